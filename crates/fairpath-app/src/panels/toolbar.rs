//! The tools at the left, and undo and what is shown at the top.

use super::menu;
use super::widgets::icon_button;
use super::{MARGIN, float};
use crate::app::{App, Ink, Tool};
use crate::icons::Icon;
use eframe::egui::{Align2, Theme, Ui, vec2};

const TOOLS: [(Tool, Icon, &str, &str); 5] = [
    (Tool::Draw, Icon::Pencil, "Draw", "P"),
    (Tool::Select, Icon::MousePointer2, "Select and move", "V"),
    (Tool::Pull, Icon::Pin, "Pull through a point", "B"),
    (Tool::Cut, Icon::Scissors, "Cut", "C"),
    (Tool::Corner, Icon::Spline, "Corner or smooth", "K"),
];

/// Shows the tools.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    float(ui, "tools", Align2::LEFT_CENTER, vec2(MARGIN, 0.0), |ui| {
        ui.vertical(|ui| {
            for (tool, icon, name, key) in TOOLS {
                if icon_button(ui, icon, name, key, app.tool == tool, true).clicked() {
                    app.tool = tool;
                }
            }
        });
    });
    float(ui, "history", Align2::LEFT_TOP, vec2(MARGIN, MARGIN), |ui| {
        ui.horizontal(|ui| {
            menu::show(app, ui);
            let undo = app.session.history().undoable().map(|deed| format!("Undo {}", deed.to_lowercase()));
            if icon_button(ui, Icon::Undo2, undo.as_deref().unwrap_or("Undo"), "Ctrl+Z", false, undo.is_some())
                .clicked()
            {
                app.session.undo();
            }
            let redo = app.session.history().redoable().map(|deed| format!("Redo {}", deed.to_lowercase()));
            if icon_button(ui, Icon::Redo2, redo.as_deref().unwrap_or("Redo"), "Ctrl+Shift+Z", false, redo.is_some())
                .clicked()
            {
                app.session.redo();
            }
        });
    });
    float(ui, "shown", Align2::RIGHT_TOP, vec2(-MARGIN, MARGIN), |ui| {
        ui.horizontal(|ui| {
            let shown = &mut app.shown;
            let kinds = shown.ink == Ink::Kinds;
            if icon_button(ui, Icon::Palette, "Colours by kind of segment", "1", kinds, true).clicked() {
                shown.ink = if kinds { Ink::Plain } else { Ink::Kinds };
            }
            let toggles: [(&mut bool, Icon, &str, &str); 5] = [
                (&mut shown.ghost, Icon::Ghost, "Strokes as drawn", "2"),
                (&mut shown.comb, Icon::Waves, "Curvature comb", "3"),
                (&mut shown.plot, Icon::ChartSpline, "Curvature plot", "4"),
                (&mut shown.grid, Icon::Grid3x3, "Grid", "5"),
                (&mut shown.inspector, Icon::PanelRight, "Figures", "6"),
            ];
            for (on, icon, name, key) in toggles {
                if icon_button(ui, icon, name, key, *on, true).clicked() {
                    *on = !*on;
                }
            }
            ui.separator();
            let dark = ui.ctx().theme() == Theme::Dark;
            let (icon, name) = if dark { (Icon::Sun, "Light") } else { (Icon::Moon, "Dark") };
            if icon_button(ui, icon, name, "", false, true).clicked() {
                ui.ctx().set_theme(if dark { Theme::Light } else { Theme::Dark });
            }
            if icon_button(ui, Icon::CircleQuestionMark, "Shortcuts", "?", app.panels.shortcuts, true).clicked() {
                app.panels.shortcuts = !app.panels.shortcuts;
            }
        });
    });
}
