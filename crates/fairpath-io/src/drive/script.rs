//! `fairpath-drive-script 1`: commands to a document as JSON, in the order in which they are to be done.

use super::import::Import;
use crate::error::{Error, Fault};
use crate::input::{read_all, text};
use crate::limits::ReadOptions;
use crate::listed::Listed;
use fairpath_drive::{Command, Play};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::io::Read;

/// The word in the file's `format`.
const FORMAT: &str = "fairpath-drive-script";

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

/// A command of a script: one to the document, one that becomes several, or one that shows it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ScriptCommand {
    /// A command to the document.
    Document(Command),
    /// Lines of a file, each of which is sketched.
    Import(Import),
    /// A drive, for whoever shows the document.
    Play(Play),
}

/// A script.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriveScript {
    /// What is to be done, in order.
    pub commands: Vec<ScriptCommand>,
}

/// The script that `reader` gives; `name` stands for the file in messages.
///
/// # Errors
/// When the file goes beyond the limits or breaks the format's rules; every command with a problem is named.
pub fn read_drive_script_from(reader: impl Read, name: &str, options: &ReadOptions) -> Result<DriveScript, Error> {
    let parsed = || {
        let bytes = read_all(reader, &options.limits)?;
        let listed = Listed { format: FORMAT, list: "commands", one: "command" };
        let commands = text(&bytes).and_then(|text| listed.parse(text, &options.limits, one))?;
        Ok(DriveScript { commands })
    };
    parsed().map_err(|fault: Fault| fault.in_file(name))
}

fn one(mut value: Value, name: Option<&str>) -> Result<ScriptCommand, serde_json::Error> {
    let Some(word @ ("import" | "play")) = name else {
        return serde_json::from_value(value).map(ScriptCommand::Document);
    };
    // Serde writes the word of a structure but does not read it.
    if let Some(fields) = value.as_object_mut() {
        fields.remove("do");
    }
    if word == "import" {
        serde_json::from_value(value).map(ScriptCommand::Import)
    } else {
        serde_json::from_value(value).map(ScriptCommand::Play)
    }
}
