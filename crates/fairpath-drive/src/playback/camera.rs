//! Cameras that go along with a drive: a moment comes in, where the camera stands and what it looks at goes out.

use super::drive::{Drive, Moment};
use fairpath_curve::trig;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// From where a drive is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CameraTrack {
    /// Through the driver's eyes.
    #[default]
    Driver,
    /// From behind and a little above.
    Chase,
    /// From above.
    Aerial,
    /// From the left side.
    Side,
}

impl CameraTrack {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Driver, Self::Chase, Self::Aerial, Self::Side];
}

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands, m.
    pub eye: [f64; 3],
    /// What it looks at, m.
    pub target: [f64; 3],
    /// What is up for it.
    pub up: [f64; 3],
}

/// Height of a driver's eyes over the road, m.
const EYES_M: f64 = 1.2;

impl CameraTrack {
    /// The camera at a moment.
    #[must_use]
    pub fn at(self, moment: &Moment) -> Camera {
        let along = trig::unit(moment.heading_rad);
        let [x, y, z] = moment.position;
        // Ahead (or behind, if negative), to the left and above, all along the slope of the road.
        let place = |ahead: f64, left: f64, above: f64| {
            [
                x + along.x * ahead - along.y * left,
                y + along.y * ahead + along.x * left,
                z + moment.grade * ahead + above,
            ]
        };
        let up = [0.0, 0.0, 1.0];
        match self {
            Self::Driver => Camera { eye: place(0.0, 0.0, EYES_M), target: place(20.0, 0.0, EYES_M - 0.3), up },
            Self::Chase => Camera { eye: place(-14.0, 0.0, 5.0), target: place(10.0, 0.0, 1.0), up },
            Self::Aerial => {
                Camera { eye: place(0.0, 0.0, 150.0), target: place(0.0, 0.0, 0.0), up: [along.x, along.y, 0.0] }
            }
            Self::Side => Camera { eye: place(0.0, 30.0, 8.0), target: place(0.0, 0.0, 1.0), up },
        }
    }

    /// The cameras at all moments of a drive.
    #[must_use]
    pub fn along(self, drive: &Drive) -> Vec<Camera> {
        drive.moments.iter().map(|m| self.at(m)).collect()
    }
}
