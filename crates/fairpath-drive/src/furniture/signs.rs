//! Signs by rule from geometry (section 3.6.2 of the thesis): a path with its profile, its intersections and its speeds come in, signs go out.

use crate::network::{Arm, Junction, Path, PathId};
use crate::profile::Profile;
use crate::rules::DesignRules;
use crate::section::{Lane, LaneKind, Section};
use fairpath_curve::{Kind, Point, Vec2, trig};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a sign says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SignKind {
    /// Stop here.
    Stop,
    /// A stop comes.
    StopAhead,
    /// A sharp bend to the left comes.
    SharpLeft,
    /// A sharp bend to the right comes.
    SharpRight,
    /// A crest comes over which one cannot see.
    Bump,
    /// A hollow comes.
    Dip,
    /// This speed, km/h.
    SpeedLimit(u16),
}

/// A sign beside a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sign {
    /// What it says.
    pub kind: SignKind,
    /// Beside which path.
    pub path: PathId,
    /// Where, arc length, m.
    pub station_m: f64,
    /// Whether it is for those who drive towards the path's end.
    pub forward: bool,
}

/// From the edge of what is laid to a sign, m.
const BESIDE_M: f64 = 0.7;

impl Sign {
    /// How far to the left of the path's middle it stands, m: on the right of those whom it is for.
    #[must_use]
    pub fn to_left_m(&self, section: &Section) -> f64 {
        let [left, right] = section.half_widths_m();
        if self.forward { -(right + BESIDE_M) } else { left + BESIDE_M }
    }

    /// Where it stands, m, and the heading of those whom it is for, radians; `path` is its path.
    #[must_use]
    pub fn stands(&self, path: &Path) -> (Point, f64) {
        let pose = path.plan.pose_at(self.station_m);
        let tangent = trig::unit(pose.heading);
        let place = pose.point + Vec2::new(-tangent.y, tangent.x) * self.to_left_m(&path.section);
        (place, if self.forward { pose.heading } else { trig::wrap_angle(pose.heading + std::f64::consts::PI) })
    }
}

/// From a sign to what it warns of, m for each km/h: about what it takes to react and to brake gently.
const AHEAD_M_PER_KMH: f64 = 1.2;

/// A bend is sharp where the speed that suits it is below the one that holds by more than this, km/h.
const SHARP_KMH: f64 = 15.0;

/// A crest or hollow deserves a sign where its K is below this share of the least one.
const STEEP_SHARE: f64 = 0.5;

/// And where the grade changes by no less than this.
const LEAST_CHANGE: f64 = 0.04;

/// The signs of a path.
pub(crate) fn signs(
    path: &Path,
    profile: &Profile,
    junctions: &[&Junction],
    stops: &[Arm],
    rules: &DesignRules,
) -> Vec<Sign> {
    if !path.section.is_road() {
        return Vec::new();
    }
    let mut found = Vec::new();
    let length = path.length_m();
    let drives = |lanes: &[Lane]| lanes.iter().any(|lane| lane.kind == LaneKind::Driving);
    let both = [(true, drives(&path.section.right)), (false, drives(&path.section.left))];
    let directions: Vec<bool> = both.into_iter().filter(|d| d.1).map(|d| d.0).collect();
    let mut add = |kind, station_m: f64, forward| {
        if directions.contains(&forward) {
            found.push(Sign { kind, path: path.id, station_m, forward });
        }
    };
    for arm in stops.iter().filter(|arm| arm.path == path.id) {
        // Those who come in drive against the arm's direction.
        let forward = !arm.forward;
        add(SignKind::Stop, arm.station_m, forward);
        if let Some(station) = before(path, arm.station_m, forward) {
            add(SignKind::StopAhead, station, forward);
        }
    }
    for bend in sharp_bends(path, rules) {
        for forward in [true, false] {
            let at = if forward { bend.from_m } else { bend.to_m };
            let left = bend.left == forward;
            if let Some(station) = before(path, at, forward) {
                add(if left { SignKind::SharpLeft } else { SignKind::SharpRight }, station, forward);
            }
        }
    }
    for (from_m, to_m, crest) in steep_changes(path, profile, rules) {
        for forward in [true, false] {
            let at = if forward { from_m } else { to_m };
            if let Some(station) = before(path, at, forward) {
                add(if crest { SignKind::Bump } else { SignKind::Dip }, station, forward);
            }
        }
    }
    let limits = path.speed_limits();
    let set = !path.speeds.is_empty();
    for (i, (from_m, kmh)) in limits.iter().enumerate().filter(|_| set) {
        let until = limits.get(i + 1).map_or(length, |l| l.0);
        let posted = SignKind::SpeedLimit(kmh.round() as u16);
        add(posted, *from_m, true);
        add(posted, until, false);
    }
    // Nobody needs signs in the middle of an intersection, be it at the seam of a closed path.
    let turns = if path.plan.is_closed() { &[-1.0, 0.0, 1.0][..] } else { &[0.0][..] };
    let within = |s: &Sign| {
        let spans = junctions.iter().flat_map(|j| &j.spans).filter(|(id, _)| *id == s.path);
        let is_in = |[a, b]: [f64; 2], station: f64| station > a + INSIDE_M && station < b - INSIDE_M;
        spans.into_iter().any(|(_, span)| turns.iter().any(|turn| is_in(*span, s.station_m + turn * length)))
    };
    found.retain(|s| s.kind == SignKind::Stop || !within(s));
    let by_station = |a: &Sign, b: &Sign| a.station_m.total_cmp(&b.station_m);
    found.sort_by(|a, b| (a.kind, a.forward).cmp(&(b.kind, b.forward)).then(by_station(a, b)));
    found.dedup_by(|b, a| (a.kind, a.forward) == (b.kind, b.forward) && b.station_m - a.station_m < NEAR_M);
    found.sort_by(|a, b| by_station(a, b).then((a.kind, a.forward).cmp(&(b.kind, b.forward))));
    found
}

/// A sign at the very border of an intersection is not in its middle, m.
const INSIDE_M: f64 = 0.5;

/// Of equal signs nearer to each other than this one is enough, m.
const NEAR_M: f64 = 40.0;

/// The station of a warning of what lies at another one; none where the path does not begin so far before it.
fn before(path: &Path, at: f64, forward: bool) -> Option<f64> {
    let ahead = AHEAD_M_PER_KMH * path.speed_limit_kmh(at);
    let station = if forward { at - ahead } else { at + ahead };
    let length = path.length_m();
    if path.plan.is_closed() {
        return Some(station.rem_euclid(length));
    }
    (0.0..=length).contains(&station).then_some(station)
}

struct Bend {
    from_m: f64,
    to_m: f64,
    left: bool,
}

/// Bends that are driven more slowly than the speed that holds.
fn sharp_bends(path: &Path, rules: &DesignRules) -> Vec<Bend> {
    let mut bends: Vec<Bend> = Vec::new();
    let mut from_m = 0.0;
    for segment in path.plan.segments() {
        let to_m = from_m + segment.length;
        let kappa = if segment.kappa0.abs() >= segment.kappa1.abs() { segment.kappa0 } else { segment.kappa1 };
        if segment.kind() != Kind::Line {
            let slow = rules.speed_on_kmh(1.0 / kappa.abs()) + SHARP_KMH < path.speed_limit_kmh(0.5 * (from_m + to_m));
            let left = kappa > 0.0;
            match bends.last_mut() {
                Some(last) if slow && last.left == left && from_m - last.to_m < 1.0 => last.to_m = to_m,
                _ if slow => bends.push(Bend { from_m, to_m, left }),
                _ => {}
            }
        }
        from_m = to_m;
    }
    bends
}

/// Crests and hollows that are too short for the speed: from, to and whether it is a crest.
fn steep_changes(path: &Path, profile: &Profile, rules: &DesignRules) -> Vec<(f64, f64, bool)> {
    let mut found: Vec<(f64, f64, bool)> = Vec::new();
    for pair in profile.knots().windows(2) {
        let middle = 0.5 * (pair[0].station_m + pair[1].station_m);
        let bend = profile.at(middle).bend_per_m;
        let rule = rules.at(path.speed_limit_kmh(middle));
        let crest = bend < 0.0;
        let least = if crest { rule.k_crest } else { rule.k_sag };
        if 0.01 / bend.abs() >= STEEP_SHARE * least {
            continue;
        }
        match found.last_mut() {
            Some(last) if last.2 == crest && pair[0].station_m - last.1 < 1e-6 => last.1 = pair[1].station_m,
            _ => found.push((pair[0].station_m, pair[1].station_m, crest)),
        }
    }
    let change = |(a, b, _): &(f64, f64, bool)| (profile.at(*b).grade - profile.at(*a).grade).abs();
    found.retain(|f| change(f) >= LEAST_CHANGE);
    found
}

/// The arms of an intersection at which traffic has to stop: those of roads that end there while others go through; else those of the roads of lower speed, then of
/// lesser width, then those that were drawn later.
pub(crate) fn stopping_arms<'a>(junction: &Junction, path_of: impl Fn(PathId) -> Option<&'a Path>) -> Vec<Arm> {
    let through = |id: PathId| junction.arms.iter().filter(|arm| arm.path == id).count() > 1;
    let rank = |arm: &Arm| {
        let path = path_of(arm.path);
        let station = arm.station_m;
        let (kmh, width) = path.map_or((0.0, 0.0), |p| (p.speed_limit_kmh(station), p.section.width_m()));
        (through(arm.path), kmh, width, std::cmp::Reverse(arm.path))
    };
    let key = |arm: &Arm| rank(arm);
    // A road that merely goes on in another one stops nobody.
    if junction.arms.len() < 3 {
        return Vec::new();
    }
    let first = junction.arms.iter().max_by(|a, b| {
        let (x, y) = (key(a), key(b));
        x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)).then(x.2.total_cmp(&y.2)).then(x.3.cmp(&y.3))
    });
    let Some(main) = first.map(|arm| arm.path) else { return Vec::new() };
    junction.arms.iter().filter(|arm| arm.path != main).copied().collect()
}
