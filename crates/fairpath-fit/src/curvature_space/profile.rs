//! A connected piecewise linear curvature (between sections 4.2 and 4.3 of McCrae and Singh 2008): places and knots in, curvature at
//! the knots out.
//!
//! The regression lines of neighbouring pieces do not meet. One least-squares problem for the values at the knots gives lines that do; each
//! place concerns the two knots beside it only, so its matrix is tridiagonal.

use super::estimate::Place;

/// Curvatures at the increasing arc lengths `knots`, at least two, linear between, with the least squared distance to `places`, which lie
/// between the first and the last knot. Without places near a knot its curvature is that of its neighbours.
pub(crate) fn connected(places: &[Place], knots: &[f64]) -> Vec<f64> {
    let n = knots.len();
    let (mut diagonal, mut above, mut right) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut k = 0;
    for p in places {
        while k + 2 < n && knots[k + 1] <= p.s {
            k += 1;
        }
        let u = ((p.s - knots[k]) / (knots[k + 1] - knots[k])).clamp(0.0, 1.0);
        let (a, b) = (1.0 - u, u);
        diagonal[k] += p.weight * a * a;
        diagonal[k + 1] += p.weight * b * b;
        above[k] += p.weight * a * b;
        right[k] += p.weight * a * p.kappa;
        right[k + 1] += p.weight * b * p.kappa;
    }
    // A knot that no place determines leans on its neighbours.
    let lean = LEAN * diagonal.iter().sum::<f64>() / n as f64;
    for k in 0..n - 1 {
        diagonal[k] += lean;
        diagonal[k + 1] += lean;
        above[k] -= lean;
    }
    // Elimination without pivots is stable for positive definite matrices.
    for k in 1..n {
        let factor = above[k - 1] / diagonal[k - 1];
        diagonal[k] -= factor * above[k - 1];
        right[k] -= factor * right[k - 1];
    }
    for k in (0..n).rev() {
        let next = if k + 1 < n { above[k] * right[k + 1] } else { 0.0 };
        right[k] = (right[k] - next) / diagonal[k];
    }
    right
}

/// Weight of the difference of neighbouring knots relative to that of the places: enough to be solvable, too little to be seen.
const LEAN: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_piecewise_linear_is_found_again() {
        let knots = [0.0, 30.0, 80.0, 100.0];
        let values = [0.01, -0.02, 0.03, 0.03];
        let at = |s: f64| {
            let k = knots.partition_point(|&v| v <= s).clamp(1, 3) - 1;
            values[k] + (values[k + 1] - values[k]) * (s - knots[k]) / (knots[k + 1] - knots[k])
        };
        let places: Vec<Place> =
            (2..=19).map(|i| 5.0 * f64::from(i)).map(|s| Place { s, kappa: at(s), weight: 5.0 }).collect();
        for (found, value) in connected(&places, &knots).into_iter().zip(values) {
            assert!((found - value).abs() < 1e-8, "{found} {value}");
        }
    }

    #[test]
    fn one_place_makes_an_arc() {
        let place = Place { s: 5.0, kappa: 0.02, weight: 10.0 };
        for found in connected(&[place], &[0.0, 10.0]) {
            assert!((found - 0.02).abs() < 1e-8, "{found}");
        }
    }
}
