//! Pictures and CAD files of hand-made shapes. With `FAIRPATH_PICTURES=folder` they are left there to be looked at.

#[path = "common/shapes.rs"]
mod example;

use example::{entry, ribbon, shapes};
use fairpath_curve::{Kind, Point, Segment, Similarity, Vec2};
use fairpath_fit::{Candidate, Stages, Stroke, Template, TemplateSet};
use fairpath_io::picture::{Comb, Layout, PictureOptions, draw_pieces, draw_splines, draw_stages, draw_templates};
use fairpath_io::{
    DxfEntities, Failure, SHIPPED_TEMPLATES, SplineFile, SplineFormat, StrokeFile, UsedPiece, UsedTemplates,
    WriteOptions, YAxis, encode_splines, shipped_templates, write_whole,
};
use std::path::Path;

/// Leaves a file where the tester asked for it.
fn keep(name: &str, bytes: &[u8]) {
    if let Some(folder) = std::env::var_os("FAIRPATH_PICTURES") {
        write_whole(&Path::new(&folder).join(name), bytes).expect("the folder can be written");
    }
}

/// A shaky stroke along a spline, as a hand would draw it.
fn shaky(name: &str, file: &SplineFile, index: usize) -> Stroke {
    let mut state = 17_u32;
    let mut shake = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 16) / 65_536.0 * 5.0 - 2.5
    };
    let poses = file.splines[index].spline.samples(9.0);
    Stroke::new(name, poses.iter().map(|p| Point::new(p.point.x + shake(), p.point.y + shake())).collect())
}

fn with_strokes() -> (SplineFile, StrokeFile) {
    let mut file = shapes();
    let strokes = vec![shaky("ribbon", &file, 0), shaky("drop/1", &file, 1), Stroke::new("dot", vec![Point::ZERO])];
    let failure = Failure { name: "dot".into(), code: "too-short".into(), text: "a dot".into() };
    file.failures.push(failure);
    (file, StrokeFile::new(strokes))
}

/// Width and height in a PNG's header.
fn png_size(png: &[u8]) -> (u32, u32) {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes([png[at], png[at + 1], png[at + 2], png[at + 3]]);
    (number(16), number(20))
}

#[test]
fn a_picture_is_as_large_as_asked_and_shows_every_kind() {
    let (file, strokes) = with_strokes();
    let picture = draw_splines(&file, Some(&strokes), &PictureOptions::default());
    let png = picture.to_png().unwrap();
    let (w, h) = png_size(&png);
    assert_eq!(w.max(h), 1600);
    for colour in ["#d7263d", "#1a9850", "#2166c4", "#b9bfc8"] {
        assert!(picture.to_svg().contains(colour), "{colour} is missing");
    }
    keep("together.png", &png);
    keep("together.svg", picture.to_svg().as_bytes());
}

#[test]
fn the_comb_can_be_chosen() {
    let (file, strokes) = with_strokes();
    let mut options = PictureOptions::default();
    let without = draw_splines(&file, Some(&strokes), &options);
    options.comb = Comb::Auto;
    let with = draw_splines(&file, Some(&strokes), &options);
    assert!(with.to_svg().len() > 2 * without.to_svg().len());
    keep("comb.png", &with.to_png().unwrap());
}

#[test]
fn a_sheet_has_a_cell_for_each_stroke_also_where_fitting_failed() {
    let (file, strokes) = with_strokes();
    let mut options = PictureOptions::default();
    options.layout = Layout::Sheet { columns: Some(3) };
    options.comb = Comb::Auto;
    let picture = draw_splines(&file, Some(&strokes), &options);
    assert_eq!(picture.size_px().0, 1600.0);
    let many = StrokeFile::new((0..60).map(|i| Stroke::new(i.to_string(), vec![Point::ZERO])).collect());
    options.layout = Layout::Sheet { columns: None };
    let large = draw_splines(&SplineFile::default(), Some(&many), &options);
    assert_eq!(large.size_px(), (10.0 * 240.0 + 48.0, 6.0 * 236.0 + 48.0));
    keep("sheet.png", &picture.to_png().unwrap());
}

#[test]
fn a_drawing_far_from_the_origin_looks_the_same() {
    let near = SplineFile { splines: vec![entry("a", ribbon((0.0, 0.0)))], ..SplineFile::default() };
    let far = SplineFile { splines: vec![entry("a", ribbon((1e9, -1e9)))], ..SplineFile::default() };
    let options = PictureOptions::default();
    let (near, far) = (draw_splines(&near, None, &options), draw_splines(&far, None, &options));
    let (near, far) = (near.to_png().unwrap(), far.to_png().unwrap());
    assert_eq!(png_size(&near), png_size(&far));
    keep("far.png", &far);
}

#[test]
fn a_y_up_drawing_stands_upright() {
    let mut file = SplineFile { splines: vec![entry("a", ribbon((0.0, 0.0)))], y: YAxis::Up, ..SplineFile::default() };
    let up = draw_splines(&file, None, &PictureOptions::default());
    file.y = YAxis::Down;
    let down = draw_splines(&file, None, &PictureOptions::default());
    assert_eq!(up.size_px(), down.size_px());
    assert_ne!(up.to_svg(), down.to_svg());
}

#[test]
fn an_empty_file_and_a_dot_are_a_white_page() {
    let picture = draw_splines(&SplineFile::default(), None, &PictureOptions::default());
    assert!(picture.to_png().is_ok());
    let dots = StrokeFile::new(vec![Stroke::new("dot", vec![Point::new(3.0, 4.0); 5])]);
    assert!(draw_splines(&SplineFile::default(), Some(&dots), &PictureOptions::default()).to_png().is_ok());
}

#[test]
fn the_stages_of_a_fit_are_five_pictures_of_one_frame() {
    let (file, strokes) = with_strokes();
    let spline = &file.splines[0].spline;
    let samples: Vec<Point> = spline.samples(25.0).iter().map(|p| p.point).collect();
    let part = |from: f64, to: f64| -> Vec<Segment> {
        spline.segments().iter().map(|s| s.subsegment(from * s.length, to * s.length)).collect()
    };
    let candidates: Vec<Candidate> = [part(0.0, 0.97), part(0.1, 0.8), part(0.4, 1.0)]
        .concat()
        .into_iter()
        .map(|segment| Candidate { segment, first: 0, last: 4, error: 0.5 })
        .collect();
    let path = (0..spline.segments().len()).collect();
    let corners = vec![3];
    let stages = Stages { points: Vec::new(), closed: false, samples, corners, candidates, path };
    let pictures = draw_stages(&strokes.strokes[0], &stages, spline, YAxis::Down, &PictureOptions::default());
    assert_eq!(pictures.iter().map(|p| p.letter).collect::<String>(), "abcef");
    assert!(pictures.iter().all(|p| p.picture.size_px() == pictures[0].picture.size_px()));
    for p in pictures {
        keep(&format!("stage-{}-{}.png", p.letter, p.name), &p.picture.to_png().unwrap());
    }
}

/// Group codes and values of a DXF.
fn groups(dxf: &str) -> Vec<(i32, &str)> {
    let lines: Vec<&str> = dxf.lines().collect();
    lines.chunks(2).map(|c| (c[0].trim().parse().unwrap(), c[1])).collect()
}

#[test]
fn a_spline_is_one_polyline_in_dxf_with_its_arcs_as_bulges() {
    let dxf = encode_splines(&shapes(), SplineFormat::Dxf, None, &WriteOptions::default()).unwrap();
    let text = String::from_utf8(dxf.bytes.clone()).unwrap();
    keep("polyline.dxf", &dxf.bytes);
    let entities: Vec<&str> = groups(&text).iter().filter(|g| g.0 == 0).map(|g| g.1).collect();
    assert_eq!(entities.iter().filter(|e| **e == "LWPOLYLINE").count(), 2);
    assert!(!entities.contains(&"ARC"));
    assert_eq!(entities.last(), Some(&"EOF"));
    assert_eq!(dxf.warnings[0].code, "y-down-in-dxf");
}

#[test]
fn dxf_can_be_flipped_and_taken_apart() {
    let mut options = WriteOptions::default();
    options.dxf.flip_y = true;
    options.dxf.entities = DxfEntities::Separate;
    let dxf = encode_splines(&shapes(), SplineFormat::Dxf, None, &options).unwrap();
    keep("separate.dxf", &dxf.bytes);
    let text = String::from_utf8(dxf.bytes).unwrap();
    assert!(dxf.warnings.is_empty());
    let lines = groups(&text).iter().filter(|g| *g == &(0, "LINE")).count();
    let shapes = shapes();
    let segments = shapes.splines.iter().flat_map(|e| e.spline.segments());
    assert_eq!(lines, segments.filter(|s| s.kind() == Kind::Line).count());
    // The drop's arc: in a flipped drawing around (50, −50).
    let groups = groups(&text);
    let arc = groups.iter().rposition(|g| *g == (0, "ARC")).unwrap();
    let value = |code: i32| -> f64 { groups[arc..].iter().find(|g| g.0 == code).unwrap().1.parse().unwrap() };
    assert!((value(10) - 50.0).abs() < 1e-9 && (value(20) + 50.0).abs() < 1e-9 && (value(40) - 50.0).abs() < 1e-9);
    assert!((value(50) - 180.0).abs() < 1e-9 && (value(51) - 90.0).abs() < 1e-9);
}

#[test]
fn what_would_never_end_is_refused_by_approximating_writers_and_kept_by_exact_ones() {
    let segment = Segment::arc(Point::ZERO, 0.0, 1e9, 1e9);
    let spline = fairpath_curve::Spline::new(vec![segment], vec![], false).unwrap();
    let file = SplineFile { splines: vec![entry("whirl", spline)], ..SplineFile::default() };
    for format in [SplineFormat::Svg, SplineFormat::Dxf] {
        let error = encode_splines(&file, format, None, &WriteOptions::default()).unwrap_err().to_string();
        assert!(error.contains("whirl") && error.contains("write JSON or CSV"), "{error}");
    }
    for format in [SplineFormat::Json, SplineFormat::Csv, SplineFormat::Png] {
        assert!(encode_splines(&file, format, None, &WriteOptions::default()).is_ok());
    }
}

#[test]
fn a_board_shows_every_template_within_the_page() {
    let sets: Vec<TemplateSet> = SHIPPED_TEMPLATES.iter().map(|name| shipped_templates(name).unwrap()).collect();
    let picture = draw_templates(&sets, &PictureOptions::default());
    let (width, height) = picture.size_px();
    assert!(width == 1600.0 && height < 2.0 * width, "{width} x {height}");
    let outlines: Vec<&str> = picture.to_svg().lines().filter(|line| line.contains("stroke=\"#59636f\"")).collect();
    assert_eq!(outlines.len(), sets.iter().map(|set| set.templates().len()).sum::<usize>());
    let closed = sets.iter().flat_map(TemplateSet::templates).filter(|t| t.spline().is_closed()).count();
    assert_eq!(outlines.iter().filter(|line| line.contains("fill=\"#f4e9c8\"")).count(), closed);
    for outline in outlines {
        let data = outline.split('"').nth(1).unwrap();
        let numbers = data.split(|c: char| !"0123456789.-".contains(c)).filter(|number| !number.is_empty());
        let numbers: Vec<f64> = numbers.map(|number| number.parse().unwrap()).collect();
        for pair in numbers.chunks(2) {
            assert!((0.0..=width).contains(&pair[0]) && (0.0..=height).contains(&pair[1]), "{pair:?} in {data}");
        }
    }
    keep("templates.png", &picture.to_png().unwrap());
}

#[test]
fn pieces_are_drawn_where_they_lie_and_in_the_legend_moved_apart_where_they_overlap() {
    let mut file = shapes();
    let ribbon = file.splines[0].spline.clone();
    let set = TemplateSet::new("own", vec![Template::new("ribbon", ribbon.clone()).unwrap()]).unwrap();
    let piece = |offset: f64, length: f64| UsedPiece {
        template: "ribbon".into(),
        offset,
        length,
        backward: false,
        turned_over: false,
        transform: Similarity::translate(Vec2::new(0.0, 3.0)),
        span: [offset, offset + length],
    };
    let gone = UsedPiece { template: "not in the set".into(), ..piece(0.0, 10.0) };
    let pieces = vec![piece(0.0, 300.0), piece(200.0, 200.0), piece(500.0, 100.0), gone];
    file.splines[0].templates = Some(UsedTemplates { set: "own".into(), pieces });
    let picture = draw_pieces(&file, None, &set, &PictureOptions::default());
    let svg = picture.to_svg();
    // Each of the three pieces has an outline, a band, a part over the stroke and one in the legend.
    for colour in ["#d7263d", "#2166c4", "#e08a00"] {
        assert_eq!(svg.matches(&format!("stroke=\"{colour}\"")).count(), 4, "{colour}");
    }
    assert!(!svg.contains("#1a9850"), "a piece of an unknown template was drawn");
    let legend = svg.split("<clipPath id=\"legend\">").nth(1).unwrap();
    let first_point = |colour: &str| {
        let line = legend.lines().find(|line| line.contains(colour)).unwrap();
        line.split('"').nth(1).unwrap().to_owned()
    };
    assert_ne!(first_point("#d7263d"), first_point("#2166c4"));
    keep("pieces.png", &picture.to_png().unwrap());
    // A file without pieces has no legend, and nothing is taken amiss.
    assert!(!draw_pieces(&shapes(), None, &set, &PictureOptions::default()).to_svg().contains("legend"));
}
