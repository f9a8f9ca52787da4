//! Sets of French curves laid out on a board side by side, each set to one scale, as old catalogues show them (figure 1 of McCrae and Singh 2011).

use super::drawing::{CombScale, Pen, sane_size};
use super::lettering;
use super::page::{Page, Picture, View, colour};
use super::{Comb, PictureOptions};
use crate::drawable::Drawable;
use fairpath_curve::{Point, Spline};
use fairpath_fit::{Template, TemplateSet};
use kurbo::{BezPath, Rect, Size, Vec2};

/// Height of the board over its width, at most.
const HIGHEST: f64 = 0.75;
/// White around each shape, as a part of the page's width.
const PADDING: f64 = 0.018;
/// Height of the capitals in names, as a part of the page's width.
const LETTERS: f64 = 0.0085;
/// Factor between the scales that are tried.
const STEP: f64 = 0.96;
/// Teeth of the comb along a line across the longest shape.
const TEETH: f64 = 160.0;
/// Two-dimensional size below which a shape would be no more than a dot, px of the page.
const SMALLEST_PX: f64 = 0.5;

/// A picture of sets, one above the other, each to a scale of its own: each French curve whole, closed ones as cut from a sheet, with its
/// name. Several sets are headed by their names.
///
/// `options.size_px` is the width of the page; `joins` marks joins, corners and ends, `comb` draws the curvature.
#[must_use]
pub fn draw_templates(sets: &[TemplateSet], options: &PictureOptions) -> Picture {
    let width = sane_size(options.size_px);
    let heading = if sets.len() > 1 { 3.0 * LETTERS * width + PADDING * width } else { 0.0 };
    let highest = HIGHEST * width / (sets.len() as f64).sqrt().max(1.0);
    let mut drawable = Drawable::default();
    let mut boards = Vec::new();
    for set in sets {
        boards.push(Board::new(set, options.comb, width, highest, &mut drawable));
    }
    let height = boards.iter().map(|board| heading + board.rows.height).sum();
    let mut page = Page::new(width, height);
    let mut top = 0.0;
    for (board, set) in boards.iter().zip(sets) {
        if heading > 0.0 {
            let letters = 1.4 * LETTERS * width;
            let at = Point::new(PADDING * width, top + PADDING * width + letters);
            write(&mut page, set.name(), at, letters, colour::FAINT);
        }
        board.draw(&mut page, top + heading, options.joins);
        top += heading + board.rows.height;
    }
    page.finish()
}

/// One set, arranged.
struct Board<'a> {
    shown: Vec<&'a Template>,
    boxes: Vec<Rect>,
    names: Vec<String>,
    comb: CombScale,
    scale: f64,
    rows: Rows,
    width: f64,
}

impl<'a> Board<'a> {
    fn new(set: &'a TemplateSet, comb: Comb, width: f64, highest: f64, drawable: &mut Drawable) -> Self {
        let shown: Vec<&Template> = set.templates().iter().filter(|t| drawable.admits(t.spline())).collect();
        let comb = comb_of(&shown, comb);
        let boxed = |t: &&Template| comb.widened(t.spline().bounding_box(), std::iter::once(t.spline()));
        let boxes: Vec<Rect> = shown.iter().map(boxed).collect();
        let named = |t: &&Template| lettering::shortened(t.name(), LETTERS * width, 0.3 * width);
        let names: Vec<String> = shown.iter().map(named).collect();
        let (scale, rows) = arranged(&boxes, &names, width, highest);
        Self { shown, boxes, names, comb, scale, rows, width }
    }

    fn draw(&self, page: &mut Page, top: f64, joins: bool) {
        let pen = Pen { unit: self.width / 1600.0 };
        let letters = LETTERS * self.width;
        for (i, cell) in self.rows.cells.iter().enumerate() {
            let cell = *cell + Vec2::new(0.0, top);
            let (bounds, name, spline) = (self.boxes[i], &self.names[i], self.shown[i].spline());
            let size = Size::new(bounds.width(), bounds.height()) * self.scale;
            let corner =
                Point::new(cell.center().x - 0.5 * size.width, cell.y1 - label_height(self.width) - size.height);
            let view = view_at(bounds, corner, self.scale);
            shape(page, &view, pen, spline);
            pen.comb(page, &view, spline, self.comb);
            if joins {
                pen.marks(page, &view, spline);
            }
            let left = cell.center().x - 0.5 * lettering::width(name, letters);
            write(page, name, Point::new(left, cell.y1 - PADDING * self.width * 0.5), letters, colour::LABEL);
        }
    }
}

/// The view that shows what lies in `bounds` at this scale below and to the right of `corner`.
pub(crate) fn view_at(bounds: Rect, corner: Point, scale: f64) -> View {
    // A shape without width or height has room for rounding all the same.
    let little = 1e-6;
    let size = Size::new(bounds.width(), bounds.height()) * scale;
    let into = Rect::from_origin_size(corner, size).inflate(little, little);
    View::fit(bounds.inflate(little / scale, little / scale), into, false)
}

/// A line of text on the page.
pub(crate) fn write(page: &mut Page, text: &str, at: Point, height: f64, colour: &str) {
    let letters = lettering::text(text, at, height);
    let thin = height / 8.0;
    page.path(&letters, format_args!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{thin:.2}\""));
}

/// One comb scale for all, so that bends can be compared.
fn comb_of(shown: &[&Template], comb: Comb) -> CombScale {
    let all = || shown.iter().map(|t| t.spline());
    let longest = all()
        .map(Spline::bounding_box)
        .fold(Rect::ZERO, |a, b| if b.width().max(b.height()) > a.width().max(a.height()) { b } else { a });
    CombScale::of(comb, all(), longest, TEETH)
}

/// A French curve: its outline, filled like a transparent sheet if it is closed.
pub(crate) fn shape(page: &mut Page, view: &View, pen: Pen, spline: &Spline) {
    let fill = if spline.is_closed() { colour::CELLULOID } else { "none" };
    let outline: BezPath = view.spline(spline);
    page.path(
        &outline,
        format_args!("fill=\"{fill}\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::TEMPLATE, 1.8 * pen.unit),
    );
}

/// Where each shape lies on the page, its name below it.
struct Rows {
    cells: Vec<Rect>,
    height: f64,
}

fn label_height(width: f64) -> f64 {
    LETTERS * width + PADDING * width
}

/// The largest scale at which all fit on the page, and where they lie then.
fn arranged(boxes: &[Rect], names: &[String], width: f64, highest: f64) -> (f64, Rows) {
    let largest = boxes.iter().fold(0.0, |m: f64, b| m.max(b.width()).max(b.height()));
    let mut scale = if largest > 0.0 { width / largest } else { 1.0 };
    loop {
        let rows = rows(boxes, names, width, scale);
        let fits = rows.height <= highest && rows.cells.iter().all(|cell| cell.x1 <= width);
        if fits || scale * largest < SMALLEST_PX {
            return (scale, rows);
        }
        scale *= STEP;
    }
}

/// Rows of cells from left to right, each row as high as its highest cell.
fn rows(boxes: &[Rect], names: &[String], width: f64, scale: f64) -> Rows {
    let padding = PADDING * width;
    let sizes: Vec<Size> = boxes
        .iter()
        .zip(names)
        .map(|(bounds, name)| {
            let lettered = lettering::width(name, LETTERS * width);
            let drawn = Size::new(bounds.width(), bounds.height()) * scale;
            Size::new(drawn.width.max(lettered) + 2.0 * padding, drawn.height + 1.5 * padding + label_height(width))
        })
        .collect();
    let mut cells = Vec::with_capacity(sizes.len());
    let (mut first, mut top) = (0, 0.5 * padding);
    while first < sizes.len() {
        let mut count = 0;
        let mut used = 0.0;
        while let Some(size) = sizes.get(first + count).filter(|size| count == 0 || used + size.width <= width) {
            used += size.width;
            count += 1;
        }
        let row = &sizes[first..first + count];
        let height = row.iter().fold(0.0, |m: f64, size| m.max(size.height));
        // What is left of the row goes between its shapes.
        let gap = (width - used).max(0.0) / count as f64;
        let mut left = 0.0;
        for size in row {
            cells.push(Rect::new(left, top, left + size.width + gap, top + height));
            left += size.width + gap;
        }
        first += count;
        top += height;
    }
    Rows { cells, height: top + padding }
}
