//! What a stroke means: a curve of its own, or a change of one that is there.

use crate::common::{arch, beside, draw, points, ring, session_of, settle, spline, wave};
use fairpath_curve::{Point, Vec2};
use fairpath_fit::CurveEnd;
use fairpath_sketch::{CurveId, Session};

/// A straight stroke from a point in a direction.
fn straight(from: Point, direction: Vec2, length: f64) -> Vec<Point> {
    let along = direction / direction.hypot();
    (0..=(length / 2.0) as usize).map(|i| from + along * (2.0 * i as f64)).collect()
}

/// The curve that a stroke is drawn over, while it is in hand.
fn over(session: &mut Session, points: &[Point]) -> Option<CurveId> {
    session.begin_stroke(1.0, false);
    points.iter().for_each(|&point| session.extend_stroke(point, None, None));
    session.watch_stroke(false);
    let over = session.hand().unwrap().over().map(|over| over.id);
    session.drop_stroke();
    over
}

#[test]
fn a_stroke_that_leads_away_from_a_curve_at_a_right_angle_becomes_a_curve_of_its_own() {
    let (mut session, ids) = session_of(&[wave()]);
    let mut led_away = 0;
    for share in [0.15, 0.4, 0.6, 0.8] {
        let curve = spline(&session, ids[0]);
        let pose = curve.pose_at(share * curve.length());
        for turn in [1.0, -1.0] {
            let away = Vec2::new(-pose.heading.sin(), pose.heading.cos()) * turn;
            let stroke = straight(pose.point + away, away, 90.0);
            if spline(&session, ids[0]).nearest(stroke[stroke.len() - 1]).distance < 30.0 {
                // It comes back to the curve, and so may mean it.
                continue;
            }
            led_away += 1;
            assert_eq!(over(&mut session, &stroke), None, "{share} {turn}");
            let back: Vec<Point> = stroke.into_iter().rev().collect();
            assert_eq!(over(&mut session, &back), None, "{share} {turn} drawn towards it");
        }
    }
    assert!(led_away >= 5, "{led_away}");
}

#[test]
fn a_stroke_that_begins_and_ends_on_a_curve_changes_it() {
    for shape in [wave(), ring(), arch()] {
        let (mut session, ids) = session_of(&[shape]);
        let curve = spline(&session, ids[0]).clone();
        let stroke = beside(&curve, 0.2 * curve.length(), 0.45 * curve.length(), 20.0);
        assert_eq!(over(&mut session, &stroke), Some(ids[0]));
        let back: Vec<Point> = stroke.iter().rev().copied().collect();
        assert_eq!(over(&mut session, &back), Some(ids[0]));
        draw(&mut session, &stroke);
        settle(&mut session);
        assert_eq!(session.drawing().curves().len(), 1);
        assert!(spline(&session, ids[0]).nearest(stroke[stroke.len() / 2]).distance < 3.0);
    }
}

#[test]
fn a_stroke_that_goes_on_from_an_end_changes_that_end() {
    let (mut session, ids) = session_of(&[wave()]);
    for end in [CurveEnd::Start, CurveEnd::End] {
        let curve = spline(&session, ids[0]).clone();
        let (pose, way) = match end {
            CurveEnd::Start => (curve.start_pose(), -1.0),
            CurveEnd::End => (curve.end_pose(), 1.0),
        };
        let along = Vec2::new(pose.heading.cos(), pose.heading.sin()) * way;
        let stroke = straight(pose.point - along * 20.0, along, 90.0);
        assert_eq!(over(&mut session, &stroke), Some(ids[0]), "{end:?}");
        draw(&mut session, &stroke);
        settle(&mut session);
        assert_eq!(session.drawing().curves().len(), 1);
        let now = spline(&session, ids[0]);
        let place = if end == CurveEnd::Start { now.start_pose().point } else { now.end_pose().point };
        assert!((place - stroke[stroke.len() - 1]).hypot() < 4.0, "{end:?}");
        assert!(now.length() > curve.length() + 50.0);
    }
}

#[test]
fn a_stroke_may_begin_across_one_curve_and_go_on_with_another() {
    let crossed = points(60, |u| (300.0, 40.0 + 120.0 * u));
    let other = points(60, |u| (20.0 + 140.0 * u, 100.0));
    let (mut session, ids) = session_of(&[crossed, other]);
    // From the upright one, at a right angle, to the end of the level one and along it.
    let stroke = straight(Point::new(299.0, 100.0), Vec2::new(-1.0, 0.0), 170.0);
    assert_eq!(over(&mut session, &stroke), Some(ids[1]));
}

#[test]
fn a_stroke_away_from_all_curves_is_over_none() {
    let (mut session, _) = session_of(&[wave()]);
    assert_eq!(over(&mut session, &straight(Point::new(40.0, 400.0), Vec2::new(1.0, 0.3), 120.0)), None);
}

#[test]
fn a_tap_draws_nothing_and_tells_where_it_was() {
    let (mut session, _) = session_of(&[wave()]);
    let before = session.drawing().clone();
    session.begin_stroke(1.0, false);
    session.extend_stroke(Point::new(5.0, 5.0), None, None);
    session.extend_stroke(Point::new(6.0, 5.5), None, None);
    session.watch_stroke(false);
    assert_eq!(session.finish_stroke(false), Some(Point::new(5.0, 5.0)));
    assert!(session.is_settled() && session.drawing() == &before);
}

#[test]
fn a_stroke_in_hand_is_shown_as_the_curve_that_it_becomes() {
    let mut session = Session::default();
    session.begin_stroke(1.0, false);
    for &point in &wave() {
        session.extend_stroke(point, None, None);
    }
    session.watch_stroke(false);
    settle(&mut session);
    let live = session.hand().unwrap().live().unwrap().spline.clone();
    session.finish_stroke(false);
    settle(&mut session);
    assert_eq!(session.drawing().curves()[0].spline, live);
}

#[test]
fn a_preview_is_what_the_curve_becomes() {
    let (mut session, ids) = session_of(&[wave()]);
    let stroke = beside(spline(&session, ids[0]), 60.0, 180.0, 18.0);
    session.begin_stroke(1.0, false);
    stroke.iter().for_each(|&point| session.extend_stroke(point, None, None));
    session.watch_stroke(false);
    settle(&mut session);
    let preview = session.hand().unwrap().preview().unwrap().spline.clone();
    session.finish_stroke(false);
    settle(&mut session);
    assert_eq!(spline(&session, ids[0]), &preview);
}

#[test]
fn a_late_picture_of_one_stroke_is_not_shown_for_the_next() {
    let mut session = Session::default();
    session.begin_stroke(1.0, false);
    wave().iter().for_each(|&point| session.extend_stroke(point, None, None));
    session.watch_stroke(false);
    let (ticket, job) = session.next_job().unwrap();
    session.begin_stroke(1.0, false);
    session.extend_stroke(Point::ORIGIN, None, None);
    session.take_answer(ticket, fairpath_sketch::run(&job));
    assert!(session.hand().unwrap().live().is_none());
}
