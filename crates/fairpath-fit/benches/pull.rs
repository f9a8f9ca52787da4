//! Times of a curve that is pulled through one, two, five and ten points, as each move of a dragged pin asks for: asserted on what they time. A picture has
//! 16 ms.
//!
//! `cargo bench -p fairpath-fit --bench pull`

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use fairpath_curve::{Continuity, Point, Spline, Vec2};
use fairpath_fit::{Constraint, FitOptions, Stroke, fit, interpolate_all};
use std::f64::consts::TAU;
use std::hint::black_box;

const REACH: f64 = 80.0;

fn fitted(points: impl Iterator<Item = (f64, f64)>) -> Spline {
    let stroke = Stroke::new("stroke", points.map(|(x, y)| Point::new(x, y)).collect());
    fit(&stroke, &FitOptions::default()).expect("it is a curve").spline
}

/// Places at equal distances moved to one side and the other, by 6 to 30 px.
fn pulls(curve: &Spline, count: usize) -> Vec<Constraint> {
    let pull = |i: usize| {
        let pose = curve.pose_at(curve.length() * (i as f64 + 0.4) / count as f64);
        let by = (6.0 + 24.0 * (1.3 * i as f64).sin().abs()) * if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let station = curve.length() * (i as f64 + 0.4) / count as f64;
        Constraint::moved(station, pose.point + Vec2::new(-pose.heading.sin(), pose.heading.cos()) * by)
    };
    (0..count).map(pull).collect()
}

fn pulled(c: &mut Criterion) {
    let wave = fitted((0..180).map(|i| f64::from(i) * 5.0).map(|x| (x, 60.0 * (x / 70.0).sin())));
    let oval = fitted((0..120).map(|i| f64::from(i) * TAU / 120.0).map(|a| (200.0 * a.cos(), 130.0 * a.sin())));
    let mut group = c.benchmark_group("pull");
    for (name, curve) in [("wave", &wave), ("oval", &oval)] {
        for count in [1, 2, 5, 10] {
            let constraints = pulls(curve, count);
            let new = interpolate_all(curve, &constraints, REACH).expect("it can be met");
            assert!(constraints.iter().all(|constraint| new.nearest(constraint.point).distance < 1e-9));
            assert!(new.joins().iter().all(|join| *join >= Continuity::G2) && new.is_closed() == curve.is_closed());
            assert!(new.length() < 1.5 * curve.length(), "{name}, {count}: {} px", new.length());
            group.bench_function(BenchmarkId::new(name, count), |b| {
                b.iter(|| interpolate_all(black_box(curve), &constraints, REACH));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, pulled);
criterion_main!(benches);
