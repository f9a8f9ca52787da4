//! The curve with minimum variation of curvature near a stroke: a stroke in, a spline of many short clothoids out.
//!
//! Moreton's functional `∫ κ′² ds` plus squared distance is minimised among curves whose curvature is linear on pieces of a few pixels. That is the
//! optimal control problem that merging solves, with more pieces and one more cost, so it takes time linear in the length.

use super::laplacian::blur;
use super::options::MvcOptions;
use super::{evenly, one_turn, stretches};
use crate::conclude::Parts;
use crate::shortest_path::chain::{Chain, Piece, Shortness};
use crate::shortest_path::controls::MAX_CURVATURE;
use crate::shortest_path::merge::{Effort, merge};
use crate::track::{Shape, Track};
use fairpath_curve::{Continuity, Kind, Vec2, trig};

/// The fairest curve and the number of its pieces; nothing where the minimum was not found.
pub(crate) fn fairest(track: &Track, options: &MvcOptions) -> Option<(Parts, usize)> {
    let ring = track.shape == Shape::Ring;
    let mut pieces: Vec<Piece> = Vec::new();
    let mut joins = Vec::new();
    let mut corners = Vec::new();
    let mut datum = 0;
    for data in stretches(track) {
        if !pieces.is_empty() {
            joins.push(Continuity::G0);
            corners.push(datum);
        }
        datum += data.len() - 1;
        let mut points = evenly(data, options.spacing, FEWEST);
        blur(&mut points, ring, 0.5, FIRST_GUESS);
        joins.resize(joins.len() + points.len() - 2, Continuity::G2);
        pieces.extend(guessed(&points, ring));
    }
    match track.shape {
        Shape::Open => {}
        Shape::Loop => joins.push(Continuity::G0),
        Shape::Ring => joins.push(Continuity::G2),
    }
    let data = one_turn(track);
    let data = if ring { &data[..data.len() - 1] } else { data };
    let mut chain = Chain {
        pieces,
        joins,
        data,
        corners,
        closed: track.shape != Shape::Open,
        end_factor: END_WEIGHT,
        // Pieces of equal length are what makes the sum over them an integral.
        short: Some(Shortness { length: options.spacing, stiffness: STIFFNESS }),
        max_curvature: MAX_CURVATURE,
        variation: libm::pow(options.smoothing_length, 6.0),
        pins: [None; 2],
        held: [None; 2],
    };
    merge(&mut chain, EFFORT)?;
    let count = chain.pieces.len();
    Some(((chain.pieces.iter().map(Piece::segment).collect(), chain.joins, track.shape != Shape::Open), count))
}

/// A stretch has at least so many pieces: with fewer the functional has nothing to vary.
const FEWEST: f64 = 4.0;

/// Rounds of smoothing before the first guess at headings and curvatures.
const FIRST_GUESS: u32 = 6;

/// Weight of ends and corners relative to other points, as in the other methods.
const END_WEIGHT: f64 = 2.0;

/// Energy for the square of what a piece lacks of its length, px.
const STIFFNESS: f64 = 0.25;

/// The functional is flat: it is followed closely.
const EFFORT: Effort = Effort { rounds: 80, tolerance: 1e-4 };

/// A piece between each two points, with the heading and the curvature of the polyline.
fn guessed(points: &[Vec2], ring: bool) -> Vec<Piece> {
    let last = points.len() - 1;
    let edge = |i: usize| points[i + 1] - points[i];
    let bend = |i: usize| {
        let (a, b) = match (i, ring) {
            (0, false) => (edge(0), edge(1)),
            (i, false) if i == last => (edge(last - 2), edge(last - 1)),
            (i, _) if i == 0 || i == last => (edge(last - 1), edge(0)),
            (i, _) => (edge(i - 1), edge(i)),
        };
        trig::wrap_angle(trig::angle_of(b) - trig::angle_of(a)) / (0.5 * (a.hypot2().sqrt() + b.hypot2().sqrt()))
    };
    (0..last)
        .map(|i| {
            let length = edge(i).hypot2().sqrt();
            let (kappa0, kappa1) = (bend(i), bend(i + 1));
            // The chord of an arc is turned by half of its turning.
            let heading = trig::angle_of(edge(i)) - 0.25 * (kappa0 + kappa1) * length;
            Piece {
                kind: Kind::Clothoid,
                q: [points[i].x, points[i].y, heading, kappa0, kappa1, length],
                sign: [0, 0],
                longest: 3.0 * length + 30.0,
            }
        })
        .collect()
}
