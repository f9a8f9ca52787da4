//! A contact sheet: every stroke in a cell of its own, with its name and what its spline is made of.

use super::PictureOptions;
use super::drawing::{CombScale, Pen, bounds, sane_size};
use super::lettering;
use super::page::{Page, Picture, View, colour, colour_of};
use crate::drawable::Drawable;
use crate::spline_file::{Failure, SplineEntry, SplineFile};
use crate::stroke_file::StrokeFile;
use crate::unit::YAxis;
use fairpath_curve::{Kind, Point, Spline};
use fairpath_fit::Stroke;
use kurbo::Rect;
use std::collections::HashMap;

/// Width and height of a cell, px.
const CELL: (f64, f64) = (240.0, 236.0);
/// Height of the drawing in a cell; the label stands below.
const DRAWING: f64 = 192.0;
/// White around the drawing in a cell.
const PADDING: f64 = 20.0;
/// White around the sheet.
const MARGIN: f64 = 24.0;
/// Height of the capitals in labels.
const LETTERS: f64 = 8.0;
/// Height of the smaller line below.
const SMALL_LETTERS: f64 = 6.5;
/// Sheets of few cells are shown so much larger at most.
const MAX_ZOOM: f64 = 2.5;
/// Most cells of a sheet: more cannot be looked at.
const MAX_CELLS: usize = 2000;

/// Teeth of the comb along a line across a cell.
const TEETH: f64 = 70.0;

/// What one cell shows.
struct Cell<'a> {
    name: &'a str,
    stroke: Option<&'a Stroke>,
    entry: Option<&'a SplineEntry>,
    failure: Option<&'a Failure>,
}

impl<'a> Cell<'a> {
    /// The spline, if it can be drawn.
    fn spline(&self) -> Option<&'a Spline> {
        self.entry.map(|e| &e.spline).filter(|s| Drawable::default().admits(s))
    }
}

/// The cells: strokes in their order, then whatever belongs to none of them.
fn cells<'a>(file: &'a SplineFile, strokes: Option<&'a StrokeFile>) -> Vec<Cell<'a>> {
    let mut entries: HashMap<&str, &SplineEntry> = file.splines.iter().map(|e| (e.name.as_str(), e)).collect();
    let mut failures: HashMap<&str, &Failure> = file.failures.iter().map(|f| (f.name.as_str(), f)).collect();
    let mut cells = Vec::new();
    for stroke in strokes.map_or(&[][..], |s| &s.strokes) {
        let name = stroke.name.as_str();
        let (entry, failure) = (entries.remove(name), failures.remove(name));
        cells.push(Cell { name, stroke: Some(stroke), entry, failure });
    }
    for entry in file.splines.iter().filter(|e| entries.contains_key(e.name.as_str())) {
        cells.push(Cell { name: &entry.name, stroke: None, entry: Some(entry), failure: None });
    }
    for failure in file.failures.iter().filter(|f| failures.contains_key(f.name.as_str())) {
        cells.push(Cell { name: &failure.name, stroke: None, entry: None, failure: Some(failure) });
    }
    cells
}

pub(crate) fn draw(
    file: &SplineFile,
    strokes: Option<&StrokeFile>,
    options: &PictureOptions,
    columns: Option<usize>,
) -> Picture {
    let mut cells = cells(file, strokes);
    cells.truncate(MAX_CELLS);
    let count = cells.len().max(1);
    // A page somewhat wider than high.
    let columns = columns.unwrap_or_else(|| (1.5 * count as f64).sqrt().ceil() as usize).clamp(1, count);
    let rows = count.div_ceil(columns);
    let (width, height) = (columns as f64 * CELL.0 + 2.0 * MARGIN, rows as f64 * CELL.1 + 2.0 * MARGIN);
    let zoom = (sane_size(options.size_px) / width.max(height)).clamp(1.0, MAX_ZOOM);
    let mut page = Page::new(width, height).zoomed(zoom);
    for (i, cell) in cells.iter().enumerate() {
        let corner = Point::new(MARGIN + (i % columns) as f64 * CELL.0, MARGIN + (i / columns) as f64 * CELL.1);
        let frame = Frame::of(cell, options);
        draw_cell(&mut page, cell, corner, options, file.y == YAxis::Up, &frame);
    }
    page.finish()
}

/// A table of pictures: a row for each stroke, a column for each of `methods`, which are a name and the splines that it made of the strokes.
///
/// The cells of a row have one scale, of the combs too, so that they can be compared. At most 2000 cells are drawn.
#[must_use]
pub fn draw_comparison(methods: &[(&str, &SplineFile)], strokes: &StrokeFile, options: &PictureOptions) -> Picture {
    let columns: Vec<Vec<Cell<'_>>> = methods.iter().map(|(_, file)| cells(file, Some(strokes))).collect();
    let rows = strokes.strokes.len().min(MAX_CELLS / methods.len().max(1));
    let width = methods.len().max(1) as f64 * CELL.0 + 2.0 * MARGIN;
    let height = rows as f64 * CELL.1 + HEAD + 2.0 * MARGIN;
    let zoom = (sane_size(options.size_px) / width.max(height)).clamp(1.0, MAX_ZOOM);
    let mut page = Page::new(width, height).zoomed(zoom);
    for (i, (name, _)) in methods.iter().enumerate() {
        let at = Point::new(MARGIN + i as f64 * CELL.0 + PADDING, MARGIN + LETTERS + 4.0);
        write(&mut page, name, at, LETTERS + 2.0, colour::STROKE);
    }
    for row in 0..rows {
        let beside: Vec<&Cell<'_>> = columns.iter().map(|cells| &cells[row]).collect();
        let Some(frame) = beside.iter().map(|cell| Frame::of(cell, options)).reduce(Frame::common) else { continue };
        for (i, cell) in beside.into_iter().enumerate() {
            let corner = Point::new(MARGIN + i as f64 * CELL.0, MARGIN + HEAD + row as f64 * CELL.1);
            draw_cell(&mut page, cell, corner, options, strokes.y == YAxis::Up, &frame);
        }
    }
    page.finish()
}

/// Height of the names of methods above their columns.
const HEAD: f64 = 26.0;

/// What of the drawing a cell shows, and the scale of its comb.
#[derive(Clone, Copy)]
struct Frame {
    around: Rect,
    comb: CombScale,
}

impl Frame {
    fn of(cell: &Cell<'_>, options: &PictureOptions) -> Self {
        let spline = cell.spline();
        let ghost = cell.stroke.filter(|_| options.ghost || spline.is_none());
        let around = bounds(spline.into_iter(), ghost.into_iter());
        let comb = CombScale::of(options.comb, spline.into_iter(), around, TEETH);
        Self { around: comb.widened(around, spline.into_iter()), comb }
    }

    /// A frame for what both show. Combs have the larger of both scales: that of the curve which bends less sharply.
    fn common(self, other: Self) -> Self {
        Self { around: self.around.union(other.around), comb: self.comb.higher(other.comb) }
    }
}

fn draw_cell(
    page: &mut Page,
    cell: &Cell<'_>,
    corner: Point,
    options: &PictureOptions,
    y_up: bool,
    &Frame { around, comb }: &Frame,
) {
    let spline = cell.spline();
    let ghost = cell.stroke.filter(|_| options.ghost || spline.is_none());
    let into = Rect::new(PADDING, PADDING, CELL.0 - PADDING, DRAWING) + corner.to_vec2();
    let view = View::fit(around, into, y_up);
    let pen = Pen { unit: 0.62 };
    if let Some(stroke) = ghost {
        pen.ghost(page, &view, stroke);
    }
    if let Some(spline) = spline {
        pen.comb(page, &view, spline, comb);
        pen.spline(page, &view, spline);
        if options.joins {
            pen.marks(page, &view, spline);
        }
    }
    label(page, cell, corner);
}

fn label(page: &mut Page, cell: &Cell<'_>, corner: Point) {
    let left = corner.x + PADDING;
    let most = CELL.0 - 2.0 * PADDING;
    let rule = corner.y + DRAWING + 8.0;
    let end = Point::new(left + most, rule);
    page.line(Point::new(left, rule), end, format_args!("stroke=\"{}\" stroke-width=\"1\"", colour::RULE));
    let base = rule + 8.0 + LETTERS;
    let name = lettering::shortened(cell.name, LETTERS, most);
    write(page, &name, Point::new(left, base), LETTERS, colour::LABEL);
    let below = base + 7.0 + SMALL_LETTERS;
    if let Some(failure) = cell.failure {
        let code = lettering::shortened(&failure.code, SMALL_LETTERS, most);
        write(page, &code, Point::new(left, below), SMALL_LETTERS, colour::FAILED);
    } else if let Some(entry) = cell.entry {
        let mut x = left;
        for kind in [Kind::Line, Kind::Arc, Kind::Clothoid] {
            let count = entry.spline.segments().iter().filter(|s| s.kind() == kind).count();
            if count > 0 {
                let text = count.to_string();
                page.circle(
                    Point::new(x + 2.5, below - 0.5 * SMALL_LETTERS),
                    2.5,
                    format_args!("fill=\"{}\"", colour_of(kind)),
                );
                write(page, &text, Point::new(x + 9.0, below), SMALL_LETTERS, colour::LABEL);
                x += 9.0 + lettering::width(&text, SMALL_LETTERS) + 11.0;
            }
        }
        if let Some(report) = &entry.report {
            let text = format!("max {:.2}", report.figures.max_deviation);
            let at = Point::new(left + most - lettering::width(&text, SMALL_LETTERS), below);
            write(page, &text, at, SMALL_LETTERS, colour::FAINT);
        }
    }
}

fn write(page: &mut Page, text: &str, at: Point, height: f64, colour: &str) {
    let width = height / 8.0;
    let letters = lettering::text(text, at, height);
    page.path(&letters, format_args!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width:.2}\""));
}
