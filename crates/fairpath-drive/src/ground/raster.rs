//! A corridor on the fine grid of the ground: cross-sections come in, for each sample that they reach how low and how high the ground may be there goes out.

use super::corridor::{CrossSection, Design, EarthworkOptions, Side};
use super::tiles::{FineGrid, TILE, TileIndex};
use crate::furniture::CLEAR_M;
use fairpath_curve::{Point, Vec2};
use std::collections::BTreeMap;

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

/// The samples that a path asks something of, by tile, each once and in order.
pub(crate) type Hits = BTreeMap<TileIndex, Vec<Hit>>;

/// What the cross-sections of a path ask of the ground. Takes time in proportion to the corridor's area.
pub(crate) fn hits(sections: &[CrossSection], bed_m: f64, options: &EarthworkOptions, grid: &FineGrid) -> Hits {
    let mut found = Hits::new();
    for pair in sections.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        if !a.covered && !b.covered && b.station_m > a.station_m {
            strip(a, b, bed_m, options, grid, &mut found);
        }
    }
    for hits in found.values_mut() {
        // Of what several stretches of the path ask of one sample, the nearest counts.
        hits.sort_by(|p, q| p.sample.cmp(&q.sample).then(p.beyond_m.total_cmp(&q.beyond_m)));
        hits.dedup_by_key(|hit| hit.sample);
    }
    found
}

/// The ground between two cross-sections.
fn strip(
    a: &CrossSection,
    b: &CrossSection,
    bed_m: f64,
    options: &EarthworkOptions,
    grid: &FineGrid,
    found: &mut Hits,
) {
    let along = |left: Vec2| Vec2::new(left.y, -left.x);
    let (ta, tb) = (along(a.left), along(b.left));
    // A bridge or a pipe asks nothing of the ground, but no tree shall stand under it.
    let shapes = a.on_ground && b.on_ground;
    let furthest = |side: &Side| side.daylight_m.max(side.half_width_m + CLEAR_M);
    let reach = |i: usize| furthest(&a.sides[i]).max(furthest(&b.sides[i])) + grid.step_m();
    let corners = [
        a.point + a.left * reach(0),
        a.point - a.left * reach(1),
        b.point + b.left * reach(0),
        b.point - b.left * reach(1),
    ];
    let Some([columns, rows]) = grid.samples_around(&corners) else { return };
    for row in rows[0]..=rows[1] {
        for column in columns[0]..=columns[1] {
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
            let (sa, sb) = (&a.sides[i], &b.sides[i]);
            // A wall stands where it stands; elsewhere the natural ground itself ends the slope.
            let spare = if sa.wall || sb.wall { 0.0 } else { grid.step_m() };
            if across > lerp(furthest(sa), furthest(sb)) + spare {
                continue;
            }
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
            let (tile, sample) = grid.tile_of([column, row]);
            found.entry(tile).or_insert_with(|| Vec::with_capacity(TILE)).push(Hit {
                sample,
                beyond_m: (across - side.half_width_m) as f32,
                low_m: low as f32,
                high_m: high as f32,
            });
        }
    }
}
