//! What the page's script asks about the drawing and the interface: for whoever wants to know how the application does, above all the judge
//! that drives it.

use eframe::egui::Pos2;
use fairpath_io::{SplineFormat, StrokeFormat, WriteOptions, encode_splines, encode_strokes};
use fairpath_sketch::{splines_of, strokes_of};
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

use super::{app_runner, named, storage, worker};
use crate::{App, Times};

/// How many frames were drawn since the start.
#[wasm_bindgen]
pub fn frames() -> f64 {
    // Exact for 2^53 frames, which no page lives to see.
    app_runner::frames() as f64
}

/// Figures about the drawing and the view on it, as JSON; none while the application is busy with a frame.
///
/// `strokes` counts the curves that were drawn, `fitted` those of them that are what they shall be; `busy` tells whether anything is still to
/// be computed; `pixel_size` is the size of a point of the screen in the drawing's unit, by which strokes are fitted that are drawn now, and
/// `corner` the place of the drawing at the upper left corner of the window.
#[wasm_bindgen]
pub fn state() -> Option<String> {
    app_runner::ask(|app| {
        let curves = app.session().drawing().curves();
        let segments: usize = curves.iter().map(|curve| curve.spline.segments().len()).sum();
        let fitted = curves.iter().filter(|curve| curve.fitted).count();
        let corner = app.view.drawing_at(Pos2::ZERO);
        let figures = json!({
            "strokes": curves.len(), "fitted": fitted, "segments": segments, "busy": !app.is_settled(),
            "pixel_size": app.view.pixel_size(), "corner": [corner.x, corner.y],
        });
        figures.to_string()
    })
}

/// The strokes as they were recorded, in the format `fairpath-strokes` 1; none while the application is busy with a frame.
///
/// # Errors
/// When they cannot be written.
#[wasm_bindgen]
pub fn strokes() -> Result<Option<String>, JsError> {
    let file = app_runner::ask(|app| strokes_of(app.session().drawing()));
    file.map(|file| text(encode_strokes(&file, StrokeFormat::Json)?)).transpose()
}

/// The drawing as it would be saved as SVG; none while the application is busy with a frame.
///
/// # Errors
/// When it cannot be written.
#[wasm_bindgen]
pub fn svg() -> Result<Option<String>, JsError> {
    let file = app_runner::ask(|app| splines_of(app.session().drawing()));
    file.map(|file| text(encode_splines(&file, SplineFormat::Svg, None, &WriteOptions::default())?.bytes)).transpose()
}

fn text(bytes: Vec<u8>) -> Result<String, JsError> {
    Ok(String::from_utf8(bytes)?)
}

/// How fast the application was since the start or [`forget_pace`], as JSON; none while it is busy with a frame.
///
/// Each of the three has `count`, `median`, `p99` and `longest`, in milliseconds: `curves` is from the last point of a stroke to its curve in
/// the picture; `frames` the application's own work for each frame while a stroke is drawn, up to the shapes of the interface, without their
/// triangles and what the graphics device is told; `jobs` each job in the worker, without the way there and back.
#[wasm_bindgen]
pub fn pace() -> Option<String> {
    app_runner::ask(|app| {
        let own = app.pace();
        json!({ "curves": own.curves, "frames": own.frames, "jobs": Times::of(&worker::times_ms()) }).to_string()
    })
}

/// Begins to time anew; false while the application is busy with a frame.
#[must_use]
#[wasm_bindgen(js_name = forgetPace)]
pub fn forget_pace() -> bool {
    worker::forget_times();
    app_runner::ask(App::forget_pace).is_some()
}

/// Everything in the interface that has a name, as JSON: a list of `{name, x, y, width, height}` in points of the screen, with the names
/// that a screen reader would say. Nothing at the first call: only from then on the names are gathered, with each frame.
#[wasm_bindgen]
#[must_use]
pub fn named() -> String {
    let places = app_runner::ctx().map(|ctx| named::places(&ctx)).unwrap_or_default();
    let row = |place: &named::Place| {
        let rect = place.rect;
        json!({ "name": place.name, "x": rect.min.x, "y": rect.min.y, "width": rect.width(), "height": rect.height() })
    };
    Value::Array(places.iter().map(row).collect()).to_string()
}

/// Saves a text in the browser's database.
///
/// # Errors
/// As [`storage::save`].
#[wasm_bindgen(js_name = saveText)]
pub async fn save_text(key: String, text: String) -> Result<(), JsError> {
    Ok(storage::save(&key, &text).await?)
}

/// Loads a text from the browser's database.
///
/// # Errors
/// As [`storage::load`].
#[wasm_bindgen(js_name = loadText)]
pub async fn load_text(key: String) -> Result<Option<String>, JsError> {
    Ok(storage::load(&key).await?)
}

/// Removes a text from the browser's database.
///
/// # Errors
/// As [`storage::remove`].
#[wasm_bindgen(js_name = removeText)]
pub async fn remove_text(key: String) -> Result<(), JsError> {
    Ok(storage::remove(&key).await?)
}
