//! Why a spline has no surface.

use thiserror::Error;

/// Why a spline cannot be inflated. Places are in the spline's own unit and frame.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InflateError {
    /// The spline is open, so it encloses nothing.
    #[error("the curve is open and encloses nothing: close it, for example by fitting it as a closed stroke")]
    Open,
    /// The spline is too small for the numbers that its place is given in, or encloses nothing.
    #[error(
        "the curve is {size:e} across at {reach:e} from the origin, too little to tell inside from outside: scale it or move it"
    )]
    TooSmall {
        /// Larger side of the bounding box.
        size: f64,
        /// Largest magnitude of a coordinate.
        reach: f64,
    },
    /// The spline is too large to be squared.
    #[error("the curve reaches beyond ±{limit:e}: scale it down")]
    TooLarge {
        /// Largest magnitude that is allowed.
        limit: f64,
    },
    /// The spline winds so much that its triangles would be too many.
    #[error("the curve turns by {turning:.0} rad in all, more than {limit:.0}: inflate a simpler part of it")]
    TooWinding {
        /// Sum of all turning, radians.
        turning: f64,
        /// Most that is allowed, radians.
        limit: f64,
    },
    /// The spline crosses, touches or retraces itself.
    #[error(
        "the curve meets itself {} at ({x:.6}, {y:.6}), after {first:.6} and after {second:.6} of its length: draw an outline that does not",
        if *.count > 1 { format!("in {count} places, first") } else { String::from("once,") }
    )]
    MeetsItself {
        /// Where, in the spline's frame.
        x: f64,
        /// Where, in the spline's frame.
        y: f64,
        /// Arc length of the earlier passage.
        first: f64,
        /// Arc length of the later passage.
        second: f64,
        /// In how many places it does.
        count: usize,
    },
    /// Two stretches of the spline come so near to each other that no triangles fit between them.
    #[error("the curve comes too near to itself at about ({x:.6}, {y:.6}) to be filled with triangles: widen it there")]
    TooNarrow {
        /// Where, in the spline's frame.
        x: f64,
        /// Where, in the spline's frame.
        y: f64,
    },
    /// The surface would need more triangles than allowed.
    #[error("the surface needs more than {limit} triangles: ask for fewer by `triangles`, or for less accuracy")]
    TooManyTriangles {
        /// Most that are allowed.
        limit: usize,
    },
    /// The equation of the height was not solved within the limit of work.
    #[error("the heights are only known to {residual:e} after {iterations} iterations: ask for fewer triangles")]
    NotSolved {
        /// Relative size of what is left.
        residual: f64,
        /// Iterations made.
        iterations: usize,
    },
    /// An option has a value that makes no sense.
    #[error("`{name}` is {value}: expected {expected}")]
    BadOption {
        /// The option's name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would do.
        expected: &'static str,
    },
}

impl InflateError {
    /// A fixed word for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::TooSmall { .. } => "too-small",
            Self::TooLarge { .. } => "too-large",
            Self::TooWinding { .. } => "too-winding",
            Self::MeetsItself { .. } => "meets-itself",
            Self::TooNarrow { .. } => "too-narrow",
            Self::TooManyTriangles { .. } => "too-many-triangles",
            Self::NotSolved { .. } => "not-solved",
            Self::BadOption { .. } => "bad-option",
        }
    }
}
