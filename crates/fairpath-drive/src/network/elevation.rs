//! The heights of paths that cross: plans, the ground and crossings come in, an elevation profile for each path goes out (section 3.4.4 of the thesis).

use super::contact::{Crossing, Meeting, PathPlace};
use super::path::{HeightMode, Path, PathId};
use crate::groups::Groups;
use crate::heights::{CrossingHeights, HeightError, HeightPoint, Over, PathPoints};
use crate::profile::{Knot, Profile, ProfileError};
use crate::smoothing::{Beam, LEAST_AROUND, smoothed};
use crate::survey::{LOOK_M, Survey, followed_m};
use crate::terrain::{Heightfield, Waters};
use std::f64::consts::TAU;

/// Waves of the ground of this length are halved in the profile of a path, m for each km/h: at 60 km/h those of 150 m.
const WAVE_M_PER_KMH: f64 = 2.5;

/// No longer waves are halved to make a path less steep, m: rather it stays steep, and the check of the design says so.
const LONGEST_WAVE_M: f64 = 2000.0;

/// Weight of the ground at a path's ends, beside 1 everywhere else.
const END_WEIGHT: f64 = 1000.0;

/// What a path is raised or lowered at a crossing comes to an end within a length in which its grade takes up this share of the steepest it may have.
const RAMP_SHARE: f64 = 0.4;

/// No such ramp is shorter, m.
const LEAST_RAMP_M: f64 = 40.0;

/// The unit of arc length in equation 3.2, m: a grade is a clearance over this length. The longer it is, the more a path is kept level.
const LENGTH_SCALE_M: f64 = 60.0;

/// Over how much of a path beside drawn heights its own profile leads to them, m for each km/h.
const TRANSITION_M_PER_KMH: f64 = 1.0;

/// A profile that a path would have alone: the ground along it, as its plan was surveyed, made fair, with what was drawn.
pub(crate) fn alone(path: &Path, survey: &Survey, ground: &Heightfield, waters: &Waters) -> Profile {
    let length = path.length_m();
    let closed = path.plan.is_closed();
    let Looks { points, spacings_m } = looks(path, survey, ground, waters);
    let whole = |profile: &Profile| if closed { closed_up(profile, length) } else { ends_exactly(profile, length) };
    let profile = if path.heights == HeightMode::Draped {
        let points = if closed { thrice(&points, length, |point, turn| [point[0] + turn, point[1]]) } else { points };
        Profile::catmull_rom(&points).expect(ASCENDING)
    } else {
        fair(path, &points, &spacings_m)
    };
    let transition = TRANSITION_M_PER_KMH * path.section.speed_kmh;
    // Around a closed path what was drawn before its end leads over to its start.
    let turns = if closed { &[-1.0, 0.0, 1.0][..] } else { &[0.0][..] };
    let drawn = path.drawn.iter().flat_map(|drawn| turns.iter().map(move |turn| (drawn, turn * length)));
    let [first, last] = profile.range_m();
    let drawn = drawn.filter(|(drawn, turn)| {
        let at = |point: Option<&[f64; 2]>| point.map_or(f64::NAN, |p| p[0] + turn);
        at(drawn.points_m.first()) < last && at(drawn.points_m.last()) > first
    });
    let profile = drawn.fold(profile, |profile, (drawn, turn)| {
        let points: Vec<[f64; 2]> = drawn.points_m.iter().map(|[s, z]| [s + turn, *z]).collect();
        let part = drawn_profile(&points).expect("a drawing has two stations or more");
        profile.with_part(&part, transition).expect("the drawing lies on the path")
    });
    whole(&profile)
}

const ASCENDING: &str = "stations ascend and heights are finite";

/// Where the ground was looked at along a path.
struct Looks {
    /// Station and height, m, ascending.
    points: Vec<[f64; 2]>,
    /// Of what length of the path each is the middle, m; an end of the path stands for none.
    spacings_m: Vec<f64>,
}

/// The heights of the ground along a path and at its ends.
fn looks(path: &Path, survey: &Survey, ground: &Heightfield, waters: &Waters) -> Looks {
    let length = path.length_m();
    let height = |station: f64| followed_m(path.plan.point_at(station), ground, waters);
    let own = survey.segments().flat_map(|(start, segment)| {
        segment.looks.iter().map(move |look| ([start + look.s_m, look.height_m], look.spacing_m))
    });
    let (points, spacings_m) = if path.plan.is_closed() {
        let own: Vec<_> = own.collect();
        // A closed path that is shorter than a step has one look, and needs two.
        if own.len() < 2 {
            [0.25, 0.75].map(|t| ([t * length, height(t * length)], 0.5 * length)).to_vec()
        } else {
            own
        }
        .into_iter()
        .unzip()
    } else {
        let end = |station: f64| [([station, height(station)], 0.0)];
        end(0.0).into_iter().chain(own).chain(end(length)).unzip()
    };
    Looks { points, spacings_m }
}

/// What there is along a closed path, and the same a turn before and a turn later.
fn thrice<T>(once: &[T], length: f64, shifted: impl Fn(&T, f64) -> T) -> Vec<T> {
    [-length, 0.0, length].iter().flat_map(|turn| once.iter().map(|x| shifted(x, *turn))).collect()
}

/// Heights made fair: waves are halved that the design speed does not like, and where that leaves the path too steep, longer ones, as long as that helps without leaving
/// the ground altogether.
fn fair(path: &Path, points: &[[f64; 2]], spacings_m: &[f64]) -> Profile {
    // A path begins and ends on the ground.
    let weights: Vec<f64> = spacings_m.iter().map(|s| if *s > 0.0 { s / LOOK_M } else { END_WEIGHT }).collect();
    if !path.plan.is_closed() {
        return Profile::new(made_fair(path, &Beam::new(points, &weights).expect(ASCENDING))).expect(ASCENDING);
    }
    // A short one is gone round several times.
    let turns = LEAST_AROUND.div_ceil(points.len());
    let length = path.length_m();
    let around = |turn: usize| points.iter().map(move |[s, z]| [s + turn as f64 * length, *z]);
    let points: Vec<[f64; 2]> = (0..turns).flat_map(around).collect();
    let weights = weights.repeat(turns);
    let length = turns as f64 * length;
    let mut knots = made_fair(path, &Beam::around(&points, &weights, length).expect(ASCENDING));
    knots.pop();
    let knots = thrice(&knots, length, |knot, turn| Knot { station_m: knot.station_m + turn, ..*knot });
    Profile::new(knots).expect(ASCENDING)
}

/// The knots of a beam that is as stiff as it must be.
fn made_fair(path: &Path, beam: &Beam) -> Vec<Knot> {
    let longest = LONGEST_WAVE_M.max(WAVE_M_PER_KMH * path.section.speed_kmh);
    let mut waves = vec![WAVE_M_PER_KMH * path.section.speed_kmh; beam.intervals()];
    loop {
        let stiffness: Vec<f64> = waves.iter().map(|wave| fourth_power(wave / TAU) / LOOK_M).collect();
        let knots = beam.knots(&stiffness).expect(ASCENDING);
        let mut is_longer = false;
        for (wave, ends) in waves.iter_mut().zip(knots.windows(2)) {
            if *wave < longest && ends[0].is_steeper(&ends[1], path.section.max_grade) {
                *wave = (*wave * LONGER).min(longest);
                is_longer = true;
            }
        }
        if !is_longer {
            return knots;
        }
        // What is stiff on one side and soft on the other would bend at once: waves become shorter little by little.
        let width = |piece: usize| knots[piece + 1].station_m - knots[piece].station_m;
        let last = waves.len() - 1;
        // Around a closed path a second time, since what is before the first is the last.
        for _ in 0..if path.plan.is_closed() { 2 } else { 1 } {
            for piece in 1..=last {
                waves[piece] = waves[piece].max(waves[piece - 1] - TAPER * width(piece));
            }
            for piece in (0..last).rev() {
                waves[piece] = waves[piece].max(waves[piece + 1] - TAPER * width(piece));
            }
            if path.plan.is_closed() {
                waves[0] = waves[0].max(waves[last] - TAPER * width(0));
                waves[last] = waves[last].max(waves[0] - TAPER * width(last));
            }
        }
    }
}

fn fourth_power(x: f64) -> f64 {
    (x * x) * (x * x)
}

/// By how much waves are longer that are tried next where a path is too steep.
const LONGER: f64 = 1.5;

/// By how much the waves that are halved become shorter with the distance from where they had to be longer, m for each m.
const TAPER: f64 = 0.15;

/// Drawn heights as a profile: evened out, since a hand trembles, but through the ends of what was drawn.
fn drawn_profile(points: &[[f64; 2]]) -> Result<Profile, ProfileError> {
    let extent = points.last().map_or(0.0, |p| p[0]) - points.first().map_or(0.0, |p| p[0]);
    let mut weights = vec![1.0; points.len()];
    (weights[0], weights[points.len() - 1]) = (100.0, 100.0);
    let wave = 0.25 * extent;
    let step = extent / points.len() as f64;
    smoothed(points, &weights, &vec![fourth_power(wave / TAU) / step.max(1e-6); points.len() - 1])
}

/// The part of a profile around a closed path that is gone through once, ending as it begins.
fn closed_up(profile: &Profile, length: f64) -> Profile {
    let part = profile.part([0.0, length]).expect("a path has a length");
    let mut knots = part.knots().to_vec();
    let first = knots[0];
    if let Some(last) = knots.last_mut() {
        *last = Knot { station_m: length, ..first };
    }
    Profile::new(knots).expect("as before")
}

/// Rounding must not leave the profile shorter than its path.
fn ends_exactly(profile: &Profile, length: f64) -> Profile {
    let mut knots = profile.knots().to_vec();
    if let Some(last) = knots.last_mut() {
        last.station_m = length;
    }
    Profile::new(knots).expect("as before")
}

/// What could not be done about heights.
#[derive(Clone, Debug, PartialEq)]
pub struct Unordered {
    /// The crossings that cannot hold together: each passes over the next, and the last over the first, at one place.
    pub crossings: Vec<usize>,
}

/// Stations and heights at the crossings of paths, m, in the order of `paths`: `alone` are the profiles that they would have by themselves. Crossings of paths that are not among
/// them are left out.
///
/// # Errors
/// When crossings at one place ask for a ring of who passes over whom.
pub(crate) fn wanted_heights(
    paths: &[&Path],
    alone: &[&Profile],
    crossings: &[Crossing],
) -> Result<Vec<Vec<[f64; 2]>>, Unordered> {
    let of = |id: PathId| paths.iter().position(|p| p.id == id);
    let joined: Vec<(usize, &Crossing, [usize; 2])> = crossings
        .iter()
        .enumerate()
        .filter_map(|(i, c)| Some((i, c, [of(c.first.path)?, of(c.second.path)?])))
        .collect();
    let stations = stations(paths, &joined);
    let point = |path: usize, station: f64| {
        let point = stations[path].partition_point(|s| *s < station - SAME_M);
        HeightPoint { path, point }
    };
    let ends = |c: &Crossing, [a, b]: [usize; 2]| [point(a, c.first.station_m), point(b, c.second.station_m)];
    let mut problem = CrossingHeights { length_scale_m: LENGTH_SCALE_M, ..CrossingHeights::default() };
    problem.paths = stations.iter().map(|stations_m| PathPoints { stations_m: stations_m.clone() }).collect();
    let mut over_of = Vec::new();
    let mut clearance: f64 = 0.0;
    for (i, c, at) in &joined {
        let [first, second] = ends(c, *at);
        match c.meeting {
            Meeting::Level => problem.level.push([first, second]),
            Meeting::Over => problem.over.push(Over { upper: first, lower: second }),
            Meeting::Under => problem.over.push(Over { upper: second, lower: first }),
        }
        if c.meeting != Meeting::Level {
            over_of.push(*i);
            clearance = clearance.max(separation_m(paths, c));
        }
    }
    let heights = problem.solve().map_err(|error| match error {
        HeightError::Ring { overs, .. } => Unordered { crossings: overs.iter().map(|o| over_of[*o]).collect() },
        other => unreachable!("stations ascend and all points exist: {other}"),
    })?;
    let heights = heights.scaled_to_clearance(&problem.over, clearance);
    // Both paths are measured from one ground at a crossing, or they would not meet.
    let mut wanted: Vec<Vec<Option<f64>>> = stations.iter().map(|s| vec![None; s.len()]).collect();
    let own = |p: HeightPoint| alone[p.path].at(stations[p.path][p.point]).height_m;
    let is_drawn = |p: HeightPoint| {
        let station = stations[p.path][p.point];
        let covers = |d: &super::path::DrawnHeights| match (d.points_m.first(), d.points_m.last()) {
            (Some(a), Some(b)) => (a[0]..=b[0]).contains(&station),
            _ => false,
        };
        paths[p.path].drawn.iter().any(covers)
    };
    for group in groups(&joined, &stations, ends) {
        let drawn: Vec<f64> = group.iter().filter(|p| is_drawn(**p)).map(|p| own(*p)).collect();
        let ground = group.iter().map(|p| own(*p)).sum::<f64>() / group.len() as f64;
        for &p in &group {
            let free = ground + heights.paths[p.path][p.point];
            wanted[p.path][p.point] = Some(if is_drawn(p) { own(p) } else { free });
        }
        // Where paths meet and one of them was drawn, it decides.
        if let Some(&height) = drawn.first() {
            for (_, c, at) in joined.iter().filter(|(_, c, _)| c.meeting == Meeting::Level) {
                let [p, q] = ends(c, *at);
                if group.contains(&p) {
                    for p in [p, q].into_iter().filter(|p| !is_drawn(*p)) {
                        wanted[p.path][p.point] = Some(height);
                    }
                }
            }
        }
    }
    keep_clear(paths, &joined, ends, is_drawn, &mut wanted);
    let known = |i: usize| {
        let all = stations[i].iter().zip(&wanted[i]);
        all.filter_map(|(s, height)| height.map(|height| [*s, height])).collect()
    };
    Ok((0..paths.len()).map(known).collect())
}

/// Crossings nearer to each other along a path than this are one place, m.
const SAME_M: f64 = 0.05;

/// Where each path has crossings, arc lengths, ascending, none twice.
fn stations(paths: &[&Path], joined: &[(usize, &Crossing, [usize; 2])]) -> Vec<Vec<f64>> {
    let mut stations: Vec<Vec<f64>> = vec![Vec::new(); paths.len()];
    for (_, c, [a, b]) in joined {
        stations[*a].push(c.first.station_m);
        stations[*b].push(c.second.station_m);
    }
    for list in &mut stations {
        list.sort_by(f64::total_cmp);
        list.dedup_by(|later, earlier| *later - *earlier <= SAME_M);
    }
    stations
}

/// Points that are at one place in plan, in groups.
fn groups(
    joined: &[(usize, &Crossing, [usize; 2])],
    stations: &[Vec<f64>],
    ends: impl Fn(&Crossing, [usize; 2]) -> [HeightPoint; 2],
) -> Vec<Vec<HeightPoint>> {
    let points: Vec<HeightPoint> = (0..stations.len())
        .flat_map(|path| (0..stations[path].len()).map(move |point| HeightPoint { path, point }))
        .collect();
    let starts: Vec<usize> = stations
        .iter()
        .scan(0, |before, own| {
            let start = *before;
            *before += own.len();
            Some(start)
        })
        .collect();
    let mut groups = Groups::new(points.len());
    for (_, c, at) in joined {
        let [p, q] = ends(c, *at).map(|p| starts[p.path] + p.point);
        groups.unite(p, q);
    }
    groups.all().into_iter().map(|group| group.into_iter().map(|i| points[i]).collect()).collect()
}

/// What must lie between the surfaces of two paths that pass over each other, m: what the lower needs free and what the upper is thick.
pub(crate) fn separation_m(paths: &[&Path], crossing: &Crossing) -> f64 {
    let section = |place: PathPlace| paths.iter().find(|p| p.id == place.path).map(|p| &p.section);
    let Some([upper, lower]) = crossing.upper_lower() else { return 0.0 };
    section(upper).map_or(0.0, |s| s.thickness_m) + section(lower).map_or(0.0, |s| s.clearance_m)
}

/// Where the heights of one of two paths were drawn, the other makes way.
fn keep_clear(
    paths: &[&Path],
    joined: &[(usize, &Crossing, [usize; 2])],
    ends: impl Fn(&Crossing, [usize; 2]) -> [HeightPoint; 2],
    is_drawn: impl Fn(HeightPoint) -> bool,
    wanted: &mut [Vec<Option<f64>>],
) {
    for (_, c, at) in joined.iter().filter(|(_, c, _)| c.meeting != Meeting::Level) {
        let [first, second] = ends(c, *at);
        let (upper, lower) = if c.meeting == Meeting::Over { (first, second) } else { (second, first) };
        let height = |p: HeightPoint, wanted: &[Vec<Option<f64>>]| wanted[p.path][p.point].unwrap_or(0.0);
        let lacks = separation_m(paths, c) - (height(upper, wanted) - height(lower, wanted));
        if !(lacks > 0.0) {
            continue;
        }
        match (is_drawn(upper), is_drawn(lower)) {
            (true, false) => wanted[lower.path][lower.point] = Some(height(lower, wanted) - lacks),
            (false, true) => wanted[upper.path][upper.point] = Some(height(upper, wanted) + lacks),
            // Both were drawn as they are: the check of clearances says so.
            _ => {}
        }
    }
}

/// The profile of a path with the wanted heights at its crossings, stations ascending, leading back beside them to what it is alone.
pub(crate) fn profile_with(path: &Path, alone: &Profile, wanted: &[[f64; 2]]) -> Profile {
    let length = path.length_m();
    let by: Vec<[f64; 2]> =
        wanted.iter().map(|[s, height]| [s.clamp(0.0, length), height - alone.at(*s).height_m]).collect();
    if by.is_empty() {
        return alone.clone();
    }
    let ramp = |by: f64| (by.abs() * 1.5 / (RAMP_SHARE * path.section.max_grade)).max(LEAST_RAMP_M);
    // Around a closed path what lies before its start is what lies before its end. Two turns, since a grade is told by the points on both sides, and there may be but one in a turn.
    let closed = path.plan.is_closed();
    let turns = if closed { &[-2.0, -1.0, 0.0, 1.0, 2.0][..] } else { &[0.0] };
    let around: Vec<[f64; 2]> =
        turns.iter().flat_map(|turn| by.iter().map(move |[s, d]| [s + turn * length, *d])).collect();
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (i, &[s, d]) in around.iter().enumerate() {
        let before = if i == 0 { f64::NEG_INFINITY } else { around[i - 1][0] + ramp(around[i - 1][1]) };
        if s - ramp(d) > before {
            points.push([s - ramp(d), 0.0]);
        }
        if points.last().is_none_or(|p| s > p[0]) {
            points.push([s, d]);
        }
        let after = around.get(i + 1).map_or(f64::INFINITY, |[s, d]| s - ramp(*d));
        if s + ramp(d) < after {
            points.push([s + ramp(d), 0.0]);
        }
    }
    let [first, last] = [points[0], points[points.len() - 1]];
    if first[0] > 0.0 {
        points.insert(0, [first[0] - length, first[1]]);
    }
    if last[0] < length {
        points.push([last[0] + length, last[1]]);
    }
    let correction =
        if path.heights == HeightMode::Draped { Profile::catmull_rom(&points) } else { Profile::monotone(&points) };
    let sum = correction.and_then(|correction| alone.plus(&correction));
    sum.unwrap_or_else(|_| alone.clone())
}
