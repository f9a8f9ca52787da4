//! The steps of the shortest-path method as figure 4 of Baran, Lehtinen and Popović (2010) shows them, one picture each.

use super::PictureOptions;
use super::drawing::{Pen, bounds, page_for, thinned};
use super::page::{Page, Picture, View, colour, colour_of};
use crate::drawable::{Drawable, drawable_points};
use crate::unit::YAxis;
use fairpath_curve::{Kind, Spline};
use fairpath_fit::{Candidate, Stages, Stroke};

/// Most candidates in a picture; of more, every second, third, … is shown.
const MAX_CANDIDATES: usize = 6000;

/// A picture of one step of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct StagePicture {
    /// Its letter in order; for the shortest-path method the one that figure 4 of its paper gives it: a, b, c, e or f (d, the graph, has no
    /// picture of its own).
    pub letter: char,
    /// A word for file names, such as `stroke`, `candidates` or `result`.
    pub name: &'static str,
    /// The picture. All drawings of one stroke have the same frame.
    pub picture: Picture,
}

/// The five pictures of a fit: a) the stroke, b) the samples with corners marked, c) all candidates, e) the chosen ones before they are
/// merged, f) the result.
///
/// Colours and marks are those of [`draw_splines`](super::draw_splines); `options.size_px` and `options.joins` count.
#[must_use]
pub fn draw_stages(
    stroke: &Stroke,
    stages: &Stages,
    spline: &Spline,
    y: YAxis,
    options: &PictureOptions,
) -> Vec<StagePicture> {
    let shown = Some(spline).filter(|s| Drawable::default().admits(s));
    let frame = bounds(shown.into_iter(), std::iter::once(stroke));
    let pen = Pen::for_size(options.size_px);
    let draw = |letter, name, content: &dyn Fn(&mut Page, &View)| {
        let (mut page, view) = page_for(frame, options.size_px, y == YAxis::Up);
        content(&mut page, &view);
        StagePicture { letter, name, picture: page.finish() }
    };
    vec![
        draw('a', "stroke", &|page, view| input(page, view, pen, stroke)),
        draw('b', "samples", &|page, view| {
            pen.ghost(page, view, stroke);
            samples(page, view, pen, stages);
        }),
        draw('c', "candidates", &|page, view| candidates(page, view, pen, stages)),
        draw('e', "path", &|page, view| {
            pen.ghost(page, view, stroke);
            path(page, view, pen, stages);
        }),
        draw('f', "result", &|page, view| {
            pen.ghost(page, view, stroke);
            if let Some(spline) = shown {
                pen.spline(page, view, spline);
                if options.joins {
                    pen.marks(page, view, spline);
                }
            }
        }),
    ]
}

pub(super) fn input(page: &mut Page, view: &View, pen: Pen, stroke: &Stroke) {
    let points = || thinned(drawable_points(stroke).map(|p| view.point(p)));
    let width = 1.6 * pen.unit;
    page.polyline(points(), format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.2}\"", colour::STROKE));
    page.dots(points(), 2.2 * pen.unit, format_args!("stroke=\"{}\"", colour::STROKE));
}

fn samples(page: &mut Page, view: &View, pen: Pen, stages: &Stages) {
    let points = || stages.samples.iter().map(|p| view.point(*p));
    let width = 0.9 * pen.unit;
    page.polyline(points(), format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.2}\"", colour::SAMPLE));
    page.open(format_args!("fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::SAMPLE, 1.2 * pen.unit));
    for p in points() {
        page.circle(p, 2.8 * pen.unit, format_args!(""));
    }
    page.close();
    for corner in stages.corners.iter().filter_map(|&i| stages.samples.get(i)) {
        page.square(view.point(*corner), 4.5 * pen.unit, format_args!("fill=\"{}\"", colour::LINE));
    }
}

fn candidates(page: &mut Page, view: &View, pen: Pen, stages: &Stages) {
    let drawable = |c: &&Candidate| c.segment.is_valid() && c.segment.absolute_turning() < 100.0;
    let every = stages.candidates.len().div_ceil(MAX_CANDIDATES).max(1);
    // The longest kinds lie lowest and the more there are of a kind the paler it is, so that none drowns the others.
    for kind in [Kind::Clothoid, Kind::Arc, Kind::Line] {
        let of_kind = stages.candidates.iter().step_by(every).filter(drawable).filter(|c| c.segment.kind() == kind);
        let of_kind: Vec<&Candidate> = of_kind.collect();
        let opacity = (4.5 / (of_kind.len() as f64).sqrt()).clamp(0.12, 0.6);
        page.open(format_args!(
            "fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\" stroke-opacity=\"{opacity:.2}\"",
            colour_of(kind),
            0.7 * pen.unit
        ));
        for c in of_kind {
            page.path(&view.segment(&c.segment), format_args!(""));
        }
        page.close();
    }
}

fn path(page: &mut Page, view: &View, pen: Pen, stages: &Stages) {
    page.open(format_args!("fill=\"none\" stroke-width=\"{:.2}\"", 2.1 * pen.unit));
    let chosen = || stages.path.iter().filter_map(|&i| stages.candidates.get(i)).filter(|c| c.segment.is_valid());
    for c in chosen() {
        page.path(&view.segment(&c.segment), format_args!("stroke=\"{}\"", colour_of(c.segment.kind())));
    }
    page.close();
    // Where each piece begins and ends: they do not quite meet.
    page.open(format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::MARK, 0.8 * pen.unit));
    for c in chosen() {
        let (start, end) = (c.segment.start_pose(), c.segment.end_pose());
        for pose in [start, end] {
            let tangent = view.direction(kurbo::Vec2::from_angle(pose.heading));
            let across = kurbo::Vec2::new(-tangent.y, tangent.x) * (4.5 * pen.unit);
            let at = view.point(pose.point);
            page.line(at - across, at + across, format_args!(""));
        }
    }
    page.close();
}
