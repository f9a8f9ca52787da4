//! The sketching application: strokes become fair curves while they are drawn, on the desktop and in the browser.
//!
//! What the application *does* is in `fairpath-sketch`; here is how it looks and how hands reach it. One frame goes one way: answers of the worker come in,
//! then what hands do, then everything is shown, then jobs go out.

mod app;
mod canvas;
mod documents;
mod example;
mod exports;
mod files;
#[cfg(not(target_arch = "wasm32"))]
mod given;
mod icons;
mod imports;
mod pace;
mod panels;
pub mod pen;
mod store;
mod surface_view;
mod theme;
mod view;
#[cfg(target_arch = "wasm32")]
pub mod web;
mod worker;

pub use app::App;
#[cfg(not(target_arch = "wasm32"))]
pub use given::GivenFile;
pub use pace::{PaceReport, Times};
#[cfg(not(target_arch = "wasm32"))]
pub use store::FileStore;
pub use store::{NoStore, Store};
pub use surface_view::SurfaceView;
pub use worker::{InlineWorker, Worker};
