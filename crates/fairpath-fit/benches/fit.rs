//! Times of whole fits, asserted on what they time: a short stroke like most, a word, and a long meander, beside a longer one that
//! shows how time grows with length.
//!
//! `cargo bench -p fairpath-fit`

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fairpath_curve::Point;
use fairpath_fit::{FitOptions, Preset, Stroke, fit};
use std::hint::black_box;
use std::ops::RangeInclusive;

/// Tremor of about half a pixel that is the same on every run.
fn tremor(i: usize) -> f64 {
    0.5 * (1.7 * i as f64).sin() + 0.3 * (5.3 * i as f64).sin()
}

fn stroke(name: &str, points: impl Iterator<Item = (f64, f64)>) -> Stroke {
    let shaken = points.enumerate().map(|(i, (x, y))| Point::new(x + tremor(i), y + tremor(i + 7)));
    Stroke::new(name, shaken.collect())
}

/// One bend of 27 points on some 200 px, the median of the quick drawings.
fn ordinary() -> Stroke {
    stroke("ordinary", (0..27).map(|i| f64::from(i) / 26.0).map(|u| (160.0 * u, 70.0 * (4.0 * u).sin())))
}

/// Letters joined as by a pen: five loops of different sizes, 1,000 px.
fn word() -> Stroke {
    let at = |i: i32| {
        let a = f64::from(i) * std::f64::consts::TAU / 40.0;
        let tall = 18.0 + 14.0 * (0.37 * a).sin();
        (9.0 * a - 22.0 * a.sin(), 100.0 - tall * a.cos())
    };
    stroke("word", (0..200).map(at))
}

/// A river of bends 100 px wide: `length` px along its middle, a point every 7 px or so.
fn meander(length: f64) -> Stroke {
    let n = (length / 5.0) as i32;
    let at = |i: i32| (5.0 * f64::from(i), 45.0 * (f64::from(i) * 5.0 / 48.0).sin());
    stroke("meander", (0..=n).map(at))
}

fn time(c: &mut Criterion, name: &str, stroke: &Stroke, preset: Preset, segments: RangeInclusive<usize>) {
    let options = FitOptions::preset(preset);
    let result = fit(stroke, &options).expect("it is a curve");
    let count = result.spline.segments().len();
    assert!(segments.contains(&count), "{name}: {count} segments, not {segments:?}");
    assert!(result.report.rms_deviation < 1.5 && result.warnings.is_empty(), "{name}: {:?}", result.report);
    let mut group = c.benchmark_group("fit");
    group.throughput(Throughput::Elements(stroke.points.len() as u64)).sample_size(20);
    group.bench_function(BenchmarkId::from_parameter(name), |b| b.iter(|| fit(black_box(stroke), &options)));
    group.finish();
}

fn fits(c: &mut Criterion) {
    time(c, "ordinary", &ordinary(), Preset::Default, 2..=5);
    time(c, "word", &word(), Preset::Default, 10..=25);
    time(c, "word/lines-arcs", &word(), Preset::LinesArcs, 10..=40);
    time(c, "meander of 2500 px", &meander(2500.0), Preset::Default, 10..=30);
    time(c, "meander of 10000 px", &meander(10_000.0), Preset::Default, 45..=110);
}

criterion_group!(benches, fits);
criterion_main!(benches);
