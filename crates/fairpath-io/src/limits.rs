//! How much of a file is believed before it is refused.

/// Bounds on what a reader takes in, so that a hostile or broken file costs bounded time and memory.
///
/// The defaults let through any drawing that a person made and most that a program did.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Limits {
    /// Largest file, bytes, and most bytes of SVG attributes where each use of an element counts anew; text strokes (CSV), which are
    /// read as a stream, may be longer. Default 512 MiB.
    pub max_bytes: u64,
    /// Longest line of a text or CSV file, bytes. Default 1 MiB.
    pub max_line_bytes: u64,
    /// Most points of all strokes of a file together, those from flattened curves included. Default 20 million.
    pub max_points: u64,
    /// Most strokes, splines or failures of a file. Default one million.
    pub max_items: u64,
    /// Most French curves of a set. Default 1000: a stroke is compared with each of them.
    pub max_templates: u64,
    /// Most XML nodes (elements, texts, comments) of an SVG or InkML file, each use of an element counted. Default four million.
    pub max_nodes: u64,
    /// Deepest nesting of SVG elements, references by `use` included. Default 256.
    pub max_depth: u64,
    /// Most samples of a terrain, before and after it is projected. Default 2²⁷, 512 MiB in single precision: ten sheets of SRTM at 1″.
    pub max_terrain_samples: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            max_bytes: 512 << 20,
            max_line_bytes: 1 << 20,
            max_points: 20_000_000,
            max_items: 1_000_000,
            max_templates: 1000,
            max_nodes: 4_000_000,
            max_depth: 256,
            max_terrain_samples: 1 << 27,
        }
    }
}

/// How to read.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReadOptions {
    /// Bounds on the input.
    pub limits: Limits,
    /// Largest distance between a curve of an SVG and the points that stand for it, in the file's unit; never finer than
    /// 1e-9 of the curve's size. Default 0.01.
    pub flatten_tolerance: f64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { limits: Limits::default(), flatten_tolerance: 0.01 }
    }
}
