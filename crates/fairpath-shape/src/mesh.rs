//! A triangle mesh in space, what it measures, and what is wrong with it.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Triangles over shared vertices.
///
/// Coordinates are in the unit and the x and y directions of the curve that the surface comes from; z is across, and x, y, z are right-handed
/// if x, y are seen with y up. Triangles are counterclockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Places of the vertices.
    pub vertices: Vec<[f64; 3]>,
    /// For each vertex the unit vector out of the surface.
    pub normals: Vec<[f64; 3]>,
    /// Vertices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// Something that is wrong with a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFault {
    /// There is no triangle.
    Empty,
    /// A vertex or its normal is not finite, or its normal is no unit vector.
    BadVertex(usize),
    /// There are not as many normals as vertices.
    NormalCount,
    /// A triangle names a vertex that does not exist, or one twice.
    BadTriangle(usize),
    /// A triangle has no area to speak of.
    Degenerate(usize),
    /// A triangle faces away from the normals of all its vertices.
    Inverted(usize),
    /// An edge, from vertex to vertex, has a triangle on one side only.
    OpenEdge(u32, u32),
    /// An edge is run through in the same direction by two triangles: more than two meet there, or two disagree about outside.
    CrowdedEdge(u32, u32),
    /// The triangles at a vertex form more than one fan.
    PinchedVertex(u32),
    /// No triangle has this vertex.
    LooseVertex(u32),
}

impl fmt::Display for MeshFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "there is no triangle"),
            Self::BadVertex(i) => write!(f, "vertex {i} has no finite place or no unit normal"),
            Self::NormalCount => write!(f, "there are not as many normals as vertices"),
            Self::BadTriangle(i) => write!(f, "triangle {i} names a vertex twice or one that does not exist"),
            Self::Degenerate(i) => write!(f, "triangle {i} has no area"),
            Self::Inverted(i) => write!(f, "triangle {i} faces away from its normals"),
            Self::OpenEdge(a, b) => write!(f, "the edge from vertex {a} to {b} has a triangle on one side only"),
            Self::CrowdedEdge(a, b) => {
                write!(f, "the edge from vertex {a} to {b} is in two triangles the same way round")
            }
            Self::PinchedVertex(i) => write!(f, "two parts of the surface meet in vertex {i} alone"),
            Self::LooseVertex(i) => write!(f, "vertex {i} is in no triangle"),
        }
    }
}

/// Twice the area of a triangle below this part of its longest edge squared is none.
const NO_AREA: f64 = 1e-12;

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

impl Mesh {
    /// Adds another mesh, which shares no vertex with this one.
    pub(crate) fn append(&mut self, other: Self) {
        let before = self.vertices.len() as u32;
        self.vertices.extend(other.vertices);
        self.normals.extend(other.normals);
        self.triangles.extend(other.triangles.into_iter().map(|t| t.map(|v| v + before)));
    }

    fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|i| self.vertices[i as usize])
    }

    /// Twice the area of a triangle, as a vector out of the surface.
    fn doubled(&self, triangle: [u32; 3]) -> [f64; 3] {
        let [a, b, c] = self.corners(triangle);
        cross(minus(b, a), minus(c, a))
    }

    /// Sum of the triangles' areas, in squares of the unit.
    #[must_use]
    pub fn area(&self) -> f64 {
        0.5 * self.triangles.iter().map(|&t| norm(self.doubled(t))).sum::<f64>()
    }

    /// Volume inside, in cubes of the unit; negative if the triangles face inwards. Means something for closed meshes only.
    #[must_use]
    pub fn volume(&self) -> f64 {
        // From a vertex of the mesh, so that meshes far from the origin lose no digits.
        let Some(&origin) = self.vertices.first() else { return 0.0 };
        let part = |&t: &[u32; 3]| {
            let [a, b, c] = self.corners(t).map(|p| minus(p, origin));
            dot(a, cross(b, c))
        };
        self.triangles.iter().map(part).sum::<f64>() / 6.0
    }

    /// Smallest angle of any triangle, radians; 0 if there is none.
    #[must_use]
    pub fn least_angle(&self) -> f64 {
        let least = self.triangles.iter().map(|&t| self.least_angle_of(t)).fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    }

    /// Smallest angle of one triangle, radians.
    #[must_use]
    pub fn least_angle_of(&self, triangle: [u32; 3]) -> f64 {
        let p = self.corners(triangle);
        let angle = |k: usize| {
            let (u, v) = (minus(p[(k + 1) % 3], p[k]), minus(p[(k + 2) % 3], p[k]));
            libm::atan2(norm(cross(u, v)), dot(u, v))
        };
        angle(0).min(angle(1)).min(angle(2))
    }

    /// Vertices less edges plus triangles: 2 for a surface like a sphere. Edges are counted as those of closed meshes, half of the triangles'
    /// sides.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        self.vertices.len() as i64 - (self.triangles.len() as i64 * 3) / 2 + self.triangles.len() as i64
    }

    /// Everything that is wrong: empty for a closed surface without seams that is oriented outwards everywhere.
    #[must_use]
    pub fn faults(&self) -> Vec<MeshFault> {
        if self.triangles.is_empty() {
            return vec![MeshFault::Empty];
        }
        let count = self.vertices.len();
        let bad = |(_, t): &(usize, &[u32; 3])| {
            t.iter().any(|&i| i as usize >= count) || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]
        };
        let mut faults: Vec<_> =
            self.triangles.iter().enumerate().filter(bad).map(|(i, _)| MeshFault::BadTriangle(i)).collect();
        if self.normals.len() != count {
            faults.push(MeshFault::NormalCount);
        }
        if !faults.is_empty() {
            return faults;
        }
        let good = |p: &[f64; 3], n: &[f64; 3]| p.iter().all(|x| x.is_finite()) && (norm(*n) - 1.0).abs() < 1e-6;
        let vertices = self.vertices.iter().zip(&self.normals).enumerate();
        faults.extend(vertices.filter(|(_, (p, n))| !good(p, n)).map(|(i, _)| MeshFault::BadVertex(i)));
        for (i, &triangle) in self.triangles.iter().enumerate() {
            faults.extend(self.fault_of(i, triangle));
        }
        self.connection_faults(&mut faults);
        faults
    }

    fn fault_of(&self, i: usize, triangle: [u32; 3]) -> Option<MeshFault> {
        let face = self.doubled(triangle);
        let [a, b, c] = self.corners(triangle);
        let longest = [minus(b, a), minus(c, b), minus(a, c)].map(|e| dot(e, e)).into_iter().fold(0.0, f64::max);
        if !(norm(face) > NO_AREA * longest) {
            return Some(MeshFault::Degenerate(i));
        }
        let away = triangle.iter().all(|&v| dot(face, self.normals[v as usize]) <= 0.0);
        away.then_some(MeshFault::Inverted(i))
    }

    /// Edges that are not shared by two triangles in opposite directions, and vertices whose triangles are not one fan.
    fn connection_faults(&self, faults: &mut Vec<MeshFault>) {
        let sides = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
        let mut edges: Vec<(u32, u32)> = self.triangles.iter().flat_map(sides).collect();
        edges.sort_unstable();
        faults.extend(edges.windows(2).filter(|w| w[0] == w[1]).map(|w| MeshFault::CrowdedEdge(w[0].0, w[0].1)));
        edges.dedup();
        let open = edges.iter().filter(|&&(a, b)| edges.binary_search(&(b, a)).is_err());
        faults.extend(open.map(|&(a, b)| MeshFault::OpenEdge(a, b)));
        // Around a vertex, each triangle leads from the edge to one neighbour on to the edge to another.
        let turns = |t: &[u32; 3]| [(t[0], t[1], t[2]), (t[1], t[2], t[0]), (t[2], t[0], t[1])];
        let mut fans: Vec<(u32, u32, u32)> = self.triangles.iter().flat_map(turns).collect();
        fans.sort_unstable();
        let mut begin = 0;
        for vertex in 0..self.vertices.len() as u32 {
            let end = begin + fans[begin..].partition_point(|fan| fan.0 <= vertex);
            let fan = &fans[begin..end];
            begin = end;
            match fan.first() {
                None => faults.push(MeshFault::LooseVertex(vertex)),
                Some(&(_, first, _)) => {
                    let next = |at: u32| fan.binary_search_by_key(&at, |f| f.1).ok().map(|i| fan[i].2);
                    let mut at = next(first);
                    let mut seen = 1;
                    while let Some(there) = at.filter(|&there| there != first && seen <= fan.len()) {
                        at = next(there);
                        seen += 1;
                    }
                    if seen != fan.len() {
                        faults.push(MeshFault::PinchedVertex(vertex));
                    }
                }
            }
        }
    }
}
