//! What the natural terrain shows along a plan: the plan comes in, heights at the places where a path is compared with the ground go out.
//!
//! Each segment of the plan is surveyed by itself: of a path that was drawn over only the segments that are new are surveyed again, however long the path is and wherever along it they begin.

use crate::terrain::{Heightfield, Waters};
use fairpath_curve::{Point, Segment, Spline, Vec2, trig};
use fairpath_fit::parallel;
use std::sync::Arc;

/// The ground is looked at for a profile in steps of this length, m.
pub(crate) const LOOK_M: f64 = 5.0;

/// Profile and ground are compared in steps of this length, m.
pub(crate) const STEP_M: f64 = 2.0;

/// Chords between cross-sections stay this near to the path, m.
const CHORD_M: f64 = 0.05;

/// Cross-sections are no further apart, m.
const FURTHEST_M: f64 = 5.0;

/// A path over water lies this much above it, m.
pub(crate) const FREEBOARD_M: f64 = 2.0;

/// The natural terrain along a plan.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Survey {
    segments: Vec<Arc<SurveyedSegment>>,
    /// Where the last one ends.
    pub(crate) end: Step,
}

/// The natural terrain along a segment. What is told of its places is the distance from its start, m.
#[derive(Debug, PartialEq)]
pub(crate) struct SurveyedSegment {
    segment: Segment,
    /// Distance and height that a profile follows, m: see [`followed_m`]. At the middles of equal steps; none on a segment of less than half a step.
    pub(crate) looks: Vec<[f64; 2]>,
    /// In equal steps from the start on, without the end.
    pub(crate) steps: Vec<Step>,
    /// Where cross-sections are taken, from the start on, without the end.
    pub(crate) lines: Vec<Line>,
}

/// A place where a profile is compared with the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    /// From the start of the segment, m.
    pub(crate) s_m: f64,
    /// Height of the ground, m.
    pub(crate) natural_m: f64,
    /// Whether it is under water.
    pub(crate) is_wet: bool,
}

/// A line across the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    /// From the start of the segment, m.
    pub(crate) s_m: f64,
    /// Where it crosses the path.
    pub(crate) point: Point,
    /// To the left, of length 1.
    pub(crate) left: Vec2,
    /// Curvature of the path there, 1/m, left positive.
    pub(crate) curvature: f64,
    /// Height of the ground there, m.
    pub(crate) natural_m: f64,
}

impl Survey {
    /// The survey of a plan. Of `before`, that of another plan on the same terrain, segments are taken over as far as both plans begin and end with the same.
    pub(crate) fn of(plan: &Spline, ground: &Heightfield, waters: &Waters, before: Option<&Self>) -> Self {
        let (old, new) = (before.map_or(&[][..], |before| &before.segments), plan.segments());
        let is_same = |(old, new): &(&Arc<SurveyedSegment>, &Segment)| old.segment == **new;
        let front = old.iter().zip(new).take_while(is_same).count();
        let back = old[front..].iter().rev().zip(new[front..].iter().rev()).take_while(is_same).count();
        let fresh = parallel::map(&new[front..new.len() - back], |segment| {
            Arc::new(SurveyedSegment::of(segment, ground, waters))
        });
        let (ahead, behind) = (old[..front].iter().cloned(), old[old.len() - back..].iter().cloned());
        let last = &new[new.len() - 1];
        let end = Step::of(last, last.length, ground, waters);
        Self { segments: ahead.chain(fresh).chain(behind).collect(), end }
    }

    /// Its segments, each with the station at which it begins, m.
    pub(crate) fn segments(&self) -> impl Iterator<Item = (f64, &SurveyedSegment)> {
        self.segments.iter().scan(0.0, |before, surveyed| {
            let start = *before;
            *before += surveyed.segment.length;
            Some((start, surveyed.as_ref()))
        })
    }
}

impl SurveyedSegment {
    fn of(segment: &Segment, ground: &Heightfield, waters: &Waters) -> Self {
        let count = (segment.length / LOOK_M).round();
        let look = |i: usize| {
            let s = (i as f64 + 0.5) / count * segment.length;
            [s, followed_m(segment.point_at(s), ground, waters)]
        };
        let looks = (0..count as usize).map(look).collect();
        let count = (segment.length / STEP_M).ceil().max(1.0);
        let step = |i: usize| Step::of(segment, i as f64 / count * segment.length, ground, waters);
        let steps = (0..count as usize).map(step).collect();
        let lines = even_cuts(segment).into_iter().map(|s| Line::of(segment, s, ground)).collect();
        Self { segment: *segment, looks, steps, lines }
    }

    /// What length of the path each look stands for, m.
    pub(crate) fn look_spacing_m(&self) -> f64 {
        self.segment.length / self.looks.len() as f64
    }

    /// Its length, m.
    pub(crate) fn length_m(&self) -> f64 {
        self.segment.length
    }

    /// A line across it where none was surveyed.
    pub(crate) fn line_at(&self, s_m: f64, ground: &Heightfield) -> Line {
        Line::of(&self.segment, s_m, ground)
    }
}

impl Step {
    fn of(segment: &Segment, s_m: f64, ground: &Heightfield, waters: &Waters) -> Self {
        let place = segment.point_at(s_m);
        let natural_m = ground.height(place);
        Self { s_m, natural_m, is_wet: waters.covers(place, natural_m) }
    }
}

impl Line {
    fn of(segment: &Segment, s_m: f64, ground: &Heightfield) -> Self {
        let pose = segment.pose_at(s_m);
        let tangent = trig::unit(pose.heading);
        let left = Vec2::new(-tangent.y, tangent.x);
        Self { s_m, point: pose.point, left, curvature: pose.curvature, natural_m: ground.height(pose.point) }
    }
}

/// The height that a profile follows at a place, m: of the ground, without its creases, or of the water with freeboard.
pub(crate) fn followed_m(place: Point, ground: &Heightfield, waters: &Waters) -> f64 {
    let z = ground.smooth_height(place);
    waters.level_at(place).map_or(z, |level| z.max(level + FREEBOARD_M))
}

/// Where a segment is cut so that chords stay near to it and are not too long, from its start on, m.
fn even_cuts(segment: &Segment) -> Vec<f64> {
    let mut cuts = Vec::new();
    let mut from = 0.0;
    for to in segment.flatten_at(CHORD_M).into_iter().chain([segment.length]) {
        let parts = ((to - from) / FURTHEST_M).ceil().max(1.0) as usize;
        cuts.extend((0..parts).map(|p| from + (to - from) * p as f64 / parts as f64));
        from = to;
    }
    cuts
}
