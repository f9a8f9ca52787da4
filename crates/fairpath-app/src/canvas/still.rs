//! What stays as it is from one picture to the next, as triangles: while a stroke is drawn over hundreds of curves, only the stroke is made into triangles anew.

use crate::app::Shown;
use crate::theme::Palette;
use crate::view::View;
use eframe::egui::epaint::{ClippedShape, Primitive};
use eframe::egui::{Mesh, Painter, Shape};
use fairpath_sketch::{Curve, CurveId};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Everything on which the picture of the curves depends.
pub(crate) struct Sight<'a> {
    pub(crate) curves: &'a [Arc<Curve>],
    pub(crate) selection: &'a BTreeSet<CurveId>,
    pub(crate) view: &'a View,
    pub(crate) shown: &'a Shown,
    pub(crate) palette: &'static Palette,
}

/// The triangles of what was seen last. Lines only: discs and letters would have to be made anew whenever the texture that they are taken from grows.
#[derive(Default)]
pub(crate) struct Still {
    seen: Option<Seen>,
    meshes: Vec<Arc<Mesh>>,
}

struct Seen {
    curves: Vec<Arc<Curve>>,
    selection: BTreeSet<CurveId>,
    view: View,
    shown: Shown,
    palette: &'static Palette,
    pixels_per_point: f32,
}

impl Seen {
    fn is(&self, sight: &Sight<'_>, pixels_per_point: f32) -> bool {
        self.curves.len() == sight.curves.len()
            && self.curves.iter().zip(sight.curves).all(|(a, b)| Arc::ptr_eq(a, b))
            && self.selection == *sight.selection
            && self.view == *sight.view
            && self.shown == *sight.shown
            && std::ptr::eq(self.palette, sight.palette)
            && self.pixels_per_point == pixels_per_point
    }
}

impl Still {
    /// Paints what is seen; `shapes` makes it where anything is other than the last time.
    pub(crate) fn paint(&mut self, painter: &Painter, sight: &Sight<'_>, shapes: impl FnOnce() -> Vec<Shape>) {
        let ctx = painter.ctx();
        let pixels_per_point = ctx.pixels_per_point();
        if !self.seen.as_ref().is_some_and(|seen| seen.is(sight, pixels_per_point)) {
            let clip_rect = painter.clip_rect();
            let clipped = shapes().into_iter().map(|shape| ClippedShape::new(clip_rect, shape)).collect();
            let meshes =
                ctx.tessellate(clipped, pixels_per_point).into_iter().filter_map(|made| match made.primitive {
                    Primitive::Mesh(mesh) => Some(Arc::new(mesh)),
                    Primitive::Callback(_) => None,
                });
            self.meshes = meshes.collect();
            self.seen = Some(Seen {
                curves: sight.curves.to_vec(),
                selection: sight.selection.clone(),
                view: *sight.view,
                shown: sight.shown.clone(),
                palette: sight.palette,
                pixels_per_point,
            });
        }
        painter.extend(self.meshes.iter().map(|mesh| Shape::Mesh(Arc::clone(mesh))));
    }
}
