//! Lanes of a road: one section, all widths constant.

use super::lane_type;
use crate::drive::xml::{Xml, number};
use fairpath_drive::{Lane, Marking, Section};

/// Width of a line, m.
const LINE_M: &str = "0.12";

/// Lanes of a cross-section, linked to those of the same numbers before and after it where the road goes on as another one of its kind.
pub(super) fn write(xml: &mut Xml, section: &Section, goes_on: [bool; 2]) {
    xml.open("lanes", &[]);
    xml.open("laneSection", &[("s", "0")]);
    let side = |xml: &mut Xml, name: &str, lanes: &[Lane], sign: i64| {
        if lanes.is_empty() {
            return;
        }
        xml.open(name, &[]);
        // From the left to the right, as one sees them.
        let order: Vec<usize> = if sign > 0 { (0..lanes.len()).rev().collect() } else { (0..lanes.len()).collect() };
        for i in order {
            lane(xml, &lanes[i], sign * (i as i64 + 1), goes_on);
        }
        xml.close(name);
    };
    side(xml, "left", &section.left, 1);
    xml.open("center", &[]);
    xml.open("lane", &[("id", "0"), ("type", "none"), ("level", "false")]);
    mark(xml, section.centre);
    xml.close("lane");
    xml.close("center");
    side(xml, "right", &section.right, -1);
    xml.close("laneSection");
    xml.close("lanes");
}

fn lane(xml: &mut Xml, lane: &Lane, id: i64, goes_on: [bool; 2]) {
    let id = id.to_string();
    xml.open("lane", &[("id", &id), ("type", lane_type(lane.kind)), ("level", "false")]);
    if goes_on != [false; 2] {
        xml.open("link", &[]);
        for (name, _) in ["predecessor", "successor"].into_iter().zip(goes_on).filter(|end| end.1) {
            xml.empty(name, &[("id", &id)]);
        }
        xml.close("link");
    }
    width(xml, [lane.width_m, lane.width_m], 1.0);
    mark(xml, lane.marking);
    xml.close("lane");
}

/// A width that changes smoothly along a road of this length, with no slope at both ends.
pub(super) fn width(xml: &mut Xml, [from, to]: [f64; 2], length: f64) {
    let by = to - from;
    let (c, d) = (number(3.0 * by / (length * length)), number(-2.0 * by / (length * length * length)));
    xml.empty("width", &[("sOffset", "0"), ("a", &number(from)), ("b", "0"), ("c", &c), ("d", &d)]);
}

fn mark(xml: &mut Xml, marking: Marking) {
    let kind = match marking {
        Marking::None => return,
        Marking::Solid => "solid",
        Marking::Broken => "broken",
        Marking::Double => "solid solid",
    };
    let attributes =
        [("sOffset", "0"), ("type", kind), ("weight", "standard"), ("color", "standard"), ("width", LINE_M)];
    xml.empty("roadMark", &attributes);
}
