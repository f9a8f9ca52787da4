//! A panic is told to the page's script, which tells the reader; without that the picture would only stand still.

use std::panic;
use std::sync::Once;

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// Defined by the script of the page, and by that of the worker.
    #[wasm_bindgen(catch, js_namespace = globalThis, js_name = fairpathPanicked)]
    fn panicked(message: &str) -> Result<(), JsValue>;
}

static ONCE: Once = Once::new();

/// From now on a panic calls `globalThis.fairpathPanicked` with its message.
pub(super) fn report_panics() {
    ONCE.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            // Where the script defines no such function, nobody there wants to know.
            let _ = panicked(&info.to_string());
            before(info);
        }));
    });
}
