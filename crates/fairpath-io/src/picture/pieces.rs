//! Strokes with the French curves that they were neatened with laid over them, and a legend of which part of each was used, as figures 2 and
//! 11 of McCrae and Singh (2011) show it.

use super::PictureOptions;
use super::board::{shape, view_at, write};
use super::drawing::{Pen, bounds, page_for, sane_size, thinned};
use super::lettering;
use super::page::{Page, Picture, View, colour, colour_of_piece};
use crate::drawable::{Drawable, drawable_points};
use crate::spline_file::{SplineFile, UsedPiece};
use crate::stroke_file::StrokeFile;
use crate::unit::YAxis;
use fairpath_curve::{Point, Similarity, Spline, Vec2};
use fairpath_fit::{Stroke, Template, TemplateSet};
use kurbo::{Rect, Size};

/// Width of the legend over that of the drawing.
const LEGEND: f64 = 0.42;
/// How far the drawing reaches beyond strokes and curves, so that templates show their shapes, as a part of its extent.
const AROUND: f64 = 0.22;
/// Points along a piece for each px of the page: it is drawn as a polyline.
const POINTS_PER_PX: f64 = 0.5;
/// Most points of one piece.
const MOST_POINTS: f64 = 4000.0;
/// Most pieces that are drawn: more cannot be told apart.
const MOST_PIECES: usize = 2000;

/// A picture of neatened strokes: beneath, each stroke; over it, each French curve that was used, whole and thin, with the part that was used
/// thick in a colour of its own, and broad and pale where the result shows it, blends included; on top, thin and dark, the result. Beside it, the French curves with their parts in the same colours, moved apart where
/// the same stretch was used more than once.
///
/// Splines without pieces, and pieces of no template of `set`, are drawn without any. `options.size_px` and `ghost` count.
#[must_use]
pub fn draw_pieces(
    file: &SplineFile,
    strokes: Option<&StrokeFile>,
    set: &TemplateSet,
    options: &PictureOptions,
) -> Picture {
    let y_up = file.y == YAxis::Up;
    let mut drawable = Drawable::default();
    let shown: Vec<&Spline> = file.splines.iter().map(|e| &e.spline).filter(|s| drawable.admits(s)).collect();
    let ghosts: &[Stroke] = strokes.filter(|_| options.ghost).map_or(&[], |s| &s.strokes);
    let used = used(file, set, &mut drawable);
    let frame = bounds(shown.iter().copied(), ghosts.iter());
    let around = AROUND * frame.width().max(frame.height());
    let size = sane_size(options.size_px);
    let (page, view) = page_for(frame.inflate(around, around), size / (1.0 + LEGEND), y_up);
    let drawing = page.bounds();
    let mut page = Page::new(drawing.width() + LEGEND * size / (1.0 + LEGEND), drawing.height());
    let pen = Pen { unit: size / 1000.0 };

    page.open_clipped(drawing, "drawing");
    for stroke in ghosts {
        ghost(&mut page, &view, pen, stroke);
    }
    // Of many templates each is drawn more faintly, or the drawing would drown among them.
    let faint = (5.0 / used.len().max(1) as f64).clamp(0.22, 0.6);
    page.open(format_args!("fill=\"none\" stroke-width=\"{:.2}\" stroke-opacity=\"{faint:.2}\"", 0.7 * pen.unit));
    for used in &used {
        page.path(&view.spline(&used.laid()), format_args!("stroke=\"{}\"", used.colour()));
    }
    page.close();
    for used in &used {
        used.draw_span(&mut page, &view, 6.0 * pen.unit);
    }
    for used in &used {
        used.draw(&mut page, &view, &used.piece.transform, 0.0, 3.2 * pen.unit);
    }
    for spline in &shown {
        let curve = view.spline(spline);
        page.path(&curve, format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::MARK, pen.unit));
    }
    page.close();
    let legend_at = Rect::new(drawing.x1, 0.0, page.bounds().x1, drawing.y1);
    legend(&mut page, legend_at, pen, set, &used);
    page.finish()
}

/// The stroke as drawn, pale and without its points, which would hide the pieces.
fn ghost(page: &mut Page, view: &View, pen: Pen, stroke: &Stroke) {
    let points = thinned(drawable_points(stroke).map(|p| view.point(p)));
    let width = 2.4 * pen.unit;
    page.polyline(points, format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.2}\"", colour::GHOST));
}

/// A piece with the template that it is of.
struct Used<'a> {
    piece: &'a UsedPiece,
    /// The curve that it is seen in.
    result: &'a Spline,
    template: &'a Template,
    /// Which of the set's templates.
    index: usize,
    /// Which of all pieces of the file.
    number: usize,
}

fn used<'a>(file: &'a SplineFile, set: &'a TemplateSet, drawable: &mut Drawable) -> Vec<Used<'a>> {
    let pieces = file.splines.iter().flat_map(|entry| {
        let pieces = entry.templates.iter().flat_map(|templates| &templates.pieces);
        pieces.map(|piece| (piece, &entry.spline))
    });
    pieces
        .filter_map(|(piece, result)| {
            let index = set.templates().iter().position(|t| t.name() == piece.template)?;
            Some((piece, result, index))
        })
        .enumerate()
        .map(|(number, (piece, result, index))| Used {
            piece,
            result,
            template: &set.templates()[index],
            index,
            number,
        })
        .filter(|used| drawable.admits(&used.laid()))
        .take(MOST_PIECES)
        .collect()
}

/// Arc lengths at equal steps from `from` to `to`, dense enough for a page of this scale.
fn steps(from: f64, to: f64, scale: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) * scale * POINTS_PER_PX).clamp(2.0, MOST_POINTS);
    let count = if count.is_finite() { count as usize } else { 2 };
    (0..=count).map(move |i| from + (to - from) * i as f64 / count as f64)
}

impl Used<'_> {
    fn colour(&self) -> &'static str {
        colour_of_piece(self.number)
    }

    /// The template as it lies over the stroke.
    fn laid(&self) -> Spline {
        self.template.spline().transformed(&self.piece.transform)
    }

    /// Where the part is seen along the result, blends included, as a broad pale band.
    fn draw_span(&self, page: &mut Page, view: &View, width: f64) {
        let [from, to] = self.piece.span;
        let points = steps(from, to, view.scale).map(|s| view.point(self.result.point_at(s)));
        page.polyline(
            points,
            format_args!(
                "fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.2}\" stroke-opacity=\"0.3\"",
                self.colour()
            ),
        );
    }

    /// The part that was used, where `by` lays it, as a line beside it at a distance on the page.
    fn draw(&self, page: &mut Page, view: &View, by: &Similarity, beside: f64, width: f64) {
        let spline = self.template.spline();
        let (from, to) = (self.piece.offset, self.piece.offset + self.piece.length);
        // Corners are drawn too, although no step falls on them.
        let mut stations: Vec<f64> = steps(from, to, by.scale * view.scale).collect();
        stations.extend(self.joins_inside());
        stations.sort_by(f64::total_cmp);
        let points = stations.into_iter().map(|s| {
            let along = view.direction(by.vector(spline.tangent_at(s)));
            let along = along / along.hypot().max(f64::MIN_POSITIVE);
            view.point(by.point(spline.point_at(s))) + Vec2::new(-along.y, along.x) * beside
        });
        page.polyline(points, format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.2}\"", self.colour()));
    }

    /// Stations of the template's joins within the piece, those of later rounds of a closed one included.
    fn joins_inside(&self) -> Vec<f64> {
        let spline = self.template.spline();
        let (from, to, round) = (self.piece.offset, self.piece.offset + self.piece.length, spline.length());
        let mut at = 0.0;
        let mut inside = Vec::new();
        for segment in spline.segments() {
            at += segment.length;
            let rounds = if spline.is_closed() { 2 } else { 1 };
            inside.extend((0..rounds).map(|r| at + f64::from(r) * round).filter(|s| (from..to).contains(s)));
        }
        inside
    }

    /// Whether two pieces have some stretch of one template in common.
    fn overlaps(&self, other: &Self) -> bool {
        let round = if self.template.spline().is_closed() { self.template.spline().length() } else { f64::INFINITY };
        let reaches = |a: &UsedPiece, b: &UsedPiece| {
            let ahead = b.offset - a.offset;
            let ahead = if round.is_finite() { ahead.rem_euclid(round) } else { ahead };
            (0.0..=a.length).contains(&ahead)
        };
        reaches(self.piece, other.piece) || reaches(other.piece, self.piece)
    }
}

/// The templates that were used, all to one scale below each other, with their parts.
fn legend(page: &mut Page, into: Rect, pen: Pen, set: &TemplateSet, used: &[Used<'_>]) {
    let mut indices: Vec<usize> = used.iter().map(|u| u.index).collect();
    indices.sort_unstable();
    indices.dedup();
    if indices.is_empty() {
        return;
    }
    let splines: Vec<&Spline> = indices.iter().map(|&i| set.templates()[i].spline()).collect();
    let boxes: Vec<Rect> = splines.iter().map(|s| s.bounding_box()).collect();
    let (padding, letters) = (0.07 * into.width(), 8.0 * pen.unit);
    let label = 3.0 * letters;
    let free = into.height() - 2.0 * padding - boxes.len() as f64 * (label + 2.0 * padding);
    let (width, height) = boxes.iter().fold((0.0_f64, 0.0), |(w, h), b| (w.max(b.width()), h + b.height()));
    let scale = ((into.width() - 2.0 * padding) / width).min(free.max(0.2 * into.height()) / height);
    page.line(
        Point::new(into.x0, padding),
        Point::new(into.x0, into.y1 - padding),
        format_args!("stroke=\"{}\" stroke-width=\"{:.2}\"", colour::RULE, 1.5 * pen.unit),
    );
    page.open_clipped(into, "legend");
    let mut top = into.y0 + padding;
    for ((&index, spline), bounds) in indices.iter().zip(splines).zip(&boxes) {
        let size = Size::new(bounds.width(), bounds.height()) * scale;
        let corner = Point::new(into.x0 + padding, top + padding);
        let view = view_at(*bounds, corner, scale);
        shape(page, &view, Pen { unit: 0.6 * pen.unit }, spline);
        let own: Vec<&Used<'_>> = used.iter().filter(|u| u.index == index).collect();
        for (u, level) in own.iter().zip(levels(&own)) {
            u.draw(page, &view, &Similarity::IDENTITY, level * 4.5 * pen.unit, 3.2 * pen.unit);
        }
        let name = lettering::shortened(set.templates()[index].name(), letters, into.width() - 2.0 * padding);
        let at = Point::new(corner.x, corner.y + size.height + label);
        write(page, &name, at, letters, colour::LABEL);
        top += size.height + label + 2.0 * padding;
    }
    page.close();
}

/// How far beside the template each of its pieces is drawn, so that none hides another: 0, 1, −1, 2, …
fn levels(pieces: &[&Used<'_>]) -> Vec<f64> {
    let mut taken: Vec<usize> = Vec::with_capacity(pieces.len());
    for (i, piece) in pieces.iter().enumerate() {
        let mut rank = 0;
        while pieces[..i].iter().zip(&taken).any(|(other, &at)| at == rank && piece.overlaps(other)) {
            rank += 1;
        }
        taken.push(rank);
    }
    taken.into_iter().map(|rank| if rank % 2 == 0 { -(rank as f64) / 2.0 } else { (rank as f64 + 1.0) / 2.0 }).collect()
}
