//! The generated references: what the program says about itself, as files under `docs/`.

use std::fmt::Write as _;

use clap::CommandFactory;
use fairpath_fit::{CurvatureSpaceOptions, FitOptions, FrenchCurveOptions, Preset, TemplateSet};
use fairpath_io::{SHIPPED_TEMPLATES, shipped_templates};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

use crate::args::{Cli, preset_name};
use crate::parameters::{self, Parameter};
use crate::pictures;

/// Every reference: file name and text.
#[must_use]
pub fn all() -> Vec<(String, String)> {
    vec![
        ("command-line.md".into(), command_line()),
        ("parameters.md".into(), parameters_page()),
        ("templates.svg".into(), templates_page()),
    ]
}

/// The sets of French curves that come along, as `fairpath templates -o FILE.svg` draws them.
fn templates_page() -> String {
    let sets: Vec<TemplateSet> = SHIPPED_TEMPLATES.into_iter().filter_map(shipped_templates).collect();
    pictures::sets(&sets, false).to_svg().to_owned()
}

fn command_line() -> String {
    let mut text = String::from("# The command line\n\nWritten by `cargo xtask generate`.\n");
    let mut command = Cli::command().term_width(110);
    command.build();
    let mut section = |title: &str, help: String| {
        let help: Vec<&str> = help.lines().map(str::trim_end).collect();
        // Writing to a String cannot fail.
        let _ = write!(text, "\n## {title}\n\n```text\n{}\n```\n", help.join("\n").trim_end());
    };
    section("fairpath", command.render_long_help().to_string());
    for verb in command.get_subcommands_mut() {
        if verb.get_name() != "help" {
            section(&format!("fairpath {}", verb.get_name()), verb.render_long_help().to_string());
        }
    }
    text
}

fn parameters_page() -> String {
    let mut text = String::from(
        "# The fitter's parameters\n\nWritten by `cargo xtask generate`. Each can be set by `--set NAME=VALUE`; \
         sections and equations are those of Baran, Lehtinen and Popović (2010).\n\n| parameter | unit | kind |",
    );
    let values = Preset::ALL.map(|preset| serde_json::to_value(FitOptions::preset(preset)).unwrap_or(Value::Null));
    for preset in Preset::ALL {
        let _ = write!(text, " {} |", preset_name(preset));
    }
    let _ = writeln!(text, " meaning |\n| --- | --- | --- |{} --- |", " ---: |".repeat(Preset::ALL.len()));
    for parameter in parameters::all::<FitOptions>() {
        let _ = write!(text, "| `{}` | {} | {} |", parameter.name, cell(&parameter.unit), cell(&parameter.kind));
        let usual = &values[0][&parameter.name];
        for (i, value) in values.iter().enumerate() {
            let value = &value[&parameter.name];
            // Only what a preset changes is shown in its column.
            let shown = if i > 0 && value == usual { String::new() } else { parameters::show(value) };
            let _ = write!(text, " {shown} |");
        }
        let _ = writeln!(text, " {} |", cell(&parameter.description));
    }
    text.push_str(
        "\n## With `--method curvature-space`\n\nSections and equations are those of McCrae and Singh (2008).\n\n",
    );
    section_of::<CurvatureSpaceOptions>(&mut text);
    text.push_str(
        "\n## With `--method french-curve`\n\nSections and equations are those of McCrae and Singh (2011).\n\n",
    );
    section_of::<FrenchCurveOptions>(&mut text);
    text
}

/// A line for each parameter of a method without presets.
fn section_of<T: JsonSchema + Serialize + Default>(text: &mut String) {
    text.push_str("| parameter | unit | kind | default | meaning |\n| --- | --- | --- | ---: | --- |\n");
    let values = serde_json::to_value(T::default()).unwrap_or(Value::Null);
    for Parameter { name, unit, description, kind } in parameters::all::<T>() {
        let value = parameters::show(&values[&name]);
        let _ = writeln!(text, "| `{name}` | {} | {} | {value} | {} |", cell(&unit), cell(&kind), cell(&description));
    }
}

/// Text as a cell of a table can hold it.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
