//! Everything that can be set about fitting in curvature space.

use super::blend::Blend;
use crate::options::FitOptions;
use crate::result::FitError;
use crate::stroke_options::StrokeOptions;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How far the method goes beyond its paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// The pieces found in curvature space are then fitted to the points themselves: curvature that is integrated twice drifts.
    #[default]
    Refined,
    /// As the paper does: curvature is integrated as it was found, and the whole laid over the stroke.
    Faithful,
}

/// How curvature is estimated along the stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CurvatureEstimate {
    /// The circle with the least squared distances to all points of a window.
    #[default]
    Circle,
    /// From each point and its two neighbours (equation 6): for strokes without tremor.
    ThreePoints,
}

/// Options of fitting in curvature space (McCrae and Singh 2008). Sections and equations are the paper's.
///
/// Lengths in px are multiplied by `pixel_size`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CurvatureSpaceOptions {
    /// What every method asks of a stroke.
    #[serde(flatten)]
    pub stroke: StrokeOptions,
    /// How far the method goes beyond its paper.
    pub mode: Mode,
    /// How curvature is estimated (section 4.1).
    pub curvature: CurvatureEstimate,
    /// Neighbourhood on each side to which a circle is fitted.
    #[schemars(extend("unit" = "px"))]
    pub curvature_window: f64,
    /// Distance of the places where circles are fitted; more on strokes longer than 500 times this between two corners.
    #[schemars(extend("unit" = "px"))]
    pub spacing: f64,
    /// Cost of one linear piece of curvature: E_cost of equation 7. Errors are counted per length of stroke, so that this does not depend on how
    /// dense the points lie: it is the paper's value times their distance.
    #[schemars(extend("unit" = "radians"))]
    pub piece_cost: f64,
    /// Whether the pieces are improved once they follow the points: those that need not be clothoids become arcs and lines, two become one,
    /// one becomes two, and inflections that nobody drew are taken out, as far as the costs below welcome it (beyond the paper; mode refined).
    pub simplify: bool,
    /// Cost of a line; null forbids lines.
    #[schemars(extend("unit" = "cost"))]
    pub line_cost: Option<f64>,
    /// Cost of an arc; null forbids arcs.
    #[schemars(extend("unit" = "cost"))]
    pub arc_cost: Option<f64>,
    /// Cost of a clothoid.
    #[schemars(extend("unit" = "cost"))]
    pub clothoid_cost: f64,
    /// Cost of an inflection.
    #[schemars(extend("unit" = "cost"))]
    pub inflection_cost: f64,
    /// Cost of deviation, times the square of what exceeds `free_share`, as a share of `target_error`, or of `max_error` where that is null.
    #[schemars(extend("unit" = "cost"))]
    pub error_cost: f64,
    /// Deviation that costs nothing, as a share of the same; on strokes of less than 100 px proportionally less.
    #[schemars(extend("unit" = "1"))]
    pub free_share: f64,
    /// Weight of ends and corners relative to other points when the curve is laid over the stroke (section 4.4).
    #[schemars(extend("unit" = "1"))]
    pub end_weight: f64,
    /// Half the width of the window in which a knot of curvature is rounded off (section 5.2), at most 0.45 of the pieces beside it; 0 leaves
    /// the knots as they are. A refined curve is moved by no more than 0.2 px thereby.
    #[schemars(extend("unit" = "px"))]
    pub blend: f64,
    /// Pieces of such a window, an even number: at each join the slope of curvature changes by so great a part of what it changed by
    /// at the knot.
    #[schemars(extend("unit" = "1"))]
    pub blend_pieces: usize,
    /// Largest deviation to be reached by lowering `piece_cost` as long as that helps (section 6); null leaves the cost as it is.
    #[schemars(extend("unit" = "px"))]
    pub target_error: Option<f64>,
    /// A curve further than this from its stroke comes with a warning.
    #[schemars(extend("unit" = "px"))]
    pub max_error: f64,
}

impl Default for CurvatureSpaceOptions {
    fn default() -> Self {
        let shared = FitOptions::default();
        Self {
            stroke: StrokeOptions::default(),
            mode: Mode::Refined,
            curvature: CurvatureEstimate::Circle,
            curvature_window: 15.0,
            spacing: 6.0,
            piece_cost: 0.2,
            simplify: true,
            line_cost: shared.line_cost,
            arc_cost: shared.arc_cost,
            clothoid_cost: 15.0,
            inflection_cost: shared.inflection_cost,
            error_cost: 125.0,
            free_share: 0.26,
            end_weight: 2.0,
            blend: 0.0,
            blend_pieces: 8,
            target_error: Some(5.0),
            max_error: shared.max_error,
        }
    }
}

impl CurvatureSpaceOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// Names the first option that is out of its range.
    pub fn validate(&self) -> Result<(), FitError> {
        // What both methods share is checked where it is defined.
        self.shared().validate()?;
        let rules = [
            ("spacing", self.spacing, 0.25, 1e6, "0.25 to 1e6 px"),
            ("piece_cost", self.piece_cost, 1e-9, 1e9, "1e-9 to 1e9 radians"),
            ("line_cost", self.line_cost.unwrap_or(0.0), 0.0, 1e9, "0 to 1e9, or null to forbid"),
            ("arc_cost", self.arc_cost.unwrap_or(0.0), 0.0, 1e9, "0 to 1e9, or null to forbid"),
            ("clothoid_cost", self.clothoid_cost, 0.0, 1e9, "0 to 1e9"),
            ("inflection_cost", self.inflection_cost, 0.0, 1e9, "0 to 1e9"),
            ("error_cost", self.error_cost, 0.0, 1e9, "0 to 1e9"),
            ("free_share", self.free_share, 0.0, 1.0, "0 to 1"),
            ("end_weight", self.end_weight, 0.01, 1e4, "0.01 to 1e4"),
            ("blend", self.blend, 0.0, 1e6, "0 to 1e6 px"),
            ("target_error", self.target_error.unwrap_or(1.0), 1e-3, 1e4, "0.001 to 1e4 px, or null"),
        ];
        for (name, value, low, high, expected) in rules {
            if !(low..=high).contains(&value) {
                return Err(FitError::BadOption { name, value, expected });
            }
        }
        if !(2..=64).contains(&self.blend_pieces) || !self.blend_pieces.is_multiple_of(2) {
            let (name, expected) = ("blend_pieces", "an even number from 2 to 64");
            return Err(FitError::BadOption { name, value: self.blend_pieces as f64, expected });
        }
        Ok(())
    }

    /// The options of what the methods share: cleaning, closure and corners.
    pub(crate) fn shared(&self) -> FitOptions {
        FitOptions {
            curvature_window: self.curvature_window,
            max_error: self.max_error,
            ..self.stroke.of_shortest_path()
        }
    }

    /// How knots are rounded off, if they are.
    pub(crate) fn blending(&self) -> Option<Blend> {
        (self.blend > 0.0).then_some(Blend { half_width: self.blend, steps: self.blend_pieces })
    }

    /// The same, for a curve that stays closer to its stroke.
    pub(crate) fn closer(&self) -> Self {
        Self {
            piece_cost: 0.25 * self.piece_cost,
            inflection_cost: 0.25 * self.inflection_cost,
            error_cost: 4.0 * self.error_cost,
            ..self.clone()
        }
    }

    /// The costs by which pieces of a stroke of given length in px are judged.
    pub(crate) fn costs(&self, length: f64) -> FitOptions {
        let scale = self.target_error.unwrap_or(self.max_error);
        let shared = self.shared();
        FitOptions {
            line_cost: self.line_cost,
            arc_cost: self.arc_cost,
            clothoid_cost: Some(self.clothoid_cost),
            inflection_cost: self.inflection_cost,
            error_cost: self.error_cost / (scale * scale),
            free_error: (self.free_share * scale).min(shared.free_share * length),
            // Beyond it the farthest point counts, not the mean.
            max_error: scale,
            end_factor: self.end_weight,
            ..shared
        }
    }
}
