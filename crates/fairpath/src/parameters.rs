//! The fitter's parameters by name: listed, described and set generically, so that a new one needs nothing here.

use std::fmt;

use anyhow::{Context, Result, anyhow, bail};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::{Deserialize, DeserializeOwned, Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_json::{Map, Value};

/// A parameter as its schema describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name, as `--set` takes it.
    pub name: String,
    /// Unit; empty where it has none.
    pub unit: String,
    /// What it means.
    pub description: String,
    /// What it may be, where that is not simply a number.
    pub kind: String,
}

/// Every parameter of a method with these options, in the order of its declaration.
#[must_use]
pub fn all<T: JsonSchema + Serialize + Default>() -> Vec<Parameter> {
    let schema = schemars::schema_for!(T).to_value();
    let empty = Map::new();
    let properties = schema["properties"].as_object().unwrap_or(&empty);
    let mut list: Vec<Parameter> = properties
        .iter()
        .map(|(name, property)| Parameter {
            name: name.clone(),
            unit: property["unit"].as_str().unwrap_or_default().to_owned(),
            description: one_line(property["description"].as_str().unwrap_or_default()),
            kind: kind(property, &schema),
        })
        .collect();
    // The schema sorts by name; the order of declaration groups what belongs together.
    let declared = serde_json::to_string(&T::default()).unwrap_or_default();
    if let Ok(Keys(keys)) = serde_json::from_str(&declared) {
        list.sort_by_key(|parameter| keys.iter().position(|name| *name == parameter.name));
    }
    list
}

/// The keys of a JSON object in the order of its text.
struct Keys(Vec<String>);

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Collect;
        impl<'de> Visitor<'de> for Collect {
            type Value = Keys;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Keys, A::Error> {
                let mut keys = Vec::new();
                while let Some((key, IgnoredAny)) = map.next_entry()? {
                    keys.push(key);
                }
                Ok(Keys(keys))
            }
        }
        deserializer.deserialize_map(Collect)
    }
}

/// The options with `key=value` settings applied in their order.
///
/// # Errors
/// When a key is unknown (the error lists near ones) or a value is of the wrong kind.
pub fn apply<T: JsonSchema + Serialize + DeserializeOwned + Default + Clone>(
    options: &T,
    settings: &[String],
) -> Result<T> {
    let mut options = options.clone();
    for setting in settings {
        let (key, text) = setting
            .split_once('=')
            .with_context(|| format!("--set {setting}: expected KEY=VALUE, such as --set closing_gap=20"))?;
        let (key, text) = (key.trim(), text.trim());
        let mut value = serde_json::to_value(&options).context("the options cannot be listed")?;
        let fields = value.as_object_mut().context("the options are no list of fields")?;
        if !fields.contains_key(key) {
            bail!("--set {setting}: {}", unknown(key, fields.keys().map(String::as_str)));
        }
        fields.insert(key.to_owned(), parse(text));
        options = serde_json::from_value(value).map_err(|error| {
            let kind = all::<T>().into_iter().find(|parameter| parameter.name == key).map(|parameter| parameter.kind);
            anyhow!("--set {setting}: expected {}: {error}", kind.unwrap_or_else(|| "another value".into()))
        })?;
    }
    Ok(options)
}

/// The value of a parameter as `--set` would take it.
#[must_use]
pub fn show(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        // 15.0 reads better as 15, and both read back to the same number.
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), |x| x.to_string()),
        other => other.to_string(),
    }
}

fn parse(text: &str) -> Value {
    match serde_json::from_str::<Value>(text) {
        Ok(value @ (Value::Number(_) | Value::Bool(_) | Value::Null)) => value,
        _ => Value::String(text.to_owned()),
    }
}

fn kind(property: &Value, schema: &Value) -> String {
    let resolved = match property["$ref"].as_str().and_then(|path| path.strip_prefix('#')) {
        Some(pointer) => schema.pointer(pointer).unwrap_or(property),
        None => property,
    };
    let choices = |value: &Value| -> Vec<String> {
        let listed = value["enum"].as_array().into_iter().flatten();
        let single = value["oneOf"].as_array().into_iter().flatten().map(|choice| &choice["const"]);
        listed.chain(single).filter_map(|choice| choice.as_str().map(str::to_owned)).collect()
    };
    let words = choices(resolved);
    if !words.is_empty() {
        return words.join(" | ");
    }
    let names: Vec<&str> = match &resolved["type"] {
        Value::String(name) => vec![name],
        Value::Array(names) => names.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    let words: Vec<&str> = names
        .into_iter()
        .map(|name| match name {
            "number" => "a number",
            "integer" => "a whole number",
            "boolean" => "true | false",
            other => other,
        })
        .collect();
    if words.is_empty() { "a value".into() } else { words.join(" | ") }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn unknown<'a>(key: &str, names: impl Iterator<Item = &'a str>) -> String {
    let mut near: Vec<(usize, &str)> = names
        .map(|name| (if name.contains(key) || key.contains(name) { 1 } else { edits(key, name) }, name))
        .filter(|&(distance, name)| distance <= (name.len() / 3).max(2))
        .collect();
    near.sort();
    let near: Vec<&str> = near.into_iter().take(4).map(|(_, name)| name).collect();
    let hint = if near.is_empty() { String::new() } else { format!("; near it: {}", near.join(", ")) };
    format!("there is no parameter {key}{hint}; `--list-parameters` shows all")
}

/// Number of characters to insert, delete or replace to get from one word to the other.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &cb) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_fit::{CurvatureSpaceOptions, FitOptions};

    fn set(setting: &str) -> Result<FitOptions> {
        apply(&FitOptions::default(), &[setting.to_owned()])
    }

    #[test]
    fn every_parameter_has_a_description() {
        let list = all::<FitOptions>();
        assert!(!list.is_empty());
        for parameter in list.into_iter().chain(all::<CurvatureSpaceOptions>()) {
            assert!(!parameter.description.is_empty(), "{}", parameter.name);
        }
    }

    #[test]
    fn keys_keep_the_order_of_the_text() {
        let Keys(keys) = serde_json::from_str(r#"{"b":1,"c":{"z":0},"a":[2]}"#).unwrap();
        assert_eq!(keys, ["b", "c", "a"]);
        assert_eq!(all::<FitOptions>()[0].name, "pixel_size");
    }

    #[test]
    fn a_setting_changes_its_parameter_only() {
        let options = set("closing_gap=20").unwrap();
        assert_eq!(options, FitOptions { closing_gap: 20.0, ..FitOptions::default() });
    }

    #[test]
    fn the_last_setting_wins() {
        let settings = ["closing_gap=1".to_owned(), "closing_gap = 2.5".to_owned()];
        assert_eq!(apply(&FitOptions::default(), &settings).unwrap().closing_gap, 2.5);
    }

    #[test]
    fn every_value_that_is_listed_can_be_set() {
        let Value::Object(fields) = serde_json::to_value(FitOptions::default()).unwrap() else { panic!("no object") };
        for (name, value) in fields {
            assert_eq!(set(&format!("{name}={}", show(&value))).unwrap(), FitOptions::default(), "{name}");
        }
    }

    #[test]
    fn an_unknown_key_names_its_neighbours() {
        let error = set("closing_gab=20").unwrap_err().to_string();
        assert!(error.contains("there is no parameter closing_gab; near it: closing_gap"), "{error}");
        let error = set("xyzzy=20").unwrap_err().to_string();
        assert!(error.contains("there is no parameter xyzzy;") && !error.contains("near it"), "{error}");
    }

    #[test]
    fn a_value_of_the_wrong_kind_is_refused() {
        for setting in ["closing_gap=wide", "closing_gap=NaN", "closing_gap=1e999", "closing_gap=", "closed=maybe"] {
            let error = set(setting).unwrap_err().to_string();
            assert!(error.starts_with(&format!("--set {setting}: expected ")), "{error}");
        }
        assert!(set("closing_gap").unwrap_err().to_string().contains("expected KEY=VALUE"));
    }

    #[test]
    fn edits_are_counted() {
        assert_eq!(
            [edits("", "abc"), edits("abc", "abd"), edits("abc", "bc"), edits("kitten", "sitting")],
            [3, 1, 1, 3]
        );
    }
}
