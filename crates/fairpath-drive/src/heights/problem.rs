//! What is asked and what comes of it: the sum that the heights shall make small, and its minimum.

use super::order::{levels, places};
use crate::sparse::{Factor, Pattern};
use thiserror::Error;

/// The points of one path at which its height is wanted: its crossings.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPoints {
    /// Arc lengths from the path's start, each further than the one before, m.
    pub stations_m: Vec<f64>,
}

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HeightPoint {
    /// Which path.
    pub path: usize,
    /// Which of its points.
    pub point: usize,
}

/// One point passes over another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Over {
    /// The upper one.
    pub upper: HeightPoint,
    /// The lower one.
    pub lower: HeightPoint,
}

/// Paths with their crossings: what the heights are to be found of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CrossingHeights {
    /// The paths.
    pub paths: Vec<PathPoints>,
    /// Which points pass over which.
    pub over: Vec<Over>,
    /// Which points are one place at one height: where paths meet.
    pub level: Vec<[HeightPoint; 2]>,
    /// The length by which stations are divided before grades are taken, m. The thesis leaves the unit of arc length open; heights are in units of a
    /// clearance, so that a grade is a clearance per this length.
    pub length_scale_m: f64,
}

/// Heights at the points.
#[derive(Clone, Debug, PartialEq)]
pub struct Heights {
    /// For each path the heights of its points over the terrain, in the order of its stations, without a unit until they are scaled.
    pub paths: Vec<Vec<f64>>,
    /// What they cost: the sum of equations 3.1, 3.2 and 3.3.
    pub cost: f64,
    /// Steps that it took.
    pub steps: usize,
}

/// Why there are no heights.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum HeightError {
    /// A station is not finite or not further than the one before.
    #[error(
        "path {path}: point {point} lies no further along it than the one before; sort the crossings and merge equal ones"
    )]
    Stations {
        /// The path.
        path: usize,
        /// The point.
        point: usize,
    },
    /// There is no such point.
    #[error("crossing {pair}: path {path} has no point {point}")]
    NoPoint {
        /// Which of the pairs, those that are level after those over each other.
        pair: usize,
        /// The path that it names.
        path: usize,
        /// The point that it names.
        point: usize,
    },
    /// Points pass over each other in a ring: at one place, since another crossing of the same roads is another point.
    #[error("path {path}, point {point} would have to pass over itself: undo one of the crossings {overs:?}")]
    Ring {
        /// The path of one point of the ring.
        path: usize,
        /// That point.
        point: usize,
        /// The pairs that make the ring.
        overs: Vec<usize>,
    },
    /// The length scale is not positive.
    #[error("the length scale must be positive and finite")]
    Scale,
}

/// Newton steps after which the method would be at fault.
const MOST_STEPS: usize = 200;

/// The decrement of Newton's method, squared, from which on the cost no longer tells whether a step gains, as a share of the cost: rounding hides it. Whole steps
/// are taken then, each of which squares the error, while the decrement falls.
const NEAR: f64 = 1e-10;

/// A step must gain at least this share of what its slope promises (Armijo's rule).
const GAIN: f64 = 1e-4;

impl CrossingHeights {
    /// The heights that cost least, by Newton's method with a line search: the only minimum, to rounding.
    ///
    /// # Errors
    /// When stations do not ascend, a pair names a point that does not exist, or points pass over each other in a ring.
    pub fn solve(&self) -> Result<Heights, HeightError> {
        let sum = Sum::of(self)?;
        let mut y = sum.start(self)?;
        let mut factor = Factor::new(&sum.pattern);
        let mut cost = sum.cost(&y);
        let (mut gradient, mut hessian) = (vec![0.0; y.len()], vec![0.0; sum.pattern.entries()]);
        let mut steps = 0;
        let mut last = f64::INFINITY;
        while steps < MOST_STEPS {
            sum.derivatives(&y, &mut gradient, &mut hessian);
            factor.decompose(&sum.pattern, &hessian);
            let step: Vec<f64> = factor.solve(&gradient).into_iter().map(|x| -x).collect();
            let slope: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
            if !(slope < 0.0 && -slope < last) {
                break;
            }
            let next = if -slope < NEAR * (1.0 + cost) {
                last = -slope;
                Some(moved(&sum, &y, &step, 1.0))
            } else {
                line_search(&sum, &y, &step, cost, slope)
            };
            let Some((next, next_cost)) = next.filter(|(_, cost)| cost.is_finite()) else { break };
            (y, cost) = (next, next_cost);
            steps += 1;
        }
        Ok(self.heights(&sum.spread(&y), cost, steps))
    }

    /// Heights of all points, path by path.
    pub(super) fn heights(&self, y: &[f64], cost: f64, steps: usize) -> Heights {
        let mut rest = y.iter().copied();
        let paths = self.paths.iter().map(|path| rest.by_ref().take(path.stations_m.len()).collect()).collect();
        Heights { paths, cost, steps }
    }
}

impl Heights {
    /// The heights times the factor that makes the least separation of the pairs the clearance, m; unchanged where there is no pair. Then every crossing has
    /// its clearance, and most have more.
    #[must_use]
    pub fn scaled_to_clearance(&self, over: &[Over], clearance_m: f64) -> Self {
        let at = |point: HeightPoint| self.paths[point.path][point.point];
        let least = over.iter().map(|pair| at(pair.upper) - at(pair.lower)).fold(f64::INFINITY, f64::min);
        let factor = if least.is_finite() { clearance_m / least } else { 1.0 };
        let paths = self.paths.iter().map(|path| path.iter().map(|y| y * factor).collect()).collect();
        Self { paths, ..*self }
    }
}

/// Goes along a step until it gains; nothing if rounding leaves no gain.
fn line_search(sum: &Sum, y: &[f64], step: &[f64], cost: f64, slope: f64) -> Option<(Vec<f64>, f64)> {
    let mut t = 1.0;
    for _ in 0..60 {
        let next = moved(sum, y, step, t);
        if next.1 <= cost + GAIN * t * slope && next.1 < cost {
            return Some(next);
        }
        t *= 0.5;
    }
    None
}

/// Heights after a part of a step, and their cost.
fn moved(sum: &Sum, y: &[f64], step: &[f64], t: f64) -> (Vec<f64>, f64) {
    let next: Vec<f64> = y.iter().zip(step).map(|(y, s)| y + t * s).collect();
    let cost = sum.cost(&next);
    (next, cost)
}

/// The sum over all points in one list. What is unknown is a height for each place: points that are level share one.
pub(super) struct Sum {
    /// The place of each point.
    places: Vec<usize>,
    /// How many points a place has.
    weights: Vec<f64>,
    /// Neighbours along a path, with the square of one over their distance.
    grades: Vec<(usize, usize, f64)>,
    /// Upper and lower points.
    over: Vec<(usize, usize)>,
    count: usize,
    /// Which second derivatives are not zero.
    pattern: Pattern,
    /// Where in the pattern the mixed derivative of each neighbour and each pair stands.
    grade_entries: Vec<usize>,
    over_entries: Vec<usize>,
}

impl Sum {
    pub(super) fn of(problem: &CrossingHeights) -> Result<Self, HeightError> {
        if !(problem.length_scale_m > 0.0 && problem.length_scale_m.is_finite()) {
            return Err(HeightError::Scale);
        }
        let mut firsts = Vec::with_capacity(problem.paths.len());
        let mut points = 0;
        for path in &problem.paths {
            firsts.push(points);
            points += path.stations_m.len();
        }
        let index = |pair: usize, HeightPoint { path, point }: HeightPoint| {
            let there = problem.paths.get(path).is_some_and(|points| point < points.stations_m.len());
            if there { Ok(firsts[path] + point) } else { Err(HeightError::NoPoint { pair, path, point }) }
        };
        let mut level = Vec::with_capacity(problem.level.len());
        for (i, &[a, b]) in problem.level.iter().enumerate() {
            let pair = problem.over.len() + i;
            level.push((index(pair, a)?, index(pair, b)?));
        }
        let (places, count) = places(points, &level);
        let mut weights = vec![0.0; count];
        for &place in &places {
            weights[place] += 1.0;
        }
        let mut grades = Vec::new();
        for (path, points) in problem.paths.iter().enumerate() {
            for (i, &station) in points.stations_m.iter().enumerate() {
                if !station.is_finite() || (i > 0 && !(station > points.stations_m[i - 1])) {
                    return Err(HeightError::Stations { path, point: i });
                }
                if i > 0 {
                    let length = (station - points.stations_m[i - 1]) / problem.length_scale_m;
                    let (a, b) = (places[firsts[path] + i - 1], places[firsts[path] + i]);
                    // A loop from a place to itself is level in the mean.
                    if a != b {
                        grades.push((a, b, 1.0 / (length * length)));
                    }
                }
            }
        }
        let mut over = Vec::with_capacity(problem.over.len());
        for (i, pair) in problem.over.iter().enumerate() {
            over.push((places[index(i, pair.upper)?], places[index(i, pair.lower)?]));
        }
        let pairs = grades.iter().map(|&(i, j, _)| (i, j)).chain(over.iter().copied());
        let pattern = Pattern::new(count, pairs);
        let entry = |i: usize, j: usize| if i == j { i } else { pattern.entry(i, j) };
        let grade_entries = grades.iter().map(|&(i, j, _)| entry(i, j)).collect();
        let over_entries = over.iter().map(|&(i, j)| entry(i, j)).collect();
        Ok(Self { places, weights, grades, over, count, pattern, grade_entries, over_entries })
    }

    /// The heights of all points from those of the places.
    pub(super) fn spread(&self, y: &[f64]) -> Vec<f64> {
        self.places.iter().map(|&place| y[place]).collect()
    }

    /// Heights in the right order: each point one higher than the highest that it passes over.
    pub(super) fn start(&self, problem: &CrossingHeights) -> Result<Vec<f64>, HeightError> {
        levels(self.count, &self.over).map_err(|ring| {
            let upper = problem.over[ring[0]].upper;
            HeightError::Ring { path: upper.path, point: upper.point, overs: ring }
        })
    }

    /// The sum of equations 3.1, 3.2 and 3.3; infinite where a point is not above the one that it passes over.
    pub(super) fn cost(&self, y: &[f64]) -> f64 {
        let height: f64 = y.iter().zip(&self.weights).map(|(y, w)| w * y * y).sum();
        let grade: f64 = self.grades.iter().map(|&(i, j, w)| w * (y[j] - y[i]) * (y[j] - y[i])).sum();
        let mut relation = 0.0;
        for &(a, b) in &self.over {
            let d = y[a] - y[b];
            if !(d > 0.0) {
                return f64::INFINITY;
            }
            relation += 1.0 / (d * d);
        }
        height + grade + relation
    }

    /// First derivatives.
    pub(super) fn gradient(&self, y: &[f64], gradient: &mut [f64]) {
        for (i, g) in gradient.iter_mut().enumerate() {
            *g = 2.0 * self.weights[i] * y[i];
        }
        for &(i, j, w) in &self.grades {
            let slope = 2.0 * w * (y[j] - y[i]);
            gradient[i] -= slope;
            gradient[j] += slope;
        }
        for &(a, b) in &self.over {
            let d = y[a] - y[b];
            let slope = -2.0 / (d * d * d);
            gradient[a] += slope;
            gradient[b] -= slope;
        }
    }

    /// First and second derivatives, these by the pattern: the diagonal first.
    fn derivatives(&self, y: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(y, gradient);
        hessian.fill(0.0);
        for (entry, weight) in hessian.iter_mut().zip(&self.weights) {
            *entry = 2.0 * weight;
        }
        for (&(i, j, w), &entry) in self.grades.iter().zip(&self.grade_entries) {
            hessian[i] += 2.0 * w;
            hessian[j] += 2.0 * w;
            hessian[entry] -= 2.0 * w;
        }
        for (&(a, b), &entry) in self.over.iter().zip(&self.over_entries) {
            let d = y[a] - y[b];
            let bend = 6.0 / (d * d * d * d);
            hessian[a] += bend;
            hessian[b] += bend;
            hessian[entry] -= bend;
        }
    }
}
