//! What must be true of fits in curvature space: known curves are found again, and any stroke gets a curve whose joins hold.

#[path = "common/corpus.rs"]
mod corpus;

use fairpath_curve::{Continuity, JOIN_TOLERANCE, Point, Segment, Spline};
use fairpath_fit::{
    Closing, CurvatureEstimate, CurvatureSpaceOptions, Fit, FitError, FitOptions, Mode, Stroke, StrokeOptions, fit,
    fit_curvature_space,
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

#[test]
fn every_recorded_stroke_gets_a_sound_curve() {
    let Some(files) = corpus::corpus() else { return };
    for (name, strokes) in files {
        let mut sums = [0.0; 3];
        for stroke in &strokes {
            let mut rms = [0.0; 3];
            for (mode, rms) in [Mode::Refined, Mode::Faithful].into_iter().zip(&mut rms) {
                let fit =
                    fit_curvature_space(stroke, &options(mode)).unwrap_or_else(|e| panic!("{}: {e}", stroke.name));
                assert_sound(&fit, stroke);
                for join in 0..fit.spline.joins().len() {
                    let (a, b) =
                        (fit.spline.segments()[join], fit.spline.segments()[(join + 1) % fit.spline.segments().len()]);
                    assert!((a.end() - b.start).hypot() < JOIN_TOLERANCE * 1e4);
                }
                *rms = fit.report.rms_deviation;
            }
            for (sum, rms) in sums.iter_mut().zip(rms) {
                *sum += rms / strokes.len() as f64;
            }
        }
        println!("{name}: mean rms refined {:.3}, faithful {:.3}", sums[0], sums[1]);
    }
}

#[test]
fn options_read_from_json_know_their_names() {
    let read = |text: &str| serde_json::from_str::<CurvatureSpaceOptions>(text);
    let options = read(r#"{"closing_gap": 20.0, "piece_cost": 0.3}"#).unwrap();
    assert_eq!((options.stroke.closing_gap, options.piece_cost), (20.0, 0.3));
    assert!(read(r#"{"closing_gab": 20.0}"#).unwrap_err().to_string().contains("closing_gab"));
}
