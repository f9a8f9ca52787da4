//! How fast it is, timed from inside: from the last point of a stroke to its curve in the picture, and the work for each picture.

use fairpath_sketch::{CurveId, Drawing};
use serde::Serialize;
use web_time::Instant;

/// Most times that are remembered: half an hour of drawing without a pause.
const MOST: usize = 1 << 17;

/// Times so far, milliseconds.
#[derive(Debug, Default)]
pub(crate) struct Pace {
    begun: Option<Instant>,
    drawing: bool,
    /// Curves that are not there yet, and when the pen that drew them was lifted.
    awaited: Vec<(CurveId, Instant)>,
    curves_ms: Vec<f64>,
    frames_ms: Vec<f64>,
}

/// What of a list of times matters, milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Times {
    /// How many there are.
    pub count: usize,
    /// Half of them are shorter.
    pub median: f64,
    /// One in a hundred is longer.
    pub p99: f64,
    /// The longest.
    pub longest: f64,
}

/// The application's own times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PaceReport {
    /// From the last point of a stroke to its curve in the picture.
    pub curves: Times,
    /// The work for each picture while a stroke is drawn.
    pub frames: Times,
}

impl Pace {
    /// A picture begins, or is made anew before it has ended; `drawing` tells whether a stroke is in hand.
    pub(crate) fn begin(&mut self, drawing: bool) {
        self.begun.get_or_insert_with(Instant::now);
        self.drawing |= drawing;
    }

    /// The picture is made. `drawn` are the curves whose strokes ended in it.
    pub(crate) fn end(&mut self, drawn: &[CurveId], drawing: &Drawing) {
        let Some(begun) = self.begun.take() else { return };
        self.awaited.extend(drawn.iter().map(|&id| (id, begun)));
        // In the picture in which a stroke ends, its curve may be waited for.
        if std::mem::take(&mut self.drawing) && drawn.is_empty() {
            note(&mut self.frames_ms, begun);
        }
        let curves_ms = &mut self.curves_ms;
        self.awaited.retain(|&(id, since)| match drawing.curve(id) {
            Some(curve) if curve.fitted => {
                note(curves_ms, since);
                false
            }
            Some(_) => true,
            None => false,
        });
    }

    /// Each time from the last point of a stroke to its curve in the picture.
    pub(crate) fn curves_ms(&self) -> &[f64] {
        &self.curves_ms
    }

    /// The work for each picture while a stroke was drawn.
    pub(crate) fn frames_ms(&self) -> &[f64] {
        &self.frames_ms
    }

    /// The times so far.
    pub(crate) fn report(&self) -> PaceReport {
        PaceReport { curves: Times::of(&self.curves_ms), frames: Times::of(&self.frames_ms) }
    }
}

fn note(list: &mut Vec<f64>, since: Instant) {
    if list.len() < MOST {
        list.push(since.elapsed().as_secs_f64() * 1e3);
    }
}

impl Times {
    /// What matters of a list of times, milliseconds.
    #[must_use]
    pub fn of(list: &[f64]) -> Self {
        let mut sorted = list.to_vec();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len().saturating_sub(1);
        let at = |share: f64| sorted.get(((sorted.len() as f64 * share) as usize).min(last)).copied().unwrap_or(0.0);
        Self { count: sorted.len(), median: at(0.5), p99: at(0.99), longest: at(1.0) }
    }
}
