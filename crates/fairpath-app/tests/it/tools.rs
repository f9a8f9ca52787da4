//! The tools besides drawing: pulling, cutting, corners, ends, closing, the picture behind.

use crate::hands::{arch, drag, draw, empty_app, press, release, session};
use eframe::egui::{Event, Key, Pos2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use fairpath_app::App;
use fairpath_curve::{Continuity, Point};
use fairpath_sketch::Background;
use std::sync::Arc;

fn line() -> Vec<Pos2> {
    (0..=80).map(|i| pos2(200.0 + 6.0 * i as f32, 350.0)).collect()
}

fn with_line<'a>() -> Harness<'a, App> {
    let mut app = empty_app();
    draw(&mut app, &line());
    app
}

fn spline<'a>(app: &'a Harness<'_, App>, i: usize) -> &'a fairpath_curve::Spline {
    &session(app).drawing().curves()[i].spline
}

#[test]
fn a_curve_is_pulled_through_a_point_and_let_go_by_a_click_on_the_pin() {
    let mut app = with_line();
    let straight = spline(&app, 0).clone();
    app.key_press(Key::B);
    app.run_steps(2);
    drag(&mut app, pos2(440.0, 350.0), pos2(440.0, 310.0));
    let pulled = spline(&app, 0).clone();
    assert!(pulled.nearest(Point::new(440.0, 310.0)).distance < 1e-6);
    assert_eq!(session(&app).drawing().curves()[0].pins.len(), 1);
    assert_eq!(session(&app).history().undoable(), Some("Pull"));
    press(&mut app, pos2(440.0, 310.0));
    release(&mut app, pos2(440.0, 310.0));
    assert_eq!(session(&app).drawing().curves()[0].pins.len(), 0);
    assert_eq!(*spline(&app, 0), straight);
    app.key_press_modifiers(eframe::egui::Modifiers::COMMAND, Key::Z);
    app.run_steps(2);
    assert_eq!(*spline(&app, 0), pulled, "undo holds it again");
}

#[test]
fn a_curve_is_cut_where_it_is_clicked() {
    let mut app = with_line();
    app.key_press(Key::C);
    app.run_steps(2);
    press(&mut app, pos2(400.0, 351.0));
    release(&mut app, pos2(400.0, 351.0));
    let ends: Vec<f64> = (0..2).map(|i| spline(&app, i).length()).collect();
    assert!((ends[0] - 200.0).abs() < 2.0 && (ends[1] - 280.0).abs() < 2.0, "{ends:?}");
}

#[test]
fn a_corner_is_made_and_smoothed_by_clicks() {
    let mut app = empty_app();
    draw(&mut app, &arch(500.0, 400.0, 150.0));
    app.key_press(Key::K);
    app.run_steps(2);
    let corners =
        |app: &Harness<'_, App>| spline(app, 0).joins().iter().filter(|join| **join == Continuity::G0).count();
    assert_eq!(corners(&app), 0);
    for expected in [1, 0] {
        press(&mut app, pos2(500.0, 250.0));
        release(&mut app, pos2(500.0, 250.0));
        assert_eq!(corners(&app), expected);
    }
}

#[test]
fn an_end_is_dragged_longer_and_shorter() {
    let mut app = with_line();
    app.key_press(Key::V);
    app.run_steps(2);
    press(&mut app, pos2(400.0, 350.0));
    release(&mut app, pos2(400.0, 350.0));
    assert!(session(&app).selected().is_some());
    let before = spline(&app, 0).length();
    let end = |app: &Harness<'_, App>| {
        let point = spline(app, 0).end_pose().point;
        pos2(point.x as f32, point.y as f32)
    };
    let from = end(&app);
    drag(&mut app, from, pos2(760.0, 350.0));
    assert!((spline(&app, 0).length() - before - 80.0).abs() < 2.0);
    let from = end(&app);
    drag(&mut app, from, pos2(500.0, 352.0));
    assert!((spline(&app, 0).length() - 300.0).abs() < 2.0);
}

#[test]
fn a_curve_is_closed_inflated_and_opened_by_keys() {
    let mut app = empty_app();
    let almost: Vec<Pos2> = (0..=90)
        .map(|i| std::f32::consts::TAU * 0.8 * i as f32 / 90.0)
        .map(|a| pos2(500.0 + 120.0 * a.cos(), 350.0 + 120.0 * a.sin()))
        .collect();
    draw(&mut app, &almost);
    let id = session(&app).drawing().curves()[0].id;
    app.state_mut().session_mut().select(Some(id), false);
    app.run_steps(2);
    app.key_press(Key::I);
    app.run_steps(2);
    app.get_by_label_contains("Only a closed curve can be inflated");
    app.key_press(Key::O);
    app.run_steps(2);
    assert!(spline(&app, 0).is_closed());
    app.state_mut().session_mut().inflate(Default::default());
    app.run_steps(1);
    app.key_press(Key::O);
    app.run_steps(2);
    assert!(!spline(&app, 0).is_closed());
}

#[test]
fn escape_while_pulling_keeps_the_curve_and_ends_the_gesture() {
    let mut app = with_line();
    app.key_press(Key::B);
    app.run_steps(2);
    press(&mut app, pos2(440.0, 350.0));
    app.event(Event::PointerMoved(pos2(440.0, 320.0)));
    app.run_steps(2);
    app.key_press(Key::Escape);
    app.run_steps(2);
    let held = session(&app).drawing().clone();
    app.event(Event::PointerMoved(pos2(440.0, 250.0)));
    app.run_steps(2);
    assert!(*session(&app).drawing() == held, "the hand holds nothing any more");
    release(&mut app, pos2(440.0, 250.0));
}

#[test]
fn the_picture_behind_is_moved_by_hand_and_taken_away() {
    let mut app = empty_app();
    let image = include_bytes!("../../../../docs/app-dark.png").to_vec();
    let at = Point::new(200.0, 150.0);
    let picture = Background { name: "map.png".into(), image, at, width: 500.0, opacity: 0.5 };
    app.state_mut().session_mut().set_background(Some(Arc::new(picture)));
    app.run_steps(2);
    app.key_press(Key::M);
    app.run_steps(2);
    drag(&mut app, pos2(400.0, 300.0), pos2(430.0, 310.0));
    let moved = session(&app).drawing().background.clone().unwrap();
    assert!((moved.at - Point::new(230.0, 160.0)).hypot() < 1e-3, "{:?}", moved.at);
    assert_eq!(session(&app).history().undoable(), Some("Move picture"));
    let slider = app.get_by_label("Strength of the picture").rect();
    drag(&mut app, slider.center(), pos2(slider.right() - 2.0, slider.center().y));
    assert!(session(&app).drawing().background.as_ref().unwrap().opacity > 0.9);
    let slider = app.get_by_label("Size of the picture").rect();
    drag(&mut app, slider.center(), pos2(slider.left() + 0.4 * slider.width(), slider.center().y));
    let scaled = session(&app).drawing().background.clone().unwrap();
    assert!(scaled.width != 500.0);
    app.get_by_label("Take the picture away").click();
    app.run_steps(2);
    assert!(session(&app).drawing().background.is_none());
    app.key_press_modifiers(eframe::egui::Modifiers::COMMAND, Key::Z);
    app.run_steps(2);
    assert_eq!(session(&app).drawing().background, Some(scaled));
}
