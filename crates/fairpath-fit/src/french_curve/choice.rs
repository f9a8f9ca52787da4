//! Sections whose templates are laid over the stroke, judged there, and divided where they do not fit (McCrae and Singh 2011, section 3.4).

use super::growth::{Growth, Match};
use super::guide::Guide;
use super::laid::{Laid, by_ends, by_least_squares};
use super::options::{FrenchCurveOptions, Laying};
use super::part::Part;
use super::pose::{Neighbours, settled};
use super::segmentation::Section;

/// A piece laid over its section of a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chosen {
    pub(crate) laid: Laid,
    /// Nodes of the part.
    pub(crate) first: usize,
    pub(crate) last: usize,
}

/// The pieces of a section: one if it fits, else those of its two best halves, and so on. A section of one step is taken as it is.
///
/// Each half has at least a sixth of the whole, so that dividing takes no more than steps × nodes of the guides × the logarithm of the steps.
pub(crate) fn fitting(
    section: Section,
    error: f64,
    part: &Part,
    guides: &[Guide],
    options: &FrenchCurveOptions,
) -> Vec<Chosen> {
    let mut out = Vec::new();
    let mut waiting = vec![(section, error)];
    while let Some((section, error)) = waiting.pop() {
        let Section { first, last, .. } = section;
        let (laid, off) = best_laid(section, error, part, guides, &Neighbours::NONE, options);
        let fits = options.end_threshold.is_none_or(|threshold| off <= threshold);
        // Both halves together err no more than the whole, unless corners of templates are in the way.
        let halved = |most: f64| if fits { None } else { halves([first, last], most, part, guides) };
        match halved(error + ROUNDING).or_else(|| halved(f64::INFINITY)) {
            None => out.push(Chosen { laid, first, last }),
            Some([left, right]) => waiting.extend([right, left]),
        }
    }
    out
}

/// The best place for a section, and how far off it is there, px.
pub(crate) fn best_laid(
    section: Section,
    error: f64,
    part: &Part,
    guides: &[Guide],
    neighbours: &Neighbours,
    options: &FrenchCurveOptions,
) -> (Laid, f64) {
    let Section { first, last, guide, node } = section;
    let points = part.run(first, last);
    let stretch = |guide: usize, node: f64| {
        let from = node * guides[guide].step;
        [from, from + part.step * (last - first) as f64]
    };
    let roomy = |guide: usize, node: usize| guides[guide].with_room(node, last - first);
    if options.mode == Laying::Faithful {
        let laid = by_ends(guides, guide, within(guides, guide, stretch(guide, roomy(guide, node))), points);
        return (laid, laid.ends_off(guides, points));
    }
    let mut best: Option<(f64, Laid, f64)> = None;
    let mut consider = |guide: usize, node: f64| {
        let stretch = within(guides, guide, stretch(guide, node));
        let laid = settled(&by_least_squares(guides, guide, stretch, points), points, guides, neighbours);
        let laid = laid.trimmed(guides, points);
        let d = laid.distance(guides, points);
        if best.is_none_or(|b| d.rms < b.0) {
            best = Some((d.rms, laid, d.largest));
            return true;
        }
        false
    };
    // What fits nearly as well in curvature may lie much nearer.
    let mut places = alike(section, error, part, guides, SLACK * options.piece_cost);
    if places.is_empty() {
        places.push(Match { error, guide, node });
    }
    let mut nearest = (guide, node as f64);
    for place in places {
        let node = roomy(place.guide, place.node);
        if consider(place.guide, node) {
            nearest = (place.guide, node);
        }
    }
    // Between nodes.
    for step in [0.5, 0.25, 0.125] {
        let (guide, node) = nearest;
        for off in [step, -step] {
            if (guides[guide].is_closed() || node + off >= 0.0) && consider(guide, node + off) {
                nearest = (guide, node + off);
            }
        }
    }
    let (_, laid, largest) =
        best.unwrap_or((0.0, by_least_squares(guides, guide, stretch(guide, node as f64), points), 0.0));
    (laid, largest)
}

/// A place whose error exceeds the least by no more than this share of the cost of a piece fits nearly as well.
const SLACK: f64 = 0.5;

/// How many such places are laid over the stroke.
const MOST_PLACES: usize = 8;

/// The places on all guides that fit a section nearly as well as the best.
fn alike(section: Section, error: f64, part: &Part, guides: &[Guide], slack: f64) -> Vec<Match> {
    let mut growth = Growth::new(guides, false, section.last - section.first);
    for &turning in &part.turnings[section.first..section.last] {
        growth.push(turning, guides, error + slack);
    }
    growth.matches(guides, MOST_PLACES)
}

/// A stretch of an open guide moved within its ends: steps of the stroke are not quite as long as those of the guide.
fn within(guides: &[Guide], guide: usize, [from, to]: [f64; 2]) -> [f64; 2] {
    let path = &guides[guide].path;
    if path.is_closed() {
        return [from, to];
    }
    let length = (to - from).min(path.length());
    let from = from.min(path.length() - length).max(0.0);
    [from, from + length]
}

/// Sums of the same differences in another order may differ by so much, radians.
const ROUNDING: f64 = 1e-9;

/// The two sections into which one is divided with the least error, with their errors, none of them more than `most`; nothing for a section
/// of one step.
fn halves([first, last]: [usize; 2], most: f64, part: &Part, guides: &[Guide]) -> Option<[(Section, f64); 2]> {
    let n = last - first;
    if n < 2 {
        return None;
    }
    let margin = (n / LEAST_SHARE).max(1);
    let cells = &part.turnings[first..last];
    let mut left = vec![None; n + 1];
    let mut growth = Growth::new(guides, false, last - first);
    for (k, &turning) in cells[..n - margin].iter().enumerate() {
        left[k + 1] = growth.push(turning, guides, most);
    }
    let mut growth = Growth::new(guides, true, last - first);
    let mut best: Option<(f64, usize, Match, Match)> = None;
    for k in (margin..n).rev() {
        let right = growth.push(cells[k], guides, most);
        if let (Some(l), Some(r)) = (left[k], right)
            && best.is_none_or(|b| l.error + r.error < b.0)
        {
            best = Some((l.error + r.error, k, l, r));
        }
    }
    let (_, k, l, r) = best?;
    // Growing backward tells where the section ended on its guide.
    let m = guides[r.guide].cells();
    let begin = if guides[r.guide].is_closed() { (r.node + m - (n - k) % m) % m } else { r.node - (n - k) };
    Some([
        (Section { first, last: first + k, guide: l.guide, node: l.node }, l.error),
        (Section { first: first + k, last, guide: r.guide, node: begin }, r.error),
    ])
}

/// A half has at least one part in so many of the whole.
const LEAST_SHARE: usize = 6;
