//! The page, judged by a browser: it starts, records what is drawn by mouse, finger and pen, finds the very curves that the command line finds,
//! gives and takes files, keeps the drawing, and says so where it cannot work. How fast it is, is told.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use serde_json::{Value, json};

use crate::steps::Outcome;
use crate::web::{self, Kind, Server, Toolchain};
use crate::{process, tools, tree};

/// The time from navigation to the first frame that is wanted on this machine; told, not judged, since other machines are slower.
const WANTED_READY_MS: f64 = 3000.0;

/// How long the browser may take for everything: long, since it is told here only that it hangs, and others may use the machine too.
const DRIVE_LIMIT: Duration = Duration::from_secs(900);

/// With this the script begins the line of a step in which something is not as it must be.
const FAULT: &str = "FAULT in";

/// How many strokes of a shared file are drawn beside the example.
const SHARED_STROKES: usize = 2;

/// Builds a page and drives it.
pub(crate) fn step(kind: Kind) -> Result<Outcome> {
    match tools_ready() {
        Ok((browser, folder)) => {
            let page = web::build(kind, Toolchain::Auto)?;
            println!("{page}");
            judge(&page.folder, &browser, &folder)
        }
        Err(error) if tree::on_build_server() => Err(error),
        Err(error) => Ok(Outcome::Skipped(format!("{error:#}"))),
    }
}

/// The browser, and the folder with what drives it.
pub(crate) fn tools_ready() -> Result<(PathBuf, PathBuf)> {
    let browser = tools::path_of(tools::chromium()?)?;
    Ok((browser, tools::node_packages("web")?))
}

fn judge(page: &Path, browser: &Path, packages: &Path) -> Result<Outcome> {
    let out = tree::scratch("judge-web")?;
    for old in ["seen.json", "recorded.json", "saved.svg", "saved.json"] {
        if out.join(old).exists() {
            fs::remove_file(out.join(old))?;
        }
    }
    let broken = damaged(page, &out.join("damaged"))?;
    let (good, bad) = (Server::start(page, 0)?, Server::start(&broken, 0)?);
    let task = json!({
        "url": good.url(), "brokenUrl": bad.url(), "browser": browser, "strokes": strokes()?, "examples": tree::root().join("examples"),
        "out": out,
    });
    let task_file = out.join("task.json");
    fs::write(&task_file, task.to_string())?;
    let script = tree::root().join("xtask/judges/web/drive.mjs");
    let drive =
        process::capture_within(Command::new("node").arg(script).arg(&task_file).current_dir(packages), DRIVE_LIMIT)?;
    print!("{}", drive.text);
    if drive.code != Some(0) {
        // The script's lines from the first fault on: what failed, in the browser's own words.
        let faults = drive.text.find(FAULT).map_or(drive.text.as_str(), |at| &drive.text[at..]).trim();
        bail!("the page does not do in the browser what it must (pictures are in {}): {faults}", out.display());
    }
    let seen: Value = serde_json::from_str(&fs::read_to_string(out.join("seen.json"))?)?;
    let curves = same_curves(&out, "saved.svg", &seen["state"]["pixel_size"])?;
    let ready_ms = seen["readyMs"].as_f64().context("the browser measured no time")?;
    let hint =
        if ready_ms > WANTED_READY_MS { format!(", more than the {WANTED_READY_MS} ms wanted") } else { String::new() };
    Ok(Outcome::Passed(format!(
        "drawn in a browser: {curves} curves as the command line makes them; ready in {ready_ms:.0} ms{hint}"
    )))
}

/// The curves of a file in `out` and those of the command line for the strokes that are recorded there, drawn with pixels of that size: the same
/// to the bit. How many there are.
pub(crate) fn same_curves(out: &Path, saved: &str, pixel_size: &Value) -> Result<usize> {
    let from = out.join(saved);
    let (saved, fitted) = (out.join("converted.json"), out.join("fitted.json"));
    let run = |args: &[&str], from: &Path, to: &Path| {
        process::run(Command::new(tree::fairpath()?).args(args).arg(from).arg("-o").arg(to))
    };
    run(&["convert"], &from, &saved)?;
    run(&["fit", "--no-times", "--pixel-size", &pixel_size.to_string()], &out.join("recorded.json"), &fitted)?;
    let (saved, fitted) = (curves(&saved)?, curves(&fitted)?);
    compare(&saved, &fitted)?;
    // A comparison that nothing can fail proves nothing.
    let mut bent = fitted.clone();
    bent[0] = bent[0].replacen("0.", "0.0", 1);
    if compare(&saved, &bent).is_ok() {
        bail!("the judge takes different curves for the same, so its word is worth nothing");
    }
    Ok(fitted.len())
}

/// Geometry and joins of each curve of a file, as text in which every bit of a number shows.
fn curves(file: &Path) -> Result<Vec<String>> {
    let text = fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
    let file: Value = serde_json::from_str(&text)?;
    let splines = file["splines"].as_array().context("a file of splines without any")?;
    let shape = |spline: &Value| json!([spline["closed"], spline["segments"], spline["joins"]]).to_string();
    Ok(splines.iter().map(shape).collect())
}

fn compare(saved: &[String], fitted: &[String]) -> Result<()> {
    if fitted.is_empty() || saved.len() != fitted.len() {
        bail!("{} curves were saved, and the command line made {}", saved.len(), fitted.len());
    }
    for (i, (saved, fitted)) in saved.iter().zip(fitted).enumerate() {
        if saved != fitted {
            bail!("curve {} differs:\n  saved        {saved}\n  command line {fitted}", i + 1);
        }
    }
    Ok(())
}

/// The strokes to draw, each a list of places in the window: the example's and, where the shared data are, some recorded by a tablet.
fn strokes() -> Result<Vec<Vec<[f64; 2]>>> {
    // Below what may lie along the top, beside what may lie along the sides.
    let mut strokes = laid_out(&tree::root().join("examples/hello.json"), 1, [330.0, 150.0, 360.0, 180.0])?;
    let wacom = tree::strokes().join("wacom.json");
    if wacom.is_file() || tree::on_build_server() {
        strokes.extend(laid_out(&wacom, SHARED_STROKES, [330.0, 380.0, 360.0, 220.0])?);
    } else {
        println!("skipped: the strokes of a tablet are not at {}", wacom.display());
    }
    Ok(strokes)
}

/// The longest strokes of a file, moved and scaled together into a box of left, top, width and height.
fn laid_out(file: &Path, count: usize, [left, top, width, height]: [f64; 4]) -> Result<Vec<Vec<[f64; 2]>>> {
    let mut strokes = fairpath_io::read_strokes(file, &fairpath_io::ReadOptions::default())?.strokes;
    strokes.sort_by_key(|stroke| std::cmp::Reverse(stroke.points.len()));
    strokes.truncate(count);
    let points = || strokes.iter().flat_map(|stroke| &stroke.points);
    let least = |of: fn(&fairpath_curve::Point) -> f64| points().map(of).fold(f64::INFINITY, f64::min);
    let most = |of: fn(&fairpath_curve::Point) -> f64| points().map(of).fold(f64::NEG_INFINITY, f64::max);
    let (x, y) = (least(|p| p.x), least(|p| p.y));
    let scale = (width / (most(|p| p.x) - x)).min(height / (most(|p| p.y) - y));
    if !(scale.is_finite() && scale > 0.0) {
        bail!("{} has no strokes that can be drawn", file.display());
    }
    // A mouse reports a place only where it differs from the one before.
    let place = |p: &fairpath_curve::Point| [left + scale * (p.x - x), top + scale * (p.y - y)];
    Ok(strokes
        .iter()
        .map(|stroke| {
            let mut places: Vec<_> = stroke.points.iter().map(place).collect();
            places.dedup();
            places
        })
        .collect())
}

/// The page with a program of which the middle was overwritten, in all its forms.
fn damaged(page: &Path, folder: &Path) -> Result<PathBuf> {
    web::copy(page, folder)?;
    let program = folder.join(web::PROGRAM_FILE);
    let mut bytes = fs::read(&program)?;
    let middle = bytes.len() / 2;
    bytes[middle..].iter_mut().take(4096).for_each(|byte| *byte = 0xff);
    fs::write(&program, bytes)?;
    for ending in ["br", "gz"] {
        fs::remove_file(folder.join(format!("{}.{ending}", web::PROGRAM_FILE)))?;
    }
    Ok(folder.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_that_differ_in_one_bit_or_are_missing_are_not_the_same() {
        let [one, other] = [["[false,0.1]".to_owned()], ["[false,0.10000000000000002]".to_owned()]];
        compare(&one, &one).unwrap();
        assert!(compare(&one, &other).is_err());
        assert!(compare(&one, &[one.clone(), one.clone()].concat()).is_err());
        assert!(compare(&[], &[]).is_err());
    }

    #[test]
    fn strokes_are_laid_into_their_box_without_repetition() {
        let drawn = laid_out(&tree::root().join("examples/hello.json"), 1, [100.0, 50.0, 300.0, 200.0]).unwrap();
        assert_eq!(drawn.len(), 1);
        assert!(drawn[0].len() > 100);
        for place in &drawn[0] {
            assert!((100.0..=400.001).contains(&place[0]) && (50.0..=250.001).contains(&place[1]), "{place:?}");
        }
        assert!(drawn[0].windows(2).all(|pair| pair[0] != pair[1]));
    }
}
