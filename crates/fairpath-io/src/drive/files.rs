//! The terrains that a script names: files beside it.

use crate::terrain::{TerrainOptions, read_terrain};
use fairpath_drive::{LaidTerrain, TerrainSource, Terrains};
use fairpath_fit::Warning;
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A folder in which terrains lie.
#[derive(Debug, Default)]
pub(super) struct TerrainFolder {
    folder: PathBuf,
    warnings: RefCell<Vec<Warning>>,
}

impl TerrainFolder {
    /// The folder in which a script lies; the present one for standard input.
    pub(super) fn beside(script: &Path) -> Self {
        Self { folder: script.parent().map(PathBuf::from).unwrap_or_default(), warnings: RefCell::default() }
    }

    /// Where it is.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// What there was to say about the terrains that were read since the last time.
    pub(super) fn new_warnings(&self) -> Vec<Warning> {
        self.warnings.take()
    }
}

impl Terrains for TerrainFolder {
    fn terrain(&self, source: &TerrainSource) -> Result<LaidTerrain, String> {
        let file = source.file.as_deref().unwrap_or_default();
        let options = TerrainOptions {
            height_range_m: source.range_m,
            spacing_m: source.cell_m,
            epsg: source.epsg,
            void_value: source.void_value,
            height_unit_m: source.height_unit_m,
            raw: source.raw,
            ..TerrainOptions::default()
        };
        let read = read_terrain(&self.folder.join(file), &options).map_err(|e| e.to_string())?;
        let told = |w: Warning| Warning { text: format!("{file}: {}", w.text), ..w };
        self.warnings.borrow_mut().extend(read.warnings.into_iter().map(told));
        Ok(LaidTerrain { field: Arc::new(read.field), georeference: read.georeference, waters: Arc::default() })
    }
}
