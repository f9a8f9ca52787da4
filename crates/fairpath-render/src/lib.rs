//! Surfaces on the graphics device: a [`fairpath_shape::Mesh`] and a [`Camera`] in, a shaded picture out, natively and in the browser.
//!
//! | to … | use |
//! | --- | --- |
//! | draw into a texture, as for a window | [`SurfaceRenderer`] |
//! | draw without a window, into bytes | [`Offscreen`] |
//! | turn, near and move | [`Camera`] |
//! | choose colours, light and zebra stripes | [`Look`] |
//!
//! # Frames
//!
//! The world is right-handed, with x to the right, y up and z out of the drawing, towards who looks at it from the front. Meshes in which y points down
//! are turned upright when they are uploaded ([`YAxis`]). All is f64 up to the matrices and vertices that the device is given; these are
//! about the middle of the surface and in units of its radius, so that it may lie anywhere.
//!
//! ```
//! # #[cfg(not(target_arch = "wasm32"))] {
//! use fairpath_curve::{Continuity, Point, Segment, Spline};
//! use fairpath_render::{Adapter, Camera, Look, Offscreen, YAxis};
//! use fairpath_shape::{InflateOptions, inflate};
//! use std::f64::consts::{PI, TAU};
//!
//! let circle = Segment::arc(Point::new(10.0, 0.0), PI / 2.0, 10.0 * TAU, 1.0 / 10.0);
//! let spline = Spline::new(vec![circle], vec![Continuity::G1], true)?;
//! let ball = inflate(&spline, &InflateOptions::default())?.mesh;
//!
//! let mut offscreen = Offscreen::new(Adapter::Best)?;
//! let mesh = offscreen.upload(&[&ball], YAxis::Up)?;
//! let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0);
//! let picture = offscreen.picture(&mesh, &camera, [64, 64], &Look::light())?;
//! let pixel = |x: usize, y: usize| &picture.rgba[4 * (64 * y + x)..][..3];
//!
//! assert_eq!(pixel(0, 0), [255, 255, 255]);
//! assert_ne!(pixel(32, 32), [255, 255, 255]);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bounds;
mod camera;
mod error;
mod gpu_mesh;
mod look;
#[cfg(not(target_arch = "wasm32"))]
mod offscreen;
mod surface;
mod target;

pub use bounds::Bounds;
pub use camera::Camera;
pub use error::RenderError;
pub use glam::DVec3;
pub use gpu_mesh::{GpuMesh, YAxis};
pub use look::{Colour, Finish, Look, Room, Zebra};
#[cfg(not(target_arch = "wasm32"))]
pub use offscreen::{Adapter, Offscreen, Picture};
pub use surface::{Drawn, SurfaceRenderer};
pub use target::PICTURE_FORMAT;
