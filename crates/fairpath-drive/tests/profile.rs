//! Profiles: continuous grade, what lies between, parts put in the place of others, and smoothing.

use fairpath_drive::{Knot, Profile, ProfileError, smoothed};
use proptest::prelude::*;

/// Stations and heights, some close together.
fn points() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec((0.5..200.0_f64, -40.0..40.0_f64), 2..30).prop_map(|steps| {
        let mut station = 0.0;
        let point = |(gap, height): (f64, f64)| {
            station += gap;
            [station, height]
        };
        steps.into_iter().map(point).collect()
    })
}

fn knots(points: &[[f64; 2]]) -> Vec<Knot> {
    let knot =
        |(i, p): (usize, &[f64; 2])| Knot { station_m: p[0], height_m: p[1], grade: 0.1 * ((i % 5) as f64 - 2.0) };
    points.iter().enumerate().map(knot).collect()
}

#[test]
fn what_is_no_profile_is_refused() {
    let knot = |station_m: f64| Knot { station_m, height_m: 1.0, grade: 0.0 };
    assert_eq!(Profile::new(vec![knot(0.0)]), Err(ProfileError::TooFew(1)));
    assert!(matches!(Profile::catmull_rom(&[]), Err(ProfileError::TooFew(0))));
    for stations in [[0.0, 0.0], [1.0, 0.0], [0.0, f64::NAN], [0.0, f64::INFINITY]] {
        let made = Profile::new(stations.map(knot).to_vec());
        assert!(matches!(made, Err(ProfileError::Knot { knot: 1, .. })), "{made:?}");
    }
    let steep = Knot { grade: f64::NAN, ..knot(0.0) };
    assert!(matches!(Profile::new(vec![steep, knot(1.0)]), Err(ProfileError::Knot { knot: 0, .. })));
}

#[test]
fn profiles_that_lie_apart_have_no_sum() {
    let between = |from: f64, to: f64| Profile::monotone(&[[from, 1.0], [to, 2.0]]).unwrap();
    assert_eq!(between(0.0, 5.0).plus(&between(7.0, 9.0)), Err(ProfileError::Apart { end_m: 5.0, begin_m: 7.0 }));
    assert!(matches!(between(0.0, 5.0).plus(&between(5.0, 9.0)), Err(ProfileError::Apart { .. })));
}

#[test]
fn what_cannot_be_smoothed_is_refused() {
    let points = [[0.0, 1.0], [10.0, 2.0], [20.0, 0.0]];
    for weights in [&[1.0, 1.0][..], &[1.0, 0.0, 1.0], &[1.0, -1.0, 1.0], &[1.0, f64::NAN, 1.0], &[1.0; 4]] {
        assert!(
            matches!(smoothed(&points, weights, &[1.0; 2]), Err(ProfileError::Weights { points: 3, .. })),
            "{weights:?}"
        );
    }
    for stiffness in [&[1.0, 0.0][..], &[-1.0, 1.0], &[1.0, f64::NAN], &[f64::INFINITY, 1.0], &[1.0], &[1.0; 3]] {
        let made = smoothed(&points, &[1.0; 3], stiffness);
        assert!(matches!(made, Err(ProfileError::Stiffness { intervals: 2, .. })), "{stiffness:?}");
    }
    assert!(matches!(smoothed(&points[..1], &[1.0], &[]), Err(ProfileError::TooFew(1))));
}

#[test]
fn a_wave_of_the_length_that_is_told_is_halved() {
    let (spacing, stiffness) = (5.0, 2e6_f64);
    let length = std::f64::consts::TAU * (stiffness * spacing).powf(0.25);
    let points: Vec<[f64; 2]> = (0..2000)
        .map(|i| [spacing * f64::from(i), libm::cos(std::f64::consts::TAU * spacing * f64::from(i) / length)])
        .collect();
    let smooth = smoothed(&points, &vec![1.0; 2000], &vec![stiffness; 1999]).unwrap();
    // A crest far from both ends.
    let crest = length * (5000.0 / length).round();
    assert!((smooth.at(crest).height_m - 0.5).abs() < 0.01, "{}", smooth.at(crest).height_m);
}

#[test]
fn stiffness_leads_from_the_points_to_the_straight_line() {
    let points: Vec<[f64; 2]> =
        (0..60).map(|i| [f64::from(i) * 5.0, 0.05 * f64::from(i) + f64::from((i * 7) % 5 - 2)]).collect();
    let weights = vec![1.0; 60];
    let exact = smoothed(&points, &weights, &[1e-9; 59]).unwrap();
    for p in &points {
        assert!((exact.at(p[0]).height_m - p[1]).abs() < 1e-9);
    }
    let line = smoothed(&points, &weights, &[1e15; 59]).unwrap();
    let (grade, middle) = (line.at(0.0).grade, line.at(147.5).height_m);
    for i in 0..60 {
        let at = line.at(5.0 * f64::from(i));
        assert!((at.grade - grade).abs() < 1e-6, "{} {grade}", at.grade);
        assert!((at.height_m - middle - grade * (5.0 * f64::from(i) - 147.5)).abs() < 1e-4);
    }
    // By least squares the residuals have no mean.
    let mean: f64 = points.iter().map(|p| line.at(p[0]).height_m - p[1]).sum::<f64>() / 60.0;
    assert!(mean.abs() < 1e-6, "{mean}");
}

/// Where the stiffness changes, no height can be moved so that the sum of distances and bending becomes less.
#[test]
fn a_beam_of_changing_stiffness_is_at_its_least_energy() {
    let points: Vec<[f64; 2]> =
        (0..40).map(|i| [f64::from(i) * 5.0, 0.1 * f64::from(i) + f64::from((i * 7) % 5 - 2)]).collect();
    let weights: Vec<f64> = (0..40).map(|i| 0.5 + f64::from(i % 3)).collect();
    let stiffness: Vec<f64> = (0..39).map(|i| if i < 20 { 50.0 } else { 4000.0 }).collect();
    let energy = |profile: &Profile| {
        let misses: f64 =
            points.iter().zip(&weights).map(|(p, w)| w * (profile.at(p[0]).height_m - p[1]).powi(2)).sum();
        let bending = |piece: usize| {
            let [_, _, c, d] = profile.cubic(piece);
            let h = profile.knots()[piece + 1].station_m - profile.knots()[piece].station_m;
            // The integral of (2c + 6dt)².
            stiffness[piece] * h * (4.0 * c * c + 12.0 * c * d * h + 12.0 * d * d * h * h)
        };
        misses + (0..39).map(bending).sum::<f64>()
    };
    let best = smoothed(&points, &weights, &stiffness).unwrap();
    let least = energy(&best);
    for i in 0..40 {
        for (rise, turn) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)] {
            let mut knots = best.knots().to_vec();
            knots[i].height_m += rise;
            knots[i].grade += turn;
            let other = energy(&Profile::new(knots).unwrap());
            assert!(other > least, "knot {i} by {rise} and {turn}: {other} and {least}");
        }
    }
}

proptest! {
    #[test]
    fn heights_and_grades_go_on_where_pieces_meet(points in points()) {
        for profile in [
            Profile::new(knots(&points)).unwrap(),
            Profile::catmull_rom(&points).unwrap(),
            Profile::monotone(&points).unwrap(),
            smoothed(&points, &vec![1.0; points.len()], &vec![1e4; points.len() - 1]).unwrap(),
        ] {
            for piece in 0..profile.knots().len() - 1 {
                let (a, b) = (profile.knots()[piece], profile.knots()[piece + 1]);
                let h = b.station_m - a.station_m;
                let [p, q, c, d] = profile.cubic(piece);
                prop_assert!((p + h * (q + h * (c + h * d)) - b.height_m).abs() < 1e-9);
                prop_assert!((q + h * (2.0 * c + h * 3.0 * d) - b.grade).abs() < 1e-9);
                // Derivatives are those of the height.
                let (s, e) = (a.station_m + 0.37 * h, 1e-4 * h);
                let [before, at, after] = [s - e, s, s + e].map(|s| profile.at(s));
                let slope = (after.height_m - before.height_m) / (2.0 * e);
                prop_assert!((slope - at.grade).abs() < 1e-5 * (1.0 + at.grade.abs()));
                let bend = (after.grade - before.grade) / (2.0 * e);
                prop_assert!((bend - at.bend_per_m).abs() < 1e-5 * (1.0 + at.bend_per_m.abs()));
            }
        }
    }

    #[test]
    fn a_monotone_profile_stays_between_neighbours(points in points(), t in 0.0..1.0_f64) {
        let profile = Profile::monotone(&points).unwrap();
        for pair in points.windows(2) {
            let height = profile.at(pair[0][0] + t * (pair[1][0] - pair[0][0])).height_m;
            let (low, high) = (pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1]));
            prop_assert!(low - 1e-9 <= height && height <= high + 1e-9, "{height} between {low} and {high}");
        }
    }

    #[test]
    fn no_place_is_steeper_than_the_steepest(points in points(), ends in (0.0..1.0_f64, 0.0..1.0_f64)) {
        let profile = Profile::new(knots(&points)).unwrap();
        let [first, last] = profile.range_m();
        let at = |t: f64| first + t * (last - first);
        let range = [at(ends.0.min(ends.1)), at(ends.0.max(ends.1))];
        let (station, grade) = profile.steepest(range);
        prop_assert!(range[0] <= station && station <= range[1]);
        prop_assert_eq!(profile.at(station).grade, grade);
        for i in 0..=500 {
            let here = profile.at(range[0] + f64::from(i) / 500.0 * (range[1] - range[0])).grade;
            prop_assert!(here.abs() <= grade.abs() + 1e-12, "{here} and {grade}");
        }
    }

    #[test]
    fn sums_parts_and_reverses_are_what_they_are_called(a in points(), b in points(), t in (0.0..0.5_f64, 0.5..1.0_f64)) {
        let (a, b) = (Profile::new(knots(&a)).unwrap(), Profile::monotone(&b).unwrap());
        let close = |x: f64, y: f64| (x - y).abs() < 1e-9 * (1.0 + x.abs());
        let ([a0, a1], [b0, b1]) = (a.range_m(), b.range_m());
        let common = [a0.max(b0), a1.min(b1)];
        match a.plus(&b) {
            Ok(sum) => {
                prop_assert_eq!(sum.range_m(), common);
                for i in 0..50 {
                    let s = common[0] + f64::from(i) / 49.0 * (common[1] - common[0]);
                    prop_assert!(close(sum.at(s).height_m, a.at(s).height_m + b.at(s).height_m));
                }
            }
            Err(error) => prop_assert!(matches!(error, ProfileError::Apart { .. }) && common[0] >= common[1], "{error}"),
        }
        let [first, last] = a.range_m();
        let range = [first + t.0 * (last - first), first + t.1 * (last - first)];
        prop_assume!(range[1] > range[0]);
        let part = a.part(range).unwrap();
        for i in 0..50 {
            let s = f64::from(i) / 49.0 * (range[1] - range[0]);
            prop_assert!(close(part.at(s).height_m, a.at(range[0] + s).height_m));
            prop_assert!(close(part.reversed().at(part.range_m()[1] - s).height_m, part.at(s).height_m));
        }
    }

    #[test]
    fn a_part_that_is_put_in_changes_nothing_beside_it(
        points in prop::collection::vec(-40.0..40.0_f64, 20..40), at in 0.2..0.5_f64, transition in 0.0..60.0_f64,
    ) {
        let whole: Vec<[f64; 2]> = points.iter().enumerate().map(|(i, z)| [25.0 * i as f64, *z]).collect();
        let whole = Profile::monotone(&whole).unwrap();
        let from = at * whole.range_m()[1];
        let part = Profile::monotone(&[[from, 3.0], [from + 40.0, 12.0], [from + 90.0, 5.0]]).unwrap();
        let new = whole.with_part(&part, transition).unwrap();
        prop_assert_eq!(new.range_m(), whole.range_m());
        for i in 0..1000 {
            let s = f64::from(i) / 999.0 * whole.range_m()[1];
            if (from..=from + 90.0).contains(&s) {
                prop_assert!((new.at(s).height_m - part.at(s).height_m).abs() < 1e-9);
            }
            let beside = 25.0 + transition;
            if s < from - beside || s > from + 90.0 + beside {
                prop_assert_eq!(new.at(s), whole.at(s));
            }
        }
    }
}

#[test]
fn a_part_near_an_end_leaves_the_profile_whole() {
    let ground = Profile::catmull_rom(&[[0.0, 5.0], [50.0, 6.0], [100.0, 4.0]]).unwrap();
    let part = Profile::catmull_rom(&[[20.0, 9.0], [40.0, 9.5]]).unwrap();
    let with = ground.with_part(&part, 60.0).unwrap();
    assert_eq!(with.range_m(), [0.0, 100.0]);
    for (station, height) in [(0.0, 5.0), (20.0, 9.0), (40.0, 9.5), (100.0, 4.0)] {
        assert!((with.at(station).height_m - height).abs() < 1e-12, "at {station}");
    }
}
