//! Scenes: what can be seen of a document.

use fairpath_curve::Point;
use fairpath_drive::{Carrier, Command, Document, NoFiles, Results, Scene, SceneOptions};

/// A document to which commands were done, given as the JSON of a script.
fn document(commands: impl IntoIterator<Item = String>) -> Document {
    let mut document = Document::new();
    for text in commands {
        let command: Command = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{text}: {e}"));
        document.run(command, &NoFiles).unwrap_or_else(|e| panic!("{text}: {e}"));
    }
    document
}

const HILLS: &str = r#"{"do":"terrain","synthetic":"hills","size":513,"cell_m":2.0,"seed":7}"#;

/// Three wide roads straight through hills, whose tunnels begin where there is little ground above them.
fn tunnels() -> Document {
    let roads = [150, 500, 850].map(|y| {
        format!(r#"{{"do":"sketch","points_m":[[20,{y}],[500,{y}],[1000,{y}]],"layer":"road","section":"four-lane"}}"#)
    });
    let structures = r#"{"do":"settings","structures":{"tunnel_below_m":10.0}}"#.to_owned();
    document([HILLS.to_owned(), structures].into_iter().chain(roads))
}

/// How far each corner of the linings, further inside than portals and their lids reach, lies above the natural ground, m.
fn above_ground(results: &Results, scene: &Scene) -> Vec<f64> {
    let mut all = Vec::new();
    for path in &results.paths {
        let name = format!("tunnels of {}", path.path.name);
        let ranges = path.structures.iter().filter(|s| s.carrier == Carrier::Tunnel).map(|s| [s.from_m, s.to_m]);
        let ranges: Vec<[f64; 2]> = ranges.collect();
        for [x, y, z] in scene.parts.iter().filter(|p| p.name == name).flat_map(|p| &p.mesh.vertices) {
            let place = Point::new(*x, *y);
            let station = path.path.plan.nearest(place).s;
            if ranges.iter().any(|[from, to]| station > from + 8.0 && station < to - 8.0) {
                all.push(z - results.ground.natural().height(place));
            }
        }
    }
    all
}

#[test]
fn linings_of_tunnels_stay_below_the_ground() {
    let document = tunnels();
    let results = document.results().unwrap();
    let scene = Scene::of(document.state(), results, &SceneOptions::default());
    let above = above_ground(results, &scene);
    assert!(above.len() > 500, "{} corners of linings", above.len());
    let highest = above.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(highest < 0.0, "{highest}");
}

/// Whether the way from one place to another leads through a triangle (Möller and Trumbore, *Fast, minimum storage ray/triangle intersection*, 1997).
fn is_through([a, b, c]: [[f64; 3]; 3], from: [f64; 3], to: [f64; 3]) -> bool {
    let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let cross =
        |p: [f64; 3], q: [f64; 3]| [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let (way, ab, ac, off) = (minus(to, from), minus(b, a), minus(c, a), minus(from, a));
    let normal = cross(way, ac);
    let pivot = dot(ab, normal);
    let (u, along) = (dot(off, normal) / pivot, cross(off, ab));
    let (v, t) = (dot(way, along) / pivot, dot(ac, along) / pivot);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t)
}

/// Checks that one can drive through the only intersection of two roads on bridges, and that there are parapets before it on both sides.
fn assert_open(commands: [&str; 4]) {
    let document = document(commands.map(str::to_owned));
    let results = document.results().unwrap();
    assert_eq!(results.junctions.len(), 1);
    let scene = Scene::of(document.state(), results, &SceneOptions::default());
    let bridges: Vec<_> = scene.parts.iter().filter(|p| p.name.starts_with("bridges of")).map(|p| &p.mesh).collect();
    assert_eq!(bridges.len(), 2);
    let stand_in_the_way = |from: [f64; 3], to: [f64; 3]| {
        let triangles =
            bridges.iter().flat_map(|mesh| mesh.triangles.iter().map(|t| t.map(|i| mesh.vertices[i as usize])));
        triangles.filter(|t| is_through(*t, from, to)).count()
    };
    for path in &results.paths {
        let at = |station: f64, left_m: f64| {
            let pose = path.path.plan.pose_at(station);
            let left = fairpath_curve::trig::unit(pose.heading + std::f64::consts::FRAC_PI_2);
            let place = pose.point + left * left_m;
            [place.x, place.y, path.profile.at(station).height_m + 0.5]
        };
        let (_, [from, to]) = results.junctions[0].spans.iter().find(|span| span.0 == path.path.id).unwrap();
        // Beyond the end of a road there may be a parapet of the other one.
        let to = if path.path.plan.is_closed() { to + 5.0 } else { (to + 5.0).min(path.path.length_m()) };
        for lane in [-2.0, 2.0] {
            for k in 0..20 {
                let [a, b] = [k, k + 1].map(|k| at(from - 5.0 + (to - from + 5.0) * f64::from(k) / 20.0, lane));
                assert_eq!(stand_in_the_way(a, b), 0, "{}: {a:?} {b:?}", path.path.name);
            }
        }
        for side in [-10.0, 10.0] {
            assert!(stand_in_the_way(at(from - 10.0, 0.0), at(from - 10.0, side)) > 0, "{}", path.path.name);
        }
    }
}

#[test]
fn no_parapet_stands_across_an_intersection_on_a_bridge() {
    // Road and ring lie so high that both are on bridges where they meet.
    assert_open([
        HILLS,
        r#"{"do":"roundabout","at_m":[500,500],"radius_m":45,"name":"ring"}"#,
        r#"{"do":"sketch","name":"road","points_m":[[500,700],[500,600],[500,480]],"as":"new"}"#,
        r#"{"do":"elevation","path":"road","points_m":[[0,190],[200,190]]}"#,
    ]);
}

#[test]
fn no_abutment_stands_on_a_bridge_on_which_a_road_ends() {
    assert_open([
        HILLS,
        r#"{"do":"sketch","name":"main","points_m":[[250,500],[500,500],[800,500]],"as":"new"}"#,
        r#"{"do":"elevation","path":"main","points_m":[[0,190],[550,190]]}"#,
        r#"{"do":"sketch","name":"side","points_m":[[530,750],[530,600],[530,500]],"as":"new"}"#,
    ]);
}
