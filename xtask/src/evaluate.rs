//! Every file of the shared data folder through the command line and then through the evaluator, which trusts nothing.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, anyhow, bail};
use serde_json::Value;

use crate::steps::{Outcome, Steps};
use crate::{bench, data, limits, process, rectilinear, table, tools, tree};

const HEADER: &[&str] = &[
    "file",
    "strokes",
    "refused",
    "segments",
    "L/A/C",
    "corners",
    "rms mean",
    "dev p99",
    "dev max",
    "rev max",
    "truth rms",
    "missed",
    "extra",
    "ms total",
    "ms max",
];

/// A file that takes longer than this to fit is taken for one that never ends. Every one of them should take seconds.
const LIMIT: Duration = Duration::from_secs(240);

/// Marks a figure of the table that is short of its goal.
const SHORT: &str = "!";

/// So many strokes that are too far off are named.
const WORST: usize = 8;

/// The evaluator's part of the test command alone, for files whose names begin with one of `names`, or for all.
pub(crate) fn run(names: &[String]) -> Result<()> {
    process::build(&["fairpath"])?;
    let mut steps = Steps::default();
    add_steps(&mut steps, names);
    if names.is_empty() {
        rectilinear::add_step(&mut steps);
    }
    steps.finish()
}

/// The methods whose curves are judged on every file, the usual one first; the tables of README are of that.
const METHODS: [&str; 3] = [limits::USUAL_METHOD, "curvature-space", "french-curve"];

/// Adds a step for each method and file; where the shared data folder is absent, one that says so.
pub(crate) fn add_steps(steps: &mut Steps, names: &[String]) {
    let mut files = files();
    files.retain(|file| names.is_empty() || names.iter().any(|name| file_name(file).starts_with(name)));
    if files.is_empty() || !tree::evaluator().exists() {
        steps.step("evaluator", || {
            let missing = format!("no such files in the shared data folder ({})", tree::shared().display());
            if tree::on_build_server() { bail!("{missing}") } else { Ok(Outcome::Skipped(missing)) }
        });
        return;
    }
    let jobs: Vec<(&str, &Path)> =
        METHODS.into_iter().flat_map(|method| files.iter().map(move |file| (method, file.as_path()))).collect();
    let mut found = Vec::new();
    steps.step("evaluator", || {
        found = judge_all(&jobs)?;
        Ok(Outcome::Passed(format!("{} methods on {} files", METHODS.len(), files.len())))
    });
    let mut found = found.into_iter();
    for method in METHODS {
        add_steps_of(steps, method, &mut found.by_ref().take(files.len()));
    }
}

/// A file by its name, and what was found in it.
type Found = (String, PathBuf, Result<Judged>);

/// Judges each method on its file, as many at once as the machine has cores, and gives what was found in the order of the jobs.
fn judge_all(jobs: &[(&str, &Path)]) -> Result<Vec<Found>> {
    // Prepared here: two at once would prepare it in each other's way.
    let python = tools::python()?;
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(&(method, file)) = jobs.get(i) else { return done };
            println!("{method}, {}", file_name(file));
            done.push((i, (file_name(file), file.to_owned(), judge(file, method, &python))));
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let mut found: Vec<(usize, Found)> = thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        workers
            .into_iter()
            .map(|worker| worker.join().map_err(|_| anyhow!("judging panicked")))
            .collect::<Result<Vec<_>>>()
    })?
    .into_iter()
    .flatten()
    .collect();
    found.sort_by_key(|(i, _)| *i);
    Ok(found.into_iter().map(|(_, found)| found).collect())
}

/// Adds a step for each file, which holds what was found against the limits, and prints the table of them.
fn add_steps_of(steps: &mut Steps, method: &str, found: &mut dyn Iterator<Item = Found>) {
    let mut rows = Vec::new();
    let mut all_short = Vec::new();
    let mut growth = None;
    for (name, file, judged) in found {
        let step = if method == limits::USUAL_METHOD { name.clone() } else { format!("{name}, {method}") };
        steps.step(format!("evaluator: {step}"), || {
            let judged = judged?;
            print!("{}", judged.text);
            print_worst(&judged.rows);
            let held = limits::hold(method, &name, &judged.summary);
            rows.push(row(&name, &judged, &held));
            if name == bench::LONG {
                growth = Some(exponent(&file, &judged)?);
            }
            let mut faults = judged.faults;
            faults.extend(held.broken);
            for fault in &faults {
                println!("{step}: {fault}");
            }
            let short: Vec<String> = held.short.iter().map(ToString::to_string).collect();
            all_short.extend(short.iter().map(|short| format!("{step}: {short}")));
            if !faults.is_empty() {
                bail!("{}", faults.join("; "))
            }
            if !short.is_empty() {
                return Ok(Outcome::Short(short.join("; ")));
            }
            Ok(Outcome::Passed(format!("{} strokes reach every goal", judged.summary["strokes"])))
        });
    }
    println!("\n{method}:\n");
    table::print(HEADER, &rows);
    if !all_short.is_empty() {
        println!("\n{SHORT} SHORT OF GOAL:");
        for short in &all_short {
            println!("  {short}");
        }
    }
    if let Some(exponent) = growth {
        println!(
            "\ngrowth over {}: ms ~ length^{exponent:.2}, each stroke timed once (see `cargo xtask bench`)",
            bench::LONG
        );
    }
}

/// How the time for a stroke grows with its length.
fn exponent(file: &Path, judged: &Judged) -> Result<f64> {
    let strokes = data::load(file)?;
    let timed = judged.rows.iter().filter_map(|row| {
        let stroke = strokes.iter().find(|stroke| row["name"] == *stroke.name)?;
        Some((data::polyline_length(stroke), row["ms"].as_f64()?))
    });
    Ok(bench::exponent(timed))
}

/// The stroke files, in order of name.
fn files() -> Vec<PathBuf> {
    let entries = fs::read_dir(tree::strokes()).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut files: Vec<PathBuf> = entries.filter(|path| is_strokes(&file_name(path))).collect();
    files.sort();
    files
}

fn is_strokes(name: &str) -> bool {
    name.ends_with(".json") && !name.ends_with("-truth.json")
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

struct Judged {
    /// What fitter and evaluator say.
    text: String,
    summary: Value,
    rows: Vec<Value>,
    faults: Vec<String>,
}

fn judge(strokes: &Path, method: &str, python: &Path) -> Result<Judged> {
    let name = file_name(strokes);
    let spline = tree::scratch("evaluate")?.join(format!("{method}-{name}"));
    let figures = spline.with_extension("figures.json");
    let mut faults = Vec::new();

    // One thread, so that the times in the table are the strokes' own.
    let mut fit = Command::new(tree::fairpath()?);
    fit.arg("fit").arg(strokes).arg("-o").arg(&spline).args(["--threads", "1", "--method", method]);
    let ran = process::capture_within(&mut fit, LIMIT)?;
    if !matches!(ran.code, Some(0 | 1)) {
        bail!("{} ended with {:?}:\n{}", process::shown(&fit), ran.code, ran.text);
    }
    let mut text = String::new();
    if ran.text.contains("panicked") {
        text.push_str(&ran.text);
        faults.push("the fitter panicked".into());
    }
    for failure in read_json(&spline)?["failures"].as_array().into_iter().flatten() {
        if failure["code"] != limits::ALLOWED_REFUSAL {
            faults.push(format!("refused: {failure}"));
        }
    }

    let mut evaluator = Command::new(python);
    evaluator.arg(tree::evaluator()).arg(strokes).arg(&spline).arg("--json").arg(&figures).arg("--quiet");
    let truth = strokes.with_file_name(name.replace(".json", "-truth.json"));
    if truth.exists() {
        evaluator.arg("--truth").arg(truth);
    }
    let ran = process::capture(&mut evaluator)?;
    text.push_str(&ran.text);
    if ran.code != Some(0) {
        faults.push("the evaluator found faults".into());
    }
    let figures = read_json(&figures)?;
    let rows = figures["rows"].as_array().cloned().unwrap_or_default();
    for row in &rows {
        for fault in row["faults"].as_array().into_iter().flatten() {
            faults.push(format!("{}: {}", row["name"].as_str().unwrap_or("?"), fault.as_str().unwrap_or("?")));
        }
    }
    Ok(Judged { text, summary: figures["summary"].clone(), rows, faults })
}

/// Names the strokes that are furthest off, where any is too far: it is them that one wants to see.
fn print_worst(rows: &[Value]) {
    for figure in ["dev_max", "rev_max"] {
        let Some(limit) = limits::EVERY_FILE.iter().find(|limit| limit.figure == figure) else { continue };
        let value = |row: &&Value| row[figure].as_f64().unwrap_or(f64::INFINITY);
        let mut worst: Vec<&Value> = rows.iter().filter(|row| value(row) > limit.goal).collect();
        worst.sort_by(|a, b| value(b).total_cmp(&value(a)));
        for row in worst.iter().take(WORST) {
            println!("  {figure} {:.1}: {}", value(row), row["name"].as_str().unwrap_or("?"));
        }
    }
}

fn read_json(path: &Path) -> Result<Value> {
    let text = fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
    serde_json::from_slice(&text).with_context(|| format!("{} is no JSON", path.display()))
}

fn row(name: &str, judged: &Judged, held: &limits::Held) -> Vec<String> {
    let sum = |key: &str| judged.rows.iter().filter_map(|row| row[key].as_u64()).sum::<u64>();
    let figure = |key: &str| match &judged.summary[key] {
        Value::Null => "-".to_owned(),
        value if held.above.contains(&key) => format!("{SHORT} {value}"),
        value => value.to_string(),
    };
    let mut cells = vec![name.to_owned(), figure("strokes"), figure("refused"), figure("segments")];
    cells.push(format!("{}/{}/{}", sum("lines"), sum("arcs"), sum("clothoids")));
    for key in [
        "corners",
        "dev_rms_mean",
        "dev_max_p99",
        "dev_max",
        "rev_max",
        "truth_rms_mean",
        "missed_corners",
        "extra_corners",
        "ms_total",
        "ms_max",
    ] {
        cells.push(figure(key));
    }
    cells
}
