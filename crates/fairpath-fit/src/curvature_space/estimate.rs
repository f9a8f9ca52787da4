//! Curvature along a stretch of stroke without corners (McCrae and Singh 2008, section 4.1): points in, places of curvature space out.

use super::options::{CurvatureEstimate, CurvatureSpaceOptions};
use crate::polyline::Polyline;
use crate::primitive_fit::{circle_through, refine};
use crate::walk::Datum;
use fairpath_curve::Vec2;

/// A point of curvature space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Arc length along the stroke, px.
    pub(crate) s: f64,
    /// Radians per px, left positive.
    pub(crate) kappa: f64,
    /// Length of stroke that it stands for, px.
    pub(crate) weight: f64,
}

/// Most places on a stretch: where it is all one line, choosing breaks takes time with the square of their number.
const MOST: f64 = 4000.0;

/// Curvature beyond this is noise or a cusp, radians per px.
const LARGEST: f64 = 0.5;

/// The fewest points from which a circle is fitted; where fewer were drawn, chords stand in.
const FEWEST: usize = 7;

/// Gauss–Newton rounds for a circle: from one through three of the points, more change nothing that matters here.
const ROUNDS: usize = 4;

/// Curvature between the arc lengths `from` and `to`, increasing in arc length, at least one place.
///
/// `data` are all points, and `line` joins them; those beyond the stretch are looked at only if the stroke goes on `smoothly` there. `is_sample` tells points that were
/// not drawn, but lie on the chord of two that were.
pub(crate) fn curvature(
    data: &[Datum],
    line: &Polyline,
    is_sample: &[bool],
    [from, to]: [f64; 2],
    smoothly: bool,
    options: &CurvatureSpaceOptions,
) -> Vec<Place> {
    match options.curvature {
        CurvatureEstimate::Circle => by_circles(data, line, [from, to], smoothly, options),
        CurvatureEstimate::ThreePoints => by_neighbours(data, is_sample, [from, to]),
    }
}

/// Circles of least squares in a window around each place.
///
/// A window that ends with the stretch would tell of its own middle, not of its place: so the places keep off the ends.
fn by_circles(
    data: &[Datum],
    line: &Polyline,
    [from, to]: [f64; 2],
    smoothly: bool,
    options: &CurvatureSpaceOptions,
) -> Vec<Place> {
    let length = to - from;
    let window = options.curvature_window.min(WIDEST * length);
    let off = if smoothly { 0.0 } else { window };
    let (first, last) = (from + off, to - off);
    let count = ((last - first) / options.spacing).clamp(1.0, MOST).ceil();
    let step = (last - first) / count;
    let mut hint = 0;
    let mut drawn: Vec<Datum> = Vec::new();
    (0..=count as usize)
        .map(|i| {
            let s = first + step * i as f64;
            let (low, high) = (s - window, s + window);
            let run = &data[line.s.partition_point(|&v| v < low)..line.s.partition_point(|&v| v <= high)];
            drawn.clear();
            if run.len() < FEWEST || run[0].s > s - 0.5 * window || run[run.len() - 1].s < s + 0.5 * window {
                let chord = 2.0 * window / (2 * FEWEST) as f64;
                drawn.extend((0..=2 * FEWEST).map(|j| {
                    let s = low + chord * j as f64;
                    Datum { point: line.at(s, &mut hint), s, weight: chord }
                }));
            } else {
                // Weights of ends and of samples differ for reasons that do not concern curvature.
                drawn.extend(run.iter().map(|d| Datum { weight: d.weight.max(1e-3), ..*d }));
            }
            let fit = refine(&circle_through(&drawn), &drawn, 3, ROUNDS, 1.0);
            let kappa = if fit.primitive.kappa.is_finite() { fit.primitive.kappa } else { 0.0 };
            // The outermost places stand for half a step.
            let weight = if i == 0 || i == count as usize { 0.5 * step } else { step };
            Place { s, kappa: kappa.clamp(-LARGEST, LARGEST), weight }
        })
        .collect()
}

/// Widest window on each side, as a share of the stretch: some of it must remain to tell how curvature changes.
const WIDEST: f64 = 0.25;

/// Equation 6 at each point and its two neighbours.
fn by_neighbours(data: &[Datum], is_sample: &[bool], [from, to]: [f64; 2]) -> Vec<Place> {
    // A sample on a chord has no curvature, which tells nothing of the stroke.
    let drawn: Vec<&Datum> = data
        .iter()
        .zip(is_sample)
        .filter(|(d, sample)| !**sample && (from..=to).contains(&d.s))
        .map(|(d, _)| d)
        .collect();
    // More are thinned evenly.
    let every = (drawn.len() as f64 / MOST).ceil().max(1.0) as usize;
    let drawn: Vec<&Datum> = drawn.into_iter().step_by(every).collect();
    let mut out: Vec<Place> = drawn
        .windows(3)
        .map(|p| {
            let kappa = three_points(p[0].point, p[1].point, p[2].point);
            Place { s: p[1].s, kappa: kappa.clamp(-LARGEST, LARGEST), weight: 0.5 * (p[2].s - p[0].s) }
        })
        .collect();
    if out.is_empty() {
        out.push(Place { s: 0.5 * (from + to), kappa: 0.0, weight: to - from });
    }
    out
}

/// Equation 6, its sign that of the turn: `2 sin(½θ) / √(|v₁| |v₂|)`.
fn three_points(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let (u, v) = (b - a, c - b);
    let product = (u.hypot2() * v.hypot2()).sqrt();
    if !(product > 0.0) {
        return 0.0;
    }
    // Half the angle without its arc cosine, which would lose small angles to rounding.
    let half = (0.5 * (1.0 - u.dot(v) / product)).max(0.0).sqrt();
    let cross = u.cross(v) / product;
    let half = if u.dot(v) > 0.0 { 0.5 * cross.abs() / (1.0 - half * half).max(0.25).sqrt() } else { half };
    2.0 * half.copysign(cross) / product.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(radius: f64) -> Vec<Datum> {
        let points: Vec<Vec2> = (0..100).map(|i| fairpath_curve::trig::unit(0.03 * f64::from(i)) * radius).collect();
        let line = Polyline::new(points);
        line.points.iter().zip(&line.s).map(|(&point, &s)| Datum { point, s, weight: 1.0 }).collect()
    }

    #[test]
    fn a_circle_has_its_curvature_by_either_estimate() {
        for curvature in [CurvatureEstimate::Circle, CurvatureEstimate::ThreePoints] {
            let data = circle(60.0);
            let ends = [0.0, data[99].s];
            let options = CurvatureSpaceOptions { curvature, ..CurvatureSpaceOptions::default() };
            let line = super::super::ground::polyline_of(&data);
            let places = super::curvature(&data, &line, &[false; 100], ends, false, &options);
            assert!(places.len() > 10);
            for place in places {
                assert!((place.kappa - 1.0 / 60.0).abs() < 1e-5, "{place:?}");
            }
        }
    }

    #[test]
    fn a_right_turn_is_negative() {
        let kappa = three_points(Vec2::ZERO, Vec2::new(1.0, 0.0), Vec2::new(1.0, -1.0));
        assert!((kappa + 2.0 * (std::f64::consts::PI / 4.0).sin()).abs() < 1e-12);
    }
}
