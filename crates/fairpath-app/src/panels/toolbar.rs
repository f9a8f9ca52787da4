//! The tools at the left, and undo and what is shown at the top.

use super::menu;
use super::widgets::{icon_button, menu_button};
use super::{MARGIN, float, is_narrow};
use crate::app::{App, Ink, Shown, Tool};
use crate::icons::Icon;
use eframe::egui::{Align2, Theme, Ui, vec2};

const TOOLS: [(Tool, Icon, &str, &str); 6] = [
    (Tool::Draw, Icon::Pencil, "Draw", "P"),
    (Tool::Select, Icon::MousePointer2, "Select and move", "V"),
    (Tool::Pull, Icon::Pin, "Pull through a point", "B"),
    (Tool::Cut, Icon::Scissors, "Cut", "C"),
    (Tool::Corner, Icon::Spline, "Corner or smooth", "K"),
    (Tool::Picture, Icon::Image, "Move and fade the picture", "M"),
];

/// Something that is shown or not.
pub(super) struct Toggle {
    icon: Icon,
    name: &'static str,
    key: &'static str,
    is_on: fn(&Shown) -> bool,
    turn: fn(&mut Shown),
}

/// What is shown or not.
pub(super) const TOGGLES: [Toggle; 6] = [
    Toggle {
        icon: Icon::Palette,
        name: "Colours by kind of segment",
        key: "1",
        is_on: |shown| shown.ink == Ink::Kinds,
        turn: |shown| shown.ink = if shown.ink == Ink::Kinds { Ink::Plain } else { Ink::Kinds },
    },
    Toggle { icon: Icon::Ghost, name: "Strokes as drawn", key: "2", is_on: |s| s.ghost, turn: |s| s.ghost ^= true },
    Toggle { icon: Icon::Waves, name: "Curvature comb", key: "3", is_on: |s| s.comb, turn: |s| s.comb ^= true },
    Toggle { icon: Icon::ChartSpline, name: "Curvature plot", key: "4", is_on: |s| s.plot, turn: |s| s.plot ^= true },
    Toggle { icon: Icon::Grid3x3, name: "Grid", key: "5", is_on: |s| s.grid, turn: |s| s.grid ^= true },
    Toggle { icon: Icon::PanelRight, name: "Figures", key: "6", is_on: |s| s.inspector, turn: |s| s.inspector ^= true },
];

/// Shows the tools.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    float(ui, "tools", Align2::LEFT_CENTER, vec2(MARGIN, 0.0), |ui| {
        ui.vertical(|ui| {
            let traced = app.session.drawing().background.is_some();
            for (tool, icon, name, key) in TOOLS.into_iter().filter(|(tool, ..)| *tool != Tool::Picture || traced) {
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
    let narrow = is_narrow(ui);
    float(ui, "shown", Align2::RIGHT_TOP, vec2(-MARGIN, MARGIN), |ui| {
        ui.horizontal(|ui| {
            if narrow {
                menu_button(ui, Icon::Eye, "What is shown", |ui| {
                    for toggle in TOGGLES {
                        let mut on = (toggle.is_on)(&app.shown);
                        if ui.checkbox(&mut on, toggle.name).changed() {
                            app.toggle(&toggle);
                        }
                    }
                });
            } else {
                for toggle in TOGGLES {
                    let on = (toggle.is_on)(&app.shown);
                    if icon_button(ui, toggle.icon, toggle.name, toggle.key, on, true).clicked() {
                        app.toggle(&toggle);
                    }
                }
                ui.separator();
            }
            let dark = ui.ctx().theme() == Theme::Dark;
            let (glyph, name) = if dark { (Icon::Sun, "Light") } else { (Icon::Moon, "Dark") };
            if icon_button(ui, glyph, name, "", false, true).clicked() {
                ui.ctx().set_theme(if dark { Theme::Light } else { Theme::Dark });
            }
            if icon_button(ui, Icon::CircleQuestionMark, "Shortcuts", "?", app.panels.shortcuts, true).clicked() {
                app.panels.shortcuts = !app.panels.shortcuts;
            }
        });
    });
}

impl App {
    /// Shows what was not shown, or the other way round.
    pub(super) fn toggle(&mut self, toggle: &Toggle) {
        let combs = self.shown.comb;
        (toggle.turn)(&mut self.shown);
        if self.shown.comb && !combs {
            self.fit_combs();
        }
    }
}
