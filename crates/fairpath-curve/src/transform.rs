//! Similarity transforms, which map segments to segments: lines stay lines, arcs arcs and clothoids clothoids.

use crate::segment::{Pose, Segment};
use crate::spline::Spline;
use crate::trig::unit;
use kurbo::{Point, Vec2};

/// A similarity of the plane: mirrored at the x axis if asked, then scaled, then rotated about the origin, then moved.
///
/// Other affine maps do not keep curvature linear in arc length and so have no place here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Whether y changes sign first.
    pub mirror: bool,
    /// Factor of lengths, positive.
    pub scale: f64,
    /// Rotation in radians, from the x axis towards the y axis.
    pub rotation: f64,
    /// Translation, applied last.
    pub translation: Vec2,
}

impl Similarity {
    /// The map that changes nothing.
    pub const IDENTITY: Self = Self { mirror: false, scale: 1.0, rotation: 0.0, translation: Vec2::ZERO };

    /// Moves by `by`.
    #[must_use]
    pub const fn translate(by: Vec2) -> Self {
        Self { translation: by, ..Self::IDENTITY }
    }

    /// Turns by `angle` radians about the origin.
    #[must_use]
    pub const fn rotate(angle: f64) -> Self {
        Self { rotation: angle, ..Self::IDENTITY }
    }

    /// Scales by the positive `factor` about the origin.
    #[must_use]
    pub const fn scale(factor: f64) -> Self {
        Self { scale: factor, ..Self::IDENTITY }
    }

    /// Mirrors at the line through the origin with the given direction in radians.
    #[must_use]
    pub fn mirror(axis: f64) -> Self {
        Self { mirror: true, rotation: 2.0 * axis, ..Self::IDENTITY }
    }

    /// The similarity without reflection that takes `from` to `to`, position and heading, and multiplies lengths by `scale`.
    #[must_use]
    pub fn between(from: Pose, to: Pose, scale: f64) -> Self {
        let turn = Self { scale, rotation: to.heading - from.heading, ..Self::IDENTITY };
        Self { translation: to.point - turn.point(from.point), ..turn }
    }

    /// The image of a vector: of a difference of points.
    #[must_use]
    pub fn vector(&self, v: Vec2) -> Vec2 {
        let v = if self.mirror { Vec2::new(v.x, -v.y) } else { v };
        let c = unit(self.rotation) * self.scale;
        Vec2::new(c.x * v.x - c.y * v.y, c.y * v.x + c.x * v.y)
    }

    /// The image of a point.
    #[must_use]
    pub fn point(&self, p: Point) -> Point {
        (self.vector(p.to_vec2()) + self.translation).to_point()
    }

    /// The image of a heading, radians.
    #[must_use]
    pub fn heading(&self, heading: f64) -> f64 {
        self.rotation + if self.mirror { -heading } else { heading }
    }

    /// This map followed by `next`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            mirror: self.mirror != next.mirror,
            scale: self.scale * next.scale,
            rotation: next.heading(self.rotation),
            translation: next.point(self.translation.to_point()).to_vec2(),
        }
    }

    /// The map that undoes this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = if self.mirror { self.rotation } else { -self.rotation };
        let turn = Self { mirror: self.mirror, scale: 1.0 / self.scale, rotation, translation: Vec2::ZERO };
        Self { translation: -turn.vector(self.translation), ..turn }
    }
}

impl Segment {
    /// The image of the segment.
    #[must_use]
    pub fn transformed(&self, by: &Similarity) -> Self {
        let curvature = if by.mirror { -1.0 } else { 1.0 } / by.scale;
        Self {
            start: by.point(self.start),
            heading: by.heading(self.heading),
            length: self.length * by.scale,
            kappa0: self.kappa0 * curvature,
            kappa1: self.kappa1 * curvature,
        }
    }
}

impl Spline {
    /// The image of the spline. Joins keep their continuity.
    #[must_use]
    pub fn transformed(&self, by: &Similarity) -> Self {
        let segments = self.segments().iter().map(|s| s.transformed(by)).collect();
        Self::from_parts(segments, self.joins().to_vec(), self.is_closed())
    }
}
