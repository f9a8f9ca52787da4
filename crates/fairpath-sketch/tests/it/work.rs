//! Deeds in any order, with answers that come late or never: what is undone and done again is as it was.

use crate::common::{beside, bits, corner, draw, ring, session_of, settle, shapes, spline, wave, work_once};
use fairpath_curve::{Point, Vec2};
use fairpath_fit::{CurveEnd, Extension, FitOptions, Stroke, fit};
use fairpath_io::{Unit, YAxis};
use fairpath_shape::InflateOptions;
use fairpath_sketch::{Answer, Curve, CurveId, Drawing, Method, Neatening, Pin, Session, Trouble, encode_drawing, run};
use proptest::prelude::*;

/// What a person may do. Numbers name a curve by its order and a place by its share.
#[derive(Clone, Debug)]
enum Deed {
    Draw(usize, f64),
    DrawOver(usize, f64),
    DropStroke(usize),
    Move(usize, f64),
    Cut(usize, f64),
    Join(usize, usize),
    Close(usize),
    Open(usize),
    Extend(usize, bool),
    Shorten(usize, bool),
    Corner(usize, f64),
    Pin(usize, f64, f64),
    Neaten(usize, f64),
    Delete(usize),
    Duplicate(usize),
    OpenDrawing(usize),
    EndGesture,
    Undo,
    Redo,
    /// The worker does a job.
    Work,
    /// The worker takes a job and answers when the next one is taken, or never.
    Stall,
}

fn deed() -> impl Strategy<Value = Deed> {
    let (which, share, shift) = (0..6_usize, 0.05..0.95_f64, -40.0..40.0_f64);
    prop_oneof![
        6 => (0..5_usize, shift.clone()).prop_map(|(shape, by)| Deed::Draw(shape, by)),
        4 => (which.clone(), share.clone()).prop_map(|(i, at)| Deed::DrawOver(i, at)),
        1 => which.clone().prop_map(Deed::DropStroke),
        2 => (which.clone(), shift.clone()).prop_map(|(i, by)| Deed::Move(i, by)),
        2 => (which.clone(), share.clone()).prop_map(|(i, at)| Deed::Cut(i, at)),
        2 => (which.clone(), which.clone()).prop_map(|(i, j)| Deed::Join(i, j)),
        2 => which.clone().prop_map(Deed::Close),
        1 => which.clone().prop_map(Deed::Open),
        2 => (which.clone(), any::<bool>()).prop_map(|(i, end)| Deed::Extend(i, end)),
        1 => (which.clone(), any::<bool>()).prop_map(|(i, end)| Deed::Shorten(i, end)),
        2 => (which.clone(), share.clone()).prop_map(|(i, at)| Deed::Corner(i, at)),
        3 => (which.clone(), share.clone(), shift).prop_map(|(i, at, by)| Deed::Pin(i, at, by)),
        3 => (which.clone(), 0.0..1.0_f64).prop_map(|(i, fairness)| Deed::Neaten(i, fairness)),
        1 => which.clone().prop_map(Deed::Delete),
        2 => which.prop_map(Deed::Duplicate),
        1 => (0..5_usize).prop_map(Deed::OpenDrawing),
        2 => Just(Deed::EndGesture),
        3 => Just(Deed::Undo),
        2 => Just(Deed::Redo),
        8 => Just(Deed::Work),
        3 => Just(Deed::Stall),
    ]
}

/// A session with a worker that may be late.
#[derive(Default)]
struct Desktop {
    session: Session,
    late: Option<(fairpath_sketch::Ticket, Answer)>,
}

impl Desktop {
    fn curve(&self, which: usize) -> Option<CurveId> {
        let curves = self.session.drawing().curves();
        (!curves.is_empty()).then(|| curves[which % curves.len()].id)
    }

    /// Does something to a curve, if there is one.
    fn with(&mut self, which: usize, deed: impl FnOnce(&mut Session, CurveId)) {
        if let Some(id) = self.curve(which) {
            deed(&mut self.session, id);
        }
    }

    fn with_selected(&mut self, which: usize, deed: impl FnOnce(&mut Session)) {
        self.with(which, |session, id| {
            session.select(Some(id), false);
            deed(session);
        });
    }

    fn answer_late(&mut self) {
        if let Some((ticket, answer)) = self.late.take() {
            self.session.take_answer(ticket, answer);
        }
    }

    fn settle(&mut self) {
        self.answer_late();
        settle(&mut self.session);
    }

    fn act(&mut self, deed: &Deed) {
        let end = |at_end: bool| if at_end { CurveEnd::End } else { CurveEnd::Start };
        match *deed {
            Deed::Draw(shape, by) => {
                let points: Vec<Point> = shapes()[shape].iter().map(|&p| p + Vec2::new(by, 0.5 * by)).collect();
                draw(&mut self.session, &points);
            }
            Deed::DrawOver(which, at) => self.with(which, |session, id| {
                let curve = spline(session, id);
                let from = 0.7 * at * curve.length();
                let points = beside(curve, from, from + 0.25 * curve.length(), 12.0);
                draw(session, &points);
            }),
            Deed::DropStroke(shape) => {
                self.session.begin_stroke(1.0, false);
                for &point in &shapes()[shape % 5] {
                    self.session.extend_stroke(point, None, None);
                }
                self.session.watch_stroke(false);
                self.session.drop_stroke();
            }
            Deed::Move(which, by) => self.with_selected(which, |session| session.move_selected(Vec2::new(by, -by))),
            Deed::Cut(which, at) => self.with(which, |session, id| session.cut(id, at * spline(session, id).length())),
            Deed::Join(a, b) => {
                if let (Some(a), Some(b)) = (self.curve(a), self.curve(b)) {
                    self.session.join(a, b, 24.0);
                }
            }
            Deed::Close(which) => self.with(which, |session, id| session.close(id, 24.0)),
            Deed::Open(which) => self.with(which, |session, id| session.open_curve(id)),
            Deed::Extend(which, at_end) => {
                self.with(which, |session, id| session.extend(id, end(at_end), 30.0, Extension::Curvature));
            }
            Deed::Shorten(which, at_end) => self.with(which, |session, id| {
                let length = spline(session, id).length();
                session.shorten(id, end(at_end), if at_end { 0.9 * length } else { 0.1 * length });
            }),
            Deed::Corner(which, at) => {
                self.with(which, |session, id| session.toggle_corner(id, at * spline(session, id).length(), 20.0));
            }
            Deed::Pin(which, share, by) => self.with(which, |session, id| {
                let curve = spline(session, id);
                let point = curve.point_at(share * curve.length()) + Vec2::new(0.3 * by, 0.2 * by);
                session.pin(id, None, Pin { share, point });
            }),
            Deed::Neaten(which, fairness) => self.with_selected(which, |session| {
                session.set_neatening(Neatening { fairness, ..session.neatening().clone() });
            }),
            Deed::Delete(which) => self.with_selected(which, Session::delete_selected),
            Deed::Duplicate(which) => {
                self.with_selected(which, |session| session.duplicate_selected(Vec2::new(9.0, 9.0)));
            }
            Deed::OpenDrawing(shape) => self.session.open(stored(shape)),
            Deed::EndGesture => self.session.end_gesture(),
            Deed::Undo => self.session.undo(),
            Deed::Redo => self.session.redo(),
            Deed::Work => {
                self.answer_late();
                work_once(&mut self.session);
            }
            Deed::Stall => {
                self.answer_late();
                self.late = self.session.next_job().map(|(ticket, job)| (ticket, run(&job)));
            }
        }
    }
}

/// A drawing as it comes from a file: in another unit, its curves counted from one and still to be fitted.
fn stored(shape: usize) -> Drawing {
    let mut drawing = Drawing::new(Unit::Mm, YAxis::Up);
    for points in [&shapes()[shape], &shapes()[(shape + 1) % 5]] {
        let id = drawing.new_id();
        let stroke = Stroke::new(format!("stored {}", id.0), points.clone());
        drawing.put(Curve::drawn(id, stroke, Neatening::default()).unwrap());
    }
    drawing
}

/// What must hold of any drawing.
fn check_sound(drawing: &Drawing) {
    let mut names: Vec<&str> = drawing.curves().iter().map(|curve| curve.name.as_str()).collect();
    let mut ids: Vec<CurveId> = drawing.curves().iter().map(|curve| curve.id).collect();
    names.sort_unstable();
    ids.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "{ids:?}");
    for curve in drawing.curves() {
        assert!(curve.spline.segments().iter().all(fairpath_curve::Segment::is_valid));
        assert!(curve.stroke.points.len() > 1 && curve.stroke.points.iter().all(|point| point.is_finite()));
        assert!(curve.unpinned.is_none() || !curve.pins.is_empty());
        assert!(curve.report.rms_deviation.is_finite());
    }
}

/// Undoes everything and does it again: each state is the same both times. Gives the states.
fn there_and_back(desktop: &mut Desktop) -> Vec<Drawing> {
    let mut states = vec![desktop.session.drawing().clone()];
    while desktop.session.history().undoable().is_some() {
        desktop.session.undo();
        desktop.settle();
        states.push(desktop.session.drawing().clone());
    }
    for before in states.iter().rev().skip(1) {
        assert!(desktop.session.history().redoable().is_some());
        desktop.session.redo();
        desktop.settle();
        assert!(desktop.session.drawing() == before, "a state is another when it is done again");
    }
    states
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn what_is_undone_and_done_again_is_as_it_was(deeds in prop::collection::vec(deed(), 1..40)) {
        let mut desktop = Desktop::default();
        for deed in &deeds {
            desktop.act(deed);
            check_sound(desktop.session.drawing());
        }
        desktop.settle();
        check_sound(desktop.session.drawing());
        prop_assert!(desktop.session.drawing().curves().iter().all(|curve| curve.fitted));
        let states = there_and_back(&mut desktop);
        prop_assert!(states.last().unwrap() == &Drawing::default());
        for state in &states {
            check_sound(state);
        }
    }

    /// Opening is a deed like others: what was there before comes back with all of its own past, whatever was done after.
    #[test]
    fn undo_leads_back_over_opening_a_drawing(
        before in prop::collection::vec(deed(), 0..12),
        shape in 0..5_usize,
        after in prop::collection::vec(deed(), 0..12),
    ) {
        let bytes = |desktop: &Desktop| encode_drawing(desktop.session.drawing()).unwrap();
        let mut desktop = Desktop::default();
        before.iter().for_each(|deed| desktop.act(deed));
        desktop.settle();
        let ids: Vec<CurveId> = desktop.session.drawing().curves().iter().map(|curve| curve.id).collect();
        let old = (bytes(&desktop), desktop.session.history().undoable().map(str::to_owned));
        desktop.act(&Deed::OpenDrawing(shape));
        prop_assert!(desktop.session.drawing().curves().iter().all(|curve| !ids.contains(&curve.id)));
        prop_assert_eq!((desktop.session.drawing().unit, desktop.session.drawing().y), (Unit::Mm, YAxis::Up));
        desktop.settle();
        let opened = bytes(&desktop);
        let mut deeds = 0;
        for deed in after.iter().filter(|deed| !matches!(deed, Deed::Undo | Deed::Redo)) {
            desktop.act(deed);
            deeds += 1;
        }
        desktop.settle();
        let end = bytes(&desktop);
        let (mut steps, mut came_by) = (0, false);
        while let Some(deed) = desktop.session.history().undoable().map(str::to_owned) {
            let is_it = deed == "Open" && bytes(&desktop) == opened;
            desktop.session.undo();
            desktop.settle();
            steps += 1;
            came_by |= is_it && (bytes(&desktop), desktop.session.history().undoable().map(str::to_owned)) == old;
        }
        prop_assert!(came_by, "{steps} steps, {deeds} deeds");
        prop_assert_eq!(bytes(&desktop), encode_drawing(&Drawing::default()).unwrap());
        for _ in 0..steps {
            desktop.session.redo();
            desktop.settle();
        }
        prop_assert_eq!(bytes(&desktop), end);
    }

    /// A worker that dies takes nothing with it but what it was to compute.
    #[test]
    fn without_a_worker_everything_can_be_undone(deeds in prop::collection::vec(deed(), 1..30)) {
        let mut desktop = Desktop::default();
        for deed in deeds.iter().filter(|deed| !matches!(deed, Deed::Work | Deed::Stall)) {
            desktop.act(deed);
            // It takes a job, and that is the last that is heard of it.
            let _ = desktop.session.next_job();
        }
        let mut session = desktop.session;
        let last = session.drawing().clone();
        // Strokes over curves that were not drawn into them are taken back first.
        let mut steps = 0;
        while session.history().undoable().is_some() {
            let version = session.history().version();
            session.undo();
            steps += usize::from(session.history().version() != version);
        }
        prop_assert!(session.drawing() == &Drawing::default());
        for _ in 0..steps {
            session.redo();
        }
        prop_assert!(session.drawing() == &last);
    }

    #[test]
    fn a_dropped_stroke_leaves_no_trace(shape in 0..5_usize, watched in prop::collection::vec(any::<bool>(), 1..6)) {
        let (mut session, _) = session_of(&[wave(), ring()]);
        let (before, version) = (session.drawing().clone(), session.history().version());
        let undoable = session.history().undoable().map(str::to_owned);
        let points = &shapes()[shape];
        session.begin_stroke(1.0, shape == 0);
        for (chunk, &works) in points.chunks(points.len() / watched.len() + 1).zip(&watched) {
            for &point in chunk {
                session.extend_stroke(point, None, None);
            }
            session.watch_stroke(false);
            if works {
                work_once(&mut session);
            }
        }
        let late = session.next_job();
        prop_assert!(session.drop_stroke());
        prop_assert!(session.hand().is_none());
        if let Some((ticket, job)) = late {
            session.take_answer(ticket, run(&job));
        }
        prop_assert!(session.is_settled());
        prop_assert!(session.take_trouble().is_none());
        prop_assert!(session.drawing() == &before);
        prop_assert_eq!(session.history().version(), version);
        prop_assert_eq!(session.history().undoable().map(str::to_owned), undoable);
        prop_assert!(!session.drop_stroke());
    }
}

#[test]
fn a_drawn_stroke_becomes_to_the_bit_what_the_fitter_gives() {
    for points in shapes() {
        let (session, ids) = session_of(std::slice::from_ref(&points));
        let expected = fit(&Stroke::new("x", points), &FitOptions::default()).unwrap();
        let curve = session.drawing().curve(ids[0]).unwrap();
        assert_eq!(bits(&curve.spline), bits(&expected.spline));
        assert_eq!((&curve.report, &curve.warnings), (&expected.report, &expected.warnings));
    }
}

#[test]
fn an_answer_also_reaches_the_states_before_so_that_undo_need_not_fit_again() {
    let mut session = Session::default();
    draw(&mut session, &wave());
    draw(&mut session, &corner());
    settle(&mut session);
    session.undo();
    assert!(session.next_job().is_none());
    assert!(session.drawing().curves()[0].fitted);
}

#[test]
fn a_deed_does_not_fit_again_what_is_being_fitted() {
    let mut session = Session::default();
    draw(&mut session, &wave());
    let (first, job) = session.next_job().unwrap();
    draw(&mut session, &corner());
    session.take_answer(first, run(&job));
    let mut jobs = 1;
    while work_once(&mut session) {
        jobs += 1;
    }
    assert_eq!(jobs, 2);
}

#[test]
fn two_strokes_over_a_curve_are_both_drawn_into_it_though_the_second_comes_before_the_first_is_done() {
    let (mut session, ids) = session_of(&[wave()]);
    let old = spline(&session, ids[0]).clone();
    let strokes = [beside(&old, 40.0, 120.0, 10.0), beside(&old, 220.0, 320.0, -10.0)];
    for stroke in &strokes {
        draw(&mut session, stroke);
    }
    assert_eq!(session.drawing().curves().len(), 1);
    settle(&mut session);
    for stroke in &strokes {
        let middle = stroke[stroke.len() / 2];
        assert!(old.nearest(middle).distance > 8.0);
        assert!(spline(&session, ids[0]).nearest(middle).distance < 2.5);
    }
    session.undo();
    session.undo();
    assert_eq!(spline(&session, ids[0]), &old);
}

#[test]
fn a_stroke_over_a_curve_that_is_still_to_be_fitted_waits_for_it() {
    let mut session = Session::default();
    draw(&mut session, &wave());
    let raw = session.drawing().curves()[0].spline.clone();
    draw(&mut session, &beside(&raw, 100.0, 180.0, 12.0));
    assert_eq!(session.drawing().curves().len(), 1);
    settle(&mut session);
    assert_eq!(session.history().undoable(), Some("Oversketch"));
    assert!(session.drawing().curves()[0].spline.segments().len() < 12);
}

#[test]
fn a_stroke_over_a_curve_that_moves_meanwhile_is_drawn_into_it_where_it_is() {
    let (mut session, ids) = session_of(&[wave()]);
    let curve = spline(&session, ids[0]).clone();
    let stroke = beside(&curve, 60.0, 160.0, 14.0);
    draw(&mut session, &stroke);
    let (ticket, job) = session.next_job().unwrap();
    session.select(Some(ids[0]), false);
    session.move_selected(Vec2::new(0.0, 3.0));
    session.take_answer(ticket, run(&job));
    settle(&mut session);
    let now = spline(&session, ids[0]);
    assert!((now.end_pose().point - curve.end_pose().point - Vec2::new(0.0, 3.0)).hypot() < 1e-9);
    assert!(now.nearest(stroke[stroke.len() / 2]).distance < 3.0);
}

#[test]
fn undo_takes_a_waiting_stroke_back_before_anything_else() {
    let (mut session, ids) = session_of(&[wave()]);
    let before = session.drawing().clone();
    let stroke = beside(spline(&session, ids[0]), 60.0, 160.0, 14.0);
    draw(&mut session, &stroke);
    assert!(!session.is_settled());
    session.undo();
    assert!(session.is_settled());
    assert!(session.drawing() == &before);
}

#[test]
fn an_answer_for_a_curve_of_before_does_not_land_in_a_drawing_that_was_opened() {
    let mut session = Session::default();
    draw(&mut session, &wave());
    let old = session.drawing().curves()[0].id;
    session.select(Some(old), false);
    let (ticket, job) = session.next_job().unwrap();
    session.open(stored(3));
    assert!(session.selection().is_empty());
    let opened = session.drawing().clone();
    session.take_answer(ticket, run(&job));
    assert!(session.drawing() == &opened);
    settle(&mut session);
    session.undo();
    assert_eq!(session.drawing().curves()[0].id, old);
    settle(&mut session);
    assert!(session.drawing().curves()[0].fitted);
    let expected = fit(&Stroke::new("x", wave()), &FitOptions::default()).unwrap();
    assert_eq!(bits(&session.drawing().curves()[0].spline), bits(&expected.spline));
}

#[test]
fn beginning_anew_leaves_no_past() {
    let (mut session, _) = session_of(&[wave()]);
    session.begin_anew(stored(1));
    assert_eq!((session.history().undoable(), session.history().redoable()), (None, None));
    settle(&mut session);
    assert!(session.drawing().curves().iter().all(|curve| curve.fitted));
}

#[test]
fn identities_are_never_given_twice() {
    let (mut session, ids) = session_of(&[wave()]);
    session.undo();
    draw(&mut session, &corner());
    assert_ne!(session.drawing().curves()[0].id, ids[0]);
}

#[test]
fn a_deed_that_changed_nothing_does_not_swallow_the_next() {
    let (mut session, ids) = session_of(&[wave()]);
    session.select(Some(ids[0]), false);
    let neatening = session.neatening().clone();
    session.set_neatening(neatening.clone());
    session.set_neatening(Neatening { fairness: 0.8, ..neatening });
    settle(&mut session);
    assert_eq!(session.history().undoable(), Some("Neaten"));
}

#[test]
fn an_option_out_of_its_range_is_refused_and_changes_nothing() {
    let (mut session, ids) = session_of(&[wave()]);
    session.select(Some(ids[0]), false);
    let (drawing, neatening) = (session.drawing().clone(), session.neatening().clone());
    for (name, value) in [("error_cost", -1.0), ("points_per_circle", 0.0), ("no_such", 1.0)] {
        let set = [(name.to_owned(), serde_json::json!(value))].into();
        session.set_neatening(Neatening { set, ..neatening.clone() });
        assert_eq!(session.take_trouble().expect(name).code, "bad-option");
        assert_eq!(session.neatening(), &neatening);
        assert!(session.drawing() == &drawing);
    }
    session.set_neatening(Neatening { fairness: f64::NAN, ..neatening });
    assert_eq!(session.take_trouble().unwrap().code, "bad-option");
}

#[test]
fn a_job_that_fails_leaves_the_curve_as_it_was_and_is_told() {
    let mut session = Session::default();
    draw(&mut session, &wave());
    let raw = session.drawing().curves()[0].spline.clone();
    let (ticket, _) = session.next_job().unwrap();
    let trouble = Trouble { code: "broken".into(), text: "the worker broke down".into() };
    session.take_answer(ticket, Answer::Failed(trouble.clone()));
    assert!(session.is_settled());
    assert_eq!(session.take_trouble(), Some(trouble));
    assert_eq!(session.drawing().curves()[0].spline, raw);
}

#[test]
fn pulling_at_a_place_does_not_fit_the_stroke_again() {
    let (mut session, ids) = session_of(&[wave()]);
    let free = spline(&session, ids[0]).clone();
    let mut index = None;
    for step in 1..=5 {
        let point = free.point_at(0.5 * free.length()) + Vec2::new(0.0, 2.0 * f64::from(step));
        index = session.pin(ids[0], index, Pin { share: 0.5, point });
        let (ticket, job) = session.next_job().unwrap();
        assert!(matches!(job, fairpath_sketch::Job::Hold { .. }), "{job:?}");
        session.take_answer(ticket, run(&job));
        assert!(spline(&session, ids[0]).nearest(point).distance < 1e-6);
        let curve = session.drawing().curve(ids[0]).unwrap();
        assert_eq!((curve.pins.len(), curve.unpinned.as_deref()), (1, Some(&free)));
    }
    session.end_gesture();
    session.undo();
    assert_eq!(spline(&session, ids[0]), &free);
}

#[test]
fn pulling_gives_the_same_whether_the_fit_was_done_before_or_comes_with_it() {
    let (mut before, ids) = session_of(&[wave()]);
    let curve = spline(&before, ids[0]);
    let pin = Pin { share: 0.3, point: curve.point_at(0.3 * curve.length()) + Vec2::new(3.0, 8.0) };
    before.pin(ids[0], None, pin);
    settle(&mut before);
    let mut with = Session::default();
    draw(&mut with, &wave());
    let (ticket, job) = with.next_job().unwrap();
    with.pin(ids[0], None, pin);
    with.take_answer(ticket, run(&job));
    settle(&mut with);
    assert_eq!(bits(spline(&with, ids[0])), bits(spline(&before, ids[0])));
    // Neatened anew and back, it is held as before.
    let (session, id) = (&mut before, ids[0]);
    let shape = bits(spline(session, id));
    session.select(Some(id), false);
    let neatening = session.neatening().clone();
    session.set_neatening(Neatening { method: Method::CurvatureSpace, ..neatening.clone() });
    settle(session);
    assert!(spline(session, id).nearest(pin.point).distance < 1e-6);
    session.set_neatening(neatening);
    settle(session);
    assert_eq!(bits(spline(session, id)), shape);
}

#[test]
fn a_surface_is_shown_as_long_as_its_curve_is_as_it_was() {
    let (mut session, ids) = session_of(&[ring()]);
    session.select(Some(ids[0]), false);
    session.inflate(InflateOptions { triangles: 200, ..InflateOptions::default() });
    settle(&mut session);
    assert_eq!(session.surface().map(|(id, _)| id), Some(ids[0]));
    session.move_selected(Vec2::new(1.0, 0.0));
    assert!(session.surface().is_none());
}

#[test]
fn copies_have_names_of_their_own() {
    let (mut session, _) = session_of(&[wave(), corner()]);
    session.select_all();
    session.duplicate_selected(Vec2::new(5.0, 5.0));
    session.duplicate_selected(Vec2::new(5.0, 5.0));
    assert_eq!(session.drawing().curves().len(), 6);
    check_sound(session.drawing());
}
