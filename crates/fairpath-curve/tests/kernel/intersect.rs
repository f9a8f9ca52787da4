//! Intersections against dense polylines, and the degenerate meetings that must end.

use crate::common::{segment, spline};
use fairpath_curve::{Contact, Continuity, Point, Segment, Spline, SplineIntersection, Vec2};
use proptest::prelude::*;

/// Arc lengths on both where two fine polylines cross.
fn crossings_of_polylines(a: &Segment, b: &Segment, n: usize) -> Vec<(f64, f64)> {
    let points = |s: &Segment| -> Vec<Point> { (0..=n).map(|i| s.point_at(s.length * i as f64 / n as f64)).collect() };
    let (p, q) = (points(a), points(b));
    let mut found = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let (u, v, d) = (p[i + 1] - p[i], q[j + 1] - q[j], q[j] - p[i]);
            let det = u.cross(v);
            let (x, y) = (d.cross(v) / det, d.cross(u) / det);
            // Clear crossings only: shallow ones and those at the ends of chords differ between polyline and curve.
            if det.abs() > 0.1 * u.hypot() * v.hypot() && (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y) {
                found.push(((i as f64 + x) / n as f64 * a.length, (j as f64 + y) / n as f64 * b.length));
            }
        }
    }
    found
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn every_clear_crossing_of_polylines_is_found(
        a in segment(12.0), b in segment(12.0), x in -0.4..0.4, y in -0.4..0.4, ratio in 0.3..3.0,
    ) {
        // Both to the same size and place.
        let scale = ratio * a.length / b.length;
        let b = Segment {
            start: a.point_at(0.5 * a.length) + Vec2::new(x, y) * a.length,
            heading: b.heading,
            length: b.length * scale,
            kappa0: b.kappa0 / scale,
            kappa1: b.kappa1 / scale,
        };
        let n = 160;
        let found = a.intersections(&b);
        let size = a.length + b.length;
        for f in &found {
            let gap = (a.point_at(f.s) - b.point_at(f.t)).hypot();
            prop_assert!(gap <= if f.contact == Contact::Crossing { 1e-12 } else { 2e-9 } * size, "{f:?} {gap:e}");
        }
        for (s, t) in crossings_of_polylines(&a, &b, n) {
            let edge = 2.0 / n as f64;
            let inside = |u: f64, l: f64| u > edge * l && u < (1.0 - edge) * l;
            if inside(s, a.length) && inside(t, b.length) {
                prop_assert!(
                    found.iter().any(|f| (f.s - s).abs() <= edge * a.length && (f.t - t).abs() <= edge * b.length),
                    "{s} {t} missing among {found:?}"
                );
            }
        }
    }

    #[test]
    fn a_segment_overlaps_itself_and_its_parts(s in segment(20.0), u in 0.05..0.4, v in 0.6..0.95) {
        let part = s.subsegment(u * s.length, v * s.length);
        let found = s.intersections(&part);
        prop_assert!(!found.is_empty());
        if s.absolute_turning() < 6.0 {
            prop_assert_eq!(found.len(), 1, "{:?}", &found);
            prop_assert_eq!(found[0].contact, Contact::Overlap);
            prop_assert!((found[0].extent - part.length).abs() <= 0.1 * s.length, "{}", found[0].extent);
        }
    }

    #[test]
    fn where_two_segments_cross_the_spline_meets_itself(s in spline()) {
        let found = s.self_intersections();
        for (i, a) in s.segments().iter().enumerate() {
            for (j, b) in s.segments().iter().enumerate().skip(i + 1) {
                for p in a.intersections(b).into_iter().filter(|p| p.contact == Contact::Crossing) {
                    let apart = s.station(j, p.t) - s.station(i, p.s);
                    let apart = if s.is_closed() { apart.min(s.length() - apart) } else { apart };
                    if apart > 1e-6 * s.length() {
                        let same = |f: &SplineIntersection| (f.point - p.point).hypot() < 1e-6 * s.length();
                        prop_assert!(found.iter().any(same), "{i} {j} {p:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_smooth_spline_of_little_turning_does_not_meet_itself_at_its_joins(s in spline()) {
        let turning: f64 = s.segments().iter().map(Segment::absolute_turning).sum();
        prop_assume!(turning < 3.0 && s.joins().iter().all(|j| *j >= Continuity::G1));
        prop_assert!(s.self_intersections().is_empty(), "{:?}", s.self_intersections());
    }
}

fn line(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
    let d = Point::new(x1, y1) - Point::new(x0, y0);
    Segment::line(Point::new(x0, y0), libm::atan2(d.y, d.x), d.hypot())
}

#[test]
fn a_line_crosses_a_circle_twice_touches_it_once_and_misses_it() {
    let circle = Segment::arc(Point::new(0.0, -1.0), 0.0, 6.0, 1.0);
    for (y, count) in [(0.3, 2), (0.999_999, 2), (1.0, 1), (1.000_001, 0)] {
        let found = circle.intersections(&line(-3.0, y, 3.0, y));
        assert_eq!(found.len(), count, "{y}: {found:?}");
        if y == 1.0 {
            assert_eq!(found[0].contact, Contact::Touching);
            assert!((found[0].point - Point::new(0.0, 1.0)).hypot() < 1e-4);
        }
        for f in found.iter().filter(|f| f.contact == Contact::Crossing) {
            assert!((f.point.y - y).abs() < 1e-13);
        }
    }
}

#[test]
fn curves_that_share_an_end_meet_there_once() {
    let a = line(0.0, 0.0, 1.0, 0.0);
    for b in [line(1.0, 0.0, 2.0, 1.0), line(1.0, 0.0, 2.0, 0.0), Segment::arc(Point::new(1.0, 0.0), 0.0, 1.0, 0.7)] {
        let found = a.intersections(&b);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].s - 1.0).abs() < 1e-6 && found[0].t < 1e-6);
    }
}

#[test]
fn a_loop_of_a_spline_is_found_once_with_both_places() {
    // A bow: in, three quarters round and out across its beginning.
    let a = Segment::line(Point::new(-2.0, 0.0), 0.0, 2.0);
    let b = Segment::arc(a.end(), 0.0, 1.5 * std::f64::consts::PI, 1.0);
    let end = b.end_pose();
    let c = Segment::line(end.point, end.heading, 3.0);
    let bow = Spline::new(vec![a, b, c], vec![Continuity::G1; 2], false).expect("G1 by construction");
    let found = bow.self_intersections();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0].point - Point::new(-1.0, 0.0)).hypot() < 1e-13);
    assert_eq!((found[0].first.segment, found[0].second.segment), (0, 2));
    assert!((found[0].first.s - 1.0).abs() < 1e-13 && (found[0].second.s - 1.0).abs() < 1e-13);
}

#[test]
fn a_circle_traced_three_times_overlaps_itself_once() {
    let thrice = Segment::arc(Point::ORIGIN, 0.0, 18.0, 1.0);
    let spline = Spline::new(vec![thrice], vec![], false).expect("one segment");
    let found = spline.self_intersections();
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].contact, Contact::Overlap);
}

#[test]
fn a_crossing_at_a_knot_is_reported_once() {
    let a = Segment::line(Point::new(-1.0, 0.0), 0.0, 1.0);
    let b = Segment::line(Point::ORIGIN, 0.0, 1.0);
    let chain = Spline::new(vec![a, b], vec![Continuity::G3], false).expect("collinear");
    let across = Spline::new(vec![line(0.0, -1.0, 0.0, 1.0)], vec![], false).expect("one segment");
    assert_eq!(chain.intersections(&across).len(), 1);
}

#[test]
fn concentric_spirals_and_parallel_curves_end_in_bounded_work() {
    let a = Segment::clothoid(Point::ORIGIN, 0.0, 100.0, 0.0, 1.0);
    for gap in [1e-3, 1e-6, 1e-9, 1e-12] {
        let b = Segment { start: Point::new(0.0, gap), ..a };
        let _ = a.intersections(&b);
    }
    let huge = Segment::clothoid(Point::ORIGIN, 0.0, 1.0, 0.0, 1e3);
    let _ = huge.intersections(&a);
    assert!(a.intersections(&Segment { length: f64::NAN, ..a }).is_empty());
}
