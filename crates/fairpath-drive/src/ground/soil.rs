//! What the ground is made of, and how steep it can stand.

use crate::terrain::inside;
use fairpath_curve::Point;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A class of soil. Slopes are the common starting values of road design for low cuts and fills; a geotechnical survey replaces them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Soil {
    /// Sound rock: cuts stand nearly upright.
    Rock,
    /// Gravel and what stands at its angle of repose, 34°.
    #[default]
    Gravel,
    /// Sand.
    Sand,
    /// Clay and silt.
    Clay,
}

impl Soil {
    /// How far a cut runs sideways for each metre that it rises.
    #[must_use]
    pub fn cut_run(self) -> f64 {
        match self {
            Self::Rock => 0.25,
            Self::Gravel => 1.5,
            Self::Sand => 1.75,
            Self::Clay => 2.0,
        }
    }

    /// How far a fill runs sideways for each metre that it falls.
    #[must_use]
    pub fn fill_run(self) -> f64 {
        match self {
            Self::Rock => 1.25,
            Self::Gravel => 1.5,
            Self::Sand => 2.0,
            Self::Clay => 2.5,
        }
    }
}

/// A region of one soil.
#[derive(Clone, Debug, PartialEq)]
pub struct SoilRegion {
    /// Its outline, m, closed by itself.
    pub outline: Vec<Point>,
    /// What it is made of.
    pub soil: Soil,
}

/// Which soil is where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soils {
    /// Where no region says another.
    pub elsewhere: Soil,
    /// Regions; later ones lie over earlier ones.
    pub regions: Vec<SoilRegion>,
}

impl Soils {
    /// The soil at a place.
    #[must_use]
    pub fn at(&self, place: Point) -> Soil {
        let region = self.regions.iter().rev().find(|r| inside(&r.outline, place));
        region.map_or(self.elsewhere, |r| r.soil)
    }
}
