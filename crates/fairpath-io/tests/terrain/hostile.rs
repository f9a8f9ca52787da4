//! Bytes that nobody should trust: read or refused, within the limits, and nothing falls over.

use super::tiffs::{Tags, tiff};
use fairpath_io::{RawLayout, RawSample, TerrainFormat, TerrainOptions, read_terrain_from};
use proptest::prelude::*;
use proptest::sample::Index;
use tiff::encoder::colortype::{Gray16, Gray32Float};
use tiff::encoder::{Compression, DeflateLevel};

/// Options with which every format can be read, and small limits.
fn options() -> TerrainOptions {
    let mut options = TerrainOptions::default();
    options.limits.max_terrain_samples = 100_000;
    options.limits.max_bytes = 1 << 20;
    options.spacing_m = Some(10.0);
    options.height_range_m = Some([0.0, 100.0]);
    options.raw = Some(RawLayout { columns: 4, rows: 3, sample: RawSample::F32, big_endian: false });
    options
}

/// Reads it; what is read is a terrain within the limits.
fn tried(bytes: &[u8], format: Option<TerrainFormat>) -> bool {
    let options = options();
    match read_terrain_from(bytes, "N42E001", format, &options) {
        Ok(file) => {
            let samples = file.field.samples();
            assert!(samples.len() as u64 <= options.limits.max_terrain_samples);
            assert!((0..samples.len()).all(|i| samples.get(i).is_finite()));
            true
        }
        Err(error) => {
            let said = error.to_string();
            assert!(said.len() < 1000, "{said}");
            false
        }
    }
}

/// Whole files to be damaged.
fn wholes() -> Vec<Vec<u8>> {
    let numbers: Vec<f32> = (0..48).map(|i| i as f32 * 1.5).collect();
    let degrees = Tags {
        keys: vec![[1024, 2], [1025, 2], [2048, 4326]],
        scale: Some([0.001, 0.001, 0.0]),
        tie: Some([0.0, 0.0, 0.0, 10.0, 47.0, 0.0]),
        packed: Compression::Deflate(DeflateLevel::Balanced),
        ..Tags::default()
    };
    let metadata = "<GDALMetadata><Item role=\"scale\">2</Item></GDALMetadata>";
    let lzw = Tags { packed: Compression::Lzw, void: Some("3"), metadata: Some(metadata), ..Tags::default() };
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 4, 3);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.write_header().unwrap().write_image_data(&[7; 24]).unwrap();
    let text = b"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value 4\n1 2 3 4".to_vec();
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    archive.start_file("a.asc", zip::write::SimpleFileOptions::default()).unwrap();
    std::io::Write::write_all(&mut archive, &text).unwrap();
    vec![
        tiff::<Gray32Float>([8, 6], &numbers, &Tags::default()),
        tiff::<Gray32Float>([8, 6], &numbers, &degrees),
        tiff::<Gray16>([8, 6], &[3; 48], &lzw),
        png,
        text,
        archive.finish().unwrap().into_inner(),
    ]
}

#[test]
fn whole_files_are_read_and_every_one_that_is_cut_off_is_refused_or_read() {
    for (i, whole) in wholes().iter().enumerate() {
        // The third is void all over.
        assert_eq!(tried(whole, None), i != 2, "{i}");
        for length in 0..whole.len() {
            tried(&whole[..length], None);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn damaged_files_are_read_or_refused(
        which in any::<Index>(),
        damage in prop::collection::vec((any::<Index>(), prop_oneof![any::<u8>(), Just(0_u8), Just(255_u8)]), 1..12),
    ) {
        let wholes = wholes();
        let mut bytes = which.get(&wholes).clone();
        for (at, value) in damage {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        tried(&bytes, None);
    }

    #[test]
    fn any_bytes_are_read_or_refused_as_any_format(bytes in prop::collection::vec(any::<u8>(), 0..400), which in any::<Index>()) {
        tried(&bytes, Some(*which.get(&TerrainFormat::ALL)));
    }

    #[test]
    fn any_grid_of_text_is_read_or_refused(text in "(ncols|nrows|xllcorner|yllcenter|cellsize|dx|NODATA_value| |\n|[0-9.eE+-]{1,5}|nan|inf){0,40}") {
        tried(format!("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n{text}").as_bytes(), None);
        tried(format!("ncols {text}").as_bytes(), None);
    }
}
