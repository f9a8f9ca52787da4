//! The terrains that a script names: files beside it.

use crate::terrain::{TerrainOptions, read_terrain};
use fairpath_drive::{LaidTerrain, TerrainSource, Terrains};
use fairpath_fit::Warning;
use std::cell::RefCell;
use std::path::PathBuf;
use std::sync::Arc;

/// A folder in which terrains lie.
#[derive(Debug, Default)]
pub struct TerrainFolder {
    folder: PathBuf,
    warnings: RefCell<Vec<Warning>>,
}

impl TerrainFolder {
    /// The folder in which a script lies.
    #[must_use]
    pub fn beside(script: &std::path::Path) -> Self {
        Self { folder: script.parent().map(PathBuf::from).unwrap_or_default(), warnings: RefCell::default() }
    }

    /// Where it is.
    #[must_use]
    pub fn folder(&self) -> &std::path::Path {
        &self.folder
    }

    /// What there was to say about the terrains that were read.
    #[must_use]
    pub fn warnings(&self) -> Vec<Warning> {
        self.warnings.borrow().clone()
    }
}

impl Terrains for TerrainFolder {
    fn terrain(&self, source: &TerrainSource) -> Result<LaidTerrain, String> {
        let file = source.file.as_deref().unwrap_or_default();
        let options =
            TerrainOptions { height_range_m: source.range_m, spacing_m: source.cell_m, ..TerrainOptions::default() };
        let read = read_terrain(&self.folder.join(file), &options).map_err(|e| e.to_string())?;
        self.warnings.borrow_mut().extend(read.warnings);
        Ok(LaidTerrain { field: Arc::new(read.field), georeference: read.georeference, waters: Arc::default() })
    }
}
