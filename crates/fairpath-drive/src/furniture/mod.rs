//! What stands along paths: signs and trees.

mod foliage;
mod pillars;
mod signs;

pub use foliage::Tree;
pub use pillars::{Pillar, pillars};
pub use signs::{Sign, SignKind};

pub(crate) use foliage::{CLEAR_M, DRY_M, standing, tiles_of, wild_trees_on};
pub(crate) use signs::{signs, stopping_arms};
