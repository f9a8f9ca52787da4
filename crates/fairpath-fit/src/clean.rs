//! From a stroke as the device gave it to a polyline in pixels: finite, without repeated points, near the origin, and never
//! denser than the fit can use.

use crate::polyline::Polyline;
use crate::result::FitError;
use fairpath_curve::{Point, Vec2};

/// Points nearer than this to the one before are repetitions, px.
const REPEATED: f64 = 1e-3;

/// Points denser than this are averaged, px: half of the smallest distance of samples, so nothing is lost to the fit.
const DENSEST: f64 = 1.0;

/// A stroke in pixels about a local origin.
#[derive(Clone, Debug)]
pub(crate) struct Cleaned {
    pub(crate) points: Vec<Vec2>,
    /// Where the local origin is in the stroke's frame.
    pub(crate) origin: Point,
    /// Pixels are multiplied by this to give the stroke's unit.
    pub(crate) scale: f64,
    /// Size of the steps if the points lie on a lattice, as a coarse mouse or canvas gives them, px; else zero.
    pub(crate) grain: f64,
}

impl Cleaned {
    /// A position in pixels in the stroke's frame.
    pub(crate) fn restore(&self, p: Vec2) -> Point {
        self.origin + p * self.scale
    }
}

/// The stroke's points in pixels.
///
/// # Errors
/// When a coordinate is not finite, or all points are equal.
pub(crate) fn clean(points: &[Point], pixel_size: f64) -> Result<Cleaned, FitError> {
    if let Some(index) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(FitError::NotFinite { index });
    }
    let (mut low, mut high) =
        (Point::new(f64::INFINITY, f64::INFINITY), Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    for p in points {
        low = Point::new(low.x.min(p.x), low.y.min(p.y));
        high = Point::new(high.x.max(p.x), high.y.max(p.y));
    }
    let size = high - low;
    let extent = size.x.max(size.y);
    // Written so that an overflow of the size to infinity fails too.
    if points.is_empty() || !(extent > REPEATED * pixel_size && extent / pixel_size < LARGEST) {
        return Err(if extent / pixel_size >= LARGEST {
            FitError::TooLarge { extent, largest: LARGEST * pixel_size }
        } else {
            FitError::TooShort { points: points.len(), extent: extent.max(0.0) }
        });
    }
    let origin = low + size * 0.5;
    let local = points.iter().map(|p| (*p - origin) / pixel_size);
    let mut distinct: Vec<Vec2> = Vec::with_capacity(points.len());
    for p in local {
        if distinct.last().is_none_or(|last| (p - *last).hypot2() > REPEATED * REPEATED) {
            distinct.push(p);
        }
    }
    let grain = grain(&distinct);
    let points = thin(&smoothed(distinct, AVERAGED * grain));
    Ok(Cleaned { points, origin, scale: pixel_size, grain })
}

/// Drawings larger than this cannot be resolved in double precision at a thousandth of a pixel, px.
const LARGEST: f64 = 1e9;

/// The step of the lattice on which the points lie, px; zero if they do not lie on one. On a lattice nearly all edges are small whole
/// multiples of the shortest along it and across it, however the drawing has been rotated since.
fn grain(points: &[Vec2]) -> f64 {
    let edges: Vec<Vec2> = points.windows(2).map(|p| p[1] - p[0]).collect();
    if edges.len() < FEWEST_EDGES {
        return 0.0;
    }
    let mut by_length = edges.clone();
    let low = by_length.len() / 10;
    let short = *by_length.select_nth_unstable_by(low, |a, b| a.hypot2().total_cmp(&b.hypot2())).1;
    let fits = |step: &Vec2| {
        let whole = |v: f64| {
            let v = v / step.hypot2();
            (v - (v + 0.5).floor()).abs() < OFF_LATTICE && v.abs() < FURTHEST
        };
        let on = edges.iter().filter(|e| whole(e.dot(*step)) && whole(e.cross(*step))).count();
        on as f64 >= LATTICE_SHARE * edges.len() as f64
    };
    // The shortest edge may be a diagonal of the lattice.
    let diagonal = Vec2::new(0.5 * (short.x + short.y), 0.5 * (short.y - short.x));
    let Some(step) = [short, diagonal].into_iter().find(fits) else { return 0.0 };
    // A polygon turns so too, and only so at its corners; a step of a staircase turns back at once.
    let turned: Vec<(usize, f64)> = edges
        .windows(2)
        .enumerate()
        .filter_map(|(i, e)| {
            let (along, across) = (e[0].dot(e[1]), e[0].cross(e[1]));
            (across.abs() > 0.1 * along.abs()).then(|| (i, across.signum()))
        })
        .collect();
    let steps = turned.windows(2).filter(|t| t[1].0 - t[0].0 <= LONGEST_STEP && t[0].1 != t[1].1).count();
    if edges.len() > LONG_SIDE * turned.len() && (steps as f64) < STEP_SHARE * turned.len() as f64 {
        return 0.0;
    }
    step.hypot2().sqrt()
}

/// Length on each side over which a staircase is averaged, in its steps.
const AVERAGED: f64 = 1.0;

/// The polyline averaged over the length `reach` on each side of every vertex, less near the ends, which stay.
fn smoothed(points: Vec<Vec2>, reach: f64) -> Vec<Vec2> {
    if reach == 0.0 {
        return points;
    }
    let line = Polyline::new(points);
    let n = line.points.len();
    // Integral of position from the start to each vertex.
    let mut sums = vec![Vec2::ZERO; n];
    for i in 1..n {
        sums[i] = sums[i - 1] + (line.points[i] + line.points[i - 1]) * (0.5 * (line.s[i] - line.s[i - 1]));
    }
    let integral = |s: f64| {
        let edge = line.s.partition_point(|&v| v <= s).clamp(1, n - 1) - 1;
        let end = line.at(s, &mut edge.clone());
        sums[edge] + (line.points[edge] + end) * (0.5 * (s - line.s[edge]))
    };
    let length = line.length();
    (0..n)
        .map(|i| {
            let s = line.s[i];
            let half = reach.min(s).min(length - s);
            if half > 0.0 { (integral(s + half) - integral(s - half)) / (2.0 * half) } else { line.points[i] }
        })
        .collect()
}

/// Fewer edges than this tell nothing of a lattice.
const FEWEST_EDGES: usize = 6;
/// Most edges between the two turns of a step, and the least share of turns that begin one: every second does where steps are apart.
const LONGEST_STEP: usize = 2;
const STEP_SHARE: f64 = 0.3;
/// Edges that a side of a polygon has at least, on average; what turns more often may be a small drawing on a coarse lattice.
const LONG_SIDE: usize = 8;
/// Least share of edges on a lattice, how far from it they may end, and the longest, in its steps.
const LATTICE_SHARE: f64 = 0.9;
const OFF_LATTICE: f64 = 0.1;
const FURTHEST: f64 = 4.5;

/// Averages neighbours where the points lie denser than [`DENSEST`]; the ends stay.
fn thin(points: &[Vec2]) -> Vec<Vec2> {
    let n = points.len();
    let length: f64 = points.windows(2).map(|p| distance(p[0], p[1])).sum();
    // A drawing of a few pixels keeps its shape.
    let densest = DENSEST.min(length / 16.0);
    let spacing = length / (n.max(2) - 1) as f64;
    if n < 8 || spacing >= densest {
        return points.to_vec();
    }
    let mut out = vec![points[0]];
    let (mut sum, mut count, mut length) = (Vec2::ZERO, 0.0, 0.0);
    for pair in points.windows(2).take(n - 2) {
        sum += pair[1];
        count += 1.0;
        length += distance(pair[0], pair[1]);
        if length >= densest {
            out.push(sum / count);
            (sum, count, length) = (Vec2::ZERO, 0.0, 0.0);
        }
    }
    out.push(points[n - 1]);
    out
}

#[inline]
pub(crate) fn distance(a: Vec2, b: Vec2) -> f64 {
    (b - a).hypot2().sqrt()
}
