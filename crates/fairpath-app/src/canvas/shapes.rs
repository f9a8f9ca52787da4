//! Curves as polylines for the screen, kept as long as curve and nearness are the same: a session of hundreds of curves flattens only what changed.

use fairpath_curve::{Kind, Point, Spline};
use fairpath_sketch::{Curve, CurveId};
use std::collections::HashMap;
use std::sync::Arc;

/// Largest distance of a polyline from its curve, points of the screen.
const ACCURACY: f64 = 0.08;

/// A piece of a curve of one kind as a polyline, in the drawing's unit.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub(crate) kind: Kind,
    pub(crate) points: Vec<Point>,
}

/// A curve ready to be painted.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) pieces: Vec<Piece>,
    /// The corners of a box around it, as two points.
    pub(crate) bounds: [Point; 2],
}

impl Shape {
    /// The shape of a spline for a screen on which a unit is `zoom` points.
    pub(crate) fn new(spline: &Spline, zoom: f64) -> Self {
        let mut pieces: Vec<Piece> = Vec::with_capacity(spline.segments().len());
        for segment in spline.segments() {
            let points = segment.flatten(ACCURACY / zoom);
            match pieces.last_mut() {
                // The raw points of a long stroke are one polyline, not a thousand lines.
                Some(piece) if piece.kind == segment.kind() => piece.points.extend(&points[1..]),
                _ => pieces.push(Piece { kind: segment.kind(), points }),
            }
        }
        let bounds = spline.bounding_box();
        Self { pieces, bounds: [Point::new(bounds.x0, bounds.y0), Point::new(bounds.x1, bounds.y1)] }
    }

    /// Whether any of it may be within two corners.
    pub(crate) fn is_within(&self, [min, max]: [Point; 2], margin: f64) -> bool {
        let [a, b] = self.bounds;
        a.x <= max.x + margin && b.x >= min.x - margin && a.y <= max.y + margin && b.y >= min.y - margin
    }
}

/// The shapes of a drawing.
#[derive(Default)]
pub(crate) struct Shapes {
    kept: HashMap<CurveId, (Arc<Curve>, f64, Arc<Shape>)>,
}

impl Shapes {
    /// The shape of a curve for that nearness.
    pub(crate) fn of(&mut self, curve: &Arc<Curve>, zoom: f64) -> Arc<Shape> {
        // Nearness in octaves: while one comes nearer the polylines stay, a little finer than need be.
        let zoom = zoom.log2().ceil().exp2();
        if let Some((kept, at, shape)) = self.kept.get(&curve.id)
            && Arc::ptr_eq(kept, curve)
            && *at == zoom
        {
            return Arc::clone(shape);
        }
        let shape = Arc::new(Shape::new(&curve.spline, zoom));
        self.kept.insert(curve.id, (Arc::clone(curve), zoom, Arc::clone(&shape)));
        shape
    }

    /// Forgets curves that are no more.
    pub(crate) fn keep(&mut self, curves: &[Arc<Curve>]) {
        if self.kept.len() > 2 * curves.len() + 16 {
            self.kept.retain(|id, _| curves.iter().any(|curve| curve.id == *id));
        }
    }
}
