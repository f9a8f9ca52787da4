//! What is said to a person: the hint of a first start, and what did not work.

use super::{BAR, MARGIN, float, room};
use crate::app::App;
use eframe::egui::{Align2, RichText, Ui, vec2};

/// How long something is shown, seconds.
const SHOWN_S: f64 = 6.0;

/// From this width on there is room between the bars at the top, points.
pub(super) const BESIDE: f32 = 1160.0;

/// Longer texts take several lines, points.
const WIDEST: f32 = 420.0;

/// Shows the hint and what is to be said.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    if app.panels.hint && (app.session.hand().is_some() || app.session.history().undoable().is_some()) {
        app.panels.hint = false;
    }
    let now = ui.input(|i| i.time);
    let canvas = ui.max_rect().width();
    // Beside the bars at the top, where there is room, else below them.
    let below = if canvas < BESIDE { BAR } else { MARGIN };
    let at = vec2(room(app).center().x - ui.max_rect().center().x, below);
    if let Some((text, since)) = &mut app.panels.notice {
        let since = *since.get_or_insert(now);
        float(ui, "notice", Align2::CENTER_TOP, at, |ui| {
            ui.set_max_width(WIDEST.min(0.8 * canvas));
            ui.label(text.as_str())
        });
        if now - since > SHOWN_S {
            app.panels.notice = None;
        } else {
            ui.ctx().request_repaint_after_secs(0.5);
        }
    } else if app.panels.hint {
        float(ui, "hint", Align2::CENTER_TOP, at, |ui| {
            ui.label("Draw anywhere. Draw near a curve to change it.");
            ui.label(RichText::new("Wheel zooms, space-drag pans, ? shows all shortcuts.").weak().small());
        });
    }
}
