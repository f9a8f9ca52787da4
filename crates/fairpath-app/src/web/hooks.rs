//! What the page's script asks about the drawing: for whoever wants to know how the application does, above all the judge that drives it.

use fairpath_io::{SplineFormat, StrokeFormat, WriteOptions, encode_splines, encode_strokes};
use fairpath_sketch::{splines_of, strokes_of};
use serde_json::json;
use wasm_bindgen::prelude::*;

use super::{app_runner, files, storage};

/// How many frames were drawn since the start.
#[wasm_bindgen]
pub fn frames() -> f64 {
    // Exact for 2^53 frames, which no page lives to see.
    app_runner::frames() as f64
}

/// Figures about the drawing and the view on it, as JSON; none while the application is busy with a frame.
///
/// `strokes` counts the curves that were drawn, `fitted` those of them that are what they shall be; `busy` tells whether anything is still to
/// be computed; `pixel_size` is the size of a point of the screen in the drawing's unit, by which strokes are fitted that are drawn now.
#[wasm_bindgen]
pub fn state() -> Option<String> {
    app_runner::ask(|app| {
        let curves = app.session().drawing().curves();
        let segments: usize = curves.iter().map(|curve| curve.spline.segments().len()).sum();
        let fitted = curves.iter().filter(|curve| curve.fitted).count();
        let (busy, pixel_size) = (!app.is_settled(), app.view.pixel_size());
        let figures = json!({
            "strokes": curves.len(), "fitted": fitted, "segments": segments, "busy": busy, "pixel_size": pixel_size,
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

/// Saves the drawing as SVG.
///
/// # Errors
/// When the application is busy with a frame, the drawing cannot be written, or the browser refuses.
#[wasm_bindgen(js_name = saveSvg)]
pub fn save_svg() -> Result<(), JsError> {
    let svg = svg()?.ok_or_else(|| JsError::new("the application is busy"))?;
    files::download("drawing.svg", svg.as_bytes()).map_err(|error| JsError::new(&error))
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
