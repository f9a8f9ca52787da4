//! What the page's script asks about the drawing: for whoever wants to know how the application does, above all the judge that drives it.

use wasm_bindgen::prelude::*;

use super::{app_runner, files, storage};

/// How many frames were drawn since the start.
#[wasm_bindgen]
pub fn frames() -> f64 {
    // Exact for 2^53 frames, which no page lives to see.
    app_runner::frames() as f64
}

/// Figures about the drawing, as JSON; none while the application is busy with a frame.
#[wasm_bindgen]
pub fn state() -> Option<String> {
    app_runner::ask(|app| app.state_json())
}

/// The strokes as they were recorded, in the format `fairpath-strokes` 1.
#[wasm_bindgen]
pub fn strokes() -> Option<String> {
    app_runner::ask(|app| app.strokes_json())
}

/// The drawing as it would be saved as SVG.
#[wasm_bindgen]
pub fn svg() -> Option<String> {
    app_runner::ask(|app| app.svg())
}

/// Saves the drawing as SVG, as the menu does.
///
/// # Errors
/// When the application is busy with a frame, or the browser refuses.
#[wasm_bindgen(js_name = saveSvg)]
pub fn save_svg() -> Result<(), JsError> {
    let svg = svg().ok_or_else(|| JsError::new("the application is busy"))?;
    files::download("drawing.svg", svg.as_bytes(), "image/svg+xml").map_err(|error| JsError::new(&error))
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
