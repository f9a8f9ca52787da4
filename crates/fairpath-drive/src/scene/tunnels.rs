//! Tunnels: lining, portals and lamps. The ground above stays whole.

use super::roads::{beside, sections_within};
use super::shape::{P3, band, cuboid, quad, triangle};
use super::{Finish, Instances, Placement, Scene, part};
use crate::document::{PathResult, Results};
use crate::ground::CrossSection;
use crate::network::{Carrier, Junction};
use crate::section::{Material, Section};
use crate::terrain::Heightfield;
use fairpath_curve::{Point, Vec2, trig};
use fairpath_shape::Mesh;
use std::sync::Arc;

/// Sides of the vault.
const VAULT: usize = 10;

/// From the edge of what is laid to the wall, m.
const WALL_M: f64 = 0.8;

/// The portal's face reaches so far beside the opening, above it at least, and below the surface, m.
const BESIDE_M: f64 = 2.5;
const ABOVE_M: f64 = 1.0;
const FOOT_M: f64 = 1.0;

/// A tunnel's portal stands this far in front of where the ground closes over it, m.
const PORTAL_M: f64 = 4.0;

/// The flattest vault is so much higher in the middle than the clearance, m.
const FLAT_M: f64 = 0.25;

/// So much ground lies over a vault at least, m.
const COVER_M: f64 = 0.6;

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
        let opening = Opening::of(section);
        // What passes above needs the place that a round vault would take.
        let lower = results.crossings.iter().filter_map(|c| Some(c.upper_lower()?[1]));
        let is_below =
            lower.into_iter().any(|p| p.path == path.path.id && (tunnel.from_m..=tunnel.to_m).contains(&p.station_m));
        let closed = sections_within(&path.sections, [tunnel.from_m, tunnel.to_m]);
        let rise = if is_below { 0.0 } else { opening.covered_rise_m(&closed, results.ground.natural()) };
        let outline = opening.outline(rise);
        let line = |[left, up]: [f64; 2]| -> Vec<P3> { run.iter().map(|s| beside(s, left, up)).collect() };
        // Seen from inside: from the right foot over the top to the left foot.
        for pair in outline.windows(2) {
            band(&mut mesh, &line(pair[0]), &line(pair[1]));
        }
        for (sign, section) in [(1.0, run[0]), (-1.0, run[run.len() - 1])] {
            let station = if sign > 0.0 { tunnel.from_m } else { tunnel.to_m };
            match end_of(path, station, &results.junctions) {
                End::Portal => {
                    // It reaches up to the ground behind it, and a lid leads over to that.
                    let inside = station + sign * step;
                    let behind = sections_within(&path.sections, [inside, inside]).first().copied();
                    portal(&mut mesh, &section, behind.as_ref(), &outline, results.ground.natural());
                }
                End::Wall => wall(&mut mesh, &section, &outline),
                End::None => {}
            }
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

/// What is at the end of a tunnel.
enum End {
    Portal,
    /// A path ends within the ground.
    Wall,
    /// It goes on: over the seam of a closed path, or into an intersection.
    None,
}

fn end_of(path: &PathResult, station_m: f64, junctions: &[Arc<Junction>]) -> End {
    let length = path.path.length_m();
    if station_m > 0.0 && station_m < length {
        return End::Portal;
    }
    let spans = junctions.iter().flat_map(|j| &j.spans).filter(|(id, _)| *id == path.path.id);
    let mut spans = spans.map(|(_, span)| span);
    if path.path.plan.is_closed() {
        let tunnels = path.structures.iter().filter(|s| s.carrier == Carrier::Tunnel);
        let both = tunnels.fold([false; 2], |both, s| [both[0] || s.from_m <= 0.0, both[1] || s.to_m >= length]);
        return if both == [true; 2] { End::None } else { End::Portal };
    }
    if spans.any(|[from, to]| (*from..=*to).contains(&station_m)) { End::None } else { End::Wall }
}

/// Closes a tunnel, seen from both sides.
fn wall(mesh: &mut Mesh, section: &CrossSection, outline: &[[f64; 2]]) {
    let corners: Vec<P3> = outline.iter().map(|[left, up]| beside(section, *left, *up)).collect();
    for pair in corners[1..].windows(2) {
        triangle(mesh, [corners[0], pair[0], pair[1]]);
        triangle(mesh, [corners[0], pair[1], pair[0]]);
    }
}

/// The opening of a tunnel: upright walls and a vault, a part of an ellipse, under which the clearance is kept at the edges of what is laid.
struct Opening {
    /// Left of the middle of the path, and half the width, m.
    middle_m: f64,
    radius_m: f64,
    clearance_m: f64,
    /// How high the vault is at the edge of what is laid, as a share of its rise.
    at_edge: f64,
}

impl Opening {
    fn of(section: &Section) -> Self {
        let [left, right] = section.half_widths_m().map(|half| half + WALL_M);
        let radius_m = 0.5 * (left + right);
        let at_edge = (1.0 - ((radius_m - WALL_M) / radius_m).powi(2)).sqrt();
        Self { middle_m: 0.5 * (left - right), radius_m, clearance_m: section.clearance_m, at_edge }
    }

    /// The rise of the vault that is a half circle, or, where the ground over these cross-sections has no room for that, the highest that stays below the ground.
    fn covered_rise_m(&self, sections: &[CrossSection], natural: &Heightfield) -> f64 {
        let mut rise = self.radius_m;
        for section in sections {
            for [sin, cos] in vault() {
                let place = section.point + section.left * (self.middle_m - self.radius_m * cos);
                let room = natural.height(place) - COVER_M - section.height_m - self.clearance_m;
                if sin > self.at_edge {
                    rise = rise.min(room / (sin - self.at_edge));
                }
            }
        }
        rise
    }

    /// Left of the middle and above the surface, from the right foot to the left one, with a vault of this rise, or of the least.
    fn outline(&self, rise_m: f64) -> Vec<[f64; 2]> {
        let rise = rise_m.max(FLAT_M / (1.0 - self.at_edge));
        let spring = (self.clearance_m - rise * self.at_edge).max(0.5 * self.clearance_m);
        let mut outline = vec![[self.middle_m - self.radius_m, -0.3]];
        outline.extend(vault().map(|[sin, cos]| [self.middle_m - self.radius_m * cos, spring + rise * sin]));
        outline.push([self.middle_m + self.radius_m, -0.3]);
        outline
    }
}

/// Sine and cosine of the corners of a vault, from the right to the left.
fn vault() -> impl Iterator<Item = [f64; 2]> {
    (0..=VAULT).map(|k| trig::sin_cos(std::f64::consts::PI * k as f64 / VAULT as f64)).map(|(sin, cos)| [sin, cos])
}

/// The face around the opening, whose top follows the natural ground at the section behind it, and a lid from there to that ground.
fn portal(
    mesh: &mut Mesh,
    section: &CrossSection,
    behind: Option<&CrossSection>,
    outline: &[[f64; 2]],
    natural: &Heightfield,
) {
    let (first, last) = (outline[0], outline[outline.len() - 1]);
    // On the right, in the middle and on the left.
    let sides = [first[0] - BESIDE_M, 0.5 * (first[0] + last[0]), last[0] + BESIDE_M];
    let ground = |behind: &CrossSection, left: f64| natural.height(behind.point + behind.left * left);
    let least = outline.iter().map(|p| p[1]).fold(0.0, f64::max) + ABOVE_M;
    let tops = sides.map(|side| {
        let above = behind.map_or(f64::NEG_INFINITY, |b| ground(b, side) - section.height_m + EDGE_M);
        [side, least.max(above)]
    });
    let top = |left: f64| {
        let [a, b] = if left < sides[1] { [tops[0], tops[1]] } else { [tops[1], tops[2]] };
        [left, a[1] + (b[1] - a[1]) * (left - a[0]) / (b[0] - a[0])]
    };
    let at = |[left, up]: [f64; 2]| beside(section, left, up);
    // Seen from both sides.
    let mut face = |[a, b, c, d]: [P3; 4]| {
        quad(mesh, [a, b, c, d]);
        quad(mesh, [d, c, b, a]);
    };
    for pair in outline.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        face([a, b, top(b[0]), top(a[0])].map(at));
    }
    for [outer, inner] in [[sides[0], first[0]], [last[0], sides[2]]] {
        face([[outer, -FOOT_M], [inner, -FOOT_M], top(inner), top(outer)].map(at));
    }
    if let Some(behind) = behind {
        let on_ground = |left: f64| {
            let place = behind.point + behind.left * left;
            [place.x, place.y, ground(behind, left) - EDGE_M]
        };
        for pair in tops.windows(2) {
            face([at(pair[0]), at(pair[1]), on_ground(pair[1][0]), on_ground(pair[0][0])]);
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

/// The mouths of all tunnels with a portal.
pub(super) fn mouths(results: &Results) -> Vec<Mouth> {
    let step = results.ground.grid().step_m();
    let of = |path: &PathResult| {
        let ends = path.structures.iter().filter(|s| s.carrier == Carrier::Tunnel);
        let ends = ends.flat_map(|s| [(s.from_m, 1.0), (s.to_m, -1.0)]);
        let ends = ends.filter(|(station, _)| matches!(end_of(path, *station, &results.junctions), End::Portal));
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
