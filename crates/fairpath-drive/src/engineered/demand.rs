//! What is asked of roads besides grade and K: a network comes in, each demand with its rows of the program goes out.

use super::network::{EngineeredNetwork, EngineeredRoad, RoadPoint};
use super::solve::Part;
use super::spline::Terms;

/// A place on a road with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// Which road.
    pub road: usize,
    /// By which messages call it.
    pub name: String,
    /// Arc length in plan from its start, m.
    pub station_m: f64,
}

/// Something that is asked of the heights besides grade and K.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Demand {
    /// A given height.
    Height {
        /// Where.
        at: NamedPoint,
        /// How high, m.
        height_m: f64,
    },
    /// A given grade.
    Grade {
        /// Where.
        at: NamedPoint,
        /// Rise for a metre.
        grade: f64,
    },
    /// A range that must not be lower.
    Lowest {
        /// Where the range begins.
        from: NamedPoint,
        /// Where it ends, m.
        to_m: f64,
        /// Not below this, m.
        height_m: f64,
    },
    /// A range that must not be higher.
    Highest {
        /// Where the range begins.
        from: NamedPoint,
        /// Where it ends, m.
        to_m: f64,
        /// Not above this, m.
        height_m: f64,
    },
    /// A crossing at which one road passes over another.
    Over {
        /// Its number in the network's list.
        over: usize,
        /// What is above.
        upper: NamedPoint,
        /// What is below.
        lower: NamedPoint,
        /// Least height of the one above the other, m.
        clearance_m: f64,
    },
    /// A crossing on one level.
    Meet {
        /// Its number in the network's list.
        meet: usize,
        /// One road.
        a: NamedPoint,
        /// The other.
        b: NamedPoint,
    },
}

impl Demand {
    /// Where on a road it is, if it is there.
    pub(super) fn stations_on(&self, road: usize) -> Vec<[f64; 2]> {
        let at = |point: &NamedPoint| (point.road == road).then_some([point.station_m; 2]);
        match self {
            Self::Height { at: point, .. } | Self::Grade { at: point, .. } => at(point).into_iter().collect(),
            Self::Lowest { from, to_m, .. } | Self::Highest { from, to_m, .. } => {
                at(from).map(|[begin, _]| [begin, *to_m]).into_iter().collect()
            }
            Self::Over { upper: a, lower: b, .. } | Self::Meet { a, b, .. } => at(a).into_iter().chain(at(b)).collect(),
        }
    }

    /// The first place that it names.
    pub(super) fn place(&self) -> &NamedPoint {
        match self {
            Self::Height { at, .. } | Self::Grade { at, .. } => at,
            Self::Lowest { from, .. } | Self::Highest { from, .. } => from,
            Self::Over { upper, .. } => upper,
            Self::Meet { a, .. } => a,
        }
    }

    /// What it asks of a road: the end of a sentence that begins with “to”.
    pub(super) fn asks(&self, road: usize) -> String {
        match self {
            Self::Height { at, height_m } => {
                format!("be at {} m at station {}", number(*height_m), number(at.station_m))
            }
            Self::Grade { at, grade } => {
                format!("have the grade {} at station {}", number(*grade), number(at.station_m))
            }
            Self::Lowest { from, to_m, height_m } => {
                format!("stay above {} m from {} to {} m", number(*height_m), number(from.station_m), number(*to_m))
            }
            Self::Highest { from, to_m, height_m } => {
                format!("stay below {} m from {} to {} m", number(*height_m), number(from.station_m), number(*to_m))
            }
            Self::Over { upper, lower, clearance_m, .. } => {
                let (way, here, there) =
                    if upper.road == road { ("over", upper, lower) } else { ("under", lower, upper) };
                format!("pass {} m {way} {}", number(*clearance_m), beside(here, there))
            }
            Self::Meet { a, b, .. } => {
                let (here, there) = if a.road == road { (a, b) } else { (b, a) };
                format!("meet {}", beside(here, there))
            }
        }
    }
}

/// The other road of a crossing, seen from this one.
fn beside(here: &NamedPoint, there: &NamedPoint) -> String {
    let other = if here.road == there.road { "itself".to_owned() } else { format!("road {:?}", there.name) };
    format!("{other} at station {} (here {})", number(there.station_m), number(here.station_m))
}

/// A number as messages have it, with at most three digits behind the point, or four of a small one.
pub(super) fn number(x: f64) -> String {
    let text = if x.abs() < 1.0 { format!("{x:.4}") } else { format!("{x:.2}") };
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Two numbers with as many digits as it takes to tell them apart.
pub(super) fn apart(x: f64, y: f64) -> [String; 2] {
    let mut texts = [number(x), number(y)];
    for digits in 4..=9 {
        if texts[0] != texts[1] || x == y {
            break;
        }
        texts = [x, y].map(|x| format!("{x:.digits$}"));
    }
    texts
}

/// Whether terms are to be equal to a value, or at least that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sense {
    Equal,
    AtLeast,
}

/// A demand with what it means for the unknowns.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    pub(super) demand: Demand,
    pub(super) sense: Sense,
    /// Whether its values are grades, not heights.
    pub(super) of_grade: bool,
    /// Terms of coefficients, all of which are to be equal to, or at least, the value.
    pub(super) rows: Vec<Vec<(usize, f64)>>,
    pub(super) value: f64,
}

/// All that is asked of the roads of a part of a network, road by road, then crossings.
pub(super) fn asked(part: &Part<'_>) -> Vec<Asked> {
    let mut all = Vec::new();
    for &road in &part.roads {
        of_road(part, road, &mut all);
    }
    let here = |point: RoadPoint| part.roads.binary_search(&point.road).is_ok();
    let height = |point: RoadPoint| part.terms(point.road, part.layouts[point.road].height(point.station_m));
    let named = |point: RoadPoint| named(part.network, point.road, point.station_m);
    let difference = |a: RoadPoint, b: RoadPoint| {
        let below = height(b).map(|(i, factor)| (i, -factor));
        vec![height(a).into_iter().chain(below).collect()]
    };
    for (i, over) in part.network.over.iter().enumerate().filter(|(_, over)| here(over.upper)) {
        let (upper, lower, clearance_m) = (named(over.upper), named(over.lower), over.clearance_m);
        all.push(Asked {
            demand: Demand::Over { over: i, upper, lower, clearance_m },
            sense: Sense::AtLeast,
            of_grade: false,
            rows: difference(over.upper, over.lower),
            value: clearance_m,
        });
    }
    for (i, meet) in part.network.meet.iter().enumerate().filter(|(_, meet)| here(meet.a)) {
        all.push(Asked {
            demand: Demand::Meet { meet: i, a: named(meet.a), b: named(meet.b) },
            sense: Sense::Equal,
            of_grade: false,
            rows: difference(meet.a, meet.b),
            value: 0.0,
        });
    }
    all
}

fn of_road(part: &Part<'_>, road: usize, all: &mut Vec<Asked>) {
    let EngineeredRoad { length_m, fixed, bounds, start_grade, end_grade, .. } = &part.network.roads[road];
    let layout = &part.layouts[road];
    let named = |station_m: f64| named(part.network, road, station_m);
    let row = |terms: Terms| part.terms(road, terms).to_vec();
    let grade_at = |all: &mut Vec<Asked>, station_m: f64, grade: Option<f64>| {
        all.extend(grade.map(|grade| Asked {
            demand: Demand::Grade { at: named(station_m), grade },
            sense: Sense::Equal,
            of_grade: true,
            rows: vec![row(layout.grade(station_m))],
            value: grade,
        }));
    };
    grade_at(all, 0.0, *start_grade);
    for point in fixed {
        let height_m = point.height_m;
        all.push(Asked {
            demand: Demand::Height { at: named(point.station_m), height_m },
            sense: Sense::Equal,
            of_grade: false,
            rows: vec![row(layout.height(point.station_m))],
            value: height_m,
        });
        grade_at(all, point.station_m, point.grade);
    }
    grade_at(all, *length_m, *end_grade);
    for bound in bounds {
        let points = layout.bezier(bound.from_m, bound.to_m);
        let (from, to_m) = (named(bound.from_m), bound.to_m);
        let sides = [(bound.lowest_m, 1.0), (bound.highest_m, -1.0)];
        for (height_m, sign) in sides.into_iter().filter_map(|(height, sign)| height.map(|height| (height, sign))) {
            let from = from.clone();
            all.push(Asked {
                demand: if sign > 0.0 {
                    Demand::Lowest { from, to_m, height_m }
                } else {
                    Demand::Highest { from, to_m, height_m }
                },
                sense: Sense::AtLeast,
                of_grade: false,
                rows: points.iter().map(|terms| row(terms.map(|(i, factor)| (i, sign * factor)))).collect(),
                value: sign * height_m,
            });
        }
    }
}

fn named(network: &EngineeredNetwork, road: usize, station_m: f64) -> NamedPoint {
    NamedPoint { road, name: network.roads[road].name.clone(), station_m }
}
