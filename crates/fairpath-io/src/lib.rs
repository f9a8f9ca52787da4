//! Readers and writers of strokes and clothoid splines.

mod atomic;
mod drawable;
mod error;
mod input;
mod limits;
pub mod picture;
mod schema;
mod spline_csv;
mod spline_dxf;
mod spline_file;
mod spline_json;
mod spline_svg;
mod splines;
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
pub use schema::{spline_schema, strokes_schema};
pub use spline_dxf::{DxfEntities, DxfOptions};
pub use spline_file::{Failure, Milliseconds, SplineEntry, SplineFile, SplineReport};
pub use splines::{
    Encoded, SplineFormat, WriteOptions, encode_splines, read_splines, read_splines_from, write_splines,
};
pub use stroke_file::StrokeFile;
pub use strokes::{StrokeFormat, encode_strokes, read_strokes, read_strokes_from, write_strokes};
pub use unit::{Unit, YAxis};
