//! Why an edit cannot be made.

use fairpath_curve::SplineError;
use thiserror::Error;

/// Why an edit cannot be made. Lengths are in the curve's unit.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EditError {
    /// A length that must be positive is not, or is not finite.
    #[error("{name} = {value} must be a positive number")]
    NotPositive {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A coordinate, heading or curvature is not finite.
    #[error("{name} must be a finite number")]
    NotFinite {
        /// Which.
        name: &'static str,
    },
    /// There is no such place on the curve.
    #[error("station {station} is not on the curve, which is {length:.6} long; give one from 0 to that")]
    NoSuchStation {
        /// What was given.
        station: f64,
        /// Length of the curve.
        length: f64,
    },
    /// The curve has no ends.
    #[error("a closed curve has no end to {what}; cut it open first")]
    Closed {
        /// What was to be done there.
        what: &'static str,
    },
    /// The cuts leave nothing of a part.
    #[error("two cuts, or a cut and an end, are at the same place, {station}; nothing would lie between")]
    EmptyPart {
        /// Where.
        station: f64,
    },
    /// More is to be trimmed than there is.
    #[error("reach {reach} leaves nothing of a curve that is {length:.6} long; give less than {most:.6}")]
    ReachTooLong {
        /// What was given.
        reach: f64,
        /// Length of the curve.
        length: f64,
        /// What would leave something.
        most: f64,
    },
    /// There is no corner at that place.
    #[error("join {join} is no corner")]
    NotACorner {
        /// Which join was given.
        join: usize,
    },
    /// No curve was found that meets what is asked; a larger reach gives it room.
    #[error("no smooth curve was found {place}; a reach of more than {reach} may give it room")]
    NoCurve {
        /// Where.
        place: &'static str,
        /// The largest that was tried.
        reach: f64,
    },
    /// Two constraints are at one place of the curve.
    #[error(
        "constraints {first} and {second} are at the same place of the curve; give their stations, or leave one out"
    )]
    SamePlace {
        /// The one, by its place among those given.
        first: usize,
        /// The other.
        second: usize,
    },
    /// The sides of a corner would not meet.
    #[error("the tangents at both ends of that reach do not cross ahead; give another reach")]
    NoCrossing,
    /// The parts do not make a spline.
    #[error("the parts do not meet: {0}")]
    Spline(#[from] SplineError),
}

impl EditError {
    /// A fixed word for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotPositive { .. } => "not-positive",
            Self::NotFinite { .. } => "not-finite",
            Self::NoSuchStation { .. } => "no-such-station",
            Self::Closed { .. } => "closed",
            Self::EmptyPart { .. } => "empty-part",
            Self::ReachTooLong { .. } => "reach-too-long",
            Self::NotACorner { .. } => "not-a-corner",
            Self::NoCurve { .. } => "no-curve",
            Self::SamePlace { .. } => "same-place",
            Self::NoCrossing => "no-crossing",
            Self::Spline(_) => "spline",
        }
    }
}
