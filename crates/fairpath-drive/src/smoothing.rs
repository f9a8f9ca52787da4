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
pub(crate) struct Beam {
    /// Station and height, m; around a closed path the first few once more behind the last.
    points: Vec<[f64; 2]>,
    /// How many intervals there are, each with its stiffness.
    intervals: usize,
    is_closed: bool,
    /// One over each weight.
    yielding: Vec<f64>,
    /// Lengths of the intervals, m, and one over each.
    lengths: Vec<f64>,
    inverse: Vec<f64>,
    /// Qᵀ W⁻¹ Q, of which the diagonal and two beside it are given, and Qᵀ g: what of the system below no stiffness tells.
    given: Vec<[f64; 3]>,
    right: Vec<f64>,
}

/// So many points come once more around a closed path.
const AGAIN: usize = 4;

/// A beam around a closed path has no fewer points than this.
pub(crate) const LEAST_AROUND: usize = 6;

impl Beam {
    /// As [`smoothed`] says.
    pub(crate) fn new(points: &[[f64; 2]], weights: &[f64]) -> Result<Self, ProfileError> {
        Self::of(points.to_vec(), weights.to_vec(), false)
    }

    /// A beam that ends where it begins, after a length; there are [`LEAST_AROUND`] points or more, and all lie within that length.
    pub(crate) fn around(points: &[[f64; 2]], weights: &[f64], length_m: f64) -> Result<Self, ProfileError> {
        let again = points.iter().take(AGAIN).map(|[s, z]| [s + length_m, *z]);
        let points: Vec<[f64; 2]> = points.iter().copied().chain(again).collect();
        let weights = weights.iter().chain(weights.iter().take(AGAIN)).copied().collect();
        Self::of(points, weights, true)
    }

    fn of(points: Vec<[f64; 2]>, weights: Vec<f64>, is_closed: bool) -> Result<Self, ProfileError> {
        // Whatever is wrong with the points is said by a curve through them.
        Profile::catmull_rom(&points)?;
        if weights.len() != points.len() || !weights.iter().all(is_positive) {
            return Err(ProfileError::Weights { points: points.len(), weights: weights.len() });
        }
        let lengths: Vec<f64> = points.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
        let inverse: Vec<f64> = lengths.iter().map(|h| 1.0 / h).collect();
        let intervals = points.len() - if is_closed { AGAIN } else { 1 };
        let yielding: Vec<f64> = weights.iter().map(|w| 1.0 / w).collect();
        // Green and Silverman's Q: the change of grade at the second of three points is this combination of their heights.
        let q = |j: usize| [inverse[j], -inverse[j] - inverse[j + 1], inverse[j + 1]];
        let rows = if is_closed { intervals } else { points.len() - 2 };
        let row = |j: usize| {
            let (qj, y) = (q(j), &yielding[j..j + 3]);
            let own = qj[0] * qj[0] * y[0] + qj[1] * qj[1] * y[1] + qj[2] * qj[2] * y[2];
            let next = (is_closed || j + 1 < rows).then(|| q(j + 1));
            let beside = next.map_or(0.0, |next| qj[1] * next[0] * y[1] + qj[2] * next[1] * y[2]);
            let beyond = if is_closed || j + 2 < rows { qj[2] * inverse[j + 2] * y[2] } else { 0.0 };
            [own, beside, beyond]
        };
        let given = (0..rows).map(row).collect();
        let change = |j: usize| {
            (points[j + 2][1] - points[j + 1][1]) * inverse[j + 1] - (points[j + 1][1] - points[j][1]) * inverse[j]
        };
        let right = (0..rows).map(change).collect();
        Ok(Self { points, intervals, is_closed, yielding, lengths, inverse, given, right })
    }

    /// How many intervals there are, each with its stiffness.
    pub(crate) fn intervals(&self) -> usize {
        self.intervals
    }

    /// The curve for a stiffness of each interval; see [`smoothed`].
    pub(crate) fn bent(&self, stiffness_m3: &[f64]) -> Result<Profile, ProfileError> {
        Profile::new(self.knots(stiffness_m3)?)
    }

    /// The same as knots, of which nothing is checked yet: one at each point, and around a closed path one more where it ends as it began.
    pub(crate) fn knots(&self, stiffness_m3: &[f64]) -> Result<Vec<Knot>, ProfileError> {
        let Self { points, intervals, is_closed, yielding, lengths, inverse, given, right } = self;
        if stiffness_m3.len() != *intervals || !stiffness_m3.iter().all(is_positive) {
            return Err(ProfileError::Stiffness { intervals: *intervals, given: stiffness_m3.len() });
        }
        if points.len() == 2 {
            return Ok(Profile::catmull_rom(points)?.knots().to_vec());
        }
        let again = stiffness_m3.iter().take(lengths.len() - intervals);
        let flexibility: Vec<f64> = lengths.iter().zip(stiffness_m3.iter().chain(again)).map(|(h, k)| h / k).collect();
        // (R + Qᵀ W⁻¹ Q) m = Qᵀ g for the moments m, where R has the intervals' flexibility; it has two diagonals beside the middle one.
        let rows = given.len();
        let mut band = given.clone();
        for (j, row) in band.iter_mut().enumerate() {
            row[0] += (flexibility[j] + flexibility[j + 1]) / 3.0;
            if *is_closed || j + 1 < rows {
                row[1] += flexibility[j + 1] / 6.0;
            }
        }
        // The moment at each point; a beam with ends has none there.
        let moments: Vec<f64> = if *is_closed {
            let inner = solve_ring(band, right);
            [inner[rows - 1]].into_iter().chain(inner.iter().copied()).chain([inner[0]]).collect()
        } else {
            let inner = solve_band(band, right.iter().map(|x| [*x]).collect());
            [0.0].into_iter().chain(inner.into_iter().map(|[x]| x)).chain([0.0]).collect()
        };
        // What the beam pushes at each point: the change of its shear.
        let shear = |i: usize| (moments[i + 1] - moments[i]) * inverse[i];
        let height = |i: usize| {
            let push = match i {
                0 => shear(0),
                _ if i + 1 == moments.len() => -shear(i - 1),
                _ => shear(i) - shear(i - 1),
            };
            points[i][1] - push * yielding[i]
        };
        let mut heights: Vec<f64> = (0..moments.len()).map(height).collect();
        if *is_closed {
            (heights[0], heights[rows + 1]) = (heights[rows], heights[1]);
        }
        const SIXTH: f64 = 1.0 / 6.0;
        let knot = |i: usize| {
            // From the piece beside it.
            let grade = if i + 1 < heights.len() {
                (heights[i + 1] - heights[i]) * inverse[i]
                    - flexibility[i] * (2.0 * moments[i] + moments[i + 1]) * SIXTH
            } else {
                (heights[i] - heights[i - 1]) * inverse[i - 1]
                    + flexibility[i - 1] * (moments[i - 1] + 2.0 * moments[i]) * SIXTH
            };
            Knot { station_m: points[i][0], height_m: heights[i], grade }
        };
        Ok((0..=*intervals).map(knot).collect())
    }
}

fn is_positive(x: &f64) -> bool {
    *x > 0.0 && x.is_finite()
}

/// Solves a symmetric positive definite system of which the diagonal and two beside it are given (L D Lᵀ), for several right sides.
fn solve_band<const SIDES: usize>(mut band: Vec<[f64; 3]>, mut x: Vec<[f64; SIDES]>) -> Vec<[f64; SIDES]> {
    fn take<const SIDES: usize>(from: &mut [f64; SIDES], share: f64, of: [f64; SIDES]) {
        (0..SIDES).for_each(|k| from[k] -= share * of[k]);
    }
    let n = band.len();
    for j in 0..n {
        let [pivot, one, two] = band[j];
        let inverse = 1.0 / pivot;
        let (l1, l2) = (one * inverse, two * inverse);
        let own = x[j];
        if j + 1 < n {
            band[j + 1][0] -= l1 * one;
            band[j + 1][1] -= l1 * two;
            take(&mut x[j + 1], l1, own);
        }
        if j + 2 < n {
            band[j + 2][0] -= l2 * two;
            take(&mut x[j + 2], l2, own);
        }
        band[j] = [inverse, l1, l2];
    }
    for j in (0..n).rev() {
        let [inverse, l1, l2] = band[j];
        let mut own = x[j].map(|x| x * inverse);
        if j + 1 < n {
            take(&mut own, l1, x[j + 1]);
        }
        if j + 2 < n {
            take(&mut own, l2, x[j + 2]);
        }
        x[j] = own;
    }
    x
}

/// The same where both diagonals go on from the last row to the first: the last two unknowns are eliminated by themselves. There are [`LEAST_AROUND`] rows or more.
fn solve_ring(mut band: Vec<[f64; 3]>, right: &[f64]) -> Vec<f64> {
    let n = band.len() - 2;
    let [last, end] = [band[n], band[n + 1]];
    // What the rows before them have of these two.
    let border = [
        (0, [last[2], end[1]]),
        (1, [0.0, end[2]]),
        (n - 2, [band[n - 2][2], 0.0]),
        (n - 1, [band[n - 1][1], band[n - 1][2]]),
    ];
    let mut x: Vec<[f64; 3]> = right[..n].iter().map(|x| [*x, 0.0, 0.0]).collect();
    for (row, [a, b]) in border {
        x[row][1] += a;
        x[row][2] += b;
    }
    band.truncate(n);
    let x = solve_band(band, x);
    // What is left for the two: a system of two equations.
    let of = |column: usize, side: usize| border.iter().map(|(row, c)| c[column] * x[*row][side]).sum::<f64>();
    let [[a, b], [c, d]] = [[last[0] - of(0, 1), last[1] - of(0, 2)], [last[1] - of(1, 1), end[0] - of(1, 2)]];
    let [p, q] = [right[n] - of(0, 0), right[n + 1] - of(1, 0)];
    let determinant = a * d - b * c;
    let two = [(d * p - b * q) / determinant, (a * q - c * p) / determinant];
    x.iter().map(|[x, u, v]| x - u * two[0] - v * two[1]).chain(two).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn around_a_closed_path_a_beam_is_as_one_that_goes_round_many_times(
            heights in prop::collection::vec(0.0..50.0_f64, LEAST_AROUND..40),
            steps in prop::collection::vec(3.0..7.0_f64, 40),
            stiffness in prop::collection::vec(1.0..1e4_f64, 40),
            weights in prop::collection::vec(0.5..2.0_f64, 40),
        ) {
            let n = heights.len();
            let mut station = 0.0;
            let points: Vec<[f64; 2]> = heights
                .iter()
                .zip(&steps)
                .map(|(z, step)| {
                    station += step;
                    [station - steps[0], *z]
                })
                .collect();
            let length = station - steps[0] + steps[n - 1];
            let around = Beam::around(&points, &weights[..n], length).unwrap().knots(&stiffness[..n]).unwrap();
            // What is changed fades over a few hundred metres at most.
            let turns = 2 * (4000.0 / length).ceil() as usize + 1;
            let again = |turn: usize| points.iter().map(move |[s, z]| [s + turn as f64 * length, *z]);
            let many: Vec<[f64; 2]> = (0..turns).flat_map(again).collect();
            let mut softness = stiffness[..n].repeat(turns);
            softness.pop();
            let long = Beam::new(&many, &weights[..n].repeat(turns)).unwrap().knots(&softness).unwrap();
            let middle = &long[turns / 2 * n..=(turns / 2 + 1) * n];
            prop_assert_eq!(around.len(), n + 1);
            for (a, b) in around.iter().zip(middle) {
                prop_assert!((a.height_m - b.height_m).abs() < 1e-6, "{a:?} {b:?}");
                prop_assert!((a.grade - b.grade).abs() < 1e-6, "{a:?} {b:?}");
            }
            prop_assert!((around[0].height_m - around[n].height_m).abs() < 1e-9);
            prop_assert!((around[0].grade - around[n].grade).abs() < 1e-9);
        }
    }
}
