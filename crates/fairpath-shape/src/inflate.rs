//! Inflation, one step after the other.

use crate::error::InflateError;
use crate::fill::Obstacle;
use crate::mesh::Mesh;
use crate::options::{InflateOptions, MOST_TRIANGLES};
use crate::outline::{Outline, measured};
use crate::poisson::solve_poisson;
use crate::rim;
use crate::surface::raise;
use crate::triangulation::triangulate;
use crate::uncrossed::outlines;
use fairpath_curve::Spline;
use std::ops::Range;

/// Area of a triangle with equal sides of length 1.
const EQUILATERAL: f64 = 0.433_012_701_892_219_3;
/// Area of the triangles that refinement ends with, as a part of the largest area that it allows, measured on many shapes.
const USUAL_AREA: f64 = 0.58;
/// Largest area that refinement allows, as a part of that of a triangle with the rim's edges.
const LARGEST_AREA: f64 = 1.3;

/// Most edges of a rim, before any are added for bends and narrow places. Thinner shapes are needles ten thousand times as long as wide.
const MOST_RIM: f64 = 50_000.0;

/// A surface with what there is to know about it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Inflated {
    /// The surface: closed, and oriented outwards. Of a curve that crosses itself it has a part for each of the outlines around what the curve encloses.
    pub mesh: Mesh,
    /// Which vertices lie on the curve, for each part, in order, with the inside on the left.
    pub rims: Vec<Range<usize>>,
}

/// The surface of a closed curve that is inflated to both sides: see the crate's documentation for the shape.
///
/// # Errors
/// When the curve is open, touches or retraces itself, encloses nothing or is beyond all measure; when an option makes no sense; when the triangles
/// are too many.
pub fn inflate(spline: &Spline, options: &InflateOptions) -> Result<Inflated, InflateError> {
    options.check()?;
    measured(spline)?;
    let outlines: Vec<Outline> = outlines(spline)?.iter().map(Outline::new).collect::<Result<_, _>>()?;
    // All parts have edges of one length in the curve's frame.
    let area: f64 = outlines.iter().map(|outline| outline.area * outline.scale * outline.scale).sum();
    let edge = edge_length(area, options);
    let mut whole = Inflated { mesh: Mesh::default(), rims: Vec::new() };
    for outline in &outlines {
        let (mesh, rim) = part(outline, edge / outline.scale, options)?;
        let before = whole.mesh.vertices.len();
        whole.rims.push(before..before + rim);
        whole.mesh.append(mesh);
    }
    Ok(whole)
}

/// The surface of one outline with edges of about that length in its frame, and how many of its vertices are the rim: the first.
fn part(outline: &Outline, edge: f64, options: &InflateOptions) -> Result<(Mesh, usize), InflateError> {
    let too_many = InflateError::TooManyTriangles { limit: MOST_TRIANGLES as usize };
    if !(outline.length() / edge <= MOST_RIM) {
        return Err(too_many);
    }
    let rim = rim::sample(outline, edge, options.accuracy);
    // Twice as many triangles as vertices, and twice more for the back.
    let most = MOST_TRIANGLES as usize / 4;
    let domain = triangulate(outline, rim, LARGEST_AREA * EQUILATERAL * edge * edge, most);
    let domain = domain.map_err(|obstacle| match obstacle {
        Obstacle::Crossing(p) => {
            let p = outline.outward(p);
            InflateError::TooNarrow { x: p.x, y: p.y }
        }
        Obstacle::TooMany => too_many,
    })?;
    let solved = solve_poisson(&domain)?;
    Ok((raise(outline, &domain, &solved, options), domain.rim.len()))
}

/// Edge length in the plane for which the surface over an area has about as many triangles as asked for.
fn edge_length(area: f64, options: &InflateOptions) -> f64 {
    let one_side = 0.5 * f64::from(options.triangles);
    (area / (one_side * USUAL_AREA * LARGEST_AREA * EQUILATERAL)).sqrt()
}
