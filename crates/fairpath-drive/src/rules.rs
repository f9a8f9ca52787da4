//! Checks of a design: rules as data and a path with its profile come in, each breach goes out with its place, what stands there and what is allowed.

use crate::network::{Crossing, Path, PathId, separation_m};
use crate::profile::Profile;
use crate::range::{OutOfRange, within};
use fairpath_curve::{Kind, Segment};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What holds at one design speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpeedRule {
    /// The speed, km/h.
    pub kmh: f64,
    /// The share of its weight by which a vehicle may be pushed aside: side friction.
    pub side_friction: f64,
    /// Least length of a crest for each percent by which the grade changes, m: to see what lies on the road in time to stop.
    pub k_crest: f64,
    /// The same of a sag, where headlights must reach as far.
    pub k_sag: f64,
}

/// Rules of design. The defaults are those of AASHTO's *A Policy on Geometric Design of Highways and Streets* (2011) as they are commonly quoted: side friction of table 3-7, K of
/// tables 3-34 and 3-36, the superelevation of 8 %, and the length of spirals of section 3.3.8.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DesignRules {
    /// Rules by ascending speed; between two, values are interpolated.
    pub speeds: Vec<SpeedRule>,
    /// The steepest superelevation, rise across for a metre.
    pub max_superelevation: f64,
    /// How fast sideways acceleration may grow along a spiral, m/s³.
    pub max_jerk_m_s3: f64,
}

impl Default for DesignRules {
    fn default() -> Self {
        let rule = |kmh, side_friction, k_crest, k_sag| SpeedRule { kmh, side_friction, k_crest, k_sag };
        Self {
            speeds: vec![
                rule(20.0, 0.35, 1.0, 3.0),
                rule(30.0, 0.28, 2.0, 6.0),
                rule(40.0, 0.23, 4.0, 9.0),
                rule(50.0, 0.19, 7.0, 13.0),
                rule(60.0, 0.17, 11.0, 18.0),
                rule(70.0, 0.15, 17.0, 23.0),
                rule(80.0, 0.14, 26.0, 30.0),
                rule(90.0, 0.13, 39.0, 38.0),
                rule(100.0, 0.12, 52.0, 45.0),
                rule(110.0, 0.11, 74.0, 55.0),
                rule(120.0, 0.09, 95.0, 63.0),
                rule(130.0, 0.08, 124.0, 73.0),
            ],
            max_superelevation: 0.08,
            max_jerk_m_s3: 1.2,
        }
    }
}

/// What a breach is a breach of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// Least radius for the speed, m.
    Radius,
    /// Superelevation that the speed would need, rise across for a metre.
    Superelevation,
    /// Least parameter of a clothoid, √(radius × length), for the speed, m.
    ClothoidParameter,
    /// Steepest grade, rise for a metre.
    Grade,
    /// K of a crest, m for each percent.
    CrestK,
    /// K of a sag, m for each percent.
    SagK,
    /// Free height between paths that cross, m.
    Clearance,
}

impl Rule {
    /// Its name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Radius => "radius",
            Self::Superelevation => "superelevation",
            Self::ClothoidParameter => "clothoid parameter",
            Self::Grade => "grade",
            Self::CrestK => "crest K",
            Self::SagK => "sag K",
            Self::Clearance => "clearance",
        }
    }

    /// The unit of its values.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Radius | Self::ClothoidParameter | Self::Clearance => "m",
            Self::Superelevation | Self::Grade => "m/m",
            Self::CrestK | Self::SagK => "m/%",
        }
    }

    /// Whether more is better.
    #[must_use]
    pub fn is_least(self) -> bool {
        !matches!(self, Self::Grade | Self::Superelevation)
    }
}

/// A place where a design breaks a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breach {
    /// On which path.
    pub path: PathId,
    /// Where it is worst, arc length, m.
    pub station_m: f64,
    /// The stretch on which the rule is broken, m.
    pub range_m: [f64; 2],
    /// Which rule.
    pub rule: Rule,
    /// What stands there.
    pub value: f64,
    /// What is allowed.
    pub limit: f64,
}

impl DesignRules {
    /// Checks every number against its range.
    ///
    /// # Errors
    /// Names the first that is out of it.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        within("max_superelevation", self.max_superelevation, 0.0, 0.5, "0 to 0.5")?;
        within("max_jerk_m_s3", self.max_jerk_m_s3, 0.01, 100.0, "0.01 to 100 m/s³")?;
        within("speeds", self.speeds.len() as f64, 1.0, 1000.0, "1 to 1000 rules")?;
        let mut before = 0.0;
        for rule in &self.speeds {
            within("speeds.kmh", rule.kmh, before, 500.0, "ascending speeds up to 500 km/h")?;
            within("speeds.side_friction", rule.side_friction, 0.01, 2.0, "0.01 to 2")?;
            within("speeds.k_crest", rule.k_crest, 0.0, 1e4, "0 to 10000")?;
            within("speeds.k_sag", rule.k_sag, 0.0, 1e4, "0 to 10000")?;
            before = rule.kmh;
        }
        Ok(())
    }

    /// What holds at a speed: between two rules in proportion, beyond the table its end.
    #[must_use]
    pub fn at(&self, kmh: f64) -> SpeedRule {
        let i = self.speeds.partition_point(|r| r.kmh < kmh);
        let (Some(a), Some(b)) = (self.speeds.get(i.saturating_sub(1)), self.speeds.get(i).or(self.speeds.last()))
        else {
            return SpeedRule { kmh, side_friction: 0.15, k_crest: 0.0, k_sag: 0.0 };
        };
        let t = if b.kmh > a.kmh { ((kmh - a.kmh) / (b.kmh - a.kmh)).clamp(0.0, 1.0) } else { 0.0 };
        let lerp = |x: f64, y: f64| x + t * (y - x);
        SpeedRule {
            kmh,
            side_friction: lerp(a.side_friction, b.side_friction),
            k_crest: lerp(a.k_crest, b.k_crest),
            k_sag: lerp(a.k_sag, b.k_sag),
        }
    }

    /// The least radius at a speed, m: V² / 127 (e + f) with V in km/h.
    #[must_use]
    pub fn min_radius_m(&self, kmh: f64) -> f64 {
        kmh * kmh / (127.0 * (self.max_superelevation + self.at(kmh).side_friction))
    }

    /// The superelevation that a speed needs on a radius beside side friction; 0 where friction does alone.
    #[must_use]
    pub fn superelevation(&self, kmh: f64, radius_m: f64) -> f64 {
        (kmh * kmh / (127.0 * radius_m) - self.at(kmh).side_friction).max(0.0)
    }

    /// The highest speed on a radius, km/h: what [`min_radius_m`](Self::min_radius_m) allows, by halving.
    #[must_use]
    pub fn speed_on_kmh(&self, radius_m: f64) -> f64 {
        let (mut low, mut high) = (1.0, 500.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.min_radius_m(middle) <= radius_m { low = middle } else { high = middle }
        }
        low
    }

    /// The least parameter of a clothoid at a speed, m: A² = v³ / C, from the growth of v² κ along it.
    #[must_use]
    pub fn min_clothoid_m(&self, kmh: f64) -> f64 {
        let v = kmh / 3.6;
        (v * v * v / self.max_jerk_m_s3).sqrt()
    }

    /// All breaches on a path with this profile, by station.
    #[must_use]
    pub fn breaches(&self, path: &Path, profile: &Profile) -> Vec<Breach> {
        let mut found = Vec::new();
        self.plan_breaches(path, &mut found);
        self.profile_breaches(path, profile, &mut found);
        found.sort_by(|a, b| a.rule.cmp(&b.rule).then(a.range_m[0].total_cmp(&b.range_m[0])));
        let mut united: Vec<Breach> = Vec::new();
        for breach in found {
            match united.last_mut() {
                Some(last) if last.rule == breach.rule && breach.range_m[0] <= last.range_m[1] + SAME_M => {
                    if worse(&breach, last) {
                        (last.station_m, last.value, last.limit) = (breach.station_m, breach.value, breach.limit);
                    }
                    last.range_m[1] = last.range_m[1].max(breach.range_m[1]);
                }
                _ => united.push(breach),
            }
        }
        united.sort_by(|a, b| a.station_m.total_cmp(&b.station_m).then(a.rule.cmp(&b.rule)));
        united
    }

    fn plan_breaches(&self, path: &Path, found: &mut Vec<Breach>) {
        let limits = path.speed_limits();
        let mut begin = 0.0;
        for segment in path.plan.segments() {
            let end = begin + segment.length;
            // Each stretch of the segment on which one speed holds.
            for (i, &(from, kmh)) in limits.iter().enumerate() {
                let until = limits.get(i + 1).map_or(f64::INFINITY, |l| l.0);
                let range_m = [from.max(begin), until.min(end)];
                if range_m[0] < range_m[1] {
                    self.stretch_breaches(path.id, segment, begin, range_m, kmh, found);
                }
            }
            begin = end;
        }
    }

    /// Breaches on a stretch of a segment, which begins at the station `begin`.
    fn stretch_breaches(
        &self,
        path: PathId,
        segment: &Segment,
        begin: f64,
        range_m: [f64; 2],
        kmh: f64,
        found: &mut Vec<Breach>,
    ) {
        // Along a clothoid curvature is most at one of the ends.
        let [a, b] = range_m.map(|s| segment.curvature_at(s - begin).abs());
        let (station_m, kappa) = if a >= b { (range_m[0], a) } else { (range_m[1], b) };
        let radius = 1.0 / kappa;
        let breach = |rule, value, limit| Breach { path, station_m, range_m, rule, value, limit };
        let least = self.min_radius_m(kmh);
        if radius < least * (1.0 - TOLERANCE) {
            found.push(breach(Rule::Radius, radius, least));
            found.push(breach(Rule::Superelevation, self.superelevation(kmh, radius), self.max_superelevation));
        }
        // Where a clothoid does not turn noticeably, nobody feels how fast it does.
        if segment.kind() == Kind::Clothoid && radius < FELT * least {
            let least = self.min_clothoid_m(kmh);
            let parameter = segment.clothoid_parameter();
            if parameter < least * (1.0 - TOLERANCE) {
                found.push(breach(Rule::ClothoidParameter, parameter, least));
            }
        }
    }

    fn profile_breaches(&self, path: &Path, profile: &Profile, found: &mut Vec<Breach>) {
        for pair in profile.knots().windows(2) {
            let range = [pair[0].station_m, pair[1].station_m];
            let (station_m, grade) = profile.steepest(range);
            let breach =
                |station_m, rule, value, limit| Breach { path: path.id, station_m, range_m: range, rule, value, limit };
            if grade.abs() > path.section.max_grade * (1.0 + TOLERANCE) {
                found.push(breach(station_m, Rule::Grade, grade.abs(), path.section.max_grade));
            }
            // The bend changes linearly between two knots: it is most at one of them. Just inside the piece, since it may jump at a knot.
            let hair = 1e-9 * (range[1] - range[0]);
            for station_m in [range[0] + hair, range[1] - hair] {
                let bend = profile.at(station_m).bend_per_m;
                let rule = self.at(path.speed_limit_kmh(station_m));
                let k = 0.01 / bend.abs();
                let (which, least) = if bend < 0.0 { (Rule::CrestK, rule.k_crest) } else { (Rule::SagK, rule.k_sag) };
                if k < least * (1.0 - TOLERANCE) {
                    found.push(breach(station_m, which, k, least));
                }
            }
        }
    }

    /// Breaches of clearance where paths cross; `path_of` gives a path with its profile.
    #[must_use]
    pub fn clearance_breaches<'a>(
        &self,
        crossings: &[Crossing],
        path_of: impl Fn(PathId) -> Option<(&'a Path, &'a Profile)>,
    ) -> Vec<Breach> {
        let mut found = Vec::new();
        for crossing in crossings {
            let Some([upper, lower]) = crossing.upper_lower() else { continue };
            let (Some((a, za)), Some((b, zb))) = (path_of(upper.path), path_of(lower.path)) else { continue };
            let free = za.at(upper.station_m).height_m - zb.at(lower.station_m).height_m - a.section.thickness_m;
            let limit = separation_m(&[a, b], crossing) - a.section.thickness_m;
            if free < limit - CLEARANCE_TOLERANCE_M {
                let station_m = upper.station_m;
                let range_m = [station_m; 2];
                found.push(Breach { path: a.id, station_m, range_m, rule: Rule::Clearance, value: free, limit });
            }
        }
        found
    }
}

/// Sideways acceleration is felt on radii up to so many times the least one.
const FELT: f64 = 4.0;

/// Values this near to a limit, as a share of it, keep to it.
const TOLERANCE: f64 = 1e-6;

/// A clearance that lacks no more than this is kept, m.
const CLEARANCE_TOLERANCE_M: f64 = 1e-4;

/// Stretches of one breach that lie no further apart are one, m.
const SAME_M: f64 = 1.0;

fn worse(a: &Breach, b: &Breach) -> bool {
    let excess = |x: &Breach| if x.rule.is_least() { x.limit / x.value } else { x.value / x.limit };
    excess(a) > excess(b)
}
