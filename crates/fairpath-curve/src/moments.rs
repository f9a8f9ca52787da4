//! The moment integrals `M_k(s) = ∫₀ˢ uᵏ e^{iθ(u)} du` of a heading that is quadratic in arc length.
//!
//! They are all that lines, arcs and clothoids need: the position is `M_0`, its derivatives by heading, curvature and
//! sharpness are `i M_0`, `i M_1` and `i M_2 / 2`, and the second derivatives go on to `M_4`. There is no special case for
//! straight or circular pieces, so nothing loses its derivative near them.
//!
//! Method: Gauss–Legendre quadrature on panels of bounded turning. About the middle of a panel the heading is
//! `a x + b x²`, so that nodes that mirror each other share their sines and cosines, and all nodes of a panel are computed side by
//! side in vectors. Panels that turn little get eight nodes, the others twelve.

use crate::trig::{sin_cos, unit};
use kurbo::Vec2;

/// Nodes of the 8-point Gauss–Legendre rule on [−1, 1]; each stands for itself and its mirror image.
const NODES_8: [f64; 4] =
    [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_2];
/// Weights of [`NODES_8`].
const WEIGHTS_8: [f64; 4] =
    [0.362_683_783_378_361_97, 0.313_706_645_877_887_27, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26];
/// Nodes of the 12-point rule.
const NODES_12: [f64; 6] = [
    0.125_233_408_511_468_92,
    0.367_831_498_998_180_2,
    0.587_317_954_286_617_5,
    0.769_902_674_194_304_7,
    0.904_117_256_370_474_9,
    0.981_560_634_246_719_2,
];
/// Weights of [`NODES_12`].
const WEIGHTS_12: [f64; 6] = [
    0.249_147_045_813_402_8,
    0.233_492_536_538_354_82,
    0.203_167_426_723_065_92,
    0.160_078_328_543_346_23,
    0.106_939_325_995_318_43,
    0.047_175_336_386_511_83,
];

/// The largest product of curvature and half length of a panel with eight nodes, radians: the rule's error is then below 3e-15
/// of the panel's length.
const GENTLE: f64 = 0.42;

/// The same for twelve nodes: the error is below 1e-15 of the panel's length.
const STEEP: f64 = 1.25;

/// More panels than this are not taken, whatever the turning: beyond, positions lose accuracy instead of time.
const MAX_PANELS: f64 = 1e6;

/// Coefficients of `cos √x` in powers of x, to the 18th degree of the angle: at most 1e-17 is left out up to 1.25 rad.
const COS: [f64; 10] = [
    1.0,
    -0.5,
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
    -1.0 / 6_402_373_705_728_000.0,
];

/// Coefficients of `(sin √x) / √x`, to the 19th degree of the angle.
const SIN: [f64; 10] = [
    1.0,
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
    -1.0 / 121_645_100_408_832_000.0,
];

/// The polynomial with the first `T` of `coefficients` at every `x`.
#[inline(always)]
fn polynomial<const T: usize, const N: usize>(coefficients: &[f64; 10], x: &[f64; N]) -> [f64; N] {
    let mut sum = [coefficients[T - 1]; N];
    for t in (0..T - 1).rev() {
        for n in 0..N {
            sum[n] = sum[n] * x[n] + coefficients[t];
        }
    }
    sum
}

/// The moments of a panel about its middle in units of half its length: `∫₋₁¹ xᵏ e^{i(slope x + bend x²)} dx`.
///
/// `A` and `B` are the numbers of terms for the angles `slope x` and `bend x²`, the latter at most half as large.
#[inline(always)]
fn panel<const K: usize, const A: usize, const B: usize, const N: usize>(
    nodes: &[f64; N],
    weights: &[f64; N],
    slope: f64,
    bend: f64,
) -> [Vec2; K] {
    let (mut a, mut b, mut aa, mut bb) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
    for n in 0..N {
        a[n] = slope * nodes[n];
        b[n] = bend * (nodes[n] * nodes[n]);
        aa[n] = a[n] * a[n];
        bb[n] = b[n] * b[n];
    }
    let cos_a = polynomial::<A, N>(&COS, &aa);
    let cos_b = polynomial::<B, N>(&COS, &bb);
    let sin_b = polynomial::<B, N>(&SIN, &bb);
    // Sums over nodes and their mirror images: e^{ib} times 2 cos a in even moments, times 2i sin a in odd ones.
    let (mut re, mut im) = ([0.0; N], [0.0; N]);
    for n in 0..N {
        re[n] = 2.0 * weights[n] * cos_b[n];
        im[n] = 2.0 * weights[n] * (b[n] * sin_b[n]);
    }
    let mut m = [Vec2::ZERO; K];
    let (mut even_re, mut even_im) = ([0.0; N], [0.0; N]);
    for n in 0..N {
        even_re[n] = cos_a[n] * re[n];
        even_im[n] = cos_a[n] * im[n];
    }
    m[0] = Vec2::new(sum(&even_re), sum(&even_im));
    if K > 1 {
        let sin_a = polynomial::<A, N>(&SIN, &aa);
        let (mut odd_re, mut odd_im) = ([0.0; N], [0.0; N]);
        for n in 0..N {
            let odd = nodes[n] * (a[n] * sin_a[n]);
            odd_re[n] = -odd * im[n];
            odd_im[n] = odd * re[n];
        }
        for k in 1..K {
            let (re, im) = if k % 2 == 1 { (&mut odd_re, &mut odd_im) } else { (&mut even_re, &mut even_im) };
            if k > 1 {
                for n in 0..N {
                    re[n] *= nodes[n] * nodes[n];
                    im[n] *= nodes[n] * nodes[n];
                }
            }
            m[k] = Vec2::new(sum(re), sum(im));
        }
    }
    m
}

#[inline(always)]
fn sum<const N: usize>(values: &[f64; N]) -> f64 {
    // Two partial sums side by side, as vectors add them.
    let (mut even, mut odd) = (0.0, 0.0);
    for n in 0..N / 2 {
        even += values[2 * n];
        odd += values[2 * n + 1];
    }
    even + odd
}

/// The first `K` moments over [0, s].
#[inline(always)]
fn integrate<const K: usize>(heading: f64, kappa0: f64, sharpness: f64, s: f64) -> [Vec2; K] {
    let steepest = kappa0.abs().max((kappa0 + sharpness * s).abs());
    let turn = 0.5 * steepest * s.abs();
    let gentle = turn <= GENTLE;
    // A NaN falls to one panel and comes out as NaN.
    let count = if turn > STEEP { (turn * (1.0 / STEEP)).min(MAX_PANELS) as usize + 1 } else { 1 };
    let half = s / (2 * count) as f64;
    let bend = 0.5 * sharpness * half * half;
    let mut total = [Vec2::ZERO; K];
    for i in 0..count {
        let mid = half * (2 * i + 1) as f64;
        let slope = (kappa0 + sharpness * mid) * half;
        // The terms left out are below 1e-16: 0.42 rad to the 14th over 14!, 0.21 rad to the 12th over 12!.
        let local: [Vec2; K] = if gentle {
            panel::<K, 7, 6, 4>(&NODES_8, &WEIGHTS_8, slope, bend)
        } else {
            panel::<K, 10, 8, 6>(&NODES_12, &WEIGHTS_12, slope, bend)
        };
        let (sin, cos) = sin_cos(heading + mid * (kappa0 + 0.5 * sharpness * mid));
        // (mid + half x)ᵏ by the binomial theorem, one factor at a time: the table of moments of x^j (mid + half x)^i.
        let mut table = local.map(|v| Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y) * half);
        for k in 0..K {
            total[k] += table[0];
            for j in 0..K - 1 - k {
                table[j] = table[j] * mid + table[j + 1] * half;
            }
        }
    }
    total
}

/// The displacement `M_0 = ∫₀ˢ e^{iθ(u)} du` with `θ(u) = heading + kappa0 u + sharpness u²/2`.
///
/// Accurate to 1e-13 × |s| for |turning| ≤ 100 rad and headings of that size. `s` may be negative.
#[must_use]
pub fn displacement(heading: f64, kappa0: f64, sharpness: f64, s: f64) -> Vec2 {
    integrate::<1>(heading, kappa0, sharpness, s)[0]
}

/// Position and unit tangent at arc length `h` from a point with the given curvature, in the frame of that point: x along
/// its tangent, y to its left.
#[inline]
pub(crate) fn local_frame(kappa: f64, sharpness: f64, h: f64) -> (Vec2, Vec2) {
    (displacement(0.0, kappa, sharpness, h), unit(h * (kappa + 0.5 * sharpness * h)))
}

/// The moments `[M_0, M_1, M_2]` over [0, s] of `θ(u) = heading + kappa0 u + sharpness u²/2`.
///
/// `M_k` is accurate to 1e-13 × |s|ᵏ⁺¹ for |turning| ≤ 100 rad.
#[must_use]
pub fn moments(heading: f64, kappa0: f64, sharpness: f64, s: f64) -> [Vec2; 3] {
    integrate::<3>(heading, kappa0, sharpness, s)
}

/// The moments `[M_0, …, M_4]` over [0, s], which second derivatives need; see [`moments`].
#[must_use]
pub fn moments_to_4(heading: f64, kappa0: f64, sharpness: f64, s: f64) -> [Vec2; 5] {
    integrate::<5>(heading, kappa0, sharpness, s)
}
