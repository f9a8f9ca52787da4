//! `fairpath oversketch`: curves corrected by strokes drawn over them.

use anyhow::{Result, bail};
use fairpath_curve::Spline;
use fairpath_fit::{FitOptions, OversketchOptions, Oversketched, Stroke, oversketch, oversketch_region};
use fairpath_io::picture::Correction;
use fairpath_io::{ReadOptions, SplineFile, StrokeFile, read_splines, read_strokes};
use fairpath_sketch::parameters_of;

use super::Ending;
use super::fit_inputs::pixel_size;
use super::fit_report::plain;
use crate::args::{OutputFormat, OversketchArgs};
use crate::output::{Destination, Ready};
use crate::printer::Printer;
use crate::{interrupt, pictures, settings};

/// A stroke that was applied.
struct Done<'a> {
    title: String,
    before: Spline,
    stroke: &'a Stroke,
    result: Oversketched,
}

pub(crate) fn run(args: &OversketchArgs, printer: &mut Printer) -> Result<Ending> {
    let to = Destination::new(&args.output, args.format)?;
    let picture = args.picture.as_deref().map(|path| Destination::new(path, None)).transpose()?;
    if let Some(picture) = &picture {
        if !matches!(picture.format, OutputFormat::Svg | OutputFormat::Png) {
            bail!("{}: a picture is written as svg or png", picture.path.display());
        }
        if picture.path == to.path {
            bail!("{}: -o and --picture name the same file", picture.path.display());
        }
    }
    interrupt::install();
    if args.splines.as_os_str() == "-" && args.strokes.as_os_str() == "-" {
        bail!("standard input (-) can be read only once");
    }
    let mut file = read_splines(&args.splines, &ReadOptions::default())?;
    let strokes = read_strokes(&args.strokes, &ReadOptions::default())?;
    let options = options(args, &strokes)?;
    check(args, &file, &strokes)?;

    let (mut done, mut failed) = (Vec::new(), false);
    for stroke in &strokes.strokes {
        match apply(&mut file, stroke, args.spline.as_deref(), &options) {
            Ok(applied) => {
                for warning in &applied.result.warnings {
                    printer.note(&format!("{}: {}", plain(&stroke.name), warning.text));
                }
                done.push(applied);
            }
            Err(problem) => {
                failed = true;
                printer.note(&format!("{}: {problem}", plain(&stroke.name)));
            }
        }
    }
    let mut ready = Ready::default();
    let (bytes, warnings) = pictures::encode(&file, None, to.format, args.flip_y)?;
    ready.add(&to.path, bytes);
    for warning in warnings {
        printer.note(&format!("{}: {}", to.path.display(), warning.text));
    }
    if let Some(picture) = picture {
        let rows: Vec<Correction<'_>> = done
            .iter()
            .map(|d| Correction { name: &d.title, before: &d.before, stroke: d.stroke, result: &d.result })
            .collect();
        ready.add(&picture.path, pictures::corrections(&rows, file.y, picture.format == OutputFormat::Png)?);
    }
    ready.write()?;
    Ok(if failed { Ending::SomeFailed } else { Ending::Done })
}

/// The options that the arguments ask for. A parameter belongs to oversketching or to fitting.
fn options(args: &OversketchArgs, strokes: &StrokeFile) -> Result<OversketchOptions> {
    let size = args.pixel_size.unwrap_or_else(|| pixel_size(strokes));
    if !(size.is_finite() && size > 0.0) {
        bail!("--pixel-size {size}: expected a number above 0, the size of a screen's pixel in the strokes' unit");
    }
    let mut options = OversketchOptions {
        mode: args.mode,
        fit: FitOptions { pixel_size: size, ..FitOptions::preset(args.preset) },
        ..OversketchOptions::default()
    };
    let own = parameters_of::<OversketchOptions>();
    for setting in &args.set {
        let key = setting.split('=').next().unwrap_or_default().trim();
        let setting = std::slice::from_ref(setting);
        if own.iter().any(|parameter| parameter.name == key) {
            options = settings::apply(&options, setting)?;
        } else {
            options.fit = settings::apply(&options.fit, setting)?;
        }
    }
    options.validate()?;
    Ok(options)
}

fn check(args: &OversketchArgs, file: &SplineFile, strokes: &StrokeFile) -> Result<()> {
    let (splines, over) = (args.splines.display(), args.strokes.display());
    if file.splines.is_empty() {
        bail!("{splines}: there is no curve in it");
    }
    if strokes.strokes.is_empty() {
        bail!("{over}: there is no stroke in it");
    }
    if (file.unit, file.y) != (strokes.unit, strokes.y) {
        bail!(
            "{over}: its unit is {} with y {}, but {splines} has {} with y {}: they cannot lie over each other",
            strokes.unit,
            strokes.y.as_str(),
            file.unit,
            file.y.as_str()
        );
    }
    if let Some(name) = &args.spline
        && !file.splines.iter().any(|entry| entry.name == *name)
    {
        bail!("--spline {name}: {splines} has no curve of that name");
    }
    Ok(())
}

/// Corrects the curve that a stroke means; the reason why not, if it means none.
fn apply<'a>(
    file: &mut SplineFile,
    stroke: &'a Stroke,
    name: Option<&str>,
    options: &OversketchOptions,
) -> std::result::Result<Done<'a>, String> {
    let named = |entry: &fairpath_io::SplineEntry| name.is_none_or(|name| entry.name == name);
    let mut best: Option<(bool, f64, usize)> = None;
    for (i, entry) in file.splines.iter().enumerate().filter(|(_, entry)| named(entry)) {
        let ends = [stroke.points.first(), stroke.points.last()].into_iter().flatten();
        let near = ends.map(|p| entry.spline.nearest(*p).distance).fold(f64::INFINITY, f64::min);
        // One that can be corrected by this stroke comes before one that cannot.
        let refused = oversketch_region(&entry.spline, stroke, options).is_err();
        if best.is_none_or(|b| (refused, near) < (b.0, b.1)) {
            best = Some((refused, near, i));
        }
    }
    let (_, _, index) = best.ok_or("there is no curve to correct")?;
    let entry = &mut file.splines[index];
    let result = oversketch(&entry.spline, stroke, options).map_err(|error| error.to_string())?;
    let before = std::mem::replace(&mut entry.spline, result.spline.clone());
    // The figures were measured against a stroke that is not at hand.
    entry.report = None;
    entry.warnings.extend(result.warnings.iter().cloned());
    Ok(Done { title: format!("{} over {}", stroke.name, entry.name), before, stroke, result })
}
