//! Curvature combs: a curve comes in, the feet and tips of its comb's teeth go out.
//!
//! A comb shows curvature as teeth at right angles to the curve, on the side away from the centre of curvature: the line
//! through their tips jumps where curvature does and bends where its slope does, which is how a draughtsman judges fairness.

use crate::segment::Segment;
use crate::spline::Spline;
use kurbo::{Point, Vec2};

/// One tooth of a comb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tooth {
    /// Index of the segment.
    pub segment: usize,
    /// Arc length from the segment's start.
    pub s: f64,
    /// The foot, on the curve.
    pub base: Point,
    /// The tip: the foot moved by −`scale` × curvature along the left normal.
    pub tip: Point,
    /// Curvature there, radians per unit.
    pub curvature: f64,
}

fn teeth(segment: &Segment, index: usize, spacing: f64, scale: f64, out: &mut Vec<Tooth>) {
    /// More teeth than this on a segment are no picture any more.
    const MAX_TEETH: f64 = 10_000.0;
    let count = libm::ceil(segment.length / spacing).clamp(1.0, MAX_TEETH);
    let count = if count.is_finite() { count as usize } else { 1 };
    for i in 0..=count {
        // The last tooth stands on the end itself, whatever the division rounds to.
        let s = if i == count { segment.length } else { segment.length * (i as f64 / count as f64) };
        let pose = segment.pose_at(s);
        let tangent = segment.tangent_at(s);
        let tip = pose.point - Vec2::new(-tangent.y, tangent.x) * (scale * pose.curvature);
        out.push(Tooth { segment: index, s, base: pose.point, tip, curvature: pose.curvature });
    }
}

impl Segment {
    /// The comb of the segment: teeth at most `spacing` apart, one at each end, `scale` × curvature long (`scale` in units of
    /// length squared). At most 10,001 teeth are given.
    #[must_use]
    pub fn comb(&self, spacing: f64, scale: f64) -> Vec<Tooth> {
        let mut out = Vec::new();
        teeth(self, 0, spacing, scale, &mut out);
        out
    }
}

impl Spline {
    /// The comb of the spline; see [`Segment::comb`]. Every segment has a tooth at each of its ends, so a join has two,
    /// and a jump of curvature shows as two tips on one foot.
    #[must_use]
    pub fn comb(&self, spacing: f64, scale: f64) -> Vec<Tooth> {
        let mut out = Vec::new();
        for (i, segment) in self.segments().iter().enumerate() {
            teeth(segment, i, spacing, scale, &mut out);
        }
        out
    }
}
