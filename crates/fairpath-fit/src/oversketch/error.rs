//! Why a stroke cannot correct a curve.

use crate::result::FitError;
use thiserror::Error;

/// Why a stroke cannot correct a curve. Distances are in the curve's unit.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OversketchError {
    /// Neither end of the stroke is near the curve.
    #[error(
        "neither end of the stroke is near the curve: they are {start:.3} and {end:.3} away, and {reach:.3} is near; begin or end it on the \
         curve, or raise `reach`"
    )]
    NotNear {
        /// Distance of the stroke's first point from the curve.
        start: f64,
        /// Distance of its last point.
        end: f64,
        /// The largest distance that is near.
        reach: f64,
    },
    /// One end of the stroke is on a closed curve, the other is not.
    #[error(
        "the curve is closed and the stroke's {which} end is {distance:.3} away from it, where {reach:.3} is near; let the stroke return to \
         the curve"
    )]
    LeadsAway {
        /// First or last.
        which: &'static str,
        /// Its distance from the curve.
        distance: f64,
        /// The largest distance that is near.
        reach: f64,
    },
    /// The stroke or the options cannot be used, or no curve was found.
    #[error(transparent)]
    Fit(#[from] FitError),
}

impl OversketchError {
    /// A fixed word for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotNear { .. } => "not-near",
            Self::LeadsAway { .. } => "leads-away",
            Self::Fit(error) => error.code(),
        }
    }
}
