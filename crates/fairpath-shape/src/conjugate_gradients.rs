//! Sparse equations: a symmetric positive definite matrix and a right side come in, the solution goes out.
//!
//! Conjugate gradients, preconditioned with an incomplete Cholesky factor whose diagonal takes up what falls outside the pattern
//! (Gustafsson 1978). For the matrices of elliptic equations that makes the number of iterations grow with the fourth root of the number
//! of unknowns instead of the square root. Sums are taken in one order, so the result is the same to the bit on every run.

/// The lower half of a symmetric matrix by columns, diagonal apart.
#[derive(Clone, Debug, Default)]
pub(crate) struct Symmetric {
    /// Diagonal.
    pub(crate) diagonal: Vec<f64>,
    /// Where each column begins in `rows` and `values`, and the end of all.
    pub(crate) starts: Vec<usize>,
    /// Row of each entry below the diagonal, increasing within a column.
    pub(crate) rows: Vec<u32>,
    /// Value of each entry below the diagonal.
    pub(crate) values: Vec<f64>,
}

/// How much of what falls outside the pattern goes to the diagonal: all of it makes factors of nearly singular matrices unstable.
const TAKEN_UP: f64 = 0.98;
/// A pivot below this part of its diagonal entry is replaced by that entry.
const LEAST_PIVOT: f64 = 1e-3;

/// What conjugate gradients came to.
#[derive(Clone, Debug)]
pub(crate) struct Solution {
    pub(crate) x: Vec<f64>,
    pub(crate) iterations: usize,
    /// Norm of the residual as a part of that of the right side.
    pub(crate) residual: f64,
}

impl Symmetric {
    /// The matrix of `size` rows with these entries `(row, column, value)` on and below the diagonal; those of one place are added in
    /// their order.
    pub(crate) fn from_entries(size: usize, mut entries: Vec<(u32, u32, f64)>) -> Self {
        // Stable, so that sums are taken in the order of the entries.
        entries.sort_by_key(|&(row, column, _)| (column, row));
        let mut matrix = Self { diagonal: vec![0.0; size], starts: vec![0; size + 1], ..Self::default() };
        let mut last = None;
        for (row, column, value) in entries {
            if row == column {
                matrix.diagonal[row as usize] += value;
            } else if last == Some((row, column)) {
                let end = matrix.values.len() - 1;
                matrix.values[end] += value;
            } else {
                matrix.rows.push(row);
                matrix.values.push(value);
                matrix.starts[column as usize + 1] = matrix.rows.len();
            }
            if row != column {
                last = Some((row, column));
            }
        }
        for i in 0..size {
            matrix.starts[i + 1] = matrix.starts[i + 1].max(matrix.starts[i]);
        }
        matrix
    }

    fn size(&self) -> usize {
        self.diagonal.len()
    }

    /// The matrix times `x`.
    fn times(&self, x: &[f64], product: &mut [f64]) {
        for (product, (x, diagonal)) in product.iter_mut().zip(x.iter().zip(&self.diagonal)) {
            *product = diagonal * x;
        }
        for column in 0..self.size() {
            let mut sum = 0.0;
            for k in self.starts[column]..self.starts[column + 1] {
                let (row, value) = (self.rows[k] as usize, self.values[k]);
                product[row] += value * x[column];
                sum += value * x[row];
            }
            product[column] += sum;
        }
    }

    /// An incomplete Cholesky factor with the matrix's own pattern; the diagonal holds the inverse pivots.
    fn factor(&self) -> Self {
        let mut factor = self.clone();
        for column in 0..self.size() {
            let pivot = factor.diagonal[column];
            let pivot = if pivot > LEAST_PIVOT * self.diagonal[column] { pivot } else { self.diagonal[column] };
            let root = pivot.sqrt();
            let inverse = if root > 0.0 { 1.0 / root } else { 1.0 };
            factor.diagonal[column] = inverse;
            let entries = factor.starts[column]..factor.starts[column + 1];
            for value in &mut factor.values[entries.clone()] {
                *value *= inverse;
            }
            for k in entries.clone() {
                let (i, value) = (factor.rows[k] as usize, factor.values[k]);
                factor.diagonal[i] -= value * value;
                let below = factor.starts[i]..factor.starts[i + 1];
                for other in k + 1..entries.end {
                    let (j, product) = (factor.rows[other], value * factor.values[other]);
                    match factor.rows[below.clone()].binary_search(&j) {
                        Ok(at) => factor.values[below.start + at] -= product,
                        Err(_) => {
                            factor.diagonal[i] -= TAKEN_UP * product;
                            factor.diagonal[j as usize] -= TAKEN_UP * product;
                        }
                    }
                }
            }
        }
        factor
    }

    /// Solves with this as the factor that [`Symmetric::factor`] gives: forwards, then backwards.
    fn solve_factored(&self, x: &mut [f64]) {
        for column in 0..self.size() {
            x[column] *= self.diagonal[column];
            for k in self.starts[column]..self.starts[column + 1] {
                x[self.rows[k] as usize] -= self.values[k] * x[column];
            }
        }
        for column in (0..self.size()).rev() {
            let mut sum = x[column];
            for k in self.starts[column]..self.starts[column + 1] {
                sum -= self.values[k] * x[self.rows[k] as usize];
            }
            x[column] = sum * self.diagonal[column];
        }
    }
}

/// Solves `matrix · x = right` until the residual is at most `tolerance` of the right side, or for `most` iterations.
pub(crate) fn solve(matrix: &Symmetric, right: &[f64], tolerance: f64, most: usize) -> Solution {
    let factor = matrix.factor();
    let size = right.len();
    let wanted = tolerance * dot(right, right).sqrt();
    let mut x = vec![0.0; size];
    let mut rest = right.to_vec();
    let mut better = rest.clone();
    factor.solve_factored(&mut better);
    let mut direction = better.clone();
    let mut image = vec![0.0; size];
    let mut measure = dot(&rest, &better);
    let mut left = dot(&rest, &rest).sqrt();
    let mut iterations = 0;
    while left > wanted && iterations < most {
        matrix.times(&direction, &mut image);
        let step = measure / dot(&direction, &image);
        for i in 0..size {
            x[i] += step * direction[i];
            rest[i] -= step * image[i];
        }
        better.copy_from_slice(&rest);
        factor.solve_factored(&mut better);
        let next = dot(&rest, &better);
        let turn = next / measure;
        measure = next;
        for i in 0..size {
            direction[i] = better[i] + turn * direction[i];
        }
        left = dot(&rest, &rest).sqrt();
        iterations += 1;
    }
    Solution { x, iterations, residual: if wanted > 0.0 { left / wanted * tolerance } else { 0.0 } }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The five-point Laplacian of a square grid of `side`² places.
    fn laplacian(side: u32) -> Symmetric {
        let mut entries = Vec::new();
        for i in 0..side * side {
            entries.push((i, i, 4.0));
            if i % side + 1 < side {
                entries.push((i + 1, i, -1.0));
            }
            if i + side < side * side {
                entries.push((i + side, i, -1.0));
            }
        }
        Symmetric::from_entries((side * side) as usize, entries)
    }

    /// Numbers in no order that are the same on every run.
    fn scattered(count: usize) -> Vec<f64> {
        let mut state = 12_345_u32;
        std::iter::repeat_with(|| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        })
        .take(count)
        .collect()
    }

    #[test]
    fn a_known_solution_is_found_again() {
        for side in [1, 2, 7, 60] {
            let matrix = laplacian(side);
            let known = scattered((side * side) as usize);
            let mut right = vec![0.0; known.len()];
            matrix.times(&known, &mut right);
            let found = solve(&matrix, &right, 1e-12, 1000);
            let worst = found.x.iter().zip(&known).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-9 && found.residual <= 1e-12, "{side}: {worst:e} {:e}", found.residual);
        }
    }

    #[test]
    fn four_times_the_unknowns_take_less_than_twice_the_iterations() {
        let iterations = [40, 80, 160].map(|side| {
            let right = vec![1.0; (side * side) as usize];
            solve(&laplacian(side), &right, 1e-10, 10_000).iterations as f64
        });
        // The square root would make each ratio 2, the fourth root 1.41.
        assert!(iterations[1] / iterations[0] < 1.7 && iterations[2] / iterations[1] < 1.7, "{iterations:?}");
    }

    #[test]
    fn entries_of_one_place_are_added() {
        let entries = vec![(1, 0, -0.5), (0, 0, 1.0), (1, 1, 2.0), (1, 0, -0.5), (0, 0, 1.0), (2, 2, 3.0)];
        let matrix = Symmetric::from_entries(3, entries);
        let found = solve(&matrix, &[1.0, 1.0, 6.0], 1e-14, 100);
        // 2x − y = 1, −x + 2y = 1, 3z = 6.
        for (found, known) in found.x.iter().zip([1.0, 1.0, 2.0]) {
            assert!((found - known).abs() < 1e-12, "{found}");
        }
    }

    #[test]
    fn too_few_iterations_are_told() {
        let matrix = laplacian(50);
        let found = solve(&matrix, &vec![1.0; 2500], 1e-12, 3);
        assert!(found.iterations == 3 && found.residual > 1e-12);
    }
}
