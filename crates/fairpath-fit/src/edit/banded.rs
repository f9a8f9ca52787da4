//! Linear equations whose matrix is symmetric and has entries near its diagonal only: the matrix and a right side come in, the solution goes out, in time
//! that grows with the number of unknowns alone.

/// Entries on each side of the diagonal.
pub(super) const BAND: usize = 5;

/// The lower half of the matrix: row `i` holds the entries of columns `i − BAND` to `i`, the diagonal last.
pub(super) type Row = [f64; BAND + 1];

/// The solution of `matrix · x = right` by Cholesky's method; nothing if the matrix is not positive definite.
pub(super) fn solve_banded(mut matrix: Vec<Row>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = matrix.len();
    for i in 0..n {
        for j in i.saturating_sub(BAND)..=i {
            let mut sum = matrix[i][BAND + j - i];
            for k in i.saturating_sub(BAND)..j {
                sum -= matrix[i][BAND + k - i] * matrix[j][BAND + k - j];
            }
            if j < i {
                matrix[i][BAND + j - i] = sum / matrix[j][BAND];
            } else if sum > 0.0 && sum.is_finite() {
                matrix[i][BAND] = sum.sqrt();
            } else {
                return None;
            }
        }
    }
    for i in 0..n {
        for j in i.saturating_sub(BAND)..i {
            right[i] -= matrix[i][BAND + j - i] * right[j];
        }
        right[i] /= matrix[i][BAND];
    }
    for i in (0..n).rev() {
        for j in i + 1..n.min(i + BAND + 1) {
            right[i] -= matrix[j][BAND + i - j] * right[j];
        }
        right[i] /= matrix[i][BAND];
    }
    right.iter().all(|x| x.is_finite()).then_some(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_solves_and_what_is_not_positive_definite_is_refused() {
        for n in [1, 2, 6, 7, 40] {
            let number = |i: usize| libm::sin(1.0 + 37.0 * i as f64);
            let mut matrix: Vec<Row> = (0..n)
                .map(|i| std::array::from_fn(|k| if k == BAND { 12.0 + number(i) } else { number(7 * i + k) }))
                .collect();
            let right: Vec<f64> = (0..n).map(|i| number(100 + i)).collect();
            let entry = |matrix: &[Row], i: usize, j: usize| {
                let (row, column) = (i.max(j), i.min(j));
                if row - column > BAND { 0.0 } else { matrix[row][BAND + column - row] }
            };
            let x = solve_banded(matrix.clone(), right.clone()).expect("its diagonal dominates");
            for i in 0..n {
                let left: f64 = (0..n).map(|j| entry(&matrix, i, j) * x[j]).sum();
                assert!((left - right[i]).abs() < 1e-13, "{n} {i}: {left} {}", right[i]);
            }
            matrix[n / 2][BAND] = -1.0;
            assert!(solve_banded(matrix, right).is_none());
        }
    }
}
