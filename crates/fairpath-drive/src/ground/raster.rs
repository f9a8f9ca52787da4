//! A corridor on the fine grid of the ground: cross-sections come in, for each sample that they reach how low and how high the ground may be there goes out.

use super::corridor::{CrossSection, Design, EarthworkOptions, Sections, Side};
use super::tiles::{FineGrid, TILE, TileIndex};
use crate::furniture::CLEAR_M;
use fairpath_curve::{Point, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

/// What a path asks of one sample of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// Which sample of its tile.
    pub(crate) sample: u16,
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

/// What the cross-sections of a path ask of the ground. Takes time in proportion to the area of the corridor that is new: of `before`, the sections and what they asked of the same
/// grid under the same options and with the same bed, tiles stay that neither the old nor the new ones reach.
pub(crate) fn hits(
    sections: &Sections,
    before: Option<(&[CrossSection], &Hits)>,
    bed_m: f64,
    options: &EarthworkOptions,
    grid: &FineGrid,
) -> Hits {
    let strips = |all: &[CrossSection], changed: &Range<usize>| -> BTreeSet<TileIndex> {
        // A section bounds the strips on both sides of it.
        let pairs = changed.start.saturating_sub(1)..(changed.end + 1).min(all.len());
        let boxes = all[pairs].windows(2).filter_map(|pair| reached([&pair[0], &pair[1]], grid));
        boxes.flat_map(|[columns, rows]| grid.tiles(columns, rows)).collect()
    };
    let (mut kept, which) = match before {
        Some((old, hits)) => {
            let mut which = strips(old, &sections.old);
            which.extend(strips(&sections.all, &sections.new));
            (hits.clone(), Some(which))
        }
        None => (Hits::new(), None),
    };
    let mut found: BTreeMap<TileIndex, Asked> = BTreeMap::new();
    for pair in sections.all.windows(2) {
        strip([&pair[0], &pair[1]], bed_m, options, grid, which.as_ref(), &mut found);
    }
    for tile in which.iter().flatten() {
        kept.remove(tile);
    }
    kept.extend(found.into_iter().map(|(tile, asked)| (tile, Arc::new(asked.ordered()))));
    kept
}

/// What is asked of a tile while strips are added.
struct Asked {
    hits: Vec<Hit>,
    /// Which of them is of each sample, counted from 1; 0 for none.
    which: [u16; TILE * TILE],
}

impl Asked {
    /// Of what several stretches of the path ask of one sample, the nearest counts.
    fn add(&mut self, hit: Hit) {
        let which = &mut self.which[usize::from(hit.sample)];
        if *which == 0 {
            self.hits.push(hit);
            *which = self.hits.len() as u16;
        } else {
            let other = &mut self.hits[usize::from(*which) - 1];
            if hit.beyond_m < other.beyond_m {
                *other = hit;
            }
        }
    }

    /// All of it in the order of samples.
    fn ordered(&self) -> Vec<Hit> {
        self.which.iter().filter(|which| **which > 0).map(|which| self.hits[usize::from(*which) - 1]).collect()
    }
}

/// How far a side reaches: to daylight, or as far as no tree shall stand.
fn furthest(side: &Side) -> f64 {
    side.daylight_m.max(side.half_width_m + CLEAR_M)
}

/// The columns and rows of the grid between which all lies that two cross-sections ask something of, if they ask anything.
fn reached([a, b]: [&CrossSection; 2], grid: &FineGrid) -> Option<[[usize; 2]; 2]> {
    if a.covered || b.covered || !(b.station_m > a.station_m) {
        return None;
    }
    let reach = |i: usize| furthest(&a.sides[i]).max(furthest(&b.sides[i])) + grid.step_m();
    grid.samples_around(&[
        a.point + a.left * reach(0),
        a.point - a.left * reach(1),
        b.point + b.left * reach(0),
        b.point - b.left * reach(1),
    ])
}

/// A share of the grid's step that is nothing.
const HAIR: f64 = 1e-6;

/// The ground between two cross-sections, on `which` tiles, if not on all.
fn strip(
    [a, b]: [&CrossSection; 2],
    bed_m: f64,
    options: &EarthworkOptions,
    grid: &FineGrid,
    which: Option<&BTreeSet<TileIndex>>,
    found: &mut BTreeMap<TileIndex, Asked>,
) {
    let Some([columns, rows]) = reached([a, b], grid) else { return };
    let is_wanted = |tile: TileIndex| which.is_none_or(|which| which.contains(&tile));
    if !grid.tiles(columns, rows).any(is_wanted) {
        return;
    }
    let along = |left: Vec2| Vec2::new(left.y, -left.x);
    let (ta, tb) = (along(a.left), along(b.left));
    // A bridge or a pipe asks nothing of the ground, but no tree shall stand under it.
    let shapes = a.on_ground && b.on_ground;
    let reaches = [0, 1].map(|i| [furthest(&a.sides[i]), furthest(&b.sides[i])]);
    // A wall stands where it stands; elsewhere the natural ground itself ends the slope.
    let spares = [0, 1].map(|i| if a.sides[i].wall || b.sides[i].wall { 0.0 } else { grid.step_m() });
    // From one sample to the next the tile is nearly always the same.
    let mut run: Option<(TileIndex, &mut Asked)> = None;
    for row in rows[0]..=rows[1] {
        // Of a row only what lies beyond the one section and before the other, and a hair on both sides for rounding.
        let y = grid.place([columns[0], row]).y;
        let mut within = [columns[0] as f64, columns[1] as f64];
        for (section, t, beyond) in [(a, ta, true), (b, tb, false)] {
            if t.x != 0.0 {
                let x = section.point.x - (y - section.point.y) * t.y / t.x;
                let column = grid.column_at(x);
                if (t.x > 0.0) == beyond {
                    within[0] = within[0].max((column - HAIR).ceil());
                } else {
                    within[1] = within[1].min((column + HAIR).floor());
                }
            }
        }
        if !(within[0] <= within[1]) {
            continue;
        }
        for column in within[0] as usize..=within[1] as usize {
            let p = grid.place([column, row]);
            let (da, db) = ((p - a.point).dot(ta), (p - b.point).dot(tb));
            if da < 0.0 || db > 0.0 || da == db {
                continue;
            }
            let u = da / (da - db);
            let lerp = |x: f64, y: f64| x + u * (y - x);
            let centre: Point = a.point.lerp(b.point, u);
            let off = p - centre;
            let left = a.left.lerp(b.left, u);
            let i = usize::from(off.dot(left) < 0.0);
            let across = off.hypot2().sqrt();
            if across > lerp(reaches[i][0], reaches[i][1]) + spares[i] {
                continue;
            }
            let (tile, sample) = grid.tile_of([column, row]);
            if run.as_ref().is_none_or(|(t, _)| *t != tile) {
                if !is_wanted(tile) {
                    continue;
                }
                run = Some((
                    tile,
                    found.entry(tile).or_insert_with(|| Asked {
                        hits: Vec::with_capacity(TILE * TILE / 2),
                        which: [0; TILE * TILE],
                    }),
                ));
            }
            let (sa, sb) = (&a.sides[i], &b.sides[i]);
            let design = Design {
                surface_m: lerp(a.height_m, b.height_m),
                bed_m,
                verge_m: options.verge_m,
                drop_m: options.verge_drop_m,
            };
            let mut side = *sa;
            side.half_width_m = lerp(sa.half_width_m, sb.half_width_m);
            (side.cut_run, side.fill_run) = (lerp(sa.cut_run, sb.cut_run), lerp(sa.fill_run, sb.fill_run));
            let [low, high] = if shapes { design.bounds(&side, across) } else { [f64::NEG_INFINITY, f64::INFINITY] };
            let beyond_m = (across - side.half_width_m) as f32;
            if let Some((_, asked)) = &mut run {
                asked.add(Hit { sample, beyond_m, low_m: low as f32, high_m: high as f32 });
            }
        }
    }
}
