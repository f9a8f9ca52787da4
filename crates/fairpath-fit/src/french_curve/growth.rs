//! All places of all templates compared with a stretch of stroke that grows step by step: what a greedy search follows, and how the
//! fits of one stretch from or to every node are known.

use super::guide::Guide;

/// A place on a guide that is being compared.
#[derive(Clone, Copy, Debug)]
struct Runner {
    guide: u32,
    /// Node of the guide at the first node of the stretch, and at its last.
    from: u32,
    at: u32,
    /// Sum of the differences of turnings so far, radians.
    error: f64,
}

/// A fit of a stretch (equations 3 and 4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Match {
    pub(crate) error: f64,
    pub(crate) guide: usize,
    /// Node of the guide where the stretch began.
    pub(crate) node: usize,
}

/// The comparisons of a growing stretch.
#[derive(Clone, Debug)]
pub(crate) struct Growth {
    runners: Vec<Runner>,
    /// Whether the stretch grows towards the start of the stroke.
    backward: bool,
}

impl Growth {
    /// An empty stretch that will have at most `longest` steps. It fits everywhere where a piece may begin; where a guide is a line or an arc for
    /// longer than that, one of many equal places stands for all.
    pub(crate) fn new(guides: &[Guide], backward: bool, longest: usize) -> Self {
        let mut runners = Vec::new();
        for (g, guide) in (0..).zip(guides) {
            let evenness = if backward { guide.even_before() } else { guide.even_after() };
            let is_like_the_one_before = |k: usize| {
                let even = if backward { evenness[k] } else { evenness[k - 1] };
                even > longest && guide.gate[k - 1] == 0.0
            };
            for (k, &gate) in guide.gate.iter().enumerate() {
                if gate == 0.0 && (k == 0 || !is_like_the_one_before(k)) {
                    runners.push(Runner { guide: g, from: k as u32, at: k as u32, error: 0.0 });
                }
            }
        }
        Self { runners, backward }
    }

    /// Takes one more step of the stroke, on which it turns by `turning`, and drops what then errs by more than `limit` or leaves its guide. The
    /// best fit of the stretch, if any ends where a piece may.
    pub(crate) fn push(&mut self, turning: f64, guides: &[Guide], limit: f64) -> Option<Match> {
        let mut best: Option<Match> = None;
        let backward = self.backward;
        self.runners.retain_mut(|runner| {
            let guide = &guides[runner.guide as usize];
            let (at, cells) = (runner.at as usize, guide.cells());
            let closed = guide.is_closed();
            let (cell, next) = if backward {
                match (at, closed) {
                    (0, false) => return false,
                    (0, true) => (cells - 1, cells - 1),
                    _ => (at - 1, at - 1),
                }
            } else {
                match (at + 1 >= cells, closed) {
                    (true, true) => (at, 0),
                    (true, false) if at >= cells => return false,
                    _ => (at, at + 1),
                }
            };
            runner.at = next as u32;
            runner.error += (turning - guide.turnings[cell]).abs();
            if runner.error > limit {
                return false;
            }
            if guide.gate[next] == 0.0 && best.is_none_or(|b| runner.error < b.error) {
                best = Some(Match { error: runner.error, guide: runner.guide as usize, node: runner.from as usize });
            }
            true
        });
        best
    }

    /// Whether nothing fits any more.
    pub(crate) fn is_empty(&self) -> bool {
        self.runners.is_empty()
    }

    /// The fits of the whole stretch that are better than those beside them on their guides, at most `most`, the best first.
    pub(crate) fn matches(&self, guides: &[Guide], most: usize) -> Vec<Match> {
        let mut found: Vec<Match> = Vec::new();
        let beside = |a: &Runner, b: &Runner| a.guide == b.guide && a.from + 1 == b.from;
        for (i, runner) in self.runners.iter().enumerate() {
            let worse = |j: Option<usize>, strictly: bool| {
                let Some(other) = j.and_then(|j| self.runners.get(j)) else { return true };
                let near = if strictly { beside(other, runner) } else { beside(runner, other) };
                !near || runner.error < other.error || (!strictly && runner.error == other.error)
            };
            let ends_well = guides[runner.guide as usize].gate[runner.at as usize] == 0.0;
            if ends_well && worse(i.checked_sub(1), true) && worse(Some(i + 1), false) {
                found.push(Match { error: runner.error, guide: runner.guide as usize, node: runner.from as usize });
            }
        }
        found.sort_by(|a, b| a.error.total_cmp(&b.error).then((a.guide, a.node).cmp(&(b.guide, b.node))));
        found.truncate(most);
        found
    }
}
