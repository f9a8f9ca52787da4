//! A stroke joined to what stays by clothoids (after McCrae and Singh 2008, section 6): the curve of the stroke alone and the poses at
//! which it shall be met come in, the curve with three clothoids on each side goes out.
//!
//! Their blend is a quintic polynomial with position, tangent and curvature at both ends. Three clothoids meet the same six numbers, and the result
//! is a spline of clothoids throughout.

use crate::splice::Run;
use fairpath_curve::{Continuity, Pose, Segment, Spline, hermite_g2};

/// Lengths of the stroke that a blend may take up, px, and the largest share of it.
const LENGTHS: [f64; 6] = [8.0, 15.0, 25.0, 40.0, 60.0, 90.0];
const LARGEST_SHARE: f64 = 0.4;

/// The curve between the poses, where there are any: trimmed at that end, and three clothoids from the pose to where it then begins. Nothing if
/// no blend was found.
pub(super) fn blended(curve: &Spline, poses: [Option<Pose>; 2]) -> Option<Run> {
    let length = curve.length();
    let lead_in = poses[0].map(|pose| lead(pose, curve));
    let lead_out = poses[1].map(|pose| lead(turned(pose), &curve.reversed()));
    let (mut from, mut to) = (0.0, length);
    let mut run = Run::default();
    if let Some(lead) = lead_in {
        let (taken, segments) = lead?;
        from = taken;
        run.segments.extend(segments);
    }
    let mut last = Vec::new();
    if let Some(lead) = lead_out {
        let (taken, segments) = lead?;
        to = length - taken;
        last.extend(segments.iter().rev().map(Segment::reversed));
    }
    run.joins = vec![Continuity::G2; run.segments.len()];
    let middle = curve.subspline(from, to)?;
    run.segments.extend_from_slice(middle.segments());
    run.joins.extend_from_slice(middle.joins());
    run.joins.extend(vec![Continuity::G2; last.len()]);
    run.segments.extend(last);
    Some(run)
}

/// The same place travelled the other way.
fn turned(pose: Pose) -> Pose {
    Pose { heading: pose.heading + std::f64::consts::PI, curvature: -pose.curvature, ..pose }
}

/// The fairest of several blends from a pose into a curve, and the length of the curve that it takes up.
fn lead(pose: Pose, curve: &Spline) -> Option<(f64, [Segment; 3])> {
    let most = LARGEST_SHARE * curve.length();
    let mut best: Option<(f64, f64, [Segment; 3])> = None;
    for taken in LENGTHS.iter().map(|&l| l.min(most)) {
        let Some(segments) = hermite_g2(pose, curve.pose_at(taken)) else { continue };
        let price = unfairness(&segments, taken);
        if best.is_none_or(|b| price < b.0) {
            best = Some((price, taken, segments));
        }
    }
    best.map(|(_, taken, segments)| (taken, segments))
}

/// Variation of curvature `∫ κ'² ds` made free of scale, with what the blend takes of the stroke as its scale: long ones vary less, but keep
/// less of what was drawn.
fn unfairness(segments: &[Segment; 3], taken: f64) -> f64 {
    let variation: f64 = segments.iter().map(|s| s.sharpness() * s.sharpness() * s.length).sum();
    let length: f64 = segments.iter().map(|s| s.length).sum();
    variation * length * length * length + KEEP * taken
}

/// What a pixel of the stroke is worth, in units of that.
const KEEP: f64 = 0.1;
