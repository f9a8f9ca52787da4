//! Readers and writers of strokes and clothoid splines.

mod atomic;
mod error;
mod input;
mod limits;
mod stroke_file;
mod strokes;
mod strokes_inkml;
mod strokes_json;
mod strokes_svg;
mod strokes_text;
mod svg_geometry;
mod unit;
mod xml;

pub use atomic::write_whole;
pub use error::Error;
pub use limits::{Limits, ReadOptions};
pub use stroke_file::StrokeFile;
pub use strokes::{StrokeFormat, encode_strokes, read_strokes, read_strokes_from, write_strokes};
pub use unit::{Unit, YAxis};
