//! JSON schemas of our own formats, made from the types that write them.

use crate::drive::ScriptRecord;
use crate::edits::EditsRecord;
use crate::spline_json::SplinesRecord;
use crate::strokes_json::StrokesRecord;
use crate::templates_json::TemplatesRecord;
use schemars::{JsonSchema, generate::SchemaSettings};

/// The JSON schema (draft 2020-12) of `fairpath-strokes 1`.
#[must_use]
pub fn strokes_schema() -> String {
    schema::<StrokesRecord<'_>>()
}

/// The JSON schema (draft 2020-12) of `fairpath-spline 1`.
#[must_use]
pub fn spline_schema() -> String {
    schema::<SplinesRecord>()
}

/// The JSON schema (draft 2020-12) of `fairpath-templates 1`.
#[must_use]
pub fn templates_schema() -> String {
    schema::<TemplatesRecord>()
}

/// The JSON schema (draft 2020-12) of `fairpath-edits 1`.
#[must_use]
pub fn edits_schema() -> String {
    schema::<EditsRecord>()
}

/// The JSON schema (draft 2020-12) of `fairpath-drive-script 1`.
#[must_use]
pub fn drive_script_schema() -> String {
    schema::<ScriptRecord>()
}

fn schema<T: JsonSchema>() -> String {
    let schema = SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<T>();
    let text = serde_json::to_string_pretty(&schema).expect("a schema is JSON");
    text + "\n"
}
