//! Scenes: what can be seen of a document.

use fairpath_curve::Point;
use fairpath_drive::{Carrier, Command, Document, NoFiles, Results, Scene, SceneOptions};

/// Three wide roads straight through hills, whose tunnels begin where there is little ground above them.
fn tunnels() -> Document {
    let mut document = Document::new();
    let roads = [150, 500, 850].map(|y| {
        format!(r#"{{"do":"sketch","points_m":[[20,{y}],[500,{y}],[1000,{y}]],"layer":"road","section":"four-lane"}}"#)
    });
    let terrain = r#"{"do":"terrain","synthetic":"hills","size":513,"cell_m":2.0,"seed":7}"#.to_owned();
    let structures = r#"{"do":"settings","structures":{"tunnel_below_m":10.0}}"#.to_owned();
    for text in [terrain, structures].into_iter().chain(roads) {
        let command: Command = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{text}: {e}"));
        document.run(command, &NoFiles).unwrap_or_else(|e| panic!("{text}: {e}"));
    }
    document
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
