//! Where on the globe a terrain lies, as plain words: nothing here computes with it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The plane in which a terrain's metres are, and where in that plane its own origin lies. A point (x, y) of the terrain has the easting
/// `origin_m[0] + x` and the northing `origin_m[1] + y`; `fairpath-io` makes longitude and latitude of that.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GeoReference {
    /// The projection as a PROJ string in metres, such as `+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs`.
    pub projection: String,
    /// The number of exactly that projection, metres included, in the register of the EPSG, where it has one.
    pub epsg: Option<u32>,
    /// Easting and northing of the terrain's own origin (0, 0), m.
    pub origin_m: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_survives_json_to_the_last_bit_and_typing_errors_are_told() {
        let reference = GeoReference {
            projection: "+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs".into(),
            epsg: Some(32_631),
            origin_m: [368_377.657_711_943_67, 1.0 / 3.0],
        };
        let json = serde_json::to_string(&reference).unwrap();
        assert_eq!(serde_json::from_str::<GeoReference>(&json).unwrap(), reference);
        let odd = json.replace("epsg", "espg");
        assert!(serde_json::from_str::<GeoReference>(&odd).unwrap_err().to_string().contains("espg"));
    }
}
