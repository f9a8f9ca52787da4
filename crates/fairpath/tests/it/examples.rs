//! The examples of the README, run for real.

use std::fs;

use super::{folder, read_json, root, run};

const INPUTS: &[(&str, usize)] =
    &[("hello.json", 5), ("duck.json", 1), ("leaf.svg", 2), ("spiral.csv", 2), ("note.inkml", 2)];

#[test]
fn every_example_becomes_every_format() {
    let folder = folder();
    for (input, strokes) in INPUTS {
        let input = format!("examples/{input}");
        for extension in ["json", "svg", "dxf", "csv", "png"] {
            let out = folder.path().join(format!("out.{extension}"));
            run(&["fit", &input, "-o", out.to_str().unwrap()]).ended(0);
            let bytes = fs::read(&out).unwrap();
            match extension {
                "json" => {
                    let file = read_json(&out);
                    assert_eq!((&file["format"], &file["version"]), (&"fairpath-spline".into(), &1.into()));
                    assert_eq!(file["splines"].as_array().unwrap().len(), *strokes, "{input}");
                    assert_eq!(file["failures"].as_array().unwrap().len(), 0, "{input}");
                }
                "svg" => assert!(String::from_utf8(bytes).unwrap().contains("<svg")),
                "dxf" => assert!(String::from_utf8(bytes).unwrap().trim_end().ends_with("EOF")),
                "csv" => assert!(String::from_utf8(bytes).unwrap().contains("kappa1")),
                _ => assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n")),
            }
        }
    }
}

#[test]
fn every_preset_fits_every_example() {
    for (input, strokes) in INPUTS {
        for preset in ["default", "accurate", "loose", "lines-arcs", "polyline", "clothoids"] {
            let input = format!("examples/{input}");
            let file = run(&["fit", &input, "--preset", preset, "-o", "-", "--format", "json"]).ended(0).json();
            assert_eq!(file["splines"].as_array().unwrap().len(), *strokes, "{input} {preset}");
            for spline in file["splines"].as_array().unwrap() {
                assert_eq!(spline["method"], "shortest-path");
                for segment in spline["segments"].as_array().unwrap() {
                    let forbidden: &[&str] = match preset {
                        "lines-arcs" => &["clothoid"],
                        "polyline" => &["arc", "clothoid"],
                        _ => &[],
                    };
                    assert!(!forbidden.contains(&segment["kind"].as_str().unwrap()), "{input} {preset}");
                }
            }
        }
    }
}

#[test]
fn converting_there_and_back_keeps_every_bit() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    run(&["fit", "examples/hello.json", "-o", &path("a.json")]).ended(0);
    for via in ["b.json", "b.svg", "b.csv"] {
        run(&["convert", &path("a.json"), "-o", &path(via)]).ended(0);
        run(&["convert", &path(via), "-o", &path("c.json")]).ended(0);
        let [a, c] = ["a.json", "c.json"].map(|name| read_json(&folder.path().join(name)));
        for (a, c) in a["splines"].as_array().unwrap().iter().zip(c["splines"].as_array().unwrap()) {
            for key in ["name", "closed", "segments", "joins"] {
                assert_eq!(a[key], c[key], "{key} through {via}");
            }
        }
    }
    for only_written in ["d.dxf", "d.png"] {
        run(&["convert", &path("a.json"), "-o", &path(only_written)]).ended(0);
        run(&["convert", &path(only_written), "-o", &path("e.json")]).ended(2);
    }
}

#[test]
fn pictures_show_strokes_and_curves() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let args = ["fit", "examples/hello.json", "-o", &path("out.json"), "--picture", &path("comb.svg")];
    run(&args).ended(0);
    assert!(fs::read_to_string(folder.path().join("comb.svg")).unwrap().contains("<svg"));
    run(&["fit", "examples/hello.json", "--picture", &path("comb.png")]).ended(0);
    assert!(fs::read(folder.path().join("comb.png")).unwrap().starts_with(b"\x89PNG"));
    run(&["fit", "examples/hello.json", "--stages", &path("steps")]).ended(0);
    assert!(fs::read_dir(folder.path().join("steps")).unwrap().count() >= 5);
}

#[test]
fn standard_input_is_read_by_content() {
    for (input, strokes) in INPUTS {
        let bytes = fs::read(root().join("examples").join(input)).unwrap();
        let file = super::run_with(&bytes, &["fit", "-", "-o", "-", "--format", "json"]).ended(0).json();
        assert_eq!(file["splines"].as_array().unwrap().len(), *strokes, "{input}");
    }
}

#[test]
fn every_command_of_the_readme_runs() {
    let folder = folder();
    fs::create_dir(folder.path().join("examples")).unwrap();
    for (input, _) in INPUTS {
        fs::copy(root().join("examples").join(input), folder.path().join("examples").join(input)).unwrap();
    }
    fs::create_dir(folder.path().join("examples/drive")).unwrap();
    let network = "examples/drive/interchange.json";
    fs::copy(root().join(network), folder.path().join(network)).unwrap();
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let code = readme.split("```sh").skip(1).filter_map(|rest| rest.split("```").next());
    let mut count = 0;
    for line in code.flat_map(str::lines) {
        let line = line.split(" #").next().unwrap_or_default().trim();
        let arguments = line.strip_prefix("cargo run --release -- ").or_else(|| line.strip_prefix("fairpath "));
        // An ellipsis or a word in capitals stands for something else.
        let Some(arguments) = arguments.filter(|text| !text.contains(['…', '[']) && !text.contains(" IN ")) else {
            continue;
        };
        super::run_in(folder.path(), &arguments.split_whitespace().collect::<Vec<_>>()).ended(0);
        count += 1;
    }
    assert!(count >= 8, "only {count} commands were found");
    for written in ["hello.svg", "leaf.dxf", "hello.json", "comb.svg", "steps", "interchange.glb", "interchange.xodr"] {
        assert!(folder.path().join(written).exists(), "{written}");
    }
}
