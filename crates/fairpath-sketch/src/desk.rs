//! What to compute next: jobs come in for places that want them, the newest for each place goes out, and answers to older ones are dropped.
//!
//! A worker does one job at a time. While a slider moves or a stroke grows, each place therefore has at most one job under way and one that waits; the
//! one that waits is replaced when the wish changes.

use crate::curve::{Curve, CurveId};
use crate::job::Job;
use std::sync::Arc;

/// A place that wants results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slot {
    /// The stroke that is being drawn.
    Live,
    /// What the stroke that is being drawn over a curve would make of it.
    Preview,
    /// A curve with a stroke drawn into it.
    Oversketch(CurveId),
    /// A curve of the drawing.
    Curve(CurveId),
    /// The surface of a curve.
    Surface(CurveId),
}

/// Names a job that was sent to a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ticket(pub u64);

/// After so many jobs for the stroke in hand, one for something else that waits: a hand that draws on and on shall not keep the rest waiting for ever.
const URGENT_IN_A_ROW: u32 = 4;

/// What a place wants.
#[derive(Clone, Debug)]
pub struct Wish {
    /// The place.
    pub slot: Slot,
    /// The curve that the job is about, as it was when it was asked for; nothing for the stroke in hand.
    pub of: Option<Arc<Curve>>,
}

impl Wish {
    /// A wish of a place for a curve as it is now.
    #[must_use]
    pub fn new(slot: Slot, of: Option<&Arc<Curve>>) -> Self {
        Self { slot, of: of.cloned() }
    }

    /// Whether it is for that curve, just as it is.
    fn is_of(&self, curve: &Arc<Curve>) -> bool {
        self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, curve))
    }
}

/// A job that is under way.
#[derive(Debug)]
struct UnderWay {
    ticket: Ticket,
    wish: Wish,
    /// Whether its answer is still welcome.
    wanted: bool,
}

/// The jobs that wait and those that are under way.
#[derive(Debug, Default)]
pub struct Desk {
    waiting: Vec<(Wish, Job)>,
    under_way: Option<UnderWay>,
    issued: u64,
    /// Jobs for the stroke in hand since the last one for something else.
    urgent_in_a_row: u32,
}

impl Desk {
    /// Wants a job done for a place, instead of whatever it wanted before.
    pub fn want(&mut self, wish: Wish, job: Job) {
        self.refuse_answer(wish.slot);
        self.want_also(wish, job);
    }

    /// As [`want`](Self::want), but an answer under way is still welcome: for previews of something that grows. The place keeps its turn.
    pub fn want_also(&mut self, wish: Wish, job: Job) {
        match self.waiting.iter_mut().find(|(waiting, _)| waiting.slot == wish.slot) {
            Some(place) => *place = (wish, job),
            None => self.waiting.push((wish, job)),
        }
    }

    /// Wants nothing any more for a place; an answer under way is not for it.
    pub fn drop_wishes(&mut self, slot: Slot) {
        self.waiting.retain(|(wish, _)| wish.slot != slot);
        self.refuse_answer(slot);
    }

    fn refuse_answer(&mut self, slot: Slot) {
        if let Some(under_way) = self.under_way.as_mut().filter(|under_way| under_way.wish.slot == slot) {
            under_way.wanted = false;
        }
    }

    /// Wants nothing any more.
    pub fn clear(&mut self) {
        self.waiting.clear();
        if let Some(under_way) = &mut self.under_way {
            under_way.wanted = false;
        }
    }

    /// The next job for the worker, if it is free: what is drawn right now comes first, but not for ever; the rest in the order in which it was wanted.
    pub fn next_job(&mut self) -> Option<(Ticket, Job)> {
        if self.under_way.is_some() || self.waiting.is_empty() {
            return None;
        }
        let is_urgent = |(wish, _): &(Wish, Job)| matches!(wish.slot, Slot::Live | Slot::Preview);
        let urgent = self.waiting.iter().position(is_urgent);
        let other = self.waiting.iter().position(|waiting| !is_urgent(waiting));
        let at = if self.urgent_in_a_row < URGENT_IN_A_ROW { urgent.or(other) } else { other.or(urgent) }?;
        self.urgent_in_a_row = if Some(at) == urgent { self.urgent_in_a_row + 1 } else { 0 };
        let (wish, job) = self.waiting.remove(at);
        self.issued += 1;
        let ticket = Ticket(self.issued);
        self.under_way = Some(UnderWay { ticket, wish, wanted: true });
        Some((ticket, job))
    }

    /// Takes note that a job is done; the wish that its answer is for, unless that was dropped.
    pub fn done(&mut self, ticket: Ticket) -> Option<Wish> {
        let under_way = self.under_way.take_if(|under_way| under_way.ticket == ticket)?;
        under_way.wanted.then_some(under_way.wish)
    }

    /// Whether nothing waits and nothing is under way.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        self.waiting.is_empty() && self.under_way.is_none()
    }

    /// Whether the newest wish of a place is for a curve just as it is.
    #[must_use]
    pub fn is_wanted(&self, slot: Slot, curve: &Arc<Curve>) -> bool {
        let waiting = self.waiting.iter().map(|(wish, _)| wish).find(|wish| wish.slot == slot);
        let under_way = self.under_way.iter().find(|under_way| under_way.wish.slot == slot && under_way.wanted);
        waiting.or(under_way.map(|under_way| &under_way.wish)).is_some_and(|wish| wish.is_of(curve))
    }
}
