//! What must be true of fits in curvature space: known curves are found again, and any stroke gets a curve whose joins hold.

#[path = "common/corpus.rs"]
mod corpus;

use fairpath_curve::{Continuity, Kind, Point, Segment, Spline};
use fairpath_fit::{
    Closing, CurvatureEstimate, CurvatureSpaceOptions, CurvatureStages, Fit, FitError, FitOptions, Mode, Observer,
    Step, Stroke, StrokeOptions, fit, fit_curvature_space, fit_curvature_space_observed,
};
use proptest::prelude::*;

fn options(mode: Mode) -> CurvatureSpaceOptions {
    CurvatureSpaceOptions { mode, ..CurvatureSpaceOptions::default() }
}

fn fitted(points: Vec<Point>, options: &CurvatureSpaceOptions) -> Fit {
    let stroke = Stroke::new("test", points);
    let fit = fit_curvature_space(&stroke, options).unwrap_or_else(|e| panic!("{e}"));
    assert_sound(&fit, &stroke);
    fit
}

/// The claims of the joins hold, and the report is what an outside measurement says.
fn assert_sound(fit: &Fit, stroke: &Stroke) {
    let spline = &fit.spline;
    let again = Spline::new(spline.segments().to_vec(), spline.joins().to_vec(), spline.is_closed());
    assert_eq!(again.as_ref(), Ok(spline), "{}", stroke.name);
    let off = stroke.points.iter().map(|&p| spline.nearest(p).distance).fold(0.0, f64::max);
    // A curve that was turned round is evaluated from its other end.
    assert!((off - fit.report.max_deviation).abs() < 1e-8 * (1.0 + off), "{}: {off}", stroke.name);
    assert_eq!(fit.report.points, stroke.points.len(), "{}", stroke.name);
}

/// Points every `step` along segments of given length and curvatures that follow each other smoothly.
fn along(pieces: &[(f64, f64, f64)], step: f64) -> Vec<Point> {
    let (mut start, mut heading) = (Point::new(40.0, -30.0), 0.4);
    let mut segments = Vec::new();
    for &(length, kappa0, kappa1) in pieces {
        let segment = Segment { start, heading, length, kappa0, kappa1 };
        (start, heading) = (segment.end(), segment.end_heading());
        segments.push(segment);
    }
    let joins = vec![Continuity::G2; segments.len() - 1];
    let spline = Spline::new(segments, joins, false).unwrap();
    let count = (spline.length() / step).round();
    (0..=count as usize).map(|i| spline.point_at(spline.length() * i as f64 / count)).collect()
}

#[test]
fn a_straight_stroke_is_one_straight_piece() {
    for mode in [Mode::Faithful, Mode::Refined] {
        for curvature in [CurvatureEstimate::Circle, CurvatureEstimate::ThreePoints] {
            let points = (0..80).map(|i| Point::new(3.0 * f64::from(i), 1.5 * f64::from(i))).collect();
            let fit = fitted(points, &CurvatureSpaceOptions { curvature, ..options(mode) });
            assert_eq!(fit.spline.segments().len(), 1, "{mode:?} {curvature:?}");
            assert!(fit.spline.segments()[0].absolute_turning() < 1e-6, "{mode:?} {curvature:?}");
            assert!(fit.report.max_deviation < 1e-6, "{mode:?} {curvature:?}");
        }
    }
}

#[test]
fn an_arc_gives_its_curvature() {
    for mode in [Mode::Faithful, Mode::Refined] {
        for kappa in [-0.02, 0.005, 0.03] {
            let fit = fitted(along(&[(150.0, kappa, kappa)], 2.0), &options(mode));
            assert_eq!(fit.spline.segments().len(), 1, "{mode:?} {kappa}");
            let found = fit.spline.segments()[0];
            assert!((found.kappa0 - kappa).abs() < 2e-4 && (found.kappa1 - kappa).abs() < 2e-4, "{mode:?} {found:?}");
        }
    }
}

#[test]
fn a_chain_of_clothoids_is_found_again() {
    let drawn = [(120.0, 0.0, 0.0), (100.0, 0.0, 0.03), (80.0, 0.03, 0.03), (150.0, 0.03, -0.02)];
    let fit = fitted(along(&drawn, 2.0), &options(Mode::Refined));
    let found = fit.spline.segments();
    assert_eq!(found.len(), drawn.len());
    for (found, (length, kappa0, kappa1)) in found.iter().zip(drawn) {
        assert!((found.length - length).abs() < 8.0, "{found:?}");
        assert!((found.kappa0 - kappa0).abs() < 1.5e-3 && (found.kappa1 - kappa1).abs() < 1.5e-3, "{found:?}");
    }
    assert!(fit.report.max_deviation < 0.1, "{}", fit.report.max_deviation);
}

#[test]
fn refinement_takes_the_drift_away() {
    let drawn = [(200.0, 0.0, 0.03), (200.0, 0.03, -0.03), (200.0, -0.03, 0.02), (150.0, 0.02, 0.0)];
    let [faithful, refined] =
        [Mode::Faithful, Mode::Refined].map(|mode| fitted(along(&drawn, 3.0), &options(mode)).report.rms_deviation);
    assert!(refined < 0.2 && refined < faithful, "{refined} {faithful}");
}

#[test]
fn limbs_meet_at_a_corner() {
    for mode in [Mode::Faithful, Mode::Refined] {
        let side = |i: u32| f64::from(i) * 2.0;
        let mut points: Vec<Point> = (0..60).map(|i| Point::new(side(i), 0.0)).collect();
        points.extend((0..60).map(|i| Point::new(120.0, side(i))));
        let fit = fitted(points, &options(mode));
        assert_eq!(fit.spline.joins().iter().filter(|j| **j == Continuity::G0).count(), 1, "{mode:?}");
        assert!(fit.report.max_deviation < 2.5, "{mode:?} {}", fit.report.max_deviation);
    }
}

#[test]
fn a_ring_closes_smoothly_or_says_that_it_does_not() {
    let ellipse = |a: f64, b: f64| -> Vec<Point> {
        (0..=150)
            .map(|i| f64::from(i) / 150.0 * std::f64::consts::TAU)
            .map(|t| Point::new(a * t.cos(), b * t.sin()))
            .collect()
    };
    for (a, b) in [(80.0, 80.0), (120.0, 60.0)] {
        let fit = fitted(ellipse(a, b), &options(Mode::Refined));
        assert!(fit.spline.is_closed(), "{a} {b}: {:?}", fit.warnings);
        assert!(fit.spline.joins().iter().all(|j| *j >= Continuity::G2));
        assert!(fit.report.max_deviation < 1.5, "{a} {b}: {}", fit.report.max_deviation);
        let open = fitted(ellipse(a, b), &options(Mode::Faithful));
        assert!(!open.spline.is_closed() && open.warnings.iter().any(|w| w.code == "left-open"));
    }
}

#[test]
fn a_target_is_met_with_more_pieces() {
    let points: Vec<Point> =
        (0..120).map(|i| f64::from(i) * 4.0).map(|x| Point::new(x, 40.0 * (x / 35.0).sin())).collect();
    let loose = CurvatureSpaceOptions { piece_cost: 4.0, target_error: None, ..options(Mode::Refined) };
    let rough = fitted(points.clone(), &loose);
    let close = fitted(points, &CurvatureSpaceOptions { target_error: Some(1.0), ..loose });
    assert!(close.report.max_deviation <= 1.0, "{}", close.report.max_deviation);
    assert!(close.spline.segments().len() > rough.spline.segments().len());
    assert!(close.warnings.is_empty(), "{:?}", close.warnings);
}

#[test]
fn what_is_no_stroke_gives_the_errors_of_the_other_method() {
    let nan = vec![Point::new(0.0, 0.0), Point::new(f64::NAN, 0.0)];
    for points in [vec![], vec![Point::ORIGIN; 5], nan, vec![Point::ORIGIN, Point::new(1e15, 0.0)]] {
        let stroke = Stroke::new("none", points);
        let ours = fit_curvature_space(&stroke, &CurvatureSpaceOptions::default()).unwrap_err();
        let theirs = fit(&stroke, &FitOptions::default()).unwrap_err();
        assert_eq!(ours.to_string(), theirs.to_string());
    }
}

#[test]
fn an_option_out_of_range_is_named() {
    let good = CurvatureSpaceOptions::default;
    let bad = [
        ("piece_cost", CurvatureSpaceOptions { piece_cost: 0.0, ..good() }),
        ("spacing", CurvatureSpaceOptions { spacing: f64::NAN, ..good() }),
        ("end_weight", CurvatureSpaceOptions { end_weight: -1.0, ..good() }),
        ("blend", CurvatureSpaceOptions { blend: -1.0, ..good() }),
        ("blend_pieces", CurvatureSpaceOptions { blend_pieces: 5, ..good() }),
        ("arc_cost", CurvatureSpaceOptions { arc_cost: Some(f64::NAN), ..good() }),
        ("target_error", CurvatureSpaceOptions { target_error: Some(0.0), ..good() }),
        ("curvature_window", CurvatureSpaceOptions { curvature_window: 1.0, ..good() }),
        (
            "pixel_size",
            CurvatureSpaceOptions { stroke: StrokeOptions { pixel_size: -1.0, ..StrokeOptions::default() }, ..good() },
        ),
    ];
    let stroke = Stroke::new("line", vec![Point::ORIGIN, Point::new(9.0, 0.0)]);
    for (option, options) in bad {
        match fit_curvature_space(&stroke, &options) {
            Err(FitError::BadOption { name, .. }) => assert_eq!(name, option),
            other => panic!("{option}: {other:?}"),
        }
    }
}

#[test]
fn reversing_a_stroke_reverses_its_curve() {
    let points = along(&[(120.0, 0.0, 0.02), (90.0, 0.02, -0.03)], 2.5);
    let forth = fitted(points.clone(), &options(Mode::Refined));
    let back = fitted(points.into_iter().rev().collect(), &options(Mode::Refined));
    assert_eq!(back.spline, forth.spline.reversed());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn whatever_is_drawn_gets_a_sound_curve(
        steps in prop::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64), 1..150),
        drift in prop_oneof![Just(0.0), Just(3.0), Just(12.0)],
        refined in any::<bool>(), three in any::<bool>(),
        closed in prop_oneof![Just(Closing::Auto), Just(Closing::Yes), Just(Closing::No)],
    ) {
        let mut at = Point::new(5.0, 5.0);
        let points: Vec<Point> = std::iter::once(at).chain(steps.iter().map(|s| { at += fairpath_curve::Vec2::new(s.0 + drift, s.1); at })).collect();
        let options = CurvatureSpaceOptions {
            mode: if refined { Mode::Refined } else { Mode::Faithful },
            curvature: if three { CurvatureEstimate::ThreePoints } else { CurvatureEstimate::Circle },
            stroke: StrokeOptions { closed, ..StrokeOptions::default() },
            ..CurvatureSpaceOptions::default()
        };
        let stroke = Stroke::new("walk", points);
        if let Ok(fit) = fit_curvature_space(&stroke, &options) {
            assert_sound(&fit, &stroke);
        } else {
            prop_assert!(stroke.points.windows(2).all(|p| (p[1] - p[0]).hypot() < 1e-3));
        }
    }
}

/// For each file the largest mean of root mean square distances of refined curves, px: what was measured and a tenth.
const MEAN_RMS: [(&str, f64); 5] =
    [("quickdraw", 1.02), ("omniglot", 1.46), ("wacom", 0.67), ("perfect", 0.94), ("synthetic", 0.86)];

#[test]
fn every_recorded_stroke_gets_a_sound_curve_that_stays_near() {
    let Some(files) = corpus::corpus() else { return };
    for (name, strokes) in files {
        let mut mean = 0.0;
        for stroke in &strokes {
            for mode in [Mode::Refined, Mode::Faithful] {
                let fit =
                    fit_curvature_space(stroke, &options(mode)).unwrap_or_else(|e| panic!("{}: {e}", stroke.name));
                assert_sound(&fit, stroke);
                if mode == Mode::Refined {
                    let off = fit.report.max_deviation;
                    assert!(off <= 8.0, "{}: {off}", stroke.name);
                    assert!(off <= 5.0 || !fit.warnings.is_empty(), "{}: {off} without a word", stroke.name);
                    mean += fit.report.rms_deviation / strokes.len() as f64;
                }
            }
        }
        let limit = MEAN_RMS.iter().find(|(of, _)| *of == name).expect("every file has its limit").1;
        assert!(mean <= limit, "{name}: {mean}");
    }
}

#[test]
fn drawn_strokes_are_followed_about_as_well_as_by_shortest_paths() {
    let Some(files) = corpus::corpus() else { return };
    let strokes = &files.iter().find(|(name, _)| *name == "synthetic").expect("the file is there").1;
    let (mut ours, mut theirs, mut segments, mut inflections) = (0.0, 0.0, 0, 0);
    for stroke in strokes {
        let space = fit_curvature_space(stroke, &options(Mode::Refined)).unwrap();
        let path = fit(stroke, &FitOptions::default()).unwrap();
        let (a, b) = (space.report.rms_deviation, path.report.rms_deviation);
        assert!(a <= 1.65 * b, "{}: {a} and {b}", stroke.name);
        assert_eq!(space.spline.is_closed(), path.spline.is_closed(), "{}", stroke.name);
        ours += a;
        theirs += b;
        segments += space.spline.segments().len();
        inflections += space.report.inflections;
    }
    assert!(ours <= 1.15 * theirs, "{ours} and {theirs}");
    assert!(segments <= 250 && inflections <= 60, "{segments} segments, {inflections} inflections");
}

/// A meander of about so many px, with a little tremor.
fn meander(length: f64) -> Vec<Point> {
    let tremor = |i: usize| 0.3 * (1.7 * i as f64).sin() + 0.2 * (5.3 * i as f64).sin();
    (0..=(length / 7.0) as usize)
        .map(|i| (i, 5.0 * i as f64))
        .map(|(i, x)| Point::new(x + tremor(i), 45.0 * (x / 48.0).sin() + 12.0 * (x / 310.0).sin() + tremor(i + 9)))
        .collect()
}

#[test]
fn a_refined_curve_does_not_drift_however_long_the_stroke() {
    let mut refined = Vec::new();
    for length in [500.0, 1500.0, 4500.0, 10_000.0] {
        let near = fitted(meander(length), &options(Mode::Refined)).report;
        let laid = CurvatureSpaceOptions { target_error: None, ..options(Mode::Faithful) };
        let far = fitted(meander(length), &laid).report;
        println!("{length} px: refined {:.2} px off, faithful {:.2}", near.max_deviation, far.max_deviation);
        assert!(near.max_deviation < far.max_deviation, "{length}");
        refined.push(near.max_deviation);
    }
    let largest = refined.iter().copied().fold(0.0, f64::max);
    assert!(largest < 4.0 && largest < 2.5 * refined[0].max(1.0), "{refined:?}");
}

#[test]
fn what_is_straight_or_round_becomes_lines_and_arcs_with_exact_joins() {
    let drawn = [(150.0, 0.0, 0.0), (90.0, 0.0, 0.025), (120.0, 0.025, 0.025), (90.0, 0.025, 0.0), (150.0, 0.0, 0.0)];
    let eager = CurvatureSpaceOptions { line_cost: Some(3.0), arc_cost: Some(5.0), ..options(Mode::Refined) };
    let fit = fitted(along(&drawn, 2.0), &eager);
    let kinds: Vec<Kind> = fit.spline.segments().iter().map(Segment::kind).collect();
    assert_eq!(kinds, [Kind::Line, Kind::Clothoid, Kind::Arc, Kind::Clothoid, Kind::Line]);
    assert!(fit.spline.joins().iter().all(|j| *j == Continuity::G2));
    assert_eq!(fit.report.inflections, 0);
    let plain = CurvatureSpaceOptions { line_cost: None, arc_cost: None, ..options(Mode::Refined) };
    let fit = fitted(along(&drawn, 2.0), &plain);
    assert!(fit.spline.segments().iter().all(|s| s.kind() == Kind::Clothoid));
}

#[test]
fn a_square_is_four_lines() {
    let mut points = Vec::new();
    let corners = [(0.0, 0.0), (150.0, 0.0), (150.0, 150.0), (0.0, 150.0), (0.0, 0.0)];
    for pair in corners.windows(2) {
        let [(x, y), (u, v)] = [pair[0], pair[1]];
        points.extend((0..40).map(|i| f64::from(i) / 40.0).map(|t| Point::new(x + (u - x) * t, y + (v - y) * t)));
    }
    let fit = fitted(points, &options(Mode::Refined));
    assert!(fit.spline.is_closed());
    let kinds: Vec<Kind> = fit.spline.segments().iter().map(Segment::kind).collect();
    assert_eq!(kinds, [Kind::Line; 4]);
}

/// The largest change of the slope of curvature at a smooth join, radians per px³.
fn largest_kink(fit: &Fit) -> f64 {
    let s = fit.spline.segments();
    let joins = fit.spline.joins().iter().enumerate().filter(|(_, j)| **j >= Continuity::G2);
    joins.map(|(i, _)| (s[(i + 1) % s.len()].sharpness() - s[i].sharpness()).abs()).fold(0.0, f64::max)
}

#[test]
fn a_blend_divides_the_kinks_of_curvature_and_leaves_the_curve_in_place() {
    let bend = [(120.0, 0.0, 0.02), (110.0, 0.02, -0.02), (130.0, -0.02, 0.01)];
    let ellipse: Vec<Point> = (0..=150)
        .map(|i| f64::from(i) / 150.0 * std::f64::consts::TAU)
        .map(|t| Point::new(120.0 * t.cos(), 60.0 * t.sin()))
        .collect();
    for points in [along(&bend, 2.0), ellipse] {
        let plain = fitted(points.clone(), &options(Mode::Refined));
        let blended = CurvatureSpaceOptions { blend: 8.0, blend_pieces: 8, ..options(Mode::Refined) };
        let fit = fitted(points, &blended);
        assert!(fit.warnings.is_empty(), "{:?}", fit.warnings);
        assert_eq!(fit.spline.is_closed(), plain.spline.is_closed());
        assert!(fit.spline.joins().iter().all(|j| *j == Continuity::G2));
        assert!(largest_kink(&fit) < 0.16 * largest_kink(&plain), "{} {}", largest_kink(&fit), largest_kink(&plain));
        assert!((fit.report.max_deviation - plain.report.max_deviation).abs() < 0.2);
    }
}

#[test]
fn the_paper_s_blend_rounds_the_profile_before_it_is_laid() {
    let points = along(&[(120.0, 0.0, 0.02), (110.0, 0.02, -0.02)], 2.0);
    let plain = fitted(points.clone(), &options(Mode::Faithful));
    let fit = fitted(points, &CurvatureSpaceOptions { blend: 8.0, ..options(Mode::Faithful) });
    assert!(fit.spline.segments().len() > plain.spline.segments().len() + 6);
    assert!(largest_kink(&fit) < 0.16 * largest_kink(&plain));
}

#[test]
fn on_clean_strokes_the_target_is_met_with_more_pieces_the_smaller_it_is() {
    let points: Vec<Point> =
        (0..200).map(|i| f64::from(i) * 3.0).map(|x| Point::new(x, 50.0 * (x / 45.0).sin() + 0.02 * x)).collect();
    let mut before = 0;
    for target in [4.0, 1.0, 0.3, 0.1] {
        let fit =
            fitted(points.clone(), &CurvatureSpaceOptions { target_error: Some(target), ..options(Mode::Refined) });
        assert!(fit.report.max_deviation <= target, "{target}: {}", fit.report.max_deviation);
        assert!(fit.warnings.is_empty(), "{target}: {:?}", fit.warnings);
        let count = fit.spline.segments().len();
        assert!(count >= before, "{target}: {count} after {before}");
        before = count;
    }
}

#[test]
fn a_target_below_the_tremor_is_missed_with_a_warning() {
    let points = (0..90).map(|i| Point::new(4.0 * f64::from(i), if i % 2 == 0 { 1.5 } else { -1.5 })).collect();
    let fit = fitted(points, &CurvatureSpaceOptions { target_error: Some(0.2), ..options(Mode::Refined) });
    assert!(fit.report.max_deviation > 0.2);
    assert!(fit.warnings.iter().any(|w| w.code == "target-missed"), "{:?}", fit.warnings);
}

#[derive(Default)]
struct Steps(Vec<Step>);

impl Observer for Steps {
    fn step(&mut self, step: Step) {
        self.0.push(step);
    }
}

#[test]
fn the_steps_are_told_and_the_stages_filled_whichever_way_the_stroke_goes() {
    let forth = along(&[(120.0, 0.0, 0.02), (90.0, 0.02, -0.03)], 2.5);
    let back: Vec<Point> = forth.iter().rev().copied().collect();
    let mut stages = [CurvatureStages::default(), CurvatureStages::default()];
    for (points, stages) in [forth, back].into_iter().zip(&mut stages) {
        let mut steps = Steps::default();
        let stroke = Stroke::new("steps", points);
        let observed =
            fit_curvature_space_observed(&stroke, &options(Mode::Refined), &mut steps, Some(stages)).unwrap();
        assert_eq!(fit_curvature_space(&stroke, &options(Mode::Refined)).unwrap(), observed);
        assert_eq!(steps.0.last(), Some(&Step::Done));
        for step in [Step::Preprocess, Step::Candidates, Step::Search, Step::Merge] {
            assert!(steps.0.contains(&step), "{step:?}");
        }
        let profile = &stages.profiles[0];
        assert_eq!((stages.places.len(), stages.profiles.len(), stages.laid.len()), (1, 1, profile.len() - 1));
        assert!((profile[profile.len() - 1].s - 210.0).abs() < 1.0 && profile[0].s.abs() < 1e-9);
        assert!(stages.places[0].windows(2).all(|p| p[0].s < p[1].s));
    }
    let [forth, back] = stages;
    for (a, b) in forth.profiles[0].iter().zip(back.profiles[0].iter().rev()) {
        assert!((a.kappa + b.kappa).abs() < 1e-12 && (a.s + b.s - 210.0).abs() < 1.0);
    }
}

#[test]
fn options_read_from_json_know_their_names() {
    let read = |text: &str| serde_json::from_str::<CurvatureSpaceOptions>(text);
    let options = read(r#"{"closing_gap": 20.0, "piece_cost": 0.3}"#).unwrap();
    assert_eq!((options.stroke.closing_gap, options.piece_cost), (20.0, 0.3));
    assert!(read(r#"{"closing_gab": 20.0}"#).unwrap_err().to_string().contains("closing_gab"));
}
