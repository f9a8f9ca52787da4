//! Newton's steps: a point with what is off comes in, and goes on.

use super::point::{Off, Point};
use super::softened::Softened;
use super::system::System;
use super::vectors::{Of, dot, set, size};

/// How much of the way to the nearest bound a step goes.
const NEARLY: f64 = 0.99;

/// A direction.
pub(super) struct Step {
    pub(super) at: Of,
    pub(super) z: Vec<f64>,
    pub(super) tau: f64,
    pub(super) kappa: f64,
}

/// Makes steps; what it works with is kept from one to the next.
pub(super) struct Newton {
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
    pub(super) fn new(system: &System<'_>) -> Self {
        let tau = system.of_tau();
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

    /// Goes a step towards the end; which share of its way it could go, none if rounding leaves no direction.
    pub(super) fn go_on(
        &mut self,
        point: &mut Point,
        system: &System<'_>,
        softened: &Softened,
        off: &Off,
    ) -> Option<f64> {
        let Point { at: Of { s, .. }, z, tau, kappa } = &*point;
        set(&mut self.tau.s, self.minus_prices.iter().zip(&softened.softness).map(|(p, softness)| p * softness));
        set(&mut self.inverse, s.iter().map(|s| 1.0 / s));
        // First straight to the end, to see how far that goes; then the same with what it left out, and as far off the bounds as that asks for.
        set(&mut self.products, s.iter().zip(z).map(|(s, z)| -s * z));
        let straight = (1.0, -tau * kappa);
        self.ask(softened, off, 1.0);
        softened.solve(system, &self.tau, &mut self.for_tau);
        softened.solve(system, &self.right, &mut self.step.at);
        self.settle((point, system, off), straight, None);
        let left = 1.0 - point.room(&self.step).min(1.0);
        let centre = left * left * left;
        let aim = centre * point.gap();
        let ahead = &self.step;
        let more = ahead.at.s.iter().zip(&ahead.z);
        self.products.iter_mut().zip(more).for_each(|(product, (s, z))| *product += aim - s * z);
        let of_tau = aim - tau * kappa - ahead.tau * ahead.kappa;
        let centred = (1.0 - centre, of_tau);
        self.ask(softened, off, 1.0 - centre);
        softened.solve(system, &self.right, &mut self.step.at);
        self.settle((point, system, off), centred, Some(softened));
        let share = (NEARLY * point.room(&self.step)).min(1.0);
        (share.is_finite() && point.go(share, &self.step)).then_some(share)
    }

    /// The right side of a step on which so much of what is off vanishes, and products of distances and prices change as told.
    fn ask(&mut self, softened: &Softened, off: &Off, share: f64) {
        let Self { right, inverse, products, .. } = self;
        for (right, off) in [(&mut right.x, &off.of.x), (&mut right.y, &off.of.y), (&mut right.w, &off.of.w)] {
            set(right, off.iter().map(|off| share * off));
        }
        let of_sides = off.of.s.iter().zip(&*products).zip(&*inverse).zip(&softened.softness);
        set(
            &mut right.s,
            of_sides.map(|(((off, product), inverse), softness)| (share * off + product * inverse) * softness),
        );
    }

    /// Adds to the solution for that right side what τ, which the last equation tells, has in it; corrected if rounding shall have no part in it.
    fn settle(
        &mut self,
        (point, system, off): (&Point, &System<'_>, &Off),
        (share, of_tau): (f64, f64),
        corrected: Option<&Softened>,
    ) {
        let Self { for_tau, right, step: Step { at, z, .. }, inverse, products, .. } = self;
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
        if let Some(softened) = corrected {
            right.add(tau, &self.tau);
            softened.correct(system, at, right, size(&off.of.x).max(size(&off.of.y)));
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
