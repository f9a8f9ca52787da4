//! Neatening while the stroke is still being drawn (McCrae and Singh 2011, sections 4 and 5): points in, settled pieces out.
//!
//! A piece grows as long as some part of some template fits; it is then settled, and never changes again. Each point costs a comparison with every
//! place of every template that still fits, whatever was drawn before.

use super::chain::Chain;
use super::choice::best_laid;
use super::growth::{Growth, Match};
use super::guide::{Guide, guides};
use super::laid::Laid;
use super::link::{Link, closing, link, reach};
use super::options::{CornerSource, FrenchCurveOptions};
use super::part::Part;
use super::piece::TemplatePiece;
use super::pose::{Joint, Neighbours};
use super::segmentation::Section;
use super::template::TemplateSet;
use super::turning::{POINTS_PER_NODE, heading, is_settled};
use super::{FrenchCurveFit, Pieces, Seen, described, joined, too_long, warn_if_far};
use crate::clean::{Cleaned, clean};
use crate::closure::close;
use crate::conclude::{describe, restored_spline};
use crate::corners::corners;
use crate::options::Closing;
use crate::polyline::Polyline;
use crate::result::{Fit, FitError, Report, Warning};
use crate::stroke::Stroke;
use fairpath_curve::{Point, Spline, Vec2, trig};

/// A stroke that is neatened while it is drawn.
///
/// ```
/// use fairpath_curve::{Continuity, Point, Segment, Spline};
/// use fairpath_fit::{FrenchCurveOptions, FrenchCurveStream, Template, TemplateSet};
///
/// let arc = Segment::arc(Point::ORIGIN, 0.0, std::f64::consts::TAU * 80.0, 1.0 / 80.0);
/// let wheel = Template::new("wheel", Spline::new(vec![arc], vec![Continuity::G3], true)?)?;
/// let mut stream = FrenchCurveStream::new(&TemplateSet::new("wheels", vec![wheel])?, &FrenchCurveOptions::default())?;
/// let mut settled = 0;
/// for i in 0..200 {
///     let a = 0.05 * f64::from(i);
///     settled += stream.push(Point::new(a * 40.0, 80.0 * a.sin())).len();
/// }
/// let fit = stream.finish()?;
/// assert!(settled > 0 && fit.pieces.len() > settled);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FrenchCurveStream {
    guides: Vec<Guide>,
    options: FrenchCurveOptions,
    /// As they came, in the stroke's frame.
    points: Vec<Point>,
    /// What takes px about the first point to the stroke's frame.
    frame: Option<Cleaned>,
    /// The same points in px, without those that are not finite or repeat the one before.
    line: Polyline,
    part: Growing,
    /// Arc length up to which corners have been looked for, px, and that at which they will be looked for again.
    free_of_corners: f64,
    look_again: f64,
    made: Made,
    fault: Option<FitError>,
}

/// The part of the stroke since the last corner.
#[derive(Clone, Debug)]
struct Growing {
    /// Arc length along the stroke at which it begins, px.
    start: f64,
    /// As those of a [`Part`].
    points: Vec<Vec2>,
    headings: Vec<f64>,
    turnings: Vec<f64>,
    /// Nodes at which the piece that grows begins, and up to which it has grown.
    first: usize,
    grown: usize,
    growth: Growth,
    /// The longest fit so far.
    best: Option<(usize, Match)>,
}

/// What has been settled.
#[derive(Clone, Debug)]
struct Made {
    pieces: Pieces,
    joints: Vec<Joint>,
    links: Vec<Link>,
    /// Arc length on the last piece's path up to which it has been given out, and length of all that has been, px.
    held: f64,
    length: f64,
}

/// A piece that is settled.
#[derive(Clone, Debug, PartialEq)]
pub struct Committed {
    /// Where it comes from. Its span is along all that was committed so far: from where the one before ended up to where this one does. Beyond that
    /// it is seen too, but may be blended with the next.
    pub piece: TemplatePiece,
    /// The new part of the curve, in the stroke's unit and frame: it continues what was committed before, with G2 except at corners, and will be part
    /// of the final curve.
    pub spline: Spline,
}

impl FrenchCurveStream {
    /// A stroke without points yet.
    ///
    /// # Errors
    /// When an option is out of its range.
    pub fn new(set: &TemplateSet, options: &FrenchCurveOptions) -> Result<Self, FitError> {
        options.validate()?;
        let guides = guides(set, options);
        let part = Growing::new(0.0, &guides);
        Ok(Self {
            guides,
            options: options.clone(),
            points: Vec::new(),
            frame: None,
            line: Polyline { points: Vec::new(), s: Vec::new() },
            part,
            free_of_corners: 0.0,
            look_again: 0.0,
            made: Made { pieces: Pieces::new(false), joints: Vec::new(), links: Vec::new(), held: 0.0, length: 0.0 },
            fault: None,
        })
    }

    /// Takes the next point, in the stroke's unit and frame, and gives the pieces that it settles, most often none.
    ///
    /// A point that is not finite, or that makes the stroke too long, is an error that [`FrenchCurveStream::finish`] will tell of; nothing
    /// more is settled then.
    pub fn push(&mut self, point: Point) -> Vec<Committed> {
        self.points.push(point);
        let mut out = Vec::new();
        let Some((from, to)) = self.edge_to(point) else { return out };
        // A long edge is drawn in several steps, so that corners behind it are seen in time.
        let length = (to - from).hypot2().sqrt();
        let count = libm::ceil(length / LONGEST_STEP).max(1.0);
        for i in 1..=count as usize {
            self.line.points.push(from + (to - from) * (i as f64 / count));
            self.line.s.push(self.line.length() + length / count);
            self.advance(&mut out);
        }
        out
    }

    /// Settles what the line as it now is determines.
    fn advance(&mut self, out: &mut Vec<Committed>) {
        let tip = self.line.length();
        if self.options.corners == CornerSource::Templates {
            self.free_of_corners = f64::INFINITY;
        } else if tip >= self.look_again {
            self.look_again = tip + LOOK_EVERY;
            self.divide(tip - UNSURE, out);
            self.free_of_corners = (tip - UNSURE).max(self.free_of_corners);
        }
        self.part.follow(&self.line, tip, &self.options);
        self.part.settle_headings(self.free_of_corners, false, &self.options);
        self.grow(false, out);
    }

    /// Ends the part at each corner that lies before arc length `until`, px.
    fn divide(&mut self, until: f64, out: &mut Vec<Committed>) {
        while let Some(corner) = self.corner(until) {
            self.end_part(corner, out);
            self.part = Growing::new(corner, &self.guides);
        }
    }

    /// Ends the stroke: the whole curve, of which all that was committed is a part.
    ///
    /// Where the stroke is closed its end is led to its beginning.
    ///
    /// # Errors
    /// As [`fit`](crate::fit).
    pub fn finish(mut self) -> Result<FrenchCurveFit, FitError> {
        if let Some(fault) = self.fault.take() {
            return Err(fault);
        }
        let cleaned = clean(&self.points, self.options.stroke.pixel_size)?;
        let unfittable = FitError::Unfittable { points: self.points.len() };
        let Some(frame) = self.frame.clone() else { return Err(unfittable) };
        let mut rest = Vec::new();
        self.divide(self.line.length(), &mut rest);
        self.end_part(self.line.length(), &mut rest);
        let mut warnings = Vec::new();
        let mut warn = |code: &str, text: String| warnings.push(Warning { code: code.into(), text });
        let wanted = close(&cleaned.points, &self.options.shared()).is_some();
        let made = &mut self.made;
        if wanted && let (Some(last), Some(first)) = (made.pieces.laid.last(), made.pieces.laid.first()) {
            match closing(last, first, made.held, &self.guides, &self.options).filter(|_| made.pieces.laid.len() > 1) {
                Some(link) => {
                    made.links.push(link);
                    made.joints.push(Joint::Smooth);
                    made.pieces.closed = true;
                }
                None => warn("left-open", "the stroke is closed, but its last piece cannot be led to its first".into()),
            }
        } else if self.options.stroke.closed == Closing::Yes {
            warn("not-closed", "the stroke was to be closed, but nothing would remain of it; it is left open".into());
        }
        let rough = made.links.iter().filter(|l| l.rough).count();
        if rough > 0 {
            warn(
                "rough-joints",
                format!("{rough} pieces meet their neighbours too roughly to be blended; corners are left"),
            );
        }
        let (parts, seen) = joined(&made.pieces, &made.joints, &made.links, &self.guides);
        let spline = restored_spline(parts, &frame).ok_or(unfittable)?;
        let pieces: Vec<TemplatePiece> = seen
            .iter()
            .zip(&made.pieces.laid)
            .map(|(seen, laid)| described(laid, *seen, &self.guides[laid.guide], &frame))
            .collect();
        let mut report = Report {
            points: self.points.len(),
            samples: made.pieces.cells,
            cost: made.pieces.cost,
            pieces: pieces.len(),
            ..Report::default()
        };
        describe(&mut report, &spline, &Stroke::new("", self.points), self.options.stroke.pixel_size);
        let mut fit = Fit { spline, report, warnings };
        warn_if_far(&mut fit, &self.options);
        Ok(FrenchCurveFit { fit, pieces })
    }

    /// The edge from the last point of the line to the next, px; nothing if there is none.
    fn edge_to(&mut self, point: Point) -> Option<(Vec2, Vec2)> {
        if self.fault.is_some() {
            return None;
        }
        if !(point.x.is_finite() && point.y.is_finite()) {
            self.fault = Some(FitError::NotFinite { index: self.points.len() - 1 });
            return None;
        }
        let scale = self.options.stroke.pixel_size;
        let frame = self.frame.get_or_insert_with(|| Cleaned { points: Vec::new(), origin: point, scale, grain: 0.0 });
        let p = (point - frame.origin) / scale;
        let Some(&last) = self.line.points.last() else {
            self.line = Polyline::new(vec![p]);
            return None;
        };
        let step = (p - last).hypot2().sqrt();
        self.fault = too_long(self.line.length() + step, &self.options);
        (self.fault.is_none() && step > REPEATED).then_some((last, p))
    }

    /// The first corner of the stroke before arc length `until`, px, that lies in what has not been compared yet.
    fn corner(&self, until: f64) -> Option<f64> {
        if self.options.corners == CornerSource::Templates {
            return None;
        }
        let tip = self.line.length();
        let from = self.line.s.partition_point(|&s| s < tip - LOOKED_AT);
        let tail: Vec<Point> = self.line.points[from..].iter().map(|p| p.to_point()).collect();
        let cleaned = clean(&tail, 1.0).ok()?;
        let tail = Polyline::new(cleaned.points);
        let shared = self.options.shared();
        let compared = self.options.spacing * self.part.turnings.len() as f64;
        let after = self.part.start + compared.max(shared.corner_distance);
        // Cleaning may change the length a little: corners are told by their distance to the tip.
        corners(&tail, false, cleaned.grain, &shared)
            .into_iter()
            .map(|s| tip - (tail.length() - s))
            .find(|&s| s > after && s < until.min(tip - REPEATED))
    }

    /// Settles all of the part up to arc length `end`, px, where the stroke has a corner or ends.
    fn end_part(&mut self, end: f64, out: &mut Vec<Committed>) {
        self.part.end(&self.line, end, &self.options);
        self.part.settle_headings(f64::INFINITY, true, &self.options);
        self.grow(true, out);
        if let Some(after) = self.made.pieces.corner_after.last_mut() {
            *after = true;
        }
    }

    /// Lets the piece grow along all steps that are known, and settles it where it does not fit any more; at the end of a part, in any case.
    fn grow(&mut self, to_the_end: bool, out: &mut Vec<Committed>) {
        loop {
            while self.part.grown < self.part.turnings.len() {
                let turning = self.part.turnings[self.part.grown];
                let found = self.part.growth.push(turning, &self.guides, self.options.greedy_error);
                self.part.grown += 1;
                if let Some(found) = found {
                    self.part.best = Some((self.part.grown, found));
                }
                if self.part.growth.is_empty() {
                    self.settle(out);
                }
            }
            if !to_the_end || self.part.first >= self.part.turnings.len() {
                return;
            }
            self.settle(out);
        }
    }

    /// Ends the piece that grows at its longest fit, and begins another there.
    fn settle(&mut self, out: &mut Vec<Committed>) {
        let first = self.part.first;
        // A step that fits nothing is taken alone.
        let (mut last, mut found) =
            self.part.best.unwrap_or_else(|| (first + 1, self.part.best_match(first + 1, &self.guides)));
        // It is to meet the piece before, if that does not draw it off the stroke.
        let before = Neighbours { before: self.made.end() };
        let (laid, error) = 'shorter: loop {
            let (part, section) = self.part.alone(last, found, &self.options);
            for neighbours in [&before, &Neighbours::NONE] {
                let (laid, off) = best_laid(section, found.error, &part, &self.guides, neighbours, &self.options);
                if last == first + 1 || self.options.end_threshold.is_none_or(|threshold| off <= threshold) {
                    break 'shorter (laid, found.error);
                }
            }
            last = (first + (last - first) * 2 / 3).max(first + 1);
            found = self.part.best_match(last, &self.guides);
        };
        self.made.pieces.cost += error + self.options.piece_cost;
        self.made.pieces.cells += last - first;
        if let Some(frame) = &self.frame
            && let Some(committed) = self.made.commit(laid, frame, &self.guides, &self.options)
        {
            out.push(committed);
        }
        self.part.restart(last, &self.guides);
    }
}

/// Points nearer than this to the one before are repetitions, px.
const REPEATED: f64 = 1e-3;

/// How much of the end of the stroke is searched for corners, how often, and how much of it the next points may yet change, px.
const LOOKED_AT: f64 = 160.0;
const LOOK_EVERY: f64 = 6.0;
const UNSURE: f64 = 32.0;

/// Longest step in which the line grows, px.
const LONGEST_STEP: f64 = 10.0;

impl Made {
    /// The piece that the next has to meet smoothly.
    fn end(&self) -> Option<Laid> {
        let smooth = !self.pieces.corner_after.last()?;
        self.pieces.laid.last().copied().filter(|_| smooth)
    }

    /// Joins a piece to what is there, and gives out what is settled by that.
    fn commit(
        &mut self,
        mut laid: Laid,
        frame: &Cleaned,
        guides: &[Guide],
        options: &FrenchCurveOptions,
    ) -> Option<Committed> {
        let path = &guides[laid.guide].path;
        let mut chain = Chain::default();
        let entered = if let Some(&before) = self.pieces.laid.last() {
            let joint = if self.end().is_some() { Joint::Smooth } else { Joint::Corner };
            if joint == Joint::Smooth {
                beside(&mut laid, &before, guides);
            }
            let link = link(&before, &laid, joint, self.held, guides, options);
            chain.push_part(&before, guides, [self.held, link.left_at]);
            chain.push_link(&link, joint);
            let entered = link.entered_at;
            self.links.push(link);
            self.joints.push(joint);
            entered
        } else {
            laid.from = path.snapped(laid.from);
            laid.from
        };
        let begin = self.length;
        self.held = path.snapped(laid.to - reach(&laid, guides, true, options));
        chain.push_part(&laid, guides, [entered, self.held]);
        self.length += chain.length;
        self.pieces.laid.push(laid);
        self.pieces.points.push(Vec::new());
        self.pieces.corner_after.push(false);
        let seen = Seen { used: [entered, self.held], span: [begin, self.length] };
        let spline = restored_spline(chain.finished(false).0, frame)?;
        Some(Committed { piece: described(&laid, seen, &guides[laid.guide], frame), spline })
    }
}

/// Begins a piece where it is beside the end of the one before.
fn beside(laid: &mut Laid, before: &Laid, guides: &[Guide]) {
    let path = &guides[laid.guide].path;
    let end = before.pose(&guides[before.guide].path, before.to).point.to_vec2();
    let [low, _] = path.smooth_stretch(laid.from);
    let latest = laid.from + BESIDE * (laid.to - laid.from);
    let foot = laid.foot(path, laid.from, [low, laid.to], end).at;
    laid.from = foot.clamp(low.min(laid.from), latest);
}

/// Most of a piece that is left out to begin beside the one before.
const BESIDE: f64 = 0.3;

impl Growing {
    fn new(start: f64, guides: &[Guide]) -> Self {
        Self {
            start,
            points: Vec::new(),
            headings: Vec::new(),
            turnings: Vec::new(),
            first: 0,
            grown: 0,
            growth: Growth::new(guides, false, usize::MAX),
            best: None,
        }
    }

    /// Adds points at equal steps up to the tip of the line.
    fn follow(&mut self, line: &Polyline, tip: f64, options: &FrenchCurveOptions) {
        let between = options.spacing / POINTS_PER_NODE as f64;
        loop {
            let s = self.start + between * self.points.len() as f64;
            if s > tip {
                return;
            }
            self.points.push(at(line, s));
        }
    }

    /// Ends at an arc length, with a last step that is shorter or longer than the others.
    fn end(&mut self, line: &Polyline, end: f64, options: &FrenchCurveOptions) {
        self.follow(line, end, options);
        let between = options.spacing / POINTS_PER_NODE as f64;
        let count = libm::round((end - self.start) / options.spacing).max(1.0) as usize;
        // What has been compared stays.
        let count = count.max(self.turnings.len() + 1);
        self.points.truncate((count - 1) * POINTS_PER_NODE + 1);
        let from = self.start + between * (self.points.len() - 1) as f64;
        for i in 1..=POINTS_PER_NODE {
            self.points.push(at(line, from + (end - from) * i as f64 / POINTS_PER_NODE as f64));
        }
    }

    /// Headings and turnings of nodes that no further point changes, because they lie far enough from the tip or the part has ended, and that lie before
    /// arc length `sure`, px.
    fn settle_headings(&mut self, sure: f64, ended: bool, options: &FrenchCurveOptions) {
        let reach = options.curvature_window * POINTS_PER_NODE as f64 / options.spacing;
        loop {
            let node = self.headings.len();
            let point = node * POINTS_PER_NODE;
            let known = point < self.points.len();
            if !known || !(ended || is_settled(point, self.points.len(), reach)) {
                return;
            }
            if self.start + options.spacing * node as f64 > sure {
                return;
            }
            let heading = heading(&self.points, point, reach, false);
            if let Some(before) = self.headings.last() {
                self.turnings.push(trig::wrap_angle(heading - before));
            }
            self.headings.push(heading);
        }
    }

    /// The best fit of the steps from the first to node `last`, however bad.
    fn best_match(&self, last: usize, guides: &[Guide]) -> Match {
        let mut growth = Growth::new(guides, false, last - self.first);
        let mut best = None;
        for &turning in &self.turnings[self.first..last] {
            best = growth.push(turning, guides, f64::INFINITY);
        }
        best.unwrap_or(Match { error: f64::INFINITY, guide: 0, node: 0 })
    }

    /// The steps from the first to node `last` as a part of their own, and as a section of that.
    fn alone(&self, last: usize, found: Match, options: &FrenchCurveOptions) -> (Part, Section) {
        let points = self.points[self.first * POINTS_PER_NODE..=last * POINTS_PER_NODE].to_vec();
        let part = Part { points, step: options.spacing, turnings: self.turnings[self.first..last].to_vec() };
        (part, Section { first: 0, last: last - self.first, guide: found.guide, node: found.node })
    }

    /// Begins another piece at a node.
    fn restart(&mut self, node: usize, guides: &[Guide]) {
        (self.first, self.grown, self.best) = (node, node, None);
        self.growth = Growth::new(guides, false, usize::MAX);
    }
}

/// The point of a line at an arc length.
fn at(line: &Polyline, s: f64) -> Vec2 {
    line.at(s, &mut line.s.partition_point(|&v| v <= s).saturating_sub(1))
}
