//! Drawing, drawing over, dropping, undoing.

use crate::hands::{app, arch, draw, empty_app, press, release, session};
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use fairpath_app::{App, InlineWorker, NoStore, Worker};
use fairpath_curve::Kind;
use fairpath_sketch::{Answer, Drawing, Job, Ticket};
use std::time::Duration;

#[test]
fn a_first_start_shows_fitted_curves_and_a_hint() {
    let harness = app();
    let drawing = session(&harness).drawing();
    assert!(drawing.curves().len() > 2);
    assert!(drawing.curves().iter().all(|curve| curve.fitted));
    harness.get_by_label_contains("Draw anywhere");
}

#[test]
fn a_drawn_arch_becomes_an_arc_where_it_was_drawn() {
    let mut harness = empty_app();
    draw(&mut harness, &arch(500.0, 400.0, 120.0));
    let curves = session(&harness).drawing().curves().to_vec();
    assert_eq!(curves.len(), 1);
    let segments = curves[0].spline.segments();
    assert_eq!(segments.iter().map(|s| s.kind()).collect::<Vec<_>>(), [Kind::Arc]);
    assert!((segments[0].length - 120.0 * std::f64::consts::PI).abs() < 2.0);
    assert_eq!(curves[0].stroke.points.len(), 61);
    assert!((curves[0].stroke.points[0].x - 380.0).abs() < 1e-3);
}

#[test]
fn escape_drops_the_stroke_in_hand_and_no_more() {
    let mut harness = empty_app();
    draw(&mut harness, &arch(300.0, 300.0, 80.0));
    let before = session(&harness).drawing().clone();
    press(&mut harness, pos2(600.0, 300.0));
    for x in 0..20 {
        harness.event(Event::PointerMoved(pos2(600.0 + 5.0 * x as f32, 300.0)));
    }
    harness.step();
    assert!(session(&harness).hand().is_some());
    harness.key_press(Key::Escape);
    harness.step();
    assert!(session(&harness).hand().is_none());
    release(&mut harness, pos2(700.0, 300.0));
    assert!(*session(&harness).drawing() == before);
}

#[test]
fn undo_and_redo_by_keys_and_by_buttons() {
    let mut harness = empty_app();
    draw(&mut harness, &arch(300.0, 300.0, 80.0));
    draw(&mut harness, &arch(600.0, 300.0, 80.0));
    let both = session(&harness).drawing().clone();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.step();
    assert_eq!(session(&harness).drawing().curves().len(), 1);
    harness.get_by_label("Undo draw").click();
    harness.run_steps(2);
    assert_eq!(session(&harness).drawing().curves().len(), 0);
    for modifiers in [Modifiers::COMMAND | Modifiers::SHIFT, Modifiers::COMMAND] {
        let key = if modifiers.shift { Key::Z } else { Key::Y };
        harness.key_press_modifiers(modifiers, key);
        harness.step();
    }
    assert!(*session(&harness).drawing() == both);
}

#[test]
fn a_stroke_along_a_curve_changes_it_and_shows_before_what_it_replaces() {
    let mut harness = empty_app();
    let line: Vec<_> = (0..80).map(|i| pos2(200.0 + 7.0 * i as f32, 400.0)).collect();
    draw(&mut harness, &line);
    let bump: Vec<_> = (0..=50)
        .map(|i| {
            let t = i as f32 / 50.0;
            pos2(380.0 + 200.0 * t, 400.0 - 60.0 * (std::f32::consts::PI * t).sin().powi(2))
        })
        .collect();
    press(&mut harness, bump[0]);
    for &point in &bump[1..] {
        harness.event(Event::PointerMoved(point));
    }
    harness.run_steps(2);
    let over = session(&harness).hand().unwrap().over().expect("it lies over the line");
    let [from, to] = over.region.replaced;
    assert!((from - 180.0).abs() < 5.0 && (to - 380.0).abs() < 5.0, "{:?}", over.region);
    assert!(session(&harness).hand().unwrap().preview().is_some());
    release(&mut harness, bump[50]);
    let curves = session(&harness).drawing().curves();
    assert_eq!(curves.len(), 1);
    assert!(curves[0].spline.bounding_box().y0 < 350.0);
    assert_eq!(session(&harness).history().undoable(), Some("Oversketch"));
}

#[test]
fn alt_counts_as_it_was_when_the_pen_was_lifted() {
    let mut harness = empty_app();
    let line: Vec<_> = (0..80).map(|i| pos2(200.0 + 7.0 * i as f32, 400.0)).collect();
    draw(&mut harness, &line);
    draw(&mut harness, &line[20..60]);
    assert_eq!(session(&harness).drawing().curves().len(), 1, "without Alt it is a correction");
    press(&mut harness, line[20]);
    for &point in &line[21..60] {
        harness.event(Event::PointerMoved(point));
    }
    // A slow screen shows the next picture when Alt is up again.
    let (pos, button, modifiers) = (line[59], PointerButton::Primary, Modifiers::ALT);
    harness.event(Event::PointerButton { pos, button, pressed: false, modifiers });
    harness.run_steps(2);
    assert_eq!(session(&harness).drawing().curves().len(), 2);
}

#[test]
fn the_slider_makes_the_selected_curve_fairer_in_one_step_of_undo() {
    let mut harness = empty_app();
    draw(&mut harness, &wiggle());
    let id = session(&harness).drawing().curves()[0].id;
    harness.state_mut().session_mut().select(Some(id), false);
    harness.run_steps(2);
    let before = session(&harness).drawing().curves()[0].clone();
    let slider = harness.get_by_label("Fairness").rect();
    harness.drag_at(slider.center());
    harness.step();
    for share in [0.6, 0.8, 1.2] {
        harness.hover_at(pos2(slider.left() + share * slider.width(), slider.center().y));
        harness.run_steps(2);
    }
    harness.drop_at(pos2(slider.left() + 1.2 * slider.width(), slider.center().y));
    harness.run_steps(2);
    let after = session(&harness).drawing().curves()[0].clone();
    assert_eq!(after.neatening.fairness, 1.0);
    assert!(after.report.rms_deviation > before.report.rms_deviation);
    assert!(after.spline.segments().len() < before.spline.segments().len());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert!(*session(&harness).drawing().curves()[0] == *before, "one step leads back");
}

/// A wave with a tremor.
fn wiggle() -> Vec<Pos2> {
    let at = |i: usize| {
        let x = i as f32 * 3.0;
        pos2(200.0 + x, 350.0 + 40.0 * (x / 60.0).sin() + 2.0 * (x / 7.0).sin())
    };
    (0..200).map(at).collect()
}

#[test]
fn the_figures_of_the_selected_curve_are_those_of_its_report() {
    let mut harness = empty_app();
    draw(&mut harness, &wiggle());
    let curve = session(&harness).drawing().curves()[0].clone();
    harness.state_mut().session_mut().select(Some(curve.id), false);
    harness.run_steps(2);
    harness.get_by_label(&format!("{:.1} px", curve.spline.length()));
    harness.get_by_label(&format!("{:.2} px", curve.report.max_deviation));
}

/// Answers only whoever waits.
#[derive(Default)]
struct Patient(InlineWorker);

impl Worker for Patient {
    fn submit(&mut self, ticket: Ticket, job: Job) {
        self.0.submit(ticket, job);
    }

    fn answers(&mut self) -> Vec<(Ticket, Answer)> {
        Vec::new()
    }

    fn answers_within(&mut self, _moment: Duration) -> Vec<(Ticket, Answer)> {
        self.0.answers()
    }
}

#[test]
fn a_curve_is_waited_for_in_the_picture_in_which_its_stroke_ends() {
    let mut harness = Harness::builder().with_size([1000.0, 700.0]).build_eframe(|creation| {
        let mut app = App::new(&creation.egui_ctx, Box::<Patient>::default(), Box::new(NoStore));
        app.open_drawing(Drawing::default());
        app
    });
    let stroke = arch(500.0, 400.0, 120.0);
    press(&mut harness, stroke[0]);
    for &point in &stroke[1..] {
        harness.event(Event::PointerMoved(point));
    }
    harness.step();
    assert!(session(&harness).drawing().curves().is_empty());
    let (pos, button, modifiers) = (stroke[stroke.len() - 1], PointerButton::Primary, Modifiers::NONE);
    harness.event(Event::PointerButton { pos, button, pressed: false, modifiers });
    harness.step();
    let curves = session(&harness).drawing().curves();
    assert!(curves.len() == 1 && curves[0].fitted, "{} curves", curves.len());
    assert_eq!(harness.state().pace().curves.count, 1);
}
