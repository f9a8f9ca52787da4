//! Networks of paths on a terrain: scripts and projects in, and files for other programs out.

mod csv;
mod export;
mod files;
mod finishes;
mod geojson;
mod gltf;
mod import;
mod landxml;
mod opendrive;
mod opening;
mod picture;
mod project;
mod script;
mod summary;
mod views;
mod xml;

pub use csv::{encode_earthwork, encode_moments};
pub use export::{DriveExport, ExportFormat, encode_drive};
pub use opening::{OpenedDrive, open_drive};
pub use picture::{MOST_PIXELS, encode_drive_picture};
pub use project::encode_project;
pub use script::{DriveScript, ScriptCommand, read_drive_script_from};
pub use summary::{PathSummary, summaries};
pub use views::DriveView;

pub(crate) use script::ScriptRecord;
