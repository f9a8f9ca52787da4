//! The method and the slider from as drawn to fairest, under the canvas's middle.

use super::{MARGIN, float};
use crate::app::App;
use eframe::egui::{Align2, ComboBox, Slider, Ui, vec2};
use fairpath_fit::Preset;
use fairpath_sketch::Method;

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

/// Shows method, preset and slider.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    float(ui, "neaten", Align2::CENTER_BOTTOM, vec2(0.0, -MARGIN), |ui| {
        ui.horizontal(|ui| {
            let mut wish = app.session.neatening().clone();
            ComboBox::from_id_salt("method").width(124.0).selected_text(method_title(wish.method)).show_ui(ui, |ui| {
                for method in Method::ALL {
                    ui.selectable_value(&mut wish.method, method, method_title(method));
                }
            });
            if wish.method == Method::ShortestPath {
                ComboBox::from_id_salt("preset").width(150.0).selected_text(preset_title(wish.preset)).show_ui(
                    ui,
                    |ui| {
                        for preset in Preset::ALL {
                            ui.selectable_value(&mut wish.preset, preset, preset_title(preset));
                        }
                    },
                );
            }
            ui.separator();
            ui.weak("raw");
            let slider = ui.add(Slider::new(&mut wish.fairness, 0.0..=1.0).show_value(false).text("Fairness"));
            ui.weak("fairest");
            if wish != *app.session.neatening() {
                app.session.set_neatening(wish);
            }
            if !slider.dragged() && !slider.has_focus() {
                app.session.end_gesture();
            }
        });
    });
}
