//! Closed splines into surfaces.

use std::fs;

use super::{folder, run, run_in};

/// Fits an example into this folder.
fn fitted(folder: &std::path::Path, example: &str) {
    let out = folder.join("spline.json");
    run(&["fit", &format!("examples/{example}"), "-o", out.to_str().unwrap()]).ended(0);
}

#[test]
fn a_closed_curve_becomes_every_format_and_a_line_of_the_table() {
    let folder = folder();
    fitted(folder.path(), "duck.json");
    for (name, begins) in [("duck.glb", &b"glTF"[..]), ("duck.obj", b"# fairpath"), ("duck.png", b"\x89PNG")] {
        let args = ["inflate", "spline.json", "-o", name, "--set", "triangles=2000"];
        let ran = run_in(folder.path(), &args).ended(0);
        assert!(fs::read(folder.path().join(name)).unwrap().starts_with(begins), "{name}");
        let lines: Vec<Vec<&str>> = ran.text().lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!((lines.len(), lines[0][0], lines[1][0]), (2, "spline", "duck"), "{}", ran.text());
        let triangles: usize = lines[1][1].parse().unwrap();
        let vertices: usize = lines[1][2].parse().unwrap();
        // Closed and like a sphere.
        assert!((1_500..3_500).contains(&triangles) && 2 * vertices == triangles + 4, "{}", ran.text());
        assert!(lines[1][4].parse::<f64>().unwrap() > 3e6 && lines[1][5].ends_with('°'), "{}", ran.text());
    }
    let first = fs::read(folder.path().join("duck.glb")).unwrap();
    run_in(folder.path(), &["inflate", "spline.json", "-o", "again.glb", "--set", "triangles=2000"]).ended(0);
    assert_eq!(first, fs::read(folder.path().join("again.glb")).unwrap());
}

#[test]
fn standard_output_takes_the_surface_or_the_table() {
    let folder = folder();
    fitted(folder.path(), "duck.json");
    let small = ["--set", "triangles=500"];
    let ran = run_in(folder.path(), &[&["inflate", "spline.json", "-o", "-", "--format", "obj"][..], &small].concat());
    let text = ran.ended(0).text().to_owned();
    assert!(text.starts_with("# fairpath") && !text.contains("spline "), "{}", &text[..60]);
    let ran = run_in(folder.path(), &[&["inflate", "spline.json"][..], &small].concat()).ended(0);
    assert!(ran.text().starts_with("spline"));
}

#[test]
fn what_has_no_inside_fails_and_the_rest_is_written() {
    let folder = folder();
    fitted(folder.path(), "leaf.svg");
    let args = ["inflate", "spline.json", "-o", "leaf.glb", "--set", "triangles=1000"];
    let ran = run_in(folder.path(), &args).ended(1);
    assert!(ran.err.contains("midrib: the curve is open"), "{}", ran.err);
    assert!(ran.text().contains("failed: open") && folder.path().join("leaf.glb").exists());
}

#[test]
fn where_nothing_can_be_inflated_nothing_is_written() {
    let folder = folder();
    fitted(folder.path(), "spiral.csv");
    let ran = run_in(folder.path(), &["inflate", "spline.json", "-o", "out.glb"]).ended(2);
    assert!(ran.err.contains("none of its 2 splines could be inflated") && ran.out.is_empty(), "{}", ran.err);
    assert!(!folder.path().join("out.glb").exists());
}

#[test]
fn unusable_arguments_are_refused_before_the_work() {
    let folder = folder();
    fitted(folder.path(), "duck.json");
    for (args, said) in [
        (&["spline.json", "-o", "out.stl"][..], "glb, obj or png"),
        (&["spline.json", "-o", "out.json"], "nothing is written as .json"),
        (&["spline.json", "-o", "no/such/out.glb"], "make it first"),
        (&["spline.json", "--set", "triangels=5"], "near it: triangles"),
        (&["spline.json", "--set", "triangles=5"], "`triangles` is 5: expected a whole number from 100 to 1000000"),
        (&["spline.json", "--set", "triangles=2.5"], "a whole number"),
        (&["spline.json", "--set", "height=0"], "`height` is 0"),
        (&["spline.json", "--set", "accuracy=nan"], "accuracy"),
        (&["missing.json"], "missing.json"),
        (&[], "SPLINE"),
    ] {
        let ran = run_in(folder.path(), &[&["inflate"][..], args].concat()).ended(2);
        assert!(ran.err.contains(said), "{args:?}: {}", ran.err);
    }
    fs::write(folder.path().join("broken.json"), "{\"format\":\"fairpath-spline\"").unwrap();
    run_in(folder.path(), &["inflate", "broken.json", "-o", "out.glb"]).ended(2);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing was written");
}

#[test]
fn its_parameters_are_listed() {
    let ran = run(&["inflate", "--list-parameters", "--set", "height=0.5"]).ended(0);
    for line in ["triangles = 20000 ", "accuracy = 0.0005 ", "height = 0.5 "] {
        assert!(ran.text().contains(line), "{}", ran.text());
    }
}
