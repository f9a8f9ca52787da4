//! Which stretches of a plan lie within an outline.

use crate::terrain::inside;
use fairpath_curve::{Point, Spline};

/// A plan is looked at in steps of this length, m: what is shorter may be missed.
const STEP_M: f64 = 2.0;

/// Halvings by which the place is found at which a plan enters or leaves: to a micrometre.
const HALVINGS: usize = 21;

/// From and to of the stretches within the outline, arc lengths, m.
pub(super) fn stretches_within(plan: &Spline, outline: &[Point]) -> Vec<[f64; 2]> {
    let length = plan.length();
    let count = (length / STEP_M).ceil().max(1.0) as usize;
    let station = |i: usize| length * i as f64 / count as f64;
    let within = |s: f64| inside(outline, plan.point_at(s));
    let border = |mut outer: f64, mut inner: f64| {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (outer + inner);
            if within(middle) { inner = middle } else { outer = middle }
        }
        inner
    };
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut from = within(0.0).then_some(0.0);
    for i in 1..=count {
        match (from, within(station(i))) {
            (None, true) => from = Some(border(station(i - 1), station(i))),
            (Some(start), false) => {
                found.push([start, border(station(i), station(i - 1))]);
                from = None;
            }
            _ => {}
        }
    }
    found.extend(from.map(|start| [start, length]));
    found
}
