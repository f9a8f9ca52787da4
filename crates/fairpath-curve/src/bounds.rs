//! Tight bounding boxes: a segment or spline comes in, the smallest axis-parallel box around it goes out.

use crate::segment::Segment;
use crate::spline::Spline;
use kurbo::{Point, Rect};
use std::f64::consts::FRAC_PI_2;

/// Arc length over which a heading turns by `delta`, when the curvature begins with `kappa`, changes at `rate`, and neither
/// changes sign nor loses magnitude on the way. `None` if it never does.
fn arc_length_of_turn(kappa: f64, rate: f64, delta: f64) -> Option<f64> {
    let discriminant = kappa * kappa + 2.0 * rate * delta;
    let root = if delta < 0.0 { -discriminant.max(0.0).sqrt() } else { discriminant.max(0.0).sqrt() };
    let s = 2.0 * delta / (kappa + root);
    s.is_finite().then_some(s)
}

/// Grows the box by the extreme points of a stretch from arc length `from` to `to` (which may lie before `from`) on which
/// the curvature keeps its sign and grows in magnitude from `from` to `to`.
///
/// With growing curvature the later of two points with the same heading lies inside the osculating circle of the
/// earlier (Kneser), so the first whole turn holds all the extremes: at most five points, however long the spiral.
fn extend(bounds: &mut Rect, segment: &Segment, from: f64, to: f64) {
    let sharpness = segment.sharpness();
    let direction = if to < from { -1.0 } else { 1.0 };
    let heading = segment.heading_at(from);
    // Travelling backwards negates the curvature but not the rate at which it changes with the distance travelled.
    let (kappa, rate) = (segment.curvature_at(from) * direction, sharpness);
    let turn = (segment.heading_at(to) - heading).clamp(-5.0 * FRAC_PI_2, 5.0 * FRAC_PI_2);
    let (low, high) = (heading.min(heading + turn), heading.max(heading + turn));
    let mut quarter = libm::ceil(low / FRAC_PI_2);
    for _ in 0..6 {
        let target = quarter * FRAC_PI_2;
        if target > high || target.is_nan() {
            break;
        }
        if let Some(s) = arc_length_of_turn(kappa, rate, target - heading) {
            let at = (from + direction * s).clamp(0.0, segment.length);
            *bounds = bounds.union_pt(segment.point_at(at));
        }
        quarter += 1.0;
    }
}

impl Segment {
    /// The smallest axis-parallel box around the segment, to the accuracy of [`Segment::point_at`].
    ///
    /// The extremes lie at the ends and where the heading is a multiple of π/2; at most a dozen points are evaluated.
    #[must_use]
    pub fn bounding_box(&self) -> Rect {
        let mut bounds = Rect::from_points(self.start, self.end());
        if !self.is_valid() {
            return bounds;
        }
        if self.has_inflection() {
            let s = self.kappa0 / (self.kappa0 - self.kappa1) * self.length;
            extend(&mut bounds, self, s, 0.0);
            extend(&mut bounds, self, s, self.length);
        } else if self.kappa0.abs() <= self.kappa1.abs() {
            extend(&mut bounds, self, 0.0, self.length);
        } else {
            extend(&mut bounds, self, self.length, 0.0);
        }
        bounds
    }
}

impl Spline {
    /// The smallest axis-parallel box around the spline; see [`Segment::bounding_box`].
    #[must_use]
    pub fn bounding_box(&self) -> Rect {
        let first: Point = self.segments()[0].start;
        self.segments().iter().fold(Rect::from_points(first, first), |bounds, s| bounds.union(s.bounding_box()))
    }
}
