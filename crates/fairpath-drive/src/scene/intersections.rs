//! The surface of intersections, with stop lines.

use super::shape::{P3, quad, triangle};
use super::{Finish, Scene};
use crate::document::{PathResult, Results, State};
use crate::furniture::stopping_arms;
use crate::network::{Arm, Junction};
use crate::section::{LaneKind, Material};
use fairpath_curve::{Point, Vec2, hermite_g1, trig};
use fairpath_shape::Mesh;
use std::f64::consts::PI;
use std::sync::Arc;

/// Width of a stop line, m.
const STOP_M: f64 = 0.4;

/// How far it lies above the surface, m.
const PAINT_M: f64 = 0.015;

/// Points along a kerb.
const KERB: usize = 8;

pub(super) fn add(scene: &mut Scene, state: &State, results: &Results) {
    let (mut ground, mut paint) = (Mesh::default(), Mesh::default());
    for junction in &results.junctions {
        surface(&mut ground, junction, results);
        let path_of = |id| state.path_of(id).map(Arc::as_ref);
        for arm in stopping_arms(junction, path_of) {
            stop_line(&mut paint, &arm, results);
        }
    }
    scene.part("intersections", Finish::Section(Material::Asphalt), ground);
    scene.part("stop lines", Finish::Section(Material::Paint), paint);
}

/// An arm as seen from the intersection.
struct Mouth {
    point: Point,
    heading: f64,
    out: Vec2,
    left: Vec2,
    /// Widths to the left and right as one drives out, m.
    widths: [f64; 2],
    height_m: f64,
}

fn mouth(arm: &Arm, results: &Results) -> Option<Mouth> {
    let path: &PathResult = results.path(arm.path)?;
    let pose = path.path.plan.pose_at(arm.station_m);
    let [left, right] = path.path.section.half_widths_m();
    let (heading, widths) =
        if arm.forward { (pose.heading, [left, right]) } else { (trig::wrap_angle(pose.heading + PI), [right, left]) };
    let out = trig::unit(heading);
    let height_m = path.profile.at(arm.station_m).height_m;
    Some(Mouth { point: pose.point, heading, out, left: Vec2::new(-out.y, out.x), widths, height_m })
}

/// A fan about the middle: arms against the clock, and between two of them the kerb.
fn surface(mesh: &mut Mesh, junction: &Junction, results: &Results) {
    let mouths: Vec<Mouth> = junction.arms.iter().filter_map(|arm| mouth(arm, results)).collect();
    if mouths.len() < 2 {
        return;
    }
    let mut rim: Vec<P3> = Vec::new();
    for (i, a) in mouths.iter().enumerate() {
        let b = &mouths[(i + 1) % mouths.len()];
        let right = a.point - a.left * a.widths[1];
        let left = a.point + a.left * a.widths[0];
        rim.push([right.x, right.y, a.height_m]);
        rim.push([left.x, left.y, a.height_m]);
        let next = b.point - b.left * b.widths[1];
        // The kerb leads in along the left of one arm, and out along the right of the next.
        let inward = trig::wrap_angle(a.heading + PI);
        let Some(kerb) = hermite_g1(left, inward, next, b.heading) else { continue };
        for k in 1..KERB {
            let t = k as f64 / KERB as f64;
            let p = kerb.point_at(t * kerb.length);
            rim.push([p.x, p.y, a.height_m + t * (b.height_m - a.height_m)]);
        }
    }
    let heights = results
        .paths
        .iter()
        .filter_map(|p| {
            let (_, [from, to]) = junction.spans.iter().find(|s| s.0 == p.path.id)?;
            let near = p.path.plan.nearest(junction.centre);
            let station = p.path.plan.station(near.segment, near.s);
            let within = station >= from - 1.0 && station <= to + 1.0;
            within.then(|| p.profile.at(station).height_m)
        })
        .collect::<Vec<f64>>();
    let mean = if heights.is_empty() {
        mouths.iter().map(|m| m.height_m).sum::<f64>() / mouths.len() as f64
    } else {
        heights.iter().sum::<f64>() / heights.len() as f64
    };
    let middle = [junction.centre.x, junction.centre.y, mean];
    for i in 0..rim.len() {
        triangle(mesh, [middle, rim[i], rim[(i + 1) % rim.len()]]);
    }
}

/// A line across the lanes that come in.
fn stop_line(mesh: &mut Mesh, arm: &Arm, results: &Results) {
    let (Some(mouth), Some(path)) = (mouth(arm, results), results.path(arm.path)) else { return };
    let section = &path.path.section;
    // Those who come in keep to their right, which is the left of the arm.
    let lanes = if arm.forward { &section.left } else { &section.right };
    let mut inner = 0.0;
    for lane in lanes {
        let outer = inner + lane.width_m;
        if lane.kind == LaneKind::Driving {
            let at = |left_m: f64, out_m: f64| {
                let p = mouth.point + mouth.left * left_m + mouth.out * out_m;
                [p.x, p.y, mouth.height_m + PAINT_M]
            };
            quad(mesh, [at(inner, 0.0), at(inner, STOP_M), at(outer, STOP_M), at(outer, 0.0)]);
        }
        inner = outer;
    }
}
