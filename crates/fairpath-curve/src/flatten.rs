//! Polylines and samples: a segment or spline comes in with a tolerance or a step, points of the curve go out.

use crate::bezier::turn_limit;
use crate::moments::displacement;
use crate::segment::{Pose, Segment};
use crate::spline::Spline;
use crate::trig::{angle_of, wrap_angle};
use kurbo::Point;

/// Turning allowed to one chord, radians: a polyline keeps at least five sides to a turn, whatever the tolerance.
const MAX_TURN: f64 = 1.4;

/// No more chords than this for one segment.
const MAX_CHORDS: f64 = 1e6;

/// Accuracies below this, relative to the length of the segment, are taken as this.
const FINEST: f64 = 1e-12;

/// `sign(x) |x|^(3/2)`.
fn power_3_2(x: f64) -> f64 {
    x * x.abs().sqrt()
}

/// `sign(x) |x|^(2/3)`.
fn power_2_3(x: f64) -> f64 {
    let root = libm::cbrt(x);
    root * root.abs()
}

impl Segment {
    /// Greatest distance of the segment between two arc lengths from the chord between its points there, for stretches that
    /// turn by less than π/2: found where the heading is that of the chord.
    fn chord_deviation(&self, from: f64, to: f64) -> f64 {
        let (kappa, sharpness) = (self.curvature_at(from), self.sharpness());
        let length = to - from;
        let chord = displacement(0.0, kappa, sharpness, length);
        let direction = wrap_angle(angle_of(chord));
        let unit = chord / chord.hypot2().sqrt();
        // kappa s + sharpness s² / 2 = direction, both roots in the form that loses nothing.
        let root = (kappa * kappa + 2.0 * sharpness * direction).max(0.0).sqrt();
        let sum = kappa + root.copysign(kappa);
        let deviation = |s: f64| {
            if s > 0.0 && s < length { unit.cross(displacement(0.0, kappa, sharpness, s)).abs() } else { 0.0 }
        };
        deviation(2.0 * direction / sum).max(deviation(-sum / sharpness))
    }

    /// Arc lengths of the vertices of a polyline within `accuracy` of the segment, both ends included.
    ///
    /// Vertices lie on the curve. Their density goes with the square root of the curvature, which makes all chords
    /// deviate equally and their number minimal as the tolerance goes to zero; every chord is then checked by
    /// its exact deviation. At least one chord for each 1.4 rad of turning, at most a million for the segment; accuracies
    /// below 1e-12 × length are taken as that. An invalid segment gives nothing.
    #[must_use]
    pub fn flatten_at(&self, accuracy: f64) -> Vec<f64> {
        if !self.is_valid() {
            return Vec::new();
        }
        let accuracy = accuracy.max(FINEST * self.length);
        let (k0, k1) = (self.kappa0, self.kappa1);
        let steepest = k0.abs().max(k1.abs());
        // Integral of sqrt|kappa| over the segment; (2/3)(k1^1.5 − k0^1.5) / (k1 − k0) loses digits where k0 = k1.
        let nearly_arc = (k1 - k0).abs() <= 1e-3 * steepest;
        let mean_root = if nearly_arc {
            (0.5 * (k0 + k1)).abs().sqrt()
        } else {
            (power_3_2(k1) - power_3_2(k0)) / (1.5 * (k1 - k0))
        };
        // A chord of length h deviates by kappa h² / 8.
        let estimate = libm::ceil(mean_root * self.length / (8.0 * accuracy).sqrt() * (1.0 - 1e-9));
        let mut count = estimate.clamp(1.0, MAX_CHORDS);
        // An inflected chord deviates by far less than its curvatures promise: fewer may do.
        for fewer in [1.0, 2.0, 3.0] {
            if estimate <= 4.0 && fewer < estimate && self.flattens(fewer, nearly_arc, accuracy) {
                return self.vertices(fewer, nearly_arc);
            }
        }
        while !self.flattens(count, nearly_arc, accuracy) && count < MAX_CHORDS {
            count = libm::ceil(count * 1.04).min(MAX_CHORDS);
        }
        self.vertices(count, nearly_arc)
    }

    /// Arc lengths that cut the integral of sqrt|kappa| into `count` equal parts.
    fn vertices(&self, count: f64, nearly_arc: bool) -> Vec<f64> {
        let (low, high) = (power_3_2(self.kappa0), power_3_2(self.kappa1));
        (0..=count as usize)
            .map(|i| {
                let u = i as f64 / count;
                let part = if nearly_arc {
                    u
                } else {
                    (power_2_3(low + (high - low) * u) - self.kappa0) / (self.kappa1 - self.kappa0)
                };
                if i == 0 {
                    0.0
                } else if u >= 1.0 {
                    self.length
                } else {
                    part.clamp(0.0, 1.0) * self.length
                }
            })
            .collect()
    }

    fn flattens(&self, count: f64, nearly_arc: bool, accuracy: f64) -> bool {
        let rate = self.sharpness();
        self.vertices(count, nearly_arc).windows(2).all(|w| {
            w[1] - w[0] <= turn_limit(self.curvature_at(w[0]), rate, MAX_TURN)
                && self.chord_deviation(w[0], w[1]) <= accuracy
        })
    }

    /// A polyline of points of the segment within `accuracy` of it; see [`Segment::flatten_at`].
    #[must_use]
    pub fn flatten(&self, accuracy: f64) -> Vec<Point> {
        self.flatten_at(accuracy).into_iter().map(|s| self.point_at(s)).collect()
    }

    /// Poses at equal steps of arc length of at most `step`, both ends included; at most a million and one.
    #[must_use]
    pub fn samples(&self, step: f64) -> Vec<Pose> {
        steps(self.length, step).map(|s| self.pose_at(s)).collect()
    }
}

/// Arc lengths from 0 to `length` at equal steps of at most `step`.
fn steps(length: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = libm::ceil(length / step * (1.0 - 1e-12));
    let count = if count >= 1.0 { count.min(MAX_CHORDS) } else { 1.0 };
    (0..=count as usize).map(move |i| if i as f64 == count { length } else { length * (i as f64 / count) })
}

impl Spline {
    /// A polyline within `accuracy` of the spline: every knot is a vertex, and the last point of a closed spline
    /// repeats the first. See [`Segment::flatten_at`].
    #[must_use]
    pub fn flatten(&self, accuracy: f64) -> Vec<Point> {
        let mut points = Vec::new();
        for segment in self.segments() {
            // The next segment's start stands for this one's end.
            points.pop();
            points.extend(segment.flatten(accuracy));
        }
        let first = self.segments()[0].start;
        if let (true, Some(last)) = (self.is_closed(), points.last_mut()) {
            *last = first;
        }
        points
    }

    /// Poses at equal steps of arc length of at most `step` from start to end, across joins; at most a million and one.
    #[must_use]
    pub fn samples(&self, step: f64) -> Vec<Pose> {
        let segments = self.segments();
        let (mut i, mut begin) = (0, 0.0);
        steps(self.length(), step)
            .map(|s| {
                while i + 1 < segments.len() && s >= begin + segments[i].length {
                    begin += segments[i].length;
                    i += 1;
                }
                segments[i].pose_at((s - begin).min(segments[i].length))
            })
            .collect()
    }
}
