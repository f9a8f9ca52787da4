//! Splines from and to files of any format.

use crate::atomic::write_whole;
use crate::error::{Error, Fault};
use crate::input::{extension, first_byte, label, open, peek, read_all, text};
use crate::limits::ReadOptions;
use crate::picture::{PictureOptions, draw_splines};
use crate::spline_dxf::{self, DxfOptions};
use crate::spline_file::SplineFile;
use crate::stroke_file::StrokeFile;
use crate::{spline_csv, spline_json, spline_svg};
use fairpath_fit::Warning;
use std::io::Read;
use std::path::Path;

/// The formats of splines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SplineFormat {
    /// `fairpath-spline 1`: everything.
    Json,
    /// Paths of cubic Béziers for other programs, with everything in the metadata.
    Svg,
    /// A row for each segment, without reports and warnings.
    Csv,
    /// AutoCAD 2000 and later, as arcs and lines; only written.
    Dxf,
    /// A picture; only written.
    Png,
}

impl SplineFormat {
    /// All formats.
    pub const ALL: [Self; 5] = [Self::Json, Self::Svg, Self::Csv, Self::Dxf, Self::Png];

    /// The extension of the format's files.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Svg => "svg",
            Self::Csv => "csv",
            Self::Dxf => "dxf",
            Self::Png => "png",
        }
    }

    /// The format of a file of that name, if its extension is one of ours.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = extension(path);
        Self::ALL.into_iter().find(|f| f.extension() == extension)
    }

    /// The format of a file that begins like this, if any that is read.
    #[must_use]
    pub fn from_content(head: &[u8]) -> Option<Self> {
        match first_byte(head)? {
            b'{' => Some(Self::Json),
            b'<' => Some(Self::Svg),
            b'#' | b'n' | b'"' => Some(Self::Csv),
            _ => None,
        }
    }
}

/// How to write splines.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WriteOptions {
    /// Largest distance between a spline and its Béziers in SVG, in the file's unit. Default 0.01.
    pub svg_tolerance: f64,
    /// How to write DXF.
    pub dxf: DxfOptions,
    /// How to draw PNG.
    pub picture: PictureOptions,
}

impl Default for WriteOptions {
    fn default() -> Self {
        Self { svg_tolerance: 0.01, dxf: DxfOptions::default(), picture: PictureOptions::default() }
    }
}

/// The splines of a file; `-` is standard input. The extension tells the format, else the content does.
///
/// # Errors
/// When the file cannot be opened, is of no format that is read, breaks its format's rules or goes beyond the limits, or its
/// segments do not meet as their joins claim.
pub fn read_splines(path: &Path, options: &ReadOptions) -> Result<SplineFile, Error> {
    read_splines_from(open(path)?, &label(path), SplineFormat::from_path(path), options)
}

/// The splines that `reader` gives. `name` stands for the file in messages; without a `format` the content tells.
///
/// # Errors
/// As [`read_splines`].
pub fn read_splines_from(
    reader: impl Read,
    name: &str,
    format: Option<SplineFormat>,
    options: &ReadOptions,
) -> Result<SplineFile, Error> {
    let expected = "splines as JSON (fairpath-spline 1), SVG written by fairpath, or CSV";
    let unknown = |problem: String| Error::UnknownFormat { file: name.into(), problem, expected };
    let (head, reader) = peek(reader).map_err(|source| Error::Read { file: name.into(), source })?;
    let Some(format) = format.or_else(|| SplineFormat::from_content(&head)) else {
        return Err(unknown(match first_byte(&head) {
            None => "the file is empty".into(),
            Some(b) => format!("nothing known begins with {:?}", char::from(b)),
        }));
    };
    if matches!(format, SplineFormat::Dxf | SplineFormat::Png) {
        return Err(unknown(format!("{} is only written", format.extension().to_uppercase())));
    }
    let parse = |bytes: Vec<u8>| match format {
        SplineFormat::Svg => spline_svg::read(text(&bytes)?, options),
        SplineFormat::Csv => spline_csv::read(text(&bytes)?, options),
        _ => spline_json::read(text(&bytes)?, options),
    };
    read_all(reader, &options.limits).and_then(parse).map_err(|fault: Fault| fault.in_file(name))
}

/// A file's bytes with what could not be kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Encoded {
    /// What to write.
    pub bytes: Vec<u8>,
    /// What the format does not hold.
    pub warnings: Vec<Warning>,
}

/// `file` in a format. A PNG shows `strokes`, if given, behind their splines.
///
/// # Errors
/// [`Error::Unwritable`] when something cannot be expressed in the format.
pub fn encode_splines(
    file: &SplineFile,
    format: SplineFormat,
    strokes: Option<&StrokeFile>,
    options: &WriteOptions,
) -> Result<Encoded, Error> {
    let bytes = match format {
        SplineFormat::Json => spline_json::write(file)?,
        SplineFormat::Svg => spline_svg::write(file, options.svg_tolerance)?,
        SplineFormat::Csv => spline_csv::write(file)?,
        SplineFormat::Dxf => return spline_dxf::write(file, &options.dxf),
        SplineFormat::Png => draw_splines(file, strokes, &options.picture).to_png()?,
    };
    Ok(Encoded { bytes, warnings: Vec::new() })
}

/// Writes splines to a file, whole or not at all, in the format of its extension; gives back what that format does not hold.
///
/// # Errors
/// As [`encode_splines`]; [`Error::UnknownFormat`] when the extension tells no format, [`Error::Write`] when the file cannot be
/// written.
pub fn write_splines(
    path: &Path,
    file: &SplineFile,
    strokes: Option<&StrokeFile>,
    options: &WriteOptions,
) -> Result<Vec<Warning>, Error> {
    let Some(format) = SplineFormat::from_path(path) else {
        return Err(Error::UnknownFormat {
            file: label(path),
            problem: "the extension tells no format".into(),
            expected: "a name that ends in .json, .svg, .csv, .dxf or .png",
        });
    };
    let Encoded { bytes, warnings } = encode_splines(file, format, strokes, options)?;
    write_whole(path, &bytes)?;
    Ok(warnings)
}
