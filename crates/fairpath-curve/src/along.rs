//! A curve that is known by its poses as a chain of clothoids: poses in, segments and their joins out.

use crate::greedy::{Tolerance, longest_pieces};
use crate::hermite_g1::hermite_g1;
use crate::hermite_g2::hermite_g2;
use crate::segment::{Pose, Segment};
use crate::spline::Continuity;
use crate::trig::{angle_of, unit, wrap_angle};
use kurbo::Point;

/// Clothoid segments along a curve, within `accuracy` of it, and the joins between them.
///
/// `pose(t)` is the curve's pose for `t` in 0 … 1: its heading and curvature must belong to its points, and be continuous for the joins to be
/// G2. Every pose at which pieces meet is met to rounding, the first and the last included. Where curvature grows beyond all bounds, as in
/// a cusp, or a piece cannot be made, the curve is followed by pieces with G1 or G0 joins instead; the joins say so.
///
/// The error is measured at 16 places of each piece, so that what happens between two of them on a curve that wiggles more finely
/// than its poses tell is not seen. Each piece is three clothoids of little variation of curvature ([`hermite_g2`]), or one line where the
/// curve is straight, and as long as the accuracy allows.
///
/// An empty answer means that the curve has no length or a pose is not finite.
#[must_use]
pub fn clothoids_along(pose: impl Fn(f64) -> Pose, accuracy: f64) -> (Vec<Segment>, Vec<Continuity>) {
    let tolerance = Tolerance { accuracy, order: ORDER, shortest: SHORTEST };
    let pieces = longest_pieces(1.0, &tolerance, |_| 1.0, |from, to| piece(&pose, from, to));
    let (mut segments, mut joins): (Vec<Segment>, Vec<Continuity>) = (Vec::new(), Vec::new());
    let mut smooth = Continuity::G0;
    for Piece { chain, within } in pieces {
        if chain.is_empty() {
            continue;
        }
        if !segments.is_empty() {
            joins.push(smooth.min(within));
        }
        joins.resize(joins.len() + chain.len() - 1, Continuity::G2);
        segments.extend(chain);
        smooth = within;
    }
    (segments, joins)
}

/// Power of a piece's length with which its error grows.
const ORDER: f64 = 5.0;

/// Pieces are never shorter than this share of the curve.
const SHORTEST: f64 = 1e-4;

/// Places at which a piece is compared with the curve.
const PLACES: usize = 16;

/// A part of the chain that begins and ends on the curve.
struct Piece {
    chain: Vec<Segment>,
    /// How well its ends agree with the curve's poses: a join is no better than the worse of its sides.
    within: Continuity,
}

/// The piece between two parameters and its largest distance from the curve.
fn piece(pose: &impl Fn(f64) -> Pose, from: f64, to: f64) -> (f64, Piece) {
    let (start, end) = (pose(from), pose(to));
    let places: Vec<Point> = (1..PLACES).map(|i| pose(from + (to - from) * i as f64 / PLACES as f64).point).collect();
    let made = straight(&start, &end)
        .map(|line| (vec![line], Continuity::G2))
        .or_else(|| hermite_g2(start, end).map(|three| (three.to_vec(), Continuity::G2)))
        .filter(|(chain, _)| winds_little(chain, &places))
        .or_else(|| {
            let one = hermite_g1(start.point, start.heading, end.point, end.heading)?;
            Some((vec![one], Continuity::G1)).filter(|(chain, _)| winds_little(chain, &places))
        })
        .or_else(|| {
            let chord = end.point - start.point;
            let line = Segment::line(start.point, angle_of(chord), chord.hypot2().sqrt());
            line.is_valid().then(|| (vec![line], Continuity::G0))
        });
    let Some((chain, within)) = made else {
        return (0.0, Piece { chain: Vec::new(), within: Continuity::G0 });
    };
    let away = |p: &Point| chain.iter().map(|s| s.nearest(*p).distance).fold(f64::INFINITY, f64::min);
    (places.iter().map(away).fold(0.0, f64::max), Piece { chain, within })
}

/// The line between two poses that lie on it.
fn straight(start: &Pose, end: &Pose) -> Option<Segment> {
    let chord = end.point - start.point;
    let length = chord.hypot2().sqrt();
    // A line keeps what its joins claim only where curvature is zero.
    let level = start.curvature == 0.0 && end.curvature == 0.0;
    let along = |pose: &Pose| {
        wrap_angle(pose.heading - angle_of(chord)).abs() < STRAIGHT && chord.dot(unit(pose.heading)) > 0.0
    };
    let line = Segment::line(start.point, start.heading, length);
    (level && along(start) && along(end)).then_some(line).filter(Segment::is_valid)
}

/// Headings that differ by less are one, radians.
const STRAIGHT: f64 = 1e-12;

/// Whether a chain is hardly longer than the polyline of the places between its ends: a solution with a loop is none.
fn winds_little(chain: &[Segment], places: &[Point]) -> bool {
    let (Some(first), Some(last)) = (chain.first(), chain.last()) else { return false };
    let stops = std::iter::once(first.start).chain(places.iter().copied()).chain([last.end()]);
    let stops: Vec<Point> = stops.collect();
    let polyline: f64 = stops.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
    chain.iter().map(|s| s.length).sum::<f64>() < LOOSEST * polyline
}

/// A piece may be this much longer than the polyline of [`PLACES`] places: that of a quarter of a circle is 0.2 % shorter.
const LOOSEST: f64 = 1.2;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::Spline;
    use kurbo::{CubicBez, ParamCurve, ParamCurveCurvature, ParamCurveDeriv};
    use proptest::prelude::*;

    fn pose(cubic: &CubicBez, t: f64) -> Pose {
        let tangent = cubic.deriv().eval(t).to_vec2();
        // kurbo counts turns from y to x as positive.
        Pose { point: cubic.eval(t), heading: angle_of(tangent), curvature: -cubic.curvature(t) }
    }

    #[test]
    fn a_parabola_is_followed_by_few_pieces() {
        let cubic = CubicBez::new((0.0, 0.0), (40.0, 0.0), (80.0, 20.0), (120.0, 60.0));
        let (segments, joins) = clothoids_along(|t| pose(&cubic, t), 0.01);
        assert!(segments.len() <= 6 && joins.iter().all(|&j| j == Continuity::G2), "{segments:?} {joins:?}");
        Spline::new(segments, joins, false).unwrap();
    }

    #[test]
    fn a_straight_curve_is_one_line() {
        let at = |t: f64| Pose {
            point: Point::new(30.0 * t, 40.0 * t),
            heading: angle_of((3.0, 4.0).into()),
            curvature: 0.0,
        };
        let (segments, _) = clothoids_along(at, 0.01);
        assert_eq!(segments.len(), 1);
        assert!((segments[0].length - 50.0).abs() < 1e-12);
    }

    #[test]
    fn poses_that_are_nowhere_make_nothing() {
        let nowhere = |_| Pose { point: Point::new(f64::NAN, 0.0), heading: 0.0, curvature: 0.0 };
        assert!(clothoids_along(nowhere, 0.1).0.is_empty());
        let dot = |_| Pose { point: Point::ORIGIN, heading: 0.0, curvature: 0.0 };
        assert!(clothoids_along(dot, 0.1).0.is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn any_cubic_is_followed(coordinates in prop::array::uniform8(-100.0..100.0_f64), accuracy in 0.01..1.0_f64) {
            let [a, b, c, d, e, f, g, h] = coordinates;
            let cubic = CubicBez::new((a, b), (c, d), (e, f), (g, h));
            let (segments, joins) = clothoids_along(|t| pose(&cubic, t), accuracy);
            let spline = Spline::new(segments, joins, false).unwrap();
            for i in 0..=400 {
                let at = cubic.eval(f64::from(i) / 400.0);
                // Between the places of the measurement, and where a cusp is cut, it may be a little more.
                prop_assert!(spline.nearest(at).distance < 1.5 * accuracy + 0.02, "{}", spline.nearest(at).distance);
            }
            prop_assert!((spline.length() - kurbo::ParamCurveArclen::arclen(&cubic, 1e-6)).abs() < 0.02 * spline.length() + 4.0 * accuracy);
        }
    }
}
