//! Sketching piecewise clothoid curves (McCrae and Singh 2008): stroke in, spline out.

mod align;
mod compose;
mod estimate;
mod ground;
mod inflections;
mod options;
mod pieces;
mod profile;
mod refine;
mod segmentation;

pub use options::{CurvatureEstimate, CurvatureSpaceOptions, Mode};

use crate::clean::{Cleaned, clean};
use crate::conclude::{Parts, describe, polyline, restored_spline};
use crate::direction::{is_backward, turned_round};
use crate::options::Closing;
use crate::result::{Fit, FitError, Observer, Report, Step, Warning};
use crate::stroke::Stroke;
use crate::track::{Shape, Track};
use crate::walk::Datum;
use compose::{Profile, placed};
use fairpath_curve::{Continuity, Point, Segment, Vec2};
use ground::{Ground, run};
use refine::{Refined, Run, refined};

/// Fits a stroke.
pub(crate) fn fit(
    stroke: &Stroke,
    options: &CurvatureSpaceOptions,
    observer: &mut dyn Observer,
) -> Result<Fit, FitError> {
    options.validate()?;
    observer.step(Step::Preprocess);
    let mut cleaned = clean(&stroke.points, options.stroke.pixel_size)?;
    let backward = is_backward(&stroke.points);
    if backward {
        let reversed: Vec<Point> = stroke.points.iter().rev().copied().collect();
        cleaned = clean(&reversed, options.stroke.pixel_size)?;
    }
    let fit = solve(stroke, &cleaned, options, observer)?;
    observer.step(Step::Done);
    Ok(if backward { turned_round(fit) } else { fit })
}

/// The method on cleaned points.
fn solve(
    stroke: &Stroke,
    cleaned: &Cleaned,
    options: &CurvatureSpaceOptions,
    observer: &mut dyn Observer,
) -> Result<Fit, FitError> {
    let track = Ground::track(cleaned, options);
    observer.step(Step::Candidates);
    let ground = Ground::of(track, options);
    let mut report = Report {
        points: stroke.points.len(),
        samples: ground.stretches.iter().map(|s| s.places.len()).sum(),
        ..Report::default()
    };
    let mut warnings = warnings_of(&ground.track, options);
    let mut warn = |code: &str, text: &str| warnings.push(told(code, text.into()));
    let found = to_target(&ground, options, observer);
    report.cost = found.cost;
    if options.mode == Mode::Refined && !found.refined {
        warn("not-refined", "the pieces could not be fitted to the points; their curvature is as it was found");
    }
    if !found.refined && ground.track.shape != Shape::Open {
        warn("left-open", "the stroke is closed, but its curve is not: curvature alone does not make ends meet");
    }
    let spline = restored_spline(found.parts, cleaned).or_else(|| {
        warn("fell-back-to-polyline", "no fair curve was found; the stroke is given as a polyline");
        restored_spline(polyline(&ground.track), cleaned)
    });
    let spline = spline.ok_or(FitError::Unfittable { points: stroke.points.len() })?;
    describe(&mut report, &spline, stroke, options.stroke.pixel_size);
    warnings.extend(warnings_if_far(report.max_deviation, options));
    Ok(Fit { spline, report, warnings })
}

fn told(code: &str, text: String) -> Warning {
    Warning { code: code.into(), text }
}

fn warnings_of(track: &Track, options: &CurvatureSpaceOptions) -> Vec<Warning> {
    let mut out = Vec::new();
    if track.trimmed > 0 {
        let text = format!("the ends of the closed stroke overshoot: {} points were cut off", track.trimmed);
        out.push(told("closed-by-trimming", text));
    }
    if options.stroke.closed == Closing::Yes && track.shape == Shape::Open {
        let text = "the stroke was to be closed, but nothing would remain of it; it is fitted as an open one";
        out.push(told("not-closed", text.into()));
    }
    out
}

fn warnings_if_far(off: f64, options: &CurvatureSpaceOptions) -> Vec<Warning> {
    let mut out = Vec::new();
    if let Some(target) = options.target_error.map(|target| target * options.stroke.pixel_size)
        && off > target
    {
        out.push(told("target-missed", format!("the curve is up to {off:.3} off, more than {target:.3}")));
    }
    if off > options.max_error * options.stroke.pixel_size {
        out.push(told("far-from-stroke", format!("the curve is up to {off:.3} away from the stroke")));
    }
    out
}

/// A curve in pixels and how it came about.
struct Found {
    parts: Parts,
    /// Whether it was fitted to the points, not only laid over them.
    refined: bool,
    /// Of the pieces of curvature, by equation 7, radians.
    cost: f64,
}

/// Finds a curve with a cost of pieces that is lowered where the target is missed, as long as that helps (section 6).
fn to_target(ground: &Ground, options: &CurvatureSpaceOptions, observer: &mut dyn Observer) -> Found {
    let shape = ground.track.shape;
    let count = ground.stretches.len();
    let mut costs = vec![options.piece_cost; count];
    let mut best: Option<(Found, f64)> = None;
    let mut stale = 0;
    let mut profiles: Vec<(Profile, f64)> = Vec::new();
    let mut runs: Vec<Run> = Vec::new();
    let target = options.target_error.unwrap_or(f64::INFINITY);
    let mut pending = vec![true; count];
    for _ in 0..LOWERED {
        observer.step(Step::Search);
        for j in (0..count).filter(|&j| pending[j]) {
            let found = pieces::linear_pieces(&ground.stretches[j], shape, costs[j]);
            if profiles.len() <= j {
                profiles.push(found);
            } else {
                profiles[j] = found;
            }
        }
        observer.step(Step::Merge);
        let cost = profiles.iter().map(|p| p.1).sum();
        let mut solved = None;
        if options.mode == Mode::Refined {
            let own: Vec<Run> = (0..count)
                .map(|j| if pending[j] || runs.len() != count { Run::of(&profiles[j].0, ground) } else { runs[j].clone() })
                .collect();
            solved = refined(&own, ground, options);
        }
        let (found, errors) = match solved {
            Some(Refined { parts, runs: next, errors }) => {
                runs = next;
                (Found { parts, refined: true, cost }, errors)
            }
            None => {
                runs.clear();
                let profiles: Vec<&Profile> = profiles.iter().map(|p| &p.0).collect();
                let (parts, errors) = limbs(&profiles, ground, options);
                (Found { parts, refined: false, cost }, errors)
            }
        };
        let off = errors.iter().copied().fold(0.0, f64::max);
        // More pieces must be worth it: tremor does not yield to them.
        if best.as_ref().is_none_or(|b| off < WORTH * b.1) {
            best = Some((found, off));
            stale = 0;
        } else {
            stale += 1;
        }
        if off <= target || stale >= PATIENCE {
            break;
        }
        for j in 0..count {
            pending[j] = errors.get(j).is_none_or(|e| *e > target) || options.mode == Mode::Faithful;
            if pending[j] {
                costs[j] *= LOWER;
            }
        }
    }
    best.map_or_else(|| unreachable!("the loop runs at least once"), |b| b.0)
}

/// By how much the cost of a piece is lowered at once, and how often at most: a thousandth of it makes a piece of nearly every place.
const LOWER: f64 = 0.5;
const LOWERED: usize = 11;

/// A curve of more pieces replaces one of fewer if its largest deviation is at most this share of the other's.
const WORTH: f64 = 0.9;

/// So often in sequence may lowering the cost bring nothing.
const PATIENCE: usize = 2;

/// The curve as the paper makes it: the first limb laid over its stretch, each further one turned about the end of the one before
/// (section 5.1); and the largest distance of points of each stretch, px.
fn limbs(profiles: &[&Profile], ground: &Ground, options: &CurvatureSpaceOptions) -> (Parts, Vec<f64>) {
    let data = run(&ground.track, &ground.track.all, profiles[0].knots[0]);
    let mut segments: Vec<Segment> = Vec::new();
    let mut joins = Vec::new();
    let mut errors = Vec::new();
    let mut joint: Option<Vec2> = None;
    for profile in profiles {
        let (from, to) = (profile.knots[0], profile.knots[profile.knots.len() - 1]);
        let run = &data[data.partition_point(|d| d.s < from - 1e-9)..data.partition_point(|d| d.s <= to + 1e-9)];
        let limb = placed(profile, run, joint, options.end_weight);
        errors.push(largest_distance(&limb, run));
        if joint.is_some() {
            joins.push(Continuity::G0);
        }
        joins.resize(joins.len() + limb.len() - 1, Continuity::G2);
        segments.extend(limb);
        joint = segments.last().map(|s| s.end().to_vec2());
    }
    ((segments, joins, false), errors)
}

fn largest_distance(limb: &[Segment], run: &[Datum]) -> f64 {
    let distance = |d: &Datum| {
        limb.iter().map(|s| s.nearest(d.point.to_point()).distance).fold(f64::INFINITY, f64::min)
    };
    run.iter().map(distance).fold(0.0, f64::max)
}
