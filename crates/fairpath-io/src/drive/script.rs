//! `fairpath-drive-script 1`: commands to a document as JSON, in the order in which they are to be done.

use super::import::Import;
use crate::error::{Error, Fault};
use crate::input::{Budget, label, open, read_all, text};
use crate::limits::{Limits, ReadOptions};
use crate::strokes_json::{check_format, check_version, json_fault};
use fairpath_drive::Command;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;
use std::io::Read;
use std::path::Path;

/// The word in the file's `format`.
pub(super) const FORMAT: &str = "fairpath-drive-script";

/// A script as it is written; this is what the schema describes.
#[derive(Serialize, JsonSchema)]
#[schemars(title = "fairpath-drive-script 1")]
pub(crate) struct ScriptRecord {
    /// Always `fairpath-drive-script`.
    #[schemars(extend("const" = "fairpath-drive-script"))]
    format: String,
    /// Always 1.
    #[schemars(extend("const" = 1))]
    version: u64,
    /// What is to be done, in order.
    commands: Vec<ScriptCommand>,
}

/// A command of a script: one to the document, or one that becomes several.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ScriptCommand {
    /// A command to the document.
    Document(Command),
    /// Lines of a file, each of which is sketched.
    Import(Import),
}

/// A script.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriveScript {
    /// What is to be done, in order.
    pub commands: Vec<ScriptCommand>,
}

/// The script in a file; `-` is standard input.
///
/// # Errors
/// When the file cannot be opened, goes beyond the limits or breaks the format's rules; every command with a problem is named.
pub fn read_drive_script(path: &Path, options: &ReadOptions) -> Result<DriveScript, Error> {
    read_drive_script_from(open(path)?, &label(path), options)
}

/// The script that `reader` gives; `name` stands for the file in messages.
///
/// # Errors
/// As [`read_drive_script`].
pub fn read_drive_script_from(reader: impl Read, name: &str, options: &ReadOptions) -> Result<DriveScript, Error> {
    let parsed = || {
        let bytes = read_all(reader, &options.limits)?;
        text(&bytes).and_then(|text| parse(text, &options.limits))
    };
    parsed().map_err(|fault| fault.in_file(name))
}

/// A file before its commands are looked at one by one.
#[derive(Deserialize)]
struct Envelope {
    #[serde(deserialize_with = "read_format")]
    #[expect(dead_code, reason = "it is checked as it is read")]
    format: (),
    #[serde(deserialize_with = "read_version")]
    #[expect(dead_code, reason = "it is checked as it is read")]
    version: (),
    commands: Vec<Value>,
}

fn read_format<'de, D: Deserializer<'de>>(d: D) -> Result<(), D::Error> {
    check_format(&String::deserialize(d)?, FORMAT)
}

fn read_version<'de, D: Deserializer<'de>>(d: D) -> Result<(), D::Error> {
    check_version(u64::deserialize(d)?)
}

fn parse(text: &str, limits: &Limits) -> Result<DriveScript, Fault> {
    let Envelope { commands, .. } = serde_json::from_str(text).map_err(|e| json_fault(&e))?;
    let mut items = Budget::items(limits);
    let (mut good, mut problems) = (Vec::with_capacity(commands.len()), Vec::new());
    for (i, value) in commands.into_iter().enumerate() {
        items.spend(|| format!("command {}", i + 1))?;
        let name = value.get("do").and_then(Value::as_str).map(str::to_owned);
        match one(value, name.as_deref()) {
            Ok(command) => good.push(command),
            Err(e) => {
                let name = name.map(|name| format!(" ({name})")).unwrap_or_default();
                problems.push(format!("command {}{name}: {e}", i + 1));
            }
        }
    }
    if problems.is_empty() {
        return Ok(DriveScript { commands: good });
    }
    let place = if problems.len() == 1 { "one command".into() } else { format!("{} commands", problems.len()) };
    Err(Fault::new(place, problems.join("; ")))
}

fn one(mut value: Value, name: Option<&str>) -> Result<ScriptCommand, serde_json::Error> {
    if name == Some("import") {
        // Serde writes the word of a structure but does not read it.
        if let Some(fields) = value.as_object_mut() {
            fields.remove("do");
        }
        serde_json::from_value(value).map(ScriptCommand::Import)
    } else {
        serde_json::from_value(value).map(ScriptCommand::Document)
    }
}
