//! Sketching clothoid splines using shortest paths (Baran, Lehtinen and Popović 2010): stroke in, spline out.

mod a_star;
mod candidates;
pub(crate) mod chain;
pub(crate) mod circle;
mod closing;
pub(crate) mod controls;
mod cycle;
mod distances;
mod graph;
pub(crate) mod hold;
pub(crate) mod merge;
mod recursion;
pub(crate) mod refine;
mod search;
mod transition;

use crate::clean::{Cleaned, clean};
use crate::conclude::{Parts, closing_warnings, describe, polyline, restored, restored_spline};
use crate::direction::{is_backward, turn_stages_round, turned_round};
use crate::options::{ClosedSearch, FitOptions};
use crate::parallel;
use crate::result::{self, Fit, FitError, Observer, Report, Stages, Step, Warning};
use crate::stroke::Stroke;
use crate::track::{Course, Shape, Track, prepare};
use chain::{Chain, Measured};
use circle::Circle;
use fairpath_curve::{Continuity, Point};
use graph::{Graph, Node, Path};
use merge::{Effort, merge};
use search::Verifier;

/// Effort of the final merge.
const FINAL: Effort = Effort { rounds: 14, tolerance: 1e-3 };

/// A curve in pixels along a prepared track, and its cost; nothing where the options allow none.
pub(crate) fn fit_track(track: &Track, cleaned: &Cleaned, options: &FitOptions) -> Option<(Parts, Report)> {
    let mut report = Report { samples: track.turn + usize::from(track.shape == Shape::Open), ..Report::default() };
    let length = track.all.station(track.turn);
    let options = &FitOptions { free_error: options.free_error.min(options.free_share * length), ..options.clone() };
    attempt(track, cleaned, options, &mut (), &mut report, None).map(|parts| (parts, report))
}

/// Fits a stroke.
pub(crate) fn fit(
    stroke: &Stroke,
    options: &FitOptions,
    observer: &mut dyn Observer,
    mut stages: Option<&mut Stages>,
) -> Result<Fit, FitError> {
    options.validate()?;
    observer.step(Step::Preprocess);
    let mut cleaned = clean(&stroke.points, options.pixel_size)?;
    let backward = is_backward(&stroke.points);
    if backward {
        let reversed: Vec<Point> = stroke.points.iter().rev().copied().collect();
        cleaned = clean(&reversed, options.pixel_size)?;
    }
    let mut fit = solve(stroke, &cleaned, options, observer, stages.as_deref_mut())?;
    // How far the curve is from what was drawn: a loop that nobody drew shows in its length.
    let drawn: f64 = stroke.points.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
    let far = STRAY * options.max_error * options.pixel_size;
    let astray = |f: &Fit| f.report.max_deviation.max(0.5 * (f.spline.length() - LONGER * drawn));
    if astray(&fit) > far {
        // Somewhere the costs accepted what nobody would: the stroke is fitted once more, more closely.
        let mut own = Stages::default();
        let close = solve(stroke, &cleaned, &closer(options), observer, stages.is_some().then_some(&mut own))?;
        if astray(&close) < astray(&fit) {
            fit = close;
            if let Some(stages) = stages.as_deref_mut() {
                *stages = own;
            }
        }
    }
    if astray(&fit) > far {
        fit.warnings.push(Warning {
            code: "far-from-stroke".into(),
            text: format!(
                "the curve is up to {:.3} away from the stroke, which is {drawn:.3} long; the curve is {:.3}",
                fit.report.max_deviation,
                fit.spline.length()
            ),
        });
    }
    if backward {
        fit = turned_round(fit);
        if let Some(stages) = stages {
            turn_stages_round(stages);
        }
    }
    observer.step(Step::Done);
    Ok(fit)
}

/// A curve may be longer than its stroke by this factor: many corners drawn out to their tips add up.
pub(crate) const LONGER: f64 = 1.01;

/// A curve further than this many times `max_error` from its stroke is fitted again.
pub(crate) const STRAY: f64 = 1.4;

/// Options that stay closer to the stroke.
pub(crate) fn closer(options: &FitOptions) -> FitOptions {
    FitOptions {
        error_cost: 4.0 * options.error_cost,
        inflection_cost: 0.25 * options.inflection_cost,
        shortness_cost: 0.25 * options.shortness_cost,
        corner_score: 0.5 * options.corner_score,
        max_error: 0.7 * options.max_error,
        ..options.clone()
    }
}

/// One pass of the whole method.
fn solve(
    stroke: &Stroke,
    cleaned: &Cleaned,
    options: &FitOptions,
    observer: &mut dyn Observer,
    mut stages: Option<&mut Stages>,
) -> Result<Fit, FitError> {
    observer.step(Step::Preprocess);
    let track = prepare(cleaned, options);
    let mut warnings = closing_warnings(&track, options.closed);
    let length = track.all.station(track.turn);
    let options = &FitOptions { free_error: options.free_error.min(options.free_share * length), ..options.clone() };
    let mut report = Report {
        points: stroke.points.len(),
        samples: track.turn + usize::from(track.shape == Shape::Open),
        ..Report::default()
    };
    let restore = |parts| restored_spline(parts, cleaned);
    let strict = attempt(&track, cleaned, options, observer, &mut report, stages.as_deref_mut()).and_then(restore);
    let spline = strict.or_else(|| {
        warnings.push(Warning {
            code: "loosened".into(),
            text: "no curve keeps to the options everywhere; joins and deviations were allowed that they forbid".into(),
        });
        attempt(&track, cleaned, &loosened(options), observer, &mut report, stages).and_then(restore)
    });
    let spline = spline.or_else(|| {
        warnings.push(Warning {
            code: "fell-back-to-polyline".into(),
            text: "no fair curve was found; the stroke is given as a polyline".into(),
        });
        restore(polyline(&track))
    });
    let spline = spline.ok_or(FitError::Unfittable { points: stroke.points.len() })?;
    describe(&mut report, &spline, stroke, options.pixel_size);
    Ok(Fit { spline, report, warnings })
}

/// Sections 3.3 to 3.6 with the given options; nothing if they allow no curve.
fn attempt(
    track: &Track,
    cleaned: &Cleaned,
    options: &FitOptions,
    observer: &mut dyn Observer,
    report: &mut Report,
    stages: Option<&mut Stages>,
) -> Option<Parts> {
    observer.step(Step::Candidates);
    let candidates = parallel::within(|| candidates::candidates(track, options));
    observer.step(Step::Graph);
    let mut graph = Graph::new(&candidates, track, options);
    let exact_ring = track.shape == Shape::Ring && options.closed_search == ClosedSearch::Exact;
    // A circle is a cycle too, of one piece.
    let circle = if exact_ring { circle::circle(track, options) } else { None };
    let mut verifier = Verifier::new(track, options);
    let below = circle.map_or(f64::INFINITY, |c| REFINED * c.cost);
    let mut best: Option<(Path, Option<Merged>)> = None;
    let cost_of = |merged: &Option<Merged>| merged.as_ref().map_or(f64::INFINITY, |m| m.cost);
    let is_held = track.held.iter().any(Option::is_some);
    let limit = if is_held { HELD_SURPRISE } else { SURPRISE };
    for _ in 0..if exact_ring || is_held { SURPRISED_ROUNDS } else { 1 } {
        observer.step(Step::Search);
        let Some(path) = parallel::within(|| search::search(&mut graph, &mut verifier, below)) else { break };
        observer.step(Step::Merge);
        let merged = parallel::within(|| merge_path(&graph, &path, track, options));
        let cost = cost_of(&merged);
        // Joins are verified two pieces at a time. What that misses in a ring of few pieces, or in a few between held ends, shows in the
        // whole: then its joins bear what it costs more, and another path may be better.
        let surprise = cost > limit * path.cost;
        if surprise {
            graph.burden(&path, cost - path.cost);
        }
        let least = best.as_ref().map_or(f64::INFINITY, |b| cost_of(&b.1));
        // Between held ends, where a second path brings nothing, a third mostly brings nothing either.
        let is_in_vain = is_held && least.is_finite() && !(cost < WORTH_A_ROUND * least);
        if best.is_none() || cost < least {
            best = Some((path, merged));
        }
        if !surprise || is_in_vain {
            break;
        }
    }
    let (mut path, merged) = best.map_or((None, None), |(path, merged)| (Some(path), merged));
    if circle.is_some_and(|c| merged.as_ref().is_none_or(|m| c.cost < m.cost)) {
        path = None;
    }
    report.nodes = graph.nodes.len();
    report.edges = graph.computed;
    report.validations = verifier.verifications;
    if let Some(stages) = stages {
        *stages = self::stages(&graph, path.as_ref(), circle.as_ref(), track, cleaned);
    }
    if let Some(path) = path {
        report.cost = path.cost;
        return merged.map(|m| m.parts);
    }
    let circle = circle?;
    report.cost = circle.cost;
    Some((vec![circle.arc], vec![Continuity::G3], true))
}

/// A cycle may cost this many times what a circle does: refinement can bring it below.
const REFINED: f64 = 2.0;

/// Most paths that are merged where ends meet or are held.
const SURPRISED_ROUNDS: usize = 3;

/// One more path is worth another round if it costs less than this share of the best one before.
const WORTH_A_ROUND: f64 = 0.99;

/// A merged path that costs more than this many times what its path did was misjudged.
const SURPRISE: f64 = 1.5;

/// The same where ends are held, which makes most paths dearer than two pieces at a time tell: another path is seldom better.
const HELD_SURPRISE: f64 = 3.0;

/// Options under which every stroke has a curve that is not far off: what was forbidden is dear instead.
pub(crate) fn loosened(options: &FitOptions) -> FitOptions {
    FitOptions {
        max_error: 2.0 * options.max_error,
        max_join_error: 2.0 * options.max_join_error,
        error_cost: 0.25 * options.error_cost,
        g1_cost: options.g1_cost.or(Some(40.0)),
        g0_cost: options.g0_cost.or(Some(80.0)),
        ..options.clone()
    }
}

/// A path with all its joins enforced.
struct Merged {
    parts: Parts,
    /// As section 3.4 counts it, measured on the whole.
    cost: f64,
}

fn merge_path(graph: &Graph, path: &Path, track: &Track, options: &FitOptions) -> Option<Merged> {
    let nodes: Vec<Node> = path.nodes.iter().map(|&i| graph.nodes[i as usize]).collect();
    let mut joins = path.joins.clone();
    let closed = track.shape != Shape::Open;
    if track.shape == Shape::Loop {
        joins.push(Continuity::G0);
    }
    let whole = Some((track.shape, track.turn));
    let held = track.held.map(|hold| hold.map(|h| h.pin));
    let along = |course, joins| -> Chain {
        let mut chain = search::chain(graph.candidates, &nodes, joins, whole, course, held, options);
        hold::give_freedom(&mut chain);
        chain
    };
    let mut chain = along(&track.all, joins.clone());
    if options.refine {
        // Chosen by the coarse points, fitted to all.
        let mut coarse = along(&track.coarse, joins);
        let measured = hold::merge_softly(&mut coarse, FINAL, SURPRISE * path.cost, options)?;
        let measured = refine::refine(&mut coarse, measured, options, FINAL)?;
        let before = refine::total(&coarse, &measured, options);
        let smooth = track.shape == Shape::Ring && !coarse.joins.contains(&Continuity::G0);
        // What lies at the seam is looked at once more from the other side.
        if smooth && let Some((other, begin)) = half_round(&coarse, &measured, &track.coarse, nodes[0].first as usize) {
            let mut other = other;
            if let Some(measured) = merge(&mut other, FINAL)
                && let Some(again) = refine::refine(&mut other, measured, options, FINAL)
                && refine::total(&other, &again, options) < before - SEAM_GAIN
            {
                let from = track.all.data.partition_point(|d| d.s < begin);
                chain.data = &track.all.data[from..from + chain.data.len()];
                coarse = other;
            }
        }
        (chain.pieces, chain.joins) = (coarse.pieces, coarse.joins);
    }
    let measured = merge(&mut chain, FINAL)?;
    let cost = refine::total(&chain, &measured, options);
    Some(Merged { parts: (chain.pieces.iter().map(chain::Piece::segment).collect(), chain.joins, closed), cost })
}

/// What a second look must gain, in units of cost: less would be left to rounding.
const SEAM_GAIN: f64 = 3.0;

/// A ring's chain, which begins at sample `first`, begun half its pieces later, and the arc length along the track where that is, px.
fn half_round<'a>(
    chain: &Chain<'a>,
    measured: &Measured,
    course: &'a Course,
    first: usize,
) -> Option<(Chain<'a>, f64)> {
    let half = chain.pieces.len() / 2;
    let (begin, end) = measured.normals[half].span;
    if begin >= end {
        return None;
    }
    let from = course.samples[first] + begin;
    let mut chain = Chain { data: &course.data[from..from + chain.data.len()], ..chain.clone() };
    chain.pieces.rotate_left(half);
    chain.joins.rotate_left(half);
    Some((chain, course.data[from].s))
}

fn stages(graph: &Graph, path: Option<&Path>, circle: Option<&Circle>, track: &Track, cleaned: &Cleaned) -> Stages {
    let n = track.turn + usize::from(track.shape == Shape::Open);
    let whole = circle.map(|c| result::Candidate {
        segment: restored(&c.arc, cleaned),
        first: 0,
        last: track.turn,
        error: c.largest * cleaned.scale,
    });
    Stages {
        points: cleaned.points.iter().map(|p| cleaned.restore(*p)).collect(),
        closed: track.shape != Shape::Open,
        samples: (0..n).map(|i| cleaned.restore(track.all.sample(i))).collect(),
        // The seam of a loop is a corner, although the fit begins there as at an end.
        corners: (0..n).filter(|&i| track.corner[i] || (i == 0 && track.shape == Shape::Loop)).collect(),
        candidates: graph
            .candidates
            .iter()
            .map(|c| result::Candidate {
                segment: restored(&c.primitive.segment(c.length), cleaned),
                first: c.first as usize,
                last: c.last as usize,
                error: c.largest * cleaned.scale,
            })
            .chain(whole)
            .collect(),
        path: match path {
            Some(path) => path.nodes.iter().map(|&i| graph.nodes[i as usize].candidate as usize).collect(),
            None => whole.map(|_| graph.candidates.len()).into_iter().collect(),
        },
    }
}
