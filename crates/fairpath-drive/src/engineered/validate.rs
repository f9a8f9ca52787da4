//! What was told of a network comes in, everything in it that cannot be meant goes out.

use super::error::InputProblem;
use super::network::{EngineeredNetwork, EngineeredRoad, RoadPoint};
use super::spline::Layout;
use crate::MOST_HEIGHT_M;
use std::fmt::Arguments;

/// Most intervals of a network: 2²⁰, ten thousand kilometres with knots each 10 m.
const MOST_INTERVALS: f64 = 1_048_576.0;

/// Least and greatest of what is positive: whatever is beyond is a slip, and would leave nothing of other numbers beside it.
const POSITIVES: [f64; 2] = [1e-6, 1e9];

const HEIGHT: &str = "heights must be within ±100,000 m";
const GRADE: &str = "grades must be within ±1000";
const POSITIVE: &str = "it must be positive, from a millionth to a thousand million";
const NOT_NEGATIVE: &str = "it must be 0 or more, up to a thousand million";
const ON_ROAD: &str = "it must be a station of the road, from 0 to its length";

/// All that is wrong with a network.
pub(super) fn problems(network: &EngineeredNetwork) -> Vec<InputProblem> {
    let mut found = Problems(Vec::new());
    let mut intervals = 0.0;
    for (i, road) in network.roads.iter().enumerate() {
        let before = found.0.len();
        found.of_road(&format!("roads[{i}]"), road);
        if found.0.len() == before {
            intervals += Layout::intervals(road);
        }
    }
    found.check(
        format_args!("roads"),
        intervals,
        intervals <= MOST_INTERVALS,
        "so many intervals are too many; let the knot spacings be greater",
    );
    for (i, over) in network.over.iter().enumerate() {
        found.point(network, &format!("over[{i}].upper"), over.upper);
        found.point(network, &format!("over[{i}].lower"), over.lower);
        found.positive(format_args!("over[{i}].clearance_m"), over.clearance_m);
        let apart = over.upper != over.lower;
        found.check(
            format_args!("over[{i}].lower.station_m"),
            over.lower.station_m,
            apart,
            "a road cannot pass over itself at one place",
        );
    }
    for (i, meet) in network.meet.iter().enumerate() {
        found.point(network, &format!("meet[{i}].a"), meet.a);
        found.point(network, &format!("meet[{i}].b"), meet.b);
    }
    found.0
}

struct Problems(Vec<InputProblem>);

impl Problems {
    fn check(&mut self, field: Arguments<'_>, found: f64, fine: bool, needs: &'static str) {
        if !fine {
            self.0.push(InputProblem { field: field.to_string(), found, needs });
        }
    }

    fn height(&mut self, field: Arguments<'_>, found: f64) {
        self.check(field, found, found.abs() <= MOST_HEIGHT_M, HEIGHT);
    }

    fn grade(&mut self, field: Arguments<'_>, found: f64) {
        self.check(field, found, found.abs() <= 1000.0, GRADE);
    }

    fn positive(&mut self, field: Arguments<'_>, found: f64) {
        self.check(field, found, (POSITIVES[0]..=POSITIVES[1]).contains(&found), POSITIVE);
    }

    fn not_negative(&mut self, field: Arguments<'_>, found: f64) {
        self.check(field, found, (0.0..=POSITIVES[1]).contains(&found), NOT_NEGATIVE);
    }

    fn of_road(&mut self, name: &str, road: &EngineeredRoad) {
        self.positive(format_args!("{name}.length_m"), road.length_m);
        self.positive(format_args!("{name}.knot_spacing_m"), road.knot_spacing_m);
        self.positive(format_args!("{name}.limits.max_grade"), road.limits.max_grade);
        self.positive(format_args!("{name}.limits.crest_k_m"), road.limits.crest_k_m);
        self.positive(format_args!("{name}.limits.sag_k_m"), road.limits.sag_k_m);
        self.positive(format_args!("{name}.section.platform_m"), road.section.platform_m);
        self.not_negative(format_args!("{name}.section.slope_run"), road.section.slope_run);
        self.positive(format_args!("{name}.section.cut_weight"), road.section.cut_weight);
        self.positive(format_args!("{name}.section.fill_weight"), road.section.fill_weight);
        self.ground(name, road);
        for (i, fixed) in road.fixed.iter().enumerate() {
            self.station(format_args!("{name}.fixed[{i}].station_m"), fixed.station_m, road);
            self.height(format_args!("{name}.fixed[{i}].height_m"), fixed.height_m);
            if let Some(grade) = fixed.grade {
                self.grade(format_args!("{name}.fixed[{i}].grade"), grade);
            }
        }
        for (i, bound) in road.bounds.iter().enumerate() {
            self.range(&format!("{name}.bounds[{i}]"), [bound.from_m, bound.to_m], road);
            for (side, height) in [("lowest_m", bound.lowest_m), ("highest_m", bound.highest_m)] {
                if let Some(height) = height {
                    self.height(format_args!("{name}.bounds[{i}].{side}"), height);
                }
            }
        }
        for (side, grade) in [("start_grade", road.start_grade), ("end_grade", road.end_grade)] {
            if let Some(grade) = grade {
                self.grade(format_args!("{name}.{side}"), grade);
            }
        }
        for (i, stretch) in road.stretches.iter().enumerate() {
            self.range(&format!("{name}.stretches[{i}]"), [stretch.from_m, stretch.to_m], road);
            self.not_negative(format_args!("{name}.stretches[{i}].weight"), stretch.weight);
        }
    }

    fn ground(&mut self, name: &str, road: &EngineeredRoad) {
        let mut last = f64::NEG_INFINITY;
        for (i, &[station, height]) in road.ground.iter().enumerate() {
            let ascends = station > last && station.is_finite();
            self.check(
                format_args!("{name}.ground[{i}][0]"),
                station,
                ascends,
                "stations of the ground must ascend and be finite",
            );
            self.height(format_args!("{name}.ground[{i}][1]"), height);
            last = station;
        }
        let far = "the ground must reach within one knot spacing of both ends of the road";
        match (road.ground.first(), road.ground.last()) {
            (Some([first, _]), Some([last, _])) => {
                self.check(format_args!("{name}.ground[0][0]"), *first, !(*first > road.knot_spacing_m), far);
                let end = road.ground.len() - 1;
                let reaches = !(*last < road.length_m - road.knot_spacing_m);
                self.check(format_args!("{name}.ground[{end}][0]"), *last, reaches, far);
            }
            _ => self.check(format_args!("{name}.ground.len()"), 0.0, false, "the ground needs at least one height"),
        }
    }

    fn station(&mut self, field: Arguments<'_>, station_m: f64, road: &EngineeredRoad) {
        self.check(field, station_m, (0.0..=road.length_m).contains(&station_m), ON_ROAD);
    }

    fn range(&mut self, name: &str, [from_m, to_m]: [f64; 2], road: &EngineeredRoad) {
        self.station(format_args!("{name}.from_m"), from_m, road);
        self.station(format_args!("{name}.to_m"), to_m, road);
        self.check(format_args!("{name}.to_m"), to_m, !(to_m <= from_m), "the range must end beyond its beginning");
    }

    fn point(&mut self, network: &EngineeredNetwork, name: &str, point: RoadPoint) {
        match network.roads.get(point.road) {
            Some(road) => self.station(format_args!("{name}.station_m"), point.station_m, road),
            None => self.check(format_args!("{name}.road"), point.road as f64, false, "there is no such road"),
        }
    }
}
