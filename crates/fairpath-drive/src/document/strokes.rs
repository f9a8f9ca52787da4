//! What a stroke on the map is meant as (section 3.4.2 of the thesis): paths and a stroke come in, the changed or new path goes out. The ends of the stroke tell: begun at the end of a path
//! and in its direction it lengthens it, drawn from one place of a path to another it corrects it, reaching from one path to another it joins them, else it is a new one. Where it is
//! taken up again beyond a gap, the path passes under what crosses it there (section 3.4.3).

use crate::network::{Path, SketchScale, points_along};
use fairpath_curve::{Continuity, Point, Spline, Vec2, trig};
use fairpath_fit::{CurveEnd, Stroke, Warning, join, oversketch};
use std::sync::Arc;

/// A stroke that begins no further than this from the end of a path may lengthen it, m for each pixel of the stroke; at least [`LEAST_GAP_M`].
const GAP_PX: f64 = 20.0;
const LEAST_GAP_M: f64 = 30.0;

/// Neither the path's end, the stroke's begin nor the way from one to the other may turn away by more than this.
const WIDEST_TURN_DEG: f64 = 35.0;

/// A gap longer than this share of the largest is a break, and not a hand that did not quite meet the end.
const BREAK_SHARE: f64 = 0.15;

/// What a stroke is taken for.
pub(super) enum Meant {
    /// A path of its own.
    New,
    /// One that was there, on another course.
    Changed { path: usize, result: Path, warnings: Vec<Warning> },
    /// Two that were there and the stroke between them as one; the second is gone.
    Joined { first: usize, second: usize, result: Path, second_is_earlier: bool, warnings: Vec<Warning> },
}

/// An end of a path at which a stroke goes on.
#[derive(Clone, Copy)]
struct Continued {
    path: usize,
    end: CurveEnd,
    gap_m: f64,
}

/// What a stroke is meant as among paths of its own layer.
pub(super) fn meant(paths: &[Arc<Path>], layer: &str, points: &[Point], scale: &SketchScale) -> Meant {
    let own = |p: &&Arc<Path>| p.layer == layer && !p.plan.is_closed();
    let candidates: Vec<usize> = (0..paths.len()).filter(|&i| own(&&paths[i])).collect();
    let reversed: Vec<Point> = points.iter().rev().copied().collect();
    let before = continued(paths, &candidates, points, scale);
    let after = continued(paths, &candidates, &reversed, scale);
    match (before, after) {
        (Some(a), Some(b)) if a.path != b.path => joined(paths, a, b, points, scale),
        (Some(a), _) => lengthened(&paths[a.path], a, points, scale),
        (None, Some(b)) => lengthened(&paths[b.path], b, &reversed, scale),
        (None, None) => corrected(paths, &candidates, points, scale),
    }
    .unwrap_or(Meant::New)
}

fn largest_gap_m(scale: &SketchScale) -> f64 {
    (GAP_PX * scale.pixel_m).max(LEAST_GAP_M)
}

/// The end of a path that a stroke goes on from, if its begin is near and in line with one: the nearest of them.
fn continued(paths: &[Arc<Path>], candidates: &[usize], points: &[Point], scale: &SketchScale) -> Option<Continued> {
    let begin = *points.first()?;
    let direction = begins_towards(points, 8.0 * scale.pixel_m)?;
    let (least, _) = trig::sin_cos(WIDEST_TURN_DEG.to_radians());
    let least = (1.0 - least * least).sqrt();
    let mut best: Option<Continued> = None;
    for &i in candidates {
        let plan = &paths[i].plan;
        for (end, pose, sign) in [(CurveEnd::Start, plan.start_pose(), -1.0), (CurveEnd::End, plan.end_pose(), 1.0)] {
            let outward = trig::unit(pose.heading) * sign;
            let gap = begin - pose.point;
            let gap_m = gap.hypot2().sqrt();
            if gap_m > largest_gap_m(scale) || outward.dot(direction) < least {
                continue;
            }
            // Across a real gap the way itself must go on straight; a hair beside the end it may point anywhere.
            if gap_m > 4.0 * scale.pixel_m && gap.dot(outward) < least * gap_m {
                continue;
            }
            if best.is_none_or(|b| gap_m < b.gap_m) {
                best = Some(Continued { path: i, end, gap_m });
            }
        }
    }
    best
}

/// The direction in which a stroke begins, over this length.
fn begins_towards(points: &[Point], over_m: f64) -> Option<Vec2> {
    let begin = *points.first()?;
    let far = points.iter().find(|p| (**p - begin).hypot2().sqrt() >= over_m).or(points.last())?;
    let v = *far - begin;
    let length = v.hypot2().sqrt();
    (length > 0.0).then(|| v / length)
}

/// A path with a stroke at its end.
fn lengthened(path: &Path, at: Continued, points: &[Point], scale: &SketchScale) -> Option<Meant> {
    let (plan, warnings, gap) = extended_plan(path, at, points, scale)?;
    let mut result = path.on(Arc::new(plan), 2.0 * largest_gap_m(scale));
    result.breaks.extend(gap);
    Some(Meant::Changed { path: at.path, result, warnings })
}

/// The plan of a path with a stroke at its end, and the stretch of it that was a break. The path keeps its direction.
fn extended_plan(
    path: &Path,
    at: Continued,
    points: &[Point],
    scale: &SketchScale,
) -> Option<(Spline, Vec<Warning>, Option<[f64; 2]>)> {
    let plan = &path.plan;
    let length = plan.length();
    // The stroke is led back onto the path, so that what is fitted anew goes on from it as it is.
    let back = (12.0 * scale.pixel_m).min(0.5 * length);
    let lead = if at.end == CurveEnd::End {
        points_along(plan, length - back, length, 2.0 * scale.pixel_m)
    } else {
        points_along(plan, 0.0, back, 2.0 * scale.pixel_m).into_iter().rev().collect()
    };
    let all: Vec<Point> = lead.into_iter().chain(points.iter().copied()).collect();
    let stroke = Stroke::new("path", scale.evened(&all));
    let done = oversketch(plan, &stroke, &scale.oversketching()).ok()?;
    let begin = *points.first()?;
    let old_end = if at.end == CurveEnd::End { plan.end_pose().point } else { plan.start_pose().point };
    let station = |p: Point| {
        let near = done.spline.nearest(p);
        done.spline.station(near.segment, near.s)
    };
    let gap = (at.gap_m > BREAK_SHARE * largest_gap_m(scale)).then(|| {
        let (a, b) = (station(old_end), station(begin));
        [a.min(b), a.max(b)]
    });
    Some((done.spline, done.warnings, gap))
}

/// Two paths and the stroke between them as one, in the direction of the first.
fn joined(paths: &[Arc<Path>], a: Continued, b: Continued, points: &[Point], scale: &SketchScale) -> Option<Meant> {
    let (first, second) = (&paths[a.path], &paths[b.path]);
    let (plan, warnings, gap) = extended_plan(first, a, points, scale)?;
    let reach = (0.5 * b.gap_m + 12.0 * scale.pixel_m).min(0.3 * plan.length()).min(0.3 * second.length_m());
    let own_end = a.end;
    let bridge = |continuity| join(&plan, own_end, &second.plan, b.end, continuity, reach).ok();
    let whole = bridge(Continuity::G2).or_else(|| bridge(Continuity::G1))?;
    // `join` runs out of the first: where that was lengthened at its start, all of it is turned round.
    let whole = if own_end == CurveEnd::Start { whole.reversed() } else { whole };
    let whole = Arc::new(whole);
    let keep = 2.0 * largest_gap_m(scale);
    let mut between = first.on(Arc::new(plan), keep);
    between.breaks.extend(gap);
    let mut result = between.on(whole.clone(), keep);
    let other = second.on(whole.clone(), keep);
    result.drawn.extend(other.drawn);
    result.breaks.extend(other.breaks);
    result.speeds.extend(other.speeds);
    if b.gap_m > BREAK_SHARE * largest_gap_m(scale) {
        let station = |p: Point| {
            let near = whole.nearest(p);
            whole.station(near.segment, near.s)
        };
        let end = if b.end == CurveEnd::End { second.plan.end_pose() } else { second.plan.start_pose() };
        let (s, t) = (station(end.point), station(*points.last()?));
        result.breaks.push([s.min(t), s.max(t)]);
    }
    let second_is_earlier = own_end == CurveEnd::Start;
    Some(Meant::Joined { first: a.path, second: b.path, result, second_is_earlier, warnings })
}

/// A path that a stroke was drawn over, from one place of it to another, running along it at both ends.
fn corrected(paths: &[Arc<Path>], candidates: &[usize], points: &[Point], scale: &SketchScale) -> Option<Meant> {
    let near = 6.0 * scale.pixel_m;
    let least = trig::sin_cos((90.0 - WIDEST_TURN_DEG).to_radians()).0;
    let reversed: Vec<Point> = points.iter().rev().copied().collect();
    let along = |path: &Path, points: &[Point]| {
        let begin = points[0];
        let on = path.plan.nearest(begin);
        let tangent = path.plan.tangent_at(path.plan.station(on.segment, on.s));
        let direction = begins_towards(points, 8.0 * scale.pixel_m)?;
        (on.distance <= near && tangent.dot(direction).abs() >= least).then_some(on.distance)
    };
    let off = |i: usize| Some(along(&paths[i], points)? + along(&paths[i], &reversed)?);
    let best = candidates.iter().filter_map(|&i| Some((i, off(i)?))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (result, warnings) = redrawn(&paths[best.0], points, scale).ok()?;
    Some(Meant::Changed { path: best.0, result, warnings })
}

/// A path corrected by a stroke.
///
/// # Errors
/// As [`oversketch`].
pub(super) fn redrawn(
    path: &Path,
    points: &[Point],
    scale: &SketchScale,
) -> Result<(Path, Vec<Warning>), fairpath_fit::OversketchError> {
    let stroke = Stroke::new("path", scale.evened(points));
    let done = oversketch(&path.plan, &stroke, &scale.oversketching())?;
    let reach = 40.0 * scale.pixel_m;
    Ok((path.on(Arc::new(done.spline), reach), done.warnings))
}
