//! How one laid piece goes over into the next: a blend, a corner where they cross, or a short line where neither is possible.

use super::blend::Stretches;
use super::guide::Guide;
use super::laid::Laid;
use super::options::FrenchCurveOptions;
use super::pose::Joint;
use fairpath_curve::{Continuity, Pose, Segment, trig};

/// What lies between two pieces.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    /// Arc length on the first piece's path where it is left, and on the second's where it is entered, px.
    pub(crate) left_at: f64,
    pub(crate) entered_at: f64,
    /// The segments between, if any.
    pub(crate) between: Vec<Segment>,
    /// How the first piece, these and the second piece meet: one more than there are segments.
    pub(crate) joins: Vec<Continuity>,
    /// Whether the pieces meet too roughly for what was wanted.
    pub(crate) rough: bool,
}

/// The link from `a` to `b`; `a` is not left before the arc length `kept` of its path.
pub(crate) fn link(
    a: &Laid,
    b: &Laid,
    joint: Joint,
    kept: f64,
    guides: &[Guide],
    options: &FrenchCurveOptions,
) -> Link {
    match joint {
        Joint::Straight => {
            Link { left_at: a.to, entered_at: b.from, between: Vec::new(), joins: vec![Continuity::G0], rough: false }
        }
        Joint::Corner => crossing(a, b, kept, guides).unwrap_or_else(|| bridge(a, b, kept, guides)),
        Joint::Smooth => match blend(a, b, guides, options) {
            Some(link) => link,
            None => Link { rough: true, ..crossing(a, b, kept, guides).unwrap_or_else(|| bridge(a, b, kept, guides)) },
        },
    }
}

/// How far a blend reaches on each piece, px.
pub(crate) fn reach(laid: &Laid, guides: &[Guide], at_end: bool, options: &FrenchCurveOptions) -> f64 {
    let path = &guides[laid.guide].path;
    let own = SHARE * (laid.to - laid.from);
    // A blend does not pass a corner of the template.
    let free = if at_end {
        laid.to - path.smooth_stretch(laid.to - LEAST)[0]
    } else {
        path.smooth_stretch(laid.from)[1] - laid.from
    };
    options.blend.min(own).min(SHARE_OF_LEG * free)
}

/// Most of a piece that a blend takes at one end: a fifth of it is seen as it is.
const SHARE: f64 = 0.4;
/// Most of the way to a corner.
const SHARE_OF_LEG: f64 = 0.8;
/// The shortest blend, px: what is less is none.
const LEAST: f64 = 1e-3;

fn blend(a: &Laid, b: &Laid, guides: &[Guide], options: &FrenchCurveOptions) -> Option<Link> {
    let (pa, pb) = (&guides[a.guide].path, &guides[b.guide].path);
    let left_at = pa.snapped(a.to - reach(a, guides, true, options));
    let entered_at = pb.snapped(b.from + reach(b, guides, false, options));
    let (before, after) = (a.to - left_at, entered_at - b.from);
    if !(before > LEAST && after > LEAST) {
        return None;
    }
    let length = before + after;
    let (smooth_a, smooth_b) = (pa.smooth_stretch(a.to - LEAST), pb.smooth_stretch(b.from + LEAST));
    let stretches = Stretches {
        from: |t: f64| a.placed(pa.pose_within(left_at + length * t, smooth_a)),
        into: |t: f64| b.placed(pb.pose_within(entered_at - length * (1.0 - t), smooth_b)),
        length,
    };
    let between = stretches.clothoids(options.accuracy)?;
    let joins = vec![Continuity::G2; between.len() + 1];
    Some(Link { left_at, entered_at, between, joins, rough: false })
}

/// The end of `a` led to the beginning of `b`, which stays as it is: smoothly if they meet at less than [`SMOOTH_CLOSING`], else with a corner. Nothing
/// if they are too far apart for that.
pub(crate) fn closing(a: &Laid, b: &Laid, kept: f64, guides: &[Guide], options: &FrenchCurveOptions) -> Option<Link> {
    let (pa, pb) = (&guides[a.guide].path, &guides[b.guide].path);
    let left_at = kept.min(a.to - LEAST);
    let (end, begin) = (a.pose(pa, a.to), b.pose(pb, b.from));
    let length = a.to - left_at;
    if trig::wrap_angle(begin.heading - end.heading).abs() < SMOOTH_CLOSING {
        let (smooth_a, smooth_b) = (pa.smooth_stretch(a.to - LEAST), pb.smooth_stretch(b.from + LEAST));
        let stretches = Stretches {
            from: |t: f64| a.placed(pa.pose_within(left_at + length * t, smooth_a)),
            into: |t: f64| b.placed(pb.pose_within(b.from - length * (1.0 - t), smooth_b)),
            length,
        };
        let between = stretches.clothoids(options.accuracy)?;
        let joins = vec![Continuity::G2; between.len() + 1];
        return Some(Link { left_at, entered_at: b.from, between, joins, rough: false });
    }
    let chain = fairpath_curve::hermite_g2(a.pose(pa, left_at), Pose { point: begin.point, ..end })?;
    let sound = chain.iter().map(|s| s.length).sum::<f64>() < LOOSE * length + FURTHER;
    let joins = vec![Continuity::G2, Continuity::G2, Continuity::G2, Continuity::G0];
    sound.then(|| Link { left_at, entered_at: b.from, between: chain.to_vec(), joins, rough: false })
}

/// Ends that meet at less than this close smoothly, radians.
const SMOOTH_CLOSING: f64 = 0.8;

/// A corner where the two pieces, or their templates a little further on, cross.
fn crossing(a: &Laid, b: &Laid, kept: f64, guides: &[Guide]) -> Option<Link> {
    let (pa, pb) = (&guides[a.guide].path, &guides[b.guide].path);
    let [low_a, high_a] = pa.smooth_stretch(a.to - LEAST);
    let [low_b, high_b] = pb.smooth_stretch(b.from + LEAST);
    let range_a = [low_a.max(a.to - KEPT * (a.to - a.from)).max(kept), high_a.min(a.to + FURTHER)];
    let range_b = [low_b.max(b.from - FURTHER), high_b.min(b.from + KEPT * (b.to - b.from))];
    let (mut u, mut v) = (a.to, b.from);
    let mut gap = f64::INFINITY;
    for _ in 0..CROSSING_ROUNDS {
        let (p, q) = (a.pose(pa, u), b.pose(pb, v));
        let apart = q.point - p.point;
        gap = apart.hypot2();
        let (s, t) = (trig::unit(p.heading), trig::unit(q.heading));
        let sine = s.cross(t);
        if sine.abs() < FLAT {
            return None;
        }
        let (du, dv) = (apart.cross(t) / sine, apart.cross(s) / sine);
        (u, v) = ((u + du).clamp(range_a[0], range_a[1]), (v + dv).clamp(range_b[0], range_b[1]));
        if du * du + dv * dv < EXACT * EXACT {
            gap = (b.pose(pb, v).point - a.pose(pa, u).point).hypot2();
            break;
        }
    }
    let found = gap < EXACT * EXACT && u > (a.from + LEAST).max(kept) && v < b.to - LEAST;
    let link = Link { left_at: u, entered_at: v, between: Vec::new(), joins: vec![Continuity::G0], rough: false };
    found.then_some(link)
}

/// Furthest that a piece is prolonged to a corner, px, and most of it that is cut off there.
const FURTHER: f64 = 15.0;
const KEPT: f64 = 0.45;
/// Newton's steps for a crossing, and the gap at which it is one, px.
const CROSSING_ROUNDS: usize = 30;
const EXACT: f64 = 1e-11;
/// Sine of the least angle at which curves cross.
const FLAT: f64 = 0.05;

/// The gap closed by bending the end of one piece and the beginning of the other to the middle between them; by a line if that is not possible.
fn bridge(a: &Laid, b: &Laid, kept: f64, guides: &[Guide]) -> Link {
    let (pa, pb) = (&guides[a.guide].path, &guides[b.guide].path);
    let (end, begin) = (a.pose(pa, a.to), b.pose(pb, b.from));
    let middle = end.point.midpoint(begin.point);
    // Corners of the templates stay.
    let (corner_a, corner_b) = (pa.smooth_stretch(a.to - LEAST)[0], pb.smooth_stretch(b.from + LEAST)[1]);
    let left_at = pa.snapped((a.to - BENT * (a.to - a.from).min(a.to - corner_a)).max(kept));
    let entered_at = pb.snapped(b.from + BENT * (b.to - b.from).min(corner_b - b.from));
    let bent = |from: Pose, to: Pose, most: f64| {
        fairpath_curve::hermite_g2(from, to).filter(|chain| chain.iter().map(|s| s.length).sum::<f64>() < most)
    };
    let into = bent(a.pose(pa, left_at), Pose { point: middle, ..end }, LOOSE * (a.to - left_at));
    let out = bent(Pose { point: middle, ..begin }, b.pose(pb, entered_at), LOOSE * (entered_at - b.from));
    if let (Some(into), Some(out)) = (into, out) {
        let between: Vec<Segment> = into.into_iter().chain(out).collect();
        let mut joins = vec![Continuity::G2; between.len() + 1];
        joins[into.len()] = Continuity::G0;
        return Link { left_at, entered_at, between, joins, rough: false };
    }
    let gap = begin.point - end.point;
    let line = Segment::line(end.point, trig::angle_of(gap), gap.hypot2().sqrt());
    let between = if line.length > EXACT { vec![line] } else { Vec::new() };
    let joins = vec![Continuity::G0; between.len() + 1];
    Link { left_at: a.to, entered_at: b.from, between, joins, rough: true }
}

/// Share of a piece that is bent, and by how much it may become longer.
const BENT: f64 = 0.4;
const LOOSE: f64 = 1.5;
