//! Many places along one plan: where each of its segments begins is added up once, so that a station is found by bisection.

use fairpath_curve::{Point, Spline};

/// A plan with the stations of its segments.
pub(crate) struct Course<'a> {
    plan: &'a Spline,
    /// Where each segment begins, m.
    starts: Vec<f64>,
}

impl<'a> Course<'a> {
    pub(crate) fn new(plan: &'a Spline) -> Self {
        let starts = plan.segments().iter().scan(0.0, |before, segment| {
            let start = *before;
            *before += segment.length;
            Some(start)
        });
        Self { plan, starts: starts.collect() }
    }

    /// The segment on which a station lies, and how far from its start, m. What lies beyond an end counts as the end.
    pub(crate) fn locate(&self, station: f64) -> (usize, f64) {
        let segment = self.starts.partition_point(|start| *start <= station).max(1) - 1;
        (segment, (station - self.starts[segment]).clamp(0.0, self.plan.segments()[segment].length))
    }

    /// The position at a station.
    pub(crate) fn point_at(&self, station: f64) -> Point {
        let (segment, s) = self.locate(station);
        self.plan.segments()[segment].point_at(s)
    }
}
