//! Intersections as areas: crossings at one height come in; which stretches of which roads lie within one intersection, and the ways through it from each lane to the next, go out.

use super::contact::{Crossing, Meeting};
use super::path::{Path, PathId};
use crate::groups::Groups;
use crate::profile::{Knot, Profile};
use crate::section::{Lane, LaneKind};
use fairpath_curve::{Continuity, Point, Pose, Segment, Spline, Vec2, hermite_g1, hermite_g2_with, trig};
use std::sync::Arc;

/// Radius to which the kerb of a corner is rounded, m.
const KERB_RADIUS_M: f64 = 7.0;

/// No arm begins further than this from where it crosses, m.
const FURTHEST_M: f64 = 45.0;

/// Where roads go on in each other's direction, what lies between them is no shorter than this on each side, m.
const LEAST_M: f64 = 10.0;

/// Intersections of one road that would leave less road than this between them are one, m.
const LEAST_ROAD_M: f64 = 12.0;

/// Nobody is led through an intersection by a sharper turn than this, degrees.
const SHARPEST_DEG: f64 = 160.0;

/// Ways that turn by less than this go straight on, degrees.
const STRAIGHT_DEG: f64 = 30.0;

/// A road that goes out from an intersection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// Of which path.
    pub path: PathId,
    /// Where the road begins and the intersection ends, arc length of the path, m.
    pub station_m: f64,
    /// Whether the road goes out towards the path's end, not its start.
    pub forward: bool,
}

/// Where a way through an intersection leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turning {
    /// On.
    Straight,
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// A way through an intersection from one lane to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// The arm that it comes from.
    pub from: usize,
    /// The arm that it goes to.
    pub to: usize,
    /// The lane that it comes from, counted from the middle of that road, among all lanes of its side.
    pub from_lane: usize,
    /// The lane that it goes to.
    pub to_lane: usize,
    /// Where it leads.
    pub turning: Turning,
    /// The edge of the lane that is nearer to the middle of the road: the lane lies to its right.
    pub plan: Spline,
    /// Its height, from station 0.
    pub profile: Profile,
    /// The lane's width where it comes in and where it goes out, m.
    pub widths_m: [f64; 2],
}

/// An intersection.
#[derive(Clone, Debug, PartialEq)]
pub struct Junction {
    /// About its middle.
    pub centre: Point,
    /// The stretches of paths that lie within it; on a closed path they may begin before its start or end beyond its end.
    pub spans: Vec<(PathId, [f64; 2])>,
    /// The roads that go out, against the clock.
    pub arms: Vec<Arm>,
    /// The ways through.
    pub ways: Vec<Way>,
}

/// One crossing's reach along its two paths.
struct Reach {
    crossing: usize,
    spans: [(PathId, [f64; 2]); 2],
}

/// The stretches of paths within an intersection.
pub(crate) type Spans = [(PathId, [f64; 2])];

/// All intersections of roads. `profile_of` gives a path's profile, and `known` an intersection with these spans if it is as it was.
pub(crate) fn junctions<'a>(
    crossings: &[Crossing],
    path_of: &dyn Fn(PathId) -> Option<&'a Path>,
    profile_of: &dyn Fn(PathId) -> Option<&'a Profile>,
    known: &dyn Fn(&Spans) -> Option<Arc<Junction>>,
) -> Vec<Arc<Junction>> {
    let reaches: Vec<Reach> = crossings
        .iter()
        .enumerate()
        .filter(|(_, c)| c.meeting == Meeting::Level)
        .filter_map(|(i, c)| {
            let (a, b) = (path_of(c.first.path)?, path_of(c.second.path)?);
            (a.section.is_road() && b.section.is_road()).then(|| reach(i, c, a, b))
        })
        .collect();
    let groups = united(&reaches, path_of);
    let one = |group: &Vec<usize>| {
        let mut spans: Vec<(PathId, [f64; 2])> = group.iter().flat_map(|&i| reaches[i].spans).collect();
        spans.sort_by(|p, q| p.0.cmp(&q.0).then(p.1[0].total_cmp(&q.1[0])));
        let spans = merged(spans, path_of);
        known(&spans).unwrap_or_else(|| {
            let points = group.iter().map(|&i| crossings[reaches[i].crossing].point);
            Arc::new(junction(spans, points, path_of, profile_of))
        })
    };
    groups.iter().map(one).collect()
}

/// How far from a crossing the intersection reaches along its paths.
fn reach(index: usize, crossing: &Crossing, a: &Path, b: &Path) -> Reach {
    let (s, t) = (crossing.first.station_m, crossing.second.station_m);
    let (u, v) = (a.plan.tangent_at(s), b.plan.tangent_at(t));
    let (sine, cosine) = (u.cross(v).abs(), u.dot(v).abs());
    let (wa, wb) = (0.5 * a.section.width_m(), 0.5 * b.section.width_m());
    // The kerbs' tangent length grows with the cotangent of half the smaller angle between the roads.
    let tangent = KERB_RADIUS_M * (1.0 + cosine) / sine.max(1e-3);
    let along = |own: f64, other: f64| {
        let far = (other + own * cosine) / sine.max(1e-3) + tangent;
        if sine < 0.2 && crossing.at_end { LEAST_M.max(own) } else { far.clamp(LEAST_M, FURTHEST_M) }
    };
    let (ea, eb) = (along(wa, wb), along(wb, wa));
    Reach { crossing: index, spans: [(a.id, [s - ea, s + ea]), (b.id, [t - eb, t + eb])] }
}

/// Crossings in groups, each of which is one intersection.
fn united<'a>(reaches: &[Reach], path_of: &dyn Fn(PathId) -> Option<&'a Path>) -> Vec<Vec<usize>> {
    let mut groups = Groups::new(reaches.len());
    let mut spans: Vec<(PathId, [f64; 2], usize)> =
        reaches.iter().enumerate().flat_map(|(i, r)| r.spans.iter().map(move |(id, span)| (*id, *span, i))).collect();
    spans.sort_by(|p, q| p.0.cmp(&q.0).then(p.1[0].total_cmp(&q.1[0])).then(p.2.cmp(&q.2)));
    for of_path in spans.chunk_by(|p, q| p.0 == q.0) {
        let mut end = f64::NEG_INFINITY;
        let mut last = None;
        for (_, [from, to], i) in of_path {
            if let Some(j) = last.filter(|_| *from < end + LEAST_ROAD_M) {
                groups.unite(*i, j);
            }
            (end, last) = (end.max(*to), Some(*i));
        }
        // Around a closed path the first follows the last.
        if let Some(path) = path_of(of_path[0].0).filter(|p| p.plan.is_closed())
            && of_path[0].1[0] + path.length_m() < end + LEAST_ROAD_M
        {
            groups.unite(of_path[0].2, of_path[of_path.len() - 1].2);
        }
    }
    groups.all()
}

fn junction<'a>(
    spans: Vec<(PathId, [f64; 2])>,
    points: impl ExactSizeIterator<Item = Point>,
    path_of: &dyn Fn(PathId) -> Option<&'a Path>,
    profile_of: &dyn Fn(PathId) -> Option<&'a Profile>,
) -> Junction {
    let count = points.len() as f64;
    let centre = (points.fold(Vec2::ZERO, |sum, p| sum + p.to_vec2()) / count).to_point();
    let mut arms: Vec<(f64, Arm)> = Vec::new();
    for &(id, [from, to]) in &spans {
        let Some(path) = path_of(id) else { continue };
        let length = path.length_m();
        let closed = path.plan.is_closed();
        // One that goes all round a closed path leaves none of it.
        if closed && to - from >= length {
            continue;
        }
        for (station, forward) in [(from, false), (to, true)] {
            let there = closed || if forward { station < length } else { station > 0.0 };
            if there {
                let station_m = if closed { station.rem_euclid(length) } else { station };
                let out = path.plan.point_at(station_m) - centre;
                arms.push((trig::angle_of(out), Arm { path: id, station_m, forward }));
            }
        }
    }
    arms.sort_by(|a, b| a.0.total_cmp(&b.0));
    let arms: Vec<Arm> = arms.into_iter().map(|a| a.1).collect();
    let mut ways = Vec::new();
    for from in 0..arms.len() {
        for to in 0..arms.len() {
            if from != to {
                ways_between(from, to, &arms, &spans, path_of, profile_of, &mut ways);
            }
        }
    }
    Junction { centre, spans, arms, ways }
}

/// Spans of one path that overlap or leave too little between them are one; what would be left of a path beyond one is taken in.
fn merged<'a>(spans: Vec<(PathId, [f64; 2])>, path_of: &dyn Fn(PathId) -> Option<&'a Path>) -> Vec<(PathId, [f64; 2])> {
    let mut out: Vec<(PathId, [f64; 2])> = Vec::new();
    for (id, [from, to]) in spans {
        match out.last_mut() {
            Some((last, span)) if *last == id && from < span[1] + LEAST_ROAD_M => span[1] = span[1].max(to),
            _ => out.push((id, [from, to])),
        }
    }
    over_the_seam(&mut out, path_of);
    for (id, [from, to]) in &mut out {
        let Some(path) = path_of(*id).filter(|p| !p.plan.is_closed()) else { continue };
        let length = path.length_m();
        if *from < LEAST_ROAD_M {
            *from = 0.0;
        }
        if *to > length - LEAST_ROAD_M {
            *to = length;
        }
    }
    out
}

/// On a closed path the first span follows the last: where they are one, it begins before the path's end and ends beyond it; a span that leaves too little of the path takes all of it.
fn over_the_seam<'a>(spans: &mut Vec<(PathId, [f64; 2])>, path_of: &dyn Fn(PathId) -> Option<&'a Path>) {
    let ids: std::collections::BTreeSet<PathId> = spans.iter().map(|s| s.0).collect();
    for id in ids {
        let Some(length) = path_of(id).filter(|p| p.plan.is_closed()).map(Path::length_m) else { continue };
        let own: Vec<usize> = (0..spans.len()).filter(|&i| spans[i].0 == id).collect();
        let (Some(&first), Some(&last)) = (own.first(), own.last()) else { continue };
        let beyond = spans[first].1.map(|s| s + length);
        if beyond[0] >= spans[last].1[1] + LEAST_ROAD_M {
            continue;
        }
        if first == last {
            spans[last].1[1] = beyond[0];
        } else {
            spans[last].1[1] = spans[last].1[1].max(beyond[1]);
            spans.remove(first);
        }
    }
}

/// A driving lane of a side.
#[derive(Clone, Copy)]
struct DrivingLane {
    /// Its number among all lanes of the side, from the middle outwards.
    number: usize,
    /// From the middle to its inner edge, m.
    inner_m: f64,
    width_m: f64,
}

/// The driving lanes of a side, from the middle outwards.
fn driving(lanes: &[Lane]) -> Vec<DrivingLane> {
    let mut inner = 0.0;
    let mut found = Vec::new();
    for (i, lane) in lanes.iter().enumerate() {
        if lane.kind == LaneKind::Driving {
            found.push(DrivingLane { number: i, inner_m: inner, width_m: lane.width_m });
        }
        inner += lane.width_m;
    }
    found
}

impl Arm {
    /// The pose of a lane's inner edge where the intersection begins, in the direction of travel: into it (`inwards`) or out of it.
    fn pose(&self, path: &Path, inner_m: f64, inwards: bool) -> Pose {
        let pose = path.plan.pose_at(self.station_m);
        // Traffic keeps to the right.
        let along = self.forward != inwards;
        let (heading, curvature) = if along {
            (pose.heading, pose.curvature)
        } else {
            (trig::wrap_angle(pose.heading + std::f64::consts::PI), -pose.curvature)
        };
        let tangent = trig::unit(heading);
        let right = Vec2::new(tangent.y, -tangent.x);
        // An offset to the right of a left bend is a wider one.
        let curvature = curvature / (1.0 + curvature * inner_m);
        Pose { point: pose.point + right * inner_m, heading, curvature }
    }

    /// The lanes on which traffic goes into the intersection, or out of it.
    fn lanes<'a>(&self, path: &'a Path, inwards: bool) -> &'a [Lane] {
        if self.forward != inwards { &path.section.right } else { &path.section.left }
    }
}

fn ways_between<'a>(
    from: usize,
    to: usize,
    arms: &[Arm],
    spans: &[(PathId, [f64; 2])],
    path_of: &dyn Fn(PathId) -> Option<&'a Path>,
    profile_of: &dyn Fn(PathId) -> Option<&'a Profile>,
    ways: &mut Vec<Way>,
) {
    let (a, b) = (&arms[from], &arms[to]);
    let (Some(pa), Some(pb)) = (path_of(a.path), path_of(b.path)) else { return };
    let (Some(za), Some(zb)) = (profile_of(a.path), profile_of(b.path)) else { return };
    let (ins, outs) = (driving(a.lanes(pa, true)), driving(b.lanes(pb, false)));
    if ins.is_empty() || outs.is_empty() {
        return;
    }
    let turn = trig::wrap_angle(b.pose(pb, 0.0, false).heading - a.pose(pa, 0.0, true).heading).to_degrees();
    if turn.abs() > SHARPEST_DEG {
        return;
    }
    let turning = if turn.abs() < STRAIGHT_DEG {
        Turning::Straight
    } else if turn > 0.0 {
        Turning::Left
    } else {
        Turning::Right
    };
    let pairs: Vec<(DrivingLane, DrivingLane)> = match turning {
        Turning::Straight => ins.iter().copied().zip(outs.iter().copied()).collect(),
        Turning::Left => vec![(ins[0], outs[0])],
        Turning::Right => vec![(ins[ins.len() - 1], outs[outs.len() - 1])],
    };
    for (lane_in, lane_out) in pairs {
        let (start, end) = (a.pose(pa, lane_in.inner_m, true), b.pose(pb, lane_out.inner_m, false));
        let own = spans.iter().find(|(id, span)| {
            *id == a.path && a.path == b.path && a.forward != b.forward && is_span(pa, *span, [a, b])
        });
        let along_itself = own.filter(|_| lane_in.inner_m == 0.0 && lane_out.inner_m == 0.0);
        let (plan, profile) = match along_itself {
            // Straight on along the road itself.
            Some((_, span)) => {
                let Some(plan) = pa.plan.subspline(span[0], span[1]) else { continue };
                let Ok(profile) = span_profile(pa, za, *span) else { continue };
                if b.forward { (plan, profile) } else { (plan.reversed(), profile.reversed()) }
            }
            None => {
                let Some(plan) = bridge(start, end) else { continue };
                let grade = |profile: &Profile, arm: &Arm, along: bool| {
                    let at = profile.at(arm.station_m);
                    (at.height_m, if along { at.grade } else { -at.grade })
                };
                let (z0, g0) = grade(za, a, !a.forward);
                let (z1, g1) = grade(zb, b, b.forward);
                let knot = |station_m, height_m, grade| Knot { station_m, height_m, grade };
                let Ok(profile) = Profile::new(vec![knot(0.0, z0, g0), knot(plan.length(), z1, g1)]) else { continue };
                (plan, profile)
            }
        };
        ways.push(Way {
            from,
            to,
            from_lane: lane_in.number,
            to_lane: lane_out.number,
            turning,
            plan,
            profile,
            widths_m: [lane_in.width_m, lane_out.width_m],
        });
    }
}

/// Whether two arms are the two ends of a span.
fn is_span(path: &Path, [from, to]: [f64; 2], [a, b]: [&Arm; 2]) -> bool {
    let (first, last) = if a.forward { (b, a) } else { (a, b) };
    let length = path.length_m();
    let same = |x: f64, y: f64| {
        let off = (x - y).abs();
        off < 1e-6 || (path.plan.is_closed() && (off - length).abs() < 1e-6)
    };
    same(first.station_m, from) && same(last.station_m, to)
}

/// The profile of a span, from station 0; on a closed path it may lie over the start.
fn span_profile(path: &Path, profile: &Profile, [from, to]: [f64; 2]) -> Result<Profile, crate::profile::ProfileError> {
    let length = path.length_m();
    if !path.plan.is_closed() || (from >= 0.0 && to <= length) {
        return profile.part([from, to]);
    }
    let turn = (from / length).floor() * length;
    let (from, to) = (from - turn, to - turn);
    let first = profile.part([from, length])?;
    let rest = profile.part([0.0, to - length])?;
    let moved = rest.knots().iter().skip(1).map(|k| Knot { station_m: k.station_m + length - from, ..*k });
    Profile::new(first.knots().iter().copied().chain(moved).collect())
}

/// Shares of the length of a way that its outer clothoids take, one after the other until there is a curve.
const SHARES: [f64; 3] = [0.3, 0.2, 0.1];

/// Three clothoids from one pose to another, with the curvatures of both: a jump of curvature would be one of the slope of the lane beside. Where there are none, one clothoid.
fn bridge(start: Pose, end: Pose) -> Option<Spline> {
    let three = SHARES.into_iter().find_map(|share| hermite_g2_with(start, end, [share; 2]));
    if let Some(three) = three {
        return Spline::new(three.to_vec(), vec![Continuity::G2; 2], false).ok();
    }
    let one = hermite_g1(start.point, start.heading, end.point, end.heading).filter(Segment::is_valid)?;
    Spline::new(vec![one], Vec::new(), false).ok()
}
