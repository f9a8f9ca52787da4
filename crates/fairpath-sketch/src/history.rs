//! Undo and redo: every state of a drawing with the name of what led to it.
//!
//! A state shares with its neighbours all curves that did not change, so it costs a pointer for each curve; undoing is exact
//! because nothing is computed backwards.

use crate::curve::Curve;
use crate::drawing::Drawing;
use std::sync::Arc;

/// Most states that are kept.
const DEEPEST: usize = 1000;

/// A state and what was done to get there.
#[derive(Clone, Debug)]
struct State {
    drawing: Drawing,
    revision: u64,
    /// What a person would call it, such as `Draw`.
    deed: String,
}

/// A drawing with its past, and what was undone.
#[derive(Clone, Debug, Default)]
pub struct History {
    present: Drawing,
    past: Vec<State>,
    future: Vec<State>,
    /// Grows with every change, undone ones too.
    version: u64,
    /// Which state the present is: undoing leads back to the number that a state had.
    revision: u64,
    /// Deeds of one gesture, such as the moves of a slider, are one step; this names the gesture that goes on.
    gesture: Option<String>,
}

impl History {
    /// A history that begins with this drawing.
    #[must_use]
    pub fn new(drawing: Drawing) -> Self {
        Self { present: drawing, ..Self::default() }
    }

    /// The drawing as it is.
    #[must_use]
    pub fn drawing(&self) -> &Drawing {
        &self.present
    }

    /// Grows whenever the drawing changes.
    #[must_use]
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Tells states of the drawing apart: after a deed was undone it is what it was before, so whoever saved that state knows that nothing differs.
    /// What a fit finds makes no other state of it: the same is found again for whoever opens what was saved before.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Does something to the drawing that can be undone.
    pub fn act<R>(&mut self, deed: &str, change: impl FnOnce(&mut Drawing) -> R) -> R {
        self.gesture = None;
        self.step(deed, change)
    }

    /// As [`act`](Self::act); what is done under the same name one after the other is one step.
    pub fn act_on<R>(&mut self, deed: &str, change: impl FnOnce(&mut Drawing) -> R) -> R {
        if self.gesture.as_deref() == Some(deed) {
            return self.amend(change);
        }
        let before = self.version;
        let result = self.step(deed, change);
        // What changed nothing left no step that the next deed could belong to.
        if self.version != before {
            self.gesture = Some(deed.to_owned());
        }
        result
    }

    /// The next deed is a step of its own even if it has the name of the last one.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// Changes the present without a step of its own: for what follows from the last deed, such as the curve that a stroke becomes.
    pub fn amend<R>(&mut self, change: impl FnOnce(&mut Drawing) -> R) -> R {
        self.version += 1;
        self.revision = self.version;
        change(&mut self.present)
    }

    /// Puts a curve in the place of a certain state of it, wherever in past, present and future that is: for what a fit found, which is the same then
    /// as now.
    pub(crate) fn supersede(&mut self, old: &Arc<Curve>, new: Curve) {
        self.version += 1;
        let new = Arc::new(new);
        let is_present = self.present.supersede(old, &new);
        // From when it came to when it went, a state of a curve is in every drawing.
        for states in [&mut self.past, &mut self.future] {
            let mut seen = is_present;
            for state in states.iter_mut().rev() {
                let has_it = state.drawing.supersede(old, &new);
                if seen && !has_it {
                    break;
                }
                seen = has_it;
            }
        }
    }

    fn step<R>(&mut self, deed: &str, change: impl FnOnce(&mut Drawing) -> R) -> R {
        let before = self.present.clone();
        let result = change(&mut self.present);
        if self.present != before {
            self.version += 1;
            let revision = std::mem::replace(&mut self.revision, self.version);
            self.past.push(State { drawing: before, revision, deed: deed.to_owned() });
            if self.past.len() > DEEPEST {
                self.past.remove(0);
            }
            self.future.clear();
        }
        result
    }

    /// What would be undone.
    #[must_use]
    pub fn undoable(&self) -> Option<&str> {
        self.past.last().map(|state| state.deed.as_str())
    }

    /// What would be done again.
    #[must_use]
    pub fn redoable(&self) -> Option<&str> {
        self.future.last().map(|state| state.deed.as_str())
    }

    /// Undoes the last deed; false if there is none.
    pub fn undo(&mut self) -> bool {
        let Some(state) = self.past.pop() else { return false };
        let undone = self.turn(state);
        self.future.push(undone);
        true
    }

    /// Does the last undone deed again; false if there is none.
    pub fn redo(&mut self) -> bool {
        let Some(state) = self.future.pop() else { return false };
        let done = self.turn(state);
        self.past.push(done);
        true
    }

    /// Makes a state the present; what was the present, with the deed that lies between the two.
    fn turn(&mut self, mut state: State) -> State {
        // Identities are never given twice, not even when the curve that had one was undone.
        state.drawing.name_after(&self.present);
        std::mem::swap(&mut self.present, &mut state.drawing);
        std::mem::swap(&mut self.revision, &mut state.revision);
        self.version += 1;
        self.gesture = None;
        state
    }
}
