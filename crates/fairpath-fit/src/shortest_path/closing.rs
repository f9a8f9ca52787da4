//! What the end of a chain must meet: its own start if it is closed, a given pose if it is held there.

use super::chain::{Chain, HEADING, KAPPA0, Piece, end};
use super::recursion::{STATE, size};
use fairpath_curve::{Continuity, Kind};
use std::f64::consts::TAU;

/// The equations that close a chain, or hold its end.
pub(crate) struct Closure {
    /// How many of x, y, heading and curvature must agree.
    pub(crate) count: usize,
    /// What the last heading exceeds the first, or the held one, by: whole turns.
    turns: f64,
    /// The pose at which the end is held; else the chain must return to its start.
    held: Option<[f64; STATE]>,
}

impl Closure {
    pub(crate) fn of(chain: &Chain) -> Self {
        let n = chain.pieces.len();
        if let Some(pin) = chain.held[1] {
            // A line's curvature is zero anyway.
            let known = usize::from(pin.count > KAPPA0 && chain.pieces[n - 1].kind == Kind::Line);
            let turned = end(&chain.pieces[n - 1].q)[HEADING] - pin.pose[HEADING];
            return Self { count: pin.count - known, turns: whole_turns(turned), held: Some(pin.pose) };
        }
        if !chain.closed {
            return Self { count: 0, turns: 0.0, held: None };
        }
        let straight = chain.pieces[0].kind == Kind::Line || chain.pieces[n - 1].kind == Kind::Line;
        let count = match chain.joins[n - 1] {
            Continuity::G0 => 2,
            Continuity::G1 => 3,
            Continuity::G2 | Continuity::G3 => 4 - usize::from(straight),
        };
        let turned = end(&chain.pieces[n - 1].q)[HEADING] - chain.pieces[0].q[HEADING];
        Self { count, turns: whole_turns(turned), held: None }
    }

    /// What is open there.
    pub(super) fn gap(&self, pieces: &[Piece]) -> [f64; 4] {
        let last = end(&pieces[pieces.len() - 1].q);
        let mut gap = [0.0; 4];
        for i in 0..self.count {
            gap[i] = last[i] - self.held.map_or(pieces[0].q[i], |pose| pose[i]);
        }
        if self.count > HEADING {
            gap[HEADING] -= self.turns;
        }
        gap
    }

    /// Whether it is a given pose that the end must meet, and not the start.
    pub(super) fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// How large the gap is there, px.
    pub(crate) fn misfit(&self, pieces: &[Piece]) -> f64 {
        if self.count == 0 {
            return 0.0;
        }
        size(self.gap(pieces))
    }
}

fn whole_turns(angle: f64) -> f64 {
    TAU * (angle / TAU + 0.5).floor()
}
