//! Terrains that nobody here made, where the data folder lies beside the workspace, against what GDAL and PROJ say of them; files made here for what those do not have;
//! and files that nobody should trust.

#[path = "terrain/formats.rs"]
mod formats;
#[path = "terrain/hostile.rs"]
mod hostile;
#[path = "terrain/projection.rs"]
mod projection;
#[path = "terrain/tiffs.rs"]
mod tiffs;

use fairpath_curve::Point;
use fairpath_drive::GeoReference;
use fairpath_io::{Projector, TerrainFile, TerrainOptions, longitude_latitude, point_at, read_terrain};
use std::fs::File;
use std::io::Read;
use std::path::PathBuf;

/// A file of the data folder, if that is there.
fn data(name: &str) -> Option<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/terrain");
    if folder.is_dir() {
        return Some(folder.join(name));
    }
    assert!(std::env::var_os("CI").is_none(), "the terrains are not at {}", folder.display());
    eprintln!("skipped: the terrains are not at {}", folder.display());
    None
}

fn read(name: &str) -> Option<TerrainFile> {
    data(name).map(|path| read_terrain(&path, &TerrainOptions::default()).unwrap())
}

fn codes(file: &TerrainFile) -> Vec<&str> {
    file.warnings.iter().map(|warning| warning.code.as_str()).collect()
}

fn reference(file: &TerrainFile) -> &GeoReference {
    file.georeference.as_ref().expect("the file says where it lies")
}

/// The heights of a sheet as they are in its archive: rows from the north, -32768 for none.
fn sheet(name: &str) -> Option<Vec<i16>> {
    let mut archive = zip::ZipArchive::new(File::open(data(name)?).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_index(0).unwrap().read_to_end(&mut bytes).unwrap();
    Some(bytes.as_chunks::<2>().0.iter().map(|&pair| i16::from_be_bytes(pair)).collect())
}

/// Mean and mean absolute difference.
fn differences(pairs: impl Iterator<Item = (f64, f64)>) -> (f64, f64, usize) {
    let (mut sum, mut absolute, mut count) = (0.0, 0.0, 0);
    for (a, b) in pairs {
        sum += a - b;
        absolute += (a - b).abs();
        count += 1;
    }
    (sum / count as f64, absolute / count as f64, count)
}

#[test]
fn a_geotiff_in_utm_keeps_its_grid_and_the_numbers_that_gdal_reads() {
    let Some(file) = read("andorra_utm31_25m_f32.tif") else { return };
    assert_eq!((file.field.size(), file.field.corner()), ([1332, 1089], Point::ZERO));
    assert_eq!((file.field.spacing_m().x, file.field.spacing_m().y), (25.0, 25.0));
    let georeference = reference(&file);
    assert_eq!(georeference.epsg, Some(32_631));
    assert_eq!(georeference.projection, "+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs");
    // The places are of points (PixelIsPoint): GDAL's corner of the raster lies half a cell further out.
    let origin = georeference.origin_m;
    assert!((origin[0] - 368_377.657_711_943_67).abs() < 1e-6 && (origin[1] - 4_697_655.399_186_13).abs() < 1e-6);
    assert_eq!((file.voids.filled, file.voids.samples), (3940, 1332 * 1089));
    assert_eq!(codes(&file), ["voids-filled"]);
    // Columns and rows from the north-west, GDAL 3.10.
    for (column, row, height) in [
        (0, 1088, 1_542.621_826_171_875),
        (10, 20, 2_747.860_595_703_125),
        (399, 0, 2_625.228_271_484_375),
        (200, 300, 2_374.530_761_718_75),
        (1331, 1088, 1_594.868_408_203_125),
    ] {
        assert_eq!(file.field.sample([column, 1088 - row]), height);
    }
}

#[test]
fn a_tiled_geotiff_of_areas_keeps_its_grid_and_the_numbers_that_gdal_reads() {
    let Some(file) = read("lidar_cottonwood_dem.tif") else { return };
    assert_eq!(file.field.size(), [400, 400]);
    assert_eq!((file.voids.filled, codes(&file)), (0, vec![]));
    let georeference = reference(&file);
    assert_eq!(georeference.epsg, Some(26_915));
    // The middle of the sample in the south-west, GDAL 3.10; its longitude and latitude, PROJ 9.
    let origin = georeference.origin_m;
    assert!((origin[0] - 429_252.813_370_022).abs() < 1e-6 && (origin[1] - 5_150_485.924_942_633).abs() < 1e-6);
    let [longitude, latitude] = longitude_latitude(georeference, Point::ZERO).unwrap();
    assert!((longitude + 93.922_078_500).abs() < 2e-9 && (latitude - 46.504_225_985).abs() < 2e-9);
    for (column, row, height) in [
        (0, 399, 410.044_494_628_906_25),
        (10, 20, 402.956_390_380_859_4),
        (399, 0, 400.674_163_818_359_4),
        (200, 300, 388.989_929_199_218_75),
        (399, 399, 405.597_198_486_328_1),
    ] {
        assert_eq!(file.field.sample([column, 399 - row]), height);
    }
}

#[test]
fn a_sheet_of_srtm_lies_where_it_should_with_the_heights_that_it_has() {
    let (Some(file), Some(raw)) = (read("N42E001.hgt.zip"), sheet("N42E001.hgt.zip")) else { return };
    assert_eq!(codes(&file), ["voids-filled", "projected"]);
    assert_eq!((file.voids.filled, file.voids.samples), (7652, 1201 * 1201));
    assert_eq!(reference(&file).epsg, Some(32_631));
    // Geometric mean of 68.6 m and 92.6 m at 42.5° N.
    let spacing = file.field.spacing_m();
    assert!((spacing.x - 79.7).abs() < 0.3 && spacing.x == spacing.y, "{spacing:?}");
    let [columns, rows] = file.field.size();
    assert!(columns * rows > 1_300_000, "{columns} × {rows}");
    // At places of UTM zone 31: bilinear between the samples of the sheet, in longitude and latitude of PROJ 9.
    let origin = reference(&file).origin_m;
    for (east, north, height) in
        [(376_749.548, 4_706_383.170_5, 1095.0), (390_000.0, 4.7e6, 2168.572), (400_000.0, 4.74e6, 1681.562)]
    {
        let found = file.field.height(Point::new(east - origin[0], north - origin[1]));
        assert!((found - height).abs() < 12.0, "{found} for {height}");
    }
    // Against every sample of the sheet within: what differs is what the bilinear resampling rounds off ridges and valleys.
    let projector = Projector::new(reference(&file)).unwrap();
    let pairs = (0..raw.len()).step_by(3).filter(|&i| raw[i] != i16::MIN).filter_map(|i| {
        let place = [1.0 + (i % 1201) as f64 / 1200.0, 43.0 - (i / 1201) as f64 / 1200.0];
        let point = projector.point(place).unwrap();
        file.field.contains(point).then(|| (file.field.height(point), f64::from(raw[i])))
    });
    let (mean, absolute, count) = differences(pairs);
    assert!(count > 400_000 && mean.abs() < 0.02 && absolute < 3.5, "{mean} {absolute} of {count}");
}

#[test]
fn the_geotiff_and_the_sheet_that_it_was_made_of_agree() {
    let (Some(tif), Some(hgt)) = (read("andorra_utm31_25m_f32.tif"), read("N42E001.hgt.zip")) else { return };
    let (from, to) = (reference(&tif).origin_m, reference(&hgt).origin_m);
    let places = (0..1089).step_by(4).flat_map(|row| (0..1332).step_by(4).map(move |column| [column, row]));
    let differing = |shift: f64| {
        differences(places.clone().filter_map(|at| {
            let place = tif.field.place(at);
            let point = Point::new(place.x + from[0] - to[0] + shift, place.y + from[1] - to[1]);
            hgt.field.contains(point).then(|| (hgt.field.height(point), tif.field.sample(at)))
        }))
    };
    let (mean, absolute, count) = differing(0.0);
    assert!(count > 80_000 && mean.abs() < 0.1 && absolute < 4.0, "{mean} {absolute} of {count}");
    // Half a cell of the sheet to either side is worse: they do not merely look alike.
    for shift in [-40.0, 40.0] {
        assert!(differing(shift).1 > 2.0 * absolute, "{} m aside: {}", shift, differing(shift).1);
    }
}

#[test]
fn a_picture_has_the_heights_of_the_sheet_that_it_was_made_of() {
    let (Some(path), Some(raw)) = (data("N42E001_u16.png"), sheet("N42E001.hgt.zip")) else { return };
    let mut options = TerrainOptions::default();
    options.height_range_m = Some([-100.0, 3200.0]);
    options.spacing_m = Some(80.0);
    // Black is what the picture has where the sheet has nothing.
    options.void_value = Some(0.0);
    let file = read_terrain(&path, &options).unwrap();
    assert_eq!((file.field.size(), file.voids.filled), ([1201, 1201], 7652));
    assert!(file.georeference.is_none() && file.field.spacing_m().x == 80.0);
    for (i, &height) in raw.iter().enumerate().filter(|(_, height)| **height != i16::MIN) {
        let found = file.field.sample([i % 1201, 1200 - i / 1201]);
        assert!((found - f64::from(height)).abs() <= 0.5 * 3300.0 / 65_535.0 + 1e-3, "{i}: {found} for {height}");
    }
    options.height_range_m = None;
    let error = read_terrain(&path, &options).unwrap_err().to_string();
    assert!(error.contains("`height_range_m`"), "{error}");
}

#[test]
fn the_sheet_of_monaco_has_the_sea() {
    let Some(file) = read("N43E007.hgt.zip") else { return };
    assert_eq!((file.voids.filled, reference(&file).epsg), (1595, Some(32_632)));
    let height = |place| file.field.height(point_at(reference(&file), place).unwrap());
    assert_eq!(height([7.5, 43.5]), 0.0);
    assert_eq!(height([7.4, 43.7]), 0.0);
    assert!((height([7.25, 43.9]) - 539.0).abs() < 25.0, "{}", height([7.25, 43.9]));
    let samples = file.field.samples();
    let sea = (0..samples.len()).filter(|&i| samples.get(i) == 0.0).count() as f64 / samples.len() as f64;
    // 1,060,406 of the sheet's 1,442,401 samples are zero (GDAL).
    assert!((sea - 0.735).abs() < 0.03, "{sea}");
}

#[test]
fn a_sheet_of_which_half_is_void_is_read_and_says_so() {
    let Some(file) = read("N48W125.hgt.zip") else { return };
    assert_eq!((file.voids.filled, file.voids.samples), (6_483_876, 3601 * 3601));
    assert_eq!(reference(&file).epsg, Some(32_610));
    assert!(file.warnings[0].text.contains("50.0 %"), "{}", file.warnings[0].text);
    let samples = file.field.samples();
    // What was filled lies between what was there: -13 to 1095 m (GDAL).
    assert!((0..samples.len()).all(|i| (-13.0..=1095.0).contains(&samples.get(i))));
}
