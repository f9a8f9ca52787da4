//! Fitting the new course of the curve: the integrated stroke and how it is held come in, segments in px go out.

use super::integrate::Integrated;
use super::options::OversketchOptions;
use crate::clean::Cleaned;
use crate::conclude::{Parts, distances};
use crate::corners::corners;
use crate::options::FitOptions;
use crate::polyline::Polyline;
use crate::shortest_path::hold::Hold;
use crate::shortest_path::{LONGER, STRAY, closer, fit_track, loosened};
use crate::track::{Track, around, between};
use fairpath_curve::{Point, Segment, Spline, Vec2, trig};

/// Length on both sides from which the angle is told at which the stroke leaves the curve, px.
const LEG: f64 = 12.0;

/// Corners nearer than this to where the stroke leaves the curve are judged by that angle, px.
const SEAM_ZONE: f64 = 14.0;

/// Length over which points near there get back their full weight, px.
const FADE: f64 = 15.0;
const FADE_SHARE: f64 = 0.2;

/// Deviation that is allowed, and that costs nothing, as shares of how far the stroke departs from the old curve; the former at least so much, px.
const TOLERATED: f64 = 0.25;
const FREE: f64 = 0.12;
const LEAST_TOLERANCE: f64 = 1.5;

/// Share of the stroke's length below which a piece is short.
const SHORT: f64 = 0.35;

/// What came of a fit.
pub(super) struct Refit {
    pub(super) parts: Parts,
    /// Largest distance of the stroke's points, and by how much the curve is longer than them; whichever is more, px.
    pub(super) astray: f64,
    /// More of that than was tolerated, px.
    pub(super) is_astray: bool,
    /// Whether joins and deviations had to be allowed that the options forbid.
    pub(super) loosened: bool,
}

/// Fits an open course that is held at its ends, or free there. `attached` tells whether the stroke leaves the curve smoothly at its start and
/// its end; where it does not, there is no old curve or a corner anyway.
pub(super) fn fit_between(
    course: &Integrated,
    held: [Option<Hold>; 2],
    attached: [bool; 2],
    cleaned: &Cleaned,
    options: &OversketchOptions,
) -> Option<Refit> {
    let seams: Vec<f64> = (0..2).filter(|&i| attached[i]).map(|i| course.sketch[i]).collect();
    let bends = bends(course, &seams, false, cleaned.grain, options);
    let near = |s: f64, reach: f64| seams.iter().any(|t| (s - t).abs() <= reach);
    let is_tight = |s: f64| near(s, options.widening);
    let fade = FADE.min(FADE_SHARE * (course.sketch[1] - course.sketch[0]));
    let worth = |s: f64| {
        let away = seams.iter().map(|t| (s - t).abs()).fold(f64::INFINITY, f64::min);
        options.seam_worth + (1.0 - options.seam_worth) * (away / fade).min(1.0)
    };
    let track = |options: &FitOptions, closest: f64| {
        between(&course.line, &bends, held, (closest, &is_tight), &worth, cleaned.grain, options)
    };
    best(|o| track(o, options.seam_sampling), course, cleaned, options)
}

/// Fits a course that closes on itself.
pub(super) fn fit_around(course: &Integrated, cleaned: &Cleaned, options: &OversketchOptions) -> Option<Refit> {
    let bends = bends(course, &course.sketch, true, cleaned.grain, options);
    best(|o| around(&course.line, &bends, cleaned.grain, o), course, cleaned, options)
}

/// The nearest of several attempts: as the options say, closer to the stroke if that strays, looser if there is no curve.
fn best(
    track: impl Fn(&FitOptions) -> Track,
    course: &Integrated,
    cleaned: &Cleaned,
    options: &OversketchOptions,
) -> Option<Refit> {
    // A small correction must not be taken for tremor.
    let own = FitOptions {
        error_cost: options.error_factor * options.fit.error_cost,
        max_error: options.fit.max_error.min((TOLERATED * course.departure).max(LEAST_TOLERANCE)),
        free_error: options.fit.free_error.min(FREE * course.departure),
        short_length: options.fit.short_length.min(SHORT * (course.sketch[1] - course.sketch[0])),
        ..options.fit.clone()
    };
    let limit = STRAY * own.max_error;
    let attempt = |options: &FitOptions, loosened: bool| {
        let (parts, _) = fit_track(&track(options), cleaned, options)?;
        let astray = astray(&parts, &course.line)?;
        Some(Refit { parts, astray, is_astray: astray > limit, loosened })
    };
    let mut found = attempt(&own, false);
    if found.as_ref().is_none_or(|f| f.is_astray) {
        for (options, is_loosened) in [(closer(&own), false), (loosened(&own), true)] {
            let other = attempt(&options, is_loosened);
            let before = found.as_ref().map_or(f64::INFINITY, |f| f.astray);
            if other.as_ref().is_some_and(|o| o.astray < before) {
                found = other;
            }
            if found.as_ref().is_some_and(|f| !f.is_astray) {
                break;
            }
        }
    }
    found
}

/// How far a curve is from its course: in distance, and half of what it is longer, which shows a loop that nobody drew.
fn astray((segments, joins, closed): &Parts, line: &Polyline) -> Option<f64> {
    let spline = Spline::new(segments.clone(), joins.clone(), *closed).ok()?;
    let course: Vec<Point> = line.points.iter().map(|p| p.to_point()).collect();
    let largest = distances(&spline, &course).into_iter().fold(0.0, f64::max);
    Some(largest.max(0.5 * (spline.length() - LONGER * line.length())))
}

/// Arc lengths of the corners of the course: those of the old curve, and those that the stroke brings.
fn bends(course: &Integrated, seams: &[f64], closed: bool, grain: f64, options: &OversketchOptions) -> Vec<f64> {
    let line = &course.line;
    let length = line.length();
    let apart = |a: f64, b: f64| {
        let d = (a - b).abs();
        if closed { d.min(length - d) } else { d }
    };
    let within = |s: f64| s >= course.sketch[0] && s <= course.sketch[1];
    let clear = |s: f64| seams.iter().all(|&t| apart(s, t) > SEAM_ZONE);
    let own = corners(line, closed, grain, &options.fit).into_iter().filter(|&s| within(s) && clear(s));
    let sharp = seams.iter().copied().filter(|&t| angle(line, t, closed) >= options.seam_corner.to_radians());
    let mut all: Vec<f64> = course.corners.iter().copied().chain(sharp).chain(own).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|b, a| *b - *a < 1e-3);
    all
}

/// The angle by which the course turns at an arc length, seen from a little way to both sides, radians.
fn angle(line: &Polyline, s: f64, closed: bool) -> f64 {
    let length = line.length();
    let at = |s: f64| {
        let s = if closed { s.rem_euclid(length) } else { s };
        line.at(s, &mut line.s.partition_point(|&v| v <= s).saturating_sub(1))
    };
    let leg = if closed { LEG } else { LEG.min(s).min(length - s) };
    let (into, out) = (at(s) - at(s - leg), at(s + leg) - at(s));
    trig::angle_of(Vec2::new(into.dot(out), into.cross(out))).abs()
}

/// The segments in another unit: lengths times `scale`, the origin moved to `cleaned`'s.
pub(super) fn restored(segments: &[Segment], cleaned: &Cleaned) -> Vec<Segment> {
    segments.iter().map(|s| crate::conclude::restored(s, cleaned)).collect()
}
