//! Small parts that several panels are made of.

use crate::icons::{Icon, icon};
use eframe::egui::containers::menu::MenuButton;
use eframe::egui::{Button, Response, Role, Ui, Vec2, WidgetInfo};

/// Size of an icon, points.
const ICON: f32 = 17.0;

/// Least side of a button that is an icon, points.
const LEAST: f32 = 30.0;

/// The button of an icon.
fn bare(ui: &Ui, glyph: Icon) -> Button<'static> {
    Button::new(icon(glyph, ICON)).min_size(Vec2::splat(ui.spacing().interact_size.y.max(LEAST)))
}

/// An icon that opens a menu of that name.
pub(super) fn menu_button(ui: &mut Ui, glyph: Icon, name: &str, entries: impl FnOnce(&mut Ui)) {
    let button = bare(ui, glyph).frame_when_inactive(false);
    let (response, _) = MenuButton::from_button(button).ui(ui, entries);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
}

/// A button that is an icon. `name` is what it is called, aloud and under the pointer; `shortcut` what does the same on the keyboard.
pub(crate) fn icon_button(
    ui: &mut Ui,
    glyph: Icon,
    name: &str,
    shortcut: &str,
    selected: bool,
    enabled: bool,
) -> Response {
    let button = bare(ui, glyph).selected(selected).frame_when_inactive(selected);
    let response = ui.add_enabled(enabled, button);
    response.widget_info(|| WidgetInfo::selected(Role::Button, enabled, selected, name));
    let text = if shortcut.is_empty() { name.to_owned() } else { format!("{name}   {shortcut}") };
    response.on_hover_text(text)
}
