//! Least-squares fit of a line, an arc or a clothoid to a run of points, by Gauss–Newton on the true distances.

use crate::linear::{cholesky, solve};
use crate::walk::{Datum, Foot, Primitive, Walker};
use fairpath_curve::{Vec2, trig};

/// Normal equations of the distances of a run of points to a primitive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Normal {
    /// `Jᵀ W J`, lower triangle, by start offset, heading, curvature, sharpness.
    pub(crate) hessian: [[f64; 4]; 4],
    /// `Jᵀ W d`.
    pub(crate) gradient: [f64; 4],
    /// `Σ w d²`.
    pub(crate) energy: f64,
    /// `Σ w`.
    pub(crate) weight: f64,
    /// `max |d|` (equation 2).
    pub(crate) max: f64,
}

impl Normal {
    pub(crate) const ZERO: Self =
        Self { hessian: [[0.0; 4]; 4], gradient: [0.0; 4], energy: 0.0, weight: 0.0, max: 0.0 };

    /// Adds a point with signed distance `d`, weight `w` and derivatives `row` by the first so many parameters.
    #[inline]
    pub(crate) fn add<const N: usize>(&mut self, row: &[f64; N], d: f64, w: f64) {
        for i in 0..N {
            let v = w * row[i];
            for j in 0..=i {
                self.hessian[i][j] += v * row[j];
            }
            self.gradient[i] += v * d;
        }
        self.energy += w * d * d;
        self.weight += w;
        self.max = self.max.max(d.abs());
    }

    /// The Gauss–Newton step of the first `n` parameters (2 line, 3 arc, 4 clothoid), the others held; nothing if the points
    /// do not determine it.
    pub(crate) fn step(&self, n: usize) -> Option<[f64; 4]> {
        // With the number of unknowns known, the compiler unrolls the loops.
        match n {
            2 => self.step_of::<2>(),
            3 => self.step_of::<3>(),
            _ => self.step_of::<4>(),
        }
    }

    fn step_of<const N: usize>(&self) -> Option<[f64; 4]> {
        let mut l: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| self.hessian[i][j]));
        if !cholesky(&mut l, N, 1e-12) {
            return None;
        }
        let mut b: [f64; N] = std::array::from_fn(|i| self.gradient[i]);
        solve(&l, N, &mut b);
        let step = std::array::from_fn(|i| if i < N { b[i] } else { 0.0 });
        step.iter().all(|v| v.is_finite()).then_some(step)
    }
}

impl Primitive {
    /// Applies a step of [`Normal::step`].
    #[inline]
    pub(crate) fn moved(&self, step: &[f64; 4]) -> Self {
        let t = trig::unit(self.heading);
        Self {
            start: self.start + Vec2::new(-t.y, t.x) * step[0],
            heading: self.heading + step[1],
            kappa: self.kappa + step[2],
            sharpness: self.sharpness + step[3],
        }
    }
}

/// The result of walking a primitive along its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walked {
    pub(crate) primitive: Primitive,
    /// Arc length at the foot of the last point.
    pub(crate) length: f64,
    pub(crate) normal: Normal,
}

/// As [`walk`], of a line.
pub(crate) fn walk_line(primitive: &Primitive, data: &[Datum], end_factor: f64) -> Walked {
    let tangent = trig::unit(primitive.heading);
    let first = tangent.dot(data[0].point - primitive.start);
    let start = primitive.start + tangent * first;
    let last = data.len() - 1;
    let (mut w0, mut w1, mut w2, mut d0, mut d1, mut energy, mut max) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0_f64);
    let mut s = 0.0;
    for (i, datum) in data.iter().enumerate() {
        let v = datum.point - start;
        s = tangent.dot(v);
        let d = tangent.cross(v);
        let w = if i == 0 || i == last { end_factor * datum.weight } else { datum.weight };
        w0 += w;
        w1 += w * s;
        w2 += w * s * s;
        d0 += w * d;
        d1 += w * d * s;
        energy += w * d * d;
        max = max.max(d.abs());
    }
    let mut normal = Normal { energy, weight: w0, max, ..Normal::ZERO };
    (normal.hessian[0][0], normal.hessian[1][0], normal.hessian[1][1]) = (w0, w1, w2);
    (normal.gradient[0], normal.gradient[1]) = (d0, d1);
    Walked { primitive: Primitive { start, ..*primitive }, length: s, normal }
}

/// As [`walk`], of an arc: on a circle foot and distance are known without stepping.
pub(crate) fn walk_arc(primitive: &Primitive, data: &[Datum], end_factor: f64) -> Walked {
    let last = data.len() - 1;
    let extent = data[last].s - data[0].s;
    let kappa = primitive.kappa;
    if !(kappa.abs() * extent > NEARLY_STRAIGHT) {
        return walk(primitive, data, end_factor);
    }
    let (sign, radius) = (kappa.signum(), 1.0 / kappa);
    let tangent = trig::unit(primitive.heading);
    let centre = primitive.start + Vec2::new(-tangent.y, tangent.x) * radius;
    // The start moves to the foot of the first point.
    let spoke = |p: Vec2| {
        let v = p - centre;
        let r = v.hypot2().sqrt();
        (v * (1.0 / r), r)
    };
    let along = |e: Vec2| Vec2::new(-e.y, e.x) * sign;
    let (e0, _) = spoke(data[0].point);
    let start = centre + e0 * radius.abs();
    let t0 = along(e0);
    let heading = primitive.heading + angle_between(tangent, t0);
    let mut normal = Normal::ZERO;
    let mut e = e0;
    for (i, datum) in data.iter().enumerate() {
        let r;
        (e, r) = spoke(datum.point);
        let d = radius - sign * r;
        let w = if i == 0 || i == last { end_factor * datum.weight } else { datum.weight };
        let chord = centre + e * radius.abs() - start;
        let t = along(e);
        // Half the square of the chord is R² (1 − cos φ), by which the curve moves across itself where curvature changes.
        normal.add(&[t.dot(t0), t.dot(chord), 0.5 * chord.hypot2()], d, w);
    }
    let turned = angle_between(e0, e);
    // Whole turns are told by the length of the stroke.
    let turns = ((extent * kappa - turned) / std::f64::consts::TAU + 0.5).floor();
    let length = (turned + turns * std::f64::consts::TAU) * radius;
    Walked { primitive: Primitive { start, heading, kappa, sharpness: 0.0 }, length, normal }
}

/// The angle from one unit vector to another in radians, a small one by the series of the arc tangent: error below 1e-16.
#[inline]
fn angle_between(a: Vec2, b: Vec2) -> f64 {
    let (along, across) = (a.dot(b), a.cross(b));
    let t = across / along;
    if !(along > 0.0 && t.abs() < 0.05) {
        return trig::angle_of(Vec2::new(along, across));
    }
    let x = t * t;
    t - t * x * (1.0 / 3.0 - x * (1.0 / 5.0 - x * (1.0 / 7.0 - x * (1.0 / 9.0 - x * (1.0 / 11.0)))))
}

/// An arc that turns less than this is walked along: its centre is too far away.
pub(crate) const NEARLY_STRAIGHT: f64 = 1e-2;

/// Walks along `data`, the ends counting `end_factor` times their weight (equation 1), after moving the primitive's start to the
/// foot of the first point.
pub(crate) fn walk(primitive: &Primitive, data: &[Datum], end_factor: f64) -> Walked {
    walk_near(primitive, data, end_factor, &mut Vec::with_capacity(data.len()))
}

/// As [`walk`], given about where the `feet` of the first so many data are, by arc length; gives those of all.
pub(crate) fn walk_near(primitive: &Primitive, data: &[Datum], end_factor: f64, feet: &mut Vec<f64>) -> Walked {
    let mut start = Walker::new(primitive);
    let foot = start.foot(data[0].point).unwrap_or_else(|| start.project(data[0].point)).s;
    start.go_to(foot);
    let (primitive, mut walker) = start.begun_here();
    let tangent = walker.tangent;
    let mut normal = Normal::ZERO;
    let last = data.len() - 1;
    let moved = foot;
    let known = feet.len();
    feet.resize(data.len(), 0.0);
    for (i, (datum, near)) in data.iter().zip(feet.iter_mut()).enumerate() {
        let foot = if i == 0 {
            Foot { s: 0.0, distance: walker.offset(datum.point) }
        } else if i < known {
            walker.project_from(*near - moved, datum.point)
        } else {
            walker.project(datum.point)
        };
        *near = foot.s;
        let w = if i == 0 || i == last { end_factor * datum.weight } else { datum.weight };
        normal.add(&walker.row(tangent), foot.distance, w);
    }
    let length = feet[last];
    if feet.iter().any(|s| !(-ASIDE..=length + ASIDE).contains(s)) {
        // The curve turns back: it does not follow the points from the first to the last.
        normal.max = f64::INFINITY;
    }
    Walked { primitive, length, normal }
}

/// How far before the first and beyond the last foot another may be, px.
const ASIDE: f64 = 6.0;

/// The chord of a run of points, as a primitive.
pub(crate) fn chord(data: &[Datum]) -> Primitive {
    let v = data[data.len() - 1].point - data[0].point;
    Primitive { start: data[0].point, heading: trig::angle_of(v), kappa: 0.0, sharpness: 0.0 }
}

/// The circle through the first, the middle and the last point, as a primitive from the first.
pub(crate) fn circle_through(data: &[Datum]) -> Primitive {
    circle_by(data[0].point, data[data.len() / 2].point, data[data.len() - 1].point)
}

/// The circle through three points, as a primitive from the first.
pub(crate) fn circle_by(a: Vec2, m: Vec2, b: Vec2) -> Primitive {
    let (u, v) = (m - a, b - a);
    let doubled_area = u.cross(v);
    let product = (u.hypot2() * v.hypot2() * (b - m).hypot2()).sqrt();
    // Seen from the middle point the stroke turns left where the end lies left of the first chord.
    let kappa = if product > 0.0 { 2.0 * doubled_area / product } else { 0.0 };
    // The angle between the tangent at the first point and the first chord is the inscribed angle over that chord.
    let inscribed = trig::angle_of(Vec2::new((v - u).dot(v), doubled_area));
    Primitive { start: a, heading: trig::angle_of(u) - inscribed, kappa, sharpness: 0.0 }
}

/// Fits the first `n` parameters from an initial guess by a fixed number of Gauss–Newton rounds.
pub(crate) fn refine(initial: &Primitive, data: &[Datum], n: usize, rounds: usize, end_factor: f64) -> Walked {
    let walk = if n == 3 && initial.sharpness == 0.0 { walk_arc } else { walk };
    let mut best = walk(initial, data, end_factor);
    for _ in 0..rounds {
        let Some(step) = best.normal.step(n) else { break };
        // The step's own forecast of what it gains.
        let gain: f64 = (0..n).map(|i| step[i] * best.normal.gradient[i]).sum();
        if gain < 1e-3 * best.normal.energy {
            break;
        }
        let next = walk(&best.primitive.moved(&step), data, end_factor);
        // A NaN is not an improvement either.
        if !(next.normal.energy <= best.normal.energy) {
            break;
        }
        let gain = best.normal.energy - next.normal.energy;
        best = next;
        if gain < 1e-3 * best.normal.energy {
            break;
        }
    }
    best
}
