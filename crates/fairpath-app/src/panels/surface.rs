//! The surface of a closed curve in a small view of its own, in which it can be turned and which can be dragged aside.

use super::widgets::icon_button;
use super::{MARGIN, float_loose};
use crate::app::App;
use crate::icons::Icon;
use eframe::egui::{Align2, Label, RichText, Ui, vec2};
use fairpath_render::{Finish, Zebra};
use fairpath_shape::InflateOptions;

/// Side of the view, points.
pub(super) const SIDE: f32 = 280.0;

/// Room that it leaves for the tools at its left and the slider below, points.
pub(super) const BESIDE: f32 = 56.0;
const ABOVE: f32 = 56.0;

/// Shows the surface, if one was asked for.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    let Some((_, mesh)) = app.session.surface() else { return };
    let (mesh, y) = (mesh.clone(), app.session.drawing().y);
    let Some(view) = &mut app.surface_view else {
        app.session.drop_surface();
        return app.panels.say("There is no graphics device that could show a surface.");
    };
    let mut keep = true;
    let mut zebra = app.panels.zebra;
    let shown = float_loose(ui, "surface", Align2::LEFT_BOTTOM, vec2(MARGIN + BESIDE, -MARGIN - ABOVE), |ui| {
        ui.set_width(SIDE);
        ui.horizontal(|ui| {
            // Not to be selected as text: here the view is taken hold of when it lies in the way.
            ui.add(Label::new("Surface").selectable(false));
            let triangles = RichText::new(format!("{} triangles", mesh.triangles.len())).weak();
            ui.add(Label::new(triangles).selectable(false));
            ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
                keep = !icon_button(ui, Icon::X, "Close the surface", "", false, true).clicked();
                if icon_button(ui, Icon::Rainbow, "Zebra stripes", "", zebra, true).clicked() {
                    zebra = !zebra;
                }
            });
        });
        let finish = if zebra { Finish::Zebra(Zebra::default()) } else { Finish::Clay };
        ui.allocate_ui(vec2(SIDE, SIDE), |ui| view.show(ui, &mesh, y, finish).err()).inner
    });
    app.panels.zebra = zebra;
    if let Some(error) = shown.inner {
        app.panels.say(error.to_string());
        keep = false;
    }
    if !keep {
        app.session.drop_surface();
    }
}

impl App {
    /// Makes a surface of the selected curve, or closes the one that is shown.
    pub(crate) fn inflate_selected(&mut self) {
        if self.session.surface().is_some() {
            return self.session.drop_surface();
        }
        match self.session.selected() {
            Some(curve) if curve.spline.is_closed() => self.session.inflate(InflateOptions::default()),
            Some(_) => self.panels.say("Only a closed curve can be inflated; O closes it."),
            None => self.panels.say("Select a closed curve to inflate it."),
        }
    }
}
