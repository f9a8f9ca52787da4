//! Draw a stroke and see it become fair.
mod app;
mod job;
pub mod pen;
#[cfg(target_arch = "wasm32")]
pub mod web;

pub use app::App;
