//! Everything that can be set about fitting, with the paper's numbers as they stand there.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Named sets of options.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Preset {
    /// Lines, arcs and clothoids with G2 joins.
    #[default]
    Default,
    /// Closer to the stroke, with more segments.
    Accurate,
    /// Fewer segments, further from the stroke.
    Loose,
    /// Lines and arcs only, G1 joins.
    LinesArcs,
    /// Lines only, G0 joins.
    Polyline,
    /// Clothoids only, G2 joins.
    Clothoids,
}

impl Preset {
    /// All presets, in the order of their documentation.
    pub const ALL: [Self; 6] =
        [Self::Default, Self::Accurate, Self::Loose, Self::LinesArcs, Self::Polyline, Self::Clothoids];
}

/// Whether the stroke is a closed curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Closing {
    /// Closed where the ends come near each other (section 3.1).
    #[default]
    Auto,
    /// Closed, whatever the distance of the ends.
    Yes,
    /// Open.
    No,
}

/// Options of the shortest-path method (Baran, Lehtinen and Popović 2010). Sections and equations are the paper's.
///
/// Lengths marked px are multiplied by `pixel_size`; costs have no unit. A cost of `null` forbids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FitOptions {
    /// Size of one pixel of a 100 dpi screen in the stroke's unit: every length below is multiplied by it.
    #[schemars(extend("unit" = "unit/px"))]
    pub pixel_size: f64,
    /// Whether the stroke is a closed curve (section 3.1).
    pub closed: Closing,
    /// Largest distance of first and last point of a closed stroke (section 3.1).
    #[schemars(extend("unit" = "px"))]
    pub closing_gap: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self::preset(Preset::Default)
    }
}

impl FitOptions {
    /// The options of a preset.
    #[must_use]
    pub fn preset(_preset: Preset) -> Self {
        Self { pixel_size: 1.0, closed: Closing::Auto, closing_gap: 15.0 }
    }
}
