//! Where the vertices of the rim lie: an outline comes in with the wanted edge length, stations along it go out.
//!
//! Edges are short where the curve bends and where the shape is narrow, so that a few triangles fit across everywhere, and their lengths
//! change gradually, so that triangles can keep their angles.

use crate::fill::fill;
use crate::outline::Outline;
use fairpath_curve::{Point, Pose};

/// Most turning along one edge, radians: 24 edges to a full turn at least.
const MOST_TURN: f64 = 0.26;
/// The same where the curve bends inwards: there the rows of triangles along the rim can only be as fine as the edges are straight.
const MOST_TURN_INWARDS: f64 = 0.13;
/// Edge length per radius of the largest circle that fits inside at the edge: some twenty edges around, some seven across.
const PER_RADIUS: f64 = 0.3;
/// Edges that are short for narrowness alone are at least this part of the wanted length: a corner is narrow without end.
const SHORTEST: f64 = 0.03;
/// How fast edge lengths may grow along the rim. Triangles that keep angles of 25 degrees could grow faster.
const GROWTH: f64 = 0.3;
/// Fewest edges between two corners, and of a rim without corners.
const FEWEST: [f64; 2] = [3.0, 16.0];
/// Rounds of measuring how narrow the shape is, each on the rim of the round before.
const ROUNDS: usize = 2;

/// A vertex of the rim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RimPoint {
    /// Arc length from the start of the outline.
    pub(crate) station: f64,
    /// Place, direction and curvature there.
    pub(crate) pose: Pose,
}

/// The vertices of the rim in order, for edges of about `edge` and no further than `accuracy` from the curve.
pub(crate) fn sample(outline: &Outline, edge: f64, accuracy: f64) -> Vec<RimPoint> {
    let stations = first_stations(outline, edge, accuracy);
    let mut rim = at(outline, &stations);
    for _ in 0..ROUNDS {
        let mut wanted: Vec<f64> = rim.iter().map(|p| along(p.pose.curvature, edge, accuracy)).collect();
        for (wanted, radius) in wanted.iter_mut().zip(radii(&rim)) {
            *wanted = wanted.min((PER_RADIUS * radius).max(SHORTEST * edge));
        }
        limit_growth(outline, &rim, &mut wanted);
        rim = at(outline, &spaced(outline, &rim, &wanted));
    }
    rim
}

/// The vertices at given stations.
pub(crate) fn at(outline: &Outline, stations: &[f64]) -> Vec<RimPoint> {
    stations.iter().map(|&station| RimPoint { station, pose: outline.pose(station) }).collect()
}

/// Edge length that a curvature allows.
fn along(curvature: f64, edge: f64, accuracy: f64) -> f64 {
    let kappa = curvature.abs();
    let turn = if curvature < 0.0 { MOST_TURN_INWARDS } else { MOST_TURN };
    // A chord of length l is kappa l² / 8 off its arc.
    edge.min(turn / kappa).min((8.0 * accuracy / kappa).sqrt())
}

/// Stations at least as dense as the curvature asks for.
fn first_stations(outline: &Outline, edge: f64, accuracy: f64) -> Vec<f64> {
    let mut stations = Vec::new();
    for ((kappa, turn), ends) in outline.bends().zip(outline.knots.windows(2)) {
        let length = ends[1] - ends[0];
        let finest = (length / (8.0 * accuracy / kappa).sqrt()).min(4.0 * turn / MOST_TURN_INWARDS + 1.0);
        let count = libm::ceil((length / edge).max(turn / MOST_TURN_INWARDS).max(finest)).max(1.0);
        stations.extend((0..count as usize).map(|i| ends[0] + length * (i as f64 / count)));
    }
    stations
}

/// For each vertex the radius of the smallest circle around a triangle at it, when the rim's polygon is cut into triangles without any
/// vertices inside: along a smooth rim that is about the largest circle that touches the rim there and fits inside.
fn radii(rim: &[RimPoint]) -> Vec<f64> {
    let mut radii = vec![f64::INFINITY; rim.len()];
    let points: Vec<Point> = rim.iter().map(|p| p.pose.point).collect();
    // What cannot be filled now will be told when it is filled in earnest.
    for triangle in fill(&points).map(|plain| plain.triangles()).unwrap_or_default() {
        let [a, b, c] = triangle.map(|i| points[i as usize]);
        let (u, v, w) = (b - a, c - b, a - c);
        let doubled = u.cross(v).abs();
        let radius = u.hypot() * v.hypot() * w.hypot() / (2.0 * doubled);
        for i in triangle {
            let held = &mut radii[i as usize];
            *held = held.min(radius);
        }
    }
    radii
}

/// Makes no wanted length longer than its neighbours' allow, around the rim and back.
fn limit_growth(outline: &Outline, rim: &[RimPoint], wanted: &mut [f64]) {
    let count = rim.len();
    let gap = |i: usize| {
        let gap = rim[(i + 1) % count].station - rim[i].station;
        if gap < 0.0 { gap + outline.length() } else { gap }
    };
    for i in (0..2 * count).map(|i| i % count) {
        let next = (i + 1) % count;
        wanted[next] = wanted[next].min(wanted[i] + GROWTH * gap(i));
    }
    for i in (0..2 * count).rev().map(|i| i % count) {
        wanted[i] = wanted[i].min(wanted[(i + 1) % count] + GROWTH * gap(i));
    }
}

/// Stations whose distances are the wanted ones or a little less, with one at each corner.
fn spaced(outline: &Outline, rim: &[RimPoint], wanted: &[f64]) -> Vec<f64> {
    let count = rim.len();
    let station = |i: usize| if i < count { rim[i].station } else { rim[i - count].station + outline.length() };
    // The number of edges up to each old vertex, counted in fractions.
    let mut edges = vec![0.0];
    for i in 0..count {
        let density = 0.5 * (1.0 / wanted[i] + 1.0 / wanted[(i + 1) % count]);
        edges.push(edges[i] + density * (station(i + 1) - station(i)));
    }
    let is_corner = |i: usize| outline.corners.iter().any(|&corner| corner == rim[i].station);
    let mut cuts: Vec<usize> = (0..count).filter(|&i| is_corner(i)).collect();
    let fewest = FEWEST[usize::from(cuts.is_empty())];
    if cuts.first() != Some(&0) {
        // The outline begins at its first station even where there is no corner.
        cuts.insert(0, 0);
    }
    cuts.push(count);
    let mut stations = Vec::new();
    for cut in cuts.windows(2) {
        let (from, to) = (edges[cut[0]], edges[cut[1]]);
        let pieces = libm::ceil(to - from).max(fewest);
        let mut i = cut[0];
        for piece in 0..pieces as usize {
            let target = from + (to - from) * (piece as f64 / pieces);
            while i + 1 < cut[1] && edges[i + 1] <= target {
                i += 1;
            }
            let part = ((target - edges[i]) / (edges[i + 1] - edges[i])).clamp(0.0, 1.0);
            // The first of each cut is the corner itself, to the bit.
            stations.push(if piece == 0 { station(cut[0]) } else { station(i) + part * (station(i + 1) - station(i)) });
        }
    }
    stations
}
