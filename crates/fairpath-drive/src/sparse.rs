//! Symmetric systems with few entries: a pattern comes in once, its factorisation is used for every matrix that has it.
//!
//! A system is positive definite, or what a least cost under equations makes of one: such equations have a multiplier each, a zero on the diagonal, and are eliminated after the
//! unknowns that they tie together, so that no pivot is by accident near zero (Vanderbei, *Symmetric quasidefinite matrices*, 1995). But for that the order of elimination is
//! that of least degree; the factor L of L D Lᵀ is computed row by row (Davis, *Direct methods for sparse linear systems*, 2006, section 4.8, gives the up-looking way).

use crate::lists::Lists;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Which entries of a symmetric matrix are not zero.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    count: usize,
    /// So many of the last unknowns are multipliers.
    multipliers: usize,
    /// For each row the columns of its entries behind the diagonal, ascending.
    behind: Lists<usize>,
}

impl Pattern {
    /// The pattern of `count` unknowns in which these belong together; a pair of one with itself is on the diagonal, which is always there.
    pub(crate) fn new(count: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Self {
        Self::with_multipliers(count, 0, pairs)
    }

    /// The same with unknowns of which the last are multipliers, each tied to one that is none.
    pub(crate) fn with_multipliers(
        count: usize,
        multipliers: usize,
        pairs: impl Iterator<Item = (usize, usize)>,
    ) -> Self {
        let pairs: Vec<_> = pairs.filter(|(i, j)| i != j).map(|(i, j)| (i.min(j), i.max(j))).collect();
        let mut behind = Lists::default();
        let mut sorted = Vec::new();
        for columns in Lists::gathered(count, &pairs).iter() {
            sorted.clear();
            sorted.extend_from_slice(columns);
            sorted.sort_unstable();
            sorted.dedup();
            behind.push(sorted.iter().copied());
        }
        Self { count, multipliers, behind }
    }

    /// How many values a matrix of the pattern has: its diagonal, then what is behind it, row by row.
    pub(crate) fn entries(&self) -> usize {
        self.count + self.behind.items().len()
    }

    /// Where the value of a pair stands, which must be in the pattern.
    pub(crate) fn entry(&self, i: usize, j: usize) -> usize {
        if i == j {
            return i;
        }
        let row = i.min(j);
        self.count + self.behind.range(row).start + self.behind.of(row).partition_point(|column| *column < i.max(j))
    }

    /// Rows and columns of the entries behind the diagonal, as they stand.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.count).flat_map(|row| self.behind.of(row).iter().map(move |&column| (row, column)))
    }

    /// A matrix of the pattern, given by its values, times a vector.
    pub(crate) fn times(&self, matrix: &[f64], x: &[f64]) -> Vec<f64> {
        let mut product: Vec<f64> = matrix.iter().zip(x).map(|(value, x)| value * x).collect();
        for row in 0..self.count {
            let range = self.behind.range(row);
            let values = &matrix[self.count + range.start..self.count + range.end];
            let (here, mut sum) = (x[row], 0.0);
            for (&column, value) in self.behind.items()[range].iter().zip(values) {
                sum += value * x[column];
                product[column] += value * here;
            }
            product[row] += sum;
        }
        product
    }
}

/// A pivot that is less than this share of the numbers that it is the difference of is nothing but their rounding: of an unknown, and of a multiplier, which has gone through more.
const ROUNDING: [f64; 2] = [1e-15, 1e-12];

/// A factorisation.
#[derive(Clone, Debug)]
pub(crate) struct Factor {
    /// The unknowns in the order of elimination.
    order: Vec<usize>,
    /// For each column of L its rows, ascending.
    columns: Lists<usize>,
    /// The values of L, as `columns` has their rows.
    values: Vec<f64>,
    /// For each row of L its columns, ascending.
    rows: Lists<usize>,
    /// For each row of L the values of the matrix that stand there, as column and entry.
    given: Lists<(usize, usize)>,
    diagonal: Vec<f64>,
}

impl Factor {
    /// The order of elimination for a pattern, and where its factor has entries.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let n = pattern.count;
        let (order, below) = least_degree(pattern);
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(step, &unknown)| place[unknown] = step);
        let rows_below = |below: Vec<usize>| {
            let mut rows: Vec<usize> = below.into_iter().map(|i| place[i]).collect();
            rows.sort_unstable();
            rows
        };
        let columns: Lists<usize> = below.into_iter().map(rows_below).collect();
        // Columns ascend in each row, since they are gone through in their order.
        let entries = columns.iter().enumerate().flat_map(|(column, rows)| rows.iter().map(move |&row| (row, column)));
        let rows = Lists::gathered(n, &entries.collect::<Vec<_>>());
        let entry = |(k, (i, j)): (usize, (usize, usize))| (place[i].max(place[j]), (place[i].min(place[j]), n + k));
        let given = Lists::gathered(n, &pattern.pairs().enumerate().map(entry).collect::<Vec<_>>());
        let values = vec![0.0; columns.items().len()];
        Self { order, columns, values, rows, given, diagonal: vec![0.0; n] }
    }

    /// Factorises a matrix of the pattern, given by its values.
    ///
    /// A row that those before it make superfluous, but for rounding, is left to have any solution: what it asks for is there if the system has a solution at all.
    pub(crate) fn decompose(&mut self, pattern: &Pattern, matrix: &[f64]) {
        let n = pattern.count;
        let mut full = vec![0.0; n];
        // How far each column is filled.
        let mut filled: Vec<usize> = (0..n).map(|column| self.columns.range(column).start).collect();
        for row in 0..n {
            for &(column, entry) in self.given.of(row) {
                full[column] = matrix[entry];
            }
            let unknown = self.order[row];
            let mut pivot = matrix[unknown];
            let mut parts = pivot.abs();
            for &column in self.rows.of(row) {
                let above = std::mem::take(&mut full[column]);
                let value = above / self.diagonal[column];
                // Rows above this one that have this column as well.
                let begin = self.columns.range(column).start;
                let end = filled[column];
                for (&other, l) in self.columns.items()[begin..end].iter().zip(&self.values[begin..end]) {
                    full[other] -= l * above;
                }
                pivot -= value * above;
                parts += (value * above).abs();
                self.values[end] = value;
                filled[column] = end + 1;
            }
            let is_multiplier = unknown + pattern.multipliers >= n;
            let sign = if is_multiplier { -1.0 } else { 1.0 };
            let is_sound = sign * pivot > ROUNDING[usize::from(is_multiplier)] * parts;
            let any = if parts == 0.0 { 1.0 } else { parts };
            self.diagonal[row] = if is_sound { pivot } else { sign * any };
        }
    }

    /// The solution for a right side.
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let n = right.len();
        let mut x: Vec<f64> = self.order.iter().map(|&unknown| right[unknown]).collect();
        let column = |column: usize| {
            let range = self.columns.range(column);
            self.columns.items()[range.clone()].iter().zip(&self.values[range])
        };
        for j in 0..n {
            let here = x[j];
            column(j).for_each(|(&row, value)| x[row] -= value * here);
        }
        for j in (0..n).rev() {
            x[j] = column(j).fold(x[j] / self.diagonal[j], |sum, (&row, value)| sum - value * x[row]);
        }
        let mut solution = vec![0.0; n];
        self.order.iter().zip(x).for_each(|(&unknown, x)| solution[unknown] = x);
        solution
    }
}

/// The unknowns in the order of least degree, by number where it is the same, with those that each is tied to when it is eliminated. A multiplier comes after the unknowns to which
/// it is tied from the beginning.
fn least_degree(pattern: &Pattern) -> (Vec<usize>, Vec<Vec<usize>>) {
    let n = pattern.count;
    let first_multiplier = n - pattern.multipliers;
    let mut near: Vec<Vec<usize>> = vec![Vec::new(); n];
    let mut awaited = vec![0; n];
    // Pairs ascend, so lists do: first come all that have a smaller number.
    for (i, j) in pattern.pairs() {
        near[j].push(i);
        if j >= first_multiplier && i < first_multiplier {
            awaited[j] += 1;
        }
    }
    for (i, j) in pattern.pairs() {
        near[i].push(j);
    }
    let mut tied: Vec<Vec<usize>> = vec![Vec::new(); first_multiplier];
    for multiplier in first_multiplier..n {
        near[multiplier].iter().filter(|&&i| i < first_multiplier).for_each(|&i| tied[i].push(multiplier));
    }
    // What is in the heap with another degree than it has now is left over from before.
    let waiting = |near: &[Vec<usize>], i: usize| Reverse((near[i].len(), i));
    let mut heap: BinaryHeap<_> = (0..n).filter(|&i| awaited[i] == 0).map(|i| waiting(&near, i)).collect();
    let mut is_done = vec![false; n];
    let (mut order, mut below) = (Vec::with_capacity(n), Vec::with_capacity(n));
    while let Some(Reverse((degree, next))) = heap.pop() {
        if is_done[next] || degree != near[next].len() {
            continue;
        }
        is_done[next] = true;
        let neighbours = std::mem::take(&mut near[next]);
        for &i in &neighbours {
            near[i] = union(&near[i], &neighbours, [next, i]);
        }
        for &multiplier in tied.get(next).into_iter().flatten() {
            awaited[multiplier] -= 1;
        }
        heap.extend(neighbours.iter().filter(|&&i| awaited[i] == 0).map(|&i| waiting(&near, i)));
        order.push(next);
        below.push(neighbours);
    }
    (order, below)
}

/// All of two ascending lists, ascending, but for two.
fn union(a: &[usize], b: &[usize], not: [usize; 2]) -> Vec<usize> {
    let mut all = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        all.push(a[i].min(b[j]));
        (i, j) = (i + usize::from(a[i] <= b[j]), j + usize::from(b[j] <= a[i]));
    }
    all.extend_from_slice(&a[i..]);
    all.extend_from_slice(&b[j..]);
    all.retain(|item| !not.contains(item));
    all
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
            let besides: Vec<(usize, usize)> = pattern.pairs().collect();
            for i in 0..n {
                let beside = besides.iter().enumerate().filter(|(_, (a, b))| *a == i || *b == i);
                matrix[i] = beside.map(|(k, _)| matrix[n + k].abs()).sum::<f64>() + 0.5;
            }
            let mut factor = Factor::new(&pattern);
            factor.decompose(&pattern, &matrix);
            let x = factor.solve(&right[..n]);
            for (left, right) in pattern.times(&matrix, &x).iter().zip(&right) {
                prop_assert!((left - right).abs() < 1e-9, "{left} {right}");
            }
        }

        #[test]
        fn the_solution_is_the_least_one_under_equations(
            n in 3..20_usize,
            weights in prop::collection::vec(0.1..10.0_f64, 20),
            equations in prop::collection::vec(prop::collection::vec((0..20_usize, -1.0..1.0_f64), 1..4), 1..3),
            kept in prop::collection::vec(-1.0..1.0_f64, 20),
            twice in any::<bool>(),
        ) {
            // Of x with ½ Σ w x² least where E x is as `kept` has it, w x + Eᵀy is zero.
            let mut equations: Vec<Vec<(usize, f64)>> = equations;
            if twice {
                equations.push(equations[0].clone());
                equations.push(vec![(0, 0.0)]);
            }
            let m = equations.len();
            let terms = || equations.iter().enumerate().flat_map(|(k, terms)| terms.iter().map(move |&(i, f)| (k, i % n, f)));
            let pattern = Pattern::with_multipliers(n + m, m, terms().map(|(k, i, _)| (i, n + k)));
            let mut matrix = vec![0.0; pattern.entries()];
            matrix[..n].copy_from_slice(&weights[..n]);
            terms().for_each(|(k, i, f)| matrix[pattern.entry(i, n + k)] += f);
            let mut right = vec![0.0; n + m];
            terms().for_each(|(k, i, f)| right[n + k] += f * kept[i]);
            let mut factor = Factor::new(&pattern);
            factor.decompose(&pattern, &matrix);
            let x = factor.solve(&right);
            // Equations of nearly nothing, or of nearly the same, have prices of any size.
            prop_assume!(x.iter().all(|x| x.abs() < 1e4));
            for (left, right) in pattern.times(&matrix, &x).iter().zip(&right) {
                prop_assert!((left - right).abs() < 1e-6, "{left} {right}");
            }
        }
    }
}
