//! Which part of which template goes where (McCrae and Singh 2011, sections 3.2 and 3.3): turnings of a stroke in, breaks and
//! places on the templates out.
//!
//! The paper fills a matrix over all pairs of points by equation 5, and for each pair slides a window along all templates. Its minimum is a
//! sum over the pieces between successive breaks, and the error of a piece is a sum over its steps once its place on a template is chosen. So the best
//! way to be at each node of each template after each step of the stroke needs only the best ways one step before: to have been one node before, or
//! to have begun a piece there. That finds the same minimum in a time of steps × nodes instead of the third power of steps times nodes.

use super::guide::Guide;

/// A part of a stroke and the place on a guide from which it is covered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Section {
    /// Nodes of the stroke.
    pub(crate) first: usize,
    pub(crate) last: usize,
    pub(crate) guide: usize,
    /// Node of the guide at the section's first.
    pub(crate) node: usize,
}

/// The sections with the least sum of errors (equations 3 and 4) and of `piece_cost` for each, and that sum, radians.
///
/// A section ends where a gate of its guide is open, and follows an open guide within its ends and a closed one round and round.
pub(crate) fn sections(turnings: &[f64], guides: &[Guide], piece_cost: f64) -> (Vec<Section>, f64) {
    let n = turnings.len();
    let mut states: Vec<State> = guides.iter().map(State::new).collect();
    let mut best = vec![f64::INFINITY; n + 1];
    let mut before = vec![Section { first: 0, last: 0, guide: 0, node: 0 }; n + 1];
    best[0] = 0.0;
    for (j, &turning) in turnings.iter().enumerate() {
        let enter = best[j] + piece_cost;
        for (g, (state, guide)) in states.iter_mut().zip(guides).enumerate() {
            state.step(guide, turning, enter, j as u32);
            let Some((value, node)) = state.least(guide) else { continue };
            if value < best[j + 1] {
                best[j + 1] = value;
                let first = state.since[node] as usize;
                before[j + 1] = Section { first, last: j + 1, guide: g, node: back(guide, node, j + 1 - first) };
            }
        }
    }
    let mut out = Vec::new();
    let mut at = n;
    while at > 0 {
        out.push(before[at]);
        at = before[at].first;
    }
    out.reverse();
    (out, best[n])
}

/// The node so many steps before another.
fn back(guide: &Guide, node: usize, steps: usize) -> usize {
    if guide.is_closed() {
        let m = guide.cells();
        (node + m - steps % m) % m
    } else {
        node - steps
    }
}

/// For each node of a guide the least cost of being there with the piece that is being made, and the node of the stroke where that began.
struct State {
    value: Vec<f64>,
    since: Vec<u32>,
}

impl State {
    fn new(guide: &Guide) -> Self {
        Self { value: vec![f64::INFINITY; guide.gate.len()], since: vec![0; guide.gate.len()] }
    }

    /// One step along the stroke, on which it turns by `turning`; a piece may begin for `enter` at stroke node `j`.
    fn step(&mut self, guide: &Guide, turning: f64, enter: f64, j: u32) {
        let cells = guide.cells();
        let (value, since) = (&mut self.value[..], &mut self.since[..]);
        let stepped = |value: &[f64], since: &[u32], k: usize| {
            let begun = enter + guide.gate[k];
            let (v, s) = if begun < value[k] { (begun, j) } else { (value[k], since[k]) };
            (v + (turning - guide.turnings[k]).abs(), s)
        };
        let across = stepped(value, since, cells - 1);
        for k in (1..cells).rev() {
            (value[k], since[k]) = stepped(value, since, k - 1);
        }
        if guide.is_closed() {
            (value[0], since[0]) = across;
        } else {
            (value[cells], since[cells]) = across;
            value[0] = f64::INFINITY;
        }
    }

    /// The least cost at a node where a piece may end.
    fn least(&self, guide: &Guide) -> Option<(f64, usize)> {
        let mut found = (f64::INFINITY, 0);
        for (k, (value, gate)) in self.value.iter().zip(&guide.gate).enumerate() {
            if value + gate < found.0 {
                found = (*value, k);
            }
        }
        (found.0 < f64::INFINITY).then_some(found)
    }
}
