//! The written forms of a segment and of a spline, as in the file format fairpath-spline 1.

use crate::segment::{Kind, Segment};
use crate::spline::{Continuity, Spline, SplineError};
use kurbo::Point;
use serde::{Deserialize, Serialize};

/// A segment as it stands in a file: `{"kind","x","y","heading","length","kappa0","kappa1"}`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[schemars(rename = "Segment")]
pub struct SegmentRecord {
    /// Follows from the curvatures; written for the reader's convenience and not needed when reading.
    #[serde(default, skip_deserializing)]
    pub kind: Option<Kind>,
    /// x of the start, in the file's unit.
    pub x: f64,
    /// y of the start, in the file's unit.
    pub y: f64,
    /// Heading at the start, radians.
    pub heading: f64,
    /// Arc length, in the file's unit.
    pub length: f64,
    /// Curvature at the start, radians per unit.
    pub kappa0: f64,
    /// Curvature at the end, radians per unit.
    pub kappa1: f64,
}

impl From<Segment> for SegmentRecord {
    fn from(s: Segment) -> Self {
        Self {
            kind: Some(s.kind()),
            x: s.start.x,
            y: s.start.y,
            heading: s.heading,
            length: s.length,
            kappa0: s.kappa0,
            kappa1: s.kappa1,
        }
    }
}

impl From<SegmentRecord> for Segment {
    fn from(r: SegmentRecord) -> Self {
        Self { start: Point::new(r.x, r.y), heading: r.heading, length: r.length, kappa0: r.kappa0, kappa1: r.kappa1 }
    }
}

impl schemars::JsonSchema for Segment {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        SegmentRecord::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        SegmentRecord::json_schema(generator)
    }
}

/// A spline as it is written: `{"closed","segments","joins"}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[schemars(rename = "Spline")]
pub struct SplineRecord {
    /// Whether the last segment runs back into the first.
    pub closed: bool,
    /// The segments in order of travel.
    pub segments: Vec<SegmentRecord>,
    /// What holds at each join.
    pub joins: Vec<Continuity>,
}

impl From<Spline> for SplineRecord {
    fn from(spline: Spline) -> Self {
        Self {
            closed: spline.is_closed(),
            segments: spline.segments().iter().map(|&segment| segment.into()).collect(),
            joins: spline.joins().to_vec(),
        }
    }
}

impl TryFrom<SplineRecord> for Spline {
    type Error = SplineError;

    fn try_from(record: SplineRecord) -> Result<Self, SplineError> {
        let segments = record.segments.into_iter().map(Segment::from).collect();
        Self::new(segments, record.joins, record.closed)
    }
}
