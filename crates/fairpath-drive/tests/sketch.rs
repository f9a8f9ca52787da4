//! Strokes on a map as plans of paths.

use fairpath_curve::{Continuity, Point};
use fairpath_drive::SketchScale;

/// A road up a slope with hairpins, as a survey has it: points some metres apart, each a little off.
fn serpentines(legs: usize, apart_m: f64, seed: u64) -> Vec<Point> {
    let mut state = seed;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let mut points = Vec::new();
    for leg in 0..legs {
        let (y, there) = (leg as f64 * apart_m, leg % 2 == 0);
        let length = 120.0 + 80.0 * noise();
        for i in 0..10 {
            let t = f64::from(i) / 9.0;
            let along = 200.0 + length * (if there { t } else { 1.0 - t } - 0.5) * 2.0;
            let wave = 6.0 * (6.0 * t).sin();
            points.push(Point::new(along + 3.0 * noise(), y + wave + 3.0 * noise()));
        }
    }
    points
}

#[test]
fn roads_with_many_hairpins_keep_to_their_strokes() {
    for (legs, apart_m, seed) in [(6, 40.0, 1), (14, 36.0, 2), (24, 45.0, 3), (30, 32.0, 4)] {
        let points = serpentines(legs, apart_m, seed);
        let scale = SketchScale { pixel_m: 2.0, min_radius_m: 12.0 };
        let sketched = scale.plan(&points, false).unwrap();
        assert!(sketched.farthest_m <= 14.0, "{legs} legs: {} m", sketched.farthest_m);
        assert!(sketched.plan.joins().iter().all(|join| *join >= Continuity::G2));
        let sharpest = sketched.plan.segments().iter().map(|s| s.kappa0.abs().max(s.kappa1.abs())).fold(0.0, f64::max);
        assert!(sharpest <= (1.0 + 1e-6) / 12.0, "{legs} legs: a radius of {} m", 1.0 / sharpest);
        let all = points.iter().map(|p| sketched.plan.nearest(*p).distance).fold(0.0, f64::max);
        assert!(all <= sketched.farthest_m + 1e-9);
    }
}
