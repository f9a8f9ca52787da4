//! ASAM OpenDRIVE 1.7: lines, arcs and spirals as they are, elevation as cubics, lanes, marks, intersections with a connecting road for each way through, signals, bridges and tunnels.
//!
//! Reference: ASAM e.V., "OpenDRIVE 1.7.0" (2021). Coordinates are those of the terrain, and `offset` tells how to get from there to the georeference. A path is one road between two
//! intersections; where it crosses others above or below, it goes on.

mod junctions;
mod lanes;
mod objects;
mod plan;
mod roads;

use super::export::DriveExport;
use super::xml::{self, Xml};
use crate::error::Error;
use fairpath_drive::{LaneKind, PathResult};
use junctions::connecting_roads;
use roads::Network;

/// The names that OpenDRIVE has for lanes.
fn lane_type(kind: LaneKind) -> &'static str {
    match kind {
        LaneKind::Driving => "driving",
        LaneKind::Shoulder => "shoulder",
        LaneKind::Median => "median",
        LaneKind::Sidewalk => "sidewalk",
        LaneKind::Cycling => "biking",
        LaneKind::Rail => "rail",
        LaneKind::None => "none",
    }
}

/// Whether anything moves on a path; pipes and ribbons are no roads.
fn is_road(path: &PathResult) -> bool {
    let section = &path.path.section;
    section.left.iter().chain(&section.right).any(|lane| lane.kind != LaneKind::None)
}

pub(super) fn write(export: &DriveExport<'_>) -> Result<Vec<u8>, Error> {
    let network = Network::of(export.results);
    if network.roads.is_empty() {
        return Err(Error::Unwritable {
            format: "OpenDRIVE",
            place: "the network".to_owned(),
            problem: "there is no road, railway or footpath in it, and OpenDRIVE has at least one".to_owned(),
        });
    }
    let mut xml = Xml::default();
    xml.open("OpenDRIVE", &[]);
    header(&mut xml, export);
    for road in &network.roads {
        roads::write(&mut xml, road, export);
    }
    let connecting = connecting_roads(&network, export.results);
    for road in &connecting {
        junctions::write_road(&mut xml, road, export.results);
    }
    junctions::write_junctions(&mut xml, &connecting, export.results);
    xml.close("OpenDRIVE");
    xml.finish()
}

fn header(xml: &mut Xml, export: &DriveExport<'_>) {
    let field = export.results.ground.natural();
    let (low, high) = (field.corner(), field.far_corner());
    let edges = [high.y, low.y, high.x, low.x].map(xml::number);
    let attributes = [
        ("revMajor", "1"),
        ("revMinor", "7"),
        ("name", export.name),
        ("version", "1.00"),
        ("north", &edges[0]),
        ("south", &edges[1]),
        ("east", &edges[2]),
        ("west", &edges[3]),
        ("vendor", concat!("fairpath ", env!("CARGO_PKG_VERSION"))),
    ];
    let Some(georeference) = export.state.terrain.as_ref().and_then(|t| t.georeference.as_ref()) else {
        xml.empty("header", &attributes);
        return;
    };
    xml.open("header", &attributes);
    xml.open("geoReference", &[]);
    xml.cdata(&georeference.projection);
    xml.close("geoReference");
    let [x, y] = georeference.origin_m.map(xml::number);
    xml.empty("offset", &[("x", &x), ("y", &y), ("z", "0"), ("hdg", "0")]);
    xml.close("header");
}
