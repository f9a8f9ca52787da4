//! The thesis's own way to the heights: steepest descent with backtracking, the gradient by finite differences. Kept as an option and as an oracle.

use super::problem::{CrossingHeights, HeightError, Heights, Sum};

/// Difference by which derivatives are taken.
const DIFFERENCE: f64 = 1e-6;

/// What is left of a step when the sum does not fall by enough, and the share of the promised fall that is enough.
const SHRINK: f64 = 0.5;
const ENOUGH: f64 = 1e-4;

impl CrossingHeights {
    /// The heights after so many steps of steepest descent, as section 3.4.4 of the thesis has it; fewer if no step gains any more.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    pub fn solve_by_descent(&self, most_steps: usize) -> Result<Heights, HeightError> {
        let sum = Sum::of(self)?;
        let mut y = sum.start(self)?;
        let mut cost = sum.cost(&y);
        let (mut step, mut steps) = (1.0, 0);
        while steps < most_steps {
            let gradient = differences(&sum, &mut y);
            let steep: f64 = gradient.iter().map(|g| g * g).sum();
            let found = (0..100).find_map(|_| {
                let next: Vec<f64> = y.iter().zip(&gradient).map(|(y, g)| y - step * g).collect();
                let next_cost = sum.cost(&next);
                let gains = next_cost < cost - ENOUGH * step * steep;
                if !gains {
                    step *= SHRINK;
                }
                gains.then_some((next, next_cost))
            });
            let Some((next, next_cost)) = found else { break };
            (y, cost) = (next, next_cost);
            // The next step may be longer again.
            step /= SHRINK;
            steps += 1;
        }
        Ok(self.heights(&sum.spread(&y), cost, steps))
    }
}

/// The gradient by central differences.
fn differences(sum: &Sum, y: &mut [f64]) -> Vec<f64> {
    (0..y.len())
        .map(|i| {
            let at = y[i];
            y[i] = at + DIFFERENCE;
            let ahead = sum.cost(y);
            y[i] = at - DIFFERENCE;
            let behind = sum.cost(y);
            y[i] = at;
            (ahead - behind) / (2.0 * DIFFERENCE)
        })
        .collect()
}
