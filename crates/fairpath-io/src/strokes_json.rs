//! `fairpath-strokes 1`: strokes as JSON, streamed into vectors without a tree in between.

use crate::error::{Error, Fault};
use crate::input::Budget;
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::unit::{Unit, YAxis};
use fairpath_curve::Point;
use fairpath_fit::Stroke;
use schemars::JsonSchema;
use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;

/// The word in the file's `format`.
pub(crate) const FORMAT: &str = "fairpath-strokes";

/// A file of strokes as it is written; this is what the schema describes.
#[derive(Serialize, JsonSchema)]
#[schemars(title = "fairpath-strokes 1")]
pub(crate) struct StrokesRecord<'a> {
    /// Always `fairpath-strokes`.
    #[schemars(extend("const" = "fairpath-strokes"))]
    format: &'a str,
    /// Always 1.
    #[schemars(extend("const" = 1))]
    version: u32,
    /// Unit of all coordinates; px if absent.
    #[serde(default)]
    unit: Unit,
    /// Pixels to the inch.
    #[serde(skip_serializing_if = "Option::is_none")]
    dpi: Option<f64>,
    /// Where the y axis points; down if absent.
    #[serde(default)]
    y: YAxis,
    /// The strokes.
    strokes: Vec<StrokeRecord<'a>>,
}

/// A stroke as it is written.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Stroke")]
struct StrokeRecord<'a> {
    /// Unique in the file.
    #[schemars(with = "String")]
    name: &'a str,
    /// Rows of one length: `[x, y]`, `[x, y, t]` or `[x, y, t, pressure]` with t in seconds and pressure in [0, 1]. t is null in
    /// all rows where the device gave pressures but no times.
    points: Vec<RowRecord>,
}

/// A point as it is written.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "Row")]
enum RowRecord {
    /// Position.
    Bare([f64; 2]),
    /// Position and time.
    Timed([f64; 3]),
    /// Position, time and pressure.
    Pressed(f64, f64, Option<f64>, f64),
}

pub(crate) fn write(file: &StrokeFile) -> Result<Vec<u8>, Error> {
    let mut strokes = Vec::with_capacity(file.strokes.len());
    for stroke in &file.strokes {
        strokes.push(StrokeRecord { name: &stroke.name, points: rows(stroke)? });
    }
    let record = StrokesRecord { format: FORMAT, version: 1, unit: file.unit, dpi: file.dpi, y: file.y, strokes };
    let mut bytes = serde_json::to_vec(&record).map_err(|e| unwritable("the file as a whole", &e.to_string()))?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn unwritable(place: &str, problem: &str) -> Error {
    Error::Unwritable { format: "JSON", place: place.into(), problem: problem.into() }
}

fn rows(stroke: &Stroke) -> Result<Vec<RowRecord>, Error> {
    check_writable(stroke, "JSON")?;
    let rows = stroke.points.iter().enumerate().map(|(i, p)| match (stroke.times_s.get(i), stroke.pressures.get(i)) {
        (t, Some(&pressure)) => RowRecord::Pressed(p.x, p.y, t.copied(), pressure),
        (Some(&t), None) => RowRecord::Timed([p.x, p.y, t]),
        (None, None) => RowRecord::Bare([p.x, p.y]),
    });
    Ok(rows.collect())
}

/// Every number is finite and there are as many times and pressures as points, or none.
pub(crate) fn check_writable(stroke: &Stroke, format: &'static str) -> Result<(), Error> {
    let place = || format!("stroke {:?}", stroke.name);
    let n = stroke.points.len();
    for (what, count) in [("times", stroke.times_s.len()), ("pressures", stroke.pressures.len())] {
        if count != 0 && count != n {
            let problem = format!("{count} {what} for {n} points; give as many or none");
            return Err(Error::Unwritable { format, place: place(), problem });
        }
    }
    let rows = stroke.points.iter().enumerate();
    let bad = rows.map(|(i, p)| (i, p.x.is_finite() && p.y.is_finite())).find(|r| !r.1).map(|r| r.0);
    let bad = bad.or_else(|| stroke.times_s.iter().position(|t| !t.is_finite()));
    if let Some(i) = bad.or_else(|| stroke.pressures.iter().position(|p| !p.is_finite())) {
        let problem = format!("point {i} has a number that is not finite; remove or repair it");
        return Err(Error::Unwritable { format, place: place(), problem });
    }
    Ok(())
}

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    let mut state = State {
        points: Budget::points(&options.limits),
        items: Budget::items(&options.limits),
        over: None,
        inside: None,
        file: StrokeFile::default(),
    };
    let mut json = serde_json::Deserializer::from_str(text);
    let result = FileSeed(&mut state).deserialize(&mut json).and_then(|()| json.end());
    if let Some(over) = state.over {
        return Err(over);
    }
    result.map_err(|e| match (json_fault(&e), state.inside.as_deref()) {
        (Fault::Malformed { place, problem }, Some(stroke)) => Fault::new(format_args!("{place}, {stroke}"), problem),
        (fault, _) => fault,
    })?;
    Ok(state.file)
}

/// The place and the text of a JSON error, told apart.
pub(crate) fn json_fault(e: &serde_json::Error) -> Fault {
    let (line, column) = (e.line(), e.column());
    let text = e.to_string();
    let text = text.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&text);
    let hint = if e.is_eof() { "; the file is cut off" } else { "" };
    Fault::new(format_args!("line {line}, column {column}"), format_args!("{text}{hint}"))
}

/// What is read so far.
struct State {
    points: Budget,
    items: Budget,
    over: Option<Fault>,
    /// The stroke that is being read, for messages.
    inside: Option<String>,
    file: StrokeFile,
}

impl State {
    fn spend<E: de::Error>(&mut self, points: bool) -> Result<(), E> {
        let count = self.file.strokes.len();
        let budget = if points { &mut self.points } else { &mut self.items };
        budget.spend(|| format!("stroke {count} (from 0)")).map_err(|over| {
            self.over = Some(over);
            E::custom("over a limit")
        })
    }
}

struct FileSeed<'a>(&'a mut State);

impl<'de> DeserializeSeed<'de> for FileSeed<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, d: D) -> Result<(), D::Error> {
        d.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for FileSeed<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object {\"format\":\"fairpath-strokes\",\"version\":1,\"strokes\":[…]}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let (mut format, mut version, mut strokes) = (false, false, false);
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "format" => {
                    check_format(&map.next_value::<String>()?, FORMAT)?;
                    format = true;
                }
                "version" => {
                    check_version(map.next_value::<u64>()?)?;
                    version = true;
                }
                "unit" => self.0.file.unit = map.next_value()?,
                "y" => self.0.file.y = map.next_value()?,
                "dpi" => self.0.file.dpi = map.next_value()?,
                "strokes" if strokes => return Err(de::Error::duplicate_field("strokes")),
                "strokes" => {
                    map.next_value_seed(StrokesSeed(self.0))?;
                    strokes = true;
                }
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        match (format, version, strokes) {
            (false, ..) => Err(de::Error::missing_field("format")),
            (_, false, _) => Err(de::Error::missing_field("version")),
            (.., false) => Err(de::Error::missing_field("strokes")),
            _ => Ok(()),
        }
    }
}

/// The word in `format` is the expected one.
pub(crate) fn check_format<E: de::Error>(found: &str, expected: &str) -> Result<(), E> {
    if found == expected {
        return Ok(());
    }
    let hint = match found {
        FORMAT => "; these are strokes: fit them first",
        "fairpath-spline" => "; these are splines, which are fitted already: convert them instead",
        "fairpath-templates" => "; these are French curves, to fit strokes with: give them to --templates",
        _ => "",
    };
    Err(E::custom(format_args!("the format is {found:?}, expected {expected:?}{hint}")))
}

/// The version is one that this program knows.
pub(crate) fn check_version<E: de::Error>(found: u64) -> Result<(), E> {
    if found == 1 {
        return Ok(());
    }
    Err(E::custom(format_args!("version {found} is not known, expected 1; a newer fairpath may read it")))
}

struct StrokesSeed<'a>(&'a mut State);

impl<'de> DeserializeSeed<'de> for StrokesSeed<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, d: D) -> Result<(), D::Error> {
        d.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for StrokesSeed<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of strokes")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        while let Some(stroke) = seq.next_element_seed(StrokeSeed(self.0))? {
            self.0.file.strokes.push(stroke);
        }
        Ok(())
    }
}

struct StrokeSeed<'a>(&'a mut State);

impl<'de> DeserializeSeed<'de> for StrokeSeed<'_> {
    type Value = Stroke;

    fn deserialize<D: Deserializer<'de>>(self, d: D) -> Result<Stroke, D::Error> {
        d.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for StrokeSeed<'_> {
    type Value = Stroke;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a stroke {\"name\":\"…\",\"points\":[[x,y],…]}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Stroke, A::Error> {
        self.0.spend(false)?;
        self.0.inside = Some(format!("stroke {}", self.0.file.strokes.len()));
        let mut name = None;
        let mut points = None;
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "name" => {
                    let given: String = map.next_value()?;
                    self.0.inside = Some(format!("stroke {} {given:?}", self.0.file.strokes.len()));
                    name = Some(given);
                }
                "points" if points.is_some() => return Err(de::Error::duplicate_field("points")),
                "points" => points = Some(map.next_value_seed(PointsSeed(self.0))?),
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        let mut stroke = points.ok_or_else(|| de::Error::missing_field("points"))?;
        self.0.inside = None;
        stroke.name = name.unwrap_or_else(|| format!("stroke/{}", self.0.file.strokes.len()));
        Ok(stroke)
    }
}

struct PointsSeed<'a>(&'a mut State);

impl<'de> DeserializeSeed<'de> for PointsSeed<'_> {
    type Value = Stroke;

    fn deserialize<D: Deserializer<'de>>(self, d: D) -> Result<Stroke, D::Error> {
        d.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for PointsSeed<'_> {
    type Value = Stroke;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of points [x,y], [x,y,t] or [x,y,t,pressure]")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Stroke, A::Error> {
        let mut stroke = Stroke::new("", Vec::new());
        let mut shape = None;
        while let Some(row) = seq.next_element::<Row>()? {
            self.0.spend(true)?;
            let row_shape = (row.len, row.t.is_some());
            if *shape.get_or_insert(row_shape) != row_shape {
                let message = "the rows of one stroke have different lengths (or only some have a time); \
                               expected all [x,y], all [x,y,t] or all [x,y,t,pressure]";
                return Err(de::Error::custom(message));
            }
            stroke.points.push(Point::new(row.x, row.y));
            stroke.times_s.extend(row.t);
            stroke.pressures.extend(row.pressure);
        }
        Ok(stroke)
    }
}

/// One row: position, perhaps time, perhaps pressure.
struct Row {
    len: usize,
    x: f64,
    y: f64,
    t: Option<f64>,
    pressure: Option<f64>,
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_seq(RowVisitor)
    }
}

struct RowVisitor;

impl<'de> Visitor<'de> for RowVisitor {
    type Value = Row;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a point [x,y], [x,y,t] or [x,y,t,pressure]")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Row, A::Error> {
        let short = |n| de::Error::invalid_length(n, &RowVisitor);
        let x = seq.next_element()?.ok_or_else(|| short(0))?;
        let y = seq.next_element()?.ok_or_else(|| short(1))?;
        let t = seq.next_element::<Option<f64>>()?;
        let pressure = seq.next_element::<f64>()?;
        if seq.next_element::<IgnoredAny>()?.is_some() {
            return Err(short(5));
        }
        if t == Some(None) && pressure.is_none() {
            return Err(de::Error::custom("a time of null is allowed only where a pressure follows; leave it out"));
        }
        let len = 2 + usize::from(t.is_some()) + usize::from(pressure.is_some());
        Ok(Row { len, x, y, t: t.flatten(), pressure })
    }
}
