//! Correcting a curve by drawing over it (section 3.7 of Baran, Lehtinen and Popović 2010; section 6 of McCrae and Singh 2008): a spline and a
//! stroke come in, the spline with the stroke in it goes out.

mod blend;
mod error;
mod integrate;
mod options;
mod refit;
mod region;
mod widen;

pub use error::OversketchError;
pub use options::{OversketchMode, OversketchOptions};

use crate::clean::{Cleaned, clean};
use crate::conclude::{describe, distances};
use crate::options::{Closing, FitOptions};
use crate::polyline::Polyline;
use crate::result::{Fit, FitError, Report, Warning};
use crate::shortest_path::STRAY;
use crate::shortest_path::chain::Pin;
use crate::shortest_path::hold::Hold;
use crate::splice::{Rest, Run};
use crate::stroke::Stroke;
use fairpath_curve::{Continuity, Point, Pose, Segment, Similarity, Spline, Vec2};
use integrate::{Integrated, attached, integrated};
use refit::{Refit, fit_around, fit_between};
use region::{Replaced, replaced};
use std::ops::Range;
use widen::{Refitted, Seam, widened};

/// What a stroke would replace of a curve: enough for a preview while it is drawn. Stations are arc lengths of the curve, in its unit; on a
/// closed curve they run on through its start, so that they may be negative or exceed its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OversketchRegion {
    /// Where the stroke leaves the curve and joins it again. The first exceeds the second a little where the stroke makes a loop.
    pub replaced: [f64; 2],
    /// What is fitted anew: outside, the curve stays as it is.
    pub refitted: [f64; 2],
    /// Whether the stroke runs against the curve.
    pub backward: bool,
    /// Whether the stroke is tied to the curve there; else its end becomes the curve's.
    pub attached: [bool; 2],
    /// Whether all of a closed curve is fitted anew.
    pub whole: bool,
}

/// A corrected curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Oversketched {
    /// The curve with the stroke in it. It runs in the direction of the old one, and a closed one begins where that began, if that place stays.
    pub spline: Spline,
    /// Which of its segments are new. All others are those of the old curve to the bit, but for one at each seam that may have been cut.
    pub new: Range<usize>,
    /// What was replaced of the old curve.
    pub region: OversketchRegion,
    /// The stroke, its ends moved onto the curve, with points of the old curve that is fitted anew beside it (figure 8, middle).
    pub integrated: Vec<Point>,
    /// Figures about the new part, measured against those points.
    pub report: Report,
    /// What was done differently from what the options ask.
    pub warnings: Vec<Warning>,
}

/// What a stroke would replace of a curve, without fitting anything: fast enough to be asked for with every point that is drawn.
///
/// # Errors
/// As [`oversketch`], as far as they show without fitting.
pub fn oversketch_region(
    spline: &Spline,
    stroke: &Stroke,
    options: &OversketchOptions,
) -> Result<OversketchRegion, OversketchError> {
    Ok(Scene::new(spline, stroke, options)?.region(spline))
}

/// Replaces the part of a curve that a stroke was drawn over (section 3.7 of Baran et al. 2010), in the curve's unit and frame.
///
/// Both ends of the stroke are projected to the curve; between these places it is replaced. On a closed curve that is the shorter of the two
/// ways around, unless the stroke clearly follows the longer one. If only one end of the stroke is near an open curve, it is replaced
/// up to its end on the side to which the stroke runs, and so extended if it begins there. The stroke may be drawn in either direction.
///
/// The new part meets what stays with the continuity that the old curve has there: G2 within a segment and at a G2 join, a corner at a corner
/// (less, where the options allow no kind of segment that could). All else stays: segments and joins outside `new` are those of
/// `spline` to the bit; of a segment that is cut, the part before the cut keeps start, heading and first curvature, that after it its last
/// curvature. An end of an open curve that was not drawn over stays where it is.
///
/// # Errors
/// When neither end of the stroke is near the curve, one end leads away from a closed curve, the stroke is a dot or has coordinates that are not
/// finite, an option is out of range, or no curve was found.
pub fn oversketch(
    spline: &Spline,
    stroke: &Stroke,
    options: &OversketchOptions,
) -> Result<Oversketched, OversketchError> {
    oversketch_by(spline, stroke, options, None)
}

/// Fits a stroke by any method.
pub type FitBy<'a> = dyn Fn(&Stroke) -> Result<Fit, FitError> + 'a;

/// As [`oversketch`]; where a stroke is fitted as a whole, which the modes `refit` and `local-blend` do, it is done by `fit`, if given.
///
/// # Errors
/// As [`oversketch`], and when `fit` fails.
pub fn oversketch_by(
    spline: &Spline,
    stroke: &Stroke,
    options: &OversketchOptions,
    fit: Option<&FitBy>,
) -> Result<Oversketched, OversketchError> {
    let scene = Scene::new(spline, stroke, options)?;
    let mut warnings = Vec::new();
    let result = match (options.mode, scene.refitted) {
        (OversketchMode::Refit, _) => scene.refit_all(spline, fit, &mut warnings),
        (OversketchMode::LocalBlend, Refitted::Between(seams)) => scene.blend(spline, &seams, fit, &mut warnings),
        (OversketchMode::ShortestPath, Refitted::Between(seams)) => scene.refit_or_blend(spline, &seams, &mut warnings),
        (_, Refitted::All) => scene.refit_all(spline, None, &mut warnings),
    };
    let Some(Made { spline: made, new, course }) = result else {
        return Err(FitError::Unfittable { points: stroke.points.len() }.into());
    };
    let integrated: Vec<Point> = course.iter().map(|p| scene.cleaned.restore(*p)).collect();
    let report = figures(&made, &new, &integrated, options.fit.pixel_size);
    if report.max_deviation > STRAY * options.fit.max_error * options.fit.pixel_size {
        warnings.push(Warning {
            code: "far-from-stroke".into(),
            text: format!("the curve is up to {:.3} away from what was drawn", report.max_deviation),
        });
    }
    let region = scene.region(spline);
    Ok(Oversketched { spline: made, new, region, integrated, report, warnings })
}

/// Figures about the new segments of a spline and the one beside them on each side, which may have taken over a part of what they were fitted to,
/// measured against those points.
fn figures(spline: &Spline, new: &Range<usize>, integrated: &[Point], pixel_size: f64) -> Report {
    let mut report = Report { points: integrated.len(), ..Report::default() };
    let whole = new.len() == spline.segments().len();
    let part = if whole {
        Some(spline.clone())
    } else {
        let n = spline.segments().len();
        let before = usize::from(spline.is_closed() || new.start > 0);
        let after = usize::from(spline.is_closed() || new.end < n);
        let count = (before + new.len() + after).min(n);
        let begin = new.start + n - before;
        let segments = (0..count).map(|i| spline.segments()[(begin + i) % n]).collect();
        let joins = (0..count - 1).map(|i| spline.joins()[(begin + i) % n]).collect();
        Spline::new(segments, joins, false).ok()
    };
    if let Some(part) = part {
        describe(&mut report, &part, &Stroke::new("", integrated.to_vec()), pixel_size);
    }
    report
}

/// A curve, a stroke over it and what that means, in px about a local origin.
struct Scene<'a> {
    options: &'a OversketchOptions,
    cleaned: Cleaned,
    curve: Spline,
    sketch: Polyline,
    replaced: Replaced,
    refitted: Refitted,
}

/// A corrected curve in its own unit, its new segments, and the points that these were fitted to, px.
struct Made {
    spline: Spline,
    new: Range<usize>,
    course: Vec<Vec2>,
}

impl Made {
    /// The largest distance of the points from the curve, px.
    fn farthest(&self, cleaned: &Cleaned) -> f64 {
        let course: Vec<Point> = self.course.iter().map(|p| cleaned.restore(*p)).collect();
        distances(&self.spline, &course).into_iter().map(|away| away / cleaned.scale).fold(0.0, f64::max)
    }
}

impl<'a> Scene<'a> {
    fn new(spline: &Spline, stroke: &Stroke, options: &'a OversketchOptions) -> Result<Self, OversketchError> {
        options.validate()?;
        let cleaned = clean(&stroke.points, options.fit.pixel_size)?;
        let scale = 1.0 / cleaned.scale;
        let translation = cleaned.origin.to_vec2() * -scale;
        let curve = spline.transformed(&Similarity { scale, translation, ..Similarity::IDENTITY });
        let sketch = Polyline::new(cleaned.points.clone());
        let replaced = replaced(&curve, &sketch, options)?;
        let refitted = widened(&curve, &replaced, sketch.length(), options);
        Ok(Self { options, cleaned, curve, sketch, replaced, refitted })
    }

    fn region(&self, spline: &Spline) -> OversketchRegion {
        let size = self.cleaned.scale;
        let Replaced { from, to, backward, attached } = self.replaced;
        let whole = self.refitted == Refitted::All;
        let refitted = match self.refitted {
            Refitted::Between(seams) => seams.map(|s| s.station() * size),
            Refitted::All => [from * size, from * size + spline.length()],
        };
        OversketchRegion { replaced: [from * size, to * size], refitted, backward, attached, whole }
    }

    /// The sketch in the direction of the curve, attached to it.
    fn sketch(&self) -> Vec<Vec2> {
        attached(&self.curve, &self.sketch, &self.replaced, self.options.attenuation)
    }

    /// The method of section 3.7, how far its curve is from what was drawn if that is more than was tolerated, px, and what to say about it.
    fn refit(&self, spline: &Spline, seams: &[Seam; 2]) -> Option<(Made, Option<f64>, Option<Warning>)> {
        let course = integrated(&self.curve, &self.sketch(), &self.replaced, seams.map(|s| s.station()));
        let rest = Rest::of(spline, seams.map(|s| s.place(self.cleaned.scale)));
        let holds = self.holds(&rest, seams);
        // Where the sketch begins at a corner or at the curve's end, there is nothing to leave smoothly.
        let smooth = [0, 1].map(|i| (course.sketch[i] - [0.0, course.line.length()][i]).abs() > 1e-3);
        let Refit { parts: (segments, joins, _), loosened, astray, is_astray } =
            fit_between(&course, holds, smooth, &self.cleaned, self.options)?;
        let new = Run { segments: refit::restored(&segments, &self.cleaned), joins };
        let made = self.spliced(rest, new, holds, course.line.points)?;
        let note = loosened.then(|| Warning {
            code: "loosened".into(),
            text: "no curve keeps to the options everywhere; joins and deviations were allowed that they forbid".into(),
        });
        Some((made, is_astray.then_some(astray), note))
    }

    /// The method of section 3.7, or where that finds nothing near, the stroke blended in.
    fn refit_or_blend(&self, spline: &Spline, seams: &[Seam; 2], warnings: &mut Vec<Warning>) -> Option<Made> {
        let (refitted, astray, note) = match self.refit(spline, seams) {
            Some((made, astray, note)) => (Some(made), astray, note),
            None => (None, Some(f64::INFINITY), None),
        };
        if let Some(astray) = astray
            && let Some(blended) = self.blend(spline, seams, None, &mut Vec::new())
            && blended.farthest(&self.cleaned) < MUCH_NEARER * astray
        {
            warnings.push(Warning {
                code: "blended".into(),
                text: "no fair curve near the stroke meets what stays on both sides; the stroke was fitted by itself and blended in".into(),
            });
            return Some(blended);
        }
        warnings.extend(note);
        refitted
    }

    /// How the new part is held at its ends by what stays.
    fn holds(&self, rest: &Rest, seams: &[Seam; 2]) -> [Option<Hold>; 2] {
        let neighbours = rest.neighbours();
        [0, 1].map(|side| {
            let to_px = |pose: Pose| {
                let p = (pose.point - self.cleaned.origin) / self.cleaned.scale;
                [p.x, p.y, pose.heading, pose.curvature * self.cleaned.scale]
            };
            match (&seams[side], neighbours[side]) {
                (Seam::Place { .. }, Some(segment)) => {
                    let pose = to_px(if side == 0 { segment.end_pose() } else { segment.start_pose() });
                    let count = possible(rest.joins[side], &self.options.fit) as usize + 2;
                    Some(Hold { pin: Pin { pose, count }, sign: sign(&rest.outward(side), side) })
                }
                (Seam::CurveEnd { station }, _) => {
                    let pose = self.curve.pose_at(*station);
                    let pose = [pose.point.x, pose.point.y, pose.heading, pose.curvature];
                    Some(Hold { pin: Pin { pose, count: 2 }, sign: 0 })
                }
                _ => None,
            }
        })
    }

    /// What stays with the new part between.
    fn spliced(&self, mut rest: Rest, mut new: Run, holds: [Option<Hold>; 2], course: Vec<Vec2>) -> Option<Made> {
        let [before, after] = rest.neighbours();
        chain(&mut new.segments, before, after, holds);
        let level = |hold: Option<Hold>| match hold.map_or(2, |h| h.pin.count) {
            4 => Continuity::G2,
            3 => Continuity::G1,
            _ => Continuity::G0,
        };
        let mut joins = holds.map(level);
        rest.absorb(&mut new, &mut joins);
        let (spline, new) = rest.with(new, joins).ok()?;
        Some(Made { spline, new, course })
    }

    /// The stroke by itself, joined to what stays by clothoids.
    fn blend(
        &self,
        spline: &Spline,
        seams: &[Seam; 2],
        fit: Option<&FitBy>,
        warnings: &mut Vec<Warning>,
    ) -> Option<Made> {
        let sketch = self.sketch();
        let rest = Rest::of(spline, seams.map(|s| s.place(self.cleaned.scale)));
        let holds = self.holds(&rest, seams);
        let own = self.fitted(&sketch, Closing::No, fit, warnings)?;
        let inner = [self.replaced.from, self.replaced.to];
        let poses = [0, 1].map(|side| {
            let hold = holds[side]?;
            let place = self.to_unit(self.curve.pose_at(seams[side].station()));
            // Beyond a corner, or an end that stays, the old curve tells the direction, or the stroke if it begins there.
            let at_once = (inner[side] - seams[side].station()).abs() < 1e-6;
            let stroke = own.pose_at([0.0, own.length()][side]);
            Some(match (hold.pin.count, at_once, rest.neighbours()[side]) {
                (4, _, Some(segment)) => {
                    if side == 0 {
                        segment.end_pose()
                    } else {
                        segment.start_pose()
                    }
                }
                (_, true, _) => Pose { point: place.point, ..stroke },
                _ => self.inner_pose(seams[side].station(), side),
            })
        });
        let new = blend::blended(&own, poses)?;
        let course = integrated(&self.curve, &sketch, &self.replaced, seams.map(|s| s.station())).line.points;
        let smoothly = [0, 1].map(|side| {
            holds[side].map(|mut hold| {
                // What is no G2 seam is met in position only.
                hold.pin.count = if hold.pin.count == 4 { 4 } else { 2 };
                hold
            })
        });
        self.spliced(rest, new, smoothly, course)
    }

    /// The pose of the old curve just inside a seam, in its unit.
    fn inner_pose(&self, station: f64, side: usize) -> Pose {
        let a_little = [1e-6, -1e-6][side];
        let pose = self.curve.pose_at(station + a_little);
        self.to_unit(Pose { point: self.curve.point_at(station), ..pose })
    }

    fn to_unit(&self, pose: Pose) -> Pose {
        let point = self.cleaned.restore(pose.point.to_vec2());
        Pose { point, curvature: pose.curvature / self.cleaned.scale, ..pose }
    }

    /// The old curve with the stroke in it, fitted as a whole.
    fn refit_all(&self, spline: &Spline, fit: Option<&FitBy>, warnings: &mut Vec<Warning>) -> Option<Made> {
        let Replaced { from, to, .. } = self.replaced;
        let closed = spline.is_closed();
        let ends = if closed { [from, from + self.curve.length()] } else { [0.0, self.curve.length()] };
        let ends = [0, 1].map(|i| if self.replaced.attached[i] { ends[i] } else { [from, to][i] });
        let course = integrated(&self.curve, &self.sketch(), &self.replaced, ends);
        let made = |made: Spline| {
            let new = 0..made.segments().len();
            Made { spline: made, new, course: course.line.points.clone() }
        };
        if fit.is_some() {
            let closing = if closed { Closing::Yes } else { Closing::No };
            return self.fitted(&course.line.points, closing, fit, warnings).map(made);
        }
        let refit = if closed {
            fit_around(&closed_up(&course), &self.cleaned, self.options)
        } else {
            fit_between(&course, [None; 2], self.replaced.attached, &self.cleaned, self.options)
        };
        let (segments, joins, closed) = refit?.parts;
        Spline::new(refit::restored(&segments, &self.cleaned), joins, closed).ok().map(made)
    }

    /// A stroke in px fitted by itself, in the curve's unit.
    fn fitted(
        &self,
        points: &[Vec2],
        closed: Closing,
        fit: Option<&FitBy>,
        warnings: &mut Vec<Warning>,
    ) -> Option<Spline> {
        let stroke = Stroke::new("oversketch", points.iter().map(|p| self.cleaned.restore(*p)).collect());
        let own = |stroke: &Stroke| {
            let error_cost = self.options.error_factor * self.options.fit.error_cost;
            crate::fit(stroke, &FitOptions { error_cost, closed, ..self.options.fit.clone() })
        };
        let fit = fit.map_or_else(|| own(&stroke), |by| by(&stroke)).ok()?;
        warnings.extend(fit.warnings);
        Some(fit.spline)
    }
}

/// A blend is taken for what shortest paths found if it is at most this share of its distance from what was drawn.
const MUCH_NEARER: f64 = 0.6;

/// A course around a closed curve with its first point once more at the end.
fn closed_up(course: &Integrated) -> Integrated {
    let mut points = course.line.points.clone();
    if points.len() > 1 && (points[0] - points[points.len() - 1]).hypot2() > 1e-6 {
        points.push(points[0]);
    }
    Integrated { line: Polyline::new(points), ..course.clone() }
}

/// The smoothest join that the options can make, where the old curve has `level`.
fn possible(level: Continuity, options: &FitOptions) -> Continuity {
    let most = if options.clothoid_cost.is_some() {
        Continuity::G2
    } else if options.arc_cost.is_some() {
        Continuity::G1
    } else {
        Continuity::G0
    };
    level.min(most)
}

/// The sign with which curvature comes to a seam: of the nearest place outward that has one, up to a corner.
fn sign(outward: &[(Segment, Option<Continuity>)], side: usize) -> i8 {
    for (segment, join) in outward {
        let mut ends = [segment.kappa1, segment.kappa0];
        if side == 1 {
            ends.reverse();
        }
        if let Some(kappa) = ends.into_iter().find(|k| k.abs() * segment.length > FLAT) {
            return if kappa > 0.0 { 1 } else { -1 };
        }
        if join.is_none_or(|j| j < Continuity::G2) {
            break;
        }
    }
    0
}

/// Turning of a segment that has no sign, radians.
const FLAT: f64 = 1e-9;

/// Chains the new segments to each other and to the bits of what they follow: moving them into the curve's unit rounds.
fn chain(new: &mut [Segment], before: Option<&Segment>, after: Option<&Segment>, holds: [Option<Hold>; 2]) {
    let mut start = before.map(Segment::end);
    for segment in new.iter_mut() {
        if let Some(point) = start {
            segment.start = point;
        }
        start = Some(segment.end());
    }
    let smooth = holds.map(|hold| hold.is_some_and(|h| h.pin.count == 4));
    let (n, is_clothoid) = (new.len(), |s: &Segment| s.kappa0 != s.kappa1);
    if let (true, Some(before)) = (smooth[0] && is_clothoid(&new[0]), before) {
        new[0].kappa0 = before.kappa1;
    }
    if let (true, Some(after)) = (smooth[1] && is_clothoid(&new[n - 1]), after) {
        new[n - 1].kappa1 = after.kappa0;
    }
}
