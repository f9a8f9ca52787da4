//! The generated references: what the program says about itself, as files under `docs/`.

use std::fmt::Write as _;

use clap::CommandFactory;
use fairpath_fit::{
    CubicOptions, CurvatureSpaceOptions, FitOptions, FrenchCurveOptions, LaplacianOptions, MvcOptions,
    OversketchOptions, Preset, TemplateSet,
};
use fairpath_io::{SHIPPED_TEMPLATES, shipped_templates};
use fairpath_shape::InflateOptions;
use fairpath_sketch::{Parameter, parameters_of, show_value};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

use crate::args::Cli;
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
            let name = format!("fairpath {}", verb.get_name());
            section(&name, verb.render_long_help().to_string());
            for inner in verb.get_subcommands_mut().filter(|inner| inner.get_name() != "help") {
                section(&format!("{name} {}", inner.get_name()), inner.render_long_help().to_string());
            }
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
        let _ = write!(text, " {} |", preset.name());
    }
    let _ = writeln!(text, " meaning |\n| --- | --- | --- |{} --- |", " ---: |".repeat(Preset::ALL.len()));
    for parameter in parameters_of::<FitOptions>() {
        let _ = write!(
            text,
            "| `{}` | {} | {} |",
            parameter.name,
            cell(&parameter.unit),
            cell(&parameter.kind.to_string())
        );
        let usual = &values[0][&parameter.name];
        for (i, value) in values.iter().enumerate() {
            let value = &value[&parameter.name];
            // Only what a preset changes is shown in its column.
            let shown = if i > 0 && value == usual { String::new() } else { show_value(value) };
            let _ = write!(text, " {shown} |");
        }
        let _ = writeln!(text, " {} |", cell(&parameter.description));
    }
    text.push_str(&plain_table::<CurvatureSpaceOptions>(
        "With `--method curvature-space`",
        "Sections and equations are those of McCrae and Singh (2008).",
    ));
    text.push_str(&plain_table::<FrenchCurveOptions>(
        "With `--method french-curve`",
        "Sections and equations are those of McCrae and Singh (2011).",
    ));
    let baseline = "This method serves for comparison.";
    text.push_str(&plain_table::<LaplacianOptions>("With `--method laplacian`", baseline));
    text.push_str(&plain_table::<CubicOptions>("With `--method cubic`", baseline));
    text.push_str(&plain_table::<MvcOptions>("With `--method mvc`", baseline));
    text.push_str(&plain_table::<OversketchOptions>(
        "With `fairpath oversketch`",
        "Beside those of the method of shortest paths above. Sections are those of Baran, Lehtinen and Popović (2010).",
    ));
    text.push_str(&plain_table::<InflateOptions>(
        "Of `fairpath inflate`",
        "Sections are those of Baran, Lehtinen and Popović (2010).",
    ));
    text
}

/// A section with the parameters of something that has no presets.
fn plain_table<T: JsonSchema + Serialize + Default>(title: &str, source: &str) -> String {
    let mut text = format!(
        "\n## {title}\n\n{source}\n\n\
         | parameter | unit | kind | default | meaning |\n| --- | --- | --- | ---: | --- |\n",
    );
    for Parameter { name, unit, description, kind, default } in parameters_of::<T>() {
        let (unit, kind, meaning) = (cell(&unit), cell(&kind.to_string()), cell(&description));
        let _ = writeln!(text, "| `{name}` | {unit} | {kind} | {} | {meaning} |", show_value(&default));
    }
    text
}

/// Text that is safe in a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
