//! Where results go. Everything is encoded before the first file is written, and each file is written whole.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use fairpath_io::write_whole;

use crate::args::OutputFormat;
use crate::interrupt;

/// A place for a result, and its form there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Destination {
    pub(crate) path: PathBuf,
    pub(crate) format: OutputFormat,
}

impl Destination {
    /// The place that the arguments ask for.
    ///
    /// # Errors
    /// When neither the extension nor `format` tells the form, or the place is a folder or in none.
    pub(crate) fn new(path: &Path, format: Option<OutputFormat>) -> Result<Self> {
        let format = match format {
            Some(format) => format,
            None => from_extension(path)?,
        };
        check_place(path)?;
        Ok(Self { path: path.to_path_buf(), format })
    }
}

fn from_extension(path: &Path) -> Result<OutputFormat> {
    const KNOWN: &str = "json, svg, dxf, csv or png";
    if path.as_os_str() == "-" {
        bail!("-o -: say in which form by --format {KNOWN}");
    }
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("json") => Ok(OutputFormat::Json),
        Some("svg") => Ok(OutputFormat::Svg),
        Some("dxf") => Ok(OutputFormat::Dxf),
        Some("csv") => Ok(OutputFormat::Csv),
        Some("png") => Ok(OutputFormat::Png),
        Some(other) => {
            bail!("{}: nothing is written as .{other}; use the extension {KNOWN}, or --format", path.display())
        }
        None => bail!("{}: the name has no extension; use {KNOWN}, or --format", path.display()),
    }
}

/// Finds out before the work, not after it, that the result would have no place.
pub(crate) fn check_place(path: &Path) -> Result<()> {
    if path.as_os_str() == "-" {
        return Ok(());
    }
    if path.is_dir() {
        bail!("{}: this is a folder; give the name of a file", path.display());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        bail!("{}: there is no folder {}; make it first", path.display(), folder.display());
    }
    Ok(())
}

/// Files that are ready to be written.
#[derive(Debug, Default)]
pub(crate) struct Ready {
    files: Vec<(PathBuf, Vec<u8>)>,
}

impl Ready {
    pub(crate) fn add(&mut self, path: impl Into<PathBuf>, bytes: Vec<u8>) {
        self.files.push((path.into(), bytes));
    }

    /// Writes them all, standard output last: who reads there may hang up.
    ///
    /// # Errors
    /// When a file cannot be written; each file before it is whole, and it and those after it are as they were.
    pub(crate) fn write(mut self) -> Result<()> {
        self.files.sort_by_key(|(path, _)| path.as_os_str() == "-");
        let _whole = interrupt::hold_off();
        for (path, bytes) in &self.files {
            if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
                std::fs::create_dir_all(folder).with_context(|| format!("{}: cannot be made", folder.display()))?;
            }
            write_whole(path, bytes)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_tells_the_format_in_any_case() {
        assert_eq!(Destination::new(Path::new("a.SVG"), None).unwrap().format, OutputFormat::Svg);
        assert_eq!(Destination::new(Path::new("a.SVG"), Some(OutputFormat::Dxf)).unwrap().format, OutputFormat::Dxf);
    }

    #[test]
    fn a_place_that_cannot_be_is_refused_with_a_remedy() {
        for (path, said) in [
            ("a.doc", "nothing is written as .doc"),
            ("a", "has no extension"),
            ("-", "say in which form by --format"),
            ("/", "has no extension"),
            ("no/such/folder/a.json", "there is no folder no/such/folder; make it first"),
        ] {
            let error = Destination::new(Path::new(path), None).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
        let error = Destination::new(Path::new("/"), Some(OutputFormat::Json)).unwrap_err().to_string();
        assert!(error.contains("this is a folder"), "{error}");
    }
}
