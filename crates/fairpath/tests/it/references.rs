//! The references under `docs/` say what the program does.

use std::fs;

use super::{root, run};

#[test]
fn checked_in_references_are_not_stale() {
    for (name, text) in fairpath::reference::all() {
        let path = root().join("docs").join(&name);
        let checked_in = fs::read_to_string(&path).unwrap_or_default();
        assert!(checked_in == text, "docs/{name} is stale: run `cargo xtask generate`");
    }
}

#[test]
fn every_listed_parameter_is_in_the_reference() {
    let page = fs::read_to_string(root().join("docs/parameters.md")).unwrap();
    let list = run(&["fit", "--list-parameters"]).ended(0);
    for line in list.text().lines() {
        let name = line.split(' ').next().unwrap();
        assert!(page.contains(&format!("| `{name}` |")), "{name}");
    }
}

#[test]
fn the_reference_names_the_options_that_others_rely_on() {
    let page = fs::read_to_string(root().join("docs/command-line.md")).unwrap();
    for option in ["--method", "--preset", "--set", "--closed", "--pixel-size", "--threads", "--strict", "--picture"] {
        assert!(page.contains(option), "{option}");
    }
}
