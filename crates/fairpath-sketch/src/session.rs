//! A person at work: deeds and answers of the worker come in, a drawing with its history, jobs for the worker and what is to be shown of the work in hand go
//! out.

use crate::background::Background;
use crate::curve::{Curve, CurveId, Pin};
use crate::desk::{Desk, Slot, Ticket};
use crate::drawing::Drawing;
use crate::hand::Hand;
use crate::history::History;
use crate::job::{Answer, Fitted, Job, Trouble};
use crate::neatening::Neatening;
use fairpath_curve::{Point, Similarity, Spline, Vec2};
use fairpath_fit::{OversketchOptions, Stroke, Template, TemplateError, TemplateSet};
use fairpath_shape::{InflateOptions, Mesh};
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
    surface: Option<(CurveId, Arc<Mesh>)>,
}

impl Session {
    /// A session on a drawing; curves that are still to be fitted will be.
    #[must_use]
    pub fn new(drawing: Drawing) -> Self {
        let mut session = Self { history: History::new(drawing), ..Self::default() };
        session.want_unfitted();
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
        let Some(id) = id else { return };
        if !(add && self.selection.remove(&id)) {
            self.selection.insert(id);
        }
        if let Some(curve) = self.selected() {
            self.neatening = Neatening { pixel_size: 1.0, closed: self.neatening.closed, ..curve.neatening.clone() };
        }
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
        if let Err(error) = neatening.settings() {
            self.trouble = Some(Trouble { code: "bad-option".into(), text: error.to_string() });
            return;
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
                    drawing.put(Curve { neatening, fitted: false, ..(**curve).clone() });
                }
            }
        });
        self.want_unfitted();
    }

    /// Ends what counts as one step of undo.
    pub fn end_gesture(&mut self) {
        self.history.end_gesture();
    }

    /// Undoes the last deed.
    pub fn undo(&mut self) {
        if self.history.undo() {
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
        let drawing = self.history.drawing();
        self.selection.retain(|&id| drawing.curve(id).is_some());
        self.surface = None;
        self.want_unfitted();
    }

    /// Begins anew with another drawing, which cannot be undone.
    pub fn open(&mut self, drawing: Drawing) {
        let neatening = std::mem::take(&mut self.neatening);
        *self = Self { neatening, desk: std::mem::take(&mut self.desk), ..Self::default() };
        self.desk.clear();
        self.history = History::new(drawing);
        self.want_unfitted();
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

    /// Puts a picture behind the drawing, or takes it away.
    pub fn set_background(&mut self, background: Option<Arc<Background>>) {
        self.history.act("Picture", |drawing| drawing.background = background);
    }

    /// Goes on with a drawing that was kept, from which undo leads back to an empty one.
    pub fn restore(&mut self, drawing: Drawing) {
        self.open(Drawing::new(drawing.unit, drawing.y));
        self.history.act("Restore", |empty| *empty = drawing);
        self.want_unfitted();
    }

    /// Adds curves, such as those of a file, and selects them.
    pub fn add(&mut self, deed: &str, curves: Vec<Curve>) {
        let ids = self.history.act(deed, |drawing| {
            let put = |mut curve: Curve| {
                curve.id = drawing.new_id();
                let id = curve.id;
                drawing.put(curve);
                id
            };
            curves.into_iter().map(put).collect()
        });
        self.selection = ids;
        self.want_unfitted();
    }

    /// Wants every curve that is still to be fitted.
    pub(crate) fn want_unfitted(&mut self) {
        let drawing = self.history.drawing();
        for curve in drawing.curves().iter().filter(|curve| !curve.fitted) {
            let job = Job::Fit {
                stroke: curve.stroke.clone(),
                templates: drawing.templates_for(&curve.neatening),
                neatening: curve.neatening.clone(),
                pins: curve.pins.clone(),
            };
            self.desk.want_also(Slot::Curve(curve.id), job);
        }
    }

    /// The next job for the worker, when that is free.
    pub fn next_job(&mut self) -> Option<(Ticket, Job)> {
        self.desk.next()
    }

    /// Whether everything that was wanted is done.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.desk.is_idle()
    }

    /// Takes the worker's answer to a job.
    pub fn take_answer(&mut self, ticket: Ticket, answer: Answer) {
        let Some(slot) = self.desk.done(ticket) else { return };
        match (slot, answer) {
            (Slot::Curve(id), Answer::Curve(fitted)) => self.fitted(id, *fitted),
            (Slot::Curve(id), Answer::Failed(trouble)) => {
                self.give_up(id);
                self.trouble = Some(trouble);
            }
            (Slot::Live | Slot::Preview, Answer::Curve(fitted)) => {
                if let Some(hand) = &mut self.hand {
                    hand.take(slot, *fitted);
                }
            }
            // A stroke that has only begun has no curve yet.
            (Slot::Live | Slot::Preview, Answer::Failed(_)) => {}
            (Slot::Oversketch(id), Answer::Curve(fitted)) => self.oversketched(id, *fitted),
            (Slot::Surface(id), Answer::Surface(mesh)) => self.surface = Some((id, Arc::new(mesh))),
            (Slot::Oversketch(_) | Slot::Surface(_), Answer::Failed(trouble)) => self.trouble = Some(trouble),
            (slot, _) => {
                let text = format!("the worker gave {slot:?} something that it did not ask for");
                self.trouble = Some(Trouble { code: "bad-answer".into(), text });
            }
        }
    }

    /// A curve gets the shape that the worker found.
    fn fitted(&mut self, id: CurveId, fitted: Fitted) {
        // While a slider moves, an older wish is shown until the newest is done.
        let newest = !self.desk.is_busy(Slot::Curve(id));
        self.history.amend(|drawing| {
            let Some(curve) = drawing.curve(id).map(|curve| (**curve).clone()) else { return };
            let Fitted { spline, report, warnings, templates, .. } = fitted;
            drawing.put(Curve { spline, report, warnings, templates, fitted: newest, ..curve });
        });
    }

    /// A curve keeps the shape that it has.
    fn give_up(&mut self, id: CurveId) {
        self.history.amend(|drawing| {
            if let Some(curve) = drawing.curve(id) {
                drawing.put(Curve { fitted: true, ..(**curve).clone() });
            }
        });
    }

    /// A curve gets the shape that a stroke over it gave it.
    fn oversketched(&mut self, id: CurveId, fitted: Fitted) {
        self.history.act("Oversketch", |drawing| {
            if let Some(curve) = drawing.curve(id) {
                drawing.put(curve.edited(fitted.spline, &fitted.drawn));
            }
        });
    }

    /// Wants a stroke drawn into a curve.
    pub(crate) fn want_oversketch(&mut self, id: CurveId, stroke: Stroke, options: OversketchOptions) {
        let Some(curve) = self.drawing().curve(id) else { return };
        let job = Job::Oversketch { spline: curve.spline.clone(), stroke, options: Box::new(options) };
        self.desk.drop_wishes(Slot::Curve(id));
        self.desk.want(Slot::Oversketch(id), job);
    }

    /// Wants the surface of the selected curve.
    pub fn inflate(&mut self, options: InflateOptions) {
        let Some(curve) = self.selected() else { return };
        let (id, spline) = (curve.id, curve.spline.clone());
        self.desk.want(Slot::Surface(id), Job::Inflate { spline, options });
    }

    /// The surface that was made last and the curve that it comes from, as long as that is as it was.
    #[must_use]
    pub fn surface(&self) -> Option<(CurveId, &Arc<Mesh>)> {
        self.surface.as_ref().map(|(id, mesh)| (*id, mesh))
    }

    /// Shows no surface any more.
    pub fn drop_surface(&mut self) {
        self.surface = None;
    }

    /// The curve nearest to a point within `reach`, and its nearest place: a station.
    #[must_use]
    pub fn nearest(&self, point: Point, reach: f64) -> Option<(CurveId, f64)> {
        let within = |curve: &&Arc<Curve>| curve.spline.bounding_box().inflate(reach, reach).contains(point);
        let candidates = self.drawing().curves().iter().filter(within);
        let measured = candidates.map(|curve| (curve, curve.spline.nearest(point)));
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
    }

    /// Gives one curve another shape.
    pub(crate) fn reshape(&mut self, deed: &str, id: CurveId, spline: Spline) {
        self.change(deed, id, |curve| curve.edited(spline, &[]));
    }

    /// Moves the selected curves; moves that follow each other are one step.
    pub fn move_selected(&mut self, by: Vec2) {
        let selection = &self.selection;
        self.history.act_on("Move", |drawing| {
            for &id in selection {
                if let Some(curve) = drawing.curve(id) {
                    drawing.put(curve.moved(by));
                }
            }
        });
        self.want_unfitted();
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
    }

    /// Copies the selected curves beside themselves and selects the copies.
    pub fn duplicate_selected(&mut self, by: Vec2) {
        let copies = self.selection.iter().filter_map(|&id| self.drawing().curve(id));
        let copies: Vec<Curve> = copies.map(|curve| curve.moved(by)).collect();
        if !copies.is_empty() {
            self.add("Duplicate", copies);
        }
    }

    /// Holds a curve through a point; while the pin is dragged, under one step.
    pub fn pin(&mut self, id: CurveId, index: Option<usize>, pin: Pin) -> Option<usize> {
        let mut at = None;
        self.history.act_on("Pull", |drawing| {
            let Some(curve) = drawing.curve(id) else { return };
            let mut curve = (**curve).clone();
            let i = index.filter(|&i| i < curve.pins.len()).unwrap_or(curve.pins.len());
            if i == curve.pins.len() {
                curve.pins.push(pin)
            } else {
                curve.pins[i] = pin
            }
            curve.fitted = false;
            drawing.put(curve);
            at = Some(i);
        });
        self.want_unfitted();
        at
    }
}
