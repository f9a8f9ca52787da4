//! What can go wrong before there is a picture.

use thiserror::Error;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// There is nothing to draw.
    #[error("there is no triangle to draw: give a mesh that has some")]
    Empty,
    /// Not every vertex has a normal.
    #[error("mesh {mesh} has {vertices} vertices and {normals} normals: give one normal for each vertex")]
    NormalCount {
        /// Which of the meshes, from 0.
        mesh: usize,
        /// Number of its vertices.
        vertices: usize,
        /// Number of its normals.
        normals: usize,
    },
    /// A vertex lies nowhere, or its normal points nowhere.
    #[error("vertex {vertex} of mesh {mesh} or its normal has a number that is not finite: repair the mesh")]
    NotFinite {
        /// Which of the meshes, from 0.
        mesh: usize,
        /// Which vertex, from 0.
        vertex: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} of mesh {mesh} names a vertex that does not exist: repair the mesh")]
    BadTriangle {
        /// Which of the meshes, from 0.
        mesh: usize,
        /// Which triangle, from 0.
        triangle: usize,
    },
    /// The surface is no larger than a point, or larger than can be computed with.
    #[error("the surface reaches {radius:e} from its middle, and can be drawn from {least:e} to {most:e}: scale it")]
    Extent {
        /// Half of the longest side of the box around the surface.
        radius: f64,
        /// Least that can be drawn.
        least: f64,
        /// Most that can be drawn.
        most: f64,
    },
    /// The surface has more vertices or triangles than the device can be given at once.
    #[error("the surface has {count} {what}, and this device takes up to {limit}: ask for fewer triangles")]
    TooMany {
        /// Vertices or corners of triangles.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// Most that are possible.
        limit: usize,
    },
    /// A picture without pixels, or with more than the device can hold.
    #[error("a picture of {width} by {height} px: each side can be from 1 to {limit} px on this device")]
    BadSize {
        /// Width, px.
        width: u32,
        /// Height, px.
        height: u32,
        /// Largest side, px.
        limit: u32,
    },
    /// There is no graphics device that would do.
    #[error(
        "no graphics device was found ({problem}): install a driver for Vulkan or OpenGL; \
         without a graphics card, Mesa's software drivers do (on Debian the package mesa-vulkan-drivers)"
    )]
    NoDevice {
        /// What the search ended with.
        problem: String,
    },
    /// The picture was drawn, and could not be fetched.
    #[error("the picture could not be read back from the graphics device ({problem}): try a smaller one")]
    ReadBack {
        /// What the device said.
        problem: String,
    },
}
