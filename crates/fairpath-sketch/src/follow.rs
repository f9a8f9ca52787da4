//! Going along a curve: points that follow each other come in, the place of the curve that belongs to each goes out, on the branch of the one before.

use fairpath_curve::{Point, Spline};

/// A place of a curve near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) station: f64,
    pub(crate) distance: f64,
}

/// Someone who goes along a curve.
pub(crate) struct Follower<'a> {
    spline: &'a Spline,
    /// Stations of the segments' starts.
    starts: Vec<f64>,
    length: f64,
    at: Option<f64>,
    /// What a place behind counts as further away, for each unit that it lies behind along the curve: where a stroke comes back over itself, the way on
    /// and the way back are equally near.
    price_of_return: f64,
}

impl<'a> Follower<'a> {
    pub(crate) fn new(spline: &'a Spline, price_of_return: f64) -> Self {
        let mut station = 0.0;
        let starts = spline.segments().iter().map(|segment| {
            let start = station;
            station += segment.length;
            start
        });
        Self { spline, starts: starts.collect(), length: spline.length(), at: None, price_of_return }
    }

    /// The place that belongs to a point: the nearest within `reach` along the curve of where the follower is, if that is no further away than `near` or
    /// not twice as far as the nearest of all; else the nearest of all.
    pub(crate) fn peek(&self, point: Point, reach: f64, near: f64) -> Place {
        let local = match self.at {
            Some(at) => self.within(at, reach, point),
            // Nobody is anywhere yet: who draws an open curve begins at its start, if that is where the point is.
            None if !self.spline.is_closed() => self.within(0.0, reach, point),
            None => None,
        };
        if let Some(place) = local.filter(|place| place.distance <= near) {
            return place;
        }
        let nearest = self.spline.nearest(point);
        let station = self.starts[nearest.segment] + nearest.s;
        let any = Place { station, distance: nearest.distance };
        local.filter(|place| place.distance <= 2.0 * any.distance).unwrap_or(any)
    }

    /// Goes to a station and gives it back.
    pub(crate) fn go_to(&mut self, station: f64) -> f64 {
        self.at = Some(station);
        station
    }

    /// The place nearest to a point within a reach along the curve of a station.
    fn within(&self, at: f64, reach: f64, point: Point) -> Option<Place> {
        let n = self.starts.len();
        let here = self.starts.partition_point(|&start| start <= at).clamp(1, n) - 1;
        let mut best: Option<(f64, Place)> = None;
        let mut look = |i: usize| {
            let segment = &self.spline.segments()[i];
            // No place of a segment is nearer than its start is, less its length: most of a curve of very many segments need not be looked at.
            let bound = (segment.start - point).hypot() - segment.length;
            if best.is_some_and(|(price, _)| bound > price) {
                return;
            }
            for found in segment.nearest_all(point) {
                let station = self.starts[i] + found.s;
                let ahead = self.ahead(station, at);
                let price = found.distance + self.price_of_return * (-ahead).max(0.0);
                if ahead.abs() <= reach && best.is_none_or(|(least, _)| price < least) {
                    best = Some((price, Place { station, distance: found.distance }));
                }
            }
        };
        look(here);
        let closed = self.spline.is_closed();
        // Forward from the end of this segment, and backward from its start, as far as the reach goes.
        let mut gone = self.starts[here] + self.spline.segments()[here].length - at;
        let mut looked = 1;
        for step in 1..n {
            let i = here + step;
            if gone > reach || (i >= n && !closed) {
                break;
            }
            look(i % n);
            gone += self.spline.segments()[i % n].length;
            looked += 1;
        }
        let mut gone = at - self.starts[here];
        for step in 1..=n - looked.min(n) {
            if gone > reach || (step > here && !closed) {
                break;
            }
            let i = (here + n - step) % n;
            look(i);
            gone += self.spline.segments()[i].length;
        }
        best.map(|(_, place)| place)
    }

    /// How far a station lies ahead of another, the shorter way around; negative if behind.
    fn ahead(&self, station: f64, of: f64) -> f64 {
        let straight = station - of;
        if !self.spline.is_closed() || straight.abs() <= 0.5 * self.length {
            straight
        } else {
            straight - self.length.copysign(straight)
        }
    }
}
