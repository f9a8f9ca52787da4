//! One piece of curve with linear curvature: a line, an arc or a clothoid.

use crate::moments::{displacement, moments, moments_to_4};
use crate::trig::unit;
use kurbo::{Point, Vec2};

/// A piece of curve whose curvature is linear in arc length.
///
/// A line has zero curvature throughout, an arc constant curvature, a clothoid (Euler spiral) the rest; all three are one
/// type and every operation is smooth across the border between them. With arc length `s` from the start,
///
/// - curvature `kappa(s) = kappa0 + (kappa1 − kappa0) s / length`,
/// - heading `theta(s) = heading + kappa0 s + (kappa1 − kappa0) s² / (2 length)`,
/// - position `start + ∫₀ˢ (cos theta, sin theta)`.
///
/// Lengths are in the unit of the stroke (px, m, …), headings in radians from the x axis towards the y axis, curvatures in
/// radians per unit; positive curvature turns from x towards y (left where y points up, right on a screen).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "crate::record::SegmentRecord", from = "crate::record::SegmentRecord"))]
pub struct Segment {
    /// Where the segment begins.
    pub start: Point,
    /// Direction of travel at the start, radians. Not reduced: headings of a spline run on through whole turns.
    pub heading: f64,
    /// Arc length, positive.
    pub length: f64,
    /// Curvature at the start, radians per unit of length.
    pub kappa0: f64,
    /// Curvature at the end, radians per unit of length.
    pub kappa1: f64,
}

/// What a segment is, read from its curvatures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Kind {
    /// Both curvatures are exactly zero.
    Line,
    /// Both curvatures are equal and not zero.
    Arc,
    /// The curvatures differ.
    Clothoid,
}

/// A point of a curve with its direction and curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position.
    pub point: Point,
    /// Direction of travel, radians.
    pub heading: f64,
    /// Curvature, radians per unit of length.
    pub curvature: f64,
}

/// Derivatives of a segment's position at a fixed arc length by the segment's own parameters.
///
/// The derivative by the start is the identity and that by arc length is the unit tangent, so neither is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionJacobian {
    /// By the heading at the start, per radian.
    pub heading: Vec2,
    /// By the curvature at the start.
    pub kappa0: Vec2,
    /// By the curvature at the end.
    pub kappa1: Vec2,
    /// By the segment's length, the arc length of the evaluated point held.
    pub length: Vec2,
}

impl Segment {
    /// A straight segment.
    #[must_use]
    pub const fn line(start: Point, heading: f64, length: f64) -> Self {
        Self { start, heading, length, kappa0: 0.0, kappa1: 0.0 }
    }

    /// A circular segment; curvature zero gives a line.
    #[must_use]
    pub const fn arc(start: Point, heading: f64, length: f64, kappa: f64) -> Self {
        Self { start, heading, length, kappa0: kappa, kappa1: kappa }
    }

    /// A segment with linear curvature from `kappa0` to `kappa1`.
    #[must_use]
    pub const fn clothoid(start: Point, heading: f64, length: f64, kappa0: f64, kappa1: f64) -> Self {
        Self { start, heading, length, kappa0, kappa1 }
    }

    /// Line, arc or clothoid, by exact comparison of the curvatures.
    #[must_use]
    pub fn kind(&self) -> Kind {
        if self.kappa0 != self.kappa1 {
            Kind::Clothoid
        } else if self.kappa0 == 0.0 {
            Kind::Line
        } else {
            Kind::Arc
        }
    }

    /// Rate of change of curvature, `(kappa1 − kappa0) / length`: zero for lines and arcs.
    #[must_use]
    pub fn sharpness(&self) -> f64 {
        (self.kappa1 - self.kappa0) / self.length
    }

    /// The clothoid parameter `A = sqrt(length / |kappa1 − kappa0|)` of road design; infinite for lines and arcs.
    #[must_use]
    pub fn clothoid_parameter(&self) -> f64 {
        (self.length / (self.kappa1 - self.kappa0).abs()).sqrt()
    }

    /// Signed angle through which the segment turns, `(kappa0 + kappa1) length / 2`, radians.
    #[must_use]
    pub fn turning(&self) -> f64 {
        0.5 * (self.kappa0 + self.kappa1) * self.length
    }

    /// Total absolute turning, radians: both halves count where the curvature changes sign inside.
    #[must_use]
    pub fn absolute_turning(&self) -> f64 {
        let (a, b) = (self.kappa0, self.kappa1);
        if a * b >= 0.0 {
            0.5 * (a + b).abs() * self.length
        } else {
            0.5 * (a * a + b * b) / (b - a).abs() * self.length
        }
    }

    /// Whether the curvature changes sign strictly inside the segment.
    #[must_use]
    pub fn has_inflection(&self) -> bool {
        self.kappa0 * self.kappa1 < 0.0
    }

    /// Curvature at arc length `s`.
    #[must_use]
    pub fn curvature_at(&self, s: f64) -> f64 {
        self.kappa0 + self.sharpness() * s
    }

    /// Heading at arc length `s`, radians, not reduced.
    #[must_use]
    pub fn heading_at(&self, s: f64) -> f64 {
        self.heading + s * (self.kappa0 + 0.5 * self.sharpness() * s)
    }

    /// Unit tangent at arc length `s`.
    #[must_use]
    pub fn tangent_at(&self, s: f64) -> Vec2 {
        unit(self.heading_at(s))
    }

    /// Position at arc length `s`, which may lie outside [0, length]: the segment continues as it is.
    ///
    /// Accurate to 1e-13 × |s| for |turning| ≤ 100 rad, beside the rounding of the start's own coordinates.
    #[must_use]
    pub fn point_at(&self, s: f64) -> Point {
        self.start + displacement(self.heading, self.kappa0, self.sharpness(), s)
    }

    /// Position, heading and curvature at arc length `s`.
    #[must_use]
    pub fn pose_at(&self, s: f64) -> Pose {
        Pose { point: self.point_at(s), heading: self.heading_at(s), curvature: self.curvature_at(s) }
    }

    /// Position, heading and curvature at the start.
    #[must_use]
    pub fn start_pose(&self) -> Pose {
        Pose { point: self.start, heading: self.heading, curvature: self.kappa0 }
    }

    /// Position, heading and curvature at the end.
    #[must_use]
    pub fn end_pose(&self) -> Pose {
        Pose { point: self.end(), heading: self.end_heading(), curvature: self.kappa1 }
    }

    /// Heading at the end, radians, not reduced.
    #[must_use]
    pub fn end_heading(&self) -> f64 {
        self.heading + self.turning()
    }

    /// Position of the end.
    #[must_use]
    pub fn end(&self) -> Point {
        self.point_at(self.length)
    }

    /// Derivatives of [`Segment::point_at`] by the segment's parameters at a fixed `s`.
    #[must_use]
    pub fn position_jacobian(&self, s: f64) -> PositionJacobian {
        let [m0, m1, m2] = moments(self.heading, self.kappa0, self.sharpness(), s).map(|m| Vec2::new(-m.y, m.x));
        let by_sharpness = m2 * 0.5;
        let kappa1 = by_sharpness / self.length;
        PositionJacobian {
            heading: m0,
            kappa0: m1 - kappa1,
            kappa1,
            length: by_sharpness * (-self.sharpness() / self.length),
        }
    }

    /// Second derivatives of [`Segment::point_at`] at a fixed `s` by pairs of heading, kappa0, kappa1 and length, in this order.
    ///
    /// Symmetric. With arc length `s` itself the mixed derivatives are those of the unit tangent.
    #[must_use]
    pub fn position_hessian(&self, s: f64) -> [[Vec2; 4]; 4] {
        let moments = moments_to_4(self.heading, self.kappa0, self.sharpness(), s);
        // The heading at u moves by 1, u − u²/2L, u²/2L and −sharpness u²/2L: polynomials in u, products of which are
        // integrated by the moments; two derivatives bring the factor i² = −1, and theta's own second derivatives a factor i.
        let (inverse, sharpness) = (1.0 / self.length, self.sharpness());
        let half = 0.5 * inverse;
        let by = [[1.0, 0.0, 0.0], [0.0, 1.0, -half], [0.0, 0.0, half], [0.0, 0.0, -half * sharpness]];
        let turned = Vec2::new(-moments[2].y, moments[2].x);
        let mut hessian = [[Vec2::ZERO; 4]; 4];
        for a in 0..4 {
            for b in 0..4 {
                let mut sum = Vec2::ZERO;
                for i in 0..3 {
                    for j in 0..3 {
                        sum -= moments[i + j] * (by[a][i] * by[b][j]);
                    }
                }
                let own = match (a.min(b), a.max(b)) {
                    (1, 3) => half * inverse,
                    (2, 3) => -half * inverse,
                    (3, 3) => 2.0 * half * sharpness * inverse,
                    _ => 0.0,
                };
                hessian[a][b] = sum + turned * own;
            }
        }
        hessian
    }

    /// The same curve travelled the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            start: self.end(),
            heading: self.end_heading() + std::f64::consts::PI,
            length: self.length,
            kappa0: -self.kappa1,
            kappa1: -self.kappa0,
        }
    }

    /// The part between the arc lengths `from` and `to`, `from < to`.
    #[must_use]
    pub fn subsegment(&self, from: f64, to: f64) -> Self {
        let Pose { point, heading, curvature } = self.pose_at(from);
        // A line stays a line and an arc an arc: no rounding may make a clothoid of them.
        let kappa1 = if self.kappa0 == self.kappa1 { curvature } else { self.curvature_at(to) };
        Self { start: point, heading, length: to - from, kappa0: curvature, kappa1 }
    }

    /// Whether all five parameters are finite and the length is positive.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        [self.start.x, self.start.y, self.heading, self.length, self.kappa0, self.kappa1].iter().all(|v| v.is_finite())
            && self.length > 0.0
    }
}
