//! Two pieces blended where they meet (McCrae and Singh 2011, section 3.4): a stretch of each in, a chain of clothoids out that
//! leaves the one and enters the other with G2.

use fairpath_curve::{Pose, Segment, Vec2, hermite_g2, trig};

/// Both curves along the blend: by how far it has come, from nought to one, their poses, and how long each is.
pub(crate) struct Stretches<A, B> {
    pub(crate) from: A,
    pub(crate) into: B,
    pub(crate) length: f64,
}

/// Position on the blend with its first and second derivative by the way along it.
struct State {
    point: Vec2,
    first: Vec2,
    second: Vec2,
}

impl<A: Fn(f64) -> Pose, B: Fn(f64) -> Pose> Stretches<A, B> {
    /// The blend of positions by equation 6, `t³ (6 t² − 15 t + 10)`.
    fn state(&self, t: f64) -> State {
        let (a, b) = ((self.from)(t), (self.into)(t));
        let weight = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
        let slope = 30.0 * t * t * (t * (t - 2.0) + 1.0);
        let bend = 60.0 * t * (t * (2.0 * t - 3.0) + 1.0);
        let velocity = |p: &Pose| trig::unit(p.heading) * self.length;
        let acceleration = |p: &Pose| {
            let t = trig::unit(p.heading);
            Vec2::new(-t.y, t.x) * (p.curvature * self.length * self.length)
        };
        let apart = b.point - a.point;
        let (va, vb) = (velocity(&a), velocity(&b));
        State {
            point: a.point.to_vec2() + apart * weight,
            first: va + (vb - va) * weight + apart * slope,
            second: acceleration(&a) * (1.0 - weight)
                + acceleration(&b) * weight
                + (vb - va) * (2.0 * slope)
                + apart * bend,
        }
    }

    /// A pose of the blend; at its ends exactly that of the curve that it leaves or enters. Nothing where it stands still.
    fn pose(&self, t: f64) -> Option<Pose> {
        if t <= 0.0 {
            return Some((self.from)(0.0));
        }
        if t >= 1.0 {
            return Some((self.into)(1.0));
        }
        let State { point, first, second } = self.state(t);
        let speed = first.hypot2().sqrt();
        if !(speed > SLOWEST * self.length) {
            return None;
        }
        let curvature = first.cross(second) / (speed * speed * speed);
        Some(Pose { point: point.to_point(), heading: trig::angle_of(first), curvature })
    }

    /// Clothoids with G2 joins that are within `accuracy` of the blend at [`PROBES`] places of each span, and meet both curves with G2. Nothing if
    /// the blend turns back on itself: the pieces then meet too roughly.
    pub(crate) fn clothoids(&self, accuracy: f64) -> Option<Vec<Segment>> {
        let mut out = Vec::new();
        let mut waiting = vec![(0.0, 1.0, DEEPEST)];
        while let Some((low, high, depth)) = waiting.pop() {
            let (a, b) = (self.pose(low)?, self.pose(high)?);
            let chain = hermite_g2(a, b).filter(|chain| self.is_near(chain, low, high, accuracy));
            match chain {
                Some(chain) => out.extend(chain),
                None if depth == 0 => return None,
                None => {
                    let middle = 0.5 * (low + high);
                    waiting.extend([(middle, high, depth - 1), (low, middle, depth - 1)]);
                }
            }
        }
        // The whole must not be a detour either.
        let length: f64 = out.iter().map(|s| s.length).sum();
        (length < LONGEST * self.length).then_some(out)
    }

    fn is_near(&self, chain: &[Segment; 3], low: f64, high: f64, accuracy: f64) -> bool {
        let nearest = |p: Vec2| chain.iter().map(|s| s.nearest(p.to_point()).distance).fold(f64::INFINITY, f64::min);
        let probe = |i: usize| low + (high - low) * i as f64 / (PROBES + 1) as f64;
        let length: f64 = chain.iter().map(|s| s.length).sum();
        let along: f64 =
            (0..=PROBES).map(|i| (self.state(probe(i + 1)).point - self.state(probe(i)).point).hypot2().sqrt()).sum();
        length < LOOSE * along + accuracy && (1..=PROBES).all(|i| nearest(self.state(probe(i)).point) <= accuracy)
    }
}

/// Places of a span of a blend at which its clothoids are compared with it.
const PROBES: usize = 7;

/// How often a blend is halved.
const DEEPEST: usize = 5;

/// Least speed along the blend, as a share of that along the pieces.
const SLOWEST: f64 = 0.05;

/// Largest length of a blend, as a multiple of that of the pieces; and of its clothoids, as a multiple of its own.
const LONGEST: f64 = 1.6;
const LOOSE: f64 = 1.2;

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::{Continuity, Point, Spline};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn clothoids_follow_the_blend_and_meet_both_pieces(
            gap in prop_oneof![Just(0.0), -3.0..3.0_f64], turn in -0.3..0.3_f64, a in -0.05..0.05_f64, b in prop_oneof![Just(0.0), -0.05..0.05_f64],
            length in 4.0..60.0_f64,
        ) {
            let gap = gap * (length / 40.0);
            let from = Segment::arc(Point::new(7.0, 3.0), 0.5, length, a);
            let middle = from.pose_at(0.5 * length);
            let begin = middle.point + trig::unit(middle.heading + 1.5) * gap;
            let half = Segment::arc(begin, middle.heading + turn, 0.5 * length, b);
            let back = Segment::arc(begin, middle.heading + turn + std::f64::consts::PI, 0.5 * length, -b);
            let into = Segment::arc(back.end(), back.end_heading() - std::f64::consts::PI, length, b);
            prop_assert!((into.end() - half.end()).hypot() < 1e-9);
            let stretches = Stretches { from: |t: f64| from.pose_at(length * t), into: |t: f64| into.pose_at(length * t), length };
            let chain = stretches.clothoids(0.05).expect("it does not turn back");
            let spline = Spline::new(chain.clone(), vec![Continuity::G2; chain.len() - 1], false);
            prop_assert!(spline.is_ok(), "{:?}", spline);
            let spline = spline.unwrap();
            let (begin, end) = (spline.start_pose(), spline.end_pose());
            prop_assert_eq!(begin, from.start_pose());
            prop_assert!((end.point - into.end()).hypot() < 1e-9 && (end.curvature - b).abs() < 1e-9);
            prop_assert!(trig::wrap_angle(end.heading - into.end_heading()).abs() < 1e-9);
            for i in 0..=50 {
                let point = stretches.state(f64::from(i) / 50.0).point;
                // Between the places that were looked at it may be a little further.
                prop_assert!(spline.nearest(point.to_point()).distance < 0.1);
            }
        }
    }
}
