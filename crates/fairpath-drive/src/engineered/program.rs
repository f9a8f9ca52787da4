//! A convex quadratic program: costs and rows are put in one by one, the least cost comes out.

use super::{general, interior};
use crate::lists::Lists;

/// The program to make ½ xᵀP x + qᵀx, and what rows cost, least where equations hold.
#[derive(Debug, Default)]
pub(super) struct Program {
    /// q.
    pub(super) linear: Vec<f64>,
    /// Entries of P on and above its diagonal, as row, column and value; what stands at one place is added up.
    pub(super) quadratic: Vec<(usize, usize, f64)>,
    pub(super) equations: Equations,
    /// Sums of unknowns that rows are about.
    pub(super) sums: Lists<(usize, f64)>,
    pub(super) rows: Vec<Row>,
}

/// Sums of unknowns that are equal to values.
#[derive(Debug, Default)]
pub(super) struct Equations {
    pub(super) sums: Lists<(usize, f64)>,
    pub(super) values: Vec<f64>,
}

/// What it costs that a sum is above or below a value; where nothing is told, it must not be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) sum: usize,
    pub(super) value: f64,
    above: Option<Cost>,
    below: Option<Cost>,
}

/// A distance d ≥ 0 costs linear · d + ½ square · d².
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    pub(super) linear: f64,
    pub(super) square: f64,
}

impl Row {
    /// On which sides of its value a sum may be, 1 for above and −1 for below, and what that costs.
    pub(super) fn sides(&self) -> impl Iterator<Item = (f64, Cost)> + use<> {
        self.above.map(|cost| (1.0, cost)).into_iter().chain(self.below.map(|cost| (-1.0, cost)))
    }

    /// The side if there is but one.
    pub(super) fn only_side(&self) -> Option<f64> {
        match (self.above, self.below) {
            (Some(_), None) => Some(1.0),
            (None, Some(_)) => Some(-1.0),
            _ => None,
        }
    }
}

/// What became of a program.
#[derive(Debug)]
pub(super) struct Outcome {
    /// The unknowns.
    pub(super) x: Vec<f64>,
    /// For each equation by how much the least cost falls when its value rises by one.
    pub(super) of_equations: Vec<f64>,
    /// The same for each row.
    pub(super) of_rows: Vec<f64>,
    /// How it ended.
    pub(super) end: End,
    /// The same in words, for who wants to know why there is no solution.
    pub(super) status: String,
    /// How many iterations it took.
    pub(super) iterations: u32,
}

/// How a program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// With its least cost.
    Solved,
    /// Its rows contradict each other.
    Infeasible,
    /// With neither.
    Unsettled,
}

impl Program {
    /// More unknowns; the first of them.
    pub(super) fn unknowns(&mut self, count: usize) -> usize {
        let first = self.linear.len();
        self.linear.resize(first + count, 0.0);
        first
    }

    /// Adds cost · x.
    pub(super) fn cost(&mut self, unknown: usize, cost: f64) {
        self.linear[unknown] += cost;
    }

    /// Adds ½ cost · (terms of x + offset)².
    pub(super) fn square(&mut self, terms: &[(usize, f64)], offset: f64, cost: f64) {
        for (i, &(a, fa)) in terms.iter().enumerate() {
            self.linear[a] += cost * fa * offset;
            self.quadratic.push((a, a, cost * fa * fa));
            for &(b, fb) in &terms[i + 1..] {
                // Only the half above the diagonal is given, where the two of a mixed product are one entry.
                let products = if a == b { 2.0 } else { 1.0 };
                self.quadratic.push((a.min(b), a.max(b), products * cost * fa * fb));
            }
        }
    }

    /// A sum of unknowns that is equal to a value; the equation's number.
    pub(super) fn equal(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, value: f64) -> usize {
        self.equations.values.push(value);
        self.equations.sums.push(terms)
    }

    /// A sum of unknowns that rows are about.
    pub(super) fn sum(&mut self, terms: impl IntoIterator<Item = (usize, f64)>) -> usize {
        self.sums.push(terms)
    }

    /// A sum is at most a value; the row's number.
    pub(super) fn at_most(&mut self, sum: usize, value: f64) -> usize {
        self.row(Row { sum, value, above: None, below: Some(Cost::default()) })
    }

    /// A sum is at least a value; the row's number.
    pub(super) fn at_least(&mut self, sum: usize, value: f64) -> usize {
        self.row(Row { sum, value, above: Some(Cost::default()), below: None })
    }

    /// A sum costs when it is above or below a value. Together the linear costs of both sides are more than nothing.
    pub(super) fn costs(&mut self, sum: usize, value: f64, above: Cost, below: Cost) -> usize {
        self.row(Row { sum, value, above: Some(above), below: Some(below) })
    }

    fn row(&mut self, row: Row) -> usize {
        self.rows.push(row);
        self.rows.len() - 1
    }

    /// The unknowns that cost least, by the method that makes use of how few terms each sum has, and where rounding keeps that from an end by the general one.
    pub(super) fn solve(&self) -> Outcome {
        let outcome = interior::solve(self);
        if outcome.end != End::Unsettled {
            return outcome;
        }
        let other = general::solve(self);
        Outcome { iterations: outcome.iterations + other.iterations, ..other }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Terms = Vec<(usize, f64)>;

    /// A few of so many unknowns, with factors.
    fn terms(count: usize) -> impl Strategy<Value = Terms> {
        prop::collection::vec((0..count, -2.0..2.0_f64), 1..4)
    }

    fn cost(program: &Program, x: &[f64]) -> f64 {
        let linear: f64 = program.linear.iter().zip(x).map(|(q, x)| q * x).sum();
        let square = |&(i, j, value): &(usize, usize, f64)| if i == j { 0.5 } else { 1.0 } * value * x[i] * x[j];
        let sums = program.sums.times(x);
        let of_row = |row: &Row| {
            let off = sums[row.sum] - row.value;
            let side = if off > 0.0 { row.above } else { row.below };
            // Beyond a limit there is nothing but rounding.
            side.map_or(0.0, |side| side.linear * off.abs() + 0.5 * side.square * off * off)
        };
        linear + program.quadratic.iter().map(square).sum::<f64>() + program.rows.iter().map(of_row).sum::<f64>()
    }

    /// Costs of a distance.
    fn costs() -> impl Strategy<Value = [Cost; 2]> {
        let square = || prop::sample::select(vec![0.0, 0.5, 1.5]);
        let costs = (-2.0..2.0_f64, 0.01..2.0_f64, square(), square());
        costs.prop_map(|(linear, more, square, other)| {
            [Cost { linear, square }, Cost { linear: more - linear, square: other }]
        })
    }

    proptest! {
        #[test]
        fn both_methods_come_to_the_same_end(
            linear in prop::collection::vec(-3.0..3.0_f64, 12),
            squares in prop::collection::vec((terms(12), -2.0..2.0_f64, 0.01..3.0_f64), 0..8),
            equal in prop::collection::vec((terms(12), -2.0..2.0_f64), 0..4),
            twice in any::<bool>(),
            at_most in prop::collection::vec((terms(12), -1.0..3.0_f64), 0..16),
            priced in prop::collection::vec((terms(12), -2.0..2.0_f64, costs()), 0..8),
        ) {
            let mut program = Program::default();
            program.unknowns(linear.len());
            for (i, q) in linear.iter().enumerate() {
                program.cost(i, *q);
                // Whatever else there is, the cost has a bound, and the unknowns have too.
                program.square(&[(i, 1.0)], 0.0, 1e-3);
                let sum = program.sum([(i, 1.0)]);
                program.at_most(sum, 100.0);
                program.at_least(sum, -100.0);
            }
            squares.iter().for_each(|(terms, offset, cost)| program.square(terms, *offset, *cost));
            // Equations that say the same twice, or nothing, are no contradiction.
            for (terms, value) in equal.iter().chain(equal.iter().take(usize::from(twice))) {
                program.equal(terms.iter().copied(), *value);
            }
            if twice {
                program.equal([(0, 1.0), (0, -1.0)], 0.0);
            }
            // Of all kinds by turns.
            for k in 0..at_most.len().max(priced.len()) {
                if let Some((terms, value, [above, below])) = priced.get(k) {
                    let sum = program.sum(terms.iter().copied());
                    program.costs(sum, *value, *above, *below);
                }
                if let Some((terms, value)) = at_most.get(k) {
                    let sum = program.sum(terms.iter().copied());
                    if k % 2 == 0 { program.at_most(sum, *value) } else { program.at_least(sum, -value) };
                }
            }
            let (own, other) = (interior::solve(&program), general::solve(&program));
            // Of equations that contradict each other either method may not know it.
            let is_contradiction = [own.end, other.end].contains(&End::Infeasible);
            let is_left = [own.end, other.end].contains(&End::Unsettled) && is_contradiction && !equal.is_empty();
            prop_assert!(own.end == other.end || is_left, "{own:?} {other:?}");
            if own.end == End::Infeasible {
                // Whatever keeps the rows keeps their sum by prices too, which is less than nothing, and no unknown makes as much of what it has there.
                let (mut sum, mut worth) = (vec![0.0; linear.len()], 0.0);
                program.equations.sums.add_transposed(&own.of_equations, &mut sum);
                worth += program.equations.values.iter().zip(&own.of_equations).map(|(e, y)| e * y).sum::<f64>();
                for (row, price) in program.rows.iter().zip(&own.of_rows) {
                    let price = match row.only_side() {
                        Some(sign) if sign * price < 0.0 => *price,
                        _ => 0.0,
                    };
                    program.sums.of(row.sum).iter().for_each(|&(i, factor)| sum[i] += factor * price);
                    worth += row.value * price;
                }
                prop_assert!(worth + 100.0 * sum.iter().map(|x| x.abs()).sum::<f64>() < 0.0);
            }
            if own.end == End::Solved {
                let [a, b] = [&own, &other].map(|outcome| cost(&program, &outcome.x));
                prop_assert!((a - b).abs() <= 1e-6 * a.abs().max(1.0), "{a} {b}");
                let sums = program.sums.times(&own.x);
                for (row, price) in program.rows.iter().zip(&own.of_rows) {
                    let off = sums[row.sum] - row.value;
                    // What a little more room in a row saves: the slope of its cost where there is one.
                    let slope = |side: Option<Cost>, d: f64| side.map_or(f64::INFINITY, |side| side.linear + side.square * d);
                    let [from, to] = if off > 1e-4 {
                        [slope(row.above, off); 2]
                    } else if off < -1e-4 {
                        [-slope(row.below, -off); 2]
                    } else {
                        [-slope(row.below, 0.0), slope(row.above, 0.0)]
                    };
                    // What is off is so little that the least cost is off by little.
                    let wrong = (from - price).max(price - to).max(0.0);
                    prop_assert!(wrong <= 1e-2 || wrong * off.abs() <= 1e-4, "{off} {price} {from} {to}");
                    prop_assert!((off <= 1e-6 || row.above.is_some()) && (off >= -1e-6 || row.below.is_some()));
                }
                for (sum, value) in program.equations.sums.times(&own.x).iter().zip(&program.equations.values) {
                    prop_assert!((sum - value).abs() <= 1e-6);
                }
                let mut off = program.linear.clone();
                for &(i, j, value) in &program.quadratic {
                    off[i] += value * own.x[j];
                    off[j] += if i == j { 0.0 } else { value * own.x[i] };
                }
                program.equations.sums.add_transposed(&own.of_equations, &mut off);
                for (row, price) in program.rows.iter().zip(&own.of_rows) {
                    program.sums.of(row.sum).iter().for_each(|&(i, factor)| off[i] += factor * price);
                }
                prop_assert!(off.iter().all(|off| off.abs() < 1e-5), "{off:?}");
            }
        }
    }
}
