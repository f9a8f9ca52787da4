//! A stretch of stroke at equal steps: what is compared with templates, and what they are laid over.

use super::turning::{POINTS_PER_NODE, turnings};
use crate::polyline::Polyline;
use fairpath_curve::Vec2;

/// A stretch between two corners or ends, or one turn of a ring.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Places at equal arc lengths along the stroke, px; every second is a node. A ring has its first once more at the end.
    pub(crate) points: Vec<Vec2>,
    /// Distance of nodes along the stroke, px.
    pub(crate) step: f64,
    /// Angles from node to node, radians.
    pub(crate) turnings: Vec<f64>,
}

impl Part {
    /// The stretch of a line between two arc lengths, with nodes about `spacing` apart and curvature taken from `window` on each side.
    pub(crate) fn new(line: &Polyline, [from, to]: [f64; 2], spacing: f64, window: f64) -> Self {
        let (points, step) = even(line, [from, to], spacing);
        let turnings = turnings(&points, window * POINTS_PER_NODE as f64 / step, false);
        Self { points, step, turnings }
    }

    /// One turn of a smoothly closed line, whose last point is its first.
    pub(crate) fn ring(line: &Polyline, spacing: f64, window: f64) -> Self {
        let (points, step) = even(line, [0.0, line.length()], spacing);
        let once = &points[..points.len() - 1];
        let turnings = turnings(once, window * POINTS_PER_NODE as f64 / step, true);
        Self { points, step, turnings }
    }

    /// A ring begun at another node.
    pub(crate) fn begun_at(mut self, seam: usize) -> Self {
        self.points.pop();
        self.points.rotate_left(seam * POINTS_PER_NODE);
        self.points.push(self.points[0]);
        self.turnings.rotate_left(seam);
        self
    }

    /// Number of steps from node to node.
    pub(crate) fn cells(&self) -> usize {
        self.turnings.len()
    }

    /// The points from node `first` to node `last`.
    pub(crate) fn run(&self, first: usize, last: usize) -> &[Vec2] {
        &self.points[first * POINTS_PER_NODE..=last * POINTS_PER_NODE]
    }
}

/// Points at equal steps, and the distance of nodes.
fn even(line: &Polyline, [from, to]: [f64; 2], spacing: f64) -> (Vec<Vec2>, f64) {
    let count = libm::round((to - from) / spacing).max(1.0);
    let between = (to - from) / (count * POINTS_PER_NODE as f64);
    let mut hint = 0;
    let points =
        (0..=count as usize * POINTS_PER_NODE).map(|i| line.at(from + between * i as f64, &mut hint)).collect();
    (points, between * POINTS_PER_NODE as f64)
}
