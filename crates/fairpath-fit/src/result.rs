//! What fitting gives back: the spline, a report, warnings, and on request every intermediate result.

use fairpath_curve::{Point, Segment, Spline};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A fitted stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The fair curve, in the unit and frame of the stroke.
    pub spline: Spline,
    /// Figures about it.
    pub report: Report,
    /// What was done differently from what the stroke or the options asked.
    pub warnings: Vec<Warning>,
}

/// Figures about a fit. Distances are in the stroke's unit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Report {
    /// Points of the stroke as given.
    pub points: usize,
    /// Largest distance of a point of the stroke to the curve.
    pub max_deviation: f64,
    /// Root mean square distance of the stroke's points to the curve.
    pub rms_deviation: f64,
    /// Sign changes of curvature along the curve, corners included.
    pub inflections: usize,
    /// Cost of the chosen path.
    pub cost: f64,
    /// Points after resampling (section 3.2).
    pub samples: usize,
    /// Candidates in the graph (section 3.4); a line counts twice, once for each logical sign.
    pub nodes: usize,
    /// Transitions whose cost was computed.
    pub edges: usize,
    /// Transitions that were verified by a merge of two curves (section 3.5).
    pub validations: usize,
}

/// The steps of the method, in order, as an [`Observer`] is told of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// Cleaning, closure, corners and resampling (sections 3.1 and 3.2).
    Preprocess,
    /// Fitting a candidate to every run of samples (section 3.3).
    Candidates,
    /// Building the graph (section 3.4).
    Graph,
    /// Finding and verifying the path (section 3.5).
    Search,
    /// Enforcing the joins (section 3.6).
    Merge,
    /// Nothing more follows.
    Done,
}

/// Watches a fit from outside: the library itself reads no clock.
pub trait Observer {
    /// A step begins, and the one before, if any, has ended. Steps may come more than once.
    fn step(&mut self, step: Step);
}

/// Watches nothing.
impl Observer for () {
    fn step(&mut self, _step: Step) {}
}

/// Something the caller should know although there is a result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Warning {
    /// A fixed word for programs, such as `closed-by-trimming`.
    pub code: String,
    /// A sentence for people.
    pub text: String,
}

/// Why a stroke has no curve.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FitError {
    /// All points are equal, or there are none.
    #[error("the stroke is a dot: {points} points, all within {extent:e} of each other; draw a longer one")]
    TooShort {
        /// Points given.
        points: usize,
        /// Size of their bounding box.
        extent: f64,
    },
    /// The drawing is too large for its pixels.
    #[error("the stroke is {extent:e} wide, more than {largest:e}; scale it down or set a larger pixel size")]
    TooLarge {
        /// Size of its bounding box.
        extent: f64,
        /// The largest that is accepted.
        largest: f64,
    },
    /// The drawing is too long for the steps in which it is compared with templates.
    #[error("the stroke is {length:e} long, more than {longest:e}; divide it, or set a larger pixel size or spacing")]
    TooLong {
        /// Its length.
        length: f64,
        /// The longest that is accepted.
        longest: f64,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {index} of the stroke has a coordinate that is not a finite number; remove or repair it")]
    NotFinite {
        /// Which point, from 0.
        index: usize,
    },
    /// Not even a polyline could be made of the stroke.
    #[error("no curve could be made of the stroke's {points} points; check its coordinates and the pixel size")]
    Unfittable {
        /// Points given.
        points: usize,
    },
    /// An option is out of its range.
    #[error("option {name} = {value} is out of range: {expected}")]
    BadOption {
        /// The option's name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would be accepted.
        expected: &'static str,
    },
}

impl FitError {
    /// A fixed word for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooShort { .. } => "too-short",
            Self::TooLarge { .. } => "too-large",
            Self::TooLong { .. } => "too-long",
            Self::NotFinite { .. } => "not-finite",
            Self::Unfittable { .. } => "unfittable",
            Self::BadOption { .. } => "bad-option",
        }
    }
}

/// Every intermediate result of a fit, as figure 4 of the paper shows them, in the unit and frame of the stroke.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stages {
    /// The cleaned points, closed if the stroke is.
    pub points: Vec<Point>,
    /// Whether the stroke was taken as closed.
    pub closed: bool,
    /// The resampled points (figure 4 b).
    pub samples: Vec<Point>,
    /// Which samples are corners, in order; the ends of an open stroke are not among them.
    pub corners: Vec<usize>,
    /// The candidates (figure 4 c).
    pub candidates: Vec<Candidate>,
    /// The chosen candidates before merging (figure 4 e), as indices into `candidates`.
    pub path: Vec<usize>,
}

/// A primitive fitted to a run of samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The primitive.
    pub segment: Segment,
    /// First sample that it covers.
    pub first: usize,
    /// Last sample that it covers; beyond the number of samples where it runs through the start of a closed stroke.
    pub last: usize,
    /// Largest distance of those samples to it (equation 2).
    pub error: f64,
}
