//! `fairpath-templates 1`: a set of French curves as JSON. Numbers are printed so that they read back to the same f64.

use crate::error::{Error, Fault};
use crate::input::Budget;
use crate::limits::Limits;
use crate::strokes_json::{check_format, check_version, json_fault};
use crate::unit::Unit;
use fairpath_curve::{Continuity, Segment, Spline, SplineError};
use fairpath_fit::TemplateSet;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

/// The word in the file's `format`.
const FORMAT: &str = "fairpath-templates";

/// A set of French curves as it is written; this is what the schema describes.
#[derive(Serialize, Deserialize, JsonSchema)]
#[schemars(title = "fairpath-templates 1")]
pub(crate) struct TemplatesRecord {
    /// Always `fairpath-templates`.
    #[schemars(extend("const" = "fairpath-templates"))]
    #[serde(deserialize_with = "read_format")]
    format: String,
    /// Always 1.
    #[schemars(extend("const" = 1))]
    #[serde(deserialize_with = "read_version")]
    version: u64,
    /// Unit of all coordinates and lengths; px if absent. Others become px of a 100 dpi screen, and metres, kilometres and feet become px
    /// of a metre.
    #[serde(default)]
    unit: Unit,
    /// What the set is called; as the file if absent.
    #[serde(default)]
    name: String,
    /// The French curves, at least one, with names that differ.
    #[schemars(length(min = 1))]
    templates: Vec<TemplateRecord>,
}

/// A French curve as it is written. Where it lies and how it is turned has no meaning.
#[derive(Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "Template")]
struct TemplateRecord {
    /// What it is called in results.
    name: String,
    /// Whether the last segment runs back into the first, so that one can go round and round.
    closed: bool,
    /// The segments in order of travel, at least one.
    #[schemars(length(min = 1))]
    segments: Vec<Segment>,
    /// The continuity that each join holds to rounding: one fewer than segments for an open shape, as many for a closed one. What is drawn
    /// with the template has a corner (G0) or a jump of curvature (G1) only where the template has one.
    joins: Vec<Continuity>,
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

/// A shape that is to be a French curve, or all that is wrong with it.
pub(crate) struct Shape {
    pub(crate) name: String,
    /// Where in the file it is.
    pub(crate) place: String,
    pub(crate) spline: Result<Spline, Vec<String>>,
}

/// What a file holds before it is a set.
pub(crate) struct Shapes {
    /// What the file calls itself, if it does.
    pub(crate) name: Option<String>,
    pub(crate) unit: Unit,
    pub(crate) shapes: Vec<Shape>,
}

pub(crate) fn read(text: &str, limits: &Limits) -> Result<Shapes, Fault> {
    let record: TemplatesRecord = serde_json::from_str(text).map_err(|e| json_fault(&e))?;
    let mut budget = Budget::templates(limits);
    let mut shapes = Vec::new();
    for (i, TemplateRecord { name, closed, segments, joins }) in record.templates.into_iter().enumerate() {
        let place = format!("template {} {name:?}", i + 1);
        budget.spend(|| place.clone())?;
        shapes.push(Shape { spline: assembled(segments, joins, closed), name, place });
    }
    Ok(Shapes { name: Some(record.name).filter(|name| !name.trim().is_empty()), unit: record.unit, shapes })
}

/// The spline of segments and joins, or every reason why they make none.
fn assembled(segments: Vec<Segment>, joins: Vec<Continuity>, closed: bool) -> Result<Spline, Vec<String>> {
    match Spline::new(segments.clone(), joins.clone(), closed) {
        Ok(spline) => Ok(spline),
        Err(SplineError::InvalidSegment { .. }) => {
            let faulty = segments.iter().enumerate().filter(|(_, segment)| !segment.is_valid());
            Err(faulty.map(|(index, _)| SplineError::InvalidSegment { index }.to_string()).collect())
        }
        Err(first @ SplineError::Gap { .. }) => {
            let problems: Vec<String> = (0..joins.len()).filter_map(|i| gap(&segments, &joins, i)).collect();
            Err(if problems.is_empty() { vec![first.to_string()] } else { problems })
        }
        Err(other) => Err(vec![other.to_string()]),
    }
}

/// What is wrong with one join, looked at alone.
fn gap(segments: &[Segment], joins: &[Continuity], index: usize) -> Option<String> {
    let (&a, &b) = (segments.get(index)?, segments.get((index + 1) % segments.len())?);
    let alone = if segments.len() == 1 {
        Spline::new(vec![a], vec![joins[index]], true)
    } else {
        Spline::new(vec![a, b], vec![joins[index]], false)
    };
    match alone {
        Err(SplineError::Gap { claimed, what, gap, .. }) => {
            Some(SplineError::Gap { index, claimed, what, gap }.to_string())
        }
        _ => None,
    }
}

pub(crate) fn write(set: &TemplateSet) -> Result<Vec<u8>, Error> {
    let templates = set.templates().iter().map(|template| TemplateRecord {
        name: template.name().into(),
        closed: template.spline().is_closed(),
        segments: template.spline().segments().to_vec(),
        joins: template.spline().joins().to_vec(),
    });
    let record = TemplatesRecord {
        format: FORMAT.into(),
        version: 1,
        unit: Unit::Px,
        name: set.name().into(),
        templates: templates.collect(),
    };
    let mut bytes = serde_json::to_vec(&record).map_err(|e| Error::Unwritable {
        format: "JSON",
        place: "the set as a whole".into(),
        problem: e.to_string(),
    })?;
    bytes.push(b'\n');
    Ok(bytes)
}
