//! Every format by files made here: what went in comes out, where it should.

use super::codes;
use super::tiffs::{Tags, big_tiff, tiff};
use fairpath_curve::Point;
use fairpath_io::{
    Error, RawLayout, RawSample, TerrainFile, TerrainFormat, TerrainOptions, point_at, read_terrain_from,
};
use std::io::{Cursor, Write};
use std::path::Path;
use tiff::encoder::colortype::{Gray8, Gray16, Gray32Float, Gray64Float, GrayI16, GrayI32, RGB8};
use tiff::encoder::{Compression, DeflateLevel, Predictor};
use zip::write::SimpleFileOptions;

fn read(bytes: &[u8], name: &str, options: &TerrainOptions) -> Result<TerrainFile, Error> {
    read_terrain_from(bytes, name, None, options)
}

fn plain(bytes: &[u8], name: &str) -> TerrainFile {
    read(bytes, name, &TerrainOptions::default()).unwrap()
}

fn refusal(bytes: &[u8], name: &str, options: &TerrainOptions) -> String {
    read(bytes, name, options).unwrap_err().to_string()
}

/// Heights of a terrain by rows from the north, as files have them.
fn heights(file: &TerrainFile) -> Vec<f64> {
    let [columns, rows] = file.field.size();
    (0..rows)
        .rev()
        .flat_map(|row| (0..columns).map(move |column| [column, row]))
        .map(|at| file.field.sample(at))
        .collect()
}

const SIZE: [u32; 2] = [4, 3];

/// Twelve heights that every kind of number holds.
fn twelve() -> Vec<f64> {
    (0..12_i32).map(|i| f64::from((i * i * 7) % 120)).collect()
}

#[test]
fn tiffs_of_every_kind_of_number_and_packing_give_their_heights() {
    let expected = twelve();
    let packings = [
        Compression::Uncompressed,
        Compression::Lzw,
        Compression::Deflate(DeflateLevel::Balanced),
        Compression::Packbits,
    ];
    for packed in packings {
        let tags = Tags { packed, ..Tags::default() };
        let as_u16: Vec<u16> = expected.iter().map(|&h| h as u16).collect();
        let as_i16: Vec<i16> = expected.iter().map(|&h| h as i16).collect();
        let as_i32: Vec<i32> = expected.iter().map(|&h| h as i32).collect();
        let as_f32: Vec<f32> = expected.iter().map(|&h| h as f32).collect();
        let files = [
            tiff::<Gray16>(SIZE, &as_u16, &tags),
            tiff::<GrayI16>(SIZE, &as_i16, &tags),
            tiff::<GrayI32>(SIZE, &as_i32, &tags),
            tiff::<Gray32Float>(SIZE, &as_f32, &tags),
            tiff::<Gray64Float>(SIZE, &expected, &tags),
            big_tiff::<Gray32Float>(SIZE, &as_f32, &tags),
        ];
        for bytes in files {
            let file = plain(&bytes, "without an extension");
            assert_eq!((file.field.size(), heights(&file)), ([4, 3], expected.clone()));
            assert!(file.warnings.is_empty(), "{:?}", file.warnings);
            let georeference = file.georeference.unwrap();
            // The middle of the cell in the south-west.
            assert_eq!((georeference.epsg, georeference.origin_m), (Some(32_631), [500_005.0, 4_699_950.0]));
            assert_eq!((file.field.spacing_m().x, file.field.spacing_m().y), (10.0, 20.0));
        }
        let horizontal = Tags { predictor: Predictor::Horizontal, ..tags };
        assert_eq!(heights(&plain(&tiff::<Gray16>(SIZE, &as_u16, &horizontal), "x")), expected);
    }
}

#[test]
fn eight_bits_show_as_terraces_and_that_is_said() {
    let bytes = tiff::<Gray8>(SIZE, &twelve().iter().map(|&h| h as u8).collect::<Vec<_>>(), &Tags::default());
    let file = plain(&bytes, "x.tif");
    assert_eq!((heights(&file), codes(&file)), (twelve(), vec!["terraces"]));
    assert!(file.warnings[0].text.contains("steps of 1.000 m"), "{}", file.warnings[0].text);
    let mut options = TerrainOptions::default();
    options.height_range_m = Some([100.0, 610.0]);
    let file = read(&bytes, "x.tif", &options).unwrap();
    assert!(file.warnings[0].text.contains("steps of 2.000 m"), "{}", file.warnings[0].text);
    assert_eq!(file.field.sample([0, 2]), 100.0);
}

#[test]
fn points_areas_feet_and_matrices_put_a_tiff_where_it_belongs() {
    let heights32: Vec<f32> = twelve().iter().map(|&h| h as f32).collect();
    let at = |tags: &Tags| {
        let file = plain(&tiff::<Gray32Float>(SIZE, &heights32, tags), "x");
        let georeference = file.georeference.clone().unwrap();
        (georeference.origin_m, georeference.epsg, file)
    };
    let points = Tags { keys: vec![[1024, 1], [1025, 2], [3072, 32_631]], ..Tags::default() };
    assert_eq!(at(&points).0, [500_000.0, 4_699_960.0]);
    // Tied by another cell than the first.
    let tied = Tags { tie: Some([2.0, 1.0, 0.0, 500_000.0, 4_700_000.0, 0.0]), ..Tags::default() };
    assert_eq!(at(&tied).0, [499_985.0, 4_699_970.0]);
    let mut matrix = [0.0; 16];
    (matrix[0], matrix[3], matrix[5], matrix[7], matrix[15]) = (10.0, 500_000.0, -20.0, 4_700_000.0, 1.0);
    let by_matrix = Tags { scale: None, tie: None, matrix: Some(matrix), ..Tags::default() };
    assert_eq!(at(&by_matrix).0, [500_005.0, 4_699_950.0]);
    // Rows from the south.
    matrix[5] = 20.0;
    let (origin, _, file) = at(&Tags { matrix: Some(matrix), ..by_matrix.clone() });
    assert_eq!((origin, file.field.sample([1, 0])), ([500_005.0, 4_700_010.0], 7.0));
    matrix[1] = 1.0;
    let turned = tiff::<Gray32Float>(SIZE, &heights32, &Tags { matrix: Some(matrix), ..by_matrix });
    let said = refusal(&turned, "x.tif", &TerrainOptions::default());
    assert!(said.contains("turn it upright"), "{said}");

    // A plane of California, in feet of surveys, heights in feet too.
    let foot = 1200.0 / 3937.0;
    let feet = Tags { keys: vec![[1024, 1], [3072, 2225], [4099, 9003]], ..Tags::default() };
    let (origin, epsg, file) = at(&feet);
    assert!((origin[0] - 500_005.0 * foot).abs() < 1e-6 && epsg.is_none());
    assert!((file.field.spacing_m().y - 20.0 * foot).abs() < 1e-9);
    assert!((file.field.sample([1, 2]) - 7.0 * foot).abs() < 1e-6);
    // The place of a point in that plane in feet, PROJ 9: (-121, 40) is at (6841823.5978, 1884884.5108).
    let georeference = file.georeference.unwrap();
    let point = point_at(&georeference, [-121.0, 40.0]).unwrap();
    assert!((point.x + origin[0] - 6_841_823.597_8 * foot).abs() < 1e-3, "{point:?}");
    assert!((point.y + origin[1] - 1_884_884.510_8 * foot).abs() < 1e-3, "{point:?}");
}

#[test]
fn what_stands_for_no_height_is_filled_however_it_is_told() {
    let mut numbers: Vec<f32> = vec![50.0; 12];
    numbers[5] = -3.402_823e38;
    let told = |void| Tags { void, ..Tags::default() };
    // With as few digits as some programs print.
    for void in ["-3.40282306074e+38", "-3.402823e+38 "] {
        let file = plain(&tiff::<Gray32Float>(SIZE, &numbers, &told(Some(void))), "x");
        assert_eq!((heights(&file), file.voids.filled, codes(&file)), (vec![50.0; 12], 1, vec!["voids-filled"]));
    }
    let said = refusal(&tiff::<Gray32Float>(SIZE, &numbers, &told(None)), "x", &TerrainOptions::default());
    assert!(said.contains("column 1, row 1") && said.contains("`void_value`"), "{said}");
    let said = refusal(&tiff::<Gray32Float>(SIZE, &numbers, &told(Some("none"))), "x", &TerrainOptions::default());
    assert!(said.contains("GDAL_NODATA"), "{said}");
    numbers[5] = f32::NAN;
    assert_eq!(plain(&tiff::<Gray32Float>(SIZE, &numbers, &told(Some("nan"))), "x").voids.filled, 1);
    let words: Vec<i16> = (0..12).map(|i| if i < 3 { i16::MIN } else { 9 }).collect();
    let file = plain(&tiff::<GrayI16>(SIZE, &words, &told(None)), "x");
    assert_eq!((heights(&file), codes(&file)), (vec![9.0; 12], vec!["void-assumed", "voids-filled"]));
    let said = refusal(&tiff::<GrayI16>(SIZE, &[7; 12], &told(Some("7"))), "x", &TerrainOptions::default());
    assert!(said.contains("every sample is a void"), "{said}");
}

#[test]
fn scale_offset_and_unit_of_gdal_are_heeded_and_the_caller_more() {
    let metadata = "<GDALMetadata><Item name=\"OFFSET\" sample=\"0\" role=\"offset\">100</Item><Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.5</Item>\
        <Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">ft</Item><Item name=\"SCALE\" sample=\"1\" role=\"scale\">9</Item></GDALMetadata>";
    let bytes = tiff::<Gray16>(SIZE, &[400; 12], &Tags { metadata: Some(metadata), ..Tags::default() });
    assert!((plain(&bytes, "x").field.sample([0, 0]) - 300.0 * 0.3048).abs() < 1e-5);
    let mut options = TerrainOptions::default();
    options.height_unit_m = Some(1.0);
    assert_eq!(read(&bytes, "x", &options).unwrap().field.sample([0, 0]), 300.0);
    let torn = tiff::<Gray16>(SIZE, &[400; 12], &Tags { metadata: Some("<GDALMetadata>"), ..Tags::default() });
    assert_eq!(codes(&plain(&torn, "x")), ["metadata-unread"]);
}

#[test]
fn a_tiff_in_degrees_is_projected_wherever_its_degrees_are_counted_from() {
    // Heights are 1000 m at 10.5° E and a metre more for each thousandth of a degree.
    let side = 41;
    let numbers: Vec<f32> = (0..side * side).map(|i| 1000.0 + (i % side) as f32 * 2.5 - 50.0).collect();
    let tags = |west: f64| Tags {
        keys: vec![[1024, 2], [1025, 2], [2048, 4326]],
        scale: Some([0.0025, 0.0025, 0.0]),
        tie: Some([0.0, 0.0, 0.0, west, 47.05, 0.0]),
        ..Tags::default()
    };
    for west in [10.45, 370.45, -349.55] {
        let bytes = tiff::<Gray32Float>([side as u32; 2], &numbers, &tags(west));
        let file = plain(&bytes, "x");
        assert_eq!(codes(&file), ["projected"]);
        let georeference = file.georeference.as_ref().unwrap();
        assert_eq!(georeference.epsg, Some(32_632));
        for longitude in [10.46, 10.5, 10.53] {
            let point = point_at(georeference, [longitude, 47.0]).unwrap();
            assert!(file.field.contains(point));
            let height = file.field.height(point);
            assert!((height - 1000.0 - 1000.0 * (longitude - 10.5)).abs() < 0.05, "{longitude}: {height}");
        }
    }
    // Without a word about degrees.
    let silent = tiff::<Gray32Float>([side as u32; 2], &numbers, &Tags { keys: vec![], ..tags(10.45) });
    let said = refusal(&silent, "x", &TerrainOptions::default());
    assert!(said.contains("look like degrees"), "{said}");
    let mut options = TerrainOptions::default();
    options.epsg = Some(4326);
    assert_eq!(read(&silent, "x", &options).unwrap().georeference.unwrap().epsg, Some(32_632));
}

#[test]
fn a_tiff_that_does_not_say_where_it_lies_needs_its_spacing() {
    let bare = Tags { keys: vec![], scale: None, tie: None, ..Tags::default() };
    let bytes = tiff::<Gray16>(SIZE, &[u16::MAX; 12], &bare);
    let mut options = TerrainOptions::default();
    assert!(refusal(&bytes, "x", &options).contains("`spacing_m`"));
    options.spacing_m = Some(0.005);
    options.height_range_m = Some([-5.0, 20.0]);
    let file = read(&bytes, "x", &options).unwrap();
    assert_eq!((file.field.spacing_m().x, file.field.sample([2, 1])), (0.005, 20.0));
    assert_eq!(codes(&file), ["no-georeference"]);
    let said = refusal(&tiff::<RGB8>(SIZE, &[1; 36], &bare), "x", &options);
    assert!(said.contains("picture in colours"), "{said}");
}

#[test]
fn pictures_in_greys_of_sixteen_and_eight_bits_are_read_and_colours_refused() {
    let png = |color: png::ColorType, depth: png::BitDepth, pixels: &[u8]| {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
        encoder.set_color(color);
        encoder.set_depth(depth);
        encoder.write_header().unwrap().write_image_data(pixels).unwrap();
        bytes
    };
    let mut options = TerrainOptions::default();
    options.spacing_m = Some(2.0);
    options.height_range_m = Some([0.0, 655.35]);
    let sixteen: Vec<u8> = [0_u16, 100, 200, 300, 400, 65_535].iter().flat_map(|grey| grey.to_be_bytes()).collect();
    let file = read(&png(png::ColorType::Grayscale, png::BitDepth::Sixteen, &sixteen), "x", &options).unwrap();
    for (found, expected) in heights(&file).iter().zip([0.0, 1.0, 2.0, 3.0, 4.0, 655.35]) {
        assert!((found - expected).abs() < 1e-4);
    }
    assert!(file.warnings.is_empty());
    let clear = [10, 255, 10, 255, 99, 0, 10, 255, 10, 255, 10, 255];
    let file = read(&png(png::ColorType::GrayscaleAlpha, png::BitDepth::Eight, &clear), "x", &options).unwrap();
    assert_eq!((file.voids.filled, codes(&file)), (1, vec!["terraces", "voids-filled"]));
    assert!(file.warnings[0].text.contains("steps of 2.570 m"), "{}", file.warnings[0].text);
    let said = refusal(&png(png::ColorType::Rgb, png::BitDepth::Eight, &[7; 18]), "x", &options);
    assert!(said.contains("greys of 16 bits"), "{said}");
}

#[test]
fn ascii_grids_lie_by_their_corner_or_middle_and_mistakes_are_named_by_line() {
    let grid = |corner: &str| format!("NCOLS 3\nnrows 2\n{corner}\ncellsize 10\nNODATA_value -1\n\n1 2 -1\n4 5e0\n6\n");
    let file = plain(grid("xllcorner 1000\r\nyllcorner 2000").as_bytes(), "x.asc");
    assert_eq!((file.field.sample([0, 1]), file.field.sample([2, 0])), (1.0, 6.0));
    assert_eq!((file.voids.filled, file.georeference), (1, None));
    let mut options = TerrainOptions::default();
    options.epsg = Some(32_631);
    let origin = |corner: &str| read(grid(corner).as_bytes(), "x", &options).unwrap().georeference.unwrap().origin_m;
    assert_eq!(origin("xllcorner 1000\nyllcorner 2000"), [1005.0, 2005.0]);
    assert_eq!(origin("xllcenter 1000\nyllcenter 2000"), [1000.0, 2000.0]);
    for (text, said) in [
        ("ncols 3\nnrows 2\ncellsize 1\n1 2 3 4 5 6", "xllcorner or xllcenter is missing"),
        ("ncols 3\nrows 2\n", "line 2: \"rows 2\""),
        ("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 five 6", "line 7: \"five\""),
        ("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5", "there are 5"),
        ("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5 6 7", "line 7: there are more"),
        ("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 inf 6", "column 1, row 0"),
        ("ncols 3\nnrows 2\nxllcorner 7\nyllcorner 44\ncellsize 0.0008\n1 2 3\n4 5 6", "look like degrees"),
        ("ncols 3000000\nnrows 2000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1", "`max_terrain_samples`"),
        ("ncols 1\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2", "at least 2 × 2"),
    ] {
        let found = refusal(text.as_bytes(), "x.asc", &TerrainOptions::default());
        assert!(found.contains(said), "{found} without {said}");
    }
}

#[test]
fn bare_numbers_are_what_the_caller_says() {
    let mut options = TerrainOptions::default();
    options.spacing_m = Some(5.0);
    let expected = [1.0, -2.0, 3.0, 4.0, 500.0, 6.0];
    for sample in [RawSample::I16, RawSample::F32] {
        for big_endian in [false, true] {
            options.raw = Some(RawLayout { columns: 3, rows: 2, sample, big_endian });
            let bytes: Vec<u8> = expected
                .iter()
                .flat_map(|&h| {
                    let mut bytes = match sample {
                        RawSample::F32 => (h as f32).to_le_bytes().to_vec(),
                        _ => (h as i16).to_le_bytes().to_vec(),
                    };
                    if big_endian {
                        bytes.reverse();
                    }
                    bytes
                })
                .collect();
            let file = read(&bytes, "x.raw", &options).unwrap();
            assert_eq!((heights(&file), file.field.spacing_m().y), (expected.to_vec(), 5.0));
            assert!(refusal(&bytes[1..], "x.raw", &options).contains("is it cut off"));
        }
    }
    options.raw = Some(RawLayout { columns: 2, rows: 2, sample: RawSample::U16, big_endian: false });
    options.height_range_m = Some([0.0, 100.0]);
    let file = read(&[0xff, 0xff, 0, 0, 0, 0, 0xff, 0xff], "x.r16", &options).unwrap();
    assert_eq!(heights(&file), [100.0, 0.0, 0.0, 100.0]);
    options.raw = None;
    assert!(refusal(&[0; 8], "x.raw", &options).contains("(`raw`)"));
}

#[test]
fn an_archive_gives_the_one_terrain_in_it() {
    let zip = |files: &[(&str, &[u8])]| {
        let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
        for (name, bytes) in files {
            archive.start_file(*name, SimpleFileOptions::default()).unwrap();
            archive.write_all(bytes).unwrap();
        }
        archive.finish().unwrap().into_inner()
    };
    let text = b"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4";
    let file = plain(&zip(&[("readme.txt", b"hello"), ("a/b.asc", text)]), "x.zip");
    assert_eq!(heights(&file), [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(plain(&zip(&[("grid", text)]), "x.zip").field.size(), [2, 2]);
    // A sheet is found by the name in the archive, whatever the archive's.
    let mut flat = vec![0; 2 * 1201 * 1201];
    flat[1] = 7;
    let file = plain(&zip(&[("S01W079.hgt", &flat)]), "download");
    assert_eq!(file.georeference.as_ref().unwrap().epsg, Some(32_717));
    let middle = point_at(file.georeference.as_ref().unwrap(), [-78.5, -0.5]).unwrap();
    assert!(file.field.contains(middle) && file.field.height(Point::ZERO) == 0.0);
    let none = TerrainOptions::default();
    assert!(refusal(&zip(&[("a.asc", text), ("b.asc", text)]), "x.zip", &none).contains("2 terrains among its 2"));
    assert!(refusal(&zip(&[]), "x.zip", &none).contains("0 terrains"));
    let whole = zip(&[("a.asc", text)]);
    assert!(refusal(&whole[..whole.len() / 2], "x.zip", &none).contains("archive"));
    let mut small = TerrainOptions::default();
    small.limits.max_bytes = 1000;
    assert!(refusal(&zip(&[("a.hgt", &flat[..100_000])]), "x.zip", &small).contains("`max_bytes`"));
}

#[test]
fn the_content_tells_more_than_the_name() {
    let bytes = tiff::<Gray16>(SIZE, &[9; 12], &Tags::default());
    assert_eq!(plain(&bytes, "x.hgt").field.size(), [4, 3]);
    assert_eq!(TerrainFormat::from_content(b"II*\0"), Some(TerrainFormat::GeoTiff));
    for (bytes, said) in [(&b""[..], "the file is empty"), (b"hello", "no known extension")] {
        let error = refusal(bytes, "x", &TerrainOptions::default());
        assert!(error.contains(said) && error.contains("SRTM"), "{error}");
    }
    assert!(refusal(b"", "N42E001.hgt", &TerrainOptions::default()).contains("empty"));
}

#[test]
fn files_that_gdal_wrote_are_read_whatever_their_layout() {
    // 20 by 18 samples in tiles of 16, 100 m in the north-west, 3 m more for each column and 2 m less for each row; GDAL 3.10 wrote them.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds/terrain");
    let seed = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let height = |i: usize| 100.0 + 3.0 * (i % 20) as f64 - 2.0 * (i / 20) as f64;
    for (name, said) in [
        ("tiles-f32-predictor.tif", &[][..]),
        ("tiles-u16-predictor-lzw.tif", &[]),
        ("bands-planar-i16.tif", &["several-bands"]),
        ("bands-pixel-i32.tif", &["several-bands"]),
        ("big-f64-packbits.tif", &[]),
        ("big-endian-f32.tif", &[]),
        ("feet-f32.tif", &[]),
        ("points-f32.tif", &[]),
    ] {
        let file = plain(&seed(name), name);
        assert_eq!((file.field.size(), codes(&file)), ([20, 18], said.to_vec()), "{name}");
        assert!(heights(&file).iter().enumerate().all(|(i, &h)| h == height(i)), "{name}: {:?}", heights(&file));
        assert!(file.georeference.is_some(), "{name}");
    }
    let scaled = plain(&seed("scaled-u8.tif"), "x");
    assert!(heights(&scaled).iter().enumerate().all(|(i, &h)| h == (height(i) - 60.0) * 0.5 - 10.0));
    assert!(scaled.warnings[0].text.contains("steps of 0.500 m"), "{:?}", scaled.warnings);
    // The tile in the north-west has no height at all, and is not in the file.
    let sparse = plain(&seed("sparse-f32.tif"), "x");
    assert_eq!(sparse.voids.filled, 256);
    assert!(heights(&sparse).iter().enumerate().all(|(i, &h)| h == height(i) || i % 20 < 16 && i / 20 < 16));
    let degrees = plain(&seed("degrees-f32.tif"), "x");
    assert_eq!(degrees.georeference.unwrap().epsg, Some(32_615));
}
