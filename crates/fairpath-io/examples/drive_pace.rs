//! Prints how long editing takes: every path of a script is drawn over, a few metres aside, once in its middle or, if it is long, in each kilometre of it, and what follows is worked out: heights, ground, signs, trees.
//! Each stroke is drawn five times: told are the middle one of the five times and the least, which other programs on the machine disturbed least.
//! The stroke leaves the path by a twentieth of its length, but bends no more than by a quarter of what the path may: a stroke that asks for what is forbidden is fitted several times.
//!
//! ```sh
//! cargo run --release -p fairpath-io --example drive_pace -- examples/drive/pass-road.json
//! ```

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use fairpath_curve::{Point, Vec2};
use fairpath_drive::{Command, Document, HeightMode, NoFiles, SketchScale};
use fairpath_io::{ReadOptions, open_drive};

/// Size of a pixel of the strokes, m, as the example scripts have it.
const PIXEL_M: f64 = 2.0;

/// A stroke reaches over a third of the path, but not further than this, m.
const LONGEST_M: f64 = 400.0;

/// Times that each stroke is drawn.
const RUNS: usize = 5;

/// A path is drawn over once for each such length of it, m.
const EACH_M: f64 = 1000.0;

fn main() -> Result<(), Box<dyn Error>> {
    for script in std::env::args().skip(1) {
        pace(Path::new(&script))?;
    }
    Ok(())
}

fn pace(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut document = open_drive(path, &ReadOptions::default(), &mut |_, _| {})?.document;
    // Once as all paths are drawn, fair, and once as the script has them.
    let as_it_is = document.state().paths.iter().any(|p| p.heights == HeightMode::Engineered);
    if as_it_is {
        measured(&document, path, "engineered")?;
    }
    document.run(Command::Heights { path: None, mode: HeightMode::Fair }, &NoFiles)?;
    measured(&document, path, "fair")
}

fn measured(document: &Document, path: &Path, mode: &str) -> Result<(), Box<dyn Error>> {
    let terrain = document.state().terrain.clone().ok_or("there is no terrain")?;
    let (mut edits, mut fits, mut refused) = (Vec::new(), Vec::new(), 0);
    for old in document.state().paths.clone() {
        let length = old.length_m();
        let extent = (length / 3.0).min(LONGEST_M);
        let count = (extent / 4.0).ceil().max(8.0) as usize;
        // The bend of the quartic below is sharpest at its ends.
        let aside = (0.05 * extent).min(0.25 / old.section.min_radius_m * extent * extent / 32.0);
        let strokes = (length / EACH_M).floor().max(1.0) as usize;
        for stroke in 0..strokes {
            let from = (stroke as f64 + 0.5) / strokes as f64 * length - 0.5 * extent;
            let points: Vec<Point> = (0..=count)
                .map(|i| {
                    let t = i as f64 / count as f64;
                    let pose = old.plan.pose_at(from + t * extent);
                    let tangent = fairpath_curve::trig::unit(pose.heading);
                    pose.point + Vec2::new(-tangent.y, tangent.x) * (aside * 16.0 * t * t * (1.0 - t) * (1.0 - t))
                })
                .collect();
            let points_m: Vec<[f64; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
            let path = Some(old.name.clone());
            let command = Command::Oversketch { points_m, path, pixel_m: PIXEL_M };
            let (mut edit, mut fit) = (Vec::new(), Vec::new());
            for _ in 0..RUNS {
                // A copy, since to forget what was undone before is no part of an edit.
                let mut edited = document.clone();
                let begun = Instant::now();
                if edited.run(command.clone(), &NoFiles).is_err() {
                    break;
                }
                edit.push(1e3 * begun.elapsed().as_secs_f64());
                let scale = SketchScale { pixel_m: PIXEL_M, min_radius_m: old.section.min_radius_m };
                let begun = Instant::now();
                let stroke = fairpath_fit::Stroke::new("s", scale.evened(&points));
                let done = fairpath_fit::oversketch(&old.plan, &stroke, &scale.oversketching());
                fit.push(1e3 * begun.elapsed().as_secs_f64());
                drop(done);
            }
            if edit.is_empty() {
                refused += 1;
                continue;
            }
            edits.push(middle_and_least(edit));
            fits.push(middle_and_least(fit));
        }
    }
    if edits.is_empty() {
        return Err(format!("{}: no path could be edited", path.display()).into());
    }
    let [columns, rows] = terrain.field.size();
    println!(
        "{}, {mode}: terrain of {columns} × {rows}, {} paths, {} strokes, of which {refused} were refused",
        path.display(),
        document.state().paths.len(),
        edits.len() + refused,
    );
    for (what, times) in [("an edit", edits), ("of it the fit", fits)] {
        for (run, which) in [("middle", 0), ("least", 1)] {
            let mut all: Vec<f64> = times.iter().map(|t| t[which]).collect();
            all.sort_by(f64::total_cmp);
            let at = |share: f64| all[(share * (all.len() - 1) as f64) as usize];
            println!(
                "  {what}, {run} of {RUNS} runs: {:.1} ms (median), {:.1} (90 of 100), {:.1} at most",
                at(0.5),
                at(0.9),
                at(1.0)
            );
        }
    }
    Ok(())
}

fn middle_and_least(mut times: Vec<f64>) -> [f64; 2] {
    times.sort_by(f64::total_cmp);
    [times[times.len() / 2], times[0]]
}
