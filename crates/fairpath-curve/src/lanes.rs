//! Two numbers side by side: the width of the vectors that every 64-bit processor has.
//!
//! Plain arithmetic on pairs, which the compiler turns into vector instructions where the results are stored, and which gives
//! the same bits where it does not.

use std::ops::{Add, AddAssign, Mul, Neg};

/// A pair of numbers that goes through the same arithmetic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes(pub(crate) [f64; 2]);

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; 2]);

    #[inline(always)]
    pub(crate) const fn both(x: f64) -> Self {
        Self([x; 2])
    }

    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        self.0[0] + self.0[1]
    }

    /// The polynomial with the first `T` coefficients at both numbers: Horner's rule for even and odd powers apart, which
    /// halves the wait of each step for the one before.
    #[inline(always)]
    pub(crate) fn polynomial<const T: usize>(self, coefficients: &[f64; 10]) -> Self {
        let square = self * self;
        let mut sums = [Self::both(coefficients[T - 1]), Self::both(coefficients[T - 2])];
        for t in (0..T - 2).rev() {
            let sum = &mut sums[(T - 1 - t) % 2];
            *sum = *sum * square + Self::both(coefficients[t]);
        }
        let [even, odd] = if T % 2 == 1 { sums } else { [sums[1], sums[0]] };
        odd * self + even
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self([self.0[0] * other.0[0], self.0[1] * other.0[1]])
    }
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self([-self.0[0], -self.0[1]])
    }
}
