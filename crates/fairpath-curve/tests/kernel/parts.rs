//! Boxes, transforms, combs, cutting and reversing.

use crate::common::{heading, segment, spline};
use fairpath_curve::{Continuity, Kind, Point, Segment, Similarity, Spline, Vec2};
use proptest::prelude::*;

fn similarity() -> impl Strategy<Value = Similarity> {
    (any::<bool>(), -3.0..3.0, heading(), -5.0..5.0, -5.0..5.0).prop_map(|(mirror, e, rotation, x, y)| Similarity {
        mirror,
        scale: libm::exp10(e),
        rotation,
        translation: Vec2::new(x, y),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn boxes_hold_dense_samples_and_are_tight(s in segment(60.0)) {
        let bounds = s.bounding_box();
        let mut sampled = kurbo::Rect::from_points(s.start, s.start);
        let n = 4000;
        for i in 0..=n {
            sampled = sampled.union_pt(s.point_at(s.length * f64::from(i) / f64::from(n)));
        }
        let rounding = 1e-12 * s.length;
        // A sample misses an extreme by at most kappa step² / 8.
        let step = s.length / f64::from(n);
        let slack = rounding + s.kappa0.abs().max(s.kappa1.abs()) * step * step / 8.0 * 1.01;
        for (outer, inner) in [
            (-bounds.x0, -sampled.x0), (-bounds.y0, -sampled.y0), (bounds.x1, sampled.x1), (bounds.y1, sampled.y1),
        ] {
            prop_assert!(outer >= inner - rounding, "a sample lies outside by {}", inner - outer);
            prop_assert!(outer <= inner + slack, "not tight by {}", outer - inner);
        }
    }

    #[test]
    fn transforming_commutes_with_evaluation(s in segment(30.0), by in similarity(), u in 0.0..1.0) {
        let t = s.transformed(&by);
        let at = u * s.length;
        let (image, point) = (by.point(s.point_at(at)), t.point_at(at * by.scale));
        let size = t.length + image.to_vec2().hypot();
        prop_assert!((image - point).hypot() <= 1e-12 * size);
        prop_assert!((by.heading(s.heading_at(at)) - t.heading_at(at * by.scale)).abs() <= 1e-11);
        // Curvatures one bit apart may become one; equal ones stay equal.
        prop_assert!(s.kind() == Kind::Clothoid || s.kind() == t.kind());
    }

    #[test]
    fn transforms_compose_and_invert(a in similarity(), b in similarity(), x in -1.0..1.0, y in -1.0..1.0) {
        let p = Point::new(x, y);
        let twice = b.point(a.point(p));
        prop_assert!((a.then(&b).point(p) - twice).hypot() <= 1e-11 * (1.0 + twice.to_vec2().hypot() + b.scale * 10.0));
        prop_assert!((a.inverse().point(a.point(p)) - p).hypot() <= 1e-11 * (1.0 + 10.0 / a.scale));
    }

    #[test]
    fn cutting_a_segment_changes_no_point(s in segment(60.0), u in 0.0..0.5, v in 0.5..1.0, w in 0.0..1.0) {
        let (from, to) = (u * s.length, v * s.length);
        let part = s.subsegment(from, to);
        let at = w * part.length;
        prop_assert!((part.point_at(at) - s.point_at(from + at)).hypot() <= 1e-12 * s.length);
    }

    #[test]
    fn reversing_twice_gives_the_segment_back(s in segment(100.0)) {
        let back = s.reversed().reversed();
        prop_assert!((back.start - s.start).hypot() <= 1e-12 * s.length);
        prop_assert_eq!((back.kappa0, back.kappa1, back.length), (s.kappa0, s.kappa1, s.length));
        prop_assert!((s.reversed().point_at(0.25 * s.length) - s.point_at(0.75 * s.length)).hypot() <= 1e-12 * s.length);
    }

    #[test]
    fn splines_cut_reversed_and_moved_stay_splines(s in spline(), u in 0.05..0.95, by in similarity()) {
        let valid = |s: &Spline| Spline::new(s.segments().to_vec(), s.joins().to_vec(), s.is_closed());
        let length = s.length();
        let (a, b) = s.split_at(u * length).expect("inside");
        prop_assert!(valid(&a).is_ok() && valid(&b).is_ok());
        prop_assert!((a.length() + b.length() - length).abs() <= 1e-12 * length);
        prop_assert!((a.end_pose().point - b.start_pose().point).hypot() <= 1e-12 * length);
        prop_assert!((a.end_pose().point - s.point_at(u * length)).hypot() <= 1e-12 * length);
        let back = s.reversed();
        prop_assert!(valid(&back).is_ok());
        prop_assert!((back.point_at(u * length) - s.point_at((1.0 - u) * length)).hypot() <= 1e-11 * length);
        let moved = s.transformed(&by);
        prop_assert!(valid(&moved).is_ok(), "{:?}", valid(&moved));
    }
}

fn stadium() -> Spline {
    use std::f64::consts::PI;
    let mut segments = vec![Segment::line(Point::ORIGIN, 0.0, 2.0)];
    for (length, kappa) in [(PI, 1.0), (2.0, 0.0), (PI, 1.0)] {
        let end = segments[segments.len() - 1].end_pose();
        segments.push(Segment::arc(end.point, end.heading, length, kappa));
    }
    Spline::new(segments, vec![Continuity::G1; 4], true).expect("a stadium closes")
}

#[test]
fn parts_of_a_closed_spline_run_through_its_start() {
    let s = stadium();
    let length = s.length();
    let part = s.subspline(length - 1.0, length + 1.0).expect("shorter than the whole");
    assert_eq!(part.segments().len(), 2);
    assert!((part.length() - 2.0).abs() < 1e-12);
    assert!((part.end_pose().point - Point::new(1.0, 0.0)).hypot() < 1e-12);
    let whole = s.subspline(3.0, 3.0 + length).expect("exactly the whole");
    assert_eq!(whole.segments().len(), 5);
    assert!(s.subspline(0.0, length).expect("whole from the start").segments().len() == 4);
    assert!((s.point_at(length + 1.0) - s.point_at(1.0)).hypot() < 1e-12, "stations go round");
    assert!(s.subspline(1.0, 1.0).is_none() && s.subspline(f64::NAN, 1.0).is_none());
}

#[test]
fn reversing_a_closed_spline_keeps_its_seam() {
    let s = stadium();
    let back = s.reversed();
    assert!(Spline::new(back.segments().to_vec(), back.joins().to_vec(), true).is_ok());
    assert!((back.turning() + s.turning()).abs() < 1e-12);
}

#[test]
fn stations_and_places_correspond() {
    let s = stadium();
    for station in [0.0, 1.0, 2.0, 4.5, 9.0] {
        let (i, at) = s.locate(station);
        assert!((s.station(i, at) - station).abs() < 1e-12);
    }
    assert_eq!(s.locate(f64::NAN).0, 0);
}

#[test]
fn a_comb_stands_on_the_outside_of_the_bend() {
    let arc = Segment::arc(Point::ORIGIN, 0.0, 1.0, 0.5);
    let comb = arc.comb(0.1, 2.0);
    assert_eq!(comb.len(), 11);
    let centre = Point::new(0.0, 2.0);
    for tooth in &comb {
        assert!(((tooth.base - centre).hypot() - 2.0).abs() < 1e-14);
        assert!(((tooth.tip - centre).hypot() - 3.0).abs() < 1e-14);
    }
    assert_eq!(stadium().comb(10.0, 1.0).len(), 8, "both ends of each segment");
}

#[test]
fn the_box_of_a_circle_is_its_square() {
    let circle = Segment::arc(Point::new(1.0, 0.0), std::f64::consts::FRAC_PI_2, std::f64::consts::TAU, 1.0);
    let b = circle.bounding_box();
    for (got, wanted) in [(b.x0, -1.0), (b.y0, -1.0), (b.x1, 1.0), (b.y1, 1.0)] {
        assert!((got - wanted).abs() < 1e-14, "{b:?}");
    }
}
