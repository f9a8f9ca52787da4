//! Chains of clothoids from what a draughtsman would note down: how long each part is and how it bends at its ends.

use fairpath_curve::{Continuity, Point, Segment, Spline, Vec2};
use std::f64::consts::TAU;

/// A place where the slope of curvature changes: length of the part that begins there, px, and curvature there, radians per px.
pub(crate) type Knot = (f64, f64);

/// Curvature that every knot may change by while a ring is closed, beside a share of its own: radians per px.
const PLAY: f64 = 0.0008;

/// An open chain that runs through the knots' curvatures; the last knot's length does not count.
pub(crate) fn open(heading: f64, knots: &[Knot]) -> Spline {
    let parts = knots.windows(2).map(|pair| (pair[0].0, pair[0].1, pair[1].1));
    let segments = chained(heading, parts);
    let joins = vec![Continuity::G2; segments.len() - 1];
    Spline::new(segments, joins, false).expect("a chain meets by construction")
}

/// A closed chain near the knots, from the last of which the curve runs back to the first, with G2 joins throughout.
///
/// Numbers noted by hand do not close. The ring is the nearest that does: lengths and curvatures are changed in proportion to their size by
/// as little as possible, in the sense of least squares, until the end meets the start and the curve has turned once.
pub(crate) fn ring(heading: f64, knots: &[Knot]) -> Spline {
    let mut knots = knots.to_vec();
    let play: Vec<(f64, f64)> = knots.iter().map(|&(length, kappa)| (length, kappa.abs() + PLAY)).collect();
    let mut best = f64::INFINITY;
    for _ in 0..60 {
        let segments = closed_chain(heading, &knots);
        let (missing, jacobian) = gap(&segments, &play);
        let size = missing.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        // At rounding, further steps gain nothing.
        if size < 1e-12 && size >= best {
            break;
        }
        best = best.min(size);
        let step = least_change(&jacobian, missing);
        let largest = step.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let damped = if largest > 0.2 { 0.2 / largest } else { 1.0 };
        for (i, (knot, play)) in knots.iter_mut().zip(&play).enumerate() {
            knot.0 -= play.0 * step[2 * i] * damped;
            knot.1 -= play.1 * step[2 * i + 1] * damped;
        }
    }
    let segments = closed_chain(heading, &knots);
    let joins = vec![Continuity::G2; segments.len()];
    Spline::new(segments, joins, true).expect("the ring was closed")
}

fn closed_chain(heading: f64, knots: &[Knot]) -> Vec<Segment> {
    let next = |i: usize| knots[(i + 1) % knots.len()].1;
    chained(heading, knots.iter().enumerate().map(|(i, &(length, kappa))| (length, kappa, next(i))))
}

fn chained(heading: f64, parts: impl Iterator<Item = (f64, f64, f64)>) -> Vec<Segment> {
    let mut segments: Vec<Segment> = Vec::new();
    for (length, kappa0, kappa1) in parts {
        let (start, heading) = segments.last().map_or((Point::ORIGIN, heading), |s| (s.end(), s.end_heading()));
        segments.push(Segment::clothoid(start, heading, length, kappa0, kappa1));
    }
    segments
}

/// What a ring is open by, the end's place over the length and the turning less a whole turn, and its derivatives by each knot's length and
/// curvature in shares of their play.
fn gap(segments: &[Segment], play: &[(f64, f64)]) -> ([f64; 3], [Vec<f64>; 3]) {
    let count = segments.len();
    let length: f64 = segments.iter().map(|s| s.length).sum();
    let turning: f64 = segments.iter().map(Segment::turning).sum();
    let end = segments[count - 1].end();
    let mut jacobian = [vec![0.0; 2 * count], vec![0.0; 2 * count], vec![0.0; 2 * count]];
    for (i, s) in segments.iter().enumerate() {
        let j = s.position_jacobian(s.length);
        let lever = end - s.end();
        let swing = Vec2::new(-lever.y, lever.x);
        let mut add = |column: usize, moved: Vec2, turned: f64, play: f64| {
            let moved = moved + swing * turned;
            for (row, value) in [moved.x / length, moved.y / length, turned].into_iter().enumerate() {
                jacobian[row][column] += value * play;
            }
        };
        let next = (i + 1) % count;
        add(2 * i, j.length + s.tangent_at(s.length), 0.5 * (s.kappa0 + s.kappa1), play[i].0);
        add(2 * i + 1, j.kappa0, 0.5 * s.length, play[i].1);
        add(2 * next + 1, j.kappa1, 0.5 * s.length, play[next].1);
    }
    let whole_turn = if turning < 0.0 { -TAU } else { TAU };
    ([end.x / length, end.y / length, turning - whole_turn], jacobian)
}

/// The smallest change that makes up for what is missing, to first order.
fn least_change(jacobian: &[Vec<f64>; 3], missing: [f64; 3]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let m: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| dot(&jacobian[i], &jacobian[j])));
    let cofactor = |r: usize, c: usize| {
        let (r1, r2, c1, c2) = ((r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3);
        m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
    };
    let det: f64 = (0..3).map(|c| m[0][c] * cofactor(0, c)).sum();
    // The matrix is symmetric, so that its cofactors need not be transposed.
    let weights: [f64; 3] = std::array::from_fn(|i| (0..3).map(|j| cofactor(i, j) * missing[j]).sum::<f64>() / det);
    (0..jacobian[0].len()).map(|i| (0..3).map(|r| jacobian[r][i] * weights[r]).sum()).collect()
}
