//! Times of the kernel's two daily operations, evaluation and projection, beside kurbo's cubic Bézier and asserted on what
//! they time. `tools/bench_pyclothoids.py` prints the same two for pyclothoids.
//!
//! `cargo bench -p fairpath-curve`

use criterion::{Criterion, criterion_group, criterion_main};
use fairpath_curve::{Point, Segment, Vec2};
use kurbo::{CubicBez, ParamCurve, ParamCurveNearest};
use std::hint::black_box;

/// Segments as fits make them: turning from 0.1 to 2 rad, inflected ones among them.
fn ordinary() -> Vec<Segment> {
    (0..64)
        .map(|i| {
            let u = f64::from(i) / 63.0;
            let (length, turn) = (20.0 + 60.0 * u, 0.1 + 1.9 * (u * 7.0 % 1.0));
            let skew = 1.2 * (u * 5.0 % 1.0);
            Segment::clothoid(
                Point::new(100.0 * u, 50.0),
                6.0 * u - 3.0,
                length,
                turn * (1.0 - skew) / length,
                turn * (1.0 + skew) / length,
            )
        })
        .collect()
}

/// Spirals that turn by 100 rad.
fn spirals() -> Vec<Segment> {
    (0..8).map(|i| Segment::clothoid(Point::ORIGIN, f64::from(i), 100.0, 0.0, 2.0)).collect()
}

/// Points beside each segment at up to a quarter of its length.
fn beside(segments: &[Segment]) -> Vec<(Segment, Point)> {
    segments
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let u = (i as f64 * 0.618).fract();
            let at = u * s.length;
            let t = s.tangent_at(at);
            let away = (0.25 * (i as f64 * 0.37).fract() - 0.125) * s.length;
            (*s, s.point_at(at) + Vec2::new(-t.y, t.x) * away)
        })
        .collect()
}

fn evaluation(c: &mut Criterion) {
    let ordinary = ordinary();
    let cubics: Vec<CubicBez> = ordinary.iter().map(|s| s.to_beziers(1e9)[0]).collect();
    for (s, b) in ordinary.iter().zip(&cubics) {
        assert!((b.eval(1.0) - s.end()).hypot() < 1e-9, "both time the same curve");
    }
    let mut group = c.benchmark_group("evaluation");
    for (name, segments) in [("segment", &ordinary), ("spiral of 100 rad", &spirals())] {
        let mut i = 0;
        group.bench_function(name, |b| {
            b.iter(|| {
                i = (i + 1) % segments.len();
                let s = &segments[i];
                black_box(s).point_at(black_box(0.7 * s.length))
            });
        });
    }
    let mut i = 0;
    group.bench_function("kurbo cubic", |b| {
        b.iter(|| {
            i = (i + 1) % cubics.len();
            black_box(&cubics[i]).eval(black_box(0.7))
        });
    });
    let mut i = 0;
    group.bench_function("position and jacobian", |b| {
        b.iter(|| {
            i = (i + 1) % ordinary.len();
            let s = &ordinary[i];
            black_box(s).position_jacobian(black_box(0.7 * s.length))
        });
    });
    group.finish();
}

fn projection(c: &mut Criterion) {
    let ordinary = beside(&ordinary());
    let spirals = beside(&spirals());
    for (s, p) in ordinary.iter().chain(&spirals) {
        let found = s.nearest(*p);
        for i in 0..=1000 {
            assert!(s.point_at(s.length * f64::from(i) / 1000.0).distance(*p) >= found.distance - 1e-9);
        }
    }
    let mut group = c.benchmark_group("projection");
    for (name, cases) in [("segment", &ordinary), ("spiral of 100 rad", &spirals)] {
        let mut i = 0;
        group.bench_function(name, |b| {
            b.iter(|| {
                i = (i + 1) % cases.len();
                black_box(&cases[i].0).nearest(black_box(cases[i].1))
            });
        });
    }
    let cubics: Vec<(CubicBez, Point)> = ordinary.iter().map(|(s, p)| (s.to_beziers(1e9)[0], *p)).collect();
    let mut i = 0;
    group.bench_function("kurbo cubic, to 1e-9", |b| {
        b.iter(|| {
            i = (i + 1) % cubics.len();
            black_box(&cubics[i].0).nearest(black_box(cubics[i].1), 1e-9)
        });
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(std::time::Duration::from_millis(300))
        .measurement_time(std::time::Duration::from_millis(1000));
    targets = evaluation, projection
}
criterion_main!(benches);
