//! Surfaces from curves: a closed [`fairpath_curve::Spline`] in, a closed triangle mesh out, as in figure 2 of Baran, Lehtinen and Popović
//! (2010), who leave the method open.
//!
//! | to … | use |
//! | --- | --- |
//! | inflate a closed spline | [`inflate`] with [`InflateOptions`] |
//! | measure a mesh | [`Mesh::area`], [`Mesh::volume`], [`Mesh::least_angle`], [`Mesh::euler_characteristic`] |
//! | find out what is wrong with a mesh | [`Mesh::faults`] |
//!
//! # The shape
//!
//! The height over the plane of the curve is √u, where Δu = −4 inside and u = 0 on the curve: the shape of a membrane under even pressure,
//! under the square root. The back is the front mirrored. A circle becomes its sphere, an ellipse an ellipsoid, whose third half axis is
//! √(2 / (1/a² + 1/b²)), and wherever the curve is smooth the surface is too: it crosses the plane upright. A curve that crosses itself
//! is inflated over all that it winds around: an eight becomes two drops, a pentagram a star.
//!
//! ```
//! use fairpath_curve::{Continuity, Point, Segment, Spline};
//! use fairpath_shape::{InflateOptions, inflate};
//! use std::f64::consts::{PI, TAU};
//!
//! let circle = Segment::arc(Point::new(10.0, 0.0), PI / 2.0, 10.0 * TAU, 1.0 / 10.0);
//! let spline = Spline::new(vec![circle], vec![Continuity::G1], true)?;
//! let ball = inflate(&spline, &InflateOptions::default())?.mesh;
//!
//! assert!(ball.faults().is_empty());
//! let exact = 4.0 / 3.0 * PI * 1000.0;
//! assert!((ball.volume() - exact).abs() < 2e-3 * exact);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod conjugate_gradients;
mod error;
mod fill;
mod inflate;
mod mesh;
mod options;
mod outline;
mod poisson;
mod rim;
mod shore;
mod surface;
mod triangulation;
mod uncrossed;

pub use error::InflateError;
pub use inflate::{Inflated, inflate};
pub use mesh::{Mesh, MeshFault};
pub use options::InflateOptions;
