//! Heights as the greys of a PNG, rows from the north: black is the lowest height that the caller gives, white the highest, in equal steps between them.

use super::TerrainOptions;
use super::raster::{Plane, Raster, Stored, check_size, terraces};
use crate::error::Fault;
use fairpath_drive::Samples;
use png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};
use std::io::Cursor;

/// How every PNG begins.
pub(super) const MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Bytes that the decoder may take for itself beside the pixels: a line of the widest grid, and what it inflates with.
const OWN_BYTES: usize = 64 << 20;

/// The heights in such a picture.
pub(super) fn read(bytes: &[u8], options: &TerrainOptions) -> Result<Raster, Fault> {
    let whole = "the picture as a whole";
    let spacing = options.spacing(whole)?;
    if options.height_range_m.is_none() {
        let problem = "greys are no heights yet; give the heights of black and white (`height_range_m`)";
        return Err(Fault::new(whole, problem));
    }
    let fault = |error: DecodingError| Fault::new(whole, format_args!("{error}; is the file cut off?"));
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: OWN_BYTES });
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(Transformations::IDENTITY);
    let header = decoder.read_header_info().map_err(fault)?;
    let size = [header.width as usize, header.height as usize];
    check_size(size, &options.limits)?;
    let channels = match header.color_type {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb | ColorType::Rgba | ColorType::Indexed => {
            let problem = "it is in colours, and heights are read from greys; save it as greys of 16 bits";
            return Err(Fault::new(whole, problem));
        }
    };
    let depth = header.bit_depth;
    if !matches!(depth, BitDepth::Eight | BitDepth::Sixteen) {
        let problem = format!("it has {} bits for a grey; save it as greys of 16 bits", depth as u8);
        return Err(Fault::new(whole, problem));
    }
    let mut reader = decoder.read_info().map_err(fault)?;
    let Some(length) = reader.output_buffer_size() else {
        return Err(Fault::new(whole, "it is too large for this machine"));
    };
    let mut pixels = vec![0; length];
    reader.next_frame(&mut pixels).map_err(fault)?;
    // One grey may stand for what is transparent.
    let clear = reader.info().trns.as_deref().and_then(|grey| Some(u16::from_be_bytes(*grey.first_chunk()?)));
    let white = if depth == BitDepth::Eight { 255.0 } else { 65_535.0 };
    let greys: Vec<u16> = match depth {
        BitDepth::Eight => pixels.iter().map(|&grey| grey.into()).collect(),
        _ => pixels.as_chunks::<2>().0.iter().map(|&pair| u16::from_be_bytes(pair)).collect(),
    };
    let height = |pixel: &[u16]| {
        let grey = f64::from(pixel[0]);
        let is_void = clear == Some(pixel[0]) || pixel.get(1) == Some(&0) || options.void_value == Some(grey);
        if is_void { f32::NAN } else { options.height(grey, Some([0.0, white])) as f32 }
    };
    let samples = greys.chunks_exact(channels).map(height).collect();
    let mut warnings = Vec::new();
    if depth == BitDepth::Eight {
        warnings
            .push(terraces((options.height(1.0, Some([0.0, white])) - options.height(0.0, Some([0.0, white]))).abs()));
    }
    Stored::from_north(size, spacing).raster(Samples::F32(samples), Plane::Local, warnings)
}
