//! Times of corrections, asserted on what they time: a bend drawn deeper, a closed curve across its start, an extension; the preview of one; and
//! a point that is moved.
//!
//! `cargo bench -p fairpath-fit --bench oversketch`

use criterion::{Criterion, criterion_group, criterion_main};
use fairpath_curve::{Point, Spline, Vec2};
use fairpath_fit::{
    Constraint, FitOptions, OversketchOptions, Stroke, fit, interpolate, oversketch, oversketch_region,
};
use std::f64::consts::{PI, TAU};
use std::hint::black_box;
use std::ops::RangeInclusive;

/// Tremor of about half a pixel that is the same on every run.
fn tremor(i: usize) -> f64 {
    0.4 * (1.7 * i as f64).sin() + 0.25 * (5.3 * i as f64).sin()
}

fn stroke(count: usize, course: impl Fn(f64) -> (f64, f64)) -> Stroke {
    let point = |i: usize| {
        let (x, y) = course(i as f64 / (count - 1) as f64);
        Point::new(x + tremor(i), y + tremor(i + 11))
    };
    Stroke::new("stroke", (0..count).map(point).collect())
}

fn fitted(stroke: &Stroke) -> Spline {
    fit(stroke, &FitOptions::default()).expect("it is a curve").spline
}

fn height(x: f64) -> f64 {
    60.0 * (2.5 * PI * x / 420.0).sin()
}

fn time(c: &mut Criterion, name: &str, old: &Spline, over: &Stroke, new: RangeInclusive<usize>) {
    let options = OversketchOptions::default();
    let result = oversketch(old, over, &options).expect("it can be corrected");
    assert!(new.contains(&result.new.len()), "{name}: {} new segments, not {new:?}", result.new.len());
    assert!(result.report.rms_deviation < 1.6 && result.warnings.is_empty(), "{name}: {:?}", result.report);
    c.bench_function(&format!("oversketch/{name}"), |b| b.iter(|| oversketch(black_box(old), over, &options)));
}

fn corrections(c: &mut Criterion) {
    let wave = fitted(&stroke(90, |u| (420.0 * u, height(420.0 * u))));
    let oval = fitted(&stroke(100, |u| (140.0 * (TAU * u).cos(), 90.0 * (TAU * u).sin())));
    let deeper = stroke(36, |u| {
        let x = 185.0 + 135.0 * u;
        (x, height(x) - 45.0 * (PI * u).sin().powi(2))
    });
    time(c, "a bend drawn deeper", &wave, &deeper, 3..=9);
    let bulge = stroke(40, |u| (118.0 + 60.0 * (PI * u).sin(), 55.0 - 105.0 * u));
    time(c, "across the start of an oval", &oval, &bulge, 2..=8);
    let longer = stroke(40, |u| (380.0 + 160.0 * u, height(380.0) + 30.0 * u * u));
    time(c, "past an end", &wave, &longer, 2..=6);

    let options = OversketchOptions::default();
    let region = oversketch_region(&wave, &deeper, &options).expect("it can be corrected");
    assert!(region.replaced[1] - region.replaced[0] > 120.0 && region.attached == [true; 2]);
    c.bench_function("oversketch/preview", |b| b.iter(|| oversketch_region(black_box(&wave), &deeper, &options)));

    let moved = Constraint::moved(200.0, wave.point_at(200.0) + Vec2::new(4.0, -7.0));
    let through = interpolate(&wave, &moved, 60.0).expect("it can be met");
    assert!(through.nearest(moved.point).distance < 1e-9);
    c.bench_function("edit/a point moved", |b| b.iter(|| interpolate(black_box(&wave), &moved, 60.0)));
}

criterion_group!(benches, corrections);
criterion_main!(benches);
