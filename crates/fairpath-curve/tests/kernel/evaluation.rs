//! Positions and derivatives against independent integration, dual numbers and finite differences.

use crate::common::segment;
use fairpath_curve::{Point, Segment, Vec2};
use num_dual::{Dual64, DualNum, HyperDual64};
use proptest::prelude::*;

/// Heading, curvatures, length and arc length as numbers of any kind.
struct Parameters<D> {
    heading: D,
    kappa0: D,
    kappa1: D,
    length: D,
    s: D,
}

/// The displacement by composite Boole-like quadrature: three-point Gauss on very many panels, in any number type.
fn displacement<D: DualNum<Primitive = f64> + Copy>(p: &Parameters<D>, panels: usize) -> [D; 2] {
    let node = 0.6_f64.sqrt();
    let mut sum = [D::from(0.0), D::from(0.0)];
    for i in 0..panels {
        for (x, w) in [(-node, 5.0 / 18.0), (0.0, 8.0 / 18.0), (node, 5.0 / 18.0)] {
            let u = p.s * ((i as f64 + 0.5 + 0.5 * x) / panels as f64);
            let theta = p.heading + p.kappa0 * u + (p.kappa1 - p.kappa0) / p.length * u * u * 0.5;
            sum[0] += theta.cos() * w;
            sum[1] += theta.sin() * w;
        }
    }
    sum.map(|v| v * p.s / panels as f64)
}

fn parameters<D: From<f64>>(s: &Segment, at: f64) -> Parameters<D> {
    Parameters {
        heading: s.heading.into(),
        kappa0: s.kappa0.into(),
        kappa1: s.kappa1.into(),
        length: s.length.into(),
        s: at.into(),
    }
}

fn panels(s: &Segment) -> usize {
    30 + (20.0 * s.kappa0.abs().max(s.kappa1.abs()) * s.length) as usize
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn positions_agree_with_brute_force_integration(s in segment(100.0), u in 0.0..1.0) {
        let at = u * s.length;
        let [x, y] = displacement(&parameters::<f64>(&s, at), 6 * panels(&s));
        let off = (s.point_at(at) - (s.start + Vec2::new(x, y))).hypot();
        prop_assert!(off <= 1e-12 * s.length, "{:e}", off / s.length);
    }

    #[test]
    fn first_derivatives_agree_with_dual_numbers(s in segment(60.0), u in 0.0..1.0) {
        let at = u * s.length;
        let jacobian = s.position_jacobian(at);
        let one = |which: usize| {
            let mut p = parameters::<Dual64>(&s, at);
            let slot = [&mut p.heading, &mut p.kappa0, &mut p.kappa1, &mut p.length, &mut p.s];
            for (i, d) in slot.into_iter().enumerate() {
                if i == which {
                    *d = d.derivative();
                }
            }
            let [x, y] = displacement(&p, 3 * panels(&s));
            Vec2::new(x.eps, y.eps)
        };
        // Turning enters the derivative by length; the others are bounded by powers of the length alone.
        let l = s.length;
        let turn = (s.kappa1 - s.kappa0).abs() * l;
        for (got, which, scale) in [
            (jacobian.heading, 0, l),
            (jacobian.kappa0, 1, l * l),
            (jacobian.kappa1, 2, l * l),
            (jacobian.length, 3, 1.0 + turn),
            (s.tangent_at(at), 4, 1.0 + turn),
        ] {
            let off = (got - one(which)).hypot();
            prop_assert!(off <= 1e-10 * scale, "parameter {which}: {:e}", off / scale);
        }
    }

    #[test]
    fn second_derivatives_agree_with_hyperdual_numbers(s in segment(30.0), u in 0.0..1.0) {
        let at = u * s.length;
        let hessian = s.position_hessian(at);
        let pair = |a: usize, b: usize| {
            let mut p = parameters::<HyperDual64>(&s, at);
            let slot = [&mut p.heading, &mut p.kappa0, &mut p.kappa1, &mut p.length];
            for (i, d) in slot.into_iter().enumerate() {
                if i == a {
                    d.eps1 = 1.0;
                }
                if i == b {
                    d.eps2 = 1.0;
                }
            }
            let [x, y] = displacement(&p, 3 * panels(&s));
            Vec2::new(x.eps1eps2, y.eps1eps2)
        };
        let l = s.length;
        let turn = 1.0 + (s.kappa1 - s.kappa0).abs() * l;
        let unit = [1.0, l, l, turn / l];
        for a in 0..4 {
            for b in 0..4 {
                let off = (hessian[a][b] - pair(a, b)).hypot();
                let scale = l * unit[a] * unit[b];
                prop_assert!(off <= 1e-10 * scale, "{a} {b}: {:e}", off / scale);
            }
        }
    }

    #[test]
    fn derivatives_agree_with_finite_differences(s in segment(10.0), u in 0.1..1.0) {
        let at = u * s.length;
        let j = s.position_jacobian(at);
        let l = s.length;
        let difference = |change: &dyn Fn(f64) -> Segment, step: f64| {
            (change(step).point_at(at) - change(-step).point_at(at)) / (2.0 * step)
        };
        let h = 1e-5;
        for (got, wanted, scale) in [
            (j.heading, difference(&|e| Segment { heading: s.heading + e, ..s }, h), l),
            (j.kappa0, difference(&|e| Segment { kappa0: s.kappa0 + e, ..s }, h / l), l * l),
            (j.kappa1, difference(&|e| Segment { kappa1: s.kappa1 + e, ..s }, h / l), l * l),
            (j.length, difference(&|e| Segment { length: l + e, ..s }, h * l), 1.0),
        ] {
            prop_assert!((got - wanted).hypot() <= 1e-6 * scale, "{:e}", (got - wanted).hypot() / scale);
        }
    }

    #[test]
    fn derivatives_are_continuous_at_the_straight_and_the_circular(h in -3.0..3.0, k in -5.0..5.0, d in 1e-18..1e-9) {
        for (exact, beside) in [
            (Segment::line(Point::ORIGIN, h, 1.0), Segment::clothoid(Point::ORIGIN, h, 1.0, d, -d)),
            (Segment::arc(Point::ORIGIN, h, 1.0, k), Segment::clothoid(Point::ORIGIN, h, 1.0, k, k + d)),
        ] {
            let (a, b) = (exact.position_jacobian(0.8), beside.position_jacobian(0.8));
            for (x, y) in [(a.heading, b.heading), (a.kappa0, b.kappa0), (a.kappa1, b.kappa1), (a.length, b.length)] {
                prop_assert!((x - y).hypot() <= 2.0 * d + 1e-15);
            }
        }
    }
}

#[test]
fn an_almost_circular_clothoid_is_not_lost() {
    // Another program evaluates this 20 px off: its series divides by the sharpness.
    let kappa = 0.1;
    for length in [10.0, 100.0, 600.0] {
        let clothoid = Segment::clothoid(Point::ORIGIN, 0.0, length, kappa, kappa + 2e-12 * length);
        let angle = kappa * length;
        let circle = Point::new(libm::sin(angle) / kappa, (1.0 - libm::cos(angle)) / kappa);
        // The sharpness itself moves the end by 2e-12 × length³ / 6 at most.
        let moved = 2e-12 * length * length * length / 6.0;
        assert!((clothoid.end() - circle).hypot() <= moved + 1e-12 * length, "{length}");
    }
}

#[test]
fn headings_of_many_turns_lose_only_their_own_rounding() {
    let a = Segment::clothoid(Point::ORIGIN, 0.3, 1.0, 1.0, 3.0);
    for turns in [1.0, 10.0, 1e3, 1e5] {
        let b = Segment { heading: 0.3 + turns * std::f64::consts::TAU, ..a };
        assert!((a.end() - b.end()).hypot() <= 1e-15 * (1.0 + 8.0 * turns));
    }
}

#[test]
fn values_that_are_not_finite_come_out_as_nan_and_huge_turnings_in_bounded_time() {
    let s = Segment::clothoid(Point::ORIGIN, 0.0, 1.0, 0.0, f64::NAN);
    assert!(s.end().x.is_nan());
    let s = Segment::clothoid(Point::ORIGIN, 0.0, 1.0, 0.0, 1e300);
    let _ = (s.end(), s.bounding_box(), s.position_jacobian(1.0));
}
