//! A polyline by arc length.

use crate::clean::distance;
use fairpath_curve::Vec2;

/// Points with their arc lengths.
#[derive(Clone, Debug)]
pub(crate) struct Polyline {
    pub(crate) points: Vec<Vec2>,
    pub(crate) s: Vec<f64>,
}

impl Polyline {
    pub(crate) fn new(points: Vec<Vec2>) -> Self {
        let mut s = Vec::with_capacity(points.len());
        let mut total = 0.0;
        for (i, p) in points.iter().enumerate() {
            if i > 0 {
                total += distance(points[i - 1], *p);
            }
            s.push(total);
        }
        Self { points, s }
    }

    pub(crate) fn length(&self) -> f64 {
        self.s.last().copied().unwrap_or(0.0)
    }

    /// The point at an arc length, clamped to the ends; `hint` is the vertex to search from and is moved along.
    pub(crate) fn at(&self, s: f64, hint: &mut usize) -> Vec2 {
        let last = self.points.len() - 1;
        while *hint + 1 < last && self.s[*hint + 1] <= s {
            *hint += 1;
        }
        while *hint > 0 && self.s[*hint] > s {
            *hint -= 1;
        }
        let (a, b) = (*hint, (*hint + 1).min(last));
        let span = self.s[b] - self.s[a];
        let u = if span > 0.0 { ((s - self.s[a]) / span).clamp(0.0, 1.0) } else { 0.0 };
        self.points[a] + (self.points[b] - self.points[a]) * u
    }
}
