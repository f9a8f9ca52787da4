//! The window as a whole: names and keys of everything, small windows, fingers.

use crate::hands::{app_at_rate, app_sized, arch, draw, empty_app, press, release, session};
use eframe::egui::{Event, Key, Modifiers, Pos2, Rect, TouchDeviceId, TouchId, TouchPhase, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use fairpath_app::App;
use fairpath_sketch::Drawing;

/// Names of what is always there.
const ALWAYS: [&str; 12] = [
    "Menu",
    "Undo",
    "Redo",
    "Draw",
    "Select and move",
    "Pull through a point",
    "Cut",
    "Corner or smooth",
    "Method",
    "Fairness",
    "All options",
    "Shortcuts",
];

fn place(app: &Harness<'_, App>, name: &str) -> Rect {
    app.get_by_label(name).rect()
}

#[test]
fn everything_has_a_name_a_place_of_its_own_and_lies_in_the_window_however_small_that_is() {
    for size in [[480.0, 360.0], [700.0, 500.0], [1000.0, 700.0], [1920.0, 1080.0]] {
        let app = app_sized(size);
        let window = Rect::from_min_size(Pos2::ZERO, size.into());
        let places = ALWAYS.map(|name| (name, place(&app, name)));
        for (i, (name, rect)) in places.iter().enumerate() {
            assert!(window.contains_rect(*rect), "{name} at {rect:?} in {size:?}");
            for (other, with) in &places[..i] {
                assert!(!rect.shrink(1.0).intersects(with.shrink(1.0)), "{name} lies over {other} in {size:?}");
            }
        }
    }
}

#[test]
fn what_is_said_lies_over_no_button() {
    for width in [480.0, 700.0, 1000.0, 1280.0] {
        let mut app = app_sized([width, 600.0]);
        app.key_press(Key::J);
        app.run_steps(3);
        let notice = app.get_by_label_contains("Select two open curves").rect();
        for name in ALWAYS {
            assert!(!notice.intersects(place(&app, name)), "the notice lies over {name} at a width of {width}");
        }
    }
}

#[test]
fn the_tabulator_reaches_the_menu_and_the_arrows_its_entries() {
    let mut app = empty_app();
    let mut reached = false;
    for _ in 0..40 {
        app.key_press(Key::Tab);
        app.run_steps(2);
        if app.get_by_label("Menu").is_focused() {
            reached = true;
            break;
        }
    }
    assert!(reached, "the menu has the focus at some time");
    app.key_press(Key::Enter);
    app.run_steps(3);
    for entry in ["New", "Open…", "Save as…", "Import…", "Import French curves…", "Export", "Unit", "Copy as SVG"]
    {
        app.get_by_label_contains(entry);
    }
}

#[test]
fn the_list_of_shortcuts_opens_and_closes_by_its_key() {
    let mut app = empty_app();
    assert!(app.query_by_label("Redo the last").is_none());
    app.event(Event::Text("?".into()));
    app.key_press_modifiers(Modifiers::SHIFT, Key::Questionmark);
    app.run_steps(4);
    app.get_by_label("Space-drag, middle-drag");
    app.key_press_modifiers(Modifiers::SHIFT, Key::Questionmark);
    app.run_steps(4);
    assert!(app.query_by_label("Space-drag, middle-drag").is_none());
}

#[test]
fn brackets_go_from_curve_to_curve_and_arrows_move_it() {
    let mut app = empty_app();
    draw(&mut app, &arch(300.0, 300.0, 80.0));
    draw(&mut app, &arch(600.0, 300.0, 80.0));
    let ids: Vec<_> = session(&app).drawing().curves().iter().map(|curve| curve.id).collect();
    for id in [ids[0], ids[1], ids[0]] {
        app.key_press(Key::CloseBracket);
        app.run_steps(2);
        assert_eq!(session(&app).selected().map(|curve| curve.id), Some(id));
    }
    let before = session(&app).selected().unwrap().spline.start_pose().point;
    app.key_press(Key::ArrowRight);
    app.run_steps(2);
    app.key_press_modifiers(Modifiers::SHIFT, Key::ArrowUp);
    app.run_steps(2);
    let by = session(&app).selected().unwrap().spline.start_pose().point - before;
    assert!((by.x - 1.0).abs() < 1e-9 && (by.y + 10.0).abs() < 1e-9, "{by:?}");
}

/// A finger that comes, stays or goes.
fn touch(app: &mut Harness<'_, App>, finger: u64, phase: TouchPhase, pos: Pos2) {
    app.event(Event::Touch { device_id: TouchDeviceId(1), id: TouchId(finger), phase, pos, force: None });
}

/// A short tap of several fingers.
fn tap(app: &mut Harness<'_, App>, fingers: u64) {
    let at = |finger: u64| pos2(400.0 + 60.0 * finger as f32, 500.0);
    for finger in 0..fingers {
        touch(app, finger, TouchPhase::Start, at(finger));
    }
    for finger in 0..fingers {
        touch(app, finger, TouchPhase::End, at(finger));
    }
    app.run_steps(2);
}

#[test]
fn a_tap_of_two_fingers_undoes_and_of_three_redoes() {
    // Each event has a frame of its own, and a tap is short.
    let mut app = app_at_rate([1000.0, 700.0], 1.0 / 60.0);
    app.state_mut().open_drawing(Drawing::default());
    app.step();
    draw(&mut app, &arch(300.0, 300.0, 80.0));
    let drawn = session(&app).drawing().clone();
    tap(&mut app, 2);
    assert_eq!(session(&app).drawing().curves().len(), 0);
    tap(&mut app, 3);
    assert!(*session(&app).drawing() == drawn);
}

#[test]
fn once_the_screen_was_touched_buttons_are_as_large_as_fingers() {
    let mut app = empty_app();
    let before = place(&app, "Cut").size();
    tap(&mut app, 1);
    app.run_steps(3);
    let after = place(&app, "Cut").size();
    assert!(before.y < 36.0 && after.min_elem() >= 40.0, "{before:?} {after:?}");
}

#[test]
fn a_second_finger_drops_the_stroke_in_hand() {
    let mut app = empty_app();
    touch(&mut app, 1, TouchPhase::Start, pos2(300.0, 300.0));
    press(&mut app, pos2(300.0, 300.0));
    for x in 0..20 {
        app.event(Event::PointerMoved(pos2(300.0 + 5.0 * x as f32, 300.0)));
    }
    app.step();
    assert!(session(&app).hand().is_some());
    touch(&mut app, 2, TouchPhase::Start, pos2(500.0, 300.0));
    app.step();
    assert!(session(&app).hand().is_none());
    release(&mut app, pos2(400.0, 300.0));
    assert!(session(&app).drawing().curves().is_empty());
}
