//! The ground: the natural terrain, and what was cut and filled for paths. The terrain itself is never changed: what was shaped lies over it in tiles of a finer grid, so that undoing
//! is exact, and the cost of a change is that of its corridor.

mod corridor;
mod raster;
mod soil;
mod tiles;
mod volumes;

pub use corridor::{CrossSection, EarthworkOptions, Side};
pub use soil::{Soil, SoilRegion, Soils};
pub use tiles::{FineGrid, Tile, TileIndex};
pub use volumes::{MassHaul, mass_haul, volumes_m3};

pub(crate) use corridor::{Site as CorridorSite, cross_sections};
pub(crate) use raster::{Hits, hits};

use crate::terrain::Heightfield;
use fairpath_curve::Point;
use std::collections::BTreeSet;
use std::sync::Arc;
use tiles::Tiles;

/// The ground: heights of the terrain, but for what was shaped. Copies share what they have in common.
#[derive(Clone, Debug)]
pub struct Ground {
    natural: Arc<Heightfield>,
    grid: FineGrid,
    tiles: Tiles,
}

impl PartialEq for Ground {
    fn eq(&self, other: &Self) -> bool {
        self.tiles == other.tiles && (Arc::ptr_eq(&self.natural, &other.natural) || self.natural == other.natural)
    }
}

impl Ground {
    /// The ground before anything was shaped.
    #[must_use]
    pub fn new(natural: Arc<Heightfield>) -> Self {
        Self { grid: FineGrid::of(&natural), natural, tiles: Tiles::new() }
    }

    /// The terrain as it was.
    #[must_use]
    pub fn natural(&self) -> &Arc<Heightfield> {
        &self.natural
    }

    /// The grid on which the ground is shaped.
    #[must_use]
    pub fn grid(&self) -> &FineGrid {
        &self.grid
    }

    /// The tiles in which something was shaped.
    pub fn shaped_tiles(&self) -> impl Iterator<Item = TileIndex> + '_ {
        self.tiles.keys().copied()
    }

    /// Column and row of every sample that was shaped, tile by tile.
    pub fn shaped_samples(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let grid = self.grid;
        self.tiles.iter().flat_map(move |(&tile, shaped)| shaped.samples.iter().map(move |s| grid.sample_of(tile, s.0)))
    }

    /// The tiles in which this ground differs from another one of the same terrain.
    #[must_use]
    pub fn changed_tiles(&self, other: &Self) -> Vec<TileIndex> {
        let tiles: BTreeSet<TileIndex> = self.tiles.keys().chain(other.tiles.keys()).copied().collect();
        let same = |tile: &TileIndex| match (self.tiles.get(tile), other.tiles.get(tile)) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b) || a == b,
            _ => false,
        };
        tiles.into_iter().filter(|tile| !same(tile)).collect()
    }

    /// The height of a sample of the fine grid, m.
    #[must_use]
    pub fn sample(&self, at: [usize; 2]) -> f64 {
        self.shaped(at).unwrap_or_else(|| self.natural.height(self.grid.place(at)))
    }

    /// The height of a sample of the fine grid, m, if it was shaped.
    #[must_use]
    pub fn shaped(&self, at: [usize; 2]) -> Option<f64> {
        let (tile, sample) = self.grid.tile_of(at);
        self.tiles.get(&tile)?.height(sample).map(f64::from)
    }

    /// The height at a place, m, by bilinear interpolation on the fine grid: where nothing was shaped, that of the terrain.
    #[must_use]
    pub fn height(&self, place: Point) -> f64 {
        let place = self.natural.clamped(place);
        let (corner, step, size) = (self.natural.corner(), self.grid.spacing_m(), self.grid.size());
        let cell = |x: f64, step: f64, count: usize| {
            let t = (x / step).max(0.0);
            let cell = (t as usize).min(count - 2);
            (cell, t - cell as f64)
        };
        let (column, u) = cell(place.x - corner.x, step.x, size[0]);
        let (row, v) = cell(place.y - corner.y, step.y, size[1]);
        let around = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| [column + i, row + j]);
        let shaped = around.map(|at| self.shaped(at));
        if shaped.iter().all(Option::is_none) {
            return self.natural.height(place);
        }
        let z: Vec<f64> =
            (0..4).map(|i| shaped[i].unwrap_or_else(|| self.natural.height(self.grid.place(around[i])))).collect();
        (z[0] * (1.0 - u) + z[1] * u) * (1.0 - v) + (z[2] * (1.0 - u) + z[3] * u) * v
    }

    /// The ground with these tiles shaped anew by what paths ask of them; all others stay as they are. `corridors` are those of all paths, in an order that does
    /// not depend on when they were drawn.
    #[must_use]
    pub(crate) fn reshaped(&self, which: &BTreeSet<TileIndex>, corridors: &[&Hits]) -> Self {
        let mut tiles = self.tiles.clone();
        for &tile in which {
            let mut asked: Vec<(u16, f32, usize, [f32; 2])> = Vec::new();
            for (path, hits) in corridors.iter().enumerate() {
                let hits = hits.get(&tile).map_or(&[][..], |hits| hits);
                asked.extend(hits.iter().map(|h| (h.sample, h.beyond_m, path, [h.low_m, h.high_m])));
            }
            // The nearest path has the last word.
            asked.sort_by(|p, q| p.0.cmp(&q.0).then(q.1.total_cmp(&p.1)).then(p.2.cmp(&q.2)));
            let mut samples = Vec::new();
            for group in asked.chunk_by(|p, q| p.0 == q.0) {
                let place = self.grid.place(self.grid.sample_of(tile, group[0].0));
                let natural = self.natural.height(place) as f32;
                let z = group.iter().fold(natural, |z, (_, _, _, [low, high])| z.min(*high).max(*low));
                if z != natural {
                    samples.push((group[0].0, z));
                }
            }
            if samples.is_empty() {
                tiles.remove(&tile);
            } else {
                tiles.insert(tile, Arc::new(Tile { samples }));
            }
        }
        Self { natural: self.natural.clone(), grid: self.grid, tiles }
    }

    /// Cut and fill by the difference of the grids before and after, m³.
    #[must_use]
    pub fn volumes_m3(&self) -> [f64; 2] {
        let step = self.grid.spacing_m();
        let cell = step.x * step.y;
        let mut volumes = [0.0; 2];
        for (&tile, shaped) in &self.tiles {
            for &(sample, z) in &shaped.samples {
                let raised = f64::from(z) - self.natural.height(self.grid.place(self.grid.sample_of(tile, sample)));
                volumes[usize::from(raised > 0.0)] += raised.abs() * cell;
            }
        }
        volumes
    }
}
