//! Times of fits in curvature space, asserted on what they time: a short stroke, one of 1,000 points, and meanders of 2,500, 5,000 and
//! 10,000 px, which show how time grows with length. `cargo xtask growth` prints that over the number of points, beside the other methods.
//!
//! `cargo bench -p fairpath-fit --bench curvature_space`

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fairpath_curve::Point;
use fairpath_fit::{CurvatureSpaceOptions, Mode, Stroke, fit_curvature_space};
use std::hint::black_box;
use std::ops::RangeInclusive;

/// Tremor of about half a pixel that is the same on every run.
fn tremor(i: usize) -> f64 {
    0.5 * (1.7 * i as f64).sin() + 0.3 * (5.3 * i as f64).sin()
}

/// A river of bends 100 px wide: `length` px along its middle, a point every `step` px of that.
fn meander(length: f64, step: f64) -> Stroke {
    let at = |i: usize| (step * i as f64, 45.0 * (step * i as f64 / 48.0).sin());
    let n = (length / step) as usize;
    let shaken = (0..=n).map(|i| (i, at(i))).map(|(i, (x, y))| Point::new(x + tremor(i), y + tremor(i + 7)));
    Stroke::new("meander", shaken.collect())
}

fn time(
    c: &mut Criterion,
    name: &str,
    stroke: &Stroke,
    options: &CurvatureSpaceOptions,
    segments: RangeInclusive<usize>,
) {
    let result = fit_curvature_space(stroke, options).expect("it is a curve");
    let count = result.spline.segments().len();
    assert!(segments.contains(&count), "{name}: {count} segments, not {segments:?}");
    if options.mode == Mode::Refined {
        assert!(result.report.rms_deviation < 1.5 && result.warnings.is_empty(), "{name}: {:?}", result.report);
    }
    let mut group = c.benchmark_group("curvature_space");
    group.throughput(Throughput::Elements(stroke.points.len() as u64)).sample_size(20);
    group.bench_function(BenchmarkId::from_parameter(name), |b| {
        b.iter(|| fit_curvature_space(black_box(stroke), options))
    });
    group.finish();
}

fn fits(c: &mut Criterion) {
    let refined = CurvatureSpaceOptions::default();
    let faithful = CurvatureSpaceOptions { mode: Mode::Faithful, target_error: None, ..refined.clone() };
    let blended = CurvatureSpaceOptions { blend: 8.0, ..refined.clone() };
    time(c, "ordinary", &meander(160.0, 6.0), &refined, 1..=5);
    time(c, "1000 points on 2500 px", &meander(2500.0, 2.5), &refined, 10..=45);
    time(c, "1000 points on 2500 px, blended", &meander(2500.0, 2.5), &blended, 80..=360);
    time(c, "1000 points on 2500 px, faithful", &meander(2500.0, 2.5), &faithful, 10..=60);
    for (length, segments) in [(2500.0, 10..=45), (5000.0, 22..=90), (10_000.0, 45..=180)] {
        time(c, &format!("meander of {length} px"), &meander(length, 5.0), &refined, segments);
    }
}

criterion_group!(benches, fits);
criterion_main!(benches);
