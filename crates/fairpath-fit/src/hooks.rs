//! Ends that the pen drew back over themselves as it was set down or lifted.

use crate::polyline::Polyline;
use fairpath_curve::Vec2;

/// Longest hook, as a multiple of the distance that a fit may have.
const LONGEST: f64 = 3.0;

/// A hook stays this near to the stroke that it was drawn over, as a share of that distance.
const NEAR: f64 = 0.5;

/// The stroke is at least this many times as long as its longest hook.
const STROKE: f64 = 4.0;

/// The points of an open stroke without the hooks at its ends: what is left passes within half of `max_error` of all points that go.
pub(crate) fn unhooked(points: &[Vec2], max_error: f64) -> &[Vec2] {
    let line = Polyline::new(points.to_vec());
    let (longest, near) = (LONGEST * max_error, NEAR * max_error);
    if line.length() < STROKE * longest {
        return points;
    }
    let reversed: Vec<Vec2> = points.iter().rev().copied().collect();
    let end = points.len() - hook(&reversed, longest, near);
    &points[hook(points, longest, near)..end]
}

/// How many points at the start belong to a hook.
fn hook(points: &[Vec2], longest: f64, near: f64) -> usize {
    let line = Polyline::new(points.to_vec());
    let within = line.s.partition_point(|&s| s <= longest);
    let turns_back = |i: usize| {
        let (into, out) = (points[i] - points[i - 1], points[i + 1] - points[i]);
        into.dot(out) < -0.5 * (into.hypot2() * out.hypot2()).sqrt()
    };
    let lies_along = |i: usize| {
        let past = line.s.partition_point(|&s| s <= line.s[i] + longest + near);
        let kept = &points[i..(past + 1).min(points.len())];
        points[..i].iter().all(|&p| kept.windows(2).any(|edge| distance_to_edge(p, edge[0], edge[1]) <= near))
    };
    (1..within.min(points.len() - 1)).rev().find(|&i| turns_back(i) && lies_along(i)).unwrap_or(0)
}

fn distance_to_edge(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let edge = b - a;
    let along = ((p - a).dot(edge) / edge.hypot2()).clamp(0.0, 1.0);
    (p - a - edge * along).hypot2().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(xy: &[(f64, f64)]) -> Vec<Vec2> {
        xy.iter().map(|&(x, y)| Vec2::new(x, y)).collect()
    }

    #[test]
    fn an_end_drawn_back_over_itself_is_no_part_of_the_stroke() {
        let stroke =
            points(&[(5.0, 1.0), (0.0, 0.0), (30.0, 0.0), (60.0, 0.0), (100.0, 0.0), (92.0, 1.0), (88.0, -1.0)]);
        assert_eq!(unhooked(&stroke, 5.0), &stroke[1..5]);
    }

    #[test]
    fn a_leg_that_leads_away_or_is_long_stays() {
        let away = points(&[(0.0, 0.0), (30.0, 0.0), (60.0, 0.0), (100.0, 0.0), (90.0, 6.0)]);
        assert_eq!(unhooked(&away, 5.0), &away[..]);
        let long = points(&[(0.0, 0.0), (30.0, 0.0), (60.0, 0.0), (100.0, 0.0), (80.0, 0.0)]);
        assert_eq!(unhooked(&long, 5.0), &long[..]);
        let short = points(&[(0.0, 0.0), (20.0, 0.0), (15.0, 0.0)]);
        assert_eq!(unhooked(&short, 5.0), &short[..]);
    }
}
