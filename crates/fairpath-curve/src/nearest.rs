//! The point of a curve nearest to a given point: a segment or spline and a point come in, arc lengths and distances go out.
//!
//! The squared distance `d²(s) / 2` has the derivatives `f = e·T`, `f' = 1 + kappa e·N`, `f'' = kappa' e·N − kappa² f`, with `e`
//! from the given point to the curve. On a stretch that turns by at most 0.8 rad to each side of its middle, `|f''|` is
//! bounded by what is known in the middle, so every stretch is either proven to hold no nearest point, proven to
//! be convex (then Newton's method cannot fail), or halved. That is an interval branch and bound with a proof at every
//! leaf; the geometry of the several minima on a spiral is that of Bertolazzi and Frego, "Point-clothoid distance and
//! projection computation" (2019), but none of its case distinctions are needed.

use crate::moments::{displacement, local_frame};
use crate::segment::Segment;
use crate::spline::Spline;
use crate::trig::unit;
use kurbo::{Point, Vec2};

/// A point of a segment near a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Arc length from the segment's start, in [0, length].
    pub s: f64,
    /// The point of the segment there.
    pub point: Point,
    /// Its distance from the given point.
    pub distance: f64,
}

/// A point of a spline near a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplineNearest {
    /// Index of the segment.
    pub segment: usize,
    /// Arc length from the start of that segment, in [0, its length]. [`Spline::station`] turns it into arc length from the
    /// start of the spline.
    pub s: f64,
    /// The point of the spline there.
    pub point: Point,
    /// Its distance from the given point.
    pub distance: f64,
}

/// Stretches turn by at most this much to each side of their middle, radians, or they are halved before anything is proven.
const HALF_TURN: f64 = 0.8;

/// A segment is cut into at most this many pieces at first; beyond, halving goes on.
const MAX_PIECES: f64 = 65_536.0;

/// Bound on the work of one piece, in evaluations, reached only by points that are equally far from all of it.
const MAX_STEPS: usize = 2048;

/// A piece is halved at most this often in depth; stretches are then shorter than rounding.
const MAX_DEPTH: usize = 60;

/// Relative rounding error granted to distances.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A stretch of a segment around its middle, in whose frame the search works.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Arc length of the middle from the segment's start.
    mid: f64,
    /// Half the arc length.
    pub(crate) half: f64,
    pub(crate) point: Point,
    tangent: Vec2,
    kappa: f64,
    sharpness: f64,
}

/// The derivatives of half the squared distance at an arc length `h` from the piece's middle, in the piece's frame.
#[derive(Clone, Copy)]
struct Probe {
    h: f64,
    position: Vec2,
    tangent: Vec2,
    distance2: f64,
    f: f64,
    f1: f64,
    f2: f64,
    kappa: f64,
}

/// What a search has found so far.
trait Collector {
    /// A point that need not be a minimum: a bound.
    fn offer(&mut self, piece: &Piece, h: f64, position: Vec2, distance2: f64);
    /// A minimum, or (`flat`) a stretch of constant distance around the point.
    fn minimum(&mut self, piece: &Piece, h: f64, position: Vec2, distance2: f64, flat: Option<f64>);
    /// Squared distances of at least this much are not wanted.
    fn bound(&self) -> f64;
}

impl Piece {
    pub(crate) fn count(segment: &Segment) -> usize {
        let steepest = segment.kappa0.abs().max(segment.kappa1.abs());
        let wanted = libm::ceil(steepest * segment.length * (0.5 / HALF_TURN));
        if wanted >= 1.0 { wanted.min(MAX_PIECES) as usize } else { 1 }
    }

    /// The pieces of a segment, in order.
    pub(crate) fn all(segment: &Segment) -> impl Iterator<Item = Self> {
        let count = Self::count(segment);
        let half = segment.length / (2 * count) as f64;
        let sharpness = segment.sharpness();
        let mut at = segment.start;
        let mut from = 0.0;
        let segment = *segment;
        (0..count).map(move |i| {
            let mid = half * (2 * i + 1) as f64;
            at += displacement(segment.heading_at(from), segment.curvature_at(from), sharpness, mid - from);
            from = mid;
            Self {
                mid,
                half,
                point: at,
                tangent: unit(segment.heading_at(mid)),
                kappa: segment.curvature_at(mid),
                sharpness,
            }
        })
    }

    fn to_local(self, point: Point) -> Vec2 {
        let d = point - self.point;
        Vec2::new(d.dot(self.tangent), self.tangent.cross(d))
    }

    fn to_world(self, v: Vec2) -> Point {
        let t = self.tangent;
        self.point + Vec2::new(t.x * v.x - t.y * v.y, t.y * v.x + t.x * v.y)
    }

    fn probe(&self, target: Vec2, h: f64) -> Probe {
        let (position, tangent) = local_frame(self.kappa, self.sharpness, h);
        self.derivatives(target, h, position, tangent)
    }

    fn derivatives(&self, target: Vec2, h: f64, position: Vec2, tangent: Vec2) -> Probe {
        let e = position - target;
        let kappa = self.kappa + self.sharpness * h;
        let along = e.dot(tangent);
        let across = tangent.cross(e);
        let (f, f1) = (along, 1.0 + kappa * across);
        Probe {
            h,
            position,
            tangent,
            distance2: e.hypot2(),
            f,
            f1,
            f2: self.sharpness * across - kappa * kappa * f,
            kappa,
        }
    }

    /// Finds the minima of distance on the piece that the collector's bound allows. Returns whether the piece's own ends
    /// are left for the caller to look at: `(low, high)`.
    fn search(&self, target: Vec2, collector: &mut impl Collector) -> (bool, bool) {
        let mut ends = (false, false);
        let middle = self.derivatives(target, 0.0, Vec2::ZERO, Vec2::new(1.0, 0.0));
        if self.examine(target, &middle, self.half, collector, &mut ends) {
            self.halve(target, middle.f > 0.0, collector, &mut ends);
        }
        ends
    }

    /// The search in the halves of the piece; apart from [`Piece::search`] because most pieces need no halving.
    #[inline(never)]
    fn halve(&self, target: Vec2, low_first: bool, collector: &mut impl Collector, ends: &mut (bool, bool)) {
        let mut stack = [(0.0, 0.0); MAX_DEPTH + 2];
        let mut depth = 0;
        let push = |depth: &mut usize, stack: &mut [(f64, f64)], center: f64, half: f64, low_first: bool| {
            // The nearer half is taken first: its distance prunes the other.
            let (a, b) = if low_first { (half, -half) } else { (-half, half) };
            stack[*depth] = (center + a, half);
            stack[*depth + 1] = (center + b, half);
            *depth += 2;
        };
        push(&mut depth, &mut stack, 0.0, 0.5 * self.half, low_first);
        let mut steps = 0;
        while depth > 0 {
            depth -= 1;
            let (center, radius) = stack[depth];
            steps += 1;
            let probe = self.probe(target, center);
            if self.examine(target, &probe, radius, collector, ends) {
                if steps >= MAX_STEPS || depth >= MAX_DEPTH {
                    collector.minimum(self, probe.h, probe.position, probe.distance2, Some(radius));
                } else {
                    push(&mut depth, &mut stack, center, 0.5 * radius, probe.f > 0.0);
                }
            }
        }
    }

    /// Looks at the stretch of `radius` around a probe: whether it has to be halved.
    #[inline(always)]
    fn examine(
        &self,
        target: Vec2,
        probe: &Probe,
        radius: f64,
        collector: &mut impl Collector,
        ends: &mut (bool, bool),
    ) -> bool {
        collector.offer(self, probe.h, probe.position, probe.distance2);
        let distance = probe.distance2.sqrt();
        let steepest = probe.kappa.abs() + self.sharpness.abs() * radius;
        let turn = steepest * radius;
        let (f, f1) = (probe.f.abs(), probe.f1.abs());
        // Bound of |f''| on the stretch; f itself stays within |f| + |f'| r + bound r²/2, which closes the circle.
        let bound = if turn <= HALF_TURN * (1.0 + 1e-9) {
            (self.sharpness.abs() * (distance + radius) + steepest * steepest * (f + f1 * radius))
                / (1.0 - 0.5 * turn * turn)
        } else {
            f64::INFINITY
        };
        let near = (distance - radius).max(0.0);
        let lowest = (near * near).max(probe.distance2 - 2.0 * f * radius - (f1 + bound * radius) * radius * radius);
        if lowest >= collector.bound() * (1.0 - ROUNDING) {
            return false;
        }
        // Half a radius of slack: halving rounds.
        let slack = self.half - 0.5 * radius;
        let (low_end, high_end) = (probe.h - radius <= -slack, probe.h + radius >= slack);
        let reach = f1 * radius + 0.5 * bound * radius * radius;
        let rounding = ROUNDING * (distance + self.mid + self.half);
        if f + reach <= rounding {
            collector.minimum(self, probe.h, probe.position, probe.distance2, Some(radius));
        } else if f > reach + rounding {
            ends.0 |= low_end && probe.f > 0.0;
            ends.1 |= high_end && probe.f < 0.0;
        } else if probe.f1 > bound * radius {
            let found = self.newton(target, *probe, probe.h - radius, probe.h + radius);
            collector.minimum(self, found.h, found.position, found.distance2, None);
        } else if probe.f1 < -bound * radius {
            ends.0 |= low_end;
            ends.1 |= high_end;
        } else {
            return true;
        }
        false
    }

    /// The minimum on [low, high], where `f` is proven to increase: its root, or the end nearer to it.
    ///
    /// Halley's method inside a bracket, so each step triples the number of correct digits.
    fn newton(&self, target: Vec2, mut probe: Probe, low: f64, high: f64) -> Probe {
        let (mut a, mut b) = (low, high);
        let close = 1e-5 * (high - low);
        for _ in 0..64 {
            if probe.f == 0.0 || (probe.f > 0.0 && probe.h <= low) || (probe.f < 0.0 && probe.h >= high) {
                return probe;
            }
            if probe.f < 0.0 {
                a = probe.h
            } else {
                b = probe.h
            }
            let newton = -probe.f / probe.f1;
            let curved = 1.0 + 0.5 * newton * probe.f2 / probe.f1;
            let step = if curved > 0.5 { newton / curved } else { newton };
            let mut h = probe.h + step;
            if !(h > a && h < b) {
                // The ends of the stretch may be the answer and are tried as they are.
                h = if h >= b && b == high {
                    high
                } else if h <= a && a == low {
                    low
                } else {
                    0.5 * (a + b)
                };
            } else if step.abs() <= close && (step * probe.kappa).abs() < 1e-5 {
                // The next error is of the order of step³: Taylor's expansion finishes.
                let normal = Vec2::new(-probe.tangent.y, probe.tangent.x);
                let position = probe.position + probe.tangent * step + normal * (0.5 * probe.kappa * step * step);
                let distance2 = (position - target).hypot2();
                return Probe { h, position, distance2, ..probe };
            }
            if h == probe.h {
                return probe;
            }
            probe = self.probe(target, h);
        }
        probe
    }
}

/// Keeps the nearest point only.
struct Best {
    bound: f64,
    found: Option<(Piece, f64, Vec2)>,
}

impl Collector for Best {
    fn offer(&mut self, piece: &Piece, h: f64, position: Vec2, distance2: f64) {
        if distance2 < self.bound {
            self.bound = distance2;
            self.found = Some((*piece, h, position));
        }
    }

    fn minimum(&mut self, piece: &Piece, h: f64, position: Vec2, distance2: f64, _flat: Option<f64>) {
        self.offer(piece, h, position, distance2);
    }

    fn bound(&self) -> f64 {
        self.bound
    }
}

impl Best {
    /// The answer on the segment, where it is nearer than the bound the search began with.
    fn answer(&self, target: Point, length: f64) -> Option<Nearest> {
        let (piece, h, position) = self.found?;
        let point = piece.to_world(position);
        Some(Nearest { s: (piece.mid + h).clamp(0.0, length), point, distance: length_of(point - target) })
    }
}

/// Keeps every local minimum, in order of arc length.
struct All {
    /// Arc length and half the length of the flat stretch around it.
    found: Vec<(f64, f64)>,
}

impl Collector for All {
    fn offer(&mut self, _piece: &Piece, _h: f64, _position: Vec2, _distance2: f64) {}

    fn minimum(&mut self, piece: &Piece, h: f64, _position: Vec2, _distance2: f64, flat: Option<f64>) {
        // A convex stretch whose lowest point is its end has no minimum of its own, unless the end is one: both
        // neighbours report it then, and it is kept once.
        self.found.push((piece.mid + h, flat.unwrap_or(0.0)));
    }

    fn bound(&self) -> f64 {
        f64::INFINITY
    }
}

fn length_of(v: Vec2) -> f64 {
    v.hypot2().sqrt()
}

/// Searches a segment for a point nearer than the square root of `bound`.
fn nearer_than(segment: &Segment, target: Point, bound: f64) -> Option<Nearest> {
    if !(segment.is_valid() && target.is_finite()) {
        return None;
    }
    let mut best = Best { bound, found: None };
    let mut answer = None;
    let start2 = (segment.start - target).hypot2();
    if start2 < best.bound {
        best.bound = start2;
        answer = Some(Nearest { s: 0.0, point: segment.start, distance: start2.sqrt() });
    }
    let count = Piece::count(segment);
    let look = |i: usize, piece: &Piece, best: &mut Best| {
        let local = piece.to_local(target);
        let (_, high) = piece.search(local, best);
        if high && i + 1 == count {
            let (position, _) = local_frame(piece.kappa, piece.sharpness, piece.half);
            best.offer(piece, piece.half, position, (position - local).hypot2());
        }
    };
    if count > 4 {
        // Many pieces: first a look at all their middles, so that the bound is good before any is searched.
        let pieces: Vec<Piece> = Piece::all(segment).collect();
        for piece in &pieces {
            best.offer(piece, 0.0, Vec2::ZERO, (piece.point - target).hypot2());
        }
        for (i, piece) in pieces.iter().enumerate() {
            look(i, piece, &mut best);
        }
    } else {
        for (i, piece) in Piece::all(segment).enumerate() {
            look(i, &piece, &mut best);
        }
    }
    best.answer(target, segment.length).or(answer)
}

impl Segment {
    /// The point of the segment nearest to `point`; of several equally near, one of them.
    ///
    /// The distance is the global minimum, to rounding (1e-14 × (length + distance) and the error of
    /// [`Segment::point_at`]); the arc length is as sharp as the minimum is: 1e-12 × length unless the curve is nearly a
    /// circle around `point`. An invalid segment or a point that is not finite gives the start and whatever its distance is.
    #[must_use]
    pub fn nearest(&self, point: Point) -> Nearest {
        nearer_than(self, point, f64::INFINITY).unwrap_or(Nearest {
            s: 0.0,
            point: self.start,
            distance: length_of(self.start - point),
        })
    }

    /// All local minima of the distance to `point` along the segment, in order of arc length, the ends included where the
    /// distance grows from them inwards.
    ///
    /// Where the distance is constant to rounding over a stretch (an arc around `point`), one point of the stretch is given.
    /// An invalid segment or a point that is not finite gives nothing.
    #[must_use]
    pub fn nearest_all(&self, point: Point) -> Vec<Nearest> {
        if !(self.is_valid() && point.is_finite()) {
            return Vec::new();
        }
        let mut all = All { found: Vec::new() };
        for piece in Piece::all(self) {
            piece.search(piece.to_local(point), &mut all);
        }
        let slope = |s: f64| (self.point_at(s) - point).dot(self.tangent_at(s));
        let tiny = 1e-9 * self.length;
        let mut merged: Vec<(f64, f64)> = Vec::new();
        let mut candidates = all.found;
        candidates.push((0.0, 0.0));
        candidates.push((self.length, 0.0));
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (s, flat) in candidates {
            match merged.last_mut() {
                Some((last, width)) if s - flat <= *last + *width + tiny => {
                    let (low, high) = ((*last - *width).min(s - flat), (*last + *width).max(s + flat));
                    // A sharp minimum stays where it is; only flat stretches are centred.
                    if *width > 0.0 || flat > 0.0 {
                        (*last, *width) = (0.5 * (low + high), 0.5 * (high - low));
                    } else if *last == 0.0 && slope(0.0) < 0.0 || slope(*last).abs() > slope(s).abs() {
                        *last = s;
                    }
                }
                _ => merged.push((s, flat)),
            }
        }
        // What is left over is a minimum if the distance falls towards it from both sides.
        merged.retain(|&(s, flat)| {
            let (low, high) = ((s - flat - tiny).max(0.0), (s + flat + tiny).min(self.length));
            let rounding = ROUNDING * (length_of(self.point_at(s) - point) + self.length);
            (s - flat <= tiny || slope(low) <= rounding) && (s + flat >= self.length - tiny || slope(high) >= -rounding)
        });
        let nearest = |s: f64| {
            let at = self.point_at(s);
            Nearest { s, point: at, distance: length_of(at - point) }
        };
        merged.into_iter().map(|(s, _)| nearest(s.clamp(0.0, self.length))).collect()
    }
}

impl Spline {
    /// For each segment, in order, a lower bound of its distance from `point`, in the unit of the spline and quickly told: every point of a segment lies in the ellipse with its ends as foci and its arc length as the long axis; of a segment that is not valid the bound means nothing.
    /// Since knots of a valid spline agree to 1e-9 of its size only, a bound may exceed the distance by as little.
    #[must_use]
    pub fn distance_bounds(&self, point: Point) -> Vec<f64> {
        let segments = self.segments();
        let end = segments[segments.len() - 1].end();
        let knots = segments.iter().map(|segment| segment.start).chain([end]);
        let away: Vec<f64> = knots.map(|knot| length_of(point - knot)).collect();
        let bound = |(segment, ends): (&Segment, &[f64])| (0.5 * (ends[0] + ends[1] - segment.length)).max(0.0);
        segments.iter().zip(away.windows(2)).map(bound).collect()
    }

    /// The point of the spline nearest to `point`; of several equally near, one of them. See [`Segment::nearest`] for the accuracy.
    ///
    /// Segments are skipped by a bound from their knots.
    #[must_use]
    pub fn nearest(&self, point: Point) -> SplineNearest {
        let segments = self.segments();
        let bounds = self.distance_bounds(point);
        // The most promising segment first.
        let mut first = (0, f64::INFINITY);
        for (i, &bound) in bounds.iter().enumerate() {
            if bound < first.1 {
                first = (i, bound);
            }
        }
        let place =
            |segment: usize, n: Nearest| SplineNearest { segment, s: n.s, point: n.point, distance: n.distance };
        let mut best = place(first.0, segments[first.0].nearest(point));
        for (i, segment) in segments.iter().enumerate() {
            // Knots of a valid spline agree to 1e-9 of its size; the bound allows for that.
            if i != first.0
                && bounds[i] * (1.0 - 1e-8) < best.distance
                && let Some(found) = nearer_than(segment, point, best.distance * best.distance)
                && found.distance < best.distance
            {
                best = place(i, found);
            }
        }
        best
    }
}
