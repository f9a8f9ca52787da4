//! How a person asks for a curve: a method, a preset, a place on the slider, and what was set beyond that.

use crate::fairness;
use crate::method::{Method, Settings};
use crate::parameters::SettingError;
use fairpath_fit::{Closing, Preset};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// How a stroke is to be neatened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Neatening {
    /// The method.
    pub method: Method,
    /// Its preset; of meaning to shortest paths only.
    pub preset: Preset,
    /// From 0, the stroke as it was drawn, to 1, fairest; at 0.5 options are those of the preset.
    pub fairness: f64,
    /// Whether the curve is closed.
    pub closed: Closing,
    /// Size of a pixel of the screen on which the stroke was drawn, in the drawing's unit: a hand trembles on the glass, not in the drawing.
    pub pixel_size: f64,
    /// Options that were set by name, over all that.
    pub set: BTreeMap<String, Value>,
    /// Name of the set of French curves.
    pub templates: String,
}

impl Default for Neatening {
    fn default() -> Self {
        Self {
            method: Method::default(),
            preset: Preset::default(),
            fairness: fairness::MIDDLE,
            closed: Closing::default(),
            pixel_size: 1.0,
            set: BTreeMap::new(),
            templates: "burmester".into(),
        }
    }
}

impl Neatening {
    /// The name that files have for how the curve came about.
    #[must_use]
    pub fn method_name(&self) -> &'static str {
        if self.fairness <= 0.0 { "raw" } else { self.method.name() }
    }

    /// The method with all of its options.
    ///
    /// # Errors
    /// When an option that was set does not exist, or a value is of the wrong kind.
    pub fn settings(&self) -> Result<Settings, SettingError> {
        if self.fairness <= 0.0 {
            return Ok(Settings::Raw);
        }
        let mut settings = fairness::at(Settings::of(self.method, self.preset), self.fairness);
        if let Some((pixel_size, closed)) = settings.stroke() {
            *pixel_size = self.pixel_size;
            *closed = self.closed;
        }
        for (name, value) in &self.set {
            settings = settings.with(name, value)?;
        }
        Ok(settings)
    }
}
