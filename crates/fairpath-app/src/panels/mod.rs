//! What floats over the canvas and lies beside it.

mod advanced;
mod hint;
mod inspector;
mod menu;
mod neaten;
mod picture;
pub(crate) mod plot;
pub(crate) mod shortcuts;
mod surface;
mod toolbar;
mod widgets;

use crate::app::App;
use crate::theme;
use eframe::egui::{self, Align2, Area, Id, InnerResponse, Rect, Ui, Vec2, vec2};

/// Distance of what floats from the edge of the canvas, points.
const MARGIN: f32 = 12.0;

/// What the bars at the edges of the canvas take up with their margins, points.
const BAR: f32 = 68.0;

/// What a hint takes up, points.
const HINT: f32 = 52.0;

/// The share of the canvas that must be left between bars and panels for a drawing to be shown there; else it is shown behind them.
const ROOM: f32 = 0.4;

/// A canvas less wide than this, points, has no room for everything at once.
const NARROW: f32 = 680.0;

/// Whether there is little room beside each other.
fn is_narrow(ui: &Ui) -> bool {
    ui.max_rect().width() < NARROW
}

/// The part of the canvas over which nothing lies.
pub(crate) fn room(app: &App) -> Rect {
    let canvas = app.view.canvas();
    let mut room = canvas.shrink2(vec2(BAR, BAR));
    if app.shown.inspector && app.session.selected().is_some() {
        room.max.x = canvas.max.x - inspector::WIDTH - 3.0 * MARGIN;
    }
    if app.session.surface().is_some() {
        room.min.x = canvas.min.x + surface::SIDE + surface::BESIDE + 3.0 * MARGIN;
    }
    if app.panels.hint && canvas.width() < hint::BESIDE {
        room.min.y += HINT;
    }
    let enough = room.width() > ROOM * canvas.width() && room.height() > ROOM * canvas.height();
    if enough { room } else { canvas.shrink(MARGIN) }
}

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
    picture::show(app, ui);
    surface::show(app, ui);
    inspector::show(app, ui);
    hint::show(app, ui);
    shortcuts::show(app, ui);
}

/// Something that floats over the canvas, held at a corner or a side of it.
fn float<R>(ui: &Ui, name: &str, at: Align2, offset: Vec2, add: impl FnOnce(&mut Ui) -> R) -> InnerResponse<R> {
    float_in(ui, Area::new(Id::unique(name)).pivot(at).fixed_pos(at.pos_in_rect(&ui.max_rect()) + offset), add)
}

/// As [`float`], but it can be dragged elsewhere by whatever in it takes no drags itself.
fn float_loose<R>(ui: &Ui, name: &str, at: Align2, offset: Vec2, add: impl FnOnce(&mut Ui) -> R) -> InnerResponse<R> {
    let begin = at.pos_in_rect(&ui.max_rect()) + offset;
    float_in(ui, Area::new(Id::unique(name)).pivot(at).default_pos(begin).movable(true), add)
}

fn float_in<R>(ui: &Ui, area: Area, add: impl FnOnce(&mut Ui) -> R) -> InnerResponse<R> {
    let area = area.constrain_to(ui.max_rect()).order(egui::Order::Middle);
    area.show(ui.ctx(), |ui| theme::floating(ui.style()).show(ui, add).inner)
}
