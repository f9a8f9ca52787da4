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
            // Up to the next whole number from the low end, and down to it from the high one.
            let (low, high) = (-floored((corner - low) / step), floored((high - corner) / step));
            let last = (count - 1) as i64;
            (high >= 0 && low <= last && low <= high).then(|| [low.max(0) as usize, high.min(last) as usize])
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

/// The shaped samples of all tiles.
pub(crate) type Tiles = BTreeMap<TileIndex, Arc<Tile>>;

impl Tile {
    /// The height of a sample, m, where it was shaped.
    #[inline]
    pub(crate) fn height(&self, sample: u16) -> Option<f32> {
        self.samples.binary_search_by_key(&sample, |s| s.0).ok().map(|i| self.samples[i].1)
    }
}
