//! A point on the way, and by how much it is off what it should be.

use super::newton::Step;
use super::softened::Softened;
use super::system::System;
use super::vectors::{Of, add, dot, haste, size};

/// How near the least cost and the values of rows a solution is, as a share of their size.
pub(super) const NEAR: f64 = 1e-10;

/// Rows contradict each other when prices prove that whatever keeps them has an unknown greater than one over this: a height a thousand kilometres off the ground.
const PROVED: f64 = 1e-6;

/// What the square of a distance costs besides, in greatest costs, where the first point is looked for and distances may be negative. Ten times more or less makes a step or two more.
const FIRST_WEIGHT: f64 = 100.0;

/// A point on the way.
#[derive(Clone)]
pub(super) struct Point {
    pub(super) at: Of,
    /// Prices of sides.
    pub(super) z: Vec<f64>,
    pub(super) tau: f64,
    pub(super) kappa: f64,
}

/// By how much a point is off what it should be.
pub(super) struct Off {
    /// Minus P x + Eᵀy + Fᵀw + q τ, e τ − E x, a τ + s⁺ − s⁻ − F x, and minus c s ∓ w + p τ − z.
    pub(super) of: Of,
    /// Minus κ + (xᵀP x + Σ c s²) / τ + qᵀx + Σ p s + eᵀy + aᵀw.
    pub(super) cost: f64,
    /// P x and c s.
    pub(super) slopes: [Vec<f64>; 2],
    /// xᵀP x + Σ c s².
    pub(super) squares: f64,
}

impl Point {
    /// Where to begin: at the least cost of a program whose rows may be anywhere at a price, with distances and prices made positive.
    pub(super) fn first(system: &System<'_>, softened: &mut Softened) -> Self {
        softened.soften(system, system.squares.iter().map(|square| 1.0 / (square + FIRST_WEIGHT)));
        let mut at = system.of_tau();
        let mut right = at.clone();
        right.s.iter_mut().zip(&softened.softness).for_each(|(s, softness)| *s *= softness);
        softened.solve(system, &right, &mut at);
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

    /// How softly sides give way: s / (z + c s).
    pub(super) fn softness(&self, system: &System<'_>) -> impl Iterator<Item = f64> {
        self.at.s.iter().zip(&self.z).zip(&system.squares).map(|((s, z), square)| s / (z + square * s))
    }

    /// By how much it is off.
    pub(super) fn off(&self, system: &System<'_>) -> Off {
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
    pub(super) fn is_contradiction(&self, system: &System<'_>) -> bool {
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
    pub(super) fn gap(&self) -> f64 {
        (dot(&self.at.s, &self.z) + self.tau * self.kappa) / (self.z.len() + 1) as f64
    }

    /// How often a direction can be gone before a distance or a price is zero.
    pub(super) fn room(&self, step: &Step) -> f64 {
        let hastes = [
            haste(&self.at.s, &step.at.s),
            haste(&self.z, &step.z),
            haste(&[self.tau, self.kappa], &[step.tau, step.kappa]),
        ];
        1.0 / hastes.into_iter().fold(0.0, f64::max)
    }

    /// Goes a direction; whether everything is a number still.
    pub(super) fn go(&mut self, share: f64, step: &Step) -> bool {
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

impl Off {
    /// How near a point is to the least cost, by what share prices and cost are off; none where it does not keep the rows.
    pub(super) fn distance(&self, system: &System<'_>, point: &Point) -> Option<f64> {
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
