//! French curves laid over the curve that is made of them: each template where it lay, and the part of it that was taken.

use super::paint::Brush;
use super::shapes::Shape;
use eframe::egui::Stroke;
use fairpath_sketch::{Curve, Drawing};

/// Width of the part of a template that was taken, points.
const TAKEN_WIDTH: f32 = 6.0;

impl Brush<'_> {
    /// The templates of a curve.
    pub(crate) fn templates(&self, drawing: &Drawing, curve: &Curve) {
        let Some(used) = &curve.templates else { return };
        let Some(set) = drawing.template_set(&used.set) else { return };
        for (i, piece) in used.pieces.iter().enumerate() {
            let Some(template) = set.templates().iter().find(|template| template.name() == piece.template) else {
                continue;
            };
            let laid = template.spline().transformed(&piece.transform);
            let colour = self.palette.templates[i % self.palette.templates.len()];
            self.shape(&Shape::new(&laid, self.view.zoom()), |_| Stroke::new(1.0, colour));
            let [from, to] = piece.span;
            if let Some(part) = curve.spline.subspline(from.max(0.0), to.min(curve.spline.length())) {
                let taken = Stroke::new(TAKEN_WIDTH, colour.gamma_multiply(0.35));
                self.shape(&Shape::new(&part, self.view.zoom()), |_| taken);
            }
        }
    }
}
