//! Why a command cannot be done.

use crate::network::Unordered;
use crate::range::OutOfRange;
use crate::section::SectionError;
use crate::terrain::TerrainError;
use fairpath_fit::{EditError, FitError, OversketchError};
use thiserror::Error;

/// Why a command cannot be done; the document is as it was.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CommandError {
    /// There is no terrain yet.
    #[error("there is no terrain yet; begin with a command like {{\"do\":\"terrain\",\"synthetic\":\"hills\"}}")]
    NoTerrain,
    /// There is a terrain already.
    #[error("there is a terrain already; a document has one")]
    SecondTerrain,
    /// The terrain command says neither where heights come from, or says it twice.
    #[error("the terrain needs either a `file` or a `synthetic` landscape (hills, islands or valley)")]
    TerrainSource,
    /// The terrain cannot be had.
    #[error("the terrain cannot be made: {0}")]
    Terrain(#[from] TerrainError),
    /// The terrain's file cannot be read.
    #[error("{0}")]
    TerrainFile(String),
    /// There is no such path.
    #[error("there is no path {name:?}; there are {known}")]
    NoPath {
        /// What was asked for.
        name: String,
        /// The names of those that there are.
        known: String,
    },
    /// A name or layer is empty.
    #[error("names of paths and layers must not be empty; leave \"name\" out to have the path numbered")]
    NoName,
    /// The name is another path's.
    #[error("there is a path {0:?} already; give this one another name")]
    NameTaken(String),
    /// There is no such cross-section.
    #[error("there is no cross-section {name:?}; there are {known}")]
    NoSection {
        /// What was asked for.
        name: String,
        /// The names of those that there are.
        known: String,
    },
    /// A cross-section has a number out of its range.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// A number is out of its range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// Too few points, or one of them is not a place.
    #[error("{field}: {problem}")]
    Points {
        /// Which points.
        field: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// The stroke becomes no curve.
    #[error("the stroke becomes no path: {0}")]
    Fit(#[from] FitError),
    /// The stroke corrects no path.
    #[error("the stroke corrects no path: {0}")]
    Oversketch(#[from] OversketchError),
    /// The paths cannot be edited so.
    #[error("the path cannot be edited so: {0}")]
    Edit(#[from] EditError),
    /// There is no crossing near the place.
    #[error("no crossing {of}lies within {reach_m} m of ({x}, {y})")]
    NoCrossing {
        /// Of which paths, with a blank behind.
        of: String,
        /// How far was looked, m.
        reach_m: f64,
        /// The place.
        x: f64,
        /// The place.
        y: f64,
    },
    /// It is not said which path passes over.
    #[error("say with `path` which of {first:?} and {second:?} shall pass over or under")]
    WhichPath {
        /// One path.
        first: String,
        /// The other.
        second: String,
    },
    /// Crossings at one place ask for a ring.
    #[error("the paths would pass over each other in a ring at one place: {crossings}")]
    Ring {
        /// The crossings, in words.
        crossings: String,
    },
    /// A lasso holds nothing that the command could be done to.
    #[error("nothing of a path lies within the lasso")]
    EmptyLasso,
    /// The command does not say what it is about.
    #[error("say with `path` or `lasso_m` what is meant")]
    Nothing,
}

/// Crossings that cannot hold together, in words.
pub(super) fn ring(unordered: &Unordered, describe: impl Fn(usize) -> String) -> CommandError {
    let crossings: Vec<String> = unordered.crossings.iter().map(|c| describe(*c)).collect();
    CommandError::Ring { crossings: crossings.join("; ") }
}
