//! A part of a template laid over a part of the stroke (McCrae and Singh 2011, section 3.4): where it lies, and how far off it is.

use super::guide::Guide;
use super::path::Path;
use crate::curvature_space::align::{Pair, Placement, align};
use fairpath_curve::{Pose, Similarity, Vec2, trig};

/// A stretch of a guide, turned and shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Laid {
    pub(crate) guide: usize,
    /// Arc lengths along the guide's path between which it is used, px.
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Turn about the origin of the path, radians, and the shift that follows it.
    pub(crate) turn: f64,
    pub(crate) shift: Vec2,
}

/// How far the points of a part are from what lies over it, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Distance {
    pub(crate) largest: f64,
    pub(crate) rms: f64,
}

/// The foot of a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Arc length along the path, px.
    pub(crate) at: f64,
    pub(crate) pose: Pose,
    /// Distance of the point to the left of the path, px.
    pub(crate) across: f64,
}

impl Laid {
    /// Takes places of the path to the stroke.
    pub(crate) fn similarity(&self) -> Similarity {
        Similarity { rotation: self.turn, translation: self.shift, ..Similarity::IDENTITY }
    }

    /// A pose of the path where it lies.
    pub(crate) fn placed(&self, pose: Pose) -> Pose {
        let by = self.similarity();
        Pose { point: by.point(pose.point), heading: by.heading(pose.heading), curvature: pose.curvature }
    }

    /// The place at an arc length of the path.
    pub(crate) fn pose(&self, path: &Path, at: f64) -> Pose {
        self.placed(path.pose(at))
    }

    /// The foot of a point on the path between two arc lengths and its prolongations, by Newton's method from `at`, at most [`SLIDE`] from there.
    pub(crate) fn foot(&self, path: &Path, at: f64, range: [f64; 2], point: Vec2) -> Foot {
        let (low, high) = (at - SLIDE, at + SLIDE);
        let mut at = at;
        let mut pose = self.placed(path.pose_within(at, range));
        for _ in 0..FOOT_ROUNDS {
            let v = point - pose.point.to_vec2();
            let tangent = trig::unit(pose.heading);
            // Near the centre of curvature every point is as near: steps are held back.
            let step = tangent.dot(v) / (1.0 - pose.curvature * tangent.cross(v)).max(0.3);
            let next = (at + step).clamp(low, high);
            if (next - at).abs() < FOOT_FOUND {
                break;
            }
            at = next;
            pose = self.placed(path.pose_within(at, range));
        }
        Foot { at, pose, across: trig::unit(pose.heading).cross(point - pose.point.to_vec2()) }
    }

    /// How far `points`, which lie at equal steps along the stroke, are from it.
    pub(crate) fn distance(&self, guides: &[Guide], points: &[Vec2]) -> Distance {
        let path = &guides[self.guide].path;
        let (mut largest, mut squares) = (0.0_f64, 0.0);
        for (at, &point) in self.places(points.len()).zip(points) {
            let foot = self.foot(path, at, [self.from, self.to], point);
            let nearest = if (self.from..=self.to).contains(&foot.at) {
                foot.pose
            } else {
                self.pose(path, foot.at.clamp(self.from, self.to))
            };
            let d2 = (point - nearest.point.to_vec2()).hypot2();
            largest = largest.max(d2);
            squares += d2;
        }
        Distance { largest: largest.sqrt(), rms: (squares / points.len() as f64).sqrt() }
    }

    /// The same, used from beside the first of `points` to beside the last, as far as its path has no corner or end between.
    pub(crate) fn trimmed(&self, guides: &[Guide], points: &[Vec2]) -> Self {
        let path = &guides[self.guide].path;
        let beside = |at: f64, inside: f64, point: Vec2| {
            let range = path.smooth_stretch(inside);
            self.foot(path, at, range, point).at.clamp(range[0], range[1].max(range[0]))
        };
        let from = beside(self.from, self.from + INSIDE, points[0]);
        let to = beside(self.to, self.to - INSIDE, points[points.len() - 1]);
        // What would be turned inside out stays.
        if to - from > LEAST_LEFT * (self.to - self.from) { Self { from, to, ..*self } } else { *self }
    }

    /// How far its ends are from those of `points`, px.
    pub(crate) fn ends_off(&self, guides: &[Guide], points: &[Vec2]) -> f64 {
        let path = &guides[self.guide].path;
        let off = |at: f64, p: Vec2| (self.pose(path, at).point.to_vec2() - p).hypot2().sqrt();
        off(self.from, points[0]).max(off(self.to, points[points.len() - 1]))
    }

    /// Arc lengths along the path that correspond to so many points at equal steps along the stroke.
    pub(crate) fn places(&self, count: usize) -> impl Iterator<Item = f64> + use<> {
        let (from, step) = (self.from, (self.to - self.from) / (count - 1) as f64);
        (0..count).map(move |i| from + step * i as f64)
    }
}

/// Way from an end that lies inside, px, and the least share of a piece that trimming leaves.
const INSIDE: f64 = 1e-6;
const LEAST_LEFT: f64 = 0.3;

/// Furthest that the foot of a point is looked for from the place that corresponds to it by arc length, px.
pub(crate) const SLIDE: f64 = 12.0;

/// Newton's steps for a foot, and a step after which it is found, px.
const FOOT_ROUNDS: usize = 5;
const FOOT_FOUND: f64 = 1e-4;

/// The stretch of a guide laid over points with its ends as near as possible to theirs: the middles of both chords coincide, and so do their
/// directions.
pub(crate) fn by_ends(guides: &[Guide], guide: usize, [from, to]: [f64; 2], points: &[Vec2]) -> Laid {
    let path = &guides[guide].path;
    let (a, b) = (path.pose(from).point.to_vec2(), path.pose(to).point.to_vec2());
    let (p, q) = (points[0], points[points.len() - 1]);
    let ((own, theirs), length) = ((b - a, q - p), to - from);
    if own.hypot2().min(theirs.hypot2()) < (SHORT_CHORD * length) * (SHORT_CHORD * length) {
        // A chord between ends that meet has no direction that means anything.
        let laid = by_least_squares(guides, guide, [from, to], points);
        let shift = laid.similarity().vector((a + b) * 0.5);
        return Laid { shift: (p + q) * 0.5 - shift, ..laid };
    }
    let turn = trig::angle_of(theirs) - trig::angle_of(own);
    let laid = Laid { guide, from, to, turn, shift: Vec2::ZERO };
    let middle = laid.similarity().vector((a + b) * 0.5);
    Laid { shift: (p + q) * 0.5 - middle, ..laid }
}

/// Shortest chord that has a direction, as a share of its arc.
const SHORT_CHORD: f64 = 0.05;

/// The stretch of a guide laid over points at equal steps with the least sum of squared distances between places that correspond by arc length.
pub(crate) fn by_least_squares(guides: &[Guide], guide: usize, [from, to]: [f64; 2], points: &[Vec2]) -> Laid {
    let path = &guides[guide].path;
    let laid = Laid { guide, from, to, turn: 0.0, shift: Vec2::ZERO };
    let last = points.len() - 1;
    let pairs: Vec<Pair> = laid
        .places(points.len())
        .zip(points)
        .enumerate()
        .map(|(i, (at, &drawn))| {
            let weight = if i == 0 || i == last { 0.5 } else { 1.0 };
            Pair { composed: path.pose(at).point.to_vec2(), drawn, weight }
        })
        .collect();
    let Placement { turn, shift } = align(&pairs, None);
    Laid { turn, shift, ..laid }
}
