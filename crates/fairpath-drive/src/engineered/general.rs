//! A convex quadratic program comes in, what Clarabel makes of it goes out.
//!
//! Clarabel knows nothing of how a program is made up, and refines its systems until rounding ends it: it takes many times as long as [`interior`](super::interior).

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
    let Program { linear, quadratic, equations, sums, rows } = program;
    let (unknowns, equal) = (linear.len(), equations.values.len());
    // Unknowns of Clarabel's are also how far each row is above and below its value, which are at least nothing.
    let sides = || rows.iter().enumerate().flat_map(|(row, sides)| sides.sides().map(move |side| (row, side)));
    let count = unknowns + sides().count();
    let mut costs = linear.clone();
    costs.extend(sides().map(|(_, (_, cost))| cost.linear));
    let squares = sides().zip(unknowns..).map(|((_, (_, cost)), unknown)| (unknown, unknown, cost.square));
    let (i, (j, values)): Triplets =
        quadratic.iter().copied().chain(squares).map(|(i, j, value)| (i, (j, value))).unzip();
    let quadratic = CscMatrix::new_from_triplets(count, count, i, j, values);
    let all = equations.sums.iter().chain(rows.iter().map(|row| sums.of(row.sum)));
    let terms = all.enumerate().flat_map(|(row, terms)| terms.iter().map(move |term| (row, *term)));
    let off = sides().zip(unknowns..).map(|((row, (sign, _)), unknown)| (equal + row, (unknown, -sign)));
    let not_negative = (unknowns..count).map(|unknown| (equal + rows.len() + unknown - unknowns, (unknown, -1.0)));
    let (i, (j, values)): Triplets = terms.chain(off).chain(not_negative).unzip();
    let mut limits = equations.values.clone();
    limits.extend(rows.iter().map(|row| row.value));
    limits.resize(equal + rows.len() + count - unknowns, 0.0);
    let matrix = CscMatrix::new_from_triplets(limits.len(), count, i, j, values);
    let cones = [ZeroConeT(equal + rows.len()), NonnegativeConeT(count - unknowns)];
    match DefaultSolver::new(&quadratic, &costs, &matrix, &limits, &cones, settings()) {
        Ok(mut solver) => {
            solver.solve();
            let solution = solver.solution;
            let end = match solution.status {
                SolverStatus::Solved | SolverStatus::AlmostSolved => End::Solved,
                SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => End::Infeasible,
                _ => End::Unsettled,
            };
            let (of_equations, others) = solution.z.split_at(equal);
            Outcome {
                end,
                x: solution.x[..unknowns].to_vec(),
                of_equations: of_equations.to_vec(),
                of_rows: others[..rows.len()].to_vec(),
                status: solution.status.to_string(),
                iterations: solution.iterations,
            }
        }
        Err(error) => Outcome {
            x: vec![0.0; unknowns],
            of_equations: vec![0.0; equal],
            of_rows: vec![0.0; rows.len()],
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
