//! What can be typed.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use fairpath_fit::{Closing, OversketchMode, Preset};
use fairpath_sketch::Method;

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
    /// Fit by several methods and show the results side by side
    Compare(CompareArgs),
    /// Inflate closed splines into surfaces
    Inflate(InflateArgs),
    /// Write a spline file in another format
    Convert(ConvertArgs),
    /// List, author or draw sets of French curves
    Templates(TemplatesArgs),
    /// Correct curves by strokes drawn over them
    Oversketch(OversketchArgs),
    /// Extend, cut, join and close curves, move their points, smooth and make corners
    Edit(EditArgs),
    /// Lay roads on a terrain: replay a script, or check a project
    Drive(DriveArgs),
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

    /// How to fit
    #[arg(long, value_name = "METHOD", default_value = Method::default().name(), value_parser = method())]
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

/// Arguments of `fairpath compare`.
///
/// Each method has its usual parameters. Without `-o` a table of one line per method goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct CompareArgs {
    /// Files of strokes, as for `fairpath fit`; `-` is standard input
    #[arg(value_name = "INPUT", required = true)]
    pub inputs: Vec<PathBuf>,

    /// Where the comparison goes: html, one page that shows and tells everything; svg or png, a table of pictures
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// A method to compare; may be given many times. By default all
    #[arg(long = "method", value_name = "METHOD", value_parser = method())]
    pub methods: Vec<Method>,

    /// Compare on this stroke; may be given many times. By default on all
    #[arg(long = "stroke", value_name = "NAME")]
    pub strokes: Vec<String>,

    /// French curves for the method french-curve: burmester, rectilinear, automotive, or a file; burmester by default
    #[arg(long, value_name = "SET")]
    pub templates: Option<PathBuf>,

    /// Whether the strokes are closed curves
    #[arg(long, value_name = "WHETHER", value_parser = closing())]
    pub closed: Option<Closing>,

    /// Size of one pixel of a 100 dpi screen, in the strokes' unit. By default it comes from the file's unit and dpi
    #[arg(long, value_name = "S")]
    pub pixel_size: Option<f64>,

    /// Number of threads; 0 is one for each processor. More than one make the times longer
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=1024))]
    pub threads: u16,

    /// Print the figures of each method to standard output instead of the table
    #[arg(long, value_name = "FORM")]
    pub stats: Option<Stats>,
}

/// Arguments of `fairpath inflate`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct InflateArgs {
    /// A spline file with closed splines: JSON (fairpath-spline 1), or SVG or CSV as written by fairpath; `-` is standard input
    #[arg(value_name = "SPLINE", required_unless_present = "list_parameters")]
    pub input: Option<PathBuf>,

    /// Where the surfaces go, in the format of the extension: glb (glTF 2.0), obj or png (a shaded picture); `-` is standard output.
    /// The table of one line per spline goes to standard output, unless that is taken
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Format of the output, where the extension does not say it
    #[arg(long, value_name = "FORMAT", requires = "output")]
    pub format: Option<SurfaceOutput>,

    /// Change a parameter; may be given many times. `--list-parameters` shows them all
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,

    /// Print the parameters with their units and values, and do nothing else
    #[arg(long)]
    pub list_parameters: bool,
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

/// Arguments of `fairpath drive`.
#[derive(Args, Debug)]
pub struct DriveArgs {
    /// What to do.
    #[command(subcommand)]
    pub verb: DriveVerb,
}

/// The verbs of `fairpath drive`.
#[derive(Subcommand, Debug)]
pub enum DriveVerb {
    /// Do the commands of a script, tell about each path, and write what came of them
    Run(DriveRunArgs),
    /// List what breaks the rules of design in a project
    Check(DriveCheckArgs),
    /// Volumes of cut and fill along a path, and what is to be hauled, as CSV
    Earthwork(DriveEarthworkArgs),
    /// Drive along a path: where the vehicle is, how it heads and how fast it is, over time, as CSV
    Play(DrivePlayArgs),
    /// Draw a picture of a network
    Render(DriveRenderArgs),
}

/// Arguments of `fairpath drive run`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct DriveRunArgs {
    /// The commands: JSON (fairpath-drive-script 1), or a project; files that it names lie beside it; `-` is standard
    /// input
    #[arg(value_name = "SCRIPT")]
    pub script: PathBuf,

    /// Where the project goes, to be opened again
    #[arg(long, value_name = "FILE")]
    pub project: Option<PathBuf>,

    /// Where an export goes, in the format of the extension; may be given many times
    #[arg(long, value_name = "FILE")]
    pub export: Vec<PathBuf>,

    /// Also tell how long each command took
    #[arg(long)]
    pub times: bool,
}

/// Arguments of `fairpath drive check`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct DriveCheckArgs {
    /// The project, or a script
    #[arg(value_name = "PROJECT")]
    pub project: PathBuf,

    /// End with 1 if a rule is broken
    #[arg(long)]
    pub strict: bool,
}

/// Arguments of `fairpath drive play`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct DrivePlayArgs {
    /// The project, or a script
    #[arg(value_name = "PROJECT")]
    pub project: PathBuf,

    /// The name of the path
    #[arg(long, value_name = "NAME")]
    pub path: String,

    /// Where the drive begins, metres from the path's start; a drive from a greater station to a lesser one goes back
    #[arg(long, value_name = "M", default_value_t = 0.0)]
    pub from: f64,

    /// Where it ends; by default at the path's end
    #[arg(long, value_name = "M")]
    pub to: Option<f64>,

    /// At intersections at the path's end, go on along the straightest way
    #[arg(long)]
    pub on: bool,

    /// Seconds from one row to the next
    #[arg(long, value_name = "S", default_value_t = 0.1)]
    pub step: f64,

    /// Also tell where this camera stands and what it looks at
    #[arg(long, value_name = "CAMERA")]
    pub camera: Option<CameraName>,

    /// Where the table goes; standard output by default
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    pub output: PathBuf,
}

/// Arguments of `fairpath drive earthwork`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct DriveEarthworkArgs {
    /// The project, or a script
    #[arg(value_name = "PROJECT")]
    pub project: PathBuf,

    /// Only this path
    #[arg(long, value_name = "NAME")]
    pub path: Option<String>,

    /// Metres from one row to the next
    #[arg(long, value_name = "M", default_value_t = 20.0)]
    pub every: f64,

    /// Where the table goes; standard output by default
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    pub output: PathBuf,
}

/// Arguments of `fairpath drive render`.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES)]
pub struct DriveRenderArgs {
    /// The project, or a script
    #[arg(value_name = "PROJECT")]
    pub project: PathBuf,

    /// Where the picture goes (PNG); `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    /// From where it is taken
    #[arg(long, value_name = "CAMERA", default_value = "birdseye")]
    pub camera: ViewName,

    /// Its width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = picture_size)]
    pub size: [usize; 2],
}

/// Two numbers with an x between them.
fn picture_size(text: &str) -> Result<[usize; 2], String> {
    let sides: Vec<Option<usize>> = text.split('x').map(|side| side.parse().ok()).collect();
    match sides[..] {
        [Some(width), Some(height)] => Ok([width, height]),
        _ => Err("expected width and height in pixels, such as 1280x720".to_owned()),
    }
}

/// From where a picture of a network is taken.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewName {
    /// All of it, from high above
    Birdseye,
    /// The middle of it, from half as far and lower
    Midway,
    /// A bridge, a tunnel or an intersection, from near by
    Closeup,
    /// From the driver's seat, in the middle of the first path
    Driver,
}

/// From where a drive is seen.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraName {
    /// Through the driver's eyes
    Driver,
    /// From behind and a little above
    Chase,
    /// From above
    Aerial,
    /// From the left side
    Side,
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

/// The formats that surfaces are written in.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceOutput {
    /// glTF 2.0 in one binary file, in metres; a px is a hundredth of an inch
    Glb,
    /// Wavefront OBJ, in the file's unit
    Obj,
    /// A shaded picture
    Png,
}

/// The forms of figures.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stats {
    /// One JSON document
    Json,
}

fn method() -> impl TypedValueParser<Value = Method> {
    let described = Method::ALL.map(|method| PossibleValue::new(method.name()).help(method.about()));
    PossibleValuesParser::new(described).try_map(|text| Method::from_name(&text).ok_or("no method of that name"))
}

fn preset() -> impl TypedValueParser<Value = Preset> {
    PossibleValuesParser::new(Preset::ALL.map(Preset::name))
        .try_map(|text| Preset::from_name(&text).ok_or("no preset of that name"))
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
}
