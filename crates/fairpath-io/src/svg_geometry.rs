//! The geometry of SVG attributes: path data, point lists, transforms and view boxes, all in f64.

use kurbo::{Affine, Arc, BezPath, PathEl, Point, SvgArc, Vec2};
use std::str::FromStr;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, PathParser, PathSegment, PointsParser, ViewBox};

/// Largest coordinate of a curve: beyond it the curve's subdivision would overflow.
const MAX_CURVE_COORDINATE: f64 = 1e60;

/// Curves are not flattened finer than this part of their size.
const FINEST_RELATIVE_TOLERANCE: f64 = 1e-9;

/// The subpaths of path data; those of a single `M`, which draw nothing, are left out.
pub(crate) fn subpaths(data: &str) -> Result<Vec<BezPath>, String> {
    let mut walker = PathWalker::default();
    for segment in PathParser::from(data) {
        walker.step(segment.map_err(|e| {
            format!("the path data are faulty: {e}; expected commands with all their numbers, such as M0 0L1 1")
        })?)?;
    }
    walker.finish();
    Ok(walker.done)
}

/// Follows path data, keeping what its commands refer back to.
#[derive(Default)]
struct PathWalker {
    done: Vec<BezPath>,
    current: BezPath,
    start: Point,
    at: Point,
    cubic_control: Option<Point>,
    quad_control: Option<Point>,
}

impl PathWalker {
    fn finish(&mut self) {
        let path = std::mem::take(&mut self.current);
        if path.elements().len() > 1 {
            self.done.push(path);
        }
    }

    /// The point that a command names, absolute.
    fn point(&self, abs: bool, x: f64, y: f64) -> Point {
        if abs { Point::new(x, y) } else { self.at + Vec2::new(x, y) }
    }

    /// A drawing command after `z` begins at the closed subpath's start.
    fn begin(&mut self) {
        if self.current.elements().is_empty() {
            self.current.move_to(self.at);
        }
    }

    fn line(&mut self, to: Point) {
        self.begin();
        self.current.line_to(to);
        self.at = to;
    }

    fn step(&mut self, segment: PathSegment) -> Result<(), String> {
        let (cubic, quad) = (self.cubic_control.take(), self.quad_control.take());
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                let to = self.point(abs, x, y);
                self.finish();
                self.current.move_to(to);
                (self.at, self.start) = (to, to);
            }
            PathSegment::LineTo { abs, x, y } => self.line(self.point(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                self.line(Point::new(if abs { x } else { self.at.x + x }, self.at.y));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                self.line(Point::new(self.at.x, if abs { y } else { self.at.y + y }));
            }
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.cubic(self.point(abs, x1, y1), self.point(abs, x2, y2), self.point(abs, x, y))?;
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let c1 = cubic.map_or(self.at, |c| self.at + (self.at - c));
                self.cubic(c1, self.point(abs, x2, y2), self.point(abs, x, y))?;
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                self.quad(self.point(abs, x1, y1), self.point(abs, x, y))?;
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                let c = quad.map_or(self.at, |c| self.at + (self.at - c));
                self.quad(c, self.point(abs, x, y))?;
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let to = self.point(abs, x, y);
                let x_rotation = x_axis_rotation.to_radians();
                let radii = Vec2::new(rx.abs(), ry.abs());
                self.arc(SvgArc { from: self.at, to, radii, x_rotation, large_arc, sweep })?;
            }
            PathSegment::ClosePath { .. } => {
                self.begin();
                self.current.close_path();
                self.finish();
                self.at = self.start;
            }
        }
        Ok(())
    }

    fn cubic(&mut self, c1: Point, c2: Point, to: Point) -> Result<(), String> {
        check_curve(&[self.at, c1, c2, to])?;
        self.begin();
        self.current.curve_to(c1, c2, to);
        self.cubic_control = Some(c2);
        self.at = to;
        Ok(())
    }

    fn quad(&mut self, c: Point, to: Point) -> Result<(), String> {
        check_curve(&[self.at, c, to])?;
        self.begin();
        self.current.quad_to(c, to);
        self.quad_control = Some(c);
        self.at = to;
        Ok(())
    }

    fn arc(&mut self, arc: SvgArc) -> Result<(), String> {
        check_curve(&[arc.from, arc.to, arc.radii.to_point()])?;
        let drawable = |a: &Arc| {
            // Radii are enlarged where they do not reach from end to end.
            let (small, large) = (a.radii.x.min(a.radii.y), a.radii.x.max(a.radii.y));
            small > f64::MIN_POSITIVE
                && FINEST_RELATIVE_TOLERANCE * large > f64::MIN_POSITIVE
                && large < MAX_CURVE_COORDINATE
        };
        let Some(elliptic) = Arc::from_svg_arc(&arc).filter(drawable) else {
            self.line(arc.to);
            return Ok(());
        };
        self.begin();
        let tolerance = FINEST_RELATIVE_TOLERANCE * elliptic.radii.x.max(elliptic.radii.y);
        let mut curves: Vec<PathEl> = elliptic.append_iter(tolerance).collect();
        // The arc ends where the path data say, not where rounding leaves it.
        if let Some(PathEl::CurveTo(.., end)) = curves.last_mut() {
            *end = arc.to;
        }
        for curve in curves {
            self.current.push(curve);
        }
        self.at = arc.to;
        Ok(())
    }
}

fn check_curve(points: &[Point]) -> Result<(), String> {
    if points.iter().all(|p| p.x.abs() < MAX_CURVE_COORDINATE && p.y.abs() < MAX_CURVE_COORDINATE) {
        return Ok(());
    }
    Err(format!("a curve reaches beyond ±{MAX_CURVE_COORDINATE:e}; expected smaller coordinates"))
}

/// The points of a `points` attribute.
pub(crate) fn points(data: &str) -> Result<Vec<Point>, String> {
    // The parser ends silently at the first fault: count the numbers to notice.
    let points: Vec<Point> = PointsParser::from(data).map(|(x, y)| Point::new(x, y)).collect();
    let mut numbers = 0;
    for number in svgtypes::NumberListParser::from(data) {
        number.map_err(|e| format!("the points are faulty: {e}"))?;
        numbers += 1;
    }
    if numbers == 2 * points.len() {
        Ok(points)
    } else {
        Err(format!("there are {numbers} numbers, expected an even count: x,y x,y …"))
    }
}

/// A path as points: exact at the ends of its pieces, and within `tolerance` of its curves.
///
/// Gives up, with nothing, after `max` points.
pub(crate) fn flatten(path: &BezPath, tolerance: f64, max: u64) -> Option<Vec<Point>> {
    let size = path.control_box();
    let finest = FINEST_RELATIVE_TOLERANCE * (size.width() + size.height());
    let mut out: Vec<Point> = Vec::new();
    let (mut start, mut at) = (Point::ZERO, Point::ZERO);
    for el in path.elements() {
        if out.len() as u64 >= max {
            return None;
        }
        match *el {
            PathEl::MoveTo(p) => {
                start = p;
                out.push(p);
            }
            PathEl::LineTo(p) => out.push(p),
            PathEl::ClosePath if at == start && out.len() > 1 => {}
            PathEl::ClosePath => out.push(start),
            curve => {
                let piece = [PathEl::MoveTo(at), curve];
                kurbo::flatten(piece, tolerance.max(finest), |el| {
                    if let PathEl::LineTo(p) = el {
                        out.push(p);
                    }
                });
            }
        }
        at = *out.last()?;
    }
    Some(out)
}

/// The transform of a `transform` attribute.
pub(crate) fn transform(data: &str) -> Result<Affine, String> {
    let t = svgtypes::Transform::from_str(data).map_err(|e| format!("the transform is faulty: {e}"))?;
    Ok(Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]))
}

/// A point moved by a transform; the identity leaves every bit as it is.
pub(crate) fn moved(by: Affine, p: Point) -> Point {
    if by == Affine::IDENTITY { p } else { by * p }
}

/// A length in px; percentages are of `whole`.
pub(crate) fn length_px(text: &str, whole: f64) -> Result<f64, String> {
    let Length { number, unit } =
        Length::from_str(text.trim()).map_err(|e| format!("the length {text:?} is faulty: {e}"))?;
    Ok(number
        * match unit {
            LengthUnit::None | LengthUnit::Px => 1.0,
            LengthUnit::In => 96.0,
            LengthUnit::Cm => 96.0 / 2.54,
            LengthUnit::Mm => 96.0 / 25.4,
            LengthUnit::Pt => 96.0 / 72.0,
            LengthUnit::Pc => 16.0,
            LengthUnit::Em => 16.0,
            LengthUnit::Ex => 8.0,
            LengthUnit::Percent => whole / 100.0,
        })
}

/// A `viewBox`.
pub(crate) fn view_box(text: &str) -> Result<ViewBox, String> {
    ViewBox::from_str(text).map_err(|e| format!("the viewBox is faulty: {e}; expected `x y width height`"))
}

/// The transform from a view box to a viewport of `width` × `height` at the origin.
pub(crate) fn fit_view_box(view: ViewBox, width: f64, height: f64, aspect: Option<&str>) -> Result<Affine, String> {
    let aspect = match aspect {
        Some(text) => AspectRatio::from_str(text).map_err(|e| format!("preserveAspectRatio is faulty: {e}"))?,
        None => AspectRatio::default(),
    };
    let (mut sx, mut sy) = (width / view.w, height / view.h);
    if aspect.align != Align::None {
        let s = if aspect.slice { sx.max(sy) } else { sx.min(sy) };
        (sx, sy) = (s, s);
    }
    let (free_x, free_y) = (width - view.w * sx, height - view.h * sy);
    let (part_x, part_y) = match aspect.align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    };
    let offset = Vec2::new(free_x * part_x - view.x * sx, free_y * part_y - view.y * sy);
    Ok(Affine::translate(offset) * Affine::scale_non_uniform(sx, sy))
}
