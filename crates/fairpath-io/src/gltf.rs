//! The binary container of glTF 2.0: arrays of numbers as accessors, and header, text and numbers as one file.
//! Reference: Khronos Group, "glTF 2.0 Specification" (2021).

use crate::error::Error;
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

/// Numbers, and how a document refers to them.
#[derive(Default)]
pub(crate) struct Buffers {
    /// All numbers.
    pub(crate) binary: Vec<u8>,
    /// Where each array lies among them.
    pub(crate) views: Vec<Value>,
    /// What each array is.
    pub(crate) accessors: Vec<Value>,
}

impl Buffers {
    /// Adds an accessor for vectors and gives its number; bounds are told only where the specification asks for them.
    pub(crate) fn vectors(&mut self, vectors: &[[f32; 3]], bounded: bool) -> usize {
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

    /// Adds an accessor for the corners of triangles and gives its number.
    pub(crate) fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
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
pub(crate) fn container(mut text: Vec<u8>, binary: Vec<u8>) -> Result<Vec<u8>, Error> {
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
