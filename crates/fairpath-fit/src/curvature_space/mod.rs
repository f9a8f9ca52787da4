//! Sketching piecewise clothoid curves (McCrae and Singh 2008): stroke in, spline out.

pub(crate) mod align;
mod blend;
mod compose;
mod estimate;
mod ground;
mod inflections;
mod options;
mod pieces;
mod profile;
mod refine;
mod segmentation;
mod stages;

pub use options::{CurvatureEstimate, CurvatureSpaceOptions, Mode};
pub use stages::{CurvaturePlace, CurvatureStages};

use crate::clean::{Cleaned, clean};
use crate::conclude::{Parts, closing_warnings, describe, polyline, restored_spline};
use crate::direction::{is_backward, turned_round};
use crate::options::FitOptions;
use crate::result::{Fit, FitError, Observer, Report, Step, Warning};
use crate::stroke::Stroke;
use crate::walk::Datum;
use blend::{blended, rounded};
use compose::{Profile, placed};
use fairpath_curve::{Continuity, Point, Segment, Vec2};
use ground::{Ground, Stretch, run};
use pieces::linear_pieces;
use refine::{LONGER, Refined, Run, refined};

/// Fits a stroke.
pub(crate) fn fit(
    stroke: &Stroke,
    options: &CurvatureSpaceOptions,
    observer: &mut dyn Observer,
    mut stages: Option<&mut CurvatureStages>,
) -> Result<Fit, FitError> {
    options.validate()?;
    observer.step(Step::Preprocess);
    let mut cleaned = clean(&stroke.points, options.stroke.pixel_size)?;
    let backward = is_backward(&stroke.points);
    if backward {
        let reversed: Vec<Point> = stroke.points.iter().rev().copied().collect();
        cleaned = clean(&reversed, options.stroke.pixel_size)?;
    }
    let mut fit = solve(stroke, &cleaned, (options, &options.shared()), observer, stages.as_deref_mut())?;
    let drawn: f64 = stroke.points.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
    let astray = |f: &Fit| f.report.max_deviation.max(0.5 * (f.spline.length() - LONGER * drawn));
    let asked = options.target_error.unwrap_or(f64::INFINITY).min(STRAY * options.max_error);
    if options.mode == Mode::Refined && astray(&fit) > asked * options.stroke.pixel_size {
        // Somewhere the costs accepted what was not asked for, or a corner was missed: the stroke is fitted once more, more closely.
        let shared = options.shared();
        let shared =
            FitOptions { corner_score: 0.5 * shared.corner_score, max_error: 0.7 * shared.max_error, ..shared };
        let mut own = CurvatureStages::default();
        let own_stages = stages.is_some().then_some(&mut own);
        let close = solve(stroke, &cleaned, (&options.closer(), &shared), observer, own_stages)?;
        if astray(&close) < WORTH * astray(&fit) {
            fit = close;
            if let Some(stages) = stages.as_deref_mut() {
                *stages = own;
            }
        }
    }
    fit.warnings.extend(warnings_if_far(fit.report.max_deviation, astray(&fit), options));
    if backward {
        fit = turned_round(fit);
        if let Some(stages) = stages {
            stages.turned_round();
        }
    }
    observer.step(Step::Done);
    Ok(fit)
}

/// A curve further than this many times `max_error` from its stroke is fitted again.
const STRAY: f64 = 1.4;

/// The method on cleaned points, with its options and those of the steps that all methods share.
fn solve(
    stroke: &Stroke,
    cleaned: &Cleaned,
    (options, shared): (&CurvatureSpaceOptions, &FitOptions),
    observer: &mut dyn Observer,
    stages: Option<&mut CurvatureStages>,
) -> Result<Fit, FitError> {
    observer.step(Step::Preprocess);
    let track = Ground::track(cleaned, shared);
    observer.step(Step::Candidates);
    let ground = Ground::of(track, options);
    let mut report = Report {
        points: stroke.points.len(),
        samples: ground.stretches.iter().map(|s| s.places.len()).sum(),
        ..Report::default()
    };
    let mut warnings = closing_warnings(&ground.track, options.stroke.closed);
    let mut warn = |code: &str, text: &str| warnings.push(told(code, text.into()));
    let Found { mut parts, profiles, refined, .. } = to_target(&ground, options, observer);
    report.cost = profiles.iter().map(|p| p.1).sum();
    if options.mode == Mode::Refined && !refined {
        warn("not-refined", "the pieces could not be fitted to the points; their curvature is as it was found");
    }
    if !refined && ground.is_closed() {
        warn("left-open", "the stroke is closed, but its curve is not: curvature alone does not make ends meet");
    }
    if let (true, Some(blend)) = (refined, options.blending()) {
        let (blended, all) = rounded(&parts, blend);
        if !all {
            warn("not-blended", "some knots of curvature could not be rounded off without moving the curve");
        }
        parts = blended;
    }
    if let Some(stages) = stages {
        let profiles: Vec<&Profile> = profiles.iter().map(|p| &p.0).collect();
        let laid = limbs(&profiles, &ground, options).0.0;
        *stages = CurvatureStages::of(&ground, &profiles, &laid, cleaned);
    }
    let spline = restored_spline(parts, cleaned).or_else(|| {
        warn("fell-back-to-polyline", "no fair curve was found; the stroke is given as a polyline");
        restored_spline(polyline(&ground.track), cleaned)
    });
    let spline = spline.ok_or(FitError::Unfittable { points: stroke.points.len() })?;
    describe(&mut report, &spline, stroke, options.stroke.pixel_size);
    Ok(Fit { spline, report, warnings })
}

fn told(code: &str, text: String) -> Warning {
    Warning { code: code.into(), text }
}

/// Warnings about a curve that is up to `off` from its stroke, or `astray` where loops that nobody drew are counted.
fn warnings_if_far(off: f64, astray: f64, options: &CurvatureSpaceOptions) -> Vec<Warning> {
    let mut out = Vec::new();
    let px = options.stroke.pixel_size;
    if let Some(target) = options.target_error.map(|target| target * px)
        && off > target
    {
        out.push(told("target-missed", format!("the curve is up to {off:.3} off, more than {target:.3}")));
    }
    if off > options.max_error * px || astray > STRAY * options.max_error * px {
        let text =
            format!("the curve is up to {off:.3} away from the stroke, or longer by {:.3}", 2.0 * (astray - off));
        let text = if astray > off { text } else { format!("the curve is up to {off:.3} away from the stroke") };
        out.push(told("far-from-stroke", text));
    }
    out
}

/// A curve in pixels and how it came about.
struct Found {
    parts: Parts,
    /// The pieces of curvature of each stretch, and what they cost by equation 7, radians.
    profiles: Vec<(Profile, f64)>,
    /// Whether it was fitted to the points, not only laid over them.
    refined: bool,
    /// Largest distance of the points of each stretch, px.
    errors: Vec<f64>,
    /// The fitted pieces of each stretch.
    runs: Vec<Run>,
}

impl Found {
    fn off(&self) -> f64 {
        self.errors.iter().copied().fold(0.0, f64::max)
    }
}

/// Finds a curve with a cost of pieces that is lowered where the target is missed, as long as that helps (section 6).
fn to_target(ground: &Ground, options: &CurvatureSpaceOptions, observer: &mut dyn Observer) -> Found {
    let target = options.target_error.unwrap_or(f64::INFINITY);
    let mut costs = vec![options.piece_cost; ground.stretches.len()];
    let mut best = attempt(ground, &costs, None, options, observer);
    let mut last = best.errors.clone();
    let mut stale = 0;
    for _ in 0..LOWERED {
        if best.off() <= target || stale >= PATIENCE {
            break;
        }
        for (j, cost) in costs.iter_mut().enumerate() {
            // Limbs that are laid over the stroke hang on those before; fitted ones go their own way.
            if options.mode == Mode::Faithful || last.get(j).is_none_or(|e| *e > target) {
                *cost *= LOWER;
            }
        }
        let next = attempt(ground, &costs, Some((&best, target)), options, observer);
        last.clone_from(&next.errors);
        // More pieces must be worth it: tremor does not yield to them.
        if next.off() < WORTH * best.off() {
            best = next;
            stale = 0;
        } else {
            stale += 1;
        }
    }
    best
}

/// The curve for given costs of a piece on each stretch. What was within the target `before` is not found anew.
fn attempt(
    ground: &Ground,
    costs: &[f64],
    before: Option<(&Found, f64)>,
    options: &CurvatureSpaceOptions,
    observer: &mut dyn Observer,
) -> Found {
    let kept = |j: usize| {
        before.filter(|(found, target)| {
            options.mode == Mode::Refined && found.refined && found.errors.get(j).is_some_and(|e| e <= target)
        })
    };
    observer.step(Step::Search);
    let stretches = ground.stretches.iter().zip(costs).enumerate();
    let profile = |(j, (stretch, cost)): (usize, (&Stretch, &f64))| match kept(j) {
        Some((found, _)) => found.profiles[j].clone(),
        None => linear_pieces(stretch, ground.track.shape, *cost),
    };
    let profiles: Vec<(Profile, f64)> = stretches.map(profile).collect();
    observer.step(Step::Merge);
    if options.mode == Mode::Refined {
        let run =
            |j: usize| kept(j).map_or_else(|| Run::of(&profiles[j].0, ground), |(found, _)| found.runs[j].clone());
        let runs: Vec<Run> = (0..profiles.len()).map(run).collect();
        if let Some(Refined { parts, runs, errors }) = refined(&runs, ground, options) {
            return Found { parts, profiles, refined: true, errors, runs };
        }
    }
    let (parts, errors) = limbs(&profiles.iter().map(|p| &p.0).collect::<Vec<_>>(), ground, options);
    Found { parts, profiles, refined: false, errors, runs: Vec::new() }
}

/// By how much the cost of a piece is lowered at once, and how often at most: a thousandth of it makes a piece of nearly every place.
const LOWER: f64 = 0.5;
const LOWERED: usize = 11;

/// A curve of more pieces replaces one of fewer if its largest deviation is at most this share of the other's.
const WORTH: f64 = 0.9;

/// So often in sequence may lowering the cost bring nothing.
const PATIENCE: usize = 4;

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
        let rounded = options.blending().map(|blend| blended(profile, blend));
        let limb = placed(rounded.as_ref().unwrap_or(profile), run, joint, options.end_weight);
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
    let distance =
        |d: &Datum| limb.iter().map(|s| s.nearest(d.point.to_point()).distance).fold(f64::INFINITY, f64::min);
    run.iter().map(distance).fold(0.0, f64::max)
}
