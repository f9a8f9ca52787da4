//! LandXML 1.2: each path as an alignment of lines, curves and spirals with its profile of parabolas, and the finished ground, in the cells of the terrain in which it was shaped, as a surface.
//!
//! Reference: LandXML.org, "LandXML 1.2 schema" (2008). Points are northing, easting and elevation. With a georeference northings and eastings are those of its projection.

use super::export::DriveExport;
use super::xml::{Xml, number};
use crate::error::Error;
use fairpath_curve::{Kind, Point, Segment, trig};
use fairpath_drive::{Finish, Profile, Scene, SceneOptions};
use std::f64::consts::FRAC_PI_2;

/// Spirals that turn further are cut in two, so that their tangents meet between their ends.
const WIDEST_TURN: f64 = FRAC_PI_2;

pub(super) fn write(export: &DriveExport<'_>) -> Result<Vec<u8>, Error> {
    let georeference = export.state.terrain.as_ref().and_then(|t| t.georeference.as_ref());
    let origin = georeference.map_or([0.0; 2], |g| g.origin_m);
    let mut xml = Xml::default();
    xml.open(
        "LandXML",
        &[
            ("xmlns", "http://www.landxml.org/schema/LandXML-1.2"),
            ("version", "1.2"),
            // The format asks for a date, and the same network shall be the same file.
            ("date", "2000-01-01"),
            ("time", "00:00:00"),
            ("readOnly", "false"),
            ("language", "English"),
        ],
    );
    xml.open("Units", &[]);
    xml.empty(
        "Metric",
        &[
            ("areaUnit", "squareMeter"),
            ("linearUnit", "meter"),
            ("volumeUnit", "cubicMeter"),
            ("temperatureUnit", "celsius"),
            ("pressureUnit", "milliBars"),
            ("angularUnit", "radians"),
            ("directionUnit", "radians"),
        ],
    );
    xml.close("Units");
    if let Some(georeference) = georeference {
        let epsg = georeference.epsg.map(|e| e.to_string());
        let mut attributes = vec![("desc", georeference.projection.as_str())];
        attributes.extend(epsg.as_deref().map(|e| ("epsgCode", e)));
        xml.empty("CoordinateSystem", &attributes);
    }
    xml.empty("Project", &[("name", export.name)]);
    xml.empty("Application", &[("name", "fairpath"), ("version", env!("CARGO_PKG_VERSION"))]);
    // The format has no group of nothing.
    let any = !export.results.paths.is_empty();
    if any {
        xml.open("Alignments", &[("name", export.name)]);
    }
    for path in &export.results.paths {
        let length = number(path.path.length_m());
        xml.open("Alignment", &[("name", &path.path.name), ("length", &length), ("staStart", "0")]);
        xml.open("CoordGeom", &[]);
        for segment in path.path.plan.segments() {
            for part in parts(segment) {
                element(&mut xml, &part, origin);
            }
        }
        xml.close("CoordGeom");
        xml.open("Profile", &[("name", &path.path.name)]);
        profile(&mut xml, &path.path.name, &path.profile);
        xml.close("Profile");
        xml.close("Alignment");
    }
    if any {
        xml.close("Alignments");
    }
    surface(&mut xml, export, origin);
    xml.close("LandXML");
    xml.finish()
}

/// A segment as elements that LandXML has: spirals neither change sides nor turn far.
fn parts(segment: &Segment) -> Vec<Segment> {
    if segment.kind() != Kind::Clothoid {
        return vec![*segment];
    }
    let mut cuts = vec![0.0];
    if segment.has_inflection() {
        cuts.push(segment.length * segment.kappa0 / (segment.kappa0 - segment.kappa1));
    }
    cuts.push(segment.length);
    let mut out = Vec::new();
    for pair in cuts.windows(2).filter(|p| p[1] > p[0]) {
        let mut part = segment.subsegment(pair[0], pair[1]);
        // Exactly straight where it changes sides.
        if pair[0] > 0.0 {
            part.kappa0 = 0.0;
        }
        if pair[1] < segment.length {
            part.kappa1 = 0.0;
        }
        let count = (part.absolute_turning() / WIDEST_TURN).ceil().max(1.0) as usize;
        for k in 0..count {
            let at = |k: usize| part.length * k as f64 / count as f64;
            out.push(if count == 1 { part } else { part.subsegment(at(k), at(k + 1)) });
        }
    }
    out
}

fn element(xml: &mut Xml, segment: &Segment, origin: [f64; 2]) {
    let place = |p: Point| format!("{} {}", number(origin[1] + p.y), number(origin[0] + p.x));
    let length = number(segment.length);
    let (start, end) = (segment.start, segment.end());
    let bend = segment.kappa0 + segment.kappa1;
    let rot = if bend > 0.0 { "ccw" } else { "cw" };
    match segment.kind() {
        Kind::Line => {
            xml.open("Line", &[("length", &length)]);
            xml.leaf("Start", &[], &place(start));
            xml.leaf("End", &[], &place(end));
            xml.close("Line");
        }
        Kind::Arc => {
            let radius = 1.0 / segment.kappa0;
            let tangent = trig::unit(segment.heading);
            let centre = start + fairpath_curve::Vec2::new(-tangent.y, tangent.x) * radius;
            let radius = number(radius.abs());
            xml.open("Curve", &[("rot", rot), ("crvType", "arc"), ("radius", &radius), ("length", &length)]);
            xml.leaf("Start", &[], &place(start));
            xml.leaf("Center", &[], &place(centre));
            xml.leaf("End", &[], &place(end));
            xml.close("Curve");
        }
        Kind::Clothoid => {
            let radius = |kappa: f64| if kappa == 0.0 { "INF".to_owned() } else { number(1.0 / kappa.abs()) };
            let (from, to) = (radius(segment.kappa0), radius(segment.kappa1));
            xml.open(
                "Spiral",
                &[
                    ("length", &length),
                    ("radiusEnd", &to),
                    ("radiusStart", &from),
                    ("rot", rot),
                    ("spiType", "clothoid"),
                ],
            );
            xml.leaf("Start", &[], &place(start));
            xml.leaf("PI", &[], &place(tangents_meet(segment)));
            xml.leaf("End", &[], &place(end));
            xml.close("Spiral");
        }
    }
}

/// Where the tangents at both ends meet; in the middle where they hardly turn.
fn tangents_meet(segment: &Segment) -> Point {
    let (start, end) = (segment.start, segment.end());
    let (u, v) = (trig::unit(segment.heading), trig::unit(segment.end_heading()));
    let across = u.cross(v);
    let chord = end - start;
    if across.abs() < 1e-9 {
        return start.midpoint(end);
    }
    start + u * (chord.cross(v) / across)
}

/// A profile as parabolas: each cubic as the two with its heights and grades at the ends that meet in its middle. A parabola is two parts of itself; a cubic that bends by `d` more from one end to
/// the other is met within h² d / 192.
fn profile(xml: &mut Xml, name: &str, profile: &Profile) {
    xml.open("ProfAlign", &[("name", name)]);
    let knots = profile.knots();
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    let pair = |station: f64, height: f64| format!("{} {}", number(station), number(height));
    xml.leaf("PVI", &[], &pair(first.station_m, first.height_m));
    for ends in knots.windows(2) {
        let (a, b) = (ends[0], ends[1]);
        let h = b.station_m - a.station_m;
        let mean = (b.height_m - a.height_m) / h;
        // The grade in the middle makes both parabolas come to the same height there.
        let middle = 2.0 * mean - 0.5 * (a.grade + b.grade);
        let half = 0.5 * h;
        let at_middle = a.height_m + 0.5 * half * (a.grade + middle);
        for (station, height, grade) in [(a.station_m, a.height_m, a.grade), (a.station_m + half, at_middle, middle)] {
            // The tangents of a parabola meet half-way.
            let pvi = pair(station + 0.5 * half, height + 0.5 * half * grade);
            xml.leaf("ParaCurve", &[("length", &number(half))], &pvi);
        }
    }
    xml.leaf("PVI", &[], &pair(last.station_m, last.height_m));
    xml.close("ProfAlign");
}

fn surface(xml: &mut Xml, export: &DriveExport<'_>, origin: [f64; 2]) {
    let options = SceneOptions { natural: false, ..SceneOptions::default() };
    let scene = Scene::ground(export.state, export.results, &options);
    let parts: Vec<_> = scene.parts.iter().filter(|p| p.finish != Finish::Water).collect();
    if parts.is_empty() {
        return;
    }
    xml.open("Surfaces", &[]);
    xml.open("Surface", &[("name", "finished ground")]);
    xml.open("Definition", &[("surfType", "TIN")]);
    xml.open("Pnts", &[]);
    let mut id = 0_usize;
    for part in &parts {
        for [x, y, z] in &part.mesh.vertices {
            id += 1;
            let rounded = |v: f64| number((1e4 * v).round() / 1e4);
            let text = format!("{} {} {}", rounded(origin[1] + y), rounded(origin[0] + x), rounded(*z));
            xml.leaf("P", &[("id", &id.to_string())], &text);
        }
    }
    xml.close("Pnts");
    xml.open("Faces", &[]);
    let mut first = 1;
    for part in &parts {
        for [a, b, c] in &part.mesh.triangles {
            let of = |v: u32| first + v as usize;
            xml.leaf("F", &[], &format!("{} {} {}", of(*a), of(*b), of(*c)));
        }
        first += part.mesh.vertices.len();
    }
    xml.close("Faces");
    xml.close("Definition");
    xml.close("Surface");
    xml.close("Surfaces");
}
