//! Hermite interpolation meets its poses, over all angles and degenerate ones.

use crate::common::heading;
use fairpath_curve::trig::wrap_angle;
use fairpath_curve::{Continuity, Point, Pose, Segment, Spline, hermite_g1, hermite_g2};
use proptest::prelude::*;
use std::f64::consts::PI;

fn pose(curvature: f64) -> impl Strategy<Value = Pose> {
    let kappa = prop_oneof![3 => -curvature..curvature, 1 => Just(0.0), 1 => -1e-6..1e-6];
    (-1.0..1.0, -1.0..1.0, heading(), kappa).prop_map(|(x, y, heading, curvature)| Pose {
        point: Point::new(x, y),
        heading,
        curvature,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn one_clothoid_meets_both_poses(a in pose(1.0), b in pose(1.0), e in -6.0..6.0) {
        let scale = libm::exp10(e);
        let (p, q) = (Point::new(a.point.x * scale, a.point.y * scale), Point::new(b.point.x * scale, b.point.y * scale));
        let direction = libm::atan2(q.y - p.y, q.x - p.x);
        let (phi0, phi1) = (wrap_angle(a.heading - direction), wrap_angle(b.heading - direction));
        // Straight back at both ends in opposite senses has no answer.
        prop_assume!((phi0 - phi1).abs() < 2.0 * PI - 1e-3);
        let s = hermite_g1(p, a.heading, q, b.heading);
        prop_assert!(s.is_some(), "{phi0} {phi1}");
        let s = s.expect("checked");
        prop_assert!((s.end() - q).hypot() <= 1e-12 * s.length, "{:e}", (s.end() - q).hypot() / s.length);
        prop_assert!(wrap_angle(s.end_heading() - b.heading).abs() <= 1e-12);
        prop_assert_eq!(s.heading, a.heading);
        prop_assert!(s.absolute_turning() <= 4.0 * PI, "no loops that are not needed");
    }

    #[test]
    fn a_clothoid_is_found_again_from_its_ends(h in heading(), l in 0.1..10.0, u in -1.2..1.2, v in -1.2..1.2) {
        let s = Segment::clothoid(Point::new(1.0, 2.0), h, l, u / l, v / l);
        let found = hermite_g1(s.start, s.heading, s.end(), s.end_heading()).expect("it exists");
        prop_assert!((found.length - l).abs() <= 1e-9 * l);
        prop_assert!((found.kappa0 - s.kappa0).abs() <= 1e-9 / l && (found.kappa1 - s.kappa1).abs() <= 1e-9 / l);
    }

    #[test]
    fn three_clothoids_meet_both_poses_and_curvatures(a in pose(10.0), b in pose(10.0)) {
        let r = (a.point - b.point).hypot();
        prop_assume!(r > 1e-3);
        let found = hermite_g2(a, b);
        prop_assert!(found.is_some());
        let segments = found.expect("checked");
        let length: f64 = segments.iter().map(|s| s.length).sum();
        let end = segments[2].end_pose();
        prop_assert!((end.point - b.point).hypot() <= 1e-10 * length, "{:e}", (end.point - b.point).hypot() / length);
        prop_assert!(wrap_angle(end.heading - b.heading).abs() <= 1e-10);
        prop_assert_eq!(end.curvature, b.curvature);
        prop_assert_eq!(segments[0].start_pose(), a);
        prop_assert!(Spline::new(segments.to_vec(), vec![Continuity::G2; 2], false).is_ok());
    }
}

#[test]
fn straight_and_circular_ends_give_lines_and_arcs() {
    let line = hermite_g1(Point::ORIGIN, 0.0, Point::new(3.0, 0.0), 0.0).expect("a line");
    assert!((line.length - 3.0).abs() < 1e-15 && line.kappa0.abs() < 1e-15 && line.kappa1.abs() < 1e-15);
    let arc = hermite_g1(Point::ORIGIN, PI / 2.0, Point::new(-2.0, 0.0), -PI / 2.0).expect("half a circle");
    assert!((arc.length - PI).abs() < 1e-13 && (arc.kappa0 - 1.0).abs() < 1e-13 && (arc.kappa1 - 1.0).abs() < 1e-13);
}

#[test]
fn a_pose_pair_on_a_line_gives_a_line_of_three() {
    let pose = |x: f64| Pose { point: Point::new(x, 0.0), heading: 0.0, curvature: 0.0 };
    for s in hermite_g2(pose(0.0), pose(1.0)).expect("a line") {
        assert!(s.kappa0.abs() < 1e-12 && s.kappa1.abs() < 1e-12);
    }
}

#[test]
fn impossible_input_gives_nothing() {
    let p = Point::new(1.0, 1.0);
    assert!(hermite_g1(p, 0.0, p, 1.0).is_none());
    assert!(hermite_g1(p, f64::NAN, Point::ORIGIN, 1.0).is_none());
    assert!(hermite_g1(p, 0.0, Point::new(f64::INFINITY, 0.0), 1.0).is_none());
    let pose = Pose { point: p, heading: 0.0, curvature: 0.0 };
    assert!(hermite_g2(pose, pose).is_none());
    assert!(hermite_g2(pose, Pose { curvature: f64::NAN, point: Point::ORIGIN, ..pose }).is_none());
}

#[test]
fn random_pose_pairs_with_strong_curvature_have_three_clothoids() {
    let mut state = 1_u64;
    let mut next = |scale: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        scale * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    };
    let mut unsolved = 0;
    for _ in 0..2_000 {
        let a = Pose { point: Point::ORIGIN, heading: next(PI), curvature: next(30.0) };
        let b = Pose { point: Point::new(1.0, 0.0), heading: next(PI), curvature: next(30.0) };
        unsolved += usize::from(hermite_g2(a, b).is_none());
    }
    assert_eq!(unsolved, 0);
}
