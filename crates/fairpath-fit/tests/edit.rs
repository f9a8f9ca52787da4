//! Edits of splines: what they promise exactly, on curves of all kinds.

use fairpath_curve::{Continuity, Point, Segment, Spline, Vec2, trig};
use fairpath_fit::{
    Constraint, CurveEnd, EditError, Extension, close, cut, extend, interpolate, interpolate_all, join, make_corner,
    smooth_corner,
};
use proptest::prelude::*;
use std::f64::consts::PI;

/// A line, a clothoid, an arc and a clothoid, G2, with a corner before the last line.
fn road() -> Spline {
    let mut segments = vec![Segment::line(Point::new(10.0, 20.0), 0.3, 120.0)];
    for (length, kappa0, kappa1) in [(80.0, 0.0, 0.01), (90.0, 0.01, 0.01), (100.0, 0.01, -0.004)] {
        let last = segments[segments.len() - 1].end_pose();
        segments.push(Segment::clothoid(last.point, last.heading, length, kappa0, kappa1));
    }
    let last = segments[3].end_pose();
    segments.push(Segment::line(last.point, last.heading + 1.2, 150.0));
    let joins = vec![Continuity::G2, Continuity::G2, Continuity::G2, Continuity::G0];
    Spline::new(segments, joins, false).expect("it is a spline")
}

fn ring() -> Spline {
    let quarter = |start: Point, heading: f64| Segment::arc(start, heading, 50.0 * PI, 0.01);
    let mut segments = vec![quarter(Point::new(0.0, 0.0), 0.0)];
    for _ in 0..3 {
        let last = segments[segments.len() - 1].end_pose();
        segments.push(quarter(last.point, last.heading));
    }
    Spline::new(segments, vec![Continuity::G3; 4], true).expect("it is a ring")
}

fn bits(s: &Segment) -> [u64; 6] {
    [s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1].map(f64::to_bits)
}

/// Segments of one spline that the other has to the bit.
fn shared(a: &Spline, b: &Spline) -> usize {
    let of_b: Vec<_> = b.segments().iter().map(bits).collect();
    a.segments().iter().filter(|s| of_b.contains(&bits(s))).count()
}

#[test]
fn extending_goes_on_as_asked_and_changes_nothing_else() {
    let old = road();
    for (end, at) in [(CurveEnd::Start, 0.0), (CurveEnd::End, old.length())] {
        for how in [Extension::Curvature, Extension::Sharpness, Extension::Straight] {
            let new = extend(&old, end, 40.0, how).expect("it can be extended");
            assert!((new.length() - old.length() - 40.0).abs() < 1e-9);
            assert!(shared(&old, &new) >= 4);
            let shift = if end == CurveEnd::Start { 40.0 } else { 0.0 };
            assert!((new.point_at(at + shift) - old.point_at(at)).hypot() < 1e-9, "{end:?} {how:?}");
        }
    }
    let bend = cut(&old, &[150.0]).expect("two parts").remove(0);
    let kappa = bend.end_pose().curvature;
    let arc = extend(&bend, CurveEnd::End, 30.0, Extension::Curvature).expect("it can be extended");
    assert_eq!((arc.segments().len(), arc.joins()[1], arc.end_pose().curvature), (3, Continuity::G2, kappa));
    let line = extend(&bend, CurveEnd::End, 30.0, Extension::Straight).expect("it can be extended");
    assert_eq!((line.joins()[1], line.end_pose().curvature), (Continuity::G1, 0.0));
    let spiral = extend(&bend, CurveEnd::End, 30.0, Extension::Sharpness).expect("it can be extended");
    assert_eq!(spiral.segments().len(), 2);
    assert!((spiral.end_pose().curvature - 2.0 * kappa).abs() < 1e-15);
    // As the whole clothoid was.
    assert!((spiral.point_at(170.0) - old.point_at(170.0)).hypot() < 1e-9);
    assert!(matches!(extend(&ring(), CurveEnd::End, 1.0, Extension::Straight), Err(EditError::Closed { .. })));
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(extend(&old, CurveEnd::End, length, Extension::Straight), Err(EditError::NotPositive { .. })));
    }
}

#[test]
fn cuts_part_a_curve_without_moving_it() {
    let old = road();
    let parts = cut(&old, &[300.0, 100.0, 120.0]).expect("four parts");
    assert_eq!(parts.len(), 4);
    let mut begin = 0.0;
    for part in &parts {
        for i in 0..=10 {
            let s = part.length() * f64::from(i) / 10.0;
            assert!((part.point_at(s) - old.point_at(begin + s)).hypot() < 1e-9);
        }
        begin += part.length();
    }
    assert!((begin - old.length()).abs() < 1e-9);
    // A closed curve opens.
    let open = cut(&ring(), &[-20.0]).expect("one part").remove(0);
    assert!(!open.is_closed() && (open.length() - ring().length()).abs() < 1e-9);
    assert!((open.start_pose().point - open.end_pose().point).hypot() < 1e-9);
    assert_eq!(cut(&ring(), &[10.0, 500.0]).expect("two parts").len(), 2);
    assert_eq!(cut(&old, &[]).expect("itself"), vec![old.clone()]);
    for bad in [vec![0.0], vec![10.0, 10.0], vec![old.length()], vec![-5.0], vec![f64::NAN], vec![1e9]] {
        assert!(cut(&old, &bad).is_err(), "{bad:?}");
    }
}

#[test]
fn joining_meets_both_curves_as_smoothly_as_asked() {
    let a = cut(&road(), &[250.0]).expect("two parts").remove(0);
    let b =
        Spline::new(vec![Segment::arc(Point::new(420.0, 250.0), 0.4, 150.0, -0.006)], vec![], false).expect("an arc");
    for end_a in [CurveEnd::Start, CurveEnd::End] {
        for end_b in [CurveEnd::Start, CurveEnd::End] {
            for continuity in [Continuity::G0, Continuity::G1, Continuity::G2] {
                for reach in [0.0, 25.0] {
                    let whole = join(&a, end_a, &b, end_b, continuity, reach).expect("they can be joined");
                    assert!(whole.joins().iter().all(|j| *j >= continuity));
                    let turned = if end_a == CurveEnd::End { a.clone() } else { a.reversed() };
                    assert!(
                        shared(&turned, &whole) >= a.segments().len() - 1,
                        "{end_a:?} {end_b:?} {continuity:?} {reach}"
                    );
                    let far = if end_b == CurveEnd::Start { b.end_pose().point } else { b.start_pose().point };
                    assert!((whole.end_pose().point - far).hypot() < 1e-9);
                }
            }
        }
    }
    let ring = close(&a, Continuity::G2, 10.0).expect("it can be closed");
    assert!(ring.is_closed() && ring.joins().iter().all(|j| *j >= Continuity::G2));
    // What meets already needs nothing between.
    let [first, second] = <[Spline; 2]>::try_from(cut(&road(), &[250.0]).expect("two parts")).expect("two");
    let again = join(&first, CurveEnd::End, &second, CurveEnd::Start, Continuity::G2, 0.0).expect("they meet");
    assert_eq!(again.segments().len(), first.segments().len() + second.segments().len());
    assert!(matches!(
        join(&a, CurveEnd::End, &b, CurveEnd::Start, Continuity::G1, 1e4),
        Err(EditError::ReachTooLong { .. })
    ));
    assert!(matches!(
        join(&a, CurveEnd::End, &ring, CurveEnd::Start, Continuity::G1, 0.0),
        Err(EditError::Closed { .. })
    ));
    assert!(join(&a, CurveEnd::End, &b, CurveEnd::Start, Continuity::G1, f64::NAN).is_err());
}

/// The constraint holds exactly, joins beside it are G2, and what lies beyond the reach is as it was.
fn check(old: &Spline, new: &Spline, constraints: &[Constraint], reach: f64) {
    let mut stations = Vec::new();
    for c in constraints {
        let near = new.nearest(c.point);
        assert!(near.distance < 1e-9, "{:e} off", near.distance);
        let pose = new.segments()[near.segment].pose_at(near.s);
        if let Some(heading) = c.heading {
            assert!(trig::wrap_angle(pose.heading - heading).abs() < 1e-9);
        }
        if let Some(curvature) = c.curvature {
            assert!((pose.curvature - curvature).abs() < 1e-9);
        }
        let before = old.nearest(c.point);
        stations.push(c.station.unwrap_or_else(|| old.station(before.segment, before.s)));
    }
    let corners = |s: &Spline| s.joins().iter().filter(|j| **j < Continuity::G2).count();
    assert_eq!(corners(old), corners(new));
    let length = old.length();
    for i in 0..=100 {
        let s = length * f64::from(i) / 100.0;
        let apart = |at: &f64| {
            let d = (s - at).abs();
            if old.is_closed() { d.min(length - d) } else { d }
        };
        if stations.iter().all(|at| apart(at) > 2.25 * reach) {
            assert!(new.nearest(old.point_at(s)).distance < 1e-9, "station {s} has moved");
        }
    }
}

#[test]
fn a_curve_passes_through_points_exactly() {
    let old = road();
    let point = old.point_at(200.0) + Vec2::new(3.0, -8.0);
    let cases = [
        Constraint::through(point),
        Constraint::moved(200.0, point),
        Constraint { heading: Some(old.pose_at(200.0).heading + 0.2), ..Constraint::through(point) },
        Constraint { curvature: Some(0.0), ..Constraint::moved(215.0, point) },
        Constraint { heading: Some(1.2), curvature: Some(0.02), ..Constraint::through(point) },
    ];
    for case in cases {
        for reach in [30.0, 60.0] {
            let new = interpolate(&old, &case, reach).expect("it can be met");
            check(&old, &new, &[case], reach);
        }
    }
}

#[test]
fn a_curve_that_passes_there_already_hardly_changes() {
    let old = road();
    let at = old.pose_at(230.0);
    let new = interpolate(&old, &Constraint::moved(230.0, at.point), 25.0).expect("it can be met");
    let far =
        (0..=200).map(|i| old.nearest(new.point_at(new.length() * f64::from(i) / 200.0)).distance).fold(0.0, f64::max);
    assert!(far < 0.02, "{far}");
}

#[test]
fn several_points_are_met_together() {
    for old in [road(), ring()] {
        let moved = |s: f64, by: Vec2| Constraint::moved(s, old.point_at(s) + by);
        let constraints = [
            moved(150.0, Vec2::new(2.0, 5.0)),
            moved(190.0, Vec2::new(-3.0, 4.0)),
            moved(260.0, Vec2::new(3.0, -3.0)),
            moved(20.0, Vec2::new(-1.0, 4.0)),
        ];
        let new = interpolate_all(&old, &constraints, 30.0).expect("they can be met");
        check(&old, &new, &constraints, 30.0);
    }
    // Across the start of a closed curve, and another elsewhere.
    let old = ring();
    let moved = |s: f64, by: Vec2| Constraint::moved(s, old.point_at(s) + by);
    let constraints = [
        moved(10.0, Vec2::new(0.0, 5.0)),
        moved(old.length() - 15.0, Vec2::new(0.0, -4.0)),
        moved(300.0, Vec2::new(6.0, 0.0)),
    ];
    check(&old, &interpolate_all(&old, &constraints, 30.0).expect("they can be met"), &constraints, 30.0);
    let twice = [moved(10.0, Vec2::ZERO), moved(10.0, Vec2::new(1.0, 0.0))];
    assert!(matches!(interpolate_all(&old, &twice, 30.0), Err(EditError::SamePlace { first: 0, second: 1 })));
}

#[test]
fn an_end_is_moved_and_a_corner_stays() {
    let old = road();
    let end = old.end_pose().point + Vec2::new(6.0, 9.0);
    let new = interpolate(&old, &Constraint::moved(old.length(), end), 50.0).expect("it can be met");
    assert!((new.end_pose().point - end).hypot() < 1e-9);
    let start = old.start_pose().point + Vec2::new(-6.0, 9.0);
    let new = interpolate(&old, &Constraint::moved(0.0, start), 50.0).expect("it can be met");
    assert!((new.start_pose().point - start).hypot() < 1e-9);
    // Near an end, the end stays.
    let near = Constraint::moved(20.0, old.point_at(20.0) + Vec2::new(0.0, 3.0));
    let new = interpolate(&old, &near, 50.0).expect("it can be met");
    assert!((new.start_pose().point - old.start_pose().point).hypot() < 1e-9);
    // Near the corner, that stays.
    let station = 380.0;
    let near = Constraint::moved(station, old.point_at(station) + Vec2::new(2.0, -2.0));
    let new = interpolate(&old, &near, 40.0).expect("it can be met");
    check(&old, &new, &[near], 40.0);
    assert!(new.nearest(old.segments()[4].start).distance < 1e-9);
}

#[test]
fn corners_are_made_smooth_and_back() {
    let old = road();
    let smooth = smooth_corner(&old, 3, 20.0).expect("it can be smoothed");
    assert!(smooth.joins().iter().all(|j| *j >= Continuity::G2));
    assert_eq!(shared(&old, &smooth), 3);
    assert!(matches!(smooth_corner(&old, 1, 20.0), Err(EditError::NotACorner { join: 1 })));
    assert!(matches!(smooth_corner(&old, 3, 1e3), Err(EditError::ReachTooLong { .. })));
    // Two lines: smoothed over the same reach and sharpened again, they are what they were.
    let line = Segment::line(Point::new(0.0, 0.0), 0.0, 100.0);
    let leg = Segment::line(Point::new(100.0, 0.0), 1.0, 100.0);
    let hook = Spline::new(vec![line, leg], vec![Continuity::G0], false).expect("a hook");
    let smooth = smooth_corner(&hook, 0, 30.0).expect("it can be smoothed");
    let middle = 0.5 * smooth.length();
    let sharp = make_corner(&smooth, middle, middle - 70.0).expect("it can be sharpened");
    assert!(sharp.nearest(Point::new(100.0, 0.0)).distance < 1e-9);
    assert!(sharp.joins().contains(&Continuity::G0));
    assert!(matches!(make_corner(&hook, 50.0, 10.0), Err(EditError::NoCrossing)));
    assert!(make_corner(&hook, f64::NAN, 10.0).is_err());
}

/// Shares of a length that are near its ends, the corner of the road, or where other curves are cut.
fn nearly() -> impl Strategy<Value = f64> {
    let corner = 390.0 / 540.0;
    let near = prop_oneof![Just(0.0), Just(1.0), Just(corner), Just(0.25), Just(0.5)];
    let off = prop_oneof![Just(0.0), Just(1e-12), Just(1e-7), Just(1e-3), 0.0..0.05_f64];
    prop_oneof![
        2 => (near, off, any::<bool>()).prop_map(|(at, off, ahead)| if ahead { at + off } else { at - off }),
        1 => 0.0..1.0_f64,
    ]
    .prop_map(|share: f64| share.clamp(0.0, 1.0))
}

/// How far a place is moved along an axis.
fn pull() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), -1e-9..1e-9_f64, -12.0..12.0_f64, -400.0..400.0_f64]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn a_moved_place_is_met_or_refused(
        closed in any::<bool>(), at in 0.0..1.0_f64, x in -12.0..12.0_f64, y in -12.0..12.0_f64, reach in 8.0..90.0_f64,
        turn in prop::option::of(-0.5..0.5_f64),
    ) {
        let old = if closed { ring() } else { road() };
        let station = at * old.length();
        let now = old.pose_at(station);
        let heading = turn.map(|t| now.heading + t);
        let constraint = Constraint { heading, ..Constraint::moved(station, now.point + Vec2::new(x, y)) };
        if let Ok(new) = interpolate(&old, &constraint, reach) {
            prop_assert!(new.nearest(constraint.point).distance < 1e-9);
            let corners = |s: &Spline| s.joins().iter().filter(|j| **j < Continuity::G2).count();
            prop_assert!(corners(&new) <= corners(&old));
            prop_assert_eq!(new.is_closed(), closed);
        }
    }

    /// Places near ends, corners, the seam and each other, moved by next to nothing and by more than the reach.
    #[test]
    fn nearly_degenerate_pulls_are_met_without_running_away(
        closed in any::<bool>(),
        places in prop::collection::vec((nearly(), pull(), pull()), 1..6),
        reach in prop_oneof![Just(2.0), 8.0..90.0_f64, Just(300.0)],
    ) {
        let old = if closed { ring() } else { road() };
        let moved = |&(share, x, y): &(f64, f64, f64)| {
            let station = share * old.length();
            Constraint::moved(station, old.point_at(station) + Vec2::new(x, y))
        };
        let constraints: Vec<_> = places.iter().map(moved).collect();
        if let Ok(new) = interpolate_all(&old, &constraints, reach) {
            let size = old.length() + places.iter().map(|(_, x, y)| x.abs() + y.abs()).sum::<f64>();
            for constraint in &constraints {
                prop_assert!(new.nearest(constraint.point).distance < 1e-9 * size);
            }
            prop_assert_eq!(new.is_closed(), closed);
            prop_assert!(new.segments().iter().all(Segment::is_valid));
            // A piece is no longer than eight of its chords.
            prop_assert!(new.length() < 20.0 * size, "{} of {size}", new.length());
            let again = interpolate_all(&old, &constraints, reach).expect("it was found before");
            prop_assert_eq!(new.segments().iter().map(bits).collect::<Vec<_>>(), again.segments().iter().map(bits).collect::<Vec<_>>());
        } else {
            // Only what cannot be told apart is refused.
            let mut shares: Vec<f64> = places.iter().map(|place| place.0).collect();
            shares.sort_by(f64::total_cmp);
            let near = shares.windows(2).map(|pair| pair[1] - pair[0]).fold(1.0 - shares[shares.len() - 1] + shares[0], f64::min);
            prop_assert!(near < 1e-6 || !(5.0..=100.0).contains(&reach), "{near}");
        }
    }
}
