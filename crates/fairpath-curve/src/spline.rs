//! A chain of segments with the continuity of each join.

use crate::segment::Segment;
use crate::trig::wrap_angle;
use thiserror::Error;

/// The continuity of a join that holds exactly, that is, to rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
pub enum Continuity {
    /// Position: a corner.
    G0,
    /// Position and heading.
    G1,
    /// Position, heading and curvature.
    G2,
    /// Position, heading, curvature and its slope.
    G3,
}

/// A curve of segments, each beginning where the one before ends.
///
/// Joins: `joins()[i]` lies between segment `i` and `i + 1`; a closed spline has one more, from the last segment to the first.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "crate::record::SplineRecord", try_from = "crate::record::SplineRecord"))]
pub struct Spline {
    segments: Vec<Segment>,
    joins: Vec<Continuity>,
    closed: bool,
}

/// Why segments and joins do not make a spline.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SplineError {
    /// There is no segment.
    #[error("a spline needs at least one segment")]
    Empty,
    /// The number of joins does not fit the number of segments.
    #[error("{joins} joins for {segments} segments: {expected} are needed")]
    JoinCount {
        /// Segments given.
        segments: usize,
        /// Joins given.
        joins: usize,
        /// Joins needed: one fewer than segments if open, as many if closed.
        expected: usize,
    },
    /// A segment has a value that is not finite or a length that is not positive.
    #[error("segment {index} has a value that is not finite or a length that is not positive")]
    InvalidSegment {
        /// Which, from 0.
        index: usize,
    },
    /// The segments do not meet as the join claims.
    #[error("join {index} is declared {claimed:?}, but its {what} differs by {gap:e}")]
    Gap {
        /// Which join, from 0.
        index: usize,
        /// What it claims.
        claimed: Continuity,
        /// Position, heading, curvature or curvature slope.
        what: &'static str,
        /// By how much it fails.
        gap: f64,
    },
}

/// Gaps of at most this are rounding: times the drawing's size for positions, times 1 rad for headings and times the largest
/// curvature nearby for curvatures.
pub const JOIN_TOLERANCE: f64 = 1e-9;

impl Spline {
    /// A spline of `segments` whose joins hold what `joins` claims, within [`JOIN_TOLERANCE`].
    ///
    /// # Errors
    /// When the counts do not agree, a segment is invalid, or a join does not hold its claim.
    pub fn new(segments: Vec<Segment>, joins: Vec<Continuity>, closed: bool) -> Result<Self, SplineError> {
        if segments.is_empty() {
            return Err(SplineError::Empty);
        }
        let expected = segments.len() - usize::from(!closed);
        if joins.len() != expected {
            return Err(SplineError::JoinCount { segments: segments.len(), joins: joins.len(), expected });
        }
        if let Some(index) = segments.iter().position(|s| !s.is_valid()) {
            return Err(SplineError::InvalidSegment { index });
        }
        let size = segments.iter().fold(1.0_f64, |m, s| m.max(s.start.x.abs()).max(s.start.y.abs()).max(s.length));
        for (index, &claimed) in joins.iter().enumerate() {
            let (a, b) = (&segments[index], &segments[(index + 1) % segments.len()]);
            let end = a.end_pose();
            let kappa_scale = [a.kappa0, a.kappa1, b.kappa0, b.kappa1].iter().fold(1.0_f64, |m, k| m.max(k.abs()));
            let slope_gap = (a.sharpness() - b.sharpness()).abs();
            let checks = [
                (Continuity::G0, "position", (end.point - b.start).hypot(), JOIN_TOLERANCE * size),
                (Continuity::G1, "heading", wrap_angle(end.heading - b.heading).abs(), JOIN_TOLERANCE),
                (Continuity::G2, "curvature", (end.curvature - b.kappa0).abs(), JOIN_TOLERANCE * kappa_scale),
                (
                    Continuity::G3,
                    "curvature slope",
                    slope_gap,
                    JOIN_TOLERANCE * kappa_scale / a.length.min(b.length).min(1.0),
                ),
            ];
            for (level, what, gap, limit) in checks {
                if claimed >= level && gap > limit {
                    return Err(SplineError::Gap { index, claimed, what, gap });
                }
            }
        }
        Ok(Self { segments, joins, closed })
    }

    /// A spline of parts that are known to fit: those of another spline, moved or cut.
    pub(crate) fn from_parts(segments: Vec<Segment>, joins: Vec<Continuity>, closed: bool) -> Self {
        debug_assert_eq!(joins.len() + usize::from(!closed), segments.len());
        Self { segments, joins, closed }
    }

    /// The segments in order of travel.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The continuity of the joins; see [`Spline`].
    #[must_use]
    pub fn joins(&self) -> &[Continuity] {
        &self.joins
    }

    /// Whether the last segment runs back into the first.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Total arc length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|s| s.length).sum()
    }
}
