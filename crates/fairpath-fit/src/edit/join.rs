//! Joining two curves, or the ends of one.

use super::{CurveEnd, EditError};
use fairpath_curve::{Continuity, Pose, Segment, Spline, hermite_g1, hermite_g2, trig};

/// One curve of two: from the other end of `a` to the end that is named, over to the named end of `b`, and on to its other end.
///
/// Both are cut back by `reach` first, and a piece is put between: a line for G0, one clothoid for G1, three for G2 (and for G3, which is not
/// promised). With reach 0 and ends that meet already as they should, nothing is put between. What lies beyond the reach keeps its bits; of a curve
/// that has to be turned round, those of [`Spline::reversed`].
///
/// # Errors
/// When a curve is closed or no longer than the reach, the reach is negative, or no piece meets both ends.
pub fn join(
    a: &Spline,
    end_a: CurveEnd,
    b: &Spline,
    end_b: CurveEnd,
    continuity: Continuity,
    reach: f64,
) -> Result<Spline, EditError> {
    if a.is_closed() || b.is_closed() {
        return Err(EditError::Closed { what: "join" });
    }
    check_reach(reach)?;
    let turned = |spline: &Spline, as_it_is| if as_it_is { spline.clone() } else { spline.reversed() };
    let first = trimmed(&turned(a, end_a == CurveEnd::End), 0.0, reach)?;
    let second = trimmed(&turned(b, end_b == CurveEnd::Start), reach, 0.0)?;
    let (between, joins) = bridge(first.end_pose(), second.start_pose(), continuity, reach)?;
    let segments = [first.segments(), &between, second.segments()].concat();
    let joins = [first.joins(), &joins, second.joins()].concat();
    Ok(Spline::new(segments, joins, false)?)
}

/// The closed curve that an open one becomes when its ends are joined; see [`join`].
///
/// # Errors
/// As [`join`].
pub fn close(spline: &Spline, continuity: Continuity, reach: f64) -> Result<Spline, EditError> {
    if spline.is_closed() {
        return Err(EditError::Closed { what: "join" });
    }
    check_reach(reach)?;
    let open = trimmed(spline, reach, reach)?;
    let (between, joins) = bridge(open.end_pose(), open.start_pose(), continuity, reach)?;
    let segments = [open.segments(), &between].concat();
    let joins = [open.joins(), &joins].concat();
    Ok(Spline::new(segments, joins, true)?)
}

fn check_reach(reach: f64) -> Result<(), EditError> {
    if reach.is_finite() && reach >= 0.0 { Ok(()) } else { Err(EditError::NotPositive { name: "reach", value: reach }) }
}

/// A curve cut back at both ends.
fn trimmed(spline: &Spline, at_start: f64, at_end: f64) -> Result<Spline, EditError> {
    if at_start == 0.0 && at_end == 0.0 {
        return Ok(spline.clone());
    }
    let length = spline.length();
    let reach = at_start.max(at_end);
    let sides = f64::from(u8::from(at_start > 0.0) + u8::from(at_end > 0.0));
    let left = spline.subspline(at_start, length - at_end);
    left.ok_or(EditError::ReachTooLong { reach, length, most: length / sides })
}

/// Segments from one pose to another, and the joins before, between and after them.
fn bridge(
    from: Pose,
    to: Pose,
    continuity: Continuity,
    reach: f64,
) -> Result<(Vec<Segment>, Vec<Continuity>), EditError> {
    let gap = to.point - from.point;
    let distance = gap.hypot2().sqrt();
    if meets(from, to, continuity, distance) {
        return Ok((Vec::new(), vec![continuity]));
    }
    let none = || EditError::NoCurve { place: "between the two ends", reach };
    let segments = match continuity {
        Continuity::G0 => vec![Segment::line(from.point, trig::angle_of(gap), distance)],
        Continuity::G1 => vec![hermite_g1(from.point, from.heading, to.point, to.heading).ok_or_else(none)?],
        Continuity::G2 | Continuity::G3 => hermite_g2(from, to).ok_or_else(none)?.to_vec(),
    };
    let joins = vec![continuity.min(Continuity::G2); segments.len() + 1];
    Ok((segments, joins))
}

/// Whether two poses meet already.
fn meets(from: Pose, to: Pose, continuity: Continuity, distance: f64) -> bool {
    let size = 1.0 + from.point.to_vec2().hypot2().sqrt();
    let turn = trig::wrap_angle(to.heading - from.heading).abs();
    let bend = (to.curvature - from.curvature).abs();
    let scale = 1.0 + from.curvature.abs();
    distance <= MEETING * size
        && (continuity < Continuity::G1 || turn <= MEETING)
        && (continuity < Continuity::G2 || bend <= MEETING * scale)
        && continuity < Continuity::G3
}

/// Half of what a spline's joins may miss.
const MEETING: f64 = 5e-10;
