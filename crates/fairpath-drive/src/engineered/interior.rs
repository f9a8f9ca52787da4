//! A convex quadratic program comes in, its least cost goes out, by the primal-dual interior-point method with homogeneous embedding of Goulart and Chen (*Clarabel: An
//! interior-point solver for conic programs with quadratic objectives*, 2024, sections 2 to 4), for rows that are equal to, or at most, a value.
//!
//! With slacks s ≥ 0 and prices y and z ≥ 0 of the two kinds of rows, what is sought is a point of
//!
//! > P x + Eᵀy + Aᵀz + q τ = 0,  E x = e τ,  A x + s = b τ,  κ + xᵀP x / τ + qᵀx + eᵀy + bᵀz = 0,  sᵢ zᵢ = 0,  τ κ = 0.
//!
//! Where τ > 0 the least cost is at x / τ; where κ > 0 the prices prove that the rows contradict each other. Steps follow Mehrotra's predictor and corrector.
//!
//! What makes it quick is the system that is solved in each step. Rows that are at most a value are eliminated first, each by itself: what is left is P + Aᵀ diag(z / s) A, in which
//! an unknown is tied to those only with which it has a row in common. For roads that is a band of two beside the diagonal, once each cell's fill is eliminated, and what crossings
//! add. But for these a step takes time proportional to the number of unknowns.

use super::program::{End, Outcome, Program};
use crate::sparse::{Factor, Pattern};

/// How near the least cost and the values of rows a solution is, as a share of their size.
const NEAR: f64 = 1e-10;

/// Most steps; there are about twenty.
const MOST_STEPS: u32 = 100;

/// What keeps rows so and is as near as this to the least cost is taken where so many steps did not come nearer, which is rounding's doing.
const ROUNDED: f64 = 1e-7;
const FARTHER: u32 = 2;

/// Rows contradict each other when prices prove that whatever keeps them has an unknown greater than one over this: a height a thousand kilometres off the ground, or a limit that is exceeded a million times.
const PROVED: f64 = 1e-6;

/// What the square of the distance of a row from its value costs, in greatest costs, where the first point is looked for. Ten times more or less makes a step or two more.
const FIRST_WEIGHT: f64 = 100.0;

/// How much of the way to the nearest bound a step goes.
const NEARLY: f64 = 0.99;

/// A program is given up when this many steps one after the other went less than [`SHORT`] of their way.
const SHORT_STEPS: u32 = 5;
const SHORT: f64 = 1e-3;

/// Directions are corrected until they are off prices and equations by this little, as long as that helps, and no more often.
const CORRECTED: f64 = 1e-12;
const CORRECTIONS: usize = 10;

/// The unknowns that cost least.
pub(super) fn solve(program: &Program) -> Outcome {
    let mut system = System::new(program);
    let mut point = Point::first(&mut system);
    let (mut best, mut nearest, mut farther) = (point.clone(), f64::INFINITY, 0);
    let (mut steps, mut short) = (0, 0);
    let end = loop {
        let off = point.off(&system);
        match off.distance(&system, &point) {
            Some(near) if near < nearest => (best, nearest, farther) = (point.clone(), near, 0),
            _ => farther += 1,
        }
        if nearest <= NEAR || (nearest <= ROUNDED && farther == FARTHER) {
            break End::Solved;
        }
        if point.is_contradiction(&system) {
            break End::Infeasible;
        }
        if steps == MOST_STEPS || short == SHORT_STEPS {
            break End::Unsettled;
        }
        steps += 1;
        let Some(share) = point.go_on(&mut system, &off) else { break End::Unsettled };
        short = if share < SHORT { short + 1 } else { 0 };
    };
    let status = match end {
        End::Solved => "solved",
        End::Infeasible => "the rows contradict each other",
        End::Unsettled => "neither solved nor proved to contradict itself",
    };
    let all = |numbers: Vec<f64>, factor: f64| numbers.into_iter().map(|number| number * factor).collect::<Vec<_>>();
    let point = if end == End::Solved { best } else { point };
    let unit = 1.0 / point.tau;
    let Of { x, y, z } = point.at;
    Outcome {
        x: all(x, unit),
        equal: all(y, unit * system.cost_unit),
        at_most: all(z, unit * system.cost_unit),
        end,
        status: status.to_owned(),
        iterations: steps,
    }
}

/// A number for each unknown, for each equation, and for each row that is at most a value.
#[derive(Clone, Debug)]
struct Of {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
}

impl Of {
    /// Of two of them a sum with a factor.
    fn plus(&self, factor: f64, other: &Self) -> Self {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + factor * b).collect();
        Self { x: sum(&self.x, &other.x), y: sum(&self.y, &other.y), z: sum(&self.z, &other.z) }
    }

    /// The greatest size of a number.
    fn size(&self) -> f64 {
        size(&[size(&self.x), size(&self.y), size(&self.z)])
    }
}

fn size(numbers: &[f64]) -> f64 {
    // Not `max`, which would leave a NaN out.
    let greater = |most: f64, number: &f64| if number.abs() <= most || most.is_nan() { most } else { number.abs() };
    numbers.iter().fold(0.0, greater)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A program with its matrices in the form in which they are used, and the factorisation of a step's system.
struct System<'a> {
    program: &'a Program,
    /// What the costs are divided by, so that the greatest of them is one.
    cost_unit: f64,
    linear: Vec<f64>,
    /// P, with its own pattern.
    quadratic: (Pattern, Vec<f64>),
    /// Of the system: P and what rows add to it, then E.
    pattern: Pattern,
    /// P and E in that pattern.
    given: Vec<f64>,
    /// For each product of two terms of a row that is at most a value the entry to which it belongs, row by row up to its end.
    products: Vec<(usize, f64)>,
    ends: Vec<usize>,
    factor: Factor,
    /// z / s of each row.
    weights: Vec<f64>,
}

impl<'a> System<'a> {
    fn new(program: &'a Program) -> Self {
        let Program { linear, quadratic, equal, at_most } = program;
        let costs = size(linear).max(quadratic.iter().fold(0.0, |most, (_, _, value)| most.max(value.abs())));
        let cost_unit = if costs > 0.0 { costs } else { 1.0 };
        let count = linear.len();
        let squares = Pattern::new(count, quadratic.iter().map(|&(i, j, _)| (i, j)));
        let mut of_squares = vec![0.0; squares.entries()];
        quadratic.iter().for_each(|&(i, j, value)| of_squares[squares.entry(i, j)] += value / cost_unit);
        let prices = (0..equal.count()).flat_map(|row| equal.terms(row).iter().map(move |&(i, _)| (i, count + row)));
        let rows = (0..at_most.count()).flat_map(|row| {
            let terms = at_most.terms(row);
            terms.iter().enumerate().flat_map(move |(k, &(i, _))| terms[k..].iter().map(move |&(j, _)| (i, j)))
        });
        let ties = squares.pairs().chain(prices).chain(rows);
        let pattern = Pattern::with_multipliers(count + equal.count(), equal.count(), ties);
        let mut given = vec![0.0; pattern.entries()];
        given[..count].copy_from_slice(&of_squares[..count]);
        squares.pairs().zip(&of_squares[count..]).for_each(|((i, j), value)| given[pattern.entry(i, j)] = *value);
        for row in 0..equal.count() {
            equal.terms(row).iter().for_each(|&(i, factor)| given[pattern.entry(i, count + row)] += factor);
        }
        let (mut products, mut ends) = (Vec::new(), Vec::new());
        for row in 0..at_most.count() {
            let terms = at_most.terms(row);
            for (k, &(i, a)) in terms.iter().enumerate() {
                for (l, &(j, b)) in terms.iter().enumerate().skip(k) {
                    let twice = if i == j && k != l { 2.0 } else { 1.0 };
                    products.push((pattern.entry(i, j), twice * a * b));
                }
            }
            ends.push(products.len());
        }
        let factor = Factor::new(&pattern);
        let linear = linear.iter().map(|cost| cost / cost_unit).collect();
        let weights = vec![1.0; at_most.count()];
        let quadratic = (squares, of_squares);
        Self { program, cost_unit, linear, quadratic, pattern, given, products, ends, factor, weights }
    }

    /// What τ is multiplied with on the right side of the equations: −q, e and b.
    fn of_tau(&self) -> Of {
        let Program { equal, at_most, .. } = self.program;
        Of { x: self.linear.iter().map(|q| -q).collect(), y: equal.values.clone(), z: at_most.values.clone() }
    }

    /// P x.
    fn quadratic_times(&self, x: &[f64]) -> Vec<f64> {
        let (pattern, values) = &self.quadratic;
        pattern.times(values, x)
    }

    /// Takes the weights of rows and factorises with them.
    fn weigh(&mut self, weights: Vec<f64>) {
        let mut matrix = self.given.clone();
        let mut begin = 0;
        for (weight, &end) in weights.iter().zip(&self.ends) {
            self.products[begin..end].iter().for_each(|&(entry, product)| matrix[entry] += weight * product);
            begin = end;
        }
        self.factor.decompose(&self.pattern, &matrix);
        self.weights = weights;
    }

    /// The solution of P x + Eᵀy + Aᵀz = right.x, E x = right.y, A x − z / weights = right.z, but for rounding.
    fn solve(&self, right: &Of) -> Of {
        let at_most = &self.program.at_most;
        // With z = weights · (A x − right.z) the first is (P + Aᵀ diag(weights) A) x + Eᵀy = right.x + Aᵀ (weights · right.z).
        let weighted: Vec<f64> = right.z.iter().zip(&self.weights).map(|(right, weight)| right * weight).collect();
        let mut sum = right.x.clone();
        at_most.add_transposed(&weighted, &mut sum);
        sum.extend_from_slice(&right.y);
        let (x, y, mut z) = self.solve_first(&sum);
        z.iter_mut().zip(&weighted).for_each(|(z, weighted)| *z -= weighted);
        Of { x, y, z }
    }

    /// Makes a solution nearer to what [`System::solve`] says.
    fn correct(&self, solution: &mut Of, right: &Of) {
        let mut left = self.left(solution, right);
        for _ in 0..CORRECTIONS {
            let before = size(&left);
            if before <= CORRECTED {
                return;
            }
            let (x, y, z) = self.solve_first(&left);
            let next = solution.plus(1.0, &Of { x, y, z });
            left = self.left(&next, right);
            let now = size(&left);
            if now < before {
                *solution = next;
            }
            if !(now < 0.5 * before) {
                return;
            }
        }
    }

    /// What is left of right.x and right.y. Of right.z nothing is, since z is told by it.
    fn left(&self, solution: &Of, right: &Of) -> Vec<f64> {
        let mut left = self.priced(solution);
        left.iter_mut().zip(&right.x).for_each(|(sum, right)| *sum = right - *sum);
        left.extend(self.program.equal.times(&solution.x).iter().zip(&right.y).map(|(sum, right)| right - sum));
        left
    }

    /// The solution where right.z is nothing.
    fn solve_first(&self, right: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let mut x = self.factor.solve(right);
        let y = x.split_off(self.linear.len());
        let mut z = self.program.at_most.times(&x);
        z.iter_mut().zip(&self.weights).for_each(|(sum, weight)| *sum *= weight);
        (x, y, z)
    }

    /// P x + Eᵀy + Aᵀz.
    fn priced(&self, of: &Of) -> Vec<f64> {
        let mut sum = self.quadratic_times(&of.x);
        self.program.equal.add_transposed(&of.y, &mut sum);
        self.program.at_most.add_transposed(&of.z, &mut sum);
        sum
    }

    /// eᵀy + bᵀz.
    fn worth(&self, of: &Of) -> f64 {
        let Program { equal, at_most, .. } = self.program;
        dot(&equal.values, &of.y) + dot(&at_most.values, &of.z)
    }

    /// qᵀx + eᵀy + bᵀz.
    fn valued(&self, of: &Of) -> f64 {
        dot(&self.linear, &of.x) + self.worth(of)
    }
}

/// A point on the way.
#[derive(Clone)]
struct Point {
    at: Of,
    s: Vec<f64>,
    tau: f64,
    kappa: f64,
}

/// By how much a point is off what it should be.
struct Off {
    /// Minus P x + Eᵀy + Aᵀz + q τ, e τ − E x, and b τ − A x − s.
    of: Of,
    /// Minus κ + xᵀP x / τ + qᵀx + eᵀy + bᵀz.
    cost: f64,
    /// P x.
    quadratic: Vec<f64>,
}

/// A direction.
struct Step {
    at: Of,
    s: Vec<f64>,
    tau: f64,
    kappa: f64,
}

impl Point {
    /// Where to begin: at the least cost of a program whose rows may be exceeded at a price, with slacks and prices made positive.
    fn first(system: &mut System<'_>) -> Self {
        let at_most = &system.program.at_most;
        system.weigh(vec![FIRST_WEIGHT; at_most.count()]);
        let mut at = system.solve(&system.of_tau());
        let positive = |numbers: Vec<f64>| {
            let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
            let lift = if least > 0.0 { 0.0 } else { 1.0 - least };
            numbers.into_iter().map(|number| number + lift).collect::<Vec<_>>()
        };
        let s = positive(at.z.iter().map(|z| -z / FIRST_WEIGHT).collect());
        at.z = positive(at.z);
        Self { at, s, tau: 1.0, kappa: 1.0 }
    }

    /// By how much it is off.
    fn off(&self, system: &System<'_>) -> Off {
        let Program { equal, at_most, .. } = system.program;
        let minus = |sum: Vec<f64>, values: &[f64]| {
            sum.into_iter().zip(values).map(|(sum, value)| value * self.tau - sum).collect::<Vec<_>>()
        };
        let quadratic = system.quadratic_times(&self.at.x);
        let mut x = system.priced(&self.at);
        x.iter_mut().zip(&system.linear).for_each(|(sum, cost)| *sum = -*sum - cost * self.tau);
        let y = minus(equal.times(&self.at.x), &equal.values);
        let mut z = minus(at_most.times(&self.at.x), &at_most.values);
        z.iter_mut().zip(&self.s).for_each(|(left, s)| *left -= s);
        let cost = -(self.kappa + dot(&self.at.x, &quadratic) / self.tau + system.valued(&self.at));
        Off { of: Of { x, y, z }, cost, quadratic }
    }

    /// Whether its prices prove that rows contradict each other.
    fn is_contradiction(&self, system: &System<'_>) -> bool {
        // If x keeps the rows, (Eᵀy + Aᵀz)ᵀx is no more than what the rows are worth, which is less than nothing; and its size is no more than the sum of those sizes times the greatest of x.
        let proof = -system.worth(&self.at);
        if !(self.kappa > self.tau && proof > 0.0) {
            return false;
        }
        let mut sum = vec![0.0; system.linear.len()];
        system.program.equal.add_transposed(&self.at.y, &mut sum);
        system.program.at_most.add_transposed(&self.at.z, &mut sum);
        sum.iter().map(|x| x.abs()).sum::<f64>() <= PROVED * proof
    }

    /// How far complementarity is from zero, a mean.
    fn gap(&self) -> f64 {
        (dot(&self.s, &self.at.z) + self.tau * self.kappa) / (self.s.len() + 1) as f64
    }

    /// Goes a step towards the end; which share of its way it could go, none if rounding leaves no direction.
    fn go_on(&mut self, system: &mut System<'_>, off: &Off) -> Option<f64> {
        system.weigh(self.at.z.iter().zip(&self.s).map(|(z, s)| z / s).collect());
        let newton = Newton::new(self, system, off);
        // First straight to the end, to see how far that goes; then the same with what it left out, and as far off the bounds as that asks for.
        let products = self.s.iter().zip(&self.at.z).map(|(s, z)| -s * z).collect();
        let ahead = newton.step(1.0, products, -self.tau * self.kappa, false);
        let left = 1.0 - self.room(&ahead).min(1.0);
        let centre = left * left * left;
        let aim = centre * self.gap();
        let products = (0..self.s.len()).map(|i| aim - self.s[i] * self.at.z[i] - ahead.s[i] * ahead.at.z[i]).collect();
        let step = newton.step(1.0 - centre, products, aim - self.tau * self.kappa - ahead.tau * ahead.kappa, true);
        let share = (NEARLY * self.room(&step)).min(1.0);
        if !size(&[share, step.at.size(), size(&step.s), step.tau, step.kappa]).is_finite() {
            return None;
        }
        self.at = self.at.plus(share, &step.at);
        self.s.iter_mut().zip(&step.s).for_each(|(s, by)| *s += share * by);
        self.tau += share * step.tau;
        self.kappa += share * step.kappa;
        // Any multiple of a point is as good; none grows or fades away.
        let unit = 1.0 / self.tau.max(self.kappa);
        let Self { at, s, tau, kappa } = self;
        [&mut at.x, &mut at.y, &mut at.z, s].into_iter().flatten().chain([tau, kappa]).for_each(|x| *x *= unit);
        Some(share)
    }

    /// How often a direction can be gone before a slack or a price is zero.
    fn room(&self, step: &Step) -> f64 {
        let pairs = self.s.iter().zip(&step.s).chain(self.at.z.iter().zip(&step.at.z));
        let pairs = pairs.chain([(&self.tau, &step.tau), (&self.kappa, &step.kappa)]);
        pairs.fold(f64::INFINITY, |room, (number, by)| if *by < 0.0 { room.min(-number / by) } else { room })
    }
}

/// The linear equations of a step.
struct Newton<'a> {
    point: &'a Point,
    system: &'a System<'a>,
    off: &'a Off,
    /// What a change of τ puts on the right side, and the solution for it.
    tau: Of,
    for_tau: Of,
}

impl<'a> Newton<'a> {
    fn new(point: &'a Point, system: &'a System<'a>, off: &'a Off) -> Self {
        let tau = system.of_tau();
        let for_tau = system.solve(&tau);
        Self { point, system, off, tau, for_tau }
    }

    /// The step on which so much of what is off vanishes, and products of slacks and prices, and τ κ, change as told; corrected if rounding shall have no part in it.
    fn step(&self, share: f64, products: Vec<f64>, of_tau: f64, corrected: bool) -> Step {
        let Self { point, system, off, for_tau, .. } = self;
        let scaled = |numbers: &[f64]| numbers.iter().map(|number| share * number).collect::<Vec<_>>();
        let mut right = Of { x: scaled(&off.of.x), y: scaled(&off.of.y), z: scaled(&off.of.z) };
        right.z.iter_mut().zip(&products).zip(&point.at.z).for_each(|((right, product), z)| *right -= product / z);
        let rest = system.solve(&right);
        // With ξ = x / τ the last equation is what tells τ: (2 P ξ + q)ᵀΔx − ξᵀP ξ Δτ + eᵀΔy + bᵀΔz + Δκ = share · off.
        let slope = |of: &Of| 2.0 * dot(&off.quadratic, &of.x) / point.tau + system.valued(of);
        let xi = dot(&point.at.x, &off.quadratic) / (point.tau * point.tau);
        let missing = |of: &Of, tau: f64| {
            share * off.cost - of_tau / point.tau - slope(of) + (xi + point.kappa / point.tau) * tau
        };
        let pivot = slope(for_tau) - xi - point.kappa / point.tau;
        let mut tau = missing(&rest, 0.0) / pivot;
        let mut at = rest.plus(tau, for_tau);
        if corrected {
            system.correct(&mut at, &right.plus(tau, &self.tau));
            let more = missing(&at, tau) / pivot;
            at = at.plus(more, for_tau);
            tau += more;
        }
        let kappa = (of_tau - point.kappa * tau) / point.tau;
        let s = (0..point.s.len()).map(|i| (products[i] - point.s[i] * at.z[i]) / point.at.z[i]).collect();
        Step { at, s, tau, kappa }
    }
}

impl Off {
    /// How near a point is to the least cost, by what share prices and cost are off; none where it does not keep the rows.
    fn distance(&self, system: &System<'_>, point: &Point) -> Option<f64> {
        let Program { equal, at_most, .. } = system.program;
        let unit = 1.0 / point.tau;
        let limits = size(&equal.values).max(size(&at_most.values));
        let unknowns = unit * size(&point.at.x);
        let squares = unit * unit * dot(&point.at.x, &self.quadratic);
        let cost = 0.5 * squares + unit * dot(&system.linear, &point.at.x);
        let bound = -0.5 * squares - unit * system.worth(&point.at);
        let share = |off: f64, size: f64| off / size.max(1.0);
        let rows =
            share(unit * size(&self.of.y).max(size(&self.of.z)), limits.max(unknowns).max(unit * size(&point.s)));
        let prices = share(unit * size(&self.of.x), size(&system.linear).max(unknowns).max(unit * size(&point.at.z)));
        let gap = share((cost - bound).abs(), cost.abs().min(bound.abs()));
        (rows <= NEAR).then(|| size(&[prices, gap]))
    }
}
