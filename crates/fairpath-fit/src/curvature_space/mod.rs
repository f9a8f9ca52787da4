//! Sketching piecewise clothoid curves (McCrae and Singh 2008): stroke in, spline out.

pub(crate) mod align;
mod compose;
mod estimate;
mod options;
mod profile;
mod refine;
mod segmentation;

pub use options::{CurvatureEstimate, CurvatureSpaceOptions, Mode};

use crate::clean::{Cleaned, clean};
use crate::conclude::{Parts, closing_warnings, describe, polyline, restored_spline};
use crate::direction::{is_backward, turned_round};
use crate::options::FitOptions;
use crate::polyline::Polyline;
use crate::result::{Fit, FitError, Report, Warning};
use crate::shortest_path::circle::circle;
use crate::stroke::Stroke;
use crate::track::{Shape, Track, prepare};
use crate::walk::Datum;
use compose::{Profile, placed};
use estimate::{Place, curvature};
use fairpath_curve::{Continuity, Point, Segment, Vec2};

/// Fits a stroke.
pub(crate) fn fit(stroke: &Stroke, options: &CurvatureSpaceOptions) -> Result<Fit, FitError> {
    options.validate()?;
    let mut cleaned = clean(&stroke.points, options.stroke.pixel_size)?;
    let backward = is_backward(&stroke.points);
    if backward {
        let reversed: Vec<Point> = stroke.points.iter().rev().copied().collect();
        cleaned = clean(&reversed, options.stroke.pixel_size)?;
    }
    let mut fit = to_target(stroke, &cleaned, options)?;
    warn_if_far(&mut fit, options);
    Ok(if backward { turned_round(fit) } else { fit })
}

/// Fits with a cost of pieces that is lowered until the target is met (section 6).
fn to_target(stroke: &Stroke, cleaned: &Cleaned, options: &CurvatureSpaceOptions) -> Result<Fit, FitError> {
    let Ground { track, stretches } = &Ground::of(cleaned, options);
    let mut piece_cost = options.piece_cost;
    let mut best: Option<Fit> = None;
    for _ in 0..if options.target_error.is_some() { LOWERED } else { 1 } {
        let fit = solve(stroke, cleaned, track, stretches, piece_cost, options)?;
        // More pieces must be worth it: tremor does not yield to them.
        if best.as_ref().is_none_or(|b| fit.report.max_deviation < WORTH * b.report.max_deviation) {
            best = Some(fit);
        }
        let reached = best.as_ref().map_or(f64::INFINITY, |b| b.report.max_deviation);
        if options.target_error.is_none_or(|target| reached <= target * options.stroke.pixel_size) {
            break;
        }
        piece_cost *= LOWER;
    }
    best.ok_or(FitError::Unfittable { points: stroke.points.len() })
}

/// By how much the cost of a piece is lowered at once, and how often at most: a thousandth of it makes a piece of nearly every place.
const LOWER: f64 = 0.7;
const LOWERED: usize = 20;

/// A curve of more pieces replaces one of fewer if its largest deviation is at most this share of the other's.
const WORTH: f64 = 0.9;

fn warn_if_far(fit: &mut Fit, options: &CurvatureSpaceOptions) {
    let off = fit.report.max_deviation;
    let told = |code: &str, text: String| Warning { code: code.into(), text };
    if let Some(target) = options.target_error
        && off > target * options.stroke.pixel_size
    {
        let target = target * options.stroke.pixel_size;
        fit.warnings.push(told("target-missed", format!("the curve is up to {off:.3} off, more than {target:.3}")));
    }
    if off > options.max_error * options.stroke.pixel_size {
        fit.warnings.push(told("far-from-stroke", format!("the curve is up to {off:.3} away from the stroke")));
    }
}

/// A stroke with its curvature: what does not depend on the cost of a piece.
struct Ground {
    track: Track,
    stretches: Vec<Stretch>,
}

/// What lies between two corners or ends, or one turn of a ring.
struct Stretch {
    places: Vec<Place>,
    /// Arc lengths along the track, px.
    span: [f64; 2],
}

impl Ground {
    fn of(cleaned: &Cleaned, options: &CurvatureSpaceOptions) -> Self {
        let track = prepare(cleaned, &options.shared());
        let data = &track.all.data;
        let mut is_sample = vec![false; data.len()];
        for &i in &track.all.samples {
            is_sample[i] = true;
        }
        let ring = track.shape == Shape::Ring;
        // Of the turns of a ring, the middle one goes on smoothly at both ends.
        let ends = if ring { [track.turn, 2 * track.turn] } else { [0, track.turn] };
        let inner = (ends[0] + 1..ends[1]).filter(|&i| track.corner[i]);
        let stops: Vec<f64> =
            std::iter::once(ends[0]).chain(inner).chain([ends[1]]).map(|i| track.all.station(i)).collect();
        let stretches = stops
            .windows(2)
            .map(|s| Stretch { places: curvature(data, &is_sample, [s[0], s[1]], ring, options), span: [s[0], s[1]] })
            .collect();
        Self { track, stretches }
    }
}

/// One pass of the method with a given cost of a piece.
fn solve(
    stroke: &Stroke,
    cleaned: &Cleaned,
    track: &Track,
    stretches: &[Stretch],
    piece_cost: f64,
    options: &CurvatureSpaceOptions,
) -> Result<Fit, FitError> {
    let mut warnings = closing_warnings(track, options.stroke.closed);
    let mut warn = |code: &str, text: &str| warnings.push(Warning { code: code.into(), text: text.into() });
    let mut report = Report {
        points: stroke.points.len(),
        samples: stretches.iter().map(|s| s.places.len()).sum(),
        ..Report::default()
    };
    let mut profiles = Vec::with_capacity(stretches.len());
    for stretch in stretches {
        let (profile, cost) = linear_pieces(stretch, track.shape, piece_cost);
        report.cost += cost;
        profiles.push(profile);
    }
    let data = course(track, profiles[0].knots[0]);
    let mut parts = None;
    if options.mode == Mode::Refined {
        parts =
            whole_circle(track, &profiles, options).or_else(|| refine::refined(&profiles, data, track.shape, options));
        if parts.is_none() {
            warn("not-refined", "the pieces could not be fitted to the points; their curvature is as it was found");
        }
    }
    let mut spline = parts.and_then(|parts| restored_spline(parts, cleaned));
    if spline.is_none() {
        if track.shape != Shape::Open {
            warn("left-open", "the stroke is closed, but its curve is not: curvature alone does not make ends meet");
        }
        spline = restored_spline(limbs(&profiles, data, options), cleaned);
    }
    let spline = spline.or_else(|| {
        warn("fell-back-to-polyline", "no fair curve was found; the stroke is given as a polyline");
        restored_spline(polyline(track), cleaned)
    });
    let spline = spline.ok_or(FitError::Unfittable { points: stroke.points.len() })?;
    describe(&mut report, &spline, stroke, options.stroke.pixel_size);
    Ok(Fit { spline, report, warnings })
}

/// The connected piecewise linear curvature of a stretch (section 4.2) and the cost of its pieces.
fn linear_pieces(stretch: &Stretch, shape: Shape, piece_cost: f64) -> (Profile, f64) {
    let (mut places, mut span) = (stretch.places.clone(), stretch.span);
    let (mut breaks, mut cost) = segmentation::breaks(&places, piece_cost);
    if shape == Shape::Ring {
        // The seam is no place to break at: it moves to where a break is anyway.
        let middle = places.len() / 2;
        if let Some(&seam) = breaks[1..breaks.len() - 1].iter().min_by_key(|i| i.abs_diff(middle)) {
            let begin = places[seam].s;
            places = turned(&places, seam, span[1] - span[0]);
            span = [begin, begin + span[1] - span[0]];
            (breaks, cost) = segmentation::breaks(&places, piece_cost);
        }
    }
    let mut knots: Vec<f64> = breaks.iter().map(|&i| places[i].s).collect();
    knots[0] = span[0];
    if knots.len() == 1 {
        knots.push(span[1]);
    }
    let last = knots.len() - 1;
    knots[last] = span[1];
    if shape == Shape::Ring {
        divide(&mut knots, RING_PIECES);
    }
    let kappas = profile::connected(&places, &knots);
    (Profile { knots, kappas }, cost)
}

/// A smoothly closed curve that is no circle has four vertices, extremes of its curvature, and linear pieces between them.
const RING_PIECES: usize = 4;

/// Halves the longest pieces until there are so many.
fn divide(knots: &mut Vec<f64>, pieces: usize) {
    while knots.len() <= pieces {
        let length = |k: &usize| knots[*k] - knots[*k - 1];
        // The first of equal ones, for the same result everywhere.
        let longest = (1..knots.len()).rev().max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or(1);
        knots.insert(longest, 0.5 * (knots[longest - 1] + knots[longest]));
    }
}

/// The places of a ring of given length from the place `seam` on, once around.
fn turned(places: &[Place], seam: usize, length: f64) -> Vec<Place> {
    let last = places.len() - 1;
    let again = places[1..=seam].iter().map(|p| Place { s: p.s + length, ..*p });
    let mut out: Vec<Place> = places[seam..].iter().copied().chain(again).collect();
    // Places stand for half a step at the ends of the turn, and for a whole one elsewhere.
    let step = length / last as f64;
    for (i, p) in out.iter_mut().enumerate() {
        p.weight = if i == 0 || i == last { 0.5 * step } else { step };
    }
    out
}

/// The points of the stroke, or of one turn of a ring, from arc length `from` on; the last of a ring is the first once more.
fn course(track: &Track, from: f64) -> &[Datum] {
    let count = track.all.samples[track.turn] - track.all.samples[0];
    let first = track.all.data.partition_point(|d| d.s < from - 1e-9);
    &track.all.data[first..=first + count]
}

/// A ring of few pieces that is a circle, as one arc: it has no vertices at which pieces could meet.
fn whole_circle(track: &Track, profiles: &[Profile], options: &CurvatureSpaceOptions) -> Option<Parts> {
    if track.shape != Shape::Ring || profiles[0].knots.len() > RING_PIECES + 1 {
        return None;
    }
    let found = circle(track, &FitOptions { arc_cost: Some(0.0), ..options.shared() })?;
    let enough = options.target_error.unwrap_or(f64::INFINITY).min(ROUND * options.max_error);
    (found.largest <= enough).then(|| (vec![found.arc], vec![Continuity::G3], true))
}

/// A ring is a circle that strays from one by less than this share of `max_error`.
const ROUND: f64 = 0.4;

/// The curve as the paper makes it: the first limb laid over its stretch, each further one turned about the end of the one before
/// (section 5.1).
fn limbs(profiles: &[Profile], data: &[Datum], options: &CurvatureSpaceOptions) -> Parts {
    let mut segments: Vec<Segment> = Vec::new();
    let mut joins = Vec::new();
    let mut joint: Option<Vec2> = None;
    for profile in profiles {
        let (from, to) = (profile.knots[0], profile.knots[profile.knots.len() - 1]);
        let run = &data[data.partition_point(|d| d.s < from - 1e-9)..data.partition_point(|d| d.s <= to + 1e-9)];
        let limb = placed(profile, run, joint, options.end_weight);
        if joint.is_some() {
            joins.push(Continuity::G0);
        }
        joins.resize(joins.len() + limb.len() - 1, Continuity::G2);
        segments.extend(limb);
        joint = segments.last().map(|s| s.end().to_vec2());
    }
    (segments, joins, false)
}

/// All of `data` as a polyline by the arc lengths that they have.
pub(crate) fn polyline_of(data: &[Datum]) -> Polyline {
    Polyline { points: data.iter().map(|d| d.point).collect(), s: data.iter().map(|d| d.s).collect() }
}
