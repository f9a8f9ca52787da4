//! How long the fitter takes, how that grows with the stroke, and how much memory it needs.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use fairpath_fit::{FitOptions, Stroke, fit};

use crate::{data, process, table, tree};

const FILES: &[&str] = &[
    "synthetic.json",
    "quickdraw.json",
    "omniglot.json",
    "wacom.json",
    "perfect.json",
    "msink.json",
    "hwrt.json",
    "long.json",
];

/// The file whose strokes tell how time grows with length.
pub(crate) const LONG: &str = "long.json";

/// A stroke that has taken this long is not timed again: the first run tells enough.
const PATIENCE_MS: f64 = 5000.0;

/// Strokes longer than this have their memory measured, px.
const HEAVY: f64 = 9000.0;

/// Prints the figures for files whose names begin with one of `names`, or for all.
pub(crate) fn run(names: &[String], repeat: usize) -> Result<()> {
    let chosen = |file: &&&str| names.is_empty() || names.iter().any(|name| file.starts_with(name.as_str()));
    println!("Milliseconds to fit a stroke with the default preset, one thread, the best of {repeat}:\n");
    let mut rows = Vec::new();
    let mut long = Vec::new();
    for file in FILES.iter().filter(chosen) {
        let strokes = data::shared(file)?;
        let times: Vec<f64> = strokes.iter().map(|stroke| best_ms(stroke, repeat)).collect();
        if *file == LONG {
            long = strokes.iter().zip(&times).map(|(s, &ms)| (s.name.clone(), data::polyline_length(s), ms)).collect();
        }
        let mut sorted = times.clone();
        sorted.sort_by(f64::total_cmp);
        let figures = [sorted.iter().sum(), sorted[sorted.len() / 2], sorted[sorted.len() - 1]];
        let mut row = vec![(*file).to_owned(), strokes.len().to_string()];
        row.extend(figures.iter().map(|ms: &f64| format!("{ms:.2}")));
        rows.push(row);
    }
    if rows.is_empty() {
        bail!("no file of that name: there are {}", FILES.join(", "));
    }
    table::print(&["file", "strokes", "total", "median", "slowest"], &rows);
    if long.is_empty() { Ok(()) } else { growth(&long) }
}

/// Prints how time grows with length, and the memory of the longest.
fn growth(long: &[(String, f64, f64)]) -> Result<()> {
    println!("\nThe long strokes:\n");
    let mut rows = Vec::new();
    for (name, length, ms) in long {
        let memory = if *length > HEAVY { format!("{:.1}", peak_of(LONG, name)?) } else { "-".into() };
        rows.push(vec![name.clone(), format!("{length:.0}"), format!("{ms:.2}"), memory]);
    }
    table::print(&["stroke", "px", "ms", "peak MiB"], &rows);
    println!(
        "\ngrowth: ms ~ length^{:.2}, by least squares over these",
        exponent(long.iter().map(|row| (row.1, row.2)))
    );
    Ok(())
}

fn best_ms(stroke: &Stroke, repeat: usize) -> f64 {
    let options = FitOptions::default();
    let mut best = f64::INFINITY;
    let mut spent = 0.0;
    for i in 0..repeat.max(1) {
        if i > 0 && spent > PATIENCE_MS {
            break;
        }
        let begun = Instant::now();
        // A dot has no curve; the time to say so counts too.
        let _ = std::hint::black_box(fit(std::hint::black_box(stroke), &options));
        let ms = begun.elapsed().as_secs_f64() * 1e3;
        best = best.min(ms);
        spent += ms;
    }
    best
}

/// The power of length by which time grows, by least squares over their logarithms.
pub(crate) fn exponent(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    slope(&points.map(|(length, ms)| (length.ln(), ms.ln())).collect::<Vec<_>>())
}

/// The slope of the least-squares line.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (mx, my) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (xy, xx) =
        points.iter().fold((0.0, 0.0), |(xy, xx), p| (xy + (p.0 - mx) * (p.1 - my), xx + (p.0 - mx) * (p.0 - mx)));
    xy / xx
}

/// Peak memory of a process that does nothing but fit this stroke, MiB.
fn peak_of(file: &str, name: &str) -> Result<f64> {
    let exe = std::env::current_exe().context("cannot tell where this program is")?;
    let ran = process::capture(Command::new(exe).arg("peak-memory").arg(tree::strokes().join(file)).arg(name))?;
    let kb: f64 = ran.text.trim().parse().with_context(|| format!("no figure but {}", ran.text))?;
    Ok(kb / 1024.0)
}

/// What the child of [`peak_of`] does.
pub(crate) fn peak_memory(file: &Path, name: &str) -> Result<()> {
    let strokes = data::load(file)?;
    let stroke = strokes.iter().find(|stroke| stroke.name == name).context("no stroke of that name")?;
    fit(stroke, &FitOptions::default())?;
    let status = std::fs::read_to_string("/proc/self/status").context("peak memory is read from /proc, as on Linux")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let Some(kb) = line.and_then(|rest| rest.split_whitespace().next()) else { bail!("/proc has no VmHWM") };
    println!("{kb}");
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_exponent_of_a_power_law_is_found() {
        let points = (1..9).map(f64::from).map(|x| (x, 3.0 * x.powf(1.25)));
        assert!((super::exponent(points) - 1.25).abs() < 1e-12);
    }
}
