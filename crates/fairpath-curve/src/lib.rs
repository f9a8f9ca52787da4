//! The clothoid kernel of Fairpath.

mod moments;
#[cfg(feature = "serde")]
mod record;
mod segment;
mod spline;
pub mod trig;

pub use kurbo::{Point, Vec2};
pub use moments::{displacement, moments};
pub use segment::{Kind, Pose, PositionJacobian, Segment};
pub use spline::{Continuity, JOIN_TOLERANCE, Spline, SplineError};
