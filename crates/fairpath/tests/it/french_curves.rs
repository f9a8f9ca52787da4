//! French curves on the command line: fitting with them, and sets of them listed, authored and drawn.

use std::fs;

use serde_json::{Value, json};

use super::{BEND, folder, read_json, run, run_in, run_with, strokes};

/// The templates of the pieces of every spline.
fn templates_used(file: &Value) -> Vec<String> {
    let splines = file["splines"].as_array().expect("splines").iter();
    let pieces = splines.flat_map(|spline| spline["pieces"].as_array().expect("every spline tells its pieces").iter());
    pieces.map(|piece| piece["template"].as_str().expect("a name").to_owned()).collect()
}

#[test]
fn the_result_tells_which_part_of_which_template_lies_where() {
    let file = run(&["fit", "examples/hello.json", "--method", "french-curve", "-o", "-", "--format", "json"]);
    let file = file.ended(0).json();
    for spline in file["splines"].as_array().unwrap() {
        assert_eq!((&spline["method"], &spline["template_set"]), (&"french-curve".into(), &"burmester".into()));
        let segments = spline["segments"].as_array().unwrap();
        let length: f64 = segments.iter().map(|segment| segment["length"].as_f64().unwrap()).sum();
        for piece in spline["pieces"].as_array().unwrap() {
            let number = |key: &str| piece[key].as_f64().unwrap_or_else(|| panic!("{key} is missing"));
            assert!(number("offset") >= 0.0 && number("length") > 0.0);
            assert!(piece["backward"].is_boolean() && piece["turned_over"].is_boolean());
            let [from, to] = [0, 1].map(|i| piece["span"][i].as_f64().unwrap());
            assert!(-1e-6 <= from && from <= to && to <= 2.0 * length, "{from} to {to} of {length}");
            for key in ["scale", "rotation", "x", "y"] {
                assert!(piece["transform"][key].is_number(), "{key}");
            }
        }
    }
    let used = templates_used(&file);
    assert!(!used.is_empty());
    assert!(used.iter().all(|name| ["sickle", "horn", "scroll", "pear"].contains(&name.as_str())), "{used:?}");
}

#[test]
fn every_shipped_set_can_be_chosen_and_the_same_set_as_a_file_gives_the_same_bytes() {
    let folder = folder();
    let args = |set: &str, out: &str| {
        let out = ["fit", "bend.json", "--method", "french-curve", "--no-times", "-o", out, "--templates", set];
        out.map(str::to_owned)
    };
    fs::write(folder.path().join("bend.json"), strokes(&[("bend", BEND)])).unwrap();
    for set in ["burmester", "rectilinear", "automotive"] {
        let fit = |set: &str, out: &str| {
            let args = args(set, out);
            run_in(folder.path(), &args.each_ref().map(String::as_str)).ended(0);
        };
        fit(set, "by-name.json");
        run_in(folder.path(), &["templates", set, "-o", "set.json"]).ended(0);
        fit("set.json", "by-file.json");
        assert_eq!(
            fs::read(folder.path().join("by-name.json")).unwrap(),
            fs::read(folder.path().join("by-file.json")).unwrap(),
            "{set}"
        );
        assert_eq!(read_json(&folder.path().join("by-name.json"))["splines"][0]["template_set"], set);
    }
}

#[test]
fn a_set_is_authored_from_fitted_splines_and_used() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    run(&["fit", "examples/hello.json", "-o", &path("hello-splines.json")]).ended(0);
    run(&["templates", &path("hello-splines.json"), "-o", &path("mine.json"), "--name", "mine"]).ended(0);
    let set = read_json(&folder.path().join("mine.json"));
    assert_eq!(
        (&set["format"], &set["unit"], &set["name"]),
        (&"fairpath-templates".into(), &"px".into(), &"mine".into())
    );
    let spline = read_json(&folder.path().join("hello-splines.json"));
    for (template, spline) in set["templates"].as_array().unwrap().iter().zip(spline["splines"].as_array().unwrap()) {
        assert_eq!((&template["name"], &template["segments"]), (&spline["name"], &spline["segments"]));
    }
    // A stroke along one of them is that template, nearly whole.
    run(&[
        "fit",
        "examples/hello.json",
        "--method",
        "french-curve",
        "--templates",
        &path("mine.json"),
        "-o",
        &path("out.json"),
    ])
    .ended(0);
    let out = read_json(&folder.path().join("out.json"));
    assert_eq!(out["splines"][0]["template_set"], "mine");
    // Half the pixel makes the template twice as long in px.
    run(&["templates", &path("hello-splines.json"), "-o", &path("half.json"), "--pixel-size", "0.5"]).ended(0);
    let length = |set: &Value| set["templates"][0]["segments"][0]["length"].as_f64().unwrap();
    assert_eq!(length(&read_json(&folder.path().join("half.json"))), 2.0 * length(&set));
}

#[test]
fn a_drawing_becomes_a_set() {
    let svg = br#"<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200">
        <path id="arch" d="M0 100A100 100 0 0 1 200 100"/><rect width="5" height="5"/></svg>"#;
    let listed = run_with(svg, &["templates", "-"]).ended(0);
    assert!(listed.err.contains("1 <rect> left out"), "{}", listed.err);
    let row = listed.text().lines().nth(1).unwrap();
    assert_eq!(
        row.split_whitespace().collect::<Vec<_>>(),
        ["arch", "standard", "input", "no", "1", "314.2", "100.0", "0"]
    );
}

#[test]
fn sets_are_listed_with_their_figures() {
    let table = run(&["templates"]).ended(0);
    let text = table.text();
    for part in ["sickle", "right angle", "circle 12.5", "burmester", "rectilinear", "automotive"] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    let only = run(&["templates", "rectilinear"]).ended(0);
    let step = only.text().lines().find(|line| line.starts_with("step")).expect("the step is listed").to_owned();
    assert_eq!(step.split_whitespace().collect::<Vec<_>>(), ["step", "rectilinear", "no", "3", "2100.0", "-", "2"]);
}

#[test]
fn sets_and_pieces_are_drawn() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    run(&["templates", "-o", &path("sets.svg")]).ended(0);
    assert!(fs::read_to_string(folder.path().join("sets.svg")).unwrap().contains("<svg"));
    run(&["templates", "burmester", "--comb", "-o", &path("set.png")]).ended(0);
    assert!(fs::read(folder.path().join("set.png")).unwrap().starts_with(b"\x89PNG"));
    let shown = [
        "fit",
        "examples/hello.json",
        "--method",
        "french-curve",
        "--picture",
        &path("pieces.svg"),
        "--templates-shown",
    ];
    run(&shown).ended(0);
    let picture = fs::read_to_string(folder.path().join("pieces.svg")).unwrap();
    assert!(picture.contains("clip-path=\"url(#drawing)\"") && picture.contains("clip-path=\"url(#legend)\""));
}

#[test]
fn the_picture_in_the_docs_is_what_the_command_draws() {
    let drawn = run(&["templates", "-o", "-", "--format", "svg"]).ended(0);
    assert!(drawn.out == fs::read(super::root().join("docs/templates.svg")).unwrap());
}

#[test]
fn what_cannot_be_is_refused_with_its_place_and_nothing_is_written() {
    let folder = folder();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let segment = json!({"x": 0, "y": 0, "heading": 0, "length": 10, "kappa0": 0, "kappa1": 0});
    let template = |name: &str| json!({"name": name, "closed": false, "segments": [segment], "joins": []});
    let set =
        |templates: &[Value]| json!({"format": "fairpath-templates", "version": 1, "templates": templates}).to_string();
    write("bend.json", &strokes(&[("bend", BEND)]));
    write("twice.json", &set(&[template("a"), template("a"), template("")]));
    write("none.json", &set(&[]));
    write("cut.json", &set(&[template("a")])[..80]);
    write("good.json", &set(&[template("a")]));
    fs::create_dir(folder.path().join("drawer")).unwrap();
    let fit = ["fit", "bend.json", "-o", "out.json", "--method", "french-curve", "--templates"];
    for (source, said) in [
        (
            "bermuda",
            "there is no such set and no such file; the sets that come along are burmester, rectilinear, automotive",
        ),
        ("absent.json", "absent.json: cannot be read"),
        ("drawer", "it is a folder"),
        ("none.json", "needs at least one"),
        ("cut.json", "line 1, column 80"),
        ("bend.json", "these are strokes"),
        ("twice.json", "twice.json: 2 problems:\n  template 2 \"a\": two French curves are called \"a\""),
        ("twice.json", "template 3 \"\": a French curve needs a name"),
    ] {
        let ran = run_in(folder.path(), &[&fit[..], &[source]].concat()).ended(2);
        assert!(ran.err.contains(said), "{} does not say {said}", ran.err);
        let ran = run_in(folder.path(), &["templates", source, "-o", "out.json"]).ended(2);
        assert!(ran.err.contains(said), "{} does not say {said}", ran.err);
    }
    for (args, said) in [
        (&["fit", "bend.json", "-o", "out.json", "--templates", "burmester"][..], "add --method french-curve"),
        (&["fit", "bend.json", "-o", "out.json", "--picture", "p.svg", "--templates-shown"], "uses no French curves"),
        (&["fit", "bend.json", "--method", "french-curve", "--templates-shown"], "--picture"),
        (&["fit", "-", "--method", "french-curve", "--templates", "-"], "standard input (-) can be read only once"),
        (&["fit", "bend.json", "--method", "french-curve", "--set", "blend=-1"], "option blend = -1 is out of range"),
        (&["templates", "good.json", "good.json", "-o", "out.json"], "two French curves are called \"a\""),
        (&["templates", "good.json", "-o", "out.dxf"], "a set is written as json, or drawn as svg or png"),
        (&["templates", "good.json", "-o", "out.json", "--comb"], "only a picture"),
        (&["templates", "good.json", "-o", "out.json", "--name", " "], "a name that is not empty"),
        (&["templates", "good.json", "--pixel-size", "0"], "expected a number above 0"),
        (&["templates", "-", "-"], "standard input (-) can be read only once"),
    ] {
        let ran = run_in(folder.path(), args).ended(2);
        assert!(ran.err.contains(said), "{args:?}: {} does not say {said}", ran.err);
    }
    assert!(!folder.path().join("out.json").exists() && !folder.path().join("out.dxf").exists());
}
