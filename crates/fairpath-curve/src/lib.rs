//! The clothoid kernel of Fairpath.

mod arcs;
mod bezier;
mod bounds;
mod comb;
mod contact;
mod fit_source;
mod flatten;
mod greedy;
mod hermite_g1;
mod hermite_g2;
mod intersect;
mod lanes;
mod moments;
mod nearest;
mod offset;
mod parts;
#[cfg(feature = "serde")]
mod record;
mod segment;
mod spline;
mod transform;
pub mod trig;

pub use comb::Tooth;
pub use fit_source::FitSource;
pub use hermite_g1::hermite_g1;
pub use hermite_g2::hermite_g2;
pub use intersect::{Contact, Intersection, Place, SplineIntersection};
pub use kurbo::{Point, Vec2};
pub use moments::{displacement, moments, moments_to_4};
pub use nearest::{Nearest, SplineNearest};
pub use offset::OffsetPoint;
pub use segment::{Kind, Pose, PositionJacobian, Segment};
pub use spline::{Continuity, JOIN_TOLERANCE, Spline, SplineError};
pub use transform::Similarity;
