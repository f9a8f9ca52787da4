//! Correcting curves by drawing over them: what is promised of the seams and of what stays, on strokes of all kinds.

use fairpath_curve::{Continuity, Point, Segment, Similarity, Spline, Vec2};
use fairpath_fit::{
    Closing, FitOptions, OversketchError, OversketchMode, OversketchOptions, Oversketched, Stroke, fit, oversketch,
    oversketch_by, oversketch_region,
};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn tremor(i: usize) -> f64 {
    0.4 * (1.7 * i as f64).sin() + 0.25 * (5.3 * i as f64).sin()
}

fn stroke(count: usize, course: impl Fn(f64) -> (f64, f64)) -> Stroke {
    let point = |i: usize| {
        let (x, y) = course(i as f64 / (count - 1) as f64);
        Point::new(x + tremor(i), y + tremor(i + 11))
    };
    Stroke::new("stroke", (0..count).map(point).collect())
}

fn reversed(stroke: &Stroke) -> Stroke {
    Stroke::new("stroke", stroke.points.iter().rev().copied().collect())
}

fn fitted(stroke: &Stroke) -> Spline {
    fit(stroke, &FitOptions::default()).expect("it is a curve").spline
}

/// Two and a half bends, 420 px wide.
fn wave() -> Spline {
    fitted(&stroke(90, |u| (420.0 * u, height(420.0 * u))))
}

fn height(x: f64) -> f64 {
    60.0 * (2.5 * PI * x / 420.0).sin()
}

fn oval() -> Spline {
    fitted(&stroke(100, |u| (140.0 * (TAU * u).cos(), 90.0 * (TAU * u).sin())))
}

/// A line, a corner and a line.
fn hook() -> Spline {
    let line = Segment::line(Point::new(0.0, 0.0), 0.0, 260.0);
    let leg = Segment::line(Point::new(260.0, 0.0), 0.5 * PI, 150.0);
    Spline::new(vec![line, leg], vec![Continuity::G0], false).expect("it is a spline")
}

fn bits(s: &Segment) -> [u64; 6] {
    [s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1].map(f64::to_bits)
}

fn corrected(old: &Spline, over: &Stroke) -> Oversketched {
    let result = oversketch(old, over, &OversketchOptions::default()).expect("it can be corrected");
    check(old, over, &result);
    result
}

/// What every correction promises.
fn check(old: &Spline, over: &Stroke, result: &Oversketched) {
    let preview = oversketch_region(old, over, &OversketchOptions::default());
    assert_eq!(preview, Ok(result.region), "the preview tells what is done");
    let new = &result.spline;
    // Joins hold what they claim, or there would be no such spline.
    Spline::new(new.segments().to_vec(), new.joins().to_vec(), new.is_closed()).expect("it is a spline");
    assert_eq!(new.is_closed(), old.is_closed());
    assert!(result.new.end <= new.segments().len() && !result.new.is_empty());
    if result.region.whole {
        return;
    }
    // Outside, every segment is one of the old ones to the bit; one at each seam may be a part of one.
    let n = new.segments().len();
    let before: Vec<_> = old.segments().iter().map(bits).collect();
    let outside = (0..n).filter(|i| !result.new.contains(i));
    let changed: Vec<usize> = outside.filter(|&i| !before.contains(&bits(&new.segments()[i]))).collect();
    let at_seam = |i: usize| (i + 1) % n == result.new.start % n || i == result.new.end % n;
    assert!(changed.iter().all(|&i| at_seam(i)), "{changed:?} changed, {:?} are new", result.new);
    for &i in &changed {
        let s = &new.segments()[i];
        let changed_at = |share: &f64| s.point_at(share * s.length);
        let is_head = old.segments().iter().any(|o| bits(o)[..3] == bits(s)[..3] && o.kappa0 == s.kappa0);
        let is_tail = old.segments().iter().any(|o| o.kappa1 == s.kappa1 && (o.end() - s.end()).hypot() < 1e-9);
        // The one segment of a closed curve may be cut at both its ends.
        let on_old = |s: &f64| old.nearest(changed_at(s)).distance < 1e-9;
        let is_middle = old.segments().len() == 1 && [0.0, 0.3, 1.0].iter().all(on_old);
        assert!(is_head || is_tail || is_middle, "segment {i} is part of no old one");
    }
    // What is not fitted anew lies where it lay.
    let [from, to] = result.region.refitted;
    let length = old.length();
    for i in 0..200 {
        let s = length * f64::from(i) / 200.0;
        let inside = [s - length, s, s + length].iter().any(|s| *s > from - 1e-6 && *s < to + 1e-6);
        if !inside {
            let away = new.nearest(old.point_at(s)).distance;
            assert!(away < 1e-8, "station {s} has moved by {away:e}");
        }
    }
    assert!(result.report.max_deviation < 7.0, "{} px off", result.report.max_deviation);
}

/// The largest distance of the stroke's points, but for those near its ends, which move onto the curve.
fn interior_deviation(result: &Oversketched, over: &Stroke) -> f64 {
    let n = over.points.len();
    over.points[n / 5..n - n / 5].iter().map(|p| result.spline.nearest(*p).distance).fold(0.0, f64::max)
}

#[test]
fn a_bend_is_drawn_deeper_and_the_rest_stays() {
    let old = wave();
    let over = stroke(36, |u| {
        let x = 185.0 + 135.0 * u;
        (x, height(x) - 45.0 * (PI * u).sin().powi(2))
    });
    let result = corrected(&old, &over);
    assert!(interior_deviation(&result, &over) < 5.0);
    assert!(result.spline.joins().iter().all(|j| *j >= Continuity::G2), "{:?}", result.spline.joins());
    assert!(result.warnings.is_empty(), "{:?}", result.warnings);
    assert!(old.point_at(0.0) == result.spline.point_at(0.0));
}

#[test]
fn curvature_does_not_leap_beside_a_correction() {
    let old = wave();
    let over = stroke(36, |u| {
        let x = 185.0 + 135.0 * u;
        (x, height(x) - 45.0 * (PI * u).sin().powi(2))
    });
    let result = corrected(&old, &over);
    let comb = result.spline.comb(2.0, 1.0);
    let leap = comb
        .windows(2)
        .filter(|t| t[0].base.distance(t[1].base) < 1e-6)
        .map(|t| (t[1].curvature - t[0].curvature).abs());
    assert!(leap.fold(0.0, f64::max) < 1e-9);
    // Where the stroke leaves the curve it bends no more than the bend that was drawn.
    let sharpest = comb.iter().map(|t| t.curvature.abs()).fold(0.0, f64::max);
    let drawn = 1.0 / 12.0;
    assert!(sharpest < drawn, "{sharpest}");
}

#[test]
fn a_small_correction_is_no_tremor() {
    let old = Spline::new(vec![Segment::line(Point::new(0.0, 0.0), 0.0, 300.0)], vec![], false).expect("a line");
    let over = stroke(20, |u| (110.0 + 60.0 * u, -7.0 * (PI * u).sin().powi(2)));
    let result = corrected(&old, &over);
    let top = result.spline.nearest(Point::new(140.0, -7.0));
    assert!(top.distance < 2.5, "{}", top.distance);
}

#[test]
fn a_bulge_beside_a_gentle_bend_is_followed_whichever_way_the_bend_goes() {
    // What looks like arcs by itself cannot be arcs where it must leave a bend and come back to it.
    for sharpness in [-4.0, -1.5, 0.0, 1.5, 4.0] {
        for kappa in [-2.5e-3, -1e-3, 0.0, 1e-3, 2.5e-3] {
            let bend = Segment {
                start: Point::ORIGIN,
                heading: 0.3,
                length: 900.0,
                kappa0: kappa,
                kappa1: kappa + sharpness * 1e-3,
            };
            let bend = Spline::new(vec![bend], Vec::new(), false).expect("it is a spline");
            let bulge = (0..=60).map(|i| f64::from(i) / 60.0).map(|t| {
                let pose = bend.pose_at(350.0 + 200.0 * t);
                let aside = 10.0 * 16.0 * t * t * (1.0 - t) * (1.0 - t);
                pose.point + fairpath_curve::trig::unit(pose.heading + 0.5 * PI) * aside
            });
            let over = Stroke::new("bulge", bulge.collect());
            let result = corrected(&bend, &over);
            let away = result.report.max_deviation;
            assert!(away < 2.0, "{kappa}, {sharpness}: {away} px off");
            assert!(result.warnings.is_empty(), "{kappa}, {sharpness}: {:?}", result.warnings);
        }
    }
}

#[test]
fn reversing_the_stroke_gives_the_same_curve() {
    for (old, over) in [
        (wave(), stroke(40, |u| (150.0 + 120.0 * u, height(150.0 + 120.0 * u) + 20.0 * (PI * u).sin()))),
        (oval(), stroke(40, |u| (118.0 + 60.0 * (PI * u).sin(), 55.0 - 105.0 * u))),
        (wave(), stroke(40, |u| (380.0 + 160.0 * u, height(380.0) + 30.0 * u * u))),
    ] {
        let (a, b) = (corrected(&old, &over), corrected(&old, &reversed(&over)));
        assert_eq!(a.spline, b.spline);
        assert_ne!(a.region.backward, b.region.backward);
    }
}

#[test]
fn a_stroke_past_an_end_extends_the_curve() {
    let old = wave();
    let end = old.end_pose();
    for backward in [false, true] {
        let over = stroke(40, |u| {
            (end.point.x - 40.0 + 160.0 * u, height(end.point.x - 40.0 + 40.0 * u.min(0.25) * 4.0) - 60.0 * u * u)
        });
        let over = if backward { reversed(&over) } else { over };
        let result = corrected(&old, &over);
        assert_eq!(result.region.attached, [true, false]);
        assert!(
            (result.spline.end_pose().point
                - Point::new(end.point.x + 120.0, over.points[if backward { 0 } else { 39 }].y))
            .hypot()
                < 4.0
        );
        assert!(result.spline.joins().iter().all(|j| *j >= Continuity::G2));
    }
    // It may begin where the curve ends, or a little beyond.
    for gap in [0.0, 8.0] {
        let ahead = old.tangent_at(old.length());
        let over = stroke(30, |u| {
            let p = end.point + ahead * (gap + 100.0 * u) + Vec2::new(-ahead.y, ahead.x) * (25.0 * u * u);
            (p.x, p.y)
        });
        let result = corrected(&old, &over);
        assert!((result.spline.end_pose().point - over.points[29]).hypot() < 4.0);
        assert!(result.spline.length() > old.length() + 90.0);
    }
}

#[test]
fn a_corner_outside_stays_and_one_inside_is_found_anew() {
    let old = hook();
    // Beside the corner.
    let beside = corrected(&old, &stroke(30, |u| (60.0 + 100.0 * u, -30.0 * (PI * u).sin())));
    assert!(beside.spline.joins().contains(&Continuity::G0));
    assert!(beside.spline.nearest(Point::new(260.0, 0.0)).distance < 1e-9);
    // Rounded.
    let round =
        corrected(&old, &stroke(30, |u| (190.0 + 70.0 * (0.5 * PI * u).sin(), 80.0 - 80.0 * (0.5 * PI * u).cos())));
    assert!(round.spline.joins().iter().all(|j| *j >= Continuity::G2), "{:?}", round.spline.joins());
    // Moved.
    let line = |a: (f64, f64), b: (f64, f64), t: f64| (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1));
    let over = stroke(41, |u| {
        if u < 0.5 {
            line((180.0, 0.0), (300.0, -30.0), 2.0 * u)
        } else {
            line((300.0, -30.0), (260.0, 90.0), 2.0 * u - 1.0)
        }
    });
    let moved = corrected(&old, &over);
    assert_eq!(moved.spline.joins().iter().filter(|j| **j == Continuity::G0).count(), 1);
    let corner = moved.spline.joins().iter().position(|j| *j == Continuity::G0).expect("a corner");
    assert!((moved.spline.segments()[corner].end() - Point::new(300.0, -30.0)).hypot() < 5.0);
}

#[test]
fn a_stroke_that_ends_at_a_corner_keeps_it() {
    let old = hook();
    let over = stroke(40, |u| (140.0 + 117.0 * u, 2.0 * u - 40.0 * (PI * u).sin()));
    let result = corrected(&old, &over);
    let corner = result.spline.joins().iter().position(|j| *j == Continuity::G0).expect("the corner stays");
    assert!((result.spline.segments()[corner].end() - Point::new(260.0, 0.0)).hypot() < 1e-9);
    assert_eq!(bits(&result.spline.segments()[corner + 1]), bits(&old.segments()[1]));
}

#[test]
fn a_closed_curve_is_corrected_across_its_start() {
    let old = oval();
    let start = old.start_pose().point;
    for angle in [0.0, 0.25 * TAU, 0.5 * TAU, 0.8 * TAU] {
        // Around the start of the curve, and elsewhere.
        let away = (start.y / 90.0).atan2(start.x / 140.0) + angle;
        let over = stroke(40, |u| {
            let a = away + 0.9 * (u - 0.5);
            let r = 1.0 + 0.25 * (PI * u).sin().powi(2);
            (140.0 * r * a.cos(), 90.0 * r * a.sin())
        });
        let result = corrected(&old, &over);
        assert!(interior_deviation(&result, &over) < 5.0);
        assert!(result.spline.joins().iter().all(|j| *j >= Continuity::G2), "{:?}", result.spline.joins());
        assert!((result.spline.turning().abs() - TAU).abs() < 1e-6);
    }
}

#[test]
fn of_two_ways_around_the_shorter_is_replaced_unless_the_stroke_follows_the_longer() {
    let old = oval();
    let arc = |from: f64, to: f64, r: f64| {
        stroke(60, move |u| {
            let a = from + (to - from) * u;
            (140.0 * r * a.cos(), 90.0 * r * a.sin())
        })
    };
    let short = corrected(&old, &arc(0.3, 1.5, 1.08));
    assert!(short.region.replaced[1] - short.region.replaced[0] < 0.4 * old.length());
    let long = corrected(&old, &arc(0.3, 4.9, 1.08));
    assert!(long.region.replaced[1] - long.region.replaced[0] > 0.6 * old.length());
    // A chord tells nothing: the smaller part goes.
    let chord = corrected(&old, &stroke(30, |u| (100.0, -60.0 + 120.0 * u)));
    assert!(chord.region.replaced[1] - chord.region.replaced[0] < 0.4 * old.length());
}

#[test]
fn a_stroke_around_nearly_all_of_a_closed_curve_replaces_it_whole() {
    let old = oval();
    let over = stroke(90, |u| {
        let a = 0.2 + 0.97 * TAU * u;
        (150.0 * a.cos(), 80.0 * a.sin())
    });
    let result = corrected(&old, &over);
    assert!(result.region.whole && result.spline.is_closed());
    assert!(interior_deviation(&result, &over) < 3.0);
}

#[test]
fn a_circle_of_one_segment_is_cut() {
    let circle = Segment::arc(Point::new(100.0, 0.0), 0.5 * PI, TAU * 100.0, 0.01);
    let old = Spline::new(vec![circle], vec![Continuity::G3], true).expect("a circle");
    for middle in [0.0, 2.0] {
        let over = stroke(40, |u| {
            let a = middle + 0.8 * (u - 0.5);
            let r = 100.0 + 25.0 * (PI * u).sin().powi(2);
            (r * a.cos(), r * a.sin())
        });
        let result = corrected(&old, &over);
        assert!(result.spline.is_closed() && result.spline.segments().len() > 2);
        assert!(interior_deviation(&result, &over) < 5.0);
    }
}

#[test]
fn a_loop_is_put_into_a_curve() {
    let old = Spline::new(vec![Segment::line(Point::new(0.0, 0.0), 0.0, 300.0)], vec![], false).expect("a line");
    let over = stroke(60, |u| (150.0 - 8.0 * u + 45.0 * (TAU * u).sin(), -45.0 * (1.0 - (TAU * u).cos())));
    for over in [over.clone(), reversed(&over)] {
        let result = corrected(&old, &over);
        assert!((result.spline.turning().abs() - TAU).abs() < 1e-6, "{}", result.spline.turning());
    }
}

#[test]
fn where_the_stroke_lies_on_the_page_does_not_matter() {
    let old = wave();
    let over = stroke(36, |u| (185.0 + 135.0 * u, height(185.0 + 135.0 * u) - 45.0 * (PI * u).sin().powi(2)));
    let here = corrected(&old, &over);
    let by = Similarity { scale: 2.5, rotation: 1.1, translation: Vec2::new(3000.0, -700.0), mirror: false };
    let points = over.points.iter().map(|p| by.point(*p)).collect();
    let options = OversketchOptions {
        fit: FitOptions { pixel_size: 2.5, ..FitOptions::default() },
        ..OversketchOptions::default()
    };
    let there = oversketch(&old.transformed(&by), &Stroke::new("over", points), &options).expect("it can be corrected");
    assert_eq!(here.spline.segments().len(), there.spline.segments().len());
    for i in 0..=100 {
        let u = f64::from(i) / 100.0;
        let moved = by.point(here.spline.point_at(u * here.spline.length()));
        assert!((moved - there.spline.point_at(u * there.spline.length())).hypot() < 0.05);
    }
}

#[test]
fn other_modes_blend_and_refit() {
    let old = wave();
    let over = stroke(36, |u| (185.0 + 135.0 * u, height(185.0 + 135.0 * u) - 45.0 * (PI * u).sin().powi(2)));
    for mode in [OversketchMode::LocalBlend, OversketchMode::Refit] {
        let options = OversketchOptions { mode, ..OversketchOptions::default() };
        let result = oversketch(&old, &over, &options).expect("it can be corrected");
        assert!(interior_deviation(&result, &over) < 5.0, "{mode:?}");
        assert!(result.spline.joins().iter().all(|j| *j >= Continuity::G2), "{mode:?}");
        assert_eq!(mode == OversketchMode::Refit, result.new.len() == result.spline.segments().len());
        let calls = std::cell::Cell::new(0);
        let by = |stroke: &Stroke| {
            calls.set(calls.get() + 1);
            fit(stroke, &FitOptions { closed: Closing::No, ..FitOptions::default() })
        };
        oversketch_by(&old, &over, &options, Some(&by)).expect("it can be corrected");
        assert_eq!(calls.get(), 1, "{mode:?}");
    }
}

#[test]
fn a_stroke_that_has_nothing_to_do_with_the_curve_is_told_so() {
    let options = OversketchOptions::default();
    let far = oversketch(&wave(), &stroke(20, |u| (100.0 + 50.0 * u, 400.0)), &options);
    assert!(matches!(far, Err(OversketchError::NotNear { start, .. }) if start > 300.0), "{far:?}");
    let away = oversketch(&oval(), &stroke(30, |u| (140.0 + 200.0 * u, 0.0)), &options);
    assert!(matches!(away, Err(OversketchError::LeadsAway { which: "last", .. })), "{away:?}");
    for points in [
        vec![],
        vec![Point::new(0.0, 0.0)],
        vec![Point::new(5.0, 5.0); 20],
        vec![Point::new(0.0, 0.0), Point::new(f64::NAN, 1.0)],
        vec![Point::new(0.0, 0.0), Point::new(f64::INFINITY, 1.0)],
        vec![Point::new(0.0, 0.0), Point::new(1e300, -1e300)],
    ] {
        let result = oversketch(&wave(), &Stroke::new("rubbish", points), &options);
        assert!(matches!(result, Err(OversketchError::Fit(_) | OversketchError::NotNear { .. })), "{result:?}");
    }
    let bad = OversketchOptions { seam_worth: f64::NAN, ..OversketchOptions::default() };
    let result = oversketch(&wave(), &stroke(9, |u| (50.0 * u, 0.0)), &bad);
    assert_eq!(result.unwrap_err().code(), "bad-option");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn what_a_stroke_does_not_reach_keeps_its_bits(
        closed in any::<bool>(), from in 0.0..1.0_f64, span in 0.08..0.45_f64, bulge in -0.4..0.4_f64,
        off in -8.0..8.0_f64, backward in any::<bool>(), count in 5_usize..60,
    ) {
        let old = if closed { oval() } else { wave() };
        let length = old.length();
        let begin = if closed { from * length } else { from * (1.0 - span) * length };
        let point = |i: usize| {
            let u = i as f64 / (count - 1) as f64;
            let s = begin + u * span * length;
            let (pose, t) = (old.pose_at(s), old.tangent_at(s));
            let across = bulge * span * length * (PI * u).sin().powi(2) + off;
            pose.point + Vec2::new(-t.y, t.x) * across + Vec2::new(tremor(i), tremor(i + 5))
        };
        let over = Stroke::new("over", (0..count).map(point).collect());
        let over = if backward { reversed(&over) } else { over };
        let result = oversketch(&old, &over, &OversketchOptions::default()).expect("it can be corrected");
        check(&old, &over, &result);
    }

    #[test]
    fn rubbish_gives_a_spline_or_an_error(
        closed in any::<bool>(),
        points in prop::collection::vec((-200.0..500.0_f64, -150.0..150.0_f64), 2..14), repeat in 1_usize..3,
    ) {
        let old = if closed { oval() } else { hook() };
        let points: Vec<Point> = points.iter().flat_map(|&p| std::iter::repeat_n(Point::from(p), repeat)).collect();
        if let Ok(result) = oversketch(&old, &Stroke::new("rubbish", points), &OversketchOptions::default()) {
            let s = &result.spline;
            prop_assert!(Spline::new(s.segments().to_vec(), s.joins().to_vec(), s.is_closed()).is_ok());
        }
    }
}
