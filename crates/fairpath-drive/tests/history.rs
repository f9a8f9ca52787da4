//! Documents over time: what follows from a state does not depend on how it was reached, and undoing and doing again lead to the same bits.

use fairpath_curve::Point;
use fairpath_drive::{
    Carrier, Command, Crossing, CrossingSet, DesignRules, Document, DrawnHeights, EarthworkOptions, HeightMode,
    Landscape, NoFiles, PathId, PathPlace, Section, SketchAs, Soil, Structure, StructureLimits, TerrainSource, pillars,
};

/// A small generator of its own: the same on every platform.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    fn place(&mut self) -> [f64; 2] {
        [20.0 + 460.0 * self.next(), 20.0 + 460.0 * self.next()]
    }

    fn square(&mut self, side: f64) -> Vec<[f64; 2]> {
        let [x, y] = self.place();
        vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
}

fn name(document: &Document, random: &mut Random) -> String {
    let paths = &document.state().paths;
    if paths.is_empty() { "none".to_owned() } else { paths[random.below(paths.len())].name.clone() }
}

/// So many kinds of commands there are below.
const KINDS: usize = 27;

fn command(document: &Document, random: &mut Random, kind: usize) -> Command {
    match kind {
        0..=4 => {
            let count = 3 + random.below(3);
            let (from, to) = (random.place(), random.place());
            let points_m = (0..=count)
                .map(|i| {
                    let t = i as f64 / count as f64;
                    let off = 25.0 * (random.next() - 0.5);
                    [from[0] + t * (to[0] - from[0]) + off, from[1] + t * (to[1] - from[1]) - off]
                })
                .collect();
            Command::Sketch {
                points_m,
                layer: "road".to_owned(),
                name: None,
                section: Some(random.of(&Section::SHIPPED).to_owned()),
                sketch_as: random.of(&[SketchAs::Auto, SketchAs::New]),
                closed: false,
                pixel_m: 1.0,
                min_radius_m: Some(15.0),
            }
        }
        5 | 6 => {
            let crossings = document.results().map_or(&[][..], |r| &r.crossings);
            let crossing = if crossings.is_empty() { None } else { Some(crossings[random.below(crossings.len())]) };
            let near = crossing.map_or([0.0; 2], |c| [c.point.x, c.point.y]);
            let path = crossing.and_then(|c| document.state().path_of(c.first.path)).map(|p| p.name.clone());
            let set = random.of(&[CrossingSet::Over, CrossingSet::Under, CrossingSet::Intersect]);
            Command::Crossing { near_m: near, set, path, other: None }
        }
        7 => Command::Delete { lasso_m: Some(random.square(60.0)), path: None },
        8 => Command::Delete { lasso_m: None, path: Some(name(document, random)) },
        9 => Command::Elevation {
            path: name(document, random),
            points_m: vec![[40.0, 20.0 + 20.0 * random.next()], [70.0, 30.0 * random.next()]],
        },
        10 => Command::Speed {
            lasso_m: Some(random.square(150.0)),
            path: None,
            kmh: 30.0 + 10.0 * random.below(6) as f64,
        },
        11 => Command::Foliage { lasso_m: random.square(120.0), density: random.next() },
        12 => Command::Soil {
            lasso_m: (random.next() < 0.7).then(|| random.square(150.0)),
            class: random.of(&[Soil::Rock, Soil::Gravel, Soil::Sand, Soil::Clay]),
        },
        13 => Command::Section {
            path: name(document, random),
            template: random.of(&["two-lane", "four-lane", "rail", "footpath", "pipe", "own"]).to_owned(),
        },
        14 => Command::Water { lasso_m: random.square(80.0), level_m: 12.0 * random.next() },
        15 => Command::Heights {
            path: Some(name(document, random)),
            mode: random.of(&[HeightMode::Fair, HeightMode::Draped, HeightMode::Engineered]),
        },
        16 | 17 => Command::Roundabout {
            at_m: random.place(),
            radius_m: 15.0 + 60.0 * random.next(),
            name: None,
            section: None,
        },
        18 => Command::Split { path: name(document, random), at_m: 200.0 * random.next() },
        19 => Command::Join { path: name(document, random), with: name(document, random) },
        20 => {
            let (from, to) = (random.place(), random.place());
            let middle = [0.5 * (from[0] + to[0]) + 10.0, 0.5 * (from[1] + to[1])];
            Command::Oversketch { points_m: vec![from, middle, to], path: Some(name(document, random)), pixel_m: 1.0 }
        }
        21 => Command::Layer { path: name(document, random), layer: random.of(&["road", "other"]).to_owned() },
        22 => {
            let mut section = Section::shipped("two-lane").unwrap();
            section.name = "own".to_owned();
            section.right[0].width_m = 2.5 + 4.0 * random.next();
            Command::DefineSection { section }
        }
        23 => {
            let ([x, y], wide, high) = (random.place(), 40.0 + 80.0 * random.next(), 40.0 + 80.0 * random.next());
            let place = |i: u8| {
                let angle = std::f64::consts::TAU * f64::from(i) / 24.0;
                [x + wide * libm::cos(angle), y + high * libm::sin(angle)]
            };
            Command::Sketch {
                points_m: (0..24).map(place).collect(),
                layer: "road".to_owned(),
                name: None,
                section: None,
                sketch_as: SketchAs::New,
                closed: true,
                pixel_m: 1.0,
                min_radius_m: Some(15.0),
            }
        }
        24 => Command::Settings {
            structures: Some(StructureLimits {
                bridge_above_m: 3.0 + 8.0 * random.next(),
                ..StructureLimits::default()
            }),
            earthwork: None,
            rules: None,
            seed: Some(random.below(5) as u64),
        },
        25 => Command::Settings {
            structures: None,
            earthwork: Some(EarthworkOptions {
                verge_m: 2.0 * random.next(),
                verge_drop_m: 0.3 * random.next(),
                reach_m: 5.0 + 30.0 * random.next(),
            }),
            rules: None,
            seed: None,
        },
        _ => {
            let mut rules = DesignRules::default();
            let stricter = 0.5 + random.next();
            for rule in &mut rules.speeds {
                rule.k_crest *= stricter;
                rule.k_sag *= stricter;
            }
            Command::Settings { structures: None, earthwork: None, rules: Some(rules), seed: None }
        }
    }
}

fn islands() -> Command {
    Command::Terrain(TerrainSource {
        synthetic: Some(Landscape::Islands),
        size: Some(126),
        cell_m: Some(4.0),
        water_level_m: Some(0.0),
        ..TerrainSource::default()
    })
}

/// What must hold of every document.
fn is_sound(document: &Document, seed: u64) {
    let (state, results) = (document.state(), document.results().unwrap());
    let waters = &state.terrain.as_ref().unwrap().waters;
    let path = |id: PathId| results.path(id).unwrap();
    for crossing in &results.crossings {
        let Some([upper, lower]) = crossing.upper_lower() else { continue };
        let drawn = |place: PathPlace| {
            let covers = |d: &DrawnHeights| {
                d.points_m[0][0] <= place.station_m && place.station_m <= d.points_m[d.points_m.len() - 1][0]
            };
            path(place.path).path.drawn.iter().any(covers)
        };
        if drawn(upper) && drawn(lower) {
            continue;
        }
        let height = |place: PathPlace| path(place.path).profile.at(place.station_m).height_m;
        let needs = path(upper.path).path.section.thickness_m + path(lower.path).path.section.clearance_m;
        let free = height(upper) - height(lower);
        assert!(free >= needs - 0.01, "seed {seed}: {free} of {needs} at {crossing:?}: {:?}", document.commands());
    }
    for result in &results.paths {
        let [first, last] = result.profile.range_m();
        let length = result.path.length_m();
        assert!(first == 0.0 && (last - length).abs() < 1e-9, "seed {seed}: {first} to {last} of {length}");
        if result.path.plan.is_closed() {
            let [a, b] = [0.0, length].map(|s| result.profile.at(s));
            assert!(
                (a.height_m - b.height_m).abs() < 1e-9 && (a.grade - b.grade).abs() < 1e-9,
                "seed {seed}: {a:?} {b:?}"
            );
        }
        for pillar in pillars(result, results) {
            assert!(pillar.top_m > pillar.foot_m);
            for other in results.paths.iter().filter(|o| o.path.id != result.path.id) {
                let off = other.path.plan.nearest(pillar.place).distance;
                assert!(
                    off > 0.5 * other.path.section.width_m(),
                    "seed {seed}: a pillar {off} m beside a path's middle"
                );
            }
        }
        for bridge in result.structures.iter().filter(|s| s.carrier == Carrier::Bridge) {
            // What leads over the seam of a closed path is told as two, each with the reasons of both.
            if result.path.plan.is_closed() && (bridge.from_m == 0.0 || bridge.to_m == length) {
                continue;
            }
            let spans = |c: &&Crossing| {
                c.upper_lower().is_some_and(|[u, _]| {
                    u.path == result.path.id && (bridge.from_m..=bridge.to_m).contains(&u.station_m)
                })
            };
            let over_path = results.crossings.iter().any(|c| spans(&c));
            let stations = (0..=200).map(|i| bridge.from_m + (bridge.to_m - bridge.from_m) * f64::from(i) / 200.0);
            let over_water = stations
                .map(|s| result.path.plan.point_at(s))
                .map(|p| (p, results.ground.natural().height(p)))
                .any(|(p, z)| waters.covers(p, z));
            let high = bridge.most_m > state.settings.structures.bridge_above_m;
            assert!(over_path || over_water || high, "seed {seed}: nothing asks for {bridge:?}");
            assert_eq!(
                (bridge.over_path && !over_path, bridge.over_water && !over_water),
                (false, false),
                "{bridge:?}"
            );
        }
    }
    let mut trees: Vec<Point> = results.trees.values().flat_map(|t| t.iter()).map(|t| t.place).collect();
    trees.sort_by(|a, b| a.x.total_cmp(&b.x));
    for (i, tree) in trees.iter().enumerate() {
        let near = trees[i + 1..].iter().take_while(|other| other.x - tree.x < 4.5);
        let least = near.map(|other| (*other - *tree).hypot2().sqrt()).fold(f64::INFINITY, f64::min);
        assert!(least >= 4.5, "seed {seed}: two trees {least} m apart");
    }
    for tree in results.trees.values().flat_map(|t| t.iter()) {
        assert!(!waters.covers(tree.place, results.ground.height(tree.place)), "seed {seed}: a tree in the water");
        for result in &results.paths {
            let near = result.path.plan.nearest(tree.place);
            let station = result.path.plan.station(near.segment, near.s);
            // Beyond its ends a path has no width.
            if station < 0.1 || station > result.path.length_m() - 0.1 {
                continue;
            }
            let covered =
                |s: &Structure| s.carrier == Carrier::Tunnel && s.from_m - 8.0 <= station && station <= s.to_m + 8.0;
            let ends = near.distance > 0.5 * result.path.section.width_m() || result.structures.iter().any(covered);
            assert!(ends, "seed {seed}: a tree {} m beside the middle of {:?}", near.distance, result.path.name);
        }
    }
}

#[test]
fn what_follows_does_not_depend_on_the_way_there_and_undoing_leads_back_to_the_same_bits() {
    let mut refused = 0;
    let mut done = 0;
    for seed in 0..100 {
        let mut random = Random::new(seed + 1);
        let mut document = Document::new();
        document.run(islands(), &NoFiles).unwrap();
        let mut trail = vec![document.results().unwrap().clone()];
        for k in 0..10 {
            // First of all there have to be paths.
            let kind = if k < 3 { 0 } else { random.below(KINDS) };
            let command = command(&document, &mut random, kind);
            match document.run(command, &NoFiles) {
                Ok(_) => {
                    done += 1;
                    trail.push(document.results().unwrap().clone());
                    // Of some of them after each command, of all at the end.
                    if seed % 5 == 0 {
                        let anew = document.results_anew().unwrap();
                        assert!(anew == **document.results().unwrap(), "seed {seed}: {:?}", document.commands());
                    }
                }
                Err(_) => refused += 1,
            }
        }
        let anew = document.results_anew().unwrap();
        assert!(anew == **document.results().unwrap(), "seed {seed}: {:?}", document.commands());
        is_sound(&document, seed);
        for results in trail.iter().rev() {
            assert!(results == document.results().unwrap(), "seed {seed}, backwards");
            document.undo();
        }
        assert!(document.results().is_none() && !document.undo());
        for results in &trail {
            assert!(document.redo());
            assert!(results == document.results().unwrap(), "seed {seed}, forwards");
        }
        assert!(!document.redo());
    }
    // Commands about paths are refused where there are none; most are not.
    assert!(done > 3 * refused, "{done} done, {refused} refused");
}

#[test]
fn trees_come_back_where_one_leg_of_a_hairpin_was() {
    let mut document = Document::new();
    document.run(islands(), &NoFiles).unwrap();
    let square = vec![[0.0, 0.0], [500.0, 0.0], [500.0, 500.0], [0.0, 500.0]];
    document.run(Command::Foliage { lasso_m: square, density: 1.0 }, &NoFiles).unwrap();
    // Both legs lie on the same tiles of the ground.
    let bend = (0..=8).map(|i| std::f64::consts::PI / 8.0 * f64::from(i) - std::f64::consts::FRAC_PI_2);
    let bend = bend.map(|angle| [380.0 + 12.0 * libm::cos(angle), 240.0 + 12.0 * libm::sin(angle)]);
    let points_m = [[60.0, 228.0]].into_iter().chain(bend).chain([[60.0, 252.0]]).collect();
    let hairpin = Command::Sketch {
        points_m,
        layer: "road".to_owned(),
        name: Some("hairpin".to_owned()),
        // It leaves the ground as it is, so that nothing about the other leg changes.
        section: Some("pipe".to_owned()),
        sketch_as: SketchAs::New,
        closed: false,
        pixel_m: 1.0,
        min_radius_m: Some(10.0),
    };
    document.run(hairpin, &NoFiles).unwrap();
    let aside = (0..=20).map(|i| {
        let t = f64::from(i) / 20.0;
        [340.0 - 240.0 * t, 252.0 + 80.0 * 16.0 * (t * (1.0 - t)) * (t * (1.0 - t))]
    });
    let leg = Command::Oversketch { points_m: aside.collect(), path: Some("hairpin".to_owned()), pixel_m: 1.0 };
    document.run(leg, &NoFiles).unwrap();
    let results = document.results().unwrap();
    assert!(document.results_anew().unwrap() == **results);
    let middle = Point::new(220.0, 252.0);
    assert!(results.paths[0].path.plan.nearest(middle).distance > 20.0, "the leg lies elsewhere now");
    let around = results.trees.values().flat_map(|trees| trees.iter()).filter(|t| (t.place - middle).hypot() < 10.0);
    assert!(around.count() > 0, "and trees stand where it was");
}
