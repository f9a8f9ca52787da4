//! Roads between intersections: which stretches of which paths they are, how they are linked, and their elements.

use super::{is_road, lanes, objects, plan};
use crate::drive::export::DriveExport;
use crate::drive::xml::{Xml, number};
use fairpath_curve::Segment;
use fairpath_drive::{Arm, Knot, LaneKind, PathId, PathResult, Profile, Results};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A stretch of a path outside of intersections.
pub(super) struct Road<'a> {
    pub(super) id: u64,
    pub(super) path: &'a Arc<PathResult>,
    /// Which of the results' paths it is.
    pub(super) index: usize,
    /// Stations of the path; on a closed one the second may lie beyond the path's length.
    pub(super) range: [f64; 2],
    pub(super) geometries: Vec<Segment>,
    pub(super) profile: Profile,
    /// What it leads to at its start and at its end.
    pub(super) leads_to: [LeadsTo; 2],
}

/// What a road leads to at one of its ends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum LeadsTo {
    Nothing,
    /// An intersection, counted from 0.
    Junction(usize),
    /// Another road in the same direction, or itself.
    Road(u64),
}

/// All roads between intersections.
pub(super) struct Network<'a> {
    pub(super) roads: Vec<Road<'a>>,
    /// For an arm the road that goes out there.
    arms: BTreeMap<(usize, usize), u64>,
}

impl<'a> Network<'a> {
    pub(super) fn of(results: &'a Results) -> Self {
        let mut network = Self { roads: Vec::new(), arms: BTreeMap::new() };
        for (index, path) in results.paths.iter().enumerate().filter(|(_, p)| is_road(p)) {
            for (range, ring) in stretches(path, results) {
                network.add(results, (index, path), range, ring);
            }
        }
        network
    }

    /// Adds the road of a stretch; as two roads where it leads from an intersection back to it, since readers take one whose ends meet for broken.
    fn add(&mut self, results: &Results, (index, path): (usize, &'a Arc<PathResult>), range: [f64; 2], ring: bool) {
        let id = self.next_id();
        if ring {
            self.push((index, path), range, [LeadsTo::Road(id); 2]);
            return;
        }
        // The start of a road is where it goes out forward, its end where it goes out backward.
        let arms = [(range[0], true), (range[1], false)]
            .map(|(station, forward)| arm_at(results, path.path.id, station, forward, path));
        let leads_to = arms.map(|arm| arm.map_or(LeadsTo::Nothing, |(j, _)| LeadsTo::Junction(j)));
        let middle = 0.5 * (range[0] + range[1]);
        let last = match leads_to {
            [LeadsTo::Junction(a), LeadsTo::Junction(b)] if a == b => {
                self.push((index, path), [range[0], middle], [leads_to[0], LeadsTo::Road(id + 1)]);
                self.push((index, path), [middle, range[1]], [LeadsTo::Road(id), leads_to[1]]);
                id + 1
            }
            _ => {
                self.push((index, path), range, leads_to);
                id
            }
        };
        for (arm, id) in arms.into_iter().zip([id, last]) {
            self.arms.extend(arm.map(|arm| (arm, id)));
        }
    }

    fn push(&mut self, (index, path): (usize, &'a Arc<PathResult>), range: [f64; 2], leads_to: [LeadsTo; 2]) {
        let whole = range == [0.0, path.path.length_m()];
        let plan =
            if whole { Some(path.path.plan.as_ref().clone()) } else { path.path.plan.subspline(range[0], range[1]) };
        // Stretches are longer than a millimetre and lie on their path.
        if let (Some(plan), Some(profile)) = (plan, profile_of(path, range)) {
            let id = self.next_id();
            self.roads.push(Road { id, path, index, range, geometries: plan::geometries(&plan), profile, leads_to });
        }
    }

    /// The road that goes out at an arm of an intersection.
    pub(super) fn road_at(&self, junction: usize, arm: usize) -> Option<u64> {
        self.arms.get(&(junction, arm)).copied()
    }

    /// The number after the last road's.
    pub(super) fn next_id(&self) -> u64 {
        self.roads.len() as u64 + 1
    }
}

/// The arm that lies at a station of a path and goes out in a direction, if any way leads to or from it.
fn arm_at(results: &Results, path: PathId, station: f64, forward: bool, of: &PathResult) -> Option<(usize, usize)> {
    let length = of.path.length_m();
    let same = |x: f64| {
        let off = (x - station).abs();
        off < 1e-6 || (of.path.plan.is_closed() && (off - length).abs() < 1e-6)
    };
    results.junctions.iter().enumerate().find_map(|(j, junction)| {
        let is_it = |a: &Arm| a.path == path && a.forward == forward && same(a.station_m);
        let arm = junction.arms.iter().position(is_it)?;
        junction.ways.iter().any(|w| w.from == arm || w.to == arm).then_some((j, arm))
    })
}

/// The stretches of a path outside of intersections, and whether one is the whole of a closed path.
fn stretches(path: &PathResult, results: &Results) -> Vec<([f64; 2], bool)> {
    let length = path.path.length_m();
    let closed = path.path.plan.is_closed();
    let own = results.junctions.iter().flat_map(|j| &j.spans).filter(|s| s.0 == path.path.id);
    let mut spans: Vec<[f64; 2]> = own.map(|s| s.1).collect();
    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
    if spans.is_empty() {
        return vec![([0.0, length], closed)];
    }
    let mut out = Vec::new();
    if closed {
        for (i, span) in spans.iter().enumerate() {
            let next = spans.get(i + 1).map_or(spans[0][0] + length, |s| s[0]);
            out.push([span[1], next]);
        }
    } else {
        let mut from = 0.0;
        for span in &spans {
            out.push([from, span[0]]);
            from = span[1];
        }
        out.push([from, length]);
    }
    out.retain(|[a, b]| b - a > 1e-3);
    out.into_iter().map(|range| (range, false)).collect()
}

/// The profile of a stretch from station 0; on a closed path it may go on over the path's start.
fn profile_of(path: &PathResult, [from, to]: [f64; 2]) -> Option<Profile> {
    let length = path.path.length_m();
    if to <= length {
        return path.profile.part([from, to]).ok();
    }
    if from >= length {
        return path.profile.part([from - length, to - length]).ok();
    }
    let first = path.profile.part([from, length]).ok()?;
    let rest = path.profile.part([0.0, to - length]).ok()?;
    let moved = rest.knots().iter().skip(1).map(|k| Knot { station_m: k.station_m + length - from, ..*k });
    Profile::new(first.knots().iter().copied().chain(moved).collect()).ok()
}

pub(super) fn write(xml: &mut Xml, road: &Road<'_>, export: &DriveExport<'_>) {
    let id = road.id.to_string();
    let length = number(plan::length(&road.geometries));
    let name = &road.path.path.name;
    xml.open("road", &[("name", name), ("length", &length), ("id", &id), ("junction", "-1"), ("rule", "RHT")]);
    links(xml, road);
    types(xml, road);
    plan::write_plan(xml, &road.geometries);
    plan::write_elevation(xml, &road.profile);
    let goes_on = road.leads_to.map(|to| matches!(to, LeadsTo::Road(_)));
    lanes::write(xml, &road.path.path.section, goes_on);
    objects::write_objects(xml, road);
    objects::write_signals(xml, road, &export.results.signs[road.index]);
    xml.close("road");
}

fn links(xml: &mut Xml, road: &Road<'_>) {
    if road.leads_to == [LeadsTo::Nothing; 2] {
        return;
    }
    xml.open("link", &[]);
    for (name, contact, to) in [("predecessor", "end", road.leads_to[0]), ("successor", "start", road.leads_to[1])] {
        match to {
            LeadsTo::Nothing => {}
            LeadsTo::Junction(j) => {
                let id = junction_id(j).to_string();
                xml.empty(name, &[("elementType", "junction"), ("elementId", &id)]);
            }
            LeadsTo::Road(id) => {
                let id = id.to_string();
                xml.empty(name, &[("elementType", "road"), ("elementId", &id), ("contactPoint", contact)]);
            }
        }
    }
    xml.close("link");
}

/// Intersections are numbered after a million, so that their numbers are nobody else's.
pub(super) fn junction_id(junction: usize) -> u64 {
    1_000_000 + junction as u64
}

/// What kind of road it is, with the speed that holds.
fn types(xml: &mut Xml, road: &Road<'_>) {
    let path = &road.path.path;
    let has = |kind: LaneKind| path.section.left.iter().chain(&path.section.right).any(|lane| lane.kind == kind);
    let kinds = [(LaneKind::Driving, "rural"), (LaneKind::Sidewalk, "pedestrian"), (LaneKind::Cycling, "bicycle")];
    // There is no type for railways.
    let kind = kinds.into_iter().find(|(kind, _)| has(*kind)).map_or("unknown", |(_, name)| name);
    let length = path.length_m();
    let mut written: Option<f64> = None;
    let all = path.speed_limits();
    let turns = if path.plan.is_closed() { vec![0.0, length] } else { vec![0.0] };
    for turn in turns {
        for (i, (begin, kmh)) in all.iter().enumerate() {
            let (begin, end) = (begin + turn, all.get(i + 1).map_or(length, |l| l.0) + turn);
            if end <= road.range[0] + 1e-6 || begin >= road.range[1] - 1e-6 || written == Some(*kmh) {
                continue;
            }
            written = Some(*kmh);
            let s = number((begin - road.range[0]).max(0.0));
            xml.open("type", &[("s", &s), ("type", kind)]);
            xml.empty("speed", &[("max", &number(*kmh)), ("unit", "km/h")]);
            xml.close("type");
        }
    }
}
