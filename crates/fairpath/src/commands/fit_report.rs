//! What `fairpath fit` says about its results.

use anyhow::{Context, Result};
use fairpath_curve::{Continuity, Kind};
use fairpath_io::{SplineEntry, SplineFile};
use fairpath_sketch::{Parameter, show_value};
use serde_json::{Value, json};

use super::method_options::MethodOptions;
use crate::args::OutputFormat;
use crate::pictures;
use crate::printer::{Printer, columns};

/// Warnings beyond this many are only counted: a thousand strokes would bury what matters.
const MOST_NOTES: usize = 20;

/// A line for each parameter: name, value, unit, kind, meaning.
pub(crate) fn parameters(options: &MethodOptions) -> String {
    let (list, values) = options.listed();
    listed(&list, &values)
}

/// The same for any parameters with their values.
pub(crate) fn listed(list: &[Parameter], values: &Value) -> String {
    let head: Vec<String> =
        list.iter().map(|parameter| format!("{} = {}", parameter.name, show_value(&values[&parameter.name]))).collect();
    let width = head.iter().map(|text| text.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for (parameter, head) in list.iter().zip(head) {
        let unit = if parameter.unit.is_empty() { parameter.kind.to_string() } else { parameter.unit.clone() };
        text.push_str(&format!("{head:<width$}  [{unit}] {}\n", parameter.description));
    }
    text
}

/// A line for each stroke.
pub(crate) fn table(file: &SplineFile) -> String {
    let header =
        ["stroke", "points", "segments", "L/A/C", "corners", "inflections", "max dev", "rms dev", "ms", "notes"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    rows.extend(file.splines.iter().map(row));
    rows.extend(file.failures.iter().map(|failure| vec![plain(&failure.name), format!("failed: {}", failure.code)]));
    columns(&rows)
}

fn row(entry: &SplineEntry) -> Vec<String> {
    let segments = entry.spline.segments();
    let count = |kind: Kind| segments.iter().filter(|segment| segment.kind() == kind).count();
    let corners = entry.spline.joins().iter().filter(|join| **join == Continuity::G0).count();
    let report = entry.report.clone().unwrap_or_default();
    vec![
        plain(&entry.name),
        report.figures.points.to_string(),
        segments.len().to_string(),
        format!("{}/{}/{}", count(Kind::Line), count(Kind::Arc), count(Kind::Clothoid)),
        corners.to_string(),
        report.figures.inflections.to_string(),
        format!("{:.3}", report.figures.max_deviation),
        format!("{:.3}", report.figures.rms_deviation),
        report.ms.map_or("-".into(), |ms| format!("{:.2}", ms.total)),
        entry.warnings.iter().map(|warning| warning.code.as_str()).collect::<Vec<_>>().join(" "),
    ]
}

/// The figures alone: the spline file without its curves.
///
/// # Errors
/// When a figure cannot be written.
pub(crate) fn figures(file: &SplineFile) -> Result<String> {
    let (bytes, _) = pictures::encode(file, None, OutputFormat::Json, false)?;
    let whole: Value = serde_json::from_slice(&bytes).context("the figures cannot be read back")?;
    let strokes: Vec<Value> = whole["splines"]
        .as_array()
        .into_iter()
        .flatten()
        .map(|spline| {
            json!({
                "name": spline["name"], "closed": spline["closed"],
                "segments": spline["segments"].as_array().map_or(0, Vec::len),
                "report": spline["report"], "warnings": spline["warnings"],
            })
        })
        .collect();
    let text = serde_json::to_string_pretty(&json!({"strokes": strokes, "failures": whole["failures"]}))?;
    Ok(text + "\n")
}

/// A sentence for each stroke that failed.
pub(crate) fn failures(file: &SplineFile) -> impl Iterator<Item = String> + '_ {
    file.failures.iter().map(|failure| format!("{}: {}", plain(&failure.name), failure.text))
}

/// A sentence for each warning about a curve.
pub(crate) fn warnings(file: &SplineFile) -> impl Iterator<Item = String> + '_ {
    let of = |entry: &SplineEntry| {
        let name = plain(&entry.name);
        entry.warnings.iter().map(|warning| format!("{name}: {}", warning.text)).collect::<Vec<_>>()
    };
    file.splines.iter().flat_map(of)
}

/// Sentences on standard error, but not too many.
pub(crate) fn notes(mut notes: impl Iterator<Item = String>, printer: &mut Printer) {
    for note in notes.by_ref().take(MOST_NOTES) {
        printer.note(&note);
    }
    let more = notes.count();
    if more > 0 {
        printer.note(&format!("… and {more} more of these"));
    }
}

/// A name without what would upset a terminal.
pub(crate) fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}
