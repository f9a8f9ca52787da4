//! `fairpath-edits 1`: edits of splines as JSON, in the order in which they are to be made.

use crate::error::Error;
use crate::input::{label, open, read_all, text};
use crate::limits::ReadOptions;
use crate::listed::Listed;
use fairpath_curve::Continuity;
use fairpath_fit::{CurveEnd, Extension};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::io::Read;
use std::path::Path;

/// The word in the file's `format`.
const FORMAT: &str = "fairpath-edits";

/// A file of edits as it is written; this is what the schema describes.
#[derive(Serialize, JsonSchema)]
#[schemars(title = "fairpath-edits 1")]
pub(crate) struct EditsRecord {
    /// Always `fairpath-edits`.
    #[schemars(extend("const" = "fairpath-edits"))]
    format: String,
    /// Always 1.
    #[schemars(extend("const" = 1))]
    version: u64,
    /// What is to be done, in order.
    edits: Vec<Edit>,
}

/// One edit. Lengths, stations and coordinates are in the unit and frame of the splines, angles in radians.
///
/// A spline is named by `spline`; without it, the only one of the file is meant, or the one nearest to a point where there is one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Edit {
    /// Lengthens a curve beyond an end.
    Extend {
        /// Which spline.
        #[serde(default)]
        spline: Option<String>,
        /// Beyond which end.
        end: CurveEnd,
        /// By how much.
        length: f64,
        /// How it goes on.
        #[serde(default)]
        how: Extension,
    },
    /// Cuts a curve. The parts are named after it with `/1`, `/2` and so on; one part alone keeps the name.
    Cut {
        /// Which spline.
        #[serde(default)]
        spline: Option<String>,
        /// Arc lengths from its start.
        #[schemars(length(min = 1))]
        stations: Vec<f64>,
        /// Which parts stay, counted from 1; all if absent.
        #[serde(default)]
        keep: Option<Vec<usize>>,
    },
    /// Joins a curve to another one, which is then no more.
    Join {
        /// Which spline, and which end of it.
        #[serde(default)]
        spline: Option<String>,
        /// Which end of it.
        end: CurveEnd,
        /// The other spline.
        with: String,
        /// Which end of that.
        with_end: CurveEnd,
        /// How smoothly.
        continuity: Continuity,
        /// How far both are cut back first.
        #[serde(default)]
        reach: f64,
    },
    /// Joins the ends of a curve.
    Close {
        /// Which spline.
        #[serde(default)]
        spline: Option<String>,
        /// How smoothly.
        continuity: Continuity,
        /// How far both ends are cut back first.
        #[serde(default)]
        reach: f64,
    },
    /// Makes a curve pass through a point, and through others.
    Interpolate {
        /// Which spline.
        #[serde(default)]
        spline: Option<String>,
        /// Where it shall pass.
        point: [f64; 2],
        /// Which place of the curve shall be there, as arc length from its start; the nearest if absent.
        #[serde(default)]
        station: Option<f64>,
        /// Direction there; chosen if absent.
        #[serde(default)]
        heading: Option<f64>,
        /// Curvature there; chosen if absent.
        #[serde(default)]
        curvature: Option<f64>,
        /// Others that shall be met by the same change.
        #[serde(default)]
        and: Vec<Through>,
        /// How far to both sides the curve may change, along it.
        reach: f64,
    },
    /// Makes a corner smooth.
    SmoothCorner {
        /// Which spline.
        #[serde(default)]
        spline: Option<String>,
        /// The corner nearest to this point.
        near: [f64; 2],
        /// How far to both sides the curve changes.
        reach: f64,
    },
    /// Makes a corner.
    MakeCorner {
        /// Which spline.
        #[serde(default)]
        spline: Option<String>,
        /// At the place of the curve that is nearest to this point.
        near: [f64; 2],
        /// How far to both sides the curve changes.
        reach: f64,
    },
}

/// A point that a curve shall pass through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Through {
    /// Where it shall be.
    pub point: [f64; 2],
    /// Which place of the curve shall be there, as arc length from its start; the nearest if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub station: Option<f64>,
    /// Direction there; chosen if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading: Option<f64>,
    /// Curvature there; chosen if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curvature: Option<f64>,
}

impl Edit {
    /// The word for it in a file.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Extend { .. } => "extend",
            Self::Cut { .. } => "cut",
            Self::Join { .. } => "join",
            Self::Close { .. } => "close",
            Self::Interpolate { .. } => "interpolate",
            Self::SmoothCorner { .. } => "smooth-corner",
            Self::MakeCorner { .. } => "make-corner",
        }
    }
}

/// The edits of a file; `-` is standard input.
///
/// # Errors
/// When the file cannot be opened, goes beyond the limits or breaks the format's rules; every edit with a problem is named.
pub fn read_edits(path: &Path, options: &ReadOptions) -> Result<Vec<Edit>, Error> {
    read_edits_from(open(path)?, &label(path), options)
}

/// The edits that `reader` gives; `name` stands for the file in messages.
///
/// # Errors
/// As [`read_edits`].
pub fn read_edits_from(reader: impl Read, name: &str, options: &ReadOptions) -> Result<Vec<Edit>, Error> {
    let parsed = || {
        let bytes = read_all(reader, &options.limits)?;
        let listed = Listed { format: FORMAT, list: "edits", one: "edit" };
        text(&bytes).and_then(|text| listed.parse(text, &options.limits, |value, _| serde_json::from_value(value)))
    };
    parsed().map_err(|fault| fault.in_file(name))
}
