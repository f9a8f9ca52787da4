//! The pieces found in curvature space fitted to the points themselves: profiles in, segments with exact joins out.
//!
//! Beyond McCrae and Singh 2008. Curvature that is integrated twice drifts (Baran et al. 2010, figure 10). Here the lengths of the pieces, the
//! curvatures at their ends and the start are moved by damped Gauss–Newton steps, by the same recursion along the chain with which the
//! shortest-path method enforces its joins. Then the pieces themselves are looked at: what need not be a clothoid becomes an arc or a line,
//! two become one where one would do, and one becomes two where it strays, as far as the costs welcome it.

use super::compose::{Profile, scattered};
use super::ground::{Ground, polyline_of, run};
use super::inflections::straighten;
use super::options::CurvatureSpaceOptions;
use crate::conclude::Parts;
use crate::polyline::Polyline;
use crate::primitive_fit;
use crate::shortest_path::chain::{Chain, LENGTH, Measured, Piece, Shortness};
use crate::shortest_path::circle::circle;
use crate::shortest_path::controls::MAX_CURVATURE;
use crate::shortest_path::merge::{Effort, merge};
use crate::shortest_path::refine::{refine, total};
use crate::track::{Course, Shape};
use crate::walk::{Datum, Primitive};
use fairpath_curve::{Continuity, Kind, Segment};

/// Effort of bringing the pieces together.
const JOIN: Effort = Effort { rounds: 20, tolerance: 1e-2 };

/// Effort of merges on the way, which only prepare for the last.
const ON_THE_WAY: Effort = Effort { rounds: 8, tolerance: 5e-3 };

/// Effort of the last merge: it starts from pieces that are nearly in place.
const FINAL: Effort = Effort { rounds: 14, tolerance: 1e-3 };

/// Pieces of one stretch: as they were found, or as they were left by the last fit.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) pieces: Vec<Piece>,
    /// Between neighbours.
    pub(crate) joins: Vec<Continuity>,
    /// Arc length along the stroke at which it begins, px.
    pub(crate) from: f64,
}

impl Run {
    /// The pieces of a profile, each on its own part of the stroke: the chain is then brought together along the stroke instead of from where
    /// it drifted.
    pub(crate) fn of(profile: &Profile, ground: &Ground) -> Self {
        let begin = if ground.is_ring() { profile.knots[0] } else { 0.0 };
        let data = run(&ground.track, &ground.track.coarse, begin);
        let line = polyline_of(data);
        let pieces: Vec<Piece> = scattered(profile, &line)
            .into_iter()
            .zip(profile.knots.windows(2))
            .map(|(segment, span)| piece(&settled(&segment, part(data, &line, span))))
            .collect();
        Self { joins: vec![Continuity::G2; pieces.len() - 1], pieces, from: profile.knots[0] }
    }
}

/// The data between two arc lengths.
fn part<'a>(data: &'a [Datum], line: &Polyline, span: &[f64]) -> &'a [Datum] {
    let low = line.s.partition_point(|&s| s < span[0] - 1e-9);
    let high = line.s.partition_point(|&s| s <= span[1] + 1e-9);
    &data[low..high]
}

/// A segment after a few steps towards its data, if there are enough of them to hold it.
fn settled(segment: &Segment, data: &[Datum]) -> Segment {
    if data.len() < HOLDING {
        return *segment;
    }
    let &Segment { start, heading, length, kappa0, kappa1 } = segment;
    let guess = Primitive { start: start.to_vec2(), heading, kappa: kappa0, sharpness: (kappa1 - kappa0) / length };
    let fit = primitive_fit::refine(&guess, data, 4, SETTLING, 1.0);
    let found = fit.primitive.segment(fit.length);
    let close = (fit.length - length).abs() < 0.2 * length;
    let calm = found.kappa0.abs().max(found.kappa1.abs()) < 2.0 * kappa0.abs().max(kappa1.abs()) + 1e-3;
    if found.is_valid() && close && calm { found } else { *segment }
}

/// Fewest data that hold a clothoid against tremor, and steps towards them.
const HOLDING: usize = 7;
const SETTLING: usize = 2;

fn piece(s: &Segment) -> Piece {
    Piece {
        kind: Kind::Clothoid,
        q: [s.start.x, s.start.y, s.heading, s.kappa0, s.kappa1, s.length],
        sign: [0, 0],
        longest: 3.0 * s.length + 30.0,
    }
}

/// A refined curve.
pub(crate) struct Refined {
    pub(crate) parts: Parts,
    /// The pieces of each stretch, for another fit in which some of them are found anew.
    pub(crate) runs: Vec<Run>,
    /// Largest distance of the points of each stretch, or half the length of a loop that nobody drew, px.
    pub(crate) errors: Vec<f64>,
}

/// The curve of runs of pieces, one for each stretch, that follows the points best, with G2 joins within a run and corners between. Nothing
/// where no such chain was found.
pub(crate) fn refined(runs: &[Run], ground: &Ground, options: &CurvatureSpaceOptions) -> Option<Refined> {
    let ring = ground.is_ring();
    let costs = options.costs(ground.length());
    // Chosen by the coarse points, fitted to all.
    let mut coarse = chain(runs, ground, &ground.track.coarse, options);
    let mut begin = runs[0].from;
    if options.simplify {
        let mut measured = merge(&mut coarse, JOIN)?;
        measured = refine(&mut coarse, measured, &costs, ON_THE_WAY)?;
        if ring {
            // What lies at the seam is looked at from the other side.
            if let Some((other, from)) = half_round(&coarse, &measured, ground, begin) {
                (coarse, begin) = (other, from);
                measured = merge(&mut coarse, ON_THE_WAY)?;
                measured = refine(&mut coarse, measured, &costs, ON_THE_WAY)?;
            }
        }
        straighten(&mut coarse, measured, &costs, ON_THE_WAY)?;
    }
    let all = run(&ground.track, &ground.track.all, begin);
    let line = polyline_of(all);
    let at = |i: &usize| line.s.partition_point(|&s| s < coarse.data[*i].s - 1e-9);
    let corners = coarse.corners.iter().map(at).collect();
    let data = &all[..all.len() - usize::from(ring)];
    let mut chain = Chain { data, corners, ..coarse };
    let measured = merge(&mut chain, FINAL)?;
    if ring
        && let Some(found) = circle(&ground.track, &costs)
        && found.cost <= total(&chain, &measured, &costs)
    {
        let runs = vec![Run { pieces: chain.pieces, joins: chain.joins, from: begin }];
        return Some(Refined {
            parts: (vec![found.arc], vec![Continuity::G3], true),
            runs,
            errors: vec![found.largest],
        });
    }
    let mut refined = concluded(chain, &measured, begin);
    // A loop that nobody drew shows in its length.
    for ((run, stretch), error) in refined.runs.iter().zip(&ground.stretches).zip(&mut refined.errors) {
        let length: f64 = run.pieces.iter().map(|p| p.q[LENGTH]).sum();
        *error = error.max(0.5 * (length - LONGER * (stretch.span[1] - stretch.span[0])));
    }
    Some(refined)
}

/// A curve may be longer than its stroke by this factor: tips of corners that are drawn out add up.
pub(super) const LONGER: f64 = 1.01;

/// The runs as one chain along a course of the stroke's points.
fn chain<'a>(runs: &[Run], ground: &Ground, course: &'a Course, options: &CurvatureSpaceOptions) -> Chain<'a> {
    let data = run(&ground.track, course, runs[0].from);
    let mut pieces = Vec::new();
    let mut joins = Vec::new();
    let mut corners = Vec::new();
    for run in runs {
        if !pieces.is_empty() {
            joins.push(Continuity::G0);
            corners.push(data.partition_point(|d| d.s < run.from - 1e-9));
        }
        joins.extend_from_slice(&run.joins);
        pieces.extend_from_slice(&run.pieces);
    }
    let shape = ground.track.shape;
    match shape {
        Shape::Open => {}
        Shape::Loop => joins.push(Continuity::G0),
        Shape::Ring => joins.push(Continuity::G2),
    }
    Chain {
        pieces,
        joins,
        // The last datum of a ring is its first.
        data: &data[..data.len() - usize::from(ground.is_ring())],
        corners,
        closed: shape != Shape::Open,
        end_factor: options.end_weight,
        short: Some(SHORT),
        max_curvature: MAX_CURVATURE,
        variation: 0.0,
        pins: [None; 2],
        held: [None; 2],
    }
}

/// Short pieces resist shortening, with this energy for the square of what is missing, px: else distances alone could make them vanish.
const SHORT: Shortness = Shortness { length: 40.0, stiffness: 0.25 };

/// A ring's chain, which begins at arc length `from` of its track, begun half its pieces later, and where that is.
fn half_round<'a>(chain: &Chain<'a>, measured: &Measured, ground: &'a Ground, from: f64) -> Option<(Chain<'a>, f64)> {
    let half = chain.pieces.len() / 2;
    let (begin, end) = measured.normals[half].span;
    if begin >= end {
        return None;
    }
    let there = chain.data[begin].s + if chain.data[begin].s < from - 1e-9 { ground.length() } else { 0.0 };
    let data = run(&ground.track, &ground.track.coarse, there);
    let mut chain = Chain { data: &data[..chain.data.len()], ..chain.clone() };
    chain.pieces.rotate_left(half);
    chain.joins.rotate_left(half);
    Some((chain, data[0].s))
}

fn concluded(chain: Chain, measured: &Measured, begin: f64) -> Refined {
    let closed = chain.closed;
    let segments = chain.pieces.iter().map(Piece::segment).collect();
    let mut runs: Vec<Run> = Vec::new();
    let mut errors: Vec<f64> = Vec::new();
    let mut corners = chain.corners.iter();
    for (k, piece) in chain.pieces.iter().enumerate() {
        let error = measured.normals[k].error;
        match (runs.last_mut(), errors.last_mut()) {
            (Some(run), Some(largest)) if chain.joins[k - 1] != Continuity::G0 => {
                run.pieces.push(*piece);
                run.joins.push(chain.joins[k - 1]);
                *largest = largest.max(error);
            }
            _ => {
                let from = if k == 0 { begin } else { corners.next().map_or(begin, |&i| chain.data[i].s) };
                runs.push(Run { pieces: vec![*piece], joins: Vec::new(), from });
                errors.push(error);
            }
        }
    }
    Refined { parts: (segments, chain.joins, closed), runs, errors }
}
