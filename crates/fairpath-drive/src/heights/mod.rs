//! Heights at crossings: points along paths and which of them pass over which come in, the heights that cost least go out
//! (McCrae 2008, section 3.4.4, equations 3.1 to 3.3).
//!
//! The thesis goes down the steepest slope with differences for derivatives. Where every upper point is above its lower one the sum is strictly convex and
//! smooth, so it has one minimum there, which Newton's method finds in a dozen steps from any heights in the right order. Each step solves one sparse
//! system with a factorisation whose pattern is the same for all of them.

mod descent;
mod order;
mod problem;

pub use problem::{CrossingHeights, HeightError, HeightPoint, Heights, Over, PathPoints};
