//! `fairpath compare`.

use crate::{folder, run_in, strokes};
use std::fs;

const BEND: &[[f64; 2]] = &[[0.0, 0.0], [20.0, 1.0], [40.0, 4.0], [60.0, 9.0], [80.0, 16.0], [100.0, 25.0]];
const LINE: &[[f64; 2]] = &[[0.0, 0.0], [20.0, 0.0], [40.0, 0.0], [60.0, 0.0]];
const DOT: &[[f64; 2]] = &[[5.0, 5.0], [5.0, 5.0]];

#[test]
fn every_method_is_compared_on_every_stroke() {
    let folder = folder();
    fs::write(folder.path().join("in.json"), strokes(&[("bend", BEND), ("line", LINE)])).unwrap();
    let ran = run_in(folder.path(), &["compare", "in.json", "-o", "out.html", "--stats", "json"]).ended(0);
    let summary = ran.json();
    let names: Vec<&str> = summary.as_array().unwrap().iter().map(|m| m["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["shortest-path", "curvature-space", "french-curve", "laplacian", "cubic", "mvc"]);
    assert!(summary.as_array().unwrap().iter().all(|m| m["fitted"] == 2 && m["ms_median"].as_f64().unwrap() > 0.0));
    let html = fs::read_to_string(folder.path().join("out.html")).unwrap();
    assert!(html.starts_with("<!doctype html>") && html.contains("curvature-space"));
}

#[test]
fn methods_and_strokes_can_be_chosen_and_drawn() {
    let folder = folder();
    fs::write(folder.path().join("in.json"), strokes(&[("bend", BEND), ("line", LINE)])).unwrap();
    let chosen = ["compare", "in.json", "--method", "cubic", "--method", "mvc", "--stroke", "line"];
    let ran = run_in(folder.path(), &chosen).ended(0);
    let first: Vec<&str> = ran.text().lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(first[..3], ["method", "cubic", "mvc"], "{}", ran.text());
    assert!(ran.text().contains("of the 1 strokes"), "{}", ran.text());
    for picture in ["out.svg", "out.png"] {
        run_in(folder.path(), &[&chosen[..], &["-o", picture]].concat()).ended(0);
        assert!(fs::metadata(folder.path().join(picture)).unwrap().len() > 1000);
    }
}

#[test]
fn a_stroke_that_no_method_fits_is_told_and_shown() {
    let folder = folder();
    fs::write(folder.path().join("in.json"), strokes(&[("bend", BEND), ("dot", DOT)])).unwrap();
    let ran = run_in(folder.path(), &["compare", "in.json", "-o", "out.html"]).ended(1);
    assert!(ran.err.contains("mvc: dot: the stroke is a dot"), "{}", ran.err);
    assert!(fs::read_to_string(folder.path().join("out.html")).unwrap().contains("the stroke is a dot"));
}

#[test]
fn what_cannot_be_compared_is_refused_and_nothing_is_written() {
    let folder = folder();
    fs::write(folder.path().join("in.json"), strokes(&[("bend", BEND)])).unwrap();
    let cases: &[(&[&str], &str)] = &[
        (&["compare"], "INPUT"),
        (&["compare", "in.json", "-o", "out.json"], "written as html, svg or png"),
        (&["compare", "in.json", "-o", "no/out.html"], "there is no folder no"),
        (&["compare", "in.json", "--stroke", "curl"], "there is no stroke of that name; the first are bend"),
        (&["compare", "in.json", "--method", "magic"], "possible values"),
        (&["compare", "in.json", "--pixel-size", "0"], "expected a number above 0"),
        (&["compare", "absent.json", "-o", "out.html"], "absent.json"),
    ];
    for (args, said) in cases {
        let ran = run_in(folder.path(), args).ended(2);
        assert!(ran.err.contains(said), "{args:?}: {}", ran.err);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
