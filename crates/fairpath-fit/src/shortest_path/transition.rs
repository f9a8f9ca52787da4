//! What it costs to join two candidates (section 3.4 of Baran et al. 2010).

use super::candidates::{Candidate, JoinState, penalty};
use super::chain::{HEADING, KAPPA0, Pin};
use crate::linear::{cholesky, solve_lower};
use crate::options::{FitOptions, Transitions};
use fairpath_curve::{Continuity, Kind, trig};

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
    let (eu, ev) = match (options.transitions, overlap(level, options)) {
        (Transitions::Covariance, 0) => by_covariance([(u, &u.tail[0]), (v, &v.head[0])], level),
        (Transitions::Covariance, 1) => {
            let [first, second] =
                [(1, 0), (0, 1)].map(|(a, b)| by_covariance([(u, &u.tail[a]), (v, &v.head[b])], level));
            let cost = |e: (f64, f64)| penalty(e.0, options) + penalty(e.1, options);
            if cost(second) < cost(first) { second } else { first }
        }
        (Transitions::Covariance, _) => by_covariance([(u, &u.tail[1]), (v, &v.head[1])], level),
        (Transitions::Paper, _) => by_mismatch(u, v, level, options),
    };
    if !(eu <= options.max_join_error || ev <= options.max_join_error) {
        return None;
    }
    Some((penalty(eu, options) - u.penalty + penalty(ev, options) - v.penalty).max(0.0))
}

/// Extra cost of deviation that is expected when a candidate, which passes the end of the stroke as `state` says, is moved to where the curve
/// is held there; nothing if that would move it too far.
pub(crate) fn estimate_held(c: &Candidate, state: &JoinState, pin: &Pin, options: &FitOptions) -> Option<f64> {
    let [xx, xy, xz, yy, yz, zz] = state.covariance;
    let mut factor = [[xx + FIRMNESS[0], 0.0, 0.0], [xy, yy + FIRMNESS[1], 0.0], [xz, yz, zz + FIRMNESS[2]]];
    let turn = trig::wrap_angle(pin.pose[HEADING] - state.heading);
    let mut gap = [state.offset, turn, pin.pose[KAPPA0] - state.curvature];
    // Position along the curve is no matter: it is longer or shorter then.
    let n = pin.count - 1;
    if !cholesky(&mut factor, n, 1e-13) {
        return None;
    }
    solve_lower(&factor, n, &mut gap);
    let energy: f64 = gap[..n].iter().map(|v| v * v).sum();
    let after = (c.error * c.error + c.spread * energy).sqrt();
    (after <= options.max_join_error).then(|| (penalty(after, options) - c.penalty).max(0.0))
}

/// What [`at_least`] needs to know of an end of a candidate, side by side: it is asked far more often than [`estimate`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Door {
    curvature: f64,
    variance: f64,
    sharpness: f64,
    slide: f64,
    /// Square of the deviation, px², and its cost.
    squared: f64,
    penalty: f64,
    spread: f64,
}

impl Door {
    pub(crate) fn head(c: &Candidate, options: &FitOptions) -> Self {
        Self::new(c, &c.head[usize::from(options.g2_overlap >= 2)])
    }

    pub(crate) fn tail(c: &Candidate, options: &FitOptions) -> Self {
        Self::new(c, &c.tail[usize::from(options.g2_overlap >= 2)])
    }

    fn new(c: &Candidate, state: &JoinState) -> Self {
        Self {
            curvature: state.curvature,
            variance: state.covariance[5] + 0.5 * FIRMNESS[2],
            sharpness: c.primitive.sharpness,
            slide: c.slide,
            squared: c.error * c.error,
            penalty: c.penalty,
            spread: c.spread,
        }
    }
}

/// A bound from below of [`estimate`] by covariance, at a fraction of its cost: the gap in curvature or heading alone, where the
/// join may slide as far as it can.
#[inline]
pub(crate) fn at_least(u: &Door, v: &Door, level: Continuity, options: &FitOptions) -> f64 {
    if level < Continuity::G2 || options.transitions == Transitions::Paper || options.g2_overlap == 1 {
        return 0.0;
    }
    let slope = (v.sharpness - u.sharpness).abs();
    let bend = (v.curvature - u.curvature).abs();
    let bend_left = (bend - u.slide.min(v.slide) * slope).max(0.0);
    let energy = 0.5 * bend_left * bend_left / (u.variance + v.variance);
    // One of the two takes at least half of it.
    let rise = |c: &Door| penalty((c.squared + c.spread * energy).sqrt(), options) - c.penalty;
    rise(u).min(rise(v))
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
#[inline]
fn by_covariance([(u, a), (v, b)]: [(&Candidate, &JoinState); 2], level: Continuity) -> (f64, f64) {
    let dimensions = level as usize + 1;
    let slope = v.primitive.sharpness - u.primitive.sharpness;
    let turn = a.turn_to(b);
    let bend = b.curvature - a.curvature;
    let s: [f64; 6] = std::array::from_fn(|i| a.covariance[i] + b.covariance[i]);
    // S = L D Lᵀ. Dimensions that the join does not fix are left out by giving them no weight.
    let (d0, s11, s22) = (s[0] + FIRMNESS[0], s[3] + FIRMNESS[1], s[5] + FIRMNESS[2]);
    let r0 = 1.0 / d0;
    let (l10, l20) = (s[1] * r0, s[2] * r0);
    let d1 = s11 - l10 * s[1];
    let e = s[4] - l20 * s[1];
    let r1 = if dimensions > 1 { 1.0 / d1 } else { 0.0 };
    let l21 = e * r1;
    let d2 = s22 - l20 * s[2] - l21 * e;
    let r2 = if dimensions > 2 { 1.0 / d2 } else { 0.0 };
    if !(d0 > 0.0 && (dimensions < 2 || d1 > 1e-13 * s11) && (dimensions < 3 || d2 > 1e-13 * s22)) {
        return (f64::INFINITY, f64::INFINITY);
    }
    let reduced = |g: [f64; 3]| {
        let y1 = g[1] - l10 * g[0];
        [g[0], y1, g[2] - l20 * g[0] - l21 * y1]
    };
    // Sliding by t adds t times the next derivative; the best t is a least-squares one.
    let (still, drift) = (reduced([a.offset - b.offset, turn, bend]), reduced([turn, bend, slope]));
    let weighted = [drift[0] * r0, drift[1] * r1, drift[2] * r2];
    let top = still[0] * weighted[0] + still[1] * weighted[1] + still[2] * weighted[2];
    let bottom = drift[0] * weighted[0] + drift[1] * weighted[1] + drift[2] * weighted[2];
    let reach = u.slide.min(v.slide);
    let slide = if bottom > 0.0 { (-top / bottom).clamp(-reach, reach) } else { 0.0 };
    let z = (still[2] + slide * drift[2]) * r2;
    let y = (still[1] + slide * drift[1]) * r1 - l21 * z;
    let x = (still[0] + slide * drift[0]) * r0 - l10 * y - l20 * z;
    let [xx, xy, xz, yy, yz, zz] = [x * x, 2.0 * x * y, 2.0 * x * z, y * y, 2.0 * y * z, z * z];
    let after = |c: &Candidate, s: &[f64; 6]| {
        let energy = s[0] * xx + s[1] * xy + s[2] * xz + s[3] * yy + s[4] * yz + s[5] * zz;
        (c.error * c.error + c.spread * energy).sqrt()
    };
    (after(u, &a.covariance), after(v, &b.covariance))
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
