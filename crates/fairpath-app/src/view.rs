//! Which part of the drawing is seen: places of the drawing come in, places on the screen go out, and back.

use eframe::egui::{Pos2, Rect, Vec2};
use fairpath_curve::Point;

/// The nearest and farthest that can be gone: points of the screen to a unit of the drawing.
const ZOOMS: std::ops::RangeInclusive<f64> = 1e-4..=1e5;

/// A view on the drawing. The screen's unit is the logical point; y runs down on the screen as the drawing's does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    /// The place of the drawing that is in the middle of the canvas.
    centre: Point,
    /// Points of the screen to a unit of the drawing.
    zoom: f64,
    /// The canvas on the screen.
    canvas: Rect,
}

impl Default for View {
    fn default() -> Self {
        Self { centre: Point::ORIGIN, zoom: 1.0, canvas: Rect::from_min_size(Pos2::ZERO, Vec2::splat(1.0)) }
    }
}

impl View {
    /// The view with the canvas there. The first time, the drawing's origin comes to its upper left corner, so that a unit of the drawing is a point
    /// of the screen.
    pub(crate) fn on(&mut self, canvas: Rect) {
        let first = self.canvas.size() == Vec2::splat(1.0);
        self.canvas = canvas;
        if first {
            self.reset();
        }
    }

    /// A unit of the drawing is a point of the screen again, and its origin the canvas's upper left corner.
    pub(crate) fn reset(&mut self) {
        self.zoom = 1.0;
        let (width, height) = (f64::from(self.canvas.width()), f64::from(self.canvas.height()));
        self.centre = Point::new(0.5 * width, 0.5 * height);
    }

    /// The canvas on the screen.
    pub(crate) fn canvas(&self) -> Rect {
        self.canvas
    }

    /// Points of the screen to a unit of the drawing.
    pub(crate) fn zoom(&self) -> f64 {
        self.zoom
    }

    /// Size of a point of the screen in the drawing.
    pub(crate) fn pixel_size(&self) -> f64 {
        1.0 / self.zoom
    }

    /// Where a place of the drawing is on the screen.
    pub(crate) fn screen_of(&self, point: Point) -> Pos2 {
        let from_centre = (point - self.centre) * self.zoom;
        self.canvas.center() + Vec2::new(from_centre.x as f32, from_centre.y as f32)
    }

    /// Which place of the drawing is there on the screen.
    pub(crate) fn drawing_at(&self, pos: Pos2) -> Point {
        let from_centre = pos - self.canvas.center();
        self.centre + self.vector(from_centre)
    }

    /// A move on the screen as one of the drawing.
    pub(crate) fn vector(&self, by: Vec2) -> fairpath_curve::Vec2 {
        fairpath_curve::Vec2::new(f64::from(by.x), f64::from(by.y)) * self.pixel_size()
    }

    /// Moves what is seen along with a hand.
    pub(crate) fn pan(&mut self, by: Vec2) {
        self.centre -= self.vector(by);
    }

    /// Comes nearer by a factor; what is under `pos` stays there.
    pub(crate) fn zoom_at(&mut self, pos: Pos2, factor: f64) {
        let fixed = self.drawing_at(pos);
        self.zoom = (self.zoom * factor).clamp(*ZOOMS.start(), *ZOOMS.end());
        self.centre += fixed - self.drawing_at(pos);
    }

    /// Shows all of a box of the drawing in a part of the canvas, with some air around it.
    pub(crate) fn fit(&mut self, min: Point, max: Point, room: Rect) {
        let air = 0.92;
        let size = (max - min).hypot().max(1e-9);
        let scale = |extent: f64, room: f32| f64::from(room.max(1.0)) * air / extent.max(1e-3 * size);
        self.zoom = scale(max.x - min.x, room.width()).min(scale(max.y - min.y, room.height()));
        self.zoom = self.zoom.clamp(*ZOOMS.start(), *ZOOMS.end());
        self.centre = min.midpoint(max) - self.vector(room.center() - self.canvas.center());
    }

    /// Numbers of the drawing are so many times what they were; what is seen stays.
    pub(crate) fn rescale(&mut self, factor: f64) {
        self.zoom = (self.zoom / factor).clamp(*ZOOMS.start(), *ZOOMS.end());
        self.centre = (self.centre.to_vec2() * factor).to_point();
    }

    /// The part of the drawing that is seen, as two corners.
    pub(crate) fn seen(&self) -> [Point; 2] {
        [self.drawing_at(self.canvas.min), self.drawing_at(self.canvas.max)]
    }
}
