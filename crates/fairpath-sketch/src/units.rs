//! The drawing in another unit: everything keeps its size, and the numbers change.

use crate::background::Background;
use crate::curve::Curve;
use crate::session::Session;
use fairpath_curve::Similarity;
use fairpath_io::Unit;
use std::sync::Arc;

impl Session {
    /// Measures the drawing in another unit, as a step that can be undone. What was drawn keeps its size: 100 px become 25.4 mm.
    ///
    /// The factor by which numbers change is given back; 1 if the unit was that one.
    pub fn measure_in(&mut self, unit: Unit) -> f64 {
        let factor = self.drawing().unit.metres() / unit.metres();
        if unit == self.drawing().unit {
            return 1.0;
        }
        // What is under way is told in the old unit.
        self.desk.clear();
        self.corrections.clear();
        self.surface = None;
        let scale = Similarity { scale: factor, ..Similarity::IDENTITY };
        self.history.act("Unit", |drawing| {
            drawing.unit = unit;
            let curves: Vec<Curve> = drawing.curves().iter().map(|curve| curve.transformed(&scale)).collect();
            for curve in curves {
                drawing.put(curve);
            }
            drawing.background = drawing.background.as_ref().map(|picture| {
                let at = (picture.at.to_vec2() * factor).to_point();
                Arc::new(Background { at, width: picture.width * factor, ..(**picture).clone() })
            });
        });
        self.want_all();
        factor
    }
}
