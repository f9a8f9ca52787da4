//! Stations along a spline: finding them, evaluating there, cutting there, and travelling the other way.

use crate::segment::{Pose, Segment};
use crate::spline::Spline;
use kurbo::{Point, Vec2};

impl Spline {
    /// Arc length from the spline's start to the place `s` on segment `segment`; an index past the end counts as the end.
    #[must_use]
    pub fn station(&self, segment: usize, s: f64) -> f64 {
        self.segments().iter().take(segment).map(|s| s.length).sum::<f64>() + s
    }

    /// The segment at arc length `s` from the spline's start, and the arc length from that segment's start.
    ///
    /// On an open spline `s` is limited to [0, length]; on a closed one it goes round. A join belongs to the segment it begins.
    #[must_use]
    pub fn locate(&self, s: f64) -> (usize, f64) {
        let mut rest = self.reduce(s);
        let last = self.segments().len() - 1;
        for (i, segment) in self.segments()[..last].iter().enumerate() {
            if rest < segment.length {
                return (i, rest);
            }
            rest -= segment.length;
        }
        (last, rest.min(self.segments()[last].length))
    }

    fn reduce(&self, s: f64) -> f64 {
        let length = self.length();
        if self.is_closed() && !(0.0..=length).contains(&s) {
            let reduced = s - length * libm::floor(s / length);
            return if reduced.is_finite() { reduced } else { 0.0 };
        }
        // Not a clamp: that keeps NaN, and an arc length has to come out.
        s.max(0.0).min(length)
    }

    /// Position, heading and curvature at arc length `s` from the spline's start; see [`Spline::locate`] for `s` out of range.
    #[must_use]
    pub fn pose_at(&self, s: f64) -> Pose {
        let (i, rest) = self.locate(s);
        self.segments()[i].pose_at(rest)
    }

    /// Position at arc length `s` from the spline's start.
    #[must_use]
    pub fn point_at(&self, s: f64) -> Point {
        let (i, rest) = self.locate(s);
        self.segments()[i].point_at(rest)
    }

    /// Unit tangent at arc length `s` from the spline's start.
    #[must_use]
    pub fn tangent_at(&self, s: f64) -> Vec2 {
        let (i, rest) = self.locate(s);
        self.segments()[i].tangent_at(rest)
    }

    /// Position, heading and curvature at the start.
    #[must_use]
    pub fn start_pose(&self) -> Pose {
        self.segments()[0].start_pose()
    }

    /// Position, heading and curvature at the end.
    #[must_use]
    pub fn end_pose(&self) -> Pose {
        self.segments()[self.segments().len() - 1].end_pose()
    }

    /// Signed angle through which the segments turn, radians; corners are not counted.
    #[must_use]
    pub fn turning(&self) -> f64 {
        self.segments().iter().map(Segment::turning).sum()
    }

    /// The same curve travelled the other way; the segments' order, directions and curvatures change sign and joins keep their continuity.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let segments = self.segments().iter().rev().map(Segment::reversed).collect();
        let mut joins = self.joins().to_vec();
        if self.is_closed() {
            // The last join, between the last segment and the first, stays the last.
            joins.pop();
        }
        joins.reverse();
        if self.is_closed() {
            joins.extend(self.joins().last());
        }
        Self::from_parts(segments, joins, self.is_closed())
    }

    /// The part between two arc lengths, an open spline.
    ///
    /// On a closed spline `to` may lie up to one length past `from`, and the part runs on through the start. Ends that fall
    /// within 1e-12 × length of a join take no sliver of the neighbouring segment. `None` if `to` is not past `from`, a
    /// number is not finite, or an open spline is left.
    #[must_use]
    pub fn subspline(&self, from: f64, to: f64) -> Option<Self> {
        let length = self.length();
        let sliver = 1e-12 * length;
        if !(from.is_finite() && to - from > sliver && to - from <= length + sliver) {
            return None;
        }
        let (from, to) = if self.is_closed() {
            let reduced = self.reduce(from);
            (reduced, reduced + (to - from))
        } else if from >= -sliver && to <= length + sliver {
            (from, to)
        } else {
            return None;
        };
        let mut segments = Vec::new();
        let mut joins = Vec::new();
        let mut begin = 0.0;
        let count = self.segments().len();
        for i in 0..(if self.is_closed() { 2 * count } else { count }) {
            let segment = &self.segments()[i % count];
            let end = begin + segment.length;
            let (a, b) = ((from - begin).max(0.0), (to - begin).min(segment.length));
            if b - a > sliver.min(0.5 * segment.length) {
                if !segments.is_empty() {
                    joins.push(self.joins()[(i + count - 1) % count]);
                }
                let whole = a <= sliver && b >= segment.length - sliver;
                segments.push(if whole { *segment } else { segment.subsegment(a, b) });
            }
            begin = end;
        }
        (!segments.is_empty()).then(|| Self::from_parts(segments, joins, false))
    }

    /// The two parts before and after arc length `s`. `None` where one of them would be empty.
    ///
    /// A closed spline gives the part from its start to `s` and that from `s` to its start.
    #[must_use]
    pub fn split_at(&self, s: f64) -> Option<(Self, Self)> {
        Some((self.subspline(0.0, s)?, self.subspline(s, self.length())?))
    }
}
