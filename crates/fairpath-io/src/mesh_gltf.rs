//! Surfaces as binary glTF 2.0: a mesh and a node for each, with positions, normals and triangles.
//!
//! Frame: right-handed, y up, z towards the viewer, metres; see [`SurfaceFile::y`] for drawings with y down. A px counts as a hundredth of an
//! inch. Numbers in glTF's buffers have 24 bits, so positions are relative to the middle of each surface, and the node moves it there with
//! the full precision of JSON.

use crate::error::Error;
use crate::gltf::{Buffers, container};
use crate::surfaces::{SurfaceEntry, SurfaceFile, upright};
use serde_json::{Value, json};

pub(crate) fn write(file: &SurfaceFile) -> Result<Vec<u8>, Error> {
    let mut parts = Parts::default();
    for entry in &file.surfaces {
        parts.add(file, entry)?;
    }
    let Parts { buffers: Buffers { binary, views, accessors }, meshes, nodes } = parts;
    let document = json!({
        "asset": {"version": "2.0", "generator": concat!("fairpath ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"nodes": (0..nodes.len()).collect::<Vec<_>>()}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [{"name": "clay", "pbrMetallicRoughness":
            {"baseColorFactor": [0.78, 0.30, 0.17, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5}}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": binary.len()}],
    });
    container(document.to_string().into_bytes(), binary)
}

/// The parts of the document, and what they point to.
#[derive(Default)]
struct Parts {
    buffers: Buffers,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
}

impl Parts {
    fn add(&mut self, file: &SurfaceFile, entry: &SurfaceEntry) -> Result<(), Error> {
        let scale = file.unit.metres();
        let vertices: Vec<[f64; 3]> =
            entry.mesh.vertices.iter().map(|&v| upright(v, file.y).map(|x| x * scale)).collect();
        let bounds = |pick: fn(f64, f64) -> f64| {
            vertices.iter().copied().reduce(|a, b| [pick(a[0], b[0]), pick(a[1], b[1]), pick(a[2], b[2])])
        };
        let (low, high) = (bounds(f64::min).unwrap_or_default(), bounds(f64::max).unwrap_or_default());
        let middle = [0, 1, 2].map(|k| low[k] + 0.5 * (high[k] - low[k]));
        let near: Vec<[f32; 3]> = vertices.iter().map(|v| [0, 1, 2].map(|k| (v[k] - middle[k]) as f32)).collect();
        let size = near.iter().flatten().fold(0.0_f32, |m, x| m.max(x.abs()));
        let holds = size.is_finite() && size > 1e-30 && middle.iter().all(|x| x.abs() < f64::from(f32::MAX));
        if !holds {
            let problem =
                format!("it is {size:e} m large, which glTF's numbers of 32 bits cannot hold; scale the drawing");
            return Err(Error::Unwritable { format: "glTF", place: format!("surface {:?}", entry.name), problem });
        }
        let normals: Vec<[f32; 3]> = entry.mesh.normals.iter().map(|&n| upright(n, file.y).map(|x| x as f32)).collect();
        let position = self.buffers.vectors(&near, true);
        let normal = self.buffers.vectors(&normals, false);
        let indices = self.buffers.indices(&entry.mesh.triangles);
        self.nodes.push(json!({"name": entry.name, "mesh": self.meshes.len(), "translation": middle}));
        self.meshes.push(json!({"name": entry.name, "primitives":
            [{"attributes": {"POSITION": position, "NORMAL": normal}, "indices": indices, "material": 0}]}));
        Ok(())
    }
}
