//! Draws strokes of files as hands do, point by point, and prints how long the application took: from the last point of each stroke to its curve in the
//! picture, and the work for each picture while it was drawn. Everything is done that the window does but for the graphics device.
//!
//!     cargo run --release -p fairpath-app --example pace -- FILE…

use eframe::egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Vec2, pos2, vec2};
use fairpath_app::{App, NoStore, Times};
use fairpath_io::{ReadOptions, read_strokes};
use fairpath_sketch::Drawing;
use std::path::Path;

/// The least window, points; one for a large stroke is larger.
const WINDOW: Vec2 = vec2(1600.0, 1000.0);

/// Room around a stroke, where the panels are, points.
const MARGIN: f32 = 100.0;

/// Points of a stroke that come between two pictures: a pen of 240 Hz on a screen of 60 Hz.
const POINTS_A_FRAME: usize = 4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ctx = Context::default();
    let mut app = App::with_thread(&ctx, Box::new(NoStore));
    let mut all = Vec::new();
    let mut window = Window { ctx, time: 0.0, size: WINDOW };
    for path in std::env::args().skip(1) {
        let file = read_strokes(Path::new(&path), &ReadOptions::default())?;
        let mut drawn = 0;
        for stroke in &file.strokes {
            let points: Vec<Pos2> = placed(stroke.points.iter().map(|p| [p.x, p.y]));
            let (Some(&first), Some(&last)) = (points.first(), points.last()) else { continue };
            let room = points.iter().fold(Vec2::ZERO, |room, p| room.max(p.to_vec2())) + Vec2::splat(MARGIN);
            window.size = WINDOW.max(room);
            // Every stroke on paper of its own, or most would change the one before.
            app.open_drawing(Drawing::default());
            window.frame(&mut app, vec![Event::PointerMoved(first)]);
            window.frame(&mut app, vec![button(first, true)]);
            for chunk in points[1..].chunks(POINTS_A_FRAME) {
                window.frame(&mut app, chunk.iter().map(|&p| Event::PointerMoved(p)).collect());
            }
            window.frame(&mut app, vec![button(last, false)]);
            while !app.is_settled() {
                window.frame(&mut app, Vec::new());
            }
            drawn += app.session().drawing().curves().len();
        }
        let report = app.pace();
        println!("{path}: {drawn} of {} strokes became curves; the others are taps", file.strokes.len());
        show("from last point to curve", report.curves);
        show("work for a picture while drawing", report.frames);
        all.extend(app.curve_times_ms());
        app.forget_pace();
    }
    show("all, from last point to curve", Times::of(&all));
    Ok(())
}

fn show(what: &str, times: Times) {
    let Times { count, median, p99, longest } = times;
    println!(
        "    {what:<34} {count:>6} times, median {median:.2} ms, 99 of 100 within {p99:.2} ms, longest {longest:.2} ms"
    );
}

/// The strokes of a file where the window is.
fn placed(points: impl Iterator<Item = [f64; 2]> + Clone) -> Vec<Pos2> {
    let low = points.clone().fold([f64::INFINITY; 2], |low, p| [low[0].min(p[0]), low[1].min(p[1])]);
    points.map(|p| pos2((p[0] - low[0]) as f32 + MARGIN, (p[1] - low[1]) as f32 + MARGIN)).collect()
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

/// A window without a screen.
struct Window {
    ctx: Context,
    time: f64,
    size: Vec2,
}

impl Window {
    fn frame(&mut self, app: &mut App, events: Vec<Event>) {
        self.time += 1.0 / 60.0;
        let screen = Rect::from_min_size(Pos2::ZERO, self.size);
        let input = RawInput { screen_rect: Some(screen), time: Some(self.time), events, ..RawInput::default() };
        app.frame_without_window(&self.ctx, input);
    }
}
