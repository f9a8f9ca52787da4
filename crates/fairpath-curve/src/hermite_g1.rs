//! G1 Hermite interpolation: two points with headings come in, the one clothoid segment through them goes out.
//!
//! With the chord as unit and as x axis, the heading of the segment is `A t² + (delta − A) t + phi0` over the unit interval, and
//! the one unknown `A` is a root of the segment's lateral offset at its end (Bertolazzi and Frego, "G1 fitting with
//! clothoids", 2015, equation 14). They prove that the root of this branch exists and is the only one. The first
//! guess is a polynomial of our own, fitted to exact roots; where Newton's method leaves the branch, the two angles are
//! grown from zero, whence the root can be followed.

use crate::moments::moments;
use crate::segment::Segment;
use crate::trig::{angle_of, wrap_angle};
use kurbo::Point;

/// Newton's step and the residuals at `A`: lateral offset, its derivative, and the advance along the chord.
fn offset(phi0: f64, phi1: f64, a: f64) -> (f64, f64, f64) {
    let [m0, m1, m2] = moments(phi0, phi1 - phi0 - a, 2.0 * a, 1.0);
    (m0.y, m2.x - m1.x, m0.x)
}

/// Follows Newton's method from a guess; `None` where it does not settle on a segment that goes forward.
fn newton(phi0: f64, phi1: f64, mut a: f64) -> Option<f64> {
    for _ in 0..20 {
        let (lateral, slope, _) = offset(phi0, phi1, a);
        let step = lateral / slope;
        if !(step.is_finite() && step.abs() < 10.0) {
            return None;
        }
        a -= step;
        if step.abs() <= 1e-13 * (1.0 + a.abs()) {
            return (offset(phi0, phi1, a).2 > 0.0).then_some(a);
        }
    }
    None
}

/// A polynomial for `A / (phi0 + phi1)`, least squares over all angles, off by less than 0.09; exact roots go
/// smoothly from 3 at zero angles to 0.28.
fn guess(phi0: f64, phi1: f64) -> f64 {
    use std::f64::consts::FRAC_1_PI;
    let (x, y) = ((phi0 * FRAC_1_PI) * (phi0 * FRAC_1_PI), (phi1 * FRAC_1_PI) * (phi1 * FRAC_1_PI));
    let product = phi0 * phi1 * (FRAC_1_PI * FRAC_1_PI);
    let sum = x + y;
    (phi0 + phi1)
        * (2.9914 + 0.7429 * product - 0.5194 * sum - 0.4954 * product * product + 0.2622 * product * sum
            - 0.0274 * (x * x + y * y))
}

/// The unknown of the unit problem for angles in [−π, π].
fn root(phi0: f64, phi1: f64) -> Option<f64> {
    let first = guess(phi0, phi1);
    // The branch lies near its guess; a root far from it belongs to a curve with loops.
    if let Some(a) = newton(phi0, phi1, first)
        && (a - first).abs() < 0.5
    {
        return Some(a);
    }
    let steps = 32;
    (1..=steps).try_fold(0.0, |ratio, i| {
        let part = f64::from(i) / f64::from(steps);
        let (p, q) = (phi0 * part, phi1 * part);
        let from = if i == 1 { guess(p, q) } else { ratio * f64::from(i) / f64::from(i - 1) };
        newton(p, q, from)
    })
}

/// The clothoid segment from one point and heading to another, the shortest and least wound of the many there are.
///
/// `start_heading` and `end_heading` are in radians; their differences to the chord are reduced to (−π, π], and the
/// segment's own heading begins with `start_heading` exactly and ends with `end_heading` but for whole turns. Lines and arcs come
/// out where they fit. The end is met within 1e-13 × length.
///
/// `None` where the points coincide, a value is not finite, or both headings point straight back along the chord in
/// opposite senses, which only an infinite circle would join.
#[must_use]
pub fn hermite_g1(start: Point, start_heading: f64, end: Point, end_heading: f64) -> Option<Segment> {
    let chord = end - start;
    let r = chord.hypot2().sqrt();
    if !(r.is_finite() && r > 0.0 && start_heading.is_finite() && end_heading.is_finite()) {
        return None;
    }
    let direction = angle_of(chord);
    let (phi0, phi1) = (wrap_angle(start_heading - direction), wrap_angle(end_heading - direction));
    let delta = phi1 - phi0;
    let a = root(phi0, phi1)?;
    let length = r / offset(phi0, phi1, a).2;
    let segment = Segment::clothoid(start, start_heading, length, (delta - a) / length, (delta + a) / length);
    (segment.is_valid() && length < 1e8 * r).then_some(segment)
}
