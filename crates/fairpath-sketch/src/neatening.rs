//! How a person asks for a curve: a method, a preset, a place on the slider, and what was set beyond that.

use crate::fairness;
use crate::method::{Method, Settings};
use fairpath_fit::{Closing, Preset};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use thiserror::Error;

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

/// Why an option cannot be set.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{name} = {value} cannot be set: {problem}")]
pub struct SettingError {
    /// The option.
    pub name: String,
    /// The value.
    pub value: String,
    /// What is wrong with it.
    pub problem: String,
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
            settings = with(&settings, name, value)?;
        }
        Ok(settings)
    }
}

/// Settings with one option changed.
fn with(settings: &Settings, name: &str, value: &Value) -> Result<Settings, SettingError> {
    let error = |problem: String| SettingError { name: name.into(), value: value.to_string(), problem };
    let mut written = serde_json::to_value(settings).map_err(|e| error(e.to_string()))?;
    let options = written["options"].as_object_mut().ok_or_else(|| error("there are no options".into()))?;
    if !options.contains_key(name) {
        return Err(error("there is no such option".into()));
    }
    options.insert(name.to_owned(), value.clone());
    serde_json::from_value(written).map_err(|e| error(e.to_string()))
}
