//! Where something lies in the world and how large it is, as a camera needs to know it.

use glam::DVec3;

/// A ball around something, in the world: x to the right, y up, z towards who looks at the drawing from the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Middle of the ball, in the unit of the drawing.
    pub centre: DVec3,
    /// Radius of the ball, in the unit of the drawing; greater than 0.
    pub radius: f64,
}

impl Bounds {
    /// The unit ball about the origin.
    pub const UNIT: Self = Self { centre: DVec3::ZERO, radius: 1.0 };
}
