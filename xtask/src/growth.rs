//! How the time of each method grows with the number of points, as figure 10 of McCrae and Singh (2011) shows it for theirs.

use std::time::Instant;

use anyhow::{Context, Result};
use fairpath_curve::{Point, Vec2, trig};
use fairpath_fit::{
    CurvatureSpaceOptions, FitOptions, FrenchCurveOptions, FrenchCurveStream, PieceSearch, Stroke, TemplateSet, fit,
    fit_curvature_space, fit_french_curve,
};
use fairpath_io::shipped_templates;

use crate::{bench, table};

const SIZES: [usize; 6] = [50, 100, 200, 500, 1000, 2000];

/// Growth is told from here on: smaller strokes are ruled by what every stroke costs.
const FROM: usize = 200;

/// Prints the table.
pub(crate) fn run(repeat: usize) -> Result<()> {
    let set = shipped_templates("burmester").context("the Burmester curves are missing")?;
    let greedy = FrenchCurveOptions { search: PieceSearch::Greedy, ..FrenchCurveOptions::default() };
    let mut rows = Vec::new();
    let mut times = [const { Vec::new() }; 4];
    for points in SIZES {
        let stroke = bends(points);
        let best = [
            best_ms(repeat, || fit(&stroke, &FitOptions::default()).is_ok()),
            best_ms(repeat, || fit_curvature_space(&stroke, &CurvatureSpaceOptions::default()).is_ok()),
            best_ms(repeat, || fit_french_curve(&stroke, &set, &FrenchCurveOptions::default()).is_ok()),
            best_ms(repeat, || fit_french_curve(&stroke, &set, &greedy).is_ok()),
        ];
        let mut row = vec![points.to_string()];
        for (times, ms) in times.iter_mut().zip(best) {
            let ms = ms.context("a method makes nothing of the stroke")?;
            row.push(format!("{ms:.2}"));
            if points >= FROM {
                times.push((points as f64, ms));
            }
        }
        row.push(format!("{:.2}", slowest_push(&stroke, &set, &greedy)?));
        rows.push(row);
    }
    println!(
        "Milliseconds for a stroke with a point every 5 px, one thread, the best of {repeat}; French curves by the Burmester set:\n"
    );
    let header = [
        "points",
        "shortest-path",
        "curvature-space",
        "french-curve",
        "french-curve, greedy",
        "slowest point while drawing",
    ];
    table::print(&header, &rows);
    let exponents: Vec<String> = times.into_iter().map(|t| format!("{:.2}", bench::exponent(t.into_iter()))).collect();
    println!("\ngrowth from {FROM} points on: ms ~ points^x, x = {}", exponents.join(", "));
    Ok(())
}

/// Bends of changing size, shaken by about half a pixel: the same on every run.
fn bends(count: usize) -> Stroke {
    let tremor = |i: f64| 0.4 * trig::sin_cos(1.7 * i).0 + 0.3 * trig::sin_cos(5.3 * i).0;
    let (mut at, mut heading) = (Point::ORIGIN, 0.0);
    let points = (0..count)
        .map(|i| {
            let s = 5.0 * i as f64;
            heading += 5.0 * (0.012 * trig::sin_cos(s / 90.0).0 + 0.008 * trig::sin_cos(s / 37.0).1);
            at += trig::unit(heading) * 5.0;
            at + Vec2::new(tremor(i as f64), tremor(i as f64 + 7.5))
        })
        .collect();
    Stroke::new("bends", points)
}

/// The best of so many; nothing if there was no result.
fn best_ms(repeat: usize, made: impl Fn() -> bool) -> Option<f64> {
    let mut best = f64::INFINITY;
    for _ in 0..repeat.max(1) {
        let begun = Instant::now();
        if !std::hint::black_box(made()) {
            return None;
        }
        best = best.min(begun.elapsed().as_secs_f64() * 1e3);
    }
    Some(best)
}

/// The longest that a stroke which is neatened while it is drawn keeps its drawer waiting at a point, milliseconds.
fn slowest_push(stroke: &Stroke, set: &TemplateSet, options: &FrenchCurveOptions) -> Result<f64> {
    let mut stream = FrenchCurveStream::new(set, options)?;
    let mut slowest = 0.0_f64;
    for &point in &stroke.points {
        let begun = Instant::now();
        std::hint::black_box(stream.push(point));
        slowest = slowest.max(begun.elapsed().as_secs_f64() * 1e3);
    }
    stream.finish()?;
    Ok(slowest)
}
