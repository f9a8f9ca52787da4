//! The shaped ground: volumes by two ways, slopes by soil, and nothing changed elsewhere.

use fairpath_curve::Point;
use fairpath_drive::{
    Command, Document, EarthworkOptions, Landscape, NoFiles, SketchAs, Soil, StructureLimits, TerrainSource,
    areas_m2_at, mass_haul, volumes_m3,
};
use proptest::prelude::*;

/// A road on hills without bridges and tunnels, so that all of it is cut and fill.
fn road(seed: u64, bends: [f64; 3], soil: Soil) -> Document {
    let mut document = Document::new();
    let terrain = TerrainSource {
        synthetic: Some(Landscape::Hills),
        size: Some(801),
        cell_m: Some(0.75),
        seed: Some(seed),
        ..TerrainSource::default()
    };
    document.run(Command::Terrain(terrain), &NoFiles).unwrap();
    let structures = StructureLimits { bridge_above_m: 1e3, tunnel_below_m: 1e3, ..StructureLimits::default() };
    let earthwork = EarthworkOptions { reach_m: 60.0, ..EarthworkOptions::default() };
    let settings =
        Command::Settings { structures: Some(structures), earthwork: Some(earthwork), rules: None, seed: None };
    document.run(settings, &NoFiles).unwrap();
    document.run(Command::Soil { lasso_m: None, class: soil }, &NoFiles).unwrap();
    let [a, b, c] = bends;
    let sketch = Command::Sketch {
        points_m: vec![[100.0, 300.0], [200.0, 300.0 + a], [300.0, 300.0 + b], [400.0, 300.0 + c], [500.0, 300.0]],
        layer: "road".to_owned(),
        name: None,
        section: None,
        sketch_as: SketchAs::New,
        closed: false,
        pixel_m: 2.0,
        min_radius_m: Some(80.0),
    };
    document.run(sketch, &NoFiles).unwrap();
    document
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn end_areas_and_the_difference_of_grids_agree_within_a_hundredth(
        seed in 0_u64..1000,
        bends in prop::array::uniform3(-40.0_f64..40.0),
        soil in prop::sample::select(vec![Soil::Rock, Soil::Gravel, Soil::Sand, Soil::Clay]),
    ) {
        let document = road(seed, bends, soil);
        let results = document.results().unwrap();
        let by_areas = volumes_m3(&results.paths[0].sections);
        let by_grid = results.ground.volumes_m3();
        let all = by_areas[0] + by_areas[1];
        // A slope that a wall cuts off ends at once: between a section with one and the next without, the mean of both areas tells little.
        prop_assume!(all > 2000.0 && results.paths[0].sections.iter().all(|s| !s.sides.iter().any(|side| side.wall)));
        for i in 0..2 {
            // Of what is nearly nothing, a hundredth is less than a sample of the grid.
            prop_assert!((by_areas[i] - by_grid[i]).abs() <= 0.01 * by_areas[i].max(0.2 * all), "{:?} {:?}", by_areas, by_grid);
        }
        let table = mass_haul(&results.paths[0].sections, 20.0);
        let sums = table.iter().fold([0.0; 2], |[c, f], row| [c + row.cut_m3, f + row.fill_m3]);
        prop_assert!((sums[0] - by_areas[0]).abs() < 1e-6 * all && (sums[1] - by_areas[1]).abs() < 1e-6 * all);
        prop_assert!((table[table.len() - 1].ordinate_m3 - (sums[0] - sums[1])).abs() < 1e-6 * all);
        prop_assert!(table.windows(2).all(|rows| rows[0].to_m == rows[1].from_m && rows[0].to_m - rows[0].from_m == 20.0));
        let last = table[table.len() - 1];
        prop_assert!(last.to_m == results.paths[0].path.length_m() && last.to_m - last.from_m <= 20.0);
        // Areas, added up in steps of 5 cm, give the volume of each stretch.
        for row in &table {
            let (step, mut sums) = (0.05, [0.0; 2]);
            let count = ((row.to_m - row.from_m) / step).round();
            for i in 0..count as usize {
                let station = row.from_m + (i as f64 + 0.5) * (row.to_m - row.from_m) / count;
                let areas = areas_m2_at(&results.paths[0].sections, station);
                sums = [0, 1].map(|k| sums[k] + areas[k] * (row.to_m - row.from_m) / count);
            }
            prop_assert!((sums[0] - row.cut_m3).abs() < 0.02 + 1e-3 * row.cut_m3, "{:?} {:?}", sums, row);
            prop_assert!((sums[1] - row.fill_m3).abs() < 0.02 + 1e-3 * row.fill_m3, "{:?} {:?}", sums, row);
        }
    }

    #[test]
    fn slopes_are_no_steeper_than_the_soil_stands_and_beyond_them_nothing_changes(
        seed in 0_u64..1000,
        bends in prop::array::uniform3(-40.0_f64..40.0),
        soil in prop::sample::select(vec![Soil::Rock, Soil::Gravel, Soil::Sand, Soil::Clay]),
    ) {
        let document = road(seed, bends, soil);
        let results = document.results().unwrap();
        let (road, ground) = (&results.paths[0], &results.ground);
        let half = 0.5 * road.path.section.width_m();
        let step = ground.grid().step_m();
        for at in ground.shaped_samples() {
            let place = ground.grid().place(at);
            let near = road.path.plan.nearest(place);
            let station = road.path.plan.station(near.segment, near.s);
            let beyond = near.distance - half - 1.0;
            prop_assume!(station > 0.0);
            let z = ground.sample(at);
            let verge = road.profile.at(station).height_m - 0.1;
            if beyond > 0.1 && station > 5.0 && station < road.path.length_m() - 5.0 {
                // The profile between two cross-sections is a chord here.
                let (up, down) = ((beyond + 0.1) / soil.cut_run() + 0.1, (beyond + 0.1) / soil.fill_run() + 0.1);
                prop_assert!(z <= verge + up && z >= verge - down, "{} beside {} at {}: {}", z, verge, beyond, station);
            }
            prop_assert!(near.distance <= half + 1.0 + 60.0 + 2.0 * step);
        }
        for i in 0..40 {
            let place = Point::new(15.0 * f64::from(i), 20.0);
            prop_assert_eq!(ground.height(place), ground.natural().height(place));
        }
    }
}
