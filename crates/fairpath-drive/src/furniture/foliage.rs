//! Trees by density (section 3.6.4 of the thesis): regions, paths and water come in, trees go out, none nearer to another than a crown is wide.
//!
//! Places are drawn by hashing the cells of a grid, and a place keeps its tree if no place within the distance has a higher lot (a hard-core process after Matérn, *Spatial Variation*, 1960,
//! the second kind, with several lots for each cell). So each tree depends on its neighbourhood only: a change of one place changes nothing elsewhere, and the same seed gives the same wood.

use crate::document::FoliageRegion;
use crate::ground::{Asked, FineGrid, Ground, TILE, TileIndex};
use crate::terrain::{Waters, inside};
use fairpath_curve::{Point, Rect, Vec2};
use std::cmp::Ordering;
use std::sync::Arc;

/// No tree stands nearer to another, m.
pub(crate) const APART_M: f64 = 4.5;

/// Nor to the edge of what is laid, m.
pub(crate) const CLEAR_M: f64 = 3.0;

/// Nor lower above water, m.
pub(crate) const DRY_M: f64 = 0.3;

/// Lots for each cell of the grid, whose side is [`APART_M`].
const LOTS: u64 = 3;

/// A tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree {
    /// Where its foot stands, m, on the ground.
    pub place: Point,
    /// Its height as a share of that of a full-grown one.
    pub size: f64,
    /// By how much it is turned, radians.
    pub turn_rad: f64,
    /// Which of the kinds of trees it is, 0 or more.
    pub kind: u8,
}

/// The trees that would stand on one tile of the fine grid if there were neither paths nor water.
pub(crate) fn wild_trees_on(tile: TileIndex, ground: &Ground, regions: &[Arc<FoliageRegion>], seed: u64) -> Vec<Tree> {
    let [low, high] = tile_box(ground.grid(), tile);
    let bounds = Rect::new(low.x, low.y, high.x, high.y);
    if !regions.iter().any(|region| touches(&region.outline, bounds)) {
        return Vec::new();
    }
    let origin = ground.natural().corner();
    let cell = |x: f64, from: f64| ((x - from) / APART_M).floor() as i64;
    let first = [cell(low.x, origin.x) - 1, cell(low.y, origin.y) - 1];
    let size = [cell(high.x, origin.x) - first[0] + 2, cell(high.y, origin.y) - first[1] + 2].map(|n| n as usize);
    // The lots of all cells on the tile and of one more around it.
    let mut lots = Vec::with_capacity(size[0] * size[1] * LOTS as usize);
    for row in 0..size[1] {
        for column in 0..size[0] {
            let at = [first[0] + column as i64, first[1] + row as i64];
            lots.extend((0..LOTS).map(|lot| Lot::new(at, lot, seed, origin)));
        }
    }
    let of_cell = |column: usize, row: usize| {
        let from = (row * size[0] + column) * LOTS as usize;
        &lots[from..from + LOTS as usize]
    };
    let densest = regions.iter().map(|region| region.density).fold(0.0, f64::max);
    let mut found = Vec::new();
    for row in 1..size[1] - 1 {
        for column in 1..size[0] - 1 {
            for own in of_cell(column, row) {
                let here = own.place.x >= low.x && own.place.x < high.x && own.place.y >= low.y && own.place.y < high.y;
                if !here || !ground.natural().contains(own.place) {
                    continue;
                }
                if !(own.wish < densest && own.wish < density_at(regions, own.place)) {
                    continue;
                }
                let beats_own =
                    |other: &Lot| other.rank > own.rank && (other.place - own.place).hypot2() < APART_M * APART_M;
                if (row - 1..=row + 1).any(|r| (column - 1..=column + 1).any(|c| of_cell(c, r).iter().any(beats_own))) {
                    continue;
                }
                let [size, turn, kind] = own.looks();
                found.push(Tree {
                    place: own.place,
                    size: 0.7 + 0.6 * size,
                    turn_rad: std::f64::consts::TAU * turn,
                    kind: (kind * 3.0) as u8,
                });
            }
        }
    }
    found
}

/// Of the trees on a tile those that neither paths nor water are in the way of.
pub(crate) fn standing(
    tile: TileIndex,
    wild: &Arc<Vec<Tree>>,
    ground: &Ground,
    asked: &Asked<'_>,
    waters: &Waters,
) -> Arc<Vec<Tree>> {
    if wild.is_empty() {
        return wild.clone();
    }
    let clear = Clear::around(tile, ground.grid(), asked);
    let stands = |tree: &Tree| {
        let is_wet = || waters.level_at(tree.place).is_some_and(|level| ground.height(tree.place) < level + DRY_M);
        !clear.is_kept_at(tree.place) && !is_wet()
    };
    if wild.iter().all(stands) {
        return wild.clone();
    }
    Arc::new(wild.iter().copied().filter(stands).collect())
}

/// The tiles that a region lies over.
pub(crate) fn tiles_of(grid: &FineGrid, region: &FoliageRegion) -> Vec<TileIndex> {
    // A tile reaches up to the first sample of the next one.
    let step = grid.spacing_m();
    let around: Vec<Point> = region.outline.iter().flat_map(|p| [*p - step, *p + step]).collect();
    let Some([columns, rows]) = grid.samples_around(&around) else { return Vec::new() };
    grid.tiles(columns, rows).collect()
}

fn tile_box(grid: &FineGrid, tile: TileIndex) -> [Point; 2] {
    let low = grid.place(grid.sample_of(tile, 0));
    let next = [tile[0] + 1, tile[1] + 1];
    [low, grid.place(grid.sample_of(next, 0))]
}

/// Whether an outline may have anything of a box within it.
fn touches(outline: &[Point], bounds: Rect) -> bool {
    let Some((first, rest)) = outline.split_first() else { return false };
    let around = rest.iter().fold(Rect::from_points(*first, *first), |sum, p| sum.union_pt(*p));
    around.x0 <= bounds.x1 && around.x1 >= bounds.x0 && around.y0 <= bounds.y1 && around.y1 >= bounds.y0
}

/// The density that was said last about a place.
fn density_at(regions: &[Arc<FoliageRegion>], place: Point) -> f64 {
    regions.iter().rev().find(|r| inside(&r.outline, place)).map_or(0.0, |r| r.density)
}

/// The samples on and around a tile that paths keep clear of trees.
struct Clear<'a> {
    grid: &'a FineGrid,
    /// The column and row of the first sample.
    first: [usize; 2],
    /// Row by row, [`Self::SIDE`] samples each.
    kept: Vec<bool>,
}

impl<'a> Clear<'a> {
    /// So many samples around a tile may have something to do with a tree on it.
    const BESIDE: usize = 2;
    const SIDE: usize = TILE + 2 * Self::BESIDE;

    fn around(tile: TileIndex, grid: &'a FineGrid, asked: &Asked<'_>) -> Self {
        let first = tile.map(|i| (i as usize * TILE).saturating_sub(Self::BESIDE));
        let mut kept = vec![false; Self::SIDE * Self::SIDE];
        let [columns, [low, high]] = tile.map(|i| [i.saturating_sub(1), i + 1]);
        let beside = (columns[0]..=columns[1]).flat_map(|column| (low..=high).map(move |row| [column, row]));
        let beside = beside.flat_map(|other| asked.on(other).iter().map(move |hits| (other, *hits)));
        for (other, hits) in beside {
            // Of the tiles in the rows before and behind, most samples are too far away.
            let rows = match other[1].cmp(&tile[1]) {
                Ordering::Less => TILE - Self::BESIDE..TILE,
                Ordering::Equal => 0..TILE,
                Ordering::Greater => 0..Self::BESIDE,
            };
            let [from, to] =
                [rows.start, rows.end].map(|row| hits.partition_point(|h| usize::from(h.sample) < row * TILE));
            for hit in hits[from..to].iter().filter(|hit| hit.keeps_clear()) {
                let at = grid.sample_of(other, hit.sample);
                let inside = |i: usize| at[i].checked_sub(first[i]).filter(|at| *at < Self::SIDE);
                if let (Some(column), Some(row)) = (inside(0), inside(1)) {
                    kept[row * Self::SIDE + column] = true;
                }
            }
        }
        Self { grid, first, kept }
    }

    /// Whether a place on the tile lies on a path or too near to one.
    fn is_kept_at(&self, place: Point) -> bool {
        let step = self.grid.spacing_m();
        let Some([columns, rows]) = self.grid.samples_around(&[place - step, place + step]) else { return true };
        let inside = |[from, to]: [usize; 2], i: usize| from - self.first[i]..=to - self.first[i];
        let columns = inside(columns, 0);
        inside(rows, 1).any(|row| columns.clone().any(|column| self.kept[row * Self::SIDE + column]))
    }
}

/// A place that could have a tree.
struct Lot {
    place: Point,
    rank: u64,
    /// It is there from this density on.
    wish: f64,
}

impl Lot {
    fn new(cell: [i64; 2], lot: u64, seed: u64, origin: Point) -> Self {
        let mut state = hash(seed ^ hash(cell[0] as u64 ^ hash((cell[1] as u64).wrapping_add(lot << 48))));
        let mut next = || {
            state = hash(state);
            share(state)
        };
        let (u, v) = (next(), next());
        let place = origin + Vec2::new((cell[0] as f64 + u) * APART_M, (cell[1] as f64 + v) * APART_M);
        let wish = next();
        Self { place, wish, rank: hash(state) }
    }

    /// Size, turn and kind of its tree, each from 0 to 1.
    fn looks(&self) -> [f64; 3] {
        let size = hash(self.rank);
        let turn = hash(size);
        [size, turn, hash(turn)].map(share)
    }
}

/// A number from 0 to 1.
fn share(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// SplitMix64's mixing of bits (Steele, Lea and Flood 2014).
fn hash(x: u64) -> u64 {
    let z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::{Hit, Hits};
    use crate::terrain::{Heightfield, Samples};
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    const SIZE: usize = 100;

    /// Somewhere from 0 to 1, often at an end.
    fn share() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), Just(1e-9), 0.0..1.0_f64, Just(1.0 - 1e-9)]
    }

    proptest! {
        #[test]
        fn what_is_kept_clear_around_a_tile_is_kept_at_each_sample_of_it(
            samples in prop::collection::btree_set((0..SIZE, 0..SIZE), 0..200),
            at_rims in prop::collection::btree_set((29..36_usize, 29..36_usize), 0..6),
            places in prop::collection::vec(((0..4_u32, 0..4_u32), (share(), share())), 1..40),
        ) {
            let spacing = Vec2::new(1.3, 1.5);
            let corner = Point::new(430_123.4, 4_700_321.7);
            let natural = Heightfield::new([SIZE, SIZE], corner, spacing, Samples::F32(vec![0.0; SIZE * SIZE])).unwrap();
            let grid = FineGrid::of(&natural);
            let samples: BTreeSet<(usize, usize)> = samples.into_iter().chain(at_rims).collect();
            // Of two paths, and with samples that may have trees.
            let mut corridors = [Hits::new(), Hits::new()];
            let mut kept = BTreeSet::new();
            for (i, &(column, row)) in samples.iter().enumerate() {
                let beyond_m = [-1.0, CLEAR_M as f32 - 0.5, CLEAR_M as f32 + 0.5][i % 3];
                if i % 3 < 2 {
                    kept.insert((column, row));
                }
                let (tile, sample) = grid.tile_of([column, row]);
                let hit = Hit { sample, natural_m: 0.0, beyond_m, low_m: 0.0, high_m: 0.0 };
                Arc::make_mut(corridors[i % 2].entry(tile).or_default()).push(hit);
            }
            for hits in corridors.iter_mut().flat_map(|hits| hits.values_mut()) {
                Arc::make_mut(hits).sort_by_key(|hit| hit.sample);
            }
            let all: BTreeSet<TileIndex> = (0..5).flat_map(|column| (0..5).map(move |row| [column, row])).collect();
            let asked = Asked::of(&all, &corridors.iter().collect::<Vec<_>>());
            for ((column, row), (u, v)) in places {
                let [low, high] = tile_box(&grid, [column, row]);
                let place = low + Vec2::new(u * (high - low).x, v * (high - low).y);
                if !natural.contains(place) {
                    continue;
                }
                let [columns, rows] = grid.samples_around(&[place - spacing, place + spacing]).unwrap();
                let expected = kept.iter().any(|(c, r)| (columns[0]..=columns[1]).contains(c) && (rows[0]..=rows[1]).contains(r));
                prop_assert_eq!(Clear::around([column, row], &grid, &asked).is_kept_at(place), expected);
            }
        }
    }
}
