//! Fair curves from rough strokes: points in, a [`fairpath_curve::Spline`] of lines, arcs and clothoids with exact joins out, by the
//! shortest-path method of Baran, Lehtinen and Popović (2010), in curvature space after McCrae and Singh (2008), or of pieces of French curves
//! after McCrae and Singh (2011).
//!
//! - Fit a stroke: [`fit`]; in curvature space: [`fit_curvature_space`]; with French curves: [`fit_french_curve`], while it is drawn:
//!   [`FrenchCurveStream`]. Watch the steps or keep every intermediate result: [`fit_observed`], [`fit_curvature_space_observed`].
//! - Compare with simpler methods: [`fit_laplacian`], [`fit_cubic`], [`fit_mvc`].
//! - Correct a curve by a stroke drawn over it: [`oversketch`]; edit it: [`extend`], [`cut`], [`join`], [`close`], [`interpolate`],
//!   [`smooth_corner`], [`make_corner`].
//! - Choose between fewer segments and less deviation: [`FitOptions::preset`], [`Preset`].
//!
//! ```
//! use fairpath_curve::Point;
//! use fairpath_fit::{FitOptions, Stroke, fit};
//!
//! let points = (0..60).map(|i| Point::new(f64::from(i) * 4.0, 0.02 * f64::from(i * i))).collect();
//! let result = fit(&Stroke::new("bend", points), &FitOptions::default())?;
//! assert!(result.report.max_deviation < 2.0);
//! # Ok::<(), fairpath_fit::FitError>(())
//! ```

mod baseline;
mod clean;
mod closure;
mod conclude;
mod corners;
mod curvature_space;
mod direction;
mod edit;
mod french_curve;
mod hooks;
mod linear;
mod options;
mod oversketch;
pub mod parallel;
mod polyline;
mod primitive_fit;
mod resample;
mod result;
mod shortest_path;
mod splice;
mod stroke;
mod stroke_options;
mod track;
mod walk;

pub use baseline::{CubicOptions, LaplacianOptions, MvcOptions};
pub use curvature_space::{CurvatureEstimate, CurvaturePlace, CurvatureSpaceOptions, CurvatureStages, Mode};
pub use edit::{
    Constraint, CurveEnd, EditError, Extension, close, cut, extend, interpolate, interpolate_all, join, make_corner,
    smooth_corner,
};
pub use french_curve::{
    Committed, CornerSource, Flips, FrenchCurveFit, FrenchCurveOptions, FrenchCurveStream, Laying, PieceSearch,
    Template, TemplateError, TemplatePiece, TemplateSet,
};
pub use options::{ClosedSearch, Closing, Deviation, FitOptions, Preset, Resampling, Search, Transitions};
pub use oversketch::{
    FitBy, OversketchError, OversketchMode, OversketchOptions, OversketchRegion, Oversketched, oversketch,
    oversketch_by, oversketch_region,
};
pub use result::{Candidate, Fit, FitError, Observer, Report, Stages, Step, Warning};
pub use stroke::Stroke;
pub use stroke_options::StrokeOptions;

/// The fair curve of a stroke, in the stroke's unit and frame. Lengths among the options are in px of `options.pixel_size` units.
///
/// Deviations are not bounded beforehand; the report states what was measured, and a warning says where it is large.
///
/// # Errors
/// When the stroke is a dot, is too large for its pixels, has coordinates that are not finite, when an option is out of range, or
/// when not even a polyline can be made of the points.
pub fn fit(stroke: &Stroke, options: &FitOptions) -> Result<Fit, FitError> {
    fit_observed(stroke, options, &mut (), None)
}

/// As [`fit`], telling `observer` of each step and leaving every intermediate result in `stages`, if given.
///
/// # Errors
/// As [`fit`].
pub fn fit_observed(
    stroke: &Stroke,
    options: &FitOptions,
    observer: &mut dyn Observer,
    stages: Option<&mut Stages>,
) -> Result<Fit, FitError> {
    shortest_path::fit(stroke, options, observer, stages)
}

/// Figures of a curve beside the points of a stroke, where no fit has told them: deviations in the unit of both, inflections, pieces. `pixel_size` is the
/// size of a pixel in that unit, by which curvature that is only rounding is told.
#[must_use]
pub fn measure(spline: &fairpath_curve::Spline, stroke: &Stroke, pixel_size: f64) -> Report {
    let mut report = Report { points: stroke.points.len(), ..Report::default() };
    conclude::describe(&mut report, spline, stroke, pixel_size);
    report
}

/// The curve of a stroke with piecewise linear curvature (McCrae and Singh 2008), in the stroke's unit and frame: clothoids with G2 joins
/// between corners. Lengths among the options are in px of `options.pixel_size` units.
///
/// Deviations are not bounded beforehand; the report states what was measured, and a warning says where it is large or where
/// `target_error` could not be met. The report's cost is the minimum of equation 7 in radians; what it says of graphs stays zero.
///
/// # Errors
/// As [`fit`].
pub fn fit_curvature_space(stroke: &Stroke, options: &CurvatureSpaceOptions) -> Result<Fit, FitError> {
    fit_curvature_space_observed(stroke, options, &mut (), None)
}

/// As [`fit_curvature_space`], telling `observer` of each step and leaving every intermediate result in `stages`, if given.
///
/// Of the steps, [`Step::Candidates`] is the estimate of curvature (section 4.1), [`Step::Search`] its segmentation (4.2) and
/// [`Step::Merge`] everything that lays the pieces over the stroke or fits them to it; there is no graph. Search and merge come anew with every
/// lower cost that is tried.
///
/// # Errors
/// As [`fit`].
pub fn fit_curvature_space_observed(
    stroke: &Stroke,
    options: &CurvatureSpaceOptions,
    observer: &mut dyn Observer,
    stages: Option<&mut CurvatureStages>,
) -> Result<Fit, FitError> {
    curvature_space::fit(stroke, options, observer, stages)
}

/// The curve of a stroke made of pieces of French curves (McCrae and Singh 2011), in the stroke's unit and frame, and where the pieces come from. G2
/// away from corners. Lengths among the options, and those of the templates, are in px of `options.stroke.pixel_size` units.
///
/// Deviations are not bounded beforehand; the report states what was measured, and a warning says where it is large. What the report says of
/// graphs stays zero.
///
/// # Errors
/// As [`fit`].
pub fn fit_french_curve(
    stroke: &Stroke,
    set: &TemplateSet,
    options: &FrenchCurveOptions,
) -> Result<FrenchCurveFit, FitError> {
    french_curve::fit(stroke, set, options)
}

/// The stroke after Laplacian smoothing: a polyline between corners, for comparison.
///
/// # Errors
/// As [`fit`].
pub fn fit_laplacian(stroke: &Stroke, options: &LaplacianOptions) -> Result<Fit, FitError> {
    baseline::fit_laplacian(stroke, options)
}

/// Least-squares cubic Béziers with common tangents, as most drawing programs fit them, for comparison. The spline follows them by clothoids
/// within `accuracy`; how many cubics they are, `report.pieces` says.
///
/// # Errors
/// As [`fit`].
pub fn fit_cubic(stroke: &Stroke, options: &CubicOptions) -> Result<Fit, FitError> {
    baseline::fit_cubic(stroke, options)
}

/// The curve that minimises the squared distance to the stroke together with the variation of its curvature, for comparison: fair, but of
/// very many pieces.
///
/// # Errors
/// As [`fit`].
pub fn fit_mvc(stroke: &Stroke, options: &MvcOptions) -> Result<Fit, FitError> {
    baseline::fit_mvc(stroke, options)
}
