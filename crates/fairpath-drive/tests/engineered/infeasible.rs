//! What would have to give, and because of what.

use crate::common::{fixed, named, network, point, road};
use fairpath_drive::{
    ClearanceAt, Demand, EngineeredError, EngineeredNetwork, FixedPoint, HeightBound, MeetAt, Shortfall, ShortfallKind,
};

fn shortfalls(network: &EngineeredNetwork) -> Vec<Shortfall> {
    let error = network.solve().unwrap_err();
    println!("{error}");
    let EngineeredError::Infeasible { shortfalls } = error else { panic!("{error}") };
    shortfalls
}

/// A pass that is fixed to the ground 60 m before and after a valley road, which is held.
#[test]
fn the_crossing_that_cannot_be_had_is_named() {
    let mut pass = named("pass", road(2000.0, |_| 0.0));
    let held = |station_m: f64| FixedPoint { station_m, height_m: 0.0, grade: Some(0.0) };
    pass.fixed = vec![held(1200.0), held(1360.0)];
    pass.limits.crest_k_m = 1.0;
    pass.limits.sag_k_m = 1.0;
    pass.limits.max_grade = 0.04;
    let mut valley = named("valley", road(600.0, |_| 0.0));
    valley.fixed = vec![held(310.0)];
    let mut network = network(vec![named("river", road(500.0, |_| 0.0)), pass, valley]);
    // This one has all the room that it needs.
    network.over.push(ClearanceAt { upper: point(1, 500.0), lower: point(0, 250.0), clearance_m: 5.2 });
    network.over.push(ClearanceAt { upper: point(1, 1280.0), lower: point(2, 310.0), clearance_m: 5.2 });
    let found = shortfalls(&network);
    assert_eq!(found.len(), 2);
    for (shortfall, range) in found.iter().zip([[1200.0, 1280.0], [1280.0, 1360.0]]) {
        assert_eq!(shortfall.kind, ShortfallKind::Grade);
        assert_eq!((shortfall.road, shortfall.road_name.as_str(), shortfall.limit), (1, "pass", 0.04));
        // 5.2 m in 80 m, of which something is lost in the curves.
        assert!((0.065..0.1).contains(&shortfall.needed), "{}", shortfall.needed);
        assert!(shortfall.from_m >= range[0] && shortfall.to_m <= range[1], "{shortfall:?}");
        assert!(shortfall.because.iter().any(|demand| matches!(demand, Demand::Over { over: 1, .. })));
        assert!(!shortfall.because.iter().any(|demand| matches!(demand, Demand::Over { over: 0, .. })));
        assert!(
            shortfall.because.iter().any(|d| matches!(d, Demand::Height { at, .. } if at.road == 1)),
            "{shortfall:?}"
        );
        let text = shortfall.to_string();
        assert!(text.starts_with("road \"pass\", stations 12"), "{text}");
        assert!(text.contains("pass 5.2 m over road \"valley\" at station 310 (here 1280)"), "{text}");
        assert!(text.ends_with("; 0.04 is allowed"), "{text}");
    }
    // With less to pass over there are heights.
    network.over[1].clearance_m = 2.0;
    assert!(network.solve().unwrap().strict);
}

#[test]
fn a_limit_that_is_far_from_reached_is_not_named() {
    // So sharp a sag is none that a road could have.
    for sag_k_m in [1.0, 1e-3, 1e-5] {
        let mut hill = road(140.0, |_| 0.0);
        hill.limits.max_grade = 0.08;
        [hill.limits.crest_k_m, hill.limits.sag_k_m] = [100.0, sag_k_m];
        hill.fixed = vec![fixed(0.0, 0.0), fixed(70.0, 9.0), fixed(140.0, 0.0)];
        let found = shortfalls(&network(vec![hill]));
        assert!(found.iter().all(|shortfall| shortfall.kind != ShortfallKind::SagK), "{found:?}");
        // The sum over both sides of the hill, which is the same on both.
        let grades = || found.iter().filter(|shortfall| shortfall.kind == ShortfallKind::Grade);
        assert_eq!(grades().count(), 2, "{found:?}");
        assert!(grades().all(|shortfall| (0.12..0.16).contains(&shortfall.needed)), "{found:?}");
    }
}

#[test]
fn a_grade_between_two_fixed_points_is_the_one_that_joins_them() {
    let mut steep = road(500.0, |_| 0.0);
    [steep.limits.crest_k_m, steep.limits.sag_k_m] = [1.0; 2];
    steep.fixed = vec![fixed(100.0, 0.0), fixed(300.0, 20.0)];
    let found = shortfalls(&network(vec![steep]));
    assert_eq!(found.len(), 1);
    // At both ends the grade is still what is allowed, at the 19 knots between them it is more: 10 m · (19 grades + 0.08) is 20 m.
    assert!((found[0].needed - 19.2 / 190.0).abs() < 1e-5, "{}", found[0].needed);
    assert!((found[0].from_m - 100.0).abs() < 1e-3 && (found[0].to_m - 300.0).abs() < 1e-3, "{found:?}");
    assert_eq!(found[0].because.len(), 2);
    let text = found[0].to_string();
    assert!(text.contains("be at 0 m at station 100") && text.contains("be at 20 m at station 300"), "{text}");
}

#[test]
fn a_curve_that_is_too_narrow_is_told_by_its_k() {
    // From 5 % up to 5 % down within 100 m: A = 10, K = 10.
    let mut crest = road(700.0, |_| 0.0);
    crest.fixed = vec![
        FixedPoint { station_m: 300.0, height_m: 0.0, grade: Some(0.05) },
        FixedPoint { station_m: 400.0, height_m: 0.0, grade: Some(-0.05) },
    ];
    let found = shortfalls(&network(vec![crest]));
    assert!(found.iter().all(|s| s.kind == ShortfallKind::CrestK && s.limit == 20.0), "{found:?}");
    assert!(found.iter().any(|s| (s.needed - 10.0).abs() < 0.01), "{found:?}");
    assert!(found[0].to_string().contains("K over the crest would have to be 10"), "{}", found[0]);
    assert!(found[0].because.iter().all(|demand| matches!(demand, Demand::Height { .. } | Demand::Grade { .. })));
}

#[test]
fn demands_that_contradict_each_other_are_named_whatever_the_limits() {
    // Two roads that meet shall also pass over each other there.
    let mut both = network(vec![named("a", road(300.0, |_| 0.0)), named("b", road(300.0, |_| 0.0))]);
    both.meet = vec![MeetAt { a: point(0, 150.0), b: point(1, 150.0) }];
    both.over = vec![ClearanceAt { upper: point(1, 150.0), lower: point(0, 150.0), clearance_m: 5.0 }];
    let found = shortfalls(&both);
    let named = |demand: &Demand| matches!(demand, Demand::Meet { meet: 0, .. } | Demand::Over { over: 0, .. });
    for shortfall in &found {
        let ShortfallKind::Demand(demand) = &shortfall.kind else { panic!("{shortfall}") };
        assert!(named(demand) && !shortfall.because.is_empty() && shortfall.because.iter().all(named), "{shortfall}");
    }
    // A fixed point that is under water.
    let mut wet = road(400.0, |_| 0.0);
    wet.fixed = vec![fixed(205.0, 1.0)];
    wet.bounds = vec![HeightBound { from_m: 150.0, to_m: 250.0, lowest_m: Some(3.0), highest_m: None }];
    let found = shortfalls(&network(vec![wet]));
    let text = found.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    assert!(text.contains("be at 1 m at station 205") && text.contains("stay above 3 m from 150 to 250 m"), "{text}");
}

#[test]
fn every_part_that_cannot_be_had_is_told() {
    let mut steep = road(500.0, |_| 0.0);
    steep.fixed = vec![fixed(100.0, 0.0), fixed(300.0, 20.0)];
    let three = network(vec![named("one", steep.clone()), road(300.0, |_| 0.0), named("two", steep)]);
    let roads: Vec<usize> = shortfalls(&three).iter().map(|s| s.road).collect();
    assert_eq!(roads, [0, 2]);
}
