//! The picture to trace over: how strong it is and how wide, while the hand moves it on the canvas.

use super::widgets::icon_button;
use super::{MARGIN, float};
use crate::app::{App, Tool};
use crate::icons::Icon;
use eframe::egui::{Align, Align2, Layout, Slider, Ui, WidgetInfo, vec2};

/// Widths that a picture can have, for what is seen of the drawing.
const WIDTHS: std::ops::RangeInclusive<f64> = 0.02..=50.0;

/// Shows the panel while the picture is what hands are at.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    if app.tool != Tool::Picture {
        return;
    }
    let Some(picture) = app.session.drawing().background.clone() else {
        app.tool = Tool::Draw;
        return;
    };
    let [min, max] = app.view.seen();
    let seen = max.x - min.x;
    float(ui, "picture", Align2::CENTER_BOTTOM, vec2(0.0, -MARGIN - 52.0), |ui| {
        ui.horizontal(|ui| {
            ui.label("Picture");
            let mut opacity = picture.opacity;
            ui.weak("faint");
            let fade = ui.add(Slider::new(&mut opacity, 0.05..=1.0).show_value(false));
            fade.widget_info(|| WidgetInfo::slider(true, opacity, "Strength of the picture"));
            ui.weak("strong");
            if fade.changed() {
                app.session.fade_background(opacity);
            }
            ui.separator();
            let mut width = picture.width / seen;
            ui.weak("small");
            let scale = ui.add(Slider::new(&mut width, WIDTHS).logarithmic(true).show_value(false));
            scale.widget_info(|| WidgetInfo::slider(true, width, "Size of the picture"));
            ui.weak("large");
            if scale.changed() {
                app.session.scale_background(width * seen, app.canvas.picture_height_per_width());
            }
            if fade.drag_stopped() || scale.drag_stopped() {
                app.session.end_gesture();
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if icon_button(ui, Icon::Check, "Done with the picture", "", false, true).clicked() {
                    app.tool = Tool::Draw;
                }
                if icon_button(ui, Icon::Trash2, "Take the picture away", "", false, true).clicked() {
                    app.session.set_background(None);
                    app.tool = Tool::Draw;
                }
            });
        });
    });
}
