//! The graph of candidates (section 3.4 of Baran et al. 2010).
//!
//! Edges are not stored: a candidate that ends at sample e can only be followed by those that start at e less the overlap, so all of
//! them are implied by indices and their costs are computed when a search asks for them.

use super::candidates::Candidate;
use super::hold::{self, Hold};
use super::transition::{Door, at_least, estimate, possible};
use crate::options::FitOptions;
use crate::track::Track;
use fairpath_curve::{Continuity, Kind};

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

impl Node {
    /// Sample intervals that it covers.
    pub(super) fn span(&self) -> usize {
        (self.last - self.first) as usize
    }
}

/// A transition between nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Edge {
    pub(crate) from: u32,
    pub(crate) to: u32,
    pub(crate) level: Continuity,
}

/// The cost of an edge that verification taught, infinite if it is forbidden, and the note before about edges from the same node.
struct Note {
    to: u32,
    level: Continuity,
    cost: f64,
    older: u32,
}

/// Candidates, nodes and what is known about edges.
pub(crate) struct Graph<'a> {
    pub(crate) candidates: &'a [Candidate],
    pub(crate) nodes: Vec<Node>,
    /// How each candidate begins and ends.
    heads: Vec<Door>,
    tails: Vec<Door>,
    corner: &'a [bool],
    held: &'a [Option<Hold>; 2],
    pub(super) options: &'a FitOptions,
    /// Nodes that start at each sample.
    starts: Vec<std::ops::Range<usize>>,
    /// What verification taught, and for each node the newest of what concerns edges from there: its place, counted from one.
    notes: Vec<Note>,
    newest: Vec<u32>,
    /// Whether it was verified how each node joins what the start and the end of the stroke are held by.
    held_verified: Vec<[bool; 2]>,
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
        for node in &mut nodes {
            let c = &candidates[node.candidate as usize];
            node.cost += [0, 1].map(|side| hold::cost(track, c, node.sign, side, options)).iter().sum::<f64>();
        }
        let newest = vec![0; nodes.len()];
        Self {
            held_verified: vec![[false; 2]; nodes.len()],
            candidates,
            nodes,
            heads: candidates.iter().map(|c| Door::head(c, options)).collect(),
            tails: candidates.iter().map(|c| Door::tail(c, options)).collect(),
            corner: &track.corner,
            held: &track.held,
            options,
            starts,
            notes: Vec::new(),
            newest,
            computed: 0,
        }
    }

    /// Sample intervals in the stroke, or in one turn of a ring.
    pub(crate) fn turn(&self) -> usize {
        self.starts.len()
    }

    pub(crate) fn starting_at(&self, sample: usize) -> std::ops::Range<usize> {
        self.starts[sample].clone()
    }

    /// The continuities that may follow a node that ends at `sample`, with their base cost.
    pub(super) fn levels(&self, sample: usize) -> impl Iterator<Item = (Continuity, f64)> + use<> {
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

    pub(super) fn edge_cost(&mut self, edge: Edge, base: f64) -> f64 {
        if let Some(cost) = self.learnt(edge) {
            return cost;
        }
        self.computed += 1;
        self.estimated(edge, base)
    }

    /// A bound from below of what a join adds to its base cost, infinite where it is impossible.
    #[inline]
    pub(super) fn bound(&self, from: u32, to: u32, level: Continuity) -> f64 {
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
        base + self.expected_deviation(edge) + self.sign_cost(edge)
    }

    /// The extra cost of deviation that a join is expected to bring; infinite where it would move both candidates too far.
    pub(crate) fn expected_deviation(&self, edge: Edge) -> f64 {
        if self.at_corner(edge) {
            return 0.0;
        }
        let [u, v] = [edge.from, edge.to].map(|i| &self.candidates[self.nodes[i as usize].candidate as usize]);
        estimate(u, v, edge.level, self.options).unwrap_or(f64::INFINITY)
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
        self.learnt(edge).is_some()
    }

    fn learnt(&self, edge: Edge) -> Option<f64> {
        let mut place = self.newest[edge.from as usize];
        while place > 0 {
            let note = &self.notes[place as usize - 1];
            if (note.to, note.level) == (edge.to, edge.level) {
                return Some(note.cost);
            }
            place = note.older;
        }
        None
    }

    fn note(&mut self, edge: Edge, cost: f64) {
        let newest = &mut self.newest[edge.from as usize];
        self.notes.push(Note { to: edge.to, level: edge.level, cost, older: *newest });
        *newest = self.notes.len() as u32;
    }

    /// Notes what verification found: the extra cost of deviation. True if the edge got dearer.
    pub(crate) fn learn(&mut self, edge: Edge, deviation: f64) -> bool {
        let base = self.base(edge);
        let before = self.estimated(edge, base);
        let actual = base + deviation + self.sign_cost(edge);
        let dearer = !(actual <= before + 1e-9 * before.abs() + 1e-9);
        self.note(edge, if dearer { actual } else { before });
        dearer
    }

    /// Whether it was verified how a node joins what the stroke's start or end is held by.
    pub(crate) fn is_held_verified(&self, node: u32, side: usize) -> bool {
        self.held_verified[node as usize][side]
    }

    /// Notes what verification found about that: the extra cost of deviation. True if the node got dearer.
    pub(crate) fn learn_held(&mut self, node: u32, side: usize, deviation: f64) -> bool {
        self.held_verified[node as usize][side] = true;
        let node = &mut self.nodes[node as usize];
        let expected =
            hold::expected(self.held[side].as_ref(), &self.candidates[node.candidate as usize], side, self.options);
        let dearer = !(deviation <= expected + 1e-9 * expected.abs() + 1e-9);
        if dearer {
            node.cost += deviation - expected;
        }
        dearer
    }

    /// Forbids an edge.
    pub(crate) fn forbid(&mut self, edge: Edge) {
        self.note(edge, f64::INFINITY);
    }

    /// Makes the joins of a path dearer, each by its share.
    pub(crate) fn burden(&mut self, path: &Path, by: f64) {
        if path.joins.is_empty() {
            self.nodes[path.nodes[0] as usize].cost += by;
        }
        let share = by / path.joins.len() as f64;
        for edge in path.edges() {
            let cost = self.cost_now(edge) + share;
            self.note(edge, cost);
        }
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

/// A sequence of nodes. A cycle has one join more than an open path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Path {
    pub(crate) nodes: Vec<u32>,
    pub(crate) joins: Vec<Continuity>,
    pub(crate) cost: f64,
}

impl Path {
    pub(crate) fn is_cycle(&self) -> bool {
        self.joins.len() == self.nodes.len()
    }

    pub(crate) fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let n = self.nodes.len();
        self.joins.iter().enumerate().map(move |(i, &level)| Edge {
            from: self.nodes[i],
            to: self.nodes[(i + 1) % n],
            level,
        })
    }
}
