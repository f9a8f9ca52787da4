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
}

impl Guide {
    /// Number of steps from node to node; a closed path has as many nodes, an open one has one more.
    pub(crate) fn cells(&self) -> usize {
        self.turnings.len()
    }

    pub(crate) fn is_closed(&self) -> bool {
        self.path.is_closed()
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
        Self { template, backward, turned_over, scale, path, turnings, step, gate }
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

/// All ways of using the templates of a set: equation 3 for each, equation 4 for those that are run through backward.
///
/// The stroke may itself be fitted from its end (`reversed`), which matters only where templates must not be.
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
                out.push(Guide::new(template, path, options, Use { backward, turned_over, scale }));
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
