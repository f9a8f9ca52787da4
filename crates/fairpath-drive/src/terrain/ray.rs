//! Where a ray meets the terrain: a ray comes in, the first place at which it passes through [`Heightfield::height`] goes out.

use super::heightfield::Heightfield;
use super::pyramid::Pyramid;
use fairpath_curve::{Point, Vec2};

/// A half line in space. x is east, y north, z up, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: [f64; 3],
    /// Where it goes; of any length but none.
    pub direction: [f64; 3],
}

impl Ray {
    /// The place after so many times its direction.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| self.origin[i] + t * self.direction[i])
    }

    /// The part of it that is within a box, if any.
    fn within(&self, low: [f64; 3], high: [f64; 3], mut part: [f64; 2]) -> Option<[f64; 2]> {
        for i in 0..3 {
            if self.direction[i] == 0.0 {
                if !(low[i] <= self.origin[i] && self.origin[i] <= high[i]) {
                    return None;
                }
                continue;
            }
            let ends = [low[i], high[i]].map(|side| (side - self.origin[i]) / self.direction[i]);
            part = [part[0].max(ends[0].min(ends[1])), part[1].min(ends[0].max(ends[1]))];
        }
        (part[0] <= part[1]).then_some(part)
    }
}

/// How much wider than itself a box is taken, as a share of the size of what lies in it: more than rounding moves the ends of a part of a ray, so that none slips
/// through between two boxes.
const WIDER: f64 = 1e-12;

/// The first place at which the ray passes through the terrain, from above or from below: how many times its direction that is.
pub(super) fn first_hit(field: &Heightfield, pyramid: &Pyramid, ray: &Ray) -> Option<f64> {
    let finite = ray.origin.iter().chain(&ray.direction).all(|x| x.is_finite());
    if !finite || ray.direction == [0.0; 3] {
        return None;
    }
    let search = Search { field, pyramid, ray };
    search.in_block(pyramid.top(), [0, 0], [0.0, f64::INFINITY])
}

struct Search<'a> {
    field: &'a Heightfield,
    pyramid: &'a Pyramid,
    ray: &'a Ray,
}

impl Search<'_> {
    fn in_block(&self, level: usize, block: [usize; 2], part: [f64; 2]) -> Option<f64> {
        let part = self.part_in_block(level, block, part)?;
        if level == 0 {
            return self.in_cells(block, part);
        }
        let mut children: Vec<(f64, [usize; 2])> = self
            .pyramid
            .children(level, block)
            .filter_map(|child| Some((self.part_in_block(level - 1, child, part)?[0], child)))
            .collect();
        children.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut first: Option<f64> = None;
        for (begin, child) in children {
            // Whatever lies in it comes later.
            if first.is_some_and(|first| first < begin) {
                break;
            }
            let hit = self.in_block(level - 1, child, part);
            first = [first, hit].into_iter().flatten().reduce(f64::min);
        }
        first
    }

    fn part_in_block(&self, level: usize, block: [usize; 2], part: [f64; 2]) -> Option<[f64; 2]> {
        let range = self.pyramid.range(level, block);
        let cells = Pyramid::cells(level, block, self.field.size());
        let low = self.field.place([cells.columns[0], cells.rows[0]]);
        let high = self.field.place([cells.columns[1], cells.rows[1]]);
        let wider = |low: f64, high: f64| {
            let by = WIDER * (low.abs() + high.abs() + (high - low));
            [low - by, high + by]
        };
        let [x, y, z] = [wider(low.x, high.x), wider(low.y, high.y), wider(range.low, range.high)];
        self.ray.within([x[0], y[0], z[0]], [x[1], y[1], z[1]], part)
    }

    /// The first hit among all cells of a smallest block.
    fn in_cells(&self, block: [usize; 2], part: [f64; 2]) -> Option<f64> {
        let cells = Pyramid::cells(0, block, self.field.size());
        let mut first: Option<f64> = None;
        for row in cells.rows[0]..cells.rows[1] {
            for column in cells.columns[0]..cells.columns[1] {
                if let Some(hit) = self.in_cell([column, row], part) {
                    first = Some(first.map_or(hit, |first: f64| first.min(hit)));
                }
            }
        }
        first
    }

    fn in_cell(&self, cell: [usize; 2], part: [f64; 2]) -> Option<f64> {
        let low = self.field.place(cell);
        let high = low + self.field.spacing_m();
        let by = WIDER * (low.x.abs() + low.y.abs() + high.x.abs() + high.y.abs());
        let flat = Ray {
            origin: [self.ray.origin[0], self.ray.origin[1], 0.0],
            direction: [self.ray.direction[0], self.ray.direction[1], 0.0],
        };
        let [begin, end] = flat.within([low.x - by, low.y - by, 0.0], [high.x + by, high.y + by, 0.0], part)?;
        let [sw, se, nw, ne] = self.field.corners(cell);
        // Height over the terrain is a quadratic of how far the ray has come since it entered.
        let from = self.ray.at(begin);
        let spacing = self.field.spacing_m();
        let at = (Point::new(from[0], from[1]) - low).component_div(spacing);
        let along = Vec2::new(self.ray.direction[0], self.ray.direction[1]).component_div(spacing);
        let (east, north, twist) = (se - sw, nw - sw, sw + ne - se - nw);
        let a = -twist * along.x * along.y;
        let b = self.ray.direction[2] - (east * along.x + north * along.y + twist * (at.x * along.y + at.y * along.x));
        let c = from[2] - (sw + east * at.x + north * at.y + twist * at.x * at.y);
        first_root([c, b, a], end - begin).map(|t| begin + t)
    }
}

/// Components divided by components.
trait ComponentDiv {
    fn component_div(self, by: Vec2) -> Vec2;
}

impl ComponentDiv for Vec2 {
    fn component_div(self, by: Vec2) -> Vec2 {
        Vec2::new(self.x / by.x, self.y / by.y)
    }
}

/// The first zero of c + b t + a t² from 0 to `end`. Where the ends are of two signs there is one for certain.
fn first_root([c, b, a]: [f64; 3], end: f64) -> Option<f64> {
    if c == 0.0 {
        return Some(0.0);
    }
    let value = |t: f64| c + t * (b + t * a);
    let mut roots = [f64::NAN; 2];
    let root = b * b - 4.0 * a * c;
    if root >= 0.0 {
        // Neither of the two differs from a difference of equals.
        let q = -0.5 * (b + root.sqrt().copysign(b));
        roots = [q / a, c / q];
    }
    let found = roots.into_iter().filter(|t| (0.0..=end).contains(t)).fold(f64::INFINITY, f64::min);
    if found.is_finite() {
        return Some(found);
    }
    // Rounding put it beyond one of the ends, or the part of the ray is endless and stands still in plan.
    (end.is_finite() && value(end) * c <= 0.0).then_some(end)
}
