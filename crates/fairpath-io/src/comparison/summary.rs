//! How methods compare in figures.

use super::Comparison;
use crate::spline_file::SplineEntry;
use fairpath_curve::{Continuity, Spline, trig};
use serde::Serialize;

/// The figures of a method over all strokes that it fitted. Distances are in the strokes' unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodSummary {
    /// The method's name.
    pub name: String,
    /// Strokes that it fitted.
    pub fitted: usize,
    /// Strokes that it did not.
    pub failed: usize,
    /// Pieces as it counts them itself, in the mean.
    pub pieces_mean: f64,
    /// Segments in the mean.
    pub segments_mean: f64,
    /// Joins without a common heading, all together.
    pub corners: usize,
    /// Joins at which curvature jumps, corners not counted, all together.
    pub curvature_jumps: usize,
    /// Changes of the sign of curvature, all together.
    pub inflections: usize,
    /// Root mean square distance, in the mean of the strokes.
    pub rms_mean: f64,
    /// Largest distance of all.
    pub max_deviation: f64,
    /// How much curvature varies: `∫ κ′² ds` times the cube of the length, which does not depend on the size; the median of the strokes.
    pub variation_median: f64,
    /// Time for a stroke, milliseconds, if it was taken: the median.
    pub ms_median: Option<f64>,
    /// On how many strokes it is best, alone or with others: in pieces, inflections, rms distance, variation of curvature.
    pub best: Wins,
}

/// On how many strokes a method is best, alone or with others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Wins {
    /// Fewest pieces.
    pub pieces: usize,
    /// Fewest inflections.
    pub inflections: usize,
    /// Least root mean square distance.
    pub rms: usize,
    /// Least variation of curvature.
    pub variation: usize,
}

/// The figures of one curve.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Figures {
    pub(super) pieces: usize,
    pub(super) segments: usize,
    pub(super) corners: usize,
    pub(super) curvature_jumps: usize,
    pub(super) inflections: usize,
    pub(super) rms: f64,
    pub(super) max: f64,
    pub(super) variation: f64,
    pub(super) ms: Option<f64>,
}

impl Figures {
    pub(super) fn of(entry: &SplineEntry) -> Self {
        let profile = Profile::of(&entry.spline);
        let report = entry.report.clone().unwrap_or_default();
        let joins = |wanted: Continuity| entry.spline.joins().iter().filter(|&&join| join == wanted).count();
        Self {
            pieces: report.figures.pieces,
            segments: entry.spline.segments().len(),
            corners: joins(Continuity::G0),
            curvature_jumps: joins(Continuity::G1),
            inflections: if profile.of_points { profile.sign_changes() } else { report.figures.inflections },
            rms: report.figures.rms_deviation,
            max: report.figures.max_deviation,
            variation: profile.variation(),
            ms: report.ms.map(|ms| ms.total),
        }
    }
}

/// Curvature along a curve.
pub(super) struct Profile {
    /// Arc length and curvature where curvature bends or jumps; linear between.
    pub(super) knots: Vec<[f64; 2]>,
    /// Whether it is estimated from points, since the curve is a polyline.
    pub(super) of_points: bool,
    length: f64,
}

/// A chain of so many lines with corners between is no curve with corners but a polyline.
const POLYLINE: usize = 12;

impl Profile {
    pub(super) fn of(spline: &Spline) -> Self {
        let segments = spline.segments();
        let edges = segments
            .iter()
            .zip(spline.joins())
            .filter(|(s, join)| s.absolute_turning() == 0.0 && **join == Continuity::G0);
        let of_points = segments.len() > POLYLINE && 10 * edges.count() > 9 * segments.len();
        let mut knots = Vec::new();
        let mut s = 0.0;
        for (i, segment) in segments.iter().enumerate() {
            if of_points {
                // The turn at a vertex falls to half of both edges.
                let before =
                    if i > 0 { Some(&segments[i - 1]) } else { segments.last().filter(|_| spline.is_closed()) };
                if let Some(before) = before {
                    let turn = trig::wrap_angle(segment.heading - before.end_heading());
                    let kappa = 2.0 * turn / (before.length + segment.length);
                    // A corner is none of the smoothing.
                    knots.push([s, if turn.abs() < CORNER { kappa } else { 0.0 }]);
                }
            } else {
                knots.push([s, segment.kappa0]);
                knots.push([s + segment.length, segment.kappa1]);
            }
            s += segment.length;
        }
        Self { knots, of_points, length: s }
    }

    fn sign_changes(&self) -> usize {
        let mut sign = 0.0;
        let mut count = 0;
        for kappa in self.knots.iter().map(|k| k[1]).filter(|k| k.abs() * self.length > FLAT) {
            count += usize::from(sign * kappa < 0.0);
            sign = kappa;
        }
        count
    }

    /// `∫ κ′² ds` times the cube of the length. Jumps of curvature, for which it would be infinite, are counted elsewhere.
    fn variation(&self) -> f64 {
        let pieces = self.knots.windows(2).filter(|k| k[1][0] > k[0][0]);
        let sum: f64 = pieces.map(|k| (k[1][1] - k[0][1]).powi(2) / (k[1][0] - k[0][0])).sum();
        sum * self.length.powi(3)
    }
}

/// Turns of this and more are corners, radians.
const CORNER: f64 = 0.7;

/// Curvature that turns less than this over the whole length has no sign, radians.
const FLAT: f64 = 1e-6;

/// The figures of all methods.
pub(super) fn of(comparison: &Comparison) -> Vec<MethodSummary> {
    let rows: Vec<Vec<Option<Figures>>> = comparison
        .methods
        .iter()
        .map(|method| {
            let of = |name: &str| method.result(name).and_then(Result::ok).map(Figures::of);
            comparison.strokes.strokes.iter().map(|stroke| of(&stroke.name)).collect()
        })
        .collect();
    let method = |i: usize| summary(&comparison.methods[i].name, &rows[i], |f, k| is_best(&rows, k, f));
    (0..rows.len()).map(method).collect()
}

/// A figure of which less is better.
type Figure = fn(&Figures) -> f64;

const FIGURES: [Figure; 4] = [|f| f.pieces as f64, |f| f.inflections as f64, |f| f.rms, |f| f.variation];

/// For each of [`FIGURES`] whether no method is better at stroke `k`.
fn is_best(rows: &[Vec<Option<Figures>>], k: usize, own: &Figures) -> [bool; 4] {
    FIGURES.map(|figure| rows.iter().filter_map(|row| row[k].as_ref()).all(|other| figure(own) <= figure(other)))
}

fn summary(name: &str, rows: &[Option<Figures>], is_best: impl Fn(&Figures, usize) -> [bool; 4]) -> MethodSummary {
    let fitted: Vec<&Figures> = rows.iter().flatten().collect();
    let mean = |figure: Figure| fitted.iter().map(|f| figure(f)).sum::<f64>() / fitted.len().max(1) as f64;
    let count = |figure: fn(&Figures) -> usize| fitted.iter().map(|f| figure(f)).sum();
    let times: Option<Vec<f64>> = fitted.iter().map(|f| f.ms).collect();
    let mut wins = [0; 4];
    for (k, figures) in rows.iter().enumerate() {
        let Some(figures) = figures else { continue };
        for (wins, best) in wins.iter_mut().zip(is_best(figures, k)) {
            *wins += usize::from(best);
        }
    }
    let [pieces, inflections, rms, variation] = wins;
    MethodSummary {
        name: name.into(),
        fitted: fitted.len(),
        failed: rows.len() - fitted.len(),
        pieces_mean: mean(|f| f.pieces as f64),
        segments_mean: mean(|f| f.segments as f64),
        corners: count(|f| f.corners),
        curvature_jumps: count(|f| f.curvature_jumps),
        inflections: count(|f| f.inflections),
        rms_mean: mean(|f| f.rms),
        max_deviation: fitted.iter().map(|f| f.max).fold(0.0, f64::max),
        variation_median: median(fitted.iter().map(|f| f.variation).collect()).unwrap_or(0.0),
        ms_median: times.and_then(median),
        best: Wins { pieces, inflections, rms, variation },
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
