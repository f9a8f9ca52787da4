//! The terrain: what is sampled from it, what rays meet, what is drawn of it, and what a change touches.

use fairpath_curve::{Point, Vec2};
use fairpath_drive::{
    CHUNK, COARSEST, Cells, Heightfield, Landscape, NeighbourLevels, Ray, Samples, SyntheticTerrain, Terrain,
    TerrainError,
};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// A field of a function of the place.
fn field(size: [usize; 2], corner: Point, spacing: Vec2, height: impl Fn(Point) -> f64) -> Heightfield {
    let place = |i: usize| corner + Vec2::new((i % size[0]) as f64 * spacing.x, (i / size[0]) as f64 * spacing.y);
    let heights = (0..size[0] * size[1]).map(|i| height(place(i))).collect();
    Heightfield::new(size, corner, spacing, Samples::F64(heights)).unwrap()
}

fn rough(size: [usize; 2]) -> Heightfield {
    let height =
        |p: Point| 20.0 * libm::sin(0.11 * p.x) * libm::cos(0.07 * p.y) + 0.9 * libm::sin(1.7 * p.x + 2.3 * p.y);
    field(size, Point::new(-40.0, 25.0), Vec2::new(2.5, 1.5), height)
}

#[test]
fn samples_are_kept_and_a_plane_is_a_plane() {
    let plane = |p: Point| 3.0 + 0.25 * p.x - 0.125 * p.y;
    let field = field([9, 7], Point::new(100.0, -50.0), Vec2::new(4.0, 2.0), plane);
    for i in 0..500 {
        let p = Point::new(100.0 + 32.0 * f64::from(i % 25) / 24.0, -50.0 + 12.0 * f64::from(i / 25) / 19.0);
        assert!((field.height(p) - plane(p)).abs() < 1e-12);
        assert!((field.smooth_height(p) - plane(p)).abs() < 1e-12);
        assert!((field.slope(p) - Vec2::new(0.25, -0.125)).hypot() < 1e-12);
    }
    assert_eq!(field.height(field.place([3, 5])), field.sample([3, 5]));
    // Beyond the edge it is the edge's.
    assert_eq!(field.height(Point::new(1e9, -1e9)), field.sample([8, 0]));
    assert!(!field.contains(Point::new(132.1, -50.0)) && field.contains(field.far_corner()));
}

#[test]
fn what_is_no_terrain_is_refused() {
    let made = |size, corner, spacing, samples| Heightfield::new(size, corner, spacing, Samples::F64(samples));
    let unit = Vec2::new(1.0, 1.0);
    assert!(matches!(made([1, 4], Point::ZERO, unit, vec![0.0; 4]), Err(TerrainError::TooSmall { .. })));
    assert!(matches!(made([2, 2], Point::ZERO, unit, vec![0.0; 5]), Err(TerrainError::Count { found: 5, .. })));
    assert!(matches!(made([usize::MAX, 2], Point::ZERO, unit, vec![]), Err(TerrainError::TooLarge { .. })));
    for spacing in [Vec2::new(0.0, 1.0), Vec2::new(1.0, -1.0), Vec2::new(f64::NAN, 1.0), Vec2::new(1.0, f64::INFINITY)]
    {
        assert!(matches!(made([2, 2], Point::ZERO, spacing, vec![0.0; 4]), Err(TerrainError::Frame { .. })));
    }
    assert!(matches!(made([2, 2], Point::new(f64::NAN, 0.0), unit, vec![0.0; 4]), Err(TerrainError::Frame { .. })));
    for height in [f64::NAN, f64::INFINITY, 2e5] {
        let error = made([2, 2], Point::ZERO, unit, vec![0.0, 0.0, 0.0, height]).unwrap_err();
        assert!(matches!(error, TerrainError::Height { column: 1, row: 1, .. }), "{error}");
    }
}

#[test]
fn a_smooth_height_has_no_creases() {
    let field = rough([40, 30]);
    // Over a line of samples the slope from the left is that from the right.
    let (x, y) = (field.place([17, 0]).x, field.place([0, 11]).y + 0.4);
    let step = 1e-5;
    let at = |x: f64| field.smooth_height(Point::new(x, y));
    let (left, right) = ((at(x) - at(x - step)) / step, (at(x + step) - at(x)) / step);
    assert!((left - right).abs() < 1e-3, "{left} {right}");
    assert!((field.smooth_height(field.place([17, 11])) - field.sample([17, 11])).abs() < 1e-12);
}

#[test]
fn landscapes_are_what_they_are_called() {
    for seed in [1, 7, 99] {
        let terrain = |landscape| {
            let made = SyntheticTerrain { landscape, size: 257, cell_m: 8.0, seed };
            Terrain::new(made.build().unwrap())
        };
        let wet = |terrain: &Terrain| {
            let samples = terrain.field().samples();
            (0..samples.len()).filter(|&i| samples.get(i) < 0.0).count() as f64 / samples.len() as f64
        };
        let [low, high] = terrain(Landscape::Hills).range_m();
        assert!(low > -30.0 && high - low > 60.0, "{low} {high}");
        let islands = terrain(Landscape::Islands);
        assert!((0.2..0.95).contains(&wet(&islands)), "{}", wet(&islands));
        let valley = terrain(Landscape::Valley);
        assert!((0.005..0.2).contains(&wet(&valley)), "{}", wet(&valley));
        // The river goes through.
        let field = valley.field();
        for column in 0..257 {
            assert!((0..257).any(|row| field.sample([column, row]) < 0.0), "{seed}: column {column} is dry");
        }
        assert!(terrain(Landscape::Hills) == terrain(Landscape::Hills));
    }
    let tiny = SyntheticTerrain { size: 1, ..SyntheticTerrain::default() };
    assert!(matches!(tiny.build(), Err(TerrainError::TooSmall { .. })));
}

#[test]
fn chunks_of_any_levels_meet_without_cracks() {
    let field = rough([2 * CHUNK + 24, 2 * CHUNK + 7]);
    let [across, up] = field.chunks();
    assert_eq!([across, up], [3, 3]);
    let mut state = 1_u64;
    for _ in 0..30 {
        let levels: Vec<u8> = (0..9)
            .map(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                ((state >> 40) % u64::from(COARSEST + 1)) as u8
            })
            .collect();
        let level = |x: usize, y: usize| levels[y * 3 + x];
        // Directed edges by the places of their ends, and the area in plan.
        let mut edges: BTreeMap<[[u64; 3]; 2], i32> = BTreeMap::new();
        let mut area = 0.0;
        for y in 0..3_usize {
            for x in 0..3_usize {
                // The finer of two neighbours follows the coarser one.
                let beside = |dx: i64, dy: i64| {
                    let (nx, ny) = (x as i64 + dx, y as i64 + dy);
                    let there = (0..3).contains(&nx) && (0..3).contains(&ny);
                    if there { level(nx as usize, ny as usize) } else { 0 }
                };
                let neighbours = NeighbourLevels {
                    west: beside(-1, 0),
                    east: beside(1, 0),
                    south: beside(0, -1),
                    north: beside(0, 1),
                };
                let mesh = field.chunk_mesh([x, y], level(x, y), neighbours);
                for triangle in &mesh.triangles {
                    let p = triangle.map(|i| mesh.vertices[i as usize]);
                    let cross = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
                    assert!(cross > 0.0, "a triangle is turned over or empty");
                    area += 0.5 * cross;
                    for i in 0..3 {
                        let [a, b] = [p[i], p[(i + 1) % 3]].map(|p| p.map(f64::to_bits));
                        *edges.entry([a, b]).or_default() += 1;
                        *edges.entry([b, a]).or_default() -= 1;
                    }
                }
            }
        }
        let (low, high) = (field.corner(), field.far_corner());
        let whole = (high.x - low.x) * (high.y - low.y);
        assert!((area - whole).abs() < 1e-9 * whole, "{area} of {whole}");
        for ([a, b], count) in edges {
            if count != 0 {
                let rim = [a, b].map(|p| p.map(f64::from_bits)).iter().fold([true; 4], |on, p| {
                    [on[0] && p[0] == low.x, on[1] && p[0] == high.x, on[2] && p[1] == low.y, on[3] && p[1] == high.y]
                });
                assert!(rim.contains(&true), "an edge within the terrain has a triangle on one side only: {levels:?}");
            }
        }
    }
}

#[test]
fn a_chunk_is_as_far_off_as_it_says() {
    let field = rough([CHUNK + 30, CHUNK + 1]);
    for chunk in [[0, 0], [1, 0]] {
        let errors = field.chunk_errors_m(chunk);
        assert_eq!(errors[0], 0.0);
        assert!(errors.windows(2).all(|pair| pair[0] <= pair[1]), "{errors:?}");
        assert!(errors[COARSEST as usize] > 5.0, "{errors:?}");
    }
    let coarse = field.chunk_mesh([0, 0], COARSEST, NeighbourLevels::all(0));
    assert_eq!((coarse.vertices.len(), coarse.triangles.len()), (4, 2));
}

proptest! {
    #[test]
    fn a_ray_meets_what_a_dense_walk_meets(
        from in (-60.0..80.0_f64, 10.0..90.0_f64, 25.0..60.0_f64),
        to in (-40.0..60.0_f64, 25.0..70.0_f64),
        below in any::<bool>(),
    ) {
        let terrain = Terrain::new(rough([41, 37]));
        let field = terrain.field();
        let target = Point::new(to.0, to.1);
        let z = if below { -60.0 } else { from.2 };
        let direction = [target.x - from.0, target.y - from.1, field.height(target) - z];
        let ray = Ray { origin: [from.0, from.1, z], direction };
        let hit = terrain.hit(&ray);
        // The ray is aimed at the terrain, if its target lies on it.
        prop_assert!(hit.is_some() || !field.contains(target));
        // Above, or below, up to the hit, and through there.
        let over = |t: f64| {
            let [x, y, z] = ray.at(t);
            (z - field.height(Point::new(x, y)), field.contains(Point::new(x, y)))
        };
        let side = if below { -1.0 } else { 1.0 };
        let length = direction.iter().map(|d| d * d).sum::<f64>();
        let end = hit.map_or(1.0, |hit| (0..3).map(|i| (hit[i] - ray.origin[i]) * direction[i]).sum::<f64>() / length);
        for i in 0..2000 {
            let (height, inside) = over(end * f64::from(i) / 2000.0);
            prop_assert!(!inside || height * side > -1e-6, "{height} m at step {i} of 2000");
        }
        if let Some(hit) = hit {
            prop_assert!(over(end).0.abs() < 1e-6, "{} m from the ray", over(end).0);
            prop_assert!((hit[2] - field.height(Point::new(hit[0], hit[1]))).abs() < 1e-12);
        }
    }

    #[test]
    fn a_change_leaves_what_a_new_terrain_would_be(
        first in (0..60_usize, 0..50_usize), size in (0..30_usize, 0..30_usize), by in -50.0..50.0_f64,
    ) {
        let field = rough([61, 53]);
        let mut terrain = Terrain::new(field.clone());
        let cells = Cells { columns: [first.0, first.0 + size.0], rows: [first.1, first.1 + size.1] };
        let mut touched = 0;
        terrain.change(cells, |_, height| { touched += 1; height + by });
        let heights = (0..61 * 53).map(|i| {
            let inside = (cells.columns[0]..=cells.columns[1]).contains(&(i % 61)) && (cells.rows[0]..=cells.rows[1]).contains(&(i / 61));
            field.samples().get(i) + if inside { by } else { 0.0 }
        });
        let fresh = Heightfield::new([61, 53], field.corner(), field.spacing_m(), Samples::F64(heights.collect())).unwrap();
        prop_assert!(terrain == Terrain::new(fresh));
        prop_assert!(touched <= (size.0 + 1) * (size.1 + 1));
    }

    #[test]
    fn no_ray_is_too_odd(origin in prop::array::uniform3(odd()), direction in prop::array::uniform3(odd())) {
        let terrain = Terrain::new(rough([20, 20]));
        let hit = terrain.hit(&Ray { origin, direction });
        prop_assert!(hit.is_none_or(|hit| hit.iter().all(|x| x.is_finite())));
    }
}

/// Numbers, and what is none.
fn odd() -> impl Strategy<Value = f64> {
    prop_oneof![
        -100.0..100.0_f64,
        Just(0.0),
        Just(-0.0),
        Just(1e-300),
        Just(1e300),
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(f64::NEG_INFINITY),
    ]
}
