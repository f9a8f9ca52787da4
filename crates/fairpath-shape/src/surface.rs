//! From the plane into space: the height's equation, solved on triangles in the plane, comes in, a closed surface goes out.
//!
//! The height is the square root of the solution, so the surface stands upright on the plane all along the rim. Equal triangles in the plane
//! would therefore be long upright ones in space. So vertices are first moved towards the rim, as far as stereographic projection
//! moves those of a disc when it makes a sphere of it: that keeps angles. The solution is then evaluated where the vertices have
//! come to lie.

use crate::mesh::Mesh;
use crate::options::InflateOptions;
use crate::outline::Outline;
use crate::poisson::{Solved, gradients, inward};
use crate::shore::{Foot, Shore};
use crate::triangulation::{Domain, OUTSIDE, signed_area};
use fairpath_curve::{Point, Vec2, trig};

/// What a triangle in the plane must keep of its area when its vertices move, as a part of what it would on a disc.
const LEAST_AREA: f64 = 0.1;
/// Vertices nearer to the rim than the first number of edge lengths go straight to it, those further than the second along the gradient.
const STRAIGHT: [f64; 2] = [1.5, 3.0];
/// Cosines of the angle between both at which they go along the gradient all the same, and straight: between them lie ridges, from which
/// either side of the rim is as near.
const AGREEING: [f64; 2] = [0.9, 0.98];
/// Largest difference between the parts of their ways that neighbours go, where some are held back.
const STEP_OF_PARTS: f64 = 0.15;
/// What is left of the way that a vertex moves when it turns a triangle over, each time.
const HELD_BACK: f64 = 0.7;
/// How often vertices are held back before all stay where they were; from half way on, those in question stay at once.
const MOST_ROUNDS: usize = 80;
/// How often surfaces are made until none of their triangles is folded over.
const MOST_SURFACES: usize = 4;
/// Steps from triangle to triangle on the way to a point; the longest way leads through about as many as lie across.
const MOST_STEPS: usize = 10_000;
/// The part of the height near the rim that comes from the distance to the curve, so that it is true in proportion however small: all up
/// to so many edge lengths from the rim, and none from so many on.
const NEAR: [f64; 2] = [0.1, 0.6];

/// The surface over the domain, and below it.
pub(crate) fn raise(outline: &Outline, domain: &Domain, solved: &Solved, options: &InflateOptions) -> Mesh {
    let shore = Shore::new(domain, outline);
    let field = Field::new(domain, solved, &shore);
    // Each vertex goes its whole way, unless that folds the plane or the surface over it.
    let mut part = vec![1.0; domain.points.len()];
    let mut places = field.spread(&mut part);
    let mut front = field.heights(&places);
    for _ in 0..MOST_SURFACES {
        let folded = folded(domain, &places, &front, options.height);
        if folded.is_empty() {
            break;
        }
        field.hold(&mut part, &folded, 0.0);
        places = field.spread(&mut part);
        front = field.heights(&places);
    }
    // What is left is too coarse for the solution's gradient to tell its slope, as in the tips of spikes.
    let folded = folded(domain, &places, &front, options.height);
    level(domain, &places, &mut front, &folded);
    close(outline, domain, &places, &front, options.height)
}

/// The triangles of the surface that face away from the normals at most of their corners.
fn folded(domain: &Domain, places: &[Point], front: &[(f64, Vec2)], height: f64) -> Vec<[u32; 3]> {
    let folds = |&&triangle: &&[u32; 3]| {
        let face = face(places, front, triangle);
        let facing = triangle.iter().filter(|&&i| {
            let (value, gradient) = front[i as usize];
            let on_rim = (i as usize) < domain.rim.len();
            let normal = if on_rim { -inward(domain.rim[i as usize].pose.heading) } else { -gradient };
            let level = normal.x * face[0] + normal.y * face[1];
            let square = height * height;
            (if on_rim { level } else { square * level + 2.0 * value.sqrt() * face[2] }) > 0.0
        });
        facing.count() < 2
    };
    domain.triangles.iter().filter(folds).copied().collect()
}

/// Normal of a triangle of the surface with height 1; its length is twice the area.
fn face(places: &[Point], front: &[(f64, Vec2)], triangle: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = triangle.map(|i| i as usize);
    let (u, v) = (places[b] - places[a], places[c] - places[a]);
    let [ha, hb, hc] = [a, b, c].map(|i| front[i].0.sqrt());
    let (du, dv) = (hb - ha, hc - ha);
    [u.y * dv - du * v.y, du * v.x - u.x * dv, u.cross(v)]
}

/// Gives the vertices of these triangles the mean normal of the triangles around them, as a gradient.
fn level(domain: &Domain, places: &[Point], front: &mut [(f64, Vec2)], triangles: &[[u32; 3]]) {
    let mut vertices: Vec<u32> =
        triangles.iter().flatten().copied().filter(|&i| i as usize >= domain.rim.len()).collect();
    if vertices.is_empty() {
        return;
    }
    vertices.sort_unstable();
    vertices.dedup();
    let mut sums = vec![[0.0; 3]; vertices.len()];
    for &triangle in &domain.triangles {
        let mut unit = None;
        for i in triangle {
            if let Ok(at) = vertices.binary_search(&i) {
                let unit = unit.get_or_insert_with(|| normalised(face(places, front, triangle)));
                for k in 0..3 {
                    sums[at][k] += unit[k];
                }
            }
        }
    }
    for (i, sum) in vertices.into_iter().zip(sums) {
        // The normal has the direction of (−∇u, 2 √u); all triangles of the front face up.
        let scale = 2.0 * front[i as usize].0.sqrt() / sum[2];
        front[i as usize].1 = -Vec2::new(sum[0], sum[1]) * scale;
    }
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
    /// The longest edge of the triangles at each vertex.
    edges: Vec<f64>,
}

impl<'a> Field<'a> {
    fn new(domain: &'a Domain, solved: &'a Solved, shore: &'a Shore) -> Self {
        let feet = shore.feet(domain);
        let inside = feet.iter().zip(&solved.u).skip(domain.rim.len());
        let per_distance = solved.rise.iter().copied().chain(inside.map(|(foot, u)| u / foot.distance)).collect();
        let mut triangle_at = vec![0; domain.points.len()];
        let mut edges = vec![0.0_f64; domain.points.len()];
        for (number, triangle) in domain.triangles.iter().enumerate() {
            for k in 0..3 {
                let (i, j) = (triangle[k] as usize, triangle[(k + 1) % 3] as usize);
                triangle_at[i] = number as u32;
                let edge = (domain.points[j] - domain.points[i]).hypot();
                edges[i] = edges[i].max(edge);
                edges[j] = edges[j].max(edge);
            }
        }
        Self { domain, solved, shore, gradients: gradients(domain, solved), feet, per_distance, triangle_at, edges }
    }

    /// Where the vertices come to lie when each goes this part of its way; parts are lowered until no triangle is turned over.
    fn spread(&self, part: &mut [f64]) -> Vec<Point> {
        let old = &self.domain.points;
        let ways: Vec<Vec2> = (0..old.len()).map(|i| self.way(i)).collect();
        // What is left of each vertex's distance from the rim, and so, roughly, of the areas around.
        let left: Vec<f64> = (0..old.len())
            .map(|i| {
                if i < self.domain.rim.len() {
                    0.0
                } else {
                    1.0 - ways[i].hypot() / self.shore.off_curve(&self.feet[i])
                }
            })
            .map(|left: f64| left.clamp(0.0, 1.0))
            .collect();
        let expected = |t: [u32; 3]| t.iter().map(|&i| left[i as usize]).sum::<f64>() / 3.0;
        let mut places = old.clone();
        // Only what moved since the last round has to be looked at again.
        let mut moved = vec![true; old.len()];
        for round in 0..MOST_ROUNDS {
            for i in (0..old.len()).filter(|&i| moved[i]) {
                // In powers, since what counts near the rim is by what factor the distance shrinks.
                let graded = part[i] < 1.0 && left[i] < 1.0;
                let way = if graded { (1.0 - libm::pow(left[i], part[i])) / (1.0 - left[i]) } else { 1.0 };
                places[i] = old[i] + ways[i] * way;
            }
            let turned = |&&t: &&[u32; 3]| {
                t.iter().any(|&i| moved[i as usize])
                    && !(signed_area(&places, t) > LEAST_AREA * expected(t) * signed_area(old, t))
            };
            let held: Vec<[u32; 3]> = self.domain.triangles.iter().filter(turned).copied().collect();
            if held.is_empty() {
                return places;
            }
            let before = part.to_vec();
            self.hold(part, &held, if 2 * round < MOST_ROUNDS { HELD_BACK } else { 0.0 });
            for i in 0..old.len() {
                moved[i] = part[i] != before[i];
            }
        }
        // Nothing is known to be worse than not to move at all.
        part.fill(0.0);
        old.clone()
    }

    /// Lets the vertices of these triangles go so much less far, and those around them somewhat less.
    fn hold(&self, part: &mut [f64], triangles: &[[u32; 3]], by: f64) {
        let before = part.to_vec();
        for i in triangles.iter().flatten().map(|&i| i as usize) {
            part[i] = by * before[i];
        }
        self.grade(part);
    }

    /// The solution and its gradient at each vertex, 0 on the rim.
    fn heights(&self, places: &[Point]) -> Vec<(f64, Vec2)> {
        let rim = self.domain.rim.len();
        (0..places.len()).map(|i| if i < rim { (0.0, Vec2::ZERO) } else { self.at(places[i], i) }).collect()
    }

    /// Lets a vertex go little further than its neighbours, in parts of their ways.
    fn grade(&self, part: &mut [f64]) {
        let rim = self.domain.rim.len() as u32;
        for triangle in &self.domain.triangles {
            for k in 0..3 {
                let (i, j) = (triangle[k], triangle[(k + 1) % 3]);
                if i >= rim && j >= rim {
                    let (i, j) = (i as usize, j as usize);
                    part[i] = part[i].min(part[j] + STEP_OF_PARTS);
                    part[j] = part[j].min(part[i] + STEP_OF_PARTS);
                }
            }
        }
    }

    /// How far and where a vertex is to be moved.
    ///
    /// On a disc of radius R, with q = r / R, stereographic projection moves it from r to 2 r / (1 + q²), which is by t q (1 + q) / (1 + q²)
    /// where t is the distance from the rim. Elsewhere too, a vertex near the rim then comes to lie at the distance t² / |∇u|, as high
    /// as it was far away. There, R is taken from u = t (2 R − t) and the way is straight to the rim, free of the gradient's noise;
    /// deep inside, from u + |∇u|² / 4 = R² with |∇u| / 2 = r, which goes smoothly over ridges.
    fn way(&self, i: usize) -> Vec2 {
        let half = self.gradients[i] * 0.5;
        let radius2 = self.solved.u[i] + half.hypot2();
        if i < self.domain.rim.len() || !(radius2 > 0.0) {
            return Vec2::ZERO;
        }
        let foot = &self.feet[i];
        let t = self.shore.off_curve(foot);
        let outward = -half / radius2.sqrt();
        let deep = outward * (t * part_of_way(outward.hypot()));
        let [from, to] = STRAIGHT.map(|edges| edges * self.edges[i]);
        let direction = self.shore.direction(foot, self.domain.points[i]);
        let agreeing = smooth((direction.dot(outward) / outward.hypot() - AGREEING[0]) / (AGREEING[1] - AGREEING[0]));
        let weight = agreeing * smooth((to - t) / (to - from));
        let radius = 0.5 * (self.solved.u[i] / foot.distance + t);
        let q = (1.0 - t / radius).clamp(0.0, 1.0);
        let straight = direction * (t * q * part_of_way(q));
        // A ridge may have no gradient at all, and so no direction to agree with.
        let way = if weight > 0.0 { deep + (straight - deep) * weight } else { deep };
        let length = way.hypot();
        if length > 0.0 { way * ((t - self.shore.cleared(foot, t, t - length)).max(0.0) / length) } else { way }
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
        let distance =
            (foot.distance + self.shore.lead(&foot)).max(1e-3 * self.shore.off_curve(&foot)).max(1e-9 * edge);
        near *= distance;
        let weight = smooth((foot.distance / edge - NEAR[0]) / (NEAR[1] - NEAR[0]));
        let weight = if deep > 0.25 * near { weight } else { 0.0 };
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
            let Some(next) = next.map(|k| self.domain.neighbours[at as usize][k]).find(|&n| n != OUTSIDE) else {
                break;
            };
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

/// The way of a vertex per distance from the rim and q; see [`Field::way`].
fn part_of_way(q: f64) -> f64 {
    (1.0 + q) / (1.0 + q * q)
}

/// From 0 up to 0 to 1 from 1 on, without a kink.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
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
