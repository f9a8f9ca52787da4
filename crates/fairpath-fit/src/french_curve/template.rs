//! French curves: named shapes that strokes are neatened with, and sets of them.

use fairpath_curve::{Continuity, Spline};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A French curve: a shape whose parts may become parts of a curve (McCrae and Singh 2011, section 3).
///
/// Lengths are in px of a 100 dpi screen. Where it lies and how it is turned has no meaning, only its curvature along its length and its
/// corners have. A closed template is gone round without end (section 3.2.2), and each may be turned over and be gone round either way
/// (section 3.2.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "TemplateRecord")]
pub struct Template {
    name: String,
    spline: Spline,
}

impl Template {
    /// The template of that name and shape.
    ///
    /// # Errors
    /// When the name is empty, or the shape is longer than [`Template::LONGEST`] or sharper than [`Template::SHARPEST`].
    pub fn new(name: impl Into<String>, spline: Spline) -> Result<Self, TemplateError> {
        let name = name.into();
        if name.trim().is_empty() {
            return Err(TemplateError::Unnamed);
        }
        let length = spline.length();
        if !(length <= Self::LONGEST) {
            return Err(TemplateError::TooLong { name, length });
        }
        let kappa = spline.segments().iter().fold(0.0_f64, |m, s| m.max(s.kappa0.abs()).max(s.kappa1.abs()));
        if !(kappa <= Self::SHARPEST) {
            return Err(TemplateError::TooSharp { name, kappa });
        }
        Ok(Self { name, spline })
    }

    /// The longest template, px: more is no shape to slide along but a drawing.
    pub const LONGEST: f64 = 100_000.0;

    /// The largest curvature of a template, radians per px: a tighter bend is a corner.
    pub const SHARPEST: f64 = 2.0;

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its shape.
    #[must_use]
    pub fn spline(&self) -> &Spline {
        &self.spline
    }

    /// Whether it has corners, of which the result may have some too.
    #[must_use]
    pub fn has_corners(&self) -> bool {
        self.spline.joins().contains(&Continuity::G0)
    }
}

/// French curves that are used together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "TemplateSetRecord")]
pub struct TemplateSet {
    name: String,
    templates: Vec<Template>,
}

impl TemplateSet {
    /// The set of these templates.
    ///
    /// # Errors
    /// When there is none, or two have one name.
    pub fn new(name: impl Into<String>, templates: Vec<Template>) -> Result<Self, TemplateError> {
        if templates.is_empty() {
            return Err(TemplateError::Empty);
        }
        for (i, template) in templates.iter().enumerate() {
            if templates[..i].iter().any(|other| other.name == template.name) {
                return Err(TemplateError::SameName { name: template.name.clone() });
            }
        }
        Ok(Self { name: name.into(), templates })
    }

    /// What the set is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its templates, at least one, in their order.
    #[must_use]
    pub fn templates(&self) -> &[Template] {
        &self.templates
    }
}

/// A template before it is checked.
#[derive(Deserialize)]
struct TemplateRecord {
    name: String,
    spline: Spline,
}

impl TryFrom<TemplateRecord> for Template {
    type Error = TemplateError;

    fn try_from(record: TemplateRecord) -> Result<Self, TemplateError> {
        Self::new(record.name, record.spline)
    }
}

/// A set before it is checked.
#[derive(Deserialize)]
struct TemplateSetRecord {
    name: String,
    templates: Vec<Template>,
}

impl TryFrom<TemplateSetRecord> for TemplateSet {
    type Error = TemplateError;

    fn try_from(record: TemplateSetRecord) -> Result<Self, TemplateError> {
        Self::new(record.name, record.templates)
    }
}

/// Why a shape is no French curve, or why some are no set.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TemplateError {
    /// There is no template.
    #[error("a set of French curves needs at least one")]
    Empty,
    /// A template has no name.
    #[error("a French curve needs a name, by which results tell what they were made of")]
    Unnamed,
    /// Two templates have one name.
    #[error("two French curves are called {name:?}; give each a name of its own")]
    SameName {
        /// The name.
        name: String,
    },
    /// A template is longer than [`Template::LONGEST`].
    #[error(
        "the French curve {name:?} is {length} px long, more than {}; scale it down or divide it",
        Template::LONGEST
    )]
    TooLong {
        /// Its name.
        name: String,
        /// Its length, px.
        length: f64,
    },
    /// A template bends more sharply than [`Template::SHARPEST`].
    #[error(
        "the French curve {name:?} has a curvature of {kappa} per px, more than {}; make that bend a corner",
        Template::SHARPEST
    )]
    TooSharp {
        /// Its name.
        name: String,
        /// Its largest curvature, radians per px.
        kappa: f64,
    },
}
