//! What of a curve is compared: points at equal steps in, the angle through which it turns from node to node out.
//!
//! Strokes and templates go through this alike. A corner of a template, an impulse of curvature that no stroke has, becomes
//! the same hump as one that was drawn by hand, and integrals of the difference of curvatures see the angle of both.

use crate::linear::{cholesky, solve};
use fairpath_curve::{Vec2, trig};

/// Points for each node: every second is one.
pub(crate) const POINTS_PER_NODE: usize = 2;

/// The angles in radians through which a curve turns from each node to the next, of which there is one for every second of its `points`, at equal
/// steps.
///
/// The heading at a node is that of the parabola, in each coordinate, nearest to the points up to `reach` steps away, those nearby counting more. Near
/// the ends of an open curve the parabola is that of the outermost whole half of a neighbourhood: its middle would tell of another
/// place, and less would tell of tremor. A closed curve's last point is the one before its first.
pub(crate) fn turnings(points: &[Vec2], reach: f64, closed: bool) -> Vec<f64> {
    let nodes = if closed { points.len() / POINTS_PER_NODE } else { (points.len() - 1) / POINTS_PER_NODE + 1 };
    let headings: Vec<f64> = (0..nodes).map(|i| heading(points, i * POINTS_PER_NODE, reach, closed)).collect();
    let next = |i: usize| headings[(i + 1) % nodes];
    let cells = if closed { nodes } else { nodes - 1 };
    (0..cells).map(|i| trig::wrap_angle(next(i) - headings[i])).collect()
}

/// The heading at point `at`, radians.
pub(crate) fn heading(points: &[Vec2], at: usize, reach: f64, closed: bool) -> f64 {
    let last = (points.len() - 1) as f64;
    let place = at as f64;
    let middle =
        if closed { place } else { place.min(last - OFF_ENDS * reach).max((OFF_ENDS * reach).min(0.5 * last)) };
    let (low, high) = (libm::ceil(middle - reach), libm::floor(middle + reach));
    let (low, high) = if closed { (low, high) } else { (low.max(0.0), high.min(last)) };
    let mut moments = [0.0; 5];
    let mut sums = [Vec2::ZERO; 3];
    let n = points.len() as isize;
    let origin = points[at];
    for i in low as isize..=high as isize {
        let t = (i as f64 - middle) / reach;
        let near = (1.0 - t * t).max(LEAST);
        let mut w = near * near;
        let p = points[i.rem_euclid(n) as usize] - origin;
        for (k, moment) in moments.iter_mut().enumerate() {
            *moment += w;
            if k < 3 {
                sums[k] += p * w;
            }
            w *= t;
        }
    }
    let [m0, m1, m2, m3, m4] = moments;
    let mut matrix = [[m0, m1, m2], [m1, m2, m3], [m2, m3, m4]];
    // Three points are needed for a parabola.
    if !cholesky(&mut matrix, 3, 1e-9) {
        let (a, b) = (at.saturating_sub(1), (at + 1).min(points.len() - 1));
        return trig::angle_of(points[b] - points[a]);
    }
    let (mut x, mut y) = (sums.map(|v| v.x), sums.map(|v| v.y));
    solve(&matrix, 3, &mut x);
    solve(&matrix, 3, &mut y);
    let t = (place - middle) / reach;
    trig::angle_of(Vec2::new(x[1] + 2.0 * t * x[2], y[1] + 2.0 * t * y[2]))
}

/// Whether the heading at point `at` of an open curve that grows at its end will not change any more.
pub(crate) fn is_settled(at: usize, points: usize, reach: f64) -> bool {
    (at as f64).max(OFF_ENDS * reach) + reach <= points as f64 - 1.0
}

/// Share of the neighbourhood by which the middle of one keeps off the ends.
const OFF_ENDS: f64 = 0.6;

/// Root of the weight of the outermost points, so that they count at all where there are few.
const LEAST: f64 = 1e-3;

#[cfg(test)]
mod tests {
    use super::*;

    /// Points every 1.5 px along an arc.
    fn arc(radius: f64, count: usize) -> Vec<Vec2> {
        (0..count).map(|i| trig::unit(1.5 * i as f64 / radius) * radius).collect()
    }

    #[test]
    fn an_arc_turns_alike_up_to_its_ends() {
        for t in turnings(&arc(40.0, 81), 10.0, false) {
            // Parabolas are arcs but for the third order.
            assert!((t - 3.0 / 40.0).abs() < 5e-3, "{t}");
        }
    }

    #[test]
    fn a_closed_curve_turns_once_around() {
        let n = 84;
        let points: Vec<Vec2> = (0..n)
            .map(|i| trig::unit(std::f64::consts::TAU * f64::from(i) / f64::from(n)))
            .map(|u| Vec2::new(30.0 * u.x, 12.0 * u.y))
            .collect();
        let sum: f64 = turnings(&points, 10.0, true).iter().sum();
        assert!((sum - std::f64::consts::TAU).abs() < 1e-9, "{sum}");
    }

    #[test]
    fn the_hump_of_a_corner_holds_its_angle() {
        for angle in [0.4, 1.5, -2.0_f64] {
            let leg = |i: usize| {
                if i < 40 {
                    Vec2::new(1.5 * i as f64, 0.0)
                } else {
                    Vec2::new(60.0, 0.0) + trig::unit(angle) * (1.5 * (i - 40) as f64)
                }
            };
            let points: Vec<Vec2> = (0..81).map(leg).collect();
            let found = turnings(&points, 10.0, false);
            let sum: f64 = found.iter().sum();
            assert!((sum - angle).abs() < 1e-9, "{sum}");
            // Nothing of it is seen further away than the neighbourhood reaches.
            assert!(found[..14].iter().chain(&found[26..]).all(|t| t.abs() < 1e-9), "{found:?}");
        }
    }

    #[test]
    fn what_is_settled_does_not_change_with_further_points() {
        let points = arc(25.0, 121);
        let reach = 10.0;
        for length in [15, 31, 61] {
            let so_far = &points[..length];
            for at in (0..length).filter(|&at| is_settled(at, length, reach)) {
                assert_eq!(heading(so_far, at, reach, false), heading(&points, at, reach, false), "{at} of {length}");
            }
        }
    }
}
