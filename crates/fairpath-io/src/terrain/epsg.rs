//! Numbers of the EPSG's register as planes or globes, and units of length by their numbers in it.

use super::raster::Plane;
use fairpath_fit::Warning;
use proj4rs::Proj;

/// A foot as it was in surveys of the United States, m: 1200/3937.
const US_SURVEY_FOOT_M: f64 = 1200.0 / 3937.0;
const FOOT_M: f64 = 0.3048;

/// What a number of the register stands for.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    /// The plane in metres, or the globe in degrees.
    pub(super) plane: Plane,
    /// Size of the unit in which the register has coordinates of that plane, m; 1 on the globe.
    pub(super) unit_m: f64,
    /// What had to be assumed.
    pub(super) warning: Option<Warning>,
}

/// The plane or globe of a number, or why it has none, in words.
pub(super) fn plane(code: u32) -> Result<Found, String> {
    let found = u16::try_from(code).ok().and_then(crs_definitions::from_code);
    let Some(definition) = found else {
        return Err(format!(
            "EPSG:{code} is not known; reproject the file to UTM, or to longitude and latitude (EPSG:4326)"
        ));
    };
    let refused = |why: &str| format!("EPSG:{code} cannot be computed ({why}); reproject the file to UTM");
    let proj = Proj::from_proj_string(definition.proj4).map_err(|error| refused(&error.to_string()))?;
    if proj.is_latlong() {
        let plane = Plane::Geographic { projection: definition.proj4.into() };
        return Ok(Found { plane, unit_m: 1.0, warning: assumed(code, definition.proj4) });
    }
    if proj.is_geocent() {
        return Err(refused("its coordinates are in space, not in a plane"));
    }
    if !proj.is_normalized_axis() {
        return Err(refused("its axes do not point to the east and the north"));
    }
    let unit_m = proj.to_meter();
    // The number stands for the plane in its own unit.
    let epsg = (unit_m == 1.0).then_some(code);
    let plane = Plane::Projected { projection: in_metres(definition.proj4), epsg };
    Ok(Found { plane, unit_m, warning: assumed(code, definition.proj4) })
}

/// What there is to say about a projection whose datum is told by an ellipsoid alone.
fn assumed(code: u32, projection: &str) -> Option<Warning> {
    let tells = |word: &str| {
        let is_datum = ["+datum=", "+towgs84=", "+nadgrids="].iter().any(|key| word.starts_with(key));
        // These ellipsoids are those of datums within a metre of WGS 84.
        is_datum || matches!(word, "+ellps=WGS84" | "+ellps=GRS80")
    };
    let text = format!(
        "the datum of EPSG:{code} is told by its ellipsoid alone and taken for WGS 84: places may be some hundred metres off"
    );
    let warning = Warning { code: "datum-assumed".into(), text };
    (!projection.split_ascii_whitespace().any(tells)).then_some(warning)
}

/// The same projection with its coordinates in metres. What a PROJ string says of its origin is in metres already.
fn in_metres(projection: &str) -> String {
    let is_unit = |word: &str| word.starts_with("+units=") || word.starts_with("+to_meter=");
    let mut words: Vec<&str> = projection.split_ascii_whitespace().filter(|word| !is_unit(word)).collect();
    let end = words.iter().position(|word| *word == "+no_defs").unwrap_or(words.len());
    words.insert(end, "+units=m");
    words.join(" ")
}

/// Size of a unit of length by its number, m; nothing where it is not one that terrains come in.
pub(super) fn unit_m(code: u32) -> Option<f64> {
    match code {
        9001 => Some(1.0),
        9002 => Some(FOOT_M),
        9003 => Some(US_SURVEY_FOOT_M),
        9036 => Some(1000.0),
        _ => None,
    }
}

/// Size of a unit of height by the word that GDAL writes, m.
pub(super) fn unit_of_word_m(word: &str) -> Option<f64> {
    match word.trim().to_ascii_lowercase().as_str() {
        "m" | "metre" | "meter" | "metres" | "meters" => Some(1.0),
        "ft" | "foot" | "feet" | "international foot" => Some(FOOT_M),
        "us-ft" | "us survey foot" | "us survey feet" | "foot_us" | "ftus" => Some(US_SURVEY_FOOT_M),
        _ => None,
    }
}

/// Size of the unit of a register of heights that is not in metres, m.
pub(super) fn unit_of_heights_m(code: u32) -> Option<f64> {
    match code {
        // NAVD88 and NGVD29.
        5702 | 6360 => Some(US_SURVEY_FOOT_M),
        8228 => Some(FOOT_M),
        _ => None,
    }
}

/// The zone of UTM on the datum WGS 84 in which a place lies: projection and number. Zones are six degrees wide everywhere, those about Norway too.
pub(super) fn utm([longitude, latitude]: [f64; 2]) -> (String, u32) {
    let zone = ((longitude + 180.0).rem_euclid(360.0) / 6.0) as u32 % 60 + 1;
    let (south, base) = if latitude < 0.0 { (" +south", 32_700) } else { ("", 32_600) };
    (format!("+proj=utm +zone={zone}{south} +datum=WGS84 +units=m +no_defs"), base + zone)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_planes_in_metres_or_globes_or_refused_with_advice() {
        let projected = |code| match plane(code).unwrap() {
            Found { plane: Plane::Projected { projection, epsg }, unit_m, .. } => (projection, epsg, unit_m),
            other => panic!("{other:?}"),
        };
        let utm31 = "+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs";
        assert_eq!(projected(32_631), (utm31.into(), Some(32_631), 1.0));
        assert_eq!(utm([2.9, 42.0]), (utm31.into(), 32_631));
        let (california, epsg, unit) = projected(2225);
        assert!(california.ends_with("+datum=NAD83 +units=m +no_defs"), "{california}");
        assert!(epsg.is_none() && (unit - US_SURVEY_FOOT_M).abs() < 1e-12);
        assert!(matches!(plane(4269).unwrap().plane, Plane::Geographic { .. }));
        for (code, said) in [(99_999, "not known"), (4978, "in space"), (2046, "axes")] {
            let problem = plane(code).unwrap_err();
            assert!(problem.contains(said) && problem.contains("reproject"), "{problem}");
        }
    }

    #[test]
    fn zones_are_those_of_the_globe() {
        for (place, code) in [
            ([-180.0, 1.0], 32_601),
            ([180.0, 1.0], 32_601),
            ([179.9, -1.0], 32_760),
            ([0.0, 50.0], 32_631),
            ([-124.5, 48.5], 32_610),
        ] {
            assert_eq!(utm(place).1, code, "{place:?}");
            assert!(matches!(plane(code).unwrap().plane, Plane::Projected { epsg: Some(same), .. } if same == code));
        }
    }
}
