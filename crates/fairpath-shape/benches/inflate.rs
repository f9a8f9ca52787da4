//! Times of inflating, asserted on what they time: the same shape with more and more triangles, which shows how time grows, and
//! shapes with corners and narrow places.
//!
//! `cargo bench -p fairpath-shape`

#[path = "../tests/common/shapes.rs"]
mod shapes;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fairpath_curve::Spline;
use fairpath_shape::{InflateOptions, inflate};
use std::hint::black_box;

fn time(c: &mut Criterion, name: &str, spline: &Spline, triangles: u32) {
    let options = InflateOptions { triangles, ..InflateOptions::default() };
    let mesh = inflate(spline, &options).expect("it can be inflated").mesh;
    assert!(mesh.faults().is_empty() && mesh.euler_characteristic() == 2, "{name}: {:?}", mesh.faults().first());
    let count = mesh.triangles.len();
    assert!((0.7..1.4).contains(&(count as f64 / f64::from(triangles))), "{name}: {count} triangles");
    let mut group = c.benchmark_group("inflate");
    group.throughput(Throughput::Elements(count as u64)).sample_size(10);
    group.bench_function(BenchmarkId::new(name, triangles), |b| b.iter(|| inflate(black_box(spline), &options)));
    group.finish();
}

fn surfaces(c: &mut Criterion) {
    time(c, "circle", &shapes::circle((0.0, 0.0), 1.0), 50_000);
    let ellipse = shapes::ellipse(2.0, 1.0, 0.3);
    for triangles in [5_000, 50_000, 500_000] {
        time(c, "ellipse", &ellipse, triangles);
    }
    time(c, "flower", &shapes::flower(5, 0.3), 50_000);
    time(c, "square", &shapes::polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]), 50_000);
}

criterion_group!(benches, surfaces);
criterion_main!(benches);
