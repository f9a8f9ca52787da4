//! Everything that can be set about fitting, with the paper's numbers as they stand there.

use crate::result::FitError;
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
    /// The numbers and the steps as the paper has them, and nothing beyond it. Where the paper leaves a cost open, the one that its
    /// first author settled on later.
    Paper,
}

impl Preset {
    /// All presets, in the order of their documentation.
    pub const ALL: [Self; 7] =
        [Self::Default, Self::Accurate, Self::Loose, Self::LinesArcs, Self::Polyline, Self::Clothoids, Self::Paper];

    /// Its name in files and on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Accurate => "accurate",
            Self::Loose => "loose",
            Self::LinesArcs => "lines-arcs",
            Self::Polyline => "polyline",
            Self::Clothoids => "clothoids",
            Self::Paper => "paper",
        }
    }

    /// The preset of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }
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

/// How samples are placed along the stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Resampling {
    /// At equal steps of the integral of the sampling rate: the same places whichever way the stroke is drawn.
    #[default]
    Even,
    /// As the paper does: the longest allowed steps from the start, the last four samples moved to meet the end.
    Greedy,
}

/// How the cost of a join is estimated before it is verified.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Transitions {
    /// The least-squares cost of moving both primitives so that they meet, from the covariances of their fits.
    #[default]
    Covariance,
    /// The paper's bound from the mismatch in position, heading and curvature.
    Paper,
}

/// How the path is found again after some of its joins got dearer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Search {
    /// Distances to the target are repaired near the joins that changed, and brought up to date everywhere before the path is accepted.
    #[default]
    Repair,
    /// As the paper does: A* with the distances found before as its heuristic, which are computed anew every few runs.
    AStar,
}

/// How the path around a smoothly closed stroke is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ClosedSearch {
    /// The shortest cycle: bounded from below by the best way once around between any two nodes, and found by branch and bound where
    /// that does not close. On a ring of very many equal cycles the search is given up after 40 times the work of its first round, and
    /// the best cycle so far is taken.
    #[default]
    Exact,
    /// As the paper does: the shortest one through a node in the middle of what was found before, three times.
    ThreeRounds,
}

/// What stands for the deviation of a primitive from its data in costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Deviation {
    /// Twice the root mean square distance: for a smooth misfit about the largest, but hardly moved by tremor.
    #[default]
    Rms,
    /// The largest distance (equation 2).
    Max,
}

/// Options of the shortest-path method (Baran, Lehtinen and Popović 2010). Sections and equations are the paper's.
///
/// Lengths in px are multiplied by `pixel_size`; costs are compared with each other only. A cost of `null` forbids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FitOptions {
    /// Size of one pixel of a 100 dpi screen in the stroke's unit: every length below is multiplied by it.
    #[schemars(extend("unit" = "unit/px"))]
    pub pixel_size: f64,
    /// Whether the stroke is a closed curve (section 3.1).
    pub closed: Closing,
    /// Largest distance of first and last point of a closed stroke (section 3.1; the paper's value is 15).
    #[schemars(extend("unit" = "px"))]
    pub closing_gap: f64,
    /// Least angle between the two arcs that meet at a corner (section 3.1 leaves the method open).
    #[schemars(extend("unit" = "degrees"))]
    pub corner_angle: f64,
    /// How much better two arcs must describe a corner than one: the drop in mean square distance over what remains.
    #[schemars(extend("unit" = "1"))]
    pub corner_score: f64,
    /// Least share of a corner's angle in the turning of its neighbourhood.
    #[schemars(extend("unit" = "1"))]
    pub corner_share: f64,
    /// Tremor taken for granted when that is judged.
    #[schemars(extend("unit" = "px"))]
    pub corner_noise: f64,
    /// A corner rounded to this radius or more is a bend.
    #[schemars(extend("unit" = "px"))]
    pub corner_radius: f64,
    /// Largest neighbourhood on each side of a corner; three smaller ones are looked at as well.
    #[schemars(extend("unit" = "px"))]
    pub corner_window: f64,
    /// Least distance of two corners along the stroke.
    #[schemars(extend("unit" = "px"))]
    pub corner_distance: f64,
    /// No piece bends to a smaller radius; corners stay corners. 1 is the finest bend that a pixel shows.
    #[schemars(extend("unit" = "px"))]
    pub min_radius: f64,
    /// How samples are placed (section 3.2).
    pub resampling: Resampling,
    /// How fast the distance of samples may change along the stroke: β of section 3.2; the paper's value is 0.2.
    #[schemars(extend("unit" = "px/px"))]
    pub sampling_falloff: f64,
    /// Samples on a full circle: γ of section 3.2; the paper's value is 15.
    #[schemars(extend("unit" = "1"))]
    pub points_per_circle: f64,
    /// Least distance of samples (section 3.2).
    #[schemars(extend("unit" = "px"))]
    pub min_sampling: f64,
    /// Largest distance of samples (section 3.2).
    #[schemars(extend("unit" = "px"))]
    pub max_sampling: f64,
    /// Neighbourhood on each side from which curvature is estimated (section 3.2).
    #[schemars(extend("unit" = "px"))]
    pub curvature_window: f64,
    /// A candidate further than this from its samples is discarded (equation 2).
    #[schemars(extend("unit" = "px"))]
    pub max_error: f64,
    /// Weight of the first and last sample of a candidate relative to the others (equation 1).
    #[schemars(extend("unit" = "1"))]
    pub end_factor: f64,
    /// Share of the weight that the samples carry in fits; the input points carry the rest, so that tremor is averaged.
    #[schemars(extend("unit" = "1"))]
    pub sample_share: f64,
    /// Cost of a line; null forbids lines (section 3.4).
    #[schemars(extend("unit" = "cost"))]
    pub line_cost: Option<f64>,
    /// Cost of an arc; null forbids arcs (section 3.4).
    #[schemars(extend("unit" = "cost"))]
    pub arc_cost: Option<f64>,
    /// Cost of a clothoid; null forbids clothoids (section 3.4).
    #[schemars(extend("unit" = "cost"))]
    pub clothoid_cost: Option<f64>,
    /// Cost of a join with continuous position only, away from corners; null forbids it (section 3.4).
    #[schemars(extend("unit" = "cost"))]
    pub g0_cost: Option<f64>,
    /// Cost of a join with continuous heading; null forbids it (section 3.4).
    #[schemars(extend("unit" = "cost"))]
    pub g1_cost: Option<f64>,
    /// Cost of a join with continuous curvature; null forbids it (section 3.4).
    #[schemars(extend("unit" = "cost"))]
    pub g2_cost: Option<f64>,
    /// Cost of deviation, times the square of what exceeds `free_error`: w_E of section 3.4.
    #[schemars(extend("unit" = "cost/px²"))]
    pub error_cost: f64,
    /// What stands for the deviation of a primitive (equation 2).
    pub deviation: Deviation,
    /// Deviation that costs nothing (section 3.4).
    #[schemars(extend("unit" = "px"))]
    pub free_error: f64,
    /// Cost of shortness, times the square of what a primitive falls short of `short_length`: w_S of section 3.4.
    #[schemars(extend("unit" = "cost/px²"))]
    pub shortness_cost: f64,
    /// Primitives shorter than this cost extra: l_min of section 3.4.
    #[schemars(extend("unit" = "px"))]
    pub short_length: f64,
    /// Largest share of the stroke's length that `free_error` may be: a small letter is drawn more finely. 1 leaves the paper's rule.
    #[schemars(extend("unit" = "1"))]
    pub free_share: f64,
    /// Cost of an inflection (sections 3.4 and 3.8); its author settled on 20 later.
    #[schemars(extend("unit" = "cost"))]
    pub inflection_cost: f64,
    /// Sample intervals by which primitives overlap at a G2 join (section 3.4): 0, 1 or 2.
    #[schemars(extend("unit" = "samples"))]
    pub g2_overlap: usize,
    /// Sample intervals by which primitives overlap at a G1 join (section 3.4): 0, 1 or 2.
    #[schemars(extend("unit" = "samples"))]
    pub g1_overlap: usize,
    /// How the cost of a join is estimated before it is verified (section 3.4).
    pub transitions: Transitions,
    /// Ratio of largest to root mean square displacement assumed when a join is estimated by covariance.
    #[schemars(extend("unit" = "1"))]
    pub transition_peak: f64,
    /// A join that is expected to move both primitives further than this is not considered (section 3.4).
    #[schemars(extend("unit" = "px"))]
    pub max_join_error: f64,
    /// How the path is found again after some of its joins got dearer (section 3.5).
    pub search: Search,
    /// How the path around a smoothly closed stroke is found (section 3.5).
    pub closed_search: ClosedSearch,
    /// Most times that the shortest path is searched anew after its joins have been verified (section 3.5).
    #[schemars(extend("unit" = "1"))]
    pub validation_rounds: usize,
    /// Whether the merged curve is improved by local changes that the same costs welcome (beyond the paper).
    pub refine: bool,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self::preset(Preset::Default)
    }
}

impl FitOptions {
    /// The options of a preset.
    #[must_use]
    pub fn preset(preset: Preset) -> Self {
        let default = Self {
            pixel_size: 1.0,
            closed: Closing::Auto,
            closing_gap: 15.0,
            corner_angle: 38.0,
            corner_score: 3.0,
            corner_share: 0.75,
            corner_noise: 0.5,
            corner_radius: 3.3,
            corner_window: 26.0,
            corner_distance: 12.0,
            min_radius: 1.0,
            resampling: Resampling::Even,
            sampling_falloff: 0.5,
            points_per_circle: 12.0,
            min_sampling: 2.0,
            max_sampling: 1000.0,
            curvature_window: 15.0,
            max_error: 5.0,
            end_factor: 2.0,
            sample_share: 0.25,
            line_cost: Some(7.5),
            arc_cost: Some(9.0),
            clothoid_cost: Some(15.0),
            g0_cost: None,
            g1_cost: None,
            g2_cost: Some(0.0),
            error_cost: 5.0,
            deviation: Deviation::Rms,
            free_error: 1.3,
            shortness_cost: 0.5,
            short_length: 40.0,
            free_share: 0.01,
            inflection_cost: 8.0,
            g2_overlap: 2,
            g1_overlap: 1,
            transitions: Transitions::Covariance,
            transition_peak: 2.0,
            max_join_error: 10.0,
            search: Search::Repair,
            closed_search: ClosedSearch::Exact,
            validation_rounds: 3,
            refine: true,
        };
        match preset {
            Preset::Default => default,
            Preset::Accurate => {
                Self { error_cost: 15.0, free_error: 0.7, max_error: 4.0, points_per_circle: 14.0, ..default }
            }
            Preset::Loose => Self { error_cost: 1.0, max_error: 8.0, ..default },
            Preset::LinesArcs => Self {
                line_cost: Some(8.0),
                arc_cost: Some(12.0),
                clothoid_cost: None,
                g1_cost: Some(0.0),
                shortness_cost: 0.0,
                ..default
            },
            Preset::Polyline => Self {
                line_cost: Some(5.0),
                arc_cost: None,
                clothoid_cost: None,
                g0_cost: Some(0.0),
                error_cost: 2.5,
                points_per_circle: 30.0,
                sampling_falloff: 0.2,
                shortness_cost: 0.0,
                ..default
            },
            Preset::Clothoids => Self { line_cost: None, arc_cost: None, ..default },
            Preset::Paper => Self {
                resampling: Resampling::Greedy,
                sampling_falloff: 0.2,
                points_per_circle: 15.0,
                sample_share: 1.0,
                error_cost: 1.0,
                inflection_cost: 20.0,
                deviation: Deviation::Max,
                free_share: 1.0,
                shortness_cost: 2.0,
                transitions: Transitions::Paper,
                search: Search::AStar,
                closed_search: ClosedSearch::ThreeRounds,
                refine: false,
                ..default
            },
        }
    }

    /// Checks every option against its range.
    ///
    /// # Errors
    /// Names the first option that is out of its range.
    pub fn validate(&self) -> Result<(), FitError> {
        let positive = |v: f64| v.is_finite() && v > 0.0;
        let not_negative = |v: f64| v.is_finite() && v >= 0.0;
        type Rule<'a> = (&'static str, f64, &'a dyn Fn(f64) -> bool, &'static str);
        let within = |low: f64, high: f64| move |v: f64| (low..=high).contains(&v);
        let (share, sampled, circle) = (within(0.0, 1.0), within(0.25, 1e6), within(4.0, 200.0));
        let (window, angle, falloff) = (within(4.0, 1000.0), within(1.0, 179.0), within(0.01, 10.0));
        let (pixel, limit) = (within(1e-12, 1e12), within(0.01, 1e4));
        let rules: [Rule; 28] = [
            ("pixel_size", self.pixel_size, &pixel, "1e-12 to 1e12"),
            ("closing_gap", self.closing_gap, &not_negative, "0 or more"),
            ("corner_angle", self.corner_angle, &angle, "1 to 179 degrees"),
            ("corner_score", self.corner_score, &not_negative, "0 or more"),
            ("corner_share", self.corner_share, &share, "0 to 1"),
            ("corner_noise", self.corner_noise, &positive, "more than 0"),
            ("corner_radius", self.corner_radius, &positive, "more than 0"),
            ("corner_window", self.corner_window, &window, "4 to 1000 px"),
            ("corner_distance", self.corner_distance, &not_negative, "0 or more"),
            ("min_radius", self.min_radius, &limit, "0.01 to 1e4 px"),
            ("sampling_falloff", self.sampling_falloff, &falloff, "0.01 to 10"),
            ("points_per_circle", self.points_per_circle, &circle, "4 to 200"),
            ("min_sampling", self.min_sampling, &sampled, "0.25 to 1e6 px"),
            ("max_sampling", self.max_sampling, &sampled, "0.25 to 1e6 px"),
            ("max_sampling", self.max_sampling, &|v| v >= self.min_sampling, "at least min_sampling"),
            ("curvature_window", self.curvature_window, &window, "4 to 1000 px"),
            ("max_error", self.max_error, &limit, "0.01 to 1e4 px"),
            ("end_factor", self.end_factor, &limit, "0.01 to 1e4"),
            ("sample_share", self.sample_share, &share, "0 to 1"),
            ("error_cost", self.error_cost, &not_negative, "0 or more"),
            ("free_error", self.free_error, &not_negative, "0 or more"),
            ("shortness_cost", self.shortness_cost, &not_negative, "0 or more"),
            ("short_length", self.short_length, &not_negative, "0 or more"),
            ("free_share", self.free_share, &not_negative, "0 or more"),
            ("inflection_cost", self.inflection_cost, &not_negative, "0 or more"),
            ("transition_peak", self.transition_peak, &not_negative, "0 or more"),
            ("max_join_error", self.max_join_error, &positive, "more than 0"),
            ("validation_rounds", self.validation_rounds as f64, &within(0.0, 1000.0), "0 to 1000"),
        ];
        for (name, value, accepts, expected) in rules {
            if !accepts(value) {
                return Err(FitError::BadOption { name, value, expected });
            }
        }
        for (name, overlap) in [("g2_overlap", self.g2_overlap), ("g1_overlap", self.g1_overlap)] {
            if overlap > 2 {
                return Err(FitError::BadOption { name, value: overlap as f64, expected: "0, 1 or 2" });
            }
        }
        let costs = [
            ("line_cost", self.line_cost),
            ("arc_cost", self.arc_cost),
            ("clothoid_cost", self.clothoid_cost),
            ("g0_cost", self.g0_cost),
            ("g1_cost", self.g1_cost),
            ("g2_cost", self.g2_cost),
        ];
        for (name, cost) in costs {
            if let Some(value) = cost
                && !not_negative(value)
            {
                return Err(FitError::BadOption { name, value, expected: "0 or more, or null to forbid" });
            }
        }
        if self.line_cost.is_none() && self.arc_cost.is_none() && self.clothoid_cost.is_none() {
            return Err(FitError::BadOption {
                name: "line_cost",
                value: f64::NAN,
                expected: "at least one kind of primitive must be allowed",
            });
        }
        Ok(())
    }

    /// The largest curvature of a piece, radians per px.
    pub(crate) fn max_curvature(&self) -> f64 {
        1.0 / self.min_radius
    }

    /// The sizes of neighbourhood in which corners are looked for, px.
    pub(crate) fn corner_windows(&self) -> [f64; 4] {
        [1.0, 0.7, 0.5, 0.35].map(|share| share * self.corner_window)
    }
}
