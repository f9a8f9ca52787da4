//! Small parts that several panels are made of.

use crate::icons::{Icon, icon};
use eframe::egui::{Button, Response, Role, Ui, Vec2, WidgetInfo};

/// Size of an icon, points.
pub(super) const ICON: f32 = 17.0;

/// Least side of a button that is an icon, points.
const LEAST: f32 = 30.0;

/// A button that is an icon. `name` is what it is called, aloud and under the pointer; `shortcut` what does the same on the keyboard.
pub(crate) fn icon_button(
    ui: &mut Ui,
    glyph: Icon,
    name: &str,
    shortcut: &str,
    selected: bool,
    enabled: bool,
) -> Response {
    let side = ui.spacing().interact_size.y.max(LEAST);
    let button =
        Button::new(icon(glyph, ICON)).selected(selected).frame_when_inactive(selected).min_size(Vec2::splat(side));
    let response = ui.add_enabled(enabled, button);
    response.widget_info(|| WidgetInfo::selected(Role::Button, enabled, selected, name));
    let text = if shortcut.is_empty() { name.to_owned() } else { format!("{name}   {shortcut}") };
    response.on_hover_text(text)
}
