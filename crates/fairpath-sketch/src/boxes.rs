//! Which curves can be near a place: the curves of a drawing come in, the boxes around them are kept as long as they stay.
//!
//! The pointer asks with every move, and the box of a curve costs more than all that is then asked of it.

use crate::curve::Curve;
use fairpath_curve::{Point, Spline};
use std::sync::Arc;

/// Curves with the boxes around them.
#[derive(Debug, Default)]
pub(crate) struct Boxes {
    /// The version of the drawing that they are of.
    version: u64,
    boxes: Vec<(Arc<Curve>, Extent)>,
}

/// The least and the largest coordinates of a curve.
type Extent = [Point; 2];

fn extent(spline: &Spline) -> Extent {
    let bounds = spline.bounding_box();
    [Point::new(bounds.x0, bounds.y0), Point::new(bounds.x1, bounds.y1)]
}

impl Boxes {
    /// Brings the boxes to these curves, which only differ from those before if the version does.
    pub(crate) fn update(&mut self, curves: &[Arc<Curve>], version: u64) {
        if self.version == version && self.boxes.len() == curves.len() {
            return;
        }
        let old = std::mem::take(&mut self.boxes);
        // Most curves are as they were and in the same order; one that went away shifts those behind it.
        let mut at = 0;
        for curve in curves {
            let known = old[at..].iter().take(2).position(|(before, _)| Arc::ptr_eq(before, curve));
            let bounds = match known {
                Some(ahead) => {
                    at += ahead;
                    old[at].1
                }
                None => extent(&curve.spline),
            };
            at = (at + 1).min(old.len());
            self.boxes.push((Arc::clone(curve), bounds));
        }
        self.version = version;
    }

    /// The curves whose boxes are no further than `reach` from a point.
    pub(crate) fn near(&self, point: Point, reach: f64) -> impl Iterator<Item = &Arc<Curve>> {
        let within = move |[least, largest]: &Extent| {
            (least.x - reach..=largest.x + reach).contains(&point.x)
                && (least.y - reach..=largest.y + reach).contains(&point.y)
        };
        self.boxes.iter().filter(move |(_, extent)| within(extent)).map(|(curve, _)| curve)
    }
}
