//! Resampling by curvature (section 3.2 of Baran et al. 2010).

use crate::options::{FitOptions, Resampling};
use crate::polyline::Polyline;
use crate::primitive_fit::{circle_through, walk_arc};
use crate::walk::Datum;

/// The desired distance of samples along a polyline: at each vertex, and in between the lower of the cones of both neighbours.
pub(crate) struct Rate {
    at_vertex: Vec<f64>,
    falloff: f64,
    low: f64,
}

/// Neighbourhood on each side for curvature, in steps of a staircase.
const GRAIN_WINDOW: f64 = 5.0;

/// Estimates the rate from the curvature at the vertices.
pub(crate) fn rate(line: &Polyline, grain: f64, options: &FitOptions) -> Rate {
    let window = options.curvature_window.max(GRAIN_WINDOW * grain);
    let n = line.points.len();
    let data: Vec<Datum> =
        line.points.iter().zip(&line.s).map(|(&point, &s)| Datum { point, s, weight: 1.0 }).collect();
    let (mut first, mut last) = (0, 0);
    let mut at_vertex: Vec<f64> = Vec::with_capacity(n);
    for i in 0..n {
        while line.s[i] - line.s[first] > window {
            first += 1;
        }
        while last + 1 < n && line.s[last + 1] - line.s[i] <= window {
            last += 1;
        }
        // Where the points are sparse the window takes in one neighbour on each side all the same.
        let (a, b) = (first.min(i.saturating_sub(1)), last.max((i + 1).min(n - 1)));
        let curvature = if b - a < 2 {
            0.0
        } else {
            // One Gauss–Newton step from a circle through three of the points is near enough to place samples.
            let run = &data[a..=b];
            let fit = walk_arc(&circle_through(run), run, 1.0);
            fit.primitive.kappa.abs().min((fit.primitive.kappa + fit.normal.step(3).map_or(0.0, |s| s[2])).abs())
        };
        let wanted = std::f64::consts::TAU / (options.points_per_circle * curvature.max(1e-9));
        at_vertex.push(wanted.clamp(options.min_sampling, options.max_sampling));
    }
    for i in 1..n {
        at_vertex[i] = at_vertex[i].min(at_vertex[i - 1] + options.sampling_falloff * (line.s[i] - line.s[i - 1]));
    }
    for i in (1..n).rev() {
        at_vertex[i - 1] = at_vertex[i - 1].min(at_vertex[i] + options.sampling_falloff * (line.s[i] - line.s[i - 1]));
    }
    Rate { at_vertex, falloff: options.sampling_falloff, low: options.min_sampling }
}

impl Rate {
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

/// Visits `[from, to]` in pieces no longer than a fraction of the rate: `visit(start, length, rate)`.
fn pieces(line: &Polyline, rate: &Rate, from: f64, to: f64, mut visit: impl FnMut(f64, f64, f64)) {
    let mut edge = line.s.partition_point(|&s| s <= from).saturating_sub(1).min(line.s.len() - 2);
    let mut s = from;
    while s < to {
        while edge + 2 < line.s.len() && line.s[edge + 1] <= s {
            edge += 1;
        }
        let here = rate.at(line, edge, s);
        let end = if edge + 2 < line.s.len() { line.s[edge + 1].min(to) } else { to };
        let step = (0.25 * here).min(end - s);
        if step <= 0.0 {
            break;
        }
        visit(s, step, rate.at(line, edge, s + 0.5 * step));
        s += step;
    }
}

/// Samples at equal steps of `∫ ds / r(s)`: the same set of places whichever way the stroke was drawn.
fn even(line: &Polyline, rate: &Rate, from: f64, to: f64, options: &FitOptions) -> Vec<f64> {
    let mut density = vec![(from, 0.0)];
    let mut total = 0.0;
    pieces(line, rate, from, to, |s, step, r| {
        total += step / r;
        density.push((s + step, total));
    });
    let fewest = if to - from >= 3.0 * options.min_sampling { 3.0 } else { 1.0 };
    // A hair is taken off so that rounding cannot decide between n and n + 1.
    let count = (total - 1e-6).ceil().max(fewest);
    let mut out = Vec::with_capacity(count as usize + 1);
    let mut i = 0;
    for k in 0..=count as usize {
        let target = total * k as f64 / count;
        while i + 2 < density.len() && density[i + 1].1 < target {
            i += 1;
        }
        let ((s0, d0), (s1, d1)) = (density[i], density[(i + 1).min(density.len() - 1)]);
        let u = if d1 > d0 { ((target - d0) / (d1 - d0)).clamp(0.0, 1.0) } else { 0.0 };
        out.push(s0 + (s1 - s0) * u);
    }
    out
}

/// The paper's greedy steps from the start, the last four samples moved inward to meet the end.
fn greedy(line: &Polyline, rate: &Rate, from: f64, to: f64) -> Vec<f64> {
    let mut out = vec![from];
    let (mut last, mut lowest) = (from, f64::INFINITY);
    pieces(line, rate, from, to, |s, step, r| {
        lowest = lowest.min(r);
        if s + step - last >= lowest {
            last += lowest.min(s + step - last);
            out.push(last);
            lowest = r;
        }
    });
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
