//! How runs end, and what they leave.

use std::fs;

use super::{BEND, DOT, folder, read_json, run, run_in, run_with, strokes};

#[test]
fn help_and_version_are_no_errors() {
    for args in [&["--help"][..], &["fit", "--help"], &["convert", "-h"], &["--version"], &["help", "fit"]] {
        let ran = run(args).ended(0);
        assert!(!ran.out.is_empty() && ran.err.is_empty());
    }
}

#[test]
fn a_dot_fails_and_the_other_strokes_are_written() {
    let folder = folder();
    fs::write(folder.path().join("in.json"), strokes(&[("first", BEND), ("dot", DOT), ("last", BEND)])).unwrap();
    let ran = run_in(folder.path(), &["fit", "in.json", "-o", "out.json"]).ended(1);
    assert!(ran.err.contains("dot: "), "{}", ran.err);
    let file = read_json(&folder.path().join("out.json"));
    let names: Vec<_> = file["splines"].as_array().unwrap().iter().map(|spline| &spline["name"]).collect();
    assert_eq!(names, ["first", "last"]);
    assert_eq!(file["failures"][0]["name"], "dot");
    assert_eq!(file["failures"][0]["code"], "too-short");
    assert_eq!(file["failures"].as_array().unwrap().len(), 1);
}

#[test]
fn only_dots_still_make_a_file_and_a_table() {
    let dots = strokes(&[("dot", DOT)]);
    let ran = run_with(dots.as_bytes(), &["fit", "-", "-o", "-", "--format", "json"]).ended(1);
    assert_eq!(ran.json()["splines"].as_array().unwrap().len(), 0);
    let ran = run_with(dots.as_bytes(), &["fit", "-"]).ended(1);
    assert!(ran.text().contains("failed: too-short"), "{}", ran.text());
}

#[test]
fn the_table_has_a_line_for_each_stroke() {
    let ran = run(&["fit", "examples/hello.json"]).ended(0);
    let lines: Vec<&str> = ran.text().lines().collect();
    assert_eq!(lines.len(), 6, "{}", ran.text());
    assert!(lines[0].starts_with("stroke") && lines[1].starts_with("hello") && lines[5].starts_with("bend"));
}

#[test]
fn statistics_are_one_json_document() {
    let file = run(&["fit", "examples/hello.json", "--stats", "json"]).ended(0).json();
    let strokes = file["strokes"].as_array().unwrap();
    assert_eq!(strokes.len(), 5);
    for stroke in strokes {
        let ms = &stroke["report"]["ms"];
        assert!(ms["total"].as_f64().unwrap() > 0.0, "{stroke}");
        for step in ["preprocess", "candidates", "graph", "search", "merge"] {
            assert!(ms[step].as_f64().is_some_and(|ms| ms >= 0.0), "{stroke}");
        }
        assert!(stroke["segments"].as_u64().unwrap() > 0 && stroke.get("joins").is_none());
    }
}

#[test]
fn parameters_are_listed_with_the_values_of_the_other_options() {
    let ran = run(&["fit", "--list-parameters", "--set", "closing_gap=17.25", "--pixel-size", "0.5", "--closed", "no"]);
    let text = ran.ended(0).text().to_owned();
    let line = |name: &str| text.lines().find(|line| line.starts_with(&format!("{name} = "))).unwrap().to_owned();
    assert!(line("closing_gap").contains("= 17.25 ") && line("closing_gap").contains("[px]"));
    assert!(line("pixel_size").contains("= 0.5 "));
    assert!(line("closed").contains("= no ") && line("closed").contains("auto | yes | no"));
}

#[test]
fn strict_tells_of_missed_tolerances_and_only_strict_does() {
    // Tremor of a third of a pixel cannot be kept within a thousandth by anything fair.
    let args = ["fit", "examples/spiral.csv", "--set", "max_error=0.001"];
    run(&args).ended(0);
    let ran = run(&[&args[..], &["--strict"]].concat()).ended(1);
    assert!(ran.err.contains("max_error"), "{}", ran.err);
    let straight = strokes(&[("straight", &[[0.0, 0.0], [50.0, 0.0], [100.0, 0.0]])]);
    run_with(straight.as_bytes(), &["fit", "-", "--strict"]).ended(0);
}

#[test]
fn the_same_name_in_two_inputs_is_told_apart() {
    let folder = folder();
    for name in ["one.json", "two.json"] {
        fs::write(folder.path().join(name), strokes(&[("a", BEND)])).unwrap();
    }
    let ran = run_in(folder.path(), &["fit", "one.json", "two.json", "-o", "out.json"]).ended(0);
    assert!(ran.err.contains('a'), "the renaming is told");
    let file = read_json(&folder.path().join("out.json"));
    assert_eq!(file["splines"].as_array().unwrap().len(), 2);
    assert_ne!(file["splines"][0]["name"], file["splines"][1]["name"]);
}

#[test]
fn hostile_names_stay_inside_the_folder_and_off_the_terminal() {
    let folder = folder();
    let hostile = "../../etc/\u{1b}[31mpass wd";
    fs::write(folder.path().join("in.json"), strokes(&[(hostile, BEND)])).unwrap();
    let ran = run_in(folder.path(), &["fit", "in.json", "--stages", "steps"]).ended(0);
    assert!(!ran.text().contains('\u{1b}'));
    for entry in fs::read_dir(folder.path().join("steps")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(name.starts_with("001-.._.._etc_"), "{name}");
    }
}

#[test]
fn a_file_in_millimetres_has_pixels_of_a_hundredth_inch() {
    let folder = folder();
    let px = strokes(&[("a", BEND)]);
    fs::write(folder.path().join("in.json"), px.replacen('{', r#"{"unit":"mm","#, 1)).unwrap();
    run_in(folder.path(), &["fit", "in.json", "-o", "out.json", "--no-times"]).ended(0);
    run_in(folder.path(), &["fit", "in.json", "-o", "same.json", "--no-times", "--pixel-size", "0.254"]).ended(0);
    let [out, same] = ["out.json", "same.json"].map(|name| fs::read(folder.path().join(name)).unwrap());
    assert_eq!(out, same);
    assert_eq!(read_json(&folder.path().join("out.json"))["unit"], "mm");
}
