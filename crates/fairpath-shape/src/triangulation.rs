//! Triangles inside an outline: the rim comes in, a Delaunay triangulation of its inside with angles of at least 25 degrees
//! away from sharp corners goes out.
//!
//! Delaunay refinement after Ruppert (1995) by the crate spade; vertices that it puts on the rim's chords are then moved onto the curve,
//! which costs up to seven of the 25 degrees where edges turn by a quarter of a radian, and hardly anything where they are fine.

use crate::fill::{Cdt, Filled, Obstacle, fill, from_spade, inside};
use crate::outline::Outline;
use crate::rim::{self, RimPoint};
use fairpath_curve::Point;
use spade::handles::{DirectedEdgeHandle, FixedVertexHandle, VertexHandle};
use spade::{AngleLimit, CdtEdge, Point2, RefinementParameters, Triangulation as _};

/// Circumradius per shortest edge of the worst triangle: 1 / (2 sin 25°), for a least angle of 25 degrees except at corners that are
/// sharper themselves. Ruppert's method is proven to end up to 20.7 degrees, and ends in practice up to about 33.
const RADIUS_PER_EDGE: f64 = 1.183_100_791_576_250_6;
/// Rounds of splitting edges that cross the inside from rim to rim; each halves what is left of them.
const MOST_ROUNDS: usize = 30;
/// How often the rim is made anew with the vertices that refinement put on it.
const MOST_RETRIES: usize = 4;

/// Marks the outside as a neighbour.
pub(crate) const OUTSIDE: u32 = u32::MAX;

/// Triangles in the plane that fill an outline.
#[derive(Debug)]
pub(crate) struct Domain {
    /// The rim's vertices in their order, then those inside from the rim inwards.
    pub(crate) points: Vec<Point>,
    /// The rim's vertices with their stations.
    pub(crate) rim: Vec<RimPoint>,
    /// Counterclockwise.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The triangle across from each corner of each triangle, or [`OUTSIDE`].
    pub(crate) neighbours: Vec<[u32; 3]>,
}

/// Fills the outline with triangles of at most `largest_area`, beginning with this rim, and with at most `most` vertices.
pub(crate) fn triangulate(
    outline: &Outline,
    mut rim: Vec<RimPoint>,
    largest_area: f64,
    most: usize,
) -> Result<Domain, Obstacle> {
    for _ in 0..MOST_RETRIES {
        let points: Vec<Point> = rim.iter().map(|p| p.pose.point).collect();
        let mut filled = fill(&points)?;
        refine(&mut filled.cdt, largest_area, most)?;
        part_bridges(&mut filled.cdt)?;
        filled = Filled::new(filled.cdt);
        let ring = walk(&filled, &rim, outline);
        let (domain, turned) = export(&filled, &ring, outline);
        if !turned {
            return Ok(domain);
        }
        rim = domain.rim;
    }
    Err(Obstacle::Crossing(rim[0].pose.point))
}

fn refine(cdt: &mut Cdt, largest_area: f64, most: usize) -> Result<(), Obstacle> {
    if cdt.num_vertices() >= most {
        return Err(Obstacle::TooMany);
    }
    let parameters = RefinementParameters::new()
        .exclude_outer_faces(true)
        .with_angle_limit(AngleLimit::from_radius_to_shortest_edge_ratio(RADIUS_PER_EDGE))
        .with_max_allowed_area(largest_area)
        .with_max_additional_vertices(most - cdt.num_vertices());
    if cdt.refine(parameters).refinement_complete { Ok(()) } else { Err(Obstacle::TooMany) }
}

/// Parts every edge inside whose ends both lie on the rim: the surface's front and back would meet in it.
fn part_bridges(cdt: &mut Cdt) -> Result<(), Obstacle> {
    let mut at = None;
    for _ in 0..MOST_ROUNDS {
        let mut on_rim = vec![false; cdt.num_vertices()];
        for edge in cdt.undirected_edges().filter(|edge| edge.is_constraint_edge()) {
            for vertex in edge.vertices() {
                on_rim[vertex.fix().index()] = true;
            }
        }
        let inside = inside(cdt);
        let middles: Vec<Point2<f64>> = cdt
            .undirected_edges()
            .filter(|edge| !edge.is_constraint_edge() && edge.vertices().iter().all(|v| on_rim[v.fix().index()]))
            .filter(|edge| inside[edge.as_directed().face().fix().index()])
            .map(|edge| {
                let [a, b] = edge.positions();
                Point2::new(0.5 * (a.x + b.x), 0.5 * (a.y + b.y))
            })
            .collect();
        if middles.is_empty() {
            return Ok(());
        }
        at = middles.first().copied();
        for middle in middles {
            cdt.insert(middle).map_err(|_| Obstacle::Crossing(from_spade(middle)))?;
        }
    }
    Err(Obstacle::Crossing(at.map_or(Point::ORIGIN, from_spade)))
}

/// The vertices along the rim, counterclockwise from the first, those that refinement added among them: number and station.
fn walk(filled: &Filled, rim: &[RimPoint], outline: &Outline) -> Vec<(FixedVertexHandle, f64)> {
    let cdt = &filled.cdt;
    let mut ring = Vec::with_capacity(rim.len());
    let mut at = FixedVertexHandle::from_index(0);
    let mut last = 0;
    loop {
        let station = if at.index() < rim.len() {
            last = at.index();
            rim[last].station
        } else {
            // On the chord from the last vertex of the old rim to the next.
            let (from, to) = (rim[last], rim[(last + 1) % rim.len()]);
            let chord = to.pose.point - from.pose.point;
            let along = (from_spade(cdt.vertex(at).position()) - from.pose.point).dot(chord) / chord.hypot2();
            let gap = if to.station > from.station { to.station } else { to.station + outline.length() } - from.station;
            from.station + along.clamp(0.0, 1.0) * gap
        };
        ring.push((at, station));
        // Exactly one edge leaves each vertex along the rim with the inside on its left.
        let next = cdt
            .vertex(at)
            .out_edges()
            .find(|edge| edge.is_constraint_edge() && filled.inside[edge.face().fix().index()])
            .map(|edge| edge.to().fix());
        match next {
            Some(next) if next.index() != 0 && ring.len() <= cdt.num_vertices() => at = next,
            _ => return ring,
        }
    }
}

/// The triangles with the rim on the curve and everything in its order, and whether that turned any triangle over.
fn export(filled: &Filled, ring: &[(FixedVertexHandle, f64)], outline: &Outline) -> (Domain, bool) {
    let cdt = &filled.cdt;
    let stations: Vec<f64> = ring.iter().map(|&(_, station)| station).collect();
    let order = numbered(filled, ring);
    let mut points = vec![Point::ORIGIN; order.iter().filter(|&&number| number != OUTSIDE).count()];
    for vertex in cdt.vertices() {
        let number = order[vertex.fix().index()];
        if number != OUTSIDE {
            points[number as usize] = from_spade(vertex.position());
        }
    }
    let rim = rim::at(outline, &stations);
    for (point, on_rim) in points.iter_mut().zip(&rim) {
        *point = on_rim.pose.point;
    }
    let (triangles, neighbours) = connected(filled, &order);
    let turned = triangles.iter().any(|&t| signed_area(&points, t) <= 0.0);
    (Domain { points, rim, triangles, neighbours }, turned)
}

/// The new number of each vertex: the rim first, then breadth first from it, which keeps neighbours near each other in memory and
/// the factors of the equations short. [`OUTSIDE`] for vertices that no triangle inside has.
fn numbered(filled: &Filled, ring: &[(FixedVertexHandle, f64)]) -> Vec<u32> {
    let cdt = &filled.cdt;
    let mut order = vec![OUTSIDE; cdt.num_vertices()];
    let mut queue: Vec<FixedVertexHandle> = ring.iter().map(|&(vertex, _)| vertex).collect();
    for (number, vertex) in queue.iter().enumerate() {
        order[vertex.index()] = number as u32;
    }
    let mut next = 0;
    while next < queue.len() {
        let vertex = cdt.vertex(queue[next]);
        next += 1;
        for edge in vertex.out_edges() {
            let to = edge.to().fix();
            let within = filled.inside[edge.face().fix().index()] || filled.inside[edge.rev().face().fix().index()];
            if within && order[to.index()] == OUTSIDE {
                order[to.index()] = queue.len() as u32;
                queue.push(to);
            }
        }
    }
    order
}

fn connected(filled: &Filled, order: &[u32]) -> (Vec<[u32; 3]>, Vec<[u32; 3]>) {
    let mut number = vec![OUTSIDE; filled.inside.len()];
    let vertex = |v: VertexHandle<'_, _, _, _, _>| order[v.fix().index()];
    let mut faces: Vec<_> = filled.cdt.inner_faces().filter(|face| filled.inside[face.fix().index()]).collect();
    faces.sort_by_key(|face| {
        let mut key = face.vertices().map(vertex);
        key.sort_unstable();
        key
    });
    for (i, face) in faces.iter().enumerate() {
        number[face.fix().index()] = i as u32;
    }
    let across = |edge: DirectedEdgeHandle<'_, _, _, CdtEdge<()>, _>| {
        let face = edge.rev().face().fix().index();
        if edge.is_constraint_edge() { OUTSIDE } else { number[face] }
    };
    let triangles = faces.iter().map(|face| face.vertices().map(vertex)).collect();
    // Edges begin at the vertices in their order, so the one across from a vertex is that which begins at the next.
    let neighbours = faces.iter().map(|face| face.adjacent_edges().map(|edge| across(edge.next()))).collect();
    (triangles, neighbours)
}

/// Area of a triangle of these points, positive if counterclockwise.
pub(crate) fn signed_area(points: &[Point], triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|i| points[i as usize]);
    0.5 * (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::{Continuity, Segment, Spline};
    use std::f64::consts::{FRAC_PI_2, PI};

    /// A rectangle with rounded ends, and one with corners.
    fn stadium() -> Spline {
        let (a, b) = (Point::new(0.0, 0.0), Point::new(3.0, 2.0));
        let parts = vec![
            Segment::line(a, 0.0, 3.0),
            Segment::arc(Point::new(3.0, 0.0), 0.0, PI, 1.0),
            Segment::line(b, PI, 3.0),
            Segment::arc(Point::new(0.0, 2.0), PI, PI, 1.0),
        ];
        Spline::new(parts, vec![Continuity::G1; 4], true).unwrap()
    }

    fn square() -> Spline {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let side = |(i, &p): (usize, &(f64, f64))| Segment::line(Point::from(p), FRAC_PI_2 * i as f64, 1.0);
        Spline::new(corners.iter().enumerate().map(side).collect(), vec![Continuity::G0; 4], true).unwrap()
    }

    fn least_angle(domain: &Domain) -> f64 {
        let angle = |t: &[u32; 3], k: usize| {
            let p = t.map(|i| domain.points[i as usize]);
            let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            libm::atan2(u.cross(v), u.dot(v)).to_degrees()
        };
        domain.triangles.iter().flat_map(|t| [angle(t, 0), angle(t, 1), angle(t, 2)]).fold(180.0, f64::min)
    }

    #[test]
    fn triangles_keep_their_angles_where_no_corner_is_sharper() {
        for (spline, edge) in [(stadium(), 0.05), (stadium(), 0.01), (square(), 0.05), (square(), 0.01)] {
            let outline = Outline::new(&spline).unwrap();
            let rim = rim::sample(&outline, edge, 1e-3);
            let domain = triangulate(&outline, rim, 0.5 * edge * edge, 100_000).unwrap();
            // Moving vertices onto the curve costs some degrees where the rim's edges turn by a quarter of a radian.
            let bound = if edge < 0.02 { 23.0 } else { 18.0 };
            assert!(least_angle(&domain) > bound, "{} with {edge}", least_angle(&domain));
        }
    }

    #[test]
    fn triangles_fill_the_outline_and_know_their_neighbours() {
        let outline = Outline::new(&stadium()).unwrap();
        let rim = rim::sample(&outline, 0.02, 1e-4);
        let domain = triangulate(&outline, rim, 2e-4, 100_000).unwrap();
        let area: f64 = domain.triangles.iter().map(|&t| signed_area(&domain.points, t)).sum();
        assert!((area / outline.area - 1.0).abs() < 1e-3, "{area} of {}", outline.area);
        let mut open = 0;
        for (i, (triangle, neighbours)) in domain.triangles.iter().zip(&domain.neighbours).enumerate() {
            for k in 0..3 {
                let edge = [triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
                if neighbours[k] == OUTSIDE {
                    assert!(edge.iter().all(|&v| (v as usize) < domain.rim.len()));
                    open += 1;
                } else {
                    let across = neighbours[k] as usize;
                    assert!(domain.neighbours[across].contains(&(i as u32)));
                    assert!(edge.iter().all(|v| domain.triangles[across].contains(v)));
                    assert!(!edge.iter().all(|&v| (v as usize) < domain.rim.len()), "no edge leads from rim to rim");
                }
            }
        }
        assert_eq!(open, domain.rim.len());
    }

    #[test]
    fn too_many_vertices_and_a_crossing_rim_are_told() {
        let outline = Outline::new(&square()).unwrap();
        let rim = rim::sample(&outline, 0.01, 1e-3);
        assert!(matches!(triangulate(&outline, rim, 1e-5, 500), Err(Obstacle::TooMany)));
        let bow = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)].map(Point::from);
        assert!(matches!(fill(&bow), Err(Obstacle::Crossing(_))));
    }
}
