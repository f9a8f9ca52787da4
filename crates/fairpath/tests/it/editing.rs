//! Correcting curves by strokes, and edits.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::{folder, read_json, run_in, strokes};

/// Points along a function, from one x to another.
fn points(from: f64, to: f64, count: usize, y: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count - 1) as f64).map(|x| [x, y(x)]).collect()
}

fn wave(x: f64) -> f64 {
    60.0 * (0.0187 * x).sin()
}

/// A folder with `curves.json` of a wave and a line below, as `fairpath fit` makes them.
fn curves() -> tempfile::TempDir {
    let folder = folder();
    let (bend, line) = (points(0.0, 420.0, 90, wave), points(0.0, 400.0, 60, |_| 300.0));
    fs::write(folder.path().join("drawn.json"), strokes(&[("bend", &bend), ("line", &line)])).unwrap();
    run_in(folder.path(), &["fit", "drawn.json", "-o", "curves.json"]).ended(0);
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

fn edits(list: &Value) -> String {
    json!({"format": "fairpath-edits", "version": 1, "edits": list}).to_string()
}

fn spline<'a>(file: &'a Value, name: &str) -> &'a Value {
    file["splines"].as_array().unwrap().iter().find(|s| s["name"] == name).expect("a spline of that name")
}

#[test]
fn strokes_correct_the_curves_that_they_lie_on() {
    let folder = curves();
    let over_bend = points(185.0, 320.0, 36, |x| wave(x) - 40.0 * ((x - 185.0) * 0.02327).sin().powi(2));
    let over_line = points(100.0, 200.0, 30, |x| 300.0 + 25.0 * ((x - 100.0) * 0.031416).sin());
    write(folder.path(), "over.json", &strokes(&[("a", &over_bend), ("b", &over_line)]));
    run_in(folder.path(), &["oversketch", "curves.json", "over.json", "-o", "out.json", "--picture", "rows.svg"])
        .ended(0);
    let (old, new) = (read_json(&folder.path().join("curves.json")), read_json(&folder.path().join("out.json")));
    for name in ["bend", "line"] {
        assert_ne!(spline(&old, name)["segments"], spline(&new, name)["segments"], "{name}");
        // What the figures were measured against is not at hand.
        assert!(spline(&old, name).get("report").is_some() && spline(&new, name).get("report").is_none());
        // The first segment of each is far from the correction, and keeps every digit but those of a cut.
        for field in ["x", "y", "heading", "kappa0"] {
            assert_eq!(spline(&old, name)["segments"][0][field], spline(&new, name)["segments"][0][field]);
        }
    }
    assert!(fs::read_to_string(folder.path().join("rows.svg")).unwrap().contains("<svg"));
    // By name only that one; the other stroke then leads nowhere.
    let ran = run_in(folder.path(), &["oversketch", "curves.json", "over.json", "-o", "one.json", "--spline", "line"])
        .ended(1);
    assert!(ran.err.contains("a: neither end of the stroke is near the curve"), "{}", ran.err);
    let one = read_json(&folder.path().join("one.json"));
    assert_eq!(spline(&old, "bend"), spline(&one, "bend"));
    assert_eq!(spline(&new, "line"), spline(&one, "line"));
}

#[test]
fn modes_and_parameters_are_heard() {
    let folder = curves();
    let over = points(100.0, 200.0, 30, |x| 300.0 + 25.0 * ((x - 100.0) * 0.031416).sin());
    write(folder.path(), "over.json", &strokes(&[("b", &over)]));
    let segments = |more: &[&str]| {
        let args = [&["oversketch", "curves.json", "over.json", "-o", "out.json"], more].concat();
        run_in(folder.path(), &args).ended(0);
        spline(&read_json(&folder.path().join("out.json")), "line")["segments"].clone()
    };
    let usual = segments(&[]);
    assert_ne!(usual, segments(&["--mode", "local-blend"]));
    assert_ne!(usual, segments(&["--mode", "refit"]));
    assert_ne!(usual, segments(&["--set", "widening=50"]));
    assert_ne!(usual, segments(&["--set", "error_cost=50"]));
    assert_eq!(usual, segments(&["--set", "mode=shortest-path"]));
    for (set, said) in [
        ("widenning=3", "there is no parameter widenning"),
        ("widening=wide", "expected a number"),
        ("seam_worth=7", "seam_worth = 7 is out of range"),
        ("widening=-1", "widening = -1 is out of range"),
    ] {
        let ran =
            run_in(folder.path(), &["oversketch", "curves.json", "over.json", "-o", "no.json", "--set", set]).ended(2);
        assert!(ran.err.contains(said), "{}", ran.err);
        assert!(!folder.path().join("no.json").exists());
    }
}

#[test]
fn unusable_corrections_are_refused() {
    let folder = curves();
    write(folder.path(), "over.json", &strokes(&[("b", &[[0.0, 0.0], [9.0, 9.0]])]));
    let metres = strokes(&[("b", &[[0.0, 0.0], [9.0, 9.0]])]).replace("\"version\":1", "\"version\":1,\"unit\":\"m\"");
    write(folder.path(), "metres.json", &metres);
    for (args, said) in [
        (vec!["curves.json", "metres.json", "-o", "no.json"], "its unit is m"),
        (vec!["curves.json", "over.json", "-o", "no.json", "--spline", "x"], "has no curve of that name"),
        (
            vec!["curves.json", "over.json", "-o", "no.json", "--picture", "no.dxf"],
            "a picture is written as svg or png",
        ),
        (vec!["over.json", "over.json", "-o", "no.json"], "over.json"),
        (vec!["curves.json", "absent.json", "-o", "no.json"], "absent.json"),
    ] {
        let ran = run_in(folder.path(), &[&["oversketch"], &args[..]].concat()).ended(2);
        assert!(ran.err.contains(said), "{}", ran.err);
        assert!(!folder.path().join("no.json").exists());
    }
}

#[test]
fn edits_are_made_in_order() {
    let folder = curves();
    let list = json!([
        {"do": "extend", "spline": "line", "end": "end", "length": 50.0, "how": "straight"},
        {"do": "cut", "spline": "line", "stations": [100.0, 300.0], "keep": [1, 3]},
        {"do": "join", "spline": "line/1", "end": "end", "with": "line/3", "with_end": "start", "continuity": "G2", "reach": 20.0},
        {"do": "interpolate", "point": [200.0, 330.0], "station": 190.0, "heading": 0.0, "reach": 60.0},
        {"do": "close", "spline": "bend", "continuity": "G0"},
        {"do": "smooth-corner", "spline": "bend", "near": [0.0, 0.0], "reach": 25.0}
    ]);
    write(folder.path(), "edits.json", &edits(&list));
    run_in(folder.path(), &["edit", "curves.json", "edits.json", "-o", "out.json"]).ended(0);
    let out = read_json(&folder.path().join("out.json"));
    assert_eq!(out["splines"].as_array().unwrap().len(), 2);
    let bend = spline(&out, "bend");
    assert_eq!((&bend["closed"], bend.get("report")), (&json!(true), None));
    let corners = bend["joins"].as_array().unwrap().iter().filter(|j| **j == "G0").count();
    assert_eq!(corners, 1);
    let line = spline(&out, "line/1");
    let at = |s: &Value| [s["x"].as_f64().unwrap(), s["y"].as_f64().unwrap()];
    let met = line["segments"].as_array().unwrap().iter().map(at).any(|[x, y]| (x - 200.0).hypot(y - 330.0) < 1e-9);
    assert!(met, "a segment begins at the point that was asked for");
}

#[test]
fn every_problem_of_an_edit_file_is_named_and_nothing_is_written() {
    let folder = curves();
    let refused = |list: Value, said: &[&str]| {
        write(folder.path(), "edits.json", &edits(&list));
        let ran = run_in(folder.path(), &["edit", "curves.json", "edits.json", "-o", "no.json"]).ended(2);
        for word in said {
            assert!(ran.err.contains(word), "{word} is not in {}", ran.err);
        }
        assert!(ran.err.contains("edits.json") && !folder.path().join("no.json").exists());
    };
    refused(
        json!([
            {"do": "extend", "spline": "line", "end": "middle", "length": 1.0},
            {"do": "fly"},
            {"do": "interpolate", "point": [1.0], "reach": 3.0},
            {"do": "cut", "stations": [1.0], "blunt": true},
            {"do": "close", "continuity": "G9"},
            {"length": 3}
        ]),
        &[
            "edit 1 (extend)",
            "edit 2 (fly)",
            "edit 3 (interpolate)",
            "edit 4 (cut)",
            "blunt",
            "edit 5 (close)",
            "edit 6",
        ],
    );
    refused(json!([{"do": "extend", "end": "end", "length": 5.0}]), &["edit 1 (extend)", "\"bend\", \"line\""]);
    refused(json!([{"do": "extend", "spline": "x", "end": "end", "length": 5.0}]), &["there is no spline \"x\""]);
    refused(
        json!([{"do": "extend", "spline": "line", "end": "end", "length": -5.0}]),
        &["length = -5 must be a positive number"],
    );
    refused(json!([{"do": "cut", "spline": "line", "stations": [1e6]}]), &["station 1000000 is not on the curve"]);
    refused(
        json!([{"do": "cut", "spline": "line", "stations": [10.0], "keep": [3]}]),
        &["keep names part 3; there are 2"],
    );
    refused(json!([{"do": "smooth-corner", "spline": "line", "near": [0, 0], "reach": 5.0}]), &["it has no corner"]);
    refused(json!([{"do": "interpolate", "point": [0, 0], "reach": 0.0}]), &["reach = 0 must be a positive number"]);
    for text in [
        "",
        "{}",
        "[]",
        "{\"format\":\"fairpath-spline\",\"version\":1,\"edits\":[]}",
        "{\"format\":\"fairpath-edits\",\"version\":2,\"edits\":[]}",
    ] {
        write(folder.path(), "edits.json", text);
        run_in(folder.path(), &["edit", "curves.json", "edits.json", "-o", "no.json"]).ended(2);
    }
}
