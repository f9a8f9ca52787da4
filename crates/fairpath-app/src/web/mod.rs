//! The application in a page of the browser: what it needs of the browser comes in here, and what the page's script calls goes out.
//!
//! | task | use |
//! | --- | --- |
//! | run the application on a canvas | [`start`] |
//! | what the pen did since the last frame, at the device's own rate | [`pen::drain`] |
//! | long work beside the page, so that it stays quick | [`PageWorker`], made of [`JobWorker`]; in the worker [`run_job`] |
//! | keep the drawing from one visit to the next | [`PageStore`], made of [`storage`] |
//! | save a file, open one | [`download`], [`open`] |
//! | what the page's script asks about the drawing and the interface | [`hooks`] |

mod app_runner;
mod files;
pub mod hooks;
mod named;
mod page_store;
mod page_worker;
pub mod pen;
pub mod storage;
mod trouble;
mod worker;

pub use app_runner::start;
pub use files::{download, open};
pub use page_store::PageStore;
pub use page_worker::PageWorker;
pub use worker::{JobOutcome, JobWorker, run_job};

use wasm_bindgen::JsValue;

/// What the browser says of an error, for the reader.
fn said(error: &JsValue) -> String {
    let text = js_sys::Reflect::get(error, &"message".into()).ok().and_then(|message| message.as_string());
    text.or_else(|| error.as_string()).unwrap_or_else(|| format!("{error:?}"))
}
