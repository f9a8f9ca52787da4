//! Sheets of the Shuttle Radar Topography Mission, `.hgt`: heights alone, 16 bits, the high byte first, rows from the north. Where they lie is told by the name
//! of the file alone: N42E001 is the corner in the south-west, and a sheet is one degree each way with samples on its edges. Heights are metres above the geoid.

use super::raster::{Plane, Raster, Stored, check_size};
use crate::error::Fault;
use crate::limits::Limits;
use fairpath_drive::Samples;

/// Samples each way: 3″ and 1″ apart.
const SIDES: [usize; 2] = [1201, 3601];

/// What stands for no height.
const VOID: i16 = i16::MIN;

/// The datum of their longitudes and latitudes.
pub(super) const WGS84: &str = "+proj=longlat +datum=WGS84 +no_defs";

/// A sheet of that name.
pub(super) fn read(bytes: &[u8], name: &str, limits: &Limits) -> Result<Raster, Fault> {
    let Some([longitude, latitude]) = corner(name) else {
        let problem =
            "its name alone says where a sheet lies; call it after its corner in the south-west, like N42E001.hgt";
        return Err(Fault::new("the name", problem));
    };
    let Some(side) = SIDES.into_iter().find(|side| 2 * side * side == bytes.len()) else {
        let expected = SIDES.map(|side| format!("{} for {side} × {side} samples", 2 * side * side)).join(" or ");
        let problem = format!("there are {} bytes, and a sheet has {expected}; is it cut off?", bytes.len());
        return Err(Fault::new("the file as a whole", problem));
    };
    check_size([side; 2], limits)?;
    let heights = bytes.as_chunks::<2>().0.iter().map(|&pair| match i16::from_be_bytes(pair) {
        VOID => f32::NAN,
        height => f32::from(height),
    });
    let step = 1.0 / (side - 1) as f64;
    let stored = Stored { size: [side; 2], first: [longitude, latitude + 1.0], step: [step, -step] };
    stored.raster(Samples::F32(heights.collect()), Plane::Geographic { projection: WGS84.into() }, Vec::new())
}

/// Longitude and latitude of the corner that a name such as `N42E001.SRTMGL1.hgt` tells.
pub(super) fn corner(name: &str) -> Option<[f64; 2]> {
    let file = name.rsplit(['/', '\\']).next()?;
    let letters = file.get(..7)?.to_ascii_uppercase();
    // Behind the corner there may be more, as in N42E001v3; not a further digit.
    if file.as_bytes().get(7).is_some_and(u8::is_ascii_digit) {
        return None;
    }
    let number = |text: &str, most: f64| {
        let fine = text.bytes().all(|b| b.is_ascii_digit());
        text.parse::<f64>().ok().filter(|&degrees| fine && degrees <= most)
    };
    let latitude = number(letters.get(1..3)?, 90.0)?;
    let longitude = number(letters.get(4..7)?, 180.0)?;
    let north = match letters.get(..1)? {
        "N" => latitude,
        "S" => -latitude,
        _ => return None,
    };
    match letters.get(3..4)? {
        "E" => Some([longitude, north]),
        "W" => Some([-longitude, north]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_tells_the_corner_or_is_no_name_of_a_sheet() {
        assert_eq!(corner("sheets/N42E001.hgt"), Some([1.0, 42.0]));
        assert_eq!(corner("s01w079.SRTMGL1.hgt.zip"), Some([-79.0, -1.0]));
        for odd in ["", "N42E01.hgt", "N42E0011", "X42E001", "N42X001", "N+2E001", "N42E181", "N4 E001", "ñ42E001é"] {
            assert_eq!(corner(odd), None, "{odd}");
        }
    }

    #[test]
    fn sheets_of_odd_sizes_and_too_large_ones_are_refused() {
        let refused = |bytes: usize, limits: &Limits| match read(&vec![0; bytes], "N42E001", limits) {
            Err(Fault::Malformed { problem, .. }) => problem,
            Err(Fault::OverLimit { limit, .. }) => limit.into(),
            other => panic!("{:?}", other.map(|raster| raster.size)),
        };
        let limits = Limits::default();
        assert!(refused(0, &limits).contains("2884802 for 1201 × 1201"));
        assert!(refused(2 * 1201 * 1201 - 1, &limits).contains("cut off"));
        let low = Limits { max_terrain_samples: 1_000_000, ..limits };
        assert_eq!(refused(2 * 1201 * 1201, &low), "max_terrain_samples");
    }
}
