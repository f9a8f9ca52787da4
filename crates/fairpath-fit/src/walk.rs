//! Walking along a primitive from data point to data point: the foot of each point, its signed distance, and how that
//! distance depends on the primitive's parameters.
//!
//! This is the innermost loop of fitting. It steps along the curve with a low-order rule whose error, about 1e-5 of a step,
//! is far below any tremor; every position that leaves the fitter is evaluated anew by the kernel.

use fairpath_curve::{Segment, Vec2};

/// A line, arc or clothoid without an end: position and heading at `s = 0`, curvature `kappa + sharpness s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Primitive {
    pub(crate) start: Vec2,
    pub(crate) heading: f64,
    pub(crate) kappa: f64,
    pub(crate) sharpness: f64,
}

/// A point to be fitted: where it is, how far along the stroke, and how much it counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Datum {
    pub(crate) point: Vec2,
    /// Arc length along the stroke, px.
    pub(crate) s: f64,
    /// Length of stroke that it stands for, px.
    pub(crate) weight: f64,
}

impl Primitive {
    pub(crate) fn segment(&self, length: f64) -> Segment {
        Segment {
            start: self.start.to_point(),
            heading: self.heading,
            length,
            kappa0: self.kappa,
            kappa1: if self.sharpness == 0.0 { self.kappa } else { self.kappa + self.sharpness * length },
        }
    }
}

/// Where a point's foot is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Arc length along the primitive, px.
    pub(crate) s: f64,
    /// Signed distance of the point, left of the primitive positive, px.
    pub(crate) distance: f64,
}

/// A place on a primitive with the running integrals that the derivatives of its position need.
///
/// The tangent at a place comes from the heading there, and the integrals of a step from the tangents at its ends by the trapezoidal
/// rule with its first Euler–Maclaurin correction: so one place waits for nothing of the place before but sums, and the processor
/// works on several at once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walker {
    pub(crate) s: f64,
    pub(crate) position: Vec2,
    /// Unit tangent.
    pub(crate) tangent: Vec2,
    pub(crate) kappa: f64,
    primitive: Primitive,
    /// `∫ u e^{iθ} du` and `½ ∫ u² e^{iθ} du` from the start.
    first: Vec2,
    second: Vec2,
}

/// Most that one step may turn, radians: the rule's error is the fourth power of it over 720, as a share of the step.
const LARGEST_TURN: f64 = 1.0;

/// Most steps of a move, whatever it turns.
const MOST_STEPS: f64 = 64.0;

/// A foot is found when the point lies across the curve to within this, px: the distance there is corrected for the rest.
const NEAR_ENOUGH: f64 = 1.0;

/// In tight bends it must be nearer, to within a turn of one over the root of this.
const TIGHTNESS: f64 = 25.0;

/// The unit vector with a heading: error below 1e-14, so that a stroke that is turned is walked alike.
#[inline]
fn unit(heading: f64) -> Vec2 {
    use std::f64::consts::TAU;
    // Adding and subtracting 1.5 × 2⁵² rounds to the nearest whole number.
    let turns = (heading * (1.0 / TAU) + 6_755_399_441_055_744.0) - 6_755_399_441_055_744.0;
    // A quarter of the angle, at most π/4, by Taylor polynomials; then it is doubled twice.
    let a = 0.25 * (heading - turns * TAU);
    let x = a * a;
    let xx = x * x;
    let high =
        (1.0 / 362_880.0 - x * (1.0 / 39_916_800.0)) + xx * (1.0 / 6_227_020_800.0 - x * (1.0 / 1_307_674_368_000.0));
    let sin = a * ((1.0 - x * (1.0 / 6.0)) + xx * ((1.0 / 120.0 - x * (1.0 / 5040.0)) + xx * high));
    let high = (1.0 / 3_628_800.0 - x * (1.0 / 479_001_600.0))
        + xx * (1.0 / 87_178_291_200.0 - x * (1.0 / 20_922_789_888_000.0));
    let cos = 1.0 - x * ((0.5 - x * (1.0 / 24.0)) + xx * ((1.0 / 720.0 - x * (1.0 / 40_320.0)) + xx * high));
    let (sin, cos) = (2.0 * sin * cos, 1.0 - 2.0 * sin * sin);
    Vec2::new(1.0 - 2.0 * sin * sin, 2.0 * sin * cos)
}

#[inline]
fn left_of(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

impl Walker {
    pub(crate) fn new(primitive: &Primitive) -> Self {
        Self {
            s: 0.0,
            position: primitive.start,
            tangent: unit(primitive.heading),
            kappa: primitive.kappa,
            primitive: *primitive,
            first: Vec2::ZERO,
            second: Vec2::ZERO,
        }
    }

    /// Moves to the place at arc length `s`, forward or back.
    #[inline]
    pub(crate) fn go_to(&mut self, s: f64) {
        let kappa = self.primitive.kappa + self.primitive.sharpness * s;
        let turn = 0.5 * (self.kappa.abs() + kappa.abs()) * (s - self.s).abs();
        if turn == 0.0 {
            self.go_straight(s);
        } else if turn > LARGEST_TURN {
            self.go_far(s, turn);
        } else {
            self.step_to(s);
        }
    }

    /// Moves along a line.
    #[inline]
    fn go_straight(&mut self, s: f64) {
        let (from, to) = (self.s, s);
        self.position += self.tangent * (to - from);
        self.first += self.tangent * (0.5 * (to * to - from * from));
        self.second += self.tangent * ((1.0 / 6.0) * (to * to * to - from * from * from));
        self.s = s;
    }

    /// Moves in several steps.
    #[cold]
    fn go_far(&mut self, s: f64, turn: f64) {
        let count = (turn / LARGEST_TURN).ceil().min(MOST_STEPS);
        let (from, step) = (self.s, (s - self.s) / count);
        for i in 1..count as usize {
            self.step_to(from + step * i as f64);
        }
        self.step_to(s);
    }

    #[inline(always)]
    fn step_to(&mut self, s: f64) {
        let Primitive { heading, kappa, sharpness, .. } = self.primitive;
        let tangent = unit(heading + s * (kappa + 0.5 * sharpness * s));
        let kappa = kappa + sharpness * s;
        let ds = s - self.s;
        let (half, twelfth) = (0.5 * ds, ds * ds * (1.0 / 12.0));
        // The derivatives of e^{iθ}, u e^{iθ} and ½ u² e^{iθ} at both ends.
        let (bend0, bend1) = (left_of(self.tangent) * self.kappa, left_of(tangent) * kappa);
        self.position += (self.tangent + tangent) * half + (bend0 - bend1) * twelfth;
        let (f0, f1) = (self.tangent * self.s, tangent * s);
        let (g0, g1) = (bend0 * self.s, bend1 * s);
        self.first += (f0 + f1) * half + (self.tangent - tangent + g0 - g1) * twelfth;
        self.second += (f0 * self.s + f1 * s) * (0.5 * half) + (f0 - f1 + (g0 * self.s - g1 * s) * 0.5) * twelfth;
        (self.s, self.tangent, self.kappa) = (s, tangent, kappa);
    }

    /// Signed distance of a point in the direction of the normal (left of the tangent), at the place where the walker is.
    #[inline]
    pub(crate) fn offset(&self, point: Vec2) -> f64 {
        self.tangent.cross(point - self.position)
    }

    /// Moves to near the foot of a point near the present place.
    #[inline]
    pub(crate) fn project(&mut self, point: Vec2) -> Foot {
        let ds = self.far_step(point);
        self.project_from(self.s + ds, point)
    }

    /// As [`Walker::project`], given about where the foot is.
    #[inline]
    pub(crate) fn project_from(&mut self, s: f64, point: Vec2) -> Foot {
        self.go_to(s);
        for _ in 0..3 {
            if let Some(foot) = self.foot(point) {
                return foot;
            }
            let ds = self.far_step(point);
            self.go_to(self.s + ds);
        }
        // Without a foot, how far the point is from here is no less than its distance.
        let v = point - self.position;
        Foot { s: self.s, distance: v.hypot2().sqrt().copysign(self.tangent.cross(v)) }
    }

    /// Moves to `s` if the foot of a point is near that place.
    #[inline]
    pub(crate) fn foot_near(&mut self, s: f64, point: Vec2) -> Option<Foot> {
        let here = *self;
        self.go_to(s);
        let foot = self.foot(point);
        if foot.is_none() {
            *self = here;
        }
        foot
    }

    /// The foot of a point, if it is near: to second order.
    #[inline]
    pub(crate) fn foot(&self, point: Vec2) -> Option<Foot> {
        let (along, across) = self.seen(point);
        let ds = self.straight_step(along, across);
        // A NaN passes, and the caller sees it in the energy.
        let near = !(ds * ds * (1.0 + TIGHTNESS * self.kappa * self.kappa) > NEAR_ENOUGH * NEAR_ENOUGH);
        // On the way there the distance changes by half of this.
        near.then_some(Foot { s: self.s + ds, distance: across - 0.5 * self.kappa * ds * along })
    }

    /// A point along and across the tangent.
    #[inline]
    fn seen(&self, point: Vec2) -> (f64, f64) {
        let v = point - self.position;
        (self.tangent.dot(v), self.tangent.cross(v))
    }

    /// Newton's step towards a foot; near the centre of curvature, where every point is as near, it is held back.
    #[inline]
    fn straight_step(&self, along: f64, across: f64) -> f64 {
        along / (1.0 - self.kappa * across).max(0.3)
    }

    /// A step towards a foot that is not near: on the osculating circle, by the series of the arc tangent.
    #[inline]
    fn far_step(&self, point: Vec2) -> f64 {
        let (along, across) = self.seen(point);
        let straight = self.straight_step(along, across);
        let t = self.kappa * straight;
        let t2 = t * t;
        let ds = if t2 < 0.4 {
            straight * (1.0 - t2 * (1.0 / 3.0 - t2 * (0.2 - t2 * 0.12)))
        } else {
            straight / (1.0 + 0.28 * t2)
        };
        // Sharpness may let it turn more than that.
        let turn = (self.kappa.abs() + (self.primitive.sharpness * ds).abs()) * ds.abs();
        if turn > LARGEST_TURN { ds * (LARGEST_TURN / turn) } else { ds }
    }

    /// The primitive from here on, and a walker at its start.
    pub(crate) fn begun_here(&self) -> (Primitive, Self) {
        let Primitive { heading, kappa, sharpness, .. } = self.primitive;
        let primitive = Primitive {
            start: self.position,
            heading: heading + self.s * (kappa + 0.5 * sharpness * self.s),
            kappa: self.kappa,
            sharpness,
        };
        (primitive, Self { s: 0.0, primitive, first: Vec2::ZERO, second: Vec2::ZERO, ..*self })
    }

    /// Derivatives of the position's normal component by start offset (along the start's normal), heading, curvature at the
    /// start and sharpness.
    #[inline]
    pub(crate) fn row(&self, start_tangent: Vec2) -> [f64; 4] {
        [
            self.tangent.dot(start_tangent),
            self.tangent.dot(self.position - self.primitive.start),
            self.tangent.dot(self.first),
            self.tangent.dot(self.second),
        ]
    }

    /// As [`Walker::row`], with the start's x and y in place of its offset.
    #[inline]
    pub(crate) fn natural_row(&self) -> [f64; 5] {
        [
            -self.tangent.y,
            self.tangent.x,
            self.tangent.dot(self.position - self.primitive.start),
            self.tangent.dot(self.first),
            self.tangent.dot(self.second),
        ]
    }

    /// Derivatives of the position by heading, curvature at the start and sharpness.
    #[inline]
    pub(crate) fn jacobian(&self) -> [Vec2; 3] {
        [self.position - self.primitive.start, self.first, self.second].map(left_of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::moments;

    const SHAPES: [(f64, f64); 5] = [(0.0, 0.0), (0.02, 0.0), (-0.05, 0.001), (0.3, -0.004), (0.0, 0.002)];

    fn primitive((kappa, sharpness): (f64, f64)) -> Primitive {
        Primitive { start: Vec2::new(3.0, -2.0), heading: 2.5, kappa, sharpness }
    }

    #[test]
    fn places_and_integrals_agree_with_the_kernel() {
        for p in SHAPES.map(primitive) {
            let mut walker = Walker::new(&p);
            for i in 1..80 {
                walker.go_to(f64::from(i));
                let s = walker.s;
                let [position, first, second] = moments(p.heading, p.kappa, p.sharpness, s);
                assert!((walker.position - p.start - position).hypot() < 2e-4 * s, "{p:?} at {s}");
                // Of derivatives less is asked.
                let tolerance = 2e-3 * s;
                assert!((walker.first - first).hypot() < tolerance * s, "{p:?} at {s}");
                assert!((walker.second - second * 0.5).hypot() < tolerance * s * s, "{p:?} at {s}");
            }
        }
    }

    #[test]
    fn a_foot_is_found_from_nearby() {
        for p in SHAPES.map(primitive) {
            for (s, d) in [(5.0, -2.0), (11.0, 0.1), (20.0, 2.5)] {
                for off in [-4.0, -0.9, 0.0, 0.3, 3.0] {
                    let mut walker = Walker::new(&p);
                    walker.go_to(s);
                    let point = walker.position + left_of(walker.tangent) * d;
                    let mut walker = Walker::new(&p);
                    let foot = walker.project_from(s + off, point);
                    assert!((foot.s - s).abs() < 0.25, "{p:?} {s} {d} {off} {foot:?}");
                    assert!((foot.distance - d).abs() < 0.06, "{p:?} {s} {d} {off} {foot:?}");
                }
            }
        }
    }
}
