//! The application: what it holds, and the order in which a frame goes.

use crate::canvas::{Canvas, Work, suitable_comb};
use crate::documents::Document;
use crate::files::Files;
use crate::pace::{Pace, PaceReport};
use crate::panels::{self, Panels};
use crate::store::Store;
use crate::surface_view::SurfaceView;
use crate::view::View;
use crate::worker::Worker;
use crate::{example, theme};
use eframe::egui::{self, CentralPanel, Context, Frame, Theme, Ui};
use fairpath_curve::Point;
use fairpath_io::Unit;
use fairpath_sketch::{Answer, Curve, CurveId, Drawing, Neatening, Session};
use std::time::Duration;
use web_time::Instant;

/// How long the curve of a stroke that has just ended is waited for: a picture of a common screen, and nobody is drawing meanwhile.
const MOMENT: Duration = Duration::from_millis(16);

/// What a press on the canvas does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tool {
    /// Draws a stroke; near a curve, over it.
    #[default]
    Draw,
    /// Selects, moves and lengthens.
    Select,
    /// Holds a curve through points.
    Pull,
    /// Cuts a curve.
    Cut,
    /// Makes corners and smooths them.
    Corner,
    /// Moves the picture to trace over.
    Picture,
}

/// In which colours curves are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Ink {
    /// Lines red, arcs green, clothoids blue.
    #[default]
    Kinds,
    /// All alike.
    Plain,
}

/// What is shown of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shown {
    pub(crate) ink: Ink,
    /// The strokes as they were drawn.
    pub(crate) ghost: bool,
    pub(crate) grid: bool,
    pub(crate) comb: bool,
    /// Length of a comb's tooth for a curvature of one, in the drawing's unit squared.
    pub(crate) comb_scale: f64,
    /// Whether a hand chose that.
    pub(crate) comb_by_hand: bool,
    /// The curvature along the selected curve, under the canvas.
    pub(crate) plot: bool,
    /// The figures of the selected curve, beside the canvas.
    pub(crate) inspector: bool,
    /// The French curves that the selected curve is made of.
    pub(crate) templates: bool,
    /// Parts of French curves are laid while a stroke is drawn.
    pub(crate) greedy: bool,
}

impl Default for Shown {
    fn default() -> Self {
        Self {
            ink: Ink::Kinds,
            ghost: true,
            grid: true,
            comb: false,
            comb_scale: 1500.0,
            comb_by_hand: false,
            plot: false,
            inspector: true,
            templates: true,
            greedy: false,
        }
    }
}

/// The application.
pub struct App {
    pub(crate) session: Session,
    worker: Box<dyn Worker>,
    pub(crate) view: View,
    pub(crate) canvas: Canvas,
    pub(crate) tool: Tool,
    pub(crate) shown: Shown,
    pub(crate) panels: Panels,
    pace: Pace,
    /// The curves whose strokes ended in this frame: mostly one, but two strokes may be quicker than a slow screen.
    drawn: Vec<CurveId>,
    pub(crate) document: Document,
    pub(crate) files: Files,
    pub(crate) store: Box<dyn Store>,
    /// All is to be shown as soon as the canvas has its size.
    pub(crate) fit_view: bool,
    /// Where surfaces are seen, if there is a graphics device that draws them.
    pub(crate) surface_view: Option<SurfaceView>,
}

impl App {
    /// The application with a worker and a store of the caller's, on what the store has kept, or the drawing of a first start.
    #[must_use]
    pub fn new(ctx: &Context, worker: Box<dyn Worker>, mut store: Box<dyn Store>) -> Self {
        theme::install(ctx);
        store.ask();
        let mut app = Self {
            session: Session::new(first_drawing()),
            worker,
            view: View::default(),
            canvas: Canvas::default(),
            tool: Tool::default(),
            shown: Shown::default(),
            panels: Panels::default(),
            pace: Pace::default(),
            drawn: Vec::new(),
            document: Document::default(),
            files: Files::default(),
            store,
            fit_view: true,
            surface_view: None,
        };
        app.panels.hint = true;
        app
    }

    /// The application for a window that is cleared with [`clear_color`](eframe::App::clear_color) for each picture, as eframe's are. Then it does not
    /// lay its paper over all of it once more, which takes long where software draws.
    #[must_use]
    pub fn in_cleared_window(mut self) -> Self {
        self.canvas.window_is_paper = true;
        self
    }

    /// The application with a thread that fits.
    ///
    /// # Panics
    /// When the system gives no thread.
    #[cfg(not(target_arch = "wasm32"))]
    #[must_use]
    pub fn on_desktop(ctx: &Context) -> Self {
        let store: Box<dyn Store> = match crate::store::FileStore::of_user() {
            Some(store) => Box::new(store),
            None => Box::new(crate::store::NoStore),
        };
        Self::with_thread(ctx, store)
    }

    /// The application with a thread that fits, and a store of the caller's.
    ///
    /// # Panics
    /// When the system gives no thread.
    #[cfg(not(target_arch = "wasm32"))]
    #[must_use]
    pub fn with_thread(ctx: &Context, store: Box<dyn Store>) -> Self {
        let worker = crate::worker::ThreadWorker::start(ctx.clone()).expect("the system gives a thread");
        Self::new(ctx, Box::new(worker), store)
    }

    /// How fast it was so far.
    #[must_use]
    pub fn pace(&self) -> PaceReport {
        self.pace.report()
    }

    /// Each time from the last point of a stroke to its curve in the picture, milliseconds.
    #[must_use]
    pub fn curve_times_ms(&self) -> &[f64] {
        self.pace.curves_ms()
    }

    /// The work for each picture while a stroke was drawn, milliseconds.
    #[must_use]
    pub fn frame_times_ms(&self) -> &[f64] {
        self.pace.frames_ms()
    }

    /// Begins to time anew.
    pub fn forget_pace(&mut self) {
        self.pace = Pace::default();
    }

    /// Makes a picture without a window, up to the triangles that a graphics device would be given.
    pub fn frame_without_window(&mut self, ctx: &Context, input: egui::RawInput) {
        let mut output = ctx.run_ui(input, |ui| self.frame(ui));
        // There is no device that would take them.
        output.textures_delta.clear();
        let triangles = ctx.tessellate(output.shapes, output.pixels_per_point);
        self.end_frame();
        drop(triangles);
    }

    fn frame(&mut self, ui: &mut Ui) {
        let before = self.session.strokes_drawn();
        self.pace.begin(self.session.hand().is_some());
        self.take_answers();
        self.read_files(ui.ctx());
        self.keep(ui.ctx());
        self.set_title(ui.ctx());
        theme::suit_fingers(ui);
        panels::shortcuts::read(self, ui);
        panels::plot::show(self, ui);
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            let Self { session, view, tool, shown, .. } = self;
            self.canvas.show(ui, Work { session, view, tool: *tool, shown });
            if std::mem::take(&mut self.fit_view) {
                self.fit_view();
                ui.ctx().request_repaint();
            }
            panels::show(self, ui);
        });
        if let Some(trouble) = self.session.take_trouble() {
            self.panels.say(trouble.text);
        }
        self.take_answers();
        let drawn = self.session.strokes_drawn().saturating_sub(before);
        if drawn > 0 {
            let newest = self.session.drawing().curves().iter().rev().take(drawn as usize);
            self.drawn.extend(newest.map(|curve| curve.id));
            self.wait_for_drawn(ui.ctx());
        }
    }

    /// Gives the curve of a stroke that has just ended a moment to come, so that it is in this picture already, which then is made anew: the screen may show the
    /// next one much later.
    fn wait_for_drawn(&mut self, ctx: &Context) {
        let begun = Instant::now();
        let are_there =
            |app: &Self| app.drawn.iter().all(|id| app.session.drawing().curve(*id).is_none_or(|curve| curve.fitted));
        while !are_there(self) {
            let Some(left) = MOMENT.checked_sub(begun.elapsed()) else { return };
            let answers = self.worker.answers_within(left);
            if answers.is_empty() {
                return;
            }
            answers.into_iter().for_each(|(ticket, answer)| self.session.take_answer(ticket, answer));
            self.take_answers();
        }
        ctx.request_discard("the curve of the stroke is there");
    }

    fn end_frame(&mut self) {
        self.pace.end(&std::mem::take(&mut self.drawn), self.session.drawing());
    }

    /// The work on the drawing.
    #[must_use]
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// The work on the drawing, to change it.
    pub fn session_mut(&mut self) -> &mut Session {
        &mut self.session
    }

    /// Whether every curve that was asked for is there.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        self.session.is_settled()
    }

    /// Shows all of the drawing.
    pub(crate) fn fit_view(&mut self) {
        let boxes = self.session.drawing().curves().iter().map(|curve| curve.spline.bounding_box());
        if let Some(all) = boxes.reduce(|a, b| a.union(b)) {
            self.view.fit(Point::new(all.x0, all.y0), Point::new(all.x1, all.y1), panels::room(self));
        }
        self.fit_combs();
    }

    /// Makes the teeth of combs as long as suits what is drawn and how near it is seen, unless a hand has chosen that.
    pub(crate) fn fit_combs(&mut self) {
        if !self.shown.comb_by_hand {
            let curves = self.session.drawing().curves();
            self.shown.comb_scale = suitable_comb(curves.iter().map(|curve| &curve.spline), &self.view);
        }
    }

    /// Measures the drawing in another unit; what is seen stays.
    pub(crate) fn measure_in(&mut self, unit: Unit) {
        self.canvas.cancel(&mut self.session);
        let factor = self.session.measure_in(unit);
        self.view.rescale(factor);
        self.shown.comb_scale *= factor * factor;
    }

    /// Neatens with a set of French curves from now on.
    pub(crate) fn choose_templates(&mut self, set: String) {
        let wish = Neatening { templates: set, ..self.session.neatening().clone() };
        self.session.set_neatening(wish);
    }

    fn take_answers(&mut self) {
        for (ticket, answer) in self.worker.answers() {
            self.session.take_answer(ticket, answer);
        }
        while let Some((ticket, job)) = self.session.next_job() {
            self.worker.submit(ticket, job);
            let answers: Vec<(_, Answer)> = self.worker.answers();
            if answers.is_empty() {
                break;
            }
            // A worker that answers at once is asked again.
            answers.into_iter().for_each(|(ticket, answer)| self.session.take_answer(ticket, answer));
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        if self.surface_view.is_none() {
            self.surface_view = frame.wgpu_render_state().map(SurfaceView::new);
        }
        self.frame(ui);
        // A picture that is made anew at once is one with the next.
        if !ui.ctx().will_discard() {
            self.end_frame();
        }
    }

    /// The page asks the application about its drawing.
    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(&mut *self)
    }

    fn on_exit(&mut self) {
        self.keep_now();
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        let theme = if visuals.dark_mode { Theme::Dark } else { Theme::Light };
        theme::Palette::of(theme).paper.to_normalized_gamma_f32()
    }
}

/// The drawing of a first start.
fn first_drawing() -> Drawing {
    let file = example::strokes();
    let mut drawing = Drawing::new(file.unit, file.y);
    for (i, stroke) in file.strokes.into_iter().enumerate() {
        if let Ok(curve) = Curve::drawn(CurveId(i as u64 + 1), stroke, Neatening::default()) {
            drawing.put(curve);
        }
    }
    drawing
}
