//! Corners made smooth, and smooth places made corners.

use super::{EditError, check_length, check_station, place};
use crate::splice::{Rest, Run};
use fairpath_curve::{Continuity, Pose, Segment, Spline, hermite_g2, trig};

/// The curve with three clothoids of G2 joins in place of a corner, from `reach` before it to `reach` after it; what lies beyond keeps its bits.
///
/// `join` is the index of the corner among [`Spline::joins`].
///
/// # Errors
/// When that join is no corner, the reach is not positive or longer than the curve on a side, or no clothoids were found.
pub fn smooth_corner(spline: &Spline, join: usize, reach: f64) -> Result<Spline, EditError> {
    check_length("reach", reach)?;
    if spline.joins().get(join) != Some(&Continuity::G0) {
        return Err(EditError::NotACorner { join });
    }
    let station: f64 = spline.segments()[..=join].iter().map(|s| s.length).sum();
    let [from, to] = around(spline, station, reach)?;
    let rest = Rest::of(spline, [from, to].map(|s| Some(place(spline, s))));
    let [start, end] = poses(&rest).ok_or(EditError::NoCurve { place: "around the corner", reach })?;
    let pieces = hermite_g2(start, end).ok_or(EditError::NoCurve { place: "around the corner", reach })?;
    let new = Run { segments: pieces.to_vec(), joins: vec![Continuity::G2; 2] };
    Ok(rest.with(new, [Continuity::G2; 2])?.0)
}

/// The curve with a corner near `station`: within `reach` to both sides it goes on straight to where these tangents cross; what lies beyond keeps
/// its bits.
///
/// # Errors
/// When the station is not on the curve, the reach is not positive or longer than the curve on a side, or the tangents do not cross ahead.
pub fn make_corner(spline: &Spline, station: f64, reach: f64) -> Result<Spline, EditError> {
    check_length("reach", reach)?;
    check_station(spline, station)?;
    let [from, to] = around(spline, station, reach)?;
    let rest = Rest::of(spline, [from, to].map(|s| Some(place(spline, s))));
    let [start, end] = poses(&rest).ok_or(EditError::NoCrossing)?;
    let (ahead, back) = (trig::unit(start.heading), trig::unit(end.heading));
    let gap = end.point - start.point;
    let sine = ahead.cross(back);
    let [first, second] =
        [gap.cross(back) / sine, ahead.cross(gap) / sine].map(|v| if v.is_finite() { v } else { 0.0 });
    // Nearly parallel ones would meet far away.
    if !(first > 0.0 && second > 0.0 && first.max(second) < FARTHEST * reach) {
        return Err(EditError::NoCrossing);
    }
    let corner = start.point + ahead * first;
    let lines = vec![Segment::line(start.point, start.heading, first), Segment::line(corner, end.heading, second)];
    let join = |curvature: f64| if curvature == 0.0 { Continuity::G2 } else { Continuity::G1 };
    let new = Run { segments: lines, joins: vec![Continuity::G0] };
    Ok(rest.with(new, [join(start.curvature), join(end.curvature)])?.0)
}

/// A corner further away than this many times the reach is none that one would draw.
const FARTHEST: f64 = 10.0;

/// The stations `reach` before and after one.
fn around(spline: &Spline, station: f64, reach: f64) -> Result<[f64; 2], EditError> {
    let length = spline.length();
    let ends = [station - reach, station + reach];
    let most = if spline.is_closed() { 0.5 * length } else { station.min(length - station) };
    if reach < most { Ok(ends) } else { Err(EditError::ReachTooLong { reach, length, most }) }
}

/// Where what stays ends and begins.
fn poses(rest: &Rest) -> Option<[Pose; 2]> {
    let [before, after] = rest.neighbours();
    Some([before?.end_pose(), after?.start_pose()])
}
