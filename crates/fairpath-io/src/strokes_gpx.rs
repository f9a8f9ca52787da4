//! Strokes from GPX: every segment of a track and every route, projected to local metres (see [`crate::geodetic`]).
//!
//! Times are seconds from the earliest time of the file, kept where every point of a stroke has one. Elevations, waypoints and whatever
//! else a point carries are left out.

use crate::error::Fault;
use crate::geodetic::{Place, project};
use crate::input::Budget;
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::xml;
use fairpath_fit::{Stroke, Warning};
use roxmltree::Node;

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    let (mut file, places) = read_places(text, options)?;
    project(&mut file, &places)?;
    Ok(file)
}

/// The lines without points, and for each the places that would be.
pub(crate) fn read_places(text: &str, options: &ReadOptions) -> Result<(StrokeFile, Vec<Vec<Place>>), Fault> {
    let document = xml::parse(text, &options.limits)?;
    let root = document.root_element();
    if root.tag_name().name() != "gpx" {
        return Err(Fault::new(xml::place(root), "expected <gpx> as the outermost element"));
    }
    let mut budgets = (Budget::items(&options.limits), Budget::points(&options.limits));
    let mut file = StrokeFile::default();
    let mut places = Vec::new();
    for (index, line) in elements(root).filter(|n| matches!(n.tag_name().name(), "trk" | "rte")).enumerate() {
        let kind = if line.tag_name().name() == "trk" { "track" } else { "route" };
        let given = child(line, "name").map(xml::inner_text).filter(|n| !n.trim().is_empty());
        let name = given.map_or_else(|| format!("{kind}/{index}"), |n| n.trim().to_owned());
        if kind == "route" {
            add(&mut file, &mut places, line, "rtept", name, &mut budgets)?;
            continue;
        }
        let segments: Vec<_> = elements(line).filter(|n| n.tag_name().name() == "trkseg").collect();
        for (i, segment) in segments.iter().enumerate() {
            let name = if segments.len() == 1 { name.clone() } else { format!("{name}/{i}") };
            add(&mut file, &mut places, *segment, "trkpt", name, &mut budgets)?;
        }
    }
    if file.strokes.is_empty() {
        let problem = "there is no track or route with points; waypoints alone are no strokes";
        return Err(Fault::new("the file as a whole", problem));
    }
    let earliest = file.strokes.iter().flat_map(|s| &s.times_s).fold(f64::INFINITY, |a, b| a.min(*b));
    file.strokes.iter_mut().flat_map(|s| &mut s.times_s).for_each(|t| *t -= earliest);
    Ok((file, places))
}

fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    elements(node).find(|n| n.tag_name().name() == name)
}

/// Adds the points below an element as a stroke, if there are any.
fn add(
    file: &mut StrokeFile,
    places: &mut Vec<Vec<Place>>,
    line: Node<'_, '_>,
    tag: &str,
    name: String,
    (items, points): &mut (Budget, Budget),
) -> Result<(), Fault> {
    let (mut here, mut times) = (Vec::new(), Vec::new());
    for point in elements(line).filter(|n| n.tag_name().name() == tag) {
        points.spend(|| xml::place(point))?;
        let (longitude, latitude) = (degrees(point, "lon")?, degrees(point, "lat")?);
        here.push(Place::new(longitude, latitude, || xml::place(point))?);
        if let Some(time) = child(point, "time") {
            times.push(time_s(&xml::inner_text(time), time)?);
        }
    }
    if here.is_empty() {
        return Ok(());
    }
    items.spend(|| xml::place(line))?;
    if times.len() != here.len() {
        if !times.is_empty() {
            let text =
                format!("{name:?} has times at {} of {} points only; they were left out", times.len(), here.len());
            file.warnings.push(Warning { code: "times-left-out".into(), text });
        }
        times.clear();
    }
    file.strokes.push(Stroke { times_s: times, ..Stroke::new(name, Vec::new()) });
    places.push(here);
    Ok(())
}

fn degrees(point: Node<'_, '_>, name: &str) -> Result<f64, Fault> {
    let Some(text) = point.attribute(name) else {
        return Err(Fault::new(xml::place(point), format_args!("there is no attribute {name}, in degrees")));
    };
    text.trim()
        .parse()
        .map_err(|_| Fault::new(xml::place(point), format_args!("{name}={text:?} is no number; expected degrees")))
}

/// Seconds since 1970 of a time such as `2024-05-17T08:30:00.5Z` (RFC 3339, a missing zone taken as UTC).
fn time_s(text: &str, node: Node<'_, '_>) -> Result<f64, Fault> {
    parsed_time_s(text.trim()).ok_or_else(|| {
        Fault::new(xml::place(node), format_args!("{text:?} is no time; expected one such as 2024-05-17T08:30:00Z"))
    })
}

fn parsed_time_s(text: &str) -> Option<f64> {
    let (date, clock) = text.split_once(['T', 't', ' '])?;
    let whole = |text: &str| -> Option<i64> {
        (text.len() <= 4 && text.bytes().all(|b| b.is_ascii_digit())).then(|| text.parse().ok())?
    };
    let mut date = date.split('-').map(whole);
    let (year, month, day) = (date.next()??, date.next()??, date.next()??);
    let (clock, zone_s) = match clock.find(['Z', 'z', '+', '-']) {
        None => (clock, 0),
        Some(i) if matches!(clock.as_bytes()[i], b'Z' | b'z') => (&clock[..i], 0),
        Some(i) => {
            let (hours, minutes) = clock[i + 1..].split_once(':')?;
            let offset = 3600 * whole(hours)? + 60 * whole(minutes)?;
            (&clock[..i], if clock.as_bytes()[i] == b'-' { -offset } else { offset })
        }
    };
    let mut clock = clock.split(':');
    let (hour, minute) = (whole(clock.next()?)?, whole(clock.next()?)?);
    let second: f64 = clock.next()?.parse().ok()?;
    let in_range = (1..=12).contains(&month) && (1..=31).contains(&day) && hour <= 24 && minute < 60;
    if !in_range || !(0.0..61.0).contains(&second) || date.next().is_some() || clock.next().is_some() {
        return None;
    }
    // Days since 1970 in the Gregorian calendar, years beginning in March so that the leap day is the last.
    let shifted = year - i64::from(month <= 2);
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    let days = 365 * shifted + shifted.div_euclid(4) - shifted.div_euclid(100) + shifted.div_euclid(400) + day_of_year
        - 719_468;
    Some((86_400 * days + 3600 * hour + 60 * minute - zone_s) as f64 + second)
}

#[cfg(test)]
mod tests {
    use super::parsed_time_s;

    #[test]
    fn times_are_seconds_since_1970() {
        let cases = [
            ("1970-01-01T00:00:00Z", Some(0.0)),
            ("2000-02-29T12:00:00Z", Some(951_825_600.0)),
            ("2024-05-17T08:30:00.5+02:00", Some(1_715_927_400.5)),
            ("1969-12-31T23:59:59", Some(-1.0)),
            ("2024-05-17", None),
            ("2024-13-17T00:00:00Z", None),
            ("today", None),
        ];
        for (text, expected) in cases {
            assert_eq!(parsed_time_s(text), expected, "{text}");
        }
    }
}
