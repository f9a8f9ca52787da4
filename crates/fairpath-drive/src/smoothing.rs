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
    Beam::new(points, weights)?.bent(stiffness_m3)
}

/// Heights and their weights, to be followed by beams of several stiffnesses.
pub(crate) struct Beam<'a> {
    points: &'a [[f64; 2]],
    /// One over each weight.
    yielding: Vec<f64>,
    /// Lengths of the intervals, m, and one over each.
    lengths: Vec<f64>,
    inverse: Vec<f64>,
}

impl<'a> Beam<'a> {
    /// As [`smoothed`] says.
    pub(crate) fn new(points: &'a [[f64; 2]], weights: &[f64]) -> Result<Self, ProfileError> {
        // Whatever is wrong with the points is said by a curve through them.
        Profile::catmull_rom(points)?;
        if weights.len() != points.len() || !weights.iter().all(is_positive) {
            return Err(ProfileError::Weights { points: points.len(), weights: weights.len() });
        }
        let lengths: Vec<f64> = points.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
        let inverse = lengths.iter().map(|h| 1.0 / h).collect();
        Ok(Self { points, yielding: weights.iter().map(|w| 1.0 / w).collect(), lengths, inverse })
    }

    /// The curve for a stiffness of each interval; see [`smoothed`].
    pub(crate) fn bent(&self, stiffness_m3: &[f64]) -> Result<Profile, ProfileError> {
        Profile::new(self.knots(stiffness_m3)?)
    }

    /// The same as knots, of which nothing is checked yet.
    pub(crate) fn knots(&self, stiffness_m3: &[f64]) -> Result<Vec<Knot>, ProfileError> {
        let Self { points, yielding, lengths: h, inverse } = self;
        let n = points.len();
        if stiffness_m3.len() != n - 1 || !stiffness_m3.iter().all(is_positive) {
            return Err(ProfileError::Stiffness { intervals: n - 1, given: stiffness_m3.len() });
        }
        if n == 2 {
            return Ok(Profile::catmull_rom(points)?.knots().to_vec());
        }
        let flexibility: Vec<f64> = h.iter().zip(stiffness_m3).map(|(h, k)| h / k).collect();
        // Green and Silverman's Q: the change of grade at each inner point is this combination of three heights.
        let q = |j: usize| [inverse[j], -inverse[j] - inverse[j + 1], inverse[j + 1]];
        // (R + Qᵀ W⁻¹ Q) m = Qᵀ g for the moments m, where R has the intervals' flexibility; it has two diagonals beside the middle one.
        let inner = n - 2;
        let mut band = vec![[0.0; 3]; inner];
        let mut right = vec![0.0; inner];
        for j in 0..inner {
            let (qj, y) = (q(j), &yielding[j..j + 3]);
            right[j] = (points[j + 2][1] - points[j + 1][1]) * qj[2] - (points[j + 1][1] - points[j][1]) * qj[0];
            band[j][0] = (flexibility[j] + flexibility[j + 1]) / 3.0
                + (qj[0] * qj[0] * y[0] + qj[1] * qj[1] * y[1] + qj[2] * qj[2] * y[2]);
            if j + 1 < inner {
                let next = q(j + 1);
                band[j][1] = flexibility[j + 1] / 6.0 + qj[1] * next[0] * y[1] + qj[2] * next[1] * y[2];
            }
            if j + 2 < inner {
                band[j][2] = qj[2] * inverse[j + 2] * y[2];
            }
        }
        let moments = solve_band(band, right);
        let moment = |i: usize| if i == 0 || i + 1 == n { 0.0 } else { moments[i - 1] };
        // What the beam pushes at each point: the change of its shear.
        let shear = |i: usize| (moment(i + 1) - moment(i)) * inverse[i];
        let height = |i: usize| {
            let push = match i {
                0 => shear(0),
                _ if i + 1 == n => -shear(i - 1),
                _ => shear(i) - shear(i - 1),
            };
            points[i][1] - push * yielding[i]
        };
        let heights: Vec<f64> = (0..n).map(height).collect();
        const SIXTH: f64 = 1.0 / 6.0;
        let knot = |i: usize| {
            // From the piece beside it.
            let grade = if i + 1 < n {
                (heights[i + 1] - heights[i]) * inverse[i] - flexibility[i] * (2.0 * moment(i) + moment(i + 1)) * SIXTH
            } else {
                (heights[i] - heights[i - 1]) * inverse[i - 1]
                    + flexibility[i - 1] * (moment(i - 1) + 2.0 * moment(i)) * SIXTH
            };
            Knot { station_m: points[i][0], height_m: heights[i], grade }
        };
        Ok((0..n).map(knot).collect())
    }
}

fn is_positive(x: &f64) -> bool {
    *x > 0.0 && x.is_finite()
}

/// Solves a symmetric positive definite system of which the diagonal and two beside it are given (L D Lᵀ).
fn solve_band(mut band: Vec<[f64; 3]>, mut x: Vec<f64>) -> Vec<f64> {
    let n = band.len();
    for j in 0..n {
        let [pivot, one, two] = band[j];
        let inverse = 1.0 / pivot;
        let (l1, l2) = (one * inverse, two * inverse);
        if j + 1 < n {
            band[j + 1][0] -= l1 * one;
            band[j + 1][1] -= l1 * two;
            x[j + 1] -= l1 * x[j];
        }
        if j + 2 < n {
            band[j + 2][0] -= l2 * two;
            x[j + 2] -= l2 * x[j];
        }
        band[j] = [inverse, l1, l2];
    }
    for j in (0..n).rev() {
        let [inverse, l1, l2] = band[j];
        x[j] *= inverse;
        if j + 1 < n {
            x[j] -= l1 * x[j + 1];
        }
        if j + 2 < n {
            x[j] -= l2 * x[j + 2];
        }
    }
    x
}
