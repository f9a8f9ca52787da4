//! A convex quadratic program: costs and rows are put in one by one, the least cost comes out.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT};

/// How near the solver comes to the least cost and to the limits, as shares of their size.
const TOLERANCE: f64 = 1e-9;

/// How near it must come to be of any use, where rounding keeps it from coming nearer.
const REDUCED_TOLERANCE: f64 = 1e-6;

/// Most iterations; there are about twenty.
const MOST_ITERATIONS: u32 = 200;

/// The program to make ½ xᵀP x + qᵀx least where rows of x are equal to, or at most, given values.
#[derive(Debug, Default)]
pub(super) struct Program {
    linear: Vec<f64>,
    quadratic: Triplets,
    equal: Rows,
    at_most: Rows,
}

#[derive(Debug, Default)]
struct Triplets {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl Triplets {
    fn push(&mut self, row: usize, column: usize, value: f64) {
        self.rows.push(row);
        self.columns.push(column);
        self.values.push(value);
    }
}

#[derive(Debug, Default)]
struct Rows {
    entries: Triplets,
    values: Vec<f64>,
}

impl Rows {
    fn push(&mut self, terms: impl IntoIterator<Item = (usize, f64)>, value: f64) -> usize {
        let row = self.values.len();
        terms.into_iter().for_each(|(unknown, factor)| self.entries.push(row, unknown, factor));
        self.values.push(value);
        row
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
    /// What the solver calls that.
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
            self.quadratic.push(a, a, cost * fa * fa);
            for &(b, fb) in &terms[i + 1..] {
                // Only the half above the diagonal is given, where the two of a mixed product are one entry.
                let products = if a == b { 2.0 } else { 1.0 };
                self.quadratic.push(a.min(b), a.max(b), products * cost * fa * fb);
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

    /// The unknowns that cost least.
    pub(super) fn solve(self) -> Outcome {
        let count = self.linear.len();
        let Triplets { rows, columns, values } = self.quadratic;
        let quadratic = CscMatrix::new_from_triplets(count, count, rows, columns, values);
        let equations = self.equal.values.len();
        let Triplets { mut rows, mut columns, mut values } = self.equal.entries;
        rows.extend(self.at_most.entries.rows.iter().map(|row| equations + row));
        columns.extend(self.at_most.entries.columns);
        values.extend(self.at_most.entries.values);
        let mut limits = self.equal.values;
        limits.extend(self.at_most.values);
        let matrix = CscMatrix::new_from_triplets(limits.len(), count, rows, columns, values);
        let cones = [ZeroConeT(equations), NonnegativeConeT(limits.len() - equations)];
        match DefaultSolver::new(&quadratic, &self.linear, &matrix, &limits, &cones, settings()) {
            Ok(mut solver) => {
                solver.solve();
                let solution = solver.solution;
                let end = match solution.status {
                    SolverStatus::Solved | SolverStatus::AlmostSolved => End::Solved,
                    SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => End::Infeasible,
                    _ => End::Unsettled,
                };
                let (equal, at_most) = solution.z.split_at(equations);
                Outcome {
                    end,
                    equal: equal.to_vec(),
                    at_most: at_most.to_vec(),
                    status: solution.status.to_string(),
                    iterations: solution.iterations,
                    x: solution.x,
                }
            }
            Err(error) => Outcome {
                x: vec![0.0; count],
                equal: vec![0.0; equations],
                at_most: vec![0.0; limits.len() - equations],
                end: End::Unsettled,
                status: error.to_string(),
                iterations: 0,
            },
        }
    }
}

/// The solver's own, but for what this file names. No limit of time is set, so what its clock tells changes nothing.
fn settings() -> DefaultSettings<f64> {
    DefaultSettings {
        verbose: false,
        max_iter: MOST_ITERATIONS,
        time_limit: f64::INFINITY,
        tol_gap_abs: TOLERANCE,
        tol_gap_rel: TOLERANCE,
        tol_feas: TOLERANCE,
        reduced_tol_gap_abs: REDUCED_TOLERANCE,
        reduced_tol_gap_rel: REDUCED_TOLERANCE,
        reduced_tol_feas: REDUCED_TOLERANCE,
        direct_solve_method: "qdldl".to_owned(),
        max_threads: 1,
        ..DefaultSettings::default()
    }
}
