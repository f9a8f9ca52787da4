//! Cameras, pictures, refusals and shaders. Pictures need a graphics device; Mesa's software drivers will do.

mod camera;
mod common;
mod picture;
mod refusals;
mod shaders;
