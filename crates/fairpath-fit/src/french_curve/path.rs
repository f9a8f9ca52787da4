//! A template as it is run through: any place along it, parts of it, and where its corners are.

use fairpath_curve::{Continuity, Pose, Segment, Spline, trig};

/// A curve with places by arc length, px. A closed one goes on without end; an open one is prolonged by the circles that touch its ends.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    spline: Spline,
    /// Arc length at which each segment begins, and the length of the whole.
    stations: Vec<f64>,
    /// Arc lengths of the corners, increasing; the ends of an open curve are not among them.
    pub(crate) corners: Vec<f64>,
}

impl Path {
    pub(crate) fn new(spline: Spline) -> Self {
        let mut stations = vec![0.0];
        let mut at = 0.0;
        for segment in spline.segments() {
            at += segment.length;
            stations.push(at);
        }
        let count = spline.segments().len();
        let mut corners: Vec<f64> = (0..spline.joins().len())
            .filter(|&i| spline.joins()[i] == Continuity::G0)
            .map(|i| if i + 1 == count { 0.0 } else { stations[i + 1] })
            .collect();
        corners.sort_by(f64::total_cmp);
        Self { spline, stations, corners }
    }

    pub(crate) fn spline(&self) -> &Spline {
        &self.spline
    }

    pub(crate) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    pub(crate) fn is_closed(&self) -> bool {
        self.spline.is_closed()
    }

    /// A place of a closed path within its first turn, and how many turns were taken off, px.
    fn reduced(&self, v: f64) -> (f64, f64) {
        if !self.is_closed() {
            return (v, 0.0);
        }
        let length = self.length();
        let off = length * libm::floor(v / length);
        // Rounding may leave a whole turn.
        if v - off >= length { (0.0, off + length) } else { (v - off, off) }
    }

    /// The segment at a place, and how far along it is; at a join the one that begins there, or the one that ends there.
    fn locate(&self, v: f64, ending: bool) -> (usize, f64) {
        let (v, _) = self.reduced(v);
        let count = self.spline.segments().len();
        if ending && v == 0.0 && self.is_closed() {
            return (count - 1, self.spline.segments()[count - 1].length);
        }
        let after =
            if ending { self.stations.partition_point(|&s| s < v) } else { self.stations.partition_point(|&s| s <= v) };
        let i = after.clamp(1, count) - 1;
        (i, v - self.stations[i])
    }

    /// Position, heading and curvature at a place.
    pub(crate) fn pose(&self, v: f64) -> Pose {
        self.pose_of(v, false)
    }

    fn pose_of(&self, v: f64, ending: bool) -> Pose {
        let (i, s) = self.locate(v, ending);
        let segment = &self.spline.segments()[i];
        if (0.0..=segment.length).contains(&s) {
            return segment.pose_at(s);
        }
        // Off the ends of an open path; a place just past a join by rounding is one of these too.
        let inside = s.clamp(0.0, segment.length);
        prolonged(segment.pose_at(inside), s - inside)
    }

    /// As [`Path::pose`], but off the stretch from `low` to `high` along the circles that touch the path there.
    pub(crate) fn pose_within(&self, v: f64, [low, high]: [f64; 2]) -> Pose {
        if v >= high {
            prolonged(self.pose_of(high, true), v - high)
        } else if v <= low {
            prolonged(self.pose_of(low, false), v - low)
        } else {
            self.pose(v)
        }
    }

    /// The corners or ends next to `v` before and after it; those at `v` itself count as before. Without any, one turn away.
    pub(crate) fn smooth_stretch(&self, v: f64) -> [f64; 2] {
        let (at, off) = self.reduced(v);
        let length = self.length();
        let after = self.corners.partition_point(|&c| c <= at + SAME_PLACE);
        let (first, last) = (self.corners.first(), self.corners.last());
        let low = if after > 0 {
            self.corners[after - 1]
        } else if self.is_closed() {
            last.map_or(at - length, |c| c - length)
        } else {
            0.0
        };
        let high = if after < self.corners.len() {
            self.corners[after]
        } else if self.is_closed() {
            first.map_or(at + length, |c| c + length)
        } else {
            length
        };
        [low + off, high + off]
    }

    /// The ends of the straight stretch on which `v` lies; nothing if the path bends there.
    pub(crate) fn leg(&self, v: f64) -> Option<[f64; 2]> {
        let (i, s) = self.locate(v, false);
        let segment = &self.spline.segments()[i];
        let begin = v - s;
        (segment.kappa0 == 0.0 && segment.kappa1 == 0.0).then_some([begin, begin + segment.length])
    }

    /// Whether the path has a corner at `v`.
    pub(crate) fn has_corner(&self, v: f64) -> bool {
        let (at, _) = self.reduced(v);
        let length = self.length();
        self.corners
            .iter()
            .any(|c| (c - at).abs() < SAME_PLACE || (self.is_closed() && (c + length - at).abs() < SAME_PLACE))
    }

    /// `v`, or the join of two segments that is so near that what lies between would be a splinter.
    pub(crate) fn snapped(&self, v: f64) -> f64 {
        let (at, off) = self.reduced(v);
        let after = self.stations.partition_point(|&s| s < at).min(self.stations.len() - 1);
        let near = [after.saturating_sub(1), after].map(|i| self.stations[i]);
        near.into_iter().find(|s| (s - at).abs() < SPLINTER).map_or(v, |s| s + off)
    }

    /// The segments from one place to another with their joins, over as many turns as it takes.
    pub(crate) fn part(&self, from: f64, to: f64) -> (Vec<Segment>, Vec<Continuity>) {
        let (mut segments, mut joins) = (Vec::new(), Vec::new());
        let count = self.spline.segments().len();
        let (first, _) = self.locate(from, false);
        let (at, _) = self.reduced(from);
        let mut begin = self.stations[first] + from - at;
        for i in (first..).take(if self.is_closed() { usize::MAX } else { count - first }) {
            let segment = &self.spline.segments()[i % count];
            // An open path that is prolonged goes on in its last segment.
            let (low, high) = ((from - begin).max(0.0), (to - begin).min(segment.length));
            if high - low > SAME_PLACE {
                if !segments.is_empty() {
                    joins.push(self.spline.joins()[(i + count - 1) % count]);
                }
                let whole = low <= SAME_PLACE && high >= segment.length - SAME_PLACE;
                segments.push(if whole { *segment } else { segment.subsegment(low, high) });
            }
            begin += segment.length;
            if begin >= to - SAME_PLACE {
                break;
            }
        }
        (segments, joins)
    }
}

/// Places nearer than this are one, px.
const SAME_PLACE: f64 = 1e-9;

/// A segment shorter than this is none that anyone drew, px.
const SPLINTER: f64 = 1e-3;

/// The pose a way along the circle that touches at a pose.
pub(crate) fn prolonged(pose: Pose, way: f64) -> Pose {
    if way == 0.0 {
        return pose;
    }
    let arc =
        Segment::arc(pose.point, pose.heading, way.abs(), if way > 0.0 { pose.curvature } else { -pose.curvature });
    let arc = if way > 0.0 { arc } else { Segment { heading: pose.heading + std::f64::consts::PI, ..arc } };
    Pose { point: arc.end(), heading: trig::wrap_angle(pose.heading + way * pose.curvature), curvature: pose.curvature }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::Point;

    fn square() -> Path {
        let mut segments = vec![Segment::line(Point::ORIGIN, 0.0, 10.0)];
        for i in 1..4 {
            segments.push(Segment::line(segments[i - 1].end(), 0.5 * std::f64::consts::PI * i as f64, 10.0));
        }
        Path::new(Spline::new(segments, vec![Continuity::G0; 4], true).unwrap())
    }

    #[test]
    fn a_closed_path_goes_on_without_end() {
        let path = square();
        for v in [-47.0, -3.0, 4.0, 83.0] {
            let (here, there) = (path.pose(v), path.pose(v + 40.0));
            assert!((here.point - there.point).hypot() < 1e-12, "{v}");
        }
        let (segments, joins) = path.part(-5.0, 77.0);
        assert_eq!((segments.len(), joins.len()), (9, 8));
        let length: f64 = segments.iter().map(|s| s.length).sum();
        assert!((length - 82.0).abs() < 1e-12);
        assert!((segments[0].start - path.pose(-5.0).point).hypot() < 1e-12);
        assert!((segments[8].end() - path.pose(77.0).point).hypot() < 1e-12);
    }

    #[test]
    fn corners_bound_smooth_stretches() {
        let path = square();
        assert_eq!(path.corners, [0.0, 10.0, 20.0, 30.0]);
        assert_eq!(path.smooth_stretch(13.0), [10.0, 20.0]);
        assert_eq!(path.smooth_stretch(-3.0), [-10.0, 0.0]);
        assert_eq!(path.smooth_stretch(10.0), [10.0, 20.0]);
        assert_eq!(path.leg(57.0), Some([50.0, 60.0]));
        assert!(path.has_corner(40.0) && path.has_corner(-10.0) && !path.has_corner(5.0));
    }

    #[test]
    fn beyond_its_range_a_path_follows_its_touching_circle() {
        let arc = Segment::arc(Point::ORIGIN, 0.0, 20.0, 0.1);
        let path = Path::new(Spline::new(vec![arc], Vec::new(), false).unwrap());
        let whole = Segment::arc(Point::ORIGIN, 0.0, 30.0, 0.1);
        for v in [20.0, 25.0, 30.0] {
            let (ours, theirs) = (path.pose_within(v, [0.0, 20.0]), whole.pose_at(v));
            assert!((ours.point - theirs.point).hypot() < 1e-12);
            assert!((trig::wrap_angle(ours.heading - theirs.heading)).abs() < 1e-12);
        }
        let before = path.pose_within(-5.0, [0.0, 20.0]);
        assert!((before.point - whole.reversed().reversed().point_at(0.0)).hypot() > 4.0);
        assert!((Segment::arc(before.point, before.heading, 5.0, 0.1).end() - Point::ORIGIN).hypot() < 1e-12);
    }
}
