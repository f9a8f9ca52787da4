//! The old curve with a new part in it: what stays keeps the bits that it has.

use fairpath_curve::{Continuity, Segment, Spline, SplineError};
use std::ops::Range;

/// Segments in order of travel with the joins between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Run {
    pub(crate) segments: Vec<Segment>,
    pub(crate) joins: Vec<Continuity>,
}

/// What stays of a curve on both sides of what is fitted anew. On a closed curve both sides are one run, from the second seam to the first.
#[derive(Clone, Debug)]
pub(crate) struct Rest {
    /// Up to the first seam and from the second on; empty where the new part reaches the curve's end.
    pub(crate) before: Run,
    pub(crate) after: Run,
    /// How the old curve runs on at the seams.
    pub(crate) joins: [Continuity; 2],
    /// Whether a segment was cut there.
    is_cut: [bool; 2],
    closed: bool,
    /// Index in `before` of the segment with which the closed curve began, if that stays.
    first: Option<usize>,
}

/// A place in a curve: at arc length `s` of a segment, its start if that is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) segment: usize,
    pub(crate) s: f64,
}

impl Rest {
    /// What lies outside two seams; without one, the new part reaches the curve's end. Whole segments and joins are those of `curve` to the bit. Of
    /// a segment that is cut, the part before the cut keeps start, heading and curvature at its start, the part after it the curvature at its end;
    /// what describes it at the cut is evaluated there.
    pub(crate) fn of(curve: &Spline, [start, end]: [Option<Place>; 2]) -> Self {
        let is_cut = [start, end].map(|at| at.is_some_and(|at| at.s > 0.0));
        let joins = [start, end].map(|at| at.map_or(Continuity::G0, |at| join_at(curve, at)));
        if let (true, Some(start), Some(end)) = (curve.is_closed(), start, end) {
            let (before, first) = around(curve, end, start);
            return Self { before, after: Run::default(), joins, is_cut, closed: true, first };
        }
        let before = start.map_or_else(Run::default, |at| up_to(curve, at));
        let after = end.map_or_else(Run::default, |at| from(curve, at));
        Self { before, after, joins, is_cut, closed: false, first: None }
    }

    /// The segments that the new part meets: the one before it and the one after.
    pub(crate) fn neighbours(&self) -> [Option<&Segment>; 2] {
        let after = if self.closed { &self.before } else { &self.after };
        [self.before.segments.last(), after.segments.first()]
    }

    /// Segments and joins outward from a seam.
    pub(crate) fn outward(&self, side: usize) -> Vec<(Segment, Option<Continuity>)> {
        let run = if side == 0 || self.closed { &self.before } else { &self.after };
        let n = run.segments.len();
        let pair = |i: usize| {
            let join = if side == 0 { i.checked_sub(1) } else { Some(i) };
            (run.segments[i], join.and_then(|j| run.joins.get(j)).copied())
        };
        if side == 0 { (0..n).rev().map(pair).collect() } else { (0..n).map(pair).collect() }
    }

    /// Gives new lines and arcs that only go on as a segment did before it was cut back to that segment; `seams` are how the
    /// new part then meets what stays.
    pub(crate) fn absorb(&mut self, new: &mut Run, seams: &mut [Continuity; 2]) {
        let goes_on = |a: &Segment, b: &Segment| a.kappa0 == a.kappa1 && b.kappa0 == b.kappa1 && a.kappa1 == b.kappa0;
        if self.is_cut[0]
            && new.segments.len() > 1
            && let Some(last) = self.before.segments.last_mut()
            && goes_on(last, &new.segments[0])
        {
            last.length += new.segments.remove(0).length;
            seams[0] = new.joins.remove(0);
        }
        let after = if self.closed { &mut self.before } else { &mut self.after };
        if self.is_cut[1]
            && let [.., _, next] = new.segments[..]
            && let Some(first) = after.segments.first_mut()
            && goes_on(&next, first)
        {
            new.segments.pop();
            seams[1] = new.joins.pop().unwrap_or(seams[1]);
            *first = Segment { length: next.length + first.length, ..next };
        }
    }

    /// The curve with `new` between the seams, where it joins as `seams` says, and which of its segments are new.
    ///
    /// # Errors
    /// When the new part does not meet what stays.
    pub(crate) fn with(self, new: Run, seams: [Continuity; 2]) -> Result<(Spline, Range<usize>), SplineError> {
        let count = new.segments.len();
        let mut all = self.before;
        let mut begin = all.segments.len();
        append(&mut all, new, seams[0]);
        if !self.closed {
            append(&mut all, self.after, seams[1]);
            return Spline::new(all.segments, all.joins, false).map(|spline| (spline, begin..begin + count));
        }
        all.joins.push(seams[1]);
        let turn = self.first.unwrap_or(0);
        all.segments.rotate_left(turn);
        all.joins.rotate_left(turn);
        begin -= turn;
        Spline::new(all.segments, all.joins, true).map(|spline| (spline, begin..begin + count))
    }
}

fn append(run: &mut Run, next: Run, join: Continuity) {
    if !run.segments.is_empty() && !next.segments.is_empty() {
        run.joins.push(join);
    }
    run.segments.extend(next.segments);
    run.joins.extend(next.joins);
}

/// The continuity of a curve at a place: within a segment it is as smooth as can be said.
fn join_at(curve: &Spline, at: Place) -> Continuity {
    if at.s > 0.0 {
        return Continuity::G3;
    }
    let n = curve.segments().len();
    curve.joins().get((at.segment + n - 1) % n).copied().unwrap_or(Continuity::G0)
}

/// The part of a segment before arc length `s`.
fn head(segment: &Segment, s: f64) -> Segment {
    let kappa1 = if segment.kappa0 == segment.kappa1 { segment.kappa1 } else { segment.curvature_at(s) };
    Segment { length: s, kappa1, ..*segment }
}

/// The part of a segment from arc length `s` on.
fn tail(segment: &Segment, s: f64) -> Segment {
    Segment { kappa1: segment.kappa1, ..segment.subsegment(s, segment.length) }
}

fn up_to(curve: &Spline, at: Place) -> Run {
    let mut segments = curve.segments()[..at.segment].to_vec();
    if at.s > 0.0 {
        segments.push(head(&curve.segments()[at.segment], at.s));
    }
    let joins = curve.joins()[..segments.len().saturating_sub(1)].to_vec();
    Run { segments, joins }
}

fn from(curve: &Spline, at: Place) -> Run {
    let mut segments = curve.segments()[at.segment..].to_vec();
    if let (Some(first), true) = (segments.first_mut(), at.s > 0.0) {
        *first = tail(first, at.s);
    }
    Run { segments, joins: curve.joins().get(at.segment..).unwrap_or_default().to_vec() }
}

/// The run of a closed curve from one place around to another, and where in it the curve's first segment begins, if it does.
fn around(curve: &Spline, from: Place, to: Place) -> (Run, Option<usize>) {
    let n = curve.segments().len();
    let mut run = Run::default();
    let mut first = None;
    // Within one segment the way leads all around, unless what stays lies between the two places.
    let ahead = (to.segment, to.s) > (from.segment, from.s);
    let steps = to.segment + if ahead { 0 } else { n } - from.segment;
    for step in 0..=steps {
        let i = (from.segment + step) % n;
        let segment = &curve.segments()[i];
        let begin = if step == 0 { from.s } else { 0.0 };
        let part = match (begin > 0.0, step == steps) {
            (_, true) if to.s == 0.0 => break,
            (false, false) => *segment,
            (false, true) => head(segment, to.s),
            (true, false) => tail(segment, begin),
            (true, true) => segment.subsegment(begin, to.s),
        };
        if !run.segments.is_empty() {
            run.joins.push(curve.joins()[(i + n - 1) % n]);
        }
        if i == 0 && begin == 0.0 {
            first = Some(run.segments.len());
        }
        run.segments.push(part);
    }
    (run, first)
}
