//! What to compute next: jobs come in for places that want them, the newest for each place goes out, and answers to older ones are dropped.
//!
//! A worker does one job at a time. While a slider moves or a stroke grows, each place therefore has at most one job under way and one that waits; the
//! one that waits is replaced when the wish changes.

use crate::curve::CurveId;
use crate::job::Job;

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

/// A wish of a place.
#[derive(Debug)]
struct Wish {
    slot: Slot,
    job: Job,
}

/// The jobs that wait and those that are under way.
#[derive(Debug, Default)]
pub struct Desk {
    waiting: Vec<Wish>,
    under_way: Option<(Ticket, Slot, bool)>,
    issued: u64,
}

impl Desk {
    /// Wants a job done for a place, instead of whatever it wanted before.
    pub fn want(&mut self, slot: Slot, job: Job) {
        self.drop_wishes(slot);
        self.waiting.push(Wish { slot, job });
    }

    /// Wants nothing any more for a place; an answer under way is not for it.
    pub fn drop_wishes(&mut self, slot: Slot) {
        self.waiting.retain(|wish| wish.slot != slot);
        if let Some((_, busy, wanted)) = &mut self.under_way
            && *busy == slot
        {
            *wanted = false;
        }
    }

    /// Wants nothing any more.
    pub fn clear(&mut self) {
        self.waiting.clear();
        if let Some((_, _, wanted)) = &mut self.under_way {
            *wanted = false;
        }
    }

    /// As [`want`](Self::want), but an answer under way is still welcome: for previews of something that grows.
    pub fn want_also(&mut self, slot: Slot, job: Job) {
        self.waiting.retain(|wish| wish.slot != slot);
        self.waiting.push(Wish { slot, job });
    }

    /// The next job for the worker, if it is free: what is drawn right now comes first, the rest in the order in which it was wanted.
    pub fn next(&mut self) -> Option<(Ticket, Job)> {
        if self.under_way.is_some() || self.waiting.is_empty() {
            return None;
        }
        let urgent = |wish: &Wish| matches!(wish.slot, Slot::Live | Slot::Preview);
        let at = self.waiting.iter().position(urgent).unwrap_or(0);
        let Wish { slot, job } = self.waiting.remove(at);
        self.issued += 1;
        let ticket = Ticket(self.issued);
        self.under_way = Some((ticket, slot, true));
        Some((ticket, job))
    }

    /// Takes note that a job is done; the place that its answer is for, unless that wants it no more.
    pub fn done(&mut self, ticket: Ticket) -> Option<Slot> {
        match self.under_way {
            Some((busy, slot, wanted)) if busy == ticket => {
                self.under_way = None;
                wanted.then_some(slot)
            }
            _ => None,
        }
    }

    /// Whether nothing waits and nothing is under way.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        self.waiting.is_empty() && self.under_way.is_none()
    }

    /// Whether a place waits for something.
    #[must_use]
    pub fn is_busy(&self, slot: Slot) -> bool {
        self.waiting.iter().any(|wish| wish.slot == slot)
            || self.under_way.is_some_and(|(_, busy, wanted)| busy == slot && wanted)
    }
}
