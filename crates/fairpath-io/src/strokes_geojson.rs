//! Strokes from GeoJSON (RFC 7946): every line and every ring of a polygon, alone, in collections and in features, projected to local
//! metres (see [`crate::geodetic`]).
//!
//! A feature's `name` in its properties, else its `id`, names its strokes. Points are no strokes; elevations are left out. Coordinates are
//! longitude and latitude of WGS 84; a file that names another reference system, as was allowed before 2016, is refused.

use crate::error::Fault;
use crate::geodetic::{Place, project};
use crate::input::Budget;
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::strokes_json::json_fault;
use fairpath_fit::{Stroke, Warning};
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde_json::Value;
use std::fmt;

/// Any GeoJSON object.
#[derive(Deserialize)]
struct Object {
    #[serde(rename = "type")]
    kind: String,
    coordinates: Option<Nested>,
    geometry: Option<Box<Object>>,
    #[serde(default)]
    geometries: Vec<Object>,
    #[serde(default)]
    features: Vec<Object>,
    #[serde(default, deserialize_with = "name_only")]
    properties: Option<Value>,
    id: Option<Value>,
    crs: Option<Value>,
}

/// Properties can be anything and large: only the name stays.
fn name_only<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Value>, D::Error> {
    #[derive(Deserialize)]
    struct Named {
        name: Option<Value>,
    }
    Ok(Option::<Named>::deserialize(deserializer)?.and_then(|p| p.name))
}

/// Numbers in lists in lists.
enum Nested {
    Number(f64),
    List(Vec<Nested>),
}

impl<'de> Deserialize<'de> for Nested {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;
        impl<'de> Visitor<'de> for Numbers {
            type Value = Nested;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("coordinates: numbers in lists")
            }

            fn visit_f64<E: de::Error>(self, v: f64) -> Result<Nested, E> {
                Ok(Nested::Number(v))
            }

            fn visit_u64<E: de::Error>(self, v: u64) -> Result<Nested, E> {
                Ok(Nested::Number(v as f64))
            }

            fn visit_i64<E: de::Error>(self, v: i64) -> Result<Nested, E> {
                Ok(Nested::Number(v as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Nested, A::Error> {
                let mut list = Vec::new();
                while let Some(item) = seq.next_element()? {
                    list.push(item);
                }
                Ok(Nested::List(list))
            }
        }
        deserializer.deserialize_any(Numbers)
    }
}

/// Whether a JSON file that begins like this is GeoJSON.
pub(crate) fn begins(head: &[u8]) -> bool {
    let has = |word: &str| head.windows(word.len()).any(|w| w == word.as_bytes());
    !has("\"fairpath-")
        && has("\"type\"")
        && ["\"FeatureCollection\"", "\"Feature\"", "\"GeometryCollection\"", "LineString\"", "Polygon\""]
            .iter()
            .any(|w| has(w))
}

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    let (mut file, places) = read_places(text, options)?;
    project(&mut file, &places)?;
    Ok(file)
}

/// The lines as places on the globe: strokes without points yet, and the places of each.
pub(crate) fn read_places(text: &str, options: &ReadOptions) -> Result<(StrokeFile, Vec<Vec<Place>>), Fault> {
    let object: Object = serde_json::from_str(text).map_err(|e| json_fault(&e))?;
    check_reference_system(object.crs.as_ref())?;
    let mut reader = Reader {
        items: Budget::items(&options.limits),
        points: Budget::points(&options.limits),
        file: StrokeFile::default(),
        places: Vec::new(),
        point_geometries: 0,
    };
    reader.object(&object, "")?;
    let Reader { mut file, places, point_geometries, .. } = reader;
    if file.strokes.is_empty() {
        let problem = "there is no line or polygon; expected LineString, MultiLineString, Polygon or MultiPolygon";
        return Err(Fault::new("the file as a whole", problem));
    }
    if point_geometries > 0 {
        let text = format!("{point_geometries} geometries are points, not lines, and were left out");
        file.warnings.push(Warning { code: "points-left-out".into(), text });
    }
    Ok((file, places))
}

fn check_reference_system(crs: Option<&Value>) -> Result<(), Fault> {
    let Some(crs) = crs.filter(|c| !c.is_null()) else { return Ok(()) };
    let name = crs.pointer("/properties/name").and_then(Value::as_str).unwrap_or_default();
    if ["CRS84", "4326", "WGS84", "WGS 84"].iter().any(|known| name.contains(known)) {
        return Ok(());
    }
    let problem = format!("the coordinates are in {name:?}; reproject the file to WGS 84 (EPSG:4326)");
    Err(Fault::new("crs", problem))
}

struct Reader {
    items: Budget,
    points: Budget,
    file: StrokeFile,
    /// The places of each stroke.
    places: Vec<Vec<Place>>,
    point_geometries: usize,
}

impl Reader {
    /// Takes the lines of an object; `name` is that of the feature around it.
    fn object(&mut self, object: &Object, name: &str) -> Result<(), Fault> {
        let at = || if name.is_empty() { object.kind.clone() } else { format!("{} in {name:?}", object.kind) };
        let depth = match object.kind.as_str() {
            "FeatureCollection" => return object.features.iter().try_for_each(|f| self.object(f, name)),
            "GeometryCollection" => return object.geometries.iter().try_for_each(|g| self.object(g, name)),
            "Feature" => {
                let word = |v: &Value| match v {
                    Value::String(s) => Some(s.clone()),
                    Value::Number(n) => Some(n.to_string()),
                    _ => None,
                };
                let own = object.properties.as_ref().and_then(word).or_else(|| object.id.as_ref().and_then(word));
                // A feature may have no place.
                return object.geometry.iter().try_for_each(|g| self.object(g, own.as_deref().unwrap_or(name)));
            }
            "Point" | "MultiPoint" => {
                self.point_geometries += 1;
                return Ok(());
            }
            "LineString" => 0,
            "MultiLineString" | "Polygon" => 1,
            "MultiPolygon" => 2,
            other => {
                let problem =
                    format!("{other:?} is no type of GeoJSON; expected a feature or a geometry such as LineString");
                return Err(Fault::new(at(), problem));
            }
        };
        let Some(coordinates) = &object.coordinates else {
            return Err(Fault::new(at(), "there are no coordinates"));
        };
        self.lines(coordinates, depth, name, &at)
    }

    fn lines(&mut self, nested: &Nested, depth: usize, name: &str, at: &dyn Fn() -> String) -> Result<(), Fault> {
        let Nested::List(list) = nested else {
            return Err(Fault::new(at(), "there is a number where a list of positions is expected"));
        };
        if depth > 0 {
            return list.iter().try_for_each(|line| self.lines(line, depth - 1, name, at));
        }
        if list.is_empty() {
            return Ok(());
        }
        self.items.spend(at)?;
        self.points.spend_many(list.len(), at)?;
        let mut places = Vec::with_capacity(list.len());
        for (i, position) in list.iter().enumerate() {
            let at = || format!("{}, position {i}", at());
            let Nested::List(numbers) = position else {
                return Err(Fault::new(at(), "expected [longitude, latitude]"));
            };
            let [Nested::Number(longitude), Nested::Number(latitude), ..] = numbers[..] else {
                return Err(Fault::new(at(), "expected [longitude, latitude]"));
            };
            places.push(Place::new(longitude, latitude, at)?);
        }
        let name = if name.is_empty() { format!("line/{}", self.file.strokes.len()) } else { name.to_owned() };
        self.file.strokes.push(Stroke::new(name, Vec::new()));
        self.places.push(places);
        Ok(())
    }
}
