//! Tunnels: lining, portals and lamps. The ground above stays whole.

use super::roads::{beside, sections_within};
use super::shape::{P3, band, cuboid, quad};
use super::{Finish, Instances, Placement, Scene, part};
use crate::document::{PathResult, Results};
use crate::ground::CrossSection;
use crate::network::Carrier;
use crate::section::Material;
use crate::terrain::Heightfield;
use fairpath_curve::{Point, Vec2, trig};
use fairpath_shape::Mesh;

/// Sides of the vault.
const VAULT: usize = 10;

/// From the edge of what is laid to the wall, m.
const WALL_M: f64 = 0.8;

/// Width of the portal's face beside the opening and above it, m.
const FACE_M: f64 = 2.5;

/// A tunnel's portal stands this far in front of where the ground closes over it, m.
const PORTAL_M: f64 = 4.0;

/// A flat vault is so much higher in the middle than the clearance, m.
const FLAT_M: f64 = 0.25;

/// From lamp to lamp, m.
const LAMP_M: f64 = 12.0;

pub(super) fn add(scene: &mut Scene, path: &PathResult, results: &Results) {
    let section = &path.path.section;
    // A step further than the ground is left open.
    let step = (MOUTH_STEPS + 1.0) * results.ground.grid().step_m();
    let mut mesh = Mesh::default();
    let mut lamps = Vec::new();
    for tunnel in path.structures.iter().filter(|s| s.carrier == Carrier::Tunnel) {
        // The portals stand in front, where the ground is cut already: the step in the ground is behind them.
        let (from, to) = ((tunnel.from_m - PORTAL_M).max(0.0), (tunnel.to_m + PORTAL_M).min(path.path.length_m()));
        let run = sections_within(&path.sections, [from, to]);
        if run.len() < 2 {
            continue;
        }
        // What passes above needs the place that a round vault would take.
        let lower = results.crossings.iter().filter_map(|c| Some(c.upper_lower()?[1]));
        let is_below =
            lower.into_iter().any(|p| p.path == path.path.id && (tunnel.from_m..=tunnel.to_m).contains(&p.station_m));
        let outline = opening(section.half_widths_m(), section.clearance_m, is_below);
        let line = |[left, up]: [f64; 2]| -> Vec<P3> { run.iter().map(|s| beside(s, left, up)).collect() };
        // Seen from inside: from the right foot over the top to the left foot.
        for pair in outline.windows(2) {
            band(&mut mesh, &line(pair[0]), &line(pair[1]));
        }
        // At its end in the open the portal reaches up to the ground behind it, and a lid leads over to that.
        for (at_start, section) in [(true, run[0]), (false, run[run.len() - 1])] {
            let inside = if at_start { tunnel.from_m + step } else { tunnel.to_m - step };
            let behind = sections_within(&path.sections, [inside, inside]).first().copied();
            portal(&mut mesh, &section, behind.as_ref(), &outline, results.ground.natural());
        }
        let top = outline.iter().map(|p| p[1]).fold(0.0, f64::max);
        let count = ((tunnel.to_m - tunnel.from_m) / LAMP_M).floor().max(1.0) as usize;
        for k in 0..count {
            let station = tunnel.from_m + (k as f64 + 0.5) * (tunnel.to_m - tunnel.from_m) / count as f64;
            let pose = path.path.plan.pose_at(station);
            let height = path.profile.at(station).height_m + top - 0.15;
            lamps.push(Placement {
                position: [pose.point.x, pose.point.y, height],
                heading_rad: pose.heading,
                pitch_rad: 0.0,
                scale: 1.0,
            });
        }
    }
    scene.part(format!("tunnels of {}", path.path.name), Finish::Section(Material::Concrete), mesh);
    let lamp = part("lamp", Finish::Light, |mesh| cuboid(mesh, [0.0, 0.0, -0.1], [1.2, 0.3, 0.1]));
    scene.instances.push(Instances { name: format!("lamps of {}", path.path.name), at: lamps, parts: vec![lamp] });
}

/// The outline of the opening, left of the middle and above the surface, from the right foot to the left one: upright walls and above the clearance a round vault, or a flat one.
fn opening([left, right]: [f64; 2], clearance_m: f64, is_flat: bool) -> Vec<[f64; 2]> {
    let (left, right) = (left + WALL_M, right + WALL_M);
    let (middle, radius) = (0.5 * (left - right), 0.5 * (left + right));
    // The vault begins so low that the clearance fits under it at the edge of what is laid.
    let at_edge = (1.0 - ((radius - WALL_M) / radius).powi(2)).sqrt();
    let rise = if is_flat { FLAT_M / (1.0 - at_edge) } else { radius };
    let spring = (clearance_m - rise * at_edge).max(0.5 * clearance_m);
    let mut outline = vec![[-right, -0.3]];
    for k in 0..=VAULT {
        let (sin, cos) = trig::sin_cos(std::f64::consts::PI * k as f64 / VAULT as f64);
        outline.push([middle - radius * cos, spring + rise * sin]);
    }
    outline.push([left, -0.3]);
    outline
}

/// The face around the opening, and a lid from it to the natural ground at the section behind it.
fn portal(
    mesh: &mut Mesh,
    section: &CrossSection,
    behind: Option<&CrossSection>,
    outline: &[[f64; 2]],
    natural: &Heightfield,
) {
    let (right, left) = (outline[0][0] - FACE_M, outline[outline.len() - 1][0] + FACE_M);
    let ground = |behind: &CrossSection, left: f64| {
        let place = behind.point + behind.left * left;
        natural.height(place)
    };
    let sides = [right, 0.5 * (right + left), left];
    let above = behind.map_or(f64::NEG_INFINITY, |b| {
        sides.iter().map(|side| ground(b, *side)).fold(f64::NEG_INFINITY, f64::max) - section.height_m
    });
    let top = (outline.iter().map(|p| p[1]).fold(0.0, f64::max) + FACE_M).max(above + EDGE_M);
    let at = |[l, up]: [f64; 2]| beside(section, l, up);
    // Seen from both sides.
    let mut face = |[a, b, c, d]: [P3; 4]| {
        quad(mesh, [a, b, c, d]);
        quad(mesh, [d, c, b, a]);
    };
    for pair in outline.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        face([a, b, [b[0], top], [a[0], top]].map(at));
    }
    let (first, last) = (outline[0], outline[outline.len() - 1]);
    face([[right, -1.0], [first[0], -1.0], [first[0], top], [right, top]].map(at));
    face([[last[0], -1.0], [left, -1.0], [left, top], [last[0], top]].map(at));
    if let Some(behind) = behind {
        let on_ground = |left: f64| {
            let place = behind.point + behind.left * left;
            [place.x, place.y, ground(behind, left) - EDGE_M]
        };
        for pair in sides.windows(2) {
            face([at([pair[0], top]), at([pair[1], top]), on_ground(pair[1]), on_ground(pair[0])]);
        }
    }
}

/// A place where a road leads into the ground: there the step between the ground that was cut and that which is whole would close the tunnel.
pub(super) struct Mouth {
    point: Point,
    /// Into the tunnel, and to the left of the path, of length 1.
    inward: Vec2,
    left: Vec2,
    /// How far it reaches inwards and outwards, and to the right and the left, m.
    along: [f64; 2],
    across: [f64; 2],
}

/// The mouths of all tunnels, but for those at which a path ends.
pub(super) fn mouths(results: &Results) -> Vec<Mouth> {
    let step = results.ground.grid().step_m();
    let of = |path: &PathResult| {
        let ends = path.structures.iter().filter(|s| s.carrier == Carrier::Tunnel);
        let ends = ends.flat_map(|s| [(s.from_m, 1.0), (s.to_m, -1.0)]);
        let [left, right] = path.path.section.half_widths_m();
        let mouth = |(station, sign): (f64, f64)| {
            let pose = path.path.plan.pose_at(station);
            let tangent = trig::unit(pose.heading);
            Mouth {
                point: pose.point,
                inward: tangent * sign,
                left: Vec2::new(-tangent.y, tangent.x),
                along: [-step, MOUTH_STEPS * step],
                across: [-(right + WALL_M), left + WALL_M],
            }
        };
        ends.map(mouth).collect::<Vec<_>>()
    };
    results.paths.iter().flat_map(|path| of(path)).collect()
}

impl Mouth {
    /// Whether a box of the ground may have a part of it.
    pub(super) fn may_lie_in(&self, low: Point, high: Point) -> bool {
        let reach = self.along[1].max(self.across[1]).max(-self.across[0]) * std::f64::consts::SQRT_2;
        let within = |x: f64, low: f64, high: f64| x > low - reach && x < high + reach;
        within(self.point.x, low.x, high.x) && within(self.point.y, low.y, high.y)
    }

    /// Whether ground with this middle and these heights at its corners would stand in it.
    pub(super) fn opens(&self, middle: Point, heights: &[f64]) -> bool {
        let off = middle - self.point;
        let (along, across) = (off.dot(self.inward), off.dot(self.left));
        let (low, high) = heights.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), z| (a.min(*z), b.max(*z)));
        high - low > STANDS_M
            && (self.along[0]..=self.along[1]).contains(&along)
            && (self.across[0]..=self.across[1]).contains(&across)
    }
}

/// Ground that rises by more from one sample to the next stands in a mouth, m.
const STANDS_M: f64 = 2.0;

/// A mouth reaches so many steps of the grid of the ground into it.
const MOUTH_STEPS: f64 = 2.0;

/// A portal stands out above the ground by this, and its lid reaches as far below it, m.
const EDGE_M: f64 = 0.3;
