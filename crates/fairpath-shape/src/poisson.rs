//! The equation of the height: triangles come in, the solution of Δu = −4 with u = 0 on the rim goes out, with its gradient.
//!
//! Linear finite elements: the matrix of the Laplacian has the cotangents of the triangles' angles as its entries. On a disc of radius R
//! the solution is R² − r², the square of a hemisphere's height.

use crate::conjugate_gradients::{Symmetric, solve};
use crate::error::InflateError;
use crate::triangulation::Domain;
use fairpath_curve::{Point, Vec2};

/// −Δu.
const SOURCE: f64 = 4.0;
/// The residual at which the equations count as solved, as a part of the right side: far below what the elements are off.
const TOLERANCE: f64 = 1e-9;
/// Most iterations; a million triangles need some 600.
const MOST_ITERATIONS: usize = 20_000;

/// The solution at the vertices of a [`Domain`].
#[derive(Debug)]
pub(crate) struct Solved {
    /// The function, 0 on the rim and positive inside.
    pub(crate) u: Vec<f64>,
    /// For each vertex of the rim, how steeply the function rises inwards from it.
    pub(crate) rise: Vec<f64>,
}

/// Solves the equation.
///
/// # Errors
/// [`InflateError::NotSolved`] when that takes too many iterations.
pub(crate) fn solve_poisson(domain: &Domain) -> Result<Solved, InflateError> {
    let (count, rim) = (domain.points.len(), domain.rim.len());
    let mut entries = Vec::with_capacity(4 * domain.triangles.len());
    let mut source = vec![0.0; count];
    for &triangle in &domain.triangles {
        let (area, halves) = element(&domain.points, triangle);
        for k in 0..3 {
            source[triangle[k] as usize] += SOURCE * area / 3.0;
            // The edge across from corner k.
            let (i, j) = (triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
            for (row, column, value) in [(i, i, halves[k]), (j, j, halves[k]), (i.max(j), i.min(j), -halves[k])] {
                if column as usize >= rim {
                    entries.push((row - rim as u32, column - rim as u32, value));
                }
            }
        }
    }
    let matrix = Symmetric::from_entries(count - rim, entries);
    let solution = solve(&matrix, &source[rim..], TOLERANCE, MOST_ITERATIONS);
    if !(solution.residual <= 10.0 * TOLERANCE) {
        return Err(InflateError::NotSolved { residual: solution.residual, iterations: solution.iterations });
    }
    let mut u = vec![0.0; rim];
    u.extend(solution.x);
    let rise = rises(domain, &u, &source);
    Ok(Solved { u, rise })
}

/// Area of a triangle and half the cotangent of the angle at each of its corners.
fn element(points: &[Point], triangle: [u32; 3]) -> (f64, [f64; 3]) {
    let p = triangle.map(|i| points[i as usize]);
    let doubled = (p[1] - p[0]).cross(p[2] - p[0]);
    let half = |k: usize| {
        let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
        0.5 * u.dot(v) / doubled
    };
    (0.5 * doubled, [half(0), half(1), half(2)])
}

/// The flux through the rim that balances the equations of its vertices, per length: more exact than the triangles' own gradients.
fn rises(domain: &Domain, u: &[f64], source: &[f64]) -> Vec<f64> {
    let rim = domain.rim.len();
    let mut flux = source[..rim].to_vec();
    for &triangle in &domain.triangles {
        if triangle.iter().all(|&i| i as usize >= rim) {
            continue;
        }
        let (_, halves) = element(&domain.points, triangle);
        for k in 0..3 {
            let (i, j) = (triangle[(k + 1) % 3] as usize, triangle[(k + 2) % 3] as usize);
            for (a, b) in [(i, j), (j, i)] {
                if a < rim {
                    flux[a] -= halves[k] * (u[a] - u[b]);
                }
            }
        }
    }
    let point = |i: usize| domain.points[i % rim];
    (0..rim)
        .map(|i| {
            let length = 0.5 * ((point(i + 1) - point(i)).hypot() + (point(i) - point(i + rim - 1)).hypot());
            // At a sharp corner nothing is left, and rounding could make it negative.
            (flux[i] / length).max(0.0)
        })
        .collect()
}

/// The gradient at each vertex: of the parabola through the vertex that fits its neighbours best, which is exact where the function is
/// quadratic; on the rim across it, as steep as the flux says.
pub(crate) fn gradients(domain: &Domain, solved: &Solved) -> Vec<Vec2> {
    let rim = domain.rim.len();
    let mut fits = vec![Parabola::default(); domain.points.len()];
    for triangle in &domain.triangles {
        for k in 0..3 {
            let (i, j) = (triangle[k] as usize, triangle[(k + 1) % 3] as usize);
            // Each edge inside comes twice, once in each direction.
            if i >= rim {
                fits[i].add(domain.points[j] - domain.points[i], solved.u[j] - solved.u[i]);
            }
        }
    }
    let mut gradients: Vec<Vec2> =
        domain.rim.iter().zip(&solved.rise).map(|(p, &rise)| inward(p.pose.heading) * rise).collect();
    let averages = averages(domain, solved);
    gradients.extend((rim..fits.len()).map(|i| fits[i].gradient().unwrap_or(averages[i])));
    gradients
}

/// The unit vector to the left of a heading.
pub(crate) fn inward(heading: f64) -> Vec2 {
    let along = fairpath_curve::trig::unit(heading);
    Vec2::new(-along.y, along.x)
}

/// Means of the triangles' gradients at each vertex, by area.
fn averages(domain: &Domain, solved: &Solved) -> Vec<Vec2> {
    let mut sums = vec![(Vec2::ZERO, 0.0); domain.points.len()];
    for triangle in &domain.triangles {
        let p = triangle.map(|i| domain.points[i as usize]);
        let u = triangle.map(|i| solved.u[i as usize]);
        let doubled = (p[1] - p[0]).cross(p[2] - p[0]);
        // Twice the area times the gradient.
        let slope = turned(p[2] - p[1]) * u[0] + turned(p[0] - p[2]) * u[1] + turned(p[1] - p[0]) * u[2];
        for &i in triangle {
            sums[i as usize].0 += slope;
            sums[i as usize].1 += doubled;
        }
    }
    sums.into_iter().map(|(sum, area)| sum / area).collect()
}

fn turned(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// Normal equations of a parabola g·d + d·H·d / 2 through a vertex, each neighbour weighted by its inverse squared distance.
#[derive(Clone, Copy, Debug, Default)]
struct Parabola {
    matrix: [[f64; 5]; 5],
    right: [f64; 5],
    scale: f64,
}

impl Parabola {
    fn add(&mut self, d: Vec2, rise: f64) {
        // Lengths in units of the first edge keep the equations of one size.
        if self.scale == 0.0 {
            self.scale = d.hypot();
        }
        let d = d / self.scale;
        let row = [d.x, d.y, 0.5 * d.x * d.x, d.x * d.y, 0.5 * d.y * d.y];
        let weight = 1.0 / d.hypot2();
        for i in 0..5 {
            for j in 0..=i {
                self.matrix[i][j] += weight * row[i] * row[j];
            }
            self.right[i] += weight * row[i] * rise;
        }
    }

    /// None where the neighbours do not tell a parabola.
    fn gradient(&self) -> Option<Vec2> {
        let mut a = self.matrix;
        let mut x = self.right;
        for i in 0..5 {
            for j in 0..=i {
                let sum: f64 = (0..j).map(|k| a[i][k] * a[j][k]).sum();
                if i > j {
                    a[i][j] = (a[i][j] - sum) / a[j][j];
                } else {
                    let pivot = a[i][i] - sum;
                    // Five neighbours on or near a conic tell no parabola.
                    if !(pivot > 1e-3 * self.matrix[i][i]) {
                        return None;
                    }
                    a[i][i] = pivot.sqrt();
                }
            }
        }
        for i in 0..5 {
            let sum: f64 = (0..i).map(|k| a[i][k] * x[k]).sum();
            x[i] = (x[i] - sum) / a[i][i];
        }
        for i in (0..5).rev() {
            let sum: f64 = (i + 1..5).map(|k| a[k][i] * x[k]).sum();
            x[i] = (x[i] - sum) / a[i][i];
        }
        Some(Vec2::new(x[0], x[1]) / self.scale)
    }
}
