//! What can be set about the methods that serve for comparison.

use crate::options::FitOptions;
use crate::result::FitError;
use crate::stroke_options::StrokeOptions;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of Laplacian smoothing: points are moved towards the middle of their neighbours, again and again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LaplacianOptions {
    /// What every method asks of a stroke.
    #[serde(flatten)]
    pub stroke: StrokeOptions,
    /// Distance of the points that are smoothed, laid evenly along the stroke.
    #[schemars(extend("unit" = "px"))]
    pub spacing: f64,
    /// Share of the way to the middle of its neighbours that a point moves at once.
    #[schemars(extend("unit" = "1"))]
    pub strength: f64,
    /// How often. Together they blur the stroke over `spacing` times the root of `strength` times this.
    #[schemars(extend("unit" = "1"))]
    pub iterations: u32,
}

impl Default for LaplacianOptions {
    fn default() -> Self {
        Self { stroke: StrokeOptions::default(), spacing: 4.0, strength: 0.5, iterations: 8 }
    }
}

impl LaplacianOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// Names the first option that is out of its range.
    pub fn validate(&self) -> Result<(), FitError> {
        self.stroke.of_shortest_path().validate()?;
        within(&[
            ("spacing", self.spacing, 0.25, 1e6, "0.25 to 1e6 px"),
            ("strength", self.strength, 0.0, 1.0, "0 to 1"),
            ("iterations", f64::from(self.iterations), 0.0, 1e5, "0 to 100000"),
        ])
    }
}

/// Options of least-squares cubics (P. J. Schneider, *An algorithm for automatically fitting digitized curves*, Graphics Gems, 1990).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CubicOptions {
    /// What every method asks of a stroke.
    #[serde(flatten)]
    pub stroke: StrokeOptions,
    /// A cubic that is further than this from one of its points is divided there.
    #[schemars(extend("unit" = "px"))]
    pub tolerance: f64,
    /// The spline of clothoids that is given for the cubics is within this of them.
    #[schemars(extend("unit" = "px"))]
    pub accuracy: f64,
    /// A curve further than this from its stroke comes with a warning.
    #[schemars(extend("unit" = "px"))]
    pub max_error: f64,
}

impl Default for CubicOptions {
    fn default() -> Self {
        let max_error = FitOptions::default().max_error;
        Self { stroke: StrokeOptions::default(), tolerance: 2.0, accuracy: 0.02, max_error }
    }
}

impl CubicOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// Names the first option that is out of its range.
    pub fn validate(&self) -> Result<(), FitError> {
        FitOptions { max_error: self.max_error, ..self.stroke.of_shortest_path() }.validate()?;
        within(&[
            ("tolerance", self.tolerance, 0.01, 1e4, "0.01 to 1e4 px"),
            ("accuracy", self.accuracy, 1e-4, 1.0, "0.0001 to 1 px"),
        ])
    }
}

/// Options of the curve with minimum variation of curvature: the sum of Moreton's functional `∫ κ′² ds` and the squared distance to the stroke,
/// as section 4 of Baran et al. (2010) used it for comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MvcOptions {
    /// What every method asks of a stroke.
    #[serde(flatten)]
    pub stroke: StrokeOptions,
    /// What is fairness worth: waves of up to about six times this length are smoothed away. Moreton's functional counts the sixth power of it.
    #[schemars(extend("unit" = "px"))]
    pub smoothing_length: f64,
    /// Length of the pieces of linear curvature among which the minimum is sought.
    #[schemars(extend("unit" = "px"))]
    pub spacing: f64,
    /// A curve further than this from its stroke comes with a warning.
    #[schemars(extend("unit" = "px"))]
    pub max_error: f64,
}

impl Default for MvcOptions {
    fn default() -> Self {
        let max_error = FitOptions::default().max_error;
        Self { stroke: StrokeOptions::default(), smoothing_length: 15.0, spacing: 8.0, max_error }
    }
}

impl MvcOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// Names the first option that is out of its range.
    pub fn validate(&self) -> Result<(), FitError> {
        FitOptions { max_error: self.max_error, ..self.stroke.of_shortest_path() }.validate()?;
        within(&[
            ("smoothing_length", self.smoothing_length, 0.0, 1e4, "0 to 1e4 px"),
            ("spacing", self.spacing, 1.0, 1e6, "1 to 1e6 px"),
        ])
    }
}

/// Checks each of name, value, least, largest, and what is expected.
fn within(rules: &[(&'static str, f64, f64, f64, &'static str)]) -> Result<(), FitError> {
    match rules.iter().find(|(_, value, low, high, _)| !(low..=high).contains(&value)) {
        Some(&(name, value, _, _, expected)) => Err(FitError::BadOption { name, value, expected }),
        None => Ok(()),
    }
}
