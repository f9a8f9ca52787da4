//! What `--set` means: `key=value` texts come in, changed options go out.

use anyhow::{Context, Result, anyhow};
use fairpath_sketch::{SettingError, read_value, with_parameter};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// The options with all settings applied in their order, each by `with`: options, name and value come in, changed options go out.
///
/// # Errors
/// When a setting is no `key=value`, its key is unknown (the error lists near ones) or its value is of the wrong kind.
pub(crate) fn apply_by<T: Clone>(
    options: &T,
    settings: &[String],
    with: impl Fn(&T, &str, &Value) -> std::result::Result<T, SettingError>,
) -> Result<T> {
    let mut options = options.clone();
    for setting in settings {
        let (key, text) = setting
            .split_once('=')
            .with_context(|| format!("--set {setting}: expected KEY=VALUE, such as --set closing_gap=20"))?;
        options = with(&options, key.trim(), &read_value(text.trim())).map_err(|error| told(setting, &error))?;
    }
    Ok(options)
}

/// As [`apply_by`], for options of any type.
///
/// # Errors
/// As [`apply_by`].
pub(crate) fn apply<T>(options: &T, settings: &[String]) -> Result<T>
where
    T: JsonSchema + Serialize + DeserializeOwned + Default + Clone,
{
    apply_by(options, settings, with_parameter)
}

/// What is wrong with a setting, and what to do about it.
fn told(setting: &str, error: &SettingError) -> anyhow::Error {
    match error {
        SettingError::BadValue { expected, problem, .. } => anyhow!("--set {setting}: expected {expected}: {problem}"),
        _ => anyhow!("--set {setting}: {error}; `--list-parameters` shows all"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_fit::FitOptions;

    fn set(setting: &str) -> Result<FitOptions> {
        apply(&FitOptions::default(), &[setting.to_owned()])
    }

    #[test]
    fn the_last_setting_wins() {
        let settings = ["closing_gap=1".to_owned(), "closing_gap = 2.5".to_owned()];
        assert_eq!(apply(&FitOptions::default(), &settings).unwrap().closing_gap, 2.5);
    }

    #[test]
    fn an_unknown_key_names_its_neighbours() {
        let error = set("closing_gab=20").unwrap_err().to_string();
        assert_eq!(
            error,
            "--set closing_gab=20: there is no parameter closing_gab; near it: closing_gap; `--list-parameters` shows all"
        );
        let error = set("xyzzy=20").unwrap_err().to_string();
        assert_eq!(error, "--set xyzzy=20: there is no parameter xyzzy; `--list-parameters` shows all");
    }

    #[test]
    fn a_value_of_the_wrong_kind_is_refused() {
        for setting in ["closing_gap=wide", "closing_gap=NaN", "closing_gap=1e999", "closing_gap=", "closed=maybe"] {
            let error = set(setting).unwrap_err().to_string();
            assert!(error.starts_with(&format!("--set {setting}: expected ")), "{error}");
        }
        assert!(set("closing_gap").unwrap_err().to_string().contains("expected KEY=VALUE"));
    }
}
