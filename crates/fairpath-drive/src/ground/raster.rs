//! A corridor on the fine grid of the ground: cross-sections come in, for each sample that they reach how low and how high the ground may be there goes out.

use super::corridor::{CrossSection, Design, EarthworkOptions, Sections, Side};
use super::tiles::{FineGrid, TILE, TileIndex};
use crate::furniture::CLEAR_M;
use fairpath_curve::{Point, Vec2};
use fairpath_fit::parallel;
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
    for tile in which.iter().flatten() {
        kept.remove(tile);
    }
    // The strips that reach each tile, ascending.
    let mut reaching: BTreeMap<TileIndex, Vec<Strip>> = BTreeMap::new();
    for pair in sections.all.windows(2) {
        let between = [&pair[0], &pair[1]];
        let Some(reach) = reached(between, grid) else { continue };
        for tile in grid.tiles(reach[0], reach[1]) {
            if which.as_ref().is_none_or(|which| which.contains(&tile)) {
                reaching.entry(tile).or_default().push(Strip { between, reach });
            }
        }
    }
    let reaching: Vec<(TileIndex, Vec<Strip>)> = reaching.into_iter().collect();
    let asked = parallel::map(&reaching, |(tile, strips)| {
        let mut asked = Asked::nothing();
        strips.iter().for_each(|strip| strip.ask(bed_m, options, grid, *tile, &mut asked));
        asked.ordered()
    });
    let asked = reaching.into_iter().zip(asked).filter(|(_, asked)| !asked.is_empty());
    kept.extend(asked.map(|((tile, _), asked)| (tile, Arc::new(asked))));
    kept
}

/// What is asked of each sample of a tile while strips are added; where nothing is, the path is endlessly far away.
struct Asked([Hit; TILE * TILE]);

impl Asked {
    fn nothing() -> Self {
        let nothing = Hit { sample: 0, beyond_m: f32::INFINITY, low_m: f32::NEG_INFINITY, high_m: f32::INFINITY };
        Self([nothing; TILE * TILE])
    }

    /// Of what several stretches of the path ask of one sample, the nearest counts.
    fn add(&mut self, hit: Hit) {
        let before = &mut self.0[usize::from(hit.sample)];
        if hit.beyond_m < before.beyond_m {
            *before = hit;
        }
    }

    /// All of it in the order of samples.
    fn ordered(&self) -> Vec<Hit> {
        let asked = || self.0.iter().filter(|hit| hit.beyond_m < f32::INFINITY);
        let mut all = Vec::with_capacity(asked().count());
        all.extend(asked());
        all
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

/// The ground between two cross-sections.
struct Strip<'a> {
    between: [&'a CrossSection; 2],
    /// As [`reached`] gives them.
    reach: [[usize; 2]; 2],
}

impl Strip<'_> {
    /// What it asks of a tile.
    fn ask(&self, bed_m: f64, options: &EarthworkOptions, grid: &FineGrid, tile: TileIndex, asked: &mut Asked) {
        let [a, b] = self.between;
        let within = |[from, to]: [usize; 2], tile: u32| {
            let first = tile as usize * TILE;
            [from.max(first), to.min(first + TILE - 1)]
        };
        let [columns, rows] = [within(self.reach[0], tile[0]), within(self.reach[1], tile[1])];
        let along = |left: Vec2| Vec2::new(left.y, -left.x);
        let (ta, tb) = (along(a.left), along(b.left));
        // Of each row, whether what lies beyond a section towards east is wanted, and how its line slants.
        let sides = [(a, ta, true), (b, tb, false)]
            .map(|(section, t, beyond)| (t.x != 0.0).then(|| (section.point, t.y / t.x, (t.x > 0.0) == beyond)));
        // A bridge or a pipe asks nothing of the ground, but no tree shall stand under it.
        let shapes = a.on_ground && b.on_ground;
        let reaches = [0, 1].map(|i| [furthest(&a.sides[i]), furthest(&b.sides[i])]);
        // A wall stands where it stands; elsewhere the natural ground itself ends the slope.
        let spares = [0, 1].map(|i| if a.sides[i].wall || b.sides[i].wall { 0.0 } else { grid.step_m() });
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
                let reach = lerp(reaches[i][0], reaches[i][1]) + spares[i];
                if off.hypot2() > reach * reach {
                    continue;
                }
                let across = off.hypot2().sqrt();
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
                let [low, high] =
                    if shapes { design.bounds(&side, across) } else { [f64::NEG_INFINITY, f64::INFINITY] };
                let beyond_m = (across - side.half_width_m) as f32;
                let (_, sample) = grid.tile_of([column, row]);
                asked.add(Hit { sample, beyond_m, low_m: low as f32, high_m: high as f32 });
            }
        }
    }
}
