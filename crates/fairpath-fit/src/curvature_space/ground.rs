//! What does not depend on the cost of a piece: the stroke prepared, and the places of curvature space along it.

use super::estimate::{Place, curvature};
use super::options::CurvatureSpaceOptions;
use crate::clean::Cleaned;
use crate::options::FitOptions;
use crate::polyline::Polyline;
use crate::track::{Course, Shape, Track, prepare};
use crate::walk::Datum;

/// A stroke with its curvature.
pub(crate) struct Ground {
    pub(crate) track: Track,
    pub(crate) stretches: Vec<Stretch>,
}

/// What lies between two corners or ends, or one turn of a ring.
pub(crate) struct Stretch {
    pub(crate) places: Vec<Place>,
    /// Arc lengths along the track, px.
    pub(crate) span: [f64; 2],
}

impl Ground {
    /// Cleaned points closed, divided at corners and resampled, as for the shortest-path method.
    pub(crate) fn track(cleaned: &Cleaned, shared: &FitOptions) -> Track {
        prepare(cleaned, shared)
    }

    /// Curvature along a track (section 4.1).
    pub(crate) fn of(track: Track, options: &CurvatureSpaceOptions) -> Self {
        let data = &track.all.data;
        let mut is_sample = vec![false; data.len()];
        for &i in &track.all.samples {
            is_sample[i] = true;
        }
        let ring = track.shape == Shape::Ring;
        // Of the turns of a ring, the middle one goes on smoothly at both ends.
        let ends = if ring { [track.turn, 2 * track.turn] } else { [0, track.turn] };
        let inner = (ends[0] + 1..ends[1]).filter(|&i| track.corner[i]);
        let stops: Vec<f64> =
            std::iter::once(ends[0]).chain(inner).chain([ends[1]]).map(|i| track.all.station(i)).collect();
        let line = polyline_of(data);
        let stretches = stops
            .windows(2)
            .map(|s| Stretch {
                places: curvature(data, &line, &is_sample, [s[0], s[1]], ring, options),
                span: [s[0], s[1]],
            })
            .collect();
        Self { track, stretches }
    }

    pub(crate) fn is_ring(&self) -> bool {
        self.track.shape == Shape::Ring
    }

    pub(crate) fn is_closed(&self) -> bool {
        self.track.shape != Shape::Open
    }

    /// Length of the stroke, or of one turn of a ring, px.
    pub(crate) fn length(&self) -> f64 {
        self.track.all.station(self.track.turn)
    }
}

/// The points of `course`, which is one of the track's, from arc length `from` on: all, or those of one turn of a ring, of which the last is
/// the first once more.
pub(crate) fn run<'a>(track: &Track, course: &'a Course, from: f64) -> &'a [Datum] {
    let count = course.samples[track.turn] - course.samples[0];
    let mut first = course.data.partition_point(|d| d.s < from - 1e-9);
    // The turns of a ring are alike.
    while first + count >= course.data.len() && first >= count {
        first -= count;
    }
    &course.data[first..=first + count]
}

/// All of `data` as a polyline by the arc lengths that they have.
pub(crate) fn polyline_of(data: &[Datum]) -> Polyline {
    Polyline { points: data.iter().map(|d| d.point).collect(), s: data.iter().map(|d| d.s).collect() }
}
