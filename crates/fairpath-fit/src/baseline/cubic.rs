//! Least-squares cubics after Schneider, by the crate flo_curves: a stroke in, its cubics followed by clothoids out, so that every method gives
//! the same kind of curve.

use super::options::CubicOptions;
use super::stretches;
use crate::conclude::Parts;
use crate::track::{Shape, Track};
use crate::walk::Datum;
use fairpath_curve::{Continuity, Pose, Segment, Vec2, clothoids_along, trig};
use flo_curves::BezierCurveFactory as _;
use flo_curves::bezier::{BezierCurve, Coord2, Curve, fit_curve_cubic};
use std::f64::consts::TAU;

/// The curve and the number of cubics that it stands for.
pub(crate) fn cubics(track: &Track, options: &CubicOptions) -> Option<(Parts, usize)> {
    let ring = track.shape == Shape::Ring;
    let (mut segments, mut joins): (Vec<Segment>, Vec<Continuity>) = (Vec::new(), Vec::new());
    let mut count = 0;
    for data in stretches(track) {
        for (i, cubic) in fitted(data, ring, options.tolerance).iter().enumerate() {
            let (chain, within) = clothoids_along(|t| cubic.pose(t), options.accuracy);
            let (Some(first), before) = (chain.first(), segments.last()) else { continue };
            if let Some(before) = before {
                let smooth = i > 0 && meets(before, first);
                joins.push(if smooth { Continuity::G1 } else { Continuity::G0 });
            }
            joins.extend(within);
            segments.extend(chain);
            count += 1;
        }
    }
    let closed = track.shape != Shape::Open;
    if closed {
        let smooth = ring && meets(segments.last()?, segments.first()?);
        joins.push(if smooth { Continuity::G1 } else { Continuity::G0 });
    }
    Some(((segments, joins, closed), count))
}

/// Whether one segment runs on into another without a corner, to rounding.
fn meets(a: &Segment, b: &Segment) -> bool {
    trig::wrap_angle(a.end_heading() - b.heading).abs() < SAME_HEADING
}

/// Headings of neighbouring cubics come from one tangent and differ by rounding only, radians.
const SAME_HEADING: f64 = 1e-10;

/// A cubic Bézier curve by its control points.
struct Cubic([Vec2; 4]);

impl Cubic {
    fn of(curve: &Curve<Coord2>) -> Self {
        let (a, b) = curve.control_points();
        Self([curve.start_point(), a, b, curve.end_point()].map(|p| Vec2::new(p.0, p.1)))
    }

    fn pose(&self, t: f64) -> Pose {
        let [a, b, c, d] = self.0;
        let u = 1.0 - t;
        let point = a * (u * u * u) + b * (3.0 * u * u * t) + c * (3.0 * u * t * t) + d * (t * t * t);
        let first = (b - a) * (3.0 * u * u) + (c - b) * (6.0 * u * t) + (d - c) * (3.0 * t * t);
        let second = (c - b * 2.0 + a) * (6.0 * u) + (d - c * 2.0 + b) * (6.0 * t);
        let speed = first.hypot2().sqrt();
        // Where the curve stands still, as at an end whose control point lies on it, it goes on to the next control point.
        let stands = speed <= STILL * ((b - a).hypot2() + (c - b).hypot2() + (d - c).hypot2()).sqrt();
        let direction = match (stands, t < 0.5) {
            (false, _) => first,
            (true, true) => second,
            (true, false) => second * -1.0,
        };
        let curvature = if stands { 0.0 } else { first.cross(second) / (speed * speed * speed) };
        Pose { point: point.to_point(), heading: trig::angle_of(direction), curvature }
    }
}

/// Speeds below this share of the control polygon are rounding.
const STILL: f64 = 1e-9;

/// The cubics of a stretch, each beginning where and in the direction in which the one before ends.
fn fitted(data: &[Datum], ring: bool, tolerance: f64) -> Vec<Cubic> {
    let points: Vec<Coord2> = data.iter().map(|d| Coord2(d.point.x, d.point.y)).collect();
    let last = points.len() - 1;
    let cuts = last.div_ceil(MOST_AT_ONCE);
    let stops: Vec<usize> = (0..=cuts).map(|k| k * last / cuts).collect();
    let direction = |i: usize| tangent(data, i, ring);
    let mut out = Vec::new();
    for block in stops.windows(2) {
        let (from, to) = (direction(block[0]), direction(block[1]));
        let run = &points[block[0]..=block[1]];
        let curves: Vec<Curve<Coord2>> = if let [a, b] = run {
            // Two points have no interior that could tell of a bend.
            let third = (*b - *a) * (1.0 / 3.0);
            vec![Curve::from_points(*a, (*a + third, *b - third), *b)]
        } else {
            fit_curve_cubic(run, &Coord2(from.x, from.y), &Coord2(-to.x, -to.y), tolerance)
        };
        out.extend(curves.iter().map(Cubic::of));
    }
    out
}

/// Points that are fitted at once: the time for one cubic's worth of division grows with the square of them.
const MOST_AT_ONCE: usize = 400;

/// The direction of the stroke at a point: that of the chord over [`REACH`] to both sides, or to one at an end.
fn tangent(data: &[Datum], i: usize, ring: bool) -> Vec2 {
    let last = data.len() - 1;
    let (low, high) = (data[i].s - REACH, data[i].s + REACH);
    let ends = i == 0 || i == last;
    let ahead = |i: usize| data[i + 1..].iter().find(|d| d.s >= data[i].s + REACH).unwrap_or(&data[last]).point;
    let behind = |i: usize| data[..i].iter().rev().find(|d| d.s <= data[i].s - REACH).unwrap_or(&data[0]).point;
    let chord = match (ends, ring) {
        // The seam of a ring is a point like any other.
        (true, true) => ahead(0) - behind(last),
        _ => {
            let b = if high > data[last].s { data[last].point } else { ahead(i) };
            let a = if low < data[0].s { data[0].point } else { behind(i) };
            b - a
        }
    };
    trig::unit(if chord.hypot2() > 0.0 { trig::angle_of(chord) } else { 0.0 } % TAU)
}

/// How far to both sides the direction is taken from, px: over less, tremor would turn it.
const REACH: f64 = 8.0;
