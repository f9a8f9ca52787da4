//! Inflections that nobody drew, taken out of a chain: a run of knots whose curvature has another sign than those around it, because of
//! tremor or of a bend that ends, is held at zero where that costs less than the inflections.

use crate::options::FitOptions;
use crate::shortest_path::chain::{Chain, KAPPA0, KAPPA1, Measured, Piece};
use crate::shortest_path::merge::{Effort, merge};
use crate::shortest_path::refine::{Change, made, total};
use fairpath_curve::{Continuity, Kind};
use std::ops::Range;

/// Curvature that has no sign, radians per px.
const FLAT: f64 = 1e-9;

/// Most pieces over which a lobe may reach: longer ones are bends.
const LONGEST: usize = 3;

/// Tries each lobe of curvature once, those that turn least first; gives the measurement after.
pub(crate) fn straighten(chain: &mut Chain, measured: Measured, costs: &FitOptions, last: Effort) -> Option<Measured> {
    let mut measured = measured;
    let before = total(chain, &measured, costs);
    let backup = chain.pieces.clone();
    let mut lobes: Vec<Lobe> = stretches(chain).flat_map(|run| lobes(chain, run)).collect();
    lobes.sort_by(|a, b| a.turning.total_cmp(&b.turning));
    let mut changed = false;
    for lobe in &lobes {
        let with: Vec<Piece> = lobe.pieces.clone().map(|k| held(&chain.pieces[k], k, lobe)).collect();
        let change = Change { range: lobe.pieces.clone(), with, level: Continuity::G2, promise: 0.0 };
        changed |= made(chain, &mut measured, &change, costs).is_some();
    }
    if !changed {
        return Some(measured);
    }
    match merge(chain, last) {
        Some(m) if total(chain, &m, costs) < before => Some(m),
        _ => {
            chain.pieces = backup;
            Some(chain.measure())
        }
    }
}

/// A run of knots with another sign than its neighbours.
struct Lobe {
    /// The pieces that begin or end at one of its knots.
    pieces: Range<usize>,
    /// Its knots; knot `k` is where piece `k` begins.
    knots: Range<usize>,
    /// The sign of the neighbours.
    sign: i8,
    /// What it turns, radians.
    turning: f64,
}

/// Runs of pieces between corners.
fn stretches(chain: &Chain) -> impl Iterator<Item = Range<usize>> {
    let mut from = 0;
    (0..chain.pieces.len()).filter_map(move |k| {
        let ends = k + 1 == chain.pieces.len() || chain.joins[k] < Continuity::G2;
        ends.then(|| std::mem::replace(&mut from, k + 1)..k + 1)
    })
}

fn lobes(chain: &Chain, run: Range<usize>) -> Vec<Lobe> {
    let pieces = &chain.pieces;
    let knots = run.start..run.end + 1;
    let kappa = |k: usize| if k < run.end { pieces[k].q[KAPPA0] } else { pieces[k - 1].q[KAPPA1] };
    let sign = |k: usize| {
        if kappa(k) > FLAT {
            1
        } else if kappa(k) < -FLAT {
            -1
        } else {
            0_i8
        }
    };
    let mut out = Vec::new();
    let mut k = knots.start;
    while k < knots.end {
        let own = sign(k);
        let first = k;
        while k < knots.end && sign(k) == own {
            k += 1;
        }
        if own == 0 {
            continue;
        }
        let around = [first.checked_sub(1).filter(|k| *k >= knots.start), Some(k).filter(|k| *k < knots.end)];
        // What ends in a line or at zero already is no lobe of the other sign.
        let other = around.iter().flatten().all(|&k| sign(k) == -own) && around.iter().any(Option::is_some);
        let of = first.saturating_sub(1).max(run.start)..k.min(run.end);
        if !other || of.len() > LONGEST {
            continue;
        }
        if pieces[of.clone()].iter().any(|p| p.kind == Kind::Line) {
            continue;
        }
        let turning = of.clone().map(|j| lobe_turning(&pieces[j], f64::from(own))).sum();
        out.push(Lobe { pieces: of, knots: first..k, sign: -own, turning });
    }
    out
}

/// What a piece turns in the direction of `sign`, radians.
fn lobe_turning(piece: &Piece, sign: f64) -> f64 {
    let (a, b, length) = (sign * piece.q[KAPPA0], sign * piece.q[KAPPA1], piece.q[5]);
    if a >= 0.0 && b >= 0.0 {
        0.5 * (a + b) * length
    } else {
        let top = a.max(b).max(0.0);
        0.5 * top * top / (a - b).abs().max(f64::MIN_POSITIVE) * length
    }
}

/// A piece that must keep the lobe's neighbours' sign at the lobe's knots.
fn held(piece: &Piece, k: usize, lobe: &Lobe) -> Piece {
    let mut out = *piece;
    for (end, knot) in [k, k + 1].into_iter().enumerate() {
        if lobe.knots.contains(&knot) {
            out.sign[end] = lobe.sign;
            out.q[KAPPA0 + end] = 0.0;
        }
    }
    if out.kind == Kind::Arc {
        out.sign = [lobe.sign; 2];
        (out.q[KAPPA0], out.q[KAPPA1]) = (0.0, 0.0);
    }
    out
}
