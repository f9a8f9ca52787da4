//! Ends of a stroke at which the curve is held, because it goes on there in segments that exist already (section 3.7 of Baran et al. 2010).
//!
//! The paper makes these segments the sole source and sink of the graph. Here each candidate at such an end bears itself what joining them
//! costs, which comes to the same.

use super::candidates::Candidate;
use super::chain::{Chain, KAPPA0, KAPPA1, LENGTH, Measured, Piece, Pin, end};
use super::merge::{Effort, merge};
use super::refine::total;
use super::transition::estimate_held;
use crate::options::FitOptions;
use crate::track::Track;
use fairpath_curve::{Continuity, Kind};

/// How the curve is held at an end of the stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hold {
    /// Where it must be, and how smoothly it must meet what exists: 2 numbers for G0, 3 for G1, 4 for G2.
    pub(crate) pin: Pin,
    /// The sign with which the curvature of what exists comes to the join; 0 if it has none.
    pub(crate) sign: i8,
}

/// What a candidate with those logical signs of curvature costs in addition because the stroke is held at its start (side 0) or end
/// (side 1); infinite where the two cannot be joined.
pub(super) fn cost(track: &Track, c: &Candidate, sign: [i8; 2], side: usize, options: &FitOptions) -> f64 {
    let is_there = [c.first == 0, c.last as usize == track.turn][side];
    let Some(hold) = track.held[side].as_ref().filter(|_| is_there) else { return 0.0 };
    let inflects = hold.pin.count == 4 && hold.sign * sign[side] < 0;
    expected(Some(hold), c, side, options) + if inflects { options.inflection_cost } else { 0.0 }
}

/// The extra cost of deviation that joining is expected to bring.
pub(super) fn expected(hold: Option<&Hold>, c: &Candidate, side: usize, options: &FitOptions) -> f64 {
    let Some(Hold { pin, .. }) = hold else { return 0.0 };
    let state = if side == 0 { &c.head[0] } else { &c.tail[0] };
    // What looks like a line from its data may have to bend: only its kind is sure.
    if !pin.admits(c.kind) || (c.kind == Kind::Arc && pin.count == 4 && pin.pose[3] * c.primitive.kappa < 0.0) {
        return f64::INFINITY;
    }
    estimate_held(c, state, pin, options).unwrap_or(f64::INFINITY)
}

/// Splits pieces of a chain that is held at both ends until it can meet both: each end that is held takes away up to four freedoms, and
/// few pieces have no more. What is split needlessly, refinement unites again.
pub(super) fn give_freedom(chain: &mut Chain) {
    let [Some(start), Some(last)] = chain.held else { return };
    if chain.joins.contains(&Continuity::G0) {
        return;
    }
    while freedom(chain) + 4 - start.count < last.count + SPARE {
        let length = |k: &usize| chain.pieces[*k].q[LENGTH];
        let Some(longest) = (0..chain.pieces.len()).max_by(|a, b| length(a).total_cmp(&length(b))) else { return };
        split(chain, longest);
    }
}

/// Freedoms beyond those that the ends take away, so that the curve can still follow its data.
const SPARE: usize = 2;

/// Effort of merging a chain that may be too stiff yet: how well it can follow its data shows soon.
const STIFF: Effort = Effort { rounds: 6, tolerance: 1e-2 };

/// Merges a chain that was just made of a path. One that is held at both ends or closes smoothly, if it costs more than `enough` or cannot meet its end, is merged
/// anew from what it was: what its end must meet makes a chain of few pieces stiffer than its path looked. First all pieces become clothoids whose curvature
/// may have any sign, then the one that strays most is split, for as long as that helps. One after the other with their neighbours, as refinement makes changes,
/// pieces come to less good ends and take longer; and what they need not be, refinement takes back.
pub(super) fn merge_softly(chain: &mut Chain, effort: Effort, enough: f64, options: &FitOptions) -> Option<Measured> {
    let is_ring = chain.closed && !chain.joins.contains(&Continuity::G0);
    if options.clothoid_cost.is_none() || chain.held.contains(&None) && !is_ring {
        return merge(chain, effort);
    }
    let begun = chain.pieces.clone();
    let mut best = merge(chain, STIFF);
    for splits in 0..=SPLITS {
        let cost = best.as_ref().map_or(f64::INFINITY, |measured| total(chain, measured, options));
        if cost <= enough {
            break;
        }
        let before = (chain.pieces.clone(), chain.joins.clone());
        if splits == 0 {
            chain.pieces.clone_from(&begun);
            for piece in &mut chain.pieces {
                (piece.kind, piece.sign) = (Kind::Clothoid, [0; 2]);
            }
        } else {
            let normals = &best.as_ref()?.normals;
            let deviation = |k: &usize| normals[*k].deviation(options);
            split(chain, (0..normals.len()).max_by(|a, b| deviation(a).total_cmp(&deviation(b)))?);
        }
        match merge(chain, STIFF) {
            Some(softer) if total(chain, &softer, options) < cost => best = Some(softer),
            _ => {
                (chain.pieces, chain.joins) = before;
                if splits > 0 {
                    break;
                }
            }
        }
    }
    best
}

/// Most pieces that are split so.
const SPLITS: usize = 3;

/// Numbers that a merge can choose for the pieces of a chain, its start aside.
fn freedom(chain: &Chain) -> usize {
    let flat_after = |k: usize| chain.pieces.get(k + 1).is_some_and(|next| next.kind == Kind::Line);
    let own = |k: usize| 1 + usize::from(chain.pieces[k].kind == Kind::Clothoid && !flat_after(k));
    (0..chain.pieces.len()).map(own).sum()
}

/// Makes two clothoids of a piece.
pub(super) fn split(chain: &mut Chain, k: usize) {
    let [first, second] = halves(&chain.pieces[k]);
    chain.pieces.splice(k..=k, [first, second]);
    chain.joins.insert(k, Continuity::G2);
}

/// Two clothoids that are together what a piece is.
pub(super) fn halves(piece: &Piece) -> [Piece; 2] {
    let half = 0.5 * piece.q[LENGTH];
    let middle = 0.5 * (piece.q[KAPPA0] + piece.q[KAPPA1]);
    let mut first = Piece { kind: Kind::Clothoid, sign: [piece.sign[0], 0], ..*piece };
    (first.q[KAPPA1], first.q[LENGTH]) = (middle, half);
    let mut second = Piece { kind: Kind::Clothoid, sign: [0, piece.sign[1]], ..*piece };
    second.q[..=KAPPA0].copy_from_slice(&end(&first.q));
    (second.q[KAPPA1], second.q[LENGTH]) = (piece.q[KAPPA1], half);
    [first, second]
}
