//! Table 1 of Baran, Lehtinen and Popović (2010), for the like strokes of ours, beside the paper's own rows.

use std::fs;

use anyhow::{Context, Result};
use fairpath::stopwatch::{Milliseconds, Stopwatch};
use fairpath_fit::{FitOptions, Preset, Report, Stroke, fit_observed};

use crate::{data, table, tree};

const HEADER: &[&str] =
    &["Curve name", "Preprocess", "Fit", "Make graph", "Find path", "Merge", "Total", "Samples", "Nodes", "Edges"];

/// What stands above the table on its page.
const INTRODUCTION: &str = "\
# The paper's table 1

Time and size of each step of Baran, Lehtinen and Popović (2010), for strokes of our own that are like the paper's, beside the paper's rows.
Written by `cargo xtask table1 --write`, on whatever machine it ran last.

Fewer samples are taken than in the paper (12 on a circle, not 15) and their distance may change faster, so that there are fewer nodes; edges are
counted when their cost is computed, which happens only when a search asks for it, so that making the graph takes no time.
";

struct Line {
    stroke: &'static str,
    preset: Preset,
    name: &'static str,
    /// Seconds on a 2.66 GHz Core i7-920: preprocess, fit, make graph, find path, merge, total.
    paper_s: [f64; 6],
    /// Samples, nodes and edges.
    paper_sizes: [usize; 3],
}

const LINES: &[Line] = &[
    Line {
        stroke: "squiggle",
        preset: Preset::Default,
        name: "Squiggle",
        paper_s: [0.09, 0.19, 0.30, 0.33, 0.11, 1.02],
        paper_sizes: [95, 5148, 87_816],
    },
    Line {
        stroke: "squiggle",
        preset: Preset::LinesArcs,
        name: "Squiggle G1",
        paper_s: [0.08, 0.02, 0.11, 0.14, 0.06, 0.41],
        paper_sizes: [95, 3026, 36_192],
    },
    Line {
        stroke: "highheel",
        preset: Preset::Default,
        name: "Highheel",
        paper_s: [0.22, 0.45, 0.72, 0.47, 0.17, 2.03],
        paper_sizes: [135, 11_226, 288_998],
    },
    Line {
        stroke: "closed_squiggle",
        preset: Preset::Default,
        name: "Closed squiggle",
        paper_s: [0.14, 0.33, 0.34, 0.42, 0.36, 1.59],
        paper_sizes: [128, 6624, 105_544],
    },
    Line {
        stroke: "closed_squiggle",
        preset: Preset::LinesArcs,
        name: "Closed squiggle G1",
        paper_s: [0.14, 0.02, 0.09, 0.28, 0.13, 0.66],
        paper_sizes: [128, 3574, 36_374],
    },
    Line {
        stroke: "butterfly",
        preset: Preset::Default,
        name: "Butterfly",
        paper_s: [0.33, 0.58, 0.81, 1.56, 1.53, 4.81],
        paper_sizes: [268, 16_186, 304_753],
    },
    Line {
        stroke: "hello",
        preset: Preset::Default,
        name: "Hello",
        paper_s: [0.09, 0.42, 0.53, 0.52, 0.76, 2.32],
        paper_sizes: [189, 10_674, 181_021],
    },
];

/// Prints the table, or writes the page of docs/ that shows it.
pub(crate) fn run(repeat: usize, write: bool) -> Result<()> {
    let strokes = data::shared("synthetic.json")?;
    let mut rows = Vec::new();
    for line in LINES {
        let stroke = strokes.iter().find(|stroke| stroke.name == line.stroke);
        let stroke = stroke.with_context(|| format!("synthetic.json has no stroke {}", line.stroke))?;
        let (report, ms) = fastest(stroke, line.preset, repeat)?;
        let ours_s = [ms.preprocess, ms.candidates, ms.graph, ms.search, ms.merge, ms.total].map(|ms| ms / 1e3);
        rows.push(row(line.name, &ours_s, [report.samples, report.nodes, report.edges], 5));
        rows.push(row(&format!("{}, the paper's", line.name), &line.paper_s, line.paper_sizes, 2));
    }
    let table = table::markdown(HEADER, &rows);
    let what = format!(
        "Seconds, one thread, the fastest of {repeat}; the paper's rows are its own strokes on its own machine."
    );
    if !write {
        print!("{what}\n\n{table}");
        return Ok(());
    }
    let path = tree::root().join("docs/table1.md");
    fs::write(&path, format!("{INTRODUCTION}\n{what}\n\n{table}")).context("cannot write docs/table1.md")?;
    println!("wrote {}", path.display());
    Ok(())
}

fn fastest(stroke: &Stroke, preset: Preset, repeat: usize) -> Result<(Report, Milliseconds)> {
    let options = FitOptions::preset(preset);
    let mut best: Option<(Report, Milliseconds)> = None;
    for _ in 0..repeat.max(1) {
        let mut watch = Stopwatch::start();
        let fit = fit_observed(stroke, &options, &mut watch, None)?;
        let ms = watch.stop();
        if best.as_ref().is_none_or(|(_, fastest)| ms.total < fastest.total) {
            best = Some((fit.report, ms));
        }
    }
    best.context("no run at all")
}

fn row(name: &str, seconds: &[f64; 6], sizes: [usize; 3], decimals: usize) -> Vec<String> {
    let mut cells = vec![name.to_owned()];
    cells.extend(seconds.iter().map(|s| format!("{s:.decimals$}")));
    cells.extend(sizes.iter().map(usize::to_string));
    cells
}
