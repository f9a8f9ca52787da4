//! The curve of a stroke does not depend on where, how large and in which direction the stroke was drawn: on real strokes, moving,
//! turning, scaling (with the pixel size) and reversing change the number of segments rarely and the deviation hardly.
//!
//! Exact equality is not asked: sums are rounded differently, and where two paths cost nearly the same the other may win.

#[path = "common/corpus.rs"]
mod corpus;

use fairpath_curve::{Point, Vec2};
use fairpath_fit::{FitOptions, Stroke, fit};
use rayon::prelude::*;
use std::sync::OnceLock;

/// What is compared of a fit.
struct Figures {
    segments: usize,
    /// Root mean square distance of the stroke's points to the curve, px.
    deviation: f64,
    closed: bool,
}

/// Strokes of one file and the figures of their fits as drawn.
struct File {
    name: &'static str,
    strokes: Vec<(Stroke, Option<Figures>)>,
}

fn figures(stroke: &Stroke, pixel_size: f64) -> Option<Figures> {
    let options = FitOptions { pixel_size, ..FitOptions::default() };
    // A dot is a dot whichever way it is turned; anything else must fit.
    let spline = match fit(stroke, &options) {
        Ok(fit) => fit.spline,
        Err(e) if e.code() == "too-short" => return None,
        Err(e) => panic!("{}: {e}", stroke.name),
    };
    let squares: f64 = stroke.points.iter().map(|p| spline.nearest(*p).distance.powi(2)).sum();
    Some(Figures {
        segments: spline.segments().len(),
        deviation: (squares / stroke.points.len() as f64).sqrt() / pixel_size,
        closed: spline.is_closed(),
    })
}

/// The fits of the strokes as drawn, computed once for all tests.
fn files() -> Option<&'static [File]> {
    static FILES: OnceLock<Option<Vec<File>>> = OnceLock::new();
    FILES
        .get_or_init(|| {
            let file = |(name, strokes): (&'static str, Vec<Stroke>)| {
                let with_figures = |s: Stroke| {
                    let f = figures(&s, 1.0);
                    (s, f)
                };
                File { name, strokes: strokes.into_par_iter().map(with_figures).collect() }
            };
            Some(corpus::corpus()?.into_iter().map(file).collect())
        })
        .as_deref()
}

/// At most this many of the 758 strokes may get another number of segments: fewer than 1 in 100.
const WANTED: usize = 7;

/// Fits every stroke after `change` and compares: at most `most` strokes may differ.
fn compare(most: usize, pixel_size: f64, change: impl Fn(&[Point]) -> Vec<Point> + Sync) {
    let Some(files) = files() else { return };
    let (mut strokes, mut changed) = (0, Vec::new());
    let mut problems = Vec::new();
    for file in files {
        let after: Vec<Option<Figures>> = file
            .strokes
            .par_iter()
            .map(|(s, _)| figures(&Stroke::new(s.name.clone(), change(&s.points)), pixel_size))
            .collect();
        let (mut sum_before, mut sum_after) = (0.0, 0.0);
        for ((stroke, before), after) in file.strokes.iter().zip(&after) {
            let (Some(before), Some(after)) = (before, after) else {
                assert!(before.is_none() && after.is_none(), "{}: a dot in one position only", stroke.name);
                continue;
            };
            strokes += 1;
            sum_before += before.deviation;
            sum_after += after.deviation;
            if before.segments != after.segments || before.closed != after.closed {
                changed.push(format!(
                    "{} {}: {} -> {} segments, closed {} -> {}, rms {:.3} -> {:.3}",
                    file.name,
                    stroke.name,
                    before.segments,
                    after.segments,
                    before.closed,
                    after.closed,
                    before.deviation,
                    after.deviation
                ));
            }
        }
        println!("{}: mean rms {sum_before:.4} -> {sum_after:.4} (sums)", file.name);
        if (sum_after / sum_before - 1.0).abs() >= 0.05 {
            problems.push(format!("{}: sum of rms deviations {sum_before} -> {sum_after}", file.name));
        }
    }
    println!("{} of {strokes} changed:\n{}", changed.len(), changed.join("\n"));
    assert!(strokes > 700, "only {strokes} strokes were fitted");
    if changed.len() > most {
        problems.push(format!("{} of {strokes} strokes got another number of segments", changed.len()));
    }
    assert!(problems.is_empty(), "{}\n{}", problems.join("\n"), changed.join("\n"));
}

fn turned(points: &[Point], degrees: f64) -> Vec<Point> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    // About a place beside the drawing, so that it moves as well.
    let centre = Point::new(120.0, 80.0);
    let turn = |v: Vec2| Vec2::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos);
    points.iter().map(|p| centre + turn(*p - centre)).collect()
}

fn scaled(points: &[Point], factor: f64) -> Vec<Point> {
    points.iter().map(|p| (p.to_vec2() * factor).to_point()).collect()
}

#[test]
fn moving_a_stroke_moves_its_curve() {
    compare(WANTED, 1.0, |p| p.iter().map(|p| *p + Vec2::new(-1234.567, 8765.4321)).collect());
}

#[test]
fn turning_a_stroke_by_90_degrees_turns_its_curve() {
    compare(WANTED, 1.0, |p| turned(p, 90.0));
}

#[test]
fn turning_a_stroke_by_180_degrees_turns_its_curve() {
    compare(WANTED, 1.0, |p| turned(p, 180.0));
}

#[test]
fn turning_a_stroke_by_37_degrees_turns_its_curve() {
    compare(WANTED, 1.0, |p| turned(p, 37.0));
}

#[test]
fn turning_a_stroke_by_minus_100_degrees_turns_its_curve() {
    compare(WANTED, 1.0, |p| turned(p, -100.3));
}

#[test]
fn mirroring_a_stroke_mirrors_its_curve() {
    compare(WANTED, 1.0, |p| p.iter().map(|p| Point::new(-p.x, p.y)).collect());
}

#[test]
fn a_stroke_and_its_pixels_a_thousand_times_smaller_give_the_same_curve_smaller() {
    compare(WANTED, 1e-3, |p| scaled(p, 1e-3));
}

#[test]
fn a_stroke_and_its_pixels_7_3_times_larger_give_the_same_curve_larger() {
    compare(WANTED, 7.3, |p| scaled(p, 7.3));
}

#[test]
fn a_stroke_and_its_pixels_ten_thousand_times_larger_give_the_same_curve_larger() {
    compare(WANTED, 1e4, |p| scaled(p, 1e4));
}

#[test]
fn reversing_a_stroke_reverses_its_curve() {
    // A stroke is fitted in a direction of its own, so nothing at all may change.
    compare(0, 1.0, |p| p.iter().rev().copied().collect());
}
