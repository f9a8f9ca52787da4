//! Heights along a path made fair: heights at stations come in, the profile goes out that is a compromise between following them and bending little.

use crate::profile::{Knot, Profile, ProfileError};

/// The curve that makes the sum of squared distances from the heights, each times its weight, plus the integral of `stiffness_m3` times the squared bend least. With one
/// stiffness it is the natural cubic spline (Reinsch, *Smoothing by spline functions*, 1967; Green and Silverman, *Nonparametric regression*, 1994, section 2.3). With a stiffness of
/// its own for each interval it is a chain of cubics too: what goes on at a point is the grade, and stiffness times bend, the bending moment of a beam. With weights of one, waves
/// of length 2π (stiffness × spacing)^¼ are halved, and shorter ones flattened; what is changed at a place fades as e^(−x √½ (stiffness × spacing)^(−¼)) with the distance x from it.
///
/// `points` are station and height, m, stations ascending; `stiffness_m3` has one number for each interval between two. Time is proportional to their number.
///
/// # Errors
/// When there are fewer than two points, stations do not ascend, a number is not finite, or there is not one positive weight for each point and one positive stiffness for each
/// interval.
pub fn smoothed(points: &[[f64; 2]], weights: &[f64], stiffness_m3: &[f64]) -> Result<Profile, ProfileError> {
    let n = points.len();
    // Whatever is wrong with the points is said by the straight line through them.
    let straight = Profile::catmull_rom(points)?;
    let is_positive = |x: &f64| *x > 0.0 && x.is_finite();
    if stiffness_m3.len() != n - 1 || !stiffness_m3.iter().all(is_positive) {
        return Err(ProfileError::Stiffness { intervals: n - 1, given: stiffness_m3.len() });
    }
    if weights.len() != n || !weights.iter().all(is_positive) {
        return Err(ProfileError::Weights { points: n, weights: weights.len() });
    }
    if n == 2 {
        return Ok(straight);
    }
    let h: Vec<f64> = points.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    let k = stiffness_m3;
    // Green and Silverman's Q: the change of grade at each inner point is this combination of three heights.
    let q = |j: usize| [1.0 / h[j], -1.0 / h[j] - 1.0 / h[j + 1], 1.0 / h[j + 1]];
    // (R + Qᵀ W⁻¹ Q) m = Qᵀ g for the moments m, where R has the intervals' flexibility; it has two diagonals beside the middle one.
    let inner = n - 2;
    let mut band = vec![[0.0; 3]; inner];
    let mut right = vec![0.0; inner];
    for j in 0..inner {
        let qj = q(j);
        right[j] = (0..3).map(|i| qj[i] * points[j + i][1]).sum();
        band[j][0] =
            (h[j] / k[j] + h[j + 1] / k[j + 1]) / 3.0 + (0..3).map(|i| qj[i] * qj[i] / weights[j + i]).sum::<f64>();
        if j + 1 < inner {
            let next = q(j + 1);
            band[j][1] =
                h[j + 1] / (6.0 * k[j + 1]) + qj[1] * next[0] / weights[j + 1] + qj[2] * next[1] / weights[j + 2];
        }
        if j + 2 < inner {
            band[j][2] = qj[2] * q(j + 2)[0] / weights[j + 2];
        }
    }
    let moments = solve_band(band, right);
    let mut heights: Vec<f64> = points.iter().map(|point| point[1]).collect();
    for (j, moment) in moments.iter().enumerate() {
        for (i, q) in q(j).into_iter().enumerate() {
            heights[j + i] -= q * moment / weights[j + i];
        }
    }
    let moment = |i: usize| if i == 0 || i + 1 == n { 0.0 } else { moments[i - 1] };
    let knot = |i: usize| {
        // From the piece beside it.
        let grade = if i + 1 < n {
            (heights[i + 1] - heights[i]) / h[i] - h[i] * (2.0 * moment(i) + moment(i + 1)) / (6.0 * k[i])
        } else {
            (heights[i] - heights[i - 1]) / h[i - 1] + h[i - 1] * (moment(i - 1) + 2.0 * moment(i)) / (6.0 * k[i - 1])
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
