//! How long it takes to find heights of least earthwork: a road of 10 km with a knot each 10 m shall take less than 200 ms, and time shall grow with length.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fairpath_drive::{
    ClearanceAt, EarthworkSection, EngineeredError, EngineeredNetwork, EngineeredRoad, FixedPoint, GradeLimits, MeetAt,
    RoadPoint,
};

/// Hills of several lengths, the short ones too narrow for a road to follow.
fn ground(length_m: f64, seed: f64) -> Vec<[f64; 2]> {
    let count = (length_m / 5.0).ceil() as usize;
    let height = |s: f64| {
        25.0 * libm::sin(s / 311.0 + seed) + 6.0 * libm::sin(s / 47.0 + 2.0 * seed) + libm::sin(s / 9.0 + 3.0 * seed)
    };
    (0..=count).map(|i| [5.0 * i as f64, height(5.0 * i as f64)]).collect()
}

fn road(name: String, length_m: f64, seed: f64) -> EngineeredRoad {
    EngineeredRoad {
        name,
        length_m,
        ground: ground(length_m, seed),
        knot_spacing_m: 10.0,
        closed: false,
        limits: GradeLimits { max_grade: 0.07, crest_k_m: 20.0, sag_k_m: 20.0 },
        section: EarthworkSection { platform_m: 10.0, slope_run: 1.5, cut_weight: 1.0, fill_weight: 1.2 },
        fixed: Vec::new(),
        bounds: Vec::new(),
        start_grade: None,
        end_grade: None,
        stretches: Vec::new(),
    }
}

/// Roads of 500 m, each of which crosses the next: over it, under it or on its level by turns, with every fourth pair apart.
fn roads(count: usize) -> EngineeredNetwork {
    let roads: Vec<_> = (0..count).map(|i| road(format!("road {i}"), 500.0, 0.37 * i as f64)).collect();
    let mut network = EngineeredNetwork { roads, ..EngineeredNetwork::default() };
    for i in 0..count / 2 {
        let (a, b) = (2 * i, (2 * i + if i % 2 == 0 { 1 } else { 2 }) % count);
        let (a, b) = (RoadPoint { road: a, station_m: 233.0 }, RoadPoint { road: b, station_m: 318.0 });
        match i % 3 {
            0 => network.over.push(ClearanceAt { upper: a, lower: b, clearance_m: 5.2 }),
            1 => network.over.push(ClearanceAt { upper: b, lower: a, clearance_m: 5.2 }),
            _ => network.meet.push(MeetAt { a, b }),
        }
    }
    network
}

fn engineered(c: &mut Criterion) {
    let mut group = c.benchmark_group("engineered");
    group.sample_size(10);
    for km in [2.5, 5.0, 10.0, 20.0] {
        let network =
            EngineeredNetwork { roads: vec![road("long".to_owned(), 1000.0 * km, 0.0)], ..Default::default() };
        group.throughput(Throughput::Elements((100.0 * km) as u64));
        group.bench_with_input(BenchmarkId::new("km", km), &network, |b, network| {
            b.iter(|| {
                let heights = network.solve().expect("a road without demands has heights");
                assert!(heights.strict);
                heights
            });
        });
    }
    let network = roads(200);
    assert_eq!(network.over.len() + network.meet.len(), 100);
    group.throughput(Throughput::Elements(200 * 50));
    group.bench_function("200 roads with 100 crossings", |b| {
        b.iter(|| network.solve().expect("there is room for the crossings"));
    });
    let mut narrow = EngineeredNetwork { roads: vec![road("narrow".to_owned(), 10_000.0, 0.0)], ..Default::default() };
    let fixed = |station_m: f64, height_m: f64| FixedPoint { station_m, height_m, grade: None };
    narrow.roads[0].fixed = vec![fixed(5000.0, 0.0), fixed(5100.0, 9.0)];
    group.throughput(Throughput::Elements(1000));
    group.bench_function("10 km that cannot be had", |b| {
        b.iter(|| assert!(matches!(narrow.solve(), Err(EngineeredError::Infeasible { .. }))));
    });
    group.finish();
}

criterion_group!(benches, engineered);
criterion_main!(benches);
