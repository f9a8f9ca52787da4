//! Resampling by curvature (section 3.2 of Baran et al. 2010).

use crate::options::{FitOptions, Resampling};
use crate::polyline::Polyline;
use crate::primitive_fit::{NEARLY_STRAIGHT, Normal, circle_through, walk_arc};
use crate::walk::Datum;
use fairpath_curve::Vec2;

/// The desired distance of samples along a polyline: at each vertex, and in between the lower of the cones of both neighbours.
pub(crate) struct Rate {
    at_vertex: Vec<f64>,
    falloff: f64,
    low: f64,
}

/// Neighbourhood on each side for curvature, in steps of a staircase.
const GRAIN_WINDOW: f64 = 6.0;

/// Points on a lattice lie exactly on the border of a window: rounding may not decide on which side, px.
const HAIR: f64 = 1e-6;

/// Curvature of a run of points, one that is below `least` as something below: one Gauss–Newton step from a circle through three of
/// them is near enough to place samples.
fn bend(run: &[Datum], least: f64) -> f64 {
    if let Some(bend) = bend_of_circle(run, least) {
        return bend;
    }
    let fit = walk_arc(&circle_through(run), run, 1.0);
    least_bend(fit.primitive.kappa, &fit.normal)
}

/// The lesser of the curvatures before and after the step.
fn least_bend(kappa: f64, normal: &Normal) -> f64 {
    kappa.abs().min((kappa + normal.step(3).map_or(0.0, |s| s[2])).abs())
}

/// As [`bend`], by the circle's radii alone; nothing where it is nearly a line.
fn bend_of_circle(run: &[Datum], least: f64) -> Option<f64> {
    let last = run.len() - 1;
    let (a, m, b) = (run[0].point, run[run.len() / 2].point, run[last].point);
    let (u, v) = (m - a, b - a);
    let doubled_area = u.cross(v);
    let norm = (v.hypot2() * (b - m).hypot2()).sqrt();
    let kappa = 2.0 * doubled_area / (norm * u.hypot2().sqrt());
    if kappa.abs() < least {
        return Some(kappa.abs());
    }
    if !(kappa.abs() * (run[last].s - run[0].s) > NEARLY_STRAIGHT && kappa.is_finite()) {
        return None;
    }
    let (sign, radius) = (kappa.signum(), 1.0 / kappa.abs());
    // The tangent at the first point is the first chord turned back by the inscribed angle over it; the spoke is across.
    let (cos, sin) = ((v - u).dot(v) / norm, doubled_area / norm);
    let chord = u * (1.0 / u.hypot2().sqrt());
    let tangent = Vec2::new(chord.x * cos + chord.y * sin, chord.y * cos - chord.x * sin);
    let first = Vec2::new(tangent.y, -tangent.x) * sign;
    let centre = a - first * radius;
    let mut normal = Normal::ZERO;
    for datum in run {
        let arm = datum.point - centre;
        let distance = arm.hypot2().sqrt();
        let spoke = arm * (1.0 / distance);
        let cos = spoke.dot(first);
        let row = [cos, radius * sign * first.cross(spoke), radius * radius * (1.0 - cos)];
        normal.add(&row, sign * (radius - distance), 1.0);
    }
    Some(least_bend(kappa, &normal))
}

/// Estimates the rate from the curvature at the vertices.
pub(crate) fn rate(line: &Polyline, grain: f64, options: &FitOptions) -> Rate {
    let window = options.curvature_window.max(GRAIN_WINDOW * grain);
    let n = line.points.len();
    let data: Vec<Datum> =
        line.points.iter().zip(&line.s).map(|(&point, &s)| Datum { point, s, weight: 1.0 }).collect();
    // What bends less has the largest sampling distance anyway.
    let least = std::f64::consts::TAU / (options.points_per_circle * options.max_sampling);
    let (mut first, mut last) = (0, 0);
    let mut reversed = Vec::new();
    let mut at_vertex: Vec<f64> = Vec::with_capacity(n);
    for i in 0..n {
        while line.s[i] - line.s[first] > window + HAIR {
            first += 1;
        }
        while last + 1 < n && line.s[last + 1] - line.s[i] <= window + HAIR {
            last += 1;
        }
        // Where the points are sparse the window takes in one neighbour on each side all the same.
        let (a, b) = (first.min(i.saturating_sub(1)), last.max((i + 1).min(n - 1)));
        let curvature = if b - a < 2 {
            0.0
        } else {
            // Seen from both ends, so that it does not matter which way the stroke was drawn.
            let run = &data[a..=b];
            reversed.clear();
            reversed.extend(run.iter().rev());
            0.5 * (bend(run, least) + bend(&reversed, least))
        };
        let wanted = std::f64::consts::TAU / (options.points_per_circle * curvature.max(1e-9));
        at_vertex.push(wanted.clamp(options.min_sampling, options.max_sampling));
    }
    let mut rate = Rate { at_vertex, falloff: options.sampling_falloff, low: options.min_sampling };
    rate.fall_off(line);
    rate
}

impl Rate {
    /// Makes the rate change along the line no faster than it may.
    fn fall_off(&mut self, line: &Polyline) {
        let (at, n) = (&mut self.at_vertex, line.s.len());
        for i in 1..n {
            at[i] = at[i].min(at[i - 1] + self.falloff * (line.s[i] - line.s[i - 1]));
        }
        for i in (1..n).rev() {
            at[i - 1] = at[i - 1].min(at[i] + self.falloff * (line.s[i] - line.s[i - 1]));
        }
    }

    /// Brings samples as near as `closest` to each other where `is_tight` says so of an arc length, px.
    pub(crate) fn tighten(&mut self, line: &Polyline, closest: f64, is_tight: &dyn Fn(f64) -> bool) {
        for (at, &s) in self.at_vertex.iter_mut().zip(&line.s) {
            if is_tight(s) {
                *at = at.min(closest.max(self.low));
            }
        }
        self.fall_off(line);
    }

    /// The rate at arc length `s` on the edge from vertex `edge`.
    fn at(&self, line: &Polyline, edge: usize, s: f64) -> f64 {
        let a = self.at_vertex[edge] + self.falloff * (s - line.s[edge]).abs();
        let b = self.at_vertex[edge + 1] + self.falloff * (line.s[edge + 1] - s).abs();
        a.min(b).max(self.low)
    }
}

/// Arc lengths of the samples between the arc lengths `from` and `to`, both included.
pub(crate) fn resample(line: &Polyline, rate: &Rate, from: f64, to: f64, options: &FitOptions) -> Vec<f64> {
    let mut s = match options.resampling {
        Resampling::Even => even(line, rate, from, to, options),
        Resampling::Greedy => greedy(line, rate, from, to),
    };
    s[0] = from;
    let last = s.len() - 1;
    s[last] = to;
    s
}

/// The stretches of `[from, to]` on which the rate is linear: start, length, rate at start and at end.
fn pieces(line: &Polyline, rate: &Rate, from: f64, to: f64) -> Vec<[f64; 4]> {
    let mut out = Vec::new();
    let mut edge = line.s.partition_point(|&s| s <= from).saturating_sub(1).min(line.s.len() - 2);
    while edge + 1 < line.s.len() && line.s[edge] < to {
        let (a, b) = (line.s[edge].max(from), line.s[edge + 1].min(to));
        // Where the cones of both vertices cut each other.
        let slope = (rate.at_vertex[edge + 1] - rate.at_vertex[edge]) / (2.0 * rate.falloff);
        let top = (0.5 * (line.s[edge] + line.s[edge + 1]) + if slope.is_finite() { slope } else { 0.0 }).clamp(a, b);
        for (p, q) in [(a, top), (top, b)] {
            if q > p {
                out.push([p, q - p, rate.at(line, edge, p), rate.at(line, edge, q)]);
            }
        }
        edge += 1;
    }
    out
}

/// `∫ ds / r` over a stretch on which `r` is linear.
fn steps(length: f64, r0: f64, r1: f64) -> f64 {
    // The logarithm through its series where the ends differ little.
    let x = (r1 - r0) / (r1 + r0);
    if x.abs() < 1e-3 {
        2.0 * length / (r0 + r1) * (1.0 + x * x / 3.0)
    } else {
        length / (r1 - r0) * libm::log(r1 / r0)
    }
}

/// Samples at equal steps of `∫ ds / r(s)`: the same set of places whichever way the stroke was drawn.
fn even(line: &Polyline, rate: &Rate, from: f64, to: f64, options: &FitOptions) -> Vec<f64> {
    let parts = pieces(line, rate, from, to);
    let mut before = Vec::with_capacity(parts.len() + 1);
    let mut total = 0.0;
    for &[_, length, r0, r1] in &parts {
        before.push(total);
        total += steps(length, r0, r1);
    }
    let fewest = if to - from >= 3.0 * options.min_sampling { 3.0 } else { 1.0 };
    // A hair is taken off so that rounding cannot decide between n and n + 1.
    let count = (total - 1e-6).ceil().max(fewest);
    let mut out = Vec::with_capacity(count as usize + 1);
    let mut i = 0;
    for k in 0..=count as usize {
        let target = total * k as f64 / count;
        while i + 1 < parts.len() && before[i + 1] < target {
            i += 1;
        }
        let Some(&[s, length, r0, r1]) = parts.get(i) else { break };
        let left = target - before[i];
        let grow = (r1 - r0) / length;
        // The inverse of the logarithm above.
        let x = grow * left;
        let ds = if x.abs() < 1e-6 { r0 * left * (1.0 + 0.5 * x) } else { r0 * libm::expm1(x) / grow };
        out.push(s + ds.clamp(0.0, length));
    }
    out
}

/// The paper's greedy steps from the start, the last four samples moved inward to meet the end.
fn greedy(line: &Polyline, rate: &Rate, from: f64, to: f64) -> Vec<f64> {
    let mut out = vec![from];
    let (mut last, mut lowest) = (from, f64::INFINITY);
    for [start, length, r0, r1] in pieces(line, rate, from, to) {
        let count = (4.0 * length / r0.min(r1)).ceil().max(1.0);
        for k in 0..count as usize {
            let (u, end) = ((k as f64 + 0.5) / count, start + length * (k + 1) as f64 / count);
            let r = r0 + (r1 - r0) * u;
            lowest = lowest.min(r);
            if end - last >= lowest {
                last += lowest.min(end - last);
                out.push(last);
                lowest = r;
            }
        }
    }
    if out.len() < 2 {
        out.push(to);
        return out;
    }
    let n = out.len();
    // The step beyond the end would have been one more `r`; the overshoot is taken from the last four steps.
    if to - last > 0.5 * (last - out[n - 2]) {
        out.push(to);
    } else {
        let shift = to - last;
        let moved = 4.min(n - 1);
        for (k, s) in out[n - moved..].iter_mut().enumerate() {
            *s += shift * (k + 1) as f64 / moved as f64;
        }
    }
    out
}
