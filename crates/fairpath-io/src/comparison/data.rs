//! A comparison as the page's script reads it: drawings in page units, figures in the strokes' unit.

use super::summary::{Figures, Profile};
use super::{Comparison, MethodSummary};
use crate::drawable::{Drawable, drawable_points};
use crate::picture::{View, bounds, path_data};
use crate::spline_file::{Failure, SplineEntry};
use crate::unit::YAxis;
use fairpath_curve::{Continuity, Kind, Spline};
use fairpath_fit::Stroke;
use kurbo::{BezPath, Rect};
use serde::Serialize;

/// The longer side of each drawing, page units.
const SIZE: f64 = 1000.0;

/// Teeth of the comb along a line across the drawing.
const TEETH: f64 = 160.0;

/// A change of curvature that shows in the comb, as a share of the largest curvature.
const SEEN: f64 = 0.03;

/// All of it.
#[derive(Serialize)]
pub(super) struct Data<'a> {
    unit: String,
    methods: Vec<Method<'a>>,
    summary: Vec<MethodSummary>,
    strokes: Vec<Drawing<'a>>,
}

#[derive(Serialize)]
struct Method<'a> {
    name: &'a str,
    about: &'a str,
}

/// A stroke with its curves, one for each method.
#[derive(Serialize)]
struct Drawing<'a> {
    name: &'a str,
    /// Width and height.
    size: [f64; 2],
    /// Page units for each unit of the stroke.
    scale: f64,
    /// x, y, x, y, …
    stroke: Vec<f64>,
    curves: Vec<Curve<'a>>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Curve<'a> {
    Fitted(Box<Fitted<'a>>),
    Failed { failure: &'a str },
}

#[derive(Serialize)]
struct Fitted<'a> {
    figures: Figures,
    /// Path data of the lines, the arcs and the clothoids.
    paths: [String; 3],
    /// x, y and 0 to 3 for G0 to G3 of each join.
    joins: Vec<f64>,
    /// Arc length in the stroke's unit, foot x and y, and the vector by which the tip lies off for one unit of scale.
    comb: Vec<f64>,
    /// Arc length and curvature, linear between.
    profile: Vec<f64>,
    of_points: bool,
    warnings: Vec<&'a str>,
}

impl<'a> Data<'a> {
    pub(super) fn of(comparison: &'a Comparison) -> Self {
        let y_up = comparison.strokes.y == YAxis::Up;
        let methods = comparison.methods.iter().map(|m| Method { name: &m.name, about: &m.about }).collect();
        let drawing = |stroke| Drawing::of(stroke, comparison, y_up);
        Self {
            unit: comparison.strokes.unit.to_string(),
            methods,
            summary: comparison.summary(),
            strokes: comparison.strokes.strokes.iter().map(drawing).collect(),
        }
    }
}

impl<'a> Drawing<'a> {
    fn of(stroke: &'a Stroke, comparison: &'a Comparison, y_up: bool) -> Self {
        let results: Vec<_> = comparison.methods.iter().map(|method| method.result(&stroke.name)).collect();
        let mut drawable = Drawable::default();
        let shown: Vec<Option<&Spline>> = results
            .iter()
            .map(|r| r.and_then(Result::ok).map(|e: &SplineEntry| &e.spline).filter(|s| drawable.admits(s)))
            .collect();
        let around = bounds(shown.iter().copied().flatten(), std::iter::once(stroke));
        let longest = around.width().max(around.height());
        let ratio = if longest > 0.0 { SIZE / longest } else { 1.0 };
        let size = [around.width() * ratio, around.height() * ratio];
        let view = View::fit(around, Rect::new(0.0, 0.0, size[0], size[1]), y_up);
        let curve =
            |(result, spline): (Option<Result<&'a SplineEntry, &'a Failure>>, &Option<&Spline>)| match (result, spline)
            {
                (Some(Ok(entry)), Some(spline)) => Curve::Fitted(Box::new(Fitted::of(entry, spline, &view, longest))),
                (Some(Ok(_)), None) => Curve::Failed { failure: "the curve cannot be drawn" },
                (Some(Err(failure)), _) => Curve::Failed { failure: &failure.text },
                (None, _) => Curve::Failed { failure: "not fitted" },
            };
        Self {
            name: &stroke.name,
            size: size.map(tenths),
            scale: view.scale,
            stroke: drawable_points(stroke).map(|p| view.point(p)).flat_map(|p| [tenths(p.x), tenths(p.y)]).collect(),
            curves: results.into_iter().zip(&shown).map(curve).collect(),
        }
    }
}

impl<'a> Fitted<'a> {
    fn of(entry: &'a SplineEntry, spline: &Spline, view: &View, size: f64) -> Self {
        let mut paths = [BezPath::new(), BezPath::new(), BezPath::new()];
        for segment in spline.segments() {
            let kind = match segment.kind() {
                Kind::Line => 0,
                Kind::Arc => 1,
                Kind::Clothoid => 2,
            };
            paths[kind].extend(view.segment(segment));
        }
        let segments = spline.segments();
        let join = |(i, join): (usize, &Continuity)| {
            let at = view.point(segments[(i + 1) % segments.len()].start);
            [tenths(at.x), tenths(at.y), f64::from(*join as u8)]
        };
        let mut s = 0.0;
        let mut comb = Vec::new();
        let mut before = 0;
        let mut last = (f64::NEG_INFINITY, 0.0);
        let sharpest = segments.iter().fold(0.0_f64, |m, s| m.max(s.kappa0.abs()).max(s.kappa1.abs()));
        for tooth in spline.comb(size / TEETH, 1.0) {
            while before < tooth.segment {
                s += segments[before].length;
                before += 1;
            }
            // Every segment has a tooth at both ends, which on short ones stand too densely.
            let jump = (tooth.curvature - last.1).abs() > SEEN * sharpest;
            if s + tooth.s - last.0 < 0.5 * size / TEETH && !jump {
                continue;
            }
            last = (s + tooth.s, tooth.curvature);
            let foot = view.point(tooth.base);
            // Curvature per page unit, along the comb's normal on the page.
            let off = view.direction(tooth.tip - tooth.base) * (1.0 / view.scale);
            comb.extend([rounded(s + tooth.s), tenths(foot.x), tenths(foot.y), rounded(off.x), rounded(off.y)]);
        }
        let profile = Profile::of(spline);
        Self {
            figures: Figures::of(entry),
            paths: paths.map(|path| path_data(&path)),
            joins: spline.joins().iter().enumerate().flat_map(join).collect(),
            comb,
            profile: profile.knots.iter().flatten().map(|&v| rounded(v)).collect(),
            of_points: profile.of_points,
            warnings: entry.warnings.iter().map(|warning| warning.text.as_str()).collect(),
        }
    }
}

/// A page coordinate: less than a ten-thousandth of the drawing cannot be seen.
fn tenths(v: f64) -> f64 {
    (v * 10.0).round() / 10.0
}

/// Six significant digits.
fn rounded(v: f64) -> f64 {
    format!("{v:.5e}").parse().unwrap_or(v)
}
