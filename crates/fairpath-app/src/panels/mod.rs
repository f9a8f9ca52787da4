//! What floats over the canvas and lies beside it.

mod advanced;
mod hint;
mod inspector;
mod menu;
mod neaten;
pub(crate) mod plot;
pub(crate) mod shortcuts;
mod surface;
mod toolbar;
mod widgets;

use crate::app::App;
use crate::theme;
use eframe::egui::{self, Align2, Area, Id, InnerResponse, Ui, Vec2};

/// Distance of what floats from the edge of the canvas, points.
const MARGIN: f32 = 12.0;

/// What the panels remember.
#[derive(Debug, Default)]
pub(crate) struct Panels {
    /// The hint of a first start.
    pub(crate) hint: bool,
    /// The list of shortcuts.
    pub(crate) shortcuts: bool,
    /// All options of the method.
    pub(crate) advanced: bool,
    /// Surfaces are striped, to judge their fairness.
    pub(crate) zebra: bool,
    /// Something to be said, and since when it is shown, seconds.
    notice: Option<(String, Option<f64>)>,
}

impl Panels {
    /// Says something for a while.
    pub(crate) fn say(&mut self, text: impl Into<String>) {
        self.notice = Some((text.into(), None));
    }
}

/// Shows everything that floats over the canvas.
pub(crate) fn show(app: &mut App, ui: &mut Ui) {
    toolbar::show(app, ui);
    neaten::show(app, ui);
    advanced::show(app, ui);
    surface::show(app, ui);
    inspector::show(app, ui);
    hint::show(app, ui);
    shortcuts::show(app, ui);
}

/// Something that floats over the canvas, held at a corner or a side of it.
fn float<R>(ui: &Ui, name: &str, at: Align2, offset: Vec2, add: impl FnOnce(&mut Ui) -> R) -> InnerResponse<R> {
    let canvas = ui.max_rect();
    Area::new(Id::unique(name))
        .pivot(at)
        .fixed_pos(at.pos_in_rect(&canvas) + offset)
        .constrain_to(canvas)
        .order(egui::Order::Middle)
        .show(ui.ctx(), |ui| theme::floating(ui.style()).show(ui, add).inner)
}
