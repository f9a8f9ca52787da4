//! Sine and cosine with the same bits on every platform.
//!
//! The standard library's `sin` and `cos` come from the platform and differ between systems and the browser, so all
//! of Fairpath's mathematics takes them from here: [`sin_cos`] for any angle, and [`sin_cos_small`] for the bounded angles
//! of quadrature panels, where a polynomial is faster and vectorises.

use kurbo::Vec2;

/// π/2 in three parts, the first two of 33 bits, so that their products with whole numbers below 2²⁰ are exact.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// The largest angle reduced by [`HALF_PI`]; larger ones go to libm.
const REDUCIBLE: f64 = 1e6;

/// Sine and cosine of any angle in radians with an absolute error below 4e-16, the same bits on every platform.
#[inline]
#[must_use]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() <= SMALL_ANGLE {
        return sin_cos_small(angle);
    }
    if angle.abs() > REDUCIBLE || angle.is_nan() {
        return libm::sincos(angle);
    }
    // Adding and subtracting 1.5 × 2⁵² rounds to the nearest whole number.
    let quarter = (angle * std::f64::consts::FRAC_2_PI + 6_755_399_441_055_744.0) - 6_755_399_441_055_744.0;
    let rest = ((angle - quarter * HALF_PI[0]) - quarter * HALF_PI[1]) - quarter * HALF_PI[2];
    let (sin, cos) = sin_cos_small(rest);
    match (quarter as i64) & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The largest angle that [`sin_cos_small`] takes, in radians.
pub const SMALL_ANGLE: f64 = 1.0;

/// Sine and cosine of an angle of at most [`SMALL_ANGLE`] in magnitude, with an absolute error below 3e-16.
///
/// Taylor polynomials to the 17th and 18th degree: the first omitted terms are 1/19! = 8e-18 and 1/20! = 4e-19.
#[inline]
#[must_use]
pub fn sin_cos_small(angle: f64) -> (f64, f64) {
    let x = angle * angle;
    // The formatter takes a minute for as deep a nest.
    #[rustfmt::skip]
    let sin = angle
        * (1.0
            + x * (-1.0 / 6.0
                + x * (1.0 / 120.0
                    + x * (-1.0 / 5040.0
                        + x * (1.0 / 362_880.0
                            + x * (-1.0 / 39_916_800.0
                                + x * (1.0 / 6_227_020_800.0
                                    + x * (-1.0 / 1_307_674_368_000.0 + x * (1.0 / 355_687_428_096_000.0)))))))));
    #[rustfmt::skip]
    let cos = 1.0
        + x * (-0.5
            + x * (1.0 / 24.0
                + x * (-1.0 / 720.0
                    + x * (1.0 / 40_320.0
                        + x * (-1.0 / 3_628_800.0
                            + x * (1.0 / 479_001_600.0
                                + x * (-1.0 / 87_178_291_200.0
                                    + x * (1.0 / 20_922_789_888_000.0 - x * (1.0 / 6_402_373_705_728_000.0)))))))));
    (sin, cos)
}

/// The unit vector with the given heading in radians.
#[inline]
#[must_use]
pub fn unit(heading: f64) -> Vec2 {
    let (sin, cos) = sin_cos(heading);
    Vec2::new(cos, sin)
}

/// The angle of a vector in radians in (−π, π], zero for the null vector, the same bits on every platform.
#[inline]
#[must_use]
pub fn angle_of(v: Vec2) -> f64 {
    libm::atan2(v.y, v.x)
}

/// The angle reduced to [−π, π) by whole turns.
#[inline]
#[must_use]
pub fn wrap_angle(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if (-PI..PI).contains(&angle) {
        return angle;
    }
    let wrapped = angle - TAU * libm::floor((angle + PI) / TAU);
    if wrapped >= PI { wrapped - TAU } else { wrapped }
}
