//! The menu of the document, at the upper left.

use super::widgets::menu_button;
use crate::app::{App, Tool};
use crate::exports::{EXPORTS, Export};
use crate::files::Purpose;
use crate::icons::Icon;
use eframe::egui::{Button, Context, Ui};
use fairpath_io::Unit;

/// What a person calls a unit.
const fn unit_title(unit: Unit) -> &'static str {
    match unit {
        Unit::Px => "Pixels, 100 to the inch",
        Unit::Pt => "Points, 72 to the inch",
        Unit::Mm => "Millimetres",
        Unit::Cm => "Centimetres",
        Unit::M => "Metres",
        Unit::Km => "Kilometres",
        Unit::In => "Inches",
        Unit::Ft => "Feet",
    }
}

/// Shows the menu's button, and the menu when it is pressed.
pub(crate) fn show(app: &mut App, ui: &mut Ui) {
    let ctx = ui.ctx().clone();
    menu_button(ui, Icon::Menu, "Menu", |ui| {
        if item(ui, "New", "") {
            app.begin_new();
        }
        if item(ui, "Open…", "Ctrl+O") {
            app.files.choose(&ctx, Purpose::Open);
        }
        if item(ui, "Save", "Ctrl+S") {
            app.save(&ctx);
        }
        if item(ui, "Save as…", "Ctrl+Shift+S") {
            app.save_as(&ctx);
        }
        ui.separator();
        if item(ui, "Import…", "") {
            app.files.choose(&ctx, Purpose::Import);
        }
        if item(ui, "Import French curves…", "") {
            app.files.choose(&ctx, Purpose::Templates);
        }
        ui.menu_button("Export", |ui| exports(app, ui, &ctx));
        if item(ui, "Copy as SVG", "Ctrl+Shift+C") {
            app.copy_svg(&ctx);
        }
        ui.separator();
        ui.menu_button("Unit", |ui| units(app, ui));
        ui.separator();
        if item(ui, "Trace over a picture…", "") {
            app.files.choose(&ctx, Purpose::Background);
        }
        if app.session.drawing().background.is_some() && item(ui, "Move and fade the picture", "") {
            app.tool = Tool::Picture;
        }
    });
}

fn item(ui: &mut Ui, name: &str, shortcut: &str) -> bool {
    ui.add(Button::new(name).shortcut_text(shortcut)).clicked()
}

/// What can be exported, by what it is of; what cannot be now says what to do first.
fn exports(app: &mut App, ui: &mut Ui, ctx: &Context) {
    let selected = app.session.selection().len();
    for (of, exports) in EXPORTS {
        let by_selection = exports.iter().all(|(export, _)| matches!(export, Export::Curves(_) | Export::Strokes(_)));
        if by_selection && selected > 0 {
            ui.weak(format!("{of}, {selected} selected"));
        } else {
            ui.weak(of);
        }
        for &(export, name) in exports {
            let can = app.exportable(export);
            let mut button = ui.add_enabled(can.is_ok(), Button::new(name));
            if let Err(first) = can {
                button = button.on_disabled_hover_text(first);
            }
            if button.clicked() {
                app.export(ctx, export);
            }
        }
    }
}

/// In which unit the drawing is measured; what was drawn keeps its size.
fn units(app: &mut App, ui: &mut Ui) {
    let now = app.session.drawing().unit;
    for unit in Unit::ALL {
        if ui.selectable_label(unit == now, unit_title(unit)).clicked() {
            app.measure_in(unit);
            ui.close();
        }
    }
}
