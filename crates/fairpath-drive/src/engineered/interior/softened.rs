//! The linear equations of a step, with the distances and prices of rows eliminated: how soft sides are comes in, a factorisation and what it solves go out.

use super::system::System;
use super::vectors::{Of, add, set, size};
use crate::sparse::Factor;

/// Directions are corrected until what they leave of prices and equations is so little, or such a share of what was off, as long as that helps, and no more often.
const CORRECTED: f64 = 1e-12;
const CORRECTED_SHARE: f64 = 1e-4;
const CORRECTIONS: usize = 10;

/// A factorisation in which each row gives way as softly as its sides do.
pub(super) struct Softened {
    /// s / (z + c s) of each side.
    pub(super) softness: Vec<f64>,
    /// Of each row: one over what its sides have together.
    weights: Vec<f64>,
    factor: Factor,
}

impl Softened {
    /// Nothing yet.
    pub(super) fn new(system: &System<'_>) -> Self {
        Self { softness: Vec::new(), weights: vec![1.0; system.values.len()], factor: Factor::new(&system.pattern) }
    }

    /// Takes the softness of sides and factorises with it.
    pub(super) fn soften(&mut self, system: &System<'_>, softness: impl Iterator<Item = f64>) {
        set(&mut self.softness, softness);
        let Self { softness, weights, factor } = self;
        let (first, below) = softness.split_at(weights.len());
        weights.copy_from_slice(first);
        add(1.0, below, &mut weights[system.singles..]);
        weights.iter_mut().for_each(|weight| *weight = 1.0 / *weight);
        let mut matrix = system.by_entry.times(&system.by_sum(weights));
        add(1.0, &system.given, &mut matrix);
        factor.decompose(&system.pattern, &matrix);
    }

    /// The solution of P x + Eᵀy + Fᵀw = right.x, E x = right.y, F x − s⁺ + s⁻ = right.w, s = right.s ± softness · w, but for rounding.
    pub(super) fn solve(&self, system: &System<'_>, right: &Of, solution: &mut Of) {
        // With w = weights · F x − pull the first is (P + Fᵀ diag(weights) F) x + Eᵀy = right.x + Fᵀ pull.
        let mut pull = right.w.clone();
        system.add_above(&right.s, &mut pull);
        pull.iter_mut().zip(&self.weights).for_each(|(pull, weight)| *pull *= weight);
        let mut sum = right.x.clone();
        system.add_rows(&pull, &mut sum);
        sum.extend_from_slice(&right.y);
        (solution.x, solution.y, solution.w) = self.solve_first(system, &sum);
        add(-1.0, &pull, &mut solution.w);
        self.tell_sides(system, solution, right);
    }

    /// How far rows are on their sides follows from their prices.
    fn tell_sides(&self, system: &System<'_>, solution: &mut Of, right: &Of) {
        let Of { w, s, .. } = solution;
        let first = w.iter().zip(&system.signs).zip(&self.softness).zip(&right.s);
        set(s, first.map(|(((w, sign), softness), right)| right + sign * w * softness));
        let below = w[system.singles..].iter().zip(&self.softness[w.len()..]).zip(&right.s[w.len()..]);
        s.extend(below.map(|((w, softness), right)| right - w * softness));
    }

    /// Makes a solution nearer to what [`Softened::solve`] says; so much is off of prices and equations.
    pub(super) fn correct(&self, system: &System<'_>, solution: &mut Of, right: &Of, off: f64) {
        let enough = CORRECTED.max(CORRECTED_SHARE * off);
        let mut left = system.left(solution, right);
        for _ in 0..CORRECTIONS {
            let before = size(&left);
            if before <= enough {
                break;
            }
            let (x, y, w) = self.solve_first(system, &left);
            let mut next = Of { x, y, w, s: Vec::new() };
            next.add(1.0, solution);
            left = system.left(&next, right);
            let now = size(&left);
            if now < before {
                *solution = next;
            }
            if !(now < 0.5 * before) {
                break;
            }
        }
        self.tell_sides(system, solution, right);
    }

    /// The solution where right.w and right.s are nothing, without s.
    fn solve_first(&self, system: &System<'_>, right: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let mut x = self.factor.solve(right);
        let y = x.split_off(system.linear.len());
        let mut w = system.rows_times(&x);
        w.iter_mut().zip(&self.weights).for_each(|(sum, weight)| *sum *= weight);
        (x, y, w)
    }
}
