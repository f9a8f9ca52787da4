//! Files dropped on the window: each becomes what it is, and rubbish changes nothing.

use crate::hands::{arch, draw, empty_app, session};
use eframe::egui::DroppedFile;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use fairpath_app::App;
use fairpath_fit::CurveEnd;
use fairpath_io::{Edit, SplineFormat, StrokeFormat, Unit, encode_splines, encode_strokes, encode_templates};
use fairpath_sketch::{encode_drawing, splines_of, strokes_of};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file that lies nowhere.
#[derive(Debug)]
struct File {
    path: PathBuf,
    bytes: Result<Vec<u8>, String>,
}

impl DroppedFile for File {
    fn path(&self) -> &Path {
        &self.path
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        self.bytes.clone()
    }
}

fn drop_file(app: &mut Harness<'_, App>, name: &str, bytes: Result<Vec<u8>, String>) {
    let path = Path::new("/somewhere").join(name);
    app.input_mut().dropped_files.push(Arc::new(File { path, bytes }));
    app.run_steps(3);
}

fn curves(app: &Harness<'_, App>) -> usize {
    session(app).drawing().curves().len()
}

/// An application in which one arch was drawn.
fn with_arch<'a>() -> Harness<'a, App> {
    let mut app = empty_app();
    draw(&mut app, &arch(500.0, 350.0, 120.0));
    app
}

#[test]
fn strokes_become_curves_and_curves_come_as_they_are() {
    let source = with_arch();
    let drawing = session(&source).drawing().clone();
    let strokes = strokes_of(&drawing);
    let splines = splines_of(&drawing);
    let mut files = vec![("drawing.json", encode_drawing(&drawing).unwrap())];
    for (name, format) in [("a.json", StrokeFormat::Json), ("a.svg", StrokeFormat::Svg), ("a.csv", StrokeFormat::Text)]
    {
        files.push((name, encode_strokes(&strokes, format).unwrap()));
    }
    for (name, format) in [("b.json", SplineFormat::Json), ("b.svg", SplineFormat::Svg), ("b.csv", SplineFormat::Csv)] {
        files.push((name, encode_splines(&splines, format, None, &Default::default()).unwrap().bytes));
    }
    let ink = r#"<ink xmlns="http://www.w3.org/2003/InkML"><trace>10 0, 60 30, 120 40, 180 30</trace></ink>"#;
    let gpx = r#"<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg><trkpt lat="42.5" lon="1.5"/>
        <trkpt lat="42.501" lon="1.501"/><trkpt lat="42.5" lon="1.503"/></trkseg></trk></gpx>"#;
    let geo = r#"{"type":"LineString","coordinates":[[1.5,42.5],[1.501,42.501],[1.503,42.5]]}"#;
    files.extend([("c.inkml", ink.into()), ("c.gpx", gpx.into()), ("c.geojson", geo.into())]);
    for (name, bytes) in files {
        let mut app = empty_app();
        drop_file(&mut app, name, Ok(bytes));
        assert_eq!(curves(&app), 1, "{name}");
        assert!(session(&app).drawing().curves()[0].fitted, "{name}");
        app.get_by_label_contains(&format!("1 curve from {name}"));
        app.state_mut().session_mut().undo();
        app.run_steps(2);
        assert_eq!(curves(&app), 0, "{name} can be undone");
    }
}

#[test]
fn a_curve_that_went_out_and_came_back_is_the_same() {
    let mut app = with_arch();
    let before = session(&app).drawing().curves()[0].spline.clone();
    let file = splines_of(session(&app).drawing());
    for format in [SplineFormat::Json, SplineFormat::Svg, SplineFormat::Csv] {
        let bytes = encode_splines(&file, format, None, &Default::default()).unwrap().bytes;
        drop_file(&mut app, &format!("arch.{}", format.extension()), Ok(bytes));
        assert_eq!(session(&app).drawing().curves().last().unwrap().spline, before, "{format:?}");
    }
}

#[test]
fn french_curves_are_chosen_at_once_and_neaten_the_next_stroke() {
    let mut app = empty_app();
    let set = fairpath_io::shipped_templates("burmester").unwrap();
    let renamed = fairpath_fit::TemplateSet::new("workshop", set.templates().to_vec()).unwrap();
    drop_file(&mut app, "workshop.json", Ok(encode_templates(&renamed).unwrap()));
    assert_eq!(curves(&app), 0);
    assert_eq!(session(&app).neatening().templates, "workshop");
    assert_eq!(session(&app).drawing().template_sets.len(), 1);
    app.get_by_label_contains("French curves in \"workshop\"");
}

#[test]
fn edits_are_made_on_the_curves_that_are_there() {
    let mut app = with_arch();
    let name = session(&app).drawing().curves()[0].name.clone();
    let before = session(&app).drawing().curves()[0].spline.length();
    let edit = Edit::Extend { spline: Some(name.clone()), end: CurveEnd::End, length: 50.0, how: Default::default() };
    let file = serde_json::json!({"format": "fairpath-edits", "version": 1, "edits": [edit]});
    drop_file(&mut app, "edits.json", Ok(file.to_string().into_bytes()));
    assert!((session(&app).drawing().curves()[0].spline.length() - before - 50.0).abs() < 1e-9);
    assert_eq!(session(&app).history().undoable(), Some("Edits"));
    let wrong = file.to_string().replace(&name, "nobody");
    let drawing = session(&app).drawing().clone();
    drop_file(&mut app, "wrong.json", Ok(wrong.into_bytes()));
    assert!(*session(&app).drawing() == drawing, "all or none");
    app.get_by_label_contains("wrong.json: edit 1 (extend): there is no spline \"nobody\"");
}

#[test]
fn a_picture_is_traced_over() {
    let mut app = empty_app();
    let png = include_bytes!("../../../../docs/app-dark.png");
    drop_file(&mut app, "map.png", Ok(png.to_vec()));
    let picture = session(&app).drawing().background.clone().expect("it lies behind the drawing");
    assert_eq!(picture.name, "map.png");
    assert!(picture.is_valid());
    app.get_by_label("Move and fade the picture");
}

#[test]
fn rubbish_is_named_and_changes_nothing() {
    for (name, bytes) in [
        ("rubbish.json", Ok(b"{\"format\": \"fairpath-strokes\", \"version\": 1, ".to_vec())),
        ("rubbish.svg", Ok(b"<svg><path d=\"M 0 0 L".to_vec())),
        ("nothing.csv", Ok(Vec::new())),
        ("infinite.csv", Ok(b"0 0\ninf 1\n2 nan\n".to_vec())),
        ("templates.json", Ok(b"{\"format\": \"fairpath-templates\", \"version\": 9}".to_vec())),
        (
            "edits.json",
            Ok(b"{\"format\": \"fairpath-edits\", \"version\": 1, \"edits\": [{\"do\": \"fly\"}]}".to_vec()),
        ),
        ("picture.png", Ok(b"\x89PNG\r\n\x1a\n".to_vec())),
        ("gone.svg", Err("the disk is gone".to_owned())),
    ] {
        let mut app = with_arch();
        let before = session(&app).drawing().clone();
        drop_file(&mut app, name, bytes);
        assert!(*session(&app).drawing() == before, "{name}");
        app.get_by_label_contains(name);
    }
}

#[test]
fn the_unit_of_an_exported_drawing_is_that_of_the_drawing() {
    let mut app = with_arch();
    let px = session(&app).drawing().curves()[0].spline.length();
    app.state_mut().session_mut().measure_in(Unit::Mm);
    app.run_steps(2);
    let file = splines_of(session(&app).drawing());
    assert_eq!(file.unit, Unit::Mm);
    assert!((file.splines[0].spline.length() - 0.254 * px).abs() < 1e-9 * px);
    app.state_mut().session_mut().undo();
    assert_eq!(session(&app).drawing().curves()[0].spline.length(), px);
}
