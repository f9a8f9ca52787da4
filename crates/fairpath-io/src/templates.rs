//! Sets of French curves from and to files: their own format, splines that were fitted, and drawings.

use crate::atomic::write_whole;
use crate::error::{Error, Fault};
use crate::input::{Budget, extension, first_byte, label, open, read_all, text};
use crate::limits::{Limits, ReadOptions};
use crate::spline_file::SplineFile;
use crate::strokes_svg::read_subpaths;
use crate::templates_json::{Shape, Shapes};
use crate::{drawn_spline, spline_csv, spline_json, spline_svg, templates_json};
use fairpath_curve::Similarity;
use fairpath_fit::{Template, TemplateError, TemplateSet, Warning};
use serde::Deserialize;
use std::io::Read;
use std::path::Path;

/// How to read French curves.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TemplateOptions {
    /// How to read the file; `flatten_tolerance` does not count.
    pub read: ReadOptions,
    /// Size of a pixel of a 100 dpi screen in the file's unit, by which all lengths are divided; by default as
    /// [`Unit::pixel_size`](crate::Unit::pixel_size) says.
    pub pixel_size: Option<f64>,
    /// Largest distance between a Bézier of a drawing and the clothoids that stand for it, px. Default 0.05.
    pub accuracy_px: f64,
}

impl Default for TemplateOptions {
    fn default() -> Self {
        Self { read: ReadOptions::default(), pixel_size: None, accuracy_px: 0.05 }
    }
}

/// A set of French curves as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct TemplateFile {
    /// The set, in px.
    pub set: TemplateSet,
    /// What in the file was left out.
    pub warnings: Vec<Warning>,
}

/// The French curves of a file; `-` is standard input. The extension tells the format, else the content does.
///
/// Read are
/// - `fairpath-templates 1`;
/// - splines, as JSON (`fairpath-spline 1`), CSV or SVG written by fairpath: each becomes a French curve of its name. That is how one is
///   authored from a stroke;
/// - any other SVG: each subpath of path, polyline, polygon and line becomes a French curve, named by its element's id. Straight lines and
///   circular arcs stay what they are, other Béziers become clothoids within `accuracy_px` with the heading and curvature that the Bézier
///   has at their ends; where the path's direction turns by more than 2 degrees there is a corner. Nothing is smoothed: what a Bézier path does
///   at its nodes, the template does too. Fit the drawing first if that is not wanted.
///
/// # Errors
/// When the file cannot be opened, is of no format that is read, breaks its format's rules or goes beyond the limits; when the pixel size
/// is not positive; [`Error::Templates`] with *every* shape that cannot be a French curve.
pub fn read_templates(path: &Path, options: &TemplateOptions) -> Result<TemplateFile, Error> {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let name = stem.filter(|stem| stem != "-").unwrap_or_else(|| "standard input".into());
    read_named(open(path)?, &label(path), &name, Some(extension(path)), options)
}

/// The French curves that `reader` gives. `name` stands for the file in messages; the content tells the format.
///
/// # Errors
/// As [`read_templates`].
pub fn read_templates_from(reader: impl Read, name: &str, options: &TemplateOptions) -> Result<TemplateFile, Error> {
    read_named(reader, name, name, None, options)
}

/// The formats that French curves are read from.
#[derive(Clone, Copy)]
enum Form {
    Json,
    Svg,
    Csv,
}

fn read_named(
    reader: impl Read,
    file: &str,
    set_name: &str,
    extension: Option<String>,
    options: &TemplateOptions,
) -> Result<TemplateFile, Error> {
    let bytes = read_all(reader, &options.read.limits).map_err(|fault| fault.in_file(file))?;
    let by_name = match extension.as_deref() {
        Some("json") => Some(Form::Json),
        Some("svg") => Some(Form::Svg),
        Some("csv") => Some(Form::Csv),
        _ => None,
    };
    let by_content = || match first_byte(&bytes) {
        Some(b'{') => Some(Form::Json),
        Some(b'<') => Some(Form::Svg),
        Some(b'#' | b'n' | b'"') => Some(Form::Csv),
        _ => None,
    };
    let Some(form) = by_name.or_else(by_content) else {
        let problem = match first_byte(&bytes) {
            None => "the file is empty".into(),
            Some(byte) => format!("nothing known begins with {:?}", char::from(byte)),
        };
        let expected = "French curves as JSON (fairpath-templates 1), splines (JSON, CSV), or a drawing (SVG)";
        return Err(Error::UnknownFormat { file: file.into(), problem, expected });
    };
    let parse = || {
        let text = text(&bytes)?;
        let (shapes, warnings) = shapes(text, form, options)?;
        let set = assemble(shapes, set_name, options)?;
        Ok(TemplateFile { set, warnings })
    };
    parse().map_err(|fault: Fault| fault.in_file(file))
}

fn shapes(text: &str, form: Form, options: &TemplateOptions) -> Result<(Shapes, Vec<Warning>), Fault> {
    let read = &options.read;
    match form {
        Form::Json if format_of(text).is_some_and(|format| format == "fairpath-spline") => {
            of_splines(spline_json::read(text, read)?, &read.limits)
        }
        Form::Json => Ok((templates_json::read(text, &read.limits)?, Vec::new())),
        Form::Csv => of_splines(spline_csv::read(text, read)?, &read.limits),
        Form::Svg if text.contains(spline_svg::NAMESPACE) => of_splines(spline_svg::read(text, read)?, &read.limits),
        Form::Svg => of_drawing(text, options),
    }
}

/// What a JSON file says that it is.
fn format_of(text: &str) -> Option<String> {
    #[derive(Deserialize)]
    struct Head {
        format: String,
    }
    serde_json::from_str(text).ok().map(|head: Head| head.format)
}

/// Each spline is a shape.
fn of_splines(file: SplineFile, limits: &Limits) -> Result<(Shapes, Vec<Warning>), Fault> {
    let mut budget = Budget::templates(limits);
    let mut shapes = Vec::new();
    for (i, entry) in file.splines.into_iter().enumerate() {
        let place = format!("spline {} {:?}", i + 1, entry.name);
        budget.spend(|| place.clone())?;
        shapes.push(Shape { name: entry.name, place, spline: Ok(entry.spline) });
    }
    Ok((Shapes { name: None, unit: file.unit, shapes }, file.warnings))
}

/// Each subpath of a drawing is a shape.
fn of_drawing(text: &str, options: &TemplateOptions) -> Result<(Shapes, Vec<Warning>), Fault> {
    let (file, subpaths) = read_subpaths(text, &options.read)?;
    let accuracy = options.accuracy_px * options.pixel_size.unwrap_or(file.unit.pixel_size());
    let mut budget = Budget::templates(&options.read.limits);
    let mut shapes = Vec::new();
    for subpath in subpaths {
        budget.spend(|| subpath.place.clone())?;
        let spline = drawn_spline::follow(&subpath.path, accuracy).map_err(|problem| vec![problem]);
        shapes.push(Shape { name: subpath.name, place: subpath.place, spline });
    }
    Ok((Shapes { name: None, unit: file.unit, shapes }, file.warnings))
}

/// The set that the shapes make, or all that is wrong with them.
fn assemble(shapes: Shapes, set_name: &str, options: &TemplateOptions) -> Result<TemplateSet, Fault> {
    let pixel_size = options.pixel_size.unwrap_or(shapes.unit.pixel_size());
    if !(pixel_size.is_finite() && pixel_size > 0.0) {
        let problem =
            format!("it is {pixel_size}; expected a number above 0, the size of a screen's pixel in the file's unit");
        return Err(Fault::new("the pixel size", problem));
    }
    let mut problems = Vec::new();
    let mut templates: Vec<Template> = Vec::new();
    for Shape { name, place, spline } in shapes.shapes {
        let spline = match spline {
            // Lengths in px stay what they are, to the bit.
            Ok(spline) if pixel_size == 1.0 => spline,
            Ok(spline) => spline.transformed(&Similarity::scale(1.0 / pixel_size)),
            Err(found) => {
                problems.extend(found.into_iter().map(|problem| format!("{place}: {problem}")));
                continue;
            }
        };
        match Template::new(name, spline) {
            Ok(template) if templates.iter().any(|other| other.name() == template.name()) => {
                let same = TemplateError::SameName { name: template.name().into() };
                problems.push(format!("{place}: {same}"));
            }
            Ok(template) => templates.push(template),
            Err(problem) => problems.push(format!("{place}: {problem}")),
        }
    }
    if !problems.is_empty() {
        return Err(Fault::Templates(problems));
    }
    let name = shapes.name.unwrap_or_else(|| set_name.into());
    TemplateSet::new(name, templates).map_err(|problem| Fault::Templates(vec![problem.to_string()]))
}

/// The set as `fairpath-templates 1`.
///
/// # Errors
/// [`Error::Unwritable`] when JSON cannot hold it.
pub fn encode_templates(set: &TemplateSet) -> Result<Vec<u8>, Error> {
    templates_json::write(set)
}

/// Writes the set as `fairpath-templates 1`, whole or not at all.
///
/// # Errors
/// As [`encode_templates`]; [`Error::Write`] when the file cannot be written.
pub fn write_templates(path: &Path, set: &TemplateSet) -> Result<(), Error> {
    write_whole(path, &encode_templates(set)?)
}

/// The names of the sets that come with the library.
pub const SHIPPED_TEMPLATES: [&str; 3] = ["burmester", "rectilinear", "automotive"];

/// One of the sets that come with the library, if that is the name of one.
///
/// `burmester`: four closed French curves whose bends run from a radius of 9 px to straight; `rectilinear`: lines and right angles;
/// `automotive`: circles, arches and long sweeps without anything straight. Drawn by the example `draw_templates`.
#[must_use]
pub fn shipped_templates(name: &str) -> Option<TemplateSet> {
    let text = match name {
        "burmester" => include_str!("../templates/burmester.json"),
        "rectilinear" => include_str!("../templates/rectilinear.json"),
        "automotive" => include_str!("../templates/automotive.json"),
        _ => return None,
    };
    read_templates_from(text.as_bytes(), name, &TemplateOptions::default()).ok().map(|file| file.set)
}
