//! What the tags of GeoTIFF say of a TIFF's coordinates: which plane or globe, in which units, and whether a sample stands for a point or for an area. After
//! OGC 19-008r4 (GeoTIFF 1.1), whose numbers of keys and values these are.

use super::TerrainOptions;
use super::epsg;
use super::hgt::WGS84;
use super::raster::{Plane, Stored};
use crate::error::Fault;
use fairpath_fit::Warning;

const MODEL_TYPE: u16 = 1024;
const RASTER_TYPE: u16 = 1025;
const GEODETIC_CRS: u16 = 2048;
const ANGULAR_UNITS: u16 = 2054;
const PROJECTED_CRS: u16 = 3072;
const LINEAR_UNITS: u16 = 3076;
const VERTICAL_CRS: u16 = 4096;
const VERTICAL_UNITS: u16 = 4099;

const MODEL_PROJECTED: u16 = 1;
const MODEL_GEOGRAPHIC: u16 = 2;
const MODEL_GEOCENTRIC: u16 = 3;
const RASTER_IS_POINT: u16 = 2;
const DEGREE: u16 = 9102;

/// What stands for something that has no number.
const USER_DEFINED: u16 = 32_767;

/// The keys of a file that have a number for a value.
#[derive(Clone, Debug, Default)]
pub(super) struct GeoKeys(Vec<(u16, u16)>);

/// What they say.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Described {
    pub(super) plane: Plane,
    /// Unit of places in the plane, m; 1 where they are degrees.
    pub(super) unit_m: f64,
    /// Unit of heights, m, if it is told.
    pub(super) height_unit_m: Option<f64>,
    /// Whether the raster's whole numbers are the middles of samples, and not their corners.
    pub(super) is_point: bool,
    pub(super) warnings: Vec<Warning>,
}

impl GeoKeys {
    /// The keys in a directory: four numbers about itself, then four for each key.
    pub(super) fn new(directory: &[u16]) -> Result<Self, Fault> {
        let place = "GeoKeyDirectory";
        let (quads, _) = directory.as_chunks::<4>();
        let [[1, _, _, count], keys @ ..] = quads else {
            return Err(Fault::new(place, "it does not begin as one; expected version 1"));
        };
        if usize::from(*count) > keys.len() {
            let problem = format!("{count} keys are announced, and there are {}; is the file cut off?", keys.len());
            return Err(Fault::new(place, problem));
        }
        // Where a place is told, the value is a number with a fraction or a text: names, and planes without a number.
        let own = keys[..usize::from(*count)].iter().filter(|[_, place, _, _]| *place == 0);
        Ok(Self(own.map(|[key, _, _, value]| (*key, *value)).collect()))
    }

    fn get(&self, key: u16) -> Option<u16> {
        self.0.iter().find(|(k, _)| *k == key).map(|(_, value)| *value)
    }

    /// A number of the register, if there is one.
    fn registered(&self, key: u16) -> Option<u32> {
        self.get(key).filter(|code| !matches!(*code, 0 | USER_DEFINED)).map(u32::from)
    }

    /// The size of the unit of a key, m.
    fn unit_m(&self, key: u16, what: &str) -> Result<Option<f64>, Fault> {
        let Some(code) = self.get(key).filter(|code| !matches!(*code, 0 | USER_DEFINED)) else { return Ok(None) };
        epsg::unit_m(code.into()).map(Some).ok_or_else(|| {
            let problem =
                format!("the unit of {what} is EPSG:{code}; expected metres, kilometres or feet: convert the file");
            Fault::new("GeoKeyDirectory", problem)
        })
    }

    /// What they say; the caller knows the number where they say nothing, and the unit of heights better.
    pub(super) fn described(&self, options: &TerrainOptions) -> Result<Described, Fault> {
        let place = "GeoKeyDirectory";
        let (projected, geodetic) = (self.registered(PROJECTED_CRS), self.registered(GEODETIC_CRS));
        let model = self.get(MODEL_TYPE);
        let is_globe = match model {
            Some(MODEL_PROJECTED) => false,
            Some(MODEL_GEOGRAPHIC) => true,
            Some(MODEL_GEOCENTRIC) => {
                return Err(Fault::new(place, "coordinates are in space, not in a plane; reproject the file to UTM"));
            }
            _ => projected.is_none() && geodetic.is_some(),
        };
        if is_globe && self.get(ANGULAR_UNITS).is_some_and(|unit| unit != DEGREE) {
            return Err(Fault::new(place, "angles are not in degrees; reproject the file to EPSG:4326"));
        }
        let says_which = matches!(model, Some(MODEL_PROJECTED | MODEL_GEOGRAPHIC));
        let mut warnings = Vec::new();
        let code = if is_globe { geodetic } else { projected }.or(options.epsg);
        let found = code.map(epsg::plane).transpose().unwrap_or_else(|problem| {
            warnings.push(Warning { code: "unknown-projection".into(), text: problem });
            None
        });
        let told = self.unit_m(LINEAR_UNITS, "places")?;
        let (plane, unit_m) = match found {
            Some(found) if is_globe != matches!(found.plane, Plane::Projected { .. }) || !says_which => {
                let unit =
                    if matches!(found.plane, Plane::Projected { .. }) { told.unwrap_or(found.unit_m) } else { 1.0 };
                warnings.extend(found.warning);
                (found.plane, unit)
            }
            _ if is_globe => {
                let text = "the datum of its longitudes and latitudes is not known and taken for WGS 84: places may be some hundred metres off";
                warnings.push(Warning { code: "datum-assumed".into(), text: text.into() });
                (Plane::Geographic { projection: WGS84.into() }, 1.0)
            }
            _ => (Plane::Local, told.unwrap_or(1.0)),
        };
        if plane == Plane::Local {
            warnings.push(Stored::without_a_globe());
        }
        let of_heights = self.registered(VERTICAL_CRS).and_then(epsg::unit_of_heights_m);
        let height_unit_m = match options.height_unit_m {
            Some(unit) => Some(unit),
            None => self.unit_m(VERTICAL_UNITS, "heights")?.or(of_heights),
        };
        let is_point = self.get(RASTER_TYPE) == Some(RASTER_IS_POINT);
        Ok(Described { plane, unit_m, height_unit_m, is_point, warnings })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(pairs: &[(u16, u16)]) -> GeoKeys {
        let mut directory = vec![1, 1, 0, pairs.len() as u16];
        pairs.iter().for_each(|&(key, value)| directory.extend([key, 0, 1, value]));
        GeoKeys::new(&directory).unwrap()
    }

    fn numbered(code: u32) -> TerrainOptions {
        TerrainOptions { epsg: Some(code), ..TerrainOptions::default() }
    }

    fn codes(described: &Described) -> Vec<&str> {
        described.warnings.iter().map(|warning| warning.code.as_str()).collect()
    }

    #[test]
    fn planes_and_globes_are_told_apart_with_their_units() {
        let utm =
            keys(&[(1024, 1), (1025, 2), (3072, 26_915), (4099, 9003)]).described(&TerrainOptions::default()).unwrap();
        assert!(matches!(utm.plane, Plane::Projected { epsg: Some(26_915), .. }));
        assert!(utm.is_point && utm.unit_m == 1.0 && utm.height_unit_m == Some(1200.0 / 3937.0));
        let feet = keys(&[(1024, 1), (3072, 2225)]).described(&TerrainOptions::default()).unwrap();
        assert!((feet.unit_m - 0.304_800_6).abs() < 1e-7 && !feet.is_point);
        // The key of the unit is more than the register's.
        assert_eq!(
            keys(&[(1024, 1), (3072, 2225), (3076, 9001)]).described(&TerrainOptions::default()).unwrap().unit_m,
            1.0
        );
        let globe = keys(&[(1024, 2), (2048, 4269)]).described(&TerrainOptions::default()).unwrap();
        assert!(matches!(globe.plane, Plane::Geographic { .. }) && globe.warnings.is_empty());
        assert_eq!(keys(&[(4096, 6360)]).described(&numbered(4326)).unwrap().height_unit_m, Some(1200.0 / 3937.0));
    }

    #[test]
    fn what_is_not_known_is_said_and_the_caller_may_know_it() {
        let unknown = keys(&[(1024, 1), (3072, 32_767), (3076, 9002)]);
        let described = unknown.described(&TerrainOptions::default()).unwrap();
        assert_eq!(
            (&described.plane, described.unit_m, codes(&described)),
            (&Plane::Local, 0.3048, vec!["no-georeference"])
        );
        assert!(matches!(unknown.described(&numbered(32_631)).unwrap().plane, Plane::Projected { .. }));
        let described = keys(&[(1024, 2), (2048, 32_767)]).described(&TerrainOptions::default()).unwrap();
        assert_eq!(codes(&described), ["datum-assumed"]);
        let described = keys(&[(1024, 1), (3072, 20_000)]).described(&TerrainOptions::default()).unwrap();
        assert_eq!(codes(&described), ["unknown-projection", "no-georeference"]);
        assert!(matches!(GeoKeys::default().described(&numbered(4326)).unwrap().plane, Plane::Geographic { .. }));
    }

    #[test]
    fn directories_that_are_none_and_units_that_are_odd_are_refused() {
        for odd in [&[][..], &[2, 1, 0, 0], &[1, 1, 0], &[1, 1, 0, 1], &[1, 1, 0, 2, 1024, 0, 1, 1]] {
            assert!(GeoKeys::new(odd).is_err(), "{odd:?}");
        }
        for odd in [(1024, 3), (3076, 9014), (4099, 9101)] {
            assert!(keys(&[odd]).described(&TerrainOptions::default()).is_err(), "{odd:?}");
        }
        // A unit that the caller knows better is not asked for.
        let feet = TerrainOptions { height_unit_m: Some(0.3048), ..TerrainOptions::default() };
        assert_eq!(keys(&[(4099, 9101)]).described(&feet).unwrap().height_unit_m, Some(0.3048));
        assert_eq!(keys(&[(4099, 32_767)]).described(&TerrainOptions::default()).unwrap().height_unit_m, None);
        assert!(keys(&[(1024, 2), (2054, 9101)]).described(&TerrainOptions::default()).is_err());
    }
}
