//! Units of length and the direction of the y axis, as files label them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The unit of a file's coordinates and lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Unit {
    /// Pixels of a screen, about 100 to the inch unless the file gives its `dpi`.
    #[default]
    Px,
    /// Points, 72 to the inch.
    Pt,
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
    /// Kilometres.
    Km,
    /// Inches.
    In,
    /// Feet of 0.3048 m.
    Ft,
}

impl Unit {
    /// All units.
    pub const ALL: [Self; 8] = [Self::Px, Self::Pt, Self::Mm, Self::Cm, Self::M, Self::Km, Self::In, Self::Ft];

    /// The word that files use, such as `mm`.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Px => "px",
            Self::Pt => "pt",
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::M => "m",
            Self::Km => "km",
            Self::In => "in",
            Self::Ft => "ft",
        }
    }

    /// Size in this unit of a pixel of a 100 dpi screen, in which lengths among the fitter's parameters and those of French curves are.
    ///
    /// On paper that is a hundredth of an inch. Drawings in metres, kilometres and feet are maps, where it would be absurd: there a pixel
    /// is a metre.
    #[must_use]
    pub const fn pixel_size(self) -> f64 {
        match self {
            Self::Px => 1.0,
            Self::Pt => 72.0 / 100.0,
            Self::Mm => 25.4 / 100.0,
            Self::Cm => 2.54 / 100.0,
            Self::In => 1.0 / 100.0,
            Self::M => 1.0,
            Self::Km => 0.001,
            Self::Ft => 1.0 / 0.3048,
        }
    }

    /// Length of one unit in metres. A pixel counts as a hundredth of an inch.
    #[must_use]
    pub const fn metres(self) -> f64 {
        match self {
            Self::Px => 0.000_254,
            Self::Pt => 0.0254 / 72.0,
            Self::Mm => 0.001,
            Self::Cm => 0.01,
            Self::M => 1.0,
            Self::Km => 1000.0,
            Self::In => 0.0254,
            Self::Ft => 0.3048,
        }
    }

    /// The unit of that word, if it is one.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|u| u.as_str() == word)
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// Where the y axis points. A label: coordinates are never changed because of it unless the caller asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum YAxis {
    /// Down, as on screens: positive curvature turns right.
    #[default]
    Down,
    /// Up, as in mathematics and on maps: positive curvature turns left.
    Up,
}

impl YAxis {
    /// The word that files use: `down` or `up`.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Down => "down",
            Self::Up => "up",
        }
    }

    /// The direction of that word, if it is one.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        [Self::Down, Self::Up].into_iter().find(|y| y.as_str() == word)
    }
}
