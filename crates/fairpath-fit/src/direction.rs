//! The direction in which a stroke is fitted, which does not depend on the one in which it was drawn: reversing a stroke then
//! reverses its spline, to the last bit.

use crate::result::{Candidate, Fit, Stages};
use fairpath_curve::{Point, Vec2};

/// Strokes nearer than this to being symmetric are fitted as drawn: either way they give the same curve.
const SYMMETRIC: f64 = 1e-9;

/// Whether a stroke is to be fitted from its end: the half that lies further from the middle of the stroke goes last.
pub(crate) fn is_backward(points: &[Point]) -> bool {
    let edges = || points.windows(2).map(|p| (p[0].midpoint(p[1]), (p[1] - p[0]).hypot2().sqrt()));
    let length: f64 = edges().map(|e| e.1).sum();
    if length <= 0.0 {
        return false;
    }
    let centre = edges().fold(Vec2::ZERO, |c, (p, l)| c + (p - points[0]) * (l / length));
    let (mut s, mut moment, mut size) = (0.0, 0.0, 0.0);
    for (p, l) in edges() {
        let arm = (s + 0.5 * l - 0.5 * length) * l * (p - points[0] - centre).hypot2();
        moment += arm;
        size += arm.abs();
        s += l;
    }
    moment < -SYMMETRIC * size
}

/// The fit of the reversed stroke as one of the stroke.
pub(crate) fn turned_round(fit: Fit) -> Fit {
    Fit { spline: fit.spline.reversed(), ..fit }
}

/// The stages of the reversed stroke as those of the stroke.
pub(crate) fn turn_stages_round(stages: &mut Stages) {
    let n = stages.samples.len();
    stages.points.reverse();
    stages.samples.reverse();
    // The first sample of a closed stroke stays the first.
    let mirrored = if stages.closed {
        stages.samples.rotate_right(1);
        n
    } else {
        n.saturating_sub(1)
    };
    for corner in &mut stages.corners {
        *corner = if stages.closed { (n - *corner) % n } else { mirrored - *corner };
    }
    stages.corners.sort_unstable();
    for c in &mut stages.candidates {
        let first = if stages.closed { (2 * n - c.last) % n } else { mirrored - c.last };
        *c = Candidate { segment: c.segment.reversed(), first, last: first + c.last - c.first, error: c.error };
    }
    stages.path.reverse();
}
