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
    // Tremor of a third of a pixel cannot be kept within a hundredth by anything fair.
    let args = ["fit", "examples/spiral.csv", "--set", "max_error=0.01"];
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

#[test]
fn whatever_the_strokes_are_each_appears_once_and_every_figure_is_finite() {
    let bend = |size: f64, at: f64| BEND.iter().map(|p| [at + size * p[0], size * p[1]]).collect::<Vec<_>>();
    let round = |turns: f64, radius: fn(f64) -> f64| -> Vec<[f64; 2]> {
        let angles = (0..=(turns * 40.0) as usize).map(|i| i as f64 * std::f64::consts::TAU / 40.0);
        angles.map(|a| [radius(a) * a.cos(), radius(a) * a.sin()]).collect()
    };
    let there = bend(1.0, 0.0);
    let back: Vec<[f64; 2]> = there.iter().chain(there.iter().rev()).copied().collect();
    let lists = [
        ("empty", Vec::new()),
        ("one point", vec![[1.0, 2.0]]),
        ("equal points", vec![[3.0, 3.0]; 20]),
        ("two points", vec![[0.0, 0.0], [50.0, 10.0]]),
        ("circle traced three times", round(3.0, |_| 60.0)),
        ("spiral of 20 turns", round(20.0, |a| 2.0 * a)),
        ("retraced line", back),
        ("staircase", (0_u32..80).map(|i| [f64::from(i / 2) * 3.0, f64::from(i.div_ceil(2)) * 3.0]).collect()),
        ("zigzag", (0..60).map(|i| [f64::from(i) * 3.0, f64::from(i % 2) * 20.0]).collect()),
        ("large", bend(1e3, 0.0)),
        ("immense", bend(1e300, 0.0)),
        ("tiny", bend(1e-12, 0.0)),
        ("denormal", vec![[5e-324, 0.0], [0.0, 5e-324]]),
        ("far away", bend(1.0, 1e12)),
    ];
    let borrowed: Vec<(&str, &[[f64; 2]])> = lists.iter().map(|(name, points)| (*name, points.as_slice())).collect();
    let file = run_with(strokes(&borrowed).as_bytes(), &["fit", "-", "-o", "-", "--format", "json"]).ended(1).json();
    let named = |key: &str| file[key].as_array().unwrap().iter().map(|entry| entry["name"].as_str().unwrap());
    let mut seen: Vec<&str> = named("splines").chain(named("failures")).collect();
    let mut wanted: Vec<&str> = lists.iter().map(|(name, _)| *name).collect();
    seen.sort_unstable();
    wanted.sort_unstable();
    assert_eq!(seen, wanted);
    for spline in file["splines"].as_array().unwrap() {
        for segment in spline["segments"].as_array().unwrap() {
            for key in ["x", "y", "heading", "length", "kappa0", "kappa1"] {
                // JSON has no infinity and no NaN: they would be null.
                assert!(segment[key].is_number(), "{spline}");
            }
        }
    }
}
