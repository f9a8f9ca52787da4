//! Strokes that no hand draws: the session stays sound, and goes on.

use crate::common::{draw, session_of, settle, spline, wave};
use fairpath_curve::{Point, Vec2};
use fairpath_fit::{CurveEnd, Extension, Stroke};
use fairpath_sketch::{Curve, CurveId, Method, Neatening, Pin, Session};
use proptest::prelude::*;

/// A coordinate that is not meant well.
fn bad() -> impl Strategy<Value = f64> {
    let values =
        vec![0.0, -0.0, 1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 1e-300, f64::MAX, 5e-324];
    prop_oneof![3 => prop::sample::select(values), 2 => -500.0..500.0_f64]
}

fn bad_points() -> impl Strategy<Value = Vec<Point>> {
    let point = (bad(), bad()).prop_map(|(x, y)| Point::new(x, y));
    prop::collection::vec((point, 1..3_usize), 0..12)
        .prop_map(|points| points.into_iter().flat_map(|(point, times)| vec![point; times]).collect())
}

/// Everything that a hand can do to each curve that there is.
fn try_everything(session: &mut Session) {
    let ids: Vec<CurveId> = session.drawing().curves().iter().map(|curve| curve.id).collect();
    for id in ids {
        let length = spline(session, id).length();
        session.select(Some(id), false);
        session.extend(id, CurveEnd::End, 0.1 * length, Extension::Sharpness);
        session.toggle_corner(id, 0.5 * length, 10.0);
        session.pin(id, None, Pin { share: 0.3, point: Point::new(1.0, 2.0) });
        settle(session);
        session.cut(id, 0.4 * length);
        session.close(id, 10.0);
        session.duplicate_selected(Vec2::new(3.0, 3.0));
        session.set_neatening(Neatening { fairness: 0.9, ..session.neatening().clone() });
        settle(session);
        session.end_gesture();
    }
}

fn check(session: &Session) {
    for curve in session.drawing().curves() {
        assert!(curve.spline.segments().iter().all(fairpath_curve::Segment::is_valid));
        assert!(curve.stroke.points.iter().all(|point| point.is_finite()));
    }
    let _ = session.nearest(Point::new(3.0, 4.0), 10.0);
}

/// What was not finite or a dot is not in the drawing; the next good stroke is as ever.
fn goes_on_as_ever(session: &mut Session) {
    let count = session.drawing().curves().len();
    session.set_neatening(Neatening::default());
    session.begin_stroke(1.0, false);
    wave().iter().for_each(|&point| session.extend_stroke(point, None, None));
    session.finish_stroke(true);
    settle(session);
    assert_eq!(session.drawing().curves().len(), count + 1);
    let (good, _) = session_of(&[wave()]);
    assert_eq!(session.drawing().curves()[count].spline, good.drawing().curves()[0].spline);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_session_survives_any_stroke(points in bad_points(), fresh in any::<bool>(), greedy in any::<bool>()) {
        let (mut session, _) = session_of(&[wave()]);
        session.begin_stroke(1.0, greedy);
        for &point in &points {
            session.extend_stroke(point, None, None);
            session.watch_stroke(fresh);
        }
        let _ = session.finish_stroke(fresh);
        settle(&mut session);
        check(&session);
        try_everything(&mut session);
        check(&session);
        goes_on_as_ever(&mut session);
    }

    #[test]
    fn a_session_survives_any_curve_of_a_file(points in bad_points(), method in 0..6_usize) {
        let neatening = Neatening { method: Method::ALL[method], ..Neatening::default() };
        let Ok(curve) = Curve::drawn(CurveId(0), Stroke::new("odd", points), neatening) else { return Ok(()) };
        let mut session = Session::default();
        session.add("Open", vec![curve]);
        settle(&mut session);
        check(&session);
    }

    #[test]
    fn a_session_survives_any_pull_and_move(x in bad(), y in bad(), share in bad(), at in bad()) {
        let (mut session, ids) = session_of(&[wave()]);
        session.pin(ids[0], None, Pin { share, point: Point::new(x, y) });
        session.pin(ids[0], Some(7), Pin { share: 0.5, point: Point::new(x, y) });
        settle(&mut session);
        session.select_all();
        session.move_selected(Vec2::new(x, y));
        session.cut(ids[0], at);
        session.shorten(ids[0], CurveEnd::Start, at);
        session.extend(ids[0], CurveEnd::End, at, Extension::Curvature);
        session.toggle_corner(ids[0], at, x);
        session.close(ids[0], y);
        settle(&mut session);
        check(&session);
        while session.history().undoable().is_some() {
            session.undo();
        }
        prop_assert!(session.drawing().curves().is_empty());
    }
}

#[test]
fn a_dot_and_two_equal_points_become_nothing() {
    for points in [vec![Point::new(3.0, 4.0)], vec![Point::new(3.0, 4.0); 2], vec![Point::new(3.0, 4.0); 50], vec![]] {
        let mut session = Session::default();
        draw(&mut session, &points);
        settle(&mut session);
        assert!(session.drawing().curves().is_empty());
        assert_eq!(session.history().undoable(), None);
    }
}

#[test]
fn a_stroke_of_a_hundred_thousand_points_is_drawn_edited_and_undone() {
    let points: Vec<Point> = (0..100_000)
        .map(|i| {
            let t = 1e-4 * f64::from(i);
            Point::new(80.0 * t + 0.3 * (91.0 * t).sin(), 200.0 + 60.0 * t.sin())
        })
        .collect();
    let mut session = Session::default();
    draw(&mut session, &points);
    let id = session.drawing().curves()[0].id;
    // While the points themselves stand for the curve, it can be edited all the same.
    session.cut(id, 300.0);
    assert_eq!(session.drawing().curves().len(), 2);
    settle(&mut session);
    assert!(session.drawing().curves().iter().all(|curve| curve.fitted && curve.spline.segments().len() < 40));
    session.undo();
    session.undo();
    assert!(session.drawing().curves().is_empty());
}
