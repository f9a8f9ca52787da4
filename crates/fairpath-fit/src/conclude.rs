//! What every method ends with: the curve in the stroke's unit and frame, measured against the stroke.

use crate::clean::Cleaned;
use crate::options::Closing;
use crate::parallel;
use crate::result::{Report, Warning};
use crate::stroke::Stroke;
use crate::track::{Shape, Track};
use fairpath_curve::{Continuity, Point, Segment, Spline, trig};

/// Segments in pixels, their joins, and whether the last runs back into the first.
pub(crate) type Parts = (Vec<Segment>, Vec<Continuity>, bool);

/// A curve in pixels in the stroke's unit and frame; nothing if its joins do not hold.
pub(crate) fn restored_spline((segments, joins, closed): Parts, cleaned: &Cleaned) -> Option<Spline> {
    Spline::new(segments.iter().map(|s| restored(s, cleaned)).collect(), joins, closed).ok()
}

/// A segment in pixels in the stroke's unit and frame.
pub(crate) fn restored(s: &Segment, cleaned: &Cleaned) -> Segment {
    Segment {
        start: cleaned.restore(s.start.to_vec2()),
        heading: s.heading,
        length: s.length * cleaned.scale,
        kappa0: s.kappa0 / cleaned.scale,
        kappa1: s.kappa1 / cleaned.scale,
    }
}

/// What is to be said about how the stroke was closed.
pub(crate) fn closing_warnings(track: &Track, closed: Closing) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let mut warn = |code: &str, text: String| warnings.push(Warning { code: code.into(), text });
    if track.trimmed > 0 {
        warn("closed-by-trimming", format!("the stroke's ends overshoot: {} points were cut off", track.trimmed));
    }
    if closed == Closing::Yes && track.shape == Shape::Open {
        let text = "the stroke was to be closed, but nothing would remain of it; it is fitted as an open one";
        warn("not-closed", text.into());
    }
    warnings
}

/// Measures the curve against the stroke's own points. Its pieces are its segments, unless the method has counted others.
pub(crate) fn describe(report: &mut Report, spline: &Spline, stroke: &Stroke, pixel_size: f64) {
    let (mut largest, mut squares) = (0.0_f64, 0.0);
    for d in distances(spline, &stroke.points) {
        largest = largest.max(d);
        squares += d * d;
    }
    if report.pieces == 0 {
        report.pieces = spline.segments().len();
    }
    report.max_deviation = largest;
    report.rms_deviation = (squares / stroke.points.len().max(1) as f64).sqrt();
    let flat = FLAT / pixel_size;
    let ends = spline.segments().iter().flat_map(|s| [s.kappa0, s.kappa1]).filter(|k| k.abs() > flat);
    let mut sign = 0.0;
    for kappa in ends {
        if sign * kappa < 0.0 {
            report.inflections += 1;
        }
        sign = kappa.signum();
    }
}

/// How far points are from a curve.
pub(crate) fn distances(spline: &Spline, points: &[Point]) -> Vec<f64> {
    parallel::map(points, |point| spline.nearest(*point).distance)
}

/// Curvature that has no sign, radians per px.
const FLAT: f64 = 1e-9;

/// The points joined by lines: what is left where nothing fits.
pub(crate) fn polyline(track: &Track) -> Parts {
    let closed = track.shape != Shape::Open;
    let points = track.all.run(0, track.turn);
    let segments: Vec<Segment> = points
        .windows(2)
        .map(|p| (p[0].point, p[1].point - p[0].point))
        .filter(|(_, edge)| edge.hypot2() > 0.0)
        .map(|(start, edge)| Segment::line(start.to_point(), trig::angle_of(edge), edge.hypot2().sqrt()))
        .collect();
    let joins = vec![Continuity::G0; segments.len().saturating_sub(usize::from(!closed))];
    (segments, joins, closed)
}
