//! Heights at crossings: the true minimum, the right order, clearances.

use fairpath_drive::{CrossingHeights, HeightError, HeightPoint, Over, PathPoints};
use proptest::prelude::*;

fn point(path: usize, point: usize) -> HeightPoint {
    HeightPoint { path, point }
}

/// A network of paths that cross each other at random, by a small generator of its own: the same on every platform.
fn network(seed: u64, paths: usize, crossings: usize) -> CrossingHeights {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut stations: Vec<Vec<f64>> = vec![Vec::new(); paths];
    let mut over = Vec::new();
    for _ in 0..crossings {
        let a = (random() * paths as f64) as usize;
        let b = (a + 1 + (random() * (paths - 1) as f64) as usize) % paths;
        for path in [a, b] {
            // Some crossings follow each other closely, as at an interchange.
            let gap = 0.5 + 200.0 * random().powi(3);
            let last = stations[path].last().copied().unwrap_or(0.0);
            stations[path].push(last + gap);
        }
        let [mut upper, mut lower] = [a, b].map(|path| point(path, stations[path].len() - 1));
        if random() < 0.5 {
            std::mem::swap(&mut upper, &mut lower);
        }
        over.push(Over { upper, lower });
    }
    let paths = stations.into_iter().map(|stations_m| PathPoints { stations_m }).collect();
    CrossingHeights { paths, over, level: Vec::new(), length_scale_m: 100.0 }
}

#[test]
fn one_crossing_has_the_heights_that_can_be_computed_by_hand() {
    let path = || PathPoints { stations_m: vec![50.0] };
    let over = vec![Over { upper: point(0, 0), lower: point(1, 0) }];
    let heights =
        CrossingHeights { paths: vec![path(), path()], over: over.clone(), level: Vec::new(), length_scale_m: 1.0 }
            .solve()
            .unwrap();
    // Both move by t: 2 t² + 1 / (4 t²) is least where t⁴ = 1/8.
    let t = 0.125_f64.powf(0.25);
    assert!((heights.paths[0][0] - t).abs() < 1e-12 && (heights.paths[1][0] + t).abs() < 1e-12, "{heights:?}");
    assert!((heights.cost - (2.0 * t * t + 0.25 / (t * t))).abs() < 1e-12);
    let scaled = heights.scaled_to_clearance(&over, 5.2);
    assert!((scaled.paths[0][0] - scaled.paths[1][0] - 5.2).abs() < 1e-12);
}

#[test]
fn newton_is_never_above_ten_thousand_steps_of_steepest_descent() {
    for seed in 0..200 {
        let network = network(seed, 2 + (seed % 5) as usize, 1 + (seed % 11) as usize);
        let newton = network.solve().unwrap();
        let descent = network.solve_by_descent(10_000).unwrap();
        // Rounding of the sum itself.
        assert!(newton.cost <= descent.cost * (1.0 + 1e-13), "{seed}: {} and {}", newton.cost, descent.cost);
        assert!(newton.steps < 60, "{seed}: {} steps", newton.steps);
    }
}

#[test]
fn a_ring_of_three_roads_at_three_crossings_is_legal() {
    // A over B, B over C, C over A: each road has two crossings.
    let paths = vec![PathPoints { stations_m: vec![0.0, 40.0] }; 3];
    let over = (0..3).map(|i| Over { upper: point(i, 0), lower: point((i + 1) % 3, 1) }).collect();
    let problem = CrossingHeights { paths, over, level: Vec::new(), length_scale_m: 40.0 };
    let heights = problem.solve().unwrap();
    for pair in &problem.over {
        let at = |p: HeightPoint| heights.paths[p.path][p.point];
        assert!(at(pair.upper) > at(pair.lower));
    }
    // Turned round by one road the network is the same.
    for path in &heights.paths[1..] {
        for (a, b) in path.iter().zip(&heights.paths[0]) {
            assert!((a - b).abs() < 1e-9, "{heights:?}");
        }
    }
}

#[test]
fn a_ring_at_one_place_is_named() {
    let paths = vec![PathPoints { stations_m: vec![10.0] }; 3];
    let over: Vec<Over> = (0..3).map(|i| Over { upper: point(i, 0), lower: point((i + 1) % 3, 0) }).collect();
    let error = CrossingHeights { paths, over, level: Vec::new(), length_scale_m: 1.0 }.solve().unwrap_err();
    let HeightError::Ring { mut overs, .. } = error.clone() else { panic!("{error}") };
    overs.sort_unstable();
    assert_eq!(overs, [0, 1, 2]);
    assert!(error.to_string().contains("undo one of the crossings"), "{error}");
}

#[test]
fn what_is_no_network_is_refused() {
    let one = |stations_m: Vec<f64>, over, length_scale_m| {
        CrossingHeights { paths: vec![PathPoints { stations_m }], over, level: Vec::new(), length_scale_m }.solve()
    };
    for bad in [vec![1.0, 1.0], vec![2.0, 1.0], vec![f64::NAN], vec![0.0, f64::INFINITY]] {
        assert!(matches!(one(bad, vec![], 1.0), Err(HeightError::Stations { .. })));
    }
    let over = vec![Over { upper: point(0, 0), lower: point(1, 0) }];
    assert_eq!(one(vec![1.0], over, 1.0), Err(HeightError::NoPoint { pair: 0, path: 1, point: 0 }));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(one(vec![1.0], vec![], bad), Err(HeightError::Scale));
    }
    assert_eq!(one(vec![], vec![], 1.0).unwrap().cost, 0.0);
}

proptest! {
    #[test]
    fn every_crossing_has_its_clearance(seed in 0..u64::MAX, paths in 2..12_usize, crossings in 1..60_usize) {
        let network = network(seed, paths, crossings);
        let heights = network.solve().unwrap().scaled_to_clearance(&network.over, 5.2);
        for pair in &network.over {
            let at = |p: HeightPoint| heights.paths[p.path][p.point];
            prop_assert!(at(pair.upper) - at(pair.lower) >= 5.2 * (1.0 - 1e-12));
        }
    }

    #[test]
    fn the_slope_is_nothing_at_the_minimum(seed in 0..u64::MAX, paths in 2..8_usize, crossings in 1..30_usize) {
        // The sum on both sides of the minimum, along each height, is no less.
        let network = network(seed, paths, crossings);
        let least = network.solve().unwrap();
        let cost = |heights: &[Vec<f64>]| {
            let mut sum: f64 = heights.iter().flatten().map(|y| y * y).sum();
            for (path, heights) in network.paths.iter().zip(heights) {
                for (s, y) in path.stations_m.windows(2).zip(heights.windows(2)) {
                    let grade = (y[1] - y[0]) / ((s[1] - s[0]) / network.length_scale_m);
                    sum += grade * grade;
                }
            }
            let at = |p: HeightPoint| heights[p.path][p.point];
            sum + network.over.iter().map(|pair| (at(pair.upper) - at(pair.lower)).powi(-2)).sum::<f64>()
        };
        prop_assert!((cost(&least.paths) - least.cost).abs() <= 1e-12 * least.cost);
        for path in 0..least.paths.len() {
            for i in 0..least.paths[path].len() {
                for by in [-1e-4, 1e-4] {
                    let mut moved = least.paths.clone();
                    moved[path][i] += by;
                    prop_assert!(cost(&moved) >= least.cost * (1.0 - 1e-13));
                }
            }
        }
    }
}

#[test]
fn points_that_are_level_share_one_height_and_count_as_two() {
    let path = |stations_m: &[f64]| PathPoints { stations_m: stations_m.to_vec() };
    // Path 0 passes over path 1 and then meets path 2, which does nothing else.
    let network = CrossingHeights {
        paths: vec![path(&[0.0, 100.0]), path(&[50.0]), path(&[10.0])],
        over: vec![Over { upper: point(0, 0), lower: point(1, 0) }],
        level: vec![[point(0, 1), point(2, 0)]],
        length_scale_m: 50.0,
    };
    let heights = network.solve().unwrap();
    let [y, z] = [heights.paths[0][1], heights.paths[2][0]];
    assert_eq!(y, z);
    // The shared height has the weight of two points: 2 · 2 z = 2 (y₀ − z) / 2².
    let upper = heights.paths[0][0];
    assert!((4.0 * z - 0.5 * (upper - z)).abs() < 1e-12, "{heights:?}");
    // A ring through what is level: over itself.
    let over = Over { upper: point(0, 1), lower: point(2, 0) };
    let ring = CrossingHeights { over: vec![over], ..network }.solve();
    assert!(matches!(ring, Err(HeightError::Ring { .. })), "{ring:?}");
}
