//! Corrections as figure 8 of Baran, Lehtinen and Popović (2010) shows them: the old curve with the stroke, the integrated stroke, the result.

use super::drawing::{CombScale, Pen, bounds, thinned};
use super::lettering;
use super::page::{Page, Picture, View, colour};
use super::{Comb, PictureOptions};
use crate::drawable::{Drawable, drawable_points};
use crate::unit::YAxis;
use fairpath_curve::{Point, Spline};
use fairpath_fit::{Oversketched, Stroke};
use kurbo::{BezPath, Rect, Vec2};

/// Width and height of one of the three drawings of a row, px.
const CELL: (f64, f64) = (330.0, 250.0);
/// White around a drawing, and around the sheet.
const PADDING: f64 = 16.0;
const MARGIN: f64 = 20.0;
/// Height of the line of text above a row, and of its capitals.
const TITLE: f64 = 26.0;
const LETTERS: f64 = 8.0;
/// Teeth of the comb along a line across a drawing.
const TEETH: f64 = 80.0;
/// Widths and distances in a drawing, thousandth parts of what a page of that size would have, px.
const UNIT: f64 = 0.7;
/// Most corrections of a sheet: more cannot be looked at.
const MAX_ROWS: usize = 500;

/// One correction.
#[derive(Clone, Copy, Debug)]
pub struct Correction<'a> {
    /// What to call it.
    pub name: &'a str,
    /// The curve before.
    pub before: &'a Spline,
    /// The stroke that was drawn over it.
    pub stroke: &'a Stroke,
    /// What came of it.
    pub result: &'a Oversketched,
}

/// A sheet with a row for each correction: the old curve, what is replaced of it and what is fitted anew beside that (orange, pale orange),
/// with the stroke; the integrated stroke between what stays; the new curve with the old one behind it.
///
/// `options.joins` and `options.comb` count for the result.
#[must_use]
pub fn draw_corrections(corrections: &[Correction<'_>], y: YAxis, options: &PictureOptions) -> Picture {
    let rows = &corrections[..corrections.len().min(MAX_ROWS)];
    let row_height = CELL.1 + TITLE;
    let (width, height) = (3.0 * CELL.0 + 2.0 * MARGIN, rows.len().max(1) as f64 * row_height + 2.0 * MARGIN);
    let mut page = Page::new(width, height);
    for (i, correction) in rows.iter().enumerate() {
        let corner = Point::new(MARGIN, MARGIN + i as f64 * row_height);
        row(&mut page, correction, corner, y == YAxis::Up, options);
    }
    page.finish()
}

fn row(page: &mut Page, correction: &Correction<'_>, corner: Point, y_up: bool, options: &PictureOptions) {
    let Correction { name, before, stroke, result } = *correction;
    let after = &result.spline;
    let name = lettering::shortened(name, LETTERS, 3.0 * CELL.0 - 2.0 * PADDING);
    let letters = lettering::text(&name, corner + Vec2::new(PADDING, LETTERS + 6.0), LETTERS);
    page.path(&letters, format_args!("fill=\"none\" stroke=\"{}\"", colour::LABEL));
    let mut drawable = Drawable::default();
    if ![before, after].into_iter().all(|s| drawable.admits(s)) {
        return;
    }
    let around = bounds([before, after].into_iter(), std::iter::once(stroke));
    let comb = CombScale::of(options.comb, [before, after].into_iter(), around, TEETH);
    let around = comb.widened(around, [before, after].into_iter());
    let view = |column: f64| {
        let into = Rect::new(PADDING, PADDING + TITLE, CELL.0 - PADDING, CELL.1 - PADDING + TITLE);
        View::fit(around, into + corner.to_vec2() + Vec2::new(column * CELL.0, 0.0), y_up)
    };
    let pen = Pen { unit: UNIT };
    old_and_stroke(page, &view(0.0), pen, correction);
    integrated(page, &view(1.0), pen, correction);
    let view = view(2.0);
    thin(page, &view, before, colour::GHOST, 1.0);
    if options.comb != Comb::Off {
        pen.comb(page, &view, after, comb);
    }
    pen.spline(page, &view, after);
    if options.joins {
        pen.marks(page, &view, after);
    }
}

fn old_and_stroke(page: &mut Page, view: &View, pen: Pen, correction: &Correction<'_>) {
    let region = &correction.result.region;
    thin(page, view, correction.before, colour::SAMPLE, 1.6);
    part(page, view, correction.before, region.refitted, colour::WIDENED, 5.0);
    part(page, view, correction.before, region.replaced, colour::REPLACED, 5.0);
    thin(page, view, correction.before, colour::SAMPLE, 0.8);
    pen.marks(page, view, correction.before);
    let points = || thinned(drawable_points(correction.stroke).map(|p| view.point(p)));
    page.polyline(points(), format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\"", colour::STROKE));
    page.dots(points(), 1.3, format_args!("stroke=\"{}\"", colour::STROKE));
}

fn integrated(page: &mut Page, view: &View, pen: Pen, correction: &Correction<'_>) {
    let Oversketched { spline, new, integrated, .. } = correction.result;
    page.open(format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::SAMPLE, 2.1 * pen.unit));
    for (i, segment) in spline.segments().iter().enumerate() {
        if !new.contains(&i) {
            page.path(&view.segment(segment), format_args!(""));
        }
    }
    page.close();
    let points = || thinned(integrated.iter().map(|p| view.point(*p)));
    page.polyline(points(), format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"", colour::REPLACED));
    page.dots(points(), 1.3, format_args!("stroke=\"{}\"", colour::REPLACED));
}

fn thin(page: &mut Page, view: &View, spline: &Spline, colour: &str, width: f64) {
    let mut path = BezPath::new();
    for segment in spline.segments() {
        path.extend(view.segment(segment));
    }
    page.path(&path, format_args!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width:.2}\""));
}

/// The part of a curve between two stations.
fn part(page: &mut Page, view: &View, spline: &Spline, [from, to]: [f64; 2], colour: &str, width: f64) {
    if let Some(part) = spline.subspline(from.min(to), to.max(from)) {
        thin(page, view, &part, colour, width);
    }
}
