//! Strokes from SVG: every subpath of path, polyline, polygon and line, with transforms applied, all in f64.
//!
//! Frame: the coordinates are those of the outermost element, y down. Its `viewBox` chooses what is shown, not where things are, so
//! it only scales: by 1 unless it and `width` say otherwise. A `width` in mm, cm, in or pt makes that the unit, else it is px.
//! What is not drawn (`defs`, `display="none"` as attribute or in `style`) is no stroke; style sheets, `visibility` and
//! `transform-origin` are not looked at; what is drawn but has no line to follow (text, images, and the
//! shapes rect, circle and ellipse) is named in a warning.

use crate::error::{Error, Fault};
use crate::input::Budget;
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::strokes_json::check_writable;
use crate::svg_geometry::{fit_view_box, flatten, length_px, moved, points, subpaths, transform, view_box};
use crate::unit::{Unit, YAxis};
use crate::xml;
use fairpath_curve::Point;
use fairpath_fit::{Stroke, Warning};
use kurbo::{Affine, BezPath, Size};
use roxmltree::Node;
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;

/// Attribute of the outermost element: the unit of the coordinates, where SVG has no word for it.
const UNIT: &str = "data-unit";
/// Attribute of the outermost element: `up` where the drawing shows coordinates of a y-up frame, flipped by a transform.
const Y: &str = "data-y";
/// Attribute of a stroke: its name, where it would not do as an id.
const NAME: &str = "data-name";

/// A subpath as it is drawn, in the frame of the outermost element.
pub(crate) struct Subpath {
    pub(crate) name: String,
    /// Where in the file it is.
    pub(crate) place: String,
    pub(crate) path: BezPath,
}

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    Ok(read_drawing(text, options, false)?.0)
}

/// The subpaths that [`read`] would make strokes of, with their lines and Béziers as they are, beside a file without strokes.
pub(crate) fn read_subpaths(text: &str, options: &ReadOptions) -> Result<(StrokeFile, Vec<Subpath>), Fault> {
    read_drawing(text, options, true)
}

fn read_drawing(text: &str, options: &ReadOptions, as_drawn: bool) -> Result<(StrokeFile, Vec<Subpath>), Fault> {
    let document = xml::parse(text, &options.limits)?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(Fault::new(xml::place(root), "expected <svg> as the outermost element"));
    }
    let mut reader = Reader {
        options,
        points: Budget::points(&options.limits),
        items: Budget::items(&options.limits),
        nodes: Budget::nodes(&options.limits),
        work: Budget::work(&options.limits),
        by_id: ids(root),
        passed_over: BTreeMap::new(),
        file: StrokeFile::default(),
        as_drawn: as_drawn.then(Vec::new),
    };
    let frame = Frame::of(root).map_err(|problem| Fault::new(xml::place(root), problem))?;
    reader.file.unit = frame.unit;
    reader.file.y = frame.y;
    reader
        .children(root, &Place { affine: frame.affine, viewport: frame.viewport, depth: 0, name: None, link: None })?;
    for (tag, count) in &reader.passed_over {
        reader.file.warnings.push(Warning {
            code: "not-a-stroke".into(),
            text: format!("{count} <{tag}> left out: only path, polyline, polygon and line are strokes"),
        });
    }
    Ok((reader.file, reader.as_drawn.unwrap_or_default()))
}

/// The elements that can be referred to; of a repeated id the first counts.
fn ids<'a, 'i>(root: Node<'a, 'i>) -> HashMap<&'a str, Node<'a, 'i>> {
    let mut map = HashMap::new();
    for node in root.descendants() {
        if let Some(id) = node.attribute("id") {
            map.entry(id).or_insert(node);
        }
    }
    map
}

/// What the outermost element says about all coordinates.
struct Frame {
    unit: Unit,
    y: YAxis,
    affine: Affine,
    viewport: Size,
}

impl Frame {
    fn of(root: Node<'_, '_>) -> Result<Self, String> {
        let view = root.attribute("viewBox").map(view_box).transpose()?;
        let side = |name: &str| match root.attribute(name).map(str::trim) {
            Some(text) if !text.ends_with('%') && text != "auto" => Ok(Some((text, length_px(text, 0.0)?))),
            _ => Ok::<_, String>(None),
        };
        let (width, height) = (side("width")?, side("height")?);
        let word = width.or(height).map_or("", |(text, _)| text.trim_start_matches(|c: char| !c.is_ascii_alphabetic()));
        let (unit, px_per_unit) = match word {
            "mm" => (Unit::Mm, 96.0 / 25.4),
            "cm" => (Unit::Cm, 96.0 / 2.54),
            "in" => (Unit::In, 96.0),
            "pt" => (Unit::Pt, 96.0 / 72.0),
            _ => (Unit::Px, 1.0),
        };
        let unit = root.attribute(UNIT).and_then(Unit::from_word).unwrap_or(unit);
        let number = |text: &str| text.trim_end_matches(|c: char| c.is_ascii_alphabetic()).trim().parse::<f64>().ok();
        // In the file's own unit, read anew so that "76.2mm" over "0 0 76.2 …" is a scale of exactly 1.
        let own = |side: Option<(&str, f64)>| {
            side.map(|(text, px)| number(text).filter(|_| text.ends_with(word)).unwrap_or(px / px_per_unit))
        };
        let sides = (own(width), own(height));
        let scale = match (view, sides) {
            (Some(v), (w, h)) if v.w > 0.0 && v.h > 0.0 => {
                let (sx, sy) = (w.map(|w| w / v.w), h.map(|h| h / v.h));
                let none = root.attribute("preserveAspectRatio").is_some_and(|a| a.trim_start().starts_with("none"));
                match (sx, sy) {
                    (Some(sx), Some(sy)) if none => Affine::scale_non_uniform(sx, sy),
                    (Some(sx), Some(sy)) => Affine::scale(sx.min(sy)),
                    (Some(s), None) | (None, Some(s)) => Affine::scale(s),
                    (None, None) => Affine::IDENTITY,
                }
            }
            _ => Affine::scale(1.0 / px_per_unit),
        };
        if !scale.is_finite() || scale.determinant() == 0.0 {
            return Err("width or height is zero or not finite; expected positive lengths".into());
        }
        let y = root.attribute(Y).and_then(YAxis::from_word).unwrap_or_default();
        let flip = if y == YAxis::Up { Affine::FLIP_Y } else { Affine::IDENTITY };
        let viewport = match (view, sides) {
            (Some(v), _) => Size::new(v.w, v.h),
            (None, (w, h)) => Size::new(w.unwrap_or(100.0), h.unwrap_or(100.0)) * px_per_unit,
        };
        Ok(Self { unit, y, affine: flip * scale, viewport })
    }
}

/// Where in the drawing the reader is.
struct Place<'p> {
    affine: Affine,
    /// What percentages are of.
    viewport: Size,
    depth: u64,
    /// The name that an enclosing `use` gives.
    name: Option<String>,
    /// The references that are being followed, innermost first.
    link: Option<&'p Link<'p>>,
}

struct Link<'p> {
    id: &'p str,
    before: Option<&'p Link<'p>>,
}

struct Reader<'a, 'i> {
    options: &'a ReadOptions,
    points: Budget,
    items: Budget,
    nodes: Budget,
    work: Budget,
    by_id: HashMap<&'a str, Node<'a, 'i>>,
    passed_over: BTreeMap<&'a str, usize>,
    file: StrokeFile,
    /// Where subpaths go that are wanted as drawn; without it, they become strokes.
    as_drawn: Option<Vec<Subpath>>,
}

impl<'a, 'i: 'a> Reader<'a, 'i> {
    fn children(&mut self, node: Node<'a, 'i>, place: &Place<'_>) -> Result<(), Fault> {
        for child in node.children().filter(Node::is_element) {
            self.element(child, place)?;
        }
        Ok(())
    }

    fn element(&mut self, node: Node<'a, 'i>, place: &Place<'_>) -> Result<(), Fault> {
        let at = || xml::place(node);
        let fault = |problem: String| Fault::new(at(), problem);
        self.nodes.spend(at)?;
        self.work.spend_many(node.attributes().map(|a| a.value().len()).sum(), at)?;
        let max = self.options.limits.max_depth;
        if place.depth >= max {
            return Err(Fault::OverLimit { place: at(), what: "levels of nesting", max, limit: "max_depth" });
        }
        if is_hidden(node) {
            return Ok(());
        }
        let own = node.attribute("transform").map(transform).transpose().map_err(fault)?;
        let affine = place.affine * own.unwrap_or(Affine::IDENTITY);
        let inner = Place { affine, depth: place.depth + 1, name: place.name.clone(), ..*place };
        match node.tag_name().name() {
            "g" | "a" | "switch" => self.children(node, &inner),
            "svg" => self.viewport(node, &inner, None),
            "use" => self.follow(node, &inner),
            "path" => {
                let paths = subpaths(node.attribute("d").unwrap_or_default()).map_err(fault)?;
                self.strokes(node, &inner, paths)
            }
            "polyline" => self.polyline(node, &inner, false),
            "polygon" => self.polyline(node, &inner, true),
            "line" => {
                let end = |x, y| {
                    Ok(Point::new(
                        coordinate(node, x, inner.viewport.width)?,
                        coordinate(node, y, inner.viewport.height)?,
                    ))
                };
                let ends = end("x1", "y1").and_then(|a| Ok([a, end("x2", "y2")?])).map_err(fault)?;
                self.strokes(node, &inner, vec![polyline(&ends, false)])
            }
            tag @ ("rect" | "circle" | "ellipse" | "text" | "image" | "foreignObject") => {
                *self.passed_over.entry(tag).or_insert(0) += 1;
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn polyline(&mut self, node: Node<'a, 'i>, place: &Place<'_>, closed: bool) -> Result<(), Fault> {
        let points = points(node.attribute("points").unwrap_or_default());
        let points = points.map_err(|problem| Fault::new(xml::place(node), problem))?;
        if points.is_empty() {
            return Ok(());
        }
        self.strokes(node, place, vec![polyline(&points, closed)])
    }

    /// The content of an inner `svg` or, of the size that a `use` gives, of a `symbol`.
    fn viewport(&mut self, node: Node<'a, 'i>, place: &Place<'_>, user: Option<Node<'a, 'i>>) -> Result<(), Fault> {
        let inner = (|| {
            let size = |name: &str, whole: f64| match user.and_then(|u| u.attribute(name)).or(node.attribute(name)) {
                Some(text) if text != "auto" => length_px(text, whole),
                _ => Ok(whole),
            };
            let offset = (coordinate(node, "x", place.viewport.width)?, coordinate(node, "y", place.viewport.height)?);
            let (width, height) = (size("width", place.viewport.width)?, size("height", place.viewport.height)?);
            let mut affine = place.affine * Affine::translate(offset);
            let mut viewport = Size::new(width, height);
            if let Some(view) = node.attribute("viewBox").map(view_box).transpose()? {
                affine *= fit_view_box(view, width, height, node.attribute("preserveAspectRatio"))?;
                viewport = Size::new(view.w, view.h);
            }
            Ok(Place { affine, viewport, name: place.name.clone(), ..*place })
        })();
        let inner = inner.map_err(|problem: String| Fault::new(xml::place(node), problem))?;
        self.children(node, &inner)
    }

    fn follow(&mut self, node: Node<'a, 'i>, place: &Place<'_>) -> Result<(), Fault> {
        let xlink = node.attribute(("http://www.w3.org/1999/xlink", "href"));
        let Some(href) = node.attribute("href").or(xlink) else { return Ok(()) };
        let fault = |problem: String| Fault::new(xml::place(node), problem);
        let Some(id) = href.trim().strip_prefix('#') else {
            return Err(fault(format!("it refers to {href:?} outside the file; expected \"#id\"")));
        };
        let Some(&target) = self.by_id.get(id) else {
            return Err(fault(format!("it refers to {href:?}, but no element has that id")));
        };
        let mut link = place.link;
        while let Some(l) = link {
            if l.id == id {
                return Err(fault(format!("it refers to {href:?}, inside which it stands; break the circle")));
            }
            link = l.before;
        }
        let offset = coordinate(node, "x", place.viewport.width)
            .and_then(|x| Ok((x, coordinate(node, "y", place.viewport.height)?)))
            .map_err(fault)?;
        let affine = place.affine * Affine::translate(offset);
        let name = node.attribute("id").map(str::to_owned).or(place.name.clone());
        let here = Link { id, before: place.link };
        let inner = Place { affine, viewport: place.viewport, depth: place.depth, name, link: Some(&here) };
        if target.tag_name().name() != "symbol" {
            return self.element(target, &inner);
        }
        let own = target.attribute("transform").map(transform).transpose().map_err(fault)?;
        let inner = Place { affine: affine * own.unwrap_or(Affine::IDENTITY), depth: inner.depth + 1, ..inner };
        if inner.depth >= self.options.limits.max_depth {
            let (place, max) = (xml::place(node), self.options.limits.max_depth);
            return Err(Fault::OverLimit { place, what: "levels of nesting", max, limit: "max_depth" });
        }
        self.viewport(target, &inner, Some(node))
    }

    /// Takes the subpaths of one element as strokes.
    fn strokes(&mut self, node: Node<'a, 'i>, place: &Place<'_>, paths: Vec<BezPath>) -> Result<(), Fault> {
        let at = || xml::place(node);
        let several = paths.len() > 1;
        let own = node.attribute(NAME).or(node.attribute("id")).map(str::to_owned);
        let base = match (&place.name, own) {
            (Some(user), Some(own)) => format!("{user}/{own}"),
            (Some(user), None) => user.clone(),
            (None, Some(own)) => own,
            (None, None) => {
                let before = self.as_drawn.as_ref().map_or(self.file.strokes.len(), Vec::len);
                format!("{}/{before}", node.tag_name().name())
            }
        };
        for (i, mut path) in paths.into_iter().enumerate() {
            self.items.spend(at)?;
            for el in path.elements_mut() {
                *el = moved_element(place.affine, *el);
            }
            if !path.is_finite() {
                return Err(Fault::new(at(), "a coordinate is not finite once transformed; expected smaller numbers"));
            }
            let name = if several { format!("{base}/{i}") } else { base.clone() };
            if let Some(as_drawn) = &mut self.as_drawn {
                self.points.spend_many(path.elements().len(), at)?;
                as_drawn.push(Subpath { name, place: at(), path });
                continue;
            }
            let Some(points) = flatten(&path, self.options.flatten_tolerance, self.points.left()) else {
                let max = self.options.limits.max_points;
                return Err(Fault::OverLimit { place: at(), what: "points", max, limit: "max_points" });
            };
            self.points.spend_many(points.len(), at)?;
            self.file.strokes.push(Stroke::new(name, points));
        }
        Ok(())
    }
}

fn moved_element(by: Affine, el: kurbo::PathEl) -> kurbo::PathEl {
    use kurbo::PathEl::{ClosePath, CurveTo, LineTo, MoveTo, QuadTo};
    match el {
        MoveTo(p) => MoveTo(moved(by, p)),
        LineTo(p) => LineTo(moved(by, p)),
        QuadTo(a, p) => QuadTo(moved(by, a), moved(by, p)),
        CurveTo(a, b, p) => CurveTo(moved(by, a), moved(by, b), moved(by, p)),
        ClosePath => ClosePath,
    }
}

/// Whether the element and all inside it are not drawn.
fn is_hidden(node: Node<'_, '_>) -> bool {
    let none = |value: &str| value.trim() == "none";
    let in_style = |style: &str| {
        style.split(';').filter_map(|rule| rule.split_once(':')).any(|(k, v)| k.trim() == "display" && none(v))
    };
    node.attribute("display").is_some_and(none) || node.attribute("style").is_some_and(in_style)
}

/// A coordinate attribute in px, 0 if absent.
fn coordinate(node: Node<'_, '_>, name: &str, whole: f64) -> Result<f64, String> {
    node.attribute(name).map_or(Ok(0.0), |text| length_px(text, whole))
}

fn polyline(points: &[Point], closed: bool) -> BezPath {
    let mut path = BezPath::new();
    for (i, &p) in points.iter().enumerate() {
        if i == 0 { path.move_to(p) } else { path.line_to(p) }
    }
    if closed {
        path.close_path();
    }
    path
}

pub(crate) fn write(file: &StrokeFile) -> Result<Vec<u8>, Error> {
    let mut bounds: Option<kurbo::Rect> = None;
    for stroke in &file.strokes {
        check_writable(stroke, "SVG")?;
        if stroke.points.is_empty() {
            let problem = "it has no points, and SVG cannot hold such a one; write JSON, or leave it out".into();
            return Err(Error::Unwritable { format: "SVG", place: format!("stroke {:?}", stroke.name), problem });
        }
        for &p in &stroke.points {
            bounds = Some(bounds.map_or(kurbo::Rect::from_points(p, p), |b| b.union_pt(p)));
        }
    }
    let mut out = String::new();
    let width = open_svg(&mut out, bounds, file.unit, file.y);
    let mut put = |args: std::fmt::Arguments<'_>| out.write_fmt(args).expect("writing to a String does not fail");
    put(format_args!(
        "<g fill=\"none\" stroke=\"#222\" stroke-width=\"{width}\" stroke-linejoin=\"round\"{}>\n",
        flip(file.y)
    ));
    for stroke in &file.strokes {
        put(format_args!("<polyline {NAME}=\"{}\" points=\"", xml::attribute(&stroke.name)));
        for (i, p) in stroke.points.iter().enumerate() {
            put(format_args!("{}{},{}", if i == 0 { "" } else { " " }, p.x, p.y));
        }
        put(format_args!("\"/>\n"));
    }
    put(format_args!("</g>\n</svg>\n"));
    Ok(out.into_bytes())
}

/// The transform that shows coordinates of a y-up frame upright.
pub(crate) fn flip(y: YAxis) -> &'static str {
    if y == YAxis::Up { " transform=\"scale(1,-1)\"" } else { "" }
}

/// Begins an SVG file that shows `bounds` (in the unit and frame of the coordinates) with a margin; gives back a fitting line width.
pub(crate) fn open_svg(out: &mut String, bounds: Option<kurbo::Rect>, unit: Unit, y: YAxis) -> f64 {
    let bounds = bounds.unwrap_or(kurbo::Rect::new(0.0, 0.0, 1.0, 1.0));
    let extent = bounds.width().max(bounds.height());
    let size = if extent > 0.0 { extent } else { 1.0 };
    let far = bounds.x0.abs().max(bounds.x1.abs()).max(bounds.y0.abs()).max(bounds.y1.abs());
    // Wide enough to be there after rounding, however far out the drawing lies.
    let margin = (0.05 * size).max(1e-12 * far);
    let shown = bounds.inflate(margin, margin);
    let top = if y == YAxis::Up { -shown.y1 } else { shown.y0 };
    let word = match unit {
        Unit::Mm | Unit::Cm | Unit::In | Unit::Pt => unit.as_str(),
        Unit::Px | Unit::M | Unit::Km | Unit::Ft => "",
    };
    let [x, y0, w, h] = [shown.x0, top, shown.width(), shown.height()];
    out.write_fmt(format_args!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" \
         width=\"{w}{word}\" height=\"{h}{word}\" viewBox=\"{x} {y0} {w} {h}\" {UNIT}=\"{unit}\" {Y}=\"{}\">\n",
        y.as_str()
    ))
    .expect("writing to a String does not fail");
    0.004 * size
}
