//! Sine and cosine with the same bits on every platform.
//!
//! The standard library's `sin` and `cos` come from the platform and differ between systems and the browser, so all
//! of Fairpath's mathematics takes them from here: [`sin_cos`] for any angle, and [`sin_cos_small`] for the bounded angles
//! of quadrature panels, where a polynomial is faster and vectorises.

use kurbo::Vec2;

/// Sine and cosine of any angle in radians, correctly rounded to within 1 ulp, the same bits on every platform.
#[inline]
#[must_use]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() <= SMALL_ANGLE { sin_cos_small(angle) } else { libm::sincos(angle) }
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
    let sin = angle
        * (1.0
            + x * (-1.0 / 6.0
                + x * (1.0 / 120.0
                    + x * (-1.0 / 5040.0
                        + x * (1.0 / 362_880.0
                            + x * (-1.0 / 39_916_800.0
                                + x * (1.0 / 6_227_020_800.0
                                    + x * (-1.0 / 1_307_674_368_000.0 + x * (1.0 / 355_687_428_096_000.0)))))))));
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
