//! Heights of those paths that are to be engineered: paths that hang together come in, with the heights that the others have; the profiles of least earthwork go out.

use super::contact::{Crossing, Meeting, Surveyed};
use super::elevation::separation_m;
use super::path::{HeightMode, Path, PathId};
use crate::engineered::{
    ClearanceAt, EarthworkSection, EngineeredError, EngineeredNetwork, EngineeredRoad, FixedPoint, GradeLimits,
    HeightBound, MeetAt, RoadPoint,
};
use crate::ground::{EarthworkOptions, Soils};
use crate::profile::Profile;
use crate::rules::DesignRules;
use crate::survey::{FREEBOARD_M, Step};
use crate::terrain::Waters;

/// Vertical curves begin and end at multiples of this length, m, or of a quarter of the path.
const KNOTS_M: f64 = 10.0;

/// What the heights of engineered paths depend on beside the paths.
pub(crate) struct Site<'a> {
    pub(crate) waters: &'a Waters,
    pub(crate) soils: &'a Soils,
    pub(crate) rules: &'a DesignRules,
    pub(crate) earthwork: &'a EarthworkOptions,
}

/// The profiles of those of the paths that are engineered. `others` are the profiles that the paths have without that, in the paths' order: those of paths that are not engineered are
/// kept to.
///
/// # Errors
/// When the limits contradict each other.
pub(crate) fn engineered(
    surveyed: &[Surveyed<'_>],
    others: &[Profile],
    crossings: &[Crossing],
    site: &Site<'_>,
) -> Result<Vec<Option<Profile>>, EngineeredError> {
    let paths: Vec<&Path> = surveyed.iter().map(|(path, _)| *path).collect();
    let mut number = vec![None; paths.len()];
    let mut roads = Vec::new();
    for (i, &(path, survey)) in surveyed.iter().enumerate() {
        if path.heights == HeightMode::Engineered {
            number[i] = Some(roads.len());
            roads.push(road((path, survey), site));
        }
    }
    let of = |id: PathId| paths.iter().position(|p| p.id == id);
    let (mut over, mut meet) = (Vec::new(), Vec::new());
    for crossing in crossings {
        let (Some(a), Some(b)) = (of(crossing.first.path), of(crossing.second.path)) else { continue };
        let (s, t) = (crossing.first.station_m, crossing.second.station_m);
        let separation = separation_m(&paths, crossing);
        let height = |i: usize, station: f64| others[i].at(station).height_m;
        match (number[a], number[b], crossing.meeting) {
            (None, None, _) => {}
            (Some(a), Some(b), meeting) => {
                let (first, second) = (RoadPoint { road: a, station_m: s }, RoadPoint { road: b, station_m: t });
                match meeting {
                    Meeting::Level => meet.push(MeetAt { a: first, b: second }),
                    Meeting::Over => over.push(ClearanceAt { upper: first, lower: second, clearance_m: separation }),
                    Meeting::Under => over.push(ClearanceAt { upper: second, lower: first, clearance_m: separation }),
                }
            }
            (Some(road), None, meeting) => held(&mut roads[road], s, height(b, t), meeting, separation),
            (None, Some(road), meeting) => held(&mut roads[road], t, height(a, s), meeting.turned(), separation),
        }
    }
    let mut found = EngineeredNetwork { roads, over, meet }.profiles()?.profiles.into_iter();
    Ok(number.into_iter().map(|n| n.and_then(|_| found.next())).collect())
}

/// A clearance over or under a path that is as it is holds this far beside the crossing, m.
const AROUND_M: f64 = 1.0;

/// A road that meets, or passes over or under, a path that is not engineered.
fn held(road: &mut EngineeredRoad, station_m: f64, height_m: f64, meeting: Meeting, separation_m: f64) {
    let at = station_m.clamp(0.0, road.length_m);
    let (from_m, to_m) = ((at - AROUND_M).max(0.0), (at + AROUND_M).min(road.length_m));
    let bound = |lowest_m, highest_m| HeightBound { from_m, to_m, lowest_m, highest_m };
    match meeting {
        Meeting::Level => road.fixed.push(FixedPoint { station_m: at, height_m, grade: None }),
        Meeting::Over => road.bounds.push(bound(Some(height_m + separation_m), None)),
        Meeting::Under => road.bounds.push(bound(None, Some(height_m - separation_m))),
    }
}

fn road((path, survey): Surveyed<'_>, site: &Site<'_>) -> EngineeredRoad {
    let length_m = path.length_m();
    let steps: Vec<(f64, &Step)> = survey.stationed().collect();
    let mut ground: Vec<[f64; 2]> = steps.iter().map(|(station, step)| [*station, step.natural_m]).collect();
    // Of a segment that is next to nothing, rounding leaves nothing.
    ground.dedup_by(|later, earlier| later[0] <= earlier[0]);
    let kmh = path.speed_limits().iter().map(|l| l.1).fold(0.0, f64::max);
    let rule = site.rules.at(kmh);
    let soil = site.soils.at(path.plan.point_at(0.5 * length_m));
    EngineeredRoad {
        name: path.name.clone(),
        length_m,
        knot_spacing_m: KNOTS_M.min(0.25 * length_m),
        closed: path.plan.is_closed(),
        limits: GradeLimits { max_grade: path.section.max_grade, crest_k_m: rule.k_crest, sag_k_m: rule.k_sag },
        section: EarthworkSection {
            platform_m: path.section.width_m() + 2.0 * site.earthwork.verge_m,
            slope_run: 0.5 * (soil.cut_run() + soil.fill_run()),
            cut_weight: 1.0,
            fill_weight: 1.0,
        },
        fixed: fixed_points(path),
        bounds: wet(path, &steps, site.waters),
        start_grade: None,
        end_grade: None,
        stretches: Vec::new(),
        ground,
    }
}

/// Two heights of one drawing nearer to each other than this leave no room for a vertical curve between them, m.
const FIXED_APART_M: f64 = 4.0 * KNOTS_M;

/// Of drawn heights the ends, and highest and lowest places between them; a later drawing counts before an earlier one that it covers.
fn fixed_points(path: &Path) -> Vec<FixedPoint> {
    let mut covered: Vec<[f64; 2]> = Vec::new();
    let mut fixed = Vec::new();
    for drawn in path.drawn.iter().rev() {
        let points = &drawn.points_m;
        let (Some(first), Some(last)) = (points.first(), points.last()) else { continue };
        let mut before = f64::NEG_INFINITY;
        for (i, &[station_m, height_m]) in points.iter().enumerate() {
            let is_end = i == 0 || i + 1 == points.len();
            let turns = !is_end && (points[i - 1][1] < height_m) == (points[i + 1][1] < height_m);
            let alone = station_m - before >= FIXED_APART_M && last[0] - station_m >= FIXED_APART_M;
            let hidden = covered.iter().any(|[a, b]| (*a..=*b).contains(&station_m));
            if !hidden && (is_end || (turns && alone)) {
                fixed.push(FixedPoint { station_m, height_m, grade: None });
                before = station_m;
            }
        }
        // Beside a later drawing there must be room for a vertical curve.
        covered.push([first[0] - FIXED_APART_M, last[0] + FIXED_APART_M]);
    }
    fixed
}

/// Over water a road keeps its freeboard.
fn wet(path: &Path, steps: &[(f64, &Step)], waters: &Waters) -> Vec<HeightBound> {
    let mut bounds: Vec<HeightBound> = Vec::new();
    let mut before = None;
    let end = steps.last().map_or(0.0, |step| step.0);
    for (station, step) in steps {
        let level = step.is_wet.then(|| waters.level_at(path.plan.point_at(*station))).flatten();
        match (bounds.last_mut(), level) {
            (Some(last), Some(_)) if level == before => last.to_m = (*station + AROUND_M).min(end),
            (_, Some(level)) => bounds.push(HeightBound {
                from_m: (*station - AROUND_M).max(0.0),
                to_m: (*station + AROUND_M).min(end),
                lowest_m: Some(level + FREEBOARD_M),
                highest_m: None,
            }),
            _ => {}
        }
        before = level;
    }
    bounds
}
