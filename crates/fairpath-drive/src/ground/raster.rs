//! A corridor on the fine grid of the ground: cross-sections come in, for each sample that they reach how low and how high the ground may be there goes out.
//!
//! Where a sample lies along and across the path depends on the plan alone and is kept: when only heights change, as they do far from where a path was drawn over, samples are bounded anew, not found anew.

use super::Ground;
use super::corridor::{CrossSection, Design, EarthworkOptions, Sections, Side};
use super::tiles::{FineGrid, TILE, TileIndex};
use crate::furniture::CLEAR_M;
use crate::section::Section;
use fairpath_curve::{Point, Vec2};
use fairpath_fit::parallel;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// What a path asks of one sample of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// Which sample of its tile.
    pub(crate) sample: u16,
    /// The natural ground there, m.
    pub(crate) natural_m: f32,
    /// How far it lies beyond the edge of the path, m; negative on the path itself.
    pub(crate) beyond_m: f32,
    /// The ground is no lower, m.
    pub(crate) low_m: f32,
    /// The ground is no higher, m.
    pub(crate) high_m: f32,
}

impl Hit {
    /// Whether no tree may stand there.
    pub(crate) fn keeps_clear(&self) -> bool {
        self.beyond_m < CLEAR_M as f32
    }
}

/// The samples that a path asks something of, by tile, each once and in order.
pub(crate) type Hits = BTreeMap<TileIndex, Arc<Vec<Hit>>>;

/// What a path asks of the ground, and where its samples lie.
#[derive(Clone, Debug, Default)]
pub(crate) struct Corridor {
    /// What is asked of each sample.
    pub(crate) hits: Hits,
    /// The samples beside the path, by tile: those of all hits, and of some more, which the slopes do not reach as they are.
    spots: BTreeMap<TileIndex, Arc<Spots>>,
}

impl PartialEq for Corridor {
    fn eq(&self, other: &Self) -> bool {
        // How far beside the slopes samples are known tells nothing of the ground.
        self.hits == other.hits
    }
}

impl Corridor {
    /// Whether a tile keeps the same samples clear of trees as another corridor's does for certain: these are told by the plan.
    pub(crate) fn clears_as(&self, other: &Self, tile: TileIndex) -> bool {
        matches!((self.spots.get(&tile), other.spots.get(&tile)), (Some(a), Some(b)) if Arc::ptr_eq(a, b))
    }
}

/// The samples of a tile beside a path.
#[derive(Debug, PartialEq)]
struct Spots {
    /// The strips that may reach the tile, ascending, each as it was looked at.
    strips: Vec<StripPlan>,
    /// By samples, and of those at one sample the nearest first.
    all: Vec<Spot>,
}

/// What the samples of a strip, the ground between two cross-sections, depend on: middles and directions of its sections, and how far to the left and the right it is looked at, m.
#[derive(Clone, Copy, Debug, PartialEq)]
struct StripPlan {
    between: [(Point, Vec2); 2],
    looked_m: [f64; 2],
}

/// A sample in a strip.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spot {
    /// Which sample of its tile.
    sample: u16,
    /// Which strip of its tile.
    strip: u16,
    /// How far from the first section to the second, 0 to 1.
    along: f32,
    /// To the left of the path, m.
    across_m: f32,
    /// Height of the natural ground there, m.
    natural_m: f32,
}

/// What the cross-sections of a path ask of the ground. Takes time in proportion to the area of the corridor that is new: of `before`, the sections and what they asked of the same
/// natural ground under the same options and with the same bed and widths, tiles stay that neither the old nor the new ones reach, and samples where they have the same plan.
pub(crate) fn corridor(
    sections: &Sections,
    before: Option<(&[CrossSection], &Corridor)>,
    section: &Section,
    options: &EarthworkOptions,
    ground: &Ground,
) -> Corridor {
    let (grid, half_widths_m) = (ground.grid(), section.half_widths_m());
    // Where most is new, all tiles are asked anew, which costs less than to tell which.
    let is_mostly_new = 2 * sections.new.len() > sections.all.len();
    let (mut corridor, which) = match before.filter(|_| !is_mostly_new) {
        Some((old, corridor)) => {
            let reached = |all: &[CrossSection], changed: &Range<usize>| -> Vec<TileIndex> {
                // A section bounds the strips on both sides of it.
                let pairs = changed.start.saturating_sub(1)..(changed.end + 1).min(all.len());
                let strips = all[pairs].windows(2).filter_map(|pair| StripPlan::of([&pair[0], &pair[1]], grid));
                strips.filter_map(|plan| plan.tiles(grid)).flat_map(tiles_within).collect()
            };
            let mut which = reached(old, &sections.old);
            which.extend(reached(&sections.all, &sections.new));
            which.sort_by_key(|tile| rank(*tile));
            which.dedup();
            (corridor.clone(), Some(which))
        }
        None => (Corridor::default(), None),
    };
    let pairs: Vec<&[CrossSection]> = sections.all.windows(2).collect();
    let strips: Vec<Strip> =
        parallel::map(&pairs, |pair| Strip::of([&pair[0], &pair[1]], grid)).into_iter().flatten().collect();
    // The strips that may reach each tile, ascending; those next to each other mostly lie on the same tiles.
    let mut reaching: Vec<(TileIndex, Range<usize>)> = Vec::new();
    let mut next = 0;
    for run in strips.chunk_by(|a, b| a.tiles == b.tiles) {
        let range = next..next + run.len();
        next = range.end;
        let tiles = tiles_within(run[0].tiles);
        let wanted = tiles.filter(|tile| which.as_ref().is_none_or(|which| which.binary_search(tile).is_ok()));
        reaching.extend(wanted.map(|tile| (tile, range.clone())));
    }
    // Stable, so that strips stay in their order.
    reaching.sort_by_key(|(tile, _)| rank(*tile));
    let reaching: Vec<&[(TileIndex, Range<usize>)]> = reaching.chunk_by(|a, b| a.0 == b.0).collect();
    let asked = parallel::map(&reaching, |reaching| {
        let tile = reaching[0].0;
        let strips: Vec<&Strip> = reaching.iter().flat_map(|(_, range)| &strips[range.clone()]).collect();
        let known = before.and_then(|(_, old)| old.spots.get(&tile));
        let (spots, places) = Spots::on(tile, &strips, known, half_widths_m, ground);
        let hits = spots.bounded(&places, section.bed_m, options, grid);
        let same = before.and_then(|(_, old)| old.hits.get(&tile)).filter(|old| ***old == hits);
        (spots, same.cloned().unwrap_or_else(|| Arc::new(hits)))
    });
    for tile in which.iter().flatten() {
        corridor.hits.remove(tile);
        corridor.spots.remove(tile);
    }
    let (mut spots, mut hits) = (Vec::new(), Vec::new());
    for (reaching, (own, asked)) in reaching.into_iter().zip(asked) {
        let tile = reaching[0].0;
        spots.extend((!own.all.is_empty()).then_some((tile, own)));
        hits.extend((!asked.is_empty()).then_some((tile, asked)));
    }
    corridor.spots.append(&mut spots.into_iter().collect());
    corridor.hits.append(&mut hits.into_iter().collect());
    corridor
}

/// The order of tiles in one number, which is soon compared.
fn rank([column, row]: TileIndex) -> u64 {
    u64::from(column) << 32 | u64::from(row)
}

/// The tiles between two columns and rows of tiles.
fn tiles_within([low, high]: [TileIndex; 2]) -> impl Iterator<Item = TileIndex> {
    (low[1]..=high[1]).flat_map(move |row| (low[0]..=high[0]).map(move |column| [column, row]))
}

/// How far a side reaches: to daylight, or as far as no tree shall stand.
fn furthest(side: &Side) -> f64 {
    side.daylight_m.max(side.half_width_m + CLEAR_M)
}

/// Sides are looked at this much further than they reach, m: as long as a slope reaches no further, the samples beside it are the same.
const SLACK_M: f64 = 5.0;

/// Distances of samples are rounded to less, m.
const ROUNDING_M: f64 = 1e-3;

/// Sections that turn by more from one to the next are taken for turning by as much: twice the angle of this cosine.
const LEAST_COSINE: f64 = 0.1;

impl StripPlan {
    /// The plan of the strip between two cross-sections, if it can ask anything of the ground.
    fn of([a, b]: [&CrossSection; 2], grid: &FineGrid) -> Option<Self> {
        if a.covered || b.covered || !(b.station_m > a.station_m) {
            return None;
        }
        let looked_m = [0, 1].map(|i| furthest(&a.sides[i]).max(furthest(&b.sides[i])) + grid.step_m());
        Some(Self { between: [(a.point, a.left), (b.point, b.left)], looked_m })
    }

    /// The same, looked at further.
    fn wider(self) -> Self {
        Self { looked_m: self.looked_m.map(|looked| looked + SLACK_M), ..self }
    }

    /// Whether a strip with this plan has all samples of one with the other, however their distances are rounded.
    fn holds(&self, other: &Self) -> bool {
        self.between == other.between && (0..2).all(|i| self.looked_m[i] >= other.looked_m[i] + ROUNDING_M)
    }

    /// The first and the last tile by column and row between which it lies; nothing beside the terrain.
    fn tiles(&self, grid: &FineGrid) -> Option<[TileIndex; 2]> {
        let [columns, rows] = self.reached(grid)?;
        Some([0, 1].map(|i| grid.tile_of([columns[i], rows[i]]).0))
    }

    /// The columns and rows of the grid between which it lies.
    fn reached(&self, grid: &FineGrid) -> Option<[[usize; 2]; 2]> {
        let [(a, left_a), (b, left_b)] = self.between;
        // Between two sections that turn, what is no further than they reach bulges beyond the line between their ends.
        let cosine = (0.5 * (left_a + left_b).hypot2().sqrt()).max(LEAST_COSINE);
        let [left, right] = self.looked_m.map(|looked| looked / cosine + ROUNDING_M);
        grid.samples_around(&[a + left_a * left, a - left_a * right, b + left_b * left, b - left_b * right])
    }
}

/// A share of the grid's step that is nothing.
const HAIR: f64 = 1e-6;

/// Two cross-sections of which one follows the other.
type Between<'a> = [&'a CrossSection; 2];

/// The ground between two cross-sections.
struct Strip<'a> {
    between: Between<'a>,
    plan: StripPlan,
    /// The tiles that it reaches as it is.
    reached: Option<[TileIndex; 2]>,
    /// The plan by which its samples are looked for, and the tiles in which these lie.
    wide: StripPlan,
    tiles: [TileIndex; 2],
}

impl<'a> Strip<'a> {
    /// The ground between two cross-sections, if they can ask anything of it.
    fn of(between: Between<'a>, grid: &FineGrid) -> Option<Self> {
        let plan = StripPlan::of(between, grid)?;
        let wide = plan.wider();
        Some(Self { between, plan, reached: plan.tiles(grid), wide, tiles: wide.tiles(grid)? })
    }

    /// Whether it may ask anything of a tile as it is.
    fn reaches(&self, tile: TileIndex) -> bool {
        let is_in = |[low, high]: [TileIndex; 2]| (0..2).all(|i| (low[i]..=high[i]).contains(&tile[i]));
        self.reached.is_some_and(is_in)
    }
}

impl Spots {
    /// The samples of a tile in these strips, and the cross-sections between which each strip lies that may ask anything of them. Samples of strips that lie where they lay `before` are kept.
    fn on<'a>(
        tile: TileIndex,
        strips: &[&Strip<'a>],
        before: Option<&Arc<Self>>,
        half_widths_m: [f64; 2],
        ground: &Ground,
    ) -> (Arc<Self>, Vec<Between<'a>>) {
        let known = before.map_or(&[][..], |before| &before.strips);
        // For each of the strips known before the one that is there now.
        let mut kept = vec![None; known.len()];
        let mut own: Vec<(&Strip, Option<usize>)> = Vec::with_capacity(strips.len());
        let mut next = 0;
        for strip in strips {
            let place = known[next..].iter().position(|known| known.holds(&strip.plan)).map(|i| next + i);
            if let Some(place) = place {
                (kept[place], next) = (Some(own.len()), place + 1);
            } else if !strip.reaches(tile) {
                continue;
            }
            own.push((strip, place));
        }
        // Not if one is gone: then trees may stand where it was.
        let is_as_before = own.len() == known.len() && own.iter().all(|(_, place)| place.is_some());
        let places = own.iter().map(|(strip, _)| strip.between).collect();
        if let Some(before) = before.filter(|_| is_as_before) {
            return (before.clone(), places);
        }
        // No more strips are told apart on one tile: what lies there so often is no road.
        own.truncate(usize::from(u16::MAX) + 1);
        let mut found = Vec::new();
        for spot in before.iter().flat_map(|before| &before.all) {
            if let Some(strip) = kept[usize::from(spot.strip)].filter(|strip| *strip < own.len()) {
                found.push(Spot { strip: strip as u16, ..*spot });
            }
        }
        for (i, (strip, _)) in own.iter().enumerate().filter(|(_, (_, place))| place.is_none()) {
            strip.spots(i as u16, ground, tile, &mut found);
        }
        let plans = own.iter().map(|(strip, place)| place.map_or(strip.wide, |place| known[place]));
        (Arc::new(Self { strips: plans.collect(), all: in_order(&found, half_widths_m) }), places)
    }

    /// What strips between these cross-sections ask of their samples, in order.
    fn bounded(&self, strips: &[Between<'_>], bed_m: f64, options: &EarthworkOptions, grid: &FineGrid) -> Vec<Hit> {
        let strips: Vec<Bounds> = strips.iter().map(|between| Bounds::of(*between, bed_m, options, grid)).collect();
        let mut hits: Vec<Hit> = Vec::with_capacity(self.all.len());
        let mut last = None;
        for spot in &self.all {
            if last == Some(spot.sample) {
                continue;
            }
            if let Some((beyond, [low, high])) = strips[usize::from(spot.strip)].at(spot) {
                last = Some(spot.sample);
                hits.push(Hit {
                    sample: spot.sample,
                    natural_m: spot.natural_m,
                    beyond_m: beyond as f32,
                    low_m: low as f32,
                    high_m: high as f32,
                });
            }
        }
        hits.shrink_to_fit();
        hits
    }
}

/// Samples by their numbers, and of those at one sample the nearest to the edge of the path first: of what several stretches of it ask of one sample, the nearest counts.
fn in_order(found: &[Spot], half_widths_m: [f64; 2]) -> Vec<Spot> {
    // Counted, then put in their places.
    let mut next = [0_u32; TILE * TILE + 1];
    found.iter().for_each(|spot| next[usize::from(spot.sample) + 1] += 1);
    for i in 1..next.len() {
        next[i] += next[i - 1];
    }
    let mut all = found.to_vec();
    for spot in found {
        let place = &mut next[usize::from(spot.sample)];
        all[*place as usize] = *spot;
        *place += 1;
    }
    let beyond = |spot: &Spot| f64::from(spot.across_m.abs()) - half_widths_m[usize::from(spot.across_m < 0.0)];
    for group in all.chunk_by_mut(|a, b| a.sample == b.sample) {
        if group.len() > 1 {
            group.sort_by(|a, b| beyond(a).total_cmp(&beyond(b)).then(a.strip.cmp(&b.strip)));
        }
    }
    all
}

/// What a strip asks of its samples.
struct Bounds {
    /// Whether it shapes the ground: a bridge or a pipe asks nothing of it, but no tree shall stand under them.
    shapes: bool,
    surface_m: Even,
    /// The rest of the design, with no height yet.
    design: Design,
    /// Left and right.
    sides: [SideBounds; 2],
}

struct SideBounds {
    half_width_m: f64,
    reach_m: Even,
    fill: Even,
    cut: Even,
}

/// What goes evenly from the first section to the second: what it is at the first, and by how much more at the second.
struct Even([f64; 2]);

impl Even {
    fn between(from: f64, to: f64) -> Self {
        Self([from, to - from])
    }

    #[inline]
    fn at(&self, share: f64) -> f64 {
        self.0[0] + share * self.0[1]
    }
}

impl Bounds {
    fn of([a, b]: Between<'_>, bed_m: f64, options: &EarthworkOptions, grid: &FineGrid) -> Self {
        let side = |i: usize| {
            let (a, b) = (&a.sides[i], &b.sides[i]);
            // A wall stands where it stands; elsewhere the natural ground itself ends the slope.
            let spare = if a.wall || b.wall { 0.0 } else { grid.step_m() };
            let [[fill_a, cut_a], [fill_b, cut_b]] = [a.slopes(), b.slopes()];
            SideBounds {
                half_width_m: a.half_width_m,
                reach_m: Even::between(furthest(a) + spare, furthest(b) + spare),
                fill: Even::between(fill_a, fill_b),
                cut: Even::between(cut_a, cut_b),
            }
        };
        Self {
            shapes: a.on_ground && b.on_ground,
            surface_m: Even::between(a.height_m, b.height_m),
            design: Design { surface_m: 0.0, bed_m, verge_m: options.verge_m, drop_m: options.verge_drop_m },
            sides: [side(0), side(1)],
        }
    }

    /// How far beyond the edge of what is laid a sample is, and its lowest and highest height; nothing where the strip does not reach it.
    #[inline]
    fn at(&self, spot: &Spot) -> Option<(f64, [f64; 2])> {
        let u = f64::from(spot.along);
        let side = &self.sides[usize::from(spot.across_m < 0.0)];
        let across = f64::from(spot.across_m.abs());
        if across > side.reach_m.at(u) {
            return None;
        }
        let beyond = across - side.half_width_m;
        let bounds = if self.shapes {
            let design = Design { surface_m: self.surface_m.at(u), ..self.design };
            design.bounds(beyond, [side.fill.at(u), side.cut.at(u)])
        } else {
            [f64::NEG_INFINITY, f64::INFINITY]
        };
        Some((beyond, bounds))
    }
}

impl Strip<'_> {
    /// Its samples on a tile, of which it is the strip with this number.
    fn spots(&self, strip: u16, ground: &Ground, tile: TileIndex, found: &mut Vec<Spot>) {
        let grid = ground.grid();
        let Some(reach) = self.wide.reached(grid) else { return };
        let [(a, left_a), (b, left_b)] = self.wide.between;
        let within = |[from, to]: [usize; 2], tile: u32| {
            let first = tile as usize * TILE;
            [from.max(first), to.min(first + TILE - 1)]
        };
        let [columns, rows] = [within(reach[0], tile[0]), within(reach[1], tile[1])];
        let along = |left: Vec2| Vec2::new(left.y, -left.x);
        let (ta, tb) = (along(left_a), along(left_b));
        // Of each row, whether what lies beyond a section towards east is wanted, and how its line slants.
        let sides = [(a, ta, true), (b, tb, false)]
            .map(|(point, t, beyond)| (t.x != 0.0).then(|| (point, t.y / t.x, (t.x > 0.0) == beyond)));
        let [first, last] = columns.map(|column| column as f64);
        let step = grid.spacing_m().x;
        for row in rows[0]..=rows[1] {
            // Of a row only what lies beyond the one section and before the other, and a hair on both sides for rounding.
            let start = grid.place([0, row]);
            let mut within = [first, last];
            for (point, slope, beyond) in sides.iter().flatten() {
                let column = (point.x - (start.y - point.y) * slope - start.x) / step;
                if *beyond {
                    within[0] = within[0].max(column - HAIR);
                } else {
                    within[1] = within[1].min(column + HAIR);
                }
            }
            if !(within[0] <= within[1]) {
                continue;
            }
            // Up to the next whole number; it is none below 0.
            let from = within[0] as usize;
            let from = from + usize::from((from as f64) < within[0]);
            for column in from..=within[1] as usize {
                let p = grid.place([column, row]);
                let (da, db) = ((p - a).dot(ta), (p - b).dot(tb));
                if da < 0.0 || db > 0.0 || da == db {
                    continue;
                }
                let u = da / (da - db);
                let off = p - a.lerp(b, u);
                let is_right = off.dot(left_a.lerp(left_b, u)) < 0.0;
                let looked = self.wide.looked_m[usize::from(is_right)];
                if off.hypot2() > looked * looked {
                    continue;
                }
                let across = off.hypot2().sqrt();
                let (_, sample) = grid.tile_of([column, row]);
                let across_m = if is_right { -across } else { across } as f32;
                let natural_m = ground.natural_at([column, row]) as f32;
                found.push(Spot { sample, strip, along: u as f32, across_m, natural_m });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terrain::{Heightfield, Samples};
    use fairpath_curve::trig;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_sample_that_a_strip_looks_at_lies_outside_of_its_box(
            heading in -3.2..3.2_f64, radius in 1.0..60.0_f64, turn in -0.7..0.7_f64, share in 0.3..0.7_f64, looked in [0.5..60.0_f64, 0.5..60.0_f64],
        ) {
            let natural = Heightfield::new([161, 161], Point::ORIGIN, Vec2::new(1.0, 1.0), Samples::F32(vec![0.0; 161 * 161]));
            let grid = FineGrid::of(&natural.unwrap());
            // From the one to the other as along a clothoid that begins or ends straight, or along anything between these.
            let chord = trig::unit(heading + share * turn) * (radius * turn.abs());
            let left = |angle: f64| Vec2::new(-trig::unit(heading + angle).y, trig::unit(heading + angle).x);
            let start = Point::new(80.0, 80.0);
            let plan = StripPlan { between: [(start, left(0.0)), (start + chord, left(turn))], looked_m: looked };
            let [(a, left_a), (b, left_b)] = plan.between;
            let along = |left: Vec2| Vec2::new(left.y, -left.x);
            let reached = plan.reached(&grid);
            for (column, row) in (0..161).flat_map(|column| (0..161).map(move |row| (column, row))) {
                let p = grid.place([column, row]);
                let (da, db) = ((p - a).dot(along(left_a)), (p - b).dot(along(left_b)));
                if da < 0.0 || db > 0.0 || da == db {
                    continue;
                }
                let u = da / (da - db);
                let off = p - a.lerp(b, u);
                let side = usize::from(off.dot(left_a.lerp(left_b, u)) < 0.0);
                if off.hypot() <= looked[side] {
                    let is_in = reached.is_some_and(|[columns, rows]| {
                        (columns[0]..=columns[1]).contains(&column) && (rows[0]..=rows[1]).contains(&row)
                    });
                    prop_assert!(is_in, "{p:?} is not in {reached:?}");
                }
            }
        }
    }
}
