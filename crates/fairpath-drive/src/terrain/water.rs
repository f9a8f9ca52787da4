//! Where water stands: a level that floods all lower ground, and bodies of water with levels of their own.

use fairpath_curve::Point;

/// A body of water with a level of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct WaterBody {
    /// An outline around it, m, closed by itself; what lies in it above the level is dry.
    pub outline: Vec<Point>,
    /// Its level, m.
    pub level_m: f64,
}

/// All water of a terrain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waters {
    /// What lies lower is under water, m.
    pub level_m: Option<f64>,
    /// Bodies of water; later ones count before earlier ones and before the level.
    pub bodies: Vec<WaterBody>,
}

impl Waters {
    /// The level of the water that would stand at a place, if the ground there is lower.
    #[must_use]
    pub fn level_at(&self, place: Point) -> Option<f64> {
        let body = self.bodies.iter().rev().find(|b| inside(&b.outline, place));
        body.map(|b| b.level_m).or(self.level_m)
    }

    /// No water stands higher, m; nothing if there is none.
    pub(crate) fn highest_m(&self) -> Option<f64> {
        let levels = self.bodies.iter().map(|body| body.level_m).chain(self.level_m);
        levels.reduce(f64::max)
    }

    /// Whether ground of this height is under water at a place.
    #[must_use]
    pub fn covers(&self, place: Point, ground_m: f64) -> bool {
        self.level_at(place).is_some_and(|level| ground_m < level)
    }
}

/// Whether a place lies within an outline: an odd number of its edges lie to the east of it.
pub(crate) fn inside(outline: &[Point], place: Point) -> bool {
    let mut within = false;
    for i in 0..outline.len() {
        let (a, b) = (outline[i], outline[(i + 1) % outline.len()]);
        if (a.y > place.y) != (b.y > place.y) {
            let x = a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x);
            within ^= place.x < x;
        }
    }
    within
}
