//! Distances from the rim: the vertices of a domain come in, for each the nearest place on the rim goes out.

use crate::outline::Outline;
use crate::triangulation::Domain;
use fairpath_curve::{Point, Vec2, trig};
use std::f64::consts::TAU;

/// Rounds of telling neighbours what is near; two or three find everything on most shapes.
const MOST_ROUNDS: usize = 20;

/// Chords beyond the nearest so far that are tried before the search along the rim ends.
const LOOK_PAST: usize = 2;

/// How far behind a chord a vertex must lie, in bulges of the curve.
const CLEARANCE: f64 = 2.0;

/// The rim as a polygon that knows how far the curve bulges out from each of its chords.
pub(crate) struct Shore {
    points: Vec<Point>,
    /// Distance of the curve from the middle of each chord, positive outwards.
    bulges: Vec<f64>,
    /// How much the polygon bends inwards at either end of each chord, radians per length; 0 where it bends outwards.
    inward: Vec<f64>,
}

/// The nearest place on the rim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// The chord, named by its first vertex.
    chord: usize,
    /// Where on the chord, from 0 to 1.
    along: f64,
    /// Distance from the chord, negative outside.
    pub(crate) distance: f64,
}

impl Shore {
    pub(crate) fn new(domain: &Domain, outline: &Outline) -> Self {
        let count = domain.rim.len();
        let points = domain.points[..count].to_vec();
        let bulge = |i: usize| {
            let (from, to) = (domain.rim[i], domain.rim[(i + 1) % count]);
            let end = if to.station > from.station { to.station } else { to.station + outline.length() };
            let middle = outline.pose(0.5 * (from.station + end)).point;
            let chord = to.pose.point - from.pose.point;
            -chord.cross(middle - from.pose.point) / chord.hypot()
        };
        let chord = |i: usize| points[(i + 1) % count] - points[i % count];
        let bends: Vec<f64> = (0..count)
            .map(|i| {
                let (before, after) = (chord(i + count - 1), chord(i));
                let turn = trig::angle_of(Vec2::new(before.dot(after), before.cross(after)));
                (-2.0 * turn / (before.hypot() + after.hypot())).max(0.0)
            })
            .collect();
        let inward = (0..count).map(|i| bends[i].max(bends[(i + 1) % count])).collect();
        Self { bulges: (0..count).map(bulge).collect(), inward, points }
    }

    fn on_chord(&self, p: Point, chord: usize) -> Foot {
        let (a, b) = (self.points[chord], self.points[(chord + 1) % self.points.len()]);
        let (edge, away): (Vec2, Vec2) = (b - a, p - a);
        let raw = edge.dot(away) / edge.hypot2();
        let along = raw.clamp(0.0, 1.0);
        let distance = (p - a.lerp(b, along)).hypot();
        let outside = raw == along && edge.cross(away) < 0.0;
        Foot { chord, along, distance: if outside { -distance } else { distance } }
    }

    /// The nearest place that is found by going along the rim from a chord.
    pub(crate) fn nearest_from(&self, p: Point, chord: usize) -> Foot {
        let count = self.points.len();
        let mut best = self.on_chord(p, chord);
        for step in [1, count - 1] {
            // Two chords that meet in the nearest place are equally near: look past them before giving up.
            let mut at = best.chord;
            let mut worse = 0;
            while worse < LOOK_PAST {
                at = (at + step) % count;
                let next = self.on_chord(p, at);
                if next.distance.abs() < best.distance.abs() {
                    best = next;
                    worse = 0;
                } else {
                    worse += 1;
                }
            }
        }
        best
    }

    /// The nearest place for each vertex inside; for those of the rim, themselves.
    pub(crate) fn feet(&self, domain: &Domain) -> Vec<Foot> {
        let rim = domain.rim.len();
        let unknown = Foot { chord: usize::MAX, along: 0.0, distance: f64::INFINITY };
        let mut feet = vec![unknown; domain.points.len()];
        for (chord, foot) in feet[..rim].iter_mut().enumerate() {
            *foot = Foot { chord, along: 0.0, distance: 0.0 };
        }
        for _ in 0..MOST_ROUNDS {
            let mut changed = false;
            for triangle in &domain.triangles {
                for k in 0..3 {
                    let (i, j) = (triangle[k] as usize, triangle[(k + 1) % 3] as usize);
                    for (to, from) in [(i, j), (j, i)] {
                        if to < rim || feet[from].chord == usize::MAX || feet[from].chord == feet[to].chord {
                            continue;
                        }
                        let found = self.nearest_from(domain.points[to], feet[from].chord);
                        if found.distance.abs() < feet[to].distance.abs() {
                            feet[to] = found;
                            changed = true;
                        }
                    }
                }
            }
            if !changed {
                break;
            }
        }
        feet
    }

    /// Number of the chord of a foot.
    pub(crate) fn chord(foot: &Foot) -> usize {
        foot.chord
    }

    /// Distance from the curve itself: to the chord, and from there along a parabola with the curve's bulge.
    pub(crate) fn off_curve(&self, foot: &Foot) -> f64 {
        foot.distance + 4.0 * foot.along * (1.0 - foot.along) * self.bulges[foot.chord]
    }

    /// The distance from the curve that a vertex at distance `t` should be moved to, instead of to `distance`, so that triangles do not turn
    /// over. It grows with both.
    ///
    /// Where the curve bulges out of its chords, a vertex must lie behind them. Where it bends inwards, rows of vertices along the rim must lie
    /// further apart than straight edges cut across the bend, so that they cannot be squeezed to less than about t² times the curvature.
    pub(crate) fn cleared(&self, foot: &Foot, t: f64, distance: f64) -> f64 {
        let count = self.points.len();
        let near = [foot.chord + count - 1, foot.chord, foot.chord + 1].map(|chord| chord % count);
        let out = CLEARANCE * near.map(|chord| self.bulges[chord]).into_iter().fold(0.0, f64::max);
        let bend = near.map(|chord| self.inward[chord]).into_iter().fold(0.0, f64::max);
        let behind = (distance * distance + out * out).sqrt();
        behind.max(t * (bend * t / (1.0 + bend * t)))
    }

    /// The direction from a point to its foot; straight outwards where it is on the rim itself.
    pub(crate) fn direction(&self, foot: &Foot, p: Point) -> Vec2 {
        let (a, b) = (self.points[foot.chord], self.points[(foot.chord + 1) % self.points.len()]);
        let way = a.lerp(b, foot.along) - p;
        let length = way.hypot();
        if foot.distance > 0.0 && length > 0.0 {
            way / length
        } else {
            Vec2::new((b - a).y, (a - b).x) / (b - a).hypot()
        }
    }

    /// How much further a function that vanishes on the curve has risen than one that vanishes on the polygon, as a distance.
    ///
    /// Along the rim the bulges are a wave with the chord's length; inwards it fades to its mean, two thirds of its crest.
    pub(crate) fn lead(&self, foot: &Foot) -> f64 {
        let (a, b) = (self.points[foot.chord], self.points[(foot.chord + 1) % self.points.len()]);
        let fading = libm::exp(-TAU * foot.distance.max(0.0) / (b - a).hypot());
        let wave = 4.0 * foot.along * (1.0 - foot.along) - 2.0 / 3.0;
        (2.0 / 3.0 + wave * fading) * self.bulges[foot.chord]
    }
}
