//! `fairpath-spline 1`: splines as JSON. Numbers are printed so that they read back to the same f64.

use crate::error::{Error, Fault};
use crate::input::Budget;
use crate::limits::{Limits, ReadOptions};
use crate::spline_file::{Failure, Milliseconds, SplineEntry, SplineFile, SplineReport, UsedPiece, UsedTemplates};
use crate::strokes_json::{check_format, check_version, json_fault};
use crate::unit::{Unit, YAxis};
use fairpath_curve::{Continuity, Segment, Similarity, Spline};
use fairpath_fit::{Report, Warning};
use schemars::{JsonSchema, Schema};
use serde::de::{Error as _, IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;
use std::fmt;

/// The word in the file's `format`.
const FORMAT: &str = "fairpath-spline";

/// A file of splines as it is written; this is what the schema describes.
#[derive(Serialize, Deserialize, JsonSchema)]
#[schemars(title = "fairpath-spline 1")]
pub(crate) struct SplinesRecord {
    /// Always `fairpath-spline`.
    #[schemars(extend("const" = "fairpath-spline"))]
    #[serde(deserialize_with = "read_format")]
    format: String,
    /// Always 1.
    #[schemars(extend("const" = 1))]
    #[serde(deserialize_with = "read_version")]
    version: u64,
    /// Unit of all coordinates and lengths; px if absent.
    #[serde(default)]
    unit: Unit,
    /// Where the y axis points; down if absent. Positive curvature turns from x towards y.
    #[serde(default)]
    y: YAxis,
    /// The splines.
    splines: Vec<SplineRecord>,
    /// The strokes that have no spline.
    #[serde(default)]
    failures: Vec<Failure>,
}

/// A spline as it is written.
#[derive(Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "Spline")]
struct SplineRecord {
    /// The stroke's name.
    name: String,
    /// The method that made it, such as `shortest-path`.
    #[serde(default)]
    method: String,
    /// Whether the last segment runs back into the first.
    closed: bool,
    /// The segments in order of travel, at least one.
    #[schemars(length(min = 1))]
    segments: Vec<Segment>,
    /// The continuity that each join holds to rounding: one fewer than segments for an open spline, as many for a closed one.
    joins: Vec<Continuity>,
    /// Figures about the fit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    report: Option<ReportRecord>,
    /// The name of the set of French curves that it was drawn with, if it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    template_set: Option<String>,
    /// The parts of French curves that it was drawn with, in order along it; only beside `template_set`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pieces: Vec<UsedPiece>,
    /// What the reader of the result should know.
    #[serde(default)]
    warnings: Vec<Warning>,
}

/// A report as it is written: the figures of the fit and the times beside them.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "SplineReport", transform = all_optional)]
struct ReportRecord {
    #[serde(flatten)]
    figures: Report,
    /// Wall time of each step.
    #[serde(skip_serializing_if = "Option::is_none")]
    ms: Option<Milliseconds>,
}

/// Another program need not know every figure of our reports.
fn all_optional(schema: &mut Schema) {
    schema.remove("required");
}

impl<'de> Deserialize<'de> for ReportRecord {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_map(ReportVisitor)
    }
}

/// Reads a report without building a tree of what the file may have put there.
struct ReportVisitor;

impl<'de> Visitor<'de> for ReportVisitor {
    type Value = ReportRecord;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a report, an object of figures")
    }

    /// Figures that the file does not have (an older or another program wrote it) are as in a fresh report.
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ReportRecord, A::Error> {
        let mut figures = serde_json::to_value(Report::default()).map_err(A::Error::custom)?;
        let mut ms = None;
        while let Some(key) = map.next_key::<String>()? {
            if key == "ms" {
                ms = map.next_value()?;
            } else if let Some(known) = figures.get_mut(&key) {
                *known = map.next_value::<Figure>()?.0;
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        let figures = serde_json::from_value(figures).map_err(A::Error::custom)?;
        Ok(ReportRecord { figures, ms })
    }
}

/// One figure of a report: a number, a word or nothing, but no list.
struct Figure(Value);

impl<'de> Deserialize<'de> for Figure {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_any(FigureVisitor)
    }
}

struct FigureVisitor;

impl Visitor<'_> for FigureVisitor {
    type Value = Figure;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a figure of the report, a number")
    }

    fn visit_bool<E>(self, v: bool) -> Result<Figure, E> {
        Ok(Figure(v.into()))
    }

    fn visit_u64<E>(self, v: u64) -> Result<Figure, E> {
        Ok(Figure(v.into()))
    }

    fn visit_i64<E>(self, v: i64) -> Result<Figure, E> {
        Ok(Figure(v.into()))
    }

    fn visit_f64<E>(self, v: f64) -> Result<Figure, E> {
        Ok(Figure(v.into()))
    }

    fn visit_str<E>(self, v: &str) -> Result<Figure, E> {
        Ok(Figure(v.into()))
    }

    fn visit_unit<E>(self) -> Result<Figure, E> {
        Ok(Figure(Value::Null))
    }
}

fn read_format<'de, D: Deserializer<'de>>(d: D) -> Result<String, D::Error> {
    let found = String::deserialize(d)?;
    check_format(&found, FORMAT)?;
    Ok(found)
}

fn read_version<'de, D: Deserializer<'de>>(d: D) -> Result<u64, D::Error> {
    let found = u64::deserialize(d)?;
    check_version(found)?;
    Ok(found)
}

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<SplineFile, Fault> {
    let record: SplinesRecord = serde_json::from_str(text).map_err(|e| json_fault(&e))?;
    from_record(record, &options.limits)
}

fn from_record(record: SplinesRecord, limits: &Limits) -> Result<SplineFile, Fault> {
    let SplinesRecord { unit, y, splines, failures, .. } = record;
    let mut items = Budget::items(limits);
    let mut file = SplineFile { unit, y, splines: Vec::with_capacity(splines.len()), failures, warnings: Vec::new() };
    for record in splines {
        items.spend(|| format!("spline {:?}", record.name))?;
        let SplineRecord { name, method, closed, segments, joins, report, template_set, pieces, warnings } = record;
        let spline = match Spline::new(segments, joins, closed) {
            Ok(spline) => spline,
            Err(source) => return Err(Fault::Spline { name, source }),
        };
        let report = report.map(|r| SplineReport { figures: r.figures, ms: r.ms });
        let templates = used_templates(&name, template_set, pieces)?;
        file.splines.push(SplineEntry { name, method, spline, report, templates, warnings });
    }
    Ok(file)
}

/// The French curves of a spline, checked as far as that is possible without them.
fn used_templates(name: &str, set: Option<String>, pieces: Vec<UsedPiece>) -> Result<Option<UsedTemplates>, Fault> {
    let fault = |problem: String| Err(Fault::new(format_args!("spline {name:?}"), problem));
    for (i, piece) in pieces.iter().enumerate() {
        let expected = match piece {
            _ if set.is_none() => "no pieces without the `template_set` that they are of",
            UsedPiece { offset, .. } if *offset < 0.0 => "an `offset` of at least 0",
            UsedPiece { length, .. } if *length <= 0.0 => "a `length` above 0",
            UsedPiece { span: [from, to], .. } if from > to => "a `span` that does not end before it begins",
            UsedPiece { transform, .. } if transform.scale <= 0.0 => "a transform with a `scale` above 0",
            _ => continue,
        };
        return fault(format!("piece {} of {:?}: expected {expected}", i + 1, piece.template));
    }
    Ok(set.map(|set| UsedTemplates { set, pieces }))
}

pub(crate) fn write(file: &SplineFile) -> Result<Vec<u8>, Error> {
    let mut splines = Vec::with_capacity(file.splines.len());
    for entry in &file.splines {
        check_writable(entry)?;
        splines.push(SplineRecord {
            name: entry.name.clone(),
            method: entry.method.clone(),
            closed: entry.spline.is_closed(),
            segments: entry.spline.segments().to_vec(),
            joins: entry.spline.joins().to_vec(),
            report: entry.report.clone().map(|r| ReportRecord { figures: r.figures, ms: r.ms }),
            template_set: entry.templates.as_ref().map(|used| used.set.clone()),
            pieces: entry.templates.as_ref().map_or(Vec::new(), |used| used.pieces.clone()),
            warnings: entry.warnings.clone(),
        });
    }
    let (format, failures) = (FORMAT.into(), file.failures.clone());
    let record = SplinesRecord { format, version: 1, unit: file.unit, y: file.y, splines, failures };
    let mut bytes = serde_json::to_vec(&record).map_err(|e| Error::Unwritable {
        format: "JSON",
        place: "the file as a whole".into(),
        problem: e.to_string(),
    })?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// JSON has no word for what is not finite: a figure that is must not become `null` unseen.
fn check_writable(entry: &SplineEntry) -> Result<(), Error> {
    let fail = |problem| Err(Error::Unwritable { format: "JSON", place: format!("spline {:?}", entry.name), problem });
    for (i, piece) in entry.templates.iter().flat_map(|used| &used.pieces).enumerate() {
        let Similarity { scale, rotation, translation, .. } = piece.transform;
        let numbers = [piece.offset, piece.length, scale, rotation, translation.x, translation.y];
        if !numbers.iter().chain(&piece.span).all(|v| v.is_finite()) {
            return fail(format!("piece {} has a number that is not finite; leave it out or repair it", i + 1));
        }
    }
    let Some(report) = &entry.report else { return Ok(()) };
    let figures = serde_json::to_value(&report.figures).unwrap_or_default();
    let ms = serde_json::to_value(report.ms.unwrap_or_default()).unwrap_or_default();
    let mut all = [&figures, &ms].into_iter().filter_map(Value::as_object).flatten();
    if let Some((key, _)) = all.find(|(_, v)| v.is_null()) {
        return fail(format!("the report's {key} is not a finite number; leave the report out or repair it"));
    }
    Ok(())
}
