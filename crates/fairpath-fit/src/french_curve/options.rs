//! Everything that can be set about fitting with French curves.

use crate::options::FitOptions;
use crate::result::FitError;
use crate::stroke_options::StrokeOptions;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a template is laid over its part of the stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Laying {
    /// By least squares over the whole part; among the places of the templates that fit nearly as well in curvature the nearest one is taken, and
    /// neighbours are turned and shifted until they meet better. A piece is judged by all its points.
    #[default]
    Refined,
    /// As the paper does (section 3.4): its ends are laid over those of the part as closely as possible, and a piece is judged by its ends.
    Faithful,
}

/// Where the result may have corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CornerSource {
    /// The stroke is divided at its corners and each part is neatened by itself; templates may add corners of their own.
    #[default]
    PreFilter,
    /// Only where a template has one.
    Templates,
}

/// How templates may be turned and used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Flips {
    /// In their own direction only (equation 3). A stroke drawn the other way may then have another curve.
    None,
    /// In both directions (equations 3 and 4).
    #[default]
    Paper,
    /// In both directions, and turned over like a sheet as well.
    All,
}

/// How the breaks between pieces are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PieceSearch {
    /// With the least sum of errors and costs (section 3.3).
    #[default]
    Optimal,
    /// Each piece as long as it fits (section 4), by the same steps as a [`FrenchCurveStream`](crate::FrenchCurveStream) takes.
    Greedy,
}

/// Options of neatening with French curves (McCrae and Singh 2011). Sections and equations are the paper's.
///
/// Lengths in px are multiplied by `pixel_size`; so are those of the templates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FrenchCurveOptions {
    /// What every method asks of a stroke.
    #[serde(flatten)]
    pub stroke: StrokeOptions,
    /// How a template is laid over the stroke.
    pub mode: Laying,
    /// Where the result may have corners.
    pub corners: CornerSource,
    /// How templates may be turned and used (section 3.2.1).
    pub flips: Flips,
    /// How the breaks between pieces are found.
    pub search: PieceSearch,
    /// Cost of one piece: E_cost of equation 5. High, with `end_threshold` null, it remakes the stroke of long stretches of a template, however they
    /// look (figure 12).
    #[schemars(extend("unit" = "radians"))]
    pub piece_cost: f64,
    /// Error at which the greedy search ends a piece (section 4).
    #[schemars(extend("unit" = "radians"))]
    pub greedy_error: f64,
    /// A piece further than this from its part of the stroke is divided (section 3.4); null takes pieces as they are.
    #[schemars(extend("unit" = "px"))]
    pub end_threshold: Option<f64>,
    /// Arc length on each side of the place where two pieces meet along which they are blended (figure 8); less on short pieces.
    #[schemars(extend("unit" = "px"))]
    pub blend: f64,
    /// Largest distance of the clothoids of a blend to the blend as equation 6 defines it.
    #[schemars(extend("unit" = "px"))]
    pub accuracy: f64,
    /// Distance of the places along stroke and templates at which curvature is compared and pieces begin and end.
    #[schemars(extend("unit" = "px"))]
    pub spacing: f64,
    /// Neighbourhood on each side from which curvature is taken, of strokes and of templates alike.
    #[schemars(extend("unit" = "px"))]
    pub curvature_window: f64,
    /// Smallest factor by which templates are scaled. The paper uses them as they are.
    #[schemars(extend("unit" = "1"))]
    pub smallest_scale: f64,
    /// Largest factor by which templates are scaled; between both, steps of at most a tenth are tried.
    #[schemars(extend("unit" = "1"))]
    pub largest_scale: f64,
    /// A curve further than this from its stroke comes with a warning.
    #[schemars(extend("unit" = "px"))]
    pub max_error: f64,
}

impl Default for FrenchCurveOptions {
    fn default() -> Self {
        let shared = FitOptions::default();
        Self {
            stroke: StrokeOptions::default(),
            mode: Laying::Refined,
            corners: CornerSource::PreFilter,
            flips: Flips::Paper,
            search: PieceSearch::Optimal,
            piece_cost: 0.2,
            greedy_error: 0.4,
            end_threshold: Some(4.0),
            blend: 20.0,
            accuracy: 0.1,
            spacing: 3.0,
            curvature_window: 15.0,
            smallest_scale: 1.0,
            largest_scale: 1.0,
            max_error: shared.max_error,
        }
    }
}

impl FrenchCurveOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// Names the first option that is out of its range.
    pub fn validate(&self) -> Result<(), FitError> {
        // What the methods share is checked where it is defined.
        self.shared().validate()?;
        let rules = [
            ("piece_cost", self.piece_cost, 1e-6, 1e9, "1e-6 to 1e9 radians"),
            ("greedy_error", self.greedy_error, 1e-6, 1e9, "1e-6 to 1e9 radians"),
            ("end_threshold", self.end_threshold.unwrap_or(1.0), 0.1, 1e6, "0.1 to 1e6 px, or null"),
            ("blend", self.blend, 0.0, 1e4, "0 to 1e4 px"),
            ("accuracy", self.accuracy, 1e-4, 1e3, "0.0001 to 1000 px"),
            ("spacing", self.spacing, 1.0, 100.0, "1 to 100 px"),
            ("smallest_scale", self.smallest_scale, 0.05, 20.0, "0.05 to 20"),
            ("largest_scale", self.largest_scale, self.smallest_scale, 20.0, "smallest_scale to 20"),
        ];
        for (name, value, low, high, expected) in rules {
            if !(low..=high).contains(&value) {
                return Err(FitError::BadOption { name, value, expected });
            }
        }
        Ok(())
    }

    /// The options of what the methods share: cleaning, closure and corners.
    pub(crate) fn shared(&self) -> FitOptions {
        let shared = self.stroke.of_shortest_path();
        FitOptions { curvature_window: self.curvature_window, max_error: self.max_error, ..shared }
    }

    /// The same for preparing a stroke, which is not divided where corners are the templates' business.
    pub(crate) fn preparing(&self) -> FitOptions {
        match self.corners {
            CornerSource::PreFilter => self.shared(),
            CornerSource::Templates => FitOptions { corner_angle: MORE_THAN_ANY_DEGREES, ..self.shared() },
        }
    }
}

/// No corner turns by as much, degrees.
const MORE_THAN_ANY_DEGREES: f64 = 181.0;
