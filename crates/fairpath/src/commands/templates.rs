//! `fairpath templates`: sets of French curves listed, authored from splines or drawings, and drawn.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use fairpath_curve::{Continuity, Spline};
use fairpath_fit::{Template, TemplateSet};
use fairpath_io::{SHIPPED_TEMPLATES, encode_templates};

use super::fit_report::plain;
use super::{Ending, template_sets};
use crate::args::{OutputFormat, TemplatesArgs};
use crate::output::{Destination, Ready};
use crate::printer::{Printer, columns};
use crate::{interrupt, pictures};

pub(crate) fn run(args: &TemplatesArgs, printer: &mut Printer) -> Result<Ending> {
    if let Some(size) = args.pixel_size
        && !(size.is_finite() && size > 0.0)
    {
        bail!("--pixel-size {size}: expected a number above 0, the size of a screen's pixel in the files' unit");
    }
    if args.inputs.iter().filter(|path| path.as_os_str() == "-").count() > 1 {
        bail!("standard input (-) can be read only once");
    }
    let to = args.output.as_deref().map(|path| destination(path, args)).transpose()?;
    interrupt::install();
    let inputs: Vec<PathBuf> =
        if args.inputs.is_empty() { SHIPPED_TEMPLATES.map(PathBuf::from).to_vec() } else { args.inputs.clone() };
    let sets: Vec<TemplateSet> =
        inputs.iter().map(|input| template_sets::load(input, args.pixel_size, printer)).collect::<Result<_>>()?;
    let Some(to) = to else {
        printer.result(&table(&sets))?;
        return Ok(Ending::Done);
    };
    let bytes = match to.format {
        OutputFormat::Json => encode_templates(&one_set(&sets, args, &to.path)?)?,
        OutputFormat::Png => pictures::sets(&sets, args.comb).to_png()?,
        _ => pictures::sets(&sets, args.comb).to_svg().as_bytes().to_vec(),
    };
    let mut ready = Ready::default();
    ready.add(&to.path, bytes);
    ready.write()?;
    Ok(Ending::Done)
}

/// Where the set goes, if it can go there.
fn destination(path: &Path, args: &TemplatesArgs) -> Result<Destination> {
    let to = Destination::new(path, args.format)?;
    match to.format {
        OutputFormat::Json if args.comb => bail!("--comb: only a picture (svg or png) has a comb"),
        OutputFormat::Svg | OutputFormat::Png if args.name.is_some() => {
            bail!("--name: a picture names the sets as they are; write json first")
        }
        OutputFormat::Json | OutputFormat::Svg | OutputFormat::Png => Ok(to),
        OutputFormat::Dxf | OutputFormat::Csv => {
            bail!("{}: a set is written as json, or drawn as svg or png", path.display())
        }
    }
}

/// The French curves of all sets as one.
fn one_set(sets: &[TemplateSet], args: &TemplatesArgs, output: &Path) -> Result<TemplateSet> {
    let name = match (&args.name, sets) {
        (Some(name), _) if name.trim().is_empty() => bail!("--name: expected a name that is not empty"),
        (Some(name), _) => name.clone(),
        (None, [only]) => only.name().to_owned(),
        (None, _) => output.file_stem().map_or_else(|| "set".to_owned(), |stem| stem.to_string_lossy().into_owned()),
    };
    let templates: Vec<Template> = sets.iter().flat_map(|set| set.templates().iter().cloned()).collect();
    Ok(TemplateSet::new(name, templates)?)
}

/// A line for each French curve; lengths are in px.
fn table(sets: &[TemplateSet]) -> String {
    let header = ["French curve", "set", "closed", "segments", "length", "min radius", "corners"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for set in sets {
        rows.extend(set.templates().iter().map(|template| row(template, set.name())));
    }
    columns(&rows)
}

fn row(template: &Template, set: &str) -> Vec<String> {
    let spline = template.spline();
    vec![
        plain(template.name()),
        plain(set),
        if spline.is_closed() { "yes" } else { "no" }.to_owned(),
        spline.segments().len().to_string(),
        format!("{:.1}", spline.length()),
        smallest_radius(spline).map_or("-".into(), |radius| format!("{radius:.1}")),
        spline.joins().iter().filter(|join| **join == Continuity::G0).count().to_string(),
    ]
}

/// Radius of the tightest bend, corners aside; none where nothing bends.
fn smallest_radius(spline: &Spline) -> Option<f64> {
    let kappa = spline.segments().iter().fold(0.0, |m: f64, s| m.max(s.kappa0.abs()).max(s.kappa1.abs()));
    (kappa > 0.0).then(|| 1.0 / kappa)
}
