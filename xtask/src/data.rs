//! The recorded strokes, for chores that link the fitter.

use std::path::Path;

use anyhow::{Result, bail};
use fairpath_fit::Stroke;
use fairpath_io::{ReadOptions, read_strokes};

use crate::tree;

/// The strokes of a file of the shared data folder.
pub(crate) fn shared(file: &str) -> Result<Vec<Stroke>> {
    if !tree::strokes().is_dir() {
        bail!("this chore needs the shared data folder beside the project ({})", tree::shared().display());
    }
    load(&tree::strokes().join(file))
}

/// The strokes of any file.
pub(crate) fn load(path: &Path) -> Result<Vec<Stroke>> {
    Ok(read_strokes(path, &ReadOptions::default())?.strokes)
}

/// The length of a stroke's polyline, in its unit.
pub(crate) fn polyline_length(stroke: &Stroke) -> f64 {
    stroke.points.windows(2).map(|pair| (pair[1] - pair[0]).hypot()).sum()
}
