//! Playback as a command: it changes nothing of a document, and whoever shows the document carries it out.

use super::camera::CameraTrack;
use super::drive::{Drive, DriveError, drive};
use crate::document::{CommandError, Results, State};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Drives along a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename = "play", deny_unknown_fields)]
pub struct Play {
    /// Which path.
    pub path: String,
    /// Where the drive begins, arc length from the path's start, m.
    #[serde(default)]
    pub from_m: f64,
    /// Where it ends, m; else at the path's end. A drive to a lesser station goes back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to_m: Option<f64>,
    /// Whether it goes on at the path's end along the straightest way.
    #[serde(default)]
    pub on: bool,
    /// From one moment to the next, s.
    #[serde(default = "tenth")]
    pub step_s: f64,
    /// From where it is seen.
    #[serde(default)]
    pub camera: CameraTrack,
}

fn tenth() -> f64 {
    0.1
}

/// Why a command to play cannot be carried out.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlayError {
    /// There is no such path.
    #[error(transparent)]
    Path(CommandError),
    /// There is no such drive along it.
    #[error("path {path:?}: {problem}")]
    Drive {
        /// Which path.
        path: String,
        /// Why.
        problem: DriveError,
    },
}

impl Play {
    /// The drive in a state with what follows from it.
    ///
    /// # Errors
    /// When there is no such path or no such drive along it.
    pub fn drive(&self, state: &State, results: &Results) -> Result<Drive, PlayError> {
        let path = state.path(&self.path).ok_or_else(|| PlayError::Path(state.no_path(&self.path)))?;
        let range = [self.from_m, self.to_m.unwrap_or(path.length_m())];
        drive(results, path.id, range, self.on, self.step_s)
            .map_err(|problem| PlayError::Drive { path: self.path.clone(), problem })
    }
}
