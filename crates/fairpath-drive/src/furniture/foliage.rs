//! Trees by density (section 3.6.4 of the thesis): regions, paths and water come in, trees go out, none nearer to another than a crown is wide.
//!
//! Places are drawn by hashing the cells of a grid, and a place keeps its tree if no place within the distance has a higher lot (a hard-core process after Matérn, *Spatial Variation*, 1960,
//! the second kind, with several lots for each cell). So each tree depends on its neighbourhood only: a change of one place changes nothing elsewhere, and the same seed gives the same wood.

use crate::document::FoliageRegion;
use crate::ground::{FineGrid, Ground, Hits, TileIndex};
use crate::terrain::{Waters, inside};
use fairpath_curve::{Point, Vec2};
use std::sync::Arc;

/// No tree stands nearer to another, m.
pub(crate) const APART_M: f64 = 4.5;

/// Nor to the edge of what is laid, m.
pub(crate) const CLEAR_M: f64 = 3.0;

/// Lots for each cell of the grid, whose side is [`APART_M`].
const LOTS: u64 = 3;

/// A tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree {
    /// Where its foot stands, m.
    pub place: Point,
    /// Height of its foot, m.
    pub foot_m: f64,
    /// Its height as a share of that of a full-grown one.
    pub size: f64,
    /// By how much it is turned, radians.
    pub turn_rad: f64,
    /// Which of the kinds of trees it is, 0 or more.
    pub kind: u8,
}

/// The trees on one tile of the fine grid.
pub(crate) fn trees_on(
    tile: TileIndex,
    ground: &Ground,
    regions: &[Arc<FoliageRegion>],
    corridors: &[&Hits],
    waters: &Waters,
    seed: u64,
) -> Vec<Tree> {
    let grid = ground.grid();
    let [low, high] = tile_box(grid, tile);
    let origin = ground.natural().corner();
    let cell = |x: f64, from: f64| ((x - from) / APART_M).floor() as i64;
    let mut found = Vec::new();
    let regions: Vec<&Arc<FoliageRegion>> = regions.iter().collect();
    for row in cell(low.y, origin.y)..=cell(high.y, origin.y) {
        for column in cell(low.x, origin.x)..=cell(high.x, origin.x) {
            for lot in 0..LOTS {
                let own = Lot::new([column, row], lot, seed, origin);
                let here = own.place.x >= low.x && own.place.x < high.x && own.place.y >= low.y && own.place.y < high.y;
                if !here || !ground.natural().contains(own.place) {
                    continue;
                }
                let density = density_at(&regions, own.place);
                if !(own.wish < density) || !own.wins(seed, origin) {
                    continue;
                }
                let foot_m = ground.height(own.place);
                let wet = waters.covers(own.place, foot_m - 0.3);
                if wet || is_blocked(grid, corridors, own.place) {
                    continue;
                }
                found.push(Tree {
                    place: own.place,
                    foot_m,
                    size: 0.7 + 0.6 * own.size,
                    turn_rad: std::f64::consts::TAU * own.turn,
                    kind: (own.kind * 3.0) as u8,
                });
            }
        }
    }
    found
}

/// The tiles that a region lies over.
pub(crate) fn tiles_of(grid: &FineGrid, region: &FoliageRegion) -> Vec<TileIndex> {
    let Some([columns, rows]) = grid.samples_around(&region.outline) else { return Vec::new() };
    let (first, _) = grid.tile_of([columns[0], rows[0]]);
    let (last, _) = grid.tile_of([columns[1], rows[1]]);
    let mut tiles = Vec::new();
    for row in first[1]..=last[1] {
        for column in first[0]..=last[0] {
            tiles.push([column, row]);
        }
    }
    tiles
}

fn tile_box(grid: &FineGrid, tile: TileIndex) -> [Point; 2] {
    let low = grid.place(grid.sample_of(tile, 0));
    let next = [tile[0] + 1, tile[1] + 1];
    [low, grid.place(grid.sample_of(next, 0))]
}

/// The density that was said last about a place.
fn density_at(regions: &[&Arc<FoliageRegion>], place: Point) -> f64 {
    regions.iter().rev().find(|r| inside(&r.outline, place)).map_or(0.0, |r| r.density)
}

/// Whether a place lies on a path or too near to one.
fn is_blocked(grid: &FineGrid, corridors: &[&Hits], place: Point) -> bool {
    let Some([columns, rows]) = grid.samples_around(&[
        place - Vec2::new(grid.spacing_m().x, grid.spacing_m().y),
        place + Vec2::new(grid.spacing_m().x, grid.spacing_m().y),
    ]) else {
        return true;
    };
    for row in rows[0]..=rows[1] {
        for column in columns[0]..=columns[1] {
            let (tile, sample) = grid.tile_of([column, row]);
            for hits in corridors.iter().filter_map(|c| c.get(&tile)) {
                if let Ok(i) = hits.binary_search_by_key(&sample, |h| h.sample)
                    && hits[i].beyond_m < CLEAR_M as f32
                {
                    return true;
                }
            }
        }
    }
    false
}

/// A place that could have a tree.
struct Lot {
    cell: [i64; 2],
    lot: u64,
    place: Point,
    rank: u64,
    /// It is there from this density on.
    wish: f64,
    size: f64,
    turn: f64,
    kind: f64,
}

impl Lot {
    fn new(cell: [i64; 2], lot: u64, seed: u64, origin: Point) -> Self {
        let mut state = hash(seed ^ hash(cell[0] as u64 ^ hash((cell[1] as u64).wrapping_add(lot << 48))));
        let mut next = || {
            state = hash(state);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (u, v) = (next(), next());
        let place = origin + Vec2::new((cell[0] as f64 + u) * APART_M, (cell[1] as f64 + v) * APART_M);
        let (wish, size, turn, kind) = (next(), next(), next(), next());
        Self { cell, lot, place, rank: hash(state), wish, size, turn, kind }
    }

    /// Whether no place within the distance has a higher rank.
    fn wins(&self, seed: u64, origin: Point) -> bool {
        for row in -1..=1 {
            for column in -1..=1 {
                for lot in 0..LOTS {
                    let cell = [self.cell[0] + column, self.cell[1] + row];
                    if cell == self.cell && lot == self.lot {
                        continue;
                    }
                    let other = Self::new(cell, lot, seed, origin);
                    if (other.place - self.place).hypot2() < APART_M * APART_M && other.rank > self.rank {
                        return false;
                    }
                }
            }
        }
        true
    }
}

/// SplitMix64's mixing of bits (Steele, Lea and Flood 2014).
fn hash(x: u64) -> u64 {
    let z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
