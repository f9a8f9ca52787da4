//! What it costs to join two candidates (section 3.4 of Baran et al. 2010).

use super::candidates::{Candidate, JoinState, penalty};
use crate::linear::{cholesky, solve};
use crate::options::{FitOptions, Transitions};
use fairpath_curve::{Continuity, Kind};

/// Whether two kinds can be joined with a continuity without degenerating.
pub(crate) fn possible(u: Kind, v: Kind, level: Continuity) -> bool {
    match level {
        Continuity::G0 => true,
        Continuity::G1 => u != Kind::Line || v != Kind::Line,
        Continuity::G2 | Continuity::G3 => u == Kind::Clothoid || v == Kind::Clothoid,
    }
}

/// Sample intervals by which neighbours overlap.
pub(crate) fn overlap(level: Continuity, options: &FitOptions) -> usize {
    match level {
        Continuity::G0 => 0,
        Continuity::G1 => options.g1_overlap.min(2),
        Continuity::G2 | Continuity::G3 => options.g2_overlap.min(2),
    }
}

/// Extra cost of deviation, `p(τ'₁) − p(τ₁) + p(τ'₂) − p(τ₂)`, that enforcing the join is expected to bring; nothing if it would
/// move both candidates too far.
pub(crate) fn estimate(u: &Candidate, v: &Candidate, level: Continuity, options: &FitOptions) -> Option<f64> {
    let (eu, ev) = match options.transitions {
        Transitions::Covariance => by_covariance(u, v, level, options),
        Transitions::Paper => by_mismatch(u, v, level, options),
    };
    if !(eu <= options.max_join_error || ev <= options.max_join_error) {
        return None;
    }
    let cost = penalty(eu, options) - penalty(u.error, options) + penalty(ev, options) - penalty(v.error, options);
    Some(cost.max(0.0))
}

/// A bound from below of [`estimate`] by covariance, at a fraction of its cost: the gap in curvature or heading alone, where the
/// join may slide as far as it can.
#[inline]
pub(crate) fn at_least(u: &Candidate, v: &Candidate, level: Continuity, options: &FitOptions) -> f64 {
    if level < Continuity::G2 || options.transitions == Transitions::Paper || options.g2_overlap == 1 {
        return 0.0;
    }
    let inner = usize::from(options.g2_overlap >= 2);
    let (a, b) = (&u.tail[inner], &v.head[inner]);
    let reach = slide_reach(u, v);
    let slope = (v.primitive.sharpness - u.primitive.sharpness).abs();
    let bend = (b.curvature - a.curvature).abs();
    let bend_left = (bend - reach * slope).max(0.0);
    let variance = a.covariance[5] + b.covariance[5] + FIRMNESS[2];
    let energy = 0.5 * bend_left * bend_left / variance;
    // One of the two takes at least half of it.
    let peak = options.transition_peak * options.transition_peak;
    let rise = |c: &Candidate| {
        let moved = (c.error * c.error + peak * energy / c.weight).sqrt();
        penalty(moved, options) - penalty(c.error, options)
    };
    rise(u).min(rise(v))
}

/// How far a join may slide from the middle of its overlap, px.
#[inline]
fn slide_reach(u: &Candidate, v: &Candidate) -> f64 {
    0.25 * (u.length / f64::from(u.last - u.first)).min(v.length / f64::from(v.last - v.first))
}

/// The states of both candidates at each sample in the middle of their overlap.
fn meeting<'a>(
    u: &'a Candidate,
    v: &'a Candidate,
    overlap: usize,
) -> impl Iterator<Item = (&'a JoinState, &'a JoinState)> {
    let pairs: &[(usize, usize)] = match overlap {
        0 => &[(0, 0)],
        1 => &[(1, 0), (0, 1)],
        _ => &[(1, 1)],
    };
    pairs.iter().map(|&(a, b)| (&u.tail[a], &v.head[b]))
}

/// The errors of both candidates after the join, from how firmly their data hold them.
///
/// Moving a fit by x costs `xᵀ H x`. The least cost of closing a gap g in position, heading and curvature is `gᵀ S⁻¹ g`, where S is the
/// sum of both ends' covariances, and it falls to the two in the ratio of `λᵀ S₁ λ` to `λᵀ S₂ λ`, `λ = S⁻¹ g`. The place of the join may
/// slide along the overlap.
fn by_covariance(u: &Candidate, v: &Candidate, level: Continuity, options: &FitOptions) -> (f64, f64) {
    let mut best = (f64::INFINITY, f64::INFINITY);
    let slope = v.primitive.sharpness - u.primitive.sharpness;
    let dimensions = level as usize + 1;
    for (a, b) in meeting(u, v, overlap(level, options)) {
        let turn = a.turn_to(b);
        let bend = b.curvature - a.curvature;
        let mut gap = [a.offset - b.offset, turn, bend];
        let s: [f64; 6] = std::array::from_fn(|i| a.covariance[i] + b.covariance[i]);
        let mut l = [[s[0], 0.0, 0.0], [s[1], s[3], 0.0], [s[2], s[4], s[5]]];
        for (i, row) in l.iter_mut().enumerate() {
            row[i] += FIRMNESS[i];
        }
        if !cholesky(&mut l, dimensions, 1e-13) {
            continue;
        }
        // Sliding by t adds t times the next derivative; the best t is a least-squares one.
        let drift = [turn, bend, slope];
        let mut pulled = drift;
        solve(&l, dimensions, &mut pulled);
        let (mut top, mut bottom) = (0.0, 0.0);
        for i in 0..dimensions {
            top += gap[i] * pulled[i];
            bottom += drift[i] * pulled[i];
        }
        let reach = slide_reach(u, v);
        let slide = if bottom > 0.0 { (-top / bottom).clamp(-reach, reach) } else { 0.0 };
        for i in 0..dimensions {
            gap[i] += slide * drift[i];
        }
        let mut force = gap;
        solve(&l, dimensions, &mut force);
        for f in &mut force[dimensions..] {
            *f = 0.0;
        }
        let after = |c: &Candidate, s: &[f64; 6]| {
            let [x, y, z] = force;
            let energy = x * (s[0] * x + 2.0 * (s[1] * y + s[2] * z)) + y * (s[3] * y + 2.0 * s[4] * z) + z * s[5] * z;
            (c.error * c.error + options.transition_peak * options.transition_peak * energy / c.weight).sqrt()
        };
        let (eu, ev) = (after(u, &a.covariance), after(v, &b.covariance));
        if penalty(eu, options) + penalty(ev, options) < penalty(best.0, options) + penalty(best.1, options)
            || best.0.is_infinite()
        {
            best = (eu, ev);
        }
    }
    best
}

/// Variances added so that two fits which their data determine fully can still be compared.
const FIRMNESS: [f64; 3] = [1e-9, 1e-12, 1e-14];

/// The paper's estimate: `τ' = τ + ½ (c₀ + c₁ l / 2 + c₂ l² / 4)`.
fn by_mismatch(u: &Candidate, v: &Candidate, level: Continuity, options: &FitOptions) -> (f64, f64) {
    let pairs: Vec<_> = meeting(u, v, overlap(level, options)).collect();
    let least = |f: &dyn Fn(&JoinState, &JoinState) -> f64| {
        let values: Vec<f64> = pairs.iter().map(|(a, b)| f(a, b)).collect();
        let changes_sign = values.iter().any(|v| *v > 0.0) && values.iter().any(|v| *v < 0.0);
        if changes_sign { 0.0 } else { values.iter().fold(f64::INFINITY, |m, v| m.min(v.abs())) }
    };
    let c0 = pairs.iter().fold(f64::INFINITY, |m, (a, b)| m.min((a.offset - b.offset).abs()));
    let c1 = if level >= Continuity::G1 { least(&|a, b| a.turn_to(b)) } else { 0.0 };
    let c2 = if level >= Continuity::G2 { least(&|a, b| b.curvature - a.curvature) } else { 0.0 };
    // How the mismatch of curvature is divided: a line can take none, an arc bends as a whole.
    let (share_u, share_v) = match (u.kind, v.kind) {
        (Kind::Line, _) => (0.0, 2.0),
        (_, Kind::Line) => (2.0, 0.0),
        (Kind::Arc, _) | (_, Kind::Arc) => (2.0, 2.0),
        _ => (1.0, 1.0),
    };
    let after = |c: &Candidate, share: f64| {
        c.error + 0.5 * (c0 + 0.5 * c1 * c.length + 0.25 * share * c2 * c.length * c.length)
    };
    (after(u, share_u), after(v, share_v))
}
