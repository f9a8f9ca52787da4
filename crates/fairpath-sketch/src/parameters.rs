//! What can be set about a method, by name: the type of its options comes in, a list with units, meanings, kinds and defaults goes out; and a name with
//! a value comes in, changed options go out.
//!
//! All of it is read from the JSON schema and the serialised form of the options, so that a new parameter needs nothing here, and a form or a command
//! line that shows this list shows it too.

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::{Deserialize, DeserializeOwned, Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_json::{Map, Value};
use std::fmt;
use thiserror::Error;

/// A parameter as its schema describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name, by which it is set.
    pub name: String,
    /// Unit; empty where it has none.
    pub unit: String,
    /// What it means, in one line.
    pub description: String,
    /// What it may be.
    pub kind: Kind,
    /// What it is unless it is set.
    pub default: Value,
}

/// What a parameter may be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number; if `nullable`, also none at all.
    Number {
        /// Whether it may be `null`.
        nullable: bool,
    },
    /// A whole number.
    Integer,
    /// Yes or no.
    Bool,
    /// One of these words.
    Choice(Vec<String>),
}

/// As a person reads it, such as `a number | null`.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number { nullable: false } => f.write_str("a number"),
            Self::Number { nullable: true } => f.write_str("a number | null"),
            Self::Integer => f.write_str("a whole number"),
            Self::Bool => f.write_str("true | false"),
            Self::Choice(words) => f.write_str(&words.join(" | ")),
        }
    }
}

/// Why a parameter cannot be set.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SettingError {
    /// There is none of that name.
    #[error("there is no parameter {name}{}", near_ones(near))]
    Unknown {
        /// The name that was given.
        name: String,
        /// Names that are spelled alike, the likeliest first.
        near: Vec<String>,
    },
    /// It cannot have that value.
    #[error("{name} = {value}: expected {expected}: {problem}")]
    BadValue {
        /// The parameter.
        name: String,
        /// The value that was given.
        value: String,
        /// What it may be.
        expected: String,
        /// What is wrong with the value.
        problem: String,
    },
}

/// The end of a sentence that says which names are spelled alike; nothing if none is.
fn near_ones(near: &[String]) -> String {
    if near.is_empty() { String::new() } else { format!("; near it: {}", near.join(", ")) }
}

/// Every parameter of options of this type, in the order of their declaration. Options within options are not among them.
#[must_use]
pub fn parameters_of<T: JsonSchema + Serialize + Default>() -> Vec<Parameter> {
    let schema = schemars::schema_for!(T).to_value();
    let defaults = serde_json::to_value(T::default()).unwrap_or_default();
    let described = |name: &String, property: &Value| {
        Some(Parameter {
            name: name.clone(),
            unit: property["unit"].as_str().unwrap_or_default().to_owned(),
            description: one_line(property["description"].as_str().unwrap_or_default()),
            kind: kind(property, &schema)?,
            default: defaults[name].clone(),
        })
    };
    let empty = Map::new();
    let properties = schema["properties"].as_object().unwrap_or(&empty);
    let mut list: Vec<Parameter> = properties.iter().filter_map(|(name, property)| described(name, property)).collect();
    // The schema sorts by name; the order of declaration groups what belongs together.
    let declared = serde_json::to_string(&T::default()).unwrap_or_default();
    if let Ok(Keys(keys)) = serde_json::from_str(&declared) {
        list.sort_by_key(|parameter| keys.iter().position(|name| *name == parameter.name));
    }
    list
}

/// The options with one parameter changed.
///
/// # Errors
/// When there is no parameter of that name, or the value is of the wrong kind. Whether a number is in its range is for the options to say.
pub fn with_parameter<T>(options: &T, name: &str, value: &Value) -> Result<T, SettingError>
where
    T: JsonSchema + Serialize + DeserializeOwned + Default,
{
    let bad = |problem: serde_json::Error| {
        let known = parameters_of::<T>().into_iter().find(|parameter| parameter.name == name);
        let expected = known.map_or_else(|| "another value".into(), |parameter| parameter.kind.to_string());
        SettingError::BadValue { name: name.into(), value: show_value(value), expected, problem: problem.to_string() }
    };
    let mut written = serde_json::to_value(options).map_err(bad)?;
    match written.get_mut(name) {
        Some(place) => *place = value.clone(),
        None => {
            let names = written.as_object().into_iter().flat_map(Map::keys).map(String::as_str);
            return Err(SettingError::Unknown { name: name.into(), near: near(name, names) });
        }
    }
    serde_json::from_value(written).map_err(bad)
}

/// A value as a person writes it; [`read_value`] reads it back.
#[must_use]
pub fn show_value(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        // 15.0 reads better as 15, and both read back to the same number.
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), |x| x.to_string()),
        other => other.to_string(),
    }
}

/// The value that a person wrote: a number, `true`, `false` or `null`, else a word.
#[must_use]
pub fn read_value(text: &str) -> Value {
    match serde_json::from_str::<Value>(text) {
        Ok(value @ (Value::Number(_) | Value::Bool(_) | Value::Null)) => value,
        _ => Value::String(text.to_owned()),
    }
}

/// The keys of a JSON object in the order of its text.
struct Keys(Vec<String>);

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Collect;
        impl<'de> Visitor<'de> for Collect {
            type Value = Keys;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys, A::Error> {
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

/// What a property of a schema may be; nothing for one that is itself a list of options.
fn kind(property: &Value, schema: &Value) -> Option<Kind> {
    let resolved = match property["$ref"].as_str().and_then(|path| path.strip_prefix('#')) {
        Some(pointer) => schema.pointer(pointer).unwrap_or(property),
        None => property,
    };
    let listed = resolved["enum"].as_array().into_iter().flatten();
    let single = resolved["oneOf"].as_array().into_iter().flatten().map(|choice| &choice["const"]);
    let words: Vec<String> = listed.chain(single).filter_map(|word| word.as_str().map(str::to_owned)).collect();
    if !words.is_empty() {
        return Some(Kind::Choice(words));
    }
    let names: Vec<&str> = match &resolved["type"] {
        Value::String(name) => vec![name],
        Value::Array(names) => names.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    match names[..] {
        ["number"] => Some(Kind::Number { nullable: false }),
        ["number", "null"] => Some(Kind::Number { nullable: true }),
        ["integer"] => Some(Kind::Integer),
        ["boolean"] => Some(Kind::Bool),
        _ => None,
    }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Most names that are offered in place of a wrong one.
const MOST_NEAR: usize = 4;

/// The names that are spelled like one, the likeliest first.
fn near<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let distance = |other: &str| if other.contains(name) || name.contains(other) { 1 } else { edits(name, other) };
    let mut near: Vec<(usize, &str)> = names
        .map(|other| (distance(other), other))
        .filter(|&(distance, other)| distance <= (other.len() / 3).max(2))
        .collect();
    near.sort();
    near.into_iter().take(MOST_NEAR).map(|(_, other)| other.to_owned()).collect()
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
    use crate::method::{Method, Settings};
    use fairpath_fit::{FitOptions, OversketchOptions, Preset};
    use fairpath_shape::InflateOptions;
    use serde_json::json;

    fn set(name: &str, value: Value) -> Result<FitOptions, SettingError> {
        with_parameter(&FitOptions::default(), name, &value)
    }

    /// The parameters of everything that can be set.
    fn all() -> Vec<Parameter> {
        let methods = Method::ALL.into_iter().flat_map(|method| Settings::of(method, Preset::Default).parameters());
        methods.chain(parameters_of::<OversketchOptions>()).chain(parameters_of::<InflateOptions>()).collect()
    }

    #[test]
    fn every_parameter_has_a_meaning_and_a_default_of_its_kind() {
        assert!(all().len() > 100, "{}", all().len());
        for Parameter { name, description, kind, default, .. } in all() {
            assert!(!description.is_empty(), "{name}");
            let fits = match &kind {
                Kind::Number { nullable } => default.is_number() || (*nullable && default.is_null()),
                Kind::Integer => default.is_u64(),
                Kind::Bool => default.is_boolean(),
                Kind::Choice(words) => words.iter().any(|word| default == word.as_str()),
            };
            assert!(fits, "{name} is {default}, which is not {kind}");
        }
    }

    #[test]
    fn a_form_leaves_out_nothing_but_options_within_options() {
        for method in Method::ALL {
            let settings = Settings::of(method, Preset::Default);
            let listed: Vec<String> = settings.parameters().into_iter().map(|parameter| parameter.name).collect();
            let values = settings.values();
            assert_eq!(listed.len(), values.as_object().unwrap().len(), "{method:?}");
            assert!(listed.iter().all(|name| values.get(name).is_some()), "{method:?}");
        }
        let listed = parameters_of::<OversketchOptions>();
        assert!(listed.iter().all(|parameter| parameter.name != "fit"));
        assert_eq!(
            listed.len() + 1,
            serde_json::to_value(OversketchOptions::default()).unwrap().as_object().unwrap().len()
        );
    }

    #[test]
    fn parameters_keep_the_order_of_their_declaration() {
        let Keys(keys) = serde_json::from_str(r#"{"b":1,"c":{"z":0},"a":[2]}"#).unwrap();
        assert_eq!(keys, ["b", "c", "a"]);
        assert_eq!(parameters_of::<FitOptions>()[0].name, "pixel_size");
    }

    #[test]
    fn a_setting_changes_its_parameter_only() {
        let options = set("closing_gap", json!(20)).unwrap();
        assert_eq!(options, FitOptions { closing_gap: 20.0, ..FitOptions::default() });
    }

    #[test]
    fn every_value_that_is_shown_reads_back_and_can_be_set() {
        for method in Method::ALL {
            for preset in Preset::ALL {
                let settings = Settings::of(method, preset);
                for (name, value) in settings.values().as_object().unwrap() {
                    let read = read_value(&show_value(value));
                    assert_eq!(settings.with(name, &read).as_ref(), Ok(&settings), "{name}");
                }
            }
        }
    }

    #[test]
    fn every_choice_can_be_set() {
        let settings = Settings::of(Method::ShortestPath, Preset::Default);
        let mut tried = 0;
        for Parameter { name, kind, .. } in settings.parameters() {
            let Kind::Choice(words) = kind else { continue };
            for word in words {
                assert_eq!(settings.with(&name, &json!(word)).unwrap().values()[&name], json!(word));
                tried += 1;
            }
        }
        assert!(tried > 10, "{tried}");
    }

    #[test]
    fn an_unknown_name_is_told_with_those_that_are_near() {
        let error = set("closing_gab", json!(20)).unwrap_err();
        assert_eq!(error.to_string(), "there is no parameter closing_gab; near it: closing_gap");
        assert_eq!(set("xyzzy", json!(20)).unwrap_err().to_string(), "there is no parameter xyzzy");
    }

    #[test]
    fn a_value_of_the_wrong_kind_is_refused_with_what_is_expected() {
        for (name, value) in [("closing_gap", json!("wide")), ("closing_gap", json!(null)), ("closed", json!("maybe"))]
        {
            let error = set(name, value.clone()).unwrap_err().to_string();
            assert!(error.starts_with(&format!("{name} = {}: expected ", show_value(&value))), "{error}");
        }
    }

    #[test]
    fn edits_are_counted() {
        assert_eq!(
            [edits("", "abc"), edits("abc", "abd"), edits("abc", "bc"), edits("kitten", "sitting")],
            [3, 1, 1, 3]
        );
    }
}
