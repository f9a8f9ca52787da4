//! Touching and overlapping curves: pairs of stretches that bounding could not part come in, contacts go out, one for each
//! connected group of pairs.

use crate::intersect::{Contact, Intersection, newton};
use crate::segment::Segment;

/// A pair of stretches, given by middle and half arc length, that may meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) s: f64,
    pub(crate) t: f64,
    pub(crate) half_s: f64,
    pub(crate) half_t: f64,
}

/// Curves nearer than this part of their size touch.
const TOUCH: f64 = 1e-9;

/// Groups shorter than this part of the size are points.
const POINT: f64 = 1e-6;

/// Joins pairs whose stretches touch on both curves; each group comes in order of the first arc length.
fn groups(mut pairs: Vec<Pair>) -> Vec<Vec<Pair>> {
    pairs.sort_by(|p, q| p.s.total_cmp(&q.s).then(p.t.total_cmp(&q.t)));
    let touches = |p: &Pair, q: &Pair| {
        (p.s - q.s).abs() <= 1.5 * (p.half_s + q.half_s) && (p.t - q.t).abs() <= 1.5 * (p.half_t + q.half_t)
    };
    let mut groups: Vec<Vec<Pair>> = Vec::new();
    for pair in pairs {
        // Only the ends of groups can touch: pairs come in order. A few back is enough, for each has few neighbours.
        let mut joined: Option<usize> = None;
        let mut i = 0;
        while i < groups.len() {
            if groups[i].iter().rev().take(24).any(|p| touches(p, &pair)) {
                match joined {
                    None => {
                        groups[i].push(pair);
                        joined = Some(i);
                    }
                    Some(first) => {
                        let other = groups.swap_remove(i);
                        groups[first].extend(other);
                        groups[first].sort_by(|p, q| p.s.total_cmp(&q.s));
                        continue;
                    }
                }
            }
            i += 1;
        }
        if joined.is_none() {
            groups.push(vec![pair]);
        }
    }
    groups
}

/// The contacts of the groups that are found to touch, or to cross at a very small angle.
pub(crate) fn resolve(a: &Segment, b: &Segment, pairs: Vec<Pair>) -> Vec<Intersection> {
    let size = a.length + b.length;
    let mut found = Vec::new();
    for group in groups(pairs) {
        let low = group.iter().fold(f64::INFINITY, |m, p| m.min(p.s - p.half_s)).max(0.0);
        let high = group.iter().fold(0.0_f64, |m, p| m.max(p.s + p.half_s)).min(a.length);
        let (low_t, high_t) =
            group.iter().fold((f64::INFINITY, 0.0_f64), |m, p| (m.0.min(p.t - p.half_t), m.1.max(p.t + p.half_t)));
        // Signed offsets of the first curve from the second, where it is near.
        let samples = if high - low <= POINT * size { 2 } else { 64 };
        let mut before: Option<(f64, f64, f64)> = None;
        let mut run: Option<(f64, f64, f64)> = None;
        let mut runs: Vec<(f64, f64, f64)> = Vec::new();
        for i in 0..=samples {
            let s = low + (high - low) * (f64::from(i) / f64::from(samples));
            let p = a.point_at(s);
            let near = b.nearest(p);
            let inside = near.s >= low_t - POINT * size && near.s <= high_t + POINT * size;
            if inside && near.distance <= TOUCH * size {
                run = Some(run.map_or((s, s, near.s), |(from, _, t)| (from, s, t)));
                before = None;
                continue;
            }
            runs.extend(run.take());
            let offset = b.tangent_at(near.s).cross(p - near.point);
            if let Some((s0, t0, offset0)) = before
                && inside
                && offset0 * offset < 0.0
                && let Some((x, y)) = newton(a, b, 0.5 * (s0 + s), 0.5 * (t0 + near.s))
                && (0.0..=a.length).contains(&x)
                && (0.0..=b.length).contains(&y)
            {
                found.push(Intersection { s: x, t: y, point: a.point_at(x), contact: Contact::Crossing, extent: 0.0 });
            }
            before = inside.then_some((s, near.s, offset));
        }
        runs.extend(run);
        // A touch between the samples: walk to the closest approach from the middle.
        if runs.is_empty() && found.is_empty() {
            let (mut s, mut distance) = (0.5 * (low + high), f64::INFINITY);
            let mut t = 0.5 * (low_t + high_t);
            for _ in 0..40 {
                let on_b = b.nearest(a.point_at(s));
                let on_a = a.nearest(on_b.point);
                let done = on_a.distance >= distance;
                (s, t, distance) = (on_a.s, on_b.s, on_a.distance);
                if done {
                    break;
                }
            }
            if distance <= TOUCH * size {
                runs.push((s, s, t));
            }
        }
        for (from, to, t) in runs {
            let s = 0.5 * (from + to);
            let is_point = to - from <= POINT * size;
            let t = if is_point { t } else { b.nearest(a.point_at(s)).s };
            let contact = if is_point { Contact::Touching } else { Contact::Overlap };
            let extent = if is_point { 0.0 } else { to - from };
            found.push(Intersection { s, t, point: a.point_at(s), contact, extent });
        }
    }
    found
}
