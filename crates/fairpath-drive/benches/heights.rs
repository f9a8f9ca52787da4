//! How long it takes to find the heights of a network: 100 crossings shall take less than 5 ms.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use fairpath_drive::{CrossingHeights, HeightPoint, Over, PathPoints};

/// A grid of roads, each of which crosses all of the other direction, over and under by turns.
fn grid(side: usize) -> CrossingHeights {
    let paths =
        (0..2 * side).map(|_| PathPoints { stations_m: (1..=side).map(|i| 80.0 * i as f64).collect() }).collect();
    let over = (0..side * side)
        .map(|k| {
            let (i, j) = (k / side, k % side);
            let (a, b) = (HeightPoint { path: i, point: j }, HeightPoint { path: side + j, point: i });
            if (i + j) % 2 == 0 { Over { upper: a, lower: b } } else { Over { upper: b, lower: a } }
        })
        .collect();
    CrossingHeights { paths, over, level: Vec::new(), length_scale_m: 100.0 }
}

fn heights(c: &mut Criterion) {
    let mut group = c.benchmark_group("heights");
    for side in [5, 10, 20] {
        let problem = grid(side);
        let descent = problem.solve_by_descent(200).expect("it has heights");
        group.bench_with_input(BenchmarkId::new("newton", side * side), &problem, |b, problem| {
            b.iter(|| {
                let heights = problem.solve().expect("it has heights");
                assert!(heights.cost <= descent.cost);
                heights
            });
        });
    }
    group.finish();
}

criterion_group!(benches, heights);
criterion_main!(benches);
