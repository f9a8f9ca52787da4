//! Surfaces as binary glTF 2.0: a mesh and a node for each, with positions, normals and triangles.
//!
//! Frame: right-handed, y up, z towards the viewer, metres; see [`SurfaceFile::y`] for drawings with y down. A px counts as a hundredth of an
//! inch. Numbers in glTF's buffers have 24 bits, so positions are relative to the middle of each surface, and the node moves it there with
//! the full precision of JSON. Reference: Khronos Group, "glTF 2.0 Specification" (2021).

use crate::error::Error;
use crate::surfaces::{SurfaceEntry, SurfaceFile, upright};
use serde_json::{Value, json};

/// Bytes of a file's header and of each chunk's.
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
/// Words of the specification: "glTF", "JSON" and "BIN" in the order of their bytes.
const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: &[u8] = b"JSON";
const BINARY_CHUNK: &[u8] = b"BIN\0";
/// Numbers of the specification: component types and targets of buffer views.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

pub(crate) fn write(file: &SurfaceFile) -> Result<Vec<u8>, Error> {
    let mut parts = Parts::default();
    for entry in &file.surfaces {
        parts.add(file, entry)?;
    }
    let Parts { binary, views, accessors, meshes, nodes } = parts;
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
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
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
        let position = self.vectors(&near, true);
        let normal = self.vectors(&normals, false);
        let indices = self.indices(&entry.mesh.triangles);
        self.nodes.push(json!({"name": entry.name, "mesh": self.meshes.len(), "translation": middle}));
        self.meshes.push(json!({"name": entry.name, "primitives":
            [{"attributes": {"POSITION": position, "NORMAL": normal}, "indices": indices, "material": 0}]}));
        Ok(())
    }

    /// Adds an accessor for vectors and gives its number; bounds are told only where the specification asks for them.
    fn vectors(&mut self, vectors: &[[f32; 3]], bounded: bool) -> usize {
        let begin = self.binary.len();
        self.binary.extend(vectors.iter().flatten().flat_map(|x| x.to_le_bytes()));
        let mut accessor = json!({"componentType": FLOAT, "count": vectors.len(), "type": "VEC3"});
        if bounded {
            let bound = |pick: fn(f32, f32) -> f32| {
                [0, 1, 2].map(|k| f64::from(vectors.iter().map(|v| v[k]).reduce(pick).unwrap_or_default()))
            };
            accessor["min"] = json!(bound(f32::min));
            accessor["max"] = json!(bound(f32::max));
        }
        self.accessor(accessor, begin, VERTICES)
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let begin = self.binary.len();
        self.binary.extend(triangles.iter().flatten().flat_map(|i| i.to_le_bytes()));
        self.accessor(
            json!({"componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR"}),
            begin,
            INDICES,
        )
    }

    /// Every part has numbers of four bytes, so all of them are aligned.
    fn accessor(&mut self, mut accessor: Value, begin: usize, target: u32) -> usize {
        accessor["bufferView"] = json!(self.views.len());
        let length = self.binary.len() - begin;
        self.views.push(json!({"buffer": 0, "byteOffset": begin, "byteLength": length, "target": target}));
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// Header, text and numbers, each filled up to four bytes.
fn container(mut text: Vec<u8>, binary: Vec<u8>) -> Result<Vec<u8>, Error> {
    text.resize(text.len().next_multiple_of(4), b' ');
    let total = HEADER + 2 * CHUNK_HEADER + text.len() + binary.len();
    let number = |n: usize| {
        u32::try_from(n).map(u32::to_le_bytes).map_err(|_| Error::Unwritable {
            format: "glTF",
            place: "the file".into(),
            problem: "it would be larger than 4 GiB; write fewer surfaces to a file, or with fewer triangles".into(),
        })
    };
    let mut bytes = Vec::with_capacity(total);
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&number(2)?);
    bytes.extend_from_slice(&number(total)?);
    for (kind, chunk) in [(JSON_CHUNK, &text), (BINARY_CHUNK, &binary)] {
        bytes.extend_from_slice(&number(chunk.len())?);
        bytes.extend_from_slice(kind);
        bytes.extend_from_slice(chunk);
    }
    Ok(bytes)
}
