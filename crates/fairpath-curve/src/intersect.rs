//! Intersections: two segments or splines (or one spline with itself) come in, all their common points go out.
//!
//! Both curves are cut into stretches inside slim boxes along their middle tangents. Boxes that miss each other are
//! dropped; where the tangents of two stretches cannot be parallel, the stretches meet at most once and Newton's method
//! finds the point to rounding; everything else is halved. Touching curves leave a few pairs at the smallest size, and
//! overlapping ones more pairs than a bound allows: both are gathered into clusters, and each cluster is reported once.

use crate::contact::{Pair, resolve};
use crate::nearest::Piece;
use crate::segment::Segment;
use crate::spline::Spline;
use crate::trig::{unit, wrap_angle};
use kurbo::{Point, Rect, Vec2};

/// How two curves meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// They cross at an angle.
    Crossing,
    /// They touch with equal or opposite headings to within what can be told apart; two crossings closer together than about
    /// 1e-7 of the size count as one touch.
    Touching,
    /// They run along each other within 1e-9 of their size.
    Overlap,
}

/// A common point of two segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// Arc length on the first segment.
    pub s: f64,
    /// Arc length on the second.
    pub t: f64,
    /// The point, on the first segment.
    pub point: Point,
    /// How they meet there.
    pub contact: Contact,
    /// Arc length of the first segment along which they overlap, around `s`; 0 for a point.
    pub extent: f64,
}

/// A place on a spline: a segment and an arc length on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Index of the segment.
    pub segment: usize,
    /// Arc length from the segment's start.
    pub s: f64,
}

/// A common point of two splines, or of two places of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplineIntersection {
    /// The place on the first spline; of one spline with itself, the earlier place.
    pub first: Place,
    /// The place on the second.
    pub second: Place,
    /// The point, on the first.
    pub point: Point,
    /// How they meet there.
    pub contact: Contact,
    /// Arc length of the first along which they overlap, within this pair of segments; 0 for a point.
    pub extent: f64,
}

/// Stretches shorter than this part of the size are not halved.
const SMALLEST: f64 = 1e-8;

/// Tangents at less than this angle, radians, count as parallel: rounding alone makes curves that overlap differ by less.
const SHALLOWEST: f64 = 1e-7;

/// No more pairs than this are kept at one level of halving.
const MAX_PAIRS: usize = 8192;

/// No segment is cut into more pieces than this before halving.
const MAX_PIECES: usize = 1024;

/// A stretch of a segment inside a box along the tangent in its middle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    pub(crate) mid: f64,
    pub(crate) half: f64,
    point: Point,
    heading: f64,
    tangent: Vec2,
    /// Greatest turning to either side of the middle, radians.
    turn: f64,
}

impl Stretch {
    fn new(segment: &Segment, mid: f64, half: f64) -> Self {
        let heading = segment.heading_at(mid);
        let turn = (segment.curvature_at(mid).abs() + segment.sharpness().abs() * half) * half;
        Self { mid, half, point: segment.point_at(mid), heading, tangent: unit(heading), turn }
    }

    /// Half the width of the box: within it the lateral offset is at most curvature × half² / 2.
    fn width(&self) -> f64 {
        self.half * (0.5 * self.turn).min(1.0)
    }

    fn halves(&self, segment: &Segment) -> [Self; 2] {
        let quarter = 0.5 * self.half;
        [Self::new(segment, self.mid - quarter, quarter), Self::new(segment, self.mid + quarter, quarter)]
    }

    /// Whether the boxes of two stretches come within `slack` of each other: separating axes.
    fn meets(&self, other: &Self, slack: f64) -> bool {
        let d = other.point - self.point;
        if d.hypot2() > (1.5 * (self.half + other.half) + slack) * (1.5 * (self.half + other.half) + slack) {
            return false;
        }
        let (cos, sin) = (self.tangent.dot(other.tangent).abs(), self.tangent.cross(other.tangent).abs());
        let (w, v) = (self.width(), other.width());
        d.dot(self.tangent).abs() <= self.half + other.half * cos + v * sin + slack
            && d.cross(self.tangent).abs() <= w + other.half * sin + v * cos + slack
            && d.dot(other.tangent).abs() <= other.half + self.half * cos + w * sin + slack
            && d.cross(other.tangent).abs() <= v + self.half * sin + w * cos + slack
    }

    /// Whether no tangent of one is parallel to one of the other, so that they meet at most once.
    fn is_transversal_to(&self, other: &Self) -> bool {
        let between = wrap_angle(2.0 * (self.heading - other.heading)).abs() * 0.5;
        self.turn + other.turn + SHALLOWEST < between
    }
}

/// Newton's method for a common point; `None` where it does not settle.
pub(crate) fn newton(a: &Segment, b: &Segment, mut s: f64, mut t: f64) -> Option<(f64, f64)> {
    let size = a.length + b.length;
    for _ in 0..30 {
        let gap = a.point_at(s) - b.point_at(t);
        let (u, v) = (a.tangent_at(s), b.tangent_at(t));
        let det = u.cross(v);
        let (ds, dt) = (-gap.cross(v) / det, -gap.cross(u) / det);
        if !(ds.abs() < size && dt.abs() < size) {
            return None;
        }
        s += ds;
        t += dt;
        if ds.abs() + dt.abs() <= 1e-14 * size {
            return Some((s, t));
        }
    }
    // Shallow crossings settle only to their own rounding.
    ((a.point_at(s) - b.point_at(t)).hypot2().sqrt() <= 1e-13 * size).then_some((s, t))
}

fn stretches(segment: &Segment) -> Vec<Stretch> {
    let count = Piece::count(segment).min(MAX_PIECES);
    let half = segment.length / (2 * count) as f64;
    (0..count).map(|i| Stretch::new(segment, half * (2 * i + 1) as f64, half)).collect()
}

fn intersect(a: &Segment, b: &Segment) -> Vec<Intersection> {
    let size = a.length + b.length;
    // Evaluation is good to 1e-13 of the length, beside the rounding of the coordinates.
    let place = a.start.to_vec2().hypot2().sqrt() + b.start.to_vec2().hypot2().sqrt();
    let slack = 1e-13 * size + 4.0 * f64::EPSILON * place;
    let mut found: Vec<Intersection> = Vec::new();
    let mut unresolved: Vec<Pair> = Vec::new();
    let others = stretches(b);
    let mut pairs: Vec<(Stretch, Stretch)> = Vec::new();
    for x in stretches(a) {
        pairs.extend(others.iter().filter(|y| x.meets(y, slack)).map(|y| (x, *y)));
    }
    while !pairs.is_empty() {
        let crowded = pairs.len() > MAX_PAIRS;
        let mut next = Vec::new();
        for (x, y) in pairs {
            if x.is_transversal_to(&y)
                && let Some((s, t)) = newton(a, b, x.mid, y.mid)
                && (s - x.mid).abs() <= x.half + slack
                && (t - y.mid).abs() <= y.half + slack
            {
                let s = s.clamp(0.0, a.length);
                let contact = Contact::Crossing;
                found.push(Intersection { s, t: t.clamp(0.0, b.length), point: a.point_at(s), contact, extent: 0.0 });
            } else if crowded || x.half + y.half <= SMALLEST * size {
                unresolved.push(Pair { s: x.mid, t: y.mid, half_s: x.half, half_t: y.half });
            } else {
                let (xs, ys) = if x.half > 4.0 * y.half {
                    (x.halves(a).to_vec(), vec![y])
                } else if y.half > 4.0 * x.half {
                    (vec![x], y.halves(b).to_vec())
                } else {
                    (x.halves(a).to_vec(), y.halves(b).to_vec())
                };
                for p in &xs {
                    next.extend(ys.iter().filter(|q| p.meets(q, slack)).map(|q| (*p, *q)));
                }
            }
        }
        pairs = next;
    }
    found.extend(resolve(a, b, unresolved));
    // A crossing on the border of two stretches is found from both sides.
    found.sort_by(|p, q| p.s.total_cmp(&q.s).then(p.t.total_cmp(&q.t)));
    let near = 1e-10 * size;
    let mut kept: Vec<Intersection> = Vec::new();
    for f in found {
        let same =
            kept.iter().rev().take_while(|k| f.s - k.s <= near.max(k.extent)).any(|k| {
                (f.t - k.t).abs() <= near.max(0.51 * k.extent) && (f.s - k.s).abs() <= near.max(0.51 * k.extent)
            });
        if !same {
            kept.push(f);
        }
    }
    kept
}

impl Segment {
    /// All common points of two segments, in order of arc length on this one; empty where a segment is invalid.
    ///
    /// Crossings are found to rounding (1e-13 of the lengths, divided by the sine of the crossing angle). Touching and
    /// overlapping stretches are reported once each, see [`Contact`]; the work is bounded, though great for thousands
    /// of turns.
    #[must_use]
    pub fn intersections(&self, other: &Self) -> Vec<Intersection> {
        if self.is_valid() && other.is_valid() { intersect(self, other) } else { Vec::new() }
    }

    /// The overlap of the segment with itself, if there is one.
    ///
    /// Only an exact arc of more than a whole turn meets itself: a line and every clothoid is simple, since
    /// osculating circles of growing curvature are nested (Kneser).
    #[must_use]
    pub fn self_overlap(&self) -> Option<Intersection> {
        let turn = std::f64::consts::TAU / self.kappa0.abs();
        let extent = self.length - turn;
        (self.kappa0 == self.kappa1 && extent > 0.0).then(|| {
            let s = 0.5 * extent;
            Intersection { s, t: s + turn, point: self.point_at(s), contact: Contact::Overlap, extent }
        })
    }
}

/// A spline with boxes that hold its segments.
type Boxed<'a> = (&'a Spline, &'a [Rect]);

/// The boxes of all segments.
fn boxes(spline: &Spline) -> Vec<Rect> {
    spline.segments().iter().map(Segment::bounding_box).collect()
}

/// Common points of the pairs of segments that `wanted` lets through.
fn between(
    (a, of_a): Boxed<'_>,
    (b, of_b): Boxed<'_>,
    wanted: impl Fn(usize, usize) -> bool,
) -> Vec<SplineIntersection> {
    assert!(a.segments().len() == of_a.len() && b.segments().len() == of_b.len(), "each segment has a box");
    let size = a.length() + b.length();
    let mut found: Vec<SplineIntersection> = Vec::new();
    for (i, (x, own)) in a.segments().iter().zip(of_a).enumerate() {
        let around = own.inflate(1e-12 * size, 1e-12 * size);
        for (j, (y, other)) in b.segments().iter().zip(of_b).enumerate() {
            let apart = around.x1 < other.x0 || other.x1 < around.x0 || around.y1 < other.y0 || other.y1 < around.y0;
            if apart || !wanted(i, j) {
                continue;
            }
            for p in x.intersections(y) {
                let (first, second) = (Place { segment: i, s: p.s }, Place { segment: j, s: p.t });
                found.push(SplineIntersection { first, second, point: p.point, contact: p.contact, extent: p.extent });
            }
        }
    }
    found
}

/// Whether two stations are the same place, around a closed spline too.
fn same_station(spline: &Spline, p: Place, q: Place, tolerance: f64) -> bool {
    let length = spline.length();
    let apart = (spline.station(p.segment, p.s) - spline.station(q.segment, q.s)).abs();
    apart <= tolerance || (spline.is_closed() && length - apart <= tolerance)
}

/// Drops what was found again from a neighbouring segment: points at knots.
fn distinct(a: &Spline, b: &Spline, found: Vec<SplineIntersection>) -> Vec<SplineIntersection> {
    let tolerance = 1e-9 * (a.length() + b.length());
    let mut kept: Vec<SplineIntersection> = Vec::new();
    for f in found {
        let again = |k: &SplineIntersection| {
            same_station(a, k.first, f.first, tolerance) && same_station(b, k.second, f.second, tolerance)
        };
        if f.extent > 0.0 || !kept.iter().any(again) {
            kept.push(f);
        }
    }
    kept
}

/// How far a spline turns, to whichever side, up to each of its segments. Where a curve meets itself it has gone round in a loop, which turns by half a turn at least, what it turns where it
/// meets itself left out (Fenchel's theorem for a curve with one corner).
struct Turned {
    /// Up to the start and the end of each segment, radians; what it turns at joins is between an end and the next start.
    at: Vec<[f64; 2]>,
    /// In one turn around a closed spline.
    around: Option<f64>,
}

impl Turned {
    fn of(spline: &Spline) -> Self {
        let segments = spline.segments();
        let kink = |a: &Segment, b: &Segment| wrap_angle(b.heading - a.end_heading()).abs();
        let mut sum = 0.0;
        let mut at = Vec::with_capacity(segments.len());
        for (i, segment) in segments.iter().enumerate() {
            if i > 0 {
                sum += kink(&segments[i - 1], segment);
            }
            let start = sum;
            sum += segment.absolute_turning();
            at.push([start, sum]);
        }
        let around = spline.is_closed().then(|| sum + kink(&segments[segments.len() - 1], &segments[0]));
        Self { at, around }
    }

    /// Whether two segments, the earlier one first, may have a point in common that is no join between them.
    fn may_meet(&self, i: usize, j: usize) -> bool {
        const LEAST: f64 = std::f64::consts::PI - 1e-9;
        let between = self.at[j][1] - self.at[i][0];
        // What lies between the same two places the other way round.
        let beyond = self.around.map_or(f64::INFINITY, |around| around - (self.at[j][0] - self.at[i][1]));
        between >= LEAST && beyond >= LEAST
    }
}

impl Spline {
    /// All common points of two splines, in order of the first's segments; see [`Segment::intersections`]. A point at a knot is
    /// reported once; overlaps are reported for each pair of segments.
    #[must_use]
    pub fn intersections(&self, other: &Self) -> Vec<SplineIntersection> {
        self.intersections_in(&boxes(self), other, &boxes(other))
    }

    /// The same, by boxes that are known: for each segment of this spline and of the other one its [`bounding_box`](Segment::bounding_box).
    /// To find all places where one of many curves meets the others, these need not be worked out again and again.
    ///
    /// # Panics
    /// When there are more or fewer boxes than segments.
    #[must_use]
    pub fn intersections_in(&self, own: &[Rect], other: &Self, others: &[Rect]) -> Vec<SplineIntersection> {
        distinct(self, other, between((self, own), (other, others), |_, _| true))
    }

    /// All points where the spline meets itself at two different stations, the earlier place first; its joins do not count.
    #[must_use]
    pub fn self_intersections(&self) -> Vec<SplineIntersection> {
        self.self_intersections_in(&boxes(self))
    }

    /// The same, by the [`bounding_box`](Segment::bounding_box) of each of its segments.
    ///
    /// # Panics
    /// When there are more or fewer boxes than segments.
    #[must_use]
    pub fn self_intersections_in(&self, boxes: &[Rect]) -> Vec<SplineIntersection> {
        let turned = Turned::of(self);
        let mut found = between((self, boxes), (self, boxes), |i, j| i < j && turned.may_meet(i, j));
        let tolerance = 1e-7 * self.length();
        found.retain(|f| f.extent > 0.0 || !same_station(self, f.first, f.second, tolerance));
        for (segment, s) in self.segments().iter().enumerate() {
            found.extend(s.self_overlap().map(|o| SplineIntersection {
                first: Place { segment, s: o.s },
                second: Place { segment, s: o.t },
                point: o.point,
                contact: o.contact,
                extent: o.extent,
            }));
        }
        distinct(self, self, found)
    }
}
