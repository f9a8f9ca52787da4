//! Documents: what commands lead to, and that undoing leads back.

use fairpath_curve::Point;
use fairpath_drive::{Carrier, Command, Document, Meeting, NoFiles, PathPlace, Section, volumes_m3};

/// A document to which commands were done, given as the JSON of a script.
fn document(commands: &[&str]) -> Document {
    let mut document = Document::new();
    for text in commands {
        let command: Command = serde_json::from_str(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        document.run(command, &NoFiles).unwrap_or_else(|e| panic!("{text}: {e}"));
    }
    document
}

const HILLS: &str = r#"{"do":"terrain","synthetic":"hills","size":513,"cell_m":2.0,"seed":7}"#;

#[test]
fn a_road_over_hills_has_its_ground_shaped_and_both_ways_of_adding_up_volumes_agree() {
    let document = document(&[
        HILLS,
        r#"{"do":"sketch","points_m":[[100,100],[300,180],[500,420],[700,480],[900,800]],"layer":"road"}"#,
    ]);
    let results = document.results().unwrap();
    let road = &results.paths[0];
    let by_areas = volumes_m3(&road.sections);
    let by_grid = results.ground.volumes_m3();
    for i in 0..2 {
        assert!(by_areas[i] > 100.0, "{by_areas:?}");
        assert!((by_areas[i] / by_grid[i] - 1.0).abs() < 0.01, "{by_areas:?} {by_grid:?}");
    }
    let length = road.path.length_m();
    let ends = road.structures.iter().flat_map(|s| [s.from_m, s.to_m]).chain([0.0, length]);
    let ends: Vec<f64> = ends.collect();
    let inner = |s: f64| ends.iter().all(|end| (s - end).abs() > 3.0);
    for section in road.sections.iter().filter(|s| s.on_ground && inner(s.station_m)) {
        let ground = results.ground.height(section.point);
        let bed = section.height_m - road.path.section.bed_m;
        assert!((ground - bed).abs() < 0.02, "at {}: {ground} for {bed}", section.station_m);
    }
}

#[test]
fn a_break_goes_under() {
    let document = document(&[
        HILLS,
        r#"{"do":"sketch","points_m":[[100,500],[300,500],[480,500]],"layer":"road"}"#,
        r#"{"do":"sketch","points_m":[[505,500],[700,500],[900,500]],"layer":"road"}"#,
        r#"{"do":"sketch","points_m":[[492,100],[492,480],[492,900]],"layer":"road"}"#,
    ]);
    let results = document.results().unwrap();
    assert_eq!(results.paths.len(), 2, "the broken one is one path");
    assert_eq!(results.crossings.len(), 1);
    let crossing = results.crossings[0];
    assert_eq!(crossing.meeting, Meeting::Under);
    assert!((crossing.point - Point::new(492.0, 500.0)).hypot2().sqrt() < 2.0, "{crossing:?}");
    let height = |i: usize, s: f64| results.paths[i].profile.at(s).height_m;
    let free = height(1, crossing.second.station_m) - height(0, crossing.first.station_m);
    assert!(free > 5.4 && free < 8.0, "{free}");
    assert!(results.paths[1].structures.iter().any(|s| s.carrier == Carrier::Bridge && s.over_path));
}

/// Sketches three straight roads that form a triangle, each of them crossing both others.
fn triangle() -> [&'static str; 3] {
    [
        r#"{"do":"sketch","name":"a","points_m":[[200,300],[400,300],[800,300]],"as":"new"}"#,
        r#"{"do":"sketch","name":"b","points_m":[[250,250],[450,450],[650,650]],"as":"new"}"#,
        r#"{"do":"sketch","name":"c","points_m":[[750,250],[550,450],[350,650]],"as":"new"}"#,
    ]
}

#[test]
fn three_roads_can_pass_over_each_other_in_a_ring() {
    let [a, b, c] = triangle();
    let document = document(&[
        HILLS,
        a,
        b,
        c,
        r#"{"do":"crossing","near_m":[300,300],"set":"over","path":"a"}"#,
        r#"{"do":"crossing","near_m":[500,500],"set":"over","path":"b"}"#,
        r#"{"do":"crossing","near_m":[700,300],"set":"over","path":"c"}"#,
    ]);
    let results = document.results().unwrap();
    assert_eq!(results.crossings.len(), 3, "{:?}", results.crossings);
    for crossing in &results.crossings {
        let [upper, lower] = crossing.upper_lower().expect("each was set");
        let height = |place: PathPlace| results.path(place.path).unwrap().profile.at(place.station_m).height_m;
        let free = height(upper) - height(lower);
        assert!(free > 5.5 - 1e-6, "{free} at {crossing:?}");
    }
    let breaches = document
        .state()
        .rules
        .clearance_breaches(&results.crossings, |id| results.path(id).map(|p| (p.path.as_ref(), p.profile.as_ref())));
    assert_eq!(breaches, []);
    assert!(results.junctions.is_empty());
}

#[test]
fn roads_that_meet_have_one_height_and_ways_in_all_directions() {
    let [a, b, c] = triangle();
    let document = document(&[HILLS, a, b, c]);
    let results = document.results().unwrap();
    assert_eq!(results.junctions.len(), 3);
    for crossing in &results.crossings {
        let [z, w] = crossing.places().map(|p| results.path(p.path).unwrap().profile.at(p.station_m).height_m);
        assert!((z - w).abs() < 1e-9, "{z} and {w}");
    }
    for junction in &results.junctions {
        assert_eq!((junction.arms.len(), junction.ways.len()), (4, 12));
        for way in &junction.ways {
            let [from, to] = [way.from, way.to].map(|i| junction.arms[i]);
            let height = |arm: fairpath_drive::Arm| results.path(arm.path).unwrap().profile.at(arm.station_m).height_m;
            let length = way.plan.length();
            assert!((way.profile.at(0.0).height_m - height(from)).abs() < 1e-9);
            assert!((way.profile.at(length).height_m - height(to)).abs() < 1e-9);
        }
    }
}

#[test]
fn what_was_said_about_a_crossing_holds_for_the_part_that_it_is_on() {
    let [a, b, _] = triangle();
    let document = document(&[
        HILLS,
        a,
        b,
        r#"{"do":"crossing","near_m":[300,300],"set":"over","path":"b"}"#,
        r#"{"do":"split","path":"b","at_m":20.0}"#,
        r#"{"do":"split","path":"a","at_m":300.0}"#,
    ]);
    let results = document.results().unwrap();
    assert_eq!(results.paths.len(), 4);
    let crossings: Vec<_> = results.crossings.iter().filter(|c| !c.at_end).collect();
    assert_eq!(crossings.len(), 1, "{:?}", results.crossings);
    let [upper, lower] = crossings[0].upper_lower().expect("one of them is above");
    let name = |place: PathPlace| results.path(place.path).unwrap().path.name.clone();
    assert!(name(upper).starts_with('b') && name(lower).starts_with('a'), "{} over {}", name(upper), name(lower));
}

#[test]
fn a_bridge_grows_with_the_path_below_it() {
    let [a, b, _] = triangle();
    let over = r#"{"do":"crossing","near_m":[300,300],"set":"over","path":"a"}"#;
    // Bridges because of high fills would hide it.
    let no_fills = r#"{"do":"settings","structures":{"bridge_above_m":1000.0,"tunnel_below_m":1000.0}}"#;
    let narrow = document(&[HILLS, no_fills, a, b, over]);
    // Of the same height and speed, so that nothing but the width tells.
    let mut section = Section::shipped("two-lane").unwrap();
    section.name = "wide".to_owned();
    section.left[0].width_m = 9.0;
    section.right[0].width_m = 9.0;
    let mut wide = document(&[HILLS, no_fills, a, b, over]);
    wide.run(Command::DefineSection { section }, &NoFiles).unwrap();
    let template = "wide".to_owned();
    wide.run(Command::Section { path: "b".to_owned(), template }, &NoFiles).unwrap();
    let bridge = |document: &Document| {
        let results = document.results().unwrap();
        let over = results.paths[0].structures.iter().find(|s| s.over_path).copied();
        over.map(|s| s.to_m - s.from_m).expect("it passes over the other")
    };
    assert!(bridge(&wide) > bridge(&narrow) + 5.0, "{} and {}", bridge(&wide), bridge(&narrow));
    assert!(wide.results_anew().as_ref() == wide.results().map(|r| r.as_ref()));
}

#[test]
fn a_choice_stays_with_its_crossing_when_the_path_is_split_before_the_next_one() {
    let document = document(&[
        HILLS,
        r#"{"do":"sketch","name":"a","points_m":[[200,300],[500,300],[800,300]],"as":"new"}"#,
        r#"{"do":"sketch","name":"b","points_m":[[400,200],[400,330],[420,350],[440,330],[440,200]],"as":"new","min_radius_m":12}"#,
        r#"{"do":"crossing","near_m":[400,300],"set":"over","path":"a"}"#,
        r#"{"do":"split","path":"a","at_m":220.0}"#,
    ]);
    let mut met: Vec<(f64, bool)> = document
        .results()
        .unwrap()
        .crossings
        .iter()
        .filter(|c| !c.at_end)
        .map(|c| (c.point.x.round(), c.meeting == Meeting::Level))
        .collect();
    met.sort_by(|p, q| p.0.total_cmp(&q.0));
    assert_eq!(met.iter().map(|m| m.1).collect::<Vec<_>>(), [false, true], "{met:?}");
}

#[test]
fn what_was_said_about_a_stretch_outlives_a_cut_through_it() {
    let [a, _, _] = triangle();
    let document = document(&[
        HILLS,
        a,
        r#"{"do":"speed","path":"a","kmh":30}"#,
        r#"{"do":"elevation","path":"a","points_m":[[200,140],[400,150]]}"#,
        r#"{"do":"split","path":"a","at_m":300.0}"#,
    ]);
    let results = document.results().unwrap();
    for path in &results.paths {
        let limits = path.path.speed_limits();
        assert_eq!(limits, [(0.0, 30.0)], "{}", path.path.name);
        let ends = [0.0, path.path.length_m()];
        assert!(ends.iter().any(|s| (path.profile.at(*s).height_m - 145.0).abs() < 0.5), "{:?}", path.path.drawn);
    }
    assert_eq!(document.state().paths[1].drawn[0].points_m, [[0.0, 145.0], [100.0, 150.0]]);
}

#[test]
fn bridges_heights_and_intersections_go_on_over_the_seam_of_a_closed_path() {
    // The circle begins at its easternmost point, where the road lies.
    let circle = r#"{"do":"roundabout","at_m":[500,500],"radius_m":100,"name":"circle"}"#;
    let across = r#"{"do":"sketch","name":"road","points_m":[[450,500],[600,500],[900,500]],"as":"new"}"#;
    let over =
        document(&[HILLS, circle, across, r#"{"do":"crossing","near_m":[600,500],"set":"over","path":"circle"}"#]);
    let circle_of = |document: &Document| {
        document.results().unwrap().path(document.state().path("circle").unwrap().id).unwrap().clone()
    };
    let bridges = circle_of(&over).structures.clone();
    let length = circle_of(&over).path.length_m();
    assert!(bridges.iter().any(|s| s.from_m == 0.0 && s.to_m > 5.0), "{bridges:?}");
    assert!(bridges.iter().any(|s| s.to_m == length && s.from_m < length - 5.0), "{bridges:?}");
    let level = document(&[HILLS, circle, across]);
    let junctions = &level.results().unwrap().junctions;
    assert_eq!(junctions.len(), 1, "{junctions:?}");
    // Two arms of the circle and two of the road.
    assert_eq!(junctions[0].arms.len(), 4, "{:?}", junctions[0].arms);
    let drawn = document(&[HILLS, circle, r#"{"do":"elevation","path":"circle","points_m":[[0,150],[40,152]]}"#]);
    let profile = circle_of(&drawn).profile.clone();
    assert!(
        (profile.at(0.0).height_m - 150.0).abs() < 0.5
            && (profile.at(length).height_m - profile.at(0.0).height_m).abs() < 1e-9
    );
    assert!((profile.at(length - 5.0).height_m - 150.0).abs() < 5.0, "{}", profile.at(length - 5.0).height_m);
}

#[test]
fn a_ring_with_one_crossing_ends_as_it_begins() {
    let ring = r#"{"do":"roundabout","at_m":[500,500],"radius_m":45,"name":"ring"}"#;
    let road = r#"{"do":"sketch","name":"road","points_m":[[500,700],[500,600],[500,480]],"as":"new"}"#;
    // The road lies so high that the ring leads up to it all the way around.
    let high = r#"{"do":"elevation","path":"road","points_m":[[0,190],[200,190]]}"#;
    for mode in ["fair", "draped", "engineered"] {
        let heights = format!(r#"{{"do":"heights","path":"ring","mode":"{mode}"}}"#);
        let document = document(&[HILLS, ring, road, high, &heights]);
        let results = document.results().unwrap();
        assert_eq!(results.crossings.len(), 1);
        let profile = &results.path(document.state().path("ring").unwrap().id).unwrap().profile;
        let [begin, end] = profile.range_m().map(|s| profile.at(s));
        assert!((begin.height_m - end.height_m).abs() < 1e-9, "{mode}: {begin:?} {end:?}");
        assert!((begin.grade - end.grade).abs() < 1e-9, "{mode}: {begin:?} {end:?}");
    }
}

#[test]
fn a_stroke_without_end_is_refused() {
    let mut document = document(&[HILLS]);
    let far: Command = serde_json::from_str(r#"{"do":"sketch","points_m":[[0,0],[1e9,0]]}"#).unwrap();
    let error = document.run(far, &NoFiles).unwrap_err().to_string();
    assert!(error.contains("1000 km"), "{error}");
}
