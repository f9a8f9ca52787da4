//! A state of a document: what was said, and nothing that follows from it. Copies share what they have in common.

use super::error::CommandError;
use crate::ground::{EarthworkOptions, Soils};
use crate::network::{Choice, Path, PathId, StructureLimits};
use crate::rules::DesignRules;
use crate::section::Section;
use crate::terrain::{GeoReference, Heightfield, Waters};
use fairpath_curve::Point;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A terrain as it was laid.
#[derive(Clone, Debug, PartialEq)]
pub struct LaidTerrain {
    /// Its heights.
    pub field: Arc<Heightfield>,
    /// Where on the globe it lies, if it lies anywhere.
    pub georeference: Option<GeoReference>,
    /// Where water stands.
    pub waters: Arc<Waters>,
}

/// A region of trees.
#[derive(Clone, Debug, PartialEq)]
pub struct FoliageRegion {
    /// Its outline, m.
    pub outline: Vec<Point>,
    /// From 0 for none to 1 for a closed wood.
    pub density: f64,
}

/// What holds for the whole document.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// From which heights on there are bridges and tunnels.
    pub structures: StructureLimits,
    /// How the ground beside paths is shaped.
    pub earthwork: EarthworkOptions,
    /// The seed of everything random.
    pub seed: u64,
}

/// What was said so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// The terrain, once it is laid.
    pub terrain: Option<LaidTerrain>,
    /// The paths, by ascending id.
    pub paths: Vec<Arc<Path>>,
    /// What was said about crossings, in order.
    pub choices: Arc<Vec<Choice>>,
    /// What the ground is made of.
    pub soils: Arc<Soils>,
    /// Woods and clearings, later ones over earlier ones.
    pub foliage: Arc<Vec<Arc<FoliageRegion>>>,
    /// Cross-sections that were defined, by name.
    pub sections: Arc<BTreeMap<String, Arc<Section>>>,
    /// What holds for the whole document.
    pub settings: Settings,
    /// The rules by which signs are posted and the design is checked.
    pub rules: Arc<DesignRules>,
    /// How many paths there ever were: the next one's id.
    pub paths_so_far: u32,
}

impl State {
    /// A path by its name.
    #[must_use]
    pub fn path(&self, name: &str) -> Option<&Arc<Path>> {
        self.paths.iter().find(|p| p.name == name)
    }

    /// A path by its id.
    #[must_use]
    pub fn path_of(&self, id: PathId) -> Option<&Arc<Path>> {
        self.paths.binary_search_by_key(&id, |p| p.id).ok().map(|i| &self.paths[i])
    }

    /// A cross-section by name: one that was defined, or one that comes along.
    #[must_use]
    pub fn section(&self, name: &str) -> Option<Arc<Section>> {
        self.sections.get(name).cloned().or_else(|| Section::shipped(name).map(Arc::new))
    }

    /// What there is to say where a path is named that does not exist.
    #[must_use]
    pub fn no_path(&self, name: &str) -> CommandError {
        let mut known: Vec<&str> = self.paths.iter().take(MOST_NAMES).map(|p| p.name.as_str()).collect();
        if self.paths.len() > MOST_NAMES {
            known.push("…");
        }
        let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
        CommandError::NoPath { name: name.to_owned(), known }
    }
}

/// So many names at most are told.
const MOST_NAMES: usize = 12;
