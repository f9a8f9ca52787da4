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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::french_curve::growth::Growth;
    use crate::french_curve::guide::guides;
    use crate::french_curve::options::{Flips, FrenchCurveOptions};
    use crate::french_curve::template::{Template, TemplateSet};
    use fairpath_curve::{Continuity, Point, Segment, Spline};
    use proptest::prelude::*;

    /// Equations 3 and 4 with every place of every guide tried for itself; infinite if none ends where a piece may.
    fn literal_fit(turnings: &[f64], guides: &[Guide]) -> f64 {
        let mut least = f64::INFINITY;
        for guide in guides {
            let (m, n) = (guide.cells(), turnings.len());
            for u in 0..guide.gate.len() {
                let end = if guide.is_closed() { (u + n) % m } else { u + n };
                if end >= guide.gate.len() || guide.gate[u] + guide.gate[end] > 0.0 {
                    continue;
                }
                let error: f64 = (0..n).map(|c| (turnings[c] - guide.turnings[(u + c) % m]).abs()).sum();
                least = least.min(error);
            }
        }
        least
    }

    /// Equation 5 as it stands.
    fn literal(turnings: &[f64], guides: &[Guide], piece_cost: f64) -> f64 {
        let n = turnings.len();
        let mut m = vec![vec![f64::INFINITY; n + 1]; n + 1];
        for span in 1..=n {
            for i in 0..=n - span {
                let j = i + span;
                let whole = literal_fit(&turnings[i..j], guides) + piece_cost;
                m[i][j] = (i + 1..j).map(|k| m[i][k] + m[k][j]).fold(whole, f64::min);
            }
        }
        m[0][n]
    }

    /// Small templates: bends, an S, a right angle, a circle that is passed more than once.
    fn small_guides() -> impl Strategy<Value = Vec<Guide>> {
        let bend = (3.0..45.0_f64, -0.2..0.2_f64, -0.2..0.2_f64)
            .prop_map(|(length, a, b)| vec![Segment::clothoid(Point::ORIGIN, 0.0, length, a, b)]);
        let angle = (8.0..30.0_f64, -2.0..2.0_f64).prop_map(|(length, turn)| {
            let leg = Segment::line(Point::ORIGIN, 0.0, length);
            vec![leg, Segment::line(leg.end(), turn, 20.0)]
        });
        let open = prop_oneof![bend, angle].prop_map(|segments| {
            let joins = vec![Continuity::G0; segments.len() - 1];
            Spline::new(segments, joins, false).unwrap()
        });
        let wheel = (2.0..8.0_f64).prop_map(|r| {
            let arc = Segment::arc(Point::ORIGIN, 0.0, std::f64::consts::TAU * r, 1.0 / r);
            Spline::new(vec![arc], vec![Continuity::G3], true).unwrap()
        });
        let one = prop_oneof![3 => open, 1 => wheel];
        (prop::collection::vec(one, 1..3), prop_oneof![Just(Flips::None), Just(Flips::Paper), Just(Flips::All)])
            .prop_map(|(splines, flips)| {
                let named = |(i, s): (usize, Spline)| Template::new(i.to_string(), s).unwrap();
                let set = TemplateSet::new("small", splines.into_iter().enumerate().map(named).collect()).unwrap();
                guides(&set, &FrenchCurveOptions { flips, ..FrenchCurveOptions::default() })
            })
    }

    fn turnings() -> impl Strategy<Value = Vec<f64>> {
        // Straight runs and repeated values are where ties lie.
        let turning = prop_oneof![Just(0.0), Just(0.3), -0.5..0.5_f64, -1e-9..1e-9_f64];
        prop::collection::vec(turning, 1..=40)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn the_sections_cost_what_the_literal_recursion_finds(
            turnings in turnings(), guides in small_guides(), piece_cost in 1e-3..1.0_f64,
        ) {
            let (found, cost) = sections(&turnings, &guides, piece_cost);
            let theirs = literal(&turnings, &guides, piece_cost);
            prop_assert!((cost - theirs).abs() < 1e-9 * (1.0 + theirs) || cost == theirs, "{} {}", cost, theirs);
            if theirs.is_finite() {
                // What is given back costs what it says, piece by piece.
                prop_assert_eq!((found[0].first, found[found.len() - 1].last), (0, turnings.len()));
                prop_assert!(found.windows(2).all(|s| s[0].last == s[1].first));
                let error = |s: &Section| -> f64 {
                    let guide = &guides[s.guide];
                    let on_guide = (0..).map(|c| guide.turnings[(s.node + c) % guide.cells()]);
                    turnings[s.first..s.last].iter().zip(on_guide).map(|(f, g)| (f - g).abs()).sum()
                };
                let sum: f64 = found.iter().map(|s| error(s) + piece_cost).sum();
                prop_assert!((sum - cost).abs() < 1e-9 * (1.0 + cost), "{} {}", sum, cost);
            }
        }

        #[test]
        fn a_growing_stretch_has_the_best_fit_of_all_places(turnings in turnings(), guides in small_guides()) {
            for longest in [turnings.len(), usize::MAX] {
                let mut growth = Growth::new(&guides, false, longest);
                for (i, &turning) in turnings.iter().enumerate() {
                    let found = growth.push(turning, &guides, f64::INFINITY).map_or(f64::INFINITY, |m| m.error);
                    let theirs = literal_fit(&turnings[..=i], &guides);
                    prop_assert!((found - theirs).abs() < 1e-7 || found == theirs, "{} {}", found, theirs);
                }
            }
            // Backward, it is the same stretch from its other end.
            let mut growth = Growth::new(&guides, true, turnings.len());
            let mut found = None;
            for &turning in turnings.iter().rev() {
                found = growth.push(turning, &guides, f64::INFINITY);
            }
            let (found, theirs) = (found.map_or(f64::INFINITY, |m| m.error), literal_fit(&turnings, &guides));
            prop_assert!((found - theirs).abs() < 1e-7 || found == theirs, "{} {}", found, theirs);
        }

        #[test]
        fn a_limit_drops_nothing_that_is_below_it(turnings in turnings(), guides in small_guides(), limit in 0.1..3.0_f64) {
            let mut all = Growth::new(&guides, false, usize::MAX);
            let mut some = Growth::new(&guides, false, usize::MAX);
            for &turning in &turnings {
                let whole = all.push(turning, &guides, f64::INFINITY).filter(|m| m.error <= limit);
                prop_assert_eq!(some.push(turning, &guides, limit).map(|m| m.error), whole.map(|m| m.error));
            }
        }
    }
}
