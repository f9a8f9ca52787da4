//! The fine grid over a terrain on which the ground is shaped, in tiles that exist only where something was shaped.

use crate::terrain::Heightfield;
use fairpath_curve::{Point, Vec2};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Side of a tile, samples.
pub(crate) const TILE: usize = 32;

/// A tile by its column and row.
pub type TileIndex = [u32; 2];

/// Samples of the fine grid are no further apart than this, m: a lane must be more than one of them wide.
const FINEST_M: f64 = 1.6;

/// No cell of the terrain is divided into more than so many along a side: beyond that it is no terrain for a road.
const MOST_PARTS: usize = 128;

/// The fine grid: each cell of the terrain divided into equal parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FineGrid {
    corner: Point,
    step: Vec2,
    parts: usize,
    /// Samples from west to east and from south to north.
    size: [usize; 2],
}

impl FineGrid {
    /// The fine grid of a terrain.
    #[must_use]
    pub fn of(natural: &Heightfield) -> Self {
        let spacing = natural.spacing_m();
        let widest = spacing.x.max(spacing.y);
        let mut parts = 1;
        while widest / parts as f64 > FINEST_M && parts < MOST_PARTS {
            parts *= 2;
        }
        let size = natural.size().map(|count| (count - 1) * parts + 1);
        Self { corner: natural.corner(), step: spacing / parts as f64, parts, size }
    }

    /// Into how many parts a cell of the terrain is divided along each side: a power of two.
    #[must_use]
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// From one sample to the next, the longer of the two directions, m.
    #[must_use]
    pub fn step_m(&self) -> f64 {
        self.step.x.max(self.step.y)
    }

    /// From one sample to the next towards east and north, m.
    #[must_use]
    pub fn spacing_m(&self) -> Vec2 {
        self.step
    }

    /// Samples from west to east and from south to north.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Where a sample lies.
    #[must_use]
    #[inline]
    pub fn place(&self, [column, row]: [usize; 2]) -> Point {
        self.corner + Vec2::new(column as f64 * self.step.x, row as f64 * self.step.y)
    }

    /// First and last column and row of the samples in the box around these places; nothing if it lies beside the terrain.
    pub(crate) fn samples_around(&self, places: &[Point]) -> Option<[[usize; 2]; 2]> {
        let range = |values: &dyn Fn(&Point) -> f64, corner: f64, step: f64, count: usize| {
            let low = places.iter().map(values).fold(f64::INFINITY, f64::min);
            let high = places.iter().map(values).fold(f64::NEG_INFINITY, f64::max);
            // Up to the next whole number from the low end, and down to it from the high one; without places there is neither.
            let first = floored((corner - low) / step).saturating_neg();
            let (end, last) = (floored((high - corner) / step), (count - 1) as i64);
            (low <= high && end >= 0 && first <= last && first <= end)
                .then(|| [first.max(0) as usize, end.min(last) as usize])
        };
        let columns = range(&|p| p.x, self.corner.x, self.step.x, self.size[0])?;
        let rows = range(&|p| p.y, self.corner.y, self.step.y, self.size[1])?;
        Some([columns, rows])
    }

    /// The tiles in which these samples lie, by first and last column and row.
    pub(crate) fn tiles(&self, columns: [usize; 2], rows: [usize; 2]) -> impl Iterator<Item = TileIndex> + use<> {
        let [[first, low], [last, high]] = [0, 1].map(|i| self.tile_of([columns[i], rows[i]]).0);
        (low..=high).flat_map(move |row| (first..=last).map(move |column| [column, row]))
    }

    /// In which tile a sample lies, and which of its samples it is.
    #[inline]
    pub(crate) fn tile_of(&self, [column, row]: [usize; 2]) -> (TileIndex, u16) {
        let tile = [(column / TILE) as u32, (row / TILE) as u32];
        (tile, ((row % TILE) * TILE + column % TILE) as u16)
    }

    /// The column and row of a sample of a tile.
    pub(crate) fn sample_of(&self, tile: TileIndex, sample: u16) -> [usize; 2] {
        let sample = usize::from(sample);
        [tile[0] as usize * TILE + sample % TILE, tile[1] as usize * TILE + sample / TILE]
    }
}

/// The whole number at or below `x`; faster than by what every processor has.
fn floored(x: f64) -> i64 {
    let whole = x as i64;
    whole.saturating_sub(i64::from((whole as f64) > x))
}

/// The shaped samples of one tile.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tile {
    /// Which samples were shaped, in order, and their heights, m.
    pub(crate) samples: Vec<(u16, f32)>,
}

/// The shaped samples of all tiles, by column and row. Copies share each column until one of them changes it: to copy takes time in proportion to the number of columns, not of tiles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tiles(BTreeMap<u32, Arc<BTreeMap<u32, Arc<Tile>>>>);

impl Tiles {
    /// A tile, if anything was shaped there.
    pub(crate) fn get(&self, [column, row]: TileIndex) -> Option<&Arc<Tile>> {
        self.0.get(&column)?.get(&row)
    }

    /// All tiles in which something was shaped, in the order of their indices.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (TileIndex, &Arc<Tile>)> {
        self.0.iter().flat_map(|(&column, rows)| rows.iter().map(move |(&row, tile)| ([column, row], tile)))
    }

    /// Puts a tile in its place; one without samples is none.
    pub(crate) fn set(&mut self, [column, row]: TileIndex, tile: Tile) {
        let rows = self.0.entry(column).or_default();
        if !tile.samples.is_empty() {
            Arc::make_mut(rows).insert(row, Arc::new(tile));
        } else if rows.contains_key(&row) {
            Arc::make_mut(rows).remove(&row);
        }
        if rows.is_empty() {
            self.0.remove(&column);
        }
    }
}

impl Tile {
    /// The height of a sample, m, where it was shaped.
    #[inline]
    pub(crate) fn height(&self, sample: u16) -> Option<f32> {
        self.samples.binary_search_by_key(&sample, |s| s.0).ok().map(|i| self.samples[i].1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_floored_as_the_standard_library_floors_them() {
        for x in [0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 7.999, -7.999, 1e15 + 0.5, -1e15 - 0.5] {
            assert_eq!(floored(x), f64::floor(x) as i64, "{x}");
        }
        assert_eq!([floored(-1e300), floored(f64::INFINITY)], [i64::MIN, i64::MAX]);
    }

    #[test]
    fn a_copy_of_tiles_is_not_changed_with_them() {
        let tile = |z: f32| Tile { samples: if z > 0.0 { vec![(0, z)] } else { Vec::new() } };
        let mut tiles = Tiles::default();
        [[2, 1], [0, 5], [2, 0], [0, 3]].into_iter().for_each(|at| tiles.set(at, tile(1.0)));
        let before = tiles.clone();
        let all = |tiles: &Tiles| tiles.iter().map(|(at, tile)| (at, tile.samples[0].1)).collect::<Vec<_>>();
        let old = vec![([0, 3], 1.0), ([0, 5], 1.0), ([2, 0], 1.0), ([2, 1], 1.0)];
        assert_eq!(all(&tiles), old);
        for (at, z) in [([0, 3], 0.0), ([0, 5], 0.0), ([2, 1], 2.0), ([1, 1], 0.0), ([2, 7], 0.0)] {
            tiles.set(at, tile(z));
        }
        assert_eq!(all(&tiles), [([2, 0], 1.0), ([2, 1], 2.0)]);
        assert_eq!([tiles.get([0, 5]).is_some(), before.get([0, 5]).is_some()], [false, true]);
        assert_eq!(all(&before), old);
        // Where all is gone, nothing of a column is left.
        let mut others = Tiles::default();
        [([2, 1], 2.0), ([2, 0], 1.0)].into_iter().for_each(|(at, z)| others.set(at, tile(z)));
        assert_eq!(tiles, others);
    }

    #[test]
    fn only_samples_in_the_box_are_around() {
        let grid = FineGrid { corner: Point::new(10.0, 20.0), step: Vec2::new(2.0, 1.0), parts: 1, size: [5, 5] };
        let around = |a: [f64; 2], b: [f64; 2]| grid.samples_around(&[Point::new(a[0], a[1]), Point::new(b[0], b[1])]);
        assert_eq!(around([10.5, 20.0], [14.0, 23.9]), Some([[1, 2], [0, 3]]));
        assert_eq!(around([-1e300, -5.0], [1e300, 100.0]), Some([[0, 4], [0, 4]]));
        assert_eq!(around([10.5, 20.0], [11.5, 23.0]), None, "between two columns");
        assert_eq!(around([18.1, 20.0], [30.0, 23.0]), None, "beside");
        assert_eq!(around([f64::NAN, 20.0], [f64::NAN, 23.0]), None);
        assert_eq!(grid.samples_around(&[]), None);
    }
}
