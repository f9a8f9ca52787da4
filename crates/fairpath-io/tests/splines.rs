//! Splines to and from files: nothing is lost that a format can hold, and what breaks its rules is refused.

#[path = "common/shapes.rs"]
mod example;

use example::{drop_shape, entry, ribbon, shapes};
use fairpath_curve::{Continuity, Point, Segment, Similarity, Spline, Vec2};
use fairpath_fit::{Fit, FitError, Report, Warning};
use fairpath_io::{
    Encoded, Error, Failure, Milliseconds, ReadOptions, SplineEntry, SplineFile, SplineFormat, Unit, UsedPiece,
    UsedTemplates, WriteOptions, YAxis, drive_script_schema, edits_schema, encode_splines, read_splines_from,
    read_strokes_from, spline_schema, strokes_schema, templates_schema, write_splines, write_whole,
};
use std::path::Path;

fn write(file: &SplineFile, format: SplineFormat) -> Vec<u8> {
    let Encoded { bytes, .. } = encode_splines(file, format, None, &WriteOptions::default()).unwrap();
    bytes
}

fn read(bytes: &[u8], format: Option<SplineFormat>) -> Result<SplineFile, Error> {
    read_splines_from(bytes, "curves", format, &ReadOptions::default())
}

/// A file in which everything is said that can be.
fn full() -> SplineFile {
    let mut file = shapes();
    file.unit = Unit::Mm;
    file.y = YAxis::Up;
    let warnings = vec![Warning { code: "closed-by-trimming".into(), text: "the ends \"overlap\" <by> 3 px\n".into() }];
    let report =
        Report { points: 120, max_deviation: 1.7, rms_deviation: 0.1 + 0.2, cost: 1e-300, ..Report::default() };
    let ms = Milliseconds { preprocess: 0.1, total: 1.4, ..Milliseconds::default() };
    let fit = Fit { spline: ribbon((1e9 + 0.001, -1e9)), report, warnings };
    file.splines.push(SplineEntry::from_fit(
        "tricky & \"name\" ]]> \u{1} \u{ffff} é\n,;#",
        "shortest-path",
        fit,
        Some(ms),
    ));
    let transform = Similarity { mirror: true, scale: 0.254, rotation: -0.1, translation: Vec2::new(1e9, 0.1 + 0.2) };
    let piece = UsedPiece {
        template: "sickle \"é\"".into(),
        offset: 0.0,
        length: 1.0 / 3.0,
        backward: true,
        turned_over: true,
        transform,
        span: [0.0, 0.1],
    };
    let templates =
        UsedTemplates { set: "burmester".into(), pieces: vec![piece.clone(), UsedPiece { offset: 7.5, ..piece }] };
    file.splines.push(SplineEntry { templates: Some(templates), ..entry("with French curves", ribbon((0.0, 0.0))) });
    let error = FitError::TooShort { points: 3, extent: 0.0 };
    file.failures.push(Failure::from_error("dot", &error));
    file
}

#[test]
fn json_and_svg_hold_everything_to_the_last_bit() {
    let file = full();
    for format in [SplineFormat::Json, SplineFormat::Svg] {
        let bytes = write(&file, format);
        assert_eq!(read(&bytes, Some(format)).unwrap(), file, "{format:?}");
        assert_eq!(read(&bytes, None).unwrap(), file, "{format:?}");
        assert_eq!(write(&read(&bytes, None).unwrap(), format), bytes, "{format:?}");
    }
}

#[test]
fn csv_holds_names_and_splines_to_the_last_bit() {
    let file = full();
    let bytes = write(&file, SplineFormat::Csv);
    let back = read(&bytes, None).unwrap();
    assert_eq!((back.unit, back.y), (file.unit, file.y));
    let content = |f: &SplineFile| f.splines.iter().map(|e| (e.name.clone(), e.spline.clone())).collect::<Vec<_>>();
    assert_eq!(content(&back), content(&file));
    assert!(String::from_utf8(bytes).unwrap().contains("# failed: \"dot\": too-short"));
}

#[test]
fn json_looks_as_the_contract_says() {
    let text = String::from_utf8(write(&full(), SplineFormat::Json)).unwrap();
    for part in [
        r#"{"format":"fairpath-spline","version":1,"unit":"mm","y":"up","splines":[{"name":"ribbon","method":"by-hand","closed":false,"segments":[{"kind":"line","x":-40.0,"y":30.0,"heading":0.3,"length":120.0,"kappa0":0.0,"kappa1":0.0},"#,
        r#""joins":["G2","G2","G2","G2","G2","G2"]"#,
        r#""report":{"points":120,"max_deviation":1.7,"rms_deviation":0.30000000000000004,"#,
        r#""ms":{"preprocess":0.1,"candidates":0.0,"graph":0.0,"search":0.0,"merge":0.0,"total":1.4}}"#,
        r#""warnings":[{"code":"closed-by-trimming","text":"#,
        r#""template_set":"burmester","pieces":[{"template":"sickle \"é\"","offset":0.0,"length":0.3333333333333333,"backward":true,"turned_over":true,"transform":{"mirror":true,"scale":0.254,"rotation":-0.1,"x":1000000000.0,"y":0.30000000000000004},"span":[0.0,0.1]},"#,
        r#""failures":[{"name":"dot","code":"too-short","text":"#,
    ] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
}

#[test]
fn json_of_another_program_needs_no_kind_report_or_warnings() {
    let text = r#"{"format":"fairpath-spline","version":1,"splines":[{"name":"a","closed":false,"extra":1,
        "segments":[{"x":0,"y":0,"heading":0,"length":1,"kappa0":0,"kappa1":0}],"joins":[],"report":{"points":7,"newer":[1]}}]}"#;
    let file = read(text.as_bytes(), None).unwrap();
    let report = file.splines[0].report.clone().unwrap();
    assert_eq!((report.figures.points, report.ms, file.unit), (7, None, Unit::Px));
}

#[test]
fn splines_that_break_the_rules_are_refused_with_their_name_or_place() {
    let wrap = |segments: &str, joins: &str| {
        format!(
            "{{\"format\":\"fairpath-spline\",\"version\":1,\"splines\":[{{\"name\":\"it\",\"closed\":false,\"segments\":[{segments}],\"joins\":[{joins}]}}]}}"
        )
    };
    let s = r#"{"x":0,"y":0,"heading":0,"length":1,"kappa0":0,"kappa1":0}"#;
    let cases = [
        (wrap("", ""), "at least one segment"),
        (wrap(s, "\"G1\""), "spline \"it\": 1 joins for 1 segments"),
        (wrap(&format!("{s},{s}"), "\"G0\""), "spline \"it\": join 0 is declared G0"),
        (wrap(&s.replace("\"length\":1", "\"length\":-1"), ""), "length that is not positive"),
        (wrap(&s.replace("\"length\":1", "\"length\":null"), ""), "line 1"),
        (wrap(&s.replace("\"x\":0,", ""), ""), "missing field `x`"),
        (wrap(s, "\"G7\""), "G7"),
        ("{\"format\":\"fairpath-strokes\",\"version\":1}".into(), "fit them first"),
        ("<svg/>".into(), "read it as strokes and fit them"),
        ("name,index\n".into(), "expected the columns"),
        ("hello".into(), "nothing known begins"),
    ];
    for (text, expected) in cases {
        let message = read(text.as_bytes(), None).unwrap_err().to_string();
        assert!(message.contains(expected) && message.starts_with("curves: "), "{text}: {message}");
    }
    for format in [SplineFormat::Dxf, SplineFormat::Png] {
        assert!(read(b"x", Some(format)).unwrap_err().to_string().contains("only written"));
    }
}

#[test]
fn csv_that_breaks_the_rules_is_refused_with_its_line() {
    let head = "name,index,kind,x,y,heading,length,kappa0,kappa1,join\n";
    let cases = [
        ("a,0,line,0,0,0,1,0,0\n", "line 2: 9 columns"),
        ("a,1,line,0,0,0,1,0,0,\n", "line 2: segment 1"),
        ("a,0,line,0,0,0,1,0,0,\nb,1,line,1,0,0,1,0,0,\n", "line 3: segment 1 of \"b\""),
        ("a,0,line,0,nan,0,1,0,0,\n", "line 2: y is \"nan\""),
        ("a,0,line,0,0,0,1,0,0,G9\n", "line 2: join is \"G9\""),
        ("a,0,line,0,0,0,1,0,0,\na,1,line,1,0,0,1,0,0,\n", "segment 0: its join is empty"),
        ("a,0,line,0,0,0,-1,0,0,\n", "spline \"a\""),
    ];
    for (rows, expected) in cases {
        let message = read(format!("{head}{rows}").as_bytes(), Some(SplineFormat::Csv)).unwrap_err().to_string();
        assert!(message.contains(expected), "{rows}: {message}");
    }
    let mut options = ReadOptions::default();
    options.limits.max_line_bytes = 20;
    let error = read_splines_from(head.as_bytes(), "curves", None, &options).unwrap_err();
    assert!(error.to_string().contains("curves: "));
}

#[test]
fn svg_paths_follow_the_splines_within_the_tolerance() {
    let file = shapes();
    let mut options = WriteOptions::default();
    for tolerance in [1.0, 0.01, 1e-4] {
        options.svg_tolerance = tolerance;
        let svg = encode_splines(&file, SplineFormat::Svg, None, &options).unwrap().bytes;
        let mut reading = ReadOptions::default();
        reading.flatten_tolerance = 1e-4 * tolerance;
        let drawn = read_strokes_from(&svg[..], "curves", None, &reading).unwrap();
        assert_eq!(drawn.strokes.iter().map(|s| s.name.as_str()).collect::<Vec<_>>(), ["ribbon", "drop/1"]);
        for (stroke, entry) in drawn.strokes.iter().zip(&file.splines) {
            let worst = stroke.points.iter().map(|p| entry.spline.nearest(*p).distance).fold(0.0, f64::max);
            assert!(worst <= 1.001 * tolerance, "{worst} > {tolerance}");
        }
    }
}

#[test]
fn svg_shows_a_y_up_file_upright_and_reads_back_as_strokes_in_its_own_frame() {
    let mut file = shapes();
    file.y = YAxis::Up;
    let svg = write(&file, SplineFormat::Svg);
    assert!(String::from_utf8_lossy(&svg).contains("scale(1,-1)"));
    let strokes = read_strokes_from(&svg[..], "curves", None, &ReadOptions::default()).unwrap();
    assert_eq!((strokes.y, strokes.strokes[0].points[0]), (YAxis::Up, Point::new(-40.0, 30.0)));
}

#[test]
fn svg_whose_paths_were_edited_says_so() {
    let svg = String::from_utf8(write(&shapes(), SplineFormat::Svg)).unwrap();
    let edited = svg.replace("d=\"M-40,30", "d=\"M-41,30");
    assert_ne!(svg, edited);
    let back = read(edited.as_bytes(), None).unwrap();
    assert_eq!(back.splines, shapes().splines);
    assert_eq!(back.warnings[0].code, "drawing-changed");
}

#[test]
fn figures_that_json_cannot_hold_are_refused() {
    let mut file = full();
    file.splines[2].report.as_mut().unwrap().figures.cost = f64::INFINITY;
    let error = encode_splines(&file, SplineFormat::Json, None, &WriteOptions::default()).unwrap_err().to_string();
    assert!(error.contains("cost is not a finite number"), "{error}");
}

#[test]
fn tolerances_must_be_positive() {
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut options = WriteOptions::default();
        options.svg_tolerance = tolerance;
        options.dxf.tolerance = tolerance;
        for format in [SplineFormat::Svg, SplineFormat::Dxf] {
            assert!(encode_splines(&shapes(), format, None, &options).unwrap_err().to_string().contains("tolerance"));
        }
    }
}

#[test]
fn output_appears_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.json");
    write_splines(&path, &full(), None, &WriteOptions::default()).unwrap();
    let before = std::fs::read(&path).unwrap();
    // A file that cannot be written as a whole leaves the old one alone, and nothing beside it.
    let mut bad = full();
    bad.splines[2].report.as_mut().unwrap().figures.cost = f64::NAN;
    assert!(write_splines(&path, &bad, None, &WriteOptions::default()).is_err());
    assert_eq!(std::fs::read(&path).unwrap(), before);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    for wrong in [folder.path().join("missing/out.json"), folder.path().to_path_buf()] {
        let error = write_whole(&wrong, b"x").unwrap_err().to_string();
        assert!(error.contains("cannot be written"), "{error}");
    }
    let error = write_splines(&folder.path().join("out.doc"), &bad, None, &WriteOptions::default()).unwrap_err();
    assert!(error.to_string().contains(".json, .svg, .csv, .dxf or .png"));
}

#[cfg(unix)]
#[test]
fn output_follows_links_and_keeps_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (target, link) = (folder.path().join("target"), folder.path().join("link"));
    let mode = |p: &Path| std::fs::metadata(p).unwrap().permissions().mode() & 0o777;
    write_whole(&target, b"one").unwrap();
    let plain = folder.path().join("plain");
    std::fs::write(&plain, b"").unwrap();
    assert_eq!(mode(&target), mode(&plain));
    std::fs::set_permissions(&target, PermissionsExt::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    write_whole(&link, b"two").unwrap();
    assert!(link.is_symlink());
    assert_eq!((std::fs::read(&target).unwrap(), mode(&target)), (b"two".to_vec(), 0o640));
    write_whole(Path::new("/dev/null"), b"gone").unwrap();
}

#[test]
fn checked_in_schemas_are_those_of_the_code() {
    for (name, schema) in [
        ("fairpath-strokes-1", strokes_schema()),
        ("fairpath-spline-1", spline_schema()),
        ("fairpath-edits-1", edits_schema()),
        ("fairpath-templates-1", templates_schema()),
        ("fairpath-drive-script-1", drive_script_schema()),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("schemas/{name}.schema.json"));
        if std::env::var_os("UPDATE_SCHEMAS").is_some() {
            write_whole(&path, schema.as_bytes()).unwrap();
        }
        let found = std::fs::read_to_string(&path).unwrap_or_default();
        assert_eq!(found, schema, "{} is stale: run the tests once with UPDATE_SCHEMAS=1", path.display());
    }
}

#[test]
fn a_closed_spline_of_one_segment_goes_through_every_format() {
    let circle = Segment::arc(Point::ZERO, 0.0, std::f64::consts::TAU * 7.0, 1.0 / 7.0);
    let circle = Spline::new(vec![circle], vec![Continuity::G3], true).unwrap();
    let file = SplineFile { splines: vec![entry("o", circle), entry("d", drop_shape())], ..SplineFile::default() };
    for format in SplineFormat::ALL {
        let bytes = write(&file, format);
        if matches!(format, SplineFormat::Json | SplineFormat::Svg | SplineFormat::Csv) {
            assert_eq!(
                read(&bytes, Some(format)).unwrap().splines.iter().map(|e| &e.spline).collect::<Vec<_>>(),
                file.splines.iter().map(|e| &e.spline).collect::<Vec<_>>()
            );
        }
    }
}

#[test]
fn pieces_that_cannot_be_are_refused_with_their_place() {
    let text = String::from_utf8(write(&full(), SplineFormat::Json)).unwrap();
    for (good, bad, said) in [
        (r#""offset":7.5"#, r#""offset":-7.5"#, "piece 2 of \"sickle \\\"é\\\"\": expected an `offset` of at least 0"),
        (
            r#""length":0.3333333333333333"#,
            r#""length":0"#,
            "piece 1 of \"sickle \\\"é\\\"\": expected a `length` above 0",
        ),
        (r#""span":[0.0,0.1]"#, r#""span":[0.2,0.1]"#, "a `span` that does not end before it begins"),
        (r#""scale":0.254"#, r#""scale":0"#, "a `scale` above 0"),
        (r#""template_set":"burmester","#, "", "without the `template_set`"),
        (r#""scale":0.254,"#, "", "missing field `scale`"),
    ] {
        assert!(text.contains(good), "{good}");
        let error = read(text.replacen(good, bad, 1).as_bytes(), None).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    let mut file = full();
    let broken =
        file.splines.iter_mut().filter_map(|e| e.templates.as_mut()).flat_map(|t| &mut t.pieces).next().unwrap();
    broken.span[1] = f64::NAN;
    let error = encode_splines(&file, SplineFormat::Json, None, &WriteOptions::default()).unwrap_err().to_string();
    assert!(
        error.contains("\"with French curves\"") && error.contains("piece 1 has a number that is not finite"),
        "{error}"
    );
}
