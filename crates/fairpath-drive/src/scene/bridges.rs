//! Bridges: deck, parapets, abutments and pillars. No pillar stands on another path or in the way of its traffic.

use super::roads::{beside, outside, sections_within, wall};
use super::shape::{P3, band, cuboid, quad};
use super::{Finish, Instances, Placement, Scene, part};
use crate::document::{PathResult, Results};
use crate::furniture::pillars;
use crate::ground::CrossSection;
use crate::network::{Carrier, Junction};
use crate::section::Material;
use fairpath_curve::trig;
use fairpath_shape::Mesh;
use std::f64::consts::FRAC_PI_2;

/// Height and thickness of a parapet, m.
const PARAPET_M: [f64; 2] = [0.9, 0.25];

/// Side of a pillar along the bridge, m; across it is half as wide as the deck.
const PILLAR_M: f64 = 1.2;

pub(super) fn add(scene: &mut Scene, path: &PathResult, results: &Results) {
    let section = &path.path.section;
    let concrete = Finish::Section(Material::Concrete);
    let [left, right] = section.half_widths_m();
    let mut mesh = Mesh::default();
    for bridge in path.structures.iter().filter(|s| s.carrier == Carrier::Bridge) {
        let run = sections_within(&path.sections, [bridge.from_m, bridge.to_m]);
        if run.len() < 2 {
            continue;
        }
        let line = |left_m: f64, above_m: f64| -> Vec<P3> { run.iter().map(|s| beside(s, left_m, above_m)).collect() };
        let deep = -section.thickness_m;
        let (out_left, out_right) = (left + PARAPET_M[1], right + PARAPET_M[1]);
        // The slab: below and at its sides; what lies on it is the road, and parapets stand on it.
        band(&mut mesh, &line(-out_right, deep), &line(out_left, deep));
        band(&mut mesh, &line(out_left, deep), &line(out_left, 0.0));
        band(&mut mesh, &line(-out_right, 0.0), &line(-out_right, deep));
        for sides in [[left, out_left], [-out_right, -right]] {
            for range in guarded(path, results, sides[0] >= 0.0) {
                let range = [range[0].max(bridge.from_m), range[1].min(bridge.to_m)];
                if range[0] < range[1] {
                    parapet(&mut mesh, &sections_within(&path.sections, range), sides);
                }
            }
        }
        let ends = [(&run[0], bridge.from_m, true), (&run[run.len() - 1], bridge.to_m, false)];
        for (section, _, backward) in ends.into_iter().filter(|(_, end_m, _)| is_on_bank(path, results, *end_m)) {
            // The abutment closes the embankment below the deck, down into the ground.
            let foot = section.natural_m.min(section.height_m + deep) - 1.0 - section.height_m;
            let corner = |left_m: f64, above_m: f64| beside(section, left_m, above_m);
            let face =
                [corner(out_left, foot), corner(-out_right, foot), corner(-out_right, 0.0), corner(out_left, 0.0)];
            let turned = [face[1], face[0], face[3], face[2]];
            quad(&mut mesh, if backward { turned } else { face });
            quad(&mut mesh, if backward { face } else { turned });
            let along = [section.left.y, -section.left.x].map(|x| x * if backward { -3.0 } else { 3.0 });
            for edge in [out_left, -out_right] {
                let low = corner(edge, foot);
                let high = corner(edge, PARAPET_M[0]);
                let far = |p: P3| [p[0] + along[0], p[1] + along[1], p[2]];
                wall(&mut mesh, &[low, far(low)], &[high, far(high)]);
            }
        }
    }
    scene.part(format!("bridges of {}", path.path.name), concrete, mesh);
    let stands = pillars(path, results);
    if stands.is_empty() {
        return;
    }
    let across = 0.5 * section.width_m();
    let unit = part("pillar", concrete, |mesh| cuboid(mesh, [0.0, 0.0, -1.0], [PILLAR_M, across, 1.0]));
    // A pillar is as tall as it has to be: pieces of one metre stand on each other.
    let at = stands.iter().flat_map(|p| {
        let count = (p.top_m - p.foot_m).ceil().max(1.0) as usize;
        (0..count).map(move |k| Placement {
            position: [p.place.x, p.place.y, p.top_m - k as f64],
            heading_rad: p.heading_rad,
            pitch_rad: 0.0,
            scale: 1.0,
        })
    });
    scene.instances.push(Instances {
        name: format!("pillars of {}", path.path.name),
        at: at.collect(),
        parts: vec![unit],
    });
}

/// Whether an embankment begins where a bridge ends: not within an intersection, nor where another bridge goes on around a closed path.
fn is_on_bank(path: &PathResult, results: &Results, end_m: f64) -> bool {
    let length = path.path.length_m();
    let places = if path.path.plan.is_closed() { &[-1.0, 0.0, 1.0][..] } else { &[0.0] };
    let places = places.iter().map(|turn| end_m + turn * length);
    let bridges = path.structures.iter().filter(|s| s.carrier == Carrier::Bridge);
    let ends = bridges.flat_map(|bridge| [bridge.from_m, bridge.to_m]);
    let meeting = ends.filter(|end| places.clone().any(|place| (place - end).abs() < 1e-6)).count();
    let mut spans = results.junctions.iter().flat_map(|junction| &junction.spans).filter(|span| span.0 == path.path.id);
    meeting < 2 && !spans.any(|(_, [from, to])| places.clone().any(|place| (*from..=*to).contains(&place)))
}

/// The stretches of a path along which nothing leads off to a side.
fn guarded(path: &PathResult, results: &Results, is_left: bool) -> Vec<[f64; 2]> {
    let (plan, length) = (&path.path.plan, path.path.length_m());
    // Around a closed path a span may begin before its start.
    let turns = if plan.is_closed() { &[-1.0, 0.0, 1.0][..] } else { &[0.0] };
    let leads_off = |junction: &Junction, [from, to]: [f64; 2]| {
        let middle = 0.5 * (from + to);
        let middle = if plan.is_closed() { middle.rem_euclid(length) } else { middle.clamp(0.0, length) };
        let middle = plan.pose_at(middle);
        let left = trig::unit(middle.heading + FRAC_PI_2);
        junction.arms.iter().any(|arm| {
            let is_here = |turn: &f64| (from - 1.0..=to + 1.0).contains(&(arm.station_m + turn * length));
            let is_own = arm.path == path.path.id && turns.iter().any(is_here);
            let off = results.path(arm.path).map(|p| (p.path.plan.point_at(arm.station_m) - middle.point).dot(left));
            !is_own && off.is_some_and(|off| (off > 0.0) == is_left)
        })
    };
    let spans = results.junctions.iter().flat_map(|junction| junction.spans.iter().map(move |span| (junction, span)));
    let own = spans.filter(|(junction, span)| span.0 == path.path.id && leads_off(junction, span.1));
    outside(path, own.map(|(_, span)| span.1))
}

/// A parapet between two distances from the middle, from the one further to the right.
fn parapet(mesh: &mut Mesh, run: &[CrossSection], [right, left]: [f64; 2]) {
    let line = |left_m: f64, above_m: f64| -> Vec<P3> { run.iter().map(|s| beside(s, left_m, above_m)).collect() };
    band(mesh, &line(left, 0.0), &line(left, PARAPET_M[0]));
    band(mesh, &line(left, PARAPET_M[0]), &line(right, PARAPET_M[0]));
    band(mesh, &line(right, PARAPET_M[0]), &line(right, 0.0));
    for section in run.first().into_iter().chain(run.last()) {
        let [low, high] = [0.0, PARAPET_M[0]].map(|above| [right, left].map(|left| beside(section, left, above)));
        wall(mesh, &low, &high);
    }
}
