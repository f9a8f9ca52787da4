//! Where a path lies on the ground, on a bridge or in a tunnel: its profile, the ground and its crossings come in, stretches go out (section 3.6.3 of the thesis).

use super::contact::{Crossing, PathPlace};
use super::path::Path;
use crate::course::Course;
use crate::profile::Profile;
use crate::survey::{STEP_M, Step, Survey};
use crate::terrain::Heightfield;
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

/// The abutment of a bridge over a path stands this far beside it, m.
const BESIDE_M: f64 = 2.0;

/// An abutment at the water stands this far inland, m.
const INLAND_M: f64 = 4.0;

/// The bridges and tunnels of a path, in the order of their stations; one that leads over the seam of a closed path is two. `other` gives the paths that it crosses, with their profiles.
pub(crate) fn structures<'a>(
    path: &Path,
    survey: &Survey,
    profile: &Profile,
    crossings: &[Crossing],
    other: impl Fn(PathPlace) -> Option<(&'a Path, &'a Profile)>,
    ground: &Heightfield,
    limits: &StructureLimits,
) -> Vec<Structure> {
    if !path.section.shapes_ground {
        return Vec::new();
    }
    let (length, closed) = (path.length_m(), path.plan.is_closed());
    let mut elevation = profile.along();
    let compare =
        |(station, step): (f64, &Step)| (station, (elevation(station).height_m - step.natural_m, step.is_wet));
    let (stations, at): (Vec<f64>, Vec<(f64, bool)>) = survey.stationed().map(compare).unzip();
    let count = stations.len() - 1;
    let station = |i: usize| if i > count { stations[i - count] + length } else { stations[i] };
    // A closed path is gone round twice, so that what leads over its seam is seen in one piece.
    let turns = if closed { 2 } else { 1 };
    let on = |i: usize| if i > count { at[i - count] } else { at[i] };
    let ranges = |begins: &dyn Fn(usize) -> bool, ends: &dyn Fn(usize) -> bool| {
        let mut found = stretches(turns * count, begins, ends);
        let around = found.iter().any(|r| r[1] - r[0] >= count);
        if closed && around {
            return vec![[0, count]];
        }
        // What is under way at the seam is found whole once more, and what begins beyond it is found a second time.
        found.retain(|r| !closed || (r[0] > 0 && r[0] <= count));
        found
    };
    let mut found = Vec::new();
    for (carrier, limit, sign) in
        [(Carrier::Bridge, limits.bridge_above_m, 1.0), (Carrier::Tunnel, limits.tunnel_below_m, -1.0)]
    {
        let above = |i: usize| sign * on(i).0;
        for range in ranges(&|i| above(i) > limit, &|i| above(i) > limits.end_share * limit) {
            let [a, b] = range.map(station);
            if b - a >= limits.least_length_m {
                let most_m = (range[0]..=range[1]).map(above).fold(0.0, f64::max);
                found.push(Structure { carrier, from_m: a, to_m: b, most_m, over_water: false, over_path: false });
            }
        }
    }
    // Over water, whatever its height; a path under water is a tunnel already or goes through it.
    for range in ranges(&|i| on(i).1 && on(i).0 > 0.0, &|i| on(i).1) {
        let most_m = (range[0]..=range[1]).map(|i| on(i).0).fold(0.0, f64::max);
        let [from_m, to_m] = [station(range[0]) - INLAND_M, station(range[1]) + INLAND_M];
        let carrier = Carrier::Bridge;
        found.push(Structure { carrier, from_m, to_m, most_m, over_water: true, over_path: false });
    }
    found.extend(crossings.iter().filter_map(|c| over_path(path, c, &other, profile, ground, limits)));
    for s in &mut found {
        if closed {
            let turn = (s.from_m / length).floor() * length;
            (s.from_m, s.to_m) = (s.from_m - turn, s.to_m - turn);
        } else {
            (s.from_m, s.to_m) = (s.from_m.max(0.0), s.to_m.min(length));
        }
    }
    let found = united(found, limits, closed.then_some(length));
    bridges_first(found, limits, length)
}

/// Ranges in which `ends` holds throughout and `begins` somewhere.
fn stretches(count: usize, begins: &dyn Fn(usize) -> bool, ends: &dyn Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let mut found = Vec::new();
    let mut from = None;
    for i in 0..=count + 1 {
        if i <= count && ends(i) {
            from = from.or(Some(i));
        } else if let Some(first) = from.take() {
            let last = i - 1;
            if (first..=last).any(begins) {
                found.push([first, last]);
            }
        }
    }
    found
}

/// Whether a path is in one of its tunnels at a station: the ground above it is whole, and carries whatever passes there.
fn is_in_tunnel(path: &Path, profile: &Profile, station: f64, ground: &Heightfield, limits: &StructureLimits) -> bool {
    let (length, course) = (path.length_m(), Course::new(&path.plan));
    let depth = |s: f64| {
        let s = if path.plan.is_closed() { s.rem_euclid(length) } else { s };
        ground.height(course.point_at(s)) - profile.at(s).height_m
    };
    let range = if path.plan.is_closed() { [station - length, station + length] } else { [0.0, length] };
    // How far it goes on, and how deep it is there.
    let side = |step: f64| {
        let places = (1..).map(|i| station + step * f64::from(i)).take_while(|s| (range[0]..=range[1]).contains(s));
        let below = places.map(depth).take_while(|depth| *depth > limits.end_share * limits.tunnel_below_m);
        below.fold((0.0, f64::NEG_INFINITY), |(reach, deepest), depth| (reach + step.abs(), f64::max(deepest, depth)))
    };
    let here = depth(station);
    if !(here > limits.end_share * limits.tunnel_below_m) {
        return false;
    }
    let ((before, a), (after, b)) = (side(-STEP_M), side(STEP_M));
    here.max(a).max(b) > limits.tunnel_below_m && before + after >= limits.least_length_m
}

/// The bridge on which a path passes over another one, as far as it may reach beyond the path's ends; none where the other is in a tunnel.
fn over_path<'a>(
    path: &Path,
    crossing: &Crossing,
    other: impl Fn(PathPlace) -> Option<(&'a Path, &'a Profile)>,
    profile: &Profile,
    ground: &Heightfield,
    limits: &StructureLimits,
) -> Option<Structure> {
    let [upper, lower] = crossing.upper_lower()?;
    if upper.path != path.id {
        return None;
    }
    let (below, below_profile) = other(lower)?;
    if is_in_tunnel(below, below_profile, lower.station_m, ground, limits) {
        return None;
    }
    let natural = ground.height(crossing.point);
    let (own, cross) = (path.plan.tangent_at(upper.station_m), below.plan.tangent_at(lower.station_m));
    // At a small angle it takes a long bridge, but not one without end.
    let sine = own.cross(cross).abs().max(0.17);
    let half = (0.5 * below.section.width_m() + 0.5 * path.section.width_m() * own.dot(cross).abs()) / sine + BESIDE_M;
    let most_m = profile.at(upper.station_m).height_m - natural;
    Some(Structure {
        carrier: Carrier::Bridge,
        from_m: upper.station_m - half,
        to_m: upper.station_m + half,
        most_m: most_m.max(0.0),
        over_water: false,
        over_path: true,
    })
}

impl Structure {
    /// As long as this and another one together.
    fn and(&mut self, other: &Self, turn: f64) {
        self.from_m = self.from_m.min(other.from_m + turn);
        self.to_m = self.to_m.max(other.to_m + turn);
        self.most_m = self.most_m.max(other.most_m);
        self.over_water |= other.over_water;
        self.over_path |= other.over_path;
    }
}

/// Those of one kind that overlap or nearly touch are one. On a closed path of the given length what leads over the seam is cut there.
fn united(mut found: Vec<Structure>, limits: &StructureLimits, closed: Option<f64>) -> Vec<Structure> {
    found.sort_by(|a, b| a.from_m.total_cmp(&b.from_m).then(a.to_m.total_cmp(&b.to_m)));
    let mut all = Vec::new();
    for carrier in [Carrier::Bridge, Carrier::Tunnel] {
        let mut kept: Vec<Structure> = Vec::new();
        for s in found.iter().filter(|s| s.carrier == carrier) {
            match kept.last_mut() {
                Some(last) if s.from_m - last.to_m <= limits.gap_m => last.and(s, 0.0),
                _ => kept.push(*s),
            }
        }
        let Some(length) = closed else {
            all.extend(kept);
            continue;
        };
        // The first follows the last.
        while kept.len() > 1 && kept[0].from_m + length - kept[kept.len() - 1].to_m <= limits.gap_m {
            let first = kept.remove(0);
            if let Some(last) = kept.last_mut() {
                last.and(&first, length);
            }
        }
        for s in kept {
            if s.to_m - s.from_m >= length {
                all.push(Structure { from_m: 0.0, to_m: length, ..s });
                continue;
            }
            all.push(Structure { to_m: s.to_m.min(length), ..s });
            all.extend((s.to_m > length).then_some(Structure { from_m: 0.0, to_m: s.to_m - length, ..s }));
        }
    }
    all
}

/// A bridge goes before a tunnel where both would be; of the tunnel stays what lies between bridges.
fn bridges_first(found: Vec<Structure>, limits: &StructureLimits, length: f64) -> Vec<Structure> {
    let (mut bridges, tunnels): (Vec<Structure>, Vec<Structure>) =
        found.into_iter().partition(|s| s.carrier == Carrier::Bridge);
    bridges.sort_by(|a, b| a.from_m.total_cmp(&b.from_m));
    let mut all = bridges.clone();
    for tunnel in tunnels {
        let mut from = tunnel.from_m;
        let in_the_way = bridges.iter().filter(|b| b.to_m > tunnel.from_m && b.from_m < tunnel.to_m);
        let ends: Vec<[f64; 2]> =
            in_the_way.map(|b| [b.from_m, b.to_m]).chain([[tunnel.to_m, f64::INFINITY]]).collect();
        for [until, on] in ends {
            // Cut off at the seam it goes on there, however short.
            let whole = [from, until] == [tunnel.from_m, tunnel.to_m];
            let at_seam = whole && (tunnel.from_m == 0.0 || tunnel.to_m == length);
            if until - from >= limits.least_length_m.min(length) || (at_seam && until > from) {
                all.push(Structure { from_m: from, to_m: until, ..tunnel });
            }
            from = from.max(on);
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
