//! Where a path lies on the ground, on a bridge or in a tunnel: its profile, the ground and its crossings come in, stretches go out (section 3.6.3 of the thesis).

use super::contact::{Crossing, PathPlace};
use super::path::Path;
use crate::profile::Profile;
use crate::terrain::{Heightfield, Waters};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What carries a stretch of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Carrier {
    /// A bridge: over water, over another path, or where a fill would be too high.
    Bridge,
    /// A tunnel: where a cut would be too deep.
    Tunnel,
}

/// A stretch of a path that does not lie on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Structure {
    /// What carries it.
    pub carrier: Carrier,
    /// Where it begins, arc length, m.
    pub from_m: f64,
    /// Where it ends, m.
    pub to_m: f64,
    /// How far the path lies above the ground (below it in a tunnel) where that is most, m.
    pub most_m: f64,
    /// Whether it spans water.
    pub over_water: bool,
    /// Whether it spans another path.
    pub over_path: bool,
}

/// From which heights on there are bridges and tunnels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StructureLimits {
    /// A fill higher than this becomes a bridge, m.
    pub bridge_above_m: f64,
    /// A cut deeper than this becomes a tunnel, m.
    pub tunnel_below_m: f64,
    /// No bridge or tunnel is shorter, but for those over water and other paths, m.
    pub least_length_m: f64,
    /// Two that lie nearer than this become one, m.
    pub gap_m: f64,
    /// Where a fill or cut of less than this share of the limit ends, the bridge or tunnel ends.
    pub end_share: f64,
}

impl Default for StructureLimits {
    fn default() -> Self {
        Self { bridge_above_m: 8.0, tunnel_below_m: 14.0, least_length_m: 20.0, gap_m: 15.0, end_share: 0.6 }
    }
}

/// Profile and ground are compared in steps of this length, m.
const STEP_M: f64 = 2.0;

/// The abutment of a bridge over a path stands this far beside it, m.
const BESIDE_M: f64 = 2.0;

/// An abutment at the water stands this far inland, m.
const INLAND_M: f64 = 4.0;

/// The bridges and tunnels of a path, in the order of their stations. `other` gives the paths that it crosses.
pub(crate) fn structures<'a>(
    path: &Path,
    profile: &Profile,
    crossings: &[Crossing],
    other: impl Fn(PathPlace) -> Option<&'a Path>,
    ground: &Heightfield,
    waters: &Waters,
    limits: &StructureLimits,
) -> Vec<Structure> {
    let length = path.length_m();
    let count = (length / STEP_M).ceil().max(1.0) as usize;
    let step = length / count as f64;
    let station = |i: usize| length * i as f64 / count as f64;
    let at: Vec<(f64, bool)> = (0..=count)
        .map(|i| {
            let place = path.plan.point_at(station(i));
            let z = ground.height(place);
            let wet = waters.covers(place, z);
            (profile.at(station(i)).height_m - z, wet)
        })
        .collect();
    let mut found = Vec::new();
    if path.section.shapes_ground {
        for (carrier, limit, sign) in
            [(Carrier::Bridge, limits.bridge_above_m, 1.0), (Carrier::Tunnel, limits.tunnel_below_m, -1.0)]
        {
            let above = |i: usize| sign * at[i].0;
            for range in stretches(count, |i| above(i) > limit, |i| above(i) > limits.end_share * limit) {
                let [a, b] = range.map(station);
                if b - a >= limits.least_length_m {
                    let most_m = (range[0]..=range[1]).map(above).fold(0.0, f64::max);
                    found.push(Structure { carrier, from_m: a, to_m: b, most_m, over_water: false, over_path: false });
                }
            }
        }
        // Over water, whatever its height; a path under water is a tunnel already or goes through it.
        for range in stretches(count, |i| at[i].1 && at[i].0 > 0.0, |i| at[i].1) {
            let most_m = (range[0]..=range[1]).map(|i| at[i].0).fold(0.0, f64::max);
            let from_m = (station(range[0]) - INLAND_M.max(step)).max(0.0);
            let to_m = (station(range[1]) + INLAND_M.max(step)).min(length);
            found.push(Structure {
                carrier: Carrier::Bridge,
                from_m,
                to_m,
                most_m,
                over_water: true,
                over_path: false,
            });
        }
        found.extend(crossings.iter().filter_map(|c| over_path(path, c, &other, profile, ground)));
    }
    united(found, limits, length)
}

/// Ranges in which `ends` holds throughout and `begins` somewhere.
fn stretches(count: usize, begins: impl Fn(usize) -> bool, ends: impl Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let mut found = Vec::new();
    let mut from = None;
    for i in 0..=count + 1 {
        if i <= count && ends(i) {
            from = from.or(Some(i));
        } else if let Some(first) = from.take() {
            let last = i - 1;
            if (first..=last).any(&begins) {
                found.push([first, last]);
            }
        }
    }
    found
}

/// The bridge on which a path passes over another one; none where the other is in the depth of a tunnel.
fn over_path<'a>(
    path: &Path,
    crossing: &Crossing,
    other: impl Fn(PathPlace) -> Option<&'a Path>,
    profile: &Profile,
    ground: &Heightfield,
) -> Option<Structure> {
    let [upper, lower] = crossing.upper_lower()?;
    if upper.path != path.id {
        return None;
    }
    let below = other(lower)?;
    let (own, cross) = (path.plan.tangent_at(upper.station_m), below.plan.tangent_at(lower.station_m));
    // At a small angle it takes a long bridge, but not one without end.
    let sine = own.cross(cross).abs().max(0.17);
    let half = (0.5 * below.section.width_m() + 0.5 * path.section.width_m() * own.dot(cross).abs()) / sine + BESIDE_M;
    let length = path.length_m();
    let most_m = profile.at(upper.station_m).height_m - ground.height(crossing.point);
    let (from_m, to_m) = ((upper.station_m - half).max(0.0), (upper.station_m + half).min(length));
    Some(Structure {
        carrier: Carrier::Bridge,
        from_m,
        to_m,
        most_m: most_m.max(0.0),
        over_water: false,
        over_path: true,
    })
}

/// Those of one kind that overlap or nearly touch are one; a bridge goes before a tunnel where both would be.
fn united(mut found: Vec<Structure>, limits: &StructureLimits, length: f64) -> Vec<Structure> {
    found.sort_by(|a, b| a.from_m.total_cmp(&b.from_m).then(a.to_m.total_cmp(&b.to_m)));
    let mut kept: Vec<Structure> = Vec::new();
    for carrier in [Carrier::Bridge, Carrier::Tunnel] {
        let mut last: Option<Structure> = None;
        for s in found.iter().filter(|s| s.carrier == carrier) {
            match &mut last {
                Some(l) if s.from_m - l.to_m <= limits.gap_m => {
                    l.to_m = l.to_m.max(s.to_m);
                    l.most_m = l.most_m.max(s.most_m);
                    l.over_water |= s.over_water;
                    l.over_path |= s.over_path;
                }
                _ => kept.extend(last.replace(*s)),
            }
        }
        kept.extend(last);
    }
    let bridges: Vec<Structure> = kept.iter().copied().filter(|s| s.carrier == Carrier::Bridge).collect();
    let mut all = bridges.clone();
    for tunnel in kept.iter().filter(|s| s.carrier == Carrier::Tunnel) {
        // What is left of the tunnel between the bridges.
        let mut from = tunnel.from_m;
        for end in bridges.iter().filter(|b| b.to_m > tunnel.from_m && b.from_m < tunnel.to_m) {
            if end.from_m - from >= limits.least_length_m {
                all.push(Structure { from_m: from, to_m: end.from_m, ..*tunnel });
            }
            from = from.max(end.to_m);
        }
        if tunnel.to_m - from >= limits.least_length_m.min(length) {
            all.push(Structure { from_m: from, to_m: tunnel.to_m, ..*tunnel });
        }
    }
    all.sort_by(|a, b| a.from_m.total_cmp(&b.from_m));
    all
}

impl StructureLimits {
    /// Checks every limit against its range.
    ///
    /// # Errors
    /// Names the first that is out of it.
    pub fn validate(&self) -> Result<(), crate::range::OutOfRange> {
        use crate::range::within;
        within("bridge_above_m", self.bridge_above_m, 0.5, 1e4, "0.5 to 10000 m")?;
        within("tunnel_below_m", self.tunnel_below_m, 0.5, 1e4, "0.5 to 10000 m")?;
        within("least_length_m", self.least_length_m, 0.0, 1e4, "0 to 10000 m")?;
        within("gap_m", self.gap_m, 0.0, 1e4, "0 to 10000 m")?;
        within("end_share", self.end_share, 0.0, 1.0, "0 to 1")
    }
}
