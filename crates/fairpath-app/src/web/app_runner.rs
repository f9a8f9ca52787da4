//! Starts the application on the page's canvas.

use std::cell::OnceCell;

use eframe::egui;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::{PageStore, PageWorker, pen, said, trouble, worker};
use crate::App;

/// The application that runs in this page.
struct Running {
    runner: eframe::WebRunner,
    ctx: OnceCell<egui::Context>,
}

thread_local! {
    static RUNNING: OnceCell<Running> = const { OnceCell::new() };
}

/// Runs the application on the canvas with the identifier `canvas_id`; `worker_url` is where the script of its worker lies.
///
/// Draws by WebGPU where the browser has it, else by WebGL 2.
///
/// # Errors
/// When there is no such canvas, when the application runs already, or when the browser gives neither WebGPU nor WebGL 2.
#[wasm_bindgen]
pub async fn start(canvas_id: String, worker_url: String) -> Result<(), JsError> {
    trouble::report_panics();
    worker::set_url(worker_url);
    let canvas = canvas(&canvas_id).ok_or_else(|| JsError::new(&format!("the page has no canvas {canvas_id}")))?;
    let runner = eframe::WebRunner::new();
    let fresh = Running { runner: runner.clone(), ctx: OnceCell::new() };
    if RUNNING.with(|running| running.set(fresh)).is_err() {
        return Err(JsError::new("the application runs already"));
    }
    let creator: eframe::AppCreator<'static> = {
        let canvas = canvas.clone();
        Box::new(move |creation| {
            RUNNING.with(|running| running.get().map(|running| running.ctx.set(creation.egui_ctx.clone())));
            // Before eframe's own listeners, one of which draws a frame when the pen is set down.
            pen::listen(&canvas, &creation.egui_ctx).map_err(|error| said(&error))?;
            let ctx = &creation.egui_ctx;
            let app = App::new(ctx, Box::new(PageWorker::new(ctx)), Box::new(PageStore::new(ctx)));
            Ok(Box::new(app.in_cleared_window()))
        })
    };
    // Every colour of ours is flat, and noise in each of a window's pixels is much work where software draws.
    let options = eframe::WebOptions { dithering: false, ..Default::default() };
    let started = runner.start(canvas, options, creator).await;
    started.map_err(|error| JsError::new(&said(&error)))
}

/// What the application says to a question, if it runs and is not busy with a frame.
pub(super) fn ask<T>(question: impl FnOnce(&mut App) -> T) -> Option<T> {
    RUNNING.with(|running| {
        let mut app = running.get()?.runner.app_mut::<App>()?;
        Some(question(&mut app))
    })
}

/// How many frames were drawn.
pub(super) fn frames() -> u64 {
    ctx().map_or(0, |ctx| ctx.cumulative_frame_nr())
}

/// The interface of the application, once it runs.
pub(super) fn ctx() -> Option<egui::Context> {
    RUNNING.with(|running| running.get()?.ctx.get().cloned())
}

fn canvas(id: &str) -> Option<HtmlCanvasElement> {
    web_sys::window()?.document()?.get_element_by_id(id)?.dyn_into().ok()
}
