//! Volumes of cut and fill from cross-sections, and what has to be hauled where.

use super::corridor::CrossSection;

/// Earthwork between one station and the next, and what has come together until then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassHaul {
    /// Where it begins, arc length, m.
    pub from_m: f64,
    /// Where it ends, m.
    pub to_m: f64,
    /// Volume that is dug off, m³.
    pub cut_m3: f64,
    /// Volume that is put down, m³.
    pub fill_m3: f64,
    /// All that was dug off so far, less all that was put down, m³: the ordinate of the mass-haul diagram.
    pub ordinate_m3: f64,
}

/// Volumes by average end areas, for stretches of about `every_m` m.
#[must_use]
pub fn mass_haul(sections: &[CrossSection], every_m: f64) -> Vec<MassHaul> {
    let mut table: Vec<MassHaul> = Vec::new();
    let mut ordinate = 0.0;
    for pair in sections.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let length = b.station_m - a.station_m;
        let volume =
            |i: usize| if a.on_ground && b.on_ground { 0.5 * (a.areas_m2[i] + b.areas_m2[i]) * length } else { 0.0 };
        let (cut, fill) = (volume(0), volume(1));
        ordinate += cut - fill;
        let row = (a.station_m / every_m).floor() * every_m;
        match table.last_mut() {
            Some(last) if row <= last.from_m => {
                last.to_m = b.station_m;
                last.cut_m3 += cut;
                last.fill_m3 += fill;
                last.ordinate_m3 = ordinate;
            }
            _ => table.push(MassHaul {
                from_m: row,
                to_m: b.station_m,
                cut_m3: cut,
                fill_m3: fill,
                ordinate_m3: ordinate,
            }),
        }
    }
    table
}

/// Cut and fill of all of it, m³.
#[must_use]
pub fn volumes_m3(sections: &[CrossSection]) -> [f64; 2] {
    mass_haul(sections, 1e12).iter().fold([0.0; 2], |[c, f], row| [c + row.cut_m3, f + row.fill_m3])
}
