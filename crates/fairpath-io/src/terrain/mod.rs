//! Terrains from files of any format, told apart by content, else by extension. What comes out is in metres, x east and y north, with the origin at the sample
//! furthest to the south-west.

mod archive;
mod ascii_grid;
mod epsg;
mod geokeys;
mod geotiff;
mod hgt;
mod options;
mod png;
mod projection;
mod raster;
mod raw;
mod resample;
mod tiff_samples;

pub use fairpath_drive::{RawLayout, RawSample};
pub use options::TerrainOptions;
pub use projection::{ProjectionError, Projector, longitude_latitude, point_at};

use crate::error::{Error, Fault};
use crate::input::{extension, label, open, read_all};
use fairpath_curve::{Point, Vec2};
use fairpath_drive::{GeoReference, Heightfield, VoidReport, fill_voids};
use fairpath_fit::Warning;
use raster::{Plane, Raster, excerpt, terrain_fault};
use std::io::Read;
use std::path::Path;

/// The formats that terrains are read from; each may lie in a ZIP archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TerrainFormat {
    /// TIFF and BigTIFF with or without the tags of GeoTIFF 1.1.
    GeoTiff,
    /// A sheet of SRTM, whose name says where it lies.
    Hgt,
    /// Greys as heights.
    Png,
    /// ESRI's grid of text.
    AsciiGrid,
    /// Bare numbers ([`TerrainOptions::raw`]).
    Raw,
}

/// What the readers of terrains accept.
const EXPECTED: &str = "a terrain as GeoTIFF, SRTM (.hgt), PNG in greys, ESRI ASCII grid (.asc) or bare numbers (.raw), or a ZIP archive of one";

impl TerrainFormat {
    /// Every format.
    pub const ALL: [Self; 5] = [Self::GeoTiff, Self::Hgt, Self::Png, Self::AsciiGrid, Self::Raw];

    /// The format of a file of that name, where its extension tells.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        match extension(path).as_str() {
            "tif" | "tiff" | "gtif" | "gtiff" => Some(Self::GeoTiff),
            "hgt" => Some(Self::Hgt),
            "png" => Some(Self::Png),
            "asc" | "agr" => Some(Self::AsciiGrid),
            "raw" | "r16" | "r32" => Some(Self::Raw),
            _ => None,
        }
    }

    /// The format of a file that begins like this; sheets of SRTM and bare numbers cannot be told.
    #[must_use]
    pub fn from_content(head: &[u8]) -> Option<Self> {
        if head.starts_with(png::MAGIC) {
            Some(Self::Png)
        } else if geotiff::begins(head) {
            Some(Self::GeoTiff)
        } else if ascii_grid::begins(head) {
            Some(Self::AsciiGrid)
        } else {
            None
        }
    }
}

/// A terrain as it came from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct TerrainFile {
    /// The heights: x east, y north, metres, the sample furthest to the south-west at (0, 0).
    pub field: Heightfield,
    /// Where on the globe it lies, if the file tells.
    pub georeference: Option<GeoReference>,
    /// How many of the file's samples had no height and were filled.
    pub voids: VoidReport,
    /// What the reader had to assume, change or leave out.
    pub warnings: Vec<Warning>,
}

/// The terrain of a file; `-` is standard input. The content tells the format, else the extension does.
///
/// What is in metres keeps its grid. What is in feet keeps it too, with places and heights in metres. What is in longitudes and latitudes is projected to the
/// zone of UTM of its middle and resampled bilinearly on a square grid of as many samples to the square kilometre, in the largest upright rectangle within it.
/// Samples without a height are filled before that.
///
/// # Errors
/// When the file cannot be opened, is of no known format, breaks its format's rules or goes beyond the limits, has no height at all or absurd ones, or does not
/// say what [`TerrainOptions`] must then say; when its rows are not upright, or it reaches too far round the globe.
pub fn read_terrain(path: &Path, options: &TerrainOptions) -> Result<TerrainFile, Error> {
    read_terrain_from(open(path)?, &label(path), None, options)
}

/// The terrain that `reader` gives. `name` stands for the file in messages, tells where a sheet of SRTM lies and, without a `format`, the format where the
/// content does not.
///
/// # Errors
/// As [`read_terrain`].
pub fn read_terrain_from(
    reader: impl Read,
    name: &str,
    format: Option<TerrainFormat>,
    options: &TerrainOptions,
) -> Result<TerrainFile, Error> {
    let in_file = |fault: Fault| fault.in_file(name);
    options.check().map_err(in_file)?;
    let bytes = read_all(reader, &options.limits).map_err(in_file)?;
    if !archive::begins(&bytes) {
        return parse(&bytes, name, format, options)?.map_err(in_file);
    }
    let (inner, content) = archive::unpacked(&bytes, &options.limits).map_err(in_file)?;
    drop(bytes);
    parse(&content, &inner, format, options)?.map_err(in_file)
}

/// The terrain in these bytes; the outer error where no format fits.
fn parse(
    bytes: &[u8],
    name: &str,
    format: Option<TerrainFormat>,
    options: &TerrainOptions,
) -> Result<Result<TerrainFile, Fault>, Error> {
    let known =
        format.or_else(|| TerrainFormat::from_content(bytes)).or_else(|| TerrainFormat::from_path(Path::new(name)));
    let Some(format) = known else {
        let problem = match bytes {
            [] => "the file is empty".into(),
            [first, ..] => format!("nothing known begins with byte {first}, and its name has no known extension"),
        };
        return Err(Error::UnknownFormat { file: excerpt(name), problem, expected: EXPECTED });
    };
    if bytes.is_empty() {
        return Ok(Err(Fault::new("the file as a whole", "it is empty")));
    }
    let raster = match format {
        TerrainFormat::GeoTiff => geotiff::read(bytes, options),
        TerrainFormat::Hgt => hgt::read(bytes, name, &options.limits),
        TerrainFormat::Png => png::read(bytes, options),
        TerrainFormat::AsciiGrid => ascii_grid::read(bytes, options),
        TerrainFormat::Raw => raw::read(bytes, options),
    };
    Ok(raster.and_then(|raster| concluded(raster, options)))
}

/// The terrain of a raster: voids filled, on a plane, in metres from its own origin.
fn concluded(mut raster: Raster, options: &TerrainOptions) -> Result<TerrainFile, Fault> {
    let voids = fill_voids(raster.size, &mut raster.samples).map_err(terrain_fault)?;
    let mut warnings = std::mem::take(&mut raster.warnings);
    if voids.filled > 0 {
        let percent = 100.0 * voids.share();
        let text = format!(
            "{} of {} samples ({percent:.1} %) had no height and were bridged from their rims",
            voids.filled, voids.samples
        );
        warnings.push(Warning { code: "voids-filled".into(), text });
    }
    if let Plane::Geographic { projection } = &raster.plane {
        let (projected, warning) = resample::to_utm(&raster, projection, options)?;
        warnings.push(warning);
        raster = projected;
    }
    let georeference = match raster.plane {
        Plane::Projected { projection, epsg } => Some(GeoReference { projection, epsg, origin_m: raster.corner }),
        Plane::Local | Plane::Geographic { .. } => None,
    };
    let [x, y] = raster.step;
    let field = Heightfield::new(raster.size, Point::ZERO, Vec2::new(x, y), raster.samples).map_err(terrain_fault)?;
    Ok(TerrainFile { field, georeference, voids, warnings })
}
