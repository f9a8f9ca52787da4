//! Editing a spline by hand: extending, cutting, joining, passing through points, corners. Each edit takes splines and gives splines; whatever an
//! edit does not reach keeps its bits.

mod banded;
#[cfg(test)]
mod coordinate_search;
mod corner;
mod cut;
mod error;
mod extend;
mod fairest;
mod guesses;
mod interpolate;
mod join;
mod three_clothoids;

pub use corner::{make_corner, smooth_corner};
pub use cut::cut;
pub use error::EditError;
pub use extend::{Extension, extend};
pub use interpolate::{Constraint, interpolate, interpolate_all};
pub use join::{close, join};

use crate::splice::Place;
use fairpath_curve::Spline;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An end of an open curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CurveEnd {
    /// Where it begins.
    Start,
    /// Where it ends.
    End,
}

/// A place this near to a join, as a share of the curve's length, is the join.
const AT_JOIN: f64 = 1e-12;

/// The place at a station, which on a closed curve may lie beyond its ends. At a join it is the start of the segment that begins there.
fn place(curve: &Spline, station: f64) -> Place {
    let (segment, s) = curve.locate(station);
    let length = curve.segments()[segment].length;
    let hair = AT_JOIN * curve.length();
    if s <= hair {
        return Place { segment, s: 0.0 };
    }
    if length - s <= hair {
        let next = segment + 1;
        let segment = if curve.is_closed() { next % curve.segments().len() } else { next };
        return Place { segment, s: 0.0 };
    }
    Place { segment, s }
}

/// A station within an open curve, or any on a closed one.
///
/// # Errors
/// When it is not finite, or beyond the ends of an open curve.
fn check_station(curve: &Spline, station: f64) -> Result<(), EditError> {
    let length = curve.length();
    let inside = (-1e-9 * length..=length * (1.0 + 1e-9)).contains(&station);
    if !station.is_finite() || !(inside || curve.is_closed()) {
        return Err(EditError::NoSuchStation { station, length });
    }
    Ok(())
}

/// A length that an edit takes: positive and finite.
fn check_length(name: &'static str, value: f64) -> Result<(), EditError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(EditError::NotPositive { name, value }) }
}
