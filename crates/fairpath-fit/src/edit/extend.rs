//! Lengthening a curve beyond an end.

use super::{CurveEnd, EditError, check_length};
use fairpath_curve::{Continuity, Kind, Segment, Spline};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a curve goes on beyond its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Extension {
    /// With the curvature that it has at its end: as a line or an arc.
    #[default]
    Curvature,
    /// With curvature that goes on changing as it did: the last segment becomes longer.
    Sharpness,
    /// As a straight line.
    Straight,
}

/// The curve with `length` more beyond one of its ends.
///
/// Where it goes on as its last segment does, that becomes longer; else a segment is added, joined G2, or G1 where it is straight and the curve is
/// not. All other segments keep their bits.
///
/// # Errors
/// When the curve is closed, or the length is not positive.
pub fn extend(spline: &Spline, end: CurveEnd, length: f64, how: Extension) -> Result<Spline, EditError> {
    check_length("length", length)?;
    if spline.is_closed() {
        return Err(EditError::Closed { what: "extend" });
    }
    let (mut segments, mut joins) = (spline.segments().to_vec(), spline.joins().to_vec());
    let at = if end == CurveEnd::Start { 0 } else { segments.len() - 1 };
    let old = segments[at];
    let goes_on = match how {
        Extension::Sharpness => true,
        Extension::Curvature => old.kind() != Kind::Clothoid,
        Extension::Straight => old.kind() == Kind::Line,
    };
    if goes_on {
        segments[at] = longer(&old, end, length);
        return Ok(Spline::new(segments, joins, false)?);
    }
    let pose = if end == CurveEnd::Start { old.start_pose() } else { old.end_pose() };
    let kappa = if how == Extension::Straight { 0.0 } else { pose.curvature };
    let join = if kappa == pose.curvature { Continuity::G2 } else { Continuity::G1 };
    let from = Segment::arc(pose.point, pose.heading, length, kappa);
    if end == CurveEnd::Start {
        let back = from.pose_at(-length);
        segments.insert(0, Segment::arc(back.point, back.heading, length, kappa));
        joins.insert(0, join);
    } else {
        segments.push(from);
        joins.push(join);
    }
    Ok(Spline::new(segments, joins, false)?)
}

/// A segment that goes on as it is.
fn longer(segment: &Segment, end: CurveEnd, by: f64) -> Segment {
    let is_clothoid = segment.kind() == Kind::Clothoid;
    let (old, length) = (segment.length, segment.length + by);
    if end == CurveEnd::End {
        let kappa1 = if is_clothoid { segment.curvature_at(length) } else { segment.kappa1 };
        return Segment { length, kappa1, ..*segment };
    }
    let back = segment.pose_at(old - length);
    let kappa0 = if is_clothoid { back.curvature } else { segment.kappa0 };
    Segment { start: back.point, heading: back.heading, length, kappa0, kappa1: segment.kappa1 }
}
