//! A convex quadratic program comes in, its least cost goes out, by the primal-dual interior-point method with homogeneous embedding of Goulart and Chen (*Clarabel: An
//! interior-point solver for conic programs with quadratic objectives*, 2024, sections 2 to 4), for equations, and rows that are above or below their values at a cost.
//!
//! Each side on which a row may be has a distance s ≥ 0 that costs p s + ½ c s², and a price z ≥ 0; equations and rows have prices y and w. What is sought is a point of
//!
//! > P x + Eᵀy + Fᵀw + q τ = 0,  E x = e τ,  F x = a τ + s⁺ − s⁻,  c s ∓ w + p τ = z,  κ + (xᵀP x + Σ c s²) / τ + qᵀx + Σ p s + eᵀy + aᵀw = 0,  s z = 0,  τ κ = 0.
//!
//! Where τ > 0 the least cost is at x / τ; where κ > 0 the prices prove that the rows contradict each other. Steps follow Mehrotra's predictor and corrector.
//!
//! What makes it quick is the system that is solved in each step. Distances and prices of rows are eliminated first, each by itself: what is left is P + Fᵀ diag(weights) F, in which
//! an unknown is tied to those only with which it has a sum in common. For roads that is a band of two beside the diagonal, and what crossings add. But for these a step takes time
//! proportional to the number of unknowns.

use super::program::{Cost, End, Outcome, Program};
use crate::lists::Lists;
use crate::sparse::{Factor, Pattern};

/// How near the least cost and the values of rows a solution is, as a share of their size.
const NEAR: f64 = 1e-10;

/// Most steps; there are about twenty.
const MOST_STEPS: u32 = 100;

/// What keeps rows so and is as near as this to the least cost is taken where so many steps did not come nearer, which is rounding's doing.
const ROUNDED: f64 = 1e-7;
const FARTHER: u32 = 2;

/// Rows contradict each other when prices prove that whatever keeps them has an unknown greater than one over this: a height a thousand kilometres off the ground.
const PROVED: f64 = 1e-6;

/// What the square of a distance costs besides, in greatest costs, where the first point is looked for and distances may be negative. Ten times more or less makes a step or two more.
const FIRST_WEIGHT: f64 = 100.0;

/// How much of the way to the nearest bound a step goes.
const NEARLY: f64 = 0.99;

/// A program is given up when this many steps one after the other went less than [`SHORT`] of their way.
const SHORT_STEPS: u32 = 5;
const SHORT: f64 = 1e-3;

/// Directions are corrected until what they leave of prices and equations is so little, or such a share of what was off, as long as that helps, and no more often.
const CORRECTED: f64 = 1e-12;
const CORRECTED_SHARE: f64 = 1e-4;
const CORRECTIONS: usize = 10;

/// The unknowns that cost least.
pub(super) fn solve(program: &Program) -> Outcome {
    let mut system = System::new(program);
    let mut point = Point::first(&mut system);
    let mut newton = Newton::new(&system);
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
        let Some(share) = newton.go_on(&mut point, &mut system, &off) else { break End::Unsettled };
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
    let Of { x, y, w, .. } = point.at;
    Outcome {
        x: all(x, unit),
        of_equations: all(y, unit * system.cost_unit),
        of_rows: system.in_order(&all(w, unit * system.cost_unit)),
        end,
        status: status.to_owned(),
        iterations: steps,
    }
}

/// A number for each unknown, each equation, each row, and each side of a row.
#[derive(Clone, Debug)]
struct Of {
    x: Vec<f64>,
    y: Vec<f64>,
    w: Vec<f64>,
    s: Vec<f64>,
}

impl Of {
    /// Adds as much of another one.
    fn add(&mut self, factor: f64, other: &Self) {
        let Self { x, y, w, s } = self;
        for (own, other) in [(x, &other.x), (y, &other.y), (w, &other.w), (s, &other.s)] {
            add(factor, other, own);
        }
    }
}

/// Adds as much of some numbers to others.
fn add(factor: f64, by: &[f64], numbers: &mut [f64]) {
    numbers.iter_mut().zip(by).for_each(|(number, by)| *number += factor * by);
}

/// Puts numbers in place of others.
fn set(numbers: &mut Vec<f64>, by: impl Iterator<Item = f64>) {
    numbers.clear();
    numbers.extend(by);
}

/// So many numbers at a time are taken together, that the processor need not wait for one after the other.
const LANES: usize = 8;

/// What comes of pairs, lane by lane and then of all lanes.
fn reduced(
    a: &[f64],
    b: &[f64],
    first: f64,
    with: impl Fn(f64, f64, f64) -> f64,
    of_lanes: impl Fn(f64, f64) -> f64,
) -> f64 {
    let mut lanes = [first; LANES];
    let (of_a, of_b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let (rest_a, rest_b) = (of_a.remainder(), of_b.remainder());
    for (a, b) in of_a.zip(of_b) {
        for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b) {
            *lane = with(*lane, *a, *b);
        }
    }
    for ((lane, a), b) in lanes.iter_mut().zip(rest_a).zip(rest_b) {
        *lane = with(*lane, *a, *b);
    }
    lanes.into_iter().fold(first, of_lanes)
}

/// The greater one, or NaN if one is.
fn greater(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

fn size(numbers: &[f64]) -> f64 {
    reduced(numbers, numbers, 0.0, |most, number, _| greater(most, number.abs()), greater)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    reduced(a, b, 0.0, |sum, a, b| sum + a * b, |sum, lane| sum + lane)
}

/// One over how often numbers can go their ways before one of them is nothing.
fn haste(numbers: &[f64], ways: &[f64]) -> f64 {
    let greater = |most: f64, haste: f64| if haste > most { haste } else { most };
    reduced(numbers, ways, 0.0, |most, number, way| greater(most, -way / number), greater)
}

/// A program with its matrices in the form in which they are used, and the factorisation of a step's system.
struct System<'a> {
    program: &'a Program,
    /// What the costs are divided by, so that the greatest of them is one.
    cost_unit: f64,
    linear: Vec<f64>,
    /// P, with its own pattern.
    quadratic: (Pattern, Vec<f64>),
    /// The rows in the order in which they stand here: first those that have but one side, then those that have both.
    order: Vec<usize>,
    /// How many have but one.
    singles: usize,
    /// The sum of each row.
    sums: Vec<usize>,
    /// 1 where a row's side is above, −1 where it is below. What is told of sides is told of one of each row, above where it has both; then come those below of these.
    signs: Vec<f64>,
    /// Of the system: P and what sums add to it, then E.
    pattern: Pattern,
    /// P and E in that pattern.
    given: Vec<f64>,
    /// For each unknown the sums in which it is, with its factors.
    by_unknown: Lists<(usize, f64)>,
    /// For each entry the sums that add to it, with the products of two of their terms.
    by_entry: Lists<(usize, f64)>,
    factor: Factor,
    /// The values of rows, and p of their sides.
    values: Vec<f64>,
    prices: Vec<f64>,
    /// c of sides.
    squares: Vec<f64>,
    /// The size of the greatest value of equations, and of rows.
    greatest: [f64; 2],
    /// s / (z + c s) of each side.
    softness: Vec<f64>,
    /// Of each row: one over what its sides have together.
    weights: Vec<f64>,
}

impl<'a> System<'a> {
    fn new(program: &'a Program) -> Self {
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
            factor: Factor::new(&pattern),
            by_unknown: sums.transposed(count),
            by_entry: products.transposed(pattern.entries()),
            pattern,
            given,
            greatest: [size(&equations.values), size(&values)],
            softness: vec![1.0; sides.len()],
            weights: vec![1.0; rows.len()],
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

    /// Numbers of rows in the program's order.
    fn in_order(&self, of_rows: &[f64]) -> Vec<f64> {
        let mut numbers = vec![0.0; of_rows.len()];
        self.order.iter().zip(of_rows).for_each(|(&row, number)| numbers[row] = *number);
        numbers
    }

    /// P x.
    fn quadratic_times(&self, x: &[f64]) -> Vec<f64> {
        let (pattern, values) = &self.quadratic;
        pattern.times(values, x)
    }

    /// F x.
    fn rows_times(&self, x: &[f64]) -> Vec<f64> {
        let sums = self.program.sums.times(x);
        self.sums.iter().map(|&sum| sums[sum]).collect()
    }

    /// Adds Fᵀ w.
    fn add_rows(&self, w: &[f64], x: &mut [f64]) {
        // Unknown by unknown, since what is added to one waits for what was added before.
        add(1.0, &self.by_unknown.times(&self.by_sum(w)), x);
    }

    /// For each sum what its rows have together.
    fn by_sum(&self, of_rows: &[f64]) -> Vec<f64> {
        let mut by_sum = vec![0.0; self.program.sums.count()];
        self.sums.iter().zip(of_rows).for_each(|(&sum, number)| by_sum[sum] += number);
        by_sum
    }

    /// Adds for each row how far it is above its value, if this is how far it is on its sides.
    fn add_above(&self, s: &[f64], rows: &mut [f64]) {
        let (first, below) = s.split_at(rows.len());
        rows.iter_mut().zip(&self.signs).zip(first).for_each(|((row, sign), s)| *row += sign * s);
        add(-1.0, below, &mut rows[self.singles..]);
    }

    /// Takes the softness of sides and factorises with it.
    fn soften(&mut self, softness: Vec<f64>) {
        self.softness = softness;
        let Self { softness, weights, singles, .. } = self;
        let (first, below) = softness.split_at(weights.len());
        weights.copy_from_slice(first);
        add(1.0, below, &mut weights[*singles..]);
        weights.iter_mut().for_each(|weight| *weight = 1.0 / *weight);
        let mut matrix = self.by_entry.times(&self.by_sum(&self.weights));
        add(1.0, &self.given, &mut matrix);
        self.factor.decompose(&self.pattern, &matrix);
    }

    /// The solution of P x + Eᵀy + Fᵀw = right.x, E x = right.y, F x − s⁺ + s⁻ = right.w, s = right.s ± softness · w, but for rounding.
    fn solve(&self, right: &Of, solution: &mut Of) {
        // With w = weights · F x − pull the first is (P + Fᵀ diag(weights) F) x + Eᵀy = right.x + Fᵀ pull.
        let mut pull = right.w.clone();
        self.add_above(&right.s, &mut pull);
        pull.iter_mut().zip(&self.weights).for_each(|(pull, weight)| *pull *= weight);
        let mut sum = right.x.clone();
        self.add_rows(&pull, &mut sum);
        sum.extend_from_slice(&right.y);
        (solution.x, solution.y, solution.w) = self.solve_first(&sum);
        add(-1.0, &pull, &mut solution.w);
        self.tell_sides(solution, right);
    }

    /// How far rows are on their sides follows from their prices.
    fn tell_sides(&self, solution: &mut Of, right: &Of) {
        let Of { w, s, .. } = solution;
        let first = w.iter().zip(&self.signs).zip(&self.softness).zip(&right.s);
        set(s, first.map(|(((w, sign), softness), right)| right + sign * w * softness));
        let below = w[self.singles..].iter().zip(&self.softness[w.len()..]).zip(&right.s[w.len()..]);
        s.extend(below.map(|((w, softness), right)| right - w * softness));
    }

    /// Makes a solution nearer to what [`System::solve`] says.
    fn correct(&self, solution: &mut Of, right: &Of, off: &Off) {
        let enough = CORRECTED.max(CORRECTED_SHARE * size(&off.of.x).max(size(&off.of.y)));
        let mut left = self.left(solution, right);
        for _ in 0..CORRECTIONS {
            let before = size(&left);
            if before <= enough {
                break;
            }
            let (x, y, w) = self.solve_first(&left);
            let mut next = Of { x, y, w, s: Vec::new() };
            next.add(1.0, solution);
            left = self.left(&next, right);
            let now = size(&left);
            if now < before {
                *solution = next;
            }
            if !(now < 0.5 * before) {
                break;
            }
        }
        self.tell_sides(solution, right);
    }

    /// What is left of right.x and right.y. Of the others nothing is, since w and s are told by them.
    fn left(&self, solution: &Of, right: &Of) -> Vec<f64> {
        let mut left = self.priced(solution);
        left.iter_mut().zip(&right.x).for_each(|(sum, right)| *sum = right - *sum);
        left.extend(
            self.program.equations.sums.times(&solution.x).iter().zip(&right.y).map(|(sum, right)| right - sum),
        );
        left
    }

    /// The solution where right.w and right.s are nothing, without s.
    fn solve_first(&self, right: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let mut x = self.factor.solve(right);
        let y = x.split_off(self.linear.len());
        let mut w = self.rows_times(&x);
        w.iter_mut().zip(&self.weights).for_each(|(sum, weight)| *sum *= weight);
        (x, y, w)
    }

    /// P x + Eᵀy + Fᵀw.
    fn priced(&self, of: &Of) -> Vec<f64> {
        let mut sum = self.quadratic_times(&of.x);
        self.program.equations.sums.add_transposed(&of.y, &mut sum);
        self.add_rows(&of.w, &mut sum);
        sum
    }

    /// eᵀy + aᵀw.
    fn worth(&self, of: &Of) -> f64 {
        dot(&self.program.equations.values, &of.y) + dot(&self.values, &of.w)
    }

    /// qᵀx + Σ p s.
    fn cost(&self, of: &Of) -> f64 {
        dot(&self.linear, &of.x) + dot(&self.prices, &of.s)
    }
}

/// A point on the way.
#[derive(Clone)]
struct Point {
    at: Of,
    /// Prices of sides.
    z: Vec<f64>,
    tau: f64,
    kappa: f64,
}

/// By how much a point is off what it should be.
struct Off {
    /// Minus P x + Eᵀy + Fᵀw + q τ, e τ − E x, a τ + s⁺ − s⁻ − F x, and minus c s ∓ w + p τ − z.
    of: Of,
    /// Minus κ + (xᵀP x + Σ c s²) / τ + qᵀx + Σ p s + eᵀy + aᵀw.
    cost: f64,
    /// P x and c s.
    slopes: [Vec<f64>; 2],
    /// xᵀP x + Σ c s².
    squares: f64,
}

impl Point {
    /// Where to begin: at the least cost of a program whose rows may be anywhere at a price, with distances and prices made positive.
    fn first(system: &mut System<'_>) -> Self {
        system.soften(system.squares.iter().map(|square| 1.0 / (square + FIRST_WEIGHT)).collect());
        let mut at = Newton::of_tau(system);
        let mut right = at.clone();
        right.s.iter_mut().zip(&system.softness).for_each(|(s, softness)| *s *= softness);
        system.solve(&right, &mut at);
        let positive = |numbers: Vec<f64>| {
            let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
            let lift = if least > 0.0 { 0.0 } else { 1.0 - least };
            numbers.into_iter().map(|number| number + lift).collect::<Vec<_>>()
        };
        let z = positive(at.s.iter().map(|s| -FIRST_WEIGHT * s).collect());
        at.s = positive(at.s);
        // The price of a row with but one side is that side's.
        let singles = at.w[..system.singles].iter_mut().zip(&system.signs).zip(&z);
        singles.for_each(|((w, sign), z)| *w = -sign * z);
        Self { at, z, tau: 1.0, kappa: 1.0 }
    }

    /// By how much it is off.
    fn off(&self, system: &System<'_>) -> Off {
        let Self { at, z, tau, kappa } = self;
        let quadratic = system.quadratic_times(&at.x);
        let stiff: Vec<f64> = system.squares.iter().zip(&at.s).map(|(square, s)| square * s).collect();
        let squares = dot(&at.x, &quadratic) + dot(&at.s, &stiff);
        let mut x = system.priced(at);
        x.iter_mut().zip(&system.linear).for_each(|(sum, q)| *sum = -*sum - q * tau);
        let minus = |mut sums: Vec<f64>, values: &[f64]| {
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum = value * tau - *sum);
            sums
        };
        let y = minus(system.program.equations.sums.times(&at.x), &system.program.equations.values);
        let mut w = minus(system.rows_times(&at.x), &system.values);
        system.add_above(&at.s, &mut w);
        let prices = system.prices.iter().zip(&stiff).zip(z);
        let mut s: Vec<f64> = prices.map(|((price, stiff), z)| z - stiff - price * tau).collect();
        let (first, below) = s.split_at_mut(at.w.len());
        first.iter_mut().zip(&system.signs).zip(&at.w).for_each(|((s, sign), w)| *s += sign * w);
        add(-1.0, &at.w[system.singles..], below);
        let cost = -(kappa + squares / tau + system.cost(at) + system.worth(at));
        Off { of: Of { x, y, w, s }, cost, slopes: [quadratic, stiff], squares }
    }

    /// Whether its prices prove that rows contradict each other.
    fn is_contradiction(&self, system: &System<'_>) -> bool {
        if self.kappa <= self.tau {
            return false;
        }
        // Of rows that may be on both sides nothing follows. If x keeps the others, (Eᵀy + Fᵀw)ᵀx is no more than what these are worth, which is less than nothing; and its size is
        // no more than the sum of those sizes times the greatest of x.
        let singles = self.at.w[..system.singles].iter().zip(&system.signs);
        let mut w: Vec<f64> = singles.map(|(w, sign)| -sign * (-sign * w).max(0.0)).collect();
        w.resize(self.at.w.len(), 0.0);
        let prices = Of { x: vec![0.0; self.at.x.len()], y: self.at.y.clone(), w, s: Vec::new() };
        let proof = -system.worth(&prices);
        proof > 0.0 && system.priced(&prices).iter().map(|x| x.abs()).sum::<f64>() <= PROVED * proof
    }

    /// How far complementarity is from zero, a mean.
    fn gap(&self) -> f64 {
        (dot(&self.at.s, &self.z) + self.tau * self.kappa) / (self.z.len() + 1) as f64
    }

    /// How often a direction can be gone before a distance or a price is zero.
    fn room(&self, step: &Step) -> f64 {
        let hastes = [
            haste(&self.at.s, &step.at.s),
            haste(&self.z, &step.z),
            haste(&[self.tau, self.kappa], &[step.tau, step.kappa]),
        ];
        1.0 / hastes.into_iter().fold(0.0, f64::max)
    }

    /// Goes a direction; whether everything is a number still.
    fn go(&mut self, share: f64, step: &Step) -> bool {
        self.at.add(share, &step.at);
        add(share, &step.z, &mut self.z);
        self.tau += share * step.tau;
        self.kappa += share * step.kappa;
        // Any multiple of a point is as good; none grows or fades away.
        let unit = 1.0 / self.tau.max(self.kappa);
        let Self { at, z, tau, kappa } = self;
        let Of { x, y, w, s } = at;
        let mut all = [x, y, w, s, z];
        all.iter_mut().flat_map(|numbers| numbers.iter_mut()).chain([tau, kappa]).for_each(|number| *number *= unit);
        all.iter().all(|numbers| size(numbers).is_finite())
    }
}

/// A direction.
struct Step {
    at: Of,
    z: Vec<f64>,
    tau: f64,
    kappa: f64,
}

/// The linear equations of a step.
struct Newton {
    /// What a change of τ puts on the right side, and the solution for it.
    tau: Of,
    for_tau: Of,
    /// −p of sides.
    minus_prices: Vec<f64>,
    /// 1 / s of sides.
    inverse: Vec<f64>,
    /// How products of distances and prices shall change.
    products: Vec<f64>,
    right: Of,
    step: Step,
}

impl Newton {
    fn new(system: &System<'_>) -> Self {
        let tau = Self::of_tau(system);
        let none = || Of { x: Vec::new(), y: Vec::new(), w: Vec::new(), s: Vec::new() };
        Self {
            minus_prices: tau.s.clone(),
            tau,
            for_tau: none(),
            inverse: Vec::new(),
            products: Vec::new(),
            right: none(),
            step: Step { at: none(), z: Vec::new(), tau: 0.0, kappa: 0.0 },
        }
    }

    /// What τ is multiplied with on the right side of the equations; of sides it is −p, of which the softness is yet to come.
    fn of_tau(system: &System<'_>) -> Of {
        Of {
            x: system.linear.iter().map(|q| -q).collect(),
            y: system.program.equations.values.clone(),
            w: system.values.clone(),
            s: system.prices.iter().map(|price| -price).collect(),
        }
    }

    /// Goes a step towards the end; which share of its way it could go, none if rounding leaves no direction.
    fn go_on(&mut self, point: &mut Point, system: &mut System<'_>, off: &Off) -> Option<f64> {
        let Point { at: Of { s, .. }, z, tau, kappa } = &*point;
        let softness = s.iter().zip(z).zip(&system.squares).map(|((s, z), square)| s / (z + square * s));
        let softness = softness.collect();
        system.soften(softness);
        set(&mut self.tau.s, self.minus_prices.iter().zip(&system.softness).map(|(p, softness)| p * softness));
        system.solve(&self.tau, &mut self.for_tau);
        set(&mut self.inverse, s.iter().map(|s| 1.0 / s));
        // First straight to the end, to see how far that goes; then the same with what it left out, and as far off the bounds as that asks for.
        set(&mut self.products, s.iter().zip(z).map(|(s, z)| -s * z));
        self.direct(point, system, off, (1.0, -tau * kappa), false);
        let left = 1.0 - point.room(&self.step).min(1.0);
        let centre = left * left * left;
        let aim = centre * point.gap();
        let ahead = &self.step;
        let more = ahead.at.s.iter().zip(&ahead.z);
        self.products.iter_mut().zip(more).for_each(|(product, (s, z))| *product += aim - s * z);
        let of_tau = aim - tau * kappa - ahead.tau * ahead.kappa;
        self.direct(point, system, off, (1.0 - centre, of_tau), true);
        let share = (NEARLY * point.room(&self.step)).min(1.0);
        (share.is_finite() && point.go(share, &self.step)).then_some(share)
    }

    /// The step on which so much of what is off vanishes, and products of distances and prices, and τ κ, change as told; corrected if rounding shall have no part in it.
    fn direct(&mut self, point: &Point, system: &System<'_>, off: &Off, (share, of_tau): (f64, f64), corrected: bool) {
        let Self { for_tau, right, step: Step { at, z, .. }, inverse, products, .. } = self;
        for (right, off) in [(&mut right.x, &off.of.x), (&mut right.y, &off.of.y), (&mut right.w, &off.of.w)] {
            set(right, off.iter().map(|off| share * off));
        }
        let of_sides = off.of.s.iter().zip(&*products).zip(&*inverse).zip(&system.softness);
        set(
            &mut right.s,
            of_sides.map(|(((off, product), inverse), softness)| (share * off + product * inverse) * softness),
        );
        system.solve(right, at);
        // With ξ = x / τ and σ = s / τ the last equation is what tells τ:
        // (2 P ξ + q)ᵀΔx + (2 c σ + p)ᵀΔs − (ξᵀP ξ + Σ c σ²) Δτ + eᵀΔy + aᵀΔw + Δκ = share · off.
        let slope = |of: &Of| {
            let squares = dot(&off.slopes[0], &of.x) + dot(&off.slopes[1], &of.s);
            2.0 * squares / point.tau + system.cost(of) + system.worth(of)
        };
        let xi = off.squares / (point.tau * point.tau);
        let missing = |of: &Of, tau: f64| {
            share * off.cost - of_tau / point.tau - slope(of) + (xi + point.kappa / point.tau) * tau
        };
        let pivot = slope(for_tau) - xi - point.kappa / point.tau;
        let mut tau = missing(at, 0.0) / pivot;
        at.add(tau, for_tau);
        if corrected {
            right.add(tau, &self.tau);
            system.correct(at, right, off);
            let more = missing(at, tau) / pivot;
            at.add(more, for_tau);
            tau += more;
        }
        self.step.tau = tau;
        self.step.kappa = (of_tau - point.kappa * tau) / point.tau;
        let of_sides = products.iter().zip(&point.z).zip(&at.s).zip(&*inverse);
        set(z, of_sides.map(|(((product, z), s), inverse)| (product - z * s) * inverse));
    }
}

impl Off {
    /// How near a point is to the least cost, by what share prices and cost are off; none where it does not keep the rows.
    fn distance(&self, system: &System<'_>, point: &Point) -> Option<f64> {
        let unit = 1.0 / point.tau;
        let share = |off: f64, size: f64| off / size.max(1.0);
        let unknowns = unit * size(&point.at.x);
        let [of_equations, of_rows] = system.greatest.map(|greatest| greatest.max(unknowns));
        let equations = share(unit * size(&self.of.y), of_equations);
        let rows = share(unit * size(&self.of.w), of_rows.max(unit * size(&point.at.s))).max(equations);
        if !(rows <= NEAR) {
            return None;
        }
        let squares = unit * unit * self.squares;
        let cost = 0.5 * squares + unit * system.cost(&point.at);
        let bound = -0.5 * squares - unit * system.worth(&point.at);
        let prices = unit * size(&self.of.x).max(size(&self.of.s));
        let prices = share(prices, unknowns.max(unit * size(&point.z)));
        let gap = share((cost - bound).abs(), cost.abs().min(bound.abs()));
        Some(size(&[prices, gap]))
    }
}
