//! A convex quadratic program: costs and rows are put in one by one, the least cost comes out.

use super::{general, interior};

/// The program to make ½ xᵀP x + qᵀx least where rows of x are equal to, or at most, given values.
#[derive(Debug, Default)]
pub(super) struct Program {
    /// q.
    pub(super) linear: Vec<f64>,
    /// Entries of P on and above its diagonal, as row, column and value; what stands at one place is added up.
    pub(super) quadratic: Vec<(usize, usize, f64)>,
    pub(super) equal: Rows,
    pub(super) at_most: Rows,
}

/// Rows with few terms each, and their values.
#[derive(Debug, Default)]
pub(super) struct Rows {
    ends: Vec<usize>,
    terms: Vec<(usize, f64)>,
    pub(super) values: Vec<f64>,
}

impl Rows {
    fn push(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, value: f64) -> usize {
        self.terms.extend(terms);
        self.ends.push(self.terms.len());
        self.values.push(value);
        self.values.len() - 1
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.values.len()
    }

    /// The unknowns of a row with their factors; an unknown may come more than once.
    pub(super) fn terms(&self, row: usize) -> &[(usize, f64)] {
        let begin = row.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.terms[begin..self.ends[row]]
    }

    /// Each row's sum for these unknowns.
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut begin = 0;
        let sum = |&end: &usize| {
            let terms = &self.terms[begin..end];
            begin = end;
            terms.iter().fold(0.0, |sum, &(unknown, factor)| sum + factor * x[unknown])
        };
        self.ends.iter().map(sum).collect()
    }

    /// Adds each row, times its number, to unknowns.
    pub(super) fn add_transposed(&self, numbers: &[f64], x: &mut [f64]) {
        let mut begin = 0;
        for (&end, number) in self.ends.iter().zip(numbers) {
            self.terms[begin..end].iter().for_each(|&(unknown, factor)| x[unknown] += factor * number);
            begin = end;
        }
    }
}

/// What became of a program.
#[derive(Debug)]
pub(super) struct Outcome {
    /// The unknowns.
    pub(super) x: Vec<f64>,
    /// For each equation by how much the least cost falls when its value rises by one.
    pub(super) equal: Vec<f64>,
    /// The same for each row that is at most its value.
    pub(super) at_most: Vec<f64>,
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

    /// A row that is equal to a value.
    pub(super) fn equal(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, value: f64) -> usize {
        self.equal.push(terms, value)
    }

    /// A row that is at most a value.
    pub(super) fn at_most(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, value: f64) -> usize {
        self.at_most.push(terms, value)
    }

    /// The unknowns that cost least, by the method that makes use of how few terms each row has, and where rounding keeps that from an end by the general one.
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
        linear + program.quadratic.iter().map(square).sum::<f64>()
    }

    proptest! {
        #[test]
        fn both_methods_come_to_the_same_end(
            linear in prop::collection::vec(-3.0..3.0_f64, 12),
            squares in prop::collection::vec((terms(12), -2.0..2.0_f64, 0.01..3.0_f64), 0..8),
            equal in prop::collection::vec((terms(12), -2.0..2.0_f64), 0..4),
            twice in any::<bool>(),
            at_most in prop::collection::vec((terms(12), -1.0..3.0_f64), 0..16),
        ) {
            let mut program = Program::default();
            program.unknowns(linear.len());
            for (i, q) in linear.iter().enumerate() {
                program.cost(i, *q);
                // Whatever else there is, the cost has a bound, and the unknowns have too.
                program.square(&[(i, 1.0)], 0.0, 1e-3);
                program.at_most([(i, 1.0)], 100.0);
                program.at_most([(i, -1.0)], 100.0);
            }
            squares.iter().for_each(|(terms, offset, cost)| program.square(terms, *offset, *cost));
            // Equations that say the same twice, or nothing, are no contradiction.
            for (terms, value) in equal.iter().chain(equal.iter().take(usize::from(twice))) {
                program.equal(terms.iter().copied(), *value);
            }
            if twice {
                program.equal([(0, 1.0), (0, -1.0)], 0.0);
            }
            at_most.iter().for_each(|(terms, value)| { program.at_most(terms.iter().copied(), *value); });
            let (own, other) = (interior::solve(&program), general::solve(&program));
            // Equations that contradict each other may be left to the other one.
            let is_left = own.end == End::Unsettled && other.end == End::Infeasible && !equal.is_empty();
            prop_assert!(own.end == other.end || is_left, "{own:?} {other:?}");
            if own.end == End::Solved {
                let [a, b] = [&own, &other].map(|outcome| cost(&program, &outcome.x));
                prop_assert!((a - b).abs() <= 1e-6 * a.abs().max(1.0), "{a} {b}");
                for (sum, value) in program.at_most.times(&own.x).iter().zip(&program.at_most.values) {
                    prop_assert!(sum - value <= 1e-6);
                }
                for (sum, value) in program.equal.times(&own.x).iter().zip(&program.equal.values) {
                    prop_assert!((sum - value).abs() <= 1e-6);
                }
                // Prices: what a little more room in a row saves.
                let gradient = |x: &[f64]| {
                    let mut sum = program.linear.clone();
                    for &(i, j, value) in &program.quadratic {
                        sum[i] += value * x[j];
                        sum[j] += if i == j { 0.0 } else { value * x[i] };
                    }
                    sum
                };
                let mut off = gradient(&own.x);
                program.equal.add_transposed(&own.equal, &mut off);
                program.at_most.add_transposed(&own.at_most, &mut off);
                prop_assert!(off.iter().all(|off| off.abs() < 1e-5), "{off:?}");
                prop_assert!(own.at_most.iter().all(|price| *price >= 0.0));
            }
        }
    }
}
