//! What can be typed.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use fairpath_fit::{Closing, Preset};

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
    /// List, author or draw sets of French curves
    Templates(TemplatesArgs),
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

    /// How to fit: `shortest-path` (Baran, Lehtinen and Popović 2010), `curvature-space` (McCrae and Singh 2008) or
    /// `french-curve` (McCrae and Singh 2011)
    #[arg(long, value_name = "METHOD", default_value = "shortest-path", value_parser = method)]
    pub method: Method,

    /// French curves for the method french-curve: burmester, rectilinear, automotive, or a file (see `fairpath
    /// templates`); burmester by default
    #[arg(long, value_name = "SET")]
    pub templates: Option<PathBuf>,

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

    /// Show in the picture how the French curves lie over the strokes and which part of each was used
    #[arg(long, requires = "picture", conflicts_with = "sheet")]
    pub templates_shown: bool,

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

/// Arguments of `fairpath templates`.
///
/// Without `-o` a table of one line per French curve goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct TemplatesArgs {
    /// Sets of French curves: burmester, rectilinear, automotive, or files. A file may be a set (fairpath-templates 1), splines
    /// as `fairpath fit` writes them (JSON, SVG, CSV; each becomes a French curve), or a drawing (SVG; each subpath
    /// does); `-` is standard input. Without any, the sets that come along
    #[arg(value_name = "SET")]
    pub inputs: Vec<PathBuf>,

    /// Where they go: as json, the French curves of all inputs as one set; as svg or png, a picture of each set; `-` is
    /// standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Format of the output, where the extension does not say it
    #[arg(long, value_name = "FORMAT", requires = "output")]
    pub format: Option<OutputFormat>,

    /// What the set is called; by default as the input, or as the output if there are several inputs
    #[arg(long, value_name = "NAME", requires = "output")]
    pub name: Option<String>,

    /// Size of one pixel of a 100 dpi screen, in the files' unit: all lengths are divided by it, since those of French
    /// curves are in px. By default it comes from each file's unit
    #[arg(long, value_name = "S")]
    pub pixel_size: Option<f64>,

    /// Draw the curvature comb in the picture
    #[arg(long, requires = "output")]
    pub comb: bool,
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
    /// McCrae and Singh (2011).
    FrenchCurve,
}

impl Method {
    /// Its name here and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ShortestPath => "shortest-path",
            Self::CurvatureSpace => "curvature-space",
            Self::FrenchCurve => "french-curve",
        }
    }
}

fn method(text: &str) -> Result<Method, String> {
    const KNOWN: &str = "use shortest-path, curvature-space or french-curve";
    let methods = [Method::ShortestPath, Method::CurvatureSpace, Method::FrenchCurve];
    if let Some(method) = methods.into_iter().find(|method| method.name() == text) {
        return Ok(method);
    }
    Err(match text {
        "laplacian" | "cubic" | "mvc" => format!("the method {text} is not part of this version; {KNOWN}"),
        _ => format!("there is no method of that name; {KNOWN}"),
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
