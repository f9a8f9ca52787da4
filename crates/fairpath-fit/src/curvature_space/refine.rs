//! The pieces found in curvature space fitted to the points themselves: profiles in, segments with exact joins out.
//!
//! Beyond McCrae and Singh 2008. Curvature that is integrated twice drifts (Baran et al. 2010, figure 10). Here number and order of the pieces are
//! kept, and their lengths, the curvatures at their ends and the start are what damped Gauss–Newton steps move, by the same recursion along the
//! chain with which the shortest-path method enforces its joins.

use super::compose::{Profile, scattered};
use super::options::CurvatureSpaceOptions;
use super::polyline_of;
use crate::conclude::Parts;
use crate::shortest_path::chain::{Chain, Piece, Shortness};
use crate::shortest_path::merge::{Effort, merge};
use crate::track::Shape;
use crate::walk::Datum;
use fairpath_curve::{Continuity, Kind};

/// Rounds that are enough for pieces which are nearly in place.
const EFFORT: Effort = Effort { rounds: 40, tolerance: 1e-3 };

/// Pieces shorter than this resist shortening, with this energy for the square of what is missing, px: else distances alone could make
/// them vanish.
const SHORT: Shortness = Shortness { length: 25.0, stiffness: 0.25 };

/// The segments that follow `data` best with as many pieces as the profiles have, G2 joins within a profile and corners between; `data`
/// are all points of the stroke, or one turn of a ring with its first point once more at the end. Nothing where no such chain was found.
pub(crate) fn refined(
    profiles: &[Profile],
    data: &[Datum],
    shape: Shape,
    options: &CurvatureSpaceOptions,
) -> Option<Parts> {
    let line = polyline_of(data);
    let mut pieces = Vec::new();
    let mut joins = Vec::new();
    let mut corners = Vec::new();
    for profile in profiles {
        if !pieces.is_empty() {
            joins.push(Continuity::G0);
            corners.push(line.s.partition_point(|&s| s < profile.knots[0] - 1e-9));
        }
        // Each on its own part of the stroke: the chain is then brought together along the stroke instead of from where it drifted.
        let apart = scattered(profile, &line);
        joins.resize(joins.len() + apart.len() - 1, Continuity::G2);
        pieces.extend(apart.into_iter().map(|s| Piece {
            kind: Kind::Clothoid,
            q: [s.start.x, s.start.y, s.heading, s.kappa0, s.kappa1, s.length],
            sign: [0, 0],
            longest: 3.0 * s.length + 30.0,
        }));
    }
    match shape {
        Shape::Open => {}
        Shape::Loop => joins.push(Continuity::G0),
        Shape::Ring => joins.push(Continuity::G2),
    }
    let data = if shape == Shape::Ring { &data[..data.len() - 1] } else { data };
    let mut chain = Chain {
        pieces,
        joins,
        data,
        corners,
        closed: shape != Shape::Open,
        end_factor: options.end_weight,
        short: Some(SHORT),
        variation: 0.0,
        pins: [None; 2],
        held: [None; 2],
    };
    merge(&mut chain, EFFORT)?;
    Some((chain.pieces.iter().map(Piece::segment).collect(), chain.joins, shape != Shape::Open))
}
