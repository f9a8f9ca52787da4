//! Is the stroke a closed curve, and if so, where do its ends meet (section 3.1 of Baran et al. 2010)?

use crate::clean::distance;
use crate::options::{Closing, FitOptions};
use crate::polyline::Polyline;
use fairpath_curve::Vec2;

/// Closed strokes have ends nearer than this share of their length: a small stroke is not closed because it is small.
const GAP_SHARE: f64 = 0.08;

/// The narrow side of a closed stroke is at least this share of its wide side: a line traced there and back is not closed.
const NARROWEST: f64 = 0.08;

/// A closed stroke, its ends trimmed to where they meet.
#[derive(Clone, Debug)]
pub(crate) struct Closed {
    /// Points of one turn; the first is not repeated at the end.
    pub(crate) points: Vec<Vec2>,
    /// Points that were cut off at the ends.
    pub(crate) trimmed: usize,
}

/// The closed form of a stroke, or nothing if it is open.
pub(crate) fn close(points: &[Vec2], options: &FitOptions) -> Option<Closed> {
    let n = points.len();
    if options.closed == Closing::No || n < 4 {
        return None;
    }
    let line = Polyline::new(points.to_vec());
    let length = line.length();
    let gap = distance(points[0], points[n - 1]);
    if options.closed == Closing::Auto {
        let largest = options.closing_gap.min(GAP_SHARE * length);
        if gap > largest || narrowness(points) < NARROWEST {
            return None;
        }
    }
    // Ends that overshoot each other are cut back to the nearest two points of the first and the last stretch of the stroke.
    let reach = (1.5 * options.closing_gap).min(0.2 * length);
    let first = (0..n).take_while(|&i| line.s[i] <= reach).last().unwrap_or(0);
    let last = (0..n).rev().take_while(|&i| line.s[i] >= length - reach).last().unwrap_or(n - 1);
    let (mut best, mut ends) = (f64::INFINITY, (0, n - 1));
    for i in 0..=first {
        for j in last.max(i + 3)..n {
            // Each pixel that is cut off must buy something: without this price, tremor would trim strokes that meet well.
            let cost = distance(points[i], points[j]) + TRIM_PRICE * (line.s[i] + length - line.s[j]);
            if cost < best {
                (best, ends) = (cost, (i, j));
            }
        }
    }
    let (i, j) = ends;
    // What is cut off must lie along what stays: a tail that leads away is part of the drawing.
    let far = STRAY_PX.min(STRAY_SHARE * length);
    let strays = |p: &Vec2| points[i..=j].windows(2).all(|e| distance_to_edge(*p, e[0], e[1]) > far);
    if options.closed == Closing::Auto && (points[..i].iter().any(strays) || points[j + 1..].iter().any(strays)) {
        return None;
    }
    let turn = Polyline::new(points[i..=j].to_vec());
    let total = turn.length();
    // The gap that remains is spread over the whole stroke, but only its part across the direction of travel: a gap along it
    // is bridged by the curve itself.
    let v = points[j] - points[i];
    let m = turn.points.len();
    let ahead = (turn.points[(m / 12).clamp(1, m - 1)] - points[i])
        + (points[j] - turn.points[m - 1 - (m / 12).clamp(1, m - 1)]);
    let along = if ahead.hypot2() > 0.0 { ahead * (v.dot(ahead) / ahead.hypot2()) } else { Vec2::ZERO };
    let bridged = v.dot(ahead) < 0.0 && v.dot(ahead).powi(2) > 0.5 * v.hypot2() * ahead.hypot2();
    let spread = if bridged { v - along } else { v };
    if options.closed == Closing::Auto && spread.hypot2() > WIDEST_SPREAD * WIDEST_SPREAD {
        return None;
    }
    let mut moved: Vec<Vec2> = turn.points.iter().zip(&turn.s).map(|(p, s)| *p + spread * (0.5 - s / total)).collect();
    if !bridged || distance(moved[0], moved[m - 1]) < 0.5 {
        moved.pop();
    }
    // A straight line that is told to close collapses: it has no inside.
    if Polyline::new(moved.clone()).length() < LEAST_TURN * length {
        return None;
    }
    Some(Closed { points: moved, trimmed: i + n - 1 - j })
}

/// Least length of what closing leaves, as a share of the stroke's.
const LEAST_TURN: f64 = 0.1;

/// Ends that pass each other at more than this were not meant to meet, px: spreading the gap would move both by half of it.
const WIDEST_SPREAD: f64 = 9.0;

/// Points that are cut off lie at most this far from what stays, px, and at most this share of the stroke's length.
const STRAY_PX: f64 = 8.0;
const STRAY_SHARE: f64 = 0.03;

fn distance_to_edge(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let v = b - a;
    let u = if v.hypot2() > 0.0 { ((p - a).dot(v) / v.hypot2()).clamp(0.0, 1.0) } else { 0.0 };
    distance(p, a + v * u)
}

/// Price of cutting off one pixel of stroke, in pixels of remaining gap.
const TRIM_PRICE: f64 = 0.25;

/// Ratio of the extents of the points along and across their main direction, in [0, 1].
fn narrowness(points: &[Vec2]) -> f64 {
    let n = points.len() as f64;
    let mean = points.iter().fold(Vec2::ZERO, |a, p| a + *p) / n;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for p in points {
        let v = *p - mean;
        xx += v.x * v.x;
        xy += v.x * v.y;
        yy += v.y * v.y;
    }
    let (half, root) = (0.5 * (xx + yy), (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt());
    ((half - root).max(0.0) / (half + root).max(1e-300)).sqrt()
}
