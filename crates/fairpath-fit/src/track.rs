//! A stroke ready to be fitted: closed if it is, divided at corners, resampled.

use crate::clean::Cleaned;
use crate::closure::close;
use crate::corners::corners;
use crate::hooks::unhooked;
use crate::options::FitOptions;
use crate::polyline::Polyline;
use crate::resample::{Rate, rate, resample};
use crate::shortest_path::hold::Hold;
use crate::walk::Datum;
use fairpath_curve::Vec2;

/// The points and samples of a stroke along its arc length, px. Those of a ring are unrolled: they run through several turns.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// All points that enter the final fit, samples included.
    pub(crate) all: Course,
    /// The samples and at most one point between two of them: enough to choose by.
    pub(crate) coarse: Course,
    /// Whether each sample is a corner.
    pub(crate) corner: Vec<bool>,
    /// Number of sample intervals in the stroke, or in one turn of a ring.
    pub(crate) turn: usize,
    pub(crate) shape: Shape,
    /// Points that closing cut off.
    pub(crate) trimmed: usize,
    /// How the curve is held at the ends of an open track, because it goes on there in segments that stay.
    pub(crate) held: [Option<Hold>; 2],
}

/// Points along a track.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    pub(crate) data: Vec<Datum>,
    /// Which datum each sample is.
    pub(crate) samples: Vec<usize>,
}

impl Course {
    /// Where sample `i` is.
    pub(crate) fn sample(&self, i: usize) -> Vec2 {
        self.data[self.samples[i]].point
    }

    /// Arc length along the stroke at sample `i`, px.
    pub(crate) fn station(&self, i: usize) -> f64 {
        self.data[self.samples[i]].s
    }

    /// The data from sample `i` to sample `j`, both included.
    pub(crate) fn run(&self, i: usize, j: usize) -> &[Datum] {
        &self.data[self.samples[i]..=self.samples[j]]
    }

    /// One datum for each stretch between samples, the one nearest to its middle, with the weight of all.
    fn thinned(&self) -> Self {
        let mut out = Self { data: Vec::new(), samples: Vec::new() };
        for (k, &i) in self.samples.iter().enumerate() {
            out.samples.push(out.data.len());
            out.data.push(self.data[i]);
            let Some(&next) = self.samples.get(k + 1) else { break };
            let middle = 0.5 * (self.data[i].s + self.data[next].s);
            let between = &self.data[i + 1..next];
            let apart = |d: &&Datum| (d.s - middle).abs();
            if let Some(nearest) = between.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))) {
                let weight = between.iter().map(|d| d.weight).sum();
                out.data.push(Datum { weight, ..*nearest });
            }
        }
        out
    }

    /// The same for a ring of given length, unrolled: its last sample is the first of the next turn.
    fn unrolled(mut self, length: f64) -> Self {
        let (one_turn, turn) = (self.data.len() - 1, self.samples.len() - 1);
        for round in 1..TURNS {
            for i in 1..=one_turn {
                let datum = self.data[i];
                self.data.push(Datum { s: datum.s + length * round as f64, ..datum });
            }
            for k in 1..=turn {
                self.samples.push(self.samples[k] + one_turn * round);
            }
        }
        self
    }
}

/// Prepares a stroke (sections 3.1 and 3.2).
pub(crate) fn prepare(cleaned: &Cleaned, options: &FitOptions) -> Track {
    let Some(closed) = close(&cleaned.points, options) else {
        let line = Polyline::new(unhooked(&cleaned.points, options.max_error).to_vec());
        let bends = corners(&line, false, cleaned.grain, options);
        let rate = rate(&line, cleaned.grain, options);
        return assemble(&line, Shape::Open, &bends, &rate, &|_| 1.0, options);
    };
    let mut points = closed.points;
    points.push(points[0]);
    let line = Polyline::new(points);
    let bends = corners(&line, true, cleaned.grain, options);
    Track { trimmed: closed.trimmed, ..around(&line, &bends, cleaned.grain, options) }
}

/// A closed track along a line that ends where it began, with known corners.
pub(crate) fn around(line: &Polyline, bends: &[f64], grain: f64, options: &FitOptions) -> Track {
    let Some(&seam) = bends.first() else {
        return assemble(line, Shape::Ring, &[], &rate(line, grain, options), &|_| 1.0, options);
    };
    // A closed stroke with corners is an open one whose ends meet at one of them.
    let bends: Vec<f64> = bends[1..].iter().map(|s| s - seam).collect();
    let line = rotated(line, seam);
    assemble(&line, Shape::Loop, &bends, &rate(&line, grain, options), &|_| 1.0, options)
}

/// An open track with known corners whose ends are held. Its samples are `closest` to each other where `is_tight` says so, px, and its points
/// count `worth` times, both by arc length.
pub(crate) fn between(
    line: &Polyline,
    bends: &[f64],
    held: [Option<Hold>; 2],
    (closest, is_tight): (f64, &dyn Fn(f64) -> bool),
    worth: &dyn Fn(f64) -> f64,
    grain: f64,
    options: &FitOptions,
) -> Track {
    let mut rate = rate(line, grain, options);
    rate.tighten(line, closest, is_tight);
    Track { held, ..assemble(line, Shape::Open, bends, &rate, worth, options) }
}

/// How a stroke's ends relate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// They do not.
    Open,
    /// They meet at a corner.
    Loop,
    /// They meet smoothly, anywhere.
    Ring,
}

/// A closed polyline that starts at arc length `s`.
fn rotated(line: &Polyline, s: f64) -> Polyline {
    let start = line.at(s, &mut 0);
    let n = line.points.len() - 1;
    let after = line.s.partition_point(|&v| v <= s + 1e-6);
    let before = line.s.partition_point(|&v| v < s - 1e-6);
    let mut points = vec![start];
    points.extend_from_slice(&line.points[after.min(n)..n]);
    points.extend_from_slice(&line.points[..before.min(n)]);
    points.push(start);
    Polyline::new(points)
}

fn assemble(
    line: &Polyline,
    shape: Shape,
    bends: &[f64],
    rate: &Rate,
    worth: &dyn Fn(f64) -> f64,
    options: &FitOptions,
) -> Track {
    let length = line.length();
    let mut stops = vec![0.0];
    stops.extend(bends.iter().copied().filter(|&s| s > 1e-6 && s < length - 1e-6));
    stops.push(length);
    let mut sample_s: Vec<f64> = vec![0.0];
    let mut corner = vec![false];
    for pair in stops.windows(2) {
        let part = resample(line, rate, pair[0], pair[1], options);
        sample_s.extend_from_slice(&part[1..]);
        corner.resize(sample_s.len() - 1, false);
        corner.push(true);
    }
    let turn = sample_s.len() - 1;
    corner[turn] = false;

    let share = options.sample_share;
    let (vertex_weight, sample_weight) = (weights(&line.s, shape), weights(&sample_s, shape));
    let mut data: Vec<Datum> = Vec::with_capacity(line.points.len() + sample_s.len());
    let mut samples = Vec::with_capacity(sample_s.len());
    let (mut hint, mut vertex) = (0, 0);
    for (k, &s) in sample_s.iter().enumerate() {
        while vertex < line.s.len() && line.s[vertex] < s - 1e-9 {
            data.push(Datum {
                point: line.points[vertex],
                s: line.s[vertex],
                weight: (1.0 - share) * vertex_weight[vertex],
            });
            vertex += 1;
        }
        let mut weight = share * sample_weight[k];
        // A sample that falls on a vertex is both.
        if vertex < line.s.len() && line.s[vertex] <= s + 1e-9 {
            weight += (1.0 - share) * vertex_weight[vertex];
            vertex += 1;
        }
        samples.push(data.len());
        data.push(Datum { point: line.at(s, &mut hint), s, weight });
    }
    for datum in &mut data {
        datum.weight *= worth(datum.s);
    }
    let all = Course { data, samples };
    let coarse = all.thinned();
    let (all, coarse) = if shape == Shape::Ring {
        corner.resize(TURNS * turn + 1, false);
        (all.unrolled(length), coarse.unrolled(length))
    } else {
        (all, coarse)
    };
    Track { all, coarse, corner, turn, shape, trimmed: 0, held: [None; 2] }
}

/// Turns through which a ring is unrolled: two neighbours may together cover more than two.
const TURNS: usize = 3;

/// Half the distance to both neighbours; across the seam of a ring, whose first and last entry are the same place.
fn weights(s: &[f64], shape: Shape) -> Vec<f64> {
    let last = s.len() - 1;
    let mut w: Vec<f64> = (0..=last).map(|i| 0.5 * (s[(i + 1).min(last)] - s[i.saturating_sub(1)])).collect();
    if shape == Shape::Ring {
        w[0] += w[last];
        w[last] = w[0];
    }
    w
}
