//! From curvature at knots to segments (McCrae and Singh 2008, section 4.3): the kernel's segment is given by its length and the curvatures at
//! its ends, so that equation 10, with its cases for falling and for constant curvature, is not needed.

use super::align::{Pair, Placement, align};
use crate::polyline::Polyline;
use crate::walk::Datum;
use fairpath_curve::{Point, Segment, Vec2};

/// Piecewise linear curvature over a stretch of stroke.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Profile {
    /// Arc lengths along the stroke, increasing, px.
    pub(crate) knots: Vec<f64>,
    /// Radians per px at each knot.
    pub(crate) kappas: Vec<f64>,
}

/// The segments of a profile with G2 joins, the first beginning at `start` with `heading`.
pub(crate) fn composed(profile: &Profile, start: Point, heading: f64) -> Vec<Segment> {
    let mut pose = (start, heading);
    profile
        .knots
        .windows(2)
        .zip(profile.kappas.windows(2))
        .map(|(s, kappa)| {
            let (start, heading) = pose;
            let segment = Segment { start, heading, length: s[1] - s[0], kappa0: kappa[0], kappa1: kappa[1] };
            let end = segment.end_pose();
            pose = (end.point, end.heading);
            segment
        })
        .collect()
}

/// The segments of a profile laid over the `data` of its stretch as a whole (section 4.4); begun at `joint` if it is a limb that
/// articulates there (section 5.1). The ends count `end_weight` times.
pub(crate) fn placed(profile: &Profile, data: &[Datum], joint: Option<Vec2>, end_weight: f64) -> Vec<Segment> {
    let canonical = composed(profile, Point::ORIGIN, 0.0);
    let mut k = 0;
    let last = data.len() - 1;
    let pairs: Vec<Pair> = data
        .iter()
        .enumerate()
        .map(|(i, datum)| {
            while k + 1 < canonical.len() && profile.knots[k + 1] <= datum.s {
                k += 1;
            }
            let on = canonical[k].point_at((datum.s - profile.knots[k]).clamp(0.0, canonical[k].length));
            let weight = if i == 0 || i == last { end_weight * datum.weight.max(LEAST) } else { datum.weight };
            Pair { composed: on.to_vec2(), drawn: datum.point, weight }
        })
        .collect();
    let Placement { turn, shift } = align(&pairs, joint);
    composed(profile, shift.to_point(), turn)
}

/// Weight that an end has at least, px: short edges beside it would leave it none.
const LEAST: f64 = 1e-3;

/// The segments of a profile, each laid over its own part of the `line` of all points: they follow the stroke without drift, but do not meet.
pub(crate) fn scattered(profile: &Profile, line: &Polyline) -> Vec<Segment> {
    let mut hint = 0;
    let mut lay = |s: &[f64], kappa: &[f64]| {
        let one = Profile { knots: s.to_vec(), kappas: kappa.to_vec() };
        let step = (s[1] - s[0]) / STEPS as f64;
        let data: Vec<Datum> = (0..=STEPS)
            .map(|i| s[0] + step * i as f64)
            .map(|s| Datum { point: line.at(s, &mut hint), s, weight: step })
            .collect();
        placed(&one, &data, None, 1.0)[0]
    };
    profile.knots.windows(2).zip(profile.kappas.windows(2)).map(|(s, kappa)| lay(s, kappa)).collect()
}

/// Steps at which a segment is compared with its part of the stroke.
const STEPS: usize = 12;
