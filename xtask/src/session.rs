//! A long session in the desktop's window: recorded strokes are drawn one after the other into one drawing, then the window says how fast it was.

use std::fs;
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use fairpath_fit::Stroke;
use fairpath_sketch::{Drawing, decode_drawing, encode_drawing};
use serde_json::Value;

use crate::window::{Area, Hands, Key, Place, Program, Screen, is_tap, laid, pause, until};
use crate::{data, process, table, tree};

/// Files of strokes that people drew.
const FILES: [&str; 3] = ["quickdraw.json", "omniglot.json", "wacom.json"];

/// From one place of a stroke to the next, as of a mouse of 250 Hz.
const STEP: Duration = Duration::from_millis(4);

/// From one stroke to the next.
const BREATH: Duration = Duration::from_millis(200);

/// After the last one.
const LAST_BREATH: Duration = Duration::from_secs(2);

/// A stroke lies in an area of that size whose corner is in one of so many rows and columns, so that no panel is in the way.
const SIZE: [i32; 2] = [400, 280];
const CORNERS: [usize; 2] = [12, 13];

/// So many strokes at the beginning and at the end are compared.
const PART: usize = 100;

/// What is wanted.
const WANTED_MEDIAN_MS: f64 = 16.0;
const WANTED_P99_MS: f64 = 33.0;
const WANTED_FRAME_MS: f64 = 16.0;
const WANTED_MB: f64 = 300.0;

/// Builds the window, draws that many strokes in it and prints what it says of itself.
pub(crate) fn run(on_screen: bool, count: usize) -> Result<()> {
    let screen = if on_screen {
        Screen::of_person()?
    } else {
        Screen::prepare()?;
        Screen::start()?
    };
    process::run(&mut process::cargo(&["build", "--release", "--package", "fairpath-app"]))?;
    let exe = tree::target_folder()?.join("release/fairpath-app");
    let out = tree::scratch("session")?;
    let [empty, kept, pace] = ["empty.json", "kept.json", "pace.json"].map(|name| out.join(name));
    for old in [&kept, &pace] {
        if old.exists() {
            fs::remove_file(old)?;
        }
    }
    fs::write(&empty, encode_drawing(&Drawing::default())?)?;
    let strokes = strokes(count)?;
    let arguments = [Path::new("--kept"), &kept, Path::new("--pace"), &pace, &empty];
    let window = Program::start(&exe, &screen, &arguments, &out.join("window.log"))?;
    draw(&window.hands, &strokes)?;
    let drawing = until(Duration::from_secs(60), "the drawing to be kept with all its curves", || {
        if !kept.is_file() {
            return Ok(None);
        }
        let drawing = decode_drawing(&fs::read(&kept)?, "the kept drawing")?;
        let all = drawing.curves().len() == count && drawing.curves().iter().all(|curve| curve.fitted);
        Ok(all.then_some(drawing))
    })?;
    window.hands.picture()?.save(&out.join("session.png"))?;
    let peak_mb = window.peak_kb()? * 1024.0 / 1e6;
    let ended = window.close()?;
    ensure!(ended.code() == Some(0), "the window was closed, and its program ended with {ended}");
    let segments: usize = drawing.curves().iter().map(|curve| curve.spline.segments().len()).sum();
    println!(
        "{count} strokes became {count} curves of {segments} segments in one drawing; {}",
        out.join("session.png").display()
    );
    show(&pace, count, peak_mb)
}

/// That many strokes, from each file by turns so that the last are like the first.
fn strokes(count: usize) -> Result<Vec<Vec<Place>>> {
    let files = FILES.map(data::shared);
    let files: Vec<Vec<Stroke>> = files.into_iter().collect::<Result<_>>()?;
    let longest = files.iter().map(Vec::len).max().unwrap_or(0);
    let by_turns = (0..longest).flat_map(|i| files.iter().filter_map(move |file| file.get(i)));
    let laid = by_turns.enumerate().map(|(i, stroke)| laid(stroke, area(i)));
    let strokes: Vec<_> = laid.filter(|places| !is_tap(places)).take(count).collect();
    ensure!(strokes.len() == count, "there are but {} strokes that are no taps", strokes.len());
    Ok(strokes)
}

/// Where a stroke lies: the numbers of rows and columns have no common factor, so that all corners have their turn.
fn area(i: usize) -> Area {
    let [column, row] = CORNERS.map(|count| (i % count) as i32);
    Area { left: 100 + 37 * column, top: 110 + 23 * row, width: SIZE[0], height: SIZE[1] }
}

/// Draws them, each as a curve of its own although others are near.
fn draw(hands: &Hands, strokes: &[Vec<Place>]) -> Result<()> {
    hands.hold(Key::Alt, true)?;
    for (i, stroke) in strokes.iter().enumerate() {
        hands.move_to(stroke[0])?;
        hands.press()?;
        for place in stroke {
            hands.move_to(*place)?;
            pause(STEP);
        }
        hands.release()?;
        pause(BREATH);
        if (i + 1) % PART == 0 {
            println!("{} strokes are drawn", i + 1);
        }
    }
    // The window may still be at the last stroke.
    pause(LAST_BREATH);
    hands.hold(Key::Alt, false)
}

/// Prints what the window wrote of its pace.
fn show(file: &Path, count: usize, peak_mb: f64) -> Result<()> {
    let pace: Value = serde_json::from_slice(&fs::read(file).context("the window wrote no pace")?)?;
    let list = |name: &str| -> Result<Vec<f64>> {
        let list = pace[name].as_array().with_context(|| format!("the pace has no {name}"))?;
        Ok(list.iter().filter_map(Value::as_f64).collect())
    };
    let (curves, frames, handed, apart) =
        (list("curve_times_ms")?, list("frame_times_ms")?, list("handed_times_ms")?, list("apart_times_ms")?);
    ensure!(curves.len() == count, "the window timed {} curves of {count}", curves.len());
    let mut rows = Vec::new();
    for (what, times, part) in [
        ("from last point to curve", &curves, PART),
        ("own work for a picture while drawing", &frames, frames.len() / 5),
        ("the same with triangles and what is handed to the device", &handed, handed.len() / 5),
        ("from picture to picture, with all waiting", &apart, apart.len() / 5),
    ] {
        ensure!(!times.is_empty(), "nothing was timed {what}");
        let part = part.min(times.len());
        let parts = [("all", &times[..]), ("first", &times[..part]), ("last", &times[times.len() - part..])];
        for (which, times) in parts {
            let mut row = vec![what.to_owned(), which.to_owned(), times.len().to_string()];
            row.extend([0.5, 0.99, 1.0].map(|share| format!("{:.2}", quantile(times, share))));
            rows.push(row);
        }
    }
    println!();
    table::print(&["time, ms", "which", "count", "median", "99 of 100", "longest"], &rows);
    println!("\npeak memory of the whole process: {peak_mb:.0} MB\n");
    let [median, p99, frame] = [quantile(&curves, 0.5), quantile(&curves, 0.99), quantile(&frames, 0.99)];
    for (what, is, wanted, unit) in [
        ("half of the curves", median, WANTED_MEDIAN_MS, "ms"),
        ("99 of 100 curves", p99, WANTED_P99_MS, "ms"),
        ("99 of 100 pictures, own work", frame, WANTED_FRAME_MS, "ms"),
        ("memory", peak_mb, WANTED_MB, "MB"),
    ] {
        let verdict = if is < wanted { "as wanted" } else { "MORE THAN WANTED" };
        println!("{what}: {is:.1} {unit}, wanted under {wanted} {unit}: {verdict}");
    }
    Ok(())
}

/// The least time that this share of times does not exceed.
fn quantile(times: &[f64], share: f64) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = (sorted.len() as f64 * share).ceil() as usize;
    sorted.get(at.clamp(1, sorted.len().max(1)) - 1).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::quantile;

    #[test]
    fn quantiles_are_times_that_were_measured() {
        let times: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        assert_eq!([0.5, 0.99, 1.0].map(|share| quantile(&times, share)), [100.0, 198.0, 200.0]);
        assert_eq!(quantile(&[7.0], 0.5), 7.0);
        assert!(quantile(&[], 0.5).is_nan());
    }
}
