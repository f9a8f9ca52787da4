//! Which places of a stroke are meant as corners.
//!
//! A place is a corner where its neighbourhood is described much better by two arcs that meet there at an angle than by a
//! single arc (Baran et al. 2010, section 3.1, leave the details open). Several sizes of neighbourhood are tried: small ones
//! see corners that lie close together, large ones see obtuse corners through the tremor.

use crate::options::FitOptions;
use crate::polyline::Polyline;
use crate::primitive_fit::{chord, circle_through, refine};
use crate::walk::Datum;
use fairpath_curve::{Vec2, trig};

/// Distance of the evenly spaced points on which corners are looked for, px.
const SPACING: f64 = 2.0;

/// More points than this are not looked at: the spacing grows instead.
const MOST_POINTS: f64 = 40_000.0;

/// A neighbourhood whose two chords turn less than this is not looked at closely, radians.
const PLAINLY_SMOOTH: f64 = 0.45;

/// Arc lengths of the corners, increasing; the ends of an open stroke are not among them.
pub(crate) fn corners(line: &Polyline, closed: bool, options: &FitOptions) -> Vec<f64> {
    let length = line.length();
    let count = libm_round((length / SPACING).min(MOST_POINTS)).max(1.0) as usize;
    let spacing = length / count as f64;
    let mut hint = 0;
    let points: Vec<Vec2> = (0..=count).map(|i| line.at(spacing * i as f64, &mut hint)).collect();
    let n = if closed { count } else { count + 1 };
    let mut found: Vec<(f64, usize)> = Vec::new();
    let mut run: Vec<Datum> = Vec::new();
    for i in 0..n {
        let mut score = 0.0_f64;
        for window in options.corner_windows() {
            let k = libm_round(window / spacing) as usize;
            let fits = if closed { 2 * k < n } else { i >= k.min(MIN_SIDE) && i + k.min(MIN_SIDE) < n };
            if k < MIN_SIDE || !fits {
                continue;
            }
            let (left, right) = if closed { (k, k) } else { (k.min(i), k.min(n - 1 - i)) };
            // A side cut short by the stroke's end tells about as much as the smaller window already did.
            if left.min(right) < k.div_ceil(2) {
                continue;
            }
            let at = |j: isize| points[(i as isize + j).rem_euclid(n as isize) as usize];
            score = score.max(score_at(&at, left as isize, right as isize, options, &mut run));
        }
        if score >= options.corner_score {
            found.push((score, i));
        }
    }
    // The best of each neighbourhood stays.
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let reach = options.corner_distance / spacing;
    let mut kept: Vec<usize> = Vec::new();
    for (_, i) in found {
        let near = |&j: &usize| {
            let d = i.abs_diff(j) as f64;
            (if closed { d.min(n as f64 - d) } else { d }) < reach
        };
        if !kept.iter().any(near) {
            kept.push(i);
        }
    }
    kept.sort_unstable();
    kept.into_iter().map(|i| spacing * i as f64).collect()
}

/// The fewest steps on either side from which an arc can be judged.
const MIN_SIDE: usize = 4;

fn libm_round(v: f64) -> f64 {
    (v + 0.5).floor()
}

/// How much better two arcs describe the neighbourhood than one: the drop of the mean square distance, relative to what two
/// arcs leave plus a floor; zero where the arcs do not meet at an angle.
fn score_at(at: &impl Fn(isize) -> Vec2, left: isize, right: isize, options: &FitOptions, run: &mut Vec<Datum>) -> f64 {
    let (a, p, b) = (at(-left), at(0), at(right));
    let (into, out) = (p - a, b - p);
    let turn = trig::angle_of(Vec2::new(into.dot(out), into.cross(out))).abs();
    if turn < PLAINLY_SMOOTH {
        return 0.0;
    }
    let mut side = |range: &mut dyn Iterator<Item = isize>| {
        run.clear();
        run.extend(range.map(|j| Datum { point: at(j), s: j as f64, weight: 1.0 }));
        let fit = refine(&circle_through(run), run, 3, 2, 1.0);
        let line = refine(&chord(run), run, 2, 1, 1.0);
        if fit.normal.energy.is_finite() && fit.normal.energy <= line.normal.energy { fit } else { line }
    };
    let back = side(&mut (1..=left).map(|j| -j));
    let forth = side(&mut (1..=right));
    let sides = (back.normal.energy + forth.normal.energy) / (back.normal.weight + forth.normal.weight);
    // Both arcs were walked away from the corner; the arriving direction is opposite to that of the walk.
    let jump = trig::wrap_angle(forth.primitive.heading - back.primitive.heading - std::f64::consts::PI);
    if jump.abs() < options.corner_angle.to_radians() {
        return 0.0;
    }
    let whole = side(&mut (-left..=right));
    let one = whole.normal.energy / whole.normal.weight;
    let floor = options.corner_noise * options.corner_noise;
    (one - sides) / (sides + floor)
}
