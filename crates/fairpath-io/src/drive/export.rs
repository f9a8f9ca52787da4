//! A document to files of other programs.

use super::{csv, geojson, gltf, landxml, opendrive};
use crate::error::Error;
use crate::input::extension;
use fairpath_drive::{Results, State};
use std::path::Path;

/// The formats that networks are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ExportFormat {
    /// Roads with lanes and intersections as ASAM OpenDRIVE 1.7.
    OpenDrive,
    /// Alignments, profiles and the finished ground as LandXML 1.2.
    LandXml,
    /// The whole scene as glTF 2.0 in one binary file.
    Glb,
    /// Paths, bridges, tunnels and signs as GeoJSON, in longitude and latitude.
    GeoJson,
    /// A table of stations.
    Csv,
}

impl ExportFormat {
    /// All formats.
    pub const ALL: [Self; 5] = [Self::OpenDrive, Self::LandXml, Self::Glb, Self::GeoJson, Self::Csv];

    /// The extension of the format's files.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::OpenDrive => "xodr",
            Self::LandXml => "xml",
            Self::Glb => "glb",
            Self::GeoJson => "geojson",
            Self::Csv => "csv",
        }
    }

    /// The format of a file of that name, if its extension is one of ours.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = extension(path);
        Self::ALL.into_iter().find(|f| f.extension() == extension)
    }
}

/// A document to be written.
#[derive(Clone, Copy, Debug)]
pub struct DriveExport<'a> {
    /// What was said.
    pub state: &'a State,
    /// What follows.
    pub results: &'a Results,
    /// The document's name, for the headers of files.
    pub name: &'a str,
}

/// A document in a format.
///
/// # Errors
/// [`Error::Unwritable`] when the format cannot hold it, such as places on the globe of a terrain that lies nowhere.
pub fn encode_drive(export: &DriveExport<'_>, format: ExportFormat) -> Result<Vec<u8>, Error> {
    match format {
        ExportFormat::OpenDrive => opendrive::write(export),
        ExportFormat::LandXml => landxml::write(export),
        ExportFormat::Glb => gltf::write(export),
        ExportFormat::GeoJson => geojson::write(export),
        ExportFormat::Csv => csv::write(export),
    }
}
