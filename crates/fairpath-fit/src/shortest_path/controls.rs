//! What may change in a merge: which parameters of a piece are its own, how far they may go, and how far in one round.

use super::chain::{Chain, HEADING, KAPPA0, KAPPA1, LENGTH, Piece, Q};
use fairpath_curve::{Continuity, Kind};

/// Shortest length of a piece, px.
const MIN_LENGTH: f64 = 1.0;
/// Largest curvature where no option says another, radians per px.
pub(crate) const MAX_CURVATURE: f64 = 1.0;

/// Where each parameter of a piece comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Role {
    State,
    Control,
    /// Zero or equal to another.
    Fixed,
    /// As it is, because the chain's start is held there.
    Held,
}

/// Where the parameters of piece `k` come from.
pub(super) fn roles(chain: &Chain, k: usize) -> [Role; Q] {
    let n = chain.pieces.len();
    let piece = &chain.pieces[k];
    let before = if k > 0 { Some(chain.joins[k - 1]) } else { None };
    let after = chain.joins.get(k).copied();
    let line = piece.kind == Kind::Line;
    let mut r = [Role::State; Q];
    if before == Some(Continuity::G0) {
        r[HEADING] = Role::Control;
    }
    let seam_with_line =
        k == 0 && chain.closed && chain.joins[n - 1] >= Continuity::G2 && chain.pieces[n - 1].kind == Kind::Line;
    r[KAPPA0] = if line || seam_with_line {
        Role::Fixed
    } else if before.is_some_and(|j| j < Continuity::G2) {
        Role::Control
    } else {
        Role::State
    };
    let flat_after = after.is_some_and(|j| j >= Continuity::G2) && chain.pieces[(k + 1) % n].kind == Kind::Line;
    r[KAPPA1] = if piece.kind == Kind::Clothoid && !flat_after { Role::Control } else { Role::Fixed };
    r[LENGTH] = Role::Control;
    if k == 0
        && let Some(pin) = chain.held[0]
    {
        r.iter_mut().take(pin.count).filter(|role| **role == Role::State).for_each(|role| *role = Role::Held);
    }
    r
}

/// Least and largest value of a control.
fn bounds(chain: &Chain, piece: &Piece, after: Option<&Piece>, joined: bool, index: usize) -> (f64, f64) {
    match index {
        LENGTH => (MIN_LENGTH, piece.longest),
        KAPPA0 | KAPPA1 => {
            let mut range = (-chain.max_curvature, chain.max_curvature);
            let mut keep = |sign: i8| match sign {
                1 => range.0 = 0.0,
                -1 => range.1 = 0.0,
                _ => {}
            };
            if index == KAPPA0 {
                keep(piece.sign[0]);
                if piece.kind == Kind::Arc {
                    keep(piece.sign[1]);
                }
            } else {
                keep(piece.sign[1]);
                if let (true, Some(next)) = (joined, after) {
                    keep(next.sign[0]);
                }
            }
            range
        }
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

pub(super) fn control_bounds(chain: &Chain, k: usize, index: usize) -> (f64, f64) {
    let n = chain.pieces.len();
    let joined = chain.joins.get(k).is_some_and(|j| *j >= Continuity::G2);
    bounds(chain, &chain.pieces[k], Some(&chain.pieces[(k + 1) % n]), joined, index)
}

pub(super) fn first_bounds(chain: &Chain) -> (f64, f64) {
    bounds(chain, &chain.pieces[0], None, false, KAPPA0)
}

/// How far a parameter may change in one round without leaving what its derivatives can foresee.
pub(super) fn reach(piece: &Piece, index: usize) -> f64 {
    let length = piece.q[LENGTH];
    match index {
        LENGTH => 0.2 * length + 1.0,
        KAPPA0 | KAPPA1 => 0.3 / length + 0.1 * piece.q[index].abs(),
        HEADING => 0.3,
        _ => 3.0,
    }
}
