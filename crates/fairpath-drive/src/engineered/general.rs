//! A convex quadratic program comes in, what Clarabel makes of it goes out.
//!
//! Clarabel knows nothing of how a program is made up, takes about four times as long as [`interior`](super::interior), and refines its systems until rounding ends it.

use super::program::{End, Outcome, Program};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT};

/// How near the least cost and the limits a solution is, as shares of their size.
const TOLERANCE: f64 = 1e-9;

/// How near it must come to be of any use, where rounding keeps it from coming nearer.
const REDUCED_TOLERANCE: f64 = 1e-6;

/// Most iterations; there are about twenty.
const MOST_ITERATIONS: u32 = 200;

/// Rows, columns and values of entries.
type Triplets = (Vec<usize>, (Vec<usize>, Vec<f64>));

/// The unknowns that cost least.
pub(super) fn solve(program: &Program) -> Outcome {
    let Program { linear, quadratic, equal, at_most } = program;
    let count = linear.len();
    let (rows, (columns, values)): Triplets = quadratic.iter().map(|&(i, j, value)| (i, (j, value))).unzip();
    let quadratic = CscMatrix::new_from_triplets(count, count, rows, columns, values);
    let all =
        || (0..equal.count()).map(|row| equal.terms(row)).chain((0..at_most.count()).map(|row| at_most.terms(row)));
    let entries = all().enumerate().flat_map(|(row, terms)| terms.iter().map(move |term| (row, *term)));
    let (rows, (columns, values)): Triplets = entries.unzip();
    let limits: Vec<f64> = equal.values.iter().chain(&at_most.values).copied().collect();
    let matrix = CscMatrix::new_from_triplets(limits.len(), count, rows, columns, values);
    let cones = [ZeroConeT(equal.count()), NonnegativeConeT(at_most.count())];
    match DefaultSolver::new(&quadratic, linear, &matrix, &limits, &cones, settings()) {
        Ok(mut solver) => {
            solver.solve();
            let solution = solver.solution;
            let end = match solution.status {
                SolverStatus::Solved | SolverStatus::AlmostSolved => End::Solved,
                SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => End::Infeasible,
                _ => End::Unsettled,
            };
            let (of_equal, of_at_most) = solution.z.split_at(equal.count());
            Outcome {
                end,
                equal: of_equal.to_vec(),
                at_most: of_at_most.to_vec(),
                status: solution.status.to_string(),
                iterations: solution.iterations,
                x: solution.x,
            }
        }
        Err(error) => Outcome {
            x: vec![0.0; count],
            equal: vec![0.0; equal.count()],
            at_most: vec![0.0; at_most.count()],
            end: End::Unsettled,
            status: error.to_string(),
            iterations: 0,
        },
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
