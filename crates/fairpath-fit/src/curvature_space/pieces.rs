//! The connected piecewise linear curvature of a stretch of stroke (McCrae and Singh 2008, section 4.2): places in, a profile out.

use super::compose::Profile;
use super::estimate::Place;
use super::ground::Stretch;
use super::{profile, segmentation};
use crate::track::Shape;

/// A profile, and the cost of its pieces by equation 7, radians.
pub(crate) fn linear_pieces(stretch: &Stretch, shape: Shape, piece_cost: f64) -> (Profile, f64) {
    let (mut breaks, mut cost) = segmentation::breaks(&stretch.places, piece_cost);
    let mut places = &stretch.places;
    let mut span = stretch.span;
    let turned;
    if shape == Shape::Ring {
        // The seam is no place to break at: it moves to where a break is anyway.
        let middle = places.len() / 2;
        if let Some(&seam) = breaks[1..breaks.len() - 1].iter().min_by_key(|i| i.abs_diff(middle)) {
            let begin = places[seam].s;
            turned = begun_at(places, seam, span[1] - span[0]);
            places = &turned;
            span = [begin, begin + span[1] - span[0]];
            (breaks, cost) = segmentation::breaks(places, piece_cost);
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
    let kappas = profile::connected(places, &knots);
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
fn begun_at(places: &[Place], seam: usize, length: f64) -> Vec<Place> {
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
