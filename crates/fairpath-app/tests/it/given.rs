//! Files that are given when the application starts.

use crate::hands::{arch, draw, session};
use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::Harness;
use fairpath_app::{App, FileStore, GivenFile, InlineWorker};
use fairpath_sketch::encode_drawing;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name)
}

/// The application as it starts with files, keeping its drawing there.
fn app_on<'a>(files: &[&Path], kept: &Path) -> Harness<'a, App> {
    let files: Vec<GivenFile> = files.iter().map(|path| GivenFile::read(path).unwrap()).collect();
    let store = Box::new(FileStore::at(kept.to_owned()));
    let size = vec2(1000.0, 700.0);
    let mut harness = Harness::builder().with_size(size).with_max_steps(20).build_eframe(|creation| {
        let mut app = App::new(&creation.egui_ctx, Box::<InlineWorker>::default(), store);
        app.open_given(&creation.egui_ctx, &files, size);
        app
    });
    harness.run_steps(3);
    harness
}

#[test]
fn strokes_and_curves_that_are_given_are_all_that_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let harness = app_on(&[&example("spiral.csv"), &example("leaf.svg")], &folder.path().join("kept.json"));
    let names: Vec<&str> = session(&harness).drawing().curves().iter().map(|curve| curve.name.as_str()).collect();
    assert!(names.contains(&"spiral") && names.len() > 1, "{names:?}");
    assert!(session(&harness).drawing().curves().iter().all(|curve| curve.fitted));
    assert!(!names.contains(&"h"), "the drawing of a first start is not among them");
}

#[test]
fn a_drawing_that_is_given_is_gone_on_with_and_undo_leads_to_the_last_one() {
    let folder = tempfile::tempdir().unwrap();
    let kept = folder.path().join("kept.json");
    let mut first = app_on(&[&example("spiral.csv")], &kept);
    let given = folder.path().join("given.json");
    fs::write(&given, encode_drawing(session(&first).drawing()).unwrap()).unwrap();
    draw(&mut first, &arch(300.0, 300.0, 80.0));
    first.state_mut().keep_now();
    let last = session(&first).drawing().clone();
    drop(first);

    for file in [given, example("leaf.svg")] {
        let mut second = app_on(&[&file], &kept);
        assert!(*session(&second).drawing() != last);
        for _ in 0..2 {
            if *session(&second).drawing() != last {
                second.key_press_modifiers(Modifiers::COMMAND, Key::Z);
                second.run_steps(2);
            }
        }
        assert!(*session(&second).drawing() == last, "undo leads back to what was kept");
    }
}

#[test]
fn curves_that_are_found_for_a_first_drawing_do_not_change_it() {
    let app = crate::hands::app();
    assert!(session(&app).drawing().curves().iter().all(|curve| curve.fitted));
    assert_eq!(app.state().title(), "drawing – Fairpath");
}

#[test]
fn the_title_tells_whether_the_file_differs_from_what_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let given = folder.path().join("given.json");
    let first = app_on(&[&example("spiral.csv")], &folder.path().join("kept.json"));
    fs::write(&given, encode_drawing(session(&first).drawing()).unwrap()).unwrap();
    let mut app = app_on(&[&given], &folder.path().join("other.json"));
    assert_eq!(app.state().title(), "given – Fairpath");
    draw(&mut app, &arch(300.0, 300.0, 80.0));
    assert_eq!(app.state().title(), "given* – Fairpath");
    for (key, title) in [(Key::Z, "given – Fairpath"), (Key::Y, "given* – Fairpath"), (Key::Z, "given – Fairpath")]
    {
        app.key_press_modifiers(Modifiers::COMMAND, key);
        app.run_steps(2);
        assert_eq!(app.state().title(), title, "after {key:?}");
    }
}

#[test]
fn a_picture_that_is_given_is_traced_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    image::RgbImage::from_pixel(40, 20, image::Rgb([200, 10, 10])).save(&path).unwrap();
    let harness = app_on(&[&path], &folder.path().join("kept.json"));
    let background = session(&harness).drawing().background.clone().expect("there is a picture");
    assert!((background.width - 800.0).abs() < 1.0, "it fills most of the canvas: {}", background.width);
}

#[test]
fn what_cannot_be_shown_is_refused_before_there_is_a_window() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let png = b"\x89PNG\r\n\x1a\nno picture";
    let files = [
        folder.path().join("absent.json"),
        folder.path().to_owned(),
        write("half.json", b"{\"format\":\"fairpath-drawing\","),
        write("prose.json", b"no strokes at all"),
        write("broken.png", png),
    ];
    for file in files {
        // There is no display, so that a window would be another failure.
        let mut command = Command::new(env!("CARGO_BIN_EXE_fairpath-app"));
        command.args([&example("hello.json"), &file]).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        let ran = command.output().unwrap();
        let told = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(2), "{told}");
        assert!(told.contains(&file.display().to_string()), "the message names the file: {told}");
        assert!(ran.stdout.is_empty());
    }
}

#[test]
fn help_tells_what_can_be_given() {
    let ran = Command::new(env!("CARGO_BIN_EXE_fairpath-app")).arg("--help").output().unwrap();
    let told = String::from_utf8_lossy(&ran.stdout).into_owned();
    assert_eq!(ran.status.code(), Some(0));
    for word in ["[FILE]...", "--kept <FILE>", "--pace <FILE>", "Exit codes"] {
        assert!(told.contains(word), "{word} is missing: {told}");
    }
    let unknown = Command::new(env!("CARGO_BIN_EXE_fairpath-app")).arg("--unknown").output().unwrap();
    assert_eq!(unknown.status.code(), Some(2));
}
