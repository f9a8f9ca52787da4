//! A stroke on the map as the plan of a path: points in metres come in, a spline of lines, arcs and clothoids goes out (section 3.4.1 of the thesis, which fits in
//! curvature space; here by shortest paths, with a least radius).

use fairpath_curve::{Continuity, Point, Spline};
use fairpath_fit::{Closing, Fit, FitError, FitOptions, OversketchOptions, Stroke, fit};

/// How strokes become plans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SketchScale {
    /// What a pixel of a stroke on paper is on the map, m: tremor of this size is evened out, and a plan may leave its stroke by five of them.
    pub pixel_m: f64,
    /// No bend is tighter, m.
    pub min_radius_m: f64,
}

/// Costs are compared with each other only, so that this one rules corners out: roads have none.
const NO_CORNERS: f64 = 1e12;

impl SketchScale {
    fn options(&self, closed: bool) -> FitOptions {
        FitOptions {
            pixel_size: self.pixel_m,
            closed: if closed { Closing::Yes } else { Closing::No },
            corner_score: NO_CORNERS,
            min_radius: (self.min_radius_m / self.pixel_m).clamp(0.01, 1e4),
            ..FitOptions::default()
        }
    }

    /// The plan of a stroke: without corners, and with curvature that goes on at every join. Where no such curve keeps to the stroke at its scale, because it bends more sharply
    /// than it may, coarser scales are tried.
    ///
    /// # Errors
    /// As [`fairpath_fit::fit`].
    pub fn plan(&self, points: &[Point], closed: bool) -> Result<Fit, FitError> {
        let stroke = Stroke::new("path", self.evened(points));
        let smooth = |fit: &Fit| fit.spline.joins().iter().all(|join| *join >= Continuity::G2);
        let mut scale = *self;
        let mut found = fit(&stroke, &scale.options(closed))?;
        for _ in 0..COARSER_TRIES {
            if smooth(&found) {
                break;
            }
            scale.pixel_m *= COARSER;
            found = fit(&stroke, &scale.options(closed))?;
        }
        Ok(found)
    }

    /// How a stroke is taken that is drawn over a plan.
    #[must_use]
    pub fn oversketching(&self) -> OversketchOptions {
        let default = OversketchOptions::default();
        OversketchOptions {
            // A seam that is no corner.
            seam_corner: 179.0,
            fit: self.options(false),
            ..default
        }
    }

    /// The points at a reasonably even spacing (section 3.4): where they lie far apart, more are put between them on the straight.
    #[must_use]
    pub fn evened(&self, points: &[Point]) -> Vec<Point> {
        let step = EVEN_STEP * self.pixel_m;
        let mut even = Vec::with_capacity(points.len());
        for pair in points.windows(2) {
            even.push(pair[0]);
            let apart = (pair[1] - pair[0]).hypot2().sqrt();
            let between = (apart / step).floor().min(MOST_BETWEEN);
            for i in 1..=between as usize {
                even.push(pair[0].lerp(pair[1], i as f64 / (between + 1.0)));
            }
        }
        even.extend(points.last());
        even
    }
}

/// By how much a scale is coarser that is tried next, and how many are.
const COARSER: f64 = 1.5;
const COARSER_TRIES: usize = 5;

/// Points of a stroke lie no further apart than this, px.
const EVEN_STEP: f64 = 4.0;

/// More are never put between two points.
const MOST_BETWEEN: f64 = 10_000.0;

/// Points along a spline at about this spacing, both ends among them.
#[must_use]
pub(crate) fn points_along(plan: &Spline, from: f64, to: f64, step: f64) -> Vec<Point> {
    let count = ((to - from) / step).ceil().max(1.0) as usize;
    (0..=count).map(|i| plan.point_at(from + (to - from) * i as f64 / count as f64)).collect()
}
