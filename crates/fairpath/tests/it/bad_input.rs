//! Whatever is wrong with arguments or input: exit code 2, a message that names the place, and nothing written.

use std::fs;

use super::{BEND, folder, run_in, run_with, strokes};

/// Fits this content under that name and gives back what was said.
#[track_caller]
fn refused(name: &str, content: &[u8]) -> String {
    let folder = folder();
    fs::write(folder.path().join(name), content).unwrap();
    let ran = run_in(folder.path(), &["fit", name, "-o", "out.json"]).ended(2);
    assert!(ran.out.is_empty());
    assert!(!folder.path().join("out.json").exists());
    assert!(ran.err.starts_with("error: ") && ran.err.contains(name), "{}", ran.err);
    ran.err
}

#[test]
fn content_of_every_broken_kind_is_refused() {
    let good = strokes(&[("a", BEND)]);
    let cases: &[(&str, &[u8])] = &[
        ("empty.json", b""),
        ("empty.csv", b""),
        ("empty.svg", b""),
        ("blank.csv", b"\n\n\n"),
        ("truncated.json", &good.as_bytes()[..good.len() / 2]),
        ("array.json", b"[1, 2, 3]"),
        ("other.json", br#"{"format":"something-else","version":1,"strokes":[]}"#),
        ("newer.json", br#"{"format":"fairpath-strokes","version":2,"strokes":[]}"#),
        ("none.json", br#"{"format":"fairpath-strokes","version":1,"strokes":[]}"#),
        ("nan.json", br#"{"format":"fairpath-strokes","version":1,"strokes":[{"name":"a","points":[[0,0],[NaN,1]]}]}"#),
        (
            "huge.json",
            br#"{"format":"fairpath-strokes","version":1,"strokes":[{"name":"a","points":[[0,0],[1e999,1]]}]}"#,
        ),
        (
            "ragged.json",
            br#"{"format":"fairpath-strokes","version":1,"strokes":[{"name":"a","points":[[0,0],[1,1,5]]}]}"#,
        ),
        ("words.json", br#"{"format":"fairpath-strokes","version":1,"strokes":[{"name":"a","points":[["x","y"]]}]}"#),
        ("nan.csv", b"0,0\nnan,1\n2,2\n"),
        ("words.csv", b"0,0\nhere,there\n"),
        ("one-column.csv", b"1\n2\n3\n"),
        (
            "latin1.json",
            b"{\"format\":\"fairpath-strokes\",\"version\":1,\"strokes\":[{\"name\":\"\xe9\",\"points\":[]}]}",
        ),
        ("binary.json", &[0, 159, 146, 150, 0, 255]),
        ("broken.svg", b"<svg xmlns='http://www.w3.org/2000/svg'><path d='M 0 0 L 10"),
        ("nothing.svg", b"<svg xmlns='http://www.w3.org/2000/svg'/>"),
        ("broken.inkml", b"<ink><trace>1 2, 3"),
        ("unknown.bin", &[1, 2, 3, 4]),
    ];
    for (name, content) in cases {
        refused(name, content);
    }
}

#[test]
fn a_bad_row_is_named_by_its_line() {
    assert!(refused("rows.csv", b"0 0\n1 1\n2 x\n").contains("line 3"));
    let json =
        "{\"format\":\"fairpath-strokes\",\n\"version\":1,\n\"strokes\":[{\"name\":\"a\",\n\"points\":[[0,0],}]}";
    assert!(refused("rows.json", json.as_bytes()).contains("line 4"));
}

#[test]
fn a_missing_file_and_a_folder_are_refused() {
    let folder = folder();
    fs::create_dir(folder.path().join("dir")).unwrap();
    for (input, said) in [("missing.json", "missing.json"), ("dir", "folder"), ("", "")] {
        let ran = run_in(folder.path(), &["fit", input, "-o", "out.json"]).ended(2);
        assert!(ran.err.contains(said), "{}", ran.err);
    }
}

#[test]
fn one_unusable_input_among_good_ones_writes_nothing() {
    let folder = folder();
    fs::write(folder.path().join("good.json"), strokes(&[("a", BEND)])).unwrap();
    fs::write(folder.path().join("bad.json"), "{").unwrap();
    let args = ["fit", "good.json", "bad.json", "-o", "out.json", "--picture", "out.svg", "--stages", "steps"];
    let ran = run_in(folder.path(), &args).ended(2);
    assert!(ran.err.contains("bad.json"), "{}", ran.err);
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "{left:?}");
}

#[test]
fn inputs_in_different_units_make_no_one_result() {
    let folder = folder();
    let px = strokes(&[("a", BEND)]);
    fs::write(folder.path().join("px.json"), &px).unwrap();
    fs::write(folder.path().join("mm.json"), px.replacen('{', r#"{"unit":"mm","#, 1)).unwrap();
    let ran = run_in(folder.path(), &["fit", "px.json", "mm.json"]).ended(2);
    assert!(
        ran.err.contains("mm.json") && ran.err.contains("px.json") && ran.err.contains("fit them apart"),
        "{}",
        ran.err
    );
}

#[test]
fn arguments_of_every_wrong_kind_are_refused() {
    let folder = folder();
    fs::write(folder.path().join("in.json"), strokes(&[("a", BEND)])).unwrap();
    fs::create_dir(folder.path().join("dir")).unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let cases: &[(&[&str], &str)] = &[
        (&[], "Usage"),
        (&["fit"], "INPUT"),
        (&["flatten", "in.json"], "unrecognized subcommand"),
        (
            &["fit", "in.json", "--method", "mvc"],
            "the method mvc is not part of this version; use shortest-path, curvature-space or french-curve",
        ),
        (
            &["fit", "in.json", "--method", "magic"],
            "there is no method of that name; use shortest-path, curvature-space or french-curve",
        ),
        (&["fit", "in.json", "--preset", "fast"], "lines-arcs"),
        (&["fit", "in.json", "--closed", "maybe"], "auto"),
        (&["fit", "in.json", "--set", "closing_gab=3"], "near it: closing_gap"),
        (&["fit", "in.json", "--set", "closing_gap"], "expected KEY=VALUE"),
        (&["fit", "in.json", "--set", "closing_gap=wide"], "expected a number"),
        (&["fit", "in.json", "--pixel-size", "0"], "expected a number above 0"),
        (&["fit", "in.json", "--pixel-size", "NaN"], "expected a number above 0"),
        (&["fit", "in.json", "--pixel-size=-1"], "expected a number above 0"),
        (&["fit", "in.json", "--threads=-1"], "threads"),
        (&["fit", "in.json", "--threads", "99999"], "threads"),
        (&["fit", "in.json", "-o", "out.doc"], "nothing is written as .doc"),
        (&["fit", "in.json", "-o", "out"], "has no extension"),
        (&["fit", "in.json", "-o", "-"], "--format"),
        (&["fit", "in.json", "-o", "dir", "--format", "json"], "this is a folder"),
        (&["fit", "in.json", "-o", "no/such/out.json"], "there is no folder"),
        (&["fit", "in.json", "-o", "file/out.json"], "there is no folder"),
        (&["fit", "in.json", "-o", "out.json", "--picture", "out.dxf"], "a picture is written as svg or png"),
        (&["fit", "in.json", "-o", "out.svg", "--picture", "out.svg"], "name the same file"),
        (&["fit", "in.json", "--stages", "file"], "expected a folder"),
        (&["fit", "in.json", "-o", "-", "--format", "json", "--stats", "json"], "standard output"),
        (&["fit", "-", "-"], "only once"),
        (&["convert", "in.json", "-o", "out.svg"], "in.json"),
        (&["convert", "missing.json", "-o", "out.svg"], "missing.json"),
        (&["convert", "in.json"], "--output"),
    ];
    for (args, said) in cases {
        let ran = run_in(folder.path(), args).ended(2);
        assert!(ran.err.contains(said), "{args:?}: {}", ran.err);
        assert!(ran.out.is_empty(), "{args:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}

#[test]
fn standard_input_is_named_in_messages() {
    let ran = run_with(b"{", &["fit", "-"]).ended(2);
    assert!(ran.err.contains("standard input"), "{}", ran.err);
    let ran = run_with(b"", &["fit", "-"]).ended(2);
    assert!(ran.err.contains("standard input") && ran.err.contains("empty"), "{}", ran.err);
}

#[cfg(unix)]
#[test]
fn a_result_that_cannot_be_written_leaves_what_was_there() {
    // A folder in the place of the temporary file cannot be had for the superuser, so a device stands in for a full disk.
    if !std::path::Path::new("/dev/full").exists() {
        return;
    }
    let folder = folder();
    fs::write(folder.path().join("in.json"), strokes(&[("a", BEND)])).unwrap();
    let ran = run_in(folder.path(), &["fit", "in.json", "-o", "/dev/full", "--format", "json"]).ended(2);
    assert!(ran.err.contains("/dev/full: cannot be written"), "{}", ran.err);
}
