//! `fairpath inflate`: closed splines into surfaces, in one file.

use std::panic::{AssertUnwindSafe, catch_unwind};

use anyhow::{Result, bail};
use fairpath_io::{
    Failure, ReadOptions, SplineEntry, SurfaceEntry, SurfaceFile, SurfaceFormat, encode_surfaces, read_splines,
};
use fairpath_shape::{InflateOptions, inflate};
use fairpath_sketch::parameters_of;
use rayon::prelude::*;

use super::Ending;
use super::fit_report::{self, plain};
use crate::args::{InflateArgs, SurfaceOutput};
use crate::output::{Destination, Ready};
use crate::printer::{Printer, columns};
use crate::{interrupt, settings};

pub(crate) fn run(args: &InflateArgs, printer: &mut Printer) -> Result<Ending> {
    let options = settings::apply(&InflateOptions::default(), &args.set)?;
    options.check()?;
    if args.list_parameters {
        let values = serde_json::to_value(&options)?;
        printer.result(&fit_report::listed(&parameters_of::<InflateOptions>(), &values))?;
        return Ok(Ending::Done);
    }
    let to = args.output.as_deref().map(|path| Destination::<SurfaceOutput>::new(path, args.format)).transpose()?;
    interrupt::install();
    let Some(input) = &args.input else { bail!("give a spline file") };
    let splines = read_splines(input, &ReadOptions::default())?;
    // `collect` keeps the order of the file, whatever the order of finishing.
    let outcomes: Vec<_> = splines.splines.par_iter().map(|entry| inflate_one(entry, &options)).collect();
    let table = table(&splines.splines, &outcomes);
    let mut file = SurfaceFile { unit: splines.unit, y: splines.y, surfaces: Vec::new() };
    let mut failed = 0;
    let mut notes = Vec::new();
    for outcome in outcomes {
        match outcome {
            Ok(surface) => file.surfaces.push(surface),
            Err(failure) => {
                failed += 1;
                notes.push(format!("{}: {}", plain(&failure.name), failure.text));
            }
        }
    }
    fit_report::notes(notes.into_iter(), printer);
    if file.surfaces.is_empty() {
        bail!("{}: none of its {failed} splines could be inflated", input.display());
    }
    let mut ready = Ready::default();
    if let Some(to) = &to {
        ready.add(&to.path, encode_surfaces(&file, surface_format(to.format))?);
    }
    ready.write()?;
    if to.is_none_or(|to| to.path.as_os_str() != "-") {
        printer.result(&table)?;
    }
    Ok(if failed == 0 { Ending::Done } else { Ending::SomeFailed })
}

fn surface_format(format: SurfaceOutput) -> SurfaceFormat {
    match format {
        SurfaceOutput::Glb => SurfaceFormat::Glb,
        SurfaceOutput::Obj => SurfaceFormat::Obj,
        SurfaceOutput::Png => SurfaceFormat::Png,
    }
}

fn inflate_one(entry: &SplineEntry, options: &InflateOptions) -> Result<SurfaceEntry, Failure> {
    let name = entry.name.clone();
    // Nothing here panics on data; should it all the same, the other surfaces are still worth having.
    match catch_unwind(AssertUnwindSafe(|| inflate(&entry.spline, options))) {
        Ok(Ok(inflated)) => Ok(SurfaceEntry { name, mesh: inflated.mesh }),
        Ok(Err(error)) => Err(Failure { name, code: error.code().into(), text: error.to_string() }),
        Err(_) => {
            let text = "inflating broke down on this spline, which is a mistake of ours: please report it";
            Err(Failure { name, code: "internal".into(), text: text.into() })
        }
    }
}

/// A line for each spline.
fn table(splines: &[SplineEntry], outcomes: &[Result<SurfaceEntry, Failure>]) -> String {
    let header = ["spline", "triangles", "vertices", "area", "volume", "least angle"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    rows.extend(splines.iter().zip(outcomes).map(|(entry, outcome)| {
        let name = plain(&entry.name);
        match outcome {
            Err(failure) => vec![name, format!("failed: {}", failure.code)],
            Ok(SurfaceEntry { mesh, .. }) => vec![
                name,
                mesh.triangles.len().to_string(),
                mesh.vertices.len().to_string(),
                format!("{:.6}", Figure(mesh.area())),
                format!("{:.6}", Figure(mesh.volume())),
                format!("{:.1}°", mesh.least_angle().to_degrees()),
            ],
        }
    }));
    columns(&rows)
}

/// A number with so many significant digits, in powers of ten where it is very large or small.
struct Figure(f64);

impl std::fmt::Display for Figure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = f.precision().unwrap_or(6);
        let magnitude = if self.0 == 0.0 { 0.0 } else { self.0.abs().log10().floor() };
        if !(-4.0..9.0).contains(&magnitude) {
            return write!(f, "{:.*e}", digits - 1, self.0);
        }
        let decimals = (digits as f64 - 1.0 - magnitude).max(0.0);
        write!(f, "{:.*}", decimals as usize, self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Figure;

    #[test]
    fn figures_have_six_digits_whatever_their_size() {
        let shown = [4.18879, 12_345.678, 0.0012345678, 1e12, 0.0, 2.5e-30].map(|x| format!("{:.6}", Figure(x)));
        assert_eq!(shown, ["4.18879", "12345.7", "0.00123457", "1.00000e12", "0.00000", "2.50000e-30"]);
    }
}
