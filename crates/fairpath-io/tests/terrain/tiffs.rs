//! Small TIFFs with tags of GeoTIFF, for the tests.

use std::io::Cursor;
use tiff::encoder::colortype::ColorType;
use tiff::encoder::{Compression, Predictor, TiffEncoder, TiffKind, TiffValue};
use tiff::tags::Tag;

/// What such a file says beside its numbers.
#[derive(Clone)]
pub(crate) struct Tags {
    /// Pairs of key and number.
    pub(crate) keys: Vec<[u16; 2]>,
    pub(crate) scale: Option<[f64; 3]>,
    pub(crate) tie: Option<[f64; 6]>,
    pub(crate) matrix: Option<[f64; 16]>,
    pub(crate) void: Option<&'static str>,
    pub(crate) metadata: Option<&'static str>,
    pub(crate) packed: Compression,
    pub(crate) predictor: Predictor,
    pub(crate) rows_per_strip: u32,
}

impl Default for Tags {
    /// UTM zone 31, cells of 10 m by 20 m, the corner of the first one at (500 000, 4 700 000).
    fn default() -> Self {
        Self {
            keys: vec![[1024, 1], [1025, 1], [3072, 32_631]],
            scale: Some([10.0, 20.0, 0.0]),
            tie: Some([0.0, 0.0, 0.0, 500_000.0, 4_700_000.0, 0.0]),
            matrix: None,
            void: None,
            metadata: None,
            packed: Compression::Uncompressed,
            predictor: Predictor::None,
            rows_per_strip: 2,
        }
    }
}

/// The bytes of such a file.
pub(crate) fn tiff<C: ColorType>(size: [u32; 2], numbers: &[C::Inner], tags: &Tags) -> Vec<u8>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    write::<C, _>(TiffEncoder::new(&mut bytes).unwrap(), size, numbers, tags);
    bytes.into_inner()
}

/// The bytes of such a file as BigTIFF.
pub(crate) fn big_tiff<C: ColorType>(size: [u32; 2], numbers: &[C::Inner], tags: &Tags) -> Vec<u8>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    write::<C, _>(TiffEncoder::new_big(&mut bytes).unwrap(), size, numbers, tags);
    bytes.into_inner()
}

fn write<C: ColorType, K: TiffKind>(
    encoder: TiffEncoder<&mut Cursor<Vec<u8>>, K>,
    size: [u32; 2],
    numbers: &[C::Inner],
    tags: &Tags,
) where
    [C::Inner]: TiffValue,
{
    let mut encoder = encoder.with_compression(tags.packed).with_predictor(tags.predictor);
    let mut image = encoder.new_image::<C>(size[0], size[1]).unwrap();
    image.rows_per_strip(tags.rows_per_strip).unwrap();
    let directory = image.encoder();
    if !tags.keys.is_empty() {
        let mut keys = vec![1_u16, 1, 0, tags.keys.len() as u16];
        tags.keys.iter().for_each(|&[key, value]| keys.extend([key, 0, 1, value]));
        directory.write_tag(Tag::GeoKeyDirectoryTag, &keys[..]).unwrap();
    }
    let doubles = [
        (Tag::ModelPixelScaleTag, tags.scale.map(|s| s.to_vec())),
        (Tag::ModelTiepointTag, tags.tie.map(|t| t.to_vec())),
        (Tag::ModelTransformationTag, tags.matrix.map(|m| m.to_vec())),
    ];
    for (tag, value) in doubles {
        if let Some(value) = value {
            directory.write_tag(tag, &value[..]).unwrap();
        }
    }
    for (tag, text) in [(Tag::GdalNodata, tags.void), (Tag::Unknown(42_112), tags.metadata)] {
        if let Some(text) = text {
            directory.write_tag(tag, text).unwrap();
        }
    }
    image.write_data(numbers).unwrap();
}
