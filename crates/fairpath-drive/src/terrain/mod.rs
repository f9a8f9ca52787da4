//! The terrain: heights on a grid, what is sampled from it and what is shown of it.

mod chunks;
mod georeference;
mod heightfield;
mod pyramid;
mod ray;
mod synthetic;
mod voids;
mod water;

pub use chunks::{CHUNK, COARSEST, NeighbourLevels};
pub use georeference::GeoReference;
pub use heightfield::{Heightfield, MOST_HEIGHT_M, MOST_SAMPLES, Samples, TerrainError};
pub use pyramid::Cells;
pub use ray::Ray;
pub use synthetic::{Landscape, SyntheticTerrain};
pub use voids::{VoidReport, fill_voids};
pub(crate) use water::inside;
pub use water::{WaterBody, Waters};

use fairpath_curve::Point;
use pyramid::Pyramid;

/// A heightfield with what makes it quick to look at from afar.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    field: Heightfield,
    pyramid: Pyramid,
}

impl Terrain {
    /// A terrain of these heights. Takes time in proportion to their number.
    #[must_use]
    pub fn new(field: Heightfield) -> Self {
        let pyramid = Pyramid::new(&field);
        Self { field, pyramid }
    }

    /// Its heights.
    #[must_use]
    pub fn field(&self) -> &Heightfield {
        &self.field
    }

    /// The lowest and the highest height, m.
    #[must_use]
    pub fn range_m(&self) -> [f64; 2] {
        let range = self.pyramid.range(self.pyramid.top(), [0, 0]);
        [range.low, range.high]
    }

    /// The first place at which a ray passes through the terrain, from above or from below; none beyond its edges.
    #[must_use]
    pub fn hit(&self, ray: &Ray) -> Option<[f64; 3]> {
        ray::first_hit(&self.field, &self.pyramid, ray).map(|t| {
            let [x, y, _] = ray.at(t);
            // On the terrain itself, whatever rounding makes of the way there.
            [x, y, self.field.height(Point::new(x, y))]
        })
    }

    /// A stroke of a camera's view laid on the terrain: where its rays meet it, in plan; rays that meet nothing are left out (section 3.4 of the thesis).
    #[must_use]
    pub fn draped(&self, rays: &[Ray]) -> Vec<Point> {
        rays.iter().filter_map(|ray| self.hit(ray)).map(|[x, y, _]| Point::new(x, y)).collect()
    }

    /// Changes heights: `height` gets a sample's column and row and its height, and gives its new one; one that is not within [`MOST_HEIGHT_M`] changes nothing. Takes time in proportion to the samples at the corners of
    /// these cells.
    pub fn change(&mut self, cells: Cells, mut height: impl FnMut([usize; 2], f64) -> f64) {
        let [columns, rows] = self.field.size();
        for row in cells.rows[0]..=cells.rows[1].min(rows - 1) {
            for column in cells.columns[0]..=cells.columns[1].min(columns - 1) {
                let at = [column, row];
                let new = height(at, self.field.sample(at));
                // What is no height would be a hole for everything that comes after.
                if new.abs() <= MOST_HEIGHT_M {
                    self.field.set(at, new);
                }
            }
        }
        // A sample is a corner of the cells on all its sides.
        let around = |[first, last]: [usize; 2], count: usize| [first.saturating_sub(1), (last + 1).min(count - 1)];
        let cells = Cells { columns: around(cells.columns, columns), rows: around(cells.rows, rows) };
        self.pyramid.update(&self.field, cells);
    }
}
