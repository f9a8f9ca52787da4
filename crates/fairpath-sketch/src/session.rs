//! A person at work: deeds and answers of the worker come in, a drawing with its history, jobs for the worker and what is to be shown of the work in hand go
//! out.

use crate::boxes::Boxes;
use crate::corrections::Correction;
use crate::curve::{Curve, CurveId, Pin};
use crate::desk::{Desk, Slot, Ticket, Wish};
use crate::drawing::Drawing;
use crate::file::Imported;
use crate::hand::Hand;
use crate::history::History;
use crate::job::{Job, NOT_HELD, Trouble, measured};
use crate::neatening::Neatening;
use fairpath_curve::{Point, Similarity, Spline, Vec2};
use fairpath_fit::{Template, TemplateError, TemplateSet};
use fairpath_shape::{InflateOptions, Mesh};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The name of the set of French curves that a person makes.
const OWN_TEMPLATES: &str = "mine";

/// A drawing and the work on it.
#[derive(Debug, Default)]
pub struct Session {
    pub(crate) history: History,
    pub(crate) desk: Desk,
    pub(crate) selection: BTreeSet<CurveId>,
    pub(crate) hand: Option<Hand>,
    /// How the next stroke will be neatened.
    neatening: Neatening,
    /// The last thing that did not work.
    trouble: Option<Trouble>,
    /// The surface that was made last, and the curve as it was then.
    pub(crate) surface: Option<(Arc<Curve>, Arc<Mesh>)>,
    /// The boxes around the curves, as of when they were last asked for.
    boxes: RefCell<Boxes>,
    /// Strokes drawn over curves that are not yet drawn into them, in their order.
    pub(crate) corrections: Vec<Correction>,
    /// How many strokes became curves of their own.
    pub(crate) strokes_drawn: u64,
    /// How many drawings were begun or opened.
    documents: u64,
}

impl Session {
    /// A session on a drawing; curves that are still to be fitted will be.
    #[must_use]
    pub fn new(drawing: Drawing) -> Self {
        let mut session = Self { history: History::new(drawing), ..Self::default() };
        session.want_all();
        session
    }

    /// The drawing.
    #[must_use]
    pub fn drawing(&self) -> &Drawing {
        self.history.drawing()
    }

    /// The drawing with its past.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// The curves that deeds are about.
    #[must_use]
    pub fn selection(&self) -> &BTreeSet<CurveId> {
        &self.selection
    }

    /// The only selected curve, if it is one.
    #[must_use]
    pub fn selected(&self) -> Option<&Arc<Curve>> {
        let id = self.selection.first().filter(|_| self.selection.len() == 1)?;
        self.drawing().curve(*id)
    }

    /// Selects a curve, or nothing; with `add` beside what is selected, or no longer if it is.
    pub fn select(&mut self, id: Option<CurveId>, add: bool) {
        if !add {
            self.selection.clear();
        }
        let Some(id) = id.filter(|&id| self.drawing().curve(id).is_some()) else { return };
        if !(add && self.selection.remove(&id)) {
            self.selection.insert(id);
        }
        if let Some(curve) = self.selected() {
            self.neatening = Neatening { pixel_size: 1.0, closed: self.neatening.closed, ..curve.neatening.clone() };
        }
    }

    /// Selects the curve after the selected one, or with `back` the one before, as they lie from the back to the front; from the last the first.
    pub fn select_next(&mut self, back: bool) {
        let curves = self.drawing().curves();
        let n = curves.len();
        let at = curves.iter().position(|curve| Some(curve.id) == self.selection.first().copied());
        let next = match (at, back) {
            (Some(i), false) => (i + 1) % n,
            (Some(i), true) => (i + n - 1) % n,
            (None, false) => 0,
            (None, true) => n.saturating_sub(1),
        };
        let id = curves.get(next).map(|curve| curve.id);
        self.select(id, false);
    }

    /// Selects every curve.
    pub fn select_all(&mut self) {
        self.selection = self.drawing().curves().iter().map(|curve| curve.id).collect();
    }

    /// The stroke in hand.
    #[must_use]
    pub fn hand(&self) -> Option<&Hand> {
        self.hand.as_ref()
    }

    /// How many strokes became curves of their own since the drawing was opened. Only grows, whatever is undone.
    #[must_use]
    pub fn strokes_drawn(&self) -> u64 {
        self.strokes_drawn
    }

    /// What did not work last, until it is taken.
    pub fn take_trouble(&mut self) -> Option<Trouble> {
        self.trouble.take()
    }

    pub(crate) fn report(&mut self, trouble: impl Into<Trouble>) {
        self.trouble = Some(trouble.into());
    }

    /// How the next stroke will be neatened; `pixel_size` is of no meaning here.
    #[must_use]
    pub fn neatening(&self) -> &Neatening {
        &self.neatening
    }

    /// Neatens the selected curves in another way, and strokes to come. Moves of a slider are one step of undo until
    /// [`end_gesture`](Self::end_gesture).
    pub fn set_neatening(&mut self, neatening: Neatening) {
        if let Err(trouble) = checked(&neatening) {
            return self.report(trouble);
        }
        self.neatening = neatening;
        let (wish, selection) = (&self.neatening, &self.selection);
        if selection.is_empty() {
            return;
        }
        self.history.act_on("Neaten", |drawing| {
            for &id in selection {
                let Some(curve) = drawing.curve(id) else { continue };
                let own = &curve.neatening;
                let neatening = Neatening { pixel_size: own.pixel_size, closed: own.closed, ..wish.clone() };
                if neatening != *own {
                    drawing.put(Curve { neatening, unpinned: None, fitted: false, ..(**curve).clone() });
                }
            }
        });
        self.want_all();
    }

    /// Ends what counts as one step of undo.
    pub fn end_gesture(&mut self) {
        self.history.end_gesture();
    }

    /// Undoes the last deed; a stroke over a curve that has not changed it yet is the last one.
    pub fn undo(&mut self) {
        if self.drop_correction() {
            self.want_all();
        } else if self.history.undo() {
            self.turned();
        }
    }

    /// Does the last undone deed again.
    pub fn redo(&mut self) {
        if self.history.redo() {
            self.turned();
        }
    }

    /// The drawing is another one: what was under way is of no use.
    fn turned(&mut self) {
        self.desk.clear();
        self.corrections.clear();
        let drawing = self.history.drawing();
        self.selection.retain(|&id| drawing.curve(id).is_some());
        self.surface = None;
        self.want_all();
    }

    /// Begins anew with another drawing and no past: what was there is gone.
    pub fn begin_anew(&mut self, mut drawing: Drawing) {
        let neatening = std::mem::take(&mut self.neatening);
        let (desk, documents) = (std::mem::take(&mut self.desk), self.documents + 1);
        *self = Self { neatening, desk, documents, ..Self::default() };
        self.desk.clear();
        drawing.document = documents;
        self.history = History::new(drawing);
        self.want_all();
    }

    /// Opens another drawing in the place of this one, with its unit and direction of y: a deed, from which undo leads back. Its curves get identities that
    /// none of this one ever had. A stroke in hand is dropped, and as with undo, strokes over curves that wait to be drawn into them.
    pub fn open(&mut self, drawing: Drawing) {
        self.exchange("Open", drawing);
    }

    /// Puts this drawing aside for an empty one in the same unit: a deed, from which undo leads back.
    pub fn begin_new(&mut self) {
        let empty = Drawing::new(self.drawing().unit, self.drawing().y);
        self.exchange("New", empty);
    }

    fn exchange(&mut self, deed: &str, drawing: Drawing) {
        self.documents += 1;
        let mut drawing = drawing.named_apart(self.drawing());
        drawing.document = self.documents;
        self.history.act(deed, |present| *present = drawing);
        self.hand = None;
        self.selection.clear();
        self.turned();
    }

    /// Makes a French curve of the selected curve, in a set of this drawing's own, whose name is given back.
    pub fn author_template(&mut self) -> Option<String> {
        let curve = self.selected()?.clone();
        // Templates are in px, whatever the drawing's unit and nearness.
        let to_px = Similarity { scale: 1.0 / curve.neatening.pixel_size, ..Similarity::IDENTITY };
        let made = self.history.act("French curve", |drawing| {
            let own = drawing.template_sets.iter().position(|set| set.name() == OWN_TEMPLATES);
            let mut templates = own.map_or_else(Vec::new, |i| drawing.template_sets[i].templates().to_vec());
            let taken = |name: &String| templates.iter().any(|template| template.name() == name.as_str());
            let name = (1..).map(|i| format!("{} {i}", curve.name)).find(|name| !taken(name)).unwrap_or_default();
            templates.push(Template::new(name, curve.spline.transformed(&to_px))?);
            let set = Arc::new(TemplateSet::new(OWN_TEMPLATES, templates)?);
            match own {
                Some(i) => drawing.template_sets[i] = set,
                None => drawing.template_sets.push(set),
            }
            Ok::<(), TemplateError>(())
        });
        match made {
            Ok(()) => Some(OWN_TEMPLATES.to_owned()),
            Err(error) => {
                self.report(Trouble { code: "no-template".into(), text: error.to_string() });
                None
            }
        }
    }

    /// Adds a set of French curves to the drawing's own, in the place of one that has its name, and gives that back.
    pub fn add_templates(&mut self, set: TemplateSet) -> String {
        let (name, set) = (set.name().to_owned(), Arc::new(set));
        self.history.act("French curves", |drawing| {
            match drawing.template_sets.iter_mut().find(|own| own.name() == name) {
                Some(own) => *own = set,
                None => drawing.template_sets.push(set),
            }
        });
        name
    }

    /// Goes on with a drawing that was kept, from which undo leads back to an empty one.
    pub fn restore(&mut self, drawing: Drawing) {
        self.begin_anew(Drawing::new(drawing.unit, drawing.y));
        self.exchange("Restore", drawing);
    }

    /// Adds the curves of a file and selects them. A drawing that was empty takes over the unit and the direction of y that they are in.
    pub fn import(&mut self, imported: Imported) {
        let Imported { unit, y, curves, .. } = imported;
        self.add_to("Import", curves, |drawing| (drawing.unit, drawing.y) = (unit, y));
    }

    /// Adds curves and selects them.
    pub fn add(&mut self, deed: &str, curves: Vec<Curve>) {
        self.add_to(deed, curves, |_| ());
    }

    fn add_to(&mut self, deed: &str, curves: Vec<Curve>, prepare: impl FnOnce(&mut Drawing)) {
        let ids = self.history.act(deed, |drawing| {
            prepare(drawing);
            let put = |mut curve: Curve| {
                curve.id = drawing.new_id();
                let id = curve.id;
                // Files know curves by their names.
                if drawing.curves().iter().any(|other| other.name == curve.name) {
                    curve.name = drawing.free_name(&curve.name);
                }
                drawing.put(curve);
                id
            };
            curves.into_iter().map(put).collect()
        });
        self.selection = ids;
        self.want_all();
    }

    /// The next job for the worker, when that is free.
    pub fn next_job(&mut self) -> Option<(Ticket, Job)> {
        self.desk.next_job()
    }

    /// Whether everything that was wanted is done.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.desk.is_idle() && self.corrections.is_empty()
    }

    /// Wants the surface of the selected curve.
    pub fn inflate(&mut self, options: InflateOptions) {
        let Some(curve) = self.selected() else { return };
        let spline = curve.spline.clone();
        let wish = Wish::new(Slot::Surface(curve.id), Some(curve));
        self.desk.want(wish, Job::Inflate { spline, options });
    }

    /// The surface that was made last and the curve that it comes from, as long as that is as it was.
    #[must_use]
    pub fn surface(&self) -> Option<(CurveId, &Arc<Mesh>)> {
        let (of, mesh) = self.surface.as_ref()?;
        let is_as_it_was = self.drawing().curve(of.id).is_some_and(|curve| curve.spline == of.spline);
        is_as_it_was.then_some((of.id, mesh))
    }

    /// Shows no surface any more.
    pub fn drop_surface(&mut self) {
        self.surface = None;
    }

    /// The curve nearest to a point within `reach`, and its nearest place: a station.
    #[must_use]
    pub fn nearest(&self, point: Point, reach: f64) -> Option<(CurveId, f64)> {
        let mut boxes = self.boxes.borrow_mut();
        boxes.update(self.drawing().curves(), self.history.version());
        let measured = boxes.near(point, reach).map(|curve| (curve, curve.spline.nearest(point)));
        let near = measured.filter(|(_, nearest)| nearest.distance <= reach);
        let best = near.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance));
        best.map(|(curve, nearest)| (curve.id, curve.spline.station(nearest.segment, nearest.s)))
    }

    /// Changes one curve under the name of a deed.
    pub(crate) fn change(&mut self, deed: &str, id: CurveId, change: impl FnOnce(&Curve) -> Curve) {
        self.desk.drop_wishes(Slot::Curve(id));
        self.history.act(deed, |drawing| {
            if let Some(curve) = drawing.curve(id) {
                drawing.put(change(curve));
            }
        });
        self.want_all();
    }

    /// Gives one curve another shape.
    pub(crate) fn reshape(&mut self, deed: &str, id: CurveId, spline: Spline) {
        self.change(deed, id, |curve| curve.edited(spline, &[]));
    }

    /// Moves the selected curves; moves that follow each other are one step.
    pub fn move_selected(&mut self, by: Vec2) {
        let stays = |id: &CurveId| self.drawing().curve(*id).is_none_or(|curve| stays_exact(curve, by));
        if !self.selection.iter().all(stays) {
            let text = "so far away the drawing would lose its shape; move it by less".into();
            return self.report(Trouble { code: "too-far".into(), text });
        }
        let selection = &self.selection;
        for &id in selection {
            // What is under way is for another place.
            self.desk.drop_wishes(Slot::Curve(id));
        }
        self.history.act_on("Move", |drawing| {
            for &id in selection {
                if let Some(curve) = drawing.curve(id) {
                    drawing.put(curve.moved(by));
                }
            }
        });
        self.want_all();
    }

    /// Deletes the selected curves.
    pub fn delete_selected(&mut self) {
        let selection = std::mem::take(&mut self.selection);
        for &id in &selection {
            self.desk.drop_wishes(Slot::Curve(id));
        }
        self.history.act("Delete", |drawing| {
            for id in selection {
                drawing.remove(id);
            }
        });
        self.want_all();
    }

    /// Copies the selected curves beside themselves and selects the copies.
    pub fn duplicate_selected(&mut self, by: Vec2) {
        let copies = self.selection.iter().filter_map(|&id| self.drawing().curve(id));
        let copies: Vec<Curve> = copies.map(|curve| curve.moved(by)).collect();
        if !copies.is_empty() {
            self.add("Duplicate", copies);
        }
    }

    /// Lets a curve go from one of the places through which it is held.
    pub fn unpin(&mut self, id: CurveId, index: usize) {
        let Some(curve) = self.drawing().curve(id).filter(|curve| index < curve.pins.len()) else { return };
        let mut curve = (**curve).clone();
        curve.pins.remove(index);
        match curve.unpinned.take_if(|_| curve.pins.is_empty()) {
            Some(free) => {
                curve.report = measured(&free, &curve.stroke, &curve.report, curve.neatening.pixel_size);
                curve.spline = Arc::unwrap_or_clone(free);
                curve.fitted = true;
                curve.warnings.retain(|warning| warning.code != NOT_HELD);
            }
            None => curve.fitted = false,
        }
        self.change("Let go", id, |_| curve);
    }

    /// Holds a curve through a point; while the pin is dragged, under one step.
    pub fn pin(&mut self, id: CurveId, index: Option<usize>, pin: Pin) -> Option<usize> {
        if !(pin.point.is_finite() && (0.0..=1.0).contains(&pin.share)) {
            return None;
        }
        let mut at = None;
        self.history.act_on("Pull", |drawing| {
            let Some(curve) = drawing.curve(id) else { return };
            let mut curve = (**curve).clone();
            if curve.pins.is_empty() && curve.fitted {
                curve.unpinned = Some(Arc::new(curve.spline.clone()));
            }
            let i = index.filter(|&i| i < curve.pins.len()).unwrap_or(curve.pins.len());
            match curve.pins.get_mut(i) {
                Some(old) => *old = pin,
                None => curve.pins.push(pin),
            }
            curve.fitted = false;
            drawing.put(curve);
            at = Some(i);
        });
        self.want_all();
        at
    }
}

/// A coordinate of more than this many lengths of a curve has too few digits left for its shape.
const FARTHEST: f64 = 1e8;

/// Whether a curve keeps its shape there.
fn stays_exact(curve: &Curve, by: Vec2) -> bool {
    let start = curve.spline.start_pose().point + by;
    start.is_finite() && start.to_vec2().hypot() <= FARTHEST * curve.spline.length()
}

/// Whether a neatening can be done.
fn checked(neatening: &Neatening) -> Result<(), Trouble> {
    let bad = |error: &dyn std::error::Error| Trouble { code: "bad-option".into(), text: error.to_string() };
    let settings = neatening.settings().map_err(|error| bad(&error))?;
    settings.check().map_err(|error| bad(&error))
}
