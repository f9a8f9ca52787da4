//! What can be set about inflating.

use crate::error::InflateError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Fewest triangles that can be asked for: with less, no closed shape looks like one.
const FEWEST: u32 = 100;

/// Most triangles of one surface, front and back together.
pub(crate) const MOST_TRIANGLES: u32 = 1_000_000;

/// How to inflate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct InflateOptions {
    /// About how many triangles the surface has, front and back together, from 100 to 1000000. Narrow places and corners take some more.
    pub triangles: u32,
    /// Largest distance of the rim's polygon from the curve, as a part of the larger side of the curve's bounding box.
    #[schemars(extend("unit" = "of the size"))]
    pub accuracy: f64,
    /// Factor of the height: with 1, a circle becomes a sphere.
    pub height: f64,
}

impl Default for InflateOptions {
    fn default() -> Self {
        Self { triangles: 20_000, accuracy: 5e-4, height: 1.0 }
    }
}

impl InflateOptions {
    /// Whether every option makes sense.
    ///
    /// # Errors
    /// [`InflateError::BadOption`] for the first that does not.
    pub fn check(&self) -> Result<(), InflateError> {
        let bad = |name, value, expected| Err(InflateError::BadOption { name, value, expected });
        if !(FEWEST..=MOST_TRIANGLES).contains(&self.triangles) {
            return bad("triangles", f64::from(self.triangles), "a whole number from 100 to 1000000");
        }
        if !(1e-6..=0.1).contains(&self.accuracy) {
            return bad("accuracy", self.accuracy, "a number from 0.000001 to 0.1");
        }
        if !(1e-3..=1e3).contains(&self.height) {
            return bad("height", self.height, "a number from 0.001 to 1000");
        }
        Ok(())
    }
}
