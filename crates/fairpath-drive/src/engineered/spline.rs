//! Quadratic B-splines over equal intervals: a road's length comes in, heights and grades as sums of a few coefficients go out.

use super::network::EngineeredRoad;
use crate::profile::{Knot, Profile, ProfileError};

/// A sum of coefficients with factors.
pub(super) type Terms = [(usize, f64); 3];

/// How a road is cut into intervals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// How many intervals.
    pub(super) count: usize,
    /// How long each is, m.
    pub(super) step_m: f64,
    length_m: f64,
    closed: bool,
}

impl Layout {
    /// Intervals of at most the knot spacing; a closed road has at least three, or its curve would meet itself.
    pub(super) fn of(road: &EngineeredRoad) -> Self {
        let count = Self::intervals(road) as usize;
        Self { count, step_m: road.length_m / count as f64, length_m: road.length_m, closed: road.closed }
    }

    /// How many intervals there would be, as a number that may be too great for a computer.
    pub(super) fn intervals(road: &EngineeredRoad) -> f64 {
        // A length that is a multiple of the spacing but for rounding shall not get one interval more.
        (road.length_m / road.knot_spacing_m - 1e-9).ceil().max(if road.closed { 3.0 } else { 1.0 })
    }

    /// How many coefficients there are.
    pub(super) fn coefficients(&self) -> usize {
        if self.closed { self.count } else { self.count + 2 }
    }

    /// How many knots have a grade of their own.
    pub(super) fn knots(&self) -> usize {
        if self.closed { self.count } else { self.count + 1 }
    }

    /// The coefficient that an interval has at first, second or third place.
    pub(super) fn index(&self, interval: usize, place: usize) -> usize {
        if self.closed { (interval + place) % self.count } else { interval + place }
    }

    /// Station of a knot, m.
    pub(super) fn station(&self, knot: usize) -> f64 {
        if knot == self.count { self.length_m } else { knot as f64 * self.step_m }
    }

    /// The interval in which a station lies and how far into it, in intervals.
    fn locate(&self, station_m: f64) -> (usize, f64) {
        let interval = ((station_m / self.step_m).floor().max(0.0) as usize).min(self.count - 1);
        (interval, station_m / self.step_m - interval as f64)
    }

    fn terms(&self, interval: usize, factors: [f64; 3]) -> Terms {
        [0, 1, 2].map(|place| (self.index(interval, place), factors[place]))
    }

    /// The height at a station.
    pub(super) fn height(&self, station_m: f64) -> Terms {
        let (interval, u) = self.locate(station_m);
        self.polar(interval, u, u)
    }

    /// The grade at a station.
    pub(super) fn grade(&self, station_m: f64) -> Terms {
        let (interval, u) = self.locate(station_m);
        self.terms(interval, [u - 1.0, 1.0 - 2.0 * u, u].map(|factor| factor / self.step_m))
    }

    /// The rise from the middle coefficient before a knot to the one after it: the grade at the knot times the step.
    pub(super) fn rise(&self, knot: usize) -> [(usize, f64); 2] {
        [(self.index(knot, 0), -1.0), (self.index(knot, 1), 1.0)]
    }

    /// The second difference of an interval: its bend times the square of the step.
    pub(super) fn bend(&self, interval: usize) -> Terms {
        self.terms(interval, [1.0, -2.0, 1.0])
    }

    /// The polar form of an interval's parabola: for two equal places the height, for two ends of a part of it the Bézier point between their heights.
    fn polar(&self, interval: usize, u: f64, v: f64) -> Terms {
        let (last, both) = (u * v, 0.5 * (u + v));
        self.terms(interval, [0.5 - both + 0.5 * last, 0.5 + both - last, 0.5 * last])
    }

    /// The Bézier points of the curve between two stations, interval by interval.
    pub(super) fn bezier(&self, from_m: f64, to_m: f64) -> Vec<Terms> {
        let ((first, u), (last, v)) = (self.locate(from_m), self.locate(to_m));
        let mut points = vec![self.polar(first, u, u)];
        for interval in first..=last {
            let begin = if interval == first { u } else { 0.0 };
            let end = if interval == last { v } else { 1.0 };
            points.extend([self.polar(interval, begin, end), self.polar(interval, end, end)]);
        }
        points
    }

    /// The mean height over one half of an interval.
    pub(super) fn half_mean(&self, interval: usize, second: bool) -> Terms {
        // Over the first half the mean of u is 1/4 and that of u² is 1/12.
        let first = [7.0 / 24.0, 2.0 / 3.0, 1.0 / 24.0];
        let factors = if second { [first[2], first[1], first[0]] } else { first };
        self.terms(interval, factors)
    }

    /// Where the halves of intervals begin and end, m.
    pub(super) fn half(&self, interval: usize, second: bool) -> [f64; 2] {
        let begin = self.station(interval);
        let (middle, end) = (begin + 0.5 * self.step_m, self.station(interval + 1));
        if second { [middle, end] } else { [begin, middle] }
    }

    /// The curve with these coefficients as a profile with the same heights and grades, which is the same curve.
    pub(super) fn profile(&self, c: &[f64]) -> Result<Profile, ProfileError> {
        let knot = |knot: usize| {
            let (a, b) = (c[self.index(knot, 0)], c[self.index(knot, 1)]);
            Knot { station_m: self.station(knot), height_m: 0.5 * (a + b), grade: (b - a) / self.step_m }
        };
        Profile::new((0..=self.count).map(knot).collect())
    }

    /// Coefficients of a curve that goes along the ground: the mean over the interval around the place of each, so that straight ground is followed exactly.
    pub(super) fn along(&self, ground: &Ground<'_>) -> Vec<f64> {
        let h = self.step_m;
        let mean = |interval: usize| ground.mean([self.station(interval), self.station(interval) + h]);
        let mut c: Vec<f64> = (0..self.count).map(mean).collect();
        if self.closed {
            c.rotate_right(1);
        } else {
            c.insert(0, 2.0 * ground.height(0.0) - c[0]);
            c.push(2.0 * ground.height(self.length_m) - c[self.count]);
        }
        c
    }
}

/// The ground along a road.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<'a>(pub(super) &'a [[f64; 2]]);

impl Ground<'_> {
    /// Its height at a station, m.
    pub(super) fn height(&self, station_m: f64) -> f64 {
        let after = self.0.partition_point(|[station, _]| *station <= station_m);
        match (after.checked_sub(1).map(|i| self.0[i]), self.0.get(after)) {
            (Some([s0, z0]), Some([s1, z1])) => z0 + (z1 - z0) * ((station_m - s0) / (s1 - s0)),
            (Some([_, z]), None) => z,
            (None, Some([_, z])) => *z,
            (None, None) => 0.0,
        }
    }

    /// Its breaks between two stations, and these.
    pub(super) fn breaks(&self, [from_m, to_m]: [f64; 2]) -> impl Iterator<Item = f64> {
        let first = self.0.partition_point(|[station, _]| *station <= from_m);
        let between = self.0[first..].iter().map(|[station, _]| *station).take_while(move |station| *station < to_m);
        std::iter::once(from_m).chain(between).chain([to_m])
    }

    /// Its mean height between two stations, m.
    pub(super) fn mean(&self, range_m: [f64; 2]) -> f64 {
        // Relative to the beginning, so that level ground has its own height to the bit.
        let base = self.height(range_m[0]);
        let (mut area, mut last) = (0.0, [range_m[0], 0.0]);
        for station in self.breaks(range_m) {
            let height = self.height(station) - base;
            area += 0.5 * (station - last[0]) * (height + last[1]);
            last = [station, height];
        }
        base + area / (range_m[1] - range_m[0])
    }
}
