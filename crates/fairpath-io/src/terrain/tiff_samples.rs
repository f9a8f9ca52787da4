//! The numbers in a TIFF's strips or tiles become heights, chunk by chunk, in the rows of the file.

use super::TerrainOptions;
use super::geotiff::{Tiff, bands, fault};
use super::raster::terraces;
use crate::error::Fault;
use fairpath_drive::{MOST_HEIGHT_M, Samples};
use fairpath_fit::Warning;
use tiff::decoder::{ChunkType, DecodingResult};
use tiff::tags::{PlanarConfiguration, Tag};

/// How much a number that is no height may differ from the one that is told to stand for none: texts have fewer digits than numbers.
const LIKE_VOID: f64 = 1e-6;

/// The lowest and the highest number of 16 bits with a sign; the lowest stands for no height in nearly all that have one.
const WORDS: [f64; 2] = [i16::MIN as f64, i16::MAX as f64];

/// What a number in the file means.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meaning {
    /// Stands for no height.
    pub(super) void: Option<f64>,
    /// Units of height to the number.
    pub(super) scale: f64,
    /// The height of zero, in units.
    pub(super) offset: f64,
    /// The unit, m, if it is told.
    pub(super) unit_m: Option<f64>,
}

/// A kind of number.
#[derive(Clone, Copy, Debug, Default)]
struct Kind {
    /// The lowest and the highest, of whole numbers.
    whole: Option<[f64; 2]>,
    /// Whether single precision would lose something.
    is_long: bool,
    /// Whether numbers were rounded to single precision.
    is_single: bool,
}

impl Kind {
    fn of(numbers: &DecodingResult) -> Self {
        let whole =
            |least: f64, most: f64, is_long: bool| Self { whole: Some([least, most]), is_long, is_single: false };
        match numbers {
            DecodingResult::U8(_) => whole(0.0, u8::MAX.into(), false),
            DecodingResult::I8(_) => whole(i8::MIN.into(), i8::MAX.into(), false),
            DecodingResult::U16(_) => whole(0.0, u16::MAX.into(), false),
            DecodingResult::I16(_) => whole(WORDS[0], WORDS[1], false),
            DecodingResult::U32(_) => whole(0.0, u32::MAX.into(), true),
            DecodingResult::I32(_) => whole(i32::MIN.into(), i32::MAX.into(), true),
            DecodingResult::U64(_) => whole(0.0, u64::MAX as f64, true),
            DecodingResult::I64(_) => whole(i64::MIN as f64, i64::MAX as f64, true),
            DecodingResult::F16(_) | DecodingResult::F32(_) => Self { is_single: true, ..Self::default() },
            DecodingResult::F64(_) => Self { is_long: true, ..Self::default() },
        }
    }

    /// As many samples without a height.
    fn no_heights(self, count: usize) -> Samples {
        if self.is_long { Samples::F64(vec![f64::NAN; count]) } else { Samples::F32(vec![f32::NAN; count]) }
    }

    /// What is to be said of numbers with few bits.
    fn warning(self, meaning: &Meaning, options: &TerrainOptions) -> Option<Warning> {
        let [least, most] = self.whole.filter(|[least, most]| most - least <= 255.0)?;
        // Without the numbers that stand for none.
        let plain = Meaning { void: None, ..*meaning };
        let options = TerrainOptions { void_value: None, ..options.clone() };
        let step = plain.height(most, self, &options) - plain.height(least, self, &options);
        Some(terraces(step.abs() / (most - least)))
    }
}

impl Meaning {
    fn height(&self, value: f64, kind: Kind, options: &TerrainOptions) -> f64 {
        if self.is_void(value, kind) || options.is_void(value, kind.is_single) {
            return f64::NAN;
        }
        if kind.whole.is_some() && options.height_range_m.is_some() {
            return options.height(value, kind.whole);
        }
        (value * self.scale + self.offset) * self.unit_m.unwrap_or(1.0)
    }

    fn is_void(&self, value: f64, kind: Kind) -> bool {
        self.void.is_some_and(|void| {
            let void = if kind.is_single { f64::from(void as f32) } else { void };
            value == void || void.abs() > MOST_HEIGHT_M && (value - void).abs() <= LIKE_VOID * void.abs()
        })
    }
}

/// Heights, row by row as the file has them; NaN has none.
pub(super) fn heights(
    tiff: &mut Tiff,
    size: [usize; 2],
    meaning: &Meaning,
    options: &TerrainOptions,
    warnings: &mut Vec<Warning>,
) -> Result<Samples, Fault> {
    let (width, height) = tiff.chunk_dimensions();
    let chunk = [width as usize, height as usize];
    let across = size[0].div_ceil(chunk[0]);
    let down = size[1].div_ceil(chunk[1]);
    let tag = if tiff.get_chunk_type() == ChunkType::Tile { Tag::TileByteCounts } else { Tag::StripByteCounts };
    let lengths: Vec<u64> = tiff.find_tag_unsigned_vec(tag).map_err(fault)?.unwrap_or_default();
    // With the numbers of a tile that lie beyond the edge of the grid, by rows of the whole tile: the decoder fails on rows that it would have to cut off
    // where they are packed by LZW (image-tiff, issue 395).
    let each = numbers_each(tiff)?;
    let row_bytes = each.saturating_mul(chunk[0]).saturating_mul(sample_bytes(tiff)?);
    let mut numbers = DecodingResult::U8(Vec::new());
    let mut samples = None;
    let mut meaning = *meaning;
    let mut assumed = false;
    for i in 0..across * down {
        // GDAL leaves chunks out in which nothing has a height.
        if lengths.get(i) == Some(&0) {
            continue;
        }
        let index = u32::try_from(i).map_err(|_| Fault::new("the TIFF", "it has too many chunks"))?;
        tiff.read_chunk_to_buffer(&mut numbers, index, row_bytes).map_err(fault)?;
        let at = [(i % across) * chunk[0], (i / across) * chunk[1]];
        let block = Block { at, columns: chunk[0], each, grid: size };
        let kind = Kind::of(&numbers);
        let samples = match &mut samples {
            Some(samples) => samples,
            None => {
                warnings.extend(kind.warning(&meaning, options));
                assumed = meaning.void.is_none() && options.void_value.is_none() && kind.whole == Some(WORDS);
                if assumed {
                    meaning.void = Some(WORDS[0]);
                }
                samples.insert(kind.no_heights(size[0] * size[1]))
            }
        };
        let height = |value: f64| meaning.height(value, kind, options);
        match &numbers {
            DecodingResult::U8(numbers) => block.place(samples, numbers, |n| height(n.into())),
            DecodingResult::I8(numbers) => block.place(samples, numbers, |n| height(n.into())),
            DecodingResult::U16(numbers) => block.place(samples, numbers, |n| height(n.into())),
            DecodingResult::I16(numbers) => block.place(samples, numbers, |n| height(n.into())),
            DecodingResult::U32(numbers) => block.place(samples, numbers, |n| height(n.into())),
            DecodingResult::I32(numbers) => block.place(samples, numbers, |n| height(n.into())),
            DecodingResult::U64(numbers) => block.place(samples, numbers, |n| height(n as f64)),
            DecodingResult::I64(numbers) => block.place(samples, numbers, |n| height(n as f64)),
            DecodingResult::F16(numbers) => block.place(samples, numbers, |n| height(n.to_f64())),
            DecodingResult::F32(numbers) => block.place(samples, numbers, |n| height(n.into())),
            DecodingResult::F64(numbers) => block.place(samples, numbers, height),
        }?;
    }
    if assumed && samples.as_ref().is_some_and(|samples| (0..samples.len()).any(|i| samples.get(i).is_nan())) {
        let text = format!("samples of {} are taken for voids, though the file does not say so", WORDS[0]);
        warnings.push(Warning { code: "void-assumed".into(), text });
    }
    Ok(samples.unwrap_or_else(|| Kind::default().no_heights(size[0] * size[1])))
}

/// How many numbers a chunk has for each sample.
fn numbers_each(tiff: &mut Tiff) -> Result<usize, Fault> {
    let planes: Option<u16> = tiff.find_tag_unsigned(Tag::PlanarConfiguration).map_err(fault)?;
    let is_apart = planes == Some(PlanarConfiguration::Planar.to_u16());
    // Of several planes the chunks of the first come first.
    Ok(if is_apart { 1 } else { bands(tiff)?.into() })
}

/// How many bytes a number has.
fn sample_bytes(tiff: &mut Tiff) -> Result<usize, Fault> {
    match tiff.colortype().map_err(fault)?.bit_depth() {
        bits @ (8 | 16 | 32 | 64) => Ok(usize::from(bits / 8)),
        bits => Err(Fault::new("the TIFF", format_args!("it has {bits} bits for a height; expected 8, 16, 32 or 64"))),
    }
}

/// A chunk and the grid that it is part of.
struct Block {
    /// Column and row of its first sample.
    at: [usize; 2],
    /// Its columns, those beyond the grid included.
    columns: usize,
    /// How many numbers it has for each sample.
    each: usize,
    /// Columns and rows of the grid.
    grid: [usize; 2],
}

impl Block {
    /// Puts the heights of these numbers where they belong.
    fn place<T: Copy>(&self, samples: &mut Samples, numbers: &[T], height: impl Fn(T) -> f64) -> Result<(), Fault> {
        let width = self.columns * self.each;
        let columns = self.columns.min(self.grid[0] - self.at[0]);
        let rows = numbers.len() / width;
        if rows * width != numbers.len() || rows > self.grid[1] - self.at[1] {
            let problem = format!("a chunk of {} columns has {} numbers", self.columns, numbers.len());
            return Err(Fault::new("the TIFF", problem));
        }
        for (row, line) in numbers.chunks_exact(width).enumerate() {
            let from = (self.at[1] + row) * self.grid[0] + self.at[0];
            let first = line.iter().step_by(self.each).map(|&number| height(number));
            match samples {
                Samples::F32(samples) => {
                    samples[from..from + columns].iter_mut().zip(first).for_each(|(sample, h)| *sample = h as f32);
                }
                Samples::F64(samples) => {
                    samples[from..from + columns].iter_mut().zip(first).for_each(|(sample, h)| *sample = h);
                }
            }
        }
        Ok(())
    }
}
