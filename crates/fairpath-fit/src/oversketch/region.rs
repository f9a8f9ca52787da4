//! Which part of a curve a stroke replaces (section 3.7 of Baran et al. 2010): a curve and a stroke come in, the stations between which the
//! curve is replaced go out, and the direction in which the stroke runs along it.

use super::error::OversketchError;
use super::options::OversketchOptions;
use crate::polyline::Polyline;
use fairpath_curve::{Continuity, Point, Spline, Vec2};

/// What a stroke replaces, in px of the local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Replaced {
    /// Stations at which the curve is left and joined again. On a closed curve the second may lie beyond its length; the first exceeds the
    /// second a little where the stroke makes a loop.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Whether the stroke runs against the curve.
    pub(super) backward: bool,
    /// Whether the curve is left there and joined there; else the stroke's end becomes the end of the curve.
    pub(super) attached: [bool; 2],
}

/// The stroke runs to the side to which it points, if it does so by at least this cosine.
const POINTS_THERE: f64 = 0.3;
/// It follows the curve where its direction agrees by at least this cosine.
const FOLLOWS: f64 = 0.7;
/// Length of the stroke's end that tells its direction, px, and the largest share of the stroke.
const END_LENGTH: f64 = 15.0;
const END_SHARE: f64 = 0.3;
/// How a branch of the curve that the stroke would leave at a right angle compares with one that is further away, px.
const ASKEW: f64 = 8.0;
/// Longest stretch of curve that a loop may go over twice, px, and the largest share of the loop.
const LOOP_OVERLAP: f64 = 30.0;
const LOOP_SHARE: f64 = 0.25;
/// A stroke that reaches beyond the curve's end by less than this does not, px.
const BEYOND: f64 = 0.5;

/// Where an end of the stroke is.
#[derive(Clone, Copy, Debug)]
enum Meeting {
    /// Beside the curve, at this station.
    On(f64),
    /// Beyond the start or the end of an open curve, at that station.
    Past(f64),
    /// Nowhere near.
    Away,
}

/// An end of the stroke, with its direction in the sense of drawing.
struct StrokeEnd {
    /// Unit vector.
    direction: Vec2,
    meeting: Meeting,
    distance: f64,
}

/// Finds what the stroke replaces.
///
/// # Errors
/// When neither end is near the curve, or only one is and the curve is closed.
pub(super) fn replaced(
    curve: &Spline,
    sketch: &Polyline,
    options: &OversketchOptions,
) -> Result<Replaced, OversketchError> {
    let ends = [false, true].map(|last| stroke_end(curve, sketch, last, options));
    let region = if curve.is_closed() {
        on_closed(curve, sketch, &ends, options)?
    } else {
        on_open(curve, sketch, &ends, options)?
    };
    Ok(snapped(curve, region, options))
}

/// The end of the stroke with the place of the curve that it means: near, and where there are several, one along which it runs.
fn stroke_end(curve: &Spline, sketch: &Polyline, last: bool, options: &OversketchOptions) -> StrokeEnd {
    let span = END_LENGTH.min(END_SHARE * sketch.length());
    let n = sketch.points.len() - 1;
    let (point, inner) = if last {
        (sketch.points[n], sketch.at(sketch.length() - span, &mut n.clone()))
    } else {
        (sketch.points[0], sketch.at(span, &mut 0))
    };
    let chord = if last { point - inner } else { inner - point };
    let direction = if chord.hypot2() > 0.0 { chord / chord.hypot2().sqrt() } else { Vec2::ZERO };
    let mut best: Option<(f64, f64, f64)> = None;
    let mut begin = 0.0;
    for (segment, bound) in curve.segments().iter().zip(curve.distance_bounds(point.to_point())) {
        // Most of a long curve is far away; twice as far as it may be, whatever rounding did to the bound.
        if bound > 2.0 * options.reach {
            begin += segment.length;
            continue;
        }
        for near in segment.nearest_all(point.to_point()).into_iter().filter(|near| near.distance <= options.reach) {
            let askew = segment.tangent_at(near.s).cross(direction).abs();
            let price = near.distance + ASKEW * askew;
            if best.is_none_or(|b| price < b.0) {
                best = Some((price, begin + near.s, near.distance));
            }
        }
        begin += segment.length;
    }
    let Some((_, station, distance)) = best else {
        let distance = curve.nearest(point.to_point()).distance;
        return StrokeEnd { direction, meeting: Meeting::Away, distance };
    };
    let beyond = |at: f64, outward: f64| {
        let pose = curve.pose_at(at);
        !curve.is_closed()
            && (station - at).abs() < 1e-6
            && (point - pose.point.to_vec2()).dot(curve.tangent_at(at)) * outward > BEYOND
    };
    let past = beyond(0.0, -1.0) || beyond(curve.length(), 1.0);
    StrokeEnd { direction, meeting: if past { Meeting::Past(station) } else { Meeting::On(station) }, distance }
}

fn not_near(ends: &[StrokeEnd; 2], options: &OversketchOptions) -> OversketchError {
    let size = options.fit.pixel_size;
    let [start, end] = [0, 1].map(|i| ends[i].distance * size);
    OversketchError::NotNear { start, end, reach: options.reach * size }
}

/// On an open curve an end that is not near means that the curve is replaced up to its end, on the side to which the stroke runs.
fn on_open(
    curve: &Spline,
    sketch: &Polyline,
    ends: &[StrokeEnd; 2],
    options: &OversketchOptions,
) -> Result<Replaced, OversketchError> {
    let length = curve.length();
    Ok(match (ends[0].meeting, ends[1].meeting) {
        (Meeting::Away, Meeting::Away) => return Err(not_near(ends, options)),
        (Meeting::On(a), Meeting::On(b)) => between(curve, sketch, ends, a, b),
        (Meeting::Past(a), Meeting::Past(b)) if a != b => {
            Replaced { from: 0.0, to: length, backward: a > b, attached: [false; 2] }
        }
        (Meeting::Past(_), Meeting::Past(_)) => {
            // It goes on from the end that is nearer, and ends where it ends.
            let first = ends[0].distance <= ends[1].distance;
            from_one(curve, &ends[usize::from(!first)], !first, None)
        }
        (Meeting::On(_), Meeting::Past(b)) => from_one(curve, &ends[0], false, Some(b)),
        (Meeting::Past(a), Meeting::On(_)) => from_one(curve, &ends[1], true, Some(a)),
        (_, Meeting::Away) => from_one(curve, &ends[0], false, None),
        (Meeting::Away, _) => from_one(curve, &ends[1], true, None),
    })
}

/// The stroke lies on an open curve with both ends.
fn between(curve: &Spline, sketch: &Polyline, ends: &[StrokeEnd; 2], a: f64, b: f64) -> Replaced {
    // How well the stroke's ends agree with running from a to b along the curve's own direction.
    let agrees = ends[0].direction.dot(curve.tangent_at(a)) + ends[1].direction.dot(curve.tangent_at(b));
    let forward = b >= a;
    let is_loop = (b - a).abs() <= LOOP_OVERLAP.min(LOOP_SHARE * sketch.length());
    let backward = if is_loop && agrees.abs() > FOLLOWS { agrees < 0.0 } else { !forward };
    let (from, to) = if backward { (b, a) } else { (a, b) };
    Replaced { from, to, backward, attached: [true; 2] }
}

/// The stroke is tied to an open curve by one end only, and replaces it up to the end at station `to`, or to which it runs.
fn from_one(curve: &Spline, tie: &StrokeEnd, at_last: bool, to: Option<f64>) -> Replaced {
    let length = curve.length();
    let station = match tie.meeting {
        Meeting::On(s) | Meeting::Past(s) => s,
        Meeting::Away => 0.0,
    };
    // Away from the tie, in the sense in which the curve runs.
    let leaves = if at_last { -tie.direction } else { tie.direction };
    let along = leaves.dot(curve.tangent_at(station));
    let to_end = match (to, tie.meeting) {
        (Some(to), _) => to > 0.5 * length,
        // From beyond an end it goes on, unless it clearly turns back.
        (None, Meeting::Past(at)) => along > if at > 0.5 * length { -POINTS_THERE } else { POINTS_THERE },
        _ if along.abs() >= POINTS_THERE => along > 0.0,
        _ => station > 0.5 * length,
    };
    // A stroke that leaves its tie towards the curve's end runs along the curve if it begins there.
    let backward = to_end == at_last;
    if to_end {
        Replaced { from: station, to: length, backward, attached: [true, false] }
    } else {
        Replaced { from: 0.0, to: station, backward, attached: [false, true] }
    }
}

/// Of the two ways around, the stroke replaces the shorter one, unless it clearly follows the other.
fn on_closed(
    curve: &Spline,
    sketch: &Polyline,
    ends: &[StrokeEnd; 2],
    options: &OversketchOptions,
) -> Result<Replaced, OversketchError> {
    let (a, b) = match (ends[0].meeting, ends[1].meeting) {
        (Meeting::Away, Meeting::Away) => return Err(not_near(ends, options)),
        (Meeting::Away, _) | (_, Meeting::Away) => {
            let last = matches!(ends[1].meeting, Meeting::Away);
            let size = options.fit.pixel_size;
            return Err(OversketchError::LeadsAway {
                which: if last { "last" } else { "first" },
                distance: ends[usize::from(last)].distance * size,
                reach: options.reach * size,
            });
        }
        (Meeting::On(a) | Meeting::Past(a), Meeting::On(b) | Meeting::Past(b)) => (a, b),
    };
    let length = curve.length();
    let ahead = (b - a).rem_euclid(length);
    // As from the other end, to the bit.
    let behind = if ahead > 0.0 { (a - b).rem_euclid(length) } else { length };
    let [s, e] = [ends[0].direction.dot(curve.tangent_at(a)), ends[1].direction.dot(curve.tangent_at(b))];
    let shorter_is_ahead = ahead <= 0.5 * length;
    let shorter = ahead.min(behind);
    let follows = |forward: bool| if forward { s.min(e) > FOLLOWS } else { s.max(e) < -FOLLOWS };
    let drawn = sketch.length();
    let is_loop = shorter <= LOOP_OVERLAP.min(LOOP_SHARE * drawn);
    let nearer_longer = (drawn - (length - shorter)).abs() < (drawn - shorter).abs();
    let forward = if nearer_longer && follows(!shorter_is_ahead) { !shorter_is_ahead } else { shorter_is_ahead };
    let attached = [true; 2];
    if is_loop && !nearer_longer && follows(!forward) {
        // A loop that comes back before it set out.
        let (from, to) = if forward { (a + ahead, a) } else { (a, a - behind) };
        return Ok(Replaced { from, to, backward: forward, attached });
    }
    Ok(if forward {
        Replaced { from: a, to: a + ahead, backward: false, attached }
    } else {
        Replaced { from: b, to: b + behind, backward: true, attached }
    })
}

/// Ends near a corner, or near the end of an open curve, are meant to be there.
fn snapped(curve: &Spline, mut region: Replaced, options: &OversketchOptions) -> Replaced {
    let length = curve.length();
    let snap = options.snap.min(0.25 * length);
    let mut places: Vec<f64> = corners(curve).map(|(s, _)| s).collect();
    if !curve.is_closed() {
        places.extend([0.0, length]);
    }
    let nearest = |s: f64| {
        let away = |place: f64| {
            let d = place - s;
            if curve.is_closed() { d - length * (d / length + 0.5).floor() } else { d }
        };
        let moves = places.iter().map(|&place| away(place));
        moves.min_by(|x, y| x.abs().total_cmp(&y.abs())).filter(|d| d.abs() <= snap).map_or(s, |d| s + d)
    };
    // What would leave nothing to replace is no snap but a tiny correction.
    let moved = Replaced {
        from: if region.attached[0] { nearest(region.from) } else { region.from },
        to: if region.attached[1] { nearest(region.to) } else { region.to },
        ..region
    };
    if region.attached != [true; 2] || (moved.to - moved.from) * (region.to - region.from) > 0.0 {
        region = moved;
    }
    region
}

/// Stations of the corners, and which join each is.
pub(super) fn corners(curve: &Spline) -> impl Iterator<Item = (f64, usize)> + '_ {
    let mut station = 0.0;
    let n = curve.segments().len();
    curve.segments().iter().enumerate().filter_map(move |(i, segment)| {
        station += segment.length;
        let is_corner = curve.joins().get(i) == Some(&Continuity::G0);
        // The last join of a closed curve is at its start.
        is_corner.then_some((if i + 1 == n { 0.0 } else { station }, i))
    })
}

impl Replaced {
    /// The points of the curve where it is left and joined again.
    pub(super) fn ends(&self, curve: &Spline) -> [Point; 2] {
        [curve.point_at(self.from), curve.point_at(self.to)]
    }
}
