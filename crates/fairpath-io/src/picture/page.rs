//! The page: a frame of the drawing on it, marks in page px, and the finished picture as SVG and PNG.

use crate::error::Error;
use fairpath_curve::{Kind, Point, Segment, Spline};
use kurbo::{Affine, BezPath, PathEl, Rect, Vec2};
use resvg::{tiny_skia, usvg};
use std::fmt::{Arguments, Write};

/// Colours of the pictures.
pub(crate) mod colour {
    pub(crate) const LINE: &str = "#d7263d";
    pub(crate) const ARC: &str = "#1a9850";
    pub(crate) const CLOTHOID: &str = "#2166c4";
    pub(crate) const GHOST: &str = "#b9bfc8";
    pub(crate) const STROKE: &str = "#3c4149";
    pub(crate) const SAMPLE: &str = "#5b6470";
    pub(crate) const MARK: &str = "#23272e";
    pub(crate) const COMB: &str = "#9a86c9";
    pub(crate) const LABEL: &str = "#4a505a";
    pub(crate) const FAINT: &str = "#8b919b";
    pub(crate) const RULE: &str = "#eceef1";
    pub(crate) const TEMPLATE: &str = "#59636f";
    pub(crate) const CELLULOID: &str = "#f4e9c8";
    pub(crate) const REPLACED: &str = "#f08a24";
    pub(crate) const WIDENED: &str = "#fbd9b0";
    pub(crate) const FAILED: &str = "#b3261e";
}

/// The colour of a kind of segment.
pub(crate) const fn colour_of(kind: Kind) -> &'static str {
    match kind {
        Kind::Line => colour::LINE,
        Kind::Arc => colour::ARC,
        Kind::Clothoid => colour::CLOTHOID,
    }
}

/// Colours that tell pieces of French curves apart, used in turn: neighbours differ in hue and in lightness.
const PIECES: [&str; 10] =
    ["#d7263d", "#2166c4", "#e08a00", "#1a9850", "#8e44ad", "#0f9bb0", "#c2478f", "#6b7a1f", "#4b4fc4", "#a65628"];

/// The colour of a piece of a French curve.
pub(crate) const fn colour_of_piece(index: usize) -> &'static str {
    PIECES[index % PIECES.len()]
}

/// Accuracy of curves on the page, px.
const ACCURACY_PX: f64 = 0.02;

/// Most pixels of a PNG: a larger page is scaled down.
const MAX_PIXELS: f64 = 64e6;

/// How the drawing lies on the page.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    centre: Point,
    on_page: Vec2,
    /// px per unit of the drawing.
    pub(crate) scale: f64,
    /// −1 where the drawing's y points up.
    y_sign: f64,
}

impl View {
    /// Fits `bounds` of the drawing into `into` on the page, keeping its proportions.
    pub(crate) fn fit(bounds: Rect, into: Rect, y_up: bool) -> Self {
        let scale = (into.width() / bounds.width()).min(into.height() / bounds.height());
        let scale = if scale.is_finite() && scale > 0.0 { scale } else { 1.0 };
        Self { centre: bounds.center(), on_page: into.center().to_vec2(), scale, y_sign: if y_up { -1.0 } else { 1.0 } }
    }

    /// A point of the drawing on the page.
    pub(crate) fn point(&self, p: Point) -> Point {
        let v = (p - self.centre) * self.scale;
        Point::new(v.x, v.y * self.y_sign) + self.on_page
    }

    /// A segment as a path on the page.
    pub(crate) fn segment(&self, segment: &Segment) -> BezPath {
        // Moved near the origin before the rounding of Béziers.
        let local = Segment { start: (segment.start - self.centre).to_point(), ..*segment };
        let mut path = BezPath::new();
        path.move_to(local.start);
        for c in local.to_beziers(ACCURACY_PX / self.scale) {
            path.push(if segment.kind() == Kind::Line {
                PathEl::LineTo(c.p3)
            } else {
                PathEl::CurveTo(c.p1, c.p2, c.p3)
            });
        }
        path.apply_affine(
            Affine::translate(self.on_page) * Affine::scale_non_uniform(self.scale, self.scale * self.y_sign),
        );
        path
    }

    /// A whole spline as one path on the page, closed if it is.
    pub(crate) fn spline(&self, spline: &Spline) -> BezPath {
        let mut path = BezPath::new();
        for segment in spline.segments() {
            let begun = !path.elements().is_empty();
            path.extend(self.segment(segment).into_iter().skip(usize::from(begun)));
        }
        if spline.is_closed() {
            path.close_path();
        }
        path
    }

    /// The direction on the page of a heading in the drawing.
    pub(crate) fn direction(&self, tangent: Vec2) -> Vec2 {
        Vec2::new(tangent.x, tangent.y * self.y_sign)
    }
}

/// A path as SVG writes it, to a hundredth of a px.
pub(crate) fn path_data(path: &BezPath) -> String {
    let mut out = String::new();
    for el in path.elements() {
        let written = match el {
            PathEl::MoveTo(p) => write!(out, "M{:.2} {:.2}", p.x, p.y),
            PathEl::LineTo(p) => write!(out, "L{:.2} {:.2}", p.x, p.y),
            PathEl::QuadTo(a, p) => write!(out, "Q{:.2} {:.2} {:.2} {:.2}", a.x, a.y, p.x, p.y),
            PathEl::CurveTo(a, b, p) => {
                write!(out, "C{:.2} {:.2} {:.2} {:.2} {:.2} {:.2}", a.x, a.y, b.x, b.y, p.x, p.y)
            }
            PathEl::ClosePath => write!(out, "Z"),
        };
        written.expect("writing to a String does not fail");
    }
    out
}

/// A page being drawn.
pub(crate) struct Page {
    body: String,
    width: f64,
    height: f64,
    zoom: f64,
}

impl Page {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        Self { body: String::new(), width: width.round().max(1.0), height: height.round().max(1.0), zoom: 1.0 }
    }

    /// The same page shown larger.
    pub(crate) fn zoomed(self, zoom: f64) -> Self {
        Self { zoom, ..self }
    }

    /// The whole page.
    pub(crate) fn bounds(&self) -> Rect {
        Rect::new(0.0, 0.0, self.width, self.height)
    }

    fn put(&mut self, args: Arguments<'_>) {
        self.body.write_fmt(args).expect("writing to a String does not fail");
    }

    /// Opens a group that has the attributes.
    pub(crate) fn open(&mut self, attributes: Arguments<'_>) {
        self.put(format_args!("<g {attributes}>\n"));
    }

    /// Opens a group of which only what lies in a rectangle is seen. `id` must differ from those of other such groups of the page.
    pub(crate) fn open_clipped(&mut self, seen: Rect, id: &str) {
        let [x, y, w, h] = [seen.x0, seen.y0, seen.width(), seen.height()];
        self.put(format_args!(
            "<clipPath id=\"{id}\"><rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\"/></clipPath>\n\
             <g clip-path=\"url(#{id})\">\n"
        ));
    }

    /// Closes the last group.
    pub(crate) fn close(&mut self) {
        self.put(format_args!("</g>\n"));
    }

    /// A curve; `attributes` may add to those of the group around.
    pub(crate) fn path(&mut self, path: &BezPath, attributes: Arguments<'_>) {
        self.put(format_args!("<path d=\"{}\" {attributes}/>\n", path_data(path)));
    }

    /// A polyline through points of the page.
    pub(crate) fn polyline(&mut self, points: impl Iterator<Item = Point>, attributes: Arguments<'_>) {
        self.put(format_args!("<polyline points=\""));
        for p in points {
            self.put(format_args!("{:.2},{:.2} ", p.x, p.y));
        }
        self.put(format_args!("\" {attributes}/>\n"));
    }

    /// Disks of one radius, as one element.
    pub(crate) fn dots(&mut self, points: impl Iterator<Item = Point>, radius: f64, attributes: Arguments<'_>) {
        self.put(format_args!(
            "<path stroke-linecap=\"round\" fill=\"none\" stroke-width=\"{:.2}\" d=\"",
            2.0 * radius
        ));
        for p in points {
            self.put(format_args!("M{:.2} {:.2}h0", p.x, p.y));
        }
        self.put(format_args!("\" {attributes}/>\n"));
    }

    /// A circle.
    pub(crate) fn circle(&mut self, centre: Point, radius: f64, attributes: Arguments<'_>) {
        let Point { x, y } = centre;
        self.put(format_args!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" {attributes}/>\n"));
    }

    /// A straight line.
    pub(crate) fn line(&mut self, a: Point, b: Point, attributes: Arguments<'_>) {
        let [x0, y0, x1, y1] = [a.x, a.y, b.x, b.y];
        self.put(format_args!("<path d=\"M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}\" {attributes}/>\n"));
    }

    /// A square with sides along the axes.
    pub(crate) fn square(&mut self, centre: Point, half: f64, attributes: Arguments<'_>) {
        let (x, y, side) = (centre.x - half, centre.y - half, 2.0 * half);
        self.put(format_args!(
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{side:.2}\" height=\"{side:.2}\" {attributes}/>\n"
        ));
    }

    pub(crate) fn finish(self) -> Picture {
        let (w, h) = (self.width, self.height);
        let (width_px, height_px) = ((w * self.zoom).round(), (h * self.zoom).round());
        let svg = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width_px}\" \
             height=\"{height_px}\" viewBox=\"0 0 {w} {h}\">\n<rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n\
             <g stroke-linecap=\"round\" stroke-linejoin=\"round\">\n{}</g>\n</svg>\n",
            self.body
        );
        Picture { svg, width_px, height_px }
    }
}

/// A finished picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    svg: String,
    width_px: f64,
    height_px: f64,
}

impl Picture {
    /// The picture as an SVG file.
    #[must_use]
    pub fn to_svg(&self) -> &str {
        &self.svg
    }

    /// Width and height of the page, px.
    #[must_use]
    pub fn size_px(&self) -> (f64, f64) {
        (self.width_px, self.height_px)
    }

    /// The picture as a PNG file, a pixel for each px of the page, less where that were more than 64 million.
    ///
    /// # Errors
    /// [`Error::Unwritable`] when the page cannot be drawn.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        let fail = |problem: String| Error::Unwritable { format: "PNG", place: "the picture".into(), problem };
        let scale = (MAX_PIXELS / (self.width_px * self.height_px)).sqrt().min(1.0) as f32;
        let pixels = |px: f64| ((px as f32 * scale).round().max(1.0)) as u32;
        let tree = usvg::Tree::from_str(&self.svg, &usvg::Options::default()).map_err(|e| fail(e.to_string()))?;
        let mut pixmap = tiny_skia::Pixmap::new(pixels(self.width_px), pixels(self.height_px))
            .ok_or_else(|| fail("the page is too large for the memory; make it smaller".into()))?;
        resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixmap.as_mut());
        pixmap.encode_png().map_err(|e| fail(e.to_string()))
    }
}
