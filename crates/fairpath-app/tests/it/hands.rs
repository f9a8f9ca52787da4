//! Hands: what a person does to the window, for a harness.

use eframe::egui::{Event, Modifiers, PointerButton, Pos2, pos2};
use egui_kittest::Harness;
use fairpath_app::{App, InlineWorker, NoStore, Store};
use fairpath_sketch::{Drawing, Session};

/// The application without a first drawing, with a worker that answers at once. A unit of the drawing is a point of the window.
pub(crate) fn empty_app<'a>() -> Harness<'a, App> {
    let mut harness = app();
    harness.state_mut().open_drawing(Drawing::default());
    harness.step();
    harness
}

/// The application as it starts.
pub(crate) fn app<'a>() -> Harness<'a, App> {
    app_with(Box::new(NoStore))
}

/// The application as it starts, with a store.
pub(crate) fn app_with<'a>(store: Box<dyn Store>) -> Harness<'a, App> {
    built([1000.0, 700.0], SLOW, store)
}

/// The application as it starts in a window of that size.
pub(crate) fn app_sized<'a>(size: [f32; 2]) -> Harness<'a, App> {
    app_at_rate(size, SLOW)
}

/// The application as it starts in a window of that size, with so many seconds from one frame to the next.
pub(crate) fn app_at_rate<'a>(size: [f32; 2], frame_s: f32) -> Harness<'a, App> {
    built(size, frame_s, Box::new(NoStore))
}

/// The harness's own rate: a quarter of a second for a frame.
const SLOW: f32 = 0.25;

fn built<'a>(size: [f32; 2], frame_s: f32, store: Box<dyn Store>) -> Harness<'a, App> {
    let builder = Harness::builder().with_size(size).with_step_dt(frame_s).with_max_steps(20);
    let mut harness =
        builder.build_eframe(|creation| App::new(&creation.egui_ctx, Box::<InlineWorker>::default(), store));
    harness.run_steps(3);
    harness
}

/// Draws a stroke through points of the window, a few to a frame.
pub(crate) fn draw(harness: &mut Harness<'_, App>, points: &[Pos2]) {
    press(harness, points[0]);
    for chunk in points[1..].chunks(4) {
        for &point in chunk {
            harness.event(Event::PointerMoved(point));
        }
        harness.step();
    }
    release(harness, points[points.len() - 1]);
}

pub(crate) fn press(harness: &mut Harness<'_, App>, pos: Pos2) {
    harness.event(Event::PointerMoved(pos));
    harness.step();
    button(harness, pos, true);
}

pub(crate) fn release(harness: &mut Harness<'_, App>, pos: Pos2) {
    button(harness, pos, false);
    harness.run_steps(2);
}

/// Drags from one place of the window to another, in a few moves.
pub(crate) fn drag(harness: &mut Harness<'_, App>, from: Pos2, to: Pos2) {
    press(harness, from);
    for i in 1..=4 {
        harness.event(Event::PointerMoved(from + (to - from) * (i as f32 / 4.0)));
        harness.step();
    }
    release(harness, to);
}

fn button(harness: &mut Harness<'_, App>, pos: Pos2, pressed: bool) {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    harness.event(Event::PointerButton { pos, button, pressed, modifiers });
    harness.step();
}

/// An arch of that radius from the left to the right around a place of the window.
pub(crate) fn arch(x: f32, y: f32, radius: f32) -> Vec<Pos2> {
    let at = |i: usize| std::f32::consts::PI * (1.0 + i as f32 / 60.0);
    (0..=60).map(|i| pos2(x + radius * at(i).cos(), y + radius * at(i).sin())).collect()
}

pub(crate) fn session<'a>(harness: &'a Harness<'_, App>) -> &'a Session {
    harness.state().session()
}
