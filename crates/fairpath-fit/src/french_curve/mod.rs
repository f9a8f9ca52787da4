//! Neatening strokes with pieces of French curves (McCrae and Singh 2011): stroke and templates in, spline and where its pieces come from out.

mod blend;
mod chain;
mod choice;
mod growth;
mod guide;
mod joints;
mod laid;
mod link;
mod options;
mod part;
mod path;
mod piece;
mod pose;
mod segmentation;
mod stream;
mod template;
mod turning;
mod whole;

pub use options::{CornerSource, Flips, FrenchCurveOptions, Laying, PieceSearch};
pub use piece::TemplatePiece;
pub use stream::{Committed, FrenchCurveStream};
pub use template::{Template, TemplateError, TemplateSet};

use crate::clean::{Cleaned, clean};
use crate::conclude::{Parts, closing_warnings, describe, polyline, restored_spline};
use crate::direction::is_backward;
use crate::polyline::Polyline;
use crate::result::{Fit, FitError, Report, Warning};
use crate::stroke::Stroke;
use crate::track::{Shape, Track, prepare};
use chain::Chain;
use choice::{Chosen, fitting};
use fairpath_curve::{Point, Similarity, Vec2};
use guide::{Guide, guides};
use joints::joints;
use laid::Laid;
use link::{Link, link};
use part::Part;
use segmentation::{Section, sections};
use whole::{all_around, whole};

/// A stroke neatened with French curves.
#[derive(Clone, Debug, PartialEq)]
pub struct FrenchCurveFit {
    /// The curve, in the unit and frame of the stroke, with its report and warnings. The report's cost is the minimum of equation 5, radians.
    pub fit: Fit,
    /// Of which templates it is made, in order of travel. None if nothing but a polyline could be made of the stroke.
    pub pieces: Vec<TemplatePiece>,
}

/// Fits a stroke.
pub(crate) fn fit(
    stroke: &Stroke,
    set: &TemplateSet,
    options: &FrenchCurveOptions,
) -> Result<FrenchCurveFit, FitError> {
    options.validate()?;
    if options.search == PieceSearch::Greedy {
        let mut stream = FrenchCurveStream::new(set, options)?;
        for &point in &stroke.points {
            stream.push(point);
        }
        return stream.finish();
    }
    let mut cleaned = clean(&stroke.points, options.stroke.pixel_size)?;
    // Where templates must not be run through backward, the direction of drawing has a meaning.
    let backward = options.flips != Flips::None && is_backward(&stroke.points);
    if backward {
        let reversed: Vec<Point> = stroke.points.iter().rev().copied().collect();
        cleaned = clean(&reversed, options.stroke.pixel_size)?;
    }
    let guides = guides(set, options);
    let mut fit = solve(stroke, &cleaned, &guides, options)?;
    warn_if_far(&mut fit.fit, options);
    Ok(if backward { turned_round(fit) } else { fit })
}

/// An error for a stroke of more steps than anyone draws: each takes time.
fn too_long(length: f64, options: &FrenchCurveOptions) -> Option<FitError> {
    let longest = MOST_STEPS * options.spacing;
    let told = |px: f64| px * options.stroke.pixel_size;
    // Written so that an overflow to infinity fails too.
    (!(length <= longest)).then(|| FitError::TooLong { length: told(length), longest: told(longest) })
}

/// Most steps of a stroke.
const MOST_STEPS: f64 = 1e5;

fn warn_if_far(fit: &mut Fit, options: &FrenchCurveOptions) {
    let off = fit.report.max_deviation;
    if off > options.max_error * options.stroke.pixel_size {
        let text = format!("the curve is up to {off:.3} away from the stroke");
        fit.warnings.push(Warning { code: "far-from-stroke".into(), text });
    }
}

/// The pieces of a stroke before they are joined.
#[derive(Clone, Debug)]
struct Pieces {
    laid: Vec<Laid>,
    /// The points that each covers.
    points: Vec<Vec<Vec2>>,
    corner_after: Vec<bool>,
    closed: bool,
    /// Minimum of equation 5, radians, and steps of the stroke.
    cost: f64,
    cells: usize,
}

impl Pieces {
    fn new(closed: bool) -> Self {
        Self { laid: Vec::new(), points: Vec::new(), corner_after: Vec::new(), closed, cost: 0.0, cells: 0 }
    }

    /// Adds the pieces of a part, at whose end the stroke has a corner or ends.
    fn add(&mut self, part: &Part, guides: &[Guide], options: &FrenchCurveOptions) {
        let (found, cost) = sections(&part.turnings, guides, options.piece_cost);
        self.cost += cost;
        self.cells += part.cells();
        for section in found {
            let error = error_of(section, part, guides);
            for Chosen { laid, first, last } in fitting(section, error, part, guides, options) {
                self.laid.push(laid);
                self.points.push(part.run(first, last).to_vec());
                self.corner_after.push(false);
            }
        }
        if let Some(after) = self.corner_after.last_mut() {
            *after = true;
        }
    }
}

/// The sum of equation 3 for a section.
fn error_of(section: Section, part: &Part, guides: &[Guide]) -> f64 {
    let guide = &guides[section.guide];
    let on_guide = guide.turnings.iter().cycle().skip(section.node);
    part.turnings[section.first..section.last].iter().zip(on_guide).map(|(f, g)| (f - g).abs()).sum()
}

/// The pieces of a stroke whose corners divide it.
fn pieces_of_parts(track: &Track, line: &Polyline, guides: &[Guide], options: &FrenchCurveOptions) -> Pieces {
    let mut pieces = Pieces::new(track.shape != Shape::Open);
    let inner = (1..track.turn).filter(|&i| track.corner[i]);
    let stops: Vec<f64> = std::iter::once(0).chain(inner).chain([track.turn]).map(|i| track.all.station(i)).collect();
    for ends in stops.windows(2) {
        let part = Part::new(line, [ends[0], ends[1]], options.spacing, options.curvature_window);
        pieces.add(&part, guides, options);
    }
    pieces
}

/// The pieces of a smoothly closed stroke.
fn pieces_of_ring(ring: Part, guides: &[Guide], options: &FrenchCurveOptions) -> Pieces {
    // The seam is no place to break at: in two turns the break nearest to the middle is one that both sides want.
    let n = ring.cells();
    let twice: Vec<f64> = ring.turnings.iter().chain(&ring.turnings).copied().collect();
    let (found, _) = sections(&twice, guides, options.piece_cost);
    let seam = found.iter().skip(1).map(|s| s.first).min_by_key(|first| first.abs_diff(n)).unwrap_or(0);
    let mut pieces = Pieces::new(true);
    pieces.add(&ring.begun_at(seam % n), guides, options);
    if let Some(after) = pieces.corner_after.last_mut() {
        *after = false;
    }
    pieces
}

/// One pass of the method.
fn solve(
    stroke: &Stroke,
    cleaned: &Cleaned,
    guides: &[Guide],
    options: &FrenchCurveOptions,
) -> Result<FrenchCurveFit, FitError> {
    let track = prepare(cleaned, &options.preparing());
    let mut warnings = closing_warnings(&track, options.stroke.closed);
    let mut warn = |code: &str, text: &str| warnings.push(Warning { code: code.into(), text: text.into() });
    let last = track.all.samples[track.turn];
    let data = &track.all.data[..=last];
    let line = Polyline::new(data.iter().map(|d| d.point).collect());
    if let Some(error) = too_long(line.length(), options) {
        return Err(error);
    }
    let ring = (track.shape == Shape::Ring).then(|| Part::ring(&line, options.spacing, options.curvature_window));
    let mut pieces = match &ring {
        Some(ring) => pieces_of_ring(ring.clone(), guides, options),
        None => pieces_of_parts(&track, &line, guides, options),
    };
    let mut report =
        Report { points: stroke.points.len(), samples: pieces.cells, cost: pieces.cost, ..Report::default() };
    let most = pieces.cost + WHOLE_IS_WORTH * options.piece_cost;
    if let Some((laid, error)) = ring.as_ref().and_then(|ring| whole(ring, guides, most, options)) {
        let length = guides[laid.guide].path.length();
        let seen = Seen { used: [0.0, length], span: [0.0, length] };
        if let Some(spline) = restored_spline(all_around(&laid, guides), cleaned) {
            report.cost = error + options.piece_cost;
            report.pieces = 1;
            describe(&mut report, &spline, stroke, options.stroke.pixel_size);
            let piece = described(&laid, seen, &guides[laid.guide], cleaned);
            return Ok(FrenchCurveFit { fit: Fit { spline, report, warnings }, pieces: vec![piece] });
        }
    }
    let mut joints = joints(&pieces.laid, &pieces.corner_after, pieces.closed, guides);
    if options.mode == Laying::Refined {
        let points: Vec<&[Vec2]> = pieces.points.iter().map(Vec::as_slice).collect();
        let limit = options.end_threshold.unwrap_or(f64::INFINITY);
        pose::settle_together(&mut pieces.laid, &points, &mut joints, guides, limit);
    }
    let links: Vec<Link> = (0..joints.len())
        .map(|i| {
            link(
                &pieces.laid[i],
                &pieces.laid[(i + 1) % pieces.laid.len()],
                joints[i],
                f64::NEG_INFINITY,
                guides,
                options,
            )
        })
        .collect();
    let rough = links.iter().filter(|l| l.rough).count();
    if rough > 0 {
        warn(
            "rough-joints",
            &format!("{rough} pieces meet their neighbours too roughly to be blended; corners are left"),
        );
    }
    let (parts, seen) = joined(&pieces, &joints, &links, guides);
    let spline = restored_spline(parts, cleaned);
    let mut out = Vec::new();
    if spline.is_some() {
        out = seen
            .iter()
            .zip(&pieces.laid)
            .map(|(seen, laid)| described(laid, *seen, &guides[laid.guide], cleaned))
            .collect();
    } else {
        warn("fell-back-to-polyline", "the pieces could not be joined; the stroke is given as a polyline");
    }
    let spline = spline
        .or_else(|| restored_spline(polyline(&track), cleaned))
        .ok_or(FitError::Unfittable { points: stroke.points.len() })?;
    report.pieces = out.len();
    describe(&mut report, &spline, stroke, options.stroke.pixel_size);
    Ok(FrenchCurveFit { fit: Fit { spline, report, warnings }, pieces: out })
}

/// A template that closes by itself may err by as much more as so many pieces cost.
const WHOLE_IS_WORTH: f64 = 2.0;

/// Where a piece is used and seen.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Arc lengths along its path, px.
    used: [f64; 2],
    /// Arc lengths along the curve, px.
    span: [f64; 2],
}

/// Pieces and links as one chain.
fn joined(pieces: &Pieces, joints: &[pose::Joint], links: &[Link], guides: &[Guide]) -> (Parts, Vec<Seen>) {
    let mut chain = Chain::default();
    let mut seen = Vec::new();
    let n = pieces.laid.len();
    let last_link = if pieces.closed { links.last() } else { None };
    // The blend of the last piece with the first is at the end of the curve.
    let mut begin = -last_link.map_or(0.0, |link| link.between.iter().map(|s| s.length).sum());
    for (i, laid) in pieces.laid.iter().enumerate() {
        let path = &guides[laid.guide].path;
        let before = if i > 0 { Some(i - 1) } else { pieces.closed.then_some(n - 1) };
        let from = before.map_or_else(|| path.snapped(laid.from), |j| links[j].entered_at);
        let to = links.get(i).map_or_else(|| path.snapped(laid.to), |l| l.left_at);
        chain.push_part(laid, guides, [from, to]);
        let left = chain.length;
        if let Some(link) = links.get(i) {
            chain.push_link(link, joints[i]);
        }
        seen.push(Seen { used: [from, to], span: [begin, chain.length] });
        begin = left;
    }
    let length = chain.length;
    let (parts, off) = chain.finished(pieces.closed);
    for seen in &mut seen {
        seen.span = along(seen.span.map(|s| s - off), length, pieces.closed);
    }
    (parts, seen)
}

/// A span that begins on a curve of given length; on a closed one it may run on through the start.
fn along([from, to]: [f64; 2], length: f64, closed: bool) -> [f64; 2] {
    if closed {
        let off = length * libm::floor(from / length);
        return [from - off, to - off];
    }
    [from.max(0.0), to.min(length)]
}

/// What a caller is told of a piece.
fn described(laid: &Laid, seen: Seen, guide: &Guide, cleaned: &Cleaned) -> TemplatePiece {
    let to_stroke =
        Similarity { scale: cleaned.scale, translation: cleaned.restore(Vec2::ZERO).to_vec2(), ..Similarity::IDENTITY };
    let [from, to] = seen.used;
    let length = guide.path.length();
    let first = if guide.backward { length - to } else { from };
    // A closed template is entered within its first turn.
    let first = if guide.is_closed() { first - length * libm::floor(first / length) } else { first.max(0.0) };
    TemplatePiece {
        template: guide.template,
        offset: first / guide.scale,
        length: (to - from) / guide.scale,
        backward: guide.backward,
        turned_over: guide.turned_over,
        transform: guide.path_from_template().then(&laid.similarity()).then(&to_stroke),
        span: seen.span.map(|s| s * cleaned.scale),
    }
}

/// The fit of the reversed stroke as one of the stroke.
fn turned_round(fit: FrenchCurveFit) -> FrenchCurveFit {
    let length = fit.fit.spline.length();
    let closed = fit.fit.spline.is_closed();
    let turned = |p: TemplatePiece| TemplatePiece {
        backward: !p.backward,
        span: along([length - p.span[1], length - p.span[0]], length, closed),
        ..p
    };
    let pieces = fit.pieces.into_iter().rev().map(turned).collect();
    FrenchCurveFit { fit: Fit { spline: fit.fit.spline.reversed(), ..fit.fit }, pieces }
}
