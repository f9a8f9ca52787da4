//! A drive: a path and a direction come in, where the vehicle is at each time goes out. Where a path ends at an intersection, the straightest way on is taken.

use super::speed::{COMFORTABLE_M_S2, smooth_speeds};
use crate::document::{PathResult, Results};
use crate::network::{Junction, PathId, Turning, Way};
use crate::profile::Profile;
use fairpath_curve::{Point, Spline, trig};
use std::collections::BTreeSet;
use thiserror::Error;

/// Where a vehicle is at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Since the start, s.
    pub time_s: f64,
    /// Way driven since the start, in plan, m.
    pub driven_m: f64,
    /// Where its middle is, on the surface, m.
    pub position: [f64; 3],
    /// Its heading, radians from east against the clock.
    pub heading_rad: f64,
    /// Rise for a metre of way.
    pub grade: f64,
    /// Curvature of its way, 1/m, left positive.
    pub curvature_per_m: f64,
    /// Its speed along the way, m/s.
    pub speed_m_s: f64,
}

/// A drive from a start to an end.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// The paths that are driven along, in order.
    pub paths: Vec<PathId>,
    /// Where the vehicle is, at even times and at the end.
    pub moments: Vec<Moment>,
}

/// Why there is no drive.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DriveError {
    /// There is no such path.
    #[error("there is no path of the id {0:?}")]
    NoPath(PathId),
    /// The range holds nothing of the path.
    #[error("from {from_m} m to {to_m} m there is nothing of the path, which is {length_m} m long")]
    Range {
        /// Where it begins, m.
        from_m: f64,
        /// Where it ends, m.
        to_m: f64,
        /// The path's length, m.
        length_m: f64,
    },
    /// The step is not positive.
    #[error("the time step is {0} s; it must be between 0.001 and 10")]
    Step(f64),
}

/// One stretch of a drive.
struct Leg {
    plan: Spline,
    profile: Profile,
    /// Speed that holds, m/s, by stretches: where each begins, from station 0.
    limits: Vec<(f64, f64)>,
    /// To the right of the plan, m.
    right_m: f64,
}

/// No drive is longer, m: roads can lead in a ring.
const LONGEST_M: f64 = 200_000.0;

/// Speeds are found at stations no further apart, m.
const SPEED_STEP_M: f64 = 2.0;

/// No vehicle is slower, m/s: it starts and ends with it.
const CRAWL_M_S: f64 = 1.0;

/// A drive along a path from one station to another, with the path's direction if the first is the lesser. If `on` is set and the range ends where the path does, at an intersection,
/// the drive goes on along the straightest way, until a road ends or comes again; on a closed path it ends after one time round. `step_s` is from one moment to the next.
///
/// # Errors
/// When there is no such path, the range is empty, or the step is out of range.
pub fn drive(results: &Results, path: PathId, range_m: [f64; 2], on: bool, step_s: f64) -> Result<Drive, DriveError> {
    if !(0.001..=10.0).contains(&step_s) {
        return Err(DriveError::Step(step_s));
    }
    let result = results.path(path).ok_or(DriveError::NoPath(path))?;
    let length_m = result.path.length_m();
    let [from, to] = range_m.map(|s| s.clamp(0.0, length_m));
    let forward = to > from;
    let leg = leg(result, [from, to]).ok_or(DriveError::Range { from_m: range_m[0], to_m: range_m[1], length_m })?;
    let mut legs = vec![leg];
    let mut paths = vec![path];
    let at_end = if forward { to >= length_m } else { to <= 0.0 };
    if on && at_end && !result.path.plan.is_closed() {
        follow(results, result, forward, &mut legs, &mut paths);
    }
    Ok(Drive { paths, moments: moments(&legs, step_s) })
}

/// A stretch of a path, driven from one station to the other.
fn leg(result: &PathResult, [from, to]: [f64; 2]) -> Option<Leg> {
    let (low, high) = (from.min(to), from.max(to));
    let plan = result.path.plan.subspline(low, high)?;
    let profile = result.profile.part([low, high]).ok()?;
    let forward = to > from;
    let section = &result.path.section;
    let lanes = if forward { &section.right } else { &section.left };
    // In the middle of the first lane that is driven on.
    let mut inner = 0.0;
    let mut right_m = 0.0;
    for lane in lanes {
        if lane.kind == crate::section::LaneKind::Driving {
            right_m = inner + 0.5 * lane.width_m;
            break;
        }
        inner += lane.width_m;
    }
    let length = high - low;
    let all = result.path.speed_limits();
    let mut limits = Vec::new();
    for (i, (begin, kmh)) in all.iter().enumerate() {
        let end = all.get(i + 1).map_or(f64::INFINITY, |l| l.0);
        let (a, b) = (begin.max(low), end.min(high));
        if a < b {
            limits.push((if forward { a - low } else { high - b }, kmh / 3.6));
        }
    }
    limits.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (plan, profile) = if forward { (plan, profile) } else { (plan.reversed(), profile.reversed()) };
    (length > 0.0).then_some(Leg { plan, profile, limits, right_m })
}

/// Goes on from the end of a path, as straight as possible.
fn follow(results: &Results, first: &PathResult, forward: bool, legs: &mut Vec<Leg>, paths: &mut Vec<PathId>) {
    let mut at = (first.path.id, forward);
    let mut seen = BTreeSet::from([at]);
    let mut driven: f64 = legs.iter().map(|l| l.plan.length()).sum();
    while driven < LONGEST_M {
        let Some((junction, way)) = straightest(results, at) else { return };
        // The last leg ends where the intersection begins.
        let arm = junction.arms[way.from];
        let Some(last) = legs.pop() else { return };
        let keep = last.plan.length() - beyond(results, at, arm.station_m);
        let (Some(plan), Ok(profile)) = (last.plan.subspline(0.0, keep), last.profile.part([0.0, keep])) else {
            // Who starts within the intersection is on no way through it, and drives to the path's end.
            legs.push(last);
            return;
        };
        legs.push(Leg { plan, profile, ..last });
        let speed = legs.last().and_then(|l| l.limits.last()).map_or(8.0, |l| l.1);
        let slow = if way.turning == Turning::Straight { speed } else { speed.min(TURNING_M_S) };
        legs.push(Leg {
            plan: way.plan.clone(),
            profile: way.profile.clone(),
            limits: vec![(0.0, slow)],
            right_m: 0.5 * way.widths_m[0],
        });
        let out = junction.arms[way.to];
        let Some(next) = results.path(out.path) else { return };
        let length = next.path.length_m();
        let [to, again] = if out.forward { [length, 0.0] } else { [0.0, length] };
        let Some(leg_to) = leg(next, [out.station_m, to]) else { return };
        driven += way.plan.length() + leg_to.plan.length();
        legs.push(leg_to);
        if next.path.plan.is_closed() {
            // Straight on is round and round: once is enough.
            legs.extend(leg(next, [again, out.station_m]));
            paths.push(out.path);
            return;
        }
        paths.push(out.path);
        at = (out.path, out.forward);
        if !seen.insert(at) {
            return;
        }
    }
}

/// Whoever turns off does so at no more than this, m/s.
const TURNING_M_S: f64 = 7.0;

/// How much of a path lies beyond a station, in the direction of travel, m.
fn beyond(results: &Results, (path, forward): (PathId, bool), station: f64) -> f64 {
    let length = results.path(path).map_or(0.0, |p| p.path.length_m());
    if forward { length - station } else { station }
}

/// The straightest way on from the end of a path.
fn straightest(results: &Results, (path, forward): (PathId, bool)) -> Option<(&Junction, &Way)> {
    let length = results.path(path)?.path.length_m();
    let ends_in = |j: &&std::sync::Arc<Junction>| {
        j.spans.iter().any(|(id, [a, b])| *id == path && if forward { *b >= length } else { *a <= 0.0 })
    };
    let junction = results.junctions.iter().find(ends_in)?;
    let mine = |w: &&Way| {
        let arm = junction.arms[w.from];
        arm.path == path && arm.forward != forward
    };
    let turn = |w: &Way| trig::wrap_angle(w.plan.end_pose().heading - w.plan.start_pose().heading).abs();
    let way = junction.ways.iter().filter(mine).min_by(|a, b| turn(a).total_cmp(&turn(b)))?;
    Some((junction, way))
}

/// Where the vehicle is at even times.
fn moments(legs: &[Leg], step_s: f64) -> Vec<Moment> {
    let mut stations = Vec::new();
    let mut limits = Vec::new();
    let mut begin = 0.0;
    for leg in legs {
        let length = leg.plan.length();
        let count = (length / SPEED_STEP_M).ceil().max(1.0) as usize;
        for i in 0..=count {
            let s = length * i as f64 / count as f64;
            let k = leg.limits.partition_point(|l| l.0 <= s).saturating_sub(1);
            stations.push(begin + s);
            limits.push(leg.limits.get(k).map_or(CRAWL_M_S, |l| l.1));
        }
        begin += length;
    }
    if let (Some(first), Some(last)) = (limits.first().copied(), limits.last().copied()) {
        limits[0] = first.min(CRAWL_M_S);
        let end = limits.len() - 1;
        limits[end] = last.min(CRAWL_M_S);
    }
    let speeds = smooth_speeds(&stations, &limits, COMFORTABLE_M_S2);
    // Between two stations v² changes evenly, so that the time is the way over the mean speed.
    let mut times = vec![0.0];
    for i in 1..stations.len() {
        let mean = 0.5 * (speeds[i] + speeds[i - 1]);
        times.push(times[i - 1] + (stations[i] - stations[i - 1]) / mean.max(1e-6));
    }
    let total = times[times.len() - 1];
    let count = (total / step_s).floor() as usize;
    let mut moments = Vec::with_capacity(count + 2);
    let mut i = 1;
    for k in 0..=count + 1 {
        let time_s = (k as f64 * step_s).min(total);
        if k > count && total - count as f64 * step_s < 1e-9 {
            break;
        }
        while i + 1 < times.len() && times[i] < time_s {
            i += 1;
        }
        let (t0, s0, v0, v1) = (times[i - 1], stations[i - 1], speeds[i - 1], speeds[i]);
        let span = times[i] - t0;
        let a = if span > 0.0 { (v1 - v0) / span } else { 0.0 };
        let dt = (time_s - t0).clamp(0.0, span);
        let driven = (s0 + v0 * dt + 0.5 * a * dt * dt).min(stations[i]);
        moments.push(moment(legs, time_s, driven, v0 + a * dt));
    }
    moments
}

fn moment(legs: &[Leg], time_s: f64, driven_m: f64, speed_m_s: f64) -> Moment {
    let mut begin = 0.0;
    let mut leg = &legs[0];
    for l in legs {
        leg = l;
        if driven_m <= begin + l.plan.length() {
            break;
        }
        begin += l.plan.length();
    }
    let s = (driven_m - begin).clamp(0.0, leg.plan.length());
    let pose = leg.plan.pose_at(s);
    let at = leg.profile.at(s);
    let tangent = trig::unit(pose.heading);
    let p: Point = pose.point + fairpath_curve::Vec2::new(tangent.y, -tangent.x) * leg.right_m;
    Moment {
        time_s,
        driven_m,
        position: [p.x, p.y, at.height_m],
        heading_rad: pose.heading,
        grade: at.grade,
        curvature_per_m: pose.curvature,
        speed_m_s,
    }
}
