//! Files out of the page and into it. Done by hand and not by the crate that the desktop uses, whose dialogs in a page are windows of its
//! own drawing that ask for one click more.

use std::cell::Cell;
use std::rc::Rc;

use js_sys::{Array, ArrayBuffer, Uint8Array};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, BlobPropertyBag, Document, File, HtmlAnchorElement, HtmlInputElement, Url};

use super::said;

/// How long the browser may take to begin a download before its bytes are given up, in ms.
const DOWNLOAD_BEGINS_MS: i32 = 60_000;

/// The kind of what is downloaded: no browser shows such instead of saving it, and the name says the rest.
const KIND: &str = "application/octet-stream";

/// Gives the person a file to save.
///
/// # Errors
/// What the browser says if it cannot.
pub fn download(name: &str, bytes: &[u8]) -> Result<(), String> {
    begin_download(name, bytes).map_err(|error| format!("{name}: the browser cannot save it: {}", said(&error)))
}

fn begin_download(name: &str, bytes: &[u8]) -> Result<(), JsValue> {
    let kind = BlobPropertyBag::new();
    kind.set_type(KIND);
    let blob = Blob::new_with_u8_array_sequence_and_options(&Array::of1(&Uint8Array::from(bytes)), &kind)?;
    let url = Url::create_object_url_with_blob(&blob)?;
    let anchor: HtmlAnchorElement = document()?.create_element("a")?.unchecked_into();
    anchor.set_href(&url);
    anchor.set_download(name);
    anchor.click();
    let give_up = Closure::once_into_js(move || Url::revoke_object_url(&url));
    let window = web_sys::window().ok_or("this is no page")?;
    window.set_timeout_with_callback_and_timeout_and_arguments_0(give_up.unchecked_ref(), DOWNLOAD_BEGINS_MS)?;
    Ok(())
}

/// Lets the person choose a file of these extensions. What was chosen comes to `then` with its name, or why it cannot be read; nothing comes
/// if nothing is chosen. Browsers allow this only soon after a click or a key.
pub fn open(extensions: &[&str], then: impl FnOnce(Result<(String, Vec<u8>), String>) + 'static) {
    let then = Rc::new(Cell::new(Some(then)));
    let outcome = {
        let then = Rc::clone(&then);
        move |read| {
            if let Some(then) = then.take() {
                then(read);
            }
        }
    };
    if let Err(error) = ask_for_file(extensions, outcome)
        && let Some(then) = then.take()
    {
        then(Err(format!("the browser cannot ask for a file: {}", said(&error))));
    }
}

fn ask_for_file(
    extensions: &[&str],
    then: impl FnOnce(Result<(String, Vec<u8>), String>) + 'static,
) -> Result<(), JsValue> {
    let input: HtmlInputElement = document()?.create_element("input")?.unchecked_into();
    input.set_type("file");
    input.set_accept(&extensions.iter().map(|extension| format!(".{extension}")).collect::<Vec<_>>().join(","));
    let chosen = Closure::once_into_js({
        let input = input.clone();
        move || {
            let Some(file) = input.files().and_then(|files| files.get(0)) else { return };
            spawn_local(async move {
                let name = file.name();
                let read = read(&file).await.map_err(|error| format!("{name}: cannot be read: {}", said(&error)));
                then(read.map(|bytes| (name, bytes)));
            });
        }
    });
    input.set_onchange(Some(chosen.unchecked_ref()));
    input.click();
    Ok(())
}

async fn read(file: &File) -> Result<Vec<u8>, JsValue> {
    let buffer: ArrayBuffer = JsFuture::from(file.array_buffer()).await?.unchecked_into();
    Ok(Uint8Array::new(&buffer).to_vec())
}

fn document() -> Result<Document, JsValue> {
    web_sys::window().and_then(|window| window.document()).ok_or_else(|| "this is no page".into())
}
