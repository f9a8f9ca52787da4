//! A program as the steps of the method see it.

use super::vectors::{Of, add, dot, size};
use crate::engineered::program::{Cost, Program};
use crate::lists::Lists;
use crate::sparse::Pattern;

/// A program with its matrices in the form in which they are used.
pub(super) struct System<'a> {
    pub(super) program: &'a Program,
    /// What the costs are divided by, so that the greatest of them is one.
    pub(super) cost_unit: f64,
    pub(super) linear: Vec<f64>,
    /// P, with its own pattern.
    pub(super) quadratic: (Pattern, Vec<f64>),
    /// The rows in the order in which they stand here: first those that have but one side, then those that have both.
    pub(super) order: Vec<usize>,
    /// How many have but one.
    pub(super) singles: usize,
    /// The sum of each row.
    pub(super) sums: Vec<usize>,
    /// 1 where a row's side is above, −1 where it is below. What is told of sides is told of one of each row, above where it has both; then come those below of these.
    pub(super) signs: Vec<f64>,
    /// Of the system: P and what sums add to it, then E.
    pub(super) pattern: Pattern,
    /// P and E in that pattern.
    pub(super) given: Vec<f64>,
    /// For each unknown the sums in which it is, with its factors.
    pub(super) by_unknown: Lists<(usize, f64)>,
    /// For each entry the sums that add to it, with the products of two of their terms.
    pub(super) by_entry: Lists<(usize, f64)>,
    /// The values of rows, and p of their sides.
    pub(super) values: Vec<f64>,
    pub(super) prices: Vec<f64>,
    /// c of sides.
    pub(super) squares: Vec<f64>,
    /// The size of the greatest value of equations, and of rows.
    pub(super) greatest: [f64; 2],
}

impl<'a> System<'a> {
    pub(super) fn new(program: &'a Program) -> Self {
        let Program { linear, quadratic, equations, sums, rows } = program;
        let (singles, pairs): (Vec<usize>, Vec<usize>) =
            (0..rows.len()).partition(|&row| rows[row].only_side().is_some());
        let order: Vec<usize> = singles.iter().chain(&pairs).copied().collect();
        let first = order.iter().filter_map(|&row| rows[row].sides().next());
        let sides: Vec<(f64, Cost)> = first.chain(pairs.iter().filter_map(|&row| rows[row].sides().nth(1))).collect();
        let of_sides = sides.iter().flat_map(|(_, cost)| [cost.linear, cost.square]);
        let costs = quadratic.iter().map(|(_, _, value)| *value).chain(linear.iter().copied()).chain(of_sides);
        let greatest = costs.fold(0.0, |most: f64, cost| most.max(cost.abs()));
        let cost_unit = if greatest > 0.0 { greatest } else { 1.0 };
        let prices: Vec<f64> = sides.iter().map(|(_, cost)| cost.linear / cost_unit).collect();
        let of_sides: Vec<f64> = sides.iter().map(|(_, cost)| cost.square / cost_unit).collect();
        let count = linear.len();
        let squares = Pattern::new(count, quadratic.iter().map(|&(i, j, _)| (i, j)));
        let mut of_squares = vec![0.0; squares.entries()];
        quadratic.iter().for_each(|&(i, j, value)| of_squares[squares.entry(i, j)] += value / cost_unit);
        let priced = || {
            let ties = equations.sums.iter().enumerate();
            ties.flat_map(move |(row, terms)| terms.iter().map(move |&(i, factor)| ((i, count + row), factor)))
        };
        let together = sums.iter().flat_map(|terms| {
            terms.iter().enumerate().flat_map(move |(k, &(i, _))| terms[k..].iter().map(move |&(j, _)| (i, j)))
        });
        let ties = squares.pairs().chain(priced().map(|(pair, _)| pair)).chain(together);
        let multipliers = equations.values.len();
        let pattern = Pattern::with_multipliers(count + multipliers, multipliers, ties);
        let mut given = vec![0.0; pattern.entries()];
        given[..count].copy_from_slice(&of_squares[..count]);
        squares.pairs().zip(&of_squares[count..]).for_each(|((i, j), value)| given[pattern.entry(i, j)] = *value);
        priced().for_each(|((i, j), factor)| given[pattern.entry(i, j)] += factor);
        let product = |terms: &[(usize, f64)], k: usize, l: usize| {
            let ((i, a), (j, b)) = (terms[k], terms[l]);
            let twice = if i == j && k != l { 2.0 } else { 1.0 };
            (pattern.entry(i, j), twice * a * b)
        };
        let mut products = Lists::default();
        for terms in sums.iter() {
            let pairs = (0..terms.len()).flat_map(|k| (k..terms.len()).map(move |l| (k, l)));
            products.push(pairs.map(|(k, l)| product(terms, k, l)));
        }
        let values: Vec<f64> = order.iter().map(|&row| rows[row].value).collect();
        let linear: Vec<f64> = linear.iter().map(|cost| cost / cost_unit).collect();
        Self {
            program,
            cost_unit,
            quadratic: (squares, of_squares),
            by_unknown: sums.transposed(count),
            by_entry: products.transposed(pattern.entries()),
            pattern,
            given,
            greatest: [size(&equations.values), size(&values)],
            linear,
            values,
            sums: order.iter().map(|&row| rows[row].sum).collect(),
            signs: sides[..rows.len()].iter().map(|(sign, _)| *sign).collect(),
            singles: singles.len(),
            order,
            prices,
            squares: of_sides,
        }
    }

    /// What τ is multiplied with on the right side of the equations; of sides it is −p, of which the softness is yet to come.
    pub(super) fn of_tau(&self) -> Of {
        Of {
            x: self.linear.iter().map(|q| -q).collect(),
            y: self.program.equations.values.clone(),
            w: self.values.clone(),
            s: self.prices.iter().map(|price| -price).collect(),
        }
    }

    /// Numbers of rows in the program's order.
    pub(super) fn in_order(&self, of_rows: &[f64]) -> Vec<f64> {
        let mut numbers = vec![0.0; of_rows.len()];
        self.order.iter().zip(of_rows).for_each(|(&row, number)| numbers[row] = *number);
        numbers
    }

    /// P x.
    pub(super) fn quadratic_times(&self, x: &[f64]) -> Vec<f64> {
        let (pattern, values) = &self.quadratic;
        pattern.times(values, x)
    }

    /// F x.
    pub(super) fn rows_times(&self, x: &[f64]) -> Vec<f64> {
        let sums = self.program.sums.times(x);
        self.sums.iter().map(|&sum| sums[sum]).collect()
    }

    /// Adds Fᵀ w.
    pub(super) fn add_rows(&self, w: &[f64], x: &mut [f64]) {
        // Unknown by unknown, since what is added to one waits for what was added before.
        add(1.0, &self.by_unknown.times(&self.by_sum(w)), x);
    }

    /// For each sum what its rows have together.
    pub(super) fn by_sum(&self, of_rows: &[f64]) -> Vec<f64> {
        let mut by_sum = vec![0.0; self.program.sums.count()];
        self.sums.iter().zip(of_rows).for_each(|(&sum, number)| by_sum[sum] += number);
        by_sum
    }

    /// Adds for each row how far it is above its value, if this is how far it is on its sides.
    pub(super) fn add_above(&self, s: &[f64], rows: &mut [f64]) {
        let (first, below) = s.split_at(rows.len());
        rows.iter_mut().zip(&self.signs).zip(first).for_each(|((row, sign), s)| *row += sign * s);
        add(-1.0, below, &mut rows[self.singles..]);
    }

    /// What is left of right.x and right.y. Of the others nothing is, since w and s are told by them.
    pub(super) fn left(&self, solution: &Of, right: &Of) -> Vec<f64> {
        let mut left = self.priced(solution);
        left.iter_mut().zip(&right.x).for_each(|(sum, right)| *sum = right - *sum);
        left.extend(
            self.program.equations.sums.times(&solution.x).iter().zip(&right.y).map(|(sum, right)| right - sum),
        );
        left
    }

    /// P x + Eᵀy + Fᵀw.
    pub(super) fn priced(&self, of: &Of) -> Vec<f64> {
        let mut sum = self.quadratic_times(&of.x);
        self.program.equations.sums.add_transposed(&of.y, &mut sum);
        self.add_rows(&of.w, &mut sum);
        sum
    }

    /// eᵀy + aᵀw.
    pub(super) fn worth(&self, of: &Of) -> f64 {
        dot(&self.program.equations.values, &of.y) + dot(&self.values, &of.w)
    }

    /// qᵀx + Σ p s.
    pub(super) fn cost(&self, of: &Of) -> f64 {
        dot(&self.linear, &of.x) + dot(&self.prices, &of.s)
    }
}
