//! What every method but the first asks of a stroke before it fits anything.

use crate::options::{Closing, FitOptions};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the points of a stroke are read: their scale, whether they close, and where their corners are.
///
/// The steps are those of the shortest-path method, whose [`FitOptions`] has more to say about them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StrokeOptions {
    /// Size of one pixel of a 100 dpi screen in the stroke's unit: every length among the options is multiplied by it.
    #[schemars(extend("unit" = "unit/px"))]
    pub pixel_size: f64,
    /// Whether the stroke is a closed curve.
    pub closed: Closing,
    /// Largest distance of first and last point of a closed stroke.
    #[schemars(extend("unit" = "px"))]
    pub closing_gap: f64,
    /// Least angle between the two arcs that meet at a corner.
    #[schemars(extend("unit" = "degrees"))]
    pub corner_angle: f64,
}

impl Default for StrokeOptions {
    fn default() -> Self {
        let FitOptions { pixel_size, closed, closing_gap, corner_angle, .. } = FitOptions::default();
        Self { pixel_size, closed, closing_gap, corner_angle }
    }
}

impl StrokeOptions {
    /// The same for the steps that all methods share, which take their options from the first of them.
    pub(crate) fn of_shortest_path(&self) -> FitOptions {
        let Self { pixel_size, closed, closing_gap, corner_angle } = *self;
        FitOptions { pixel_size, closed, closing_gap, corner_angle, ..FitOptions::default() }
    }
}
