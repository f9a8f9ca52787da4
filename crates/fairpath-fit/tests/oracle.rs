//! The steps of the method, looked at one by one from outside: sampling, candidates and path obey what the paper asks of them.

#[path = "common/corpus.rs"]
mod corpus;

use fairpath_curve::{Kind, Point, Segment};
use fairpath_fit::{Candidate, Closing, Deviation, FitOptions, Preset, Stages, Stroke, fit_observed};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The paper's corner-free, closed and open strokes drawn here, and every fifth real one.
fn strokes() -> Vec<Stroke> {
    let drawn = |name: &str, f: &dyn Fn(f64) -> (f64, f64)| {
        Stroke::new(name, (0..=120).map(|i| Point::from(f(f64::from(i) / 120.0))).collect())
    };
    let tau = std::f64::consts::TAU;
    let mut all = vec![
        drawn("wave", &|u| (240.0 * u, 40.0 * (7.0 * u).sin())),
        drawn("ellipse", &|u| (100.0 * (tau * u).cos(), 60.0 * (tau * u).sin())),
        drawn("angle", &|u| (200.0 * u, 150.0 * (u - 0.5).abs())),
        drawn("heart", &|u| (100.0 * (tau * u).sin().powi(3), 80.0 * (tau * u).cos() - 30.0 * (2.0 * tau * u).cos())),
    ];
    for (_, strokes) in corpus::corpus().unwrap_or_default() {
        all.extend(strokes.into_iter().step_by(5));
    }
    all
}

/// Fits every stroke and looks at its stages: how many there were to look at.
fn each(options: &FitOptions, look: impl Fn(&str, &Stages) + Sync) -> usize {
    strokes()
        .par_iter()
        .filter(|stroke| {
            let mut stages = Stages::default();
            let Ok(fit) = fit_observed(stroke, options, &mut (), Some(&mut stages)) else { return false };
            // What was loosened was made by other options than those asked for.
            if fit.warnings.iter().any(|w| w.code != "closed-by-trimming") {
                return false;
            }
            look(&stroke.name, &stages);
            true
        })
        .count()
}

/// Sample `i` of a stroke or of one of its turns.
fn sample(stages: &Stages, i: usize) -> Point {
    stages.samples[i % stages.samples.len()]
}

/// Largest distance of the samples that a candidate covers to its continuation on both sides: a fit measures across the curve, also
/// where a stroke turns back and a sample lies beyond the end.
fn farthest(stages: &Stages, c: &Candidate) -> f64 {
    let way: f64 = (c.first..c.last).map(|i| (sample(stages, i + 1) - sample(stages, i)).hypot()).sum();
    let (s, more) = (&c.segment, 0.5 * way);
    let long = Segment {
        start: s.point_at(-more),
        heading: s.heading_at(-more),
        length: s.length + 2.0 * more,
        kappa0: s.curvature_at(-more),
        kappa1: s.curvature_at(s.length + more),
    };
    (c.first..=c.last).map(|i| long.nearest(sample(stages, i)).distance).fold(0.0, f64::max)
}

/// What a fit may misjudge a distance by: it stops looking for the foot of a point when it is this near, px.
const FOOT: f64 = 0.15;

#[test]
fn the_error_of_a_candidate_is_the_largest_distance_of_its_samples() {
    // With all weight on the samples these are the data.
    let options = FitOptions { deviation: Deviation::Max, sample_share: 1.0, ..FitOptions::default() };
    let n = each(&options, |name, stages| {
        let mut off: Vec<f64> = Vec::new();
        for c in &stages.candidates {
            let truth = farthest(stages, c);
            // The vertices between the samples are data as well, so it may be larger.
            assert!(c.error > 0.95 * truth - FOOT, "{name}: {c:?}: {truth}");
            off.push(c.error - truth);
        }
        off.sort_by(f64::total_cmp);
        if let Some(typical) = off.get(off.len() / 2) {
            // On a staircase of 4 px, sampled further apart than that, its steps stand out by two pixels.
            assert!(*typical < 2.5, "{name}: errors are {typical} px larger than the distances of the samples");
        }
    });
    assert!(n >= 4, "{n} strokes");
}

#[test]
fn no_candidate_leaves_its_samples_further_than_allowed() {
    for preset in [Preset::Default, Preset::Accurate, Preset::LinesArcs] {
        let options = FitOptions::preset(preset);
        let n = each(&options, |name, stages| {
            for c in &stages.candidates {
                let truth = farthest(stages, c);
                assert!(truth <= options.max_error + FOOT, "{name}: {c:?} is {truth} px off");
            }
        });
        assert!(n >= 4, "{n} strokes");
    }
}

#[test]
fn candidates_cover_their_samples_in_order_from_end_to_end() {
    let (all, short) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let n = each(&FitOptions::default(), |name, stages| {
        let samples = stages.samples.len();
        assert!(!stages.candidates.is_empty(), "{name}");
        for c in &stages.candidates {
            assert!(c.first < samples && c.first < c.last && c.last <= c.first + samples, "{name}: {c:?}");
            assert!(stages.closed || c.last < samples, "{name}: {c:?}");
            let least = match c.segment.kind() {
                Kind::Line => 1,
                Kind::Arc => 2,
                Kind::Clothoid => 3,
            };
            // A clothoid may come out straight or round.
            assert!(c.last - c.first >= least, "{name}: {c:?}");
            // It begins at the foot of its first sample and ends at that of its last.
            let (from, to) = (c.segment.start, c.segment.end());
            let reach = FitOptions::default().max_error + FOOT;
            all.fetch_add(1, Ordering::Relaxed);
            if (from - sample(stages, c.first)).hypot().max((to - sample(stages, c.last)).hypot()) >= reach {
                short.fetch_add(1, Ordering::Relaxed);
                println!("{name}: {c:?} ends away from its samples");
            }
        }
    });
    // Where a stroke is smaller than the radius of its curve the walk along a candidate may stop early.
    let (all, short) = (all.into_inner(), short.into_inner());
    assert!(short * 10_000 <= all, "{short} of {all} candidates end away from their samples");
    assert!(n >= 4, "{n} strokes");
}

#[test]
fn no_candidate_runs_through_a_corner() {
    let seen = AtomicUsize::new(0);
    let n = each(&FitOptions::default(), |name, stages| {
        seen.fetch_add(stages.corners.len(), Ordering::Relaxed);
        let last = stages.samples.len() - usize::from(!stages.closed);
        assert!(stages.corners.windows(2).all(|c| c[0] < c[1]), "{name}: {:?}", stages.corners);
        let inside = |c: usize| c < last && (c > 0 || stages.closed);
        assert!(stages.corners.iter().all(|&c| inside(c)), "{name}: {:?}", stages.corners);
        for c in &stages.candidates {
            assert!(!stages.corners.iter().any(|&k| c.first < k && k < c.last), "{name}: {c:?} {:?}", stages.corners);
        }
    });
    let corners = seen.into_inner();
    assert!(n >= 4 && corners > 0, "{n} strokes with {corners} corners");
}

#[test]
fn a_square_has_four_corners_wherever_it_was_begun_and_whichever_way_it_was_drawn() {
    for begun in [0, 10, 37] {
        for backward in [false, true] {
            let side = |i: usize| match (i / 25 % 4, (i % 25) as f64 * 4.0) {
                (0, u) => (u, 0.0),
                (1, u) => (100.0, u),
                (2, u) => (100.0 - u, 100.0),
                (_, u) => (0.0, 100.0 - u),
            };
            let tilt = |(x, y): (f64, f64)| Point::new(0.96 * x - 0.28 * y, 0.28 * x + 0.96 * y);
            let mut points: Vec<Point> = (0..=100).map(|i| tilt(side(begun + i))).collect();
            if backward {
                points.reverse();
            }
            let mut stages = Stages::default();
            let fitted =
                fit_observed(&Stroke::new("square", points), &FitOptions::default(), &mut (), Some(&mut stages));
            assert!(fitted.is_ok_and(|f| f.spline.is_closed()));
            let corners: Vec<Point> = stages.corners.iter().map(|&i| stages.samples[i]).collect();
            assert_eq!(corners.len(), 4, "{corners:?}");
            for corner in corners {
                let off = |v: f64| v.abs().min((v - 100.0).abs());
                let (x, y) = (0.96 * corner.x + 0.28 * corner.y, 0.96 * corner.y - 0.28 * corner.x);
                assert!(off(x).max(off(y)) < 3.0, "{x}, {y}");
            }
        }
    }
}

#[test]
fn the_path_leads_from_end_to_end_with_the_overlaps_of_its_joins() {
    for (g2, g1) in [(2, 1), (1, 1), (0, 0)] {
        let options = FitOptions { g2_overlap: g2, g1_overlap: g1, g1_cost: Some(10.0), ..FitOptions::default() };
        let n = each(&options, |name, stages| {
            let path: Vec<&Candidate> = stages.path.iter().map(|&i| &stages.candidates[i]).collect();
            let (first, last) = (path[0], path[path.len() - 1]);
            let samples = stages.samples.len();
            let mut end = first.last;
            for pair in path.windows(2) {
                // Positions run on through the start of a ring.
                let ahead = (pair[1].first + 2 * samples - end % samples) % samples;
                let overlap = if ahead == 0 { 0 } else { samples - ahead };
                let corner = stages.corners.contains(&(end % samples));
                let allowed = if corner { vec![0] } else { vec![g2, g1] };
                assert!(allowed.contains(&overlap), "{name}: {overlap} at sample {end} of {samples}");
                end = end - overlap + (pair[1].last - pair[1].first);
            }
            if !stages.closed {
                assert_eq!((first.first, end), (0, samples - 1), "{name}");
            } else {
                // Once around, to a join with the first.
                let around = end - first.first;
                assert!((samples..=samples + 2).contains(&around), "{name}: {around} of {samples}, ends {}", last.last);
            }
        });
        assert!(n >= 4, "{n} strokes");
    }
}

/// Arc lengths of the samples of an open stroke along its points.
fn arc_lengths(name: &str, stages: &Stages) -> Vec<f64> {
    let points = &stages.points;
    let (mut edge, mut at, mut out) = (0, 0.0, Vec::new());
    for sample in &stages.samples {
        loop {
            assert!(
                edge + 1 < points.len(),
                "{name}: a sample at {sample:?} is not on the stroke after those before it"
            );
            let (a, v) = (points[edge], points[edge + 1] - points[edge]);
            let u = ((*sample - a).dot(v) / v.hypot2()).clamp(0.0, 1.0);
            let on =
                (*sample - (a + v * u)).hypot() < 1e-6 && out.last().is_none_or(|s| at + u * v.hypot() >= s - 1e-6);
            if on {
                out.push(at + u * v.hypot());
                break;
            }
            at += v.hypot();
            edge += 1;
        }
    }
    out
}

#[test]
fn samples_lie_on_the_stroke_in_order_and_their_spacing_changes_as_slowly_as_asked() {
    for falloff in [0.1, 0.2, 0.4] {
        let options = FitOptions { sampling_falloff: falloff, closed: Closing::No, ..FitOptions::default() };
        // Along one step of the integral of the rate, the rate changes by this factor at most.
        let fastest = falloff.exp() * 1.02;
        let uneven = AtomicUsize::new(0);
        let n = each(&options, |name, stages| {
            let s = arc_lengths(name, stages);
            let last = s.len() - 1;
            let mut even = true;
            let stop = |i: usize| i == 0 || i == last || stages.corners.contains(&i);
            for i in 0..last {
                let gap = s[i + 1] - s[i];
                // Up to twice as dense, since a stretch holds a whole number of steps.
                let dense = gap < 0.499 * options.min_sampling && !(stop(i) && stop(i + 1));
                let ratio = if i > 0 && !stop(i) { gap / (s[i] - s[i - 1]) } else { 1.0 };
                if dense || gap > options.max_sampling || ratio >= fastest || ratio <= 1.0 / fastest {
                    println!("{name}: {gap} px after sample {i} of {last}, {ratio} times the one before");
                    even = false;
                }
            }
            uneven.fetch_add(usize::from(!even), Ordering::Relaxed);
        });
        assert!(n >= 4, "{n} strokes");
        // Where a stroke retraces itself the arc length of a sample is not to be told from its place.
        let uneven = uneven.into_inner();
        assert!(uneven * 20 <= n, "{uneven} of {n} strokes are sampled unevenly");
    }
}

#[test]
fn a_stroke_is_closed_when_asked_and_open_when_asked() {
    for (closed, closing) in [(true, Closing::Yes), (false, Closing::No)] {
        let n = each(&FitOptions { closed: closing, ..FitOptions::default() }, |name, stages| {
            assert!(stages.closed == closed || stages.points.len() < 4, "{name}");
        });
        assert!(n >= 4, "{n} strokes");
    }
}

#[test]
fn a_circle_has_the_samples_that_the_options_ask_for() {
    let tau = std::f64::consts::TAU;
    for per_circle in [8.0, 12.0, 30.0] {
        let options = FitOptions { points_per_circle: per_circle, ..FitOptions::default() };
        let circle =
            |i: i32| Point::new(80.0 * (f64::from(i) * tau / 200.0).cos(), 80.0 * (f64::from(i) * tau / 200.0).sin());
        let stroke = Stroke::new("circle", (0..=200).map(circle).collect());
        let mut stages = Stages::default();
        fit_observed(&stroke, &options, &mut (), Some(&mut stages)).expect("a circle can be fitted");
        let (samples, expected) = (stages.samples.len() as f64, per_circle);
        assert!(stages.closed && (samples - expected).abs() <= 1.0, "{samples} samples, not {expected}");
    }
}
