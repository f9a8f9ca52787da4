//! The templates of a set in every way in which they may be used: turned over or not, forth or back, at every scale.

use super::options::{Flips, FrenchCurveOptions};
use super::path::Path;
use super::template::TemplateSet;
use super::turning::{POINTS_PER_NODE, turnings};
use fairpath_curve::{Similarity, Vec2};

/// A template run through in one way.
#[derive(Clone, Debug)]
pub(crate) struct Guide {
    pub(crate) template: usize,
    pub(crate) backward: bool,
    pub(crate) turned_over: bool,
    pub(crate) scale: f64,
    /// The template scaled, turned over, and in the direction in which it is run through.
    pub(crate) path: Path,
    /// Angles from node to node, radians.
    pub(crate) turnings: Vec<f64>,
    /// Distance of nodes, px: about the spacing, and a whole number of them make up the path.
    pub(crate) step: f64,
    /// For each node nothing if a piece may begin or end there, else infinity: what is compared near a corner of the path is the corner already,
    /// so a piece holds it and enough of both sides, or nothing of it.
    pub(crate) gate: Vec<f64>,
    /// See [`Guide::even_after`] and [`Guide::even_before`].
    evenness: [Vec<usize>; 2],
}

/// Length of a line or an arc kept free on each side of a piece, px.
const ROOM: f64 = 30.0;

/// Turnings that differ by less than this are rounding, radians.
const EVEN: f64 = 1e-9;

/// For each node, on how many steps in a row after it and before it a path turns alike.
fn evenness(turnings: &[f64], closed: bool) -> [Vec<usize>; 2] {
    let cells = turnings.len();
    let nodes = cells + usize::from(!closed);
    if closed && turnings.iter().all(|t| (t - turnings[0]).abs() < EVEN) {
        return [vec![usize::MAX; nodes], vec![usize::MAX; nodes]];
    }
    // The first node of a closed path counts as an end: a little more is compared then than need be.
    let (mut after, mut before) = (vec![0; cells + 1], vec![0; cells + 1]);
    let alike = |a: usize, b: usize| (turnings[a] - turnings[b]).abs() < EVEN;
    for k in (0..cells).rev() {
        after[k] = if k + 1 < cells && alike(k, k + 1) { after[k + 1] + 1 } else { 1 };
    }
    for k in 1..=cells {
        before[k] = if k > 1 && alike(k - 1, k - 2) { before[k - 1] + 1 } else { 1 };
    }
    after.truncate(nodes);
    before.truncate(nodes);
    [after, before]
}

impl Guide {
    /// Number of steps from node to node; a closed path has as many nodes, an open one has one more.
    pub(crate) fn cells(&self) -> usize {
        self.turnings.len()
    }

    pub(crate) fn is_closed(&self) -> bool {
        self.path.is_closed()
    }

    /// Whether another way of using the same template is no other: a line is a line from either end.
    fn is_same(&self, other: &Self) -> bool {
        let pairs = || self.turnings.iter().zip(&other.turnings);
        self.template == other.template && self.scale == other.scale && pairs().all(|(a, b)| (a - b).abs() < EVEN)
    }

    /// For each node, on how many steps in a row from there the path turns alike.
    pub(crate) fn even_after(&self) -> &[usize] {
        &self.evenness[0]
    }

    /// For each node, on how many steps in a row up to there the path turns alike.
    pub(crate) fn even_before(&self) -> &[usize] {
        &self.evenness[1]
    }

    /// A place as good as `node` for a piece of so many steps: on a line or an arc the ends of the piece keep off its ends, so that there is
    /// room to prolong it.
    pub(crate) fn with_room(&self, node: usize, steps: usize) -> f64 {
        let place = node as f64;
        if self.is_closed() || self.even_after()[node] < steps {
            return place;
        }
        let (low, high) = (place - self.even_before()[node] as f64, place + (self.even_after()[node] - steps) as f64);
        let room = (ROOM / self.step).min(0.5 * (high - low));
        place.max(low + room).min(high - room)
    }

    /// Takes the template as it was drawn to the path.
    pub(crate) fn path_from_template(&self) -> Similarity {
        Similarity { mirror: self.turned_over, scale: self.scale, ..Similarity::IDENTITY }
    }

    fn new(template: usize, path: Path, options: &FrenchCurveOptions, use_: Use) -> Self {
        let count = libm::round(path.length() / options.spacing).max(1.0);
        let step = path.length() / count;
        let between = step / POINTS_PER_NODE as f64;
        let points = POINTS_PER_NODE * count as usize + usize::from(!path.is_closed());
        let points: Vec<Vec2> = (0..points).map(|i| path.pose(between * i as f64).point.to_vec2()).collect();
        let turnings = turnings(&points, options.curvature_window / between, path.is_closed());
        let nodes = count as usize + usize::from(!path.is_closed());
        let reach = CORNER_REACH * options.curvature_window;
        let mut gate: Vec<f64> = (0..nodes).map(|k| barred(&path, step * k as f64, reach)).collect();
        if gate.iter().all(|&g| g > 0.0) {
            gate.fill(0.0);
        }
        let Use { backward, turned_over, scale } = use_;
        let evenness = evenness(&turnings, path.is_closed());
        Self { template, backward, turned_over, scale, path, turnings, step, gate, evenness }
    }
}

/// Share of the neighbourhood from which curvature is taken within which a corner is seen.
const CORNER_REACH: f64 = 0.6;

/// Infinity near a corner; between two that are near each other, the middle is free.
fn barred(path: &Path, v: f64, reach: f64) -> f64 {
    if path.corners.is_empty() {
        return 0.0;
    }
    let [low, high] = path.smooth_stretch(v);
    let length = path.length();
    // The ends of an open path are no corners.
    let (before, after) = if path.is_closed() {
        (v - low, high - v)
    } else {
        (if low > 0.0 { v - low } else { f64::INFINITY }, if high < length { high - v } else { f64::INFINITY })
    };
    let enough = reach.min(MIDDLE * (high - low));
    if before >= enough && after >= enough { 0.0 } else { f64::INFINITY }
}

/// Share of the way between two corners at which a piece may break in any case.
const MIDDLE: f64 = 0.4;

/// In which way a template is used.
#[derive(Clone, Copy)]
struct Use {
    backward: bool,
    turned_over: bool,
    scale: f64,
}

/// All ways of using the templates of a set: equation 3 for each, equation 4 for those that are run through backward. A way that is no
/// other than one before is left out.
pub(crate) fn guides(set: &TemplateSet, options: &FrenchCurveOptions) -> Vec<Guide> {
    let ways: &[(bool, bool)] = match options.flips {
        Flips::None => &[(false, false)],
        Flips::Paper => &[(false, false), (true, false)],
        Flips::All => &[(false, false), (true, false), (false, true), (true, true)],
    };
    let mut out = Vec::new();
    for (template, curve) in set.templates().iter().enumerate() {
        for scale in scales(options) {
            for &(backward, turned_over) in ways {
                let drawn =
                    curve.spline().transformed(&Similarity { mirror: turned_over, scale, ..Similarity::IDENTITY });
                let path = Path::new(if backward { drawn.reversed() } else { drawn });
                let guide = Guide::new(template, path, options, Use { backward, turned_over, scale });
                if !out.iter().any(|other: &Guide| other.is_same(&guide)) {
                    out.push(guide);
                }
            }
        }
    }
    out
}

/// The scales to be tried, in equal ratios of at most [`SCALE_STEP`].
fn scales(options: &FrenchCurveOptions) -> Vec<f64> {
    let (low, high) = (options.smallest_scale, options.largest_scale);
    let steps = libm::ceil(libm::log(high / low) / libm::log(SCALE_STEP) - 1e-9).max(0.0);
    if steps == 0.0 {
        return vec![low];
    }
    (0..=steps as usize).map(|i| low * libm::pow(high / low, i as f64 / steps)).collect()
}

const SCALE_STEP: f64 = 1.1;
