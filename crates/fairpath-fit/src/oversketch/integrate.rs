//! One stroke of the sketch and of the parts of the old curve beside it (section 3.7 and the middle of figure 8 of Baran et al. 2010).

use super::region::{Replaced, corners};
use crate::conclude::distances;
use crate::polyline::Polyline;
use fairpath_curve::{Point, Spline, Vec2};

/// Distance of the points taken from the old curve, px.
const SPACING: f64 = 2.0;

/// The move of the sketch's end fades over at least this many times its own length.
const GENTLE: f64 = 4.0;

/// Points along the new course of the curve, px.
#[derive(Clone, Debug)]
pub(super) struct Integrated {
    pub(super) line: Polyline,
    /// Arc lengths at which the sketch leaves the old curve and joins it again.
    pub(super) sketch: [f64; 2],
    /// How far the sketch departs from the old curve, px.
    pub(super) departure: f64,
    /// Arc lengths of the corners of the old curve among these points.
    pub(super) corners: Vec<f64>,
}

/// The sketch turned into the direction of the curve, with its ends moved onto it where they are attached.
pub(super) fn attached(curve: &Spline, sketch: &Polyline, replaced: &Replaced, attenuation: f64) -> Vec<Vec2> {
    let mut points = sketch.points.clone();
    if replaced.backward {
        points.reverse();
    }
    let line = Polyline::new(points);
    let length = line.length();
    let ends = replaced.ends(curve).map(|p| p.to_vec2());
    let n = line.points.len();
    let mut moves = [ends[0] - line.points[0], ends[1] - line.points[n - 1]];
    for (side, by) in moves.iter_mut().enumerate() {
        let station = [replaced.from, replaced.to][side];
        if !replaced.attached[side] {
            *by = Vec2::ZERO;
        } else if !curve.is_closed() && station == [curve.length(), 0.0][side] {
            // What begins beyond the curve's end need not be drawn back to it: the curve runs on to there.
            let outward = curve.tangent_at(station) * [1.0, -1.0][side];
            *by -= outward * by.dot(outward).min(0.0);
        }
    }
    let fades = moves.map(|by| attenuation.max(GENTLE * by.hypot2().sqrt()).min(0.5 * length));
    let share = |away: f64, over: f64| if over > 0.0 { (1.0 - away / over).max(0.0) } else { 0.0 };
    let moved = |(p, s): (&Vec2, &f64)| *p + moves[0] * share(*s, fades[0]) + moves[1] * share(length - s, fades[1]);
    let mut out: Vec<Vec2> = line.points.iter().zip(&line.s).map(moved).collect();
    // The ends of a stroke of two points or of none that fades are where they belong all the same.
    (out[0], out[n - 1]) = (line.points[0] + moves[0], line.points[n - 1] + moves[1]);
    out
}

/// The old curve from `begin` to where the sketch leaves it, the sketch, and the old curve from where it is joined to `end`.
pub(super) fn integrated(curve: &Spline, sketch: &[Vec2], replaced: &Replaced, [begin, end]: [f64; 2]) -> Integrated {
    let mut course = Course::default();
    course.follow(curve, begin, replaced.from);
    let first = course.points.len().saturating_sub(1);
    course.extend(sketch);
    let last = course.points.len() - 1;
    course.follow(curve, replaced.to, end);
    let line = Polyline::new(course.points);
    let corners = course.corners.into_iter().map(|i| line.s[i]).collect();
    let sketched: Vec<Point> = sketch.iter().map(|p| p.to_point()).collect();
    let departure = distances(curve, &sketched).into_iter().fold(0.0, f64::max);
    let sketch = [line.s[first], line.s[last]];
    Integrated { line, sketch, departure, corners }
}

/// A polyline as it grows, and which of its points are corners of the old curve.
#[derive(Default)]
struct Course {
    points: Vec<Vec2>,
    corners: Vec<usize>,
}

impl Course {
    /// Adds points, without repetition.
    fn extend(&mut self, more: &[Vec2]) {
        for &p in more {
            if self.points.last().is_none_or(|last| (p - *last).hypot2() > 1e-6) {
                self.points.push(p);
            }
        }
    }

    /// Adds points of the curve between two stations, both included; nothing if they are one.
    fn follow(&mut self, curve: &Spline, from: f64, to: f64) {
        if !(to - from > 1e-6) {
            return;
        }
        let length = curve.length();
        let turns = if curve.is_closed() { -1..=2 } else { 0..=0 };
        let mut stops: Vec<f64> = turns
            .flat_map(|turn| corners(curve).map(move |(s, _)| s + f64::from(turn) * length))
            .filter(|&s| s > from + 1e-6 && s < to - 1e-6)
            .collect();
        stops.sort_by(f64::total_cmp);
        stops.push(to);
        let mut begin = from;
        for stop in stops {
            let n = ((stop - begin) / SPACING).ceil().max(1.0);
            let point = |i: usize| curve.point_at(begin + (stop - begin) * i as f64 / n).to_vec2();
            let part: Vec<Vec2> = (0..=n as usize).map(point).collect();
            self.extend(&part);
            if stop < to {
                self.corners.push(self.points.len() - 1);
            }
            begin = stop;
        }
    }
}
