//! Heights along a path made fair: heights at stations come in, the profile goes out that is a compromise between following them and bending little.

use crate::profile::{Knot, Profile, ProfileError};

/// The natural cubic spline that makes the sum of squared distances from the heights, each times its weight, plus `stiffness_m3` times the integral of the
/// squared bend, least: the bend is continuous, and nothing at both ends (Reinsch, *Smoothing by spline functions*, 1967; Green and Silverman, *Nonparametric
/// regression*, 1994, section 2.3). With weights of one, waves of length 2π (stiffness × spacing)^¼ are halved, and shorter ones flattened.
///
/// `points` are station and height, m, stations ascending. Time is proportional to their number.
///
/// # Errors
/// When there are fewer than two points, stations do not ascend, a number is not finite, the stiffness is negative, or there is not one positive weight for each point.
pub fn smoothed(points: &[[f64; 2]], weights: &[f64], stiffness_m3: f64) -> Result<Profile, ProfileError> {
    let n = points.len();
    // Whatever is wrong with the points is said by the straight line through them.
    let straight = Profile::catmull_rom(points)?;
    if !(stiffness_m3 >= 0.0 && stiffness_m3.is_finite()) {
        return Err(ProfileError::Stiffness(stiffness_m3));
    }
    if weights.len() != n || !weights.iter().all(|w| *w > 0.0 && w.is_finite()) {
        return Err(ProfileError::Weights { points: n, weights: weights.len() });
    }
    if n == 2 {
        return Ok(straight);
    }
    let h: Vec<f64> = points.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    // Green and Silverman's Q: a bend at each inner point is this combination of three heights.
    let q = |j: usize| [1.0 / h[j], -1.0 / h[j] - 1.0 / h[j + 1], 1.0 / h[j + 1]];
    // (R + stiffness Qᵀ W⁻¹ Q) γ = Qᵀ g, which has two diagonals beside the middle one.
    let m = n - 2;
    let mut band = vec![[0.0; 3]; m];
    let mut right = vec![0.0; m];
    for j in 0..m {
        let qj = q(j);
        right[j] = (0..3).map(|i| qj[i] * points[j + i][1]).sum();
        band[j][0] =
            (h[j] + h[j + 1]) / 3.0 + stiffness_m3 * (0..3).map(|i| qj[i] * qj[i] / weights[j + i]).sum::<f64>();
        if j + 1 < m {
            let next = q(j + 1);
            band[j][1] =
                h[j + 1] / 6.0 + stiffness_m3 * (qj[1] * next[0] / weights[j + 1] + qj[2] * next[1] / weights[j + 2]);
        }
        if j + 2 < m {
            band[j][2] = stiffness_m3 * qj[2] * q(j + 2)[0] / weights[j + 2];
        }
    }
    let bends = solve_band(band, right);
    let mut heights: Vec<f64> = points.iter().map(|point| point[1]).collect();
    for (j, bend) in bends.iter().enumerate() {
        for (i, q) in q(j).into_iter().enumerate() {
            heights[j + i] -= stiffness_m3 * q * bend / weights[j + i];
        }
    }
    let bend = |i: usize| if i == 0 || i + 1 == n { 0.0 } else { bends[i - 1] };
    let knot = |i: usize| {
        // From the piece beside it.
        let grade = if i + 1 < n {
            (heights[i + 1] - heights[i]) / h[i] - h[i] * (2.0 * bend(i) + bend(i + 1)) / 6.0
        } else {
            (heights[i] - heights[i - 1]) / h[i - 1] + h[i - 1] * (bend(i - 1) + 2.0 * bend(i)) / 6.0
        };
        Knot { station_m: points[i][0], height_m: heights[i], grade }
    };
    Profile::new((0..n).map(knot).collect())
}

/// Solves a symmetric positive definite system of which the diagonal and two beside it are given (L D Lᵀ).
fn solve_band(mut band: Vec<[f64; 3]>, mut x: Vec<f64>) -> Vec<f64> {
    let n = band.len();
    for j in 0..n {
        let [pivot, one, two] = band[j];
        let (l1, l2) = (one / pivot, two / pivot);
        if j + 1 < n {
            band[j + 1][0] -= l1 * one;
            band[j + 1][1] -= l1 * two;
            x[j + 1] -= l1 * x[j];
        }
        if j + 2 < n {
            band[j + 2][0] -= l2 * two;
            x[j + 2] -= l2 * x[j];
        }
        band[j] = [pivot, l1, l2];
    }
    for j in (0..n).rev() {
        let [pivot, l1, l2] = band[j];
        x[j] /= pivot;
        if j + 1 < n {
            x[j] -= l1 * x[j + 1];
        }
        if j + 2 < n {
            x[j] -= l2 * x[j + 2];
        }
    }
    x
}
