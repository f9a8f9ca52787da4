//! Roads to test with, and a check of all limits that knows nothing but the profiles.

use fairpath_drive::{
    EarthworkSection, EngineeredHeights, EngineeredNetwork, EngineeredRoad, FixedPoint, GradeLimits, Profile, RoadPoint,
};

pub(crate) fn road(length_m: f64, ground: impl Fn(f64) -> f64) -> EngineeredRoad {
    let count = (length_m / 5.0).ceil() as usize;
    let station = |i: usize| length_m * i as f64 / count as f64;
    EngineeredRoad {
        name: "road".to_owned(),
        length_m,
        ground: (0..=count).map(|i| [station(i), ground(station(i))]).collect(),
        knot_spacing_m: 10.0,
        closed: false,
        limits: GradeLimits { max_grade: 0.08, crest_k_m: 20.0, sag_k_m: 15.0 },
        section: EarthworkSection { platform_m: 10.0, slope_run: 1.5, cut_weight: 1.0, fill_weight: 1.0 },
        fixed: Vec::new(),
        bounds: Vec::new(),
        start_grade: None,
        end_grade: None,
        stretches: Vec::new(),
    }
}

pub(crate) fn named(name: &str, road: EngineeredRoad) -> EngineeredRoad {
    EngineeredRoad { name: name.to_owned(), ..road }
}

pub(crate) fn network(roads: Vec<EngineeredRoad>) -> EngineeredNetwork {
    EngineeredNetwork { roads, ..EngineeredNetwork::default() }
}

pub(crate) fn fixed(station_m: f64, height_m: f64) -> FixedPoint {
    FixedPoint { station_m, height_m, grade: None }
}

pub(crate) fn point(road: usize, station_m: f64) -> RoadPoint {
    RoadPoint { road, station_m }
}

pub(crate) fn height(profiles: &[Profile], point: RoadPoint) -> f64 {
    profiles[point.road].at(point.station_m).height_m
}

/// Asserts that profiles keep all limits: without any tolerance if they say so.
pub(crate) fn assert_limits(network: &EngineeredNetwork, heights: &EngineeredHeights) {
    let profiles = &heights.profiles;
    let (grade, k, clearance) = if heights.strict { (0.0, 0.0, 0.0) } else { (1e-6, 1e-4, 1e-4) };
    assert_eq!(profiles.len(), network.roads.len());
    for (road, profile) in network.roads.iter().zip(profiles) {
        assert_eq!(profile.range_m(), [0.0, road.length_m]);
        let steepest = profile.steepest([0.0, road.length_m]).1.abs();
        assert!(steepest <= road.limits.max_grade + grade, "{steepest} {:?}", road.limits);
        for piece in 0..profile.knots().len() - 1 {
            let [_, _, c, d] = profile.cubic(piece);
            let span = profile.knots()[piece + 1].station_m - profile.knots()[piece].station_m;
            assert!(span <= road.knot_spacing_m * (1.0 + 1e-9));
            // No more than rounding of heights is left of the cubic term.
            assert!((d * span * span * span).abs() < 1e-10, "{d}");
            let bend = 2.0 * c + 3.0 * d * span;
            let least = if bend < 0.0 { road.limits.crest_k_m } else { road.limits.sag_k_m };
            assert!(bend.abs() * 100.0 * least <= 1.0 + k, "K {} {least}", 1.0 / (100.0 * bend));
        }
        for fixed in &road.fixed {
            let at = profile.at(fixed.station_m);
            assert!((at.height_m - fixed.height_m).abs() < 1e-6, "{} {fixed:?}", at.height_m);
            assert!(fixed.grade.is_none_or(|grade| (at.grade - grade).abs() < 1e-7), "{} {fixed:?}", at.grade);
        }
        for (grade, station) in [(road.start_grade, 0.0), (road.end_grade, road.length_m)] {
            assert!(grade.is_none_or(|grade| (profile.at(station).grade - grade).abs() < 1e-7));
        }
        for bound in &road.bounds {
            for i in 0..=1000 {
                let z = profile.at(bound.from_m + (bound.to_m - bound.from_m) * f64::from(i) / 1000.0).height_m;
                assert!(bound.lowest_m.is_none_or(|lowest| z >= lowest - clearance), "{z} {bound:?}");
                assert!(bound.highest_m.is_none_or(|highest| z <= highest + clearance), "{z} {bound:?}");
            }
        }
        if road.closed {
            let (a, b) = (profile.knots()[0], profile.knots()[profile.knots().len() - 1]);
            assert_eq!((a.height_m, a.grade), (b.height_m, b.grade));
        }
    }
    for over in &network.over {
        let room = height(profiles, over.upper) - height(profiles, over.lower);
        assert!(room >= over.clearance_m - clearance, "{room} {over:?}");
    }
    for meet in &network.meet {
        assert!((height(profiles, meet.a) - height(profiles, meet.b)).abs() < 1e-6);
    }
}
