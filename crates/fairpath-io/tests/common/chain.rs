//! Segments end to end, for tests.

use fairpath_curve::{Point, Segment};

/// Segments of `(length, kappa0, kappa1)`, each beginning where the one before ends.
pub(crate) fn chain(start: (f64, f64), heading: f64, pieces: &[(f64, f64, f64)]) -> Vec<Segment> {
    let mut segments: Vec<Segment> = Vec::new();
    for &(length, kappa0, kappa1) in pieces {
        let (start, heading) = segments.last().map_or((Point::from(start), heading), |s| (s.end(), s.end_heading()));
        segments.push(Segment::clothoid(start, heading, length, kappa0, kappa1));
    }
    segments
}
