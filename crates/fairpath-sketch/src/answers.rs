//! What comes back from the worker: each answer goes to where it was wanted, if that is still as it was.

use crate::curve::{Curve, CurveId};
use crate::desk::{Slot, Ticket, Wish};
use crate::job::{Answer, Fitted, Job, NOT_HELD, Trouble};
use crate::session::Session;
use std::sync::Arc;

impl Session {
    /// Wants everything that is still to be done: curves to be fitted, strokes to be drawn into curves.
    pub(crate) fn want_all(&mut self) {
        let drawing = self.history.drawing();
        for curve in drawing.curves().iter().filter(|curve| !curve.fitted) {
            let slot = Slot::Curve(curve.id);
            if self.desk.is_wanted(slot, curve) {
                continue;
            }
            let (stroke, neatening, pins) = (curve.stroke.clone(), curve.neatening.clone(), curve.pins.clone());
            let job = match &curve.unpinned {
                // Only the places have changed through which it is held.
                Some(spline) => {
                    Job::Hold { spline: (**spline).clone(), stroke, pins, pixel_size: neatening.pixel_size }
                }
                None => Job::Fit { templates: drawing.templates_for(&neatening), stroke, neatening, pins },
            };
            self.desk.want_also(Wish::new(slot, Some(curve)), job);
        }
        self.want_corrections();
    }

    /// Takes the worker's answer to a job.
    pub fn take_answer(&mut self, ticket: Ticket, answer: Answer) {
        let Some(Wish { slot, of }) = self.desk.done(ticket) else { return };
        match (slot, of, answer) {
            (Slot::Curve(id), Some(of), Answer::Curve(fitted)) => self.fitted(id, &of, *fitted),
            (Slot::Curve(_), Some(of), Answer::Failed(trouble)) => {
                // The curve keeps the shape that it has.
                self.history.supersede(&of, Curve { fitted: true, ..(*of).clone() });
                self.report(trouble);
            }
            (Slot::Live | Slot::Preview, _, Answer::Curve(fitted)) => {
                if let Some(hand) = &mut self.hand {
                    hand.take(slot, *fitted);
                }
            }
            // A stroke that has only begun has no curve yet.
            (Slot::Live | Slot::Preview, _, Answer::Failed(_)) => {}
            (Slot::Oversketch(id), Some(of), Answer::Curve(fitted)) => self.corrected(id, &of, *fitted),
            (Slot::Oversketch(id), Some(of), Answer::Failed(trouble)) => {
                // On the curve as it is now it may be done.
                if self.drawing().curve(id).is_some_and(|curve| Arc::ptr_eq(curve, &of)) {
                    self.take_correction(id);
                    self.report(trouble);
                }
            }
            (Slot::Surface(_), Some(of), Answer::Surface(mesh)) => self.surface = Some((of, Arc::new(mesh))),
            (Slot::Surface(_), _, Answer::Failed(trouble)) => self.report(trouble),
            (slot, _, _) => {
                let text = format!("the worker gave {slot:?} something that it did not ask for");
                self.report(Trouble { code: "bad-answer".into(), text });
            }
        }
        self.want_all();
    }

    /// A curve gets the shape that the worker found for a state of it.
    fn fitted(&mut self, id: CurveId, of: &Arc<Curve>, fitted: Fitted) {
        self.history.supersede(of, shaped(of, of, &fitted));
        // While a slider moves, an older wish is shown until the newest is done.
        if let Some(curve) = self.drawing().curve(id).filter(|curve| !curve.fitted).cloned() {
            self.history.supersede(&curve, shaped(&curve, of, &fitted));
        }
    }
}

/// A curve with the shape that was found for a state of it.
fn shaped(curve: &Curve, of: &Curve, fitted: &Fitted) -> Curve {
    let Fitted { spline, report, mut warnings, templates, unpinned, .. } = fitted.clone();
    let mut shaped = Curve { spline, report, templates, ..curve.clone() };
    if of.unpinned.is_some() {
        // It was only held, so that what the fit had to say still holds.
        let told = of.warnings.iter().filter(|warning| warning.code != NOT_HELD).cloned();
        warnings.splice(0..0, told);
        shaped.templates.clone_from(&of.templates);
    }
    shaped.warnings = warnings;
    let same_fit = curve.stroke == of.stroke && curve.neatening == of.neatening;
    shaped.fitted = same_fit && curve.pins == of.pins;
    shaped.unpinned = match unpinned {
        _ if !same_fit || curve.pins.is_empty() => None,
        Some(unpinned) => Some(Arc::new(unpinned)),
        None => Some(Arc::new(shaped.spline.clone())),
    };
    shaped
}
