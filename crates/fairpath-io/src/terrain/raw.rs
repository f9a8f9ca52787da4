//! Bare numbers, `.raw`: rows from the north, each from the west, with nothing before or after them. What they are is said by the caller.

use super::TerrainOptions;
use super::raster::{Plane, Raster, Stored, check_size};
use crate::error::Fault;
use fairpath_drive::{RawLayout, RawSample, Samples};

/// The heights in such a file.
pub(super) fn read(bytes: &[u8], options: &TerrainOptions) -> Result<Raster, Fault> {
    let whole = "the file as a whole";
    let Some(layout) = &options.raw else {
        let problem =
            "bare numbers do not say how many there are; give columns, rows, kind of number and order of bytes (`raw`)";
        return Err(Fault::new(whole, problem));
    };
    let spacing = options.spacing(whole)?;
    let size = [layout.columns, layout.rows];
    let count = check_size(size, &options.limits)?;
    let width = layout.sample.bytes();
    if bytes.len() != count * width {
        let problem = format!(
            "there are {} bytes, and {} × {} samples of {width} bytes are {}; is it cut off, or is its size another?",
            bytes.len(),
            size[0],
            size[1],
            count * width
        );
        return Err(Fault::new(whole, problem));
    }
    let is_single = layout.sample == RawSample::F32;
    let height = |value: f64, whole: Option<[f64; 2]>| {
        if options.is_void(value, is_single) { f32::NAN } else { options.height(value, whole) as f32 }
    };
    let samples = numbers(bytes, layout, height);
    Stored::from_north(size, spacing).raster(Samples::F32(samples), Plane::Local, Vec::new())
}

/// Each number as a height; beside it the range of numbers that whole ones have.
fn numbers(bytes: &[u8], layout: &RawLayout, height: impl Fn(f64, Option<[f64; 2]>) -> f32) -> Vec<f32> {
    let pairs = || bytes.as_chunks::<2>().0.iter().map(|&b| if layout.big_endian { [b[1], b[0]] } else { b });
    match layout.sample {
        RawSample::U16 => pairs().map(|b| height(u16::from_le_bytes(b).into(), Some([0.0, 65_535.0]))).collect(),
        RawSample::I16 => {
            let range = Some([i16::MIN, i16::MAX].map(f64::from));
            pairs().map(|b| height(i16::from_le_bytes(b).into(), range)).collect()
        }
        RawSample::F32 => {
            let number = |b| if layout.big_endian { f32::from_be_bytes(b) } else { f32::from_le_bytes(b) };
            bytes.as_chunks::<4>().0.iter().map(|&b| height(number(b).into(), None)).collect()
        }
    }
}
