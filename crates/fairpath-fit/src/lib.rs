//! Fair curves from rough strokes.

mod clean;
mod closure;
mod corners;
mod direction;
mod linear;
mod options;
mod polyline;
mod primitive_fit;
mod resample;
mod result;
mod shortest_path;
mod stroke;
mod track;
mod walk;

pub use options::{Closing, Deviation, FitOptions, Preset, Resampling, Search, Transitions};
pub use result::{Candidate, Fit, FitError, Observer, Report, Stages, Step, Warning};
pub use stroke::Stroke;

/// The fair curve of a stroke.
///
/// # Errors
/// When the stroke is a dot, has coordinates that are not finite, or an option is out of range.
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
