//! The shortest cycle around a ring whose joins hold: exactly, where section 3.5 of Baran et al. 2010 searches three times.
//!
//! Every cycle crosses a chosen sample after exactly one node, its gate. The best way once around from any gate to any gate is found
//! by one search, and bounds all cycles from below. The bound is made tight by prices on the gates, which cancel in a cycle: the
//! distances of the turn before. Then the way around mostly arrives where it set out, and is the shortest cycle. Where a cheaper one
//! is still possible, the gates that it could pass are searched apart.

use super::a_star::{a_star, arrivals};
use super::distances::{Distances, Gates, Goal};
use super::graph::{Graph, Path};
use super::search::{REPAIR_REACH, ROUNDS_NEARBY, Verifier, verified};

/// Costs that differ by less are equal.
const EQUAL: f64 = 1e-9;

/// So many gates with the same start are searched one by one; for more, the distances between them are worth computing.
const FEW: usize = 2;

/// Most edges that may be looked at, in multiples of those of the first search: on a circle with very many samples every gate is as
/// good as any other. Beyond it the best cycle so far is taken.
const PATIENCE: usize = 40;

/// The shortest cycle, if it costs less than `below`. Where `validation_rounds` cut verification off, joins count as estimated.
pub(crate) fn shortest_cycle(graph: &mut Graph, verifier: &mut Verifier, below: f64) -> Option<Path> {
    let (cut, gates) = least_covered(graph);
    let rounds = verifier.options.validation_rounds * ROUNDS_NEARBY;
    let mut search = Search { graph, verifier, cut, rounds, most_edges: usize::MAX, below, best: None };
    let mut distances = search.distances(gates.into_iter().map(|gate| (gate, 0.0)).collect());
    search.most_edges = search.graph.computed.saturating_mul(PATIENCE);
    distances = search.distances(distances.departures());
    let lap = search.enforced_lap(&mut distances);
    if let (Some(lap), None) = (lap, &search.best)
        && below.is_infinite()
    {
        // Any cycle will do to begin with.
        let home = Goal::around(search.graph, lap.nodes[lap.nodes.len() / 2]);
        let cycle = verified(search.graph, &home, search.verifier);
        search.keep_shorter(cycle);
    }
    for group in search.promising_groups(&distances) {
        search.through(&distances, group);
    }
    search.best.map(|cycle| from_longest(search.graph, cycle))
}

/// The cycle begun at one of its longest nodes: later steps look across the seam last, and there they would least want to.
fn from_longest(graph: &Graph, mut cycle: Path) -> Path {
    let node = |i: u32| &graph.nodes[i as usize];
    let length = |i: u32| graph.candidates[node(i).candidate as usize].length;
    let longest = cycle.nodes.iter().fold(0.0_f64, |m, &i| m.max(length(i)));
    // Rounding must not choose between the sides of a square.
    let long = (0..cycle.nodes.len()).filter(|&k| length(cycle.nodes[k]) >= NEARLY * longest);
    let begin = long.min_by_key(|&k| node(cycle.nodes[k]).first).unwrap_or(0);
    cycle.nodes.rotate_left(begin);
    cycle.joins.rotate_left(begin);
    cycle
}

/// Share of the longest length that is as good.
const NEARLY: f64 = 0.8;

struct Search<'a, 'g, 'v> {
    graph: &'a mut Graph<'g>,
    verifier: &'a mut Verifier<'v>,
    cut: usize,
    /// Rounds of verification that are left.
    rounds: usize,
    most_edges: usize,
    /// The cost that a cycle must stay below: that of the best so far.
    below: f64,
    best: Option<Path>,
}

impl Search<'_, '_, '_> {
    fn distances(&mut self, prices: Vec<(u32, f64)>) -> Distances {
        Distances::new(self.graph, &Goal::Around(Gates { cut: self.cut, prices }))
    }

    fn keep_shorter(&mut self, cycle: Option<Path>) {
        if let Some(cycle) = cycle
            && cycle.cost < self.below - EQUAL
        {
            self.below = cycle.cost;
            self.best = Some(cycle);
        }
    }

    /// Verifies a path while there are rounds left, and then only avoids what cannot be merged; the nodes whose onward joins got
    /// dearer.
    fn enforce(&mut self, path: &Path) -> Vec<u32> {
        if self.rounds == 0 {
            return self.verifier.avoid_pinching(self.graph, path);
        }
        self.rounds -= 1;
        self.verifier.reprice(self.graph, path)
    }

    /// The best way around whose joins hold; kept if it is a cycle. Nothing if it cannot be short enough.
    fn enforced_lap(&mut self, distances: &mut Distances) -> Option<Path> {
        while distances.least() < self.below - EQUAL {
            let lap = settled_lap(distances)?;
            let dearer = self.enforce(&lap);
            if dearer.is_empty() {
                self.keep_shorter(lap.is_cycle().then(|| lap.clone()));
                return Some(lap);
            }
            distances.repair(self.graph, dearer, REPAIR_REACH);
        }
        None
    }

    /// The gates that a shorter cycle could pass, judged by the ways from them and to them.
    fn promising(&mut self, distances: &Distances) -> Vec<u32> {
        let below = self.below - EQUAL;
        let from: Vec<u32> = distances.gates.keys().copied().filter(|&g| distances.bound_through(g) < below).collect();
        let mut both = if from.is_empty() { Vec::new() } else { arrivals(distances, self.graph, &from, below) };
        both.retain(|gate| from.binary_search(gate).is_ok());
        both
    }

    /// The same by their start, the most promising first.
    fn promising_groups(&mut self, distances: &Distances) -> Vec<Vec<u32>> {
        let mut groups: Vec<Vec<u32>> = Vec::new();
        for gate in self.promising(distances) {
            let first = |i: u32| self.graph.nodes[i as usize].first;
            match groups.iter_mut().find(|group| first(group[0]) == first(gate)) {
                Some(group) => group.push(gate),
                None => groups.push(vec![gate]),
            }
        }
        groups
    }

    /// Looks for a shorter cycle through gates that start at one sample. Between these alone the bound is tight enough that few
    /// gates remain.
    fn through(&mut self, distances: &Distances, group: Vec<u32>) {
        if group.len() <= FEW {
            group.into_iter().for_each(|gate| self.through_gate(distances, gate));
            return;
        }
        let mut own = self.distances(group.into_iter().map(|gate| (gate, 0.0)).collect());
        self.enforced_lap(&mut own);
        for gate in self.promising(&own) {
            self.through_gate(&own, gate);
        }
    }

    fn through_gate(&mut self, distances: &Distances, gate: u32) {
        while self.graph.computed < self.most_edges {
            let Some(cycle) = a_star(distances, self.graph, Some(gate), self.below - EQUAL) else { return };
            if self.enforce(&cycle).is_empty() {
                self.keep_shorter(Some(cycle));
                return;
            }
        }
    }
}

/// From the best gate on, the first way around that arrives at a gate from which the search has set out before: at its own, if that
/// is where all ways lead.
fn settled_lap(distances: &Distances) -> Option<Path> {
    let mut gate = distances.cheapest_gate()?;
    let mut seen = vec![gate];
    loop {
        let (lap, arrived) = distances.lap(gate)?;
        if seen.contains(&arrived) {
            return Some(lap);
        }
        seen.push(arrived);
        gate = arrived;
    }
}

/// The sample after which the fewest nodes can cross, and those nodes.
fn least_covered(graph: &Graph) -> (usize, Vec<u32>) {
    let turn = graph.turn();
    let crosses = |node: &super::graph::Node, cut: usize| (cut + turn - node.first as usize) % turn < node.span();
    let mut covering = vec![0_usize; turn];
    for node in &graph.nodes {
        for sample in node.first as usize..node.first as usize + node.span() {
            covering[sample % turn] += 1;
        }
    }
    let cut = (0..turn).min_by_key(|&sample| covering[sample]).unwrap_or(0);
    let gates = (0..graph.nodes.len() as u32).filter(|&i| crosses(&graph.nodes[i as usize], cut)).collect();
    (cut, gates)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clean::clean;
    use crate::options::FitOptions;
    use crate::shortest_path::candidates::candidates;
    use crate::shortest_path::graph::Edge;
    use crate::shortest_path::transition::overlap;
    use crate::track::{Shape, prepare};
    use fairpath_curve::Point;
    use std::f64::consts::TAU;

    /// A closed curve with waves around it and a little tremor, all drawn from the seed.
    fn ring(seed: u64) -> Vec<Point> {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / (1_u64 << 23) as f64 - 1.0
        };
        let (size, narrow) = (30.0 + 20.0 * random(), 0.8 + 0.2 * random());
        let waves: Vec<[f64; 2]> = (0..3).map(|_| [0.06 * random(), 0.06 * random()]).collect();
        (0..80)
            .map(|i| {
                let a = TAU * f64::from(i) / 80.0;
                let wave = |(k, w): (usize, &[f64; 2])| {
                    let b = a * (k + 2) as f64;
                    w[0] * b.cos() + w[1] * b.sin()
                };
                let r = size * (1.0 + waves.iter().enumerate().map(wave).sum::<f64>());
                Point::new(100.0 + r * a.cos() + 0.3 * random(), 80.0 + narrow * r * a.sin() + 0.3 * random())
            })
            .collect()
    }

    /// The shortest cycle through one node, found by trying every edge.
    fn through(graph: &mut Graph, home: u32) -> Option<Path> {
        let (turn, n) = (graph.turn(), graph.nodes.len());
        let origin = graph.nodes[home as usize].first as usize;
        let place = |graph: &Graph, i: u32| (graph.nodes[i as usize].first as usize + turn - origin) % turn;
        let mut order: Vec<u32> = (0..n as u32).filter(|&i| i == home || place(graph, i) > 0).collect();
        order.sort_by_key(|&i| std::cmp::Reverse((place(graph, i), i)));
        let mut best = vec![(f64::INFINITY, None); n];
        for i in order {
            let node = graph.nodes[i as usize];
            let end = place(graph, i) + node.span();
            for (level, base) in graph.levels(0) {
                let overlap = overlap(level, graph.options);
                if node.span() <= overlap {
                    continue;
                }
                let next_start = end - overlap;
                for next in graph.starting_at((origin + next_start) % turn) {
                    let closes = next_start == turn && next == home as usize;
                    if (next_start >= turn && !closes) || graph.nodes[next].span() <= overlap {
                        continue;
                    }
                    let ahead = if closes { 0.0 } else { best[next].0 };
                    let cost = node.cost + graph.edge_cost(Edge { from: i, to: next as u32, level }, base) + ahead;
                    if cost < best[i as usize].0 {
                        best[i as usize] = (cost, Some((next as u32, level)));
                    }
                }
            }
        }
        let mut path = Path { nodes: Vec::new(), joins: Vec::new(), cost: best[home as usize].0 };
        let mut node = home;
        loop {
            let (next, level) = best[node as usize].1?;
            path.nodes.push(node);
            path.joins.push(level);
            if next == home {
                return Some(path);
            }
            node = next;
        }
    }

    #[test]
    fn no_cycle_through_any_node_is_shorter_than_the_shortest_cycle() {
        let (mut rings, mut not_by_three_rounds) = (0, 0);
        for seed in 0..24 {
            // Joins of several kinds overlap differently.
            let (g1_cost, g0_cost) = [(None, None), (Some(4.0), None), (Some(8.0), Some(20.0))][seed as usize % 3];
            let options = FitOptions {
                g1_cost,
                g0_cost,
                points_per_circle: 9.0,
                validation_rounds: 100,
                ..FitOptions::default()
            };
            let cleaned = clean(&ring(seed), 1.0).expect("it is no dot");
            let track = prepare(&cleaned, &options);
            if track.shape != Shape::Ring {
                continue;
            }
            let candidates = candidates(&track, &options);
            let mut graph = Graph::new(&candidates, &track, &options);
            let mut verifier = Verifier::new(&track, &options);
            let found = shortest_cycle(&mut graph, &mut verifier, f64::INFINITY).expect("there is a cycle");
            let sum: f64 = found.nodes.iter().map(|&i| graph.nodes[i as usize].cost).sum::<f64>()
                + found.edges().map(|e| graph.cost_now(e)).sum::<f64>();
            assert!((sum - found.cost).abs() < 1e-9 * sum, "ring {seed}: {sum} but {}", found.cost);
            assert!(found.edges().all(|e| graph.is_verified(e)), "ring {seed}");
            for home in 0..graph.nodes.len() as u32 {
                while let Some(other) = through(&mut graph, home) {
                    // What cannot be merged does not count.
                    if verifier.avoid_pinching(&mut graph, &other).is_empty() {
                        assert!(other.cost > found.cost - 1e-6, "ring {seed}: {} but {}", found.cost, other.cost);
                        break;
                    }
                }
            }
            let mut graph = Graph::new(&candidates, &track, &options);
            let three = super::super::search::three_rounds(&mut graph, &mut verifier);
            not_by_three_rounds += usize::from(three.is_none_or(|t| t.cost > found.cost + 1e-6));
            rings += 1;
        }
        assert!(
            rings >= 12 && not_by_three_rounds > 0,
            "{rings} rings, {not_by_three_rounds} of them not by three rounds"
        );
    }
}
