//! The ground: the natural terrain, and what was cut and filled for paths. The terrain itself is never changed: what was shaped lies over it in tiles of a finer grid, so that undoing
//! is exact, and the cost of a change is that of its corridor.

mod asked;
mod corridor;
mod raster;
mod soil;
mod tiles;
mod volumes;

pub use corridor::{CrossSection, EarthworkOptions, Side};
pub use soil::{Soil, SoilRegion, Soils};
pub use tiles::{FineGrid, TileIndex};
pub use volumes::{MassHaul, areas_m2_at, mass_haul, volumes_m3};

pub(crate) use asked::Asked;
pub(crate) use corridor::{Site as CorridorSite, cross_sections};
pub(crate) use raster::{Corridor, Hit, Hits, corridor};
pub(crate) use tiles::TILE;

use crate::terrain::Heightfield;
use fairpath_curve::Point;
use fairpath_fit::parallel;
use std::collections::BTreeSet;
use std::sync::Arc;
use tiles::{Tile, Tiles};

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
        Self { grid: FineGrid::of(&natural), natural, tiles: Tiles::default() }
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
        self.tiles.iter().map(|(tile, _)| tile)
    }

    /// Column and row of every sample that was shaped, tile by tile.
    pub fn shaped_samples(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let grid = self.grid;
        self.tiles.iter().flat_map(move |(tile, shaped)| shaped.samples.iter().map(move |s| grid.sample_of(tile, s.0)))
    }

    /// The tiles in which this ground differs from another one of the same terrain.
    #[must_use]
    pub fn changed_tiles(&self, other: &Self) -> Vec<TileIndex> {
        let tiles: BTreeSet<TileIndex> = self.shaped_tiles().chain(other.shaped_tiles()).collect();
        let same = |tile: &TileIndex| match (self.tiles.get(*tile), other.tiles.get(*tile)) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b) || a == b,
            _ => false,
        };
        tiles.into_iter().filter(|tile| !same(tile)).collect()
    }

    /// The height of a sample of the fine grid before anything was shaped, m.
    fn natural_at(&self, at: [usize; 2]) -> f64 {
        self.natural.height_between(at, self.grid.parts())
    }

    /// The height of a sample of the fine grid, m.
    #[must_use]
    pub fn sample(&self, at: [usize; 2]) -> f64 {
        self.shaped(at).unwrap_or_else(|| self.natural_at(at))
    }

    /// The height of a sample of the fine grid, m, if it was shaped.
    #[must_use]
    pub fn shaped(&self, at: [usize; 2]) -> Option<f64> {
        let (tile, sample) = self.grid.tile_of(at);
        self.tiles.get(tile)?.height(sample).map(f64::from)
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
        let z: Vec<f64> = (0..4).map(|i| shaped[i].unwrap_or_else(|| self.natural_at(around[i]))).collect();
        (z[0] * (1.0 - u) + z[1] * u) * (1.0 - v) + (z[2] * (1.0 - u) + z[3] * u) * v
    }

    /// The ground with these tiles shaped anew by what paths ask of them; all others stay as they are. `corridors` are those of all paths, in an order that does
    /// not depend on when they were drawn.
    #[must_use]
    pub(crate) fn reshaped(&self, which: &BTreeSet<TileIndex>, corridors: &[&Hits]) -> Self {
        let asked = Asked::of(which, corridors);
        let which: Vec<TileIndex> = which.iter().copied().collect();
        let shaped = parallel::map(&which, |tile| shaped_samples(asked.on(*tile)));
        let mut tiles = self.tiles.clone();
        for (tile, samples) in which.into_iter().zip(shaped) {
            tiles.set(tile, Tile { samples });
        }
        Self { natural: self.natural.clone(), grid: self.grid, tiles }
    }

    /// No height on a tile is lower, m.
    pub(crate) fn lowest_m(&self, tile: TileIndex) -> f64 {
        let [column, row] = tile;
        // Between its last samples and the first of the next tiles it is as these are, too.
        let [low, high] = [tile, [column + 1, row + 1]].map(|tile| self.grid.place(self.grid.sample_of(tile, 0)));
        let next = [tile, [column + 1, row], [column, row + 1], [column + 1, row + 1]];
        let shaped = next.iter().filter_map(|tile| self.tiles.get(*tile)).flat_map(|tile| &tile.samples);
        shaped.map(|(_, z)| f64::from(*z)).fold(self.natural.lowest_m([low, high]), f64::min)
    }

    /// Cut and fill by the difference of the grids before and after, m³.
    #[must_use]
    pub fn volumes_m3(&self) -> [f64; 2] {
        let step = self.grid.spacing_m();
        let cell = step.x * step.y;
        let mut volumes = [0.0; 2];
        for (tile, shaped) in self.tiles.iter() {
            for &(sample, z) in &shaped.samples {
                let raised = f64::from(z) - self.natural_at(self.grid.sample_of(tile, sample));
                volumes[usize::from(raised > 0.0)] += raised.abs() * cell;
            }
        }
        volumes
    }
}

/// The samples of a tile that are shaped by what paths ask of it, in order, and their heights, m.
fn shaped_samples(asked: &[&[Hit]]) -> Vec<(u16, f32)> {
    let bounded = |z: f32, hit: &Hit| z.min(hit.high_m).max(hit.low_m);
    let mut samples = Vec::new();
    let mut add = |sample: u16, natural: f32, z: f32| {
        if z != natural {
            samples.push((sample, z));
        }
    };
    if let [alone] = asked {
        for hit in *alone {
            add(hit.sample, hit.natural_m, bounded(hit.natural_m, hit));
        }
    } else {
        let mut all: Vec<&Hit> = asked.iter().copied().flatten().collect();
        // The nearest path has the last word, and of two as near the one that was drawn later.
        all.sort_by(|p, q| p.sample.cmp(&q.sample).then(q.beyond_m.total_cmp(&p.beyond_m)));
        for group in all.chunk_by(|p, q| p.sample == q.sample) {
            let natural = group[0].natural_m;
            add(group[0].sample, natural, group.iter().fold(natural, |z, hit| bounded(z, hit)));
        }
    }
    samples
}
