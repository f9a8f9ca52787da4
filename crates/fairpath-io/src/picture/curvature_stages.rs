//! The steps of a fit in curvature space, as figures 4, 7 and 10 of McCrae and Singh (2008) show them: stages in, a picture of each out.

use super::PictureOptions;
use super::drawing::{Pen, bounds, page_for, sane_size};
use super::lettering;
use super::page::{Page, View, colour, colour_of};
use super::stages::{StagePicture, input};
use crate::drawable::Drawable;
use crate::unit::YAxis;
use fairpath_curve::{Point, Segment, Spline};
use fairpath_fit::{CurvaturePlace, CurvatureStages, Stroke};
use kurbo::BezPath;

/// Height of the curvature plot over its width.
const PLOT_SHAPE: f64 = 0.45;
/// Part of the plot's width that stays white on each side.
const PLOT_MARGIN: f64 = 0.06;
/// Part of all places whose curvature may lie beyond the plot.
const OUTLIERS: f64 = 0.01;

/// The four pictures of a fit: a) the stroke, b) curvature along it: the estimate as dots, its linear pieces with the places where they
/// meet, and the profile of the result, c) the curve of the linear pieces as it is, laid over the stroke as a whole, d) the result.
///
/// Colours and marks are those of [`draw_splines`](super::draw_splines); `options.size_px` and `options.joins` count.
#[must_use]
pub fn draw_curvature_stages(
    stroke: &Stroke,
    stages: &CurvatureStages,
    spline: &Spline,
    y: YAxis,
    options: &PictureOptions,
) -> Vec<StagePicture> {
    let shown = Some(spline).filter(|s| Drawable::default().admits(s));
    let laid: Vec<&Segment> = stages.laid.iter().filter(|s| s.is_valid() && s.absolute_turning() < 1e3).collect();
    let frame = laid.iter().fold(bounds(shown.into_iter(), std::iter::once(stroke)), |b, s| b.union(s.bounding_box()));
    let pen = Pen::for_size(options.size_px);
    let draw = |letter, name, content: &dyn Fn(&mut Page, &View)| {
        let (mut page, view) = page_for(frame, options.size_px, y == YAxis::Up);
        content(&mut page, &view);
        StagePicture { letter, name, picture: page.finish() }
    };
    vec![
        draw('a', "stroke", &|page, view| input(page, view, pen, stroke)),
        plot(stages, shown, pen, options),
        draw('c', "laid", &|page, view| {
            pen.ghost(page, view, stroke);
            page.open(format_args!("fill=\"none\" stroke-width=\"{:.2}\"", 2.1 * pen.unit));
            for s in &laid {
                page.path(&view.segment(s), format_args!("stroke=\"{}\"", colour_of(s.kind())));
            }
            page.close();
        }),
        draw('d', "result", &|page, view| {
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

/// Arc length to the right and curvature up, on a page of their own.
struct Axes {
    width: f64,
    height: f64,
    margin: f64,
    length: f64,
    /// Largest curvature that is shown.
    top: f64,
}

impl Axes {
    fn at(&self, s: f64, kappa: f64) -> Point {
        let x = self.margin + (self.width - 2.0 * self.margin) * (s / self.length).clamp(-0.02, 1.02);
        let half = 0.5 * self.height;
        Point::new(x, half - (half - self.margin) * (kappa / self.top).clamp(-1.05, 1.05))
    }

    fn of(&self, p: &CurvaturePlace) -> Point {
        self.at(p.s, p.kappa)
    }
}

fn plot(stages: &CurvatureStages, spline: Option<&Spline>, pen: Pen, options: &PictureOptions) -> StagePicture {
    let width = sane_size(options.size_px);
    let of_spline = || spline.into_iter().flat_map(Spline::segments).flat_map(|s| [s.kappa0, s.kappa1]);
    let mut sizes: Vec<f64> =
        stages.places.iter().flatten().map(|p| p.kappa.abs()).chain(of_spline().map(f64::abs)).collect();
    sizes.retain(|k| k.is_finite());
    sizes.sort_by(f64::total_cmp);
    let rank = ((1.0 - OUTLIERS) * sizes.len() as f64) as usize;
    let top = sizes.get(rank.min(sizes.len().saturating_sub(1))).copied().unwrap_or(0.0);
    let length = stages.profiles.last().and_then(|p| p.last()).map_or(0.0, |p| p.s);
    let positive = |v: f64| if v.is_finite() && v > 0.0 { v } else { 1.0 };
    let axes = Axes {
        width,
        height: PLOT_SHAPE * width,
        margin: PLOT_MARGIN * width,
        length: positive(length),
        top: positive(1.1 * top),
    };
    let mut page = Page::new(axes.width, axes.height);
    grid(&mut page, &axes, pen);
    if let Some(spline) = spline {
        result(&mut page, &axes, pen, stages, spline);
    }
    for profile in &stages.profiles {
        let line = || profile.iter().map(|p| axes.of(p));
        let look = format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::LINE, 1.4 * pen.unit);
        page.polyline(line(), look);
        page.open(format_args!("fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::LINE, 1.2 * pen.unit));
        for p in line() {
            page.circle(p, 3.0 * pen.unit, format_args!(""));
        }
        page.close();
    }
    let dots = stages.places.iter().flatten().map(|p| axes.of(p));
    page.dots(dots, 1.5 * pen.unit, format_args!("stroke=\"{}\"", colour::STROKE));
    StagePicture { letter: 'b', name: "curvature", picture: page.finish() }
}

/// The axis of zero curvature, and what the ends of both axes stand for.
fn grid(page: &mut Page, axes: &Axes, pen: Pen) {
    page.open(format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::GHOST, pen.unit));
    page.line(axes.at(0.0, 0.0), axes.at(axes.length, 0.0), format_args!(""));
    page.line(axes.at(0.0, -axes.top), axes.at(0.0, axes.top), format_args!(""));
    page.close();
    let height = 11.0 * pen.unit;
    let mut label = |text: &str, at: Point| {
        let look = format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::LABEL, pen.unit);
        page.path(&lettering::text(text, at, height), look);
    };
    let corner = axes.at(0.0, axes.top);
    label(&format!("{:.3}", axes.top), Point::new(corner.x + height, corner.y + height));
    let end = format!("{:.0}", axes.length);
    let at = axes.at(axes.length, 0.0);
    label(&end, Point::new(at.x - lettering::width(&end, height), at.y + 1.8 * height));
}

/// The curvature of the result, broken at corners, along the stroke: stretched to its length.
fn result(page: &mut Page, axes: &Axes, pen: Pen, stages: &CurvatureStages, spline: &Spline) {
    // A closed curve may begin elsewhere than its profile.
    let begin = stages.laid.first().filter(|_| spline.is_closed()).map_or(0.0, |s| {
        let near = spline.nearest(s.start);
        spline.segments()[..near.segment].iter().map(|s| s.length).sum::<f64>() + near.s
    });
    let whole = spline.length();
    let stretch = if whole > 0.0 { axes.length / whole } else { 1.0 };
    let mut path = BezPath::new();
    let mut s = -begin;
    for segment in spline.segments() {
        // What runs through the beginning of the plot goes on at its end.
        let cut = (-s).clamp(0.0, segment.length);
        for (from, to, shift) in [(0.0, cut, whole), (cut, segment.length, 0.0)] {
            if to > from {
                path.move_to(axes.at((s + from + shift) * stretch, segment.curvature_at(from)));
                path.line_to(axes.at((s + to + shift) * stretch, segment.curvature_at(to)));
            }
        }
        s += segment.length;
    }
    let look = format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::CLOTHOID, 3.0 * pen.unit);
    page.path(&path, look);
}
