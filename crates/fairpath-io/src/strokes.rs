//! Strokes from files of any format, told apart by extension, else by content.

use crate::error::{Error, Fault};
use crate::input::{check_size, extension, first_byte, label, open, peek, read_all, strip_bom, text};
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::{strokes_geojson, strokes_gpx, strokes_inkml, strokes_json, strokes_svg, strokes_text};
use std::io::Read;
use std::path::Path;

/// The formats that strokes are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StrokeFormat {
    /// `fairpath-strokes 1`.
    Json,
    /// Every subpath of path, polyline, polygon and line.
    Svg,
    /// CSV or text with blanks: `x y [t [pressure]]`.
    Text,
    /// Traces of W3C InkML.
    InkMl,
    /// Tracks and routes of GPX, projected to local metres.
    Gpx,
    /// Lines and rings of GeoJSON, projected to local metres.
    GeoJson,
}

/// What the readers of strokes accept.
const EXPECTED: &str = "strokes as JSON (fairpath-strokes 1), SVG, CSV or blank-separated text (x y [t [pressure]]), InkML, GPX or GeoJSON";

impl StrokeFormat {
    /// Every format.
    pub const ALL: [Self; 6] = [Self::Json, Self::Svg, Self::Text, Self::InkMl, Self::Gpx, Self::GeoJson];

    /// The format of a file of that name, where its extension tells.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        match extension(path).as_str() {
            "json" => Some(Self::Json),
            "svg" => Some(Self::Svg),
            "csv" | "tsv" | "txt" | "dat" | "xy" => Some(Self::Text),
            "inkml" | "ink" => Some(Self::InkMl),
            "gpx" => Some(Self::Gpx),
            "geojson" => Some(Self::GeoJson),
            _ => None,
        }
    }

    /// The format of a file that begins like this, if any.
    #[must_use]
    pub fn from_content(head: &[u8]) -> Option<Self> {
        match first_byte(head)? {
            b'{' if strokes_geojson::begins(head) => Some(Self::GeoJson),
            b'{' => Some(Self::Json),
            b'<' => {
                let find = |what: &[u8]| head.windows(what.len()).position(|w| w == what);
                let marks = [
                    (find(b"<svg"), Self::Svg),
                    (find(b"<ink").or_else(|| find(b":ink")), Self::InkMl),
                    (find(b"<gpx"), Self::Gpx),
                ];
                let first = marks.into_iter().filter_map(|(at, format)| Some((at?, format))).min_by_key(|m| m.0);
                Some(first.map_or(Self::Svg, |m| m.1))
            }
            b'0'..=b'9' | b'+' | b'-' | b'.' | b'#' | b'"' => Some(Self::Text),
            _ => {
                let text = String::from_utf8_lossy(strip_bom(&head[..head.len().min(4096)]));
                strokes_text::begins_with_header(&text).then_some(Self::Text)
            }
        }
    }
}

/// The strokes of a file; `-` is standard input. The extension tells the format, else the content does.
///
/// # Errors
/// When the file cannot be opened, is of no known format, breaks its format's rules or goes beyond the limits.
pub fn read_strokes(path: &Path, options: &ReadOptions) -> Result<StrokeFile, Error> {
    read_strokes_from(open(path)?, &label(path), StrokeFormat::from_path(path), options)
}

/// The strokes that `reader` gives. `name` stands for the file in messages; without a `format` the content tells.
///
/// # Errors
/// As [`read_strokes`].
pub fn read_strokes_from(
    reader: impl Read,
    name: &str,
    format: Option<StrokeFormat>,
    options: &ReadOptions,
) -> Result<StrokeFile, Error> {
    let (head, reader) = peek(reader).map_err(|source| Error::Read { file: name.into(), source })?;
    let format = format_of(&head, name, format)?;
    let result = if format == StrokeFormat::Text {
        strokes_text::read(reader, options)
    } else {
        read_all(reader, &options.limits).and_then(|bytes| parse(&bytes, format, options))
    };
    result.map_err(|fault| fault.in_file(name))
}

/// The format of a file that begins like this, where its name tells `given`.
pub(crate) fn format_of(head: &[u8], name: &str, given: Option<StrokeFormat>) -> Result<StrokeFormat, Error> {
    // GeoJSON files are often called `.json`.
    let given = given.filter(|&f| f != StrokeFormat::Json || !strokes_geojson::begins(head));
    given.or_else(|| StrokeFormat::from_content(head)).ok_or_else(|| {
        let problem = match first_byte(head) {
            None => "the file is empty".into(),
            Some(b) => format!("nothing known begins with {:?}", char::from(b)),
        };
        Error::UnknownFormat { file: name.into(), problem, expected: EXPECTED }
    })
}

fn parse(bytes: &[u8], format: StrokeFormat, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    check_size(bytes, &options.limits)?;
    let mut file = match format {
        StrokeFormat::Json => strokes_json::read(text(bytes)?, options)?,
        StrokeFormat::Svg => strokes_svg::read(text(bytes)?, options)?,
        StrokeFormat::InkMl => strokes_inkml::read(text(bytes)?, options)?,
        StrokeFormat::Gpx => strokes_gpx::read(text(bytes)?, options)?,
        StrokeFormat::GeoJson => strokes_geojson::read(text(bytes)?, options)?,
        StrokeFormat::Text => strokes_text::read(bytes, options)?,
    };
    file.make_names_unique();
    Ok(file)
}

/// `file` in the form of a format that strokes are written in: JSON keeps everything; text keeps points, times and pressures,
/// and the names in comments; SVG keeps the points of each stroke as a polyline.
///
/// # Errors
/// [`Error::Unwritable`] for InkML, GPX and GeoJSON, which are only read, and for coordinates that are not finite.
pub fn encode_strokes(file: &StrokeFile, format: StrokeFormat) -> Result<Vec<u8>, Error> {
    match format {
        StrokeFormat::Json => strokes_json::write(file),
        StrokeFormat::Svg => strokes_svg::write(file),
        StrokeFormat::Text => strokes_text::write(file),
        StrokeFormat::InkMl => Err(only_read("InkML")),
        StrokeFormat::Gpx => Err(only_read("GPX")),
        StrokeFormat::GeoJson => Err(only_read("GeoJSON")),
    }
}

fn only_read(format: &'static str) -> Error {
    let problem = format!("{format} is only read; write JSON, SVG or CSV");
    Error::Unwritable { format, place: "the file as a whole".into(), problem }
}

/// Writes strokes to a file, whole or not at all, in the format of its extension (JSON where there is none).
///
/// # Errors
/// As [`encode_strokes`], and when the file cannot be written.
pub fn write_strokes(path: &Path, file: &StrokeFile) -> Result<(), Error> {
    let format = StrokeFormat::from_path(path).unwrap_or(StrokeFormat::Json);
    crate::atomic::write_whole(path, &encode_strokes(file, format)?)
}
