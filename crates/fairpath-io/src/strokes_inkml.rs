//! Strokes from W3C InkML (2011): traces with the channels X, Y, T (time) and F (force), difference-encoded or not.
//!
//! Frame: X and Y as they stand, in the unit of channel X (`mm`, `cm`, `in`, `pt`, `m`; `himetric` becomes mm; all else is px); y points
//! down unless Y has `orientation="-ve"`. T is in ms unless its channel says otherwise. F is divided by its channel's `max`, or if there
//! is none and some value is above 1, by the largest of the file. Traces of type `penUp` are no strokes. A trace that continues
//! another (`continuation`, `priorRef`) is appended to it. `traceView`s only select from traces and are passed over.

use crate::error::Fault;
use crate::input::Budget;
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::unit::{Unit, YAxis};
use crate::xml;
use fairpath_curve::Point;
use fairpath_fit::{Stroke, Warning};
use roxmltree::Node;
use std::collections::HashMap;

/// Most channels of a trace format; the standard names some thirty.
const MAX_CHANNELS: usize = 64;

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    let document = xml::parse(text, &options.limits)?;
    let root = document.root_element();
    if root.tag_name().name() != "ink" {
        return Err(Fault::new(xml::place(root), "expected <ink> as the outermost element"));
    }
    let by_id: HashMap<&str, Node<'_, '_>> = root.descendants().filter_map(|n| id(n).map(|i| (i, n))).first_of_key();
    let mut points = Budget::points(&options.limits);
    let mut items = Budget::items(&options.limits);
    let mut file = StrokeFile::default();
    let mut position_of: HashMap<&str, usize> = HashMap::new();
    let mut current: Option<Node<'_, '_>> = None;
    let only = only_format(root);
    let mut pen_up = 0;
    let mut frame: Option<(Unit, YAxis)> = None;
    let mut cache: HashMap<Option<roxmltree::NodeId>, Format> = HashMap::new();
    for node in root.descendants().filter(Node::is_element) {
        match node.tag_name().name() {
            "context" | "traceFormat" if node.parent() == Some(root) => current = Some(node),
            "trace" => {
                if node.attribute("type") == Some("penUp") {
                    pen_up += 1;
                    continue;
                }
                let source = format_node(node, &by_id).or(current).or(only);
                let format = match cache.entry(source.map(|n| n.id())) {
                    std::collections::hash_map::Entry::Occupied(e) => e.into_mut(),
                    std::collections::hash_map::Entry::Vacant(e) => e.insert(Format::of(source, &by_id)?),
                };
                let found = (format.unit, format.y);
                if *frame.get_or_insert(found) != found {
                    return Err(Fault::new(
                        xml::place(node),
                        "traces of one file have different units or directions of y",
                    ));
                }
                let stroke = trace(node, format, &mut points)?;
                let prior =
                    node.attribute("priorRef").and_then(|r| position_of.get(r.trim_start_matches('#'))).copied();
                let position = match (node.attribute("continuation"), prior) {
                    (Some("middle" | "end"), Some(position)) => {
                        append(&mut file.strokes[position], stroke);
                        position
                    }
                    _ => {
                        items.spend(|| xml::place(node))?;
                        let name = id(node).map_or_else(|| format!("trace/{}", file.strokes.len()), str::to_owned);
                        file.strokes.push(Stroke { name, ..stroke });
                        file.strokes.len() - 1
                    }
                };
                if let Some(id) = id(node) {
                    position_of.insert(id, position);
                }
            }
            _ => {}
        }
    }
    (file.unit, file.y) = frame.unwrap_or_default();
    finish(&mut file, pen_up);
    Ok(file)
}

/// Collects pairs so that the first of a repeated key stays.
trait FirstOfKey<K, V> {
    fn first_of_key(self) -> HashMap<K, V>;
}

impl<K: std::hash::Hash + Eq, V, I: Iterator<Item = (K, V)>> FirstOfKey<K, V> for I {
    fn first_of_key(self) -> HashMap<K, V> {
        let mut map = HashMap::new();
        for (k, v) in self {
            map.entry(k).or_insert(v);
        }
        map
    }
}

fn id<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute(("http://www.w3.org/XML/1998/namespace", "id")).or_else(|| node.attribute("id"))
}

/// Continues a stroke; times or pressures that only one part has are dropped.
fn append(stroke: &mut Stroke, more: Stroke) {
    let join = |a: &mut Vec<f64>, b: Vec<f64>| {
        if a.is_empty() || b.is_empty() { a.clear() } else { a.extend(b) }
    };
    join(&mut stroke.times_s, more.times_s);
    join(&mut stroke.pressures, more.pressures);
    stroke.points.extend(more.points);
}

/// Scales pressures whose range the file does not give, and says what was left out.
fn finish(file: &mut StrokeFile, pen_up: usize) {
    let largest = file.strokes.iter().flat_map(|s| &s.pressures).fold(0.0_f64, |m, p| m.max(*p));
    if largest > 1.0 {
        file.strokes.iter_mut().flat_map(|s| &mut s.pressures).for_each(|p| *p /= largest);
        let text = format!("pressures go up to {largest} and were divided by that");
        file.warnings.push(Warning { code: "pressure-scaled".into(), text });
    }
    if pen_up > 0 {
        let text = format!("{pen_up} traces of a lifted pen left out");
        file.warnings.push(Warning { code: "not-a-stroke".into(), text });
    }
}

/// The element that an attribute such as `contextRef` refers to.
fn referred<'a, 'i>(node: Node<'a, 'i>, name: &str, by_id: &HashMap<&str, Node<'a, 'i>>) -> Option<Node<'a, 'i>> {
    by_id.get(node.attribute(name)?.trim_start_matches('#')).copied()
}

/// The context or format that a trace names, itself or by its groups.
fn format_node<'a, 'i>(trace: Node<'a, 'i>, by_id: &HashMap<&str, Node<'a, 'i>>) -> Option<Node<'a, 'i>> {
    trace.ancestors().find_map(|n| referred(n, "contextRef", by_id))
}

/// The format of a file that has but one.
fn only_format<'a, 'i>(root: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
    let mut formats = root.descendants().filter(|n| n.tag_name().name() == "traceFormat");
    formats.next().filter(|_| formats.next().is_none())
}

/// What the values of a point mean.
struct Format {
    channels: Vec<Channel>,
    /// Of the channels, how many at the end may be missing.
    optional: usize,
    unit: Unit,
    y: YAxis,
}

#[derive(Clone)]
struct Channel {
    role: Role,
    scale: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    X,
    Y,
    Time,
    Force,
    Other,
}

impl Format {
    /// The format of a context, an ink source or a trace format; X and Y without one.
    fn of(node: Option<Node<'_, '_>>, by_id: &HashMap<&str, Node<'_, '_>>) -> Result<Self, Fault> {
        let mut format = Self { channels: Vec::new(), optional: 0, unit: Unit::Px, y: YAxis::Down };
        let Some(format_node) = node.and_then(|n| trace_format(n, by_id, 0)) else {
            format.channels = [Role::X, Role::Y].map(|role| Channel { role, scale: 1.0 }).to_vec();
            return Ok(format);
        };
        for node in format_node.descendants().filter(|n| n.tag_name().name() == "channel") {
            format.push(node);
            if format.channels.len() > MAX_CHANNELS {
                return Err(Fault::new(
                    xml::place(node),
                    format_args!("more than {MAX_CHANNELS} channels; leave some out"),
                ));
            }
            let intermittent = node.ancestors().any(|a| a.tag_name().name() == "intermittentChannels");
            format.optional += usize::from(intermittent);
        }
        if [Role::X, Role::Y].iter().all(|r| format.channels.iter().any(|c| c.role == *r)) {
            return Ok(format);
        }
        Err(Fault::new(xml::place(format_node), "there is no channel X or no channel Y; expected both"))
    }

    fn push(&mut self, node: Node<'_, '_>) {
        let units = node.attribute("units").unwrap_or_default();
        let mut scale = 1.0;
        let role = match node.attribute("name").unwrap_or_default() {
            "X" => {
                (self.unit, scale) = length_unit(units);
                Role::X
            }
            "Y" => {
                scale = length_unit(units).1;
                if node.attribute("orientation") == Some("-ve") {
                    self.y = YAxis::Up;
                }
                Role::Y
            }
            "T" => {
                scale = if units == "s" { 1.0 } else { 1e-3 };
                Role::Time
            }
            "F" => {
                let max =
                    node.attribute("max").and_then(|m| m.parse::<f64>().ok()).filter(|m| *m > 0.0 && m.is_finite());
                scale = max.map_or(1.0, |m| 1.0 / m);
                Role::Force
            }
            _ => Role::Other,
        };
        self.channels.push(Channel { role, scale });
    }
}

fn length_unit(word: &str) -> (Unit, f64) {
    match word {
        "himetric" => (Unit::Mm, 0.01),
        "mm" | "cm" | "in" | "pt" | "m" => (Unit::from_word(word).unwrap_or_default(), 1.0),
        _ => (Unit::Px, 1.0),
    }
}

/// Follows a context to its trace format.
fn trace_format<'a, 'i>(node: Node<'a, 'i>, by_id: &HashMap<&str, Node<'a, 'i>>, depth: usize) -> Option<Node<'a, 'i>> {
    if node.tag_name().name() == "traceFormat" {
        return Some(node);
    }
    if depth > 8 {
        return None;
    }
    if let Some(inside) = node.descendants().find(|n| n.tag_name().name() == "traceFormat") {
        return Some(inside);
    }
    ["traceFormatRef", "inkSourceRef", "contextRef"]
        .into_iter()
        .find_map(|name| trace_format(referred(node, name, by_id)?, by_id, depth + 1))
}

/// How a channel's value follows from the written number, until another sign says otherwise.
#[derive(Clone, Copy, Default)]
struct Decoder {
    order: u8,
    value: f64,
    velocity: f64,
}

impl Decoder {
    fn next(&mut self, written: f64) -> f64 {
        match self.order {
            0 => {
                self.velocity = written - self.value;
                self.value = written;
            }
            1 => {
                self.velocity = written;
                self.value += written;
            }
            _ => {
                self.velocity += written;
                self.value += self.velocity;
            }
        }
        self.value
    }
}

fn trace(node: Node<'_, '_>, format: &Format, budget: &mut Budget) -> Result<Stroke, Fault> {
    let mut stroke = Stroke::new("", Vec::new());
    let mut decoders = vec![Decoder::default(); format.channels.len()];
    let text = xml::inner_text(node);
    for (index, point) in text.split(',').enumerate() {
        if point.trim().is_empty() {
            continue;
        }
        let fault = |problem: String| Fault::new(format_args!("{}, point {index}", xml::place(node)), problem);
        budget.spend(|| xml::place(node))?;
        let count = point_values(point, &mut decoders).map_err(fault)?;
        let (most, least) = (format.channels.len(), format.channels.len() - format.optional);
        if count < least {
            return Err(fault(format!("{count} values, expected {least}, one for each channel of the traceFormat")));
        }
        let value = |role| {
            let at = format.channels[..count.min(most)].iter().position(|c| c.role == role)?;
            Some(decoders[at].value * format.channels[at].scale)
        };
        let (Some(x), Some(y)) = (value(Role::X), value(Role::Y)) else {
            return Err(fault("X or Y is missing".into()));
        };
        let rest = [value(Role::Time), value(Role::Force)];
        if !x.is_finite() || !y.is_finite() || rest.iter().flatten().any(|v| !v.is_finite()) {
            return Err(fault("a value is not a finite number".into()));
        }
        stroke.points.push(Point::new(x, y));
        stroke.times_s.extend(rest[0]);
        stroke.pressures.extend(rest[1]);
    }
    // An intermittent channel that some points lack says nothing about the whole stroke.
    for values in [&mut stroke.times_s, &mut stroke.pressures] {
        if values.len() != stroke.points.len() {
            values.clear();
        }
    }
    Ok(stroke)
}

/// Decodes the values of one point; gives back how many there are.
fn point_values(text: &str, decoders: &mut [Decoder]) -> Result<usize, String> {
    let mut rest = text.trim_start();
    let mut count = 0;
    while !rest.is_empty() {
        let Some(decoder) = decoders.get_mut(count) else {
            return Err(format!("more than {count} values, expected one for each channel of the traceFormat"));
        };
        if let Some(order) = ['!', '\'', '"'].into_iter().position(|sign| rest.starts_with(sign)) {
            decoder.order = order as u8;
            rest = rest[1..].trim_start();
        }
        let length = value_length(rest);
        let (token, after) = rest.split_at(length);
        match token {
            // Unchanged, or not given: as before.
            "*" | "?" => {}
            "T" => decoder.value = 1.0,
            "F" => decoder.value = 0.0,
            _ => {
                let hex = token.strip_prefix('#').map(|h| i64::from_str_radix(h, 16).map(|v| v as f64).ok());
                let Some(written) = hex.unwrap_or_else(|| token.parse::<f64>().ok()) else {
                    let shown: String = rest.chars().take(16).collect();
                    return Err(format!("{shown:?} is no value; expected a number, perhaps after ' or \" or !"));
                };
                decoder.next(written);
            }
        }
        rest = after.trim_start();
        count += 1;
    }
    Ok(count)
}

/// Bytes of the value that the text begins with: `-1.5e3`, `#1f`, `*`, `?`, `T` or `F`; numbers may touch, as in `3-5`.
fn value_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    match bytes.first() {
        Some(b'*' | b'?' | b'T' | b'F') => return 1,
        Some(b'#') => return 1 + bytes[1..].iter().take_while(|b| b.is_ascii_hexdigit()).count(),
        _ => {}
    }
    let mut end = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let mut dot = false;
    while let Some(&b) = bytes.get(end) {
        match b {
            b'0'..=b'9' => end += 1,
            b'.' if !dot => {
                dot = true;
                end += 1;
            }
            b'e' | b'E' => {
                let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
                if !bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
                    break;
                }
                end += 1 + sign;
                dot = true;
            }
            _ => break,
        }
    }
    end
}
