//! What can be typed.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use fairpath_fit::{Closing, OversketchMode, Preset};

/// From a rough stroke to a fair curve of lines, arcs and clothoids.
#[derive(Parser, Debug)]
#[command(name = "fairpath", version, propagate_version = true, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "\
Exit codes: 0 all done; 1 some stroke failed, or --strict and a tolerance was missed;
2 unusable arguments or input. Output files are written whole or not at all.";

/// The verbs.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Fit a fair curve to each stroke
    Fit(FitArgs),
    /// Write a spline file in another format
    Convert(ConvertArgs),
    /// Correct curves by strokes drawn over them
    Oversketch(OversketchArgs),
    /// Extend, cut, join and close curves, move their points, smooth and make corners
    Edit(EditArgs),
}

/// Arguments of `fairpath fit`.
///
/// Without `-o` a table of one line per stroke goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct FitArgs {
    /// Files of strokes: JSON (fairpath-strokes 1), SVG, InkML, GPX, GeoJSON, or CSV and text of rows
    /// `x y [t [pressure]]` with a blank line between strokes; `-` is standard input
    #[arg(value_name = "INPUT", required_unless_present = "list_parameters")]
    pub inputs: Vec<PathBuf>,

    /// Where the curves go, in the format of the extension: json, svg, dxf, csv or png; `-` is standard output.
    /// Without it, a table of one line per stroke goes to standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Format of the output, where the extension does not say it
    #[arg(long, value_name = "FORMAT", requires = "output")]
    pub format: Option<OutputFormat>,

    /// Write DXF with the y axis turned up where the strokes have it down, so that the drawing looks as drawn
    #[arg(long)]
    pub flip_y: bool,

    /// How to fit: `shortest-path` (Baran, Lehtinen and Popović 2010) or `curvature-space` (McCrae and Singh 2008)
    #[arg(long, value_name = "METHOD", default_value = "shortest-path", value_parser = method)]
    pub method: Method,

    /// The set of parameters to start from
    #[arg(long, value_name = "PRESET", default_value = "default", value_parser = preset())]
    pub preset: Preset,

    /// Change a parameter; may be given many times, and wins over the preset and the other options.
    /// `--list-parameters` shows them all
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,

    /// Whether the strokes are closed curves
    #[arg(long, value_name = "WHETHER", value_parser = closing())]
    pub closed: Option<Closing>,

    /// Size of one pixel of a 100 dpi screen, in the strokes' unit: all lengths among the parameters are multiplied by
    /// it. By default it comes from the file's unit and dpi
    #[arg(long, value_name = "S")]
    pub pixel_size: Option<f64>,

    /// Number of threads; 0 is one for each processor. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=1024))]
    pub threads: u16,

    /// End with exit code 1 if a curve is further than `max_error` from its stroke, or none was found that is not
    #[arg(long)]
    pub strict: bool,

    /// Also draw a picture (svg or png): stroke, lines red, arcs green, clothoids blue, joins, corners, curvature comb
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,

    /// Lay the strokes of the picture out side by side, each scaled to fit
    #[arg(long, requires = "picture")]
    pub sheet: bool,

    /// Also draw the steps of the method for each stroke, as pictures in this folder
    #[arg(long, value_name = "DIR")]
    pub stages: Option<PathBuf>,

    /// Print the parameters with their units and the values that the other options give them, and do nothing else
    #[arg(long)]
    pub list_parameters: bool,

    /// Leave the times out of the report, so that the same input always gives the same bytes
    #[arg(long)]
    pub no_times: bool,

    /// Print the figures of each fit to standard output instead of the table
    #[arg(long, value_name = "FORM")]
    pub stats: Option<Stats>,
}

/// Arguments of `fairpath convert`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct ConvertArgs {
    /// A spline file: JSON (fairpath-spline 1), or SVG or CSV as written by fairpath; `-` is standard input
    #[arg(value_name = "IN")]
    pub input: PathBuf,

    /// Where it goes, in the format of the extension: json, svg, dxf, csv or png; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    /// Format of the output, where the extension does not say it
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<OutputFormat>,

    /// Write DXF with the y axis turned up where the strokes have it down, so that the drawing looks as drawn
    #[arg(long)]
    pub flip_y: bool,
}

/// Arguments of `fairpath oversketch`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct OversketchArgs {
    /// The curves: JSON (fairpath-spline 1), or SVG or CSV as written by fairpath; `-` is standard input
    #[arg(value_name = "SPLINE")]
    pub splines: PathBuf,

    /// The strokes drawn over them, in any format that `fairpath fit` reads; they are applied in order
    #[arg(value_name = "STROKE")]
    pub strokes: PathBuf,

    /// Where all curves go, in the format of the extension: json, svg, dxf, csv or png; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    /// Format of the output, where the extension does not say it
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<OutputFormat>,

    /// Write DXF with the y axis turned up where the strokes have it down, so that the drawing looks as drawn
    #[arg(long)]
    pub flip_y: bool,

    /// The curve that is meant; without it, each stroke corrects the one that it lies on
    #[arg(long, value_name = "NAME")]
    pub spline: Option<String>,

    /// `shortest-path`: what is replaced and a little beside it is fitted anew (Baran, Lehtinen and Popović 2010); `refit`: the whole
    /// curve is; `local-blend`: the stroke is fitted by itself and blended in (both McCrae and Singh 2008)
    #[arg(long, value_name = "MODE", default_value = "shortest-path", value_parser = oversketch_mode())]
    pub mode: OversketchMode,

    /// The set of parameters to start from
    #[arg(long, value_name = "PRESET", default_value = "default", value_parser = preset())]
    pub preset: Preset,

    /// Change a parameter of oversketching or of fitting; may be given many times. `docs/parameters.md` lists them all
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,

    /// Size of one pixel of a 100 dpi screen, in the strokes' unit: all lengths among the parameters are multiplied by
    /// it. By default it comes from the strokes' unit and dpi
    #[arg(long, value_name = "S")]
    pub pixel_size: Option<f64>,

    /// Also draw a picture (svg or png) with a row for each stroke: what it replaces, the integrated stroke, the result
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,
}

/// Arguments of `fairpath edit`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct EditArgs {
    /// The curves: JSON (fairpath-spline 1), or SVG or CSV as written by fairpath; `-` is standard input
    #[arg(value_name = "SPLINE")]
    pub splines: PathBuf,

    /// What to do: JSON (fairpath-edits 1), in order
    #[arg(value_name = "EDITS")]
    pub edits: PathBuf,

    /// Where all curves go, in the format of the extension: json, svg, dxf, csv or png; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    /// Format of the output, where the extension does not say it
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<OutputFormat>,

    /// Write DXF with the y axis turned up where the strokes have it down, so that the drawing looks as drawn
    #[arg(long)]
    pub flip_y: bool,
}

/// The formats that curves are written in.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputFormat {
    /// fairpath-spline 1: everything, exactly
    Json,
    /// A drawing of cubic Béziers
    Svg,
    /// A drawing for CAD
    Dxf,
    /// A row for each segment
    Csv,
    /// A picture
    Png,
}

/// The forms of figures.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stats {
    /// One JSON document
    Json,
}

/// The methods that exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Baran, Lehtinen and Popović (2010).
    ShortestPath,
    /// McCrae and Singh (2008).
    CurvatureSpace,
}

impl Method {
    /// Its name here and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ShortestPath => "shortest-path",
            Self::CurvatureSpace => "curvature-space",
        }
    }
}

fn method(text: &str) -> Result<Method, String> {
    let methods = [Method::ShortestPath, Method::CurvatureSpace];
    if let Some(method) = methods.into_iter().find(|method| method.name() == text) {
        return Ok(method);
    }
    Err(match text {
        "french-curve" | "laplacian" | "cubic" | "mvc" => {
            format!("the method {text} is not part of this version; use shortest-path or curvature-space")
        }
        _ => "there is no method of that name; use shortest-path or curvature-space".to_owned(),
    })
}

/// The word for a preset, here and in files.
#[must_use]
pub fn preset_name(preset: Preset) -> &'static str {
    match preset {
        Preset::Default => "default",
        Preset::Accurate => "accurate",
        Preset::Loose => "loose",
        Preset::LinesArcs => "lines-arcs",
        Preset::Polyline => "polyline",
        Preset::Clothoids => "clothoids",
        Preset::Paper => "paper",
    }
}

fn preset() -> impl TypedValueParser<Value = Preset> {
    PossibleValuesParser::new(Preset::ALL.map(preset_name)).try_map(|text| {
        Preset::ALL.into_iter().find(|&preset| preset_name(preset) == text).ok_or("no preset of that name")
    })
}

fn oversketch_mode() -> impl TypedValueParser<Value = OversketchMode> {
    PossibleValuesParser::new(["shortest-path", "refit", "local-blend"]).map(|text| match text.as_str() {
        "refit" => OversketchMode::Refit,
        "local-blend" => OversketchMode::LocalBlend,
        _ => OversketchMode::ShortestPath,
    })
}

fn closing() -> impl TypedValueParser<Value = Closing> {
    PossibleValuesParser::new(["auto", "yes", "no"]).map(|text| match text.as_str() {
        "yes" => Closing::Yes,
        "no" => Closing::No,
        _ => Closing::Auto,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn presets_have_the_names_that_files_use() {
        for preset in Preset::ALL {
            assert_eq!(serde_json::to_value(preset).unwrap(), preset_name(preset));
        }
    }
}
