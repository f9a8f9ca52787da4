//! `fairpath fit`: read all strokes, fit them in parallel, write everything or nothing.

use std::collections::BTreeMap;
use std::sync::Arc;

use anyhow::{Result, bail};
use fairpath_fit::{Preset, TemplateSet};
use fairpath_io::{Failure, SplineEntry, SplineFile};
use fairpath_sketch::Method;

use super::Ending;
use super::fit_inputs::{Inputs, Job};
use super::fit_report;
use super::fitting::{fitted, in_parallel};
use super::method_options::MethodOptions;
use super::template_sets;
use crate::args::{FitArgs, OutputFormat, Stats};
use crate::output::{Destination, Ready};
use crate::printer::Printer;
use crate::{interrupt, pictures};

/// The fitter's word for a stroke that it gave back as a polyline.
const FALLBACK: &str = "fell-back-to-polyline";

pub(crate) fn run(args: &FitArgs, printer: &mut Printer) -> Result<Ending> {
    let templates = templates(args, printer)?;
    let base = MethodOptions::asked(&args.into(), &templates, None)?;
    if args.list_parameters {
        printer.result(&fit_report::parameters(&base))?;
        return Ok(Ending::Done);
    }
    let destination = args.output.as_deref().map(|path| Destination::new(path, args.format)).transpose()?;
    let picture = args.picture.as_deref().map(|path| Destination::new(path, None)).transpose()?;
    check_combination(args, destination.as_ref(), picture.as_ref())?;
    interrupt::install();

    let inputs = Inputs::read(&args.inputs, printer)?;
    let jobs = inputs.jobs(|pixel_size| MethodOptions::asked(&args.into(), &templates, pixel_size))?;
    let outcomes = fit_all(&jobs, &inputs, args)?;
    let mut ready = Ready::default();
    let file = collect(&inputs, outcomes, args, &mut ready);
    if let Some(to) = &destination {
        let (bytes, warnings) = pictures::encode(&file, Some(&inputs.file), to.format, args.flip_y)?;
        ready.add(&to.path, bytes);
        for warning in warnings {
            printer.note(&format!("{}: {}", to.path.display(), warning.text));
        }
    }
    if let Some(to) = &picture {
        let png = to.format == OutputFormat::Png;
        let bytes = if args.templates_shown {
            pictures::with_templates(&file, &inputs.file, &templates, png)?
        } else {
            pictures::overview(&file, &inputs.file, png, args.sheet)?
        };
        ready.add(&to.path, bytes);
    }
    ready.write()?;
    report(args, &file, printer)?;

    let missed = if args.strict { missed_tolerances(&jobs, &file) } else { Vec::new() };
    fit_report::notes(missed.iter().cloned(), printer);
    Ok(if file.failures.is_empty() && missed.is_empty() { Ending::Done } else { Ending::SomeFailed })
}

/// The French curves that the arguments ask for; of no meaning to other methods.
fn templates(args: &FitArgs, printer: &mut Printer) -> Result<Arc<TemplateSet>> {
    if args.method != Method::FrenchCurve {
        if args.templates.is_some() {
            bail!("--templates: the method {} uses no French curves; add --method french-curve", args.method.name());
        }
        if args.templates_shown {
            bail!("--templates-shown: the method {} uses no French curves", args.method.name());
        }
    }
    let source = args.templates.clone().unwrap_or_else(|| template_sets::USUAL.into());
    if source.as_os_str() == "-" && args.inputs.iter().any(|input| input.as_os_str() == "-") {
        bail!("standard input (-) can be read only once, and both --templates and an input name it");
    }
    Ok(Arc::new(template_sets::load(&source, None, printer)?))
}

fn report(args: &FitArgs, file: &SplineFile, printer: &mut Printer) -> Result<()> {
    let to_file = args.output.is_some();
    // Told before the result, which may go to a reader who hangs up. The table and the figures show warnings themselves.
    fit_report::notes(fit_report::failures(file), printer);
    if to_file {
        fit_report::notes(fit_report::warnings(file), printer);
    }
    match args.stats {
        Some(Stats::Json) => printer.result(&fit_report::figures(file)?),
        None if to_file => Ok(()),
        None => printer.result(&fit_report::table(file)),
    }
}

fn check_combination(args: &FitArgs, output: Option<&Destination>, picture: Option<&Destination>) -> Result<()> {
    let stdout = |to: Option<&Destination>| to.is_some_and(|to| to.path.as_os_str() == "-");
    if args.stats.is_some() && stdout(output) {
        bail!("--stats and -o - both write to standard output; give one of them a file");
    }
    if let Some(to) = picture {
        if !matches!(to.format, OutputFormat::Svg | OutputFormat::Png) {
            bail!("{}: a picture is written as svg or png", to.path.display());
        }
        if output.is_some_and(|output| output.path == to.path) {
            bail!("{}: -o and --picture name the same file", to.path.display());
        }
    }
    if args.preset != Preset::Default && args.method != Method::ShortestPath {
        bail!("--preset {}: the method {} has no presets", args.preset.name(), args.method.name());
    }
    if args.stages.as_ref().is_some_and(|folder| folder.exists() && !folder.is_dir()) {
        bail!("--stages: expected a folder, and a file of that name exists");
    }
    Ok(())
}

/// What came of a stroke: a curve or the reason why not, and pictures of the steps, if asked for.
struct Outcome {
    result: std::result::Result<SplineEntry, Failure>,
    steps: Vec<(String, Vec<u8>)>,
}

fn fit_all(jobs: &[Job<'_>], inputs: &Inputs, args: &FitArgs) -> Result<Vec<Outcome>> {
    let draw = args.stages.is_some().then_some(inputs.file.y);
    in_parallel(jobs, args.threads, |job| match fitted(job, args.method, !args.no_times, draw) {
        Ok((entry, steps)) => Outcome { result: Ok(entry), steps },
        Err(failure) => Outcome { result: Err(failure), steps: Vec::new() },
    })
}

/// All outcomes as one file; the pictures of the steps are made ready to be written.
fn collect(inputs: &Inputs, outcomes: Vec<Outcome>, args: &FitArgs, ready: &mut Ready) -> SplineFile {
    let mut file = SplineFile { unit: inputs.file.unit, y: inputs.file.y, ..SplineFile::default() };
    for (i, (outcome, stroke)) in outcomes.into_iter().zip(&inputs.file.strokes).enumerate() {
        if let Some(folder) = &args.stages {
            for (step, svg) in outcome.steps {
                // The number tells apart what is the same once it is fit for a file's name.
                ready.add(folder.join(format!("{:03}-{}-{step}.svg", i + 1, file_stem(&stroke.name))), svg);
            }
        }
        match outcome.result {
            Ok(entry) => file.splines.push(entry),
            Err(failure) => file.failures.push(failure),
        }
    }
    file
}

/// A sentence for each curve that is further from its stroke than asked, or is no fair curve at all.
fn missed_tolerances(jobs: &[Job<'_>], file: &SplineFile) -> Vec<String> {
    let by_name: BTreeMap<&str, &Job<'_>> = jobs.iter().map(|job| (job.stroke.name.as_str(), job)).collect();
    let mut missed = Vec::new();
    for entry in &file.splines {
        let Some(job) = by_name.get(entry.name.as_str()) else { continue };
        let name = fit_report::plain(&entry.name);
        let allowed = job.options.largest_deviation();
        let deviation = entry.report.as_ref().map_or(0.0, |report| report.figures.max_deviation);
        if deviation > allowed {
            missed.push(format!("{name}: the curve is {deviation:.3} off, more than {allowed:.3} (max_error)"));
        } else if entry.warnings.iter().any(|warning| warning.code == FALLBACK) {
            missed.push(format!("{name}: no fair curve keeps within {allowed:.3} (max_error)"));
        }
    }
    missed
}

/// A stroke's name as part of the name of a file.
fn file_stem(name: &str) -> String {
    name.chars().take(80).map(|c| if c.is_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '_' }).collect()
}
