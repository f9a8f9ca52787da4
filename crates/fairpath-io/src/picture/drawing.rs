//! Strokes and their splines on one page, where they are or as a contact sheet.

use super::page::{Page, Picture, View, colour, colour_of};
use super::{Comb, Layout, PictureOptions, sheet};
use crate::drawable::{Drawable, drawable_points};
use crate::spline_file::SplineFile;
use crate::stroke_file::StrokeFile;
use crate::unit::YAxis;
use fairpath_curve::{Continuity, Point, Spline, Tooth};
use fairpath_fit::Stroke;
use kurbo::{BezPath, Rect, Vec2};

/// Part of the page's longer side that stays white on each side.
const MARGIN: f64 = 0.05;
/// The comb's highest teeth, but for the sharpest few, as a part of the largest spline's extent.
const COMB_HEIGHT: f64 = 0.1;
/// The part of all teeth that may stand higher than that.
const COMB_OUTLIERS: f64 = 0.02;
/// Teeth that would stand higher than so many times that are cut off, lest one sharp place hide the drawing.
const COMB_CUT: f64 = 2.0;
/// Teeth of the comb along a line across the page.
const TEETH: f64 = 220.0;

/// Points of the line through the comb's tips for each tooth that is drawn.
const TIPS_PER_TOOTH: usize = 4;

/// A picture of splines, with `strokes`, if given, behind them.
///
/// Strokes without a spline are shown too. What no page can show (coordinates beyond 1e60, spirals of more than 1e5 rad) is left out.
#[must_use]
pub fn draw_splines(file: &SplineFile, strokes: Option<&StrokeFile>, options: &PictureOptions) -> Picture {
    if let Layout::Sheet { columns } = options.layout {
        return sheet::draw(file, strokes, options, columns);
    }
    let y_up = file.y == YAxis::Up;
    let mut drawable = Drawable::default();
    let shown: Vec<&Spline> = file.splines.iter().map(|e| &e.spline).filter(|s| drawable.admits(s)).collect();
    let ghosts: &[Stroke] = strokes.filter(|_| options.ghost).map_or(&[], |s| &s.strokes);
    let bounds = bounds(shown.iter().copied(), ghosts.iter());
    let comb = CombScale::of(options.comb, shown.iter().copied(), bounds, TEETH);
    let bounds = comb.widened(bounds, shown.iter().copied());
    let (mut page, view) = page_for(bounds, options.size_px, y_up);
    let pen = Pen::for_size(options.size_px);
    for stroke in ghosts {
        pen.ghost(&mut page, &view, stroke);
    }
    for spline in &shown {
        pen.comb(&mut page, &view, spline, comb);
    }
    for spline in &shown {
        pen.spline(&mut page, &view, spline);
    }
    if options.joins {
        for spline in &shown {
            pen.marks(&mut page, &view, spline);
        }
    }
    page.finish()
}

/// A page's size within what can be drawn and seen, px.
pub(crate) fn sane_size(size_px: f64) -> f64 {
    if size_px.is_finite() { size_px.clamp(64.0, 16_384.0) } else { 1600.0 }
}

/// A page of the drawing's proportions, its longer side `size_px`, and the drawing's place on it.
pub(crate) fn page_for(bounds: Rect, size_px: f64, y_up: bool) -> (Page, View) {
    let size_px = sane_size(size_px);
    let (w, h) = (bounds.width(), bounds.height());
    // A page is at most four times as long as wide.
    let longest = w.max(h);
    let (w, h) = if longest > 0.0 { (w.max(0.25 * longest), h.max(0.25 * longest)) } else { (1.0, 1.0) };
    let margin = MARGIN * size_px;
    let scale = (size_px - 2.0 * margin) / w.max(h);
    let (width, height) = (w * scale + 2.0 * margin, h * scale + 2.0 * margin);
    let view = View::fit(bounds, Rect::new(margin, margin, width - margin, height - margin), y_up);
    (Page::new(width, height), view)
}

/// The box around splines and strokes; a unit box around the origin if there are none.
pub(crate) fn bounds<'a>(splines: impl Iterator<Item = &'a Spline>, strokes: impl Iterator<Item = &'a Stroke>) -> Rect {
    let of_splines = splines.map(Spline::bounding_box);
    let of_strokes = strokes.flat_map(drawable_points).map(|p| Rect::from_points(p, p));
    of_splines.chain(of_strokes).reduce(|a, b| a.union(b)).unwrap_or(Rect::new(-0.5, -0.5, 0.5, 0.5))
}

/// Points of the page without those too near to the one before to be told from it; the last stays.
pub(crate) fn thinned(points: impl Iterator<Item = Point>) -> impl Iterator<Item = Point> {
    const APART_PX: f64 = 0.2;
    let mut points = points.peekable();
    let mut kept: Option<Point> = None;
    std::iter::from_fn(move || {
        loop {
            let p = points.next()?;
            let last = points.peek().is_none();
            if last || kept.is_none_or(|k| (p - k).hypot() >= APART_PX) {
                kept = Some(p);
                return kept;
            }
        }
    })
}

/// How long the comb's teeth are, and how dense.
#[derive(Clone, Copy)]
pub(crate) struct CombScale {
    /// Tooth length over curvature; nothing without a comb.
    scale: Option<f64>,
    /// Longest tooth.
    longest: f64,
    spacing: f64,
}

impl CombScale {
    /// The comb with about `teeth` teeth along a line across the drawing.
    pub(crate) fn of<'a>(comb: Comb, splines: impl Iterator<Item = &'a Spline>, bounds: Rect, teeth: f64) -> Self {
        let spacing = bounds.width().max(bounds.height()) / teeth;
        let mut longest = f64::INFINITY;
        let scale = match comb {
            Comb::Off => None,
            Comb::Scale(scale) => Some(scale).filter(|s| s.is_finite()),
            Comb::Auto => {
                let mut height: f64 = 0.0;
                let mut teeth = Vec::new();
                for spline in splines {
                    let own = spline.bounding_box();
                    height = height.max(COMB_HEIGHT * own.width().max(own.height()));
                    teeth.extend(spline.comb(spacing, 0.0));
                }
                longest = COMB_CUT * height;
                let mut curvatures: Vec<f64> = teeth.iter().map(|t| t.curvature.abs()).filter(|k| *k > 0.0).collect();
                curvatures.sort_by(f64::total_cmp);
                let rank = ((1.0 - COMB_OUTLIERS) * curvatures.len() as f64) as usize;
                curvatures.get(rank.min(curvatures.len().saturating_sub(1))).map(|k| height / k)
            }
        };
        Self { scale: scale.filter(|_| spacing > 0.0), longest, spacing }
    }

    /// The one of two scales that has longer teeth.
    pub(crate) fn higher(self, other: Self) -> Self {
        if other.scale.unwrap_or(0.0) > self.scale.unwrap_or(0.0) { other } else { self }
    }

    /// Where a tooth ends in the picture.
    fn tip(&self, tooth: &Tooth) -> Point {
        let whole = tooth.tip - tooth.base;
        let length = whole.hypot();
        if length > self.longest { tooth.base + whole * (self.longest / length) } else { tooth.tip }
    }

    /// The box around the comb too, but not farther than the drawing's own size.
    pub(crate) fn widened<'a>(&self, bounds: Rect, splines: impl Iterator<Item = &'a Spline>) -> Rect {
        let Some(scale) = self.scale else { return bounds };
        let most = 0.5 * bounds.width().max(bounds.height());
        let tips = splines.flat_map(|s| s.comb(self.spacing, scale)).map(|t| self.tip(&t));
        tips.fold(bounds, |b, p| b.union_pt(p)).intersect(bounds.inflate(most, most))
    }
}

/// Draws with line widths that suit a page's size.
#[derive(Clone, Copy)]
pub(crate) struct Pen {
    /// Thousandth part of the page, or what passes for it, px.
    pub(crate) unit: f64,
}

impl Pen {
    pub(crate) fn for_size(size_px: f64) -> Self {
        Self { unit: sane_size(size_px) / 1000.0 }
    }

    /// The stroke as drawn, pale, with its points.
    pub(crate) fn ghost(&self, page: &mut Page, view: &View, stroke: &Stroke) {
        let on_page = || thinned(drawable_points(stroke).map(|p| view.point(p)));
        page.polyline(
            on_page(),
            format_args!(
                "fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2}\" opacity=\"0.75\"",
                colour::GHOST,
                self.unit
            ),
        );
        page.dots(on_page(), 1.6 * self.unit, format_args!("stroke=\"{}\"", colour::GHOST));
    }

    /// The segments in the colours of their kinds.
    pub(crate) fn spline(&self, page: &mut Page, view: &View, spline: &Spline) {
        page.open(format_args!("fill=\"none\" stroke-width=\"{:.2}\"", 2.1 * self.unit));
        for s in spline.segments() {
            page.path(&view.segment(s), format_args!("stroke=\"{}\"", colour_of(s.kind())));
        }
        page.close();
    }

    /// The curvature comb: thin teeth and the line through their tips, which breaks at corners: there is no curvature there.
    pub(crate) fn comb(&self, page: &mut Page, view: &View, spline: &Spline, comb: CombScale) {
        let Some(scale) = comb.scale else { return };
        let teeth = spline.comb(comb.spacing / TIPS_PER_TOOTH as f64, scale);
        let mut lines = BezPath::new();
        let mut tips = BezPath::new();
        let mut before = None;
        let mut in_segment = 0;
        for t in &teeth {
            let corner = |i: usize| spline.joins().get(i) == Some(&Continuity::G0);
            let new = before != Some(t.segment);
            let tip = view.point(comb.tip(t));
            if before.is_none() || new && before.is_some_and(corner) {
                tips.move_to(tip);
            } else {
                tips.line_to(tip);
            }
            in_segment = if new { 0 } else { in_segment + 1 };
            if in_segment % TIPS_PER_TOOTH == 0 {
                lines.move_to(view.point(t.base));
                lines.line_to(tip);
            }
            before = Some(t.segment);
        }
        let width = 0.55 * self.unit;
        page.open(format_args!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.2}\"", colour::COMB));
        page.path(&lines, format_args!("opacity=\"0.55\""));
        page.path(&tips, format_args!("stroke-width=\"{:.2}\"", 1.6 * width));
        page.close();
    }

    /// Joins as a type designer marks nodes: smooth ones by a tick across the curve (two for G3, half for G1), corners by a square, ends by a ring.
    pub(crate) fn marks(&self, page: &mut Page, view: &View, spline: &Spline) {
        let segments = spline.segments();
        page.open(format_args!("fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"{:.2}\"", colour::MARK, 0.9 * self.unit));
        for (i, join) in spline.joins().iter().enumerate() {
            let next = &segments[(i + 1) % segments.len()];
            let at = view.point(next.start);
            let tangent = view.direction(next.tangent_at(0.0));
            self.join(page, at, tangent, *join);
        }
        if !spline.is_closed()
            && let (Some(first), Some(last)) = (segments.first(), segments.last())
        {
            for end in [first.start, last.end()] {
                page.circle(view.point(end), 3.0 * self.unit, format_args!(""));
            }
        }
        page.close();
    }

    fn join(&self, page: &mut Page, at: Point, tangent: Vec2, join: Continuity) {
        let across = Vec2::new(-tangent.y, tangent.x) * (6.0 * self.unit);
        match join {
            Continuity::G0 => {
                page.square(at, 3.0 * self.unit, format_args!("fill=\"{}\" stroke=\"none\"", colour::MARK));
            }
            Continuity::G1 => page.line(at, at + across, format_args!("")),
            Continuity::G2 => page.line(at - across, at + across, format_args!("")),
            Continuity::G3 => {
                for shift in [-1.2, 1.2] {
                    let at = at + tangent * (shift * self.unit);
                    page.line(at - across, at + across, format_args!(""));
                }
            }
        }
    }
}
