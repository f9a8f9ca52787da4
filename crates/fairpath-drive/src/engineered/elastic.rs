//! Limits that contradict each other come in, which of them must give and because of what goes out.
//!
//! First grades and bends may be exceeded, each by a share of its limit, and the sum of shares times lengths is made least, while what is asked besides holds. Where
//! that has no solution, what is asked is contradictory by itself: then it alone gives, in metres, and grades and bends are free. A sum of amounts, not of squares,
//! makes few limits give; a hundredth of the squares is added so that a shortage is spread evenly over where it may be anyway.

use super::demand::{Asked, Demand, Sense};
use super::error::EngineeredError;
use super::program::{Cost, End, Outcome, Program};
use super::shortfall::{Shortfall, ShortfallKind};
use super::solve::{PULL, Part, greatest_bend, shifted};
use crate::profile::Profile;

/// The part of squares in what is made least.
const SQUARES: f64 = 0.01;

/// A limit gives if it is exceeded by more than this share of itself, or of a metre.
const EXCEEDED: f64 = 1e-7;

/// A demand is a reason if it presses with more than this share of what the strongest one presses with.
const PRESSES: f64 = 1e-4;

/// What would have to give.
///
/// # Errors
/// When nothing has to, or the solver does not get so far: then there is no answer either way.
pub(super) fn shortfalls(part: &Part<'_>, status: &str) -> Result<Vec<Shortfall>, EngineeredError> {
    let (program, rows) = design_gives(part);
    let outcome = program.solve();
    let found = match outcome.end {
        End::Solved => {
            let presses = pressure(part, &outcome, &rows);
            let profiles = part.profiles(&outcome.x)?;
            profiles.iter().flat_map(|(road, profile)| exceeded(part, *road, profile, &presses)).collect()
        }
        End::Infeasible | End::Unsettled => {
            let (program, rows, slacks) = demands_give(part);
            let outcome = program.solve();
            let presses = pressure(part, &outcome, &rows);
            if outcome.end == End::Solved { contradictory(part, &outcome, &slacks, &presses) } else { Vec::new() }
        }
    };
    if found.is_empty() {
        let status = format!("{status}, then {}", outcome.status);
        return Err(EngineeredError::Unsettled { roads: part.roads.clone(), status });
    }
    Ok(found)
}

/// For each demand its rows, among those of its sense.
type Rows = Vec<Vec<usize>>;

/// The program in which grades and bends give.
fn design_gives(part: &Part<'_>) -> (Program, Rows) {
    let mut program = Program::default();
    program.unknowns(part.base.len());
    // Where nothing else tells how high a road is; too little to make any limit give.
    (0..part.base.len()).for_each(|i| program.square(&[(i, 1.0)], 0.0, PULL));
    for (_, road, layout, first) in part.each() {
        let h = layout.step_m;
        // Each side in shares of its own limit, so that all costs are of one size.
        let mut soft = |terms: &[(usize, f64)], [least, most]: [f64; 2]| {
            let exceeded = Cost { linear: h, square: SQUARES * h };
            let mut side = |limit: f64, above: Cost, below: Cost| {
                let unit = 1.0 / limit.abs();
                let sum = program.sum(terms.iter().map(|&(i, factor)| (i, factor * unit)));
                program.costs(sum, (limit - part.on_ground(terms)) * unit, above, below);
            };
            side(most, exceeded, Cost::default());
            side(least, Cost::default(), exceeded);
        };
        let most = h * road.limits.max_grade;
        for knot in 0..layout.knots() {
            soft(&layout.rise(knot).map(|(i, factor)| (first + i, factor)), [-most, most]);
        }
        let [crest, sag] = [road.limits.crest_k_m, road.limits.sag_k_m].map(|k| h * h * greatest_bend(k));
        for interval in 0..layout.count {
            soft(&shifted(layout.bend(interval), first), [-crest, sag]);
        }
    }
    let rows = part.asked.iter().map(|asked| asked_rows(part, &mut program, asked, None)).collect();
    (program, rows)
}

/// The program in which what is asked gives, with the unknowns by how much: above and below.
fn demands_give(part: &Part<'_>) -> (Program, Rows, Vec<[usize; 2]>) {
    let mut program = Program::default();
    program.unknowns(part.base.len());
    (0..part.base.len()).for_each(|i| program.square(&[(i, 1.0)], 0.0, PULL));
    for (_, _, layout, first) in part.each() {
        for interval in 0..layout.count {
            let bend = shifted(layout.bend(interval), first);
            program.square(&bend, part.on_ground(&bend), PULL);
        }
    }
    let (mut rows, mut slacks) = (Vec::new(), Vec::new());
    for asked in &part.asked {
        let first = program.unknowns(2);
        let slack = [first, first + 1];
        for unknown in slack {
            let sum = program.sum([(unknown, 1.0)]);
            program.at_least(sum, 0.0);
            program.cost(unknown, 1.0);
            program.square(&[(unknown, 1.0)], 0.0, SQUARES);
        }
        rows.push(asked_rows(part, &mut program, asked, Some(slack)));
        slacks.push(slack);
    }
    (program, rows, slacks)
}

/// Puts in the rows of what is asked, which may give by slacks that are added and taken away.
fn asked_rows(part: &Part<'_>, program: &mut Program, asked: &Asked, slack: Option<[usize; 2]>) -> Vec<usize> {
    let row = |terms: &Vec<(usize, f64)>| {
        let value = asked.value - part.on_ground(terms);
        let gives = slack.into_iter().flat_map(|[more, less]| [(more, 1.0), (less, -1.0)]);
        let terms: Vec<(usize, f64)> = terms.iter().copied().chain(gives).collect();
        match asked.sense {
            Sense::Equal => program.equal(terms, value),
            Sense::AtLeast => {
                let sum = program.sum(terms);
                program.at_least(sum, value)
            }
        }
    };
    asked.rows.iter().map(row).collect()
}

/// How hard each demand presses; 0 for those that do not, but for rounding.
fn pressure(part: &Part<'_>, outcome: &Outcome, rows: &Rows) -> Vec<f64> {
    let mut presses: Vec<f64> = (part.asked.iter().zip(rows))
        .map(|(asked, rows)| {
            let prices = if asked.sense == Sense::Equal { &outcome.of_equations } else { &outcome.of_rows };
            let sum: f64 = rows.iter().map(|&row| prices[row].abs()).sum();
            // A grade turns a road around a point; over one interval that moves it by the interval's length.
            if asked.of_grade { sum / part.layouts[asked.demand.place().road].step_m } else { sum }
        })
        .collect();
    let least = PRESSES * presses.iter().copied().fold(0.0, f64::max);
    presses.iter_mut().filter(|press| **press <= least).for_each(|press| *press = 0.0);
    presses
}

/// A stretch on which something is exceeded.
struct Run {
    from_m: f64,
    to_m: f64,
    most: f64,
}

/// The grades and bends of a road that are exceeded.
fn exceeded(part: &Part<'_>, road: usize, profile: &Profile, presses: &[f64]) -> Vec<Shortfall> {
    let limits = part.network.roads[road].limits;
    let whole = &part.network.roads[road];
    let around = whole.closed.then_some(whole.length_m);
    let on_road =
        |station: f64| around.map_or(station, |length| if station > length { station - length } else { station });
    let shortfall = |kind: ShortfallKind, run: &Run, needed: f64, limit: f64| Shortfall {
        kind,
        road,
        road_name: whole.name.clone(),
        from_m: run.from_m,
        to_m: on_road(run.to_m),
        needed,
        limit,
        because: reasons(part, road, run, presses),
    };
    let mut found = Vec::new();
    for sign in [1.0, -1.0] {
        for run in runs(profile, limits.max_grade, around, |[a, b]| [sign * a.grade, sign * b.grade]) {
            found.push(shortfall(ShortfallKind::Grade, &run, run.most, limits.max_grade));
        }
    }
    let curves = [(ShortfallKind::CrestK, -1.0, limits.crest_k_m), (ShortfallKind::SagK, 1.0, limits.sag_k_m)];
    for (kind, sign, k) in curves {
        let bend = |[a, b]: [crate::Knot; 2]| [sign * (b.grade - a.grade) / (b.station_m - a.station_m); 2];
        for run in runs(profile, greatest_bend(k), around, bend) {
            found.push(shortfall(kind.clone(), &run, 1.0 / (100.0 * run.most), k));
        }
    }
    found
}

/// Where something that is linear between knots is beyond a limit; around a road of the length that is given if it is closed, what leads over its seam is one stretch that
/// ends beyond its length.
fn runs(
    profile: &Profile,
    limit: f64,
    around: Option<f64>,
    at_ends: impl Fn([crate::Knot; 2]) -> [f64; 2],
) -> Vec<Run> {
    let limit = limit * (1.0 + EXCEEDED);
    let mut runs: Vec<Run> = Vec::new();
    for pair in profile.knots().windows(2) {
        let [a, b] = at_ends([pair[0], pair[1]]);
        if !(a.max(b) > limit) {
            continue;
        }
        let at = |share: f64| pair[0].station_m + share * (pair[1].station_m - pair[0].station_m);
        let crossing = (limit - a) / (b - a);
        let from_m = if a > limit { at(0.0) } else { at(crossing) };
        let to_m = if b > limit { pair[1].station_m } else { at(crossing) };
        match runs.last_mut().filter(|run| run.to_m >= from_m) {
            Some(run) => (run.to_m, run.most) = (to_m, run.most.max(a).max(b)),
            None => runs.push(Run { from_m, to_m, most: a.max(b) }),
        }
    }
    if let (Some(length), [first, .., last]) = (around, &mut runs[..])
        && first.from_m <= 0.0
        && last.to_m >= length
    {
        (last.to_m, last.most) = (length + first.to_m, last.most.max(first.most));
        runs.remove(0);
    }
    runs
}

/// What presses on a stretch: what lies on it, and the nearest on both sides; the strongest first.
fn reasons(part: &Part<'_>, road: usize, run: &Run, presses: &[f64]) -> Vec<Demand> {
    let mut places: Vec<(usize, [f64; 2])> = Vec::new();
    for (i, asked) in part.asked.iter().enumerate().filter(|(i, _)| presses[*i] > 0.0) {
        let on_it = asked.demand.stations_on(road);
        // Around a closed road the next one may lie beyond its seam.
        let whole = &part.network.roads[road];
        let turns = if whole.closed { &[-1.0, 0.0, 1.0][..] } else { &[0.0][..] };
        let turned = |range: &[f64; 2]| {
            let range = *range;
            turns.iter().map(move |turn| (i, range.map(|s| s + turn * whole.length_m)))
        };
        places.extend(on_it.iter().flat_map(turned));
    }
    let mut near: Vec<usize> =
        places.iter().filter(|(_, [a, b])| *b > run.from_m && *a < run.to_m).map(|(i, _)| *i).collect();
    let before = places.iter().filter(|(_, [_, b])| *b <= run.from_m).map(|(_, [_, b])| *b).fold(f64::NAN, f64::max);
    let after = places.iter().filter(|(_, [a, _])| *a >= run.to_m).map(|(_, [a, _])| *a).fold(f64::NAN, f64::min);
    near.extend(places.iter().filter(|(_, [a, b])| *b == before || *a == after).map(|(i, _)| *i));
    near.sort_by(|&i, &j| presses[j].total_cmp(&presses[i]).then(i.cmp(&j)));
    near.dedup();
    near.into_iter().map(|i| part.asked[i].demand.clone()).collect()
}

/// The demands that give, each with those on the same roads that press against it.
fn contradictory(part: &Part<'_>, outcome: &Outcome, slacks: &[[usize; 2]], presses: &[f64]) -> Vec<Shortfall> {
    let roads = |demand: &Demand| {
        let on = |road: &usize| !demand.stations_on(*road).is_empty();
        part.roads.iter().copied().filter(on).collect::<Vec<_>>()
    };
    let mut found = Vec::new();
    for (i, (asked, [more, less])) in part.asked.iter().zip(slacks).enumerate() {
        let gives = outcome.x[*less] - outcome.x[*more];
        if gives.abs() <= EXCEEDED {
            continue;
        }
        let own = roads(&asked.demand);
        let against = |&j: &usize| {
            j != i && presses[j] > 0.0 && roads(&part.asked[j].demand).iter().any(|road| own.contains(road))
        };
        let mut others: Vec<usize> = (0..part.asked.len()).filter(against).collect();
        others.sort_by(|&a, &b| presses[b].total_cmp(&presses[a]).then(a.cmp(&b)));
        let place = asked.demand.place();
        let range = asked.demand.stations_on(place.road).first().copied().unwrap_or([place.station_m; 2]);
        let sign = if matches!(asked.demand, Demand::Highest { .. }) { -1.0 } else { 1.0 };
        found.push(Shortfall {
            road: place.road,
            road_name: place.name.clone(),
            from_m: range[0],
            to_m: range[1],
            needed: sign * (asked.value + gives),
            limit: sign * asked.value,
            because: others.into_iter().map(|j| part.asked[j].demand.clone()).collect(),
            kind: ShortfallKind::Demand(asked.demand.clone()),
        });
    }
    found
}
