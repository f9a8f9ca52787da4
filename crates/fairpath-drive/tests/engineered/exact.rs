//! Cases whose solution is known by hand.

use crate::common::{assert_limits, fixed, network, point, road};
use fairpath_drive::{ClearanceAt, EarthworkSection, EngineeredError, GradeLimits, HeightBound, WeightedStretch};

#[test]
fn on_level_ground_the_road_is_level() {
    for closed in [false, true] {
        let mut level = road(730.0, |_| 412.5);
        level.closed = closed;
        let heights = network(vec![level]).solve().unwrap();
        assert!(heights.strict);
        assert!(heights.profiles[0].knots().iter().all(|k| (k.height_m - 412.5).abs() < 1e-9 && k.grade.abs() < 1e-10));
        assert!(heights.earthwork[0].counted < 1e-5, "{:?}", heights.earthwork);
    }
}

#[test]
fn ground_as_even_as_a_road_is_followed() {
    let incline = road(1000.0, |s| 100.0 - 0.07 * s);
    let heights = network(vec![incline]).solve().unwrap();
    for knot in heights.profiles[0].knots() {
        assert!((knot.height_m - (100.0 - 0.07 * knot.station_m)).abs() < 1e-8, "{knot:?}");
    }
    // At the very limit there is no room, and it is followed within the tolerance.
    let steepest = road(1000.0, |s| 0.08 * s);
    let heights = network(vec![steepest.clone()]).solve().unwrap();
    assert!(heights.strict && (heights.profiles[0].at(1000.0).height_m - 80.0).abs() < 1e-3);
    let mut held = steepest;
    held.fixed = vec![fixed(0.0, 0.0), fixed(1000.0, 80.0)];
    let held = network(vec![held]);
    let heights = held.solve().unwrap();
    assert!(!heights.strict);
    assert_limits(&held, &heights);
}

/// A road on level ground that must reach a height in the middle and may not cut: over the middle it is bent as a crest, then as much as a sag. With b = 1 / (100 K) and the
/// height H each curve is s = √(H / b) long, the fill on each side is H s, and the grade between the curves is b s.
#[test]
fn a_bump_has_the_fill_that_is_known_by_hand() {
    let (k, h) = (20.0_f64, 5.0_f64);
    let s = (h * 100.0 * k).sqrt();
    assert_eq!(s, 100.0);
    let mut bump = road(600.0, |_| 0.0);
    bump.limits = GradeLimits { max_grade: 0.08, crest_k_m: k, sag_k_m: k };
    bump.section = EarthworkSection { platform_m: 10.0, slope_run: 0.0, cut_weight: 1.0, fill_weight: 1.0 };
    bump.fixed = vec![fixed(300.0, h)];
    bump.bounds = vec![HeightBound { from_m: 0.0, to_m: 600.0, lowest_m: Some(0.0), highest_m: None }];
    let bump = network(vec![bump]);
    let heights = bump.solve().unwrap();
    assert_limits(&bump, &heights);
    let found = heights.earthwork[0];
    assert!((found.fill_m3 - 10.0 * 2.0 * h * s).abs() < 0.5, "{found:?}");
    assert!(found.cut_m3 < 0.1, "{found:?}");
    let quarter = heights.profiles[0].at(300.0 + s);
    assert!((quarter.height_m - 0.5 * h).abs() < 1e-3 && (quarter.grade + s / (100.0 * k)).abs() < 1e-4, "{quarter:?}");
}

/// A crossing lifts the upper road and lowers the lower one until a metre more costs the same on both: here both move half the clearance.
#[test]
fn two_like_roads_share_a_clearance() {
    let mut crossing = network(vec![road(800.0, |_| 0.0), road(800.0, |_| 0.0)]);
    crossing.roads.iter_mut().for_each(|r| r.limits.crest_k_m = r.limits.sag_k_m);
    crossing.over = vec![ClearanceAt { upper: point(1, 400.0), lower: point(0, 400.0), clearance_m: 5.0 }];
    let heights = crossing.solve().unwrap();
    assert_limits(&crossing, &heights);
    assert!(heights.strict);
    let [lower, upper] = [0, 1].map(|road: usize| heights.profiles[road].at(400.0).height_m);
    assert!((lower + 2.5).abs() < 1e-3 && (upper - 2.5).abs() < 1e-3, "{lower} {upper}");
    // If cut is dear, the upper road bears more.
    crossing.roads.iter_mut().for_each(|r| r.section.cut_weight = 3.0);
    let heights = crossing.solve().unwrap();
    assert!(heights.profiles[1].at(400.0).height_m > 3.0);
}

#[test]
fn a_bridge_goes_straight_over_a_gorge() {
    let gorge = |s: f64| if (s - 500.0).abs() < 60.0 { -40.0 } else { 0.0 };
    let mut bridge = road(1000.0, gorge);
    bridge.limits.max_grade = 0.5;
    bridge.stretches = vec![WeightedStretch { from_m: 430.0, to_m: 570.0, weight: 0.0 }];
    let bridge = network(vec![bridge]);
    let heights = bridge.solve().unwrap();
    assert_limits(&bridge, &heights);
    let middle = heights.profiles[0].at(500.0).height_m;
    assert!(middle.abs() < 0.01 && heights.earthwork[0].counted < 1.0, "{middle} {:?}", heights.earthwork);
    let mut dam = bridge.clone();
    dam.roads[0].stretches.clear();
    assert!(dam.solve().unwrap().earthwork[0].counted > 10_000.0);
}

/// Where no earth counts at all, the road is the straightest, as near to the ground as that allows.
#[test]
fn a_road_all_of_bridge_is_straight() {
    let mut bridge = road(1000.0, |s| 30.0 + 0.01 * s + 5.0 * libm::sin(s * std::f64::consts::PI / 100.0));
    bridge.stretches = vec![WeightedStretch { from_m: 0.0, to_m: 1000.0, weight: 0.0 }];
    let heights = network(vec![bridge]).solve().unwrap();
    assert_eq!(heights.earthwork[0].counted, 0.0);
    let [first, middle, last] = [0.0, 500.0, 1000.0].map(|s| heights.profiles[0].at(s).height_m);
    assert!((first + last - 2.0 * middle).abs() < 0.1 && (middle - 35.0).abs() < 1.0, "{first} {middle} {last}");
}

#[test]
fn what_cannot_be_meant_is_listed_completely() {
    let mut bad = network(vec![road(100.0, |_| 0.0), road(100.0, |_| 0.0)]);
    bad.roads[0].limits.crest_k_m = 0.0;
    bad.roads[0].limits.max_grade = f64::NAN;
    bad.roads[0].ground[3][0] = 1.0;
    bad.roads[1].ground.truncate(10);
    bad.roads[1].fixed = vec![fixed(100.5, f64::INFINITY)];
    bad.roads[1].bounds = vec![HeightBound { from_m: 50.0, to_m: 40.0, lowest_m: Some(f64::NAN), highest_m: None }];
    bad.roads[1].stretches = vec![WeightedStretch { from_m: 0.0, to_m: 40.0, weight: -1.0 }];
    bad.over = vec![
        ClearanceAt { upper: point(2, 0.0), lower: point(0, -1.0), clearance_m: 0.0 },
        ClearanceAt { upper: point(0, 5.0), lower: point(0, 5.0), clearance_m: 5.0 },
    ];
    let Err(EngineeredError::Invalid { problems }) = bad.solve() else { panic!("it was accepted") };
    let fields: Vec<&str> = problems.iter().map(|problem| problem.field.as_str()).collect();
    assert_eq!(
        fields,
        [
            "roads[0].limits.max_grade",
            "roads[0].limits.crest_k_m",
            "roads[0].ground[3][0]",
            "roads[1].ground[9][0]",
            "roads[1].fixed[0].station_m",
            "roads[1].fixed[0].height_m",
            "roads[1].bounds[0].to_m",
            "roads[1].bounds[0].lowest_m",
            "roads[1].stretches[0].weight",
            "over[0].upper.road",
            "over[0].lower.station_m",
            "over[0].clearance_m",
            "over[1].lower.station_m",
        ]
    );
    let text = problems[1].to_string();
    assert_eq!(text, "roads[0].limits.crest_k_m is 0; it must be positive, from a millionth to a thousand million");
    let mut fine = network(vec![road(1e6, |_| 0.0)]);
    fine.roads[0].knot_spacing_m = 1e-6;
    assert!(matches!(fine.solve(), Err(EngineeredError::Invalid { .. })));
    assert!(network(Vec::new()).solve().unwrap().profiles.is_empty());
}
