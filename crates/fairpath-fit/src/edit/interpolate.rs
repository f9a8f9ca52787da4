//! Curves through given points (section 5.3 of McCrae and Singh 2008): a spline and constraints come in, a spline that meets them exactly
//! goes out, changed near them only.
//!
//! Their quintic Hermite splines are three clothoids each here, which meet position, heading and curvature at both ends as well. What a
//! constraint leaves open, heading or curvature, is chosen so that curvature varies least.

use super::fairest::{Passed, fairest};
use super::{EditError, check_length, check_station, place};
use crate::splice::{Place, Rest, Run};
use fairpath_curve::{Continuity, Point, Pose, Segment, Spline};

/// A place through which a curve shall pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// The place of the curve that shall be moved there, as arc length from its start; the nearest one if absent.
    pub station: Option<f64>,
    /// Where it shall be.
    pub point: Point,
    /// Direction in which it shall pass, radians; chosen if absent.
    pub heading: Option<f64>,
    /// Curvature that it shall have there; chosen if absent.
    pub curvature: Option<f64>,
}

impl Constraint {
    /// A point that the curve shall pass through where it comes nearest already.
    #[must_use]
    pub const fn through(point: Point) -> Self {
        Self { station: None, point, heading: None, curvature: None }
    }

    /// A place of the curve that shall be moved to a point.
    #[must_use]
    pub const fn moved(station: f64, point: Point) -> Self {
        Self { station: Some(station), ..Self::through(point) }
    }
}

/// The curve through a point, changed only within `reach` along it to both sides of the place that is moved, with G2 joins where it changes.
///
/// Corners stay where they are: the change ends there if one is nearer. If no clothoids are found, up to 2.25 times the reach is tried. An end of
/// an open curve is moved with all that lies within the reach of it.
///
/// # Errors
/// When a number is not finite, the reach is not positive, the station is not on the curve, or no clothoids were found.
pub fn interpolate(spline: &Spline, constraint: &Constraint, reach: f64) -> Result<Spline, EditError> {
    interpolate_all(spline, std::slice::from_ref(constraint), reach)
}

/// The curve through several points; see [`interpolate`]. Between two whose reaches overlap all of the curve is new.
///
/// # Errors
/// As [`interpolate`], and when two constraints are at the same place of the curve.
pub fn interpolate_all(spline: &Spline, constraints: &[Constraint], reach: f64) -> Result<Spline, EditError> {
    check_length("reach", reach)?;
    let mut knots = Vec::with_capacity(constraints.len());
    for (index, constraint) in constraints.iter().enumerate() {
        knots.push(Knot::of(spline, constraint, index)?);
    }
    knots.sort_by(|a, b| a.station.total_cmp(&b.station));
    for pair in knots.windows(2) {
        if pair[1].station - pair[0].station <= APART * spline.length() {
            return Err(EditError::SamePlace { first: pair[0].index, second: pair[1].index });
        }
    }
    let groups = groups(spline, knots, reach);
    let room = room(spline, &groups);
    let mut curve = spline.clone();
    // Later ones first: stations before them stay as they are. One that runs on through the start of a closed curve would move them all: it is the
    // last, and moves by what the others have made the curve longer.
    let around = |i: &usize| groups[*i].iter().any(|k| k.station >= spline.length());
    let (last, order): (Vec<usize>, Vec<usize>) =
        (0..groups.len()).rev().partition(|i| spline.is_closed() && around(i));
    for i in order.into_iter().chain(last) {
        let longer = if spline.is_closed() && around(&i) { curve.length() - spline.length() } else { 0.0 };
        let group: Vec<Knot> = groups[i].iter().map(|k| Knot { station: k.station + longer, ..*k }).collect();
        let widths = [1.0, 1.5, 2.25].map(|factor| (factor * reach).min(reach.max(room[i])));
        let found = widths.iter().find_map(|&width| through(&curve, &group, width));
        curve = found.ok_or(EditError::NoCurve { place: "through the point", reach: widths[2] })??;
    }
    Ok(curve)
}

/// How far the change of each group may reach without touching those of its neighbours.
fn room(spline: &Spline, groups: &[Vec<Knot>]) -> Vec<f64> {
    let n = groups.len();
    let length = spline.length();
    let ends = |i: usize| (groups[i][0].station, groups[i][groups[i].len() - 1].station);
    let gap = |i: usize, j: usize| {
        let apart = ends(j).0 - ends(i).1;
        if j > i { apart } else { apart + length }
    };
    (0..n)
        .map(|i| {
            let wraps = spline.is_closed() && n > 1;
            let before = if i > 0 {
                gap(i - 1, i)
            } else if wraps {
                gap(n - 1, 0)
            } else {
                f64::INFINITY
            };
            let after = if i + 1 < n {
                gap(i, i + 1)
            } else if wraps {
                gap(n - 1, 0)
            } else {
                f64::INFINITY
            };
            0.5 * before.min(after)
        })
        .collect()
}

/// Places nearer than this to each other, as a share of the curve's length, are one.
const APART: f64 = 1e-9;

/// A constraint with its place, and what the curve has there now.
#[derive(Clone, Copy)]
struct Knot {
    index: usize,
    station: f64,
    pose: Pose,
    /// Whether heading and curvature may be chosen.
    free: [bool; 2],
}

impl Knot {
    fn of(spline: &Spline, constraint: &Constraint, index: usize) -> Result<Self, EditError> {
        let Constraint { station, point, heading, curvature } = *constraint;
        for (name, value) in [("point x", point.x), ("point y", point.y)] {
            if !value.is_finite() {
                return Err(EditError::NotFinite { name });
            }
        }
        for (name, value) in [("heading", heading), ("curvature", curvature)] {
            if value.is_some_and(|v| !v.is_finite()) {
                return Err(EditError::NotFinite { name });
            }
        }
        let station = match station {
            Some(station) => {
                check_station(spline, station)?;
                if spline.is_closed() {
                    station.rem_euclid(spline.length())
                } else {
                    station.clamp(0.0, spline.length())
                }
            }
            None => {
                let near = spline.nearest(point);
                spline.station(near.segment, near.s)
            }
        };
        let now = spline.pose_at(station);
        let pose =
            Pose { point, heading: heading.unwrap_or(now.heading), curvature: curvature.unwrap_or(now.curvature) };
        Ok(Self { index, station, pose, free: [heading.is_none(), curvature.is_none()] })
    }
}

/// Knots whose reaches overlap, together. Around a closed curve the last may belong to the first; their stations are then counted on.
fn groups(spline: &Spline, knots: Vec<Knot>, reach: f64) -> Vec<Vec<Knot>> {
    let mut groups: Vec<Vec<Knot>> = Vec::new();
    for knot in knots {
        match groups.last_mut() {
            Some(group) if knot.station - group[group.len() - 1].station < 2.0 * reach => group.push(knot),
            _ => groups.push(vec![knot]),
        }
    }
    let n = groups.len();
    if spline.is_closed() && n > 1 {
        let length = spline.length();
        let last = groups[n - 1][groups[n - 1].len() - 1].station;
        if groups[0][0].station + length - last < 2.0 * reach {
            let first = groups.remove(0);
            let moved = first.into_iter().map(|k| Knot { station: k.station + length, ..k });
            groups[n - 2].extend(moved);
        }
    }
    groups
}

/// The curve through a group of knots; nothing if no clothoids were found.
fn through(curve: &Spline, group: &[Knot], reach: f64) -> Option<Result<Spline, EditError>> {
    let (first, last) = (group[0].station, group[group.len() - 1].station);
    let [from, to] = ends(curve, first, last, reach)?;
    let rest = Rest::of(curve, [from, to].map(|end| end.place));
    let [before, after] = rest.neighbours();
    let held = |neighbour: Option<Pose>, end: &Anchor, station: f64| {
        let moves_end = (station - end.station).abs() <= APART * curve.length();
        match neighbour {
            // A corner stays where it is, but the curve comes to it as it did.
            Some(pose) if end.corner => Some(Pose { point: pose.point, ..end.pose }),
            Some(pose) => Some(pose),
            None => (!moves_end).then_some(end.pose),
        }
    };
    let start = held(before.map(Segment::end_pose), &from, first);
    let end = held(after.map(Segment::start_pose), &to, last);
    let held = |pose| Passed { pose, free: [false; 2] };
    let knots = group.iter().map(|knot| Passed { pose: knot.pose, free: knot.free });
    let passed: Vec<Passed> = start.map(held).into_iter().chain(knots).chain(end.map(held)).collect();
    let mut new = Run { segments: fairest(&passed)?, ..Run::default() };
    new.joins = vec![Continuity::G2; new.segments.len().checked_sub(1)?];
    let joins = [from, to].map(|end| if end.corner { Continuity::G0 } else { Continuity::G2 });
    Some(rest.with(new, joins).map(|(spline, _)| spline).map_err(EditError::from))
}

/// Where a change ends.
#[derive(Clone, Copy)]
struct Anchor {
    station: f64,
    /// Nothing at the curve's end.
    place: Option<Place>,
    /// The pose of the old curve, on the side of the change.
    pose: Pose,
    corner: bool,
}

/// How far a change reaches to both sides; nothing if it would reach around a closed curve to itself.
fn ends(curve: &Spline, first: f64, last: f64, reach: f64) -> Option<[Anchor; 2]> {
    let length = curve.length();
    let reach = if curve.is_closed() { reach.min(0.5 * (length - (last - first)) * NOT_ALL) } else { reach };
    if !(reach > 0.0) {
        return None;
    }
    Some([anchor(curve, first, reach, false), anchor(curve, last, reach, true)])
}

/// The share of a closed curve that a change may take up at most.
const NOT_ALL: f64 = 0.9;

fn anchor(curve: &Spline, from: f64, reach: f64, ahead: bool) -> Anchor {
    let length = curve.length();
    let outward = if ahead { 1.0 } else { -1.0 };
    let mut away = reach;
    let mut corner = false;
    let turns = if curve.is_closed() { -1..=2 } else { 0..=0 };
    let mut knot = 0.0;
    for (i, segment) in curve.segments().iter().enumerate() {
        knot += segment.length;
        if curve.joins().get(i) == Some(&Continuity::G0) {
            for turn in turns.clone() {
                let d = outward * (knot + f64::from(turn) * length - from);
                if d > APART * length && d < away + APART * length {
                    (away, corner) = (d, true);
                }
            }
        }
    }
    let mut station = from + outward * away;
    let past = !curve.is_closed() && (station <= APART * length || station >= (1.0 - APART) * length);
    if past {
        station = station.clamp(0.0, length);
    }
    let at = place(curve, station);
    // At a corner the pose on the side of the change is that of the segment there.
    let n = curve.segments().len();
    let pose = match (ahead, at.s > 0.0) {
        (_, true) => curve.segments()[at.segment].pose_at(at.s),
        (false, false) => curve.segments()[at.segment % n].start_pose(),
        (true, false) => curve.segments()[(at.segment + n - 1) % n].end_pose(),
    };
    Anchor { station, place: (!past).then_some(at), pose, corner: corner && !past }
}
