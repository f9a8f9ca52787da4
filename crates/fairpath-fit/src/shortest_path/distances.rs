//! Distances of all nodes of the graph to the target, from the last sample back, and their repair where edges get dearer (section 3.5
//! of Baran et al. 2010).
//!
//! The followers at each sample are kept in order of their distance to the target; since a join never costs less than its base, the
//! scan for the best follower stops at the first that cannot improve on what is found.

use super::graph::{Edge, Graph, Node, Path};
use super::transition::overlap;
use fairpath_curve::Continuity;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// The way on from a node.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Onward {
    Nowhere,
    Target,
    To(u32, Continuity),
}

/// Where a search begins and ends.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Goal {
    /// From the first sample of the track to the last.
    End,
    /// Once around a ring, from one of the gates to one of them.
    Around(Gates),
}

impl Goal {
    /// Once around, at the node where it began.
    pub(crate) fn around(graph: &Graph, node: u32) -> Self {
        Self::Around(Gates { cut: graph.nodes[node as usize].first as usize, prices: vec![(node, 0.0)] })
    }
}

/// Nodes after which a cycle crosses from `cut` to a later sample: the last to start no later than there. Every cycle has exactly
/// one, so that those in which it is one of these are the cycles that pass a gate.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Gates {
    pub(crate) cut: usize,
    /// What arriving at each gate counts for. Setting out from there earns the same, so that it is nothing to a cycle.
    pub(crate) prices: Vec<(u32, f64)>,
}

/// The way once around from a gate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Departure {
    pub(super) price: f64,
    cost: f64,
    onward: Onward,
}

/// Distances of all nodes to the target.
pub(crate) struct Distances {
    /// Cost of the node and of everything after it, or the price if it is a gate and that is less.
    pub(super) to_target: Vec<f64>,
    onward: Vec<Onward>,
    /// Nodes by start, nearest to the target first.
    pub(super) order: Vec<Vec<u32>>,
    /// Nodes whose way on leads to a node.
    leading_to: Vec<Vec<u32>>,
    /// Nodes whose distances repairs have left too short.
    stale: Vec<u32>,
    /// The gates; none if the search ends at the last sample.
    pub(super) gates: BTreeMap<u32, Departure>,
    /// The sample from which positions are counted, and the one at which the search ends.
    pub(super) origin: usize,
    pub(super) target: usize,
    pub(super) turn: usize,
}

impl Distances {
    /// Computes all distances to the goal, from the last position back.
    pub(crate) fn new(graph: &mut Graph, goal: &Goal) -> Self {
        let n = graph.nodes.len();
        let turn = graph.turn();
        let (origin, prices) = match goal {
            Goal::End => (0, &[][..]),
            Goal::Around(gates) => (gates.cut + 1, &gates.prices[..]),
        };
        let unknown = |price| Departure { price, cost: f64::INFINITY, onward: Onward::Nowhere };
        let mut d = Self {
            to_target: vec![f64::INFINITY; n],
            onward: vec![Onward::Nowhere; n],
            order: vec![Vec::new(); turn],
            leading_to: vec![Vec::new(); n],
            stale: Vec::new(),
            gates: prices.iter().map(|p| (p.0, unknown(p.1))).collect(),
            origin,
            target: origin + turn,
            turn,
        };
        for position in (origin..origin + turn).rev() {
            let sample = position % turn;
            let nodes = graph.starting_at(sample);
            for node in nodes.clone() {
                let (cost, onward) = d.best_inside(graph, node as u32);
                d.to_target[node] = cost;
                d.set_onward(node as u32, onward);
            }
            let mut list: Vec<u32> = nodes.map(|i| i as u32).collect();
            list.retain(|&i| d.to_target[i as usize].is_finite());
            list.sort_by(|&a, &b| d.to_target[a as usize].total_cmp(&d.to_target[b as usize]).then(a.cmp(&b)));
            d.order[sample] = list;
        }
        for &(gate, _) in prices {
            d.set_out(graph, gate);
        }
        d
    }

    /// Where a node starts, counted on from the origin.
    fn position(&self, node: &Node) -> usize {
        let first = node.first as usize;
        if first < self.origin { first + self.turn } else { first }
    }

    /// Where a node ends, counted on from the origin.
    pub(super) fn end(&self, node: &Node) -> usize {
        self.position(node) + node.span()
    }

    /// The best way on from a node between origin and target. At a gate it may end.
    fn best_inside(&self, graph: &mut Graph, node: u32) -> (f64, Onward) {
        let end = self.end(&graph.nodes[node as usize]);
        let (cost, onward) = self.best_onward(graph, node, end);
        match self.gates.get(&node) {
            Some(gate) if gate.price <= cost => (gate.price, Onward::Target),
            _ => (cost, onward),
        }
    }

    /// Computes the way once around from a gate, which lies a turn before where it is arrived at.
    fn set_out(&mut self, graph: &mut Graph, gate: u32) {
        let end = self.end(&graph.nodes[gate as usize]) - self.turn;
        let (cost, onward) = self.best_onward(graph, gate, end);
        if let Some(departure) = self.gates.get_mut(&gate) {
            (departure.cost, departure.onward) = (cost, onward);
        }
    }

    fn set_onward(&mut self, node: u32, onward: Onward) {
        if let Onward::To(old, _) = self.onward[node as usize] {
            self.leading_to[old as usize].retain(|&i| i != node);
        }
        if let Onward::To(new, _) = onward {
            self.leading_to[new as usize].push(node);
        }
        self.onward[node as usize] = onward;
    }

    fn best_onward(&self, graph: &mut Graph, node: u32, end: usize) -> (f64, Onward) {
        let this = graph.nodes[node as usize];
        if self.gates.is_empty() && end == self.target {
            return (this.cost, Onward::Target);
        }
        let (mut best, mut onward) = (f64::INFINITY, Onward::Nowhere);
        for (level, base) in graph.levels(end) {
            let overlap = overlap(level, graph.options);
            if this.span() <= overlap || end < self.origin + overlap {
                continue;
            }
            let next_start = end - overlap;
            if next_start >= self.target {
                continue;
            }
            for &next in &self.order[next_start % self.turn] {
                let ahead = self.to_target[next as usize];
                if base + ahead >= best {
                    break;
                }
                // Those that end no later than this one would not move on.
                if next_start + graph.nodes[next as usize].span() <= end {
                    continue;
                }
                if base + ahead + graph.bound(node, next, level) >= best {
                    continue;
                }
                let total = graph.edge_cost(Edge { from: node, to: next, level }, base) + ahead;
                if total < best {
                    (best, onward) = (total, Onward::To(next, level));
                }
            }
        }
        (this.cost + best, onward)
    }

    /// Brings distances up to date after the edges from `from` got dearer, up to `reach` samples before each. What lies further
    /// back keeps distances that are too short by nearly the same amount, so that its choices rarely change, until it is
    /// [settled](Self::settle).
    pub(crate) fn repair(&mut self, graph: &mut Graph, from: impl IntoIterator<Item = u32>, reach: usize) {
        // Later starts first: what a node's distance depends on is then settled before it.
        let place = |d: &Self, graph: &Graph, i: u32| (d.position(&graph.nodes[i as usize]), i);
        let mut open: BTreeSet<(usize, u32)> = from.into_iter().map(|i| place(self, graph, i)).collect();
        let sources: Vec<usize> = open.iter().map(|o| o.0).collect();
        let mut changed: HashSet<u32> = open.iter().map(|o| o.1).collect();
        while let Some((position, node)) = open.pop_last() {
            let (cost, onward) = self.best_inside(graph, node);
            let before = self.to_target[node as usize];
            self.set_onward(node, onward);
            if cost == before {
                continue;
            }
            self.to_target[node as usize] = cost;
            if !self.gates.is_empty() {
                changed.insert(node);
            }
            let list = &mut self.order[position % self.turn];
            list.retain(|&i| i != node);
            if cost.is_finite() {
                let to_target = &self.to_target;
                let place =
                    list.partition_point(|&i| to_target[i as usize].total_cmp(&cost).then(i.cmp(&node)).is_lt());
                list.insert(place, node);
            }
            // The nearest source at or after a place decides whether it is within reach.
            let within = |place: usize| {
                reach == usize::MAX
                    || sources.get(sources.partition_point(|&s| s < place)).is_some_and(|s| s - place <= reach)
            };
            for &i in &self.leading_to[node as usize] {
                let place = place(self, graph, i);
                if within(place.0) {
                    open.insert(place);
                } else {
                    self.stale.push(i);
                }
            }
        }
        // Costs only grow: a way that did not get dearer is still the best.
        let dearer = |gate: u32, departure: &Departure| {
            changed.contains(&gate) || matches!(departure.onward, Onward::To(next, _) if changed.contains(&next))
        };
        let gates: Vec<u32> = self.gates.iter().filter(|g| dearer(*g.0, g.1)).map(|g| *g.0).collect();
        for gate in gates {
            self.set_out(graph, gate);
        }
    }

    /// Brings all distances up to date that repairs have left behind, and those of `from`, whose edges got dearer. Costs only grow, so
    /// what leads to nothing that got dearer stays the shortest.
    pub(crate) fn settle(&mut self, graph: &mut Graph, from: Option<u32>) {
        let stale = std::mem::take(&mut self.stale);
        self.repair(graph, stale.into_iter().chain(from), usize::MAX);
    }

    /// The shortest path to the goal; around a ring it must end at the gate where it began.
    pub(crate) fn path(&self) -> Option<Path> {
        if self.gates.is_empty() {
            let start = *self.order[self.origin].first()?;
            return self.followed(start, self.to_target[start as usize], self.onward[start as usize]).map(|p| p.0);
        }
        let gate = self.cheapest_gate()?;
        let (path, arrived) = self.lap(gate)?;
        (arrived == gate).then_some(path)
    }

    /// The gate from which going once around costs least, prices included.
    pub(crate) fn cheapest_gate(&self) -> Option<u32> {
        let bound = |gate: &&u32| self.bound_through(**gate);
        self.gates.keys().min_by(|a, b| bound(a).total_cmp(&bound(b))).copied()
    }

    /// What going once around costs at least, prices included.
    pub(crate) fn least(&self) -> f64 {
        self.cheapest_gate().map_or(f64::INFINITY, |gate| self.bound_through(gate))
    }

    /// What going once around from a gate costs, prices included: a bound from below of all cycles that pass it.
    pub(crate) fn bound_through(&self, gate: u32) -> f64 {
        self.gates.get(&gate).map_or(f64::INFINITY, |g| g.cost - g.price)
    }

    /// The gates from which there is a way around, and what it costs to go it.
    pub(crate) fn departures(&self) -> Vec<(u32, f64)> {
        self.gates.iter().map(|(gate, d)| (*gate, d.cost)).filter(|p| p.1.is_finite()).collect()
    }

    /// The best way once around from a gate, and the gate arrived at: a cycle, or a path that ends with another gate.
    pub(crate) fn lap(&self, gate: u32) -> Option<(Path, u32)> {
        let (mut path, arrived) = self.followed(gate, self.bound_through(gate), self.gates.get(&gate)?.onward)?;
        if arrived != gate {
            path.nodes.push(arrived);
        }
        Some((path, arrived))
    }

    /// The way on from a node to the goal, and the node arrived at: a gate, or the last node of the path.
    fn followed(&self, start: u32, cost: f64, onward: Onward) -> Option<(Path, u32)> {
        let mut path = Path { nodes: vec![start], joins: Vec::new(), cost };
        let (mut node, mut onward) = (start, onward);
        loop {
            match onward {
                Onward::Target => return Some((path, node)),
                Onward::To(next, level) => {
                    path.joins.push(level);
                    (node, onward) = (next, self.onward[next as usize]);
                    if self.gates.is_empty() || onward != Onward::Target {
                        path.nodes.push(next);
                    }
                }
                Onward::Nowhere => return None,
            }
        }
    }
}
