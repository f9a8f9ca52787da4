//! What must be true of fits with French curves: strokes along templates are found there, the templates' own segments make the curve, and any
//! stroke gets a curve whose joins hold.

#[path = "common/corpus.rs"]
mod corpus;
#[path = "common/templates.rs"]
mod templates;

use fairpath_curve::{Continuity, Kind, Point, Similarity, Spline, Vec2, trig};
use fairpath_fit::{
    Closing, CornerSource, FitError, FitOptions, Flips, FrenchCurveFit, FrenchCurveOptions, FrenchCurveStream, Laying,
    PieceSearch, Stroke, StrokeOptions, TemplateSet, fit, fit_french_curve,
};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, TAU};
use templates::{burmester, chain, rectilinear, set, wave, wheel};

fn default() -> FrenchCurveOptions {
    FrenchCurveOptions::default()
}

fn fitted(points: Vec<Point>, set: &TemplateSet, options: &FrenchCurveOptions) -> FrenchCurveFit {
    let stroke = Stroke::new("test", points);
    let fit = fit_french_curve(&stroke, set, options).unwrap_or_else(|e| panic!("{e}"));
    assert_sound(&fit, &stroke, set);
    fit
}

/// The claims of the joins hold, the report is what an outside measurement says, and so are places of the pieces.
fn assert_sound(fit: &FrenchCurveFit, stroke: &Stroke, set: &TemplateSet) {
    let (spline, report) = (&fit.fit.spline, &fit.fit.report);
    let again = Spline::new(spline.segments().to_vec(), spline.joins().to_vec(), spline.is_closed());
    assert_eq!(again.as_ref(), Ok(spline), "{}", stroke.name);
    let off = stroke.points.iter().map(|&p| spline.nearest(p).distance).fold(0.0, f64::max);
    assert!((off - report.max_deviation).abs() < 1e-8 * (1.0 + off), "{}: {off}", stroke.name);
    assert_eq!(report.points, stroke.points.len(), "{}", stroke.name);
    let length = spline.length();
    for piece in &fit.pieces {
        let template = set.templates()[piece.template].spline();
        assert!(piece.offset >= 0.0 && piece.length > 0.0, "{}: {piece:?}", stroke.name);
        if template.is_closed() {
            assert!(piece.offset < template.length(), "{}: {piece:?}", stroke.name);
        } else {
            assert!(piece.offset + piece.length <= template.length() + 1e-6, "{}: {piece:?}", stroke.name);
        }
        let [from, to] = piece.span;
        assert!((0.0..=length).contains(&from) && to > from, "{}: {piece:?}", stroke.name);
        assert!(to <= if spline.is_closed() { 2.0 } else { 1.0 } * length + 1e-6, "{}: {piece:?}", stroke.name);
    }
    if fit.fit.warnings.iter().all(|w| w.code != "fell-back-to-polyline") {
        assert!(!fit.pieces.is_empty(), "{}", stroke.name);
    }
}

/// Tremor of about half a pixel that is the same on every run.
fn tremor(i: usize) -> Vec2 {
    let wave = |i: f64| 0.4 * (1.7 * i).sin() + 0.3 * (5.3 * i).sin();
    Vec2::new(wave(i as f64), wave(i as f64 + 7.5))
}

fn shaken(points: Vec<Point>) -> Vec<Point> {
    points.into_iter().enumerate().map(|(i, p)| p + tremor(i)).collect()
}

/// Points every 3 px along a part of a spline, moved.
fn along(spline: &Spline, from: f64, to: f64, by: &Similarity) -> Vec<Point> {
    let count = ((to - from) / 3.0).round();
    (0..=count as usize).map(|i| by.point(spline.point_at(from + (to - from) * i as f64 / count))).collect()
}

/// Points every 4 px along a polygon.
fn polygon(corners: &[(f64, f64)]) -> Vec<Point> {
    let mut out = Vec::new();
    for pair in corners.windows(2) {
        let (a, b) = (Point::new(pair[0].0, pair[0].1), Point::new(pair[1].0, pair[1].1));
        let count = ((b - a).hypot() / 4.0).round();
        out.extend((0..count as usize).map(|i| a.lerp(b, i as f64 / count)));
    }
    out.push(Point::new(corners[corners.len() - 1].0, corners[corners.len() - 1].1));
    out
}

fn moved() -> Similarity {
    Similarity { rotation: 2.1, translation: Vec2::new(300.0, -40.0), ..Similarity::IDENTITY }
}

#[test]
fn a_stroke_along_a_template_is_one_piece_of_it() {
    let set = burmester();
    for (template, from, to) in [(0, 60.0, 300.0), (1, 20.0, 150.0), (2, 250.0, 600.0)] {
        let drawn = along(set.templates()[template].spline(), from, to, &moved());
        for mode in [Laying::Refined, Laying::Faithful] {
            let fit = fitted(drawn.clone(), &set, &FrenchCurveOptions { mode, ..default() });
            let [piece] = &fit.pieces[..] else { panic!("{template} {mode:?}: {} pieces", fit.pieces.len()) };
            assert_eq!((piece.template, piece.backward, piece.turned_over), (template, false, false), "{mode:?}");
            assert!((piece.offset - from).abs() < 3.0 && (piece.length - (to - from)).abs() < 3.0, "{piece:?}");
            assert!(fit.fit.report.max_deviation < 1.0, "{template} {mode:?}: {}", fit.fit.report.max_deviation);
        }
    }
}

#[test]
fn a_template_is_used_backward_and_turned_over_where_it_must_be() {
    let set = burmester();
    let sweep = set.templates()[2].spline();
    let mirror = Similarity { mirror: true, ..moved() };
    let all = FrenchCurveOptions { flips: Flips::All, ..default() };
    for (by, backward, turned_over) in
        [(moved(), false, false), (moved(), true, false), (mirror, false, true), (mirror, true, true)]
    {
        let mut drawn = along(sweep, 250.0, 650.0, &by);
        if backward {
            drawn.reverse();
        }
        let fit = fitted(drawn, &set, &all);
        let [piece] = &fit.pieces[..] else { panic!("{} pieces", fit.pieces.len()) };
        assert_eq!((piece.template, piece.backward, piece.turned_over), (2, backward, turned_over));
        assert_eq!(piece.transform.mirror, turned_over);
        assert!((piece.offset - 250.0).abs() < 3.0, "{piece:?}");
    }
    // Without turning over there is no such sweep.
    let fit = fitted(along(sweep, 250.0, 650.0, &mirror), &set, &default());
    assert!(fit.pieces.len() > 1 || fit.fit.report.max_deviation > 1.0);
}

#[test]
fn what_is_seen_of_a_piece_is_the_template_itself() {
    let set = burmester();
    let wave = (0..150).map(|i| f64::from(i) * 4.0).map(|x| Point::new(x, 60.0 * (x / 70.0).sin())).collect();
    let options = default();
    let fit = fitted(shaken(wave), &set, &options);
    let spline = &fit.fit.spline;
    let mut seen = 0;
    for piece in &fit.pieces {
        let template = set.templates()[piece.template].spline().transformed(&piece.transform);
        let [from, to] = piece.span;
        // Blends reach twice their length into the span: once of the neighbour's part, once of this one's.
        let clear = 2.0 * options.blend + 2.0;
        for i in 0..20 {
            let s = from + clear + (to - from - 2.0 * clear) * f64::from(i) / 19.0;
            if s > from + clear && s < to - clear {
                let pose = spline.pose_at(s);
                let nearest = template.nearest(pose.point);
                assert!(nearest.distance < 1e-7, "{} off at {s}", nearest.distance);
                let kappa = template.segments()[nearest.segment].curvature_at(nearest.s);
                assert!((pose.curvature.abs() - kappa.abs()).abs() < 1e-7, "{} {kappa}", pose.curvature);
                seen += 1;
            }
        }
    }
    assert!(seen > 20, "{seen}");
    assert!(spline.joins().iter().all(|j| *j >= Continuity::G2), "a smooth stroke has no corner");
}

#[test]
fn dearer_pieces_are_fewer() {
    let set = burmester();
    let points: Vec<Point> = (0..300)
        .map(|i| f64::from(i) * 4.0)
        .map(|x| Point::new(x, 50.0 * (x / 60.0).sin() + 30.0 * (x / 23.0).cos()))
        .collect();
    let count = |piece_cost: f64| {
        let options = FrenchCurveOptions { piece_cost, end_threshold: None, ..default() };
        fitted(shaken(points.clone()), &set, &options).pieces.len()
    };
    let (many, some, few) = (count(0.02), count(0.2), count(1.5));
    assert!(many > some && some > few, "{many} {some} {few}");
}

#[test]
fn a_piece_that_strays_is_divided() {
    let set = burmester();
    let points: Vec<Point> =
        (0..200).map(|i| f64::from(i) * 0.035).map(|a| Point::new(60.0 * a, 90.0 * a.sin())).collect();
    let loose = FrenchCurveOptions { piece_cost: 2.0, end_threshold: None, ..default() };
    let strict = FrenchCurveOptions { end_threshold: Some(2.0), ..loose.clone() };
    let (loose, strict) = (fitted(points.clone(), &set, &loose), fitted(points, &set, &strict));
    assert!(strict.pieces.len() > loose.pieces.len());
    assert!(strict.fit.report.max_deviation < 3.0 && loose.fit.report.max_deviation > 4.0);
}

#[test]
fn a_stroke_around_a_closed_template_closes_exactly() {
    let around = |spline: &Spline| shaken(along(spline, 30.0, 30.0 + spline.length(), &moved()));
    let wheels = wheel(70.0);
    let fit = fitted(around(wheels.templates()[0].spline()), &wheels, &default());
    assert!(fit.fit.spline.is_closed() && fit.pieces.len() == 1);
    assert_eq!(fit.fit.spline.segments().len(), 1);
    assert_eq!(fit.fit.spline.segments()[0].kind(), Kind::Arc);
    let set = burmester();
    let egg = set.templates()[0].spline();
    let fit = fitted(around(egg), &set, &default());
    assert!(fit.fit.spline.is_closed() && fit.pieces.len() == 1, "{} pieces", fit.pieces.len());
    assert_eq!(fit.fit.spline.segments().len(), egg.segments().len());
    assert!(fit.fit.report.max_deviation < 1.5);
}

#[test]
fn a_closed_stroke_of_several_pieces_closes_by_a_blend() {
    let points: Vec<Point> = (0..=120)
        .map(|i| f64::from(i) / 120.0 * TAU)
        .map(|t| Point::new((100.0 + 22.0 * (3.0 * t).cos()) * t.cos(), (80.0 + 22.0 * (3.0 * t).cos()) * t.sin()))
        .collect();
    for mode in [Laying::Refined, Laying::Faithful] {
        let fit = fitted(points.clone(), &burmester(), &FrenchCurveOptions { mode, ..default() });
        assert!(fit.fit.spline.is_closed() && fit.pieces.len() > 1, "{mode:?}");
        assert!(fit.fit.spline.joins().iter().all(|j| *j >= Continuity::G2), "{mode:?}");
    }
}

#[test]
fn a_rough_rectangle_is_four_lines_that_meet_at_corners() {
    // Not quite right-angled, and shaken.
    let outline = [(0.0, 0.0), (181.0, 4.0), (178.0, 122.0), (-2.0, 119.0), (0.0, 0.0)];
    for corners in [CornerSource::PreFilter, CornerSource::Templates] {
        let options = FrenchCurveOptions { corners, ..default() };
        let fit = fitted(shaken(polygon(&outline)), &rectilinear(), &options);
        let spline = &fit.fit.spline;
        assert!(spline.is_closed(), "{corners:?}");
        assert_eq!(spline.segments().len(), 4, "{corners:?}: {:?}", spline.segments());
        assert!(spline.segments().iter().all(|s| s.kind() == Kind::Line), "{corners:?}");
        assert!(spline.joins().iter().all(|j| *j == Continuity::G0), "{corners:?}");
        assert!(fit.fit.report.max_deviation < 5.0, "{corners:?}: {}", fit.fit.report.max_deviation);
        if corners == CornerSource::Templates {
            // The angles are those of the template, not those of the drawing.
            for i in 0..4 {
                let turn = spline.segments()[(i + 1) % 4].heading - spline.segments()[i].heading;
                assert!((trig::wrap_angle(turn).abs() - FRAC_PI_2).abs() < 1e-3, "{turn}");
            }
        }
    }
}

#[test]
fn only_templates_with_corners_make_corners_where_they_are_asked() {
    let zigzag = shaken(polygon(&[(0.0, 0.0), (90.0, 70.0), (180.0, 0.0), (270.0, 70.0)]));
    let corners = |set: &TemplateSet, corners: CornerSource| {
        let fit = fitted(zigzag.clone(), set, &FrenchCurveOptions { corners, ..default() });
        fit.fit.spline.joins().iter().filter(|j| **j == Continuity::G0).count()
    };
    assert_eq!(corners(&burmester(), CornerSource::PreFilter), 2);
    assert_eq!(corners(&burmester(), CornerSource::Templates), 0);
    assert!(corners(&rectilinear(), CornerSource::Templates) > 0);
}

#[test]
fn long_waves_remake_a_spiral() {
    let spiral: Vec<Point> = (0..400)
        .map(|i| 0.04 * f64::from(i))
        .map(|a| Point::new((30.0 + 9.0 * a) * a.cos(), (30.0 + 9.0 * a) * a.sin()))
        .collect();
    let options = FrenchCurveOptions {
        piece_cost: 20.0,
        end_threshold: None,
        mode: Laying::Faithful,
        corners: CornerSource::Templates,
        ..default()
    };
    let fit = fitted(spiral.clone(), &wave(), &options);
    let length: f64 = spiral.windows(2).map(|p| (p[1] - p[0]).hypot()).sum();
    // As few as the template's length of 160 px allows.
    assert_eq!(fit.pieces.len(), (length / 160.0).ceil() as usize);
    assert!(fit.fit.report.inflections > 3 * fit.pieces.len() / 2, "{}", fit.fit.report.inflections);
    assert!(fit.fit.report.max_deviation < 60.0, "{}", fit.fit.report.max_deviation);
}

#[test]
fn a_larger_drawing_of_a_template_is_found_where_scaling_is_allowed() {
    let set = burmester();
    let by = Similarity { scale: 1.21, ..moved() };
    let drawn = along(set.templates()[0].spline(), 40.0, 330.0, &by);
    let options = FrenchCurveOptions { smallest_scale: 1.0, largest_scale: 1.21, ..default() };
    let fit = fitted(drawn.clone(), &set, &options);
    assert_eq!(fit.pieces.len(), 1);
    assert!((fit.pieces[0].transform.scale - 1.21).abs() < 1e-9, "{:?}", fit.pieces[0]);
    assert!((fit.pieces[0].length - 290.0).abs() < 5.0, "{:?}", fit.pieces[0]);
    assert!(fitted(drawn, &set, &default()).pieces.len() > 1);
}

#[test]
fn another_unit_gives_the_same_curve() {
    let set = burmester();
    let points = along(set.templates()[1].spline(), 10.0, 120.0, &moved());
    let px = fitted(points.clone(), &set, &default());
    let stroke = StrokeOptions { pixel_size: 0.25, ..StrokeOptions::default() };
    let mm = points.iter().map(|p| Point::new(0.25 * p.x + 5.0, 0.25 * p.y)).collect();
    let mm = fitted(mm, &set, &FrenchCurveOptions { stroke, ..default() });
    assert_eq!(px.pieces.len(), mm.pieces.len());
    assert!((0.25 * px.fit.spline.length() - mm.fit.spline.length()).abs() < 1e-6);
    assert!((px.pieces[0].transform.scale * 0.25 - mm.pieces[0].transform.scale).abs() < 1e-12);
    assert!((px.pieces[0].offset - mm.pieces[0].offset).abs() < 1e-6);
}

#[test]
fn reversing_a_stroke_reverses_its_curve() {
    let set = burmester();
    let points: Vec<Point> = shaken(
        (0..150).map(|i| f64::from(i) * 4.0).map(|x| Point::new(x, 0.1 * x + 45.0 * (x / 60.0).sin())).collect(),
    );
    let forth = fitted(points.clone(), &set, &default());
    let back = fitted(points.into_iter().rev().collect(), &set, &default());
    // One of them was fitted as it was drawn; to turn a spline round twice is to round it twice.
    let (one, other) = (&forth.fit.spline, &back.fit.spline);
    assert!(*other == one.reversed() || *one == other.reversed());
    assert_eq!(back.pieces.len(), forth.pieces.len());
    for (b, f) in back.pieces.iter().rev().zip(&forth.pieces) {
        assert_eq!((b.template, b.offset, b.length, b.transform), (f.template, f.offset, f.length, f.transform));
        assert_ne!(b.backward, f.backward);
    }
}

fn scribble(n: usize) -> Vec<Point> {
    let at = |i: usize| 0.045 * i as f64;
    shaken((0..n).map(at).map(|a| Point::new(25.0 * a + 60.0 * (0.7 * a).sin(), 70.0 * a.cos())).collect())
}

#[test]
fn a_stream_commits_what_the_whole_curve_has() {
    let mut strokes = vec![scribble(500)];
    strokes.push(shaken(polygon(&[(0.0, 0.0), (150.0, 20.0), (120.0, 140.0), (300.0, 150.0)])));
    for points in strokes {
        let set = burmester();
        let options = FrenchCurveOptions { search: PieceSearch::Greedy, ..default() };
        let mut stream = FrenchCurveStream::new(&set, &options).unwrap();
        let committed: Vec<_> = points.iter().flat_map(|&p| stream.push(p)).collect();
        let whole = stream.finish().unwrap();
        assert_sound(&whole, &Stroke::new("stream", points.clone()), &set);
        assert!(committed.len() >= 2 && committed.len() <= whole.pieces.len());
        let mut length = 0.0;
        for (i, (part, piece)) in committed.iter().zip(&whole.pieces).enumerate() {
            assert_eq!((part.piece.template, part.piece.transform), (piece.template, piece.transform));
            // It lies where the whole curve does at the same arc length.
            for k in 0..=10 {
                let s = part.spline.length() * f64::from(k) / 10.0;
                let (here, there) = (part.spline.point_at(s), whole.fit.spline.point_at(length + s));
                assert!((here - there).hypot() < 1e-6, "part {i} at {s}: {here:?} {there:?}");
            }
            assert!((part.piece.span[0] - length).abs() < 1e-6);
            length += part.spline.length();
            assert!((part.piece.span[1] - length).abs() < 1e-6);
        }
        let stroke = Stroke::new("greedy", points);
        assert_eq!(fit_french_curve(&stroke, &set, &options).unwrap(), whole);
    }
}

#[test]
fn a_greedy_search_finds_corners_and_follows_the_stroke() {
    let zigzag = shaken(polygon(&[(0.0, 0.0), (160.0, 90.0), (320.0, 0.0), (480.0, 90.0)]));
    let options = FrenchCurveOptions { search: PieceSearch::Greedy, ..default() };
    let fit = fitted(zigzag, &burmester(), &options);
    assert_eq!(fit.fit.spline.joins().iter().filter(|j| **j == Continuity::G0).count(), 2);
    assert!(fit.fit.report.max_deviation < 5.0, "{}", fit.fit.report.max_deviation);
    let fit = fitted(scribble(400), &burmester(), &options);
    assert!(fit.fit.report.rms_deviation < 2.5, "{}", fit.fit.report.rms_deviation);
}

#[test]
fn a_stream_tells_of_what_is_no_stroke() {
    let set = burmester();
    let finished = |points: &[Point]| {
        let mut stream = FrenchCurveStream::new(&set, &default()).unwrap();
        let committed: usize = points.iter().map(|&p| stream.push(p).len()).sum();
        (committed, stream.finish())
    };
    let nan = [Point::ORIGIN, Point::new(9.0, 0.0), Point::new(f64::NAN, 0.0), Point::new(18.0, 0.0)];
    assert_eq!(finished(&nan).1, Err(FitError::NotFinite { index: 2 }));
    assert!(matches!(finished(&[]).1, Err(FitError::TooShort { .. })));
    assert!(matches!(finished(&[Point::ORIGIN; 4]).1, Err(FitError::TooShort { .. })));
    let far = [Point::ORIGIN, Point::new(1e7, 0.0)];
    let (committed, end) = finished(&far);
    assert!(committed == 0 && matches!(end, Err(FitError::TooLong { .. })), "{end:?}");
}

#[test]
fn what_is_no_stroke_gives_the_errors_of_the_other_methods() {
    let nan = vec![Point::new(0.0, 0.0), Point::new(f64::NAN, 0.0)];
    for points in [vec![], vec![Point::ORIGIN; 5], nan, vec![Point::ORIGIN, Point::new(1e15, 0.0)]] {
        let stroke = Stroke::new("none", points);
        let ours = fit_french_curve(&stroke, &wave(), &default()).unwrap_err();
        let theirs = fit(&stroke, &FitOptions::default()).unwrap_err();
        assert_eq!(ours.to_string(), theirs.to_string());
    }
    let long = Stroke::new("long", vec![Point::ORIGIN, Point::new(1e6, 0.0)]);
    let error = fit_french_curve(&long, &wave(), &default()).unwrap_err();
    assert_eq!(error.code(), "too-long");
    assert!(error.to_string().contains("set a larger pixel size"), "{error}");
}

#[test]
fn an_option_out_of_range_is_named() {
    let bad = [
        ("piece_cost", FrenchCurveOptions { piece_cost: 0.0, ..default() }),
        ("greedy_error", FrenchCurveOptions { greedy_error: f64::NAN, ..default() }),
        ("end_threshold", FrenchCurveOptions { end_threshold: Some(0.0), ..default() }),
        ("blend", FrenchCurveOptions { blend: -1.0, ..default() }),
        ("accuracy", FrenchCurveOptions { accuracy: 0.0, ..default() }),
        ("spacing", FrenchCurveOptions { spacing: 0.1, ..default() }),
        ("smallest_scale", FrenchCurveOptions { smallest_scale: 0.0, ..default() }),
        ("largest_scale", FrenchCurveOptions { smallest_scale: 2.0, largest_scale: 1.0, ..default() }),
        ("curvature_window", FrenchCurveOptions { curvature_window: 1.0, ..default() }),
    ];
    let stroke = Stroke::new("line", vec![Point::ORIGIN, Point::new(9.0, 0.0)]);
    for (option, options) in bad {
        match fit_french_curve(&stroke, &wave(), &options) {
            Err(FitError::BadOption { name, .. }) => assert_eq!(name, option),
            other => panic!("{option}: {other:?}"),
        }
        assert!(FrenchCurveStream::new(&wave(), &options).is_err(), "{option}");
    }
}

#[test]
fn options_read_from_json_know_their_names() {
    let read = |text: &str| serde_json::from_str::<FrenchCurveOptions>(text);
    let options = read(r#"{"closing_gap": 20.0, "piece_cost": 0.3, "flips": "all", "end_threshold": null}"#).unwrap();
    assert_eq!((options.stroke.closing_gap, options.piece_cost, options.end_threshold), (20.0, 0.3, None));
    assert_eq!(options.flips, Flips::All);
    assert!(read(r#"{"piece_cots": 20.0}"#).unwrap_err().to_string().contains("piece_cots"));
}

fn any_set() -> impl Strategy<Value = TemplateSet> {
    let tiny = set(vec![("tiny", chain(&[(0.0, 2.0, 0.0, 0.3), (1.0, 0.5, 0.3, -1.0)]))]);
    prop_oneof![Just(rectilinear()), Just(wave()), Just(wheel(25.0)), Just(wheel(1.0)), Just(tiny), Just(burmester())]
}

fn any_options() -> impl Strategy<Value = FrenchCurveOptions> {
    let closed = prop_oneof![Just(Closing::Auto), Just(Closing::Yes), Just(Closing::No)];
    let flips = prop_oneof![Just(Flips::None), Just(Flips::Paper), Just(Flips::All)];
    let end_threshold = prop_oneof![Just(None), Just(Some(4.0)), Just(Some(0.1))];
    let blend = prop_oneof![Just(20.0), Just(0.0), Just(300.0)];
    (closed, flips, end_threshold, blend, any::<[bool; 3]>(), 0.001..2.0_f64).prop_map(
        |(closed, flips, end_threshold, blend, [faithful, greedy, templates], piece_cost)| FrenchCurveOptions {
            stroke: StrokeOptions { closed, ..StrokeOptions::default() },
            mode: if faithful { Laying::Faithful } else { Laying::Refined },
            search: if greedy { PieceSearch::Greedy } else { PieceSearch::Optimal },
            corners: if templates { CornerSource::Templates } else { CornerSource::PreFilter },
            flips,
            end_threshold,
            blend,
            piece_cost,
            ..default()
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn whatever_is_drawn_gets_a_sound_curve(
        steps in prop::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64), 1..120),
        drift in prop_oneof![Just(0.0), Just(3.0), Just(12.0)],
        scale in prop_oneof![Just(1.0), Just(0.01), Just(8.0)],
        back in any::<bool>(),
        options in any_options(), set in any_set(),
    ) {
        let mut at = Point::new(5.0, 5.0);
        let mut points: Vec<Point> = std::iter::once(at)
            .chain(steps.iter().map(|s| { at += Vec2::new(s.0 + drift, s.1) * scale; at }))
            .collect();
        if back {
            // A line that is retraced.
            points.extend(points.clone().into_iter().rev());
        }
        let stroke = Stroke::new("walk", points);
        match fit_french_curve(&stroke, &set, &options) {
            Ok(fit) => assert_sound(&fit, &stroke, &set),
            Err(FitError::TooShort { .. }) => {
                prop_assert!(stroke.points.iter().all(|p| (*p - stroke.points[0]).hypot() < 3e-3));
            }
            Err(error) => prop_assert!(false, "{error}"),
        }
    }
}

#[test]
fn every_recorded_stroke_gets_a_sound_curve() {
    let Some(files) = corpus::corpus() else { return };
    let set = burmester();
    for (name, strokes) in files {
        let mut sums = [0.0; 3];
        let ways = [
            default(),
            FrenchCurveOptions { mode: Laying::Faithful, ..default() },
            FrenchCurveOptions { search: PieceSearch::Greedy, ..default() },
        ];
        for stroke in &strokes {
            for (options, sum) in ways.iter().zip(&mut sums) {
                let fit = fit_french_curve(stroke, &set, options).unwrap_or_else(|e| panic!("{}: {e}", stroke.name));
                assert_sound(&fit, stroke, &set);
                *sum += fit.fit.report.rms_deviation / strokes.len() as f64;
            }
        }
        println!("{name}: mean rms refined {:.3}, faithful {:.3}, greedy {:.3}", sums[0], sums[1], sums[2]);
        assert!(sums[0] < 2.0 && sums[0] < sums[1], "{name}: {sums:?}");
    }
}
