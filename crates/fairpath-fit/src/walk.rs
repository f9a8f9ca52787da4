//! Walking along a primitive from data point to data point: the foot of each point, its signed distance, and how that
//! distance depends on the primitive's parameters.
//!
//! This is the innermost loop of fitting. It steps along the curve with a low-order rule whose error, about 1e-5 of a step,
//! is far below any tremor; every position that leaves the fitter is evaluated anew by the kernel.

use fairpath_curve::{Segment, Vec2, trig};

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

/// A place on a primitive with the running integrals that the derivatives of its position need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walker {
    pub(crate) s: f64,
    pub(crate) position: Vec2,
    /// Unit tangent.
    pub(crate) tangent: Vec2,
    pub(crate) kappa: f64,
    sharpness: f64,
    origin: Vec2,
    /// `∫ u e^{iθ} du` and `½ ∫ u² e^{iθ} du` from the start.
    first: Vec2,
    second: Vec2,
}

/// Most that one step towards a foot may turn, radians.
const LARGEST_TURN: f64 = 1.2;

/// A foot is found when the point lies across the curve to within this, px.
const NEAR_ENOUGH: f64 = 0.3;

/// Sine and cosine of the small angles between data points: error below 1e-10 up to half a radian.
#[inline]
fn sin_cos_step(a: f64) -> (f64, f64) {
    if a.abs() > 0.5 {
        return trig::sin_cos(a);
    }
    let x = a * a;
    (
        a * (1.0 - x * (1.0 / 6.0 - x * (1.0 / 120.0 - x * (1.0 / 5040.0 - x * (1.0 / 362_880.0))))),
        1.0 - x * (0.5 - x * (1.0 / 24.0 - x * (1.0 / 720.0 - x * (1.0 / 40_320.0)))),
    )
}

#[inline]
fn rotate(v: Vec2, (sin, cos): (f64, f64)) -> Vec2 {
    Vec2::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
}

impl Walker {
    pub(crate) fn new(primitive: &Primitive) -> Self {
        Self {
            s: 0.0,
            position: primitive.start,
            tangent: trig::unit(primitive.heading),
            kappa: primitive.kappa,
            sharpness: primitive.sharpness,
            origin: primitive.start,
            first: Vec2::ZERO,
            second: Vec2::ZERO,
        }
    }

    /// Moves by `ds` along the curve, forward or back.
    #[inline]
    pub(crate) fn advance(&mut self, ds: f64) {
        let bend = self.sharpness * ds;
        let to_mid = ds * (0.5 * self.kappa + 0.125 * bend);
        let turn = sin_cos_step(to_mid);
        let mid = rotate(self.tangent, turn);
        let half = 0.5 * ds * (self.kappa + 0.5 * bend);
        let x = half * half;
        // The chord seen from the middle's tangent: sinc of half the turning, and the skew that sharpness adds.
        let along = if x < 0.3 {
            ds * (1.0 - x * (1.0 / 6.0 - x * (1.0 / 120.0 - x * (1.0 / 5040.0))))
        } else {
            ds * trig::sin_cos(half).0 / half
        };
        let across = bend * ds * ds * (1.0 / 24.0);
        let step = Vec2::new(mid.x * along - mid.y * across, mid.y * along + mid.x * across);
        let middle = self.s + 0.5 * ds;
        let cube = ds * ds * ds * (1.0 / 12.0);
        self.first += step * middle + Vec2::new(-mid.y, mid.x) * (cube * (self.kappa + 0.5 * bend));
        self.second += step * (0.5 * middle * middle) + mid * (0.5 * cube);
        self.position += step;
        // The second half turns by a little more than the first.
        let more = 0.25 * bend * ds;
        let end = rotate(mid, turn);
        self.tangent = if more == 0.0 {
            end
        } else if more.abs() < 0.02 {
            rotate(end, (more * (1.0 - more * more * (1.0 / 6.0)), 1.0 - 0.5 * more * more))
        } else {
            rotate(end, trig::sin_cos(more))
        };
        self.s += ds;
        self.kappa += bend;
    }

    /// Signed distance of a point in the direction of the normal (left of the tangent), at the place where the walker is.
    #[inline]
    pub(crate) fn offset(&self, point: Vec2) -> f64 {
        self.tangent.cross(point - self.position)
    }

    /// Moves to the foot of a point near the present place and gives its signed distance.
    #[inline]
    pub(crate) fn project(&mut self, point: Vec2) -> f64 {
        for round in 0..4 {
            let v = point - self.position;
            let along = self.tangent.dot(v);
            // What is left moves the distance by its square times half the curvature: nothing that a fit could see.
            if round > 0 && along.abs() < NEAR_ENOUGH {
                break;
            }
            // The foot on the osculating circle, by the series of the arc tangent; near the circle's centre, where every
            // point is as near, the step is held back.
            let narrowing = (1.0 - self.kappa * self.tangent.cross(v)).max(0.3);
            let straight = along / narrowing;
            let t = self.kappa * straight;
            let t2 = t * t;
            let mut ds = if t2 < 0.4 {
                straight * (1.0 - t2 * (1.0 / 3.0 - t2 * (0.2 - t2 * 0.12)))
            } else {
                straight / (1.0 + 0.28 * t2)
            };
            // No step turns by more than this; a NaN passes, and the caller sees it in the energy.
            let turn = (self.kappa.abs() + (self.sharpness * ds).abs()) * ds.abs();
            if turn > LARGEST_TURN {
                ds *= LARGEST_TURN / turn;
            }
            self.advance(ds);
        }
        self.offset(point)
    }

    /// Derivatives of the position's normal component by start offset (along the start's normal), heading, curvature at the
    /// start and sharpness.
    #[inline]
    pub(crate) fn row(&self, start_tangent: Vec2) -> [f64; 4] {
        [
            self.tangent.dot(start_tangent),
            self.tangent.dot(self.position - self.origin),
            self.tangent.dot(self.first),
            self.tangent.dot(self.second),
        ]
    }

    /// Derivatives of the position by heading, curvature at the start and sharpness.
    #[inline]
    pub(crate) fn jacobian(&self) -> [Vec2; 3] {
        [self.position - self.origin, self.first, self.second].map(|v| Vec2::new(-v.y, v.x))
    }
}
