//! A stroke on the map as the plan of a path: points in metres come in, a spline of lines, arcs and clothoids goes out (section 3.4.1 of the thesis, which fits in
//! curvature space; here by shortest paths, with a least radius).

use fairpath_curve::{Continuity, Point, Spline};
use fairpath_fit::{Closing, CurveEnd, Fit, FitError, FitOptions, OversketchOptions, Stroke, Warning, fit, join};

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
    /// than it may, coarser scales are tried; a long stroke with many bends, which no curve follows as a whole, is drawn in parts that are joined where it is straight.
    ///
    /// # Errors
    /// As [`fairpath_fit::fit`].
    pub fn plan(&self, points: &[Point], closed: bool) -> Result<SketchedPlan, FitError> {
        let points = self.evened(points);
        let mut found = self.in_one(&points, closed)?;
        if found.is_astray && !closed {
            let parts = self.in_parts(&points, MOST_HALVINGS).map(|plan| self.judged(plan, &points, Vec::new()));
            found = parts.filter(|parts| parts.farthest_m < found.farthest_m).unwrap_or(found);
        }
        if found.plan.joins().iter().any(|join| *join < Continuity::G2) {
            let text = "no curve whose curvature goes on everywhere keeps to the stroke".to_owned();
            found.warnings.push(Warning { code: "curvature-jumps".into(), text });
        }
        Ok(found)
    }

    /// One fit of the whole.
    fn in_one(&self, points: &[Point], closed: bool) -> Result<SketchedPlan, FitError> {
        let stroke = Stroke::new("path", points.to_vec());
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
        let warnings = found.warnings.into_iter().filter(|w| w.code != FAR).collect();
        Ok(self.judged(found.spline, points, warnings))
    }

    /// Two plans, each of half of a stroke, as one; each of its own halves where it strays. Nothing where they cannot be joined.
    fn in_parts(&self, points: &[Point], halvings: usize) -> Option<Spline> {
        let middle = straightest(points)?;
        let half = |points: &[Point]| {
            let whole = self.in_one(points, false).ok()?;
            let parts = if whole.is_astray && halvings > 1 { self.in_parts(points, halvings - 1) } else { None };
            let parts = parts.map(|plan| self.judged(plan, points, Vec::new()));
            Some(parts.filter(|parts| parts.farthest_m < whole.farthest_m).unwrap_or(whole).plan)
        };
        let (first, second) = (half(&points[..=middle])?, half(&points[middle..])?);
        let most = 1.0 / self.min_radius_m;
        // The shorter the better, as long as it may bend so.
        let over = |reach: f64| {
            let joined = join(&first, CurveEnd::End, &second, CurveEnd::Start, Continuity::G2, reach).ok()?;
            let sharpest = |plan: &Spline| {
                let bends = plan.segments().iter().flat_map(|s| [s.kappa0.abs(), s.kappa1.abs()]);
                bends.fold(0.0, f64::max)
            };
            (sharpest(&joined) <= most.max(sharpest(&first)).max(sharpest(&second)) * (1.0 + 1e-9)).then_some(joined)
        };
        SEAM_PX.iter().find_map(|reach| over(reach * self.pixel_m))
    }

    /// A plan beside its stroke.
    fn judged(&self, plan: Spline, points: &[Point], mut warnings: Vec<Warning>) -> SketchedPlan {
        let farthest_m = points.iter().map(|p| plan.nearest(*p).distance).fold(0.0, f64::max);
        let drawn: f64 = points.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
        let far = FAR_PX * self.pixel_m;
        // A loop that nobody drew shows in its length.
        let is_astray = farthest_m > far || 0.5 * (plan.length() - LONGER * drawn) > far;
        if is_astray {
            let text = format!(
                "the path is up to {farthest_m:.1} m away from the stroke, which is {drawn:.1} m long; the path is {:.1} m",
                plan.length()
            );
            warnings.push(Warning { code: FAR.into(), text });
        }
        SketchedPlan { plan, warnings, farthest_m, is_astray }
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

/// A stroke as the plan of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct SketchedPlan {
    /// The plan, m.
    pub plan: Spline,
    /// What was done differently from what was asked.
    pub warnings: Vec<Warning>,
    /// Largest distance of a point of the stroke from it, m.
    pub farthest_m: f64,
    /// Whether that is more than anybody would accept.
    is_astray: bool,
}

/// Of the points in the middle third of a stroke that about which it is straightest; nothing of a stroke that is too short to be cut.
fn straightest(points: &[Point]) -> Option<usize> {
    let n = points.len();
    if n < LEAST_POINTS {
        return None;
    }
    // How much longer the way along a few points is than straight across.
    let detour = |i: usize| {
        let around = &points[i - ABOUT..=i + ABOUT];
        let along: f64 = around.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
        along / (points[i + ABOUT] - points[i - ABOUT]).hypot2().sqrt().max(1e-9)
    };
    (n / 3..=2 * n / 3).min_by(|a, b| detour(*a).total_cmp(&detour(*b)))
}

/// No stroke of fewer points is cut.
const LEAST_POINTS: usize = 24;

/// So many points on both sides of one tell how straight a stroke is there.
const ABOUT: usize = 4;

/// A stroke is cut into no more than two to the power of this parts.
const MOST_HALVINGS: usize = 6;

/// How far two parts are cut back where they are joined, px.
const SEAM_PX: [f64; 5] = [4.0, 8.0, 16.0, 32.0, 64.0];

/// A plan that is further from its stroke than this strays, px: as a fit itself judges it.
const FAR_PX: f64 = 7.0;

/// A plan may be longer than its stroke by this factor.
const LONGER: f64 = 1.01;

/// The code of the warning that says so.
const FAR: &str = "far-from-stroke";

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
