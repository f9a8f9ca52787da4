//! French curves to and from files, and the sets that come along.

#[path = "../examples/draw_templates/chain.rs"]
mod chain;
#[path = "common/shapes.rs"]
mod example;
#[path = "../examples/draw_templates/sets.rs"]
mod sets;

use example::{drop_shape, entry, ribbon, shapes};
use fairpath_curve::{Continuity, Kind, Segment, Similarity, Spline, trig::wrap_angle};
use fairpath_fit::{Template, TemplateSet};
use fairpath_io::{
    Error, SHIPPED_TEMPLATES, SplineFile, SplineFormat, TemplateFile, TemplateOptions, Unit, WriteOptions,
    encode_splines, encode_templates, read_templates, read_templates_from, shipped_templates, write_templates,
};
use std::path::Path;

fn read(bytes: impl AsRef<[u8]>) -> Result<TemplateFile, Error> {
    read_templates_from(bytes.as_ref(), "curves", &TemplateOptions::default())
}

fn shipped(name: &str) -> TemplateSet {
    shipped_templates(name).unwrap_or_else(|| panic!("{name} cannot be read"))
}

fn named<'a>(set: &'a TemplateSet, name: &str) -> &'a Template {
    set.templates().iter().find(|t| t.name() == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Largest and smallest absolute curvature of a spline.
fn curvatures(spline: &Spline) -> (f64, f64) {
    let all = || spline.segments().iter().flat_map(|s| [s.kappa0.abs(), s.kappa1.abs()]);
    let crosses = spline.segments().iter().any(Segment::has_inflection);
    (all().fold(0.0, f64::max), if crosses { 0.0 } else { all().fold(f64::INFINITY, f64::min) })
}

#[test]
fn the_shipped_files_are_what_the_program_draws() {
    let drawn = sets::all();
    assert_eq!(drawn.iter().map(TemplateSet::name).collect::<Vec<_>>(), SHIPPED_TEMPLATES);
    for set in drawn {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("templates/{}.json", set.name()));
        let found = std::fs::read(&path).unwrap();
        let stale = format!("{} is stale: run the example draw_templates", path.display());
        assert!(encode_templates(&set).unwrap() == found, "{stale}");
        assert_eq!(shipped(set.name()), set);
    }
    assert_eq!(shipped_templates("bermuda"), None);
}

#[test]
fn closed_templates_close_and_their_joins_hold_to_rounding() {
    for name in SHIPPED_TEMPLATES {
        for template in shipped(name).templates() {
            let (spline, segments) = (template.spline(), template.spline().segments());
            for (i, join) in spline.joins().iter().enumerate() {
                let (end, next) = (segments[i].end_pose(), segments[(i + 1) % segments.len()]);
                let what = format!("{name}, {}, join {i}", template.name());
                // Rounding of coordinates of a few thousand px is about 1e-12.
                assert!((end.point - next.start).hypot() < 5e-11, "{what}: {:?}", end.point - next.start);
                if *join == Continuity::G2 {
                    assert!(wrap_angle(end.heading - next.heading).abs() < 1e-12, "{what}");
                    assert!((end.curvature - next.kappa0).abs() < 1e-15, "{what}");
                }
            }
        }
    }
}

#[test]
fn burmester_curves_are_smooth_rings_with_bends_of_every_radius() {
    let set = shipped("burmester");
    assert!(set.templates().len() >= 3);
    for template in set.templates() {
        let spline = template.spline();
        assert!(spline.is_closed(), "{}", template.name());
        assert!(spline.joins().iter().all(|join| *join == Continuity::G2));
        assert!((spline.turning().abs() - std::f64::consts::TAU).abs() < 1e-12);
        assert!(spline.self_intersections().is_empty(), "{} crosses itself", template.name());
        let (tightest, flattest) = curvatures(spline);
        assert!((8.0..15.0).contains(&(1.0 / tightest)), "{}: radius {}", template.name(), 1.0 / tightest);
        assert!(flattest < 1.0 / 2000.0, "{}", template.name());
        assert!((500.0..3000.0).contains(&spline.length()));
    }
}

#[test]
fn rectilinear_templates_have_lines_and_right_angles_only() {
    let set = shipped("rectilinear");
    for template in set.templates() {
        let segments = template.spline().segments();
        assert!(segments.iter().all(|s| s.kind() == Kind::Line));
        assert!(template.spline().joins().iter().all(|join| *join == Continuity::G0));
        for pair in segments.windows(2) {
            let turn = wrap_angle(pair[1].heading - pair[0].end_heading()).abs();
            assert!((turn - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{}: {turn}", template.name());
        }
    }
    assert!(!named(&set, "line").has_corners());
    assert!(named(&set, "right angle").has_corners());
}

#[test]
fn automotive_templates_have_nothing_straight_and_no_corner() {
    let set = shipped("automotive");
    for template in set.templates() {
        let spline = template.spline();
        assert!(spline.segments().iter().all(|s| s.kind() != Kind::Line), "{}", template.name());
        assert!(spline.joins().iter().all(|join| *join >= Continuity::G2), "{}", template.name());
        let (tightest, _) = curvatures(spline);
        assert!(1.0 / tightest >= 12.4, "{}: radius {}", template.name(), 1.0 / tightest);
    }
    let circle = named(&set, "circle 50").spline();
    assert!(circle.is_closed() && circle.segments()[0].kind() == Kind::Arc);
    assert!((circle.length() - 100.0 * std::f64::consts::PI).abs() < 1e-12);
}

#[test]
fn sets_read_back_to_the_last_bit() {
    let set = TemplateSet::new(
        "tricky \"set\" é",
        vec![Template::new("a/1", ribbon((1e6 + 0.001, -0.1))).unwrap(), Template::new(" b ", drop_shape()).unwrap()],
    )
    .unwrap();
    let bytes = encode_templates(&set).unwrap();
    assert_eq!(read(&bytes).unwrap(), TemplateFile { set: set.clone(), warnings: vec![] });
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("set.json");
    write_templates(&path, &set).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), bytes);
    assert_eq!(read_templates(&path, &TemplateOptions::default()).unwrap().set, set);
    let text = String::from_utf8(bytes).unwrap();
    let head = r#"{"format":"fairpath-templates","version":1,"unit":"px","name":"tricky \"set\" é","templates":[{"name":"a/1","closed":false,"segments":[{"kind":"line","x":"#;
    assert!(text.starts_with(head), "{text}");
}

#[test]
fn splines_become_templates_of_their_names_in_px() {
    let mut file = shapes();
    for format in [SplineFormat::Json, SplineFormat::Svg, SplineFormat::Csv] {
        let bytes = encode_splines(&file, format, None, &WriteOptions::default()).unwrap().bytes;
        let set = read(&bytes).unwrap().set;
        assert_eq!(set.name(), "curves");
        for (template, entry) in set.templates().iter().zip(&file.splines) {
            assert_eq!((template.name(), template.spline()), (entry.name.as_str(), &entry.spline), "{format:?}");
        }
    }
    file.unit = Unit::Mm;
    let bytes = encode_splines(&file, SplineFormat::Json, None, &WriteOptions::default()).unwrap().bytes;
    let set = read(&bytes).unwrap().set;
    let expected = file.splines[0].spline.transformed(&Similarity::scale(1.0 / 0.254));
    assert_eq!(set.templates()[0].spline(), &expected);
    let mut options = TemplateOptions::default();
    options.pixel_size = Some(0.5);
    let set = read_templates_from(&bytes[..], "curves", &options).unwrap().set;
    assert_eq!(set.templates()[0].spline().length(), 2.0 * file.splines[0].spline.length());
    options.pixel_size = Some(0.0);
    let error = read_templates_from(&bytes[..], "curves", &options).unwrap_err().to_string();
    assert!(error.contains("pixel size") && error.contains("above 0"), "{error}");
}

#[test]
fn every_subpath_of_a_drawing_becomes_a_template() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">
        <path id="slot" d="M0 0H100A20 20 0 0 1 100 40H0A20 20 0 0 1 0 0Z M10 10L20 10"/>
        <g transform="scale(2)"><polyline id="angle" points="0,0 50,0 50,50"/></g>
        <path d="M0 0C40 0 60 60 100 60"/><rect width="3" height="4"/></svg>"#;
    let file = read(svg).unwrap();
    let names: Vec<&str> = file.set.templates().iter().map(Template::name).collect();
    assert_eq!(names, ["slot/0", "slot/1", "angle", "path/3"]);
    let spline = |name| named(&file.set, name).spline();
    assert!(spline("slot/0").is_closed());
    assert_eq!(spline("slot/0").segments()[1].kind(), Kind::Arc);
    assert_eq!(spline("angle").joins(), [Continuity::G0]);
    assert_eq!(spline("angle").length(), 200.0);
    assert!(spline("path/3").joins().iter().all(|join| *join >= Continuity::G1));
    assert_eq!(file.warnings.len(), 1, "the rectangle is named as left out");
}

#[test]
fn all_problems_are_listed_with_their_places() {
    let line =
        |x: f64, heading: f64| format!(r#"{{"x":{x},"y":0,"heading":{heading},"length":10,"kappa0":0,"kappa1":0}}"#);
    let template = |name: &str, closed: bool, segments: &[String], joins: &str| {
        format!(r#"{{"name":"{name}","closed":{closed},"segments":[{}],"joins":[{joins}]}}"#, segments.join(","))
    };
    let long = r#"{"x":0,"y":0,"heading":0,"length":1e6,"kappa0":0,"kappa1":0}"#.to_owned();
    let sharp = r#"{"x":0,"y":0,"heading":0,"length":1,"kappa0":0,"kappa1":3}"#.to_owned();
    let short = r#"{"x":0,"y":0,"heading":0,"length":-1,"kappa0":0,"kappa1":0}"#.to_owned();
    let templates = [
        template("gaps", false, &[line(0.0, 0.0), line(11.0, 0.0), line(21.0, 0.5)], r#""G1","G1""#),
        template("good", false, &[line(0.0, 0.0)], ""),
        template("good", false, &[line(0.0, 0.0)], ""),
        template("", false, &[line(0.0, 0.0)], ""),
        template("long", false, &[long], ""),
        template("sharp", false, &[sharp], ""),
        template("short", false, &[short.clone(), short], r#""G0""#),
        template("joins", true, &[line(0.0, 0.0)], ""),
        template("empty", false, &[], ""),
    ];
    let file = format!(r#"{{"format":"fairpath-templates","version":1,"templates":[{}]}}"#, templates.join(","));
    let Error::Templates { problems, .. } = read(&file).unwrap_err() else { panic!("another error") };
    let expected = [
        ("template 1 \"gaps\"", "join 0 is declared G1, but its position differs by 1e0"),
        ("template 1 \"gaps\"", "join 1 is declared G1, but its heading differs by 5e-1"),
        ("template 3 \"good\"", "two French curves are called \"good\""),
        ("template 4 \"\"", "needs a name"),
        ("template 5 \"long\"", "scale it down or divide it"),
        ("template 6 \"sharp\"", "make that bend a corner"),
        ("template 7 \"short\"", "segment 0 has"),
        ("template 7 \"short\"", "segment 1 has"),
        ("template 8 \"joins\"", "0 joins for 1 segments: 1 are needed"),
        ("template 9 \"empty\"", "at least one segment"),
    ];
    assert_eq!(problems.len(), expected.len(), "{problems:#?}");
    for (problem, (place, what)) in problems.iter().zip(expected) {
        assert!(problem.starts_with(place) && problem.contains(what), "{problem} instead of {place}: {what}");
    }
    let text = read(&file).unwrap_err().to_string();
    assert!(text.starts_with("curves: 10 problems:\n  template 1"), "{text}");
}

#[test]
fn what_is_no_set_is_refused_with_what_to_do() {
    for (bytes, said) in [
        (&b""[..], "the file is empty"),
        (b"\x00\x01", "nothing known begins with"),
        (b"{", "line 1, column 1"),
        (b"{\"format\":\"fairpath-templates\",\"version\":1,\"templates\":[", "the file is cut off"),
        (b"{\"format\":\"fairpath-templates\",\"version\":1,\"templates\":[]}", "needs at least one"),
        (b"{\"format\":\"fairpath-templates\",\"version\":2,\"templates\":[]}", "version 2 is not known"),
        (b"{\"format\":\"fairpath-strokes\",\"version\":1,\"strokes\":[]}", "these are strokes"),
        (b"{\"format\":\"fairpath-spline\",\"version\":1,\"splines\":[]}", "needs at least one"),
        (b"<svg xmlns=\"http://www.w3.org/2000/svg\"/>", "needs at least one"),
        (b"<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0L0 0\"/></svg>", "no length"),
        (
            b"<svg xmlns=\"http://www.w3.org/2000/svg\"><path id=\"cusp\" d=\"M0 0C100 100 0 100 100 0\"/></svg>",
            "corner",
        ),
    ] {
        let error = read(bytes).unwrap_err().to_string();
        assert!(error.starts_with("curves: ") && error.contains(said), "{error} does not say {said}");
    }
    let mut options = TemplateOptions::default();
    options.read.limits.max_templates = 1;
    let many = encode_templates(&shipped("rectilinear")).unwrap();
    let error = read_templates_from(&many[..], "curves", &options).unwrap_err().to_string();
    assert!(error.contains("template 2 \"right angle\": more than 1 French curves"), "{error}");
}

#[test]
fn a_spline_of_a_set_that_is_no_template_is_named() {
    let file = SplineFile { splines: vec![entry("", ribbon((0.0, 0.0)))], ..SplineFile::default() };
    let bytes = encode_splines(&file, SplineFormat::Json, None, &WriteOptions::default()).unwrap().bytes;
    let error = read(&bytes).unwrap_err().to_string();
    assert!(error.contains("spline 1 \"\": a French curve needs a name"), "{error}");
}
