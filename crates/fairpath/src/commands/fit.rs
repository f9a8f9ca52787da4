//! `fairpath fit`: read all strokes, fit them in parallel, write everything or nothing.

use std::panic::{AssertUnwindSafe, catch_unwind};

use anyhow::{Context, Result, bail};
use fairpath_fit::{FitError, FitOptions, Stages, Stroke, fit, fit_observed};
use fairpath_io::{Failure, SplineEntry, SplineFile};
use rayon::prelude::*;

use super::Ending;
use super::fit_inputs::{Inputs, Job};
use super::fit_report;
use crate::args::{FitArgs, Method, OutputFormat, Stats};
use crate::output::{Destination, Ready};
use crate::printer::Printer;
use crate::progress::Progress;
use crate::stopwatch::Stopwatch;
use crate::{interrupt, parameters, pictures};

pub(crate) fn run(args: &FitArgs, printer: &mut Printer) -> Result<Ending> {
    let base = options(args, None)?;
    if args.list_parameters {
        printer.result(&fit_report::parameters(&base))?;
        return Ok(Ending::Done);
    }
    let destination = args.output.as_deref().map(|path| Destination::new(path, args.format)).transpose()?;
    let picture = args.picture.as_deref().map(|path| Destination::new(path, None)).transpose()?;
    check_combination(args, destination.as_ref(), picture.as_ref())?;
    interrupt::install();

    let inputs = Inputs::read(&args.inputs, printer)?;
    let jobs = inputs.jobs(|pixel_size| options(args, pixel_size))?;
    let results = fit_all(&jobs, args)?;
    let fitted = collect(args.method, &inputs, &jobs, results);

    let mut ready = Ready::default();
    if let Some(to) = &destination {
        ready.add(&to.path, pictures::encode(&fitted.file, to.format)?);
    }
    if let Some(to) = &picture {
        ready.add(&to.path, pictures::overview(&fitted.file, &inputs.file, to.format)?);
    }
    if let Some(folder) = &args.stages {
        for (job, stages) in jobs.iter().zip(&fitted.stages) {
            let Some(stages) = stages else { continue };
            for (step, svg) in pictures::stages(job.stroke, stages, &fitted.file, &inputs.file)? {
                ready.add(folder.join(format!("{}-{step}.svg", file_stem(&job.stroke.name))), svg);
            }
        }
    }
    ready.write()?;
    match (args.stats, &destination) {
        (Some(Stats::Json), _) => printer.result(&fit_report::figures(&fitted.file)?)?,
        (None, None) => printer.result(&fit_report::table(&fitted.file))?,
        (None, Some(_)) => {}
    }
    fit_report::notes(&fitted.file, destination.is_some() || args.stats.is_some(), printer);

    let missed = if args.strict { missed_tolerances(&jobs, &fitted.file) } else { Vec::new() };
    for text in &missed {
        printer.note(text);
    }
    Ok(if fitted.file.failures.is_empty() && missed.is_empty() { Ending::Done } else { Ending::SomeFailed })
}

/// The options that the arguments ask for, for strokes whose file says so of its pixels.
fn options(args: &FitArgs, pixel_size_of_file: Option<f64>) -> Result<FitOptions> {
    let mut options = FitOptions::preset(args.preset);
    if let Some(closed) = args.closed {
        options.closed = closed;
    }
    if let Some(size) = args.pixel_size {
        if !(size.is_finite() && size > 0.0) {
            bail!("--pixel-size {size}: expected a number above 0, the size of a screen's pixel in the strokes' unit");
        }
    }
    if let Some(size) = args.pixel_size.or(pixel_size_of_file) {
        options.pixel_size = size;
    }
    let options = parameters::apply(&options, &args.set)?;
    // Any stroke shows an option that is out of range; a short one is cheap.
    let probe = Stroke::new("probe", vec![(0.0, 0.0).into(), (1.0, 0.0).into()]);
    match fit(&probe, &options) {
        Err(error @ FitError::BadOption { .. }) => bail!("{error}"),
        _ => Ok(options),
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
    if args.stages.as_ref().is_some_and(|folder| folder.exists() && !folder.is_dir()) {
        bail!("--stages: expected a folder, and a file of that name exists");
    }
    Ok(())
}

/// What came of a stroke.
struct Outcome {
    result: std::result::Result<SplineEntry, Failure>,
    stages: Option<Stages>,
}

fn fit_all(jobs: &[Job<'_>], args: &FitArgs) -> Result<Vec<Outcome>> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads)
        .build()
        .with_context(|| format!("cannot start {} threads; ask for fewer", args.threads))?;
    let progress = Progress::start(jobs.len());
    // `collect` keeps the order of the input, whatever the order of finishing.
    Ok(pool.install(|| {
        jobs.par_iter()
            .map(|job| {
                let outcome = fit_one(job, args);
                progress.one_done();
                outcome
            })
            .collect()
    }))
}

fn fit_one(job: &Job<'_>, args: &FitArgs) -> Outcome {
    let mut stages = args.stages.is_some().then(Stages::default);
    let name = &job.stroke.name;
    // The fitter does not panic on data; should it all the same, the other strokes are still worth having.
    let fitted = catch_unwind(AssertUnwindSafe(|| {
        let mut watch = Stopwatch::start();
        let fit = fit_observed(job.stroke, &job.options, &mut watch, stages.as_mut());
        (fit, watch.stop())
    }));
    let result = match fitted {
        Ok((Ok(fit), ms)) => Ok(SplineEntry::from_fit(name.as_str(), args.method.name(), fit, Some(ms))),
        Ok((Err(error), _)) => Err(Failure::from_error(name.as_str(), &error)),
        Err(_) => Err(Failure {
            name: name.clone(),
            code: "internal".into(),
            text: "the fitter broke down on this stroke, which is a mistake of ours: please report it".into(),
        }),
    };
    Outcome { stages: if result.is_ok() { stages } else { None }, result }
}

struct Fitted {
    file: SplineFile,
    /// For each job.
    stages: Vec<Option<Stages>>,
}

fn collect(_method: Method, inputs: &Inputs, jobs: &[Job<'_>], outcomes: Vec<Outcome>) -> Fitted {
    debug_assert_eq!(jobs.len(), outcomes.len());
    let mut file = SplineFile { unit: inputs.file.unit, y: inputs.file.y, ..SplineFile::default() };
    let mut stages = Vec::new();
    for outcome in outcomes {
        stages.push(outcome.stages);
        match outcome.result {
            Ok(entry) => file.splines.push(entry),
            Err(failure) => file.failures.push(failure),
        }
    }
    Fitted { file, stages }
}

/// A sentence for each curve that is further from its stroke than asked.
fn missed_tolerances(jobs: &[Job<'_>], file: &SplineFile) -> Vec<String> {
    let mut missed = Vec::new();
    for entry in &file.splines {
        let Some(job) = jobs.iter().find(|job| job.stroke.name == entry.name) else { continue };
        let Some(report) = &entry.report else { continue };
        let allowed = job.options.max_error * job.options.pixel_size;
        let deviation = report.figures.max_deviation;
        if deviation > allowed {
            missed.push(format!("{}: the curve is {deviation:.3} off, more than {allowed:.3} (max_error)", entry.name));
        }
    }
    missed
}

/// A stroke's name as the name of a file.
fn file_stem(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '_' }).collect()
}
