//! The sketching application: strokes become fair curves while they are drawn, on the desktop and in the browser.
//!
//! What the application *does* is in `fairpath-sketch`; here is how it looks and how hands reach it. One frame goes one way: answers of the worker come in,
//! then what hands do, then everything is shown, then jobs go out.

mod app;
mod canvas;
mod example;
mod icons;
mod panels;
mod surface_view;
mod theme;
mod view;
mod worker;

pub use app::App;
pub use surface_view::SurfaceView;
pub use worker::{InlineWorker, Worker};
