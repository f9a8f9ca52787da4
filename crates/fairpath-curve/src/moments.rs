//! The moment integrals `M_k(s) = ∫₀ˢ uᵏ e^{iθ(u)} du`, `k = 0, 1, 2`, of a heading that is quadratic in arc length.
//!
//! They are all that lines, arcs and clothoids need: the position is `M_0`, and its derivatives by heading, curvature and
//! sharpness are `i M_0`, `i M_1` and `i M_2 / 2`. There is no special case for straight or circular pieces, so
//! nothing loses its derivative near them.

use crate::trig::{sin_cos, sin_cos_small, unit};
use kurbo::Vec2;

/// Abscissae and weights of the 10-point Gauss–Legendre rule on [−1, 1]; each stands for itself and its mirror image.
pub(crate) const GAUSS_10: [(f64, f64); 5] = [
    (0.148_874_338_981_631_21, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_19, 0.269_266_719_309_996_36),
    (0.679_409_568_299_024_41, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_51, 0.149_451_349_150_580_59),
    (0.973_906_528_517_171_72, 0.066_671_344_308_688_14),
];

/// The largest product of curvature and half length of a quadrature panel, in radians. With ten nodes the error of the
/// rule is then below 1e-15 of the panel's length.
const PANEL_SLOPE: f64 = 1.0;

/// More panels than this are not taken, whatever the turning: beyond, positions lose accuracy instead of time.
const MAX_PANELS: f64 = 1e6;

fn panels(kappa0: f64, sharpness: f64, s: f64) -> usize {
    let steepest = kappa0.abs().max((kappa0 + sharpness * s).abs());
    let wanted = libm::ceil(steepest * s.abs() / (2.0 * PANEL_SLOPE));
    // A NaN falls to one panel and comes out as NaN.
    if wanted >= 1.0 { wanted.min(MAX_PANELS) as usize } else { 1 }
}

/// The displacement `M_0 = ∫₀ˢ e^{iθ(u)} du` with `θ(u) = heading + kappa0 u + sharpness u²/2`.
///
/// Accurate to 1e-12 × |s| for |turning| ≤ 100 rad.
#[must_use]
pub fn displacement(heading: f64, kappa0: f64, sharpness: f64, s: f64) -> Vec2 {
    let n = panels(kappa0, sharpness, s);
    let half = s / (2 * n) as f64;
    let mut sum = Vec2::ZERO;
    for panel in 0..n {
        let mid = half * (2 * panel + 1) as f64;
        let slope = (kappa0 + sharpness * mid) * half;
        let bend = 0.5 * sharpness * half * half;
        let (mut re, mut im) = (0.0, 0.0);
        for (x, w) in GAUSS_10 {
            let (_, cos_a) = sin_cos_small(slope * x);
            let (sin_b, cos_b) = sin_cos_small(bend * x * x);
            re += 2.0 * w * cos_a * cos_b;
            im += 2.0 * w * cos_a * sin_b;
        }
        let (sin, cos) = sin_cos(heading + mid * (kappa0 + 0.5 * sharpness * mid));
        sum += Vec2::new(cos * re - sin * im, sin * re + cos * im) * half;
    }
    sum
}

/// Position and unit tangent at arc length `h` from a point with the given curvature, in the frame of that point: x along
/// its tangent, y to its left.
#[inline]
pub(crate) fn local_frame(kappa: f64, sharpness: f64, h: f64) -> (Vec2, Vec2) {
    (displacement(0.0, kappa, sharpness, h), unit(h * (kappa + 0.5 * sharpness * h)))
}

/// The moments `[M_0, M_1, M_2]` over [0, s] of `θ(u) = heading + kappa0 u + sharpness u²/2`.
///
/// `M_k` is accurate to 1e-12 × |s|ᵏ⁺¹ for |turning| ≤ 100 rad.
#[must_use]
pub fn moments(heading: f64, kappa0: f64, sharpness: f64, s: f64) -> [Vec2; 3] {
    let n = panels(kappa0, sharpness, s);
    let half = s / (2 * n) as f64;
    let mut sum = [Vec2::ZERO; 3];
    for panel in 0..n {
        let mid = half * (2 * panel + 1) as f64;
        let slope = (kappa0 + sharpness * mid) * half;
        let bend = 0.5 * sharpness * half * half;
        // Moments about the panel's middle, in units of half its length: e^{ib} times cos a (even) or i sin a (odd).
        let mut m = [Vec2::ZERO; 3];
        for (x, w) in GAUSS_10 {
            let (sin_a, cos_a) = sin_cos_small(slope * x);
            let (sin_b, cos_b) = sin_cos_small(bend * x * x);
            let even = Vec2::new(cos_b, sin_b) * (2.0 * w * cos_a);
            m[0] += even;
            m[1] += Vec2::new(-sin_b, cos_b) * (2.0 * w * x * sin_a);
            m[2] += even * (x * x);
        }
        let (sin, cos) = sin_cos(heading + mid * (kappa0 + 0.5 * sharpness * mid));
        let [m0, m1, m2] = m.map(|v| Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y) * half);
        sum[0] += m0;
        sum[1] += m0 * mid + m1 * half;
        sum[2] += m0 * (mid * mid) + m1 * (2.0 * mid * half) + m2 * (half * half);
    }
    sum
}
