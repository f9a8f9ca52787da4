//! `fairpath compare`: several methods on the same strokes, as a page to read, a picture, or a table.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Result, bail};
use fairpath_fit::Preset;
use fairpath_io::picture::{Comb, PictureOptions, draw_comparison};
use fairpath_io::{ComparedMethod, Comparison, MethodSummary, SplineFile, StrokeFile};
use fairpath_sketch::Method;

use super::fit_inputs::{Inputs, Job};
use super::fitting::{fitted, in_parallel};
use super::method_options::{Asked, MethodOptions};
use super::{Ending, fit_report, template_sets};
use crate::args::{CompareArgs, Stats};
use crate::interrupt;
use crate::output::{Ready, check_place};
use crate::printer::{Printer, columns};

pub(crate) fn run(args: &CompareArgs, printer: &mut Printer) -> Result<Ending> {
    let form = args.output.as_deref().map(Form::of).transpose()?;
    interrupt::install();
    let mut inputs = Inputs::read(&args.inputs, printer)?;
    inputs.keep_only(&args.strokes)?;
    let comparison = Comparison { methods: compared(args, &inputs, printer)?, strokes: inputs.file };
    for method in &comparison.methods {
        let named = |text: String| format!("{}: {text}", method.name);
        fit_report::notes(fit_report::failures(&method.results).map(named), printer);
    }
    if let (Some(form), Some(path)) = (form, &args.output) {
        let mut ready = Ready::default();
        ready.add(path, form.encode(&comparison)?);
        ready.write()?;
    }
    let summary = comparison.summary();
    match args.stats {
        Some(Stats::Json) => printer.result(&(serde_json::to_string_pretty(&summary)? + "\n"))?,
        None if args.output.is_some() => {}
        None => printer.result(&table(&summary, &comparison.strokes))?,
    }
    let failed = comparison.methods.iter().any(|method| !method.results.failures.is_empty());
    Ok(if failed { Ending::SomeFailed } else { Ending::Done })
}

/// The methods with what they make of the strokes.
fn compared(args: &CompareArgs, inputs: &Inputs, printer: &mut Printer) -> Result<Vec<ComparedMethod>> {
    let methods = if args.methods.is_empty() { &Method::ALL[..] } else { &args.methods };
    let source = args.templates.clone().unwrap_or_else(|| template_sets::USUAL.into());
    let templates = Arc::new(template_sets::load(&source, None, printer)?);
    let mut jobs: Vec<(Method, Job<'_>)> = Vec::new();
    for &method in methods {
        let asked =
            Asked { method, preset: Preset::Default, set: &[], closed: args.closed, pixel_size: args.pixel_size };
        let own = inputs.jobs(|pixel_size| MethodOptions::asked(&asked, &templates, pixel_size))?;
        jobs.extend(own.into_iter().map(|job| (method, job)));
    }
    let mut made = in_parallel(&jobs, args.threads, |(method, job)| fitted(job, *method, true, None))?.into_iter();
    let count = inputs.file.strokes.len();
    Ok(methods
        .iter()
        .map(|method| {
            let mut results = SplineFile { unit: inputs.file.unit, y: inputs.file.y, ..SplineFile::default() };
            for outcome in made.by_ref().take(count) {
                match outcome {
                    Ok((entry, _)) => results.splines.push(entry),
                    Err(failure) => results.failures.push(failure),
                }
            }
            ComparedMethod { name: method.name().into(), about: method.about().into(), results }
        })
        .collect())
}

/// What a comparison is written as.
#[derive(Clone, Copy)]
enum Form {
    Html,
    Svg,
    Png,
}

impl Form {
    /// The form that the name of a file tells.
    fn of(path: &Path) -> Result<Self> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let form = match extension.as_deref() {
            Some("html" | "htm") => Self::Html,
            Some("svg") => Self::Svg,
            Some("png") => Self::Png,
            _ => bail!("{}: a comparison is written as html, svg or png; give such an extension", path.display()),
        };
        check_place(path)?;
        Ok(form)
    }

    fn encode(self, comparison: &Comparison) -> Result<Vec<u8>> {
        let picture = || {
            let methods: Vec<(&str, &SplineFile)> =
                comparison.methods.iter().map(|method| (method.name.as_str(), &method.results)).collect();
            let mut options = PictureOptions::default();
            options.comb = Comb::Auto;
            options.joins = false;
            draw_comparison(&methods, &comparison.strokes, &options)
        };
        Ok(match self {
            Self::Html => comparison.to_html().into_bytes(),
            Self::Svg => picture().to_svg().as_bytes().to_vec(),
            Self::Png => picture().to_png()?,
        })
    }
}

/// A line for each method: its figures, and in brackets on how many strokes it is best.
fn table(summary: &[MethodSummary], strokes: &StrokeFile) -> String {
    let header = [
        "method",
        "fitted",
        "failed",
        "pieces",
        "segments",
        "corners",
        "jumps",
        "inflections",
        "rms mean",
        "max dev",
        "variation",
        "ms median",
    ];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    rows.extend(summary.iter().map(|m| {
        vec![
            m.name.clone(),
            m.fitted.to_string(),
            m.failed.to_string(),
            format!("{:.1} ({})", m.pieces_mean, m.best.pieces),
            format!("{:.1}", m.segments_mean),
            m.corners.to_string(),
            m.curvature_jumps.to_string(),
            format!("{} ({})", m.inflections, m.best.inflections),
            format!("{:.3} ({})", m.rms_mean, m.best.rms),
            format!("{:.2}", m.max_deviation),
            format!("{:.2e} ({})", m.variation_median, m.best.variation),
            m.ms_median.map_or("-".into(), |ms| format!("{ms:.2}")),
        ]
    }));
    let count = strokes.strokes.len();
    let note = format!(
        "\nIn brackets: on how many of the {count} strokes a method is best, alone or with others. Pieces and segments are means; jumps are \
         joins at which curvature jumps, corners not counted; variation is the median of the integral of the squared slope of curvature, times \
         the cube of the length.\n"
    );
    columns(&rows) + &note
}
