//! Laid pieces and what lies between them as one chain of segments (McCrae and Singh 2011, section 3.4).

use super::guide::Guide;
use super::laid::Laid;
use super::link::Link;
use super::pose::Joint;
use crate::conclude::Parts;
use fairpath_curve::{Continuity, Segment, trig};
use std::f64::consts::TAU;

/// A chain in px that grows at its end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chain {
    segments: Vec<Segment>,
    /// How each segment but the first begins.
    seams: Vec<Seam>,
    /// How the next segment will begin.
    next: Option<Seam>,
    /// Arc length so far.
    pub(crate) length: f64,
}

/// How a segment follows another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Seam {
    Joined(Continuity),
    /// Both are straight, and are to be one.
    Fused,
}

impl Chain {
    fn push(&mut self, segment: Segment) {
        let seam = self.next.take().unwrap_or(Seam::Joined(Continuity::G0));
        if !self.segments.is_empty() {
            self.seams.push(seam);
        }
        self.length += segment.length;
        self.segments.push(segment);
    }

    /// Adds the part of a laid template from one arc length of its path to another: its own segments, moved.
    pub(crate) fn push_part(&mut self, laid: &Laid, guides: &[Guide], [from, to]: [f64; 2]) {
        let (segments, joins) = guides[laid.guide].path.part(from, to);
        let by = laid.similarity();
        let mut joins = joins.into_iter();
        for segment in segments {
            self.push(segment.transformed(&by));
            if let Some(join) = joins.next() {
                self.next = Some(Seam::Joined(join));
            }
        }
    }

    /// Adds what lies between two pieces, of which the second is still to come.
    pub(crate) fn push_link(&mut self, link: &Link, joint: Joint) {
        let fused = joint == Joint::Straight;
        for (segment, &join) in link.between.iter().zip(&link.joins) {
            self.next = Some(Seam::Joined(join));
            self.push(*segment);
        }
        let last = link.joins.last().copied().unwrap_or(Continuity::G0);
        self.next = Some(if fused { Seam::Fused } else { Seam::Joined(last) });
    }

    /// The segments with their joins; if `closed`, the last runs into the first as the last link told. A closed curve begins where no line is to be
    /// made of two: by how much that is later than it was is given too, px.
    pub(crate) fn finished(mut self, closed: bool) -> (Parts, f64) {
        let mut off = 0.0;
        if closed {
            self.seams.push(self.next.unwrap_or(Seam::Joined(Continuity::G0)));
            let whole = self.seams.iter().rposition(|s| *s != Seam::Fused).map_or(0, |i| i + 1) % self.seams.len();
            if self.seams.last() == Some(&Seam::Fused) {
                off = self.segments[..whole].iter().map(|s| s.length).sum();
                self.segments.rotate_left(whole);
                self.seams.rotate_left(whole);
            }
        }
        let (segments, joins) = fused(&self.segments, &self.seams);
        ((run_on(segments, &joins), joins, closed), off)
    }
}

/// Straight segments that continue each other made one, from where the first begins to where the last ends.
///
/// Both ends are corners or ends of the curve, so that it does not matter that the line is turned by what rounding and least squares left. Should
/// one not be, it becomes a corner.
fn fused(segments: &[Segment], seams: &[Seam]) -> (Vec<Segment>, Vec<Continuity>) {
    let n = segments.len();
    let (mut out, mut joins): (Vec<Segment>, Vec<Continuity>) = (Vec::with_capacity(n), Vec::with_capacity(n));
    let mut i = 0;
    while i < n {
        let mut last = i;
        while last + 1 < n && seams[last] == Seam::Fused {
            last += 1;
        }
        let join = match seams.get(last) {
            Some(Seam::Joined(join)) => Some(*join),
            // A closed curve that is nothing but lines to be made one is none.
            Some(Seam::Fused) => Some(Continuity::G0),
            None => None,
        };
        if last > i {
            let (begin, end) = (segments[i].start, segments[last].end());
            let way = end - begin;
            if let Some(before) = joins.last_mut() {
                *before = Continuity::G0;
            }
            out.push(Segment::line(begin, trig::angle_of(way), way.hypot2().sqrt()));
            joins.extend(join.map(|_| Continuity::G0));
        } else {
            out.push(segments[i]);
            joins.extend(join);
        }
        i = last + 1;
    }
    (out, joins)
}

/// Headings that run on through whole turns from segment to segment.
fn run_on(mut segments: Vec<Segment>, joins: &[Continuity]) -> Vec<Segment> {
    for i in 1..segments.len() {
        if joins[i - 1] > Continuity::G0 {
            let off = libm::round((segments[i - 1].end_heading() - segments[i].heading) / TAU);
            if off != 0.0 {
                segments[i].heading += TAU * off;
            }
        }
    }
    segments
}
