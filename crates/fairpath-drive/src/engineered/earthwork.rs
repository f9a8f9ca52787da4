//! The earth that a road moves: its profile and its ground come in, volumes go out, exact but for rounding.

use super::network::EngineeredRoad;
use super::solve::Earthwork;
use super::spline::Ground;
use crate::profile::Profile;

/// The rule of Gauss with three places, exact for polynomials up to the fifth degree; the area is one of the fourth. Places and weights on −1 to 1.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// The volumes that a road with this profile moves, each cubic metre times the weight of its stretch.
pub(super) fn earthwork(road: &EngineeredRoad, profile: &Profile) -> Earthwork {
    let ground = Ground(&road.ground);
    let mut sum = Earthwork { cut_m3: 0.0, fill_m3: 0.0, counted: 0.0 };
    for pair in profile.knots().windows(2) {
        let range = [pair[0].station_m, pair[1].station_m];
        let mut breaks: Vec<f64> = ground.breaks(range).collect();
        breaks.extend(stretch_ends(road, range));
        breaks.sort_by(f64::total_cmp);
        for part in breaks.windows(2) {
            let weight = weight_at(road, 0.5 * (part[0] + part[1]));
            if part[0] < part[1] && weight > 0.0 {
                add(&mut sum, road, profile, [part[0], part[1]], weight);
            }
        }
    }
    sum.counted = sum.cut_m3 * road.section.cut_weight + sum.fill_m3 * road.section.fill_weight;
    sum
}

/// Where stretches begin or end between two stations.
pub(super) fn stretch_ends(road: &EngineeredRoad, [from_m, to_m]: [f64; 2]) -> impl Iterator<Item = f64> {
    let ends = road.stretches.iter().flat_map(|stretch| [stretch.from_m, stretch.to_m]);
    ends.filter(move |end| *end > from_m && *end < to_m)
}

/// What earthwork counts at a station.
pub(super) fn weight_at(road: &EngineeredRoad, station_m: f64) -> f64 {
    let here = road.stretches.iter().filter(|s| s.from_m <= station_m && station_m <= s.to_m);
    here.map(|stretch| stretch.weight).product()
}

/// Adds a part along which the profile is one parabola and the ground straight.
fn add(sum: &mut Earthwork, road: &EngineeredRoad, profile: &Profile, [from, to]: [f64; 2], weight: f64) {
    let ground = Ground(&road.ground);
    let height = |station: f64| profile.at(station).height_m - ground.height(station);
    let length = to - from;
    // The parabola of the height over the ground through both ends and the middle: a + b u + c u² for u from 0 to 1.
    let (begin, middle, end) = (height(from), height(0.5 * (from + to)), height(to));
    let (a, b, c) = (begin, 4.0 * middle - 3.0 * begin - end, 2.0 * (begin + end - 2.0 * middle));
    let mut cuts = vec![0.0, 1.0];
    cuts.extend(roots(a, b, c).into_iter().flatten().filter(|u| *u > 0.0 && *u < 1.0));
    cuts.sort_by(f64::total_cmp);
    for pair in cuts.windows(2) {
        let (centre, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        let rise = |u: f64| a + u * (b + u * c);
        let area = |d: f64| d.abs() * (road.section.platform_m + road.section.slope_run * d.abs());
        let volume: f64 = GAUSS.iter().map(|(place, w)| w * area(rise(centre + half * place))).sum();
        let volume = weight * length * half * volume;
        if rise(centre) > 0.0 {
            sum.fill_m3 += volume;
        } else {
            sum.cut_m3 += volume;
        }
    }
}

/// Where a + b u + c u² is nothing.
fn roots(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    let square = b * b - 4.0 * a * c;
    if square < 0.0 {
        return [None, None];
    }
    // Of the two ways to each root the one that does not cancel.
    let q = -0.5 * (b + square.sqrt().copysign(b));
    let root = |over: f64, under: f64| (under != 0.0).then(|| over / under);
    [root(q, c), root(a, q)]
}
