//! TIFF and GeoTIFF: heights in strips or tiles, packed or not, of whole numbers or fractions; and the tags that say where they lie (OGC 19-008r4) and what
//! GDAL adds to them: the number that stands for no height, scale, offset and unit.

use super::TerrainOptions;
use super::epsg;
use super::geokeys::{Described, GeoKeys};
use super::raster::{Plane, Raster, Stored, check_size, excerpt};
use super::tiff_samples::{Meaning, heights};
use crate::error::Fault;
use fairpath_fit::Warning;
use std::io::Cursor;
use tiff::decoder::{Decoder, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

/// How TIFF and BigTIFF begin, in both orders of bytes.
const MAGICS: [&[u8]; 4] = [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"];

/// Text in XML about the samples, by GDAL.
const GDAL_METADATA: Tag = Tag::Unknown(42_112);

/// Most of its nodes that are looked at.
const METADATA_NODES: u32 = 10_000;

/// Largest value of a tag, bytes: lists of a million strips are as long.
const TAG_BYTES: usize = 16 << 20;

/// Most images of a file that are looked at for masks.
const MOST_IMAGES: usize = 64;

/// The bit of NewSubfileType that says so.
const MASK: u32 = 4;

/// Rows that lean by less than this share of a sample over the whole raster are upright: printed numbers are no more exact.
const UPRIGHT: f64 = 0.01;

/// A TIFF that is being read.
pub(super) type Tiff<'a> = Decoder<Cursor<&'a [u8]>>;

/// Whether a file that begins like this is a TIFF.
pub(super) fn begins(head: &[u8]) -> bool {
    MAGICS.iter().any(|magic| head.starts_with(magic))
}

/// An error of the decoder.
pub(super) fn fault(error: TiffError) -> Fault {
    Fault::new("the TIFF", format_args!("{}; is the file cut off?", excerpt(error)))
}

/// The heights of the first image in such a file.
pub(super) fn read(bytes: &[u8], options: &TerrainOptions) -> Result<Raster, Fault> {
    let most = usize::try_from(options.limits.max_bytes).unwrap_or(usize::MAX);
    let mut limits = Limits::default();
    (limits.decoding_buffer_size, limits.intermediate_buffer_size, limits.ifd_value_size) = (most, most, TAG_BYTES);
    let mut tiff = Decoder::new(Cursor::new(bytes)).map_err(fault)?.with_limits(limits);
    let (width, height) = tiff.dimensions().map_err(fault)?;
    let size = [width as usize, height as usize];
    check_size(size, &options.limits)?;
    let directory = tag(&mut tiff, Tag::GeoKeyDirectoryTag, |value| value.into_u16_vec())?;
    let keys = directory.map_or(Ok(GeoKeys::default()), |directory| GeoKeys::new(&directory))?;
    let mut described = keys.described(options)?;
    let stored = match stored(&mut tiff, size, &described)? {
        Some(stored) if described.plane == Plane::Local => stored.check_metres().map(|()| stored)?,
        Some(stored) => stored,
        None => {
            if described.plane != Plane::Local {
                described.warnings.push(Stored::without_a_place());
            }
            described.plane = Plane::Local;
            Stored::from_north(size, options.spacing("the TIFF")?)
        }
    };
    let mut warnings = std::mem::take(&mut described.warnings);
    let meaning = meaning(&mut tiff, &described, options, &mut warnings)?;
    if bands(&mut tiff)? > 1 {
        let text = "there are several numbers for each sample; the first is taken for its height";
        warnings.push(Warning { code: "several-bands".into(), text: text.into() });
    }
    let samples = heights(&mut tiff, size, &meaning, options, &mut warnings)?;
    if has_mask(&mut tiff) {
        let text = "a mask in the file is not looked at: what it hides is taken for heights";
        warnings.push(Warning { code: "mask-ignored".into(), text: text.into() });
    }
    stored.raster(samples, described.plane, warnings)
}

/// The value of a tag, if it is there and of its kind.
fn tag<T>(
    tiff: &mut Tiff,
    tag: Tag,
    value: impl Fn(tiff::decoder::ifd::Value) -> Result<T, TiffError>,
) -> Result<Option<T>, Fault> {
    tiff.find_tag(tag).map_err(fault)?.map(value).transpose().map_err(fault)
}

/// How many numbers there are for each sample; pictures in colours are refused.
pub(super) fn bands(tiff: &mut Tiff) -> Result<u16, Fault> {
    match tiff.colortype().map_err(fault)? {
        ColorType::Gray(_) => Ok(1),
        ColorType::GrayA(_) => Ok(2),
        ColorType::Multiband { num_samples, .. } => Ok(num_samples),
        other => {
            let problem =
                format!("it is a picture in colours ({other:?}), and heights are read from one number a sample");
            Err(Fault::new("the TIFF", problem))
        }
    }
}

/// Where the samples lie, in metres or degrees; nothing where the file does not say.
fn stored(tiff: &mut Tiff, size: [usize; 2], described: &Described) -> Result<Option<Stored>, Fault> {
    let doubles = |value: tiff::decoder::ifd::Value| value.into_f64_vec();
    let scale = tag(tiff, Tag::ModelPixelScaleTag, doubles)?;
    let tie = tag(tiff, Tag::ModelTiepointTag, doubles)?;
    let matrix = tag(tiff, Tag::ModelTransformationTag, doubles)?;
    let unit = described.unit_m;
    // The middle of the first sample, in the raster's own numbers.
    let half = if described.is_point { 0.0 } else { 0.5 };
    let (first, step) = match (scale.as_deref(), tie.as_deref(), matrix.as_deref()) {
        (Some([across, up, ..]), Some([i, j, _, x, y, ..]), _) => {
            ([x + (half - i) * across, y - (half - j) * up], [*across, -up])
        }
        (_, _, Some([a, b, _, x, e, f, _, y, ..])) => {
            let lean = [b * size[1] as f64 / a, e * size[0] as f64 / f];
            if !lean.iter().all(|lean| lean.abs() <= UPRIGHT) {
                let problem = "its rows do not run from west to east; turn it upright, as gdalwarp does";
                return Err(Fault::new("ModelTransformation", problem));
            }
            ([x + half * (a + b), y + half * (e + f)], [*a, *f])
        }
        (None, None, None) => return Ok(None),
        _ => {
            let problem = "it is tied to the ground by single points; turn it upright, as gdalwarp does";
            return Err(Fault::new("ModelTiepoint", problem));
        }
    };
    Ok(Some(Stored { size, first: first.map(|m| m * unit), step: step.map(|m| m * unit) }))
}

/// What a number in the file means.
fn meaning(
    tiff: &mut Tiff,
    described: &Described,
    options: &TerrainOptions,
    warnings: &mut Vec<Warning>,
) -> Result<Meaning, Fault> {
    let void = match tag(tiff, Tag::GdalNodata, |value| value.into_string())? {
        Some(text) => {
            let trimmed = text.trim_matches(|c: char| c == '\0' || c.is_whitespace());
            match trimmed.parse() {
                Ok(void) => Some(void),
                Err(_) => {
                    return Err(Fault::new("GDAL_NODATA", format_args!("{:?} is not a number", excerpt(trimmed))));
                }
            }
        }
        None => None,
    };
    let mut meaning = Meaning { void, scale: 1.0, offset: 0.0, unit_m: described.height_unit_m };
    if let Some(text) = tag(tiff, GDAL_METADATA, |value| value.into_string())? {
        // All of it or nothing: a scale without its offset is worse than neither.
        match with_metadata(text.trim_end_matches('\0'), meaning) {
            Ok(told) => meaning = told,
            Err(problem) => {
                let problem = excerpt(problem);
                let text =
                    format!("what GDAL says of scale, offset and unit of the heights is not understood: {problem}");
                warnings.push(Warning { code: "metadata-unread".into(), text });
            }
        }
    }
    // The caller knows better.
    if let Some(unit) = options.height_unit_m {
        meaning.unit_m = Some(unit);
    }
    Ok(meaning)
}

/// Scale, offset and unit of the first band.
fn with_metadata(text: &str, mut meaning: Meaning) -> Result<Meaning, String> {
    let bounded = roxmltree::ParsingOptions { nodes_limit: METADATA_NODES, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(text, bounded).map_err(|error| error.to_string())?;
    for item in document.descendants().filter(|node| node.has_tag_name("Item")) {
        if item.attribute("sample").is_some_and(|sample| sample != "0") {
            continue;
        }
        let value = item.text().unwrap_or_default().trim();
        let number = || match value.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("{value:?} is not a number")),
        };
        match item.attribute("role") {
            Some("scale") => meaning.scale = number()?,
            Some("offset") => meaning.offset = number()?,
            Some("unittype") if !value.is_empty() => {
                let unit = epsg::unit_of_word_m(value).ok_or_else(|| format!("{value:?} is no unit of height"))?;
                meaning.unit_m = Some(unit);
            }
            _ => {}
        }
    }
    Ok(meaning)
}

/// Whether an image of the file says which samples of the first are meant.
fn has_mask(tiff: &mut Tiff) -> bool {
    for _ in 0..MOST_IMAGES {
        // An image of another kind, or a broken one, after the one that was read, is no reason to refuse it.
        if !tiff.more_images() || tiff.next_image().is_err() {
            return false;
        }
        let kind = tag(tiff, Tag::NewSubfileType, |value| value.into_u32()).ok().flatten();
        if kind.is_some_and(|kind| kind & MASK != 0) {
            return true;
        }
    }
    false
}
