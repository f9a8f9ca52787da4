//! The comparison of methods: figures by hand, and a page that stands alone.

use fairpath_curve::{Continuity, Point, Segment, Spline};
use fairpath_fit::{Report, Stroke};
use fairpath_io::picture::{PictureOptions, draw_comparison};
use fairpath_io::{
    ComparedMethod, Comparison, Failure, Milliseconds, SplineEntry, SplineFile, SplineReport, StrokeFile,
};
use serde_json::Value;

fn entry(name: &str, spline: Spline, rms: f64, pieces: usize, ms: f64) -> SplineEntry {
    let figures = Report { rms_deviation: rms, max_deviation: 2.0 * rms, pieces, ..Report::default() };
    let ms = Some(Milliseconds { total: ms, ..Milliseconds::default() });
    let report = Some(SplineReport { figures, ms });
    SplineEntry { name: name.into(), method: "by-hand".into(), spline, report, warnings: vec![], templates: None }
}

/// A clothoid from straight to a bend and back: `∫ κ′² ds` is 2 × 0.02² / 100.
fn bend() -> Spline {
    let first = Segment::clothoid(Point::ORIGIN, 0.0, 100.0, 0.0, 0.02);
    let second = Segment::clothoid(first.end(), first.end_heading(), 100.0, 0.02, 0.0);
    Spline::new(vec![first, second], vec![Continuity::G2], false).unwrap()
}

/// A quarter of a circle of radius 100 as a polyline of 30 chords.
fn chords() -> Spline {
    let at =
        |i: i32| Point::ORIGIN + fairpath_curve::trig::unit(f64::from(i) * std::f64::consts::FRAC_PI_2 / 30.0) * 100.0;
    let chord = |i: i32| {
        let v = at(i + 1) - at(i);
        Segment::line(at(i), fairpath_curve::trig::angle_of(v), v.hypot())
    };
    Spline::new((0..30).map(chord).collect(), vec![Continuity::G0; 29], false).unwrap()
}

fn comparison() -> Comparison {
    let stroke = |name: &str| Stroke::new(name, vec![Point::ORIGIN, Point::new(50.0, 3.0), Point::new(90.0, 60.0)]);
    let file = |splines, failures| SplineFile { splines, failures, ..SplineFile::default() };
    let failure = Failure { name: "b</script>".into(), code: "too-short".into(), text: "a <dot>".into() };
    let method = |name: &str, results| ComparedMethod { name: name.into(), about: "some & such".into(), results };
    Comparison {
        strokes: StrokeFile::new(vec![stroke("a"), stroke("b</script>")]),
        methods: vec![
            method("one", file(vec![entry("a", bend(), 1.0, 2, 3.0)], vec![failure])),
            method(
                "two",
                file(vec![entry("a", chords(), 0.5, 30, 1.0), entry("b</script>", bend(), 0.7, 2, 5.0)], vec![]),
            ),
        ],
    }
}

#[test]
fn the_figures_are_those_by_hand() {
    let summary = comparison().summary();
    let [one, two] = &summary[..] else { panic!("{summary:?}") };
    assert_eq!((one.fitted, one.failed, two.fitted, two.failed), (1, 1, 2, 0));
    assert_eq!((one.pieces_mean, one.rms_mean, one.max_deviation, one.ms_median), (2.0, 1.0, 2.0, Some(3.0)));
    let by_hand = 2.0 * 0.02 * 0.02 / 100.0 * 200.0_f64.powi(3);
    assert!((one.variation_median - by_hand).abs() < 1e-9 * by_hand, "{}", one.variation_median);
    assert_eq!((two.corners, two.curvature_jumps), (29, 0));
    // The one has fewer pieces at the only stroke that both have; the other is nearer there and alone at the second.
    assert_eq!((one.best.pieces, one.best.rms), (1, 0));
    assert_eq!((two.best.pieces, two.best.rms), (1, 2));
}

#[test]
fn a_polyline_has_the_curvature_of_its_turns() {
    let data = data(&comparison().to_html());
    let curve = &data["strokes"][0]["curves"][1];
    assert_eq!(curve["of_points"], true);
    let profile: Vec<f64> = curve["profile"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    assert_eq!(profile.len(), 2 * 29);
    assert!(profile.chunks(2).all(|k| (k[1] - 0.01).abs() < 1e-5), "{profile:?}");
    assert_eq!(curve["figures"]["inflections"], 0);
}

/// What the page gives to its script.
fn data(html: &str) -> Value {
    let (_, after) = html.split_once("<script type=\"application/json\" id=\"data\">").expect("the page has data");
    let (data, _) = after.split_once("</script>").expect("the data end");
    serde_json::from_str(data).expect("the data are JSON")
}

#[test]
fn the_page_stands_alone_and_no_name_breaks_it() {
    let html = comparison().to_html();
    let data = data(&html);
    assert_eq!(data["strokes"][1]["name"], "b</script>");
    assert_eq!(data["strokes"][1]["curves"][0]["failure"], "a <dot>");
    assert_eq!(html.matches("</script>").count(), 2, "one for the data and one for the script");
    for outside in ["http://", "https://", "src=", "@import", "url("] {
        let lines: Vec<&str> =
            html.lines().filter(|l| l.contains(outside) && !l.contains("www.w3.org/2000/svg")).collect();
        assert!(lines.is_empty(), "{outside}: {lines:?}");
    }
}

#[test]
fn curves_lie_on_the_page_with_feet_of_the_comb_on_them() {
    let data = data(&comparison().to_html());
    let drawing = &data["strokes"][0];
    let size: Vec<f64> = drawing["size"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    assert!((size[0].max(size[1]) - 1000.0).abs() < 1e-9, "{size:?}");
    let scale = drawing["scale"].as_f64().unwrap();
    let comb: Vec<f64> = drawing["curves"][0]["comb"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let spline = bend();
    let foot = |k: usize| (Point::new(comb[k + 1], comb[k + 2]), spline.point_at(comb[k]));
    for k in (5..comb.len()).step_by(5) {
        let ((a, on_a), (b, on_b)) = (foot(k - 5), foot(k));
        assert!(((b - a) - (on_b - on_a) * scale).hypot() < 0.3, "{k}");
    }
}

#[test]
fn the_picture_has_a_cell_for_each_stroke_and_method() {
    let comparison = comparison();
    let methods: Vec<(&str, &SplineFile)> = comparison.methods.iter().map(|m| (m.name.as_str(), &m.results)).collect();
    let picture = draw_comparison(&methods, &comparison.strokes, &PictureOptions::default());
    // Two columns of 240 px between margins of 24 px, shown larger by one factor.
    let (width, height) = picture.size_px();
    assert!((width / height - 528.0 / 546.0).abs() < 0.01, "{width} {height}");
    picture.to_png().unwrap();
}
