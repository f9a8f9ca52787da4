//! The desktop window: arguments come in, the application runs in a window until that is closed, and its exit code goes out.

use anyhow::{Context as _, Result};
use clap::Parser;
use eframe::egui::{self, Ui, Vec2};
use fairpath_app::{App, FileStore, GivenFile, PaceReport, Times};
use serde::Serialize;
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::rc::Rc;
use std::time::Instant;

/// The size of a new window, points.
const SIZE: Vec2 = egui::vec2(1280.0, 820.0);

/// Draw a stroke and see it become fair.
#[derive(Parser, Debug)]
#[command(name = "fairpath-app", version, after_help = EXIT_CODES)]
struct Arguments {
    /// What to show: a drawing (fairpath-drawing 1) is gone on with, and strokes and curves (JSON, SVG, CSV, text, InkML, GPX, GeoJSON)
    /// and a picture to trace over (PNG, JPEG, WebP) are added to it. Undo leads back to the last drawing. Without a file, the
    /// application goes on with the last drawing
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Where the drawing is kept against crashes, and where the last one is looked for, instead of the user's own folder
    #[arg(long, value_name = "FILE")]
    kept: Option<PathBuf>,

    /// When the window is closed, write there as JSON how fast the application was, in milliseconds: from the last point of each stroke to
    /// its curve in the picture, and the work for each picture while a stroke was drawn
    #[arg(long, value_name = "FILE")]
    pace: Option<PathBuf>,
}

const EXIT_CODES: &str = "\
Exit codes: 0 the window was closed; 1 there was no window, or the pace could not be written;
2 unusable arguments or files, told before there is a window.";

/// Runs the application with the arguments of this process.
pub(crate) fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let files: Result<Vec<GivenFile>> = arguments.files.iter().map(|path| GivenFile::read(path)).collect();
    let files = match files {
        Ok(files) => files,
        Err(error) => {
            eprintln!("fairpath-app: {error:#}");
            return ExitCode::from(2);
        }
    };
    match show(files, arguments.kept, arguments.pace.as_deref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("fairpath-app: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the window until it is closed, and writes its pace.
fn show(files: Vec<GivenFile>, kept: Option<PathBuf>, pace: Option<&Path>) -> Result<()> {
    let viewport = egui::ViewportBuilder::default()
        .with_title("Fairpath")
        .with_app_id("fairpath")
        .with_inner_size(SIZE)
        .with_min_inner_size([480.0, 360.0]);
    let last_words = Rc::new(RefCell::new(None));
    let report = Rc::clone(&last_words);
    let start = move |creation: &eframe::CreationContext<'_>| {
        let ctx = &creation.egui_ctx;
        let mut app = match kept {
            Some(path) => App::with_thread(ctx, Box::new(FileStore::at(path))),
            None => App::on_desktop(ctx),
        }
        .in_cleared_window();
        app.open_given(ctx, &files, SIZE);
        Ok(Box::new(Window { app, drawing: false, begun: None, handed_ms: Vec::new(), apart_ms: Vec::new(), report })
            as _)
    };
    // Every colour of ours is flat, and noise in each of a window's pixels is much work where software draws.
    let options = eframe::NativeOptions { viewport, dithering: false, ..Default::default() };
    eframe::run_native("fairpath", options, Box::new(start))
        .context("there is no window; it needs a screen of X or Wayland and a driver to draw with")?;
    if let (Some(path), Some(pace)) = (pace, last_words.take()) {
        let bytes = serde_json::to_vec(&pace).context("the pace cannot be written")?;
        fairpath_io::write_whole(path, &bytes).context("the pace cannot be written")?;
    }
    Ok(())
}

/// How fast a window was, milliseconds.
#[derive(Serialize)]
struct WindowPace {
    /// The application's own times.
    #[serde(flatten)]
    own: PaceReport,
    /// The work for each picture while a stroke was drawn up to its being handed to the graphics device, without waiting for that.
    handed: Times,
    /// From one picture to the next while a stroke was drawn, with all waiting.
    apart: Times,
    /// The times that `curves` sums up, in their order.
    curve_times_ms: Vec<f64>,
    /// The times that `frames` sums up, in their order.
    frame_times_ms: Vec<f64>,
    /// The times that `handed` sums up, in their order.
    handed_times_ms: Vec<f64>,
    /// The times that `apart` sums up, in their order.
    apart_times_ms: Vec<f64>,
}

/// The application in its window, and what only a window can time.
struct Window {
    app: App,
    /// Whether a stroke was in hand in the picture before.
    drawing: bool,
    /// When that picture was begun.
    begun: Option<Instant>,
    handed_ms: Vec<f64>,
    apart_ms: Vec<f64>,
    /// Where the pace goes in the end.
    report: Rc<RefCell<Option<WindowPace>>>,
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        let now = Instant::now();
        if self.drawing {
            self.handed_ms.extend(frame.info().cpu_usage.map(|seconds| f64::from(seconds) * 1e3));
            self.apart_ms.extend(self.begun.map(|begun| (now - begun).as_secs_f64() * 1e3));
        }
        self.begun = Some(now);
        self.drawing = self.app.session().hand().is_some();
        self.app.ui(ui, frame);
        self.drawing &= self.app.session().hand().is_some();
    }

    fn on_exit(&mut self) {
        self.app.on_exit();
        *self.report.borrow_mut() = Some(WindowPace {
            own: self.app.pace(),
            handed: Times::of(&self.handed_ms),
            apart: Times::of(&self.apart_ms),
            curve_times_ms: self.app.curve_times_ms().to_vec(),
            frame_times_ms: self.app.frame_times_ms().to_vec(),
            handed_times_ms: std::mem::take(&mut self.handed_ms),
            apart_times_ms: std::mem::take(&mut self.apart_ms),
        });
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        self.app.clear_color(visuals)
    }
}
