//! Strokes drawn over curves: each waits until its curve is what it was drawn over, becomes a job, and again if the curve changed meanwhile.
//!
//! A hand may draw the second correction before the first is done, or while the curve itself is still being fitted; none shall be lost.

use crate::curve::{Curve, CurveId};
use crate::desk::{Slot, Wish};
use crate::job::{Fitted, Job};
use crate::session::Session;
use fairpath_fit::{OversketchOptions, Stroke};
use std::sync::Arc;

/// A stroke drawn over a curve.
#[derive(Debug)]
pub(crate) struct Correction {
    id: CurveId,
    stroke: Stroke,
    options: OversketchOptions,
}

impl Session {
    /// Wants a stroke drawn into a curve, after those that were drawn before.
    pub(crate) fn correct(&mut self, id: CurveId, stroke: Stroke, options: OversketchOptions) {
        self.corrections.push(Correction { id, stroke, options });
        self.want_all();
    }

    /// Wants the first stroke over each curve, for the curve as it is now.
    pub(crate) fn want_corrections(&mut self) {
        let drawing = self.history.drawing();
        self.corrections.retain(|correction| drawing.curve(correction.id).is_some());
        for (i, Correction { id, stroke, options }) in self.corrections.iter().enumerate() {
            let slot = Slot::Oversketch(*id);
            let is_first = self.corrections[..i].iter().all(|before| before.id != *id);
            let Some(curve) = drawing.curve(*id).filter(|curve| is_first && curve.fitted) else { continue };
            if !self.desk.is_wanted(slot, curve) {
                let (spline, stroke, options) = (curve.spline.clone(), stroke.clone(), Box::new(options.clone()));
                self.desk.want(Wish::new(slot, Some(curve)), Job::Oversketch { spline, stroke, options });
            }
        }
    }

    /// A curve gets the shape that the first stroke over it gave it, unless it has changed since that was asked for.
    pub(crate) fn corrected(&mut self, id: CurveId, of: &Arc<Curve>, fitted: Fitted) {
        if !self.drawing().curve(id).is_some_and(|curve| Arc::ptr_eq(curve, of)) {
            return;
        }
        self.take_correction(id);
        self.history.act("Oversketch", |drawing| drawing.put(of.edited(fitted.spline, &fitted.drawn)));
    }

    /// Takes the first stroke over a curve out.
    pub(crate) fn take_correction(&mut self, id: CurveId) {
        if let Some(at) = self.corrections.iter().position(|correction| correction.id == id) {
            self.corrections.remove(at);
        }
    }

    /// Takes back the last stroke that waits; false if none does.
    pub(crate) fn drop_correction(&mut self) -> bool {
        let Some(Correction { id, .. }) = self.corrections.pop() else { return false };
        if self.corrections.iter().all(|other| other.id != id) {
            self.desk.drop_wishes(Slot::Oversketch(id));
        }
        true
    }
}
