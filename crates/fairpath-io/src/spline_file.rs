//! Splines of one file with their reports, and the strokes that have none.

use crate::unit::{Unit, YAxis};
use fairpath_curve::{Similarity, Spline, Vec2};
use fairpath_fit::{Fit, FitError, Report, TemplatePiece, TemplateSet, Warning};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A file of splines: every stroke that was fitted is among `splines` or `failures`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SplineFile {
    /// Unit of all coordinates and lengths.
    pub unit: Unit,
    /// Where the y axis of the coordinates points.
    pub y: YAxis,
    /// The splines in the order of their strokes.
    pub splines: Vec<SplineEntry>,
    /// The strokes without a spline.
    pub failures: Vec<Failure>,
    /// What the reader of the file had to say about it; not part of the file.
    pub warnings: Vec<Warning>,
}

/// A spline with where it comes from and how well it does.
#[derive(Clone, Debug, PartialEq)]
pub struct SplineEntry {
    /// The stroke's name.
    pub name: String,
    /// The method that made it, such as `shortest-path`.
    pub method: String,
    /// The curve; whether it is closed it knows itself.
    pub spline: Spline,
    /// Figures, where the method gave any.
    pub report: Option<SplineReport>,
    /// The French curves that it was drawn with, if it was.
    pub templates: Option<UsedTemplates>,
    /// What the reader of the result should know.
    pub warnings: Vec<Warning>,
}

impl SplineEntry {
    /// The entry for a fitted stroke.
    #[must_use]
    pub fn from_fit(name: impl Into<String>, method: impl Into<String>, fit: Fit, ms: Option<Milliseconds>) -> Self {
        let Fit { spline, report, warnings } = fit;
        Self {
            name: name.into(),
            method: method.into(),
            spline,
            report: Some(SplineReport { figures: report, ms }),
            templates: None,
            warnings,
        }
    }
}

/// Which French curves a spline was drawn with, and where each lay.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UsedTemplates {
    /// What the set is called.
    pub set: String,
    /// The parts that were used, in order along the spline.
    pub pieces: Vec<UsedPiece>,
}

impl UsedTemplates {
    /// The pieces of a fit with the names that `set` has for them; a piece of no template of the set is left out.
    #[must_use]
    pub fn new(set: &TemplateSet, pieces: &[TemplatePiece]) -> Self {
        let named = |piece: &TemplatePiece| {
            let template = set.templates().get(piece.template)?.name().to_owned();
            let TemplatePiece { offset, length, backward, turned_over, transform, span, .. } = *piece;
            Some(UsedPiece { template, offset, length, backward, turned_over, transform, span })
        };
        Self { set: set.name().into(), pieces: pieces.iter().filter_map(named).collect() }
    }
}

/// A part of a French curve laid over a part of a stroke.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "Piece")]
pub struct UsedPiece {
    /// The template's name.
    pub template: String,
    /// Arc length along the template at which the part begins, in its own direction, px. On a closed template `offset + length` may go past
    /// its end and runs on from its start.
    pub offset: f64,
    /// Length of the part along the template, px.
    pub length: f64,
    /// Whether the part is run through against the template's own direction, from `offset + length` to `offset`.
    #[serde(default)]
    pub backward: bool,
    /// Whether the template is turned over like a sheet.
    #[serde(default)]
    pub turned_over: bool,
    /// Lays the template, px, over the stroke, in the file's unit and frame.
    #[serde(with = "SimilarityRecord")]
    #[schemars(with = "SimilarityRecord")]
    pub transform: Similarity,
    /// Arc lengths along the spline between which the part is seen, in the file's unit.
    pub span: [f64; 2],
}

/// A similarity as it is written: y changes its sign first if `mirror` says so, then lengths are multiplied by `scale`, then it is turned
/// about the origin by `rotation`, then moved by `x` and `y`.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(remote = "Similarity")]
#[schemars(rename = "Transform")]
struct SimilarityRecord {
    /// Whether y changes its sign first.
    mirror: bool,
    /// Factor of lengths, positive.
    scale: f64,
    /// Radians from x towards y.
    rotation: f64,
    /// Move by x and y.
    #[serde(flatten, with = "VectorRecord")]
    #[schemars(with = "VectorRecord")]
    translation: Vec2,
}

/// A vector as it is written.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(remote = "Vec2")]
#[schemars(rename = "Vector")]
struct VectorRecord {
    /// Along x, in the file's unit.
    x: f64,
    /// Along y, in the file's unit.
    y: f64,
}

/// The report on a fit with the time that it took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SplineReport {
    /// Figures of the fit.
    pub figures: Report,
    /// Times, where a clock was at hand.
    pub ms: Option<Milliseconds>,
}

/// Wall time of each step of a fit, milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Milliseconds {
    /// Cleaning, closure, corners and resampling.
    pub preprocess: f64,
    /// Fitting the candidates.
    pub candidates: f64,
    /// Building the graph.
    pub graph: f64,
    /// Finding and verifying the path.
    pub search: f64,
    /// Enforcing the joins.
    pub merge: f64,
    /// All of it, what lies between the steps included.
    pub total: f64,
}

/// A stroke without a spline.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Failure {
    /// The stroke's name.
    pub name: String,
    /// A fixed word for programs, such as `too-short`.
    pub code: String,
    /// A sentence for people.
    pub text: String,
}

impl Failure {
    /// The failure that `error` is for the stroke of that name.
    #[must_use]
    pub fn from_error(name: impl Into<String>, error: &FitError) -> Self {
        Self { name: name.into(), code: error.code().into(), text: error.to_string() }
    }
}
