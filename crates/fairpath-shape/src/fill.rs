//! A polygon filled with triangles that have no other vertices, in the form of the crate spade.

use fairpath_curve::Point;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

/// Added to coordinates for spade, which takes no number between zero and 1e-43: this keeps them between 1 and 2.
const SHIFT: f64 = 1.5;

/// The triangulator's own form.
pub(crate) type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Why an outline could not be filled.
#[derive(Debug)]
pub(crate) enum Obstacle {
    /// The rim crosses or touches itself near this point.
    Crossing(Point),
    /// More vertices are needed than allowed.
    TooMany,
}

/// A filled polygon, still in the form of the triangulator.
pub(crate) struct Filled {
    pub(crate) cdt: Cdt,
    /// Whether each face is inside, by its index.
    pub(crate) inside: Vec<bool>,
}

impl Filled {
    pub(crate) fn new(cdt: Cdt) -> Self {
        let inside = inside(&cdt);
        Self { cdt, inside }
    }

    /// The triangles inside by vertex numbers, counterclockwise.
    pub(crate) fn triangles(&self) -> Vec<[u32; 3]> {
        let faces = self.cdt.inner_faces().filter(|face| self.inside[face.fix().index()]);
        faces.map(|face| face.vertices().map(|v| v.fix().index() as u32)).collect()
    }
}

fn to_spade(p: Point) -> Point2<f64> {
    Point2::new(p.x + SHIFT, p.y + SHIFT)
}

pub(crate) fn from_spade(p: Point2<f64>) -> Point {
    Point::new(p.x - SHIFT, p.y - SHIFT)
}

/// The polygon of these points, in order, cut into triangles without further vertices.
pub(crate) fn fill(points: &[Point]) -> Result<Filled, Obstacle> {
    let vertices: Vec<_> = points.iter().map(|&p| to_spade(p)).collect();
    let count = vertices.len();
    let edges = (0..count).map(|i| [i, (i + 1) % count]).collect();
    let mut conflict = None;
    let cdt = Cdt::try_bulk_load_cdt(vertices, edges, |[i, _]| conflict = conflict.or(Some(i)));
    let crossing = |i: usize| Obstacle::Crossing(points[i.min(count - 1)]);
    let cdt = cdt.map_err(|_| crossing(0))?;
    if let Some(i) = conflict {
        return Err(crossing(i));
    }
    // Equal points are merged, and a vertex on another edge parts that edge: either way an edge is missing.
    let vertex = FixedVertexHandle::from_index;
    let missing =
        (0..count).find(|&i| cdt.num_vertices() != count || !cdt.exists_constraint(vertex(i), vertex((i + 1) % count)));
    match missing {
        Some(i) => Err(crossing(i)),
        None => Ok(Filled::new(cdt)),
    }
}

/// Tells the faces inside from those that are reached from without.
pub(crate) fn inside(cdt: &Cdt) -> Vec<bool> {
    let mut inside = vec![true; cdt.num_all_faces()];
    inside[0] = false;
    let mut edges: Vec<_> = cdt.convex_hull().map(|edge| edge.rev()).collect();
    while let Some(edge) = edges.pop() {
        if edge.is_constraint_edge() {
            continue;
        }
        let Some(face) = edge.face().as_inner() else { continue };
        if std::mem::replace(&mut inside[face.fix().index()], false) {
            edges.extend([edge.next().rev(), edge.prev().rev()]);
        }
    }
    inside
}
