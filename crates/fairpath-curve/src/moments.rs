//! The moment integrals `M_k(s) = ∫₀ˢ uᵏ e^{iθ(u)} du` of a heading that is quadratic in arc length.
//!
//! They are all that lines, arcs and clothoids need: the position is `M_0`, its derivatives by heading, curvature and
//! sharpness are `i M_0`, `i M_1` and `i M_2 / 2`, and the second derivatives go on to `M_4`. There is no special case for
//! straight or circular pieces, so nothing loses its derivative near them.
//!
//! Method: Gauss–Legendre quadrature on panels of bounded turning. About the middle of a panel the heading is
//! `a x + b x²`, so that nodes that mirror each other share their sines and cosines, and all nodes of a panel are computed side by
//! side in vectors. Panels that turn little get eight nodes, the others twelve.

use crate::lanes::Lanes;
use crate::trig::{sin_cos, unit};
use kurbo::Vec2;

/// Nodes of the 8-point Gauss–Legendre rule on [−1, 1]; each stands for itself and its mirror image.
const NODES_8: [Lanes; 2] = [
    Lanes([0.183_434_642_495_649_8, 0.525_532_409_916_329]),
    Lanes([0.796_666_477_413_626_7, 0.960_289_856_497_536_2]),
];
/// Twice the weights of [`NODES_8`], once for each mirror image.
const WEIGHTS_8: [Lanes; 2] = [
    Lanes([0.725_367_566_756_724, 0.627_413_291_755_774_6]),
    Lanes([0.444_762_068_906_748_94, 0.202_457_072_580_752_5]),
];
/// Nodes of the 12-point rule.
const NODES_12: [Lanes; 3] = [
    Lanes([0.125_233_408_511_468_9, 0.367_831_498_998_180_2]),
    Lanes([0.587_317_954_286_617_5, 0.769_902_674_194_304_7]),
    Lanes([0.904_117_256_370_474_9, 0.981_560_634_246_719_2]),
];
/// Twice the weights of [`NODES_12`].
const WEIGHTS_12: [Lanes; 3] = [
    Lanes([0.498_294_091_626_805_6, 0.466_985_073_076_709_6]),
    Lanes([0.406_334_853_446_131_84, 0.320_156_657_086_692_5]),
    Lanes([0.213_878_651_990_636_86, 0.094_350_672_773_023_65]),
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

/// The moments of a panel about its middle in units of half its length, `∫₋₁¹ xᵏ e^{i(slope x + bend x²)} dx`, real and
/// imaginary parts, each still in two partial sums.
///
/// `A` and `B` are the numbers of terms for the angles `slope x` and `bend x²`, the latter at most half as large. The
/// results are written to memory because that is where the compiler begins to look for vectors.
#[inline(never)]
fn panel<const K: usize, const A: usize, const B: usize, const N: usize>(
    nodes: &[Lanes; N],
    weights: &[Lanes; N],
    slope: f64,
    bend: f64,
    moments: &mut [[Lanes; 2]; K],
) {
    let mut sums = [[Lanes::ZERO; 2]; K];
    for (&x, &weight) in nodes.iter().zip(weights) {
        let xx = x * x;
        let (a, b) = (Lanes::both(slope) * x, Lanes::both(bend) * xx);
        let (aa, bb) = (a * a, b * b);
        let re = weight * bb.polynomial::<B>(&COS);
        let im = weight * (b * bb.polynomial::<B>(&SIN));
        // Sums over a node and its mirror image: e^{ib} times 2 cos a in even moments, times 2i sin a in odd ones.
        let cos_a = aa.polynomial::<A>(&COS);
        let mut even = [cos_a * re, cos_a * im];
        let mut odd = [Lanes::ZERO; 2];
        if K > 1 {
            let sin_a = x * (a * aa.polynomial::<A>(&SIN));
            odd = [-(sin_a * im), sin_a * re];
        }
        for (k, sum) in sums.iter_mut().enumerate() {
            let term = if k % 2 == 0 { &mut even } else { &mut odd };
            if k > 1 {
                *term = term.map(|v| v * xx);
            }
            sum[0] += term[0];
            sum[1] += term[1];
        }
    }
    *moments = sums;
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
        let mut local = [[Lanes::ZERO; 2]; K];
        if gentle {
            panel::<K, 7, 6, 2>(&NODES_8, &WEIGHTS_8, slope, bend, &mut local);
        } else {
            panel::<K, 10, 8, 3>(&NODES_12, &WEIGHTS_12, slope, bend, &mut local);
        }
        let (sin, cos) = sin_cos(heading + mid * (kappa0 + 0.5 * sharpness * mid));
        // (mid + half x)ᵏ by the binomial theorem, one factor at a time: the table of moments of x^j (mid + half x)^i.
        let mut table = local.map(|[re, im]| {
            let (re, im) = (re.sum(), im.sum());
            Vec2::new(cos * re - sin * im, sin * re + cos * im) * half
        });
        for (k, total) in total.iter_mut().enumerate() {
            *total += table[0];
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

/// Sines and cosines of two angles of at most 1.25 rad side by side; written to memory as [`panel`] does.
#[inline(never)]
fn sin_cos_pair(angles: [f64; 2], out: &mut [Lanes; 2]) {
    let angles = Lanes(angles);
    let squares = angles * angles;
    *out = [angles * squares.polynomial::<10>(&SIN), squares.polynomial::<10>(&COS)];
}

/// Position and unit tangent at arc length `h` from a point with the given curvature, in the frame of that point: x along
/// its tangent, y to its left. Fast for stretches of little turning, which searches are made of.
pub(crate) fn local_frame(kappa: f64, sharpness: f64, h: f64) -> (Vec2, Vec2) {
    let steepest = kappa.abs().max((kappa + sharpness * h).abs());
    let heading = |s: f64| s * (kappa + 0.5 * sharpness * s);
    let half = 0.5 * h;
    if steepest * half.abs() > GENTLE {
        return (displacement(0.0, kappa, sharpness, h), unit(heading(h)));
    }
    let (mut moment, mut sines) = ([[Lanes::ZERO; 2]; 1], [Lanes::ZERO; 2]);
    panel::<1, 7, 6, 2>(
        &NODES_8,
        &WEIGHTS_8,
        (kappa + sharpness * half) * half,
        0.5 * sharpness * half * half,
        &mut moment,
    );
    sin_cos_pair([heading(half), heading(h)], &mut sines);
    let [Lanes([sin, sin_end]), Lanes([cos, cos_end])] = sines;
    let [[re, im]] = moment;
    let (re, im) = (re.sum(), im.sum());
    (Vec2::new(cos * re - sin * im, sin * re + cos * im) * half, Vec2::new(cos_end, sin_end))
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
