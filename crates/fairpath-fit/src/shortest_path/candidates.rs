//! Candidate primitives for every run of samples (section 3.3 of Baran et al. 2010).

use crate::linear::{cholesky, solve, solve_lower};
use crate::options::{Deviation, FitOptions};
use crate::parallel;
use crate::primitive_fit::{Normal, Walked, chord, circle_through, walk_arc, walk_line, walk_near};
use crate::track::{Shape, Track};
use crate::walk::{Datum, Primitive, Walker};
use fairpath_curve::{Kind, Vec2, trig};

/// A primitive fitted to the samples `first..=last`, with what the graph needs to know of it.
#[derive(Clone, Debug)]
pub(crate) struct Candidate {
    pub(crate) kind: Kind,
    pub(crate) first: u32,
    pub(crate) last: u32,
    pub(crate) primitive: Primitive,
    pub(crate) length: f64,
    /// Its deviation as costs count it, px: τ of section 3.4.
    pub(crate) error: f64,
    /// Largest distance of the data to it, px (equation 2).
    pub(crate) largest: f64,
    /// What that costs: `p(τ)`.
    pub(crate) penalty: f64,
    /// Square of the deviation that a unit of weighted squared distance adds at a join, px².
    pub(crate) spread: f64,
    /// How far a join may slide from the middle of its overlap: a quarter of a sample interval, px.
    pub(crate) slide: f64,
    /// Its state where it may be joined: at its first and second sample, and at its last and last but one.
    pub(crate) head: [JoinState; 2],
    pub(crate) tail: [JoinState; 2],
    /// Kind's cost, deviation, shortness and inflection (section 3.4).
    pub(crate) cost: f64,
}

/// How a primitive passes a sample, and how firmly its data hold it there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JoinState {
    /// Arc length along the primitive, px.
    pub(crate) s: f64,
    /// Signed distance from the primitive to the sample, px.
    pub(crate) offset: f64,
    pub(crate) heading: f64,
    pub(crate) curvature: f64,
    /// Covariance of position across the curve, heading and curvature for a unit of weighted squared distance: the upper
    /// triangle by rows.
    pub(crate) covariance: [f64; 6],
}

impl Candidate {
    pub(crate) fn curvature_at_end(&self) -> f64 {
        self.primitive.kappa + self.primitive.sharpness * self.length
    }

    pub(crate) fn has_inflection(&self) -> bool {
        // Rounding gives a straight run curvatures of either sign.
        let (a, b) = (self.primitive.kappa, self.curvature_at_end());
        a * b < 0.0 && a.abs().min(b.abs()) * self.length > FLAT
    }
}

/// Turning of a primitive that has no sign, radians.
const FLAT: f64 = 1e-9;

/// Penalty of deviation: `p(τ) = w_E max(τ − 1, 0)²` (section 3.4).
#[inline]
pub(crate) fn penalty(error: f64, options: &FitOptions) -> f64 {
    let excess = (error - options.free_error).max(0.0);
    options.error_cost * excess * excess
}

/// The deviation that costs are counted from.
#[inline]
pub(crate) fn deviation(energy: f64, weight: f64, largest: f64, options: &FitOptions) -> f64 {
    match options.deviation {
        Deviation::Rms if largest <= options.max_error => 2.0 * (energy / weight.max(1e-9)).sqrt(),
        // Beyond the cutoff it is the farthest point that counts: a hook at the end of a long line must not drown in it.
        Deviation::Rms => largest,
        Deviation::Max => largest,
    }
}

/// A kind of primitive that is allowed, and the fit of the run before to start from.
struct Family {
    kind: Kind,
    cost: f64,
    unknowns: usize,
    /// Fewest sample intervals.
    fewest: usize,
    /// The fit of the run one sample shorter, and where along it the feet of its data are.
    warm: Option<Walked>,
    feet: Vec<f64>,
    misses: usize,
}

/// All candidates, in the order of their first sample.
pub(crate) fn candidates(track: &Track, options: &FitOptions) -> Vec<Candidate> {
    let starts = track.turn;
    let end = if track.shape == Shape::Ring { 2 * track.turn } else { track.turn };
    let from = |first: &usize| {
        let first = *first;
        let mut out = Vec::new();
        let mut families: Vec<Family> = [
            (Kind::Line, options.line_cost, 2, 1),
            (Kind::Arc, options.arc_cost, 3, 2),
            (Kind::Clothoid, options.clothoid_cost, 4, 3),
        ]
        .into_iter()
        .filter_map(|(kind, cost, unknowns, fewest)| {
            Some(Family { kind, cost: cost?, unknowns, fewest, warm: None, feet: Vec::new(), misses: 0 })
        })
        .collect();
        // A primitive may not run through a corner, nor more than once around.
        let stop = (first + 1..=end).find(|&j| track.corner[j]).unwrap_or(end).min(first + track.turn);
        let begins_here = first == 0 && track.shape != Shape::Ring || track.corner[first];
        let mut before = first;
        for last in first + 1..=stop {
            let span = last - first;
            if !span.is_multiple_of(stride(span)) && !begins_here && last != stop {
                continue;
            }
            let data = track.coarse.run(first, last);
            let fresh = track.coarse.samples[last] - track.coarse.samples[before];
            before = last;
            for family in &mut families {
                if family.misses < PATIENCE && last - first >= family.fewest {
                    extend(family, data, fresh, (first, last), track, options, &mut out);
                }
            }
            if families.iter().all(|f| f.misses >= PATIENCE) {
                break;
            }
        }
        out
    };
    let starts: Vec<usize> = (0..starts).collect();
    parallel::map(&starts, from).into_iter().flatten().collect()
}

/// Long runs are fitted only in every second and fourth length: where exactly a long primitive ends matters less. The rule knows only
/// the length, so that it is the same in both directions.
fn stride(span: usize) -> usize {
    match span {
        0..=12 => 1,
        13..=24 => 2,
        _ => 4,
    }
}

/// Whether merging can straighten a primitive to what it allows. A curl far smaller than a pixel lies near all points of a blot, but
/// would wind on for ever.
pub(crate) fn mergeable(p: &Primitive, length: f64, max_curvature: f64) -> bool {
    p.kappa.abs().max((p.kappa + p.sharpness * length).abs()) <= SHARPEST * max_curvature
}

/// A primitive may bend more than a merged one by this factor: fits of two or three samples do without being curls.
const SHARPEST: f64 = 10.0;

/// A kind of primitive is given up after this many runs in sequence that it does not fit.
const PATIENCE: usize = 2;

/// A candidate whose deviation costs more than this is discarded: two of the dearest kind would serve in its place.
fn hopeless(options: &FitOptions) -> f64 {
    let dearest =
        [options.line_cost, options.arc_cost, options.clothoid_cost].into_iter().flatten().fold(0.0, f64::max);
    2.0 * dearest + HOPELESS_MARGIN
}

/// Runs of no more intervals than this are kept all the same: without them there might be no path at all.
const ALWAYS_KEPT: usize = 4;

/// So that costs of zero do not discard everything.
const HOPELESS_MARGIN: f64 = 10.0;

/// A round of Gauss–Newton is taken while it promises to lower the energy by this share.
const WORTH_A_STEP: f64 = 0.02;

/// The normal equations of a fit with the data that follow its last one, which is the first of `data`; their feet are added.
fn extended(shorter: &Walked, data: &[Datum], end_factor: f64, feet: &mut Vec<f64>) -> Normal {
    let mut walker = Walker::new(&shorter.primitive);
    let tangent = walker.tangent;
    let mut normal = shorter.normal;
    walker.go_to(shorter.length);
    feet.pop();
    for (i, datum) in data.iter().enumerate() {
        let foot = walker.project(datum.point);
        feet.push(foot.s);
        // The former end is an end no more, and the new one is.
        let factor = if i == 0 {
            1.0 - end_factor
        } else if i + 1 == data.len() {
            end_factor
        } else {
            1.0
        };
        normal.add(&walker.row(tangent), foot.distance, factor * datum.weight);
    }
    normal
}

/// Fits one kind to a run and keeps it if it is near enough.
fn extend(
    family: &mut Family,
    data: &[Datum],
    fresh: usize,
    span: (usize, usize),
    track: &Track,
    options: &FitOptions,
    out: &mut Vec<Candidate>,
) {
    let mut feet = std::mem::take(&mut family.feet);
    let walk = |primitive: &Primitive, feet: &mut Vec<f64>| match family.kind {
        Kind::Line => walk_line(primitive, data, options.end_factor),
        Kind::Arc => walk_arc(primitive, data, options.end_factor),
        Kind::Clothoid => walk_near(primitive, data, options.end_factor, feet),
    };
    let n = family.unknowns;
    // From the fit of the shorter run one step over all data is nearly always enough.
    let (guess, rounds) = match &family.warm {
        Some(shorter) => {
            let longer = extended(shorter, &data[data.len() - 1 - fresh..], options.end_factor, &mut feet);
            (longer.step(n).map_or(shorter.primitive, |step| shorter.primitive.moved(&step)), 1)
        }
        None if family.kind == Kind::Line => (chord(data), 1),
        None => (circle_through(data), 3),
    };
    let mut fit = walk(&guess, &mut feet);
    for _ in 0..rounds {
        let Some(step) = fit.normal.step(n) else { break };
        // The step's own forecast of what it gains.
        let gain: f64 = (0..n).map(|i| step[i] * fit.normal.gradient[i]).sum();
        if gain < WORTH_A_STEP * fit.normal.energy + 1e-3 * fit.normal.weight {
            break;
        }
        let next = walk(&fit.primitive.moved(&step), &mut feet);
        if !(next.normal.energy <= fit.normal.energy) {
            break;
        }
        fit = next;
    }
    let extent = data[data.len() - 1].s - data[0].s;
    let sound = fit.normal.energy.is_finite()
        && fit.length > 0.25 * extent
        && fit.length < 1.5 * extent + 4.0
        && mergeable(&fit.primitive, fit.length, options.max_curvature());
    let error = deviation(fit.normal.energy, fit.normal.weight, fit.normal.max, options);
    if !sound
        || fit.normal.max > options.max_error
        || (span.1 - span.0 > ALWAYS_KEPT && penalty(error, options) > hopeless(options))
    {
        family.misses += 1;
        family.warm = sound.then_some(fit);
        if sound {
            family.feet = feet;
        }
        return;
    }
    family.misses = 0;
    family.warm = Some(fit);
    family.feet = feet;
    let free = make(family, &fit.primitive, fit.length, &fit.normal, span, track, options);
    let inflects = family.kind == Kind::Clothoid && free.has_inflection();
    out.push(free);
    if inflects {
        constrained(family, &fit, data, span, track, options, out);
    }
}

/// The clothoids without inflection that come nearest to one with (section 3.8).
///
/// The best clothoid under a sign constraint has zero curvature at one end. Which end is flat decides the sign, so there are two;
/// each is found from the free fit's normal equations with the one condition added, and corrected once.
fn constrained(
    family: &Family,
    free: &Walked,
    data: &[Datum],
    span: (usize, usize),
    track: &Track,
    options: &FitOptions,
    out: &mut Vec<Candidate>,
) {
    let mut feet = Vec::with_capacity(data.len());
    for flat_start in [true, false] {
        let mut fit = *free;
        feet.clone_from(&family.feet);
        let mut hopeful = true;
        for round in 0..2 {
            let Some((p, forecast)) = flat_end_step(&fit.primitive, fit.length, &fit.normal, flat_start) else { break };
            let error = deviation(forecast, fit.normal.weight, 0.0, options);
            hopeful = penalty(error, options) <= hopeless(options);
            let gain = fit.normal.energy - forecast;
            if !hopeful || (round > 0 && gain < WORTH_A_STEP * fit.normal.energy + 1e-3 * fit.normal.weight) {
                break;
            }
            fit = walk_near(&p, data, options.end_factor, &mut feet);
        }
        if !hopeful || !(fit.normal.max <= options.max_error) || !(fit.length > 0.0) {
            continue;
        }
        // Walking moves the start by a hair; the condition is set again exactly.
        let mut p = fit.primitive;
        let square = fit.length * fit.length;
        let moved = if flat_start {
            let by = p.kappa;
            p.kappa = 0.0;
            by * square * (1.0 / 2.0)
        } else {
            let by = p.sharpness + p.kappa / fit.length;
            p.sharpness -= by;
            by * square * fit.length * (1.0 / 6.0)
        };
        if p.sharpness == 0.0 || !mergeable(&p, fit.length, options.max_curvature()) {
            continue;
        }
        // If that moves the far end of a long or tight one, it is measured as it is now.
        if moved.abs() > 0.1 {
            let length = fit.length;
            fit = walk_near(&p, data, options.end_factor, &mut feet);
            fit.length = length;
        }
        if fit.normal.max <= options.max_error {
            out.push(make(family, &p, fit.length, &fit.normal, span, track, options));
        }
    }
}

/// One Gauss–Newton step of a clothoid whose curvature is zero at one end, and the energy that it forecasts.
fn flat_end_step(p: &Primitive, length: f64, normal: &Normal, flat_start: bool) -> Option<(Primitive, f64)> {
    // With t = (offset, heading, x): curvature = 0 and sharpness = x, or curvature = −x length and sharpness = x.
    let by = if flat_start { [0.0, 1.0] } else { [-length, 1.0] };
    let now = if flat_start { p.sharpness } else { -p.kappa / length };
    let full = |i: usize, j: usize| normal.hessian[i.max(j)][i.min(j)];
    // Moving to the condition first: the change of curvature and sharpness at x = now.
    let base = [by[0] * now - p.kappa, by[1] * now - p.sharpness];
    let mut a = [[0.0; 3]; 3];
    let mut b = [0.0; 3];
    for i in 0..3 {
        for j in 0..=i {
            a[i][j] = match (i, j) {
                (2, 2) => by[0] * by[0] * full(2, 2) + 2.0 * by[0] * by[1] * full(2, 3) + by[1] * by[1] * full(3, 3),
                (2, j) => by[0] * full(2, j) + by[1] * full(3, j),
                (i, j) => full(i, j),
            };
        }
        let residual = |k: usize| normal.gradient[k] - full(k, 2) * base[0] - full(k, 3) * base[1];
        b[i] = if i < 2 { residual(i) } else { by[0] * residual(2) + by[1] * residual(3) };
    }
    if !cholesky(&mut a, 3, 1e-12) {
        return None;
    }
    solve(&a, 3, &mut b);
    let x = now + b[2];
    let step = [b[0], b[1], by[0] * x - p.kappa, by[1] * x - p.sharpness];
    let forecast = normal.energy
        + (0..4)
            .map(|i| step[i] * ((0..4).map(|j| full(i, j) * step[j]).sum::<f64>() - 2.0 * normal.gradient[i]))
            .sum::<f64>();
    step.iter().all(|v| v.is_finite()).then(|| (p.moved(&step), forecast.max(0.0)))
}

/// Completes a candidate: its states at the joins and its cost.
fn make(
    family: &Family,
    primitive: &Primitive,
    length: f64,
    normal: &Normal,
    (first, last): (usize, usize),
    track: &Track,
    options: &FitOptions,
) -> Candidate {
    let error = deviation(normal.energy, normal.weight, normal.max, options);
    let short = (options.short_length - length).max(0.0);
    let mut candidate = Candidate {
        kind: family.kind,
        first: first as u32,
        last: last as u32,
        primitive: *primitive,
        length,
        error,
        largest: normal.max,
        penalty: penalty(error, options),
        spread: options.transition_peak * options.transition_peak / normal.weight,
        slide: 0.25 * length / (last - first) as f64,
        head: [JoinState::NONE; 2],
        tail: [JoinState::NONE; 2],
        cost: family.cost + penalty(error, options) + options.shortness_cost * short * short,
    };
    if candidate.has_inflection() {
        candidate.cost += options.inflection_cost;
    }
    let firmness = Firmness::of(normal, family.unknowns);
    let mut walker = Walker::new(primitive);
    let tangent = walker.tangent;
    let state = |walker: &Walker, s: f64, offset: f64| firmness.state(walker, tangent, primitive, s, offset);
    let (second, last_but_one) = ((first + 1).min(last), (last - 1).max(first));
    if joins_at_ends(options) || track.held[0].is_some() {
        candidate.head[0] = state(&walker, 0.0, walker.offset(track.coarse.sample(first)));
    }
    let foot = walker.project(track.coarse.sample(second));
    candidate.head[1] = state(&walker, foot.s, foot.distance);
    let near = length - (track.coarse.station(last) - track.coarse.station(last_but_one));
    let foot = walker.project_from(near, track.coarse.sample(last_but_one));
    candidate.tail[1] = state(&walker, foot.s, foot.distance);
    candidate.tail[0].s = length;
    if joins_at_ends(options) || track.held[1].is_some() {
        walker.go_to(length);
        candidate.tail[0] = state(&walker, length, walker.offset(track.coarse.sample(last)));
    }
    candidate
}

/// Whether joins are ever estimated at the very ends of candidates: where these overlap by two intervals, they are not.
fn joins_at_ends(options: &FitOptions) -> bool {
    options.g0_cost.is_some()
        || (options.g1_cost.is_some() && options.g1_overlap < 2)
        || (options.g2_cost.is_some() && options.g2_overlap < 2)
}

/// How firmly its data hold a fit: the factor of its normal matrix.
struct Firmness {
    factor: [[f64; 4]; 4],
    unknowns: usize,
}

impl Firmness {
    fn of(normal: &Normal, unknowns: usize) -> Self {
        let mut factor = normal.hessian;
        // A little firmness, as of a tenth of the data's weight seen over a pixel, keeps undetermined fits finite.
        let scale = normal.weight * 1e-9;
        for (i, row) in factor.iter_mut().enumerate() {
            row[i] += scale;
        }
        if !cholesky(&mut factor, unknowns, 1e-14) {
            factor = [[0.0; 4]; 4];
            for (i, row) in factor.iter_mut().enumerate() {
                row[i] = LOOSE;
            }
        }
        Self { factor, unknowns }
    }

    /// The state of a fit at arc length `s`, near which the walker is.
    fn state(&self, walker: &Walker, tangent: Vec2, p: &Primitive, s: f64, offset: f64) -> JoinState {
        // Rows of the change of position across the curve, heading and curvature by the primitive's unknowns.
        let mut rows = [walker.row(tangent), [0.0, 1.0, s, 0.5 * s * s], [0.0, 0.0, 1.0, s]];
        for row in &mut rows {
            for v in &mut row[self.unknowns..] {
                *v = 0.0;
            }
            solve_lower(&self.factor, self.unknowns, row);
        }
        let dot = |i: usize, j: usize| {
            let (a, b): (&[f64; 4], &[f64; 4]) = (&rows[i], &rows[j]);
            a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
        };
        JoinState {
            s,
            offset,
            heading: p.heading + s * (p.kappa + 0.5 * p.sharpness * s),
            curvature: p.kappa + p.sharpness * s,
            covariance: [dot(0, 0), dot(0, 1), dot(0, 2), dot(1, 1), dot(1, 2), dot(2, 2)],
        }
    }
}

/// Square root of the variance of what no data determine.
const LOOSE: f64 = 30.0;

impl JoinState {
    const NONE: Self = Self { s: 0.0, offset: 0.0, heading: 0.0, curvature: 0.0, covariance: [0.0; 6] };

    /// Difference of two headings as the least turn between them.
    pub(crate) fn turn_to(&self, other: &Self) -> f64 {
        trig::wrap_angle(other.heading - self.heading)
    }
}
