//! Segments and splines as sources for kurbo's curve fitter.

use crate::segment::Segment;
use crate::spline::Spline;
use kurbo::{CurveFitSample, ParamCurveFit, Point, Vec2};
use std::ops::Range;

/// A spline as a source for [`kurbo::fit_to_bezpath`] and its relatives, for callers who want kurbo's fitter, its
/// simplification across joins, or its stroke expansion.
///
/// The parameter is arc length divided by the spline's length. Corners are reported as cusps. kurbo computes with the
/// platform's sine and arctangent, so its results may differ in their last bits between systems and the browser, unlike those of
/// [`Spline::to_bez_path`].
#[derive(Clone, Debug)]
pub struct FitSource<'a> {
    spline: &'a Spline,
    /// Arc length from the spline's start to the start of each segment, and the total.
    stations: Vec<f64>,
}

impl<'a> FitSource<'a> {
    /// The source for a spline.
    #[must_use]
    pub fn new(spline: &'a Spline) -> Self {
        let mut stations = vec![0.0];
        let mut total = 0.0;
        for segment in spline.segments() {
            total += segment.length;
            stations.push(total);
        }
        Self { spline, stations }
    }

    fn total(&self) -> f64 {
        self.stations.last().copied().unwrap_or(0.0)
    }

    /// The segment at parameter `t` and the arc length on it; at a knot the one before if `sign` is negative.
    fn at(&self, t: f64, sign: f64) -> (&Segment, f64) {
        let segments = self.spline.segments();
        let s = t * self.total();
        // Knots reached within rounding count as reached, so that `sign` chooses the side.
        let rounding = 1e-13 * self.total();
        let inner = &self.stations[1..segments.len()];
        let i = if sign < 0.0 {
            inner.partition_point(|&k| k + rounding < s)
        } else {
            inner.partition_point(|&k| k - rounding <= s)
        };
        (&segments[i], (s - self.stations[i]).clamp(0.0, segments[i].length))
    }
}

impl ParamCurveFit for FitSource<'_> {
    fn sample_pt_tangent(&self, t: f64, sign: f64) -> CurveFitSample {
        let (segment, s) = self.at(t, sign);
        CurveFitSample { p: segment.point_at(s), tangent: segment.tangent_at(s) * self.total() }
    }

    fn sample_pt_deriv(&self, t: f64) -> (Point, Vec2) {
        let sample = self.sample_pt_tangent(t, 1.0);
        (sample.p, sample.tangent)
    }

    fn break_cusp(&self, range: Range<f64>) -> Option<f64> {
        let total = self.total();
        let margin = 1e-9;
        self.spline
            .joins()
            .iter()
            .zip(&self.stations[1..])
            .map(|(join, s)| (join, s / total))
            .find(|&(join, t)| {
                *join == crate::spline::Continuity::G0 && t > range.start + margin && t < range.end - margin
            })
            .map(|(_, t)| t)
    }
}
