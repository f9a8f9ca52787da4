//! Everything that can be set about oversketching.

use crate::options::FitOptions;
use crate::result::FitError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What becomes of the old curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OversketchMode {
    /// What the stroke replaces and a little beside it is fitted anew by shortest paths, held where it meets the segments that stay (Baran,
    /// Lehtinen and Popović 2010, section 3.7).
    #[default]
    ShortestPath,
    /// The old curve with the stroke in it is fitted anew as a whole (McCrae and Singh 2008, section 6).
    Refit,
    /// The stroke is fitted by itself and joined to what stays by three clothoids on each side (McCrae and Singh 2008, section 6, which has
    /// a quintic polynomial where we have clothoids).
    LocalBlend,
}

/// Options of oversketching. Sections are those of Baran, Lehtinen and Popović (2010).
///
/// Lengths in px are multiplied by the `pixel_size` of `fit`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OversketchOptions {
    /// What becomes of the old curve.
    pub mode: OversketchMode,
    /// An end of the stroke no further than this from the curve is meant to lie on it (section 3.7 leaves the distance open).
    #[schemars(extend("unit" = "px"))]
    pub reach: f64,
    /// Least length of old curve that is fitted anew on each side of what the stroke replaces (section 3.7).
    #[schemars(extend("unit" = "px"))]
    pub widening: f64,
    /// Most of that length: where the next join is further, the segment is cut. Beside a stroke that is shorter, that length is enough.
    #[schemars(extend("unit" = "px"))]
    pub widest: f64,
    /// Length of the stroke over which the move of its end onto the curve fades (section 3.7: a small region). It is at least four times as long
    /// as the move, and at most half the stroke.
    #[schemars(extend("unit" = "px"))]
    pub attenuation: f64,
    /// Factor of the cost of deviation: one is more precise in correcting than in sketching (section 3.7).
    #[schemars(extend("unit" = "1"))]
    pub error_factor: f64,
    /// Largest distance of samples where the stroke leaves the curve (section 3.7: more densely).
    #[schemars(extend("unit" = "px"))]
    pub seam_sampling: f64,
    /// Weight of the points where the stroke leaves the curve, relative to others: they show how well it was hit, not how the curve shall run.
    #[schemars(extend("unit" = "1"))]
    pub seam_worth: f64,
    /// A stroke that leaves the curve at no less than this angle makes a corner there.
    #[schemars(extend("unit" = "degrees"))]
    pub seam_corner: f64,
    /// A stroke that ends no further than this from a corner of the curve, or from its end, ends there.
    #[schemars(extend("unit" = "px"))]
    pub snap: f64,
    /// How the curve is fitted.
    pub fit: FitOptions,
}

impl Default for OversketchOptions {
    fn default() -> Self {
        Self {
            mode: OversketchMode::ShortestPath,
            reach: 20.0,
            widening: 20.0,
            widest: 60.0,
            attenuation: 30.0,
            error_factor: 2.0,
            seam_sampling: 6.0,
            seam_worth: 0.2,
            seam_corner: 75.0,
            snap: 6.0,
            fit: FitOptions::default(),
        }
    }
}

impl OversketchOptions {
    /// Checks every option against its range, those of `fit` too.
    ///
    /// # Errors
    /// Names the first option that is out of its range.
    pub fn validate(&self) -> Result<(), FitError> {
        self.fit.validate()?;
        let rules = [
            ("reach", self.reach, 0.01, 1e6, "0.01 to 1e6 px"),
            ("widening", self.widening, 1.0, 1e6, "1 to 1e6 px"),
            ("widest", self.widest, self.widening, 1e6, "widening to 1e6 px"),
            ("attenuation", self.attenuation, 0.0, 1e6, "0 to 1e6 px"),
            ("error_factor", self.error_factor, 0.01, 1e4, "0.01 to 1e4"),
            ("seam_sampling", self.seam_sampling, 0.25, 1e6, "0.25 to 1e6 px"),
            ("seam_worth", self.seam_worth, 0.01, 1.0, "0.01 to 1"),
            ("seam_corner", self.seam_corner, 1.0, 180.0, "1 to 180 degrees"),
            ("snap", self.snap, 0.0, 1e6, "0 to 1e6 px"),
        ];
        for (name, value, low, high, expected) in rules {
            if !(low..=high).contains(&value) {
                return Err(FitError::BadOption { name, value, expected });
            }
        }
        Ok(())
    }
}
