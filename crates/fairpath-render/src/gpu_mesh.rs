//! Meshes in f64 come in, buffers on the graphics device go out: f32 about the middle of all, in units of their radius.

use crate::bounds::Bounds;
use crate::error::RenderError;
use bytemuck::{Pod, Zeroable};
use fairpath_shape::Mesh;
use glam::DVec3;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

/// Half of the box's longest side may be from the first to the second, so that squares and quotients stay numbers.
const EXTENTS: [f64; 2] = [1e-100, 1e100];
/// Most vertices of one buffer: WebGL counts no further with certainty (2²⁴ − 1).
const MOST_VERTICES: usize = 0x00ff_ffff;

/// Where the y axis of a mesh's coordinates points.
///
/// Worlds have it up. A mesh with y down, from a drawing on a screen, is turned about its x axis by half a turn: then nothing is mirrored, and from
/// the front the drawing appears as it was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum YAxis {
    /// Up, as in mathematics.
    Up,
    /// Down, as on screens.
    Down,
}

impl YAxis {
    fn upright(self, [x, y, z]: [f64; 3]) -> DVec3 {
        match self {
            Self::Up => DVec3::new(x, y, z),
            Self::Down => DVec3::new(x, -y, -z),
        }
    }
}

/// Meshes on a graphics device, ready to be drawn as often as wanted.
#[derive(Debug)]
pub struct GpuMesh {
    pub(crate) vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    /// Corners of all triangles.
    pub(crate) corners: u32,
    bounds: Bounds,
}

/// A vertex as the shader takes it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Vertex {
    /// Place about the middle, in radii.
    place: [f32; 3],
    /// Unit vector out of the surface.
    normal: [f32; 3],
}

impl Vertex {
    pub(crate) const ATTRIBUTES: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
}

impl GpuMesh {
    /// Copies meshes, which are drawn as one, to a device.
    ///
    /// # Errors
    /// [`RenderError`] where there is no triangle, a mesh is not sound enough to be drawn, or the device cannot hold it.
    pub(crate) fn new(device: &wgpu::Device, meshes: &[&Mesh], y: YAxis) -> Result<Self, RenderError> {
        check(meshes)?;
        let bounds = bounds(meshes, y)?;
        let vertices = vertices(meshes, y, &bounds);
        let indices = indices(meshes);
        let limits = device.limits();
        let most = |size: usize| usize::try_from(limits.max_buffer_size).unwrap_or(usize::MAX) / size;
        let counts = [
            ("vertices", vertices.len(), most(size_of::<Vertex>()).min(MOST_VERTICES)),
            ("corners of triangles", indices.len(), most(size_of::<u32>()).min(u32::MAX as usize)),
        ];
        if let Some((what, count, limit)) = counts.into_iter().find(|(_, count, limit)| count > limit) {
            return Err(RenderError::TooMany { what, count, limit });
        }
        let buffer = |label, contents: &[u8], usage| {
            device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage })
        };
        Ok(Self {
            vertices: buffer("vertices", bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
            indices: buffer("triangles", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX),
            corners: indices.len() as u32,
            bounds,
        })
    }

    /// A ball around all of it, in the world.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }
}

fn check(meshes: &[&Mesh]) -> Result<(), RenderError> {
    if meshes.iter().all(|mesh| mesh.triangles.is_empty()) {
        return Err(RenderError::Empty);
    }
    for (mesh, Mesh { vertices, normals, triangles }) in meshes.iter().enumerate() {
        if vertices.len() != normals.len() {
            return Err(RenderError::NormalCount { mesh, vertices: vertices.len(), normals: normals.len() });
        }
        let finite = |v: &[f64; 3]| v.iter().all(|x| x.is_finite());
        if let Some(vertex) = vertices.iter().zip(normals).position(|(p, n)| !(finite(p) && finite(n))) {
            return Err(RenderError::NotFinite { mesh, vertex });
        }
        if let Some(triangle) = triangles.iter().position(|t| t.iter().any(|&i| i as usize >= vertices.len())) {
            return Err(RenderError::BadTriangle { mesh, triangle });
        }
    }
    Ok(())
}

/// The ball about the middle of the box around the meshes.
fn bounds(meshes: &[&Mesh], y: YAxis) -> Result<Bounds, RenderError> {
    let points = || meshes.iter().flat_map(|mesh| &mesh.vertices).map(|&v| y.upright(v));
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    // Halved first, since the sum of the largest numbers is none.
    let (centre, reach) = (0.5 * low + 0.5 * high, (0.5 * high - 0.5 * low).max_element());
    let [least, most] = EXTENTS;
    if !(least..=most).contains(&reach) {
        return Err(RenderError::Extent { radius: reach, least, most });
    }
    let radius = points().map(|p| (p - centre).length_squared()).fold(0.0, f64::max).sqrt();
    Ok(Bounds { centre, radius })
}

fn vertices(meshes: &[&Mesh], y: YAxis, bounds: &Bounds) -> Vec<Vertex> {
    let all = meshes.iter().flat_map(|mesh| mesh.vertices.iter().zip(&mesh.normals));
    all.map(|(&place, &normal)| Vertex {
        place: ((y.upright(place) - bounds.centre) / bounds.radius).as_vec3().to_array(),
        normal: y.upright(normal).as_vec3().to_array(),
    })
    .collect()
}

fn indices(meshes: &[&Mesh]) -> Vec<u32> {
    let mut before = 0_u32;
    let mut indices = Vec::new();
    for mesh in meshes {
        indices.extend(mesh.triangles.iter().flatten().map(|&i| before.wrapping_add(i)));
        // Too many vertices are refused afterwards, by their number.
        before = before.wrapping_add(mesh.vertices.len() as u32);
    }
    indices
}
