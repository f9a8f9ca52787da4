//! Generators and reference computations shared by the tests.

use fairpath_curve::{Continuity, Point, Segment, Spline};
use proptest::prelude::*;

/// A magnitude over many decades, either sign, or exactly zero.
fn magnitude(low: i32, high: i32) -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        6 => (f64::from(low)..f64::from(high), any::<bool>())
            .prop_map(|(e, minus)| if minus { -libm::exp10(e) } else { libm::exp10(e) }),
    ]
}

/// Headings, with those near ±π, multiples of π/2 and whole turns over-represented.
pub(crate) fn heading() -> impl Strategy<Value = f64> {
    use std::f64::consts::{FRAC_PI_2, PI};
    prop_oneof![-PI..PI, (-4..=4_i32, magnitude(-16, -6)).prop_map(|(k, e)| f64::from(k) * FRAC_PI_2 + e), -30.0..30.0,]
}

/// Segments of unit length with the given greatest |turning at either end curvature|, most of them nearly degenerate.
fn unit_segment(turn: f64) -> impl Strategy<Value = Segment> {
    let end = move || prop_oneof![2 => -turn..turn, 1 => -3.0..3.0, 1 => magnitude(-18, 0)];
    prop_oneof![
        (heading(), end(), end()).prop_map(|(h, a, b)| Segment::clothoid(Point::ORIGIN, h, 1.0, a, b)),
        // A sharpness that is almost nothing.
        (heading(), end(), magnitude(-18, -3)).prop_map(|(h, a, d)| Segment::clothoid(Point::ORIGIN, h, 1.0, a, a + d)),
        (heading(), end()).prop_map(|(h, a)| Segment::arc(Point::ORIGIN, h, 1.0, a)),
        // An inflection close to one end.
        (heading(), end(), 1e-9..1e-2).prop_map(|(h, a, d)| Segment::clothoid(Point::ORIGIN, h, 1.0, a, -a * d)),
    ]
}

/// Segments with lengths from 1e-6 to 1e6 and curvatures times length of at most `turn`.
pub(crate) fn segment(turn: f64) -> impl Strategy<Value = Segment> {
    (unit_segment(turn), -6.0..6.0, -1.0..1.0, -1.0..1.0).prop_map(|(s, e, x, y)| {
        let length = libm::exp10(e);
        Segment {
            start: Point::new(x * length, y * length),
            length,
            kappa0: s.kappa0 / length,
            kappa1: s.kappa1 / length,
            ..s
        }
    })
}

/// Open G1 splines of up to six segments about the size of one.
pub(crate) fn spline() -> impl Strategy<Value = Spline> {
    (prop::collection::vec(unit_segment(4.0), 1..6), any::<bool>()).prop_map(|(mut parts, corners)| {
        let mut pose = parts[0].start_pose();
        for part in &mut parts {
            part.start = pose.point;
            part.heading = pose.heading + if corners { 1.0 } else { 0.0 };
            pose = part.end_pose();
        }
        let join = if corners { Continuity::G0 } else { Continuity::G1 };
        let joins = vec![join; parts.len() - 1];
        Spline::new(parts, joins, false).expect("chained parts make a spline")
    })
}

/// The least distance found by sampling and golden-section refinement of the best samples.
pub(crate) fn distance_by_sampling(segment: &Segment, point: Point, samples: usize) -> f64 {
    let distance = |s: f64| (segment.point_at(s) - point).hypot2().sqrt();
    let at = |i: usize| segment.length * i as f64 / samples as f64;
    let d: Vec<f64> = (0..=samples).map(|i| distance(at(i))).collect();
    let mut best = f64::INFINITY;
    let least = d.iter().copied().fold(f64::INFINITY, f64::min);
    for i in 0..=samples {
        best = best.min(d[i]);
        let lowest = (i == 0 || d[i] <= d[i - 1]) && (i == samples || d[i] <= d[i + 1]);
        if lowest && d[i] - least <= segment.length / samples as f64 {
            let (mut a, mut b) = (at(i.saturating_sub(1)), at((i + 1).min(samples)));
            for _ in 0..60 {
                let (c, e) = (a + 0.381_966 * (b - a), b - 0.381_966 * (b - a));
                if distance(c) < distance(e) { b = e } else { a = c }
            }
            best = best.min(distance(0.5 * (a + b)));
        }
    }
    best
}
