//! Deeds on the drawing as a whole: its unit, lists of edits, sets of French curves, the picture behind, pins that let go.

use crate::common::{arch, bits, ring, session_of, settle, shapes, spline, wave};
use fairpath_curve::{Continuity, Point, Vec2};
use fairpath_fit::{CurveEnd, TemplateSet};
use fairpath_io::{Edit, Unit, shipped_templates};
use fairpath_sketch::{Background, CurveId, Method, Neatening, Pin, Session, encode_drawing};
use std::sync::Arc;

fn length(session: &Session, id: CurveId) -> f64 {
    spline(session, id).length()
}

#[test]
fn another_unit_changes_numbers_and_no_size() {
    let (mut session, ids) = session_of(&shapes());
    session.set_background(Some(Arc::new(Background {
        name: "map".into(),
        image: vec![1],
        at: Point::new(10.0, 20.0),
        width: 300.0,
        opacity: 0.5,
    })));
    session.pin(ids[0], None, Pin { share: 0.5, point: Point::new(200.0, 100.0) });
    settle(&mut session);
    let before = session.drawing().clone();
    let px: Vec<f64> = ids.iter().map(|&id| length(&session, id)).collect();
    let factor = session.measure_in(Unit::Mm);
    assert!((factor - 0.254).abs() < 1e-15);
    for (&id, px) in ids.iter().zip(&px) {
        assert!((length(&session, id) - 0.254 * px).abs() < 1e-9 * px);
        let (old, new) = (before.curve(id).unwrap(), session.drawing().curve(id).unwrap());
        assert!((new.report.max_deviation - 0.254 * old.report.max_deviation).abs() < 1e-12);
        assert_eq!(new.neatening.pixel_size, 0.254 * old.neatening.pixel_size);
        assert_eq!(new.spline.joins(), old.spline.joins());
    }
    assert_eq!(session.drawing().background.as_ref().unwrap().width, 300.0 * 0.254);
    assert_eq!(session.history().undoable(), Some("Unit"));
    session.undo();
    assert!(*session.drawing() == before, "undo is exact");
    assert_eq!(session.measure_in(Unit::Px), 1.0);
    assert!(*session.drawing() == before && session.history().undoable() != Some("Unit"));
}

#[test]
fn a_curve_fitted_anew_in_another_unit_has_the_same_shape() {
    for method in Method::ALL {
        let (mut session, ids) = session_of(&[wave()]);
        session.select(Some(ids[0]), false);
        session.set_neatening(Neatening { method, ..Neatening::default() });
        settle(&mut session);
        let px = spline(&session, ids[0]).clone();
        session.measure_in(Unit::In);
        session.set_neatening(Neatening { method, fairness: 0.9, ..Neatening::default() });
        settle(&mut session);
        session.set_neatening(Neatening { method, ..Neatening::default() });
        settle(&mut session);
        let inches = spline(&session, ids[0]);
        assert_eq!(inches.segments().len(), px.segments().len(), "{method:?}");
        let off = px.samples(2.0).into_iter().map(|pose| {
            let point = (pose.point.to_vec2() * 0.01).to_point();
            inches.nearest(point).distance
        });
        let worst = off.fold(0.0, f64::max);
        assert!(worst < 1e-5, "{method:?}: {worst} in");
    }
}

#[test]
fn a_list_of_edits_is_one_step_and_keeps_what_it_does_not_touch() {
    let (mut session, ids) = session_of(&[wave(), arch(), ring()]);
    let names: Vec<String> = session.drawing().curves().iter().map(|curve| curve.name.clone()).collect();
    let before = session.drawing().clone();
    let (start, half) = (length(&session, ids[0]), 0.5 * length(&session, ids[0]));
    let edits = [
        Edit::Extend { spline: Some(names[1].clone()), end: CurveEnd::End, length: 20.0, how: Default::default() },
        Edit::Cut { spline: Some(names[0].clone()), stations: vec![half], keep: None },
    ];
    let untouched = bits(spline(&session, ids[2]));
    let longer = length(&session, ids[1]) + 20.0;
    assert!(session.make_edits(&edits));
    settle(&mut session);
    assert_eq!(session.history().undoable(), Some("Edits"));
    let curves = session.drawing().curves();
    assert_eq!(curves.len(), 4);
    assert_eq!(curves[0].id, ids[0], "the first part is still that curve");
    assert_eq!([&curves[0].name, &curves[1].name], [&format!("{}/1", names[0]), &format!("{}/2", names[0])]);
    assert!((curves[0].spline.length() + curves[1].spline.length() - start).abs() < 1e-9 * start);
    assert!((length(&session, ids[1]) - longer).abs() < 1e-9);
    assert_eq!(bits(spline(&session, ids[2])), untouched);
    let mut seen: Vec<u64> = curves.iter().map(|curve| curve.id.0).collect();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), 4, "identities are never shared");
    session.undo();
    assert!(*session.drawing() == before);
    // What was edited stays so on the slider.
    session.redo();
    session.select(Some(ids[1]), false);
    session.set_neatening(Neatening { fairness: 0.6, ..Neatening::default() });
    settle(&mut session);
    assert!((length(&session, ids[1]) - longer).abs() < 6.0);
}

#[test]
fn a_join_in_a_list_makes_one_curve_of_both() {
    let (mut session, ids) = session_of(&[wave(), arch()]);
    let names: Vec<String> = session.drawing().curves().iter().map(|curve| curve.name.clone()).collect();
    let edit = Edit::Join {
        spline: Some(names[0].clone()),
        end: CurveEnd::End,
        with: names[1].clone(),
        with_end: CurveEnd::Start,
        continuity: Continuity::G2,
        reach: 10.0,
    };
    let points: usize = session.drawing().curves().iter().map(|curve| curve.stroke.points.len()).sum();
    assert!(session.make_edits(&[edit]));
    settle(&mut session);
    let curves = session.drawing().curves();
    assert_eq!(curves.len(), 1);
    assert_eq!(curves[0].id, ids[0]);
    assert!(curves[0].stroke.points.len() > points / 2, "it carries both strokes");
}

#[test]
fn a_list_that_cannot_be_made_changes_nothing_and_names_the_edit() {
    let (mut session, _) = session_of(&[wave(), arch()]);
    let name = session.drawing().curves()[0].name.clone();
    let before = session.drawing().clone();
    let good = Edit::Extend { spline: Some(name.clone()), end: CurveEnd::End, length: 9.0, how: Default::default() };
    for (bad, said) in [
        (Edit::Extend { spline: None, end: CurveEnd::End, length: 9.0, how: Default::default() }, "say by"),
        (Edit::Extend { spline: Some("x".into()), end: CurveEnd::End, length: 9.0, how: Default::default() }, "\"x\""),
        (Edit::Cut { spline: Some(name.clone()), stations: vec![f64::NAN], keep: None }, "edit 2 (cut)"),
        (Edit::Cut { spline: Some(name), stations: vec![10.0], keep: Some(vec![3]) }, "part 3"),
    ] {
        assert!(!session.make_edits(&[good.clone(), bad]));
        let trouble = session.take_trouble().expect("it is told");
        assert!(trouble.text.contains(said) && trouble.text.contains("edit 2"), "{trouble:?}");
        assert!(*session.drawing() == before);
    }
}

#[test]
fn a_set_of_french_curves_replaces_the_one_of_its_name() {
    let mut session = Session::default();
    let shipped = shipped_templates("burmester").unwrap();
    let set = |count: usize| TemplateSet::new("mine", shipped.templates()[..count].to_vec()).unwrap();
    for count in [3, 1] {
        assert_eq!(session.add_templates(set(count)), "mine");
        assert_eq!(session.drawing().template_sets.len(), 1);
        assert_eq!(session.drawing().template_set("mine").unwrap().templates().len(), count);
    }
    session.undo();
    assert_eq!(session.drawing().template_set("mine").unwrap().templates().len(), 3);
}

#[test]
fn the_picture_behind_is_moved_scaled_and_faded_in_steps_of_undo() {
    let mut session = Session::default();
    session.fade_background(0.3);
    assert!(session.drawing().background.is_none(), "there is none to fade");
    let picture =
        Background { name: "map".into(), image: vec![1], at: Point::new(0.0, 0.0), width: 100.0, opacity: 0.5 };
    session.set_background(Some(Arc::new(picture.clone())));
    for _ in 0..10 {
        session.move_background(Vec2::new(1.0, 2.0));
    }
    session.end_gesture();
    session.scale_background(50.0, 2.0);
    session.scale_background(40.0, 2.0);
    let scaled = session.drawing().background.clone().unwrap();
    // Its middle was at (50, 100) and moved by (10, 20).
    assert!((scaled.at - Point::new(40.0, 80.0)).hypot() < 1e-9, "{:?}", scaled.at);
    for bad in [f64::NAN, -1.0, 0.0, f64::INFINITY] {
        session.scale_background(bad, 2.0);
        session.move_background(Vec2::new(1e300, 0.0));
        session.fade_background(7.0);
        assert_eq!(session.drawing().background.as_ref(), Some(&scaled));
    }
    session.undo();
    session.undo();
    assert_eq!(session.drawing().background.as_deref(), Some(&picture));
}

#[test]
fn a_pin_that_lets_go_gives_the_curve_back_and_the_others_hold_on() {
    let (mut session, ids) = session_of(&[wave()]);
    let free = session.drawing().clone();
    let pins = [(0.3, Point::new(140.0, 60.0)), (0.7, Point::new(260.0, 200.0))];
    for (share, point) in pins {
        session.pin(ids[0], None, Pin { share, point });
        session.end_gesture();
        settle(&mut session);
    }
    session.unpin(ids[0], 0);
    settle(&mut session);
    let curve = session.drawing().curve(ids[0]).unwrap();
    assert_eq!(curve.pins.len(), 1);
    assert!(curve.spline.nearest(pins[1].1).distance < 1e-6);
    session.unpin(ids[0], 7);
    assert_eq!(session.drawing().curve(ids[0]).unwrap().pins.len(), 1, "there is no such pin");
    session.unpin(ids[0], 0);
    settle(&mut session);
    let curve = session.drawing().curve(ids[0]).unwrap();
    assert_eq!(bits(&curve.spline), bits(&free.curve(ids[0]).unwrap().spline));
    assert!(curve.fitted && curve.unpinned.is_none() && curve.pins.is_empty());
    session.undo();
    assert_eq!(session.drawing().curve(ids[0]).unwrap().pins.len(), 1);
}

#[test]
fn the_next_curve_follows_the_selected_one_around() {
    let (mut session, ids) = session_of(&[wave(), arch(), ring()]);
    let selected = |session: &Session| session.selected().map(|curve| curve.id);
    session.select(None, false);
    for i in [0, 1, 2, 0] {
        session.select_next(false);
        assert_eq!(selected(&session), Some(ids[i]));
    }
    session.select_next(true);
    assert_eq!(selected(&session), Some(ids[2]));
    let mut empty = Session::default();
    empty.select_next(true);
    assert_eq!(selected(&empty), None);
    assert!(encode_drawing(empty.drawing()).is_ok());
}

#[test]
fn undo_leads_back_over_opening_a_file_and_beginning_a_new_drawing() {
    let (mut session, _) = session_of(&[wave(), arch()]);
    let first = session.drawing().clone();
    let (other, _) = session_of(&[ring()]);
    let mut other = other.drawing().clone();
    other.unit = Unit::Mm;
    session.open(other.clone());
    assert_eq!(session.history().undoable(), Some("Open"));
    assert_eq!((session.drawing().unit, session.drawing().curves().len()), (Unit::Mm, 1));
    let opened = session.drawing().clone();
    let id = opened.curves()[0].id;
    assert!(first.curves().iter().all(|curve| curve.id != id), "no curve has the identity of another drawing's");
    session.begin_new();
    assert!(session.drawing().curves().is_empty());
    assert_eq!(session.drawing().unit, Unit::Mm);
    let documents = [&first, &opened, session.drawing()].map(|drawing| drawing.document);
    assert!(documents[0] != documents[1] && documents[1] != documents[2], "{documents:?}");
    session.undo();
    assert!(*session.drawing() == opened && session.drawing().document == opened.document);
    session.undo();
    assert!(*session.drawing() == first && session.drawing().document == first.document);
    session.redo();
    assert_eq!(encode_drawing(session.drawing()).unwrap(), encode_drawing(&opened).unwrap());
    while session.history().undoable().is_some() {
        session.undo();
    }
    assert!(session.drawing().curves().is_empty());
}

#[test]
fn what_was_under_way_never_lands_in_a_drawing_that_was_opened() {
    let (mut session, ids) = session_of(&[wave()]);
    let (other, _) = session_of(&[ring()]);
    session.select(Some(ids[0]), false);
    session.set_neatening(Neatening { fairness: 0.9, ..Neatening::default() });
    let (ticket, job) = session.next_job().expect("it is to be fitted anew");
    session.open(other.drawing().clone());
    let opened = session.drawing().clone();
    session.take_answer(ticket, fairpath_sketch::run(&job));
    settle(&mut session);
    assert!(*session.drawing() == opened);
    assert!(session.selected().is_none() && session.take_trouble().is_none());
}
