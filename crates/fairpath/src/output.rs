//! Where results go. Everything is encoded before the first file is written, and each file is written whole.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use fairpath_io::write_whole;

use crate::args::OutputFormat;
use crate::interrupt;

/// A place for a result, and its form there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Destination<F = OutputFormat> {
    pub(crate) path: PathBuf,
    pub(crate) format: F,
}

impl<F: ValueEnum> Destination<F> {
    /// The place that the arguments ask for.
    ///
    /// # Errors
    /// When neither the extension nor `format` tells the form, or the place is a folder or in none.
    pub(crate) fn new(path: &Path, format: Option<F>) -> Result<Self> {
        let format = match format {
            Some(format) => format,
            None => from_extension(path)?,
        };
        check_place(path)?;
        Ok(Self { path: path.to_path_buf(), format })
    }
}

fn from_extension<F: ValueEnum>(path: &Path) -> Result<F> {
    let known = known::<F>();
    if path.as_os_str() == "-" {
        bail!("-o -: say in which form by --format {known}");
    }
    let Some(extension) = path.extension().map(|e| e.to_string_lossy().to_lowercase()) else {
        bail!("{}: the name has no extension; use {known}, or --format", path.display());
    };
    let Ok(format) = F::from_str(&extension, true) else {
        bail!("{}: nothing is written as .{extension}; use the extension {known}, or --format", path.display());
    };
    Ok(format)
}

/// The formats, as one would say them.
fn known<F: ValueEnum>() -> String {
    let values: Vec<_> = F::value_variants().iter().filter_map(ValueEnum::to_possible_value).collect();
    let names: Vec<&str> = values.iter().map(|value| value.get_name()).collect();
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
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
    use crate::args::SurfaceOutput;

    #[test]
    fn formats_are_listed_as_one_says_them() {
        assert_eq!(known::<OutputFormat>(), "json, svg, dxf, csv or png");
        assert_eq!(known::<SurfaceOutput>(), "glb, obj or png");
    }

    #[test]
    fn the_extension_tells_the_format_in_any_case() {
        assert_eq!(Destination::<OutputFormat>::new(Path::new("a.SVG"), None).unwrap().format, OutputFormat::Svg);
        assert_eq!(Destination::<SurfaceOutput>::new(Path::new("a.Glb"), None).unwrap().format, SurfaceOutput::Glb);
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
            let error = Destination::<OutputFormat>::new(Path::new(path), None).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
        let error = Destination::new(Path::new("/"), Some(OutputFormat::Json)).unwrap_err().to_string();
        assert!(error.contains("this is a folder"), "{error}");
    }
}
