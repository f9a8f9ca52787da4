//! What lies on a path: its lanes, their sides and lines, and the pieces along it.

use super::shape::{P3, band, quad};
use super::{Finish, Instances, Placement, Scene, part};
use crate::document::PathResult;
use crate::ground::CrossSection;
use crate::network::Junction;
use crate::section::{Lane, LaneKind, Marking, Material, Section};
use fairpath_shape::Mesh;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Width of a line, and how far it lies above the surface, m.
const LINE_M: f64 = 0.12;
const PAINT_M: f64 = 0.015;

/// A broken line: so much paint, then so much none, m.
const DASH_M: f64 = 3.0;
const GAP_M: f64 = 6.0;

pub(super) fn add(scene: &mut Scene, path: &PathResult, junctions: &[Arc<Junction>]) {
    let section = &path.path.section;
    let mut meshes: BTreeMap<Finish, Mesh> = BTreeMap::new();
    let spans = junctions.iter().flat_map(|junction| &junction.spans);
    for range in outside(path, spans.filter(|span| span.0 == path.path.id).map(|span| span.1)) {
        let run = sections_within(&path.sections, range);
        if run.len() < 2 {
            continue;
        }
        surface(section, &run, &mut meshes);
        lines(section, &run, &mut meshes);
    }
    for (finish, mesh) in meshes {
        scene.part(path.path.name.clone(), finish, mesh);
    }
    pieces(scene, path);
}

/// The stretches of a path outside of intersections, of which the spans along it are given.
pub(super) fn outside(path: &PathResult, spans: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let length = path.path.length_m();
    let mut within: Vec<[f64; 2]> = Vec::new();
    for [from, to] in spans {
        within.push([from.max(0.0), to.min(length)]);
        if path.path.plan.is_closed() {
            within.extend((from < 0.0).then_some([from + length, length]));
            within.extend((to > length).then_some([0.0, to - length]));
        }
    }
    within.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut out = Vec::new();
    let mut from = 0.0;
    for [a, b] in within {
        if a > from {
            out.push([from, a]);
        }
        from = f64::max(from, b);
    }
    if from < length {
        out.push([from, length]);
    }
    out
}

/// The cross-sections within a range, with one at each end of it.
pub(super) fn sections_within(sections: &[CrossSection], [from, to]: [f64; 2]) -> Vec<CrossSection> {
    let mut run = Vec::new();
    run.extend(between(sections, from));
    run.extend(sections.iter().copied().filter(|s| s.station_m > from + 1e-6 && s.station_m < to - 1e-6));
    run.extend(between(sections, to));
    run.dedup_by(|b, a| b.station_m - a.station_m < 1e-6);
    run
}

/// The cross-section at a station, between the two beside it.
fn between(sections: &[CrossSection], station: f64) -> Option<CrossSection> {
    let i = sections.partition_point(|s| s.station_m < station);
    let b = sections.get(i).or(sections.last())?;
    let a = &sections[i.saturating_sub(1)];
    let t = if b.station_m > a.station_m {
        ((station - a.station_m) / (b.station_m - a.station_m)).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let left = a.left.lerp(b.left, t);
    Some(CrossSection {
        station_m: station,
        point: a.point.lerp(b.point, t),
        left: left / left.hypot2().sqrt(),
        height_m: a.height_m + t * (b.height_m - a.height_m),
        natural_m: a.natural_m + t * (b.natural_m - a.natural_m),
        ..if t > 0.5 { *b } else { *a }
    })
}

/// A place beside the middle of a cross-section: so far to the left and above the surface.
pub(super) fn beside(section: &CrossSection, left_m: f64, above_m: f64) -> P3 {
    let p = section.point + section.left * left_m;
    [p.x, p.y, section.height_m + above_m]
}

fn surface(section: &Section, run: &[CrossSection], meshes: &mut BTreeMap<Finish, Mesh>) {
    let line = |left_m: f64, above_m: f64| -> Vec<P3> { run.iter().map(|s| beside(s, left_m, above_m)).collect() };
    for (sign, lanes) in [(1.0, &section.left), (-1.0, &section.right)] {
        let mut inner = 0.0;
        for lane in lanes {
            let outer = inner + lane.width_m;
            let mesh = meshes.entry(Finish::Section(lane.material)).or_default();
            let (left, right) = if sign > 0.0 { (outer, inner) } else { (-inner, -outer) };
            band(mesh, &line(left, 0.0), &line(right, 0.0));
            inner = outer;
        }
    }
    // The sides of what is laid, down to the bed; underneath nobody looks, where it lies on the ground.
    let [left, right] = section.half_widths_m();
    let depth = if section.bed_m > 0.0 { section.bed_m } else { section.thickness_m };
    let edge = |lanes: &[Lane]| lanes.last().map_or(Material::Asphalt, |l| l.material);
    let mesh = meshes.entry(Finish::Section(edge(&section.left))).or_default();
    band(mesh, &line(left, -depth), &line(left, 0.0));
    let mesh = meshes.entry(Finish::Section(edge(&section.right))).or_default();
    band(mesh, &line(-right, 0.0), &line(-right, -depth));
    if !section.shapes_ground {
        band(
            meshes.entry(Finish::Section(edge(&section.left))).or_default(),
            &line(-right, -depth),
            &line(left, -depth),
        );
    }
}

fn lines(section: &Section, run: &[CrossSection], meshes: &mut BTreeMap<Finish, Mesh>) {
    let mut marks = vec![(0.0, section.centre)];
    for (sign, lanes) in [(1.0, &section.left), (-1.0, &section.right)] {
        let mut outer = 0.0;
        for lane in lanes {
            outer += lane.width_m;
            if lane.kind != LaneKind::None {
                marks.push((sign * outer, lane.marking));
            }
        }
    }
    let mesh = meshes.entry(Finish::Section(Material::Paint)).or_default();
    for (left_m, marking) in marks {
        match marking {
            Marking::None => {}
            Marking::Solid => stripe(mesh, run, left_m),
            Marking::Double => {
                stripe(mesh, run, left_m + LINE_M);
                stripe(mesh, run, left_m - LINE_M);
            }
            Marking::Broken => {
                let (first, last) = (run[0].station_m, run[run.len() - 1].station_m);
                let mut from = (first / (DASH_M + GAP_M)).ceil() * (DASH_M + GAP_M);
                while from + DASH_M <= last {
                    stripe(mesh, &sections_within(run, [from, from + DASH_M]), left_m);
                    from += DASH_M + GAP_M;
                }
            }
        }
    }
}

fn stripe(mesh: &mut Mesh, run: &[CrossSection], left_m: f64) {
    let line = |off: f64| -> Vec<P3> { run.iter().map(|s| beside(s, left_m + off, PAINT_M)).collect() };
    band(mesh, &line(0.5 * LINE_M), &line(-0.5 * LINE_M));
}

/// The parametric pieces along a path.
fn pieces(scene: &mut Scene, path: &PathResult) {
    let length = path.path.length_m();
    for piece in &path.path.section.pieces {
        let [along, across, up] = piece.size_m;
        let mesh = part(&piece.name, Finish::Section(piece.material), |mesh| {
            super::shape::cuboid(mesh, [0.0, 0.0, 0.0], [along, across, up]);
        });
        let count = (length / piece.every_m).floor() as usize;
        let at = (0..count).map(|k| {
            let station = (k as f64 + 0.5) * piece.every_m;
            let pose = path.path.plan.pose_at(station);
            let elevation = path.profile.at(station);
            let tangent = fairpath_curve::trig::unit(pose.heading);
            let p = pose.point + fairpath_curve::Vec2::new(-tangent.y, tangent.x) * piece.left_m;
            Placement {
                position: [p.x, p.y, elevation.height_m + piece.above_m],
                heading_rad: pose.heading,
                pitch_rad: libm::atan(elevation.grade),
                scale: 1.0,
            }
        });
        scene.instances.push(Instances {
            name: format!("{} of {}", piece.name, path.path.name),
            at: at.collect(),
            parts: vec![mesh],
        });
    }
}

/// A wall that stands up from one line of points to a line above it, seen from both sides.
pub(super) fn wall(mesh: &mut Mesh, low: &[P3], high: &[P3]) {
    for i in 1..low.len().min(high.len()) {
        quad(mesh, [low[i - 1], low[i], high[i], high[i - 1]]);
        quad(mesh, [low[i], low[i - 1], high[i - 1], high[i]]);
    }
}
