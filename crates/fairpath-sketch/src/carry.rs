//! What a curve is fitted to after it was edited: the strokes of the old curves, these and the new one come in, a stroke goes out that fits the new one,
//! so that another place on the slider does not undo the edit.
//!
//! Places are found by going along both curves side by side: where a curve crosses itself, the nearest place may lie on the wrong branch.

use crate::follow::Follower;
use fairpath_curve::{Continuity, Point, Spline};
use fairpath_fit::Stroke;

/// Distance of the points that stand for a part without a stroke, px.
const SPACING: f64 = 4.0;

/// Most such points: a longer curve has them further apart.
const MOST_PLACES: f64 = 20_000.0;

/// A place of one curve this near to the other lies on both, as a share of their lengths.
const SAME: f64 = 1e-7;

/// A point of a stroke within this belongs to the branch of its neighbours, px; further away, another branch may be meant.
const NEAR: f64 = 12.0;

/// A point whose place lies behind that of the one before counts as further away, for each px behind: strokes go forward.
const RETURN: f64 = 0.5;

/// What is looked through along a curve beside what the points have gone, px.
const SLACK: f64 = 16.0;

/// The points of the strokes, each of which was fitted by the spline beside it, along those parts of `new` that lie on these splines, and along the others
/// the points of `drawn` that are nearest to them, or if there are none, points of `new` itself. Times and pressures belong to a stroke that was drawn at
/// one go and are left out unless nothing changed.
///
/// `pixel_size` is the size of a pixel in the unit of the curves. The name is that of the first stroke.
#[must_use]
pub fn carried(sources: &[(&Stroke, &Spline)], new: &Spline, drawn: &[Point], pixel_size: f64) -> Stroke {
    if let [(stroke, old)] = sources
        && old == &new
    {
        return (*stroke).clone();
    }
    let places = Places::new(new, pixel_size);
    let mut points: Vec<(f64, Point)> = Vec::new();
    let mut shared = vec![false; places.stations.len() - 1];
    for (stroke, old) in sources {
        let stretches = places.shared_with(old, new);
        for stretch in &stretches {
            shared[stretch.at] = true;
        }
        points.extend(moved_over(stroke, old, &stretches, pixel_size));
        points.extend(cut_ends(old, new, &stretches, shared.len()));
    }
    let mut replaced: Vec<(f64, Point)> = Vec::new();
    for &point in drawn {
        let foot = new.nearest(point);
        let s = new.station(foot.segment, foot.s);
        if !shared[places.stretch(s)] {
            replaced.push((s, point));
        }
    }
    for [from, to] in runs_of_changed(&shared) {
        let ends = [places.stations[from], places.stations[to]];
        if !replaced.iter().any(|(s, _)| (ends[0]..=ends[1]).contains(s)) {
            points.extend((from..=to).map(|i| (places.stations[i], places.points[i])));
        }
    }
    points.append(&mut replaced);
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut points: Vec<Point> = points.into_iter().map(|(_, point)| point).collect();
    points.dedup();
    if points.len() < FEWEST {
        points = new.samples(new.length() / FEWEST as f64).into_iter().map(|pose| pose.point).collect();
    }
    let name = sources.first().map(|(stroke, _)| stroke.name.clone()).unwrap_or_default();
    Stroke::new(name, points)
}

/// Fewer points than this say too little about a curve; its own are taken instead.
const FEWEST: usize = 4;

/// Places along the new curve: equally far apart, and its corners.
struct Places {
    stations: Vec<f64>,
    points: Vec<Point>,
}

/// What lies on both curves: the part of the new one from a place to the next.
struct Stretch {
    /// Index of the place of the new curve where it begins.
    at: usize,
    /// Stations of its ends on the new curve.
    new: [f64; 2],
    /// Stations of the same ends on the old curve; beyond its ends if it is closed and the part goes on through its start.
    old: [f64; 2],
}

impl Places {
    fn new(curve: &Spline, pixel_size: f64) -> Self {
        let length = curve.length();
        let samples = curve.samples((SPACING * pixel_size).max(length / MOST_PLACES));
        let step = length / (samples.len() - 1) as f64;
        let mut places: Vec<(f64, Point)> =
            samples.into_iter().enumerate().map(|(i, pose)| (step * i as f64, pose.point)).collect();
        let mut station = 0.0;
        for (segment, join) in curve.segments().iter().zip(curve.joins()) {
            station += segment.length;
            if *join == Continuity::G0 && station < length {
                places.push((station, segment.end()));
            }
        }
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (stations, points) = places.into_iter().unzip();
        Self { stations, points }
    }

    /// Index of the stretch in which a station lies.
    fn stretch(&self, station: f64) -> usize {
        self.stations.partition_point(|&s| s <= station).clamp(1, self.stations.len() - 1) - 1
    }

    /// The stretches that lie on an old curve.
    fn shared_with(&self, old: &Spline, new: &Spline) -> Vec<Stretch> {
        let same = SAME * (old.length() + new.length());
        let mut follower = Follower::new(old, 0.0);
        let mut before = 0.0;
        let mut station_of = |station: f64, point: Point| {
            let place = follower.peek(point, 2.0 * (station - before) + same, same);
            before = station;
            (place.distance <= same).then(|| follower.go_to(place.station))
        };
        let on_old: Vec<Option<f64>> =
            self.stations.iter().zip(&self.points).map(|(&station, &point)| station_of(station, point)).collect();
        let stretch = |at: usize| {
            let new = [self.stations[at], self.stations[at + 1]];
            let (from, to) = (on_old[at]?, on_old[at + 1]?);
            let way = if old.is_closed() { shorter_way(from, to, old.length()) } else { to - from };
            // Both ends may lie on the old curve and what is between them not.
            let is_same = (way.abs() - (new[1] - new[0])).abs() <= same;
            is_same.then_some(Stretch { at, new, old: [from, from + way] })
        };
        (0..on_old.len() - 1).filter_map(stretch).collect()
    }
}

/// How far it is from one station of a closed curve to another, the shorter way, negative against its direction.
fn shorter_way(from: f64, to: f64, length: f64) -> f64 {
    let way = (to - from).rem_euclid(length);
    if way > 0.5 * length { way - length } else { way }
}

/// The points of a stroke that belong to the stretches, each with its station on the new curve.
fn moved_over(stroke: &Stroke, old: &Spline, stretches: &[Stretch], pixel_size: f64) -> Vec<(f64, Point)> {
    let length = old.length();
    let mut sorted: Vec<&Stretch> = stretches.iter().collect();
    sorted.sort_by(|a, b| a.old[0].min(a.old[1]).total_cmp(&b.old[0].min(b.old[1])));
    let find = |station: f64| {
        let end = sorted.partition_point(|stretch| stretch.old[0].min(stretch.old[1]) <= station);
        let stretch = sorted.get(end.checked_sub(1)?)?;
        (stretch.old[0].max(stretch.old[1]) >= station).then(|| {
            let share = (station - stretch.old[0]) / (stretch.old[1] - stretch.old[0]);
            stretch.new[0] + share * (stretch.new[1] - stretch.new[0])
        })
    };
    let mut follower = Follower::new(old, RETURN);
    let mut before = stroke.points.first().copied().unwrap_or_default();
    let mut moved = Vec::new();
    for &point in &stroke.points {
        let reach = 2.0 * (point - before).hypot() + SLACK * pixel_size;
        let place = follower.peek(point, reach, NEAR * pixel_size);
        let station = follower.go_to(place.station);
        before = point;
        // What goes on through the start of a closed curve has stations beyond its ends.
        let turns: &[f64] = if old.is_closed() { &[0.0, length, -length] } else { &[0.0] };
        if let Some(s) = turns.iter().find_map(|turn| find(station + turn)) {
            moved.push((s, point));
        }
    }
    moved
}

/// The ends of the new curve, of `count` stretches, that lie within the old one: there it was cut, between two points of the stroke.
fn cut_ends(old: &Spline, new: &Spline, stretches: &[Stretch], count: usize) -> Vec<(f64, Point)> {
    if new.is_closed() {
        return Vec::new();
    }
    let margin = SAME * old.length();
    let within = |station: f64| old.is_closed() || (station > margin && station < old.length() - margin);
    let mut ends = Vec::new();
    if let Some(first) = stretches.first().filter(|first| first.at == 0 && within(first.old[0])) {
        ends.push((first.new[0], new.start_pose().point));
    }
    if let Some(last) = stretches.last().filter(|last| last.at + 1 == count && within(last.old[1])) {
        ends.push((last.new[1], new.end_pose().point));
    }
    ends
}

/// Runs of stretches that are not shared, as indices of the places where they begin and end.
fn runs_of_changed(shared: &[bool]) -> Vec<[usize; 2]> {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for i in (0..shared.len()).filter(|&i| !shared[i]) {
        match runs.last_mut() {
            Some(run) if run[1] == i => run[1] = i + 1,
            _ => runs.push([i, i + 1]),
        }
    }
    runs
}
