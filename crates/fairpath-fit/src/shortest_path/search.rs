//! Finding a path whose joins hold (section 3.5 of Baran et al. 2010): the shortest path is verified join by join, joins that turn out
//! dearer than estimated are repriced, and the search is repeated until nothing changes.

use super::a_star::a_star;
use super::candidates::{Candidate, penalty};
use super::chain::{Chain, KAPPA0, Measured, Piece, Pin, Shortness};
use super::cycle::shortest_cycle;
use super::distances::{Distances, Goal};
use super::graph::{Edge, Graph, Node, Path};
use super::hold::Hold;
use super::merge::{Effort, Verdict, merge_until};
use super::transition::overlap;
use crate::options::{ClosedSearch, FitOptions, Search};
use crate::parallel;
use crate::track::{Course, Shape, Track};
use fairpath_curve::{Continuity, Kind};

/// Effort of verifying one join.
const VERIFY: Effort = Effort { rounds: 5, tolerance: 3e-2 };

/// The shortest path through the graph whose joins have all been verified, if it costs less than `below`.
pub(crate) fn search(graph: &mut Graph, verifier: &mut Verifier, below: f64) -> Option<Path> {
    let path = match (verifier.track.shape, verifier.options.closed_search) {
        (Shape::Open | Shape::Loop, _) => verified(graph, &Goal::End, verifier),
        (Shape::Ring, ClosedSearch::Exact) => shortest_cycle(graph, verifier, below),
        (Shape::Ring, ClosedSearch::ThreeRounds) => three_rounds(graph, verifier),
    };
    path.filter(|p| p.cost < below)
}

/// A cycle found by searching once around from the node in the middle of what was found before, three times (section 3.5).
pub(super) fn three_rounds(graph: &mut Graph, verifier: &mut Verifier) -> Option<Path> {
    let open = Distances::new(graph, &Goal::End).path()?;
    let mut best: Option<Path> = None;
    let mut from = middle(graph, &open);
    for _ in 0..3 {
        let once_around = Goal::around(graph, from);
        let Some(path) = verified(graph, &once_around, verifier) else { break };
        from = middle(graph, &path);
        // The path found before passes through this node too: no gain means that it was the best already.
        if best.as_ref().is_some_and(|b| path.cost >= b.cost - 1e-9) {
            break;
        }
        best = Some(path);
    }
    best
}

/// The node of a path that covers the place half a turn from its start.
fn middle(graph: &Graph, path: &Path) -> u32 {
    let turn = graph.turn();
    let start = graph.nodes[path.nodes[0] as usize].first as usize;
    let wanted = turn / 2;
    let at = |i: &&u32| {
        let n = &graph.nodes[**i as usize];
        let from = (n.first as usize + turn - start) % turn;
        let centre = from + (n.last - n.first) as usize / 2;
        centre.abs_diff(wanted)
    };
    *path.nodes.iter().min_by_key(at).unwrap_or(&path.nodes[0])
}

/// The shortest path to the goal whose joins have been verified, as far as `validation_rounds` allow.
pub(super) fn verified(graph: &mut Graph, goal: &Goal, verifier: &mut Verifier) -> Option<Path> {
    let options = verifier.options;
    let mut distances = Distances::new(graph, goal);
    let mut path = distances.path()?;
    if options.search == Search::AStar {
        let gate = distances.gates.keys().next().copied();
        let most = options.validation_rounds * ROUNDS_NEARBY;
        for run in 1..=most {
            if verifier.reprice(graph, &path).is_empty() {
                break;
            }
            if run % RUNS_BETWEEN == 0 {
                distances = Distances::new(graph, goal);
            }
            path = a_star(&distances, graph, gate, f64::INFINITY)?;
        }
    }
    for _ in 0..options.validation_rounds {
        // Joins are verified with distances repaired nearby; when the path holds, all distances are brought up to date, and it
        // is done if the path still holds.
        let mut changed = false;
        for _ in 0..ROUNDS_NEARBY {
            let dearer = verifier.reprice(graph, &path);
            if dearer.is_empty() {
                break;
            }
            changed = true;
            distances.repair(graph, dearer, REPAIR_REACH);
            path = distances.path()?;
        }
        if !changed {
            break;
        }
        distances.settle(graph, None);
        path = distances.path()?;
    }
    // What the last round left unverified is taken as estimated, but what cannot be merged at all is avoided.
    while !verifier.avoid_pinching(graph, &path).is_empty() {
        distances = Distances::new(graph, goal);
        path = distances.path()?;
    }
    Some(path)
}

/// Runs of A* after which its heuristic is computed anew.
const RUNS_BETWEEN: usize = 4;

/// Most rounds of verification between two searches of the whole.
pub(super) const ROUNDS_NEARBY: usize = 12;

/// Samples before a join that got dearer, within which distances are repaired at once.
pub(super) const REPAIR_REACH: usize = 15;

/// Verifies joins, and counts how many.
pub(super) struct Verifier<'a> {
    track: &'a Track,
    pub(super) options: &'a FitOptions,
    pub(super) verifications: usize,
}

impl<'a> Verifier<'a> {
    pub(super) fn new(track: &'a Track, options: &'a FitOptions) -> Self {
        Self { track, options, verifications: 0 }
    }

    /// Verifies the joins of a path; the nodes whose onward joins got dearer.
    pub(super) fn reprice(&mut self, graph: &mut Graph, path: &Path) -> Vec<u32> {
        let mut dearer = self.avoid_pinching(graph, path);
        // Two curves that end at a corner meet near it whatever they are: there is nothing to enforce.
        let open: Vec<Edge> = path.edges().filter(|e| !graph.is_verified(*e) && !graph.at_corner(*e)).collect();
        self.verifications += open.len();
        let known: &Graph = graph;
        let deviations = parallel::map(&open, |edge| verify(known, *edge, self.track, self.options));
        for (edge, deviation) in open.into_iter().zip(deviations) {
            if graph.learn(edge, deviation) {
                dearer.push(edge.from);
            }
        }
        dearer.extend(self.reprice_held(graph, path));
        dearer
    }

    /// Verifies how a path joins what its ends are held by (section 3.7); the nodes that got dearer.
    fn reprice_held(&mut self, graph: &mut Graph, path: &Path) -> Vec<u32> {
        let mut dearer = Vec::new();
        for (side, node) in [path.nodes[0], path.nodes[path.nodes.len() - 1]].into_iter().enumerate() {
            let Some(hold) = &self.track.held[side] else { continue };
            if graph.is_held_verified(node, side) {
                continue;
            }
            self.verifications += 1;
            let deviation = verify_held(graph, node, side, hold, self.track, self.options);
            if graph.learn_held(node, side, deviation) {
                dearer.push(node);
            }
        }
        dearer
    }

    /// Forbids a join of a path that cannot be merged; the node before it.
    pub(super) fn avoid_pinching(&self, graph: &mut Graph, path: &Path) -> Vec<u32> {
        let edge = pinched(graph, path);
        edge.inspect(|edge| graph.forbid(*edge)).map(|edge| edge.from).into_iter().collect()
    }
}

/// The dearer of two G2 joins with which lines on both sides would straighten a clothoid.
fn pinched(graph: &mut Graph, path: &Path) -> Option<Edge> {
    let edges: Vec<Edge> = path.edges().collect();
    let kind = |graph: &Graph, node: u32| graph.candidates[graph.nodes[node as usize].candidate as usize].kind;
    let n = edges.len();
    let pairs = if path.is_cycle() { n } else { n.saturating_sub(1) };
    for i in 0..pairs {
        let (a, b) = (edges[i], edges[(i + 1) % n]);
        if a.level == Continuity::G2
            && b.level == Continuity::G2
            && kind(graph, a.from) == Kind::Line
            && kind(graph, a.to) == Kind::Clothoid
            && kind(graph, b.to) == Kind::Line
        {
            return Some(if graph.cost_now(a) > graph.cost_now(b) { a } else { b });
        }
    }
    None
}

/// Enforces one join between its two candidates and gives the extra cost of deviation that results; infinite where they cannot be
/// joined.
fn verify(graph: &Graph, edge: Edge, track: &Track, options: &FitOptions) -> f64 {
    let ends = [edge.from, edge.to].map(|i| graph.nodes[i as usize]);
    let (u, v) = (&graph.candidates[ends[0].candidate as usize], &graph.candidates[ends[1].candidate as usize]);
    let mut chain = chain(graph.candidates, &ends, vec![edge.level], None, &track.coarse, [None; 2], options);
    let extra = |measured: &Measured| {
        let (a, b) = (measured.normals[0].deviation(options), measured.normals[1].deviation(options));
        (penalty(a, options) - u.penalty).max(0.0) + (penalty(b, options) - v.penalty).max(0.0)
    };
    // Below the estimate it does not matter by how much.
    let expected = graph.expected_deviation(edge);
    let judge = |_: &Chain, measured: &Measured, _: usize| {
        if extra(measured) <= expected { Verdict::Enough } else { Verdict::GoOn }
    };
    merge_until(&mut chain, VERIFY, judge).map_or(f64::INFINITY, |measured| extra(&measured))
}

/// As [`verify`], of a candidate and what the end of the stroke is held by.
fn verify_held(graph: &Graph, node: u32, side: usize, hold: &Hold, track: &Track, options: &FitOptions) -> f64 {
    let node = graph.nodes[node as usize];
    let before = graph.candidates[node.candidate as usize].penalty;
    let mut held = [None; 2];
    held[side] = Some(hold.pin);
    let mut chain = chain(graph.candidates, &[node], Vec::new(), None, &track.coarse, held, options);
    let measured = merge_until(&mut chain, VERIFY, |_, _, _| Verdict::GoOn);
    measured.map_or(f64::INFINITY, |m| (penalty(m.normals[0].deviation(options), options) - before).max(0.0))
}

/// The chain of a sequence of nodes, each trimmed to the middle of its overlaps (section 3.6), along the points of `course`. If it is
/// the `whole` stroke, its shape and the samples in one turn tell how it closes; `held` ends begin and end it exactly.
pub(crate) fn chain<'a>(
    candidates: &[Candidate],
    nodes: &[Node],
    joins: Vec<Continuity>,
    whole: Option<(Shape, usize)>,
    course: &'a Course,
    held: [Option<Pin>; 2],
    options: &FitOptions,
) -> Chain<'a> {
    let n = nodes.len();
    let before = |k: usize| if k > 0 { Some(joins[k - 1]) } else { joins.get(n - 1).copied() };
    let signs = allowed_signs(candidates, nodes, &joins);
    let mut pieces = Vec::with_capacity(n);
    let mut corners = Vec::new();
    // Positions run on through the start of a ring.
    let mut end = nodes[0].first as usize;
    let mut position = end;
    for (k, node) in nodes.iter().enumerate() {
        let c = &candidates[node.candidate as usize];
        if k > 0 {
            position = end - overlap(joins[k - 1], options);
        }
        end = position + (node.last - node.first) as usize;
        let head = before(k).map_or(0, |j| overlap(j, options));
        let tail = joins.get(k).map_or(0, |&j| overlap(j, options));
        let from = match head {
            0 => c.head[0].s,
            1 => 0.5 * (c.head[0].s + c.head[1].s),
            _ => c.head[1].s,
        };
        let to = match tail {
            0 => c.tail[0].s,
            1 => 0.5 * (c.tail[0].s + c.tail[1].s),
            _ => c.tail[1].s,
        };
        let to = to.max(from + 1.0);
        let part = c.primitive.segment(c.length).subsegment(from, to);
        pieces.push(Piece {
            kind: c.kind,
            q: [part.start.x, part.start.y, part.heading, part.kappa0, part.kappa1, part.length],
            sign: signs[k],
            longest: 3.0 * part.length + 30.0,
        });
        if k + 1 < n && joins[k] == Continuity::G0 {
            corners.push(course.samples[end] - course.samples[nodes[0].first as usize]);
        }
    }
    let start = nodes[0].first as usize;
    let closed = whole.is_some_and(|(shape, _)| shape != Shape::Open);
    let data = match whole {
        // The last datum of a ring is its first.
        Some((Shape::Ring, turn)) => {
            let run = course.run(start, start + turn);
            &run[..run.len() - 1]
        }
        _ => course.run(start, end),
    };
    let stiffness = SHORT_STIFFNESS * options.shortness_cost;
    let short = whole.map(|_| Shortness { length: options.short_length, stiffness });
    for (side, k) in [0, n - 1].into_iter().enumerate() {
        // There the curvature is given.
        if held[side].is_some_and(|pin| pin.count > KAPPA0) {
            pieces[k].sign[side] = 0;
        }
    }
    Chain {
        pieces,
        joins,
        data,
        corners,
        closed,
        end_factor: options.end_factor,
        short,
        max_curvature: options.max_curvature(),
        variation: 0.0,
        pins: [None; 2],
        held,
    }
}

/// Energy for a unit of the cost of shortness, px³.
const SHORT_STIFFNESS: f64 = 0.5;

/// The signs that curvatures must keep so that no inflection arises which the path has not paid for (section 3.8): those of the path,
/// lifted for arcs, for clothoids that inflect anyway, and where a G2 join changes sign.
fn allowed_signs(candidates: &[Candidate], nodes: &[Node], joins: &[Continuity]) -> Vec<[i8; 2]> {
    let n = nodes.len();
    let mut signs: Vec<[i8; 2]> = nodes
        .iter()
        .map(|node| {
            let c = &candidates[node.candidate as usize];
            if c.kind != Kind::Clothoid || node.sign[0] != node.sign[1] { [0, 0] } else { node.sign }
        })
        .collect();
    for (i, &level) in joins.iter().enumerate() {
        let (a, b) = (i, (i + 1) % n);
        if level >= Continuity::G2 && nodes[a].sign[1] != nodes[b].sign[0] {
            signs[a][1] = 0;
            signs[b][0] = 0;
        }
    }
    signs
}
