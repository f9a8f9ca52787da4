//! The nearest point against sampling, and its behaviour on degenerate input.

use crate::common::{distance_by_sampling, segment, spline};
use fairpath_curve::{Point, Segment, Vec2};
use proptest::prelude::*;

fn query() -> impl Strategy<Value = Vec2> {
    prop_oneof![
        (-1.5..1.5, -1.5..1.5).prop_map(|(x, y)| Vec2::new(x, y)),
        (-20.0..20.0, -20.0..20.0).prop_map(|(x, y)| Vec2::new(x, y)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn nearest_is_no_farther_than_dense_samples(s in segment(20.0), q in query()) {
        let p = s.start + q * s.length;
        let found = s.nearest(p);
        let sampled = distance_by_sampling(&s, p, 400);
        prop_assert!((0.0..=s.length).contains(&found.s));
        prop_assert!((s.point_at(found.s) - found.point).hypot() <= 1e-12 * s.length, "the point is that at s");
        let rounding = 1e-13 * (s.length + found.distance);
        prop_assert!(found.distance <= sampled + rounding, "{} > {}", found.distance, sampled);
        prop_assert!((found.distance - (found.point - p).hypot()).abs() <= rounding);
    }

    #[test]
    fn a_point_of_the_curve_is_its_own_nearest(s in segment(100.0), u in 0.0..1.0) {
        let p = s.point_at(u * s.length);
        prop_assert!(s.nearest(p).distance <= 2e-13 * s.length);
    }

    #[test]
    fn all_minima_hold_the_nearest_and_are_minima(s in segment(20.0), q in query()) {
        let p = s.start + q * s.length;
        let nearest = s.nearest(p);
        let all = s.nearest_all(p);
        let rounding = 1e-12 * (s.length + nearest.distance);
        let least = all.iter().map(|n| n.distance).fold(f64::INFINITY, f64::min);
        prop_assert!((least - nearest.distance).abs() <= rounding, "{least} {}", nearest.distance);
        for n in &all {
            for step in [-1e-7, 1e-7] {
                let beside = n.s + step * s.length;
                if (0.0..=s.length).contains(&beside) {
                    let d = (s.point_at(beside) - p).hypot();
                    prop_assert!(d >= n.distance - rounding, "{d} {}", n.distance);
                }
            }
        }
        prop_assert!(all.windows(2).all(|w| w[0].s < w[1].s));
    }

    #[test]
    fn every_minimum_among_samples_is_among_all(s in segment(20.0), q in query()) {
        let p = s.start + q * s.length;
        let all = s.nearest_all(p);
        let n = 500;
        let d: Vec<f64> = (0..=n).map(|i| (s.point_at(s.length * f64::from(i) / f64::from(n)) - p).hypot()).collect();
        let step = s.length / f64::from(n);
        for i in 1..d.len() - 1 {
            let clear = 1e-9 * s.length;
            if d[i] < d[i - 1] - clear && d[i] < d[i + 1] - clear {
                let at = i as f64 * step;
                prop_assert!(all.iter().any(|m| (m.s - at).abs() <= 1.01 * step), "no minimum near {at}: {all:?}");
            }
        }
    }

    #[test]
    fn no_segment_is_nearer_than_its_bound(s in spline(), q in query()) {
        let p = s.segments()[0].start + q * s.length();
        let bounds = s.distance_bounds(p);
        prop_assert_eq!(bounds.len(), s.segments().len());
        for (segment, bound) in s.segments().iter().zip(bounds) {
            prop_assert!(bound <= segment.nearest(p).distance + 1e-8 * s.length(), "{bound}");
        }
    }

    #[test]
    fn nearest_of_a_spline_is_the_best_of_its_segments(s in spline(), q in query()) {
        let p = Point::ORIGIN + q;
        let found = s.nearest(p);
        let best = s.segments().iter().map(|g| g.nearest(p).distance).fold(f64::INFINITY, f64::min);
        prop_assert!((found.distance - best).abs() <= 1e-13 * (1.0 + best));
        let on = s.segments()[found.segment].point_at(found.s);
        prop_assert!((on - found.point).hypot() <= 1e-12);
    }
}

#[test]
fn the_centre_of_a_circle_is_answered_quickly_and_once() {
    for segment in [
        Segment::arc(Point::ORIGIN, 0.3, 6.0, 1.0),
        Segment::clothoid(Point::ORIGIN, 0.3, 6.0, 1.0, 1.0 + 1e-15),
        Segment::arc(Point::ORIGIN, 0.3, 60.0, 1.0),
    ] {
        let centre = Point::ORIGIN + Vec2::new(-libm::sin(0.3), libm::cos(0.3));
        assert!((segment.nearest(centre).distance - 1.0).abs() < 1e-13);
        assert_eq!(segment.nearest_all(centre).len(), 1, "{segment:?}");
    }
}

#[test]
fn a_spiral_has_a_minimum_on_every_turn() {
    let spiral = Segment::clothoid(Point::ORIGIN, 0.0, 100.0, 0.0, 1.0);
    // From a point outside all turns but near the pole, each turn has one nearest point.
    let pole = Point::new(0.5, 0.5) + (spiral.end() - Point::ORIGIN);
    let minima = spiral.nearest_all(pole);
    assert!(minima.len() >= 5, "{minima:?}");
}

#[test]
fn values_that_are_not_finite_do_no_harm() {
    let good = Segment::line(Point::ORIGIN, 0.0, 1.0);
    assert!(good.nearest(Point::new(f64::NAN, 0.0)).distance.is_nan());
    assert_eq!(good.nearest(Point::new(f64::INFINITY, 0.0)).s, 0.0);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let segment = Segment { kappa1: bad, ..good };
        assert_eq!(segment.nearest(Point::ORIGIN).s, 0.0);
        assert!(segment.nearest_all(Point::ORIGIN).is_empty());
    }
}
