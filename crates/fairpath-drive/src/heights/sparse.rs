//! Symmetric positive definite systems with few entries: a pattern comes in once, its factorisation is used for every matrix that has it.
//!
//! The order of elimination is that of least degree; the factor L of L D Lᵀ is computed row by row (Davis, *Direct methods for sparse linear systems*, 2006,
//! section 4.8, gives the up-looking way).

use std::collections::BTreeSet;

/// Which entries of a symmetric matrix are not zero.
#[derive(Clone, Debug)]
pub(super) struct Pattern {
    count: usize,
    /// Rows and columns of the entries besides the diagonal, the smaller first, ascending.
    pairs: Vec<(usize, usize)>,
}

impl Pattern {
    /// The pattern of `count` unknowns in which these belong together; a pair of one with itself is on the diagonal, which is always there.
    pub(super) fn new(count: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Self {
        let ordered: BTreeSet<_> = pairs.filter(|(i, j)| i != j).map(|(i, j)| (i.min(j), i.max(j))).collect();
        Self { count, pairs: ordered.into_iter().collect() }
    }

    /// How many values a matrix of the pattern has: its diagonal, then the pairs.
    pub(super) fn entries(&self) -> usize {
        self.count + self.pairs.len()
    }

    /// Where the value of a pair stands, which must be in the pattern.
    pub(super) fn entry(&self, i: usize, j: usize) -> usize {
        let pair = (i.min(j), i.max(j));
        self.count + self.pairs.partition_point(|other| *other < pair)
    }
}

/// A factorisation.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    /// Place of each unknown in the order of elimination.
    place: Vec<usize>,
    /// For each row of L its columns, ascending, with the values.
    rows: Vec<Vec<usize>>,
    values: Vec<Vec<f64>>,
    diagonal: Vec<f64>,
    /// For each row of L the values of the matrix that stand there, as column and entry.
    given: Vec<Vec<(usize, usize)>>,
    /// For each column of L the rows that have it.
    columns: Vec<Vec<usize>>,
}

impl Factor {
    /// The order of elimination for a pattern, and where its factor has entries.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let n = pattern.count;
        let mut near: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); n];
        for &(i, j) in &pattern.pairs {
            near[i].insert(j);
            near[j].insert(i);
        }
        // By degree, then by number: the order depends on the pattern alone.
        let mut waiting: BTreeSet<(usize, usize)> = (0..n).map(|i| (near[i].len(), i)).collect();
        let mut place = vec![0; n];
        let mut below: Vec<Vec<usize>> = Vec::with_capacity(n);
        for step in 0..n {
            let Some((_, next)) = waiting.pop_first() else { break };
            place[next] = step;
            let neighbours: Vec<usize> = std::mem::take(&mut near[next]).into_iter().collect();
            for &i in &neighbours {
                waiting.remove(&(near[i].len(), i));
                near[i].remove(&next);
                near[i].extend(neighbours.iter().filter(|&&j| j != i));
                waiting.insert((near[i].len(), i));
            }
            below.push(neighbours);
        }
        let mut rows: Vec<Vec<usize>> = vec![Vec::new(); n];
        let columns: Vec<Vec<usize>> = below
            .iter()
            .map(|below| {
                let mut rows: Vec<usize> = below.iter().map(|&i| place[i]).collect();
                rows.sort_unstable();
                rows
            })
            .collect();
        // Columns ascend, since they are gone through in their order.
        for (column, below) in columns.iter().enumerate() {
            below.iter().for_each(|&row| rows[row].push(column));
        }
        let mut given: Vec<Vec<(usize, usize)>> = vec![Vec::new(); n];
        for (k, &(i, j)) in pattern.pairs.iter().enumerate() {
            let (row, column) = (place[i].max(place[j]), place[i].min(place[j]));
            given[row].push((column, n + k));
        }
        let values = rows.iter().map(|row| vec![0.0; row.len()]).collect();
        Self { place, rows, values, diagonal: vec![0.0; n], given, columns }
    }

    /// Factorises a matrix of the pattern, given by its values.
    pub(super) fn decompose(&mut self, pattern: &Pattern, matrix: &[f64]) {
        let n = pattern.count;
        let mut unknown_at = vec![0; n];
        for (unknown, &place) in self.place.iter().enumerate() {
            unknown_at[place] = unknown;
        }
        let mut full = vec![0.0; n];
        for row in 0..n {
            for &(column, entry) in &self.given[row] {
                full[column] = matrix[entry];
            }
            let mut pivot = matrix[unknown_at[row]];
            for k in 0..self.rows[row].len() {
                let column = self.rows[row][k];
                let above = full[column];
                full[column] = 0.0;
                let value = above / self.diagonal[column];
                // Rows below that have this column as well, up to this row.
                for &other in self.columns[column].iter().take_while(|&&other| other < row) {
                    let at = self.rows[other].partition_point(|&c| c < column);
                    full[other] -= self.values[other][at] * above;
                }
                pivot -= value * above;
                self.values[row][k] = value;
            }
            self.diagonal[row] = pivot;
        }
    }

    /// The solution for a right side.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let n = right.len();
        let mut x = vec![0.0; n];
        for (unknown, &place) in self.place.iter().enumerate() {
            x[place] = right[unknown];
        }
        for row in 0..n {
            let known: f64 =
                self.rows[row].iter().zip(&self.values[row]).map(|(&column, value)| value * x[column]).sum();
            x[row] -= known;
        }
        for row in 0..n {
            x[row] /= self.diagonal[row];
        }
        for row in (0..n).rev() {
            let here = x[row];
            for (&column, value) in self.rows[row].iter().zip(&self.values[row]) {
                x[column] -= value * here;
            }
        }
        self.place.iter().map(|&place| x[place]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_solution_solves_the_system(
            n in 1..30_usize,
            pairs in prop::collection::vec((0..30_usize, 0..30_usize, -1.0..1.0_f64), 0..60),
            right in prop::collection::vec(-1.0..1.0_f64, 30),
        ) {
            let pairs: Vec<_> = pairs.into_iter().map(|(i, j, v)| (i % n, j % n, v)).filter(|(i, j, _)| i != j).collect();
            let pattern = Pattern::new(n, pairs.iter().map(|&(i, j, _)| (i, j)));
            let mut matrix = vec![0.0; pattern.entries()];
            for &(i, j, v) in &pairs {
                matrix[pattern.entry(i, j)] = v;
            }
            // As heavy a diagonal as makes it positive definite.
            for i in 0..n {
                let beside: f64 = pattern.pairs.iter().enumerate()
                    .filter(|(_, (a, b))| *a == i || *b == i)
                    .map(|(k, _)| matrix[n + k].abs())
                    .sum();
                matrix[i] = beside + 0.5;
            }
            let mut factor = Factor::new(&pattern);
            factor.decompose(&pattern, &matrix);
            let x = factor.solve(&right[..n]);
            let mut left: Vec<f64> = (0..n).map(|i| matrix[i] * x[i]).collect();
            for (k, &(i, j)) in pattern.pairs.iter().enumerate() {
                left[i] += matrix[n + k] * x[j];
                left[j] += matrix[n + k] * x[i];
            }
            for (left, right) in left.iter().zip(&right) {
                prop_assert!((left - right).abs() < 1e-9, "{left} {right}");
            }
        }
    }
}
