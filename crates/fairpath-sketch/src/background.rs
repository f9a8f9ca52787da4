//! A picture behind the drawing, to trace over.

use data_encoding::BASE64;
use fairpath_curve::Point;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A picture behind the drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Background {
    /// What its file was called.
    pub name: String,
    /// The bytes of its file: PNG, JPEG or WebP.
    #[serde(serialize_with = "as_text", deserialize_with = "from_text")]
    pub image: Vec<u8>,
    /// Its upper left corner, in the drawing's unit.
    pub at: Point,
    /// Its width, in the drawing's unit.
    pub width: f64,
    /// From 0, not to be seen, to 1.
    pub opacity: f64,
}

impl Background {
    /// Whether it can be shown: finite, and not without width.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.at.is_finite() && self.width.is_finite() && self.width > 0.0 && (0.0..=1.0).contains(&self.opacity)
    }
}

fn as_text<S: Serializer>(image: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&BASE64.encode(image))
}

fn from_text<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<u8>, D::Error> {
    let text = String::deserialize(deserializer)?;
    BASE64.decode(text.as_bytes()).map_err(|error| D::Error::custom(format!("the image is not base64: {error}")))
}
