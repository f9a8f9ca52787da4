//! A convex quadratic program comes in, its least cost goes out, by the primal-dual interior-point method with homogeneous embedding of Goulart and Chen (*Clarabel: An
//! interior-point solver for conic programs with quadratic objectives*, 2024, sections 2 to 4), for equations, and rows that are above or below their values at a cost.
//!
//! Each side on which a row may be has a distance s ≥ 0 that costs p s + ½ c s², and a price z ≥ 0; equations and rows have prices y and w. What is sought is a point of
//!
//! > P x + Eᵀy + Fᵀw + q τ = 0,  E x = e τ,  F x = a τ + s⁺ − s⁻,  c s ∓ w + p τ = z,  κ + (xᵀP x + Σ c s²) / τ + qᵀx + Σ p s + eᵀy + aᵀw = 0,  s z = 0,  τ κ = 0.
//!
//! Where τ > 0 the least cost is at x / τ; where κ > 0 the prices prove that the rows contradict each other. Steps follow Mehrotra's predictor and corrector.
//!
//! What makes it quick is the system that is solved in each step. Distances and prices of rows are eliminated first, each by itself: what is left is P + Fᵀ diag(weights) F, in which
//! an unknown is tied to those only with which it has a sum in common. For roads that is a band of two beside the diagonal, and what crossings add. But for these a step takes time
//! proportional to the number of unknowns.

mod newton;
mod point;
mod softened;
mod system;
mod vectors;

use super::program::{End, Outcome, Program};
use newton::Newton;
use point::{NEAR, Point};
use softened::Softened;
use system::System;
use vectors::Of;

/// Most steps; there are about twenty.
const MOST_STEPS: u32 = 100;

/// What keeps rows so and is as near as this to the least cost is taken where so many steps did not come nearer, which is rounding's doing.
const ROUNDED: f64 = 1e-7;
const FARTHER: u32 = 2;

/// A program is given up when this many steps one after the other went less than [`SHORT`] of their way.
const SHORT_STEPS: u32 = 5;
const SHORT: f64 = 1e-3;

/// The unknowns that cost least.
pub(super) fn solve(program: &Program) -> Outcome {
    let system = System::new(program);
    let mut softened = Softened::new(&system);
    let mut point = Point::first(&system, &mut softened);
    let mut newton = Newton::new(&system);
    let (mut best, mut nearest, mut farther) = (point.clone(), f64::INFINITY, 0);
    let (mut steps, mut short) = (0, 0);
    let end = loop {
        let off = point.off(&system);
        match off.distance(&system, &point) {
            Some(near) if near < nearest => (best, nearest, farther) = (point.clone(), near, 0),
            _ => farther += 1,
        }
        if nearest <= NEAR || (nearest <= ROUNDED && farther == FARTHER) {
            break End::Solved;
        }
        if point.is_contradiction(&system) {
            break End::Infeasible;
        }
        if steps == MOST_STEPS || short == SHORT_STEPS {
            break End::Unsettled;
        }
        steps += 1;
        softened.soften(&system, point.softness(&system));
        let Some(share) = newton.go_on(&mut point, &system, &softened, &off) else { break End::Unsettled };
        short = if share < SHORT { short + 1 } else { 0 };
    };
    let status = match end {
        End::Solved => "solved",
        End::Infeasible => "the rows contradict each other",
        End::Unsettled => "neither solved nor proved to contradict itself",
    };
    let all = |numbers: Vec<f64>, factor: f64| numbers.into_iter().map(|number| number * factor).collect::<Vec<_>>();
    let point = if end == End::Solved { best } else { point };
    let unit = 1.0 / point.tau;
    let Of { x, y, w, .. } = point.at;
    Outcome {
        x: all(x, unit),
        of_equations: all(y, unit * system.cost_unit),
        of_rows: system.in_order(&all(w, unit * system.cost_unit)),
        end,
        status: status.to_owned(),
        iterations: steps,
    }
}
