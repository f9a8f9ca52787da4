//! Whatever is drawn and whatever is set: a fit is an error with a fixed word or a curve whose joins hold and whose report is true.

#[path = "common/corpus.rs"]
mod corpus;
#[path = "common/judge.rs"]
mod judge;

use fairpath_curve::{Continuity, Kind, Point, Vec2};
use fairpath_fit::{Closing, Fit, FitOptions, Preset, Stages, Stroke, fit, fit_observed};
use judge::{extent, fitted, judged};
use proptest::prelude::*;
use proptest::sample::select;
use std::f64::consts::{PI, TAU};

fn stroke(name: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Stroke {
    Stroke::new(name, points.into_iter().map(Point::from).collect())
}

/// A stroke that bends both ways, like a letter.
fn wave() -> Stroke {
    stroke("wave", (0..60).map(|i| f64::from(i) * 4.0).map(|x| (x, 40.0 * (x / 35.0).sin())))
}

// ---- arbitrary strokes ----------------------------------------------------------------------------------------------

/// Points as no hand would draw them, aimed at what is nearly degenerate.
fn points() -> impl Strategy<Value = Vec<Point>> {
    let count = 0..300_usize;
    let steps = |size: f64| prop::collection::vec((-size..size, -size..size), 0..300);
    let walk = |steps: Vec<(f64, f64)>| -> Vec<Point> {
        let mut at = Point::new(100.0, 100.0);
        steps
            .into_iter()
            .map(|s| {
                at += Vec2::from(s);
                at
            })
            .collect()
    };
    let staircase = (count.clone(), select(vec![1.0, 4.0, 25.0]), any::<u64>()).prop_map(|(n, step, bits)| {
        let mut at = Point::ORIGIN;
        let mut stairs = vec![at];
        for i in 0..n {
            at += if bits >> (i % 64) & 1 == 0 { Vec2::new(step, 0.0) } else { Vec2::new(0.0, step) };
            stairs.push(at);
        }
        stairs
    });
    let there_and_back = (count.clone(), -1.0..1.0_f64, 0.0..2.0_f64).prop_map(|(n, skew, tremor)| {
        (0..n)
            .map(|i| {
                let u = (i as f64 / 40.0 * PI).cos() * 100.0;
                Point::new(u, skew * u + tremor * (i as f64 * 2.3).sin())
            })
            .collect()
    });
    let nearly_equal = (count.clone(), select(vec![1e-14, 1e-9, 1e-4, 1e-3, 2e-3])).prop_map(|(n, step)| {
        (0..n).map(|i| Point::new(50.0 + step * (i * i % 7) as f64, 20.0 - step * (i % 3) as f64)).collect()
    });
    let nearly_closed = (count, 1.0..200.0_f64, -0.3..0.3_f64, 0.5..3.0_f64).prop_map(|(n, r, open, turns)| {
        (0..n)
            .map(|i| {
                let a = (turns.round() * TAU + open) * i as f64 / n.max(2) as f64;
                Point::new(r * a.cos(), 0.7 * r * a.sin())
            })
            .collect()
    });
    let drawn = prop_oneof![
        steps(0.5).prop_map(walk),
        steps(3.0).prop_map(walk),
        steps(40.0).prop_map(walk),
        staircase,
        there_and_back,
        nearly_equal,
        nearly_closed,
    ];
    // Repeated points, and all of it elsewhere.
    (drawn, prop::bool::weighted(0.3), select(vec![0.0, -1e4, 1e7])).prop_map(|(drawn, doubled, away)| {
        let times = if doubled { 2 } else { 1 };
        drawn.into_iter().flat_map(|p| std::iter::repeat_n(p + Vec2::new(away, -0.5 * away), times)).collect()
    })
}

fn options() -> impl Strategy<Value = FitOptions> {
    let closing = select(vec![Closing::Auto, Closing::Yes, Closing::No]);
    (select(Preset::ALL.to_vec()), closing)
        .prop_map(|(preset, closed)| FitOptions { closed, ..FitOptions::preset(preset) })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_stroke_gives_a_sound_curve_or_a_fixed_word(points in points(), options in options()) {
        let dot = points.is_empty() || extent(&points) < 5e-4;
        let drawing = points.len() > 1 && extent(&points) > 2e-3;
        match judged(&Stroke::new("any", points), &options) {
            Ok(_) => prop_assert!(!dot),
            // A straight stroke that must be closed encloses nothing.
            Err("unfittable") => prop_assert!(options.closed == Closing::Yes),
            Err(code) => prop_assert!(code == "too-short" && !drawing, "{}", code),
        }
    }

    #[test]
    fn any_stroke_in_any_unit_is_fitted_as_in_pixels(points in points(), options in options(), power in -9..9_i32) {
        // A power of two scales without rounding: nothing at all may change but the unit.
        let unit = f64::from(power * 3).exp2();
        let larger = points.iter().map(|p| (p.to_vec2() * unit).to_point()).collect();
        let in_px = judged(&Stroke::new("px", points), &options);
        let in_unit = judged(&Stroke::new("unit", larger), &FitOptions { pixel_size: unit, ..options });
        match (in_px, in_unit) {
            (Ok(a), Ok(b)) => prop_assert_eq!(a.spline.segments().len(), b.spline.segments().len()),
            (a, b) => prop_assert_eq!(a.err(), b.err()),
        }
    }

    #[test]
    fn a_coordinate_that_is_no_number_is_found(
        points in points(),
        at in any::<prop::sample::Index>(),
        bad in select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
        in_x in any::<bool>(),
    ) {
        prop_assume!(!points.is_empty());
        let mut points = points;
        let index = at.index(points.len());
        *(if in_x { &mut points[index].x } else { &mut points[index].y }) = bad;
        prop_assert_eq!(judged(&Stroke::new("bad", points), &FitOptions::default()).err(), Some("not-finite"));
    }
}

// ---- what another implementation fails on ---------------------------------------------------------------------------

#[test]
fn nothing_one_point_and_equal_points_are_too_short() {
    for n in [0, 1, 2, 20] {
        let dot = stroke("dot", std::iter::repeat_n((12.0, 34.0), n));
        for preset in Preset::ALL {
            assert_eq!(judged(&dot, &FitOptions::preset(preset)).err(), Some("too-short"), "{n} points");
        }
    }
}

#[test]
fn two_points_give_the_line_between_them() {
    let fit = fitted(&stroke("two", [(10.0, 20.0), (110.0, 95.0)]), &FitOptions::default());
    let [line] = fit.spline.segments() else { panic!("{:?}", fit.spline) };
    assert_eq!(line.kind(), Kind::Line);
    assert!((line.length - 125.0).abs() < 1e-6 && fit.report.max_deviation < 1e-6);
}

#[test]
fn doubled_points_change_nothing() {
    let once = wave();
    let twice = Stroke::new("twice", once.points.iter().flat_map(|p| [*p, *p]).collect());
    let options = FitOptions::default();
    assert_eq!(fitted(&once, &options).spline, fitted(&twice, &options).spline);
}

#[test]
fn a_tremor_of_a_few_thousandths_of_a_pixel_that_ends_where_it_began_is_fitted_or_too_short() {
    let n = |i: i32| (50.0 + 0.001 * f64::from(i * i % 7), 20.0 - 0.001 * f64::from(i % 3));
    for count in [8, 22, 43, 64, 300] {
        let code = judged(&stroke("tremor", (0..count).map(n)), &FitOptions::default()).err();
        assert!([None, Some("too-short")].contains(&code), "{count} points: {code:?}");
    }
}

#[test]
fn a_blot_is_fitted_with_bounded_work_whatever_is_set() {
    // A walk of half pixels: a curl of next to no radius is as near to it as any curve.
    let mut state = 1_u64;
    let mut step = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
    };
    for round in 0..60 {
        let mut at = Point::new(100.0, 100.0);
        let points = (0..20 + 4 * round).map(|_| {
            at += Vec2::new(step(), step());
            at
        });
        let blot = Stroke::new("blot", points.collect());
        for preset in Preset::ALL {
            let fit = fitted(&blot, &FitOptions { closed: Closing::No, ..FitOptions::preset(preset) });
            let turning: f64 = fit.spline.segments().iter().map(|s| s.absolute_turning()).sum();
            assert!(turning < 300.0, "{preset:?}, round {round}: turns by {turning}");
        }
    }
}

#[test]
fn a_closed_stroke_without_any_feasible_edge_still_gives_a_closed_curve() {
    // Tolerances that no primitive meets, and joins that none of the kinds can make.
    let tight = FitOptions { closed: Closing::Yes, max_error: 0.01, max_join_error: 1e-9, ..FitOptions::default() };
    let unjoinable = FitOptions { clothoid_cost: None, closed: Closing::Yes, ..FitOptions::default() };
    let jagged = stroke(
        "jagged",
        (0..80).map(|i| f64::from(i) * TAU / 80.0).map(|a| {
            let r = 100.0 + 8.0 * (a * 17.0).sin();
            (r * a.cos(), r * a.sin())
        }),
    );
    for options in [tight, unjoinable] {
        let fit = fitted(&jagged, &options);
        assert!(fit.spline.is_closed());
        assert!(!fit.warnings.is_empty(), "it was not what the options asked, and nobody was told");
        assert!(fit.report.max_deviation < 20.0, "{}", fit.report.max_deviation);
    }
}

#[test]
fn a_spiral_of_twenty_turns_is_followed() {
    let spiral = stroke(
        "spiral",
        (0..2000).map(|i| f64::from(i) / 2000.0).map(|u| {
            let (r, a) = (10.0 + 240.0 * u, 20.0 * TAU * u);
            (r * a.cos(), r * a.sin())
        }),
    );
    let fit = fitted(&spiral, &FitOptions::default());
    assert!(fit.report.max_deviation < 5.0 && fit.report.rms_deviation < 1.5, "{:?}", fit.report);
    assert!(!fit.spline.is_closed());
    let turned: f64 = fit.spline.segments().iter().map(|s| s.turning()).sum();
    assert!((turned - 20.0 * TAU).abs() < 0.5, "turns by {turned}");
}

#[test]
fn a_circle_traced_three_times_stays_a_circle() {
    for (turns, tremor) in [(3.0, 0.0), (3.0, 1.0), (2.93, 1.0)] {
        let circle = stroke(
            "circle",
            (0..=360).map(f64::from).map(|i| {
                let (a, r) = (turns * TAU * i / 360.0, 100.0 + tremor * (1.7 * i).sin());
                (200.0 + r * a.cos(), 200.0 + r * a.sin())
            }),
        );
        let fit = fitted(&circle, &FitOptions::default());
        assert!(fit.report.max_deviation < 3.0, "{turns} turns: {:?}", fit.report);
    }
}

/// Once around an ellipse, in either direction.
fn ellipse(radius: f64, narrow: f64, direction: f64, tremor: f64) -> Stroke {
    let count = (TAU * radius / 4.0).ceil();
    stroke(
        "ellipse",
        (0..=count as usize).map(|i| i as f64).map(|i| {
            let (a, r) = (direction * TAU * i / count, radius + tremor * (1.7 * i).sin());
            (200.0 + r * a.cos(), 300.0 + narrow * r * a.sin())
        }),
    )
}

#[test]
fn a_full_circle_is_one_closed_arc() {
    for (radius, direction, tremor) in [(12.0, 1.0, 0.0), (60.0, -1.0, 0.5), (400.0, 1.0, 1.0)] {
        for preset in [Preset::Default, Preset::Accurate, Preset::LinesArcs] {
            let fit = fitted(&ellipse(radius, 1.0, direction, tremor), &FitOptions::preset(preset));
            let [arc] = fit.spline.segments() else { panic!("{preset:?} {radius}: {:?}", fit.spline.segments()) };
            assert_eq!((fit.spline.is_closed(), fit.spline.joins()), (true, &[Continuity::G3][..]));
            assert_eq!(arc.kind(), Kind::Arc);
            assert!((arc.turning() - direction * TAU).abs() < 1e-12, "turns by {}", arc.turning());
            assert!((1.0 / arc.kappa0.abs() - radius).abs() < 0.1 + 0.1 * tremor, "{} but {radius}", 1.0 / arc.kappa0);
        }
    }
}

#[test]
fn an_ellipse_is_no_circle() {
    for preset in [Preset::Default, Preset::LinesArcs, Preset::Clothoids] {
        for narrow in [0.4, 0.7] {
            let fit = fitted(&ellipse(100.0, narrow, 1.0, 0.0), &FitOptions::preset(preset));
            assert!(fit.spline.is_closed() && fit.spline.segments().len() > 2, "{preset:?}: {:?}", fit.spline);
        }
    }
}

#[test]
fn a_retraced_line_is_open_and_keeps_its_end() {
    for last in [200, 150, 110] {
        let there = (0..=100).map(f64::from);
        let back = (0..100).rev().take(last - 100).map(f64::from);
        let line = stroke("retraced", there.chain(back).map(|u| (50.0 + 2.0 * u, 80.0 + u + 0.4 * (u * 1.3).sin())));
        let fit = fitted(&line, &FitOptions::default());
        assert!(!fit.spline.is_closed(), "back to {last}");
        let segments = fit.spline.segments();
        let end = segments[segments.len() - 1].end();
        let (first_point, last_point) = (line.points[0], line.points[line.points.len() - 1]);
        assert!((segments[0].start - first_point).hypot() < 3.0, "starts at {:?}", segments[0].start);
        assert!((end - last_point).hypot() < 3.0, "ends at {end:?}, not at {last_point:?}");
        assert!(fit.report.max_deviation < 3.0, "{:?}", fit.report);
    }
}

#[test]
fn a_butterfly_of_clothoids_alone_stays_near_its_stroke() {
    // Fay's butterfly curve, once around.
    let butterfly = stroke(
        "butterfly",
        (0..=300).map(|i| f64::from(i) * TAU / 300.0).map(|t| {
            let r = 50.0 * (t.sin().exp() - 2.0 * (4.0 * t).cos() + ((2.0 * t - PI) / 24.0).sin().powi(5));
            (r * t.cos(), -r * t.sin())
        }),
    );
    let fit = fitted(&butterfly, &FitOptions::preset(Preset::Clothoids));
    assert!(fit.report.max_deviation < 7.0 && fit.report.rms_deviation < 2.0, "{:?}", fit.report);
}

#[test]
fn coordinates_a_thousand_times_larger_are_fitted_with_bounded_work() {
    let wave = wave();
    let large = Stroke::new("large", wave.points.iter().map(|p| (p.to_vec2() * 1000.0).to_point()).collect());
    let fit = fitted(&large, &FitOptions::default());
    // Pixels are pixels: the polygon that the points make is now a real polygon, but its samples do not grow with its size.
    assert!(fit.report.samples < 3000 && fit.report.nodes < 300_000, "{:?}", fit.report);
}

#[test]
fn small_detail_far_from_the_origin_is_fitted_with_exact_joins() {
    // Twelve digits before the detail: more than a double has at a pixel of 1e-6.
    let wave = wave();
    let points = wave.points.iter().map(|p| Point::new(1e9, -1e9) + p.to_vec2() * 1e-3);
    let fit = fitted(&Stroke::new("far", points.collect()), &FitOptions { pixel_size: 1e-3, ..FitOptions::default() });
    assert!(fit.report.max_deviation < 5e-3, "{:?}", fit.report);
}

#[test]
fn a_million_points_are_fitted_with_work_that_grows_with_the_curve_only() {
    let points = |n: u32| {
        stroke("dense", (0..n).map(|i| f64::from(i) * 240.0 / f64::from(n)).map(|x| (x, 40.0 * (x / 35.0).sin())))
    };
    let (sparse, dense) = (fit(&points(300), &FitOptions::default()), fit(&points(1_000_000), &FitOptions::default()));
    let (sparse, dense) = (sparse.expect("it is a curve"), dense.expect("it is a curve"));
    assert_eq!(dense.report.points, 1_000_000);
    assert!(dense.report.nodes < 2 * sparse.report.nodes, "{} and {}", dense.report.nodes, sparse.report.nodes);
    assert!(dense.report.max_deviation < 5.0 && !dense.spline.is_closed());
}

/// The largest magnitude of curvature.
fn sharpest(fit: &Fit) -> f64 {
    fit.spline.segments().iter().map(|s| s.kappa0.abs().max(s.kappa1.abs())).fold(0.0, f64::max)
}

#[test]
fn no_piece_bends_to_less_than_the_least_radius() {
    // Up, round a bend of 5 px, and down again; then a wave.
    let leg = (0..40).map(|i| (0.0, f64::from(i) * 3.0));
    let bend = (0..=12).map(|i| PI * (1.0 - f64::from(i) / 12.0)).map(|a| (5.0 + 5.0 * a.cos(), 120.0 + 5.0 * a.sin()));
    let back = (0..40).map(|i| (10.0 + 8.0 * (f64::from(i) / 4.0).sin(), 117.0 - f64::from(i) * 3.0));
    let hairpin = stroke("hairpin", leg.chain(bend).chain(back));
    for min_radius in [1.0, 8.0, 12.0, 20.0] {
        let options = FitOptions { min_radius, corner_score: 1e9, ..FitOptions::default() };
        let fit = fitted(&hairpin, &options);
        let sharpest = sharpest(&fit);
        assert!(sharpest <= (1.0 + 1e-9) / min_radius, "{} for {min_radius}", 1.0 / sharpest);
        // The others have to be paid for by leaving the stroke.
        assert!(min_radius > 1.0 || fit.report.max_deviation < 5.0, "{:?}", fit.report);
    }
}

proptest! {
    #[test]
    fn no_hook_bends_to_less_than_the_least_radius(
        turns in prop::collection::vec((0.5..12.0_f64, -1.2..1.2_f64), 6..30),
        min_radius in 1.0..40.0_f64,
        corner_score in select(vec![1.0, 1e9]),
        preset in select(Preset::ALL.to_vec()),
    ) {
        let mut at = (Point::ORIGIN, 0.0);
        let points = turns.iter().map(|(step, turn)| {
            at.1 += turn;
            at.0 += fairpath_curve::trig::unit(at.1) * *step;
            at.0
        });
        let options = FitOptions { min_radius, corner_score, ..FitOptions::preset(preset) };
        let drawn = Stroke::new("hook", points.collect());
        let sharpest = sharpest(&fit(&drawn, &options).expect("it is a curve"));
        prop_assert!(sharpest <= (1.0 + 1e-9) / min_radius, "{} for {min_radius}", 1.0 / sharpest);
    }
}

// ---- options ------------------------------------------------------------------------------------------------------

type Setter = (&'static str, fn(&mut FitOptions, f64));

macro_rules! setters {
    (numbers: $($number:ident),*; costs: $($cost:ident),*; counts: $($count:ident),*) => {
        [
            $((stringify!($number), (|o, v| o.$number = v) as fn(&mut FitOptions, f64)),)*
            $((stringify!($cost), |o, v| o.$cost = Some(v)),)*
            $((stringify!($count), |o, v| o.$count = v as usize),)*
        ]
    };
}

fn setters() -> Vec<Setter> {
    setters!(
        numbers: pixel_size, closing_gap, corner_angle, corner_score, corner_share, corner_noise, corner_radius,
            corner_window, corner_distance, min_radius, sampling_falloff, points_per_circle, min_sampling, max_sampling, curvature_window, max_error,
            end_factor, sample_share, error_cost, free_error, shortness_cost, short_length, free_share, inflection_cost,
            transition_peak, max_join_error;
        costs: line_cost, arc_cost, clothoid_cost, g0_cost, g1_cost, g2_cost;
        counts: g2_overlap, g1_overlap, validation_rounds
    )
    .to_vec()
}

#[test]
fn every_number_among_the_options_is_set_to_absurd_values_here() {
    let named: Vec<&str> = setters().iter().map(|s| s.0).collect();
    let all = serde_json::to_value(FitOptions::default()).expect("options are a value");
    for (name, value) in all.as_object().expect("options are an object") {
        assert!(
            named.contains(&name.as_str()) || value.is_string() || value.is_boolean(),
            "{name} is a number that no test sets"
        );
    }
    assert_eq!(
        all.as_object().map(|o| o.values().filter(|v| !v.is_string() && !v.is_boolean()).count()),
        Some(named.len())
    );
}

#[test]
fn an_absurd_option_is_refused_or_still_gives_a_sound_curve() {
    let values = [
        0.0,
        -0.0,
        -1.0,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        1e300,
        -1e300,
        f64::MIN_POSITIVE,
        5e-324,
        1e-9,
        1e-3,
        0.3,
        1e3,
        1e6,
        1e12,
    ];
    let ring = stroke("ring", (0..90).map(|i| f64::from(i) * TAU / 90.0).map(|a| (60.0 * a.cos(), 40.0 * a.sin())));
    let (mut refused, mut fitted) = (0, 0);
    for (name, set) in setters() {
        for value in values {
            for stroke in [wave(), ring.clone()] {
                let mut options = FitOptions::default();
                set(&mut options, value);
                let drawn = Stroke::new(format!("{} with {name} = {value:e}", stroke.name), stroke.points);
                match judged(&drawn, &options) {
                    Ok(_) => fitted += 1,
                    Err("bad-option") => refused += 1,
                    Err(code) => assert!(name == "pixel_size" && code.starts_with("too-"), "{}: {code}", drawn.name),
                }
            }
        }
    }
    assert!(refused > 100 && fitted > 100, "{refused} refused, {fitted} fitted");
}

#[test]
fn options_that_are_no_numbers_are_refused_by_name() {
    for (name, set) in
        setters().into_iter().filter(|s| !["g2_overlap", "g1_overlap", "validation_rounds"].contains(&s.0))
    {
        for value in [f64::NAN, f64::INFINITY, -1.0] {
            let mut options = FitOptions::default();
            set(&mut options, value);
            let error = fit(&wave(), &options).expect_err(name);
            assert_eq!(error.code(), "bad-option", "{name} = {value}: {error}");
            assert!(error.to_string().contains(name), "{error}");
        }
    }
}

// ---- same bits ----------------------------------------------------------------------------------------------------

fn bits(fit: &Fit) -> Vec<u64> {
    let report = [fit.report.max_deviation, fit.report.rms_deviation, fit.report.cost];
    let parts = fit.spline.segments().iter();
    let numbers = parts.flat_map(|s| [s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1]).chain(report);
    numbers.map(f64::to_bits).collect()
}

/// Strokes of every file, or drawn here where the files are absent.
fn some_strokes() -> Vec<Stroke> {
    let mut some = vec![wave()];
    for (_, strokes) in corpus::corpus().unwrap_or_default() {
        some.extend(strokes.into_iter().step_by(7));
    }
    some
}

#[test]
fn fitting_again_and_in_many_threads_gives_the_same_bits() {
    let strokes = some_strokes();
    let fit_all = || -> Vec<Option<Vec<u64>>> {
        strokes.iter().map(|s| fit(s, &FitOptions::default()).ok().map(|f| bits(&f))).collect()
    };
    let once = fit_all();
    assert!(once.iter().flatten().all(|b| !b.is_empty()) && once[0].is_some());
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(fit_all)).collect();
        for thread in threads {
            assert_eq!(thread.join().expect("no fit panics"), once);
        }
    });
}

// ---- presets ------------------------------------------------------------------------------------------------------

/// Fits with stages, and whether the result departs from the options with a warning.
fn with_stages(stroke: &Stroke, preset: Preset) -> Option<(Fit, Stages, bool)> {
    let mut stages = Stages::default();
    let fit = fit_observed(stroke, &FitOptions::preset(preset), &mut (), Some(&mut stages)).ok()?;
    let departs = fit.warnings.iter().any(|w| ["loosened", "fell-back-to-polyline"].contains(&w.code.as_str()));
    Some((fit, stages, departs))
}

fn kinds(fit: &Fit) -> Vec<Kind> {
    fit.spline.segments().iter().map(fairpath_curve::Segment::kind).collect()
}

#[test]
fn the_polyline_preset_gives_lines_that_meet_at_angles() {
    for stroke in some_strokes() {
        let Some((fit, ..)) = with_stages(&stroke, Preset::Polyline) else { continue };
        assert!(kinds(&fit).iter().all(|k| *k == Kind::Line), "{}: {:?}", stroke.name, kinds(&fit));
        assert!(fit.spline.joins().iter().all(|j| *j == Continuity::G0), "{}", stroke.name);
    }
}

#[test]
fn the_lines_arcs_preset_gives_lines_and_arcs_that_meet_smoothly_but_at_corners() {
    let (mut all, mut departing) = (0, Vec::new());
    for stroke in some_strokes() {
        let Some((fit, stages, departs)) = with_stages(&stroke, Preset::LinesArcs) else { continue };
        assert!(kinds(&fit).iter().all(|k| *k != Kind::Clothoid), "{}: {:?}", stroke.name, kinds(&fit));
        all += 1;
        if departs {
            departing.push(stroke.name);
            continue;
        }
        let angles = fit.spline.joins().iter().filter(|j| **j == Continuity::G0).count();
        // A closed stroke with corners starts at one that is not listed.
        let corners = stages.corners.len() + usize::from(fit.spline.is_closed());
        assert!(angles <= corners, "{}: {angles} angles at {corners} corners", stroke.name);
    }
    assert!(departing.len() * 20 <= all, "{} of {all} were not made by the options: {departing:?}", departing.len());
}

#[test]
fn the_clothoids_preset_gives_clothoids_that_join_with_equal_curvature_but_at_corners() {
    let (mut all, mut segments, mut straight, mut departing) = (0, 0, 0, Vec::new());
    for stroke in some_strokes() {
        let Some((fit, stages, departs)) = with_stages(&stroke, Preset::Clothoids) else { continue };
        all += 1;
        if departs {
            // A few pixels hold too few samples to tell a clothoid.
            if extent(&stroke.points) > 12.0 {
                departing.push(stroke.name);
            }
            continue;
        }
        // A clothoid may come out with no curvature at all, where the stroke is straight, and as an arc where it may not bend more.
        segments += kinds(&fit).len();
        straight += kinds(&fit).iter().filter(|k| **k == Kind::Line).count();
        let sharpest = 1.0 / FitOptions::default().min_radius;
        let mut arcs = fit.spline.segments().iter().filter(|s| s.kind() == Kind::Arc);
        assert!(arcs.all(|a| a.kappa0.abs() == sharpest), "{}: {:?}", stroke.name, kinds(&fit));
        let weaker = fit.spline.joins().iter().filter(|j| **j < Continuity::G2).count();
        let corners = stages.corners.len() + usize::from(fit.spline.is_closed());
        assert!(weaker <= corners, "{}: {weaker} joins without equal curvature at {corners} corners", stroke.name);
    }
    assert!(straight * 20 <= segments, "{straight} of {segments} are straight");
    assert!(departing.len() * 20 <= all, "{} of {all} were not made by the options: {departing:?}", departing.len());
}
