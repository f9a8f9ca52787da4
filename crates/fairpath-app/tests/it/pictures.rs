//! How it looks: pictures drawn by the graphics device, held against those that were looked at (`tests/snapshots`). After a change that is meant:
//! `UPDATE_SNAPSHOTS=true cargo test -p fairpath-app --test it pictures`, and look at them.
//!
//! Drivers draw edges a little differently, so a pixel may differ slightly, but hardly any may differ more.

use crate::hands::{arch, drag, draw, press};
use eframe::egui::{Event, Key, Modifiers, Pos2, Theme, pos2, vec2};
use egui_kittest::{Harness, SnapshotOptions};
use fairpath_app::{App, InlineWorker, NoStore};
use fairpath_io::{ReadOptions, read_strokes};
use fairpath_sketch::{Curve, CurveId, Drawing, Method, Neatening};
use std::path::Path;

/// How much a pixel may differ, as egui_kittest measures it, and how many may differ more.
const DIFFERENCE: f32 = 0.6;
const PIXELS: usize = 12;

fn window<'a>(theme: Theme, size: [f32; 2]) -> Harness<'a, App> {
    let builder = Harness::builder().with_size(size).with_theme(theme).with_max_steps(20);
    let mut app = builder
        .wgpu()
        .build_eframe(|creation| App::new(&creation.egui_ctx, Box::<InlineWorker>::default(), Box::new(NoStore)));
    app.run_steps(4);
    app
}

fn compare(app: &mut Harness<'_, App>, name: &str) {
    // What hovers and what blinks is gone after a while.
    app.event(Event::PointerGone);
    app.run_steps(6);
    let options = SnapshotOptions::new()
        .threshold(DIFFERENCE)
        .max_failed_pixels(PIXELS)
        .output_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots"));
    app.snapshot_options(name, &options);
}

fn select(app: &mut Harness<'_, App>, index: usize) {
    let id = app.state().session().drawing().curves()[index].id;
    app.state_mut().session_mut().select(Some(id), false);
    app.run_steps(2);
}

fn keys(app: &mut Harness<'_, App>, keys: &[Key]) {
    for &key in keys {
        app.key_press(key);
        app.run_steps(2);
    }
}

/// Opens those strokes of an example that have one of these names.
fn open(app: &mut Harness<'_, App>, file: &str, names: &[&str], neatening: &Neatening) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(file);
    let strokes = read_strokes(&path, &ReadOptions::default()).unwrap().strokes;
    let mut drawing = Drawing::default();
    for stroke in strokes.into_iter().filter(|stroke| names.contains(&stroke.name.as_str())) {
        let id = CurveId(drawing.curves().len() as u64 + 1);
        drawing.put(Curve::drawn(id, stroke, neatening.clone()).unwrap());
    }
    assert_eq!(drawing.curves().len(), names.len());
    app.state_mut().open_drawing(drawing);
    app.run_steps(6);
}

#[test]
fn first_start() {
    compare(&mut window(Theme::Light, [800.0, 560.0]), "first-start");
}

#[test]
fn combs_plot_and_figures() {
    let mut app = window(Theme::Light, [1000.0, 640.0]);
    select(&mut app, 1);
    keys(&mut app, &[Key::Num3, Key::Num4]);
    app.key_press_modifiers(Modifiers::COMMAND, Key::Num0);
    compare(&mut app, "combs");
}

#[test]
fn dark_with_plain_ink() {
    let mut app = window(Theme::Dark, [800.0, 560.0]);
    select(&mut app, 2);
    keys(&mut app, &[Key::Num1]);
    compare(&mut app, "dark");
}

#[test]
fn preview_of_a_correction() {
    let mut app = window(Theme::Light, [800.0, 560.0]);
    app.state_mut().open_drawing(Drawing::default());
    app.run_steps(2);
    draw(&mut app, &arch(400.0, 420.0, 220.0));
    let bump = |i: usize| {
        let a = std::f32::consts::PI * (1.35 + 0.3 * i as f32 / 40.0);
        let radius = 220.0 + 60.0 * (std::f32::consts::PI * i as f32 / 40.0).sin().powi(2);
        pos2(400.0 + radius * a.cos(), 420.0 + radius * a.sin())
    };
    let bump: Vec<Pos2> = (0..=40).map(bump).collect();
    press(&mut app, bump[0]);
    bump[1..].iter().for_each(|&point| app.event(Event::PointerMoved(point)));
    app.run_steps(3);
    let options = SnapshotOptions::new()
        .threshold(DIFFERENCE)
        .max_failed_pixels(PIXELS)
        .output_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots"));
    // The pen is still down.
    app.snapshot_options("oversketch", &options);
}

#[test]
fn french_curves_laid_over() {
    let mut app = window(Theme::Light, [800.0, 560.0]);
    let neatening = Neatening { method: Method::FrenchCurve, ..Neatening::default() };
    open(&mut app, "hello.json", &["letter S", "bend"], &neatening);
    select(&mut app, 0);
    compare(&mut app, "french-curves");
}

#[test]
fn inflated_surface() {
    let mut app = window(Theme::Light, [800.0, 560.0]);
    open(&mut app, "duck.json", &["duck"], &Neatening::default());
    select(&mut app, 0);
    keys(&mut app, &[Key::I]);
    compare(&mut app, "surface");
}

#[test]
fn a_surface_is_dragged_aside() {
    use egui_kittest::kittest::Queryable;
    let mut app = window(Theme::Light, [800.0, 560.0]);
    open(&mut app, "duck.json", &["duck"], &Neatening::default());
    select(&mut app, 0);
    keys(&mut app, &[Key::I]);
    app.run_steps(3);
    let title = |app: &Harness<'_, App>| app.get_by_label("Surface").rect().center();
    let (begin, by) = (title(&app), vec2(180.0, -120.0));
    drag(&mut app, begin, begin + by);
    let end = title(&app);
    assert!((end - begin - by).length() < 1.0, "from {begin} to {end}");
    // No further than the canvas.
    drag(&mut app, end, pos2(-300.0, 900.0));
    let held = title(&app);
    assert!(held.x > 0.0 && held.y < 560.0, "{held}");
}

#[test]
fn options_of_the_method() {
    use egui_kittest::kittest::Queryable;
    let mut app = window(Theme::Light, [800.0, 560.0]);
    app.get_by_label("All options").click();
    compare(&mut app, "options");
}

#[test]
fn shortcuts() {
    use egui_kittest::kittest::Queryable;
    let mut app = window(Theme::Dark, [1000.0, 640.0]);
    app.get_by_label("Shortcuts").click();
    compare(&mut app, "shortcuts");
}

#[test]
fn a_dense_screen() {
    let builder = Harness::builder().with_size([540.0, 380.0]).with_pixels_per_point(2.0).with_max_steps(20);
    let mut app = builder
        .wgpu()
        .build_eframe(|creation| App::new(&creation.egui_ctx, Box::<InlineWorker>::default(), Box::new(NoStore)));
    app.run_steps(4);
    compare(&mut app, "dense");
}

#[test]
fn the_smallest_window() {
    let mut app = window(Theme::Light, [480.0, 360.0]);
    select(&mut app, 0);
    compare(&mut app, "smallest");
}
