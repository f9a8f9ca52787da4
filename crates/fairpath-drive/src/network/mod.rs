//! The network: paths, where they cross, how high they lie there, and what carries them.

mod contact;
mod elevation;
mod engineer;
mod junction;
mod path;
mod sketch;
mod structure;

pub use contact::{Choice, Crossing, Meeting, PathPlace};
pub use elevation::Unordered;
pub use junction::{Arm, Junction, Turning, Way};
pub use path::{DrawnHeights, HeightMode, Path, PathId, SpeedZone};
pub use sketch::{SketchScale, SketchedPlan};
pub use structure::{Carrier, Structure, StructureLimits};

pub(crate) use contact::{Surveyed, crossings_between, crossings_within, decide, reach};
pub(crate) use elevation::{alone, profile_with, separation_m, wanted_heights};
pub(crate) use engineer::{Site, engineered};
pub(crate) use junction::junctions;
pub(crate) use sketch::points_along;
pub(crate) use structure::structures;
