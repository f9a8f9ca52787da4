//! For tests: the fairest curve through poses by a search along one coordinate after the other, which is slow, but needs no derivatives.

use super::fairest::Passed;
use fairpath_curve::{Pose, Segment, hermite_g2};

/// Variation of curvature `∫ κ'² ds` of segments, times the fifth power of their length.
pub(super) fn variation(segments: &[Segment]) -> f64 {
    let length: f64 = segments.iter().map(|s| s.length).sum();
    let sum: f64 = segments.iter().map(|s| s.sharpness() * s.sharpness() * s.length).sum();
    sum * length.powi(5)
}

fn between(from: &Pose, to: &Pose) -> Option<f64> {
    hermite_g2(*from, *to).map(|segments| variation(&segments))
}

/// Steps of the search in heading, radians, and in curvature, turning over the distance to the neighbours.
const FIRST_STEP: f64 = 0.25;
const LAST_STEP: f64 = 4e-3;

/// A step is taken that leaves at most this share of the variation.
const WORTHWHILE: f64 = 0.999;

/// The segments of the curve, three between each two poses.
pub(super) fn coordinate_search(passed: &[Passed]) -> Option<Vec<Segment>> {
    let mut poses: Vec<Pose> = passed.iter().map(|p| p.pose).collect();
    let near = |poses: &[Pose], i: usize| -> Option<f64> {
        let before = if i > 0 { between(&poses[i - 1], &poses[i])? } else { 0.0 };
        let after = if i + 1 < poses.len() { between(&poses[i], &poses[i + 1])? } else { 0.0 };
        Some(before + after)
    };
    let mut step = FIRST_STEP;
    while step > LAST_STEP {
        let mut improved = false;
        for (i, Passed { free, .. }) in passed.iter().enumerate() {
            let mut before = near(&poses, i).unwrap_or(f64::INFINITY);
            let apart = poses.windows(2).map(|p| (p[1].point - p[0].point).hypot2().sqrt()).fold(0.0, f64::max);
            for (turn, bend) in [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step), (step, -step), (-step, step)] {
                if (turn != 0.0 && !free[0]) || (bend != 0.0 && !free[1]) || !(apart > 0.0) {
                    continue;
                }
                let old = poses[i];
                poses[i].heading += turn;
                poses[i].curvature += bend / apart;
                match near(&poses, i) {
                    Some(now) if now < before * WORTHWHILE => (before, improved) = (now, true),
                    _ => poses[i] = old,
                }
            }
        }
        if !improved {
            step *= 0.5;
        }
    }
    let mut segments = Vec::new();
    for pair in poses.windows(2) {
        segments.extend(hermite_g2(pair[0], pair[1])?);
    }
    Some(segments)
}
