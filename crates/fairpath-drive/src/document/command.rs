//! What can be done to a document, as data: what the application does, a script does with the same words.

use crate::ground::{EarthworkOptions, Soil};
use crate::network::{HeightMode, Meeting, StructureLimits};
use crate::rules::DesignRules;
use crate::section::Section;
use crate::terrain::Landscape;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One command. Places are in metres in the terrain's frame, x east and y north; stations are arc lengths in plan from a path's start, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Command {
    /// Lays the terrain on which all else happens: first of all commands, and only once.
    Terrain(TerrainSource),
    /// Draws a stroke on the map.
    Sketch {
        /// Its points.
        points_m: Vec<[f64; 2]>,
        /// The layer on which it lies.
        #[serde(default = "road")]
        layer: String,
        /// The name of the path that it becomes; else it gets the layer's name with a number.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        name: Option<String>,
        /// The cross-section, by name.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        section: Option<String>,
        /// Whether it is a path of its own or belongs to one that is there.
        #[serde(default, rename = "as")]
        sketch_as: SketchAs,
        /// Whether it closes on itself.
        #[serde(default)]
        closed: bool,
        /// Size of a pixel of the stroke on the map, m: tremor of this size is evened out.
        #[serde(default = "one")]
        pixel_m: f64,
        /// No bend is tighter, m; else as the cross-section has it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        min_radius_m: Option<f64>,
    },
    /// Corrects a path by a stroke drawn over it.
    Oversketch {
        /// The stroke's points.
        points_m: Vec<[f64; 2]>,
        /// Which path; else the one that lies under it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        path: Option<String>,
        /// Size of a pixel of the stroke on the map, m.
        #[serde(default = "one")]
        pixel_m: f64,
    },
    /// Says how paths cross.
    Crossing {
        /// A place near the crossing.
        near_m: [f64; 2],
        /// What is to be done.
        set: CrossingSet,
        /// The path that shall pass over or under; where paths shall intersect it may be left out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        path: Option<String>,
        /// The path that it crosses there, where it crosses several.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        other: Option<String>,
    },
    /// Takes away what lies within a lasso, or a path as a whole.
    Delete {
        /// The lasso's outline.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        lasso_m: Option<Vec<[f64; 2]>>,
        /// A path's name; with a lasso, only of this path.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        path: Option<String>,
    },
    /// Makes two paths of one.
    Split {
        /// Which path.
        path: String,
        /// Where, arc length from its start, m.
        at_m: f64,
    },
    /// Makes one path of two, over the two ends that are nearest to each other, in the direction of the first.
    Join {
        /// The first, which keeps its name.
        path: String,
        /// The second.
        with: String,
    },
    /// Draws a roundabout.
    Roundabout {
        /// Its centre.
        at_m: [f64; 2],
        /// Its radius, m.
        radius_m: f64,
        /// Its name.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        name: Option<String>,
        /// The cross-section, by name.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        section: Option<String>,
    },
    /// Draws heights in a vertical plane along a path.
    Elevation {
        /// Which path.
        path: String,
        /// Station and height, m.
        points_m: Vec<[f64; 2]>,
    },
    /// Says how the height of a path follows the ground.
    Heights {
        /// Which path; else all of them.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        path: Option<String>,
        /// How.
        mode: HeightMode,
    },
    /// Sets the speed on what lies within a lasso, or on a whole path.
    Speed {
        /// The lasso's outline.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        lasso_m: Option<Vec<[f64; 2]>>,
        /// A path's name; with a lasso, only on this path.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        path: Option<String>,
        /// Speed, km/h.
        kmh: f64,
    },
    /// Plants a region, or clears it.
    Foliage {
        /// The region's outline.
        lasso_m: Vec<[f64; 2]>,
        /// From 0 for none to 1 for a closed wood.
        density: f64,
    },
    /// Fills a region with water up to a level.
    Water {
        /// An outline around it; what lies in it above the level is dry.
        lasso_m: Vec<[f64; 2]>,
        /// The level, m.
        level_m: f64,
    },
    /// Says what the ground is made of.
    Soil {
        /// The region's outline; else everywhere.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        lasso_m: Option<Vec<[f64; 2]>>,
        /// What it is made of.
        class: Soil,
    },
    /// Gives a path another cross-section.
    Section {
        /// Which path.
        path: String,
        /// The cross-section, by name.
        template: String,
    },
    /// Adds a cross-section, or replaces one of that name; paths that have it keep the old one.
    DefineSection {
        /// All of it.
        section: Section,
    },
    /// Moves a path to another layer.
    Layer {
        /// Which path.
        path: String,
        /// The layer's name.
        layer: String,
    },
    /// Changes what holds for the whole document.
    Settings {
        /// From which heights on there are bridges and tunnels.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        structures: Option<StructureLimits>,
        /// How the ground beside paths is shaped.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        earthwork: Option<EarthworkOptions>,
        /// The rules by which signs are posted and the design is checked.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        rules: Option<DesignRules>,
        /// The seed of everything random.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        seed: Option<u64>,
    },
}

impl Command {
    /// The word for it in a script.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Terrain(_) => "terrain",
            Self::Sketch { .. } => "sketch",
            Self::Oversketch { .. } => "oversketch",
            Self::Crossing { .. } => "crossing",
            Self::Delete { .. } => "delete",
            Self::Split { .. } => "split",
            Self::Join { .. } => "join",
            Self::Roundabout { .. } => "roundabout",
            Self::Elevation { .. } => "elevation",
            Self::Heights { .. } => "heights",
            Self::Speed { .. } => "speed",
            Self::Foliage { .. } => "foliage",
            Self::Water { .. } => "water",
            Self::Soil { .. } => "soil",
            Self::Section { .. } => "section",
            Self::DefineSection { .. } => "define-section",
            Self::Layer { .. } => "layer",
            Self::Settings { .. } => "settings",
        }
    }
}

fn road() -> String {
    "road".to_owned()
}

fn one() -> f64 {
    1.0
}

/// Where a terrain comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TerrainSource {
    /// A file of heights, beside the script.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// A landscape of nobody's survey.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub synthetic: Option<Landscape>,
    /// Samples of such a landscape each way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<usize>,
    /// From one sample to the next, m: of such a landscape, or of a picture or raw file, which does not say it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell_m: Option<f64>,
    /// Other seeds give other landscapes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Heights of black and white of a picture, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range_m: Option<[f64; 2]>,
    /// The EPSG number of the coordinates of a file that does not tell it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub epsg: Option<u32>,
    /// The number that stands for no height, as the file has it; beside the one that the file tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub void_value: Option<f64>,
    /// Length of the unit of height, m, instead of the one that the file tells: 0.3048 for feet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_unit_m: Option<f64>,
    /// What the numbers of a raw file are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub raw: Option<RawLayout>,
    /// What lies lower is under water, m; without it, there is no water.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub water_level_m: Option<f64>,
}

/// What bare numbers are: rows from the north, each from the west.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RawLayout {
    /// Samples from west to east.
    pub columns: usize,
    /// Samples from north to south.
    pub rows: usize,
    /// What each is.
    pub sample: RawSample,
    /// Whether the byte of highest value comes first.
    #[serde(default)]
    pub big_endian: bool,
}

/// A number in a file without a header.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawSample {
    /// 0 to 65,535.
    U16,
    /// -32,768 to 32,767.
    I16,
    /// Single precision.
    F32,
}

impl RawSample {
    /// How many bytes it takes.
    #[must_use]
    pub fn bytes(self) -> usize {
        match self {
            Self::U16 | Self::I16 => 2,
            Self::F32 => 4,
        }
    }
}

/// What a stroke is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SketchAs {
    /// What its ends tell: begun at the end of a path and in its direction it lengthens it, drawn along one it corrects it, else it is a new one (section 3.4.2).
    #[default]
    Auto,
    /// A path of its own.
    New,
}

/// How a crossing is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CrossingSet {
    /// The path passes over the other.
    Over,
    /// It passes under it.
    Under,
    /// They meet at one height.
    Intersect,
}

impl From<CrossingSet> for Meeting {
    fn from(set: CrossingSet) -> Self {
        match set {
            CrossingSet::Over => Self::Over,
            CrossingSet::Under => Self::Under,
            CrossingSet::Intersect => Self::Level,
        }
    }
}
