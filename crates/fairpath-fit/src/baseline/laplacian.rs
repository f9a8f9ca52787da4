//! Laplacian smoothing: a stroke in, a polyline out. What figure 3 of McCrae and Singh (2008) compares with; it shrinks bends, and what it leaves is
//! no curve but points.

use super::options::LaplacianOptions;
use super::{evenly, stretches};
use crate::conclude::Parts;
use crate::track::{Shape, Track};
use fairpath_curve::{Continuity, Segment, Vec2, trig};

/// The smoothed polyline and the number of its edges. Ends and corners stay where they are.
pub(crate) fn smoothed(track: &Track, options: &LaplacianOptions) -> Option<(Parts, usize)> {
    let ring = track.shape == Shape::Ring;
    let mut points: Vec<Vec2> = Vec::new();
    for data in stretches(track) {
        let mut part = evenly(data, options.spacing, if ring { 3.0 } else { 1.0 });
        blur(&mut part, ring, options.strength, options.iterations);
        points.extend_from_slice(if points.is_empty() { &part } else { &part[1..] });
    }
    let edges: Vec<Segment> = points
        .windows(2)
        .map(|p| (p[0], p[1] - p[0]))
        .map(|(start, edge)| Segment::line(start.to_point(), trig::angle_of(edge), edge.hypot2().sqrt()))
        .filter(Segment::is_valid)
        .collect();
    let closed = track.shape != Shape::Open;
    let count = edges.len();
    let joins = vec![Continuity::G0; count.checked_sub(usize::from(!closed))?];
    Some(((edges, joins, closed), count))
}

/// Moves all points at once towards the middle of their neighbours; the ends stay, those of a ring, which are one point, are as the others.
pub(crate) fn blur(points: &mut [Vec2], ring: bool, strength: f64, iterations: u32) {
    let last = points.len() - 1;
    let mut before = points.to_vec();
    for _ in 0..iterations {
        before.copy_from_slice(points);
        let moved = |a: Vec2, b: Vec2, c: Vec2| b + ((a + c) * 0.5 - b) * strength;
        for i in 1..last {
            points[i] = moved(before[i - 1], before[i], before[i + 1]);
        }
        if ring {
            points[0] = moved(before[last - 1], before[0], before[1]);
            points[last] = points[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zigzag_is_flattened_and_its_ends_stay() {
        let mut points: Vec<Vec2> = (0..21).map(|i| Vec2::new(f64::from(i), f64::from(i % 2))).collect();
        let ends = (points[0], points[20]);
        blur(&mut points, false, 0.5, 50);
        assert_eq!((points[0], points[20]), ends);
        assert!(points[5..16].iter().all(|p| (p.y - 0.5).abs() < 0.2), "{points:?}");
    }

    #[test]
    fn a_circle_shrinks_alike_everywhere() {
        let mut points: Vec<Vec2> =
            (0..=40).map(|i| trig::unit(f64::from(i % 40) * std::f64::consts::TAU / 40.0) * 30.0).collect();
        blur(&mut points, true, 0.5, 20);
        let radii: Vec<f64> = points.iter().map(|p| p.hypot2().sqrt()).collect();
        assert!(radii.iter().all(|r| (r - radii[0]).abs() < 1e-9 && *r < 29.9), "{radii:?}");
    }
}
