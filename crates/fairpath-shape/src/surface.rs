//! From the plane into space: the height's equation, solved on triangles in the plane, comes in, a closed surface goes out.
//!
//! The height is the square root of the solution, so the surface stands upright on the plane all along the rim. Equal triangles in the plane
//! would therefore be long upright ones in space. So vertices are first moved towards the rim, as far as stereographic projection
//! moves those of a disc when it makes a sphere of it: that keeps angles. The solution is then evaluated where the vertices have
//! come to lie.

use crate::mesh::Mesh;
use crate::options::InflateOptions;
use crate::outline::Outline;
use crate::poisson::{Solved, gradients};
use crate::shore::{Foot, Shore};
use crate::triangulation::{Domain, OUTSIDE, signed_area};
use fairpath_curve::{Point, Vec2, trig};

/// What a triangle in the plane must keep of its area when its vertices move, as a part of what it would on a disc.
const LEAST_AREA: f64 = 0.1;
/// What is left of the way that a vertex moves when it turns a triangle over, each time.
const HELD_BACK: f64 = 0.7;
/// How often vertices are held back before all stay where they were.
const MOST_ROUNDS: usize = 60;
/// Steps from triangle to triangle on the way to a point; the longest way leads through about as many as lie across.
const MOST_STEPS: usize = 10_000;
/// The part of the height near the rim that comes from the distance to the curve, so that it is true in proportion however small: all up
/// to so many edge lengths from the rim, and none from so many on.
const NEAR: [f64; 2] = [1.0, 3.0];

/// The surface over the domain, and below it.
pub(crate) fn raise(outline: &Outline, domain: &Domain, solved: &Solved, options: &InflateOptions) -> Mesh {
    let shore = Shore::new(domain, outline);
    let field = Field::new(domain, solved, &shore);
    let places = field.spread();
    let rim = domain.rim.len();
    let mut front = vec![(0.0, Vec2::ZERO); rim];
    for i in rim..places.len() {
        front.push(field.at(places[i], i));
    }
    close(outline, domain, &places, &front, options.height)
}

/// The solution, ready to be evaluated anywhere inside.
struct Field<'a> {
    domain: &'a Domain,
    solved: &'a Solved,
    shore: &'a Shore,
    gradients: Vec<Vec2>,
    feet: Vec<Foot>,
    /// The solution per distance from the rim's polygon.
    per_distance: Vec<f64>,
    /// A triangle at each vertex.
    triangle_at: Vec<u32>,
}

impl<'a> Field<'a> {
    fn new(domain: &'a Domain, solved: &'a Solved, shore: &'a Shore) -> Self {
        let feet = shore.feet(domain);
        let inside = feet.iter().zip(&solved.u).skip(domain.rim.len());
        let per_distance = solved.rise.iter().copied().chain(inside.map(|(foot, u)| u / foot.distance)).collect();
        let mut triangle_at = vec![0; domain.points.len()];
        for (number, triangle) in domain.triangles.iter().enumerate() {
            for &i in triangle {
                triangle_at[i as usize] = number as u32;
            }
        }
        Self { domain, solved, shore, gradients: gradients(domain, solved), feet, per_distance, triangle_at }
    }

    /// Where the vertices come to lie.
    fn spread(&self) -> Vec<Point> {
        let old = &self.domain.points;
        let ways: Vec<Vec2> = (0..old.len()).map(|i| self.way(i)).collect();
        // What is left of each vertex's distance from the rim, and so, roughly, of the areas around.
        let left: Vec<f64> = (0..old.len())
            .map(|i| if i < self.domain.rim.len() { 0.0 } else { 1.0 - ways[i].hypot() / self.shore.from_curve(&self.feet[i]) })
            .collect();
        let expected = |t: [u32; 3]| t.iter().map(|&i| left[i as usize]).sum::<f64>() / 3.0;
        let mut part = vec![1.0; old.len()];
        let mut places: Vec<Point> = old.iter().zip(&ways).map(|(&p, &way)| p + way).collect();
        for _ in 0..MOST_ROUNDS {
            let turned = |&&t: &&[u32; 3]| !(signed_area(&places, t) > LEAST_AREA * expected(t) * signed_area(old, t));
            let mut held: Vec<u32> = self.domain.triangles.iter().filter(turned).flatten().copied().collect();
            if held.is_empty() {
                return places;
            }
            held.sort_unstable();
            held.dedup();
            for i in held.into_iter().map(|i| i as usize) {
                part[i] *= HELD_BACK;
                places[i] = old[i] + ways[i] * part[i];
            }
        }
        // Nothing is known to be worse than not to move at all.
        old.clone()
    }

    /// How far and where a vertex is to be moved.
    ///
    /// On a disc of radius R, with q = r / R, stereographic projection moves it from r to 2 r / (1 + q²), which is
    /// by t q (1 + q) / (1 + q²) where t is the distance from the rim. There, u + |∇u|² / 4 is R², and |∇u| / 2 is r. Taken elsewhere
    /// too, a vertex near the rim comes to lie at the distance t² / |∇u|, as on the disc, and so as high as it was far away.
    fn way(&self, i: usize) -> Vec2 {
        let half = self.gradients[i] * 0.5;
        let radius2 = self.solved.u[i] + half.hypot2();
        if i < self.domain.rim.len() || !(radius2 > 0.0) {
            return Vec2::ZERO;
        }
        let outward = -half / radius2.sqrt();
        let q = outward.hypot();
        outward * (self.shore.from_curve(&self.feet[i]) * (1.0 + q) / (1.0 + q * q))
    }

    /// The solution and its gradient at a point near a vertex.
    fn at(&self, p: Point, vertex: usize) -> (f64, Vec2) {
        let (triangle, weights) = self.locate(p, self.triangle_at[vertex]);
        let corners = self.domain.triangles[triangle as usize].map(|i| i as usize);
        let mut gradient = Vec2::ZERO;
        let (mut deep, mut near) = (0.0, 0.0);
        let mut edge = 0.0_f64;
        for k in 0..3 {
            let (i, weight) = (corners[k], weights[k]);
            let from = self.domain.points[i];
            gradient += self.gradients[i] * weight;
            // Exact for quadratic functions, unlike the values' own mean.
            deep += weight * (self.solved.u[i] + 0.5 * self.gradients[i].dot(p - from));
            near += weight * self.per_distance[i];
            edge = edge.max((from - self.domain.points[corners[(k + 1) % 3]]).hypot());
        }
        let foot = self.shore.nearest_from(p, Shore::chord(&self.feet[vertex]));
        // Never as low as the rim, or front and back would touch.
        let distance = (foot.distance + self.shore.lead(&foot)).max(1e-3 * self.shore.from_curve(&foot)).max(1e-9 * edge);
        near *= distance;
        let weight = ((foot.distance / edge - NEAR[0]) / (NEAR[1] - NEAR[0])).clamp(0.0, 1.0);
        let weight = if deep > 0.25 * near { weight * weight * (3.0 - 2.0 * weight) } else { 0.0 };
        (near + weight * (deep - near), gradient)
    }

    /// The triangle around a point and the weights of its corners there; where the point is outside, those of the nearest inside that the
    /// way there leads to.
    fn locate(&self, p: Point, start: u32) -> (u32, [f64; 3]) {
        let mut at = start;
        let mut weights = self.weights(p, at);
        for _ in 0..MOST_STEPS {
            let mut order = [0, 1, 2];
            order.sort_by(|&a, &b| weights[a].total_cmp(&weights[b]));
            // Over the edge that the point is furthest beyond, or the next if that is the rim.
            let next = order.into_iter().filter(|&k| weights[k] < 0.0);
            let Some(next) = next.map(|k| self.domain.neighbours[at as usize][k]).find(|&n| n != OUTSIDE) else { break };
            at = next;
            weights = self.weights(p, at);
        }
        let kept = weights.map(|w| w.max(0.0));
        let sum: f64 = kept.iter().sum();
        (at, kept.map(|w| w / sum))
    }

    fn weights(&self, p: Point, triangle: u32) -> [f64; 3] {
        let [a, b, c] = self.domain.triangles[triangle as usize].map(|i| self.domain.points[i as usize]);
        let doubled = (b - a).cross(c - a);
        let wa = (b - p).cross(c - p) / doubled;
        let wb = (c - p).cross(a - p) / doubled;
        [wa, wb, 1.0 - wa - wb]
    }
}

/// Front and back, joined along the rim, in the frame of the curve.
fn close(outline: &Outline, domain: &Domain, places: &[Point], front: &[(f64, Vec2)], height: f64) -> Mesh {
    let rim = domain.rim.len();
    let inside = places.len() - rim;
    let mut mesh = Mesh::default();
    let vertex = |i: usize, side: f64| {
        let p = outline.outward(places[i]);
        [p.x, p.y, side * height * outline.scale * front[i].0.sqrt()]
    };
    for i in 0..rim {
        mesh.vertices.push(vertex(i, 0.0));
        let out = outward(outline, domain, i);
        mesh.normals.push([out.x, out.y, 0.0]);
    }
    for side in [1.0, -1.0] {
        for i in rim..places.len() {
            mesh.vertices.push(vertex(i, side));
            // The gradient of z² − height² u.
            let (u, gradient) = front[i];
            mesh.normals.push(normalised([-gradient.x * height, -gradient.y * height, side * 2.0 * u.sqrt()]));
        }
    }
    let back = |i: u32| if (i as usize) < rim { i } else { i + inside as u32 };
    mesh.triangles = domain.triangles.clone();
    mesh.triangles.extend(domain.triangles.iter().map(|&[a, b, c]| [back(a), back(c), back(b)]));
    mesh
}

/// The horizontal direction out of the surface at a vertex of the rim: at a corner, half way between those of its sides.
fn outward(outline: &Outline, domain: &Domain, i: usize) -> Vec2 {
    let at = domain.rim[i];
    let mut along = trig::unit(at.pose.heading);
    if outline.corners.contains(&at.station) {
        let before = (i + domain.rim.len() - 1) % domain.rim.len();
        let arriving = outline.arriving(at.station);
        let sum = along + trig::unit(arriving);
        // A cusp has no such direction but the one in which its tip points.
        along = if sum.hypot() > 1e-6 {
            sum / sum.hypot()
        } else {
            let tip = at.pose.point - domain.rim[before].pose.point;
            Vec2::new(-tip.y, tip.x) / tip.hypot()
        };
    }
    Vec2::new(along.y, -along.x)
}

fn normalised(v: [f64; 3]) -> [f64; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length > 0.0 { v.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}
