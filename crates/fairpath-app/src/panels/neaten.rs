//! The method and the slider from as drawn to fairest, under the canvas's middle.

use super::widgets::icon_button;
use super::{MARGIN, float, is_narrow};
use crate::app::App;
use crate::icons::Icon;
use eframe::egui::{Align2, ComboBox, Role, Slider, Ui, WidgetInfo, vec2};
use fairpath_fit::Preset;
use fairpath_sketch::{Method, Neatening};

/// What a person calls a method.
pub(crate) const fn method_title(method: Method) -> &'static str {
    match method {
        Method::ShortestPath => "Shortest path",
        Method::CurvatureSpace => "Curvature space",
        Method::FrenchCurve => "French curves",
        Method::Laplacian => "Laplacian",
        Method::Cubic => "Cubic Béziers",
        Method::Mvc => "Least variation",
    }
}

const fn preset_title(preset: Preset) -> &'static str {
    match preset {
        Preset::Default => "Lines, arcs, clothoids",
        Preset::Accurate => "Accurate",
        Preset::Loose => "Loose",
        Preset::LinesArcs => "Lines and arcs",
        Preset::Polyline => "Lines only",
        Preset::Clothoids => "Clothoids only",
        Preset::Paper => "As the paper",
    }
}

/// Length of the slider where there is little room, points.
const SHORT: f32 = 90.0;

/// Shows method, preset and slider.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    let is_narrow = is_narrow(ui);
    float(ui, "neaten", Align2::CENTER_BOTTOM, vec2(0.0, -MARGIN), |ui| {
        ui.horizontal(|ui| {
            let mut wish = app.session.neatening().clone();
            let combo = ComboBox::from_id_salt("method").width(124.0).selected_text(method_title(wish.method)).show_ui(
                ui,
                |ui| {
                    for method in Method::ALL {
                        ui.selectable_value(&mut wish.method, method, method_title(method));
                    }
                },
            );
            combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Method"));
            if wish.method == Method::ShortestPath && !is_narrow {
                let combo = ComboBox::from_id_salt("preset")
                    .width(150.0)
                    .selected_text(preset_title(wish.preset))
                    .show_ui(ui, |ui| {
                        for preset in Preset::ALL {
                            ui.selectable_value(&mut wish.preset, preset, preset_title(preset));
                        }
                    });
                combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Preset"));
            }
            if wish.method == Method::FrenchCurve {
                french_curves(app, ui, &mut wish);
            }
            if is_narrow {
                ui.spacing_mut().slider_width = SHORT;
            }
            ui.separator();
            ui.weak("raw");
            let slider = ui.add(Slider::new(&mut wish.fairness, 0.0..=1.0).show_value(false));
            slider.widget_info(|| WidgetInfo::slider(true, wish.fairness, "Fairness"));
            ui.weak("fairest");
            let open = app.panels.advanced;
            if icon_button(ui, Icon::SlidersHorizontal, "All options", "", open, true).clicked() {
                app.panels.advanced = !open;
            }
            if wish.method != app.session.neatening().method {
                // Options of one method mean nothing to another.
                wish.set.clear();
            }
            if wish != *app.session.neatening() {
                app.session.set_neatening(wish);
            }
            if !slider.dragged() && !slider.has_focus() {
                app.session.end_gesture();
            }
        });
    });
}

/// Which set of French curves, whether it is laid while drawing, and the selected curve as one more.
fn french_curves(app: &mut App, ui: &mut Ui, wish: &mut Neatening) {
    let combo =
        ComboBox::from_id_salt("templates").width(110.0).selected_text(wish.templates.as_str()).show_ui(ui, |ui| {
            for name in app.session.drawing().template_set_names() {
                ui.selectable_value(&mut wish.templates, name.clone(), name);
            }
        });
    combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Set of French curves"));
    let (shown, live) = (app.shown.templates, app.shown.greedy);
    if icon_button(ui, Icon::Eye, "French curves over the stroke", "", shown, true).clicked() {
        app.shown.templates = !shown;
    }
    if icon_button(ui, Icon::Zap, "Lay French curves while drawing", "", live, true).clicked() {
        app.shown.greedy = !live;
    }
    let selected = app.session.selected().is_some();
    if icon_button(ui, Icon::CopyPlus, "Make the selected curve a French curve", "", false, selected).clicked()
        && let Some(set) = app.session.author_template()
    {
        app.panels.say(format!("A French curve more in {set:?}."));
        wish.templates = set;
    }
}
