//! Searching forward through the graph by A* (Hart, Nilsson and Raphael 1968).
//!
//! Distances to the target serve as its heuristic. Costs of joins only grow, so distances that were computed before stay bounds from
//! below.

use super::distances::Distances;
use super::graph::{Edge, Graph, Path};
use super::transition::overlap;
use fairpath_curve::Continuity;
use std::cmp::{Ordering, Reverse};
use std::collections::{BinaryHeap, HashMap, HashSet};

/// Where a search may stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Place {
    /// On its way, before a node.
    Before(u32),
    /// At the gate from which it sets out, and at the one where it ends.
    Leaving(u32),
    At(u32),
    /// At the end of the track, after its last node.
    End(u32),
}

/// A place that is yet to be visited, by a bound from below of the cost of the best path through it.
#[derive(Clone, Copy, Debug)]
struct Open {
    total: f64,
    place: Place,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        self.total.total_cmp(&other.total).then(self.place.cmp(&other.place))
    }
}

/// The cost of everything before a place, and the place and join before it.
type Reached = HashMap<Place, (f64, Option<(Place, Continuity)>)>;

/// The shortest path to the goal, if it costs less than `below`: from the first sample to the last, or from `gate` once around to itself.
pub(crate) fn a_star(distances: &Distances, graph: &mut Graph, gate: Option<u32>, below: f64) -> Option<Path> {
    let from = match gate {
        Some(gate) => vec![gate],
        None => distances.order[distances.origin].clone(),
    };
    let mut found = None;
    let reached = explore(distances, graph, &from, below, |place, total| {
        let home = match place {
            Place::At(g) => Some(g) == gate,
            _ => true,
        };
        if home {
            found = Some((place, total));
        }
        home
    });
    found.map(|(place, cost)| traced(place, cost, &reached))
}

/// The gates that can be arrived at from any gate with a path that costs less than `below`, prices included.
pub(crate) fn arrivals(distances: &Distances, graph: &mut Graph, from: &[u32], below: f64) -> Vec<u32> {
    let mut arrived = Vec::new();
    explore(distances, graph, from, below, |place, _| {
        if let Place::At(gate) = place {
            arrived.push(gate);
        }
        false
    });
    arrived
}

/// Visits places in the order of the cost of the best path through them, up to `below`, and tells `arrived` of those where a path
/// may end, until that has enough.
fn explore(
    distances: &Distances,
    graph: &mut Graph,
    from: &[u32],
    below: f64,
    mut arrived: impl FnMut(Place, f64) -> bool,
) -> Reached {
    let mut reached = Reached::new();
    let mut open = BinaryHeap::new();
    for &start in from {
        let (place, before, total) = match distances.gates.get(&start) {
            Some(gate) => (Place::Leaving(start), -gate.price, distances.bound_through(start)),
            None => (Place::Before(start), 0.0, distances.to_target[start as usize]),
        };
        if total < below {
            reached.insert(place, (before, None));
            open.push(Reverse(Open { total, place }));
        }
    }
    let mut settled = HashSet::new();
    while let Some(Reverse(Open { total, place })) = open.pop() {
        if !settled.insert(place) {
            continue;
        }
        let end = |node: u32| distances.end(&graph.nodes[node as usize]);
        let (node, end) = match place {
            Place::Before(node) => (node, end(node)),
            Place::Leaving(gate) => (gate, end(gate) - distances.turn),
            Place::At(_) | Place::End(_) if arrived(place, total) => break,
            Place::At(_) | Place::End(_) => continue,
        };
        let this = graph.nodes[node as usize];
        let before = reached[&place].0 + this.cost;
        if distances.gates.is_empty() && end == distances.target {
            reached.insert(Place::End(node), (before, None));
            open.push(Reverse(Open { total: before, place: Place::End(node) }));
            continue;
        }
        for (level, base) in graph.levels(end) {
            let overlap = overlap(level, graph.options);
            if this.span() <= overlap || end < distances.origin + overlap {
                continue;
            }
            let next_start = end - overlap;
            if next_start >= distances.target {
                continue;
            }
            for &next in &distances.order[next_start % distances.turn] {
                let ahead = distances.to_target[next as usize];
                if before + base + ahead >= below {
                    break;
                }
                if next_start + graph.nodes[next as usize].span() <= end {
                    continue;
                }
                let gate = distances.gates.get(&next).map(|g| (Place::At(next), g.price));
                let on = (Place::Before(next), distances.to_target[next as usize]);
                for (there, ahead) in [Some(on), gate].into_iter().flatten() {
                    if settled.contains(&there) {
                        continue;
                    }
                    let cost = before + graph.edge_cost(Edge { from: node, to: next, level }, base);
                    if cost + ahead < below && reached.get(&there).is_none_or(|r| cost < r.0) {
                        reached.insert(there, (cost, Some((place, level))));
                        open.push(Reverse(Open { total: cost + ahead, place: there }));
                    }
                }
            }
        }
    }
    reached
}

/// The path by which a search came to its last place.
fn traced(last: Place, cost: f64, reached: &Reached) -> Path {
    let (mut nodes, mut joins) = (Vec::new(), Vec::new());
    let mut place = last;
    loop {
        match place {
            Place::Before(node) | Place::Leaving(node) => nodes.push(node),
            Place::End(node) => {
                place = Place::Before(node);
                continue;
            }
            Place::At(_) => {}
        }
        let Some((before, level)) = reached[&place].1 else { break };
        joins.push(level);
        place = before;
    }
    nodes.reverse();
    joins.reverse();
    Path { nodes, joins, cost }
}
