//! What a user draws: a sequence of points, with times and pressures where the device gives them.

use fairpath_curve::Point;
use serde::{Deserialize, Serialize};

/// A hand-drawn stroke.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Name, unique in its file; the result carries it.
    pub name: String,
    /// Positions in drawing order, in the file's unit.
    pub points: Vec<Point>,
    /// Seconds for each point, or empty where the device gave none.
    pub times_s: Vec<f64>,
    /// Pressure in [0, 1] for each point, or empty where the device gave none.
    pub pressures: Vec<f64>,
}

impl Stroke {
    /// A stroke of bare positions.
    #[must_use]
    pub fn new(name: impl Into<String>, points: Vec<Point>) -> Self {
        Self { name: name.into(), points, times_s: Vec::new(), pressures: Vec::new() }
    }
}
