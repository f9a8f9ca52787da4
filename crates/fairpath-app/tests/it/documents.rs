//! The drawing as a document: kept against crashes, opened, imported.

use crate::hands::{app_with, arch, draw, empty_app, session};
use eframe::egui::{Key, Modifiers};
use fairpath_app::FileStore;
use fairpath_sketch::decode_drawing;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// What is kept in a file, as soon as it holds so many curves; a thread writes it.
fn kept(path: &Path, curves: usize) -> fairpath_sketch::Drawing {
    let begun = Instant::now();
    loop {
        let drawing = fs::read(path).ok().and_then(|bytes| decode_drawing(&bytes, "kept").ok());
        if let Some(drawing) = drawing.filter(|drawing| drawing.curves().len() == curves) {
            return drawing;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing was kept");
        std::thread::yield_now();
    }
}

#[test]
fn what_was_drawn_fifteen_seconds_ago_is_offered_after_a_crash() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deep/kept.json");
    let mut first = app_with(Box::new(FileStore::at(path.clone())));
    first.state_mut().open_drawing(fairpath_sketch::Drawing::default());
    draw(&mut first, &arch(300.0, 300.0, 80.0));
    draw(&mut first, &arch(600.0, 300.0, 80.0));
    let before = session(&first).drawing().clone();
    // A step of the harness is a quarter of a second.
    first.run_steps(60);
    let on_disk = kept(&path, 2);
    assert!(on_disk == before, "what is kept is what was drawn");

    // Nobody said goodbye to the first; the second starts beside it.
    let mut second = app_with(Box::new(FileStore::at(path)));
    assert!(*session(&second).drawing() == before, "it is here again");
    second.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    second.run_steps(2);
    assert!(session(&second).drawing().curves().is_empty(), "undo leads to an empty drawing");
}

#[test]
fn a_damaged_file_is_set_aside() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.json");
    fs::write(&path, "{\"format\":\"fairpath-drawing\",").unwrap();
    let harness = app_with(Box::new(FileStore::at(path.clone())));
    assert!(session(&harness).drawing().curves().len() > 2, "the first drawing is shown instead");
    let aside = fs::read_to_string(path.with_extension("damaged.json")).unwrap();
    assert_eq!(aside, "{\"format\":\"fairpath-drawing\",");
}

#[test]
fn the_time_from_a_stroke_to_its_curve_is_noted_once() {
    let mut harness = empty_app();
    draw(&mut harness, &arch(500.0, 400.0, 120.0));
    assert!(harness.state().is_settled());
    assert_eq!(harness.state().pace().curves.count, 1);
}

#[test]
fn what_comes_back_by_redo_or_after_a_crash_was_not_drawn_and_is_not_timed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.json");
    let mut first = app_with(Box::new(FileStore::at(path.clone())));
    first.state_mut().open_drawing(fairpath_sketch::Drawing::default());
    draw(&mut first, &arch(500.0, 400.0, 120.0));
    for key in [Key::Z, Key::Y] {
        first.key_press_modifiers(Modifiers::COMMAND, key);
        first.run_steps(2);
    }
    assert_eq!(session(&first).drawing().curves().len(), 1);
    assert_eq!(first.state().pace().curves.count, 1);
    first.state_mut().keep_now();
    kept(&path, 1);

    let second = app_with(Box::new(FileStore::at(path)));
    assert_eq!(session(&second).drawing().curves().len(), 1);
    assert_eq!(second.state().pace().curves.count, 0);
}
