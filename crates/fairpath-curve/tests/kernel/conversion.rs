//! Béziers, polylines and arcs stay within the tolerance asked for, and are few.

use crate::common::{segment, spline};
use fairpath_curve::{Continuity, FitSource, Kind, Point, Segment, Spline, Vec2};
use kurbo::{CubicBez, ParamCurve};
use proptest::prelude::*;

fn accuracy() -> impl Strategy<Value = f64> {
    (-8.0..-1.5).prop_map(libm::exp10)
}

fn deviation_of_cubics(s: &Segment, cubics: &[CubicBez]) -> f64 {
    let mut worst = 0.0_f64;
    for c in cubics {
        for i in 0..=40 {
            worst = worst.max(s.nearest(c.eval(f64::from(i) / 40.0)).distance);
        }
    }
    worst
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn beziers_keep_their_accuracy_and_their_joins(s in segment(20.0), a in accuracy()) {
        let a = a * s.length;
        let cubics = s.to_beziers(a);
        let rounding = 1e-12 * s.length;
        prop_assert!(!cubics.is_empty());
        prop_assert!(deviation_of_cubics(&s, &cubics) <= a + rounding);
        prop_assert_eq!(cubics[0].p0, s.start);
        prop_assert!((cubics[cubics.len() - 1].p3 - s.end()).hypot() <= rounding);
        for w in cubics.windows(2) {
            prop_assert_eq!(w[0].p3, w[1].p0);
            let (t0, t1) = (w[0].p3 - w[0].p2, w[1].p1 - w[1].p0);
            prop_assert!(t0.cross(t1).abs() <= 1e-9 * t0.hypot() * t1.hypot() && t0.dot(t1) > 0.0);
        }
        // And the curve stays within reach of the cubics: no part of it is skipped.
        for i in 0..=100 {
            let p = s.point_at(s.length * f64::from(i) / 100.0);
            let near = cubics.iter().map(|c| {
                use kurbo::ParamCurveNearest;
                c.nearest(p, 1e-9 * s.length).distance_sq.sqrt()
            }).fold(f64::INFINITY, f64::min);
            prop_assert!(near <= 1.01 * a + 1e-7 * s.length, "{near} > {a}");
        }
    }

    #[test]
    fn polylines_keep_their_accuracy(s in segment(50.0), a in accuracy()) {
        let a = a.max(1e-6) * s.length;
        let stations = s.flatten_at(a);
        prop_assert_eq!(stations[0], 0.0);
        prop_assert_eq!(stations[stations.len() - 1], s.length);
        for w in stations.windows(2) {
            prop_assert!(w[0] < w[1]);
            let chord = Segment::line(s.point_at(w[0]), 0.0, 1.0);
            let v = s.point_at(w[1]) - chord.start;
            for i in 1..8 {
                let p = s.point_at(w[0] + (w[1] - w[0]) * f64::from(i) / 8.0) - chord.start;
                let off = v.cross(p).abs() / v.hypot();
                prop_assert!(off <= a * (1.0 + 1e-9) + 1e-12 * s.length, "{off} > {a}");
            }
        }
    }

    #[test]
    fn arcs_keep_their_accuracy_and_meet_in_g1(s in segment(20.0), a in accuracy()) {
        let a = a.max(1e-7) * s.length;
        let arcs = s.to_arcs(a);
        let spline = Spline::new(arcs.clone(), vec![Continuity::G1; arcs.len() - 1], false);
        prop_assert!(spline.is_ok(), "{spline:?}");
        prop_assert!(arcs.iter().all(|p| p.kind() != Kind::Clothoid));
        let rounding = 1e-12 * s.length;
        for arc in &arcs {
            for i in 0..=20 {
                let d = s.nearest(arc.point_at(arc.length * f64::from(i) / 20.0)).distance;
                prop_assert!(d <= a + rounding, "{d} > {a}");
            }
        }
        let last = arcs[arcs.len() - 1];
        prop_assert!((last.end() - s.end()).hypot() <= 1e-11 * s.length);
        prop_assert!((last.end_heading() - s.end_heading()).abs() <= 1e-8, "whole turns are kept");
    }

    #[test]
    fn paths_of_splines_hold_their_knots(s in spline()) {
        let path = s.to_bez_path(1e-4);
        let ends: Vec<Point> = path.elements().iter().filter_map(|e| e.end_point()).collect();
        for g in s.segments() {
            prop_assert!(ends.contains(&g.start));
        }
        let polyline = s.flatten(1e-3);
        for g in s.segments() {
            prop_assert!(polyline.contains(&g.start));
        }
        let arcs = s.to_arcs(1e-4);
        let again = Spline::new(arcs.segments().to_vec(), arcs.joins().to_vec(), false);
        prop_assert!(again.is_ok(), "{again:?}");
    }
}

#[test]
fn beziers_are_no_more_than_kurbos_optimum_plus_one() {
    let (mut ours, mut theirs) = (0, 0);
    for (k0, k1) in [(0.0, 3.0), (1.0, 1.0), (-2.0, 2.0), (2.0, 9.0), (0.5, 0.7), (-0.3, 4.0), (0.0, 12.0)] {
        for accuracy in [1e-2, 1e-3, 1e-4, 1e-6] {
            let segment = Segment::clothoid(Point::ORIGIN, 0.4, 1.0, k0, k1);
            let spline = Spline::new(vec![segment], vec![], false).expect("one segment is a spline");
            let count = segment.to_beziers(accuracy).len();
            let path = kurbo::fit_to_bezpath_opt(&FitSource::new(&spline), accuracy);
            let other = path.segments().count();
            assert!(count <= other + 1, "{k0} {k1} {accuracy}: {count} against {other}");
            ours += count;
            theirs += other;
        }
    }
    assert!(ours <= theirs + 3, "{ours} cubics against kurbo's {theirs}");
}

#[test]
fn polylines_are_as_few_as_the_largest_possible_chords_allow() {
    // For a circle the longest chord of sagitta a is known: 2 acos(1 − a / r) of turning.
    for accuracy in [1e-2, 1e-4, 1e-6] {
        let circle = Segment::arc(Point::ORIGIN, 0.0, std::f64::consts::TAU, 1.0);
        let least = libm::ceil(std::f64::consts::TAU / (2.0 * libm::acos(1.0 - accuracy))) as usize;
        let count = circle.flatten(accuracy).len() - 1;
        assert!(count <= least + 1, "{count} chords, {least} would do");
    }
    assert_eq!(Segment::line(Point::ORIGIN, 1.0, 5.0).flatten(1e-3).len(), 2);
}

#[test]
fn arcs_are_near_the_least_number_there_is() {
    // No chain of arcs g long stays within sharpness × g³ × 0.00802 of a clothoid; the rest is for the fixed end headings.
    for (k0, k1) in [(0.0, 3.0), (-2.0, 2.0), (2.0, 9.0), (0.0, 12.0)] {
        for accuracy in [1e-3, 1e-4, 1e-6, 1e-8] {
            let segment = Segment::clothoid(Point::ORIGIN, 0.4, 1.0, k0, k1);
            let least = libm::ceil(libm::cbrt(0.008_02 * (k1 - k0) / accuracy)) as usize;
            let count = segment.to_arcs(accuracy).len();
            assert!(count <= least.max(2) + 2 + least / 20, "{k0} {k1} {accuracy}: {count} against {least}");
        }
    }
}

#[test]
fn absurd_accuracies_end_in_bounded_work() {
    let s = Segment::clothoid(Point::ORIGIN, 0.0, 1.0, 0.0, 5.0);
    for accuracy in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        assert!(s.to_beziers(accuracy).len() < 10_000, "{accuracy}");
        assert!(s.to_arcs(accuracy).len() < 100_000, "{accuracy}");
        assert!(s.flatten(accuracy).len() <= 1_000_001, "{accuracy}");
        assert!(s.samples(accuracy.max(1e-3)).len() > 1);
    }
    let bad = Segment { length: f64::NAN, ..s };
    assert!(bad.to_beziers(0.1).is_empty() && bad.to_arcs(0.1).is_empty() && bad.flatten(0.1).is_empty());
}

#[test]
fn samples_are_equally_far_apart_across_joins() {
    let a = Segment::clothoid(Point::ORIGIN, 0.0, 1.0, 0.0, 1.0);
    let b = Segment::arc(a.end(), a.end_heading(), 0.7, 1.0);
    let spline = Spline::new(vec![a, b], vec![Continuity::G2], false).expect("G2 by construction");
    let poses = spline.samples(0.1);
    assert_eq!(poses.len(), 18);
    assert_eq!(poses[0].point, Point::ORIGIN);
    assert!((poses[17].point - b.end()).hypot() < 1e-14);
    let steps: Vec<Vec2> = poses.windows(2).map(|w| w[1].point - w[0].point).collect();
    assert!(steps.iter().all(|v| (v.hypot() - 0.1).abs() < 1e-4));
}
