//! A network of roads comes in, each road's profile of least earthwork goes out.

use super::components::components;
use super::demand::{Asked, Sense, asked};
use super::earthwork::{earthwork, stretch_ends, weight_at};
use super::elastic;
use super::error::EngineeredError;
use super::network::{EngineeredNetwork, EngineeredRoad};
use super::program::{Cost, End, Outcome, Program};
use super::spline::{Ground, Layout, Terms};
use super::validate::problems;
use crate::profile::Profile;

/// What one metre of road counts for the square of its bend, m⁴: as much as a cubic metre of earth if it bends by one over this root. A road that bends as K = 20 has it
/// all along counts as much as 25 µm of fill on a platform of 10 m.
pub const STIFFNESS_M4: f64 = 1000.0;

/// What the square of a metre off the ground costs at each coefficient, m³/m², so that a road that nothing holds has a height: a road that is 100 m off the ground
/// pays the hundredth of a litre for each knot.
pub(super) const PULL: f64 = 1e-9;

/// Room that is kept within the limits while the program is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// Of grades, rise for a metre.
    pub grade: f64,
    /// Of K, as a share.
    pub k: f64,
    /// Of clearances and bounds, m.
    pub height_m: f64,
}

/// The room that is kept within the limits.
pub const MARGIN: Margin = Margin { grade: 1e-7, k: 1e-6, height_m: 1e-6 };

/// By how much the limits may be missed when there is no room within them, and by how much given heights and grades and meetings may always be.
pub(super) const TOLERANCE: Margin = Margin { grade: 1e-6, k: 1e-4, height_m: 1e-4 };

/// The heights of a network.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineeredHeights {
    /// For each road its profile, from station 0 to its length; each piece is a parabola.
    pub profiles: Vec<Profile>,
    /// For each road the earth that it moves.
    pub earthwork: Vec<Earthwork>,
    /// Whether grades, K, clearances and bounds hold without any tolerance. Otherwise there was no room within them, as where a road is fixed at two points that
    /// only the steepest grade connects; then grades hold to 1e-6, K to 1e-4 of itself, clearances and bounds to 0.1 mm. Given heights and meetings hold
    /// to 0.1 mm, given grades to 1e-6, always.
    pub strict: bool,
    /// How many iterations the solver took for all parts of the network together.
    pub iterations: u32,
}

/// The earth that a road moves, exactly that between its profile and its ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Earthwork {
    /// Volume cut, m³, each times the weight of its stretch.
    pub cut_m3: f64,
    /// Volume filled, m³, likewise.
    pub fill_m3: f64,
    /// Both times what they count.
    pub counted: f64,
}

impl EngineeredNetwork {
    /// The heights of least earthwork within all limits.
    ///
    /// Roads that no crossing ties together, not even through others, have no influence on each other.
    ///
    /// # Errors
    /// When something that was told cannot be meant, with all that is wrong; when limits contradict each other, with what would have to give; when rounding
    /// keeps the solver from either.
    pub fn solve(&self) -> Result<EngineeredHeights, EngineeredError> {
        let Profiles { profiles, strict, iterations } = self.profiles()?;
        let earthwork = self.roads.iter().zip(&profiles).map(|(road, profile)| earthwork(road, profile)).collect();
        Ok(EngineeredHeights { profiles, earthwork, strict, iterations })
    }

    /// The same without the earth that is moved.
    pub(crate) fn profiles(&self) -> Result<Profiles, EngineeredError> {
        let problems = problems(self);
        if !problems.is_empty() {
            return Err(EngineeredError::Invalid { problems });
        }
        let layouts: Vec<Layout> = self.roads.iter().map(Layout::of).collect();
        let mut profiles: Vec<Option<Profile>> = vec![None; self.roads.len()];
        let (mut strict, mut iterations, mut shortfalls) = (true, 0, Vec::new());
        for roads in components(self) {
            let part = Part::new(self, &layouts, roads);
            match part.least() {
                Ok(least) => {
                    strict &= least.strict;
                    iterations += least.iterations;
                    for (road, profile) in part.profiles(&least.x)? {
                        profiles[road] = Some(profile);
                    }
                }
                Err(status) => shortfalls.extend(elastic::shortfalls(&part, &status)?),
            }
        }
        if !shortfalls.is_empty() {
            return Err(EngineeredError::Infeasible { shortfalls });
        }
        Ok(Profiles { profiles: profiles.into_iter().flatten().collect(), strict, iterations })
    }
}

/// The profiles of a network, with what [`EngineeredHeights`] has beside.
pub(crate) struct Profiles {
    pub(crate) profiles: Vec<Profile>,
    strict: bool,
    iterations: u32,
}

/// Roads that hang together, with the places of their unknowns.
pub(super) struct Part<'a> {
    pub(super) network: &'a EngineeredNetwork,
    pub(super) layouts: &'a [Layout],
    /// Which roads, ascending.
    pub(super) roads: Vec<usize>,
    /// For each of them its first unknown.
    firsts: Vec<usize>,
    /// Coefficients along the ground, from which the unknowns are counted: so they are tens of metres at most, wherever the origin of heights is.
    pub(super) base: Vec<f64>,
    /// What is asked of the roads besides grade and K.
    pub(super) asked: Vec<Asked>,
}

/// A solution within limits.
struct Least {
    x: Vec<f64>,
    strict: bool,
    iterations: u32,
}

impl<'a> Part<'a> {
    fn new(network: &'a EngineeredNetwork, layouts: &'a [Layout], roads: Vec<usize>) -> Self {
        let (mut firsts, mut base) = (Vec::new(), Vec::new());
        for &road in &roads {
            firsts.push(base.len());
            base.extend(layouts[road].along(&Ground(&network.roads[road].ground)));
        }
        let mut part = Self { network, layouts, roads, firsts, base, asked: Vec::new() };
        part.asked = asked(&part);
        part
    }

    /// The roads with their intervals and their first unknowns.
    pub(super) fn each(&self) -> impl Iterator<Item = (usize, &EngineeredRoad, &Layout, usize)> {
        let road = |(&road, &first): (&usize, &usize)| (road, &self.network.roads[road], &self.layouts[road], first);
        self.roads.iter().zip(&self.firsts).map(road)
    }

    /// Terms of a road as terms of unknowns.
    pub(super) fn terms(&self, road: usize, terms: Terms) -> Terms {
        let first = self.roads.binary_search(&road).map_or(0, |place| self.firsts[place]);
        terms.map(|(i, factor)| (first + i, factor))
    }

    /// What terms come to on the ground.
    pub(super) fn on_ground(&self, terms: &[(usize, f64)]) -> f64 {
        terms.iter().map(|&(i, factor)| factor * self.base[i]).sum()
    }

    /// The profiles of a solution.
    pub(super) fn profiles(&self, x: &[f64]) -> Result<Vec<(usize, Profile)>, EngineeredError> {
        let c: Vec<f64> = self.base.iter().zip(x).map(|(base, x)| base + x).collect();
        let profile = |(road, _, layout, first): (usize, &EngineeredRoad, &Layout, usize)| {
            let unsettled = |error: crate::ProfileError| EngineeredError::Unsettled {
                roads: self.roads.clone(),
                status: error.to_string(),
            };
            Ok((road, layout.profile(&c[first..first + layout.coefficients()]).map_err(unsettled)?))
        };
        self.each().map(profile).collect()
    }

    /// The least earthwork: first with room within the limits, then, where there is none, as much beyond. An error is what the solver said.
    fn least(&self) -> Result<Least, String> {
        let mut iterations = 0;
        let mut status = String::new();
        for room in [1.0, -1.0] {
            let outcome = self.program(room).solve();
            iterations += outcome.iterations;
            if outcome.end == End::Solved {
                let excess = self.excess(&outcome);
                let strict = excess.grade <= 0.0 && excess.k <= 0.0 && excess.height_m <= 0.0;
                let within = excess.grade <= TOLERANCE.grade
                    && excess.k <= TOLERANCE.k
                    && excess.height_m <= TOLERANCE.height_m
                    && excess.given <= 1.0;
                if within {
                    return Ok(Least { x: outcome.x, strict, iterations });
                }
            }
            status = outcome.status;
        }
        Err(status)
    }

    /// The program of least earthwork, with so many margins within the limits.
    fn program(&self, room: f64) -> Program {
        let mut program = Program::default();
        program.unknowns(self.base.len());
        (0..self.base.len()).for_each(|i| program.square(&[(i, 1.0)], 0.0, 2.0 * PULL));
        for (_, road, layout, first) in self.each() {
            let ground = Ground(&road.ground);
            for interval in 0..layout.count {
                let bend = shifted(layout.bend(interval), first);
                let h = layout.step_m;
                program.square(&bend, self.on_ground(&bend), 2.0 * STIFFNESS_M4 / (h * h * h));
                for second in [false, true] {
                    self.cell(&mut program, road, shifted(layout.half_mean(interval, second), first), {
                        let range = layout.half(interval, second);
                        (0.5 * h * mean_weight(road, range), ground.mean(range))
                    });
                }
            }
        }
        self.design(&mut program, room);
        for asked in &self.asked {
            for row in &asked.rows {
                let value = asked.value - self.on_ground(row);
                match asked.sense {
                    Sense::Equal => program.equal(row.iter().copied(), value),
                    Sense::AtLeast => {
                        let sum = program.sum(row.iter().copied());
                        program.at_least(sum, value + room * MARGIN.height_m)
                    }
                };
            }
        }
        program
    }

    /// The earth of one cell: its mean height, its length times the weight there, and the mean height of its ground.
    fn cell(&self, program: &mut Program, road: &EngineeredRoad, mean: Terms, (length, ground): (f64, f64)) {
        if length == 0.0 {
            return;
        }
        let (width, run) = (road.section.platform_m, road.section.slope_run);
        let cost = |weight: f64| Cost { linear: length * weight * width, square: 2.0 * length * weight * run };
        let sum = program.sum(mean);
        let value = ground - self.on_ground(&mean);
        program.costs(sum, value, cost(road.section.fill_weight), cost(road.section.cut_weight));
    }

    /// The limits of grade and bend.
    fn design(&self, program: &mut Program, room: f64) {
        let mut between = |terms: &[(usize, f64)], [least, most]: [f64; 2]| {
            // In shares of the upper limit, so that grades and bends are of one size with heights.
            let ground = self.on_ground(terms);
            let sum = program.sum(terms.iter().map(|&(i, factor)| (i, factor / most)));
            program.at_most(sum, (most - ground) / most);
            program.at_least(sum, (least - ground) / most);
        };
        for (_, road, layout, first) in self.each() {
            let h = layout.step_m;
            let most = h * (road.limits.max_grade - room * MARGIN.grade);
            for knot in 0..layout.knots() {
                between(&layout.rise(knot).map(|(i, factor)| (first + i, factor)), [-most, most]);
            }
            let bend_limit = |k: f64| h * h * greatest_bend(k) * (1.0 - room * MARGIN.k);
            let [crest, sag] = [road.limits.crest_k_m, road.limits.sag_k_m].map(bend_limit);
            for interval in 0..layout.count {
                between(&shifted(layout.bend(interval), first), [-crest, sag]);
            }
        }
    }

    /// By how much a solution is beyond its limits; negative where it is within.
    fn excess(&self, outcome: &Outcome) -> Excess {
        let c: Vec<f64> = self.base.iter().zip(&outcome.x).map(|(base, x)| base + x).collect();
        let value = |terms: &[(usize, f64)]| terms.iter().map(|&(i, factor)| factor * c[i]).sum::<f64>();
        let lowest = f64::NEG_INFINITY;
        let mut excess = Excess { grade: lowest, k: lowest, height_m: lowest, given: 0.0 };
        for (_, road, layout, first) in self.each() {
            let h = layout.step_m;
            for knot in 0..layout.knots() {
                let rise = value(&layout.rise(knot).map(|(i, factor)| (first + i, factor)));
                excess.grade = excess.grade.max(rise.abs() / h - road.limits.max_grade);
            }
            for interval in 0..layout.count {
                let bend = value(&shifted(layout.bend(interval), first)) / (h * h);
                let k = if bend < 0.0 { road.limits.crest_k_m } else { road.limits.sag_k_m };
                excess.k = excess.k.max(bend.abs() / greatest_bend(k) - 1.0);
            }
        }
        for asked in &self.asked {
            for row in &asked.rows {
                let short = asked.value - value(row);
                match asked.sense {
                    Sense::Equal if asked.of_grade => excess.given = excess.given.max(short.abs() / TOLERANCE.grade),
                    Sense::Equal => excess.given = excess.given.max(short.abs() / TOLERANCE.height_m),
                    Sense::AtLeast => excess.height_m = excess.height_m.max(short),
                }
            }
        }
        excess
    }
}

struct Excess {
    grade: f64,
    k: f64,
    height_m: f64,
    /// Of given heights and grades, in tolerances.
    given: f64,
}

/// The bend of a vertical curve of this K, 1/m.
pub(super) fn greatest_bend(k_m: f64) -> f64 {
    1.0 / (100.0 * k_m)
}

pub(super) fn shifted(terms: Terms, first: usize) -> Terms {
    terms.map(|(i, factor)| (first + i, factor))
}

/// The mean of what earthwork counts over a cell.
fn mean_weight(road: &EngineeredRoad, [from, to]: [f64; 2]) -> f64 {
    let mut breaks: Vec<f64> = stretch_ends(road, [from, to]).chain([from, to]).collect();
    breaks.sort_by(f64::total_cmp);
    let parts = breaks.windows(2).filter(|part| part[0] < part[1]);
    parts.map(|part| (part[1] - part[0]) * weight_at(road, 0.5 * (part[0] + part[1]))).sum::<f64>() / (to - from)
}
