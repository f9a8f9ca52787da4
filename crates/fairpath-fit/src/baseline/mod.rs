//! Ways to smooth strokes that are older than the methods of this crate, to compare them with: stroke in, spline out.
//!
//! All take the stroke as the other methods do, closed and divided at corners alike, so that what differs is the smoothing alone.

mod cubic;
mod laplacian;
mod mvc;
mod options;

pub use options::{CubicOptions, LaplacianOptions, MvcOptions};

use crate::clean::clean;
use crate::conclude::{Parts, closing_warnings, describe, polyline, restored_spline};
use crate::direction::{is_backward, turned_round};
use crate::polyline::Polyline;
use crate::result::{Fit, FitError, Report, Warning};
use crate::stroke::Stroke;
use crate::stroke_options::StrokeOptions;
use crate::track::{Shape, Track, prepare};
use crate::walk::Datum;
use fairpath_curve::{Point, Vec2};

/// Laplacian smoothing.
pub(crate) fn fit_laplacian(stroke: &Stroke, options: &LaplacianOptions) -> Result<Fit, FitError> {
    options.validate()?;
    neatened(stroke, &options.stroke, f64::INFINITY, |track| laplacian::smoothed(track, options))
}

/// Least-squares cubics.
pub(crate) fn fit_cubic(stroke: &Stroke, options: &CubicOptions) -> Result<Fit, FitError> {
    options.validate()?;
    neatened(stroke, &options.stroke, options.max_error, |track| cubic::cubics(track, options))
}

/// Minimum variation of curvature.
pub(crate) fn fit_mvc(stroke: &Stroke, options: &MvcOptions) -> Result<Fit, FitError> {
    options.validate()?;
    neatened(stroke, &options.stroke, options.max_error, |track| mvc::fairest(track, options))
}

/// What `method` makes of a stroke and how many pieces it counts; the points themselves where it makes nothing.
fn neatened(
    stroke: &Stroke,
    options: &StrokeOptions,
    max_error: f64,
    method: impl Fn(&Track) -> Option<(Parts, usize)>,
) -> Result<Fit, FitError> {
    let mut cleaned = clean(&stroke.points, options.pixel_size)?;
    let backward = is_backward(&stroke.points);
    if backward {
        let reversed: Vec<Point> = stroke.points.iter().rev().copied().collect();
        cleaned = clean(&reversed, options.pixel_size)?;
    }
    let track = prepare(&cleaned, &options.of_shortest_path());
    let mut warnings = closing_warnings(&track, options.closed);
    let mut report = Report { points: stroke.points.len(), samples: one_turn(&track).len(), ..Report::default() };
    let made = method(&track).and_then(|(parts, pieces)| Some((restored_spline(parts, &cleaned)?, pieces)));
    let (spline, pieces) = match made {
        Some(made) => made,
        None => {
            let text = "no smooth curve was found; the stroke is given as a polyline";
            warnings.push(Warning { code: "fell-back-to-polyline".into(), text: text.into() });
            let spline = restored_spline(polyline(&track), &cleaned)
                .ok_or(FitError::Unfittable { points: stroke.points.len() })?;
            let pieces = spline.segments().len();
            (spline, pieces)
        }
    };
    report.pieces = pieces;
    describe(&mut report, &spline, stroke, options.pixel_size);
    let off = report.max_deviation;
    if off > max_error * options.pixel_size {
        let text = format!("the curve is up to {off:.3} away from the stroke");
        warnings.push(Warning { code: "far-from-stroke".into(), text });
    }
    let fit = Fit { spline, report, warnings };
    Ok(if backward { turned_round(fit) } else { fit })
}

/// The points of the stroke, or of one turn of a ring, whose last is then the first once more.
fn one_turn(track: &Track) -> &[Datum] {
    track.all.run(0, track.turn)
}

/// What lies between two corners or ends, both included; of a ring, one turn.
fn stretches(track: &Track) -> Vec<&[Datum]> {
    let mut out = Vec::new();
    let mut from = 0;
    for i in 1..=track.turn {
        if i == track.turn || (track.shape != Shape::Ring && track.corner[i]) {
            out.push(track.all.run(from, i));
            from = i;
        }
    }
    out
}

/// Points at equal steps of about `spacing` px along the polyline of a stretch, its ends included, at least `fewest` steps.
fn evenly(data: &[Datum], spacing: f64, fewest: f64) -> Vec<Vec2> {
    let line = Polyline::new(data.iter().map(|d| d.point).collect());
    let steps = (line.length() / spacing).round().clamp(fewest, MOST_STEPS);
    let mut hint = 0;
    (0..=steps as usize).map(|i| line.at(line.length() * i as f64 / steps, &mut hint)).collect()
}

/// Most steps of a stretch: beyond, they become longer.
const MOST_STEPS: f64 = 20_000.0;
