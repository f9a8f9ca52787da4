//! The graph of candidates and its shortest path (sections 3.4 and 3.5 of Baran et al. 2010).
//!
//! Edges are not stored: a candidate that ends at sample e can only be followed by those that start at e less the overlap, so all of
//! them are implied by indices and their costs are computed when a search asks for them. The followers at each sample are kept in
//! order of their distance to the target; since a join never costs less than its base, the scan for the best follower stops
//! at the first that cannot improve on what is found.

use super::candidates::Candidate;
use super::transition::{Door, at_least, estimate, overlap, possible};
use crate::options::FitOptions;
use crate::track::Track;
use fairpath_curve::{Continuity, Kind};
use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeSet, BinaryHeap, HashMap, HashSet};

/// A candidate with the logical signs of its curvature at start and end (section 3.8). A line makes two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) candidate: u32,
    pub(crate) first: u32,
    pub(crate) last: u32,
    pub(crate) sign: [i8; 2],
    pub(crate) cost: f64,
    kind: Kind,
}

/// A transition between nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Edge {
    pub(crate) from: u32,
    pub(crate) to: u32,
    pub(crate) level: Continuity,
}

/// Candidates, nodes and what is known about edges.
pub(crate) struct Graph<'a> {
    pub(crate) candidates: &'a [Candidate],
    pub(crate) nodes: Vec<Node>,
    /// How each candidate begins and ends.
    heads: Vec<Door>,
    tails: Vec<Door>,
    corner: &'a [bool],
    options: &'a FitOptions,
    /// Nodes that start at each sample.
    starts: Vec<std::ops::Range<usize>>,
    /// Costs learnt by verification; infinite for forbidden edges.
    learnt: HashMap<Edge, f64>,
    /// Whether anything was learnt about edges from a node.
    touched: Vec<bool>,
    /// Edges whose cost was computed.
    pub(crate) computed: usize,
}

impl<'a> Graph<'a> {
    pub(crate) fn new(candidates: &'a [Candidate], track: &'a Track, options: &'a FitOptions) -> Self {
        let mut nodes = Vec::with_capacity(candidates.len() * 5 / 4);
        for (i, c) in candidates.iter().enumerate() {
            let node =
                |sign| Node { candidate: i as u32, first: c.first, last: c.last, sign, cost: c.cost, kind: c.kind };
            match c.kind {
                Kind::Line => nodes.extend([node([1, 1]), node([-1, -1])]),
                Kind::Arc | Kind::Clothoid => nodes.push(node(signs(c))),
            }
        }
        let mut starts = Vec::with_capacity(track.turn + 1);
        let mut at = 0;
        for sample in 0..track.turn as u32 {
            let end = at + nodes[at..].iter().take_while(|n| n.first == sample).count();
            starts.push(at..end);
            at = end;
        }
        let touched = vec![false; nodes.len()];
        Self {
            candidates,
            nodes,
            heads: candidates.iter().map(|c| Door::head(c, options)).collect(),
            tails: candidates.iter().map(|c| Door::tail(c, options)).collect(),
            corner: &track.corner,
            options,
            starts,
            learnt: HashMap::new(),
            touched,
            computed: 0,
        }
    }

    pub(crate) fn starting_at(&self, sample: usize) -> std::ops::Range<usize> {
        self.starts[sample].clone()
    }

    /// The continuities that may follow a node that ends at `sample`, with their base cost.
    fn levels(&self, sample: usize) -> impl Iterator<Item = (Continuity, f64)> + use<> {
        let o = self.options;
        let all = if self.corner[sample] {
            [Some((Continuity::G0, 0.0)), None, None]
        } else {
            [
                o.g2_cost.map(|c| (Continuity::G2, c)),
                o.g1_cost.map(|c| (Continuity::G1, c)),
                o.g0_cost.map(|c| (Continuity::G0, c)),
            ]
        };
        all.into_iter().flatten()
    }

    fn edge_cost(&mut self, edge: Edge, base: f64) -> f64 {
        if self.touched[edge.from as usize]
            && let Some(&cost) = self.learnt.get(&edge)
        {
            return cost;
        }
        self.computed += 1;
        self.estimated(edge, base)
    }

    /// A bound from below of what a join adds to its base cost, infinite where it is impossible.
    #[inline]
    fn bound(&self, from: u32, to: u32, level: Continuity) -> f64 {
        let (u, v) = (&self.nodes[from as usize], &self.nodes[to as usize]);
        if !possible(u.kind, v.kind, level) {
            return f64::INFINITY;
        }
        let (tail, head) = (&self.tails[u.candidate as usize], &self.heads[v.candidate as usize]);
        self.sign_cost(Edge { from, to, level }) + at_least(tail, head, level, self.options)
    }

    /// The cost of an edge before verification.
    fn estimated(&self, edge: Edge, base: f64) -> f64 {
        let (u, v) = (&self.nodes[edge.from as usize], &self.nodes[edge.to as usize]);
        if !possible(u.kind, v.kind, edge.level) {
            return f64::INFINITY;
        }
        let (cu, cv) = (&self.candidates[u.candidate as usize], &self.candidates[v.candidate as usize]);
        let mismatch = if self.at_corner(edge) {
            0.0
        } else {
            match estimate(cu, cv, edge.level, self.options) {
                Some(cost) => cost,
                None => return f64::INFINITY,
            }
        };
        base + mismatch + self.sign_cost(edge)
    }

    fn sign_cost(&self, edge: Edge) -> f64 {
        let (u, v) = (&self.nodes[edge.from as usize], &self.nodes[edge.to as usize]);
        if edge.level >= Continuity::G2 && u.sign[1] != v.sign[0] { self.options.inflection_cost } else { 0.0 }
    }

    fn base(&self, edge: Edge) -> f64 {
        let sample = self.nodes[edge.from as usize].last as usize;
        self.levels(sample).find(|l| l.0 == edge.level).map_or(f64::INFINITY, |l| l.1)
    }

    /// Whether an edge joins at a corner.
    pub(crate) fn at_corner(&self, edge: Edge) -> bool {
        edge.level == Continuity::G0 && self.corner[self.nodes[edge.from as usize].last as usize]
    }

    /// Whether an edge has been verified.
    pub(crate) fn is_verified(&self, edge: Edge) -> bool {
        self.learnt.contains_key(&edge)
    }

    /// Notes what verification found: the extra cost of deviation. True if the edge got dearer.
    pub(crate) fn learn(&mut self, edge: Edge, deviation: f64) -> bool {
        let base = self.base(edge);
        let before = self.estimated(edge, base);
        let actual = base + deviation + self.sign_cost(edge);
        let dearer = !(actual <= before + 1e-9 * before.abs() + 1e-9);
        self.learnt.insert(edge, if dearer { actual } else { before });
        self.touched[edge.from as usize] = true;
        dearer
    }

    /// Forbids an edge.
    pub(crate) fn forbid(&mut self, edge: Edge) {
        self.learnt.insert(edge, f64::INFINITY);
        self.touched[edge.from as usize] = true;
    }

    /// What an edge costs now.
    pub(crate) fn cost_now(&mut self, edge: Edge) -> f64 {
        let base = self.base(edge);
        self.edge_cost(edge, base)
    }
}

/// The logical signs of a curved candidate: those of its curvature, and where that vanishes at one end, the other's.
fn signs(c: &Candidate) -> [i8; 2] {
    let of = |k: f64| if k > 0.0 { 1 } else { -1 };
    let (a, b) = (c.primitive.kappa, c.curvature_at_end());
    let negligible = 1e-9 * (a.abs() + b.abs());
    let start = if a.abs() > negligible { of(a) } else { of(b) };
    let end = if b.abs() > negligible { of(b) } else { of(a) };
    [start, end]
}

/// The way on from a node.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Onward {
    Nowhere,
    Target,
    To(u32, Continuity),
}

/// Where a search ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goal {
    /// At the last sample of the track.
    End,
    /// Once around, at the node where it began.
    Around(u32),
}

/// Distances of all nodes to the target.
pub(crate) struct Distances {
    /// Cost of the node and of everything after it.
    to_target: Vec<f64>,
    onward: Vec<Onward>,
    /// Nodes by start, nearest to the target first.
    order: Vec<Vec<u32>>,
    /// Nodes whose way on leads to a node.
    leading_to: Vec<Vec<u32>>,
    /// Nodes whose distances repairs have left too short.
    stale: Vec<u32>,
    goal: Goal,
    /// The sample from which positions are counted, and the one at which the search ends.
    origin: usize,
    target: usize,
    turn: usize,
}

impl Distances {
    /// Computes all distances to the goal, from the last position back.
    pub(crate) fn new(graph: &mut Graph, goal: Goal) -> Self {
        let n = graph.nodes.len();
        let turn = graph.starts.len();
        let origin = match goal {
            Goal::End => 0,
            Goal::Around(node) => graph.nodes[node as usize].first as usize,
        };
        let mut d = Self {
            to_target: vec![f64::INFINITY; n],
            onward: vec![Onward::Nowhere; n],
            order: vec![Vec::new(); turn],
            leading_to: vec![Vec::new(); n],
            stale: Vec::new(),
            goal,
            origin,
            target: origin + turn,
            turn,
        };
        for position in (origin..origin + turn).rev() {
            let sample = position % turn;
            let nodes = match goal {
                Goal::Around(node) if position == origin => node as usize..node as usize + 1,
                _ => graph.starting_at(sample),
            };
            for node in nodes.clone() {
                let (cost, onward) = d.best_onward(graph, node as u32);
                d.to_target[node] = cost;
                d.set_onward(node as u32, onward);
            }
            let mut list: Vec<u32> = nodes.map(|i| i as u32).collect();
            list.retain(|&i| d.to_target[i as usize].is_finite());
            list.sort_by(|&a, &b| d.to_target[a as usize].total_cmp(&d.to_target[b as usize]).then(a.cmp(&b)));
            d.order[sample] = list;
        }
        d
    }

    /// Where a node starts, counted on from the origin.
    fn position(&self, node: &Node) -> usize {
        let first = node.first as usize;
        if first < self.origin { first + self.turn } else { first }
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

    fn best_onward(&self, graph: &mut Graph, node: u32) -> (f64, Onward) {
        let this = graph.nodes[node as usize];
        let start = self.position(&this);
        let end = start + (this.last - this.first) as usize;
        if self.goal == Goal::End && end == self.target {
            return (this.cost, Onward::Target);
        }
        let (mut best, mut onward) = (f64::INFINITY, Onward::Nowhere);
        for (level, base) in graph.levels(end) {
            let overlap = overlap(level, graph.options);
            if end < start + overlap + 1 {
                continue;
            }
            let next_start = end - overlap;
            if next_start >= self.target {
                if let (Goal::Around(home), true) = (self.goal, next_start == self.target) {
                    let cost = graph.edge_cost(Edge { from: node, to: home, level }, base);
                    if cost < best {
                        (best, onward) = (cost, Onward::To(home, level));
                    }
                }
                continue;
            }
            for &next in &self.order[next_start % self.turn] {
                let ahead = self.to_target[next as usize];
                if base + ahead >= best {
                    break;
                }
                // Those that end no later than this one would not move on.
                let span = graph.nodes[next as usize].last - graph.nodes[next as usize].first;
                if next_start + span as usize <= end {
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
        let mut open: BTreeSet<(usize, u32)> =
            from.into_iter().map(|i| (self.position(&graph.nodes[i as usize]), i)).collect();
        let sources: Vec<usize> = open.iter().map(|o| o.0).collect();
        while let Some((position, node)) = open.pop_last() {
            let (cost, onward) = self.best_onward(graph, node);
            let before = self.to_target[node as usize];
            self.set_onward(node, onward);
            if cost == before {
                continue;
            }
            self.to_target[node as usize] = cost;
            let list = &mut self.order[position % self.turn];
            list.retain(|&i| i != node);
            if cost.is_finite() {
                let to_target = &self.to_target;
                let place =
                    list.partition_point(|&i| to_target[i as usize].total_cmp(&cost).then(i.cmp(&node)).is_lt());
                list.insert(place, node);
            }
            if self.goal != Goal::Around(node) {
                // The nearest source at or after a place decides whether it is within reach.
                let within = |place: usize| {
                    reach == usize::MAX
                        || sources.get(sources.partition_point(|&s| s < place)).is_some_and(|s| s - place <= reach)
                };
                let leading = self.leading_to[node as usize].iter();
                for &i in leading {
                    let place = self.position(&graph.nodes[i as usize]);
                    if within(place) {
                        open.insert((place, i));
                    } else {
                        self.stale.push(i);
                    }
                }
            }
        }
    }

    /// Brings all distances up to date that repairs have left behind, and those of `from`, whose edges got dearer. Costs only grow, so
    /// what leads to nothing that got dearer stays the shortest.
    pub(crate) fn settle(&mut self, graph: &mut Graph, from: Option<u32>) {
        let stale = std::mem::take(&mut self.stale);
        self.repair(graph, stale.into_iter().chain(from), usize::MAX);
    }

    /// The shortest path to the goal by A* (Hart, Nilsson and Raphael 1968), for distances that have become too short since they were
    /// computed: costs only grow, so they are an admissible heuristic.
    pub(crate) fn a_star(&self, graph: &mut Graph) -> Option<Path> {
        let mut reached = Reached::new();
        let mut open = BinaryHeap::new();
        for &start in &self.order[self.origin] {
            reached.insert(start, (0.0, None));
            open.push(Reverse(Estimate { total: self.to_target[start as usize], node: start, arrived: None }));
        }
        let mut settled = HashSet::new();
        while let Some(Reverse(Estimate { total, node, arrived })) = open.pop() {
            if let Some(closing) = arrived {
                return Some(self.traced(node, closing, total, &reached));
            }
            if !settled.insert(node) {
                continue;
            }
            let this = graph.nodes[node as usize];
            let before = reached[&node].0 + this.cost;
            let start = self.position(&this);
            let end = start + (this.last - this.first) as usize;
            if self.goal == Goal::End && end == self.target {
                open.push(Reverse(Estimate { total: before, node, arrived: Some(Continuity::G0) }));
                continue;
            }
            for (level, base) in graph.levels(end) {
                let overlap = overlap(level, graph.options);
                if end < start + overlap + 1 {
                    continue;
                }
                let next_start = end - overlap;
                if let (Goal::Around(home), true) = (self.goal, next_start == self.target) {
                    let cost = before + graph.edge_cost(Edge { from: node, to: home, level }, base);
                    if cost.is_finite() {
                        open.push(Reverse(Estimate { total: cost, node, arrived: Some(level) }));
                    }
                }
                if next_start >= self.target {
                    continue;
                }
                for &next in &self.order[next_start % self.turn] {
                    let span = graph.nodes[next as usize].last - graph.nodes[next as usize].first;
                    if next_start + span as usize <= end || settled.contains(&next) {
                        continue;
                    }
                    let cost = before + graph.edge_cost(Edge { from: node, to: next, level }, base);
                    if cost.is_finite() && reached.get(&next).is_none_or(|r| cost < r.0) {
                        reached.insert(next, (cost, Some((node, level))));
                        let total = cost + self.to_target[next as usize];
                        open.push(Reverse(Estimate { total, node: next, arrived: None }));
                    }
                }
            }
        }
        None
    }

    /// The path by which A* came to its last node.
    fn traced(&self, last: u32, closing: Continuity, cost: f64, reached: &Reached) -> Path {
        let (mut nodes, mut joins) = (vec![last], Vec::new());
        if let Goal::Around(_) = self.goal {
            joins.push(closing);
        }
        let mut node = last;
        while let Some((before, level)) = reached[&node].1 {
            nodes.push(before);
            joins.push(level);
            node = before;
        }
        nodes.reverse();
        joins.reverse();
        Path { nodes, joins, cost }
    }

    /// The shortest path to the goal.
    pub(crate) fn path(&self) -> Option<Path> {
        let start = *self.order[self.origin].first()?;
        let mut path = Path { nodes: vec![start], joins: Vec::new(), cost: self.to_target[start as usize] };
        let mut node = start;
        loop {
            match self.onward[node as usize] {
                Onward::Target => return Some(path),
                Onward::To(next, level) => {
                    path.joins.push(level);
                    if self.goal == Goal::Around(next) {
                        return Some(path);
                    }
                    path.nodes.push(next);
                    node = next;
                }
                Onward::Nowhere => return None,
            }
        }
    }
}

/// The cost of everything before a node, and the node and join before it.
type Reached = HashMap<u32, (f64, Option<(u32, Continuity)>)>;

/// A node that A* has yet to visit, by the length of the best path through it.
#[derive(Clone, Copy, Debug)]
struct Estimate {
    total: f64,
    node: u32,
    /// The join by which the goal is reached from `node`, if this is the goal.
    arrived: Option<Continuity>,
}

impl PartialEq for Estimate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Estimate {}

impl PartialOrd for Estimate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Estimate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.total.total_cmp(&other.total).then(self.node.cmp(&other.node)).then(self.arrived.cmp(&other.arrived))
    }
}

/// A sequence of nodes. A cycle has one join more than an open path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Path {
    pub(crate) nodes: Vec<u32>,
    pub(crate) joins: Vec<Continuity>,
    pub(crate) cost: f64,
}

impl Path {
    pub(crate) fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let n = self.nodes.len();
        self.joins.iter().enumerate().map(move |(i, &level)| Edge {
            from: self.nodes[i],
            to: self.nodes[(i + 1) % n],
            level,
        })
    }
}
