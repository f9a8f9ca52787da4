//! The menu of the document, at the upper left.

use crate::app::App;
use crate::files::Purpose;
use crate::icons::{Icon, icon};
use eframe::egui::{Button, Role, Ui, WidgetInfo};
use fairpath_io::SplineFormat;

/// Formats of curves with what a person calls them.
const FORMATS: [(SplineFormat, &str); 5] = [
    (SplineFormat::Svg, "SVG, for drawing programs"),
    (SplineFormat::Dxf, "DXF, for CAD"),
    (SplineFormat::Json, "JSON, exact curves"),
    (SplineFormat::Csv, "CSV, a row for each segment"),
    (SplineFormat::Png, "PNG, a picture"),
];

/// Shows the menu's button, and the menu when it is pressed.
pub(crate) fn show(app: &mut App, ui: &mut Ui) {
    let ctx = ui.ctx().clone();
    let menu = ui.menu_button(icon(Icon::Menu, 17.0), |ui| {
        let item =
            |ui: &mut Ui, name: &str, shortcut: &str| ui.add(Button::new(name).shortcut_text(shortcut)).clicked();
        if item(ui, "New", "") {
            app.clear();
        }
        if item(ui, "Open…", "Ctrl+O") {
            app.files.choose(&ctx, Purpose::Open);
        }
        if item(ui, "Save…", "Ctrl+S") {
            app.save(&ctx);
        }
        ui.separator();
        if item(ui, "Import strokes or curves…", "") {
            app.files.choose(&ctx, Purpose::Import);
        }
        ui.menu_button("Export", |ui| {
            for (format, name) in FORMATS {
                if item(ui, name, "") {
                    app.export(&ctx, format);
                }
            }
        });
        if item(ui, "Copy as SVG", "Ctrl+Shift+C") {
            app.copy_svg(&ctx);
        }
        ui.separator();
        if item(ui, "Trace over a picture…", "") {
            app.files.choose(&ctx, Purpose::Background);
        }
        if app.session.drawing().background.is_some() && item(ui, "Take the picture away", "") {
            app.session.set_background(None);
        }
    });
    menu.response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Menu"));
}
