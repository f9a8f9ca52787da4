//! The figures of the selected curve, at the right.

use super::{MARGIN, float, is_narrow};
use crate::app::App;
use eframe::egui::{Align2, Grid, RichText, ScrollArea, Ui, vec2};
use fairpath_curve::{Continuity, Kind, Segment, Spline};
use fairpath_sketch::Curve;

/// Width of the panel, points.
pub(super) const WIDTH: f32 = 272.0;

/// Height of a row of figures, points.
const ROW: f32 = 17.0;

/// A radius so many times the curve's length is that of a straight line.
const STRAIGHT: f64 = 100.0;

/// Shows the figures.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    if !app.shown.inspector || is_narrow(ui) {
        return;
    }
    let Some(curve) = app.session.selected().cloned() else { return };
    let unit = app.session.drawing().unit.as_str();
    float(ui, "inspector", Align2::RIGHT_TOP, vec2(-MARGIN, MARGIN + 56.0), |ui| {
        ui.set_width(WIDTH);
        ui.spacing_mut().interact_size.y = ROW;
        ui.label(RichText::new(&curve.name).heading());
        figures(ui, &curve, unit);
        for warning in &curve.warnings {
            ui.label(RichText::new(&warning.text).small().color(ui.visuals().warn_fg_color));
        }
        ui.separator();
        segments(ui, &curve.spline);
    });
}

fn figures(ui: &mut Ui, curve: &Curve, unit: &str) {
    let spline = &curve.spline;
    let corners = spline.joins().iter().filter(|join| **join == Continuity::G0).count();
    Grid::new("figures").num_columns(2).spacing([12.0, 3.0]).show(ui, |ui| {
        let mut row = |name: &str, value: String| {
            ui.weak(name);
            ui.label(value);
            ui.end_row();
        };
        row("Length", format!("{:.1} {unit}", spline.length()));
        row("Segments", spline.segments().len().to_string());
        row("Corners", corners.to_string());
        row("Inflections", curve.report.inflections.to_string());
        row("Deviation, mean", format!("{:.2} {unit}", curve.report.rms_deviation));
        row("Deviation, largest", format!("{:.2} {unit}", curve.report.max_deviation));
    });
}

/// The parameter A of a clothoid, the root of length over change of curvature.
fn parameter(segment: &Segment) -> Option<f64> {
    (segment.kind() == Kind::Clothoid).then(|| segment.sharpness().abs().sqrt().recip())
}

fn segments(ui: &mut Ui, spline: &Spline) {
    ScrollArea::vertical().max_height(260.0).auto_shrink([false, true]).show(ui, |ui| {
        Grid::new("segments").num_columns(5).striped(true).spacing([10.0, 2.0]).show(ui, |ui| {
            for title in ["", "from", "length", "radius", "A", "join"] {
                ui.weak(title);
            }
            ui.end_row();
            for (i, segment) in spline.segments().iter().enumerate() {
                let kind = match segment.kind() {
                    Kind::Line => "line",
                    Kind::Arc => "arc",
                    Kind::Clothoid => "clothoid",
                };
                let radius = |kappa: f64| match 1.0 / kappa.abs() {
                    radius if radius > STRAIGHT * spline.length() => "∞".to_owned(),
                    radius => format!("{radius:.0}"),
                };
                ui.label(kind);
                ui.label(format!("{:.0}, {:.0}", segment.start.x, segment.start.y));
                ui.label(format!("{:.1}", segment.length));
                ui.label(match segment.kind() {
                    Kind::Clothoid => format!("{}–{}", radius(segment.kappa0), radius(segment.kappa1)),
                    _ => radius(segment.kappa0),
                });
                ui.label(parameter(segment).map_or_else(String::new, |a| format!("{a:.0}")));
                ui.label(spline.joins().get(i).map_or_else(String::new, |join| format!("{join:?}")));
                ui.end_row();
            }
        });
    });
}
