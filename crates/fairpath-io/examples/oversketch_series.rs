//! Draws a series of corrections, as figure 8 of Baran, Lehtinen and Popović (2010):
//! `cargo run -p fairpath-io --example oversketch_series -- docs/oversketch.svg|OUT.png`. The same bytes on every run.

use fairpath_curve::{Point, Spline};
use fairpath_fit::{
    FitOptions, OversketchError, OversketchMode, OversketchOptions, Oversketched, Stroke, fit, oversketch,
};
use fairpath_io::picture::{Comb, Correction, PictureOptions, draw_corrections};
use fairpath_io::{YAxis, write_whole};
use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// Tremor of a hand, the same on every run, px.
fn tremor(i: usize) -> f64 {
    0.4 * (1.7 * i as f64).sin() + 0.25 * (5.3 * i as f64).sin()
}

/// A stroke through points on a course, drawn with a little tremor.
fn stroke(name: &str, count: usize, course: impl Fn(f64) -> (f64, f64)) -> Stroke {
    let point = |i: usize| {
        let (x, y) = course(i as f64 / (count - 1) as f64);
        Point::new(x + tremor(i), y + tremor(i + 11))
    };
    Stroke::new(name, (0..count).map(point).collect())
}

/// A course along straight lines between vertices.
fn along(vertices: &[(f64, f64)], u: f64) -> (f64, f64) {
    let length = |w: &[(f64, f64)]| (w[1].0 - w[0].0).hypot(w[1].1 - w[0].1);
    let mut left = u * vertices.windows(2).map(length).sum::<f64>();
    for w in vertices.windows(2) {
        let t = left / length(w);
        if t <= 1.0 {
            return (w[0].0 + t * (w[1].0 - w[0].0), w[0].1 + t * (w[1].1 - w[0].1));
        }
        left -= length(w);
    }
    vertices[vertices.len() - 1]
}

/// A wave.
fn wave() -> Stroke {
    stroke("wave", 90, |u| (420.0 * u, height(420.0 * u)))
}

fn height(x: f64) -> f64 {
    60.0 * (2.5 * PI * x / 420.0).sin()
}

/// The wave between two places, moved in the middle by so much.
fn changed(from: f64, to: f64, by: f64) -> Stroke {
    let at = |u: f64| from + (to - from) * u;
    stroke("over", 36, |u| (at(u), height(at(u)) + by * (PI * u).sin().powi(2)))
}

fn oval() -> Stroke {
    stroke("oval", 100, |u| (140.0 * (TAU * u).cos(), 90.0 * (TAU * u).sin()))
}

/// A case: its name, the curve and the stroke over it.
type Case = (&'static str, Stroke, Stroke, OversketchMode);

fn cases() -> Vec<Case> {
    let own = OversketchMode::ShortestPath;
    let rect = [(0.0, 0.0), (260.0, 0.0), (260.0, 150.0), (0.0, 150.0), (0.0, 1.0)];
    let arm = |u: f64| (300.0 * u, 40.0 * (PI * u).sin());
    vec![
        ("a bend drawn deeper", wave(), changed(185.0, 320.0, -45.0), own),
        ("a small correction", wave(), changed(50.0, 125.0, 9.0), own),
        (
            "a large bulge on a straight line",
            stroke("line", 40, |u| (400.0 * u, 0.0)),
            stroke("s", 40, |u| (110.0 + 180.0 * u, -85.0 * (PI * u).sin().powf(1.3))),
            own,
        ),
        (
            "past an end",
            stroke("arm", 50, arm),
            stroke("s", 40, |u| (240.0 + 200.0 * u, 25.0 - 18.0 * u - 55.0 * (PI * u).sin() * u)),
            own,
        ),
        (
            "over a corner, which is rounded",
            stroke("rect", 130, |u| along(&rect[..3], u)),
            stroke("s", 30, |u| (190.0 + 70.0 * (0.5 * PI * u).sin(), 80.0 - 80.0 * (0.5 * PI * u).cos())),
            own,
        ),
        (
            "over a corner, with a new one",
            stroke("rect", 130, |u| along(&rect[..3], u)),
            stroke("s", 40, |u| along(&[(180.0, 1.0), (300.0, -30.0), (259.0, 90.0)], u)),
            own,
        ),
        (
            "a side drawn against its direction",
            oval(),
            stroke("s", 40, |u| (115.0 - 230.0 * u, -50.0 - 70.0 * (PI * u).sin())),
            own,
        ),
        (
            "across the start of a closed curve",
            oval(),
            stroke("s", 40, |u| (118.0 + 60.0 * (PI * u).sin(), 55.0 - 105.0 * u)),
            own,
        ),
        (
            "between two corners of a closed curve",
            stroke("rect", 150, |u| along(&rect, u)),
            stroke("s", 40, |u| (260.0 * u, -45.0 * (PI * u).sin())),
            own,
        ),
        (
            "a loop in a line",
            stroke("arm", 50, arm),
            stroke("s", 60, |u| (140.0 + 20.0 * u + 45.0 * (TAU * u).sin(), 38.0 - 45.0 * (1.0 - (TAU * u).cos()))),
            own,
        ),
        ("blended in locally", wave(), changed(185.0, 320.0, -45.0), OversketchMode::LocalBlend),
        ("fitted anew as a whole", wave(), changed(185.0, 320.0, -45.0), OversketchMode::Refit),
    ]
}

fn main() -> Result<(), Box<dyn Error>> {
    let output = std::env::args().nth(1).ok_or("usage: oversketch_series OUT.svg|OUT.png")?;
    let cases = cases();
    let mut done: Vec<(&str, Spline, &Stroke, Oversketched)> = Vec::new();
    for (name, drawn, over, mode) in &cases {
        let before = fit(drawn, &FitOptions::default())?.spline;
        let options = OversketchOptions { mode: *mode, ..OversketchOptions::default() };
        let result: Result<Oversketched, OversketchError> = oversketch(&before, over, &options);
        let result = result?;
        println!(
            "{name}: {} of {} segments new, {:.2} px off, {:?}",
            result.new.len(),
            result.spline.segments().len(),
            result.report.max_deviation,
            result.warnings.iter().map(|w| w.code.as_str()).collect::<Vec<_>>()
        );
        done.push((name, before, over, result));
    }
    let corrections: Vec<Correction<'_>> =
        done.iter().map(|(name, before, stroke, result)| Correction { name, before, stroke, result }).collect();
    let mut options = PictureOptions::default();
    options.comb = Comb::Auto;
    let picture = draw_corrections(&corrections, YAxis::Down, &options);
    let bytes = if output.ends_with(".png") { picture.to_png()? } else { picture.to_svg().as_bytes().to_vec() };
    write_whole(Path::new(&output), &bytes)?;
    Ok(())
}
