//! Conversion to circular arcs: a segment or spline and a tolerance come in, few arcs that meet in G1 go out.

use crate::bezier::turn_limit;
use crate::greedy::{Tolerance, longest_pieces};
use crate::moments::displacement;
use crate::segment::{Kind, Segment};
use crate::spline::{Continuity, Spline};
use crate::trig::{angle_of, sin_cos, unit, wrap_angle};
use kurbo::{Point, Vec2};

/// Turning allowed to one pair of arcs, radians.
const MAX_TURN: f64 = 2.4;

/// Samples on each arc at which the distance is measured.
const SAMPLES: usize = 8;

/// Sampling misses up to this part of the largest error.
const SAMPLING_MARGIN: f64 = 1.04;

/// Accuracies below this, relative to the length of the segment, are taken as this.
const FINEST: f64 = 1e-12;

/// The arc that leaves `start` with the given heading and passes through `end`.
fn arc_through(start: Point, heading: f64, end: Point) -> Segment {
    let chord = end - start;
    let t = unit(heading);
    let half = angle_of(Vec2::new(t.dot(chord), t.cross(chord)));
    let straight = chord.hypot2().sqrt();
    let sin = sin_cos(half).0;
    let length = if half == 0.0 { straight } else { straight * (half / sin) };
    Segment::arc(start, heading, length, 2.0 * half / length)
}

/// Two arcs between two poses, G1 throughout, with equally long tangents at the two ends: the member of the family of biarcs
/// that neither end dominates.
fn biarc(start: Point, heading: f64, end: Point, end_heading: f64) -> [Segment; 2] {
    let (t0, t1) = (unit(heading), unit(end_heading));
    let v = end - start;
    let b = v.dot(t0 + t1);
    let a = (t0 - t1).hypot2();
    let d = v.hypot2() / (b + (b * b + a * v.hypot2()).sqrt());
    let joint = start + (v + (t0 - t1) * d) * 0.5;
    let first = arc_through(start, heading, joint);
    [first, arc_through(joint, first.end_heading(), end)]
}

/// Signed distance of a point from the full circle of an arc, in the form that holds for lines too.
fn circle_distance(arc: &Segment, point: Point) -> f64 {
    let e = point - arc.start;
    let q = arc.kappa0 * e.hypot2() - 2.0 * unit(arc.heading).cross(e);
    -q / (1.0 + (1.0 + arc.kappa0 * q).max(0.0).sqrt())
}

impl Segment {
    /// Circular arcs along the segment within `accuracy` of it, meeting in G1; ends and end headings are kept.
    ///
    /// Lines and arcs come back as they are. A clothoid becomes pairs of arcs, each pair as long as the tolerance
    /// allows, within 1 %; the distance is measured at eight points of every arc with a margin of 4 %. Accuracies
    /// below 1e-12 × length are taken as that. An invalid segment gives nothing.
    #[must_use]
    pub fn to_arcs(&self, accuracy: f64) -> Vec<Self> {
        if !self.is_valid() {
            return Vec::new();
        }
        if self.kind() != Kind::Clothoid {
            return vec![*self];
        }
        let tolerance =
            Tolerance { accuracy: accuracy.max(FINEST * self.length), order: 3.0, shortest: 1e-6 * self.length };
        let sharpness = self.sharpness();
        let longest = |from: f64| turn_limit(self.curvature_at(from), sharpness, MAX_TURN);
        let pairs = longest_pieces(self.length, &tolerance, longest, |from, to| {
            let pose = self.pose_at(from);
            let local = |s: f64| displacement(pose.heading, pose.curvature, sharpness, s);
            let pair = biarc(pose.point, pose.heading, pose.point + local(to - from), self.heading_at(to));
            // The second arc's end heading is exact to rounding; whole turns of `heading` are kept by the first.
            let share = (to - from) / (pair[0].length + pair[1].length);
            let mut worst = wrap_angle(pair[1].end_heading() - self.heading_at(to)).abs() * 1e-3 * (to - from);
            let mut begin = 0.0;
            for arc in &pair {
                for i in 0..SAMPLES {
                    let s = (begin + arc.length * ((i as f64 + 0.5) / SAMPLES as f64)) * share;
                    worst = worst.max(circle_distance(arc, pose.point + local(s)).abs());
                }
                begin += arc.length;
            }
            (worst * SAMPLING_MARGIN, pair)
        });
        pairs.into_iter().flatten().collect()
    }
}

impl Spline {
    /// The spline as lines and circular arcs within `accuracy`; see [`Segment::to_arcs`]. Corners stay corners, other joins
    /// become G1.
    #[must_use]
    pub fn to_arcs(&self, accuracy: f64) -> Self {
        let mut segments: Vec<Segment> = Vec::new();
        let mut joins = Vec::new();
        for (i, segment) in self.segments().iter().enumerate() {
            let arcs = segment.to_arcs(accuracy);
            joins.extend(std::iter::repeat_n(Continuity::G1, arcs.len() - 1));
            joins.extend(self.joins().get(i).map(|&join| join.min(Continuity::G1)));
            segments.extend(arcs);
        }
        Self::from_parts(segments, joins, self.is_closed())
    }
}
