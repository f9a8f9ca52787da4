//! A closed stroke that is one closed template all around: it closes by itself, and needs no seam.

use super::guide::Guide;
use super::laid::{Laid, by_least_squares};
use super::options::FrenchCurveOptions;
use super::part::Part;
use super::pose::{Neighbours, settled};
use crate::conclude::Parts;

/// The closed template that covers one turn of a ring, if there is one about as long that errs by less than `most` radians and is not too far off,
/// with its error.
pub(crate) fn whole(ring: &Part, guides: &[Guide], most: f64, options: &FrenchCurveOptions) -> Option<(Laid, f64)> {
    let n = ring.cells();
    let length = ring.step * n as f64;
    let mut best: Option<(f64, usize, usize)> = None;
    for (g, guide) in guides.iter().enumerate().filter(|(_, g)| g.is_closed()) {
        if (guide.path.length() - length).abs() > ABOUT * length {
            continue;
        }
        let turnings = in_steps(&guide.turnings, n);
        for node in 0..n {
            let on_guide = turnings[node..].iter().chain(&turnings[..node]);
            let error: f64 = ring.turnings.iter().zip(on_guide).map(|(f, g)| (f - g).abs()).sum();
            if error < best.map_or(most, |b| b.0) {
                best = Some((error, g, node));
            }
        }
    }
    let (error, guide, node) = best?;
    let turn = guides[guide].path.length();
    let from = turn * node as f64 / n as f64;
    let points = &ring.points;
    let laid = by_least_squares(guides, guide, [from, from + turn], points);
    let laid = settled(&laid, points, guides, &Neighbours::NONE);
    let off = laid.distance(guides, points).largest;
    options.end_threshold.is_none_or(|threshold| off <= threshold).then_some((laid, error))
}

/// Largest difference of the lengths of stroke and template, as a share of the stroke's.
const ABOUT: f64 = 0.05;

/// The same turnings in another number of steps.
fn in_steps(turnings: &[f64], count: usize) -> Vec<f64> {
    let mut sums = vec![0.0];
    for (i, t) in turnings.iter().enumerate() {
        sums.push(sums[i] + t);
    }
    let cells = turnings.len();
    let turned = |i: usize| {
        let v = (i * cells) as f64 / count as f64;
        let k = (v as usize).min(cells - 1);
        sums[k] + (sums[k + 1] - sums[k]) * (v - k as f64)
    };
    (0..count).map(|i| turned(i + 1) - turned(i)).collect()
}

/// The whole template where it lies: all its segments with its own joins.
pub(crate) fn all_around(laid: &Laid, guides: &[Guide]) -> Parts {
    let moved = guides[laid.guide].path.spline().transformed(&laid.similarity());
    (moved.segments().to_vec(), moved.joins().to_vec(), true)
}
