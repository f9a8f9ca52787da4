//! Splines as SVG: one `path` of cubic Béziers for each, and the exact primitives in the metadata.
//!
//! The numbers of the paths are the splines' own coordinates; a y-up frame is shown upright by a transform around them. The metadata
//! hold the whole file as `fairpath-spline 1`, so that reading our SVG gives bit-identical splines. A check sum over the drawing tells
//! whether somebody changed the paths afterwards: what is read then is still the metadata, with a warning.

use crate::drawable::{check_drawable, check_tolerance};
use crate::error::{Error, Fault};
use crate::limits::ReadOptions;
use crate::spline_file::SplineFile;
use crate::strokes_svg::{flip, open_svg};
use crate::{spline_json, xml};
use fairpath_fit::Warning;
use kurbo::Rect;
use roxmltree::Document;
use std::collections::HashSet;
use std::fmt::Write;

/// The namespace of our metadata.
pub(crate) const NAMESPACE: &str = "urn:fairpath:spline:1";
/// The element in the metadata.
const ELEMENT: &str = "document";

pub(crate) fn write(file: &SplineFile, tolerance: f64) -> Result<Vec<u8>, Error> {
    check_drawable(file, "SVG")?;
    check_tolerance(tolerance, "SVG")?;
    let shown = file.splines.iter().map(|e| e.spline.bounding_box()).reduce(|a: Rect, b| a.union(b));
    let mut out = String::new();
    let line_width = open_svg(&mut out, shown, file.unit, file.y);
    let mut drawing = String::new();
    let mut put = |args: std::fmt::Arguments<'_>| drawing.write_fmt(args).expect("writing to a String does not fail");
    put(format_args!(
        "<g fill=\"none\" stroke=\"#111\" stroke-width=\"{line_width}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"{}>\n",
        flip(file.y)
    ));
    let mut taken = HashSet::new();
    let mut sum = Checksum::default();
    for entry in &file.splines {
        let path = entry.spline.to_bez_path(tolerance).to_svg();
        sum.add(&path);
        put(format_args!("<path id=\"{}\" d=\"{path}\"/>\n", xml::attribute(&unique(&entry.name, &mut taken))));
    }
    put(format_args!("</g>\n</svg>\n"));
    let json = spline_json::write(file)?;
    let json = String::from_utf8(json).expect("JSON is UTF-8");
    // JSON can name what XML cannot hold.
    let json: String = json.trim_end().chars().map(escaped).collect();
    out.write_fmt(format_args!(
        "<metadata><fairpath:{ELEMENT} xmlns:fairpath=\"{NAMESPACE}\" drawing=\"{:016x}\">{}</fairpath:{ELEMENT}></metadata>\n",
        sum.0,
        xml::content(&json)
    ))
    .expect("writing to a String does not fail");
    out.push_str(&drawing);
    Ok(out.into_bytes())
}

/// A character of a JSON string as XML can hold it.
fn escaped(c: char) -> String {
    if xml::is_legal(c) { c.to_string() } else { format!("\\u{:04x}", u32::from(c)) }
}

/// The name, with a suffix where another spline has it already: ids must differ.
fn unique(name: &str, taken: &mut HashSet<String>) -> String {
    let mut id = name.to_owned();
    let mut n = 1;
    while !taken.insert(id.clone()) {
        n += 1;
        id = format!("{name}#{n}");
    }
    id
}

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<SplineFile, Fault> {
    let document = xml::parse(text, &options.limits)?;
    let Some(node) = document.descendants().find(|n| n.has_tag_name((NAMESPACE, ELEMENT))) else {
        return Err(Fault::new(
            xml::place(document.root_element()),
            "there are no Fairpath primitives in the metadata; this is a drawing: read it as strokes and fit them",
        ));
    };
    let mut file = spline_json::read(&xml::inner_text(node), options).map_err(|fault| match fault {
        Fault::Malformed { place, problem } => Fault::new(format_args!("{}, {place}", xml::place(node)), problem),
        other => other,
    })?;
    if node.attribute("drawing") != Some(&format!("{:016x}", drawing_sum(&document).0)) {
        file.warnings.push(Warning {
            code: "drawing-changed".into(),
            text: "the paths were changed after the file was written; the splines read are those from before".into(),
        });
    }
    Ok(file)
}

/// FNV-1a over path data: it need only notice an honest edit.
struct Checksum(u64);

impl Default for Checksum {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Checksum {
    fn add(&mut self, path: &str) {
        for byte in path.bytes().chain([0]) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

fn drawing_sum(document: &Document<'_>) -> Checksum {
    let mut sum = Checksum::default();
    for node in document.descendants().filter(|n| n.tag_name().name() == "path") {
        sum.add(node.attribute("d").unwrap_or_default());
    }
    sum
}
