//! Splines of one file with their reports, and the strokes that have none.

use crate::unit::{Unit, YAxis};
use fairpath_curve::Spline;
use fairpath_fit::{Fit, FitError, Report, Warning};
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
            warnings,
        }
    }
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
