//! Where the curve that is fitted anew meets what stays: beyond what the stroke replaces, at a join, a corner, the curve's end or a cut
//! (section 3.7 of Baran et al. 2010). A curve and what is replaced come in, the two seams go out.

use super::options::OversketchOptions;
use super::region::{Replaced, corners};
use crate::splice::Place;
use fairpath_curve::Spline;

/// An end of what is fitted anew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Seam {
    /// The curve ends there, where it ended before.
    CurveEnd { station: f64 },
    /// The curve ends where the stroke does.
    StrokeEnd { station: f64 },
    /// What stays ends or begins here: at arc length `s` of a segment, its start if that is zero.
    Place { station: f64, segment: usize, s: f64 },
}

impl Seam {
    /// Arc length from the curve's start, px; on a closed curve it may lie beyond both ends.
    pub(super) fn station(&self) -> f64 {
        match *self {
            Self::CurveEnd { station } | Self::StrokeEnd { station } | Self::Place { station, .. } => station,
        }
    }

    /// Where that is in the curve in its own unit, of which a px is `scale`; nothing where the curve ends.
    pub(super) fn place(&self, scale: f64) -> Option<Place> {
        match *self {
            Self::Place { segment, s, .. } => Some(Place { segment, s: s * scale }),
            _ => None,
        }
    }
}

/// What is fitted anew, in px of the local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refitted {
    Between([Seam; 2]),
    /// All of a closed curve.
    All,
}

/// What would be left of a segment that is cut, or of the whole curve, must be longer than this, px.
const LEAST_REST: f64 = 12.0;

/// A place this near to a join is the join, px.
const AT_JOIN: f64 = 1e-6;

/// A place where the curve may be parted: its station and the segment that begins there.
#[derive(Clone, Copy)]
struct Knot {
    station: f64,
    segment: usize,
    corner: bool,
}

/// Widens what is replaced by a stroke of length `drawn`: beside a short one, little needs to change.
pub(super) fn widened(curve: &Spline, replaced: &Replaced, drawn: f64, options: &OversketchOptions) -> Refitted {
    let knots = knots(curve);
    let options = &OversketchOptions { widest: options.widest.min(drawn).max(options.widening), ..options.clone() };
    let start = if replaced.attached[0] {
        seam(curve, &knots, replaced.from, false, options)
    } else {
        Seam::StrokeEnd { station: replaced.from }
    };
    let end = if replaced.attached[1] {
        seam(curve, &knots, replaced.to, true, options)
    } else {
        Seam::StrokeEnd { station: replaced.to }
    };
    if curve.is_closed() && end.station() - start.station() > curve.length() - LEAST_REST {
        return Refitted::All;
    }
    Refitted::Between([start, end])
}

/// The knots of a curve; those of a closed one through four turns, so that one may look past its start.
fn knots(curve: &Spline) -> Vec<Knot> {
    let length = curve.length();
    let sharp: Vec<usize> = corners(curve).map(|(_, join)| join).collect();
    let n = curve.segments().len();
    let turns = if curve.is_closed() { -1..3 } else { 0..1 };
    let mut out = Vec::new();
    for turn in turns {
        let mut station = f64::from(turn) * length;
        for (segment, s) in curve.segments().iter().enumerate() {
            let corner = (segment > 0 || curve.is_closed()) && sharp.contains(&((segment + n - 1) % n));
            out.push(Knot { station, segment, corner });
            station += s.length;
        }
    }
    if !curve.is_closed() {
        out.push(Knot { station: length, segment: n, corner: false });
    }
    out
}

/// The seam before (or, `ahead`, after) a station.
fn seam(curve: &Spline, knots: &[Knot], from: f64, ahead: bool, options: &OversketchOptions) -> Seam {
    let outward = if ahead { 1.0 } else { -1.0 };
    let away = |knot: &Knot| outward * (knot.station - from);
    let nearest = |least: f64, corner: bool| {
        let fit = knots.iter().filter(|k| away(k) >= least && (k.corner || !corner));
        fit.min_by(|a, b| away(a).total_cmp(&away(b)))
    };
    let wide = nearest(options.widening, false);
    // Where there is a corner anyway, nothing has to be made smooth.
    let corner = nearest(-AT_JOIN, true).filter(|c| wide.is_none_or(|w| away(c) <= away(w)));
    let last = curve.segments().len();
    let is_end = |knot: &Knot| !curve.is_closed() && (knot.segment == 0 || knot.segment == last);
    let at = |knot: &Knot| {
        if is_end(knot) {
            return Seam::CurveEnd { station: knot.station };
        }
        Seam::Place { station: knot.station, segment: knot.segment, s: 0.0 }
    };
    let cut = |away: f64| {
        let station = from + outward * away;
        let (segment, s) = curve.locate(station);
        if s <= AT_JOIN {
            return Seam::Place { station, segment, s: 0.0 };
        }
        if curve.segments()[segment].length - s <= AT_JOIN {
            return Seam::Place { station, segment: (segment + 1) % last, s: 0.0 };
        }
        Seam::Place { station, segment, s }
    };
    match corner.or(wide) {
        // Nearer to the curve's end than the widening.
        None => Seam::CurveEnd { station: if ahead { curve.length() } else { 0.0 } },
        // How the curve ends is not what was drawn over: it stays if that leaves something.
        Some(knot) if is_end(knot) && away(knot) > options.widening + LEAST_REST => {
            cut(options.widest.min(away(knot) - LEAST_REST))
        }
        Some(knot) if away(knot) <= options.widest + LEAST_REST => at(knot),
        Some(_) => cut(options.widest),
    }
}
