//! Conversion to circular arcs: a segment or spline and a tolerance come in, few arcs that meet in G1 go out.

use crate::bezier::turn_limit;
use crate::greedy::{Tolerance, longest_pieces};
use crate::hermite_g2::solve3;
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

/// Greatest distance of the part of `segment` from `from` to `to` from the circle of an arc.
fn deviation(segment: &Segment, arc: &Segment, from: f64, to: f64) -> f64 {
    let pose = segment.pose_at(from);
    let sharpness = segment.sharpness();
    (0..SAMPLES)
        .map(|i| (to - from) * ((i as f64 + 0.5) / SAMPLES as f64))
        .map(|s| circle_distance(arc, pose.point + displacement(pose.heading, pose.curvature, sharpness, s)).abs())
        .fold(0.0, f64::max)
}

/// `count` ≥ 2 arcs along a clothoid, all deviating about equally; `None` where they cannot be brought to its end.
///
/// A chain of arcs has a curvature of steps. With the joints on the clothoid, a distance g apart, and the headings there
/// behind it by sharpness × g² / 12, the offset between joints is the third Bernoulli polynomial, sharpness × g³ ×
/// 0.00802 at most: of all chains the one that stays nearest. The two outer arcs, whose headings at the ends are given,
/// are shorter by √½. What is neglected leaves a small gap at the end, which is closed by the least change to all arcs.
fn level_chain(segment: &Segment, count: usize) -> Option<(f64, Vec<Segment>)> {
    use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
    let length = segment.length;
    let g = length / ((count - 2) as f64 + SQRT_2);
    let behind = segment.sharpness() * g * g / 12.0;
    let station = |j: usize| {
        if j == 0 {
            0.0
        } else if j == count {
            length
        } else {
            g * (FRAC_1_SQRT_2 + (j - 1) as f64)
        }
    };
    let heading = |j: usize| segment.heading_at(station(j)) - if j == 0 || j == count { 0.0 } else { behind };
    let mut parts: Vec<(f64, f64)> = (0..count)
        .map(|i| {
            let along = station(i + 1) - station(i);
            (along, (heading(i + 1) - heading(i)) / along)
        })
        .collect();
    // Every arc adds its own rounding.
    let rounding = (1e-14 + 4e-16 * count as f64) * length;
    let target = segment.end();
    let target_heading = segment.end_heading();
    for _ in 0..8 {
        let arcs = chain_of(segment, &parts);
        let end = arcs[count - 1].end_pose();
        let missing = [target.x - end.point.x, target.y - end.point.y, (target_heading - end.heading) * length];
        if missing.iter().all(|m| m.abs() <= rounding) {
            let worst =
                (0..count).map(|i| deviation(segment, &arcs[i], station(i), station(i + 1))).fold(0.0, f64::max);
            return Some((worst * SAMPLING_MARGIN, arcs));
        }
        // The least change of all lengths (in units of the length) and curvatures (in units of its inverse).
        let columns: Vec<[[f64; 3]; 2]> = arcs
            .iter()
            .map(|arc| {
                let joint = arc.end();
                let rest = end.point - joint;
                let swing = Vec2::new(-rest.y, rest.x);
                let by_length = unit(arc.end_heading()) + swing * arc.kappa0;
                let j = arc.position_jacobian(arc.length);
                let by_kappa = (j.kappa0 + j.kappa1 + swing * arc.length) / length;
                [
                    [by_length.x * length, by_length.y * length, arc.kappa0 * length * length],
                    [by_kappa.x, by_kappa.y, arc.length],
                ]
            })
            .collect();
        let mut m = [[0.0; 3]; 3];
        for c in columns.iter().flatten() {
            for (row, a) in m.iter_mut().zip(c) {
                for (cell, b) in row.iter_mut().zip(c) {
                    *cell += a * b;
                }
            }
        }
        let multipliers = solve3(&m, missing);
        let dot = |c: &[f64; 3]| c.iter().zip(&multipliers).map(|(a, b)| a * b).sum::<f64>();
        for (part, [by_length, by_kappa]) in parts.iter_mut().zip(&columns) {
            part.0 += dot(by_length) * length;
            part.1 += dot(by_kappa) / length;
            if !(part.0 > 0.0 && part.1.is_finite()) {
                return None;
            }
        }
    }
    None
}

/// Arcs of the given lengths and curvatures one after the other.
fn chain_of(segment: &Segment, parts: &[(f64, f64)]) -> Vec<Segment> {
    let mut pose = segment.start_pose();
    parts
        .iter()
        .map(|&(length, kappa)| {
            let arc = Segment::arc(pose.point, pose.heading, length, kappa);
            pose = arc.end_pose();
            arc
        })
        .collect()
}

/// The fewest arcs of a level chain within the accuracy. `None` where the tolerance is so wide against the curve's radii that
/// such chains do not settle.
fn level_arcs(segment: &Segment, accuracy: f64) -> Option<Vec<Segment>> {
    let g = libm::cbrt(accuracy / (0.00802 * segment.sharpness().abs()));
    let estimate = libm::ceil(segment.length / g + 2.0 - std::f64::consts::SQRT_2);
    if estimate.is_nan() || estimate > 20_000.0 {
        return None;
    }
    let mut count = (estimate as usize).saturating_sub(1).max(2);
    for _ in 0..8 {
        let next = match level_chain(segment, count) {
            Some((worst, arcs)) if worst <= accuracy => return Some(arcs),
            // The deviation falls with the third power of the number.
            Some((worst, _)) => libm::ceil(count as f64 * libm::cbrt(worst / accuracy) * 0.999) as usize,
            None => count + 1,
        };
        count = next.clamp(count + 1, 2 * count);
    }
    None
}

impl Segment {
    /// Circular arcs along the segment within `accuracy` of it, meeting in G1; ends and end headings are kept.
    ///
    /// Lines and arcs come back as they are. A clothoid becomes a chain of about equal deviation, within two and 5 % of the least number there
    /// is: a third fewer than biarcs need. Only where the tolerance is wide against the radii are they pairs (biarcs), each as
    /// long as allowed. The distance is measured at eight points of every arc with a margin of 4 %. Accuracies below
    /// 1e-12 × length are taken as that. An invalid segment gives nothing.
    #[must_use]
    pub fn to_arcs(&self, accuracy: f64) -> Vec<Self> {
        if !self.is_valid() {
            return Vec::new();
        }
        if self.kind() != Kind::Clothoid {
            return vec![*self];
        }
        let accuracy = accuracy.max(FINEST * self.length);
        if let Some(arcs) = level_arcs(self, accuracy) {
            return arcs;
        }
        let tolerance = Tolerance { accuracy, order: 3.0, shortest: 1e-6 * self.length };
        let sharpness = self.sharpness();
        let longest = |from: f64| turn_limit(self.curvature_at(from), sharpness, MAX_TURN);
        let pairs = longest_pieces(self.length, &tolerance, longest, |from, to| {
            let pose = self.pose_at(from);
            let local = |s: f64| displacement(pose.heading, pose.curvature, sharpness, s);
            let pair = biarc(pose.point, pose.heading, pose.point + local(to - from), self.heading_at(to));
            // The second arc's end heading is exact to rounding; whole turns of `heading` are kept by the first.
            let share = (to - from) / (pair[0].length + pair[1].length);
            let mut worst = wrap_angle(pair[1].end_heading() - self.heading_at(to)).abs() * 1e-3 * (to - from);
            let joint = from + pair[0].length * share;
            worst = worst.max(deviation(self, &pair[0], from, joint)).max(deviation(self, &pair[1], joint, to));
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
