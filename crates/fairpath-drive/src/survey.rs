//! What the natural terrain shows along a plan: the plan comes in, heights at the places where a path is compared with the ground go out, and how far the plan reaches.
//!
//! Each segment of the plan is surveyed by itself: of a path that was drawn over only the segments that are new are surveyed again, however long the path is. And what is left of a segment
//! that was cut is looked at where it was looked at before: the marks at which it is lie along the whole line, arc or clothoid of which the segment is a part, and places are told in steps
//! far above rounding. So no cross-section moves that was not drawn over, and no height but by what a profile leads over.

use crate::terrain::{Heightfield, Waters};
use fairpath_curve::{Kind, Point, Rect, Segment, Spline, Vec2, trig};
use fairpath_fit::parallel;
use std::sync::Arc;

/// The ground is looked at for a profile in steps of this length, m.
pub(crate) const LOOK_M: f64 = 5.0;

/// Profile and ground are compared in steps of this length, m; engineered roads follow the ground as these tell it.
pub(crate) const STEP_M: f64 = 2.0;

/// Cross-sections are taken in steps of this length, m, or in equal parts of it.
const LINE_M: f64 = 5.0;

/// Chords between cross-sections stay this near to the path, m.
const CHORD_M: f64 = 0.07;

/// From one cross-section to the next a path turns by no more, radians.
const MOST_TURN: f64 = 1.4;

/// A mark that is nearer to an end of its segment than this share of what lies between marks is none.
const HAIR: f64 = 0.1;

/// Places are told in steps of this, m, directions and curvatures in steps of these.
const PLACE_M: f64 = 1.0 / 65_536.0;
const DIRECTION: f64 = 1.0 / (1_u64 << 30) as f64;
const CURVATURE_PER_M: f64 = 1.0 / (1_u64 << 40) as f64;

/// A segment that begins so far from the mark with the number 0 has marks of its own, m: where they are on the whole of it rounding would tell.
const FURTHEST_M: f64 = 1e6;

/// Into no more parts a step between cross-sections is divided.
const MOST_PARTS: f64 = 5000.0;

/// A path over water lies this much above it, m.
pub(crate) const FREEBOARD_M: f64 = 2.0;

/// The natural terrain along a plan.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Survey {
    segments: Vec<Arc<SurveyedSegment>>,
    /// The box around each segment, and around all.
    pub(crate) boxes: Vec<Rect>,
    pub(crate) bounds: Rect,
    /// Where the last one ends.
    pub(crate) end: Step,
}

/// The natural terrain along a segment. What is told of its places is the distance from its start, m.
#[derive(Debug, PartialEq)]
pub(crate) struct SurveyedSegment {
    segment: Segment,
    /// Where it begins between its marks, m: see [`origin_m`].
    from_m: f64,
    /// Without its ends, and none at all on a segment that is too short.
    pub(crate) looks: Vec<Look>,
    /// From the start on, without the end.
    pub(crate) steps: Vec<Step>,
    /// Where cross-sections are taken, from the start on, without the end.
    pub(crate) lines: Vec<Line>,
}

/// A height that a profile follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    /// From the start of the segment, m.
    pub(crate) s_m: f64,
    /// The height, m: see [`followed_m`].
    pub(crate) height_m: f64,
    /// What length of the segment it stands for, m.
    pub(crate) spacing_m: f64,
}

/// A place where a profile is compared with the ground, and where the ground of an engineered road is told.
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
        let made = &new[front..new.len() - back];
        let fresh = parallel::map(made, |segment| Arc::new(SurveyedSegment::of(segment, ground, waters)));
        let (ahead, behind) = (old[..front].iter().cloned(), old[old.len() - back..].iter().cloned());
        let old = before.map_or(&[][..], |before| &before.boxes);
        let boxed = made.iter().map(Segment::bounding_box);
        let boxes: Vec<Rect> =
            old[..front].iter().copied().chain(boxed).chain(old[old.len() - back..].iter().copied()).collect();
        let bounds = boxes.iter().fold(boxes[0], |bounds, other| bounds.union(*other));
        let last = &new[new.len() - 1];
        let end = Step::of(last, last.length, ground, waters);
        Self { segments: ahead.chain(fresh).chain(behind).collect(), boxes, bounds, end }
    }

    /// Its steps with their stations, m, ascending, from the start of the plan to its end.
    pub(crate) fn stationed(&self) -> impl Iterator<Item = (f64, &Step)> {
        let steps = self.segments().flat_map(|(start, segment)| segment.steps.iter().map(move |s| (start + s.s_m, s)));
        steps.chain([(self.segments.iter().map(|surveyed| surveyed.segment.length).sum(), &self.end)])
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
        let from_m = origin_m(segment);
        let length = segment.length;
        let places = marks(segment, from_m, LOOK_M);
        let look = |i: usize| {
            let between = |i: usize, j: usize| 0.5 * (places[i] + places[j]);
            let from = if i == 0 { 0.0 } else { between(i - 1, i) };
            let to = if i + 1 == places.len() { length } else { between(i, i + 1) };
            let height_m = followed_m(told(segment.point_at(places[i])), ground, waters);
            Look { s_m: places[i], height_m, spacing_m: to - from }
        };
        let looks = (0..places.len()).map(look).collect();
        let from_start = |marks: Vec<f64>| std::iter::once(0.0).chain(marks);
        let steps = from_start(marks(segment, from_m, STEP_M)).map(|s| Step::of(segment, s, ground, waters)).collect();
        let lines = from_start(cuts(segment, from_m)).map(|s| Line::of(segment, s, ground)).collect();
        Self { segment: *segment, from_m, looks, steps, lines }
    }

    /// Its length, m.
    pub(crate) fn length_m(&self) -> f64 {
        self.segment.length
    }

    /// A line across it where none was surveyed, to the nearest `step_m` between its marks.
    pub(crate) fn line_near(&self, s_m: f64, step_m: f64, ground: &Heightfield) -> Line {
        let s = ((self.from_m + s_m) / step_m).round() * step_m - self.from_m;
        Line::of(&self.segment, s.clamp(0.0, self.segment.length), ground)
    }

    /// The line across its end.
    pub(crate) fn last_line(&self, ground: &Heightfield) -> Line {
        Line::of(&self.segment, self.segment.length, ground)
    }
}

impl Step {
    fn of(segment: &Segment, s_m: f64, ground: &Heightfield, waters: &Waters) -> Self {
        let place = told(segment.point_at(s_m));
        let natural_m = ground.height(place);
        Self { s_m, natural_m, is_wet: waters.covers(place, natural_m) }
    }
}

impl Line {
    fn of(segment: &Segment, s_m: f64, ground: &Heightfield) -> Self {
        let pose = segment.pose_at(s_m);
        let tangent = trig::unit(pose.heading);
        let left = Vec2::new(rounded(-tangent.y, DIRECTION), rounded(tangent.x, DIRECTION));
        let point = told(pose.point);
        Self { s_m, point, left, curvature: rounded(pose.curvature, CURVATURE_PER_M), natural_m: ground.height(point) }
    }
}

/// Where a segment begins on the line, arc or clothoid of which it is a part, m: from the foot of the perpendicular from the origin, from where it heads east, or from where it inflects.
fn origin_m(segment: &Segment) -> f64 {
    let from_m = match segment.kind() {
        Kind::Line => segment.start.to_vec2().dot(trig::unit(segment.heading)),
        Kind::Arc => segment.heading / segment.kappa0,
        Kind::Clothoid => segment.kappa0 / segment.sharpness(),
    };
    if from_m.abs() < FURTHEST_M { from_m } else { 0.0 }
}

/// Where a segment that begins at `from_m` has marks in steps of this length, from its start, m.
fn marks(segment: &Segment, from_m: f64, step_m: f64) -> Vec<f64> {
    let hair = HAIR * step_m;
    let first = ((from_m + hair) / step_m).ceil();
    let mark = |i: u32| (first + f64::from(i)) * step_m - from_m;
    (0..).map(mark).take_while(|s| *s <= segment.length - hair).collect()
}

/// Where a segment that begins at `from_m` is cut so that chords stay near to it, from its start, m.
fn cuts(segment: &Segment, from_m: f64) -> Vec<f64> {
    let sharpness = segment.sharpness();
    let mut cuts = Vec::new();
    let first = (from_m / LINE_M).floor();
    for i in 0_u32.. {
        let [from, to] = [i, i + 1].map(|i| (first + f64::from(i)) * LINE_M - from_m);
        if from > segment.length {
            break;
        }
        // A chord of length h deviates by kappa h² / 8; beside the ends of the segment it may be longer by a hair.
        let most = [from, to].map(|s| (segment.kappa0 + sharpness * s).abs());
        let most = most[0].max(most[1]);
        let longest = (8.0 * CHORD_M / most).sqrt().min(MOST_TURN / most);
        let parts = (LINE_M * (1.0 + HAIR) / longest).ceil().clamp(1.0, MOST_PARTS);
        let part = LINE_M / parts;
        // Of a short and sharp clothoid there are many parts beyond its ends.
        let first = ((HAIR * part - from) / part).ceil().max(0.0);
        let within = |k: &f64| *k < parts && from + k * part <= segment.length - HAIR * part;
        let k = (0_u32..).map(|k| first + f64::from(k)).take_while(within);
        cuts.extend(k.map(|k| from + k * part));
    }
    cuts
}

/// A place as it is told.
fn told(place: Point) -> Point {
    Point::new(rounded(place.x, PLACE_M), rounded(place.y, PLACE_M))
}

fn rounded(x: f64, step: f64) -> f64 {
    // Not the nothing that is negative.
    (x / step).round() * step + 0.0
}

/// The height that a profile follows at a place, m: of the ground, without its creases, or of the water with freeboard.
pub(crate) fn followed_m(place: Point, ground: &Heightfield, waters: &Waters) -> f64 {
    let z = ground.smooth_height(place);
    waters.level_at(place).map_or(z, |level| z.max(level + FREEBOARD_M))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terrain::{Landscape, SyntheticTerrain};
    use proptest::prelude::*;

    fn ground() -> Heightfield {
        SyntheticTerrain { landscape: Landscape::Hills, size: 129, cell_m: 16.0, seed: 3 }.build().unwrap()
    }

    /// How many there are of `part`, which begins so far from the start of the whole, that the whole does not have, or only elsewhere.
    fn strange<T>(
        whole: &[T],
        part: &[T],
        from_m: f64,
        s_m: impl Fn(&T) -> f64,
        is_same: impl Fn(&T, &T) -> bool,
    ) -> usize {
        let is_there = |own: &&T| {
            let near = |other: &&T| (s_m(other) - from_m - s_m(own)).abs() < 1e-3;
            whole.iter().find(near).is_some_and(|other| is_same(own, other))
        };
        // The first is where the part begins.
        part[1..].iter().filter(|own| !is_there(own)).count()
    }

    #[test]
    fn a_sharp_and_short_clothoid_has_few_cross_sections() {
        let start = Point::new(900.0, 900.0);
        let sliver = Segment { start, heading: 1.0, length: 1e-6, kappa0: -1.0, kappa1: 1.0 };
        let surveyed = SurveyedSegment::of(&sliver, &ground(), &Waters::default());
        assert!(surveyed.lines.len() < 100, "{} on a segment of a micrometre", surveyed.lines.len());
    }

    proptest! {
        #[test]
        fn what_is_left_of_a_cut_segment_is_looked_at_where_it_was(
            place in [200.0..1500.0_f64, 200.0..1500.0_f64],
            heading in -3.0..3.0_f64,
            length in 60.0..600.0_f64,
            turns in [-2.0..2.0_f64, -2.0..2.0_f64],
            kind in 0..3_usize,
            share in 0.2..0.8_f64,
        ) {
            let (ground, waters) = (ground(), Waters { level_m: Some(5.0), ..Waters::default() });
            let [kappa0, kappa1] = [[0.0; 2], [turns[0] / length; 2], turns.map(|t| t / length)][kind];
            let start = Point::new(place[0], place[1]);
            let whole = Segment { start, heading, length, kappa0, kappa1 };
            let cut = share * length;
            let of = |segment: &Segment| SurveyedSegment::of(segment, &ground, &waters);
            let all = of(&whole);
            let (mut count, mut others) = (0, 0);
            for (part, from) in [(whole.subsegment(0.0, cut), 0.0), (whole.subsegment(cut, length), cut)] {
                let part = of(&part);
                let line = |a: &Line, b: &Line| {
                    (a.point, a.left, a.curvature, a.natural_m) == (b.point, b.left, b.curvature, b.natural_m)
                };
                count += part.lines.len() + part.steps.len();
                others += strange(&all.lines, &part.lines, from, |line| line.s_m, line);
                let step = |a: &Step, b: &Step| (a.natural_m, a.is_wet) == (b.natural_m, b.is_wet);
                others += strange(&all.steps, &part.steps, from, |step| step.s_m, step);
                let covered: f64 = part.looks.iter().map(|look| look.spacing_m).sum();
                prop_assert!((covered - part.length_m()).abs() < 1e-9, "looks stand for {covered} m of {} m", part.length_m());
            }
            // What rounding brings to the other side of a step, a few in a million.
            prop_assert!(others <= 1, "{others} of {count}");
        }

        #[test]
        fn cross_sections_are_near_enough_to_each_other(
            heading in -3.0..3.0_f64, length in 0.5..900.0_f64, turns in [-9.0..9.0_f64, -9.0..9.0_f64],
        ) {
            let segment = Segment {
                start: Point::new(900.0, 900.0), heading, length, kappa0: turns[0] / length, kappa1: turns[1] / length,
            };
            let all = SurveyedSegment::of(&segment, &ground(), &Waters::default());
            let ends: Vec<f64> = all.lines.iter().map(|line| line.s_m).chain([length]).collect();
            prop_assert!(ends[0] == 0.0);
            for pair in ends.windows(2) {
                prop_assert!(pair[1] > pair[0] && pair[1] - pair[0] <= LINE_M * (1.0 + HAIR) + 1e-6, "{pair:?}");
                let [a, b] = [0, 1].map(|i| segment.point_at(pair[i]));
                let chord = (b - a) / (b - a).hypot();
                let off = |i: i32| chord.cross(segment.point_at(pair[0] + 0.01 * f64::from(i) * (pair[1] - pair[0])) - a);
                let most = (0..=100).map(|i| off(i).abs()).fold(0.0, f64::max);
                prop_assert!(most <= CHORD_M, "{most} m between {pair:?}");
                prop_assert!((segment.heading_at(pair[1]) - segment.heading_at(pair[0])).abs() <= MOST_TURN);
            }
        }
    }
}
