//! The pictures of the documents: the application in the states that they tell of, drawn by the graphics device without a window.
//!
//!     cargo run --release -p fairpath-app --example pictures -- FOLDER

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Theme, Vec2, pos2};
use egui_kittest::Harness;
use fairpath_app::{App, InlineWorker, NoStore};
use fairpath_fit::Stroke;
use fairpath_io::{ReadOptions, read_strokes};
use fairpath_sketch::{Curve, CurveId, Drawing, Method, Neatening};
use std::error::Error;
use std::path::{Path, PathBuf};

/// The window, points.
const WINDOW: Vec2 = Vec2::new(1180.0, 740.0);

/// Pixels to a point.
const DENSITY: f32 = 1.0;

type Window = Harness<'static, App>;

/// A picture by its name: the theme, and what is done before it is taken.
type Scene = (&'static str, Theme, fn(&mut Window));

const SCENES: [Scene; 6] = [
    ("app-first-start", Theme::Light, |_| {}),
    ("app-combs", Theme::Light, |app| {
        select(app, 0);
        press_keys(app, &[Key::Num3, Key::Num4]);
        show_all(app);
    }),
    ("app-oversketch", Theme::Light, |app| {
        select_none(app);
        draw_over(app);
    }),
    ("app-french-curves", Theme::Light, |app| {
        let neatening = Neatening { method: Method::FrenchCurve, ..Neatening::default() };
        open(app, "hello.json", &neatening, |name| name == "letter S" || name == "bend");
        select(app, 0);
        show_all(app);
    }),
    ("app-surface", Theme::Light, |app| {
        open(app, "duck.json", &Neatening::default(), |_| true);
        select(app, 0);
        press_keys(app, &[Key::I]);
        app.run_steps(4);
        show_all(app);
    }),
    ("app-dark", Theme::Dark, |app| {
        select(app, 3);
        press_keys(app, &[Key::Num3]);
        show_all(app);
    }),
];

/// Brings all of the drawing into the part of the canvas over which nothing lies.
fn show_all(app: &mut Window) {
    app.key_press_modifiers(Modifiers::COMMAND, Key::Num0);
    app.run_steps(2);
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("name the folder for the pictures")?);
    for (name, theme, scene) in SCENES {
        let builder = Harness::builder().with_size(WINDOW).with_theme(theme).with_pixels_per_point(DENSITY);
        let mut app = builder
            .wgpu()
            .build_eframe(|creation| App::new(&creation.egui_ctx, Box::<InlineWorker>::default(), Box::new(NoStore)));
        app.run_steps(4);
        scene(&mut app);
        app.run_steps(4);
        let path = folder.join(format!("{name}.png"));
        app.render()?.save(&path)?;
        println!("{}", path.display());
    }
    Ok(())
}

fn select(app: &mut Window, index: usize) {
    let id = app.state().session().drawing().curves()[index].id;
    app.state_mut().session_mut().select(Some(id), false);
    app.run_steps(2);
}

fn select_none(app: &mut Window) {
    app.state_mut().session_mut().select(None, false);
    app.run_steps(2);
}

fn press_keys(app: &mut Window, keys: &[Key]) {
    for &key in keys {
        app.key_press(key);
        app.run_steps(2);
    }
}

/// Opens the strokes of an example whose names are wanted.
fn open(app: &mut Window, file: &str, neatening: &Neatening, wanted: fn(&str) -> bool) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(file);
    let strokes = read_strokes(&path, &ReadOptions::default()).expect("the example can be read").strokes;
    let mut drawing = Drawing::default();
    for (i, stroke) in strokes.into_iter().filter(|stroke| wanted(&stroke.name)).enumerate() {
        let stroke = Stroke { times_s: Vec::new(), pressures: Vec::new(), ..stroke };
        drawing.put(Curve::drawn(CurveId(i as u64 + 1), stroke, neatening.clone()).expect("it is no dot"));
    }
    app.state_mut().open_drawing(drawing);
    app.run_steps(6);
}

/// Draws a bulge on a line of its own, and stops before the pen is lifted.
fn draw_over(app: &mut Window) {
    app.state_mut().open_drawing(Drawing::default());
    app.run_steps(2);
    let wave = |i: usize| pos2(180.0 + 8.0 * i as f32, 400.0 + 90.0 * (i as f32 / 16.0).sin());
    let stroke: Vec<Pos2> = (0..=100).map(wave).collect();
    hold(app, &stroke);
    button(app, stroke[100], false);
    app.run_steps(3);
    let bulge = |i: usize| {
        let [from, to] = [stroke[34], stroke[66]];
        let t = i as f32 / 40.0;
        from + t * (to - from) + Vec2::new(0.0, -70.0 * (std::f32::consts::PI * t).sin())
    };
    let bulge: Vec<Pos2> = (0..=40).map(bulge).collect();
    hold(app, &bulge);
}

/// Draws a stroke, the pen still down.
fn hold(app: &mut Window, points: &[Pos2]) {
    app.event(Event::PointerMoved(points[0]));
    app.step();
    button(app, points[0], true);
    for &point in &points[1..] {
        app.event(Event::PointerMoved(point));
    }
    app.run_steps(3);
}

fn button(app: &mut Window, pos: Pos2, pressed: bool) {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    app.event(Event::PointerButton { pos, button, pressed, modifiers });
    app.step();
}
