//! A ring as one piece: a circle, which the graph has no node for, since a candidate cannot follow itself.
//!
//! Beyond Baran et al. 2010, whose full circle has two pieces at least.

use super::candidates::{deviation, penalty};
use crate::linear::{cholesky, solve};
use crate::options::FitOptions;
use crate::track::Track;
use crate::walk::Datum;
use fairpath_curve::{Segment, Vec2, trig};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Most rounds of Gauss–Newton; from the centroid it settles in three or four.
const ROUNDS: usize = 10;

/// A circle fitted to a whole ring, gone round as often as the ring goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    /// From the first sample on.
    pub(crate) arc: Segment,
    /// As candidates are priced (section 3.4).
    pub(crate) cost: f64,
    /// Largest distance of the data to it, px.
    pub(crate) largest: f64,
}

/// The circle nearest to a ring; nothing if arcs are forbidden, it does not go around, bends more than the options allow, or strays further than a candidate may.
pub(crate) fn circle(track: &Track, options: &FitOptions) -> Option<Circle> {
    let arc_cost = options.arc_cost?;
    // The last datum of a turn is the first of the next.
    let data = track.all.run(0, track.turn).split_last()?.1;
    let (centre, radius) = nearest_circle(data)?;
    let (mut energy, mut weight, mut largest) = (0.0, 0.0, 0.0_f64);
    for d in data {
        let off = (d.point - centre).hypot2().sqrt() - radius;
        energy += d.weight * off * off;
        weight += d.weight;
        largest = largest.max(off.abs());
    }
    let turned =
        (0..data.len()).map(|i| angle_between(data[i].point - centre, data[(i + 1) % data.len()].point - centre));
    let turns = (turned.sum::<f64>() / TAU).round();
    if !(largest <= options.max_error && largest < radius) || turns == 0.0 || radius * options.max_curvature() < 1.0 {
        return None;
    }
    let angle = trig::angle_of(data[0].point - centre);
    let (sin, cos) = trig::sin_cos(angle);
    let kappa = turns.signum() / radius;
    let arc = Segment {
        start: (centre + radius * Vec2::new(cos, sin)).to_point(),
        heading: trig::wrap_angle(angle + turns.signum() * FRAC_PI_2),
        length: TAU * radius * turns.abs(),
        kappa0: kappa,
        kappa1: kappa,
    };
    let short = (options.short_length - arc.length).max(0.0);
    let error = deviation(energy, weight, largest, options);
    let cost = arc_cost + penalty(error, options) + options.shortness_cost * short * short;
    Some(Circle { arc, cost, largest })
}

/// Centre and radius of the circle with the least weighted squared distances, by Gauss–Newton.
fn nearest_circle(data: &[Datum]) -> Option<(Vec2, f64)> {
    let weight: f64 = data.iter().map(|d| d.weight).sum();
    let mean = |f: &dyn Fn(&Datum) -> f64| data.iter().map(|d| d.weight * f(d)).sum::<f64>() / weight;
    let mut centre = Vec2::new(mean(&|d| d.point.x), mean(&|d| d.point.y));
    let mut radius = mean(&|d| (d.point - centre).hypot2().sqrt());
    for _ in 0..ROUNDS {
        let mut normal = [[0.0; 3]; 3];
        let mut step = [0.0; 3];
        for d in data {
            let arm = d.point - centre;
            let distance = arm.hypot2().sqrt();
            if !(distance > 0.0) {
                return None;
            }
            // The distance to the circle falls as the centre moves towards the point and as the radius grows.
            let row = [arm.x / distance, arm.y / distance, 1.0];
            for i in 0..3 {
                for j in 0..=i {
                    normal[i][j] += d.weight * row[i] * row[j];
                }
                step[i] += d.weight * row[i] * (distance - radius);
            }
        }
        if !cholesky(&mut normal, 3, 1e-12) {
            return None;
        }
        solve(&normal, 3, &mut step);
        centre += Vec2::new(step[0], step[1]);
        radius += step[2];
        if step.iter().all(|s| s.abs() <= 1e-12 * radius) {
            break;
        }
    }
    (radius.is_finite() && radius > 0.0).then_some((centre, radius))
}

/// The turn from one direction to another.
fn angle_between(a: Vec2, b: Vec2) -> f64 {
    trig::angle_of(Vec2::new(a.dot(b), a.cross(b)))
}
