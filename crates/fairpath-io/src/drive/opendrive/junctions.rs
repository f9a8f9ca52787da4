//! Intersections: a road for each way through, with one lane, and the connections.

use super::roads::{Network, junction_id};
use super::{lanes, plan};
use crate::drive::xml::{Xml, number};
use fairpath_curve::Segment;
use fairpath_drive::{Arm, Results, Turning, Way};

/// A road for a way through an intersection.
pub(super) struct Connecting<'a> {
    id: u64,
    junction: usize,
    junction_id: u64,
    way: &'a Way,
    geometries: Vec<Segment>,
    /// The roads that it comes from and goes to, at which end of each it begins and ends, and the lanes there.
    from: (u64, &'static str, i64),
    to: (u64, &'static str, i64),
}

/// At which end of a road an arm lies.
fn contact(arm: &Arm) -> &'static str {
    if arm.forward { "start" } else { "end" }
}

/// The number of a lane of an arm's road, for traffic into the intersection or out of it.
fn lane(arm: &Arm, lane: usize, inwards: bool) -> i64 {
    let id = lane as i64 + 1;
    // With the road's direction one drives on lanes with negative numbers.
    if arm.forward != inwards { -id } else { id }
}

pub(super) fn connecting_roads<'a>(network: &Network<'_>, results: &'a Results) -> Vec<Connecting<'a>> {
    let mut id = network.next_id();
    let mut found = Vec::new();
    for (j, junction) in results.junctions.iter().enumerate() {
        for way in &junction.ways {
            let (a, b) = (&junction.arms[way.from], &junction.arms[way.to]);
            let (Some(from), Some(to)) = (network.road_at(j, way.from), network.road_at(j, way.to)) else { continue };
            found.push(Connecting {
                id,
                junction: j,
                junction_id: junction_id(j),
                way,
                geometries: plan::geometries(&way.plan),
                from: (from, contact(a), lane(a, way.from_lane, true)),
                to: (to, contact(b), lane(b, way.to_lane, false)),
            });
            id += 1;
        }
    }
    found
}

pub(super) fn write_road(xml: &mut Xml, road: &Connecting<'_>, results: &Results) {
    let turning = match road.way.turning {
        Turning::Straight => "straight on",
        Turning::Left => "left",
        Turning::Right => "right",
    };
    let name = format!("{turning} from {} to {}", road.from.0, road.to.0);
    let length = plan::length(&road.geometries);
    let (id, junction) = (road.id.to_string(), road.junction_id.to_string());
    xml.open(
        "road",
        &[("name", &name), ("length", &number(length)), ("id", &id), ("junction", &junction), ("rule", "RHT")],
    );
    xml.open("link", &[]);
    for (element, (id, contact, _)) in [("predecessor", road.from), ("successor", road.to)] {
        xml.empty(element, &[("elementType", "road"), ("elementId", &id.to_string()), ("contactPoint", contact)]);
    }
    xml.close("link");
    let arm = &results.junctions[road.junction].arms[road.way.from];
    let kmh = results.path(arm.path).map_or(50.0, |p| p.path.speed_limit_kmh(arm.station_m));
    xml.open("type", &[("s", "0"), ("type", "rural")]);
    xml.empty("speed", &[("max", &number(kmh)), ("unit", "km/h")]);
    xml.close("type");
    plan::write_plan(xml, &road.geometries);
    plan::write_elevation(xml, &road.way.profile);
    xml.open("lanes", &[]);
    xml.open("laneSection", &[("s", "0")]);
    xml.open("center", &[]);
    xml.empty("lane", &[("id", "0"), ("type", "none"), ("level", "false")]);
    xml.close("center");
    xml.open("right", &[]);
    xml.open("lane", &[("id", "-1"), ("type", "driving"), ("level", "false")]);
    xml.open("link", &[]);
    xml.empty("predecessor", &[("id", &road.from.2.to_string())]);
    xml.empty("successor", &[("id", &road.to.2.to_string())]);
    xml.close("link");
    lanes::width(xml, road.way.widths_m, length);
    xml.close("lane");
    xml.close("right");
    xml.close("laneSection");
    xml.close("lanes");
    xml.close("road");
}

pub(super) fn write_junctions(xml: &mut Xml, connecting: &[Connecting<'_>], results: &Results) {
    for of_one in connecting.chunk_by(|a, b| a.junction == b.junction) {
        let id = of_one[0].junction_id.to_string();
        let centre = results.junctions[of_one[0].junction].centre;
        let name = format!("intersection at {:.0}, {:.0}", centre.x, centre.y);
        xml.open("junction", &[("name", &name), ("id", &id)]);
        for (k, road) in of_one.iter().enumerate() {
            let (connection, incoming, own) = (k.to_string(), road.from.0.to_string(), road.id.to_string());
            xml.open(
                "connection",
                &[
                    ("id", &connection),
                    ("incomingRoad", &incoming),
                    ("connectingRoad", &own),
                    ("contactPoint", "start"),
                ],
            );
            xml.empty("laneLink", &[("from", &road.from.2.to_string()), ("to", "-1")]);
            xml.close("connection");
        }
        xml.close("junction");
    }
}
