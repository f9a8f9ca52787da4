//! Which places of a stroke are meant as corners.
//!
//! A place is a corner where its neighbourhood is described much better by two arcs that meet there at an angle than by a
//! single arc (Baran et al. 2010, section 3.1, leave the details open). Several sizes of neighbourhood are tried: small ones
//! see corners that lie close together, large ones see obtuse corners through the tremor.

use crate::options::FitOptions;
use crate::polyline::Polyline;
use crate::primitive_fit::{Walked, chord, circle_through, refine, walk_arc, walk_line};
use crate::walk::{Datum, Primitive, Walker};
use fairpath_curve::{Vec2, trig};

/// Distance of the evenly spaced points on which corners are looked for, px.
const SPACING: f64 = 2.0;

/// Strokes longer than this are looked at with the full neighbourhoods, px; those of shorter ones shrink to this share at least.
const FULL_SIZE: f64 = 150.0;
const FINEST: f64 = 0.45;

/// More points than this are not looked at: the spacing grows instead.
const MOST_POINTS: f64 = 40_000.0;

/// Tremor that comes with steps of a given size, as a share of it, and the smallest neighbourhood in such steps.
const GRAIN_NOISE: f64 = 0.25;
const GRAIN_WINDOW: f64 = 4.5;

/// Share of the least corner angle that must show in the narrowest neighbourhood before a place is looked at closely.
const NARROW_SHARE: f64 = 0.5;

/// Arc lengths of the corners, increasing; the ends of an open stroke are not among them.
pub(crate) fn corners(line: &Polyline, closed: bool, grain: f64, options: &FitOptions) -> Vec<f64> {
    let length = line.length();
    if length < SPACING {
        return Vec::new();
    }
    // What is small is drawn finely: its corners are looked for in smaller neighbourhoods.
    let fineness = (length / FULL_SIZE).clamp(FINEST, 1.0);
    let count = round((length / (fineness * SPACING)).min(MOST_POINTS)).max(1.0) as usize;
    let spacing = length / count as f64;
    let mut hint = 0;
    let points: Vec<Vec2> = (0..=count).map(|i| line.at(spacing * i as f64, &mut hint)).collect();
    let n = if closed { count } else { count + 1 };
    let noise = (fineness * options.corner_noise).max(GRAIN_NOISE * grain);
    let mut found: Vec<Sighting> = Vec::new();
    // A neighbourhood of a few steps of a staircase shows nothing but steps.
    let reach = |window: f64| round((fineness * window).max(GRAIN_WINDOW * grain) / spacing) as usize;
    let windows = options.corner_windows().map(reach);
    let narrow = windows[3].max(MIN_SIDE) as isize;
    let (sin_least, cos_least) = trig::sin_cos(NARROW_SHARE * options.corner_angle.to_radians());
    let course = Surroundings::new(&points[..n], if closed { windows[0].min(n) } else { 0 });
    for i in 0..n {
        // A corner turns within a few pixels what it turns at all.
        let index = |j: isize| {
            if closed { j.rem_euclid(n as isize) as usize } else { j.clamp(0, n as isize - 1) as usize }
        };
        let (a, p, b) = (points[index(i as isize - narrow)], points[i], points[index(i as isize + narrow)]);
        let (into, out) = (p - a, b - p);
        // The turn is less than that angle.
        if into.cross(out).abs() * cos_least <= into.dot(out) * sin_least {
            continue;
        }
        for k in windows {
            let (left, right) = if closed { (k, k) } else { (k.min(i), k.min(n - 1 - i)) };
            // A side cut short by the stroke's end tells about as much as a smaller window does.
            if k < MIN_SIDE || 2 * left.min(right) < k.max(2 * MIN_SIDE) || (closed && 2 * k >= n) {
                continue;
            }
            if let Some(strength) = strength(&course.around(i, left, right), noise, options) {
                found.push(Sighting { strength, place: i, reach: k });
            }
        }
    }
    // The strongest stays. What was seen through a window that holds a stronger corner was that corner, seen from aside.
    found.sort_by(|a, b| b.strength.total_cmp(&a.strength).then(a.place.cmp(&b.place)));
    let least = (fineness * options.corner_distance / spacing) as usize;
    let mut kept: Vec<usize> = Vec::new();
    for sighting in found {
        let near = |&j: &usize| {
            let d = sighting.place.abs_diff(j);
            (if closed { d.min(n - d) } else { d }) < sighting.reach.max(least)
        };
        if !kept.iter().any(near) {
            kept.push(sighting.place);
        }
    }
    kept.sort_unstable();
    kept.into_iter()
        .map(|i| spacing * i as f64)
        .filter(|&s| rounding(line, s, closed, fineness, options).is_none_or(|radius| radius < options.corner_radius))
        .collect()
}

/// The radius to which the stroke is rounded at a corner, px; nothing if it stays within the tremor of a sharp one.
///
/// Both sides are prolonged from beyond the rounding. A sharp corner has its vertices on one side or the other; a round one turned by θ
/// passes at `r (1 − cos ½θ)` inside of both.
fn rounding(line: &Polyline, corner: f64, closed: bool, fineness: f64, options: &FitOptions) -> Option<f64> {
    let length = line.length();
    let clear = fineness * CLEAR;
    let at = |s: f64| {
        let s = if closed { s.rem_euclid(length) } else { s };
        line.at(s, &mut line.s.partition_point(|&v| v <= s).saturating_sub(1))
    };
    let side = |direction: f64| {
        let run: Vec<Datum> = (0..SIDE_POINTS)
            .map(|j| clear + fineness * SIDE * j as f64 / (SIDE_POINTS - 1) as f64)
            .filter(|away| closed || (0.0..=length).contains(&(corner + direction * away)))
            .map(|away| Datum { point: at(corner + direction * away), s: away, weight: 1.0 })
            .collect();
        (run.len() >= MIN_SIDE).then(|| line_or_arc(&run, options.corner_noise * options.corner_noise).primitive)
    };
    let sides = [side(-1.0)?, side(1.0)?];
    let between = |low: f64, high: f64| line.s.partition_point(|&s| s <= low)..line.s.partition_point(|&s| s < high);
    let mut near: Vec<usize> = between(corner - clear, corner + clear).collect();
    if closed {
        near.extend(between(corner - clear + length, length));
        near.extend(between(0.0, corner + clear - length));
    }
    let turn_at = |i: usize| {
        let (s, p) = (line.s[i], line.points[i]);
        turn_between(p - at(s - STEP), at(s + STEP) - p)
    };
    if near.iter().any(|&i| turn_at(i) > SHARP) {
        return None;
    }
    let vertices = near.iter().map(|&i| line.points[i]);
    let inside =
        |p: Vec2| sides.map(|side| Walker::new(&side).project(p).distance.abs()).into_iter().fold(f64::MAX, f64::min);
    let most = vertices.map(inside).fold(0.0, f64::max);
    let turn = trig::wrap_angle(sides[1].heading - sides[0].heading - std::f64::consts::PI);
    (most > TREMOR * options.corner_noise).then(|| most / (1.0 - trig::sin_cos(0.5 * turn).1))
}

/// Distance from a corner at which its sides are taken to begin, and their length, px.
const CLEAR: f64 = 7.0;
const SIDE: f64 = 10.0;
const SIDE_POINTS: usize = 9;

/// A vertex at which the stroke turns by more than this between steps of that length is sharp, radians and px: on a bend the turning
/// is spread.
const SHARP: f64 = 1.0;
const STEP: f64 = 2.5;

/// A vertex further from both sides than this many times the tremor tells of a rounding.
const TREMOR: f64 = 2.5;

/// The angle between two chords, radians.
fn turn_between(into: Vec2, out: Vec2) -> f64 {
    trig::angle_of(Vec2::new(into.dot(out), into.cross(out))).abs()
}

/// A corner as it appears in one neighbourhood.
struct Sighting {
    strength: f64,
    place: usize,
    /// Points on each side that were looked at.
    reach: usize,
}

/// The fewest steps on either side from which an arc can be judged.
const MIN_SIDE: usize = 4;

fn round(v: f64) -> f64 {
    (v + 0.5).floor()
}

/// The evenly spaced points both ways round, so that every neighbourhood is a slice of them.
struct Surroundings {
    forth: Vec<Datum>,
    back: Vec<Datum>,
    /// Points of a closed stroke that are repeated at each end.
    repeated: usize,
}

/// The neighbourhood of a place, which belongs to neither side.
struct Neighbourhood<'a> {
    whole: &'a [Datum],
    /// Both sides, walked away from the place.
    back: &'a [Datum],
    forth: &'a [Datum],
    place: Vec2,
}

impl Surroundings {
    fn new(points: &[Vec2], repeated: usize) -> Self {
        let n = points.len();
        let around = points[n - repeated..].iter().chain(points).chain(&points[..repeated]);
        let datum = |(point, i): (&Vec2, u32)| Datum { point: *point, s: f64::from(i), weight: 1.0 };
        Self {
            forth: around.clone().zip(0..).map(datum).collect(),
            back: around.rev().zip(0..).map(datum).collect(),
            repeated,
        }
    }

    fn around(&self, i: usize, left: usize, right: usize) -> Neighbourhood<'_> {
        let at = i + self.repeated;
        let mirrored = self.back.len() - 1 - at;
        Neighbourhood {
            whole: &self.forth[at - left..=at + right],
            back: &self.back[mirrored + 1..=mirrored + left],
            forth: &self.forth[at + 1..=at + right],
            place: self.forth[at].point,
        }
    }
}

/// How strong a corner is: the angle at which the two arcs meet over the distance that they leave; nothing where it is none.
///
/// It is one if the two arcs meet at a sufficient angle, if that angle makes up most of the neighbourhood's turning (a tight
/// bend turns all along), and if they leave much less distance than a single arc.
fn strength(near: &Neighbourhood, noise: f64, options: &FitOptions) -> Option<f64> {
    let steps = (near.whole.len() - 1) as f64;
    let (a, p, b) = (near.whole[0].point, near.place, near.whole[near.whole.len() - 1].point);
    let floor = noise * noise;
    // No arc follows a stroke that turns back on itself: it would have to be walked back and forth.
    let turns_back = (b - a).hypot2().sqrt() / steps < 0.1;
    // Even if the two arcs left nothing, a single one that leaves no more than this would do.
    if !turns_back && one_leaves_less(near.whole, options.corner_score * floor) {
        return None;
    }
    let back = line_or_arc(near.back, floor);
    let forth = line_or_arc(near.forth, floor);
    // Both arcs were walked away from the corner; the arriving direction is opposite to that of the walk.
    let jump = trig::wrap_angle(forth.primitive.heading - back.primitive.heading - std::f64::consts::PI).abs();
    if jump < options.corner_angle.to_radians() || jump < options.corner_share * turn_between(p - a, b - p) {
        return None;
    }
    let sides = (back.normal.energy + forth.normal.energy) / (back.normal.weight + forth.normal.weight);
    let whole = line_or_arc(near.whole, floor);
    let one =
        if turns_back && whole.length < 0.5 * steps { f64::MAX } else { whole.normal.energy / whole.normal.weight };
    let remaining = sides + floor;
    (one - sides >= options.corner_score * remaining).then(|| jump / remaining)
}

/// Whether some line or arc leaves a mean square distance below `limit`, px²: the best one leaves no more.
fn one_leaves_less(run: &[Datum], limit: f64) -> bool {
    let limit = limit * run.len() as f64;
    // A hairpin lies along a line too, but does not follow it.
    let apart = (run[run.len() - 1].point - run[0].point).hypot2();
    let path: f64 = run.windows(2).map(|d| (d[1].point - d[0].point).hypot2()).sum::<f64>() * (run.len() - 1) as f64;
    if apart > STRAIGHT * path && line_energy(run) < limit {
        return true;
    }
    let arc = circle_through(run);
    if arc_energy(&arc, run) < limit {
        return true;
    }
    let fit = walk_arc(&arc, run, 1.0);
    fit.normal.step(3).is_some_and(|step| arc_energy(&fit.primitive.moved(&step), run) < limit)
}

/// Least square of a run's chord, as a share of its length's, at which a line can follow the run.
const STRAIGHT: f64 = 0.5;

/// Sum of the squared distances to the line nearest to all points, px².
fn line_energy(run: &[Datum]) -> f64 {
    let n = run.len() as f64;
    let origin = run[0].point;
    let (mut sum, mut xx, mut xy, mut yy) = (Vec2::ZERO, 0.0, 0.0, 0.0);
    for datum in run {
        let v = datum.point - origin;
        sum += v;
        xx += v.x * v.x;
        xy += v.x * v.y;
        yy += v.y * v.y;
    }
    let (xx, xy, yy) = (xx - sum.x * sum.x / n, xy - sum.x * sum.y / n, yy - sum.y * sum.y / n);
    0.5 * (xx + yy) - (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
}

/// Sum of the squared distances to the circle of which an arc is part, px².
fn arc_energy(arc: &Primitive, run: &[Datum]) -> f64 {
    let (tangent, kappa) = (trig::unit(arc.heading), arc.kappa);
    let square = |datum: &Datum| {
        let v = datum.point - arc.start;
        let (q, y) = (v.hypot2(), tangent.cross(v));
        // The radius less the distance from the centre, in a form that holds for straight arcs as well.
        let d = (2.0 * y - kappa * q) / (1.0 + (1.0 - kappa * (2.0 * y - kappa * q)).max(0.0).sqrt());
        d * d
    };
    run.iter().map(square).sum()
}

/// The arc that describes a run best, or a line where that does to within the tremor.
fn line_or_arc(run: &[Datum], floor: f64) -> Walked {
    let line = walk_line(&chord(run), run, 1.0);
    let line = line.normal.step(2).map_or(line, |step| walk_line(&line.primitive.moved(&step), run, 1.0));
    if line.normal.energy < 0.5 * floor * line.normal.weight {
        return line;
    }
    let arc = refine(&circle_through(run), run, 3, 2, 1.0);
    if arc.normal.energy.is_finite() && arc.normal.energy <= line.normal.energy { arc } else { line }
}
