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

/// Volumes by average end areas for every `every_m` m, the last stretch being what is left. Between two cross-sections areas change evenly, so that a stretch may end there.
#[must_use]
pub fn mass_haul(sections: &[CrossSection], every_m: f64) -> Vec<MassHaul> {
    let mut table: Vec<MassHaul> = Vec::new();
    let mut ordinate_m3 = 0.0;
    for pair in sections.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let length = b.station_m - a.station_m;
        if !(length > 0.0) {
            continue;
        }
        let mut from_m = a.station_m;
        while from_m < b.station_m {
            let row = table.last_mut().filter(|row| from_m < row.from_m + every_m);
            let begin = row.as_ref().map_or(from_m, |row| row.from_m);
            let end = begin + every_m;
            // A hair beyond a cross-section is no stretch.
            let to_m = if end < b.station_m - HAIR_M { end } else { b.station_m };
            let [t, u] = [from_m, to_m].map(|station| (station - a.station_m) / length);
            let volume = |i: usize| {
                let (p, q) = (a.areas_m2[i], b.areas_m2[i]);
                let mean = p + 0.5 * (t + u) * (q - p);
                if a.on_ground && b.on_ground { mean * (to_m - from_m) } else { 0.0 }
            };
            let (cut_m3, fill_m3) = (volume(0), volume(1));
            ordinate_m3 += cut_m3 - fill_m3;
            match row {
                Some(row) => {
                    *row = MassHaul {
                        to_m,
                        cut_m3: row.cut_m3 + cut_m3,
                        fill_m3: row.fill_m3 + fill_m3,
                        ordinate_m3,
                        ..*row
                    };
                }
                None => table.push(MassHaul { from_m, to_m, cut_m3, fill_m3, ordinate_m3 }),
            }
            from_m = to_m;
        }
    }
    table
}

/// Stretches are no shorter, m.
const HAIR_M: f64 = 1e-6;

/// Cut and fill of all of it, m³.
#[must_use]
pub fn volumes_m3(sections: &[CrossSection]) -> [f64; 2] {
    mass_haul(sections, f64::INFINITY).iter().fold([0.0; 2], |[c, f], row| [c + row.cut_m3, f + row.fill_m3])
}

/// Areas of cut and fill across a path at a station, m²: nothing on a bridge or in a tunnel.
#[must_use]
pub fn areas_m2_at(sections: &[CrossSection], station_m: f64) -> [f64; 2] {
    let after = sections.partition_point(|s| s.station_m < station_m).clamp(1, sections.len().max(2) - 1);
    let (Some(a), Some(b)) = (sections.get(after - 1), sections.get(after)) else { return [0.0; 2] };
    if !(a.on_ground && b.on_ground) {
        return [0.0; 2];
    }
    let t = ((station_m - a.station_m) / (b.station_m - a.station_m).max(HAIR_M)).clamp(0.0, 1.0);
    [0, 1].map(|i| a.areas_m2[i] + t * (b.areas_m2[i] - a.areas_m2[i]))
}
