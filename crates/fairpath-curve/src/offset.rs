//! Parallel curves: a segment or spline and a signed distance come in, points of the offset curve go out.
//!
//! The parallel of a clothoid is no clothoid, so it is sampled. Its speed is `1 − curvature × distance`; where that changes
//! sign the parallel turns back in a cusp, which a road's edge or a pen's outline must know about.

use crate::segment::Segment;
use crate::spline::Spline;
use crate::trig::unit;
use kurbo::{Point, Vec2};

/// A point of a parallel curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetPoint {
    /// Index of the segment.
    pub segment: usize,
    /// Arc length on the segment to which the point belongs.
    pub s: f64,
    /// The point.
    pub point: Point,
    /// `1 − curvature × distance`, the speed of the parallel against the segment's; its signed curvature is the segment's
    /// divided by this.
    pub speed: f64,
    /// Whether the parallel turns back here: the speed changes sign inside the segment.
    pub is_cusp: bool,
}

/// No more points than this for one segment.
const MAX_POINTS: usize = 1_000_000;

fn sample(segment: &Segment, index: usize, distance: f64, accuracy: f64, out: &mut Vec<OffsetPoint>) {
    if !(segment.is_valid() && distance.is_finite()) {
        return;
    }
    let at = |s: f64, is_cusp: bool| {
        let t = unit(segment.heading_at(s));
        let speed = if is_cusp { 0.0 } else { 1.0 - segment.curvature_at(s) * distance };
        let point = segment.point_at(s) + Vec2::new(-t.y, t.x) * distance;
        OffsetPoint { segment: index, s, point, speed, is_cusp }
    };
    let (v0, v1) = (1.0 - segment.kappa0 * distance, 1.0 - segment.kappa1 * distance);
    let cusp = (v0 * v1 < 0.0).then(|| segment.length * (v0 / (v0 - v1)));
    let accuracy = accuracy.max(1e-12 * (segment.length + distance.abs()));
    let sharpness = segment.sharpness();
    let mut s = 0.0;
    out.push(at(0.0, false));
    for _ in 0..MAX_POINTS {
        let to = cusp.filter(|&c| c > s).unwrap_or(segment.length);
        // A chord over ds deviates by at most ds²/8 times the second derivative of the parallel by s, whose length is
        // at most |kappa v| + |kappa' distance|. Its bound over the step needs the step: two rounds from above.
        let mut step = to - s;
        for _ in 0..3 {
            let kappa = segment.curvature_at(s).abs().max(segment.curvature_at(s + step).abs());
            let speed = (1.0 - segment.curvature_at(s) * distance)
                .abs()
                .max((1.0 - segment.curvature_at(s + step) * distance).abs());
            let bend = kappa * speed + (sharpness * distance).abs();
            step = step.min((8.0 * accuracy / bend).sqrt()).min(1.0 / kappa);
        }
        // Equal steps to the next cusp or the end, rather than a sliver at last.
        let rest = to - s;
        let count = libm::ceil(rest / step * (1.0 - 1e-9));
        if count >= 2.0 {
            s += rest / count;
            out.push(at(s, false));
            continue;
        }
        let is_cusp = cusp == Some(to);
        s = to;
        out.push(at(s, is_cusp));
        if !is_cusp {
            return;
        }
    }
}

impl Segment {
    /// Points of the parallel curve at the signed `distance` (positive to the left, towards positive normals), so dense that
    /// their polyline stays within `accuracy` of it; both ends included, cusps included and marked.
    ///
    /// Accuracies below 1e-12 × (length + |distance|) are taken as that; at most a million points. An invalid segment or a
    /// distance that is not finite gives nothing.
    #[must_use]
    pub fn offset(&self, distance: f64, accuracy: f64) -> Vec<OffsetPoint> {
        let mut out = Vec::new();
        sample(self, 0, distance, accuracy, &mut out);
        out
    }
}

impl Spline {
    /// The parallels of all segments one after the other; see [`Segment::offset`].
    ///
    /// At smooth joins the point is given for both segments. At corners the parallel has a gap or an overlap, which is left
    /// to the caller, who knows whether it wants a mitre, a round or a cut.
    #[must_use]
    pub fn offset(&self, distance: f64, accuracy: f64) -> Vec<OffsetPoint> {
        let mut out = Vec::new();
        for (i, segment) in self.segments().iter().enumerate() {
            sample(segment, i, distance, accuracy, &mut out);
        }
        out
    }
}
