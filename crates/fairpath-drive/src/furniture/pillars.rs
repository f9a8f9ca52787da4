//! Where pillars stand below a bridge (section 3.6.3 of the thesis): evenly spaced, but not on other paths.

use crate::document::{PathResult, Results};
use crate::network::Carrier;
use fairpath_curve::Point;

/// Pillars stand about this far apart along a bridge, m.
const SPACING_M: f64 = 25.0;

/// A pillar is at least this high below the deck; lower ones would be walls, m.
const LEAST_M: f64 = 1.5;

/// A pillar is moved in steps of this length to both sides where it would stand on a path, m.
const STEP_M: f64 = 2.0;

/// No pillar stands nearer to the edge of another path than this, m.
const CLEAR_M: f64 = 1.5;

/// A pillar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pillar {
    /// Where it stands.
    pub place: Point,
    /// Heading of the bridge above it, radians.
    pub heading_rad: f64,
    /// Height of the ground at its foot, m.
    pub foot_m: f64,
    /// Height of its top, the underside of the deck, m.
    pub top_m: f64,
}

/// The pillars of all bridges of a path.
#[must_use]
pub fn pillars(path: &PathResult, results: &Results) -> Vec<Pillar> {
    let mut found = Vec::new();
    let half = 0.5 * path.path.section.width_m();
    for bridge in path.structures.iter().filter(|s| s.carrier == Carrier::Bridge) {
        let length = bridge.to_m - bridge.from_m;
        let count = (length / SPACING_M).ceil() as usize;
        let spacing = length / count.max(1) as f64;
        for k in 1..count {
            let wanted = bridge.from_m + k as f64 * spacing;
            let tries =
                (0..=(0.45 * spacing / STEP_M) as usize).flat_map(|i| [1.0, -1.0].map(|s| s * i as f64 * STEP_M));
            let free = tries.map(|by| wanted + by).find(|&s| is_free(path, s, half, results));
            let Some(station) = free else { continue };
            let pose = path.path.plan.pose_at(station);
            let foot_m = results.ground.height(pose.point);
            let top_m = path.profile.at(station).height_m - path.path.section.thickness_m;
            if top_m - foot_m >= LEAST_M {
                found.push(Pillar { place: pose.point, heading_rad: pose.heading, foot_m, top_m });
            }
        }
    }
    found
}

/// Whether no other path, or another place of the same one, lies under the bridge there.
fn is_free(path: &PathResult, station: f64, half: f64, results: &Results) -> bool {
    let place = path.path.plan.point_at(station);
    results.paths.iter().all(|other| {
        let reach = half + 0.5 * other.path.section.width_m() + CLEAR_M;
        if !other.path.plan.bounding_box().inflate(reach, reach).contains(place) {
            return true;
        }
        if other.path.id != path.path.id {
            return other.path.plan.nearest(place).distance > reach;
        }
        // Of the own path, what is not the bridge itself.
        let mut from = 0.0;
        other.path.plan.segments().iter().all(|segment| {
            let begin = from;
            from += segment.length;
            let near = segment.nearest_all(place);
            near.into_iter().all(|n| (begin + n.s - station).abs() < 2.0 * reach || n.distance > reach)
        })
    })
}
