//! Driving along paths (section 3.7 of the thesis): which way, how fast, and seen from where.

mod camera;
mod drive;
mod play;
mod speed;

pub use camera::{Camera, CameraTrack};
pub use drive::{Drive, DriveError, Moment, drive};
pub use play::{Play, PlayError};
pub use speed::{COMFORTABLE_M_S2, smooth_speeds};
