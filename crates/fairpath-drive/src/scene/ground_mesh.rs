//! The ground as triangles: coarse far from paths, as fine as it was shaped where it was.

use super::shape::{P3, quad};
use super::tunnels::Mouth;
use super::{Finish, Scene, SceneOptions};
use crate::document::{Results, State};
use crate::ground::Ground;
use crate::terrain::{CHUNK, COARSEST, Heightfield, NeighbourLevels, Waters};
use fairpath_curve::{Point, Rect};
use fairpath_shape::Mesh;
use std::collections::{BTreeMap, BTreeSet};

/// The ground; `mouths` are the places where a road leads into it, and it is left open.
pub(super) fn add(scene: &mut Scene, state: &State, results: &Results, options: &SceneOptions, mouths: &[Mouth]) {
    let ground = &results.ground;
    let natural = ground.natural();
    let shaped = shaped_cells(ground);
    let chunks = natural.chunks();
    let boxes: Vec<Rect> = results.paths.iter().map(|p| p.path.plan.bounding_box()).collect();
    let distance = |chunk: [usize; 2]| {
        let cells = natural.chunk_cells(chunk);
        let low = natural.place([cells.columns[0], cells.rows[0]]);
        let high = natural.place([cells.columns[1], cells.rows[1]]);
        boxes.iter().map(|b| apart(*b, low, high)).fold(f64::INFINITY, f64::min)
    };
    let touched: BTreeSet<[usize; 2]> = shaped.keys().map(|c| [c[0] / CHUNK, c[1] / CHUNK]).collect();
    let beside = |[i, j]: [usize; 2]| {
        (i.saturating_sub(1)..=i + 1).any(|i| (j.saturating_sub(1)..=j + 1).any(|j| touched.contains(&[i, j])))
    };
    let mut levels: Vec<Option<u8>> = Vec::with_capacity(chunks[0] * chunks[1]);
    for j in 0..chunks[1] {
        for i in 0..chunks[0] {
            let far = distance([i, j]);
            levels.push(if !options.natural {
                None
            } else if beside([i, j]) {
                Some(0)
            } else if far > options.margin_m {
                None
            } else {
                let allowed = options.coarseness * far.min(1e5);
                let errors = natural.chunk_errors_m([i, j]);
                (0..=COARSEST).rev().find(|&l| errors[usize::from(l)] <= allowed).or(Some(0))
            });
        }
    }
    let level = |i: usize, j: usize| levels[j * chunks[0] + i];
    let mut mesh = Mesh::default();
    for j in 0..chunks[1] {
        for i in 0..chunks[0] {
            let Some(own) = level(i, j).filter(|_| options.natural) else { continue };
            let of = |i: Option<usize>, j: Option<usize>| match (i, j) {
                (Some(i), Some(j)) if i < chunks[0] && j < chunks[1] => level(i, j).unwrap_or(own),
                _ => own,
            };
            let neighbours = NeighbourLevels {
                west: of(i.checked_sub(1), Some(j)),
                east: of(Some(i + 1), Some(j)),
                south: of(Some(i), j.checked_sub(1)),
                north: of(Some(i), Some(j + 1)),
            };
            let chunk = natural.chunk_mesh([i, j], own, neighbours);
            let here = touched.contains(&[i, j]);
            append(&mut mesh, &chunk, |t| !here || !is_shaped(natural, &shaped, &chunk, t));
        }
    }
    if options.natural {
        scene.part("terrain", Finish::Ground, mesh);
    }
    let (mut wild, mut worked) = (Mesh::default(), Mesh::default());
    for (cell, samples) in &shaped {
        let box_of = |[i, j]: [usize; 2]| ground.grid().place([i * ground.grid().parts(), j * ground.grid().parts()]);
        let [low, high] = [box_of(*cell), box_of([cell[0] + 1, cell[1] + 1])];
        let near: Vec<&Mouth> = mouths.iter().filter(|m| m.may_lie_in(low, high)).collect();
        refined(ground, *cell, samples, &near, &mut wild, &mut worked);
    }
    scene.part("terrain beside paths", Finish::Ground, wild);
    scene.part("earthwork", Finish::Earthwork, worked);
    if let Some(waters) = state.terrain.as_ref().map(|t| &t.waters) {
        scene.part("water", Finish::Water, water(natural, waters));
    }
}

/// The surface of all water: the sea as one sheet, bodies of water in the cells of the terrain that they reach.
fn water(natural: &Heightfield, waters: &Waters) -> Mesh {
    let mut mesh = Mesh::default();
    let mut sheet = |[low, high]: [Point; 2], z: f64| {
        quad(&mut mesh, [[low.x, low.y, z], [high.x, low.y, z], [high.x, high.y, z], [low.x, high.y, z]]);
    };
    if let Some(level) = waters.level_m {
        sheet([natural.corner(), natural.far_corner()], level);
    }
    let last = natural.size().map(|n| n - 2);
    for body in &waters.bodies {
        let bounds = |values: &dyn Fn(&Point) -> f64, from: f64, step: f64, last: usize| {
            let cell = |x: f64| (((x - from) / step).floor().max(0.0) as usize).min(last);
            let low = body.outline.iter().map(values).fold(f64::INFINITY, f64::min);
            let high = body.outline.iter().map(values).fold(f64::NEG_INFINITY, f64::max);
            cell(low)..=cell(high)
        };
        let (corner, spacing) = (natural.corner(), natural.spacing_m());
        for row in bounds(&|p| p.y, corner.y, spacing.y, last[1]) {
            for column in bounds(&|p| p.x, corner.x, spacing.x, last[0]) {
                let cell = [natural.place([column, row]), natural.place([column + 1, row + 1])];
                let middle = cell[0].midpoint(cell[1]);
                let corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| natural.sample([column + i, row + j]));
                if waters.level_at(middle) == Some(body.level_m) && corners.iter().any(|z| *z < body.level_m) {
                    sheet(cell, body.level_m);
                }
            }
        }
    }
    mesh
}

/// How far a box lies from another one.
fn apart(a: Rect, low: Point, high: Point) -> f64 {
    let x = (a.x0 - high.x).max(low.x - a.x1).max(0.0);
    let y = (a.y0 - high.y).max(low.y - a.y1).max(0.0);
    (x * x + y * y).sqrt()
}

/// The cells of the terrain in which samples were shaped, with these, counted in the cell from its south-west.
fn shaped_cells(ground: &Ground) -> BTreeMap<[usize; 2], Vec<[usize; 2]>> {
    let parts = ground.grid().parts();
    let last = ground.natural().size().map(|n| n - 2);
    let mut cells: BTreeMap<[usize; 2], Vec<[usize; 2]>> = BTreeMap::new();
    for at in ground.shaped_samples() {
        // A sample on a border belongs to the cells on both sides.
        let range = |k: usize, last: usize| {
            let cell = k / parts;
            let first = if k.is_multiple_of(parts) { cell.saturating_sub(1) } else { cell };
            first..=cell.min(last)
        };
        for column in range(at[0], last[0]) {
            for row in range(at[1], last[1]) {
                let own = [at[0] - column * parts, at[1] - row * parts];
                cells.entry([column, row]).or_default().push(own);
            }
        }
    }
    cells
}

fn append(mesh: &mut Mesh, other: &Mesh, keep: impl Fn([u32; 3]) -> bool) {
    let mut number = vec![u32::MAX; other.vertices.len()];
    for &triangle in other.triangles.iter().filter(|t| keep(**t)) {
        let moved = triangle.map(|v| {
            let n = &mut number[v as usize];
            if *n == u32::MAX {
                *n = mesh.vertices.len() as u32;
                mesh.vertices.push(other.vertices[v as usize]);
                mesh.normals.push(other.normals[v as usize]);
            }
            *n
        });
        mesh.triangles.push(moved);
    }
}

/// Whether a triangle of a chunk in full detail lies in a cell that is drawn more finely.
fn is_shaped(
    natural: &Heightfield,
    shaped: &BTreeMap<[usize; 2], Vec<[usize; 2]>>,
    chunk: &Mesh,
    triangle: [u32; 3],
) -> bool {
    let [a, b, c] = triangle.map(|v| chunk.vertices[v as usize]);
    let (corner, spacing) = (natural.corner(), natural.spacing_m());
    let column = ((a[0] + b[0] + c[0]) / 3.0 - corner.x) / spacing.x;
    let row = ((a[1] + b[1] + c[1]) / 3.0 - corner.y) / spacing.y;
    shaped.contains_key(&[column as usize, row as usize])
}

/// One cell of the terrain, divided where it was shaped. Where it was not, the ground is bilinear, so that its borders are straight and meet finer ones without a gap.
fn refined(
    ground: &Ground,
    cell: [usize; 2],
    samples: &[[usize; 2]],
    mouths: &[&Mouth],
    wild: &mut Mesh,
    worked: &mut Mesh,
) {
    let parts = ground.grid().parts();
    let side = parts + 2;
    // How many shaped samples lie to the south-west of each.
    let mut sums = vec![0_u32; side * side];
    for [i, j] in samples {
        sums[(j + 1) * side + i + 1] += 1;
    }
    for j in 1..side {
        for i in 1..side {
            sums[j * side + i] += sums[j * side + i - 1] + sums[(j - 1) * side + i] - sums[(j - 1) * side + i - 1];
        }
    }
    let count = |[i0, j0]: [usize; 2], [i1, j1]: [usize; 2]| {
        let at = |i: usize, j: usize| sums[j * side + i];
        at(i1 + 1, j1 + 1) + at(i0, j0) - at(i0, j1 + 1) - at(i1 + 1, j0)
    };
    let origin = [cell[0] * parts, cell[1] * parts];
    // Which vertex each sample has become, of what was shaped and of what was not.
    let mut numbers = [vec![u32::MAX; side * side], vec![u32::MAX; side * side]];
    let mut blocks = vec![([0, 0], parts)];
    while let Some(([i, j], size)) = blocks.pop() {
        let shaped = count([i, j], [i + size, j + size]) > 0;
        if shaped && size > 1 {
            let half = size / 2;
            for (di, dj) in [(0, 0), (half, 0), (0, half), (half, half)] {
                blocks.push(([i + di, j + dj], half));
            }
            continue;
        }
        if size == 1 && shaped && !mouths.is_empty() {
            let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[di, dj]| [origin[0] + i + di, origin[1] + j + dj]);
            let middle = ground.grid().place(corners[0]).midpoint(ground.grid().place(corners[2]));
            let heights = corners.map(|at| ground.sample(at));
            if mouths.iter().any(|mouth| mouth.opens(middle, &heights)) {
                continue;
            }
        }
        let (mesh, numbers) = if shaped { (&mut *worked, &mut numbers[0]) } else { (&mut *wild, &mut numbers[1]) };
        let mut corner = |di: usize, dj: usize| {
            let (i, j) = (i + di, j + dj);
            let number = &mut numbers[j * side + i];
            if *number == u32::MAX {
                *number = mesh.vertices.len() as u32;
                let (place, normal) = vertex(ground, [origin[0] + i, origin[1] + j]);
                mesh.vertices.push(place);
                mesh.normals.push(normal);
            }
            *number
        };
        let [a, b, c, d] = [corner(0, 0), corner(size, 0), corner(size, size), corner(0, size)];
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
}

/// A sample of the fine grid as a vertex with its normal, by the slopes to all sides.
fn vertex(ground: &Ground, at: [usize; 2]) -> (P3, P3) {
    let grid = ground.grid();
    let (size, step) = (grid.size(), grid.spacing_m());
    let place = grid.place(at);
    let around = |k: usize, count: usize| (k.saturating_sub(1), (k + 1).min(count - 1));
    let ((w, e), (s, n)) = (around(at[0], size[0]), around(at[1], size[1]));
    let x = (ground.sample([w, at[1]]) - ground.sample([e, at[1]])) / ((e - w) as f64 * step.x);
    let y = (ground.sample([at[0], s]) - ground.sample([at[0], n])) / ((n - s) as f64 * step.y);
    let length = (x * x + y * y + 1.0).sqrt();
    ([place.x, place.y, ground.sample(at)], [x / length, y / length, 1.0 / length])
}
