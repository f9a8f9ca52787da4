//! Parallel curves keep their distance and mark their cusps.

use crate::common::segment;
use fairpath_curve::{Point, Segment, Vec2};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn the_polyline_of_a_parallel_stays_within_the_accuracy(s in segment(10.0), d in -0.5..0.5, e in -6.0..-2.0) {
        let (distance, accuracy) = (d * s.length, libm::exp10(e) * s.length);
        let points = s.offset(distance, accuracy);
        let exact = |at: f64| {
            let t = s.tangent_at(at);
            s.point_at(at) + Vec2::new(-t.y, t.x) * distance
        };
        prop_assert_eq!(points[0].s, 0.0);
        prop_assert_eq!(points[points.len() - 1].s, s.length);
        for w in points.windows(2) {
            prop_assert!(w[0].s < w[1].s);
            let chord = w[1].point - w[0].point;
            for i in 1..6 {
                let p = exact(w[0].s + (w[1].s - w[0].s) * f64::from(i) / 6.0);
                let along = ((p - w[0].point).dot(chord) / chord.hypot2()).clamp(0.0, 1.0);
                let off = (p - (w[0].point + chord * if along.is_finite() { along } else { 0.0 })).hypot();
                prop_assert!(off <= accuracy * 1.000_001 + 1e-12 * s.length, "{off} > {accuracy}");
            }
        }
        let turns_back = (1.0 - s.kappa0 * distance) * (1.0 - s.kappa1 * distance) < 0.0;
        prop_assert_eq!(points.iter().filter(|p| p.is_cusp).count(), usize::from(turns_back));
    }
}

#[test]
fn the_parallel_of_a_circle_is_a_circle() {
    let circle = Segment::arc(Point::new(0.0, -2.0), 0.0, 10.0, 0.5);
    for distance in [-1.0, 1.0, 3.0] {
        for p in circle.offset(distance, 1e-3) {
            assert!((p.point.to_vec2().hypot() - (2.0 - distance).abs()).abs() < 1e-13);
            assert!((p.speed - (1.0 - 0.5 * distance)).abs() < 1e-14);
        }
    }
    assert!(circle.offset(f64::NAN, 1e-3).is_empty());
}
