//! G2 Hermite interpolation: two poses with curvature come in, three clothoid segments that meet them in G2 go out.
//!
//! After Bertolazzi and Frego, "On the G2 Hermite interpolation problem with clothoids" (2018): one clothoid has no freedom left
//! for given end curvatures, three have two degrees too many, which the lengths of the outer two take up. For given
//! outer lengths, as fractions of the whole, the two inner curvatures and the length are found by continuation: the one
//! clothoid of the G1 problem is the exact answer for its own end curvatures, and these are moved to those wanted.
//! Short enough outer segments always admit a solution. Among several fractions, and by a search from the best, the curve with
//! the least variation of curvature is chosen.

use crate::hermite_g1::hermite_g1;
use crate::segment::{Pose, Segment};
use crate::trig::{angle_of, wrap_angle};
use kurbo::{Point, Vec2};

/// The unit problem: from the origin to (1, 0).
#[derive(Clone, Copy)]
struct Ends {
    phi0: f64,
    phi1: f64,
    kappa0: f64,
    kappa1: f64,
}

/// Fractions of the length that the outer segments take.
type Fractions = [f64; 2];

/// Inner curvatures at the two joins, and the length of the whole.
type Unknowns = [f64; 3];

fn chain(ends: &Ends, [first, last]: Fractions, [a, b, length]: Unknowns) -> [Segment; 3] {
    let s0 = Segment::clothoid(Point::ORIGIN, ends.phi0, first * length, ends.kappa0, a);
    let s1 = Segment::clothoid(s0.end(), s0.end_heading(), (1.0 - first - last) * length, a, b);
    let s2 = Segment::clothoid(s1.end(), s1.end_heading(), last * length, b, ends.kappa1);
    [s0, s1, s2]
}

/// What is missing at the end, heading and position, and its derivatives by the unknowns.
fn residual(ends: &Ends, fractions: Fractions, unknowns: Unknowns) -> ([f64; 3], [[f64; 3]; 3]) {
    let segments = chain(ends, fractions, unknowns);
    let [a, b, _] = unknowns;
    let [first, last] = fractions;
    let part = [first, 1.0 - first - last, last];
    let curvature = [[ends.kappa0, a], [a, b], [b, ends.kappa1]];
    let end = segments[2].end();
    // How the heading at the start of each segment moves with each unknown.
    let mut heading = [0.0; 3];
    let mut moved = [Vec2::ZERO; 3];
    for (i, s) in segments.iter().enumerate() {
        let j = s.position_jacobian(s.length);
        let own = [
            if i == 0 {
                j.kappa1
            } else if i == 1 {
                j.kappa0
            } else {
                Vec2::ZERO
            },
            if i == 1 {
                j.kappa1
            } else if i == 2 {
                j.kappa0
            } else {
                Vec2::ZERO
            },
            (j.length + s.tangent_at(s.length)) * part[i],
        ];
        let half = 0.5 * s.length;
        let turning = [
            if i < 2 { half } else { 0.0 },
            if i > 0 { half } else { 0.0 },
            0.5 * (curvature[i][0] + curvature[i][1]) * part[i],
        ];
        for u in 0..3 {
            moved[u] += own[u] + j.heading * heading[u];
            heading[u] += turning[u];
        }
    }
    let missing = [segments[2].end_heading() - ends.phi1, end.x - 1.0, end.y];
    (missing, [heading, moved.map(|v| v.x), moved.map(|v| v.y)])
}

/// Solves a 3 × 3 system by Cramer's rule.
pub(crate) fn solve3(m: &[[f64; 3]; 3], r: [f64; 3]) -> [f64; 3] {
    let cross =
        |u: [f64; 3], v: [f64; 3]| [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let (c01, c12, c20) = (cross(m[0], m[1]), cross(m[1], m[2]), cross(m[2], m[0]));
    let det = m[0][0] * c12[0] + m[0][1] * c12[1] + m[0][2] * c12[2];
    std::array::from_fn(|i| (c12[i] * r[0] + c20[i] * r[1] + c01[i] * r[2]) / det)
}

/// Newton's method from a guess; `None` where it does not settle.
fn newton(ends: &Ends, fractions: Fractions, mut u: Unknowns) -> Option<Unknowns> {
    let mut before = f64::INFINITY;
    for _ in 0..12 {
        let (missing, jacobian) = residual(ends, fractions, u);
        let step = solve3(&jacobian, missing);
        let size = step[2].abs() + (step[0].abs() + step[1].abs()) * u[2].abs();
        if !size.is_finite() || size > 20.0 {
            return None;
        }
        for (value, d) in u.iter_mut().zip(step) {
            *value -= d;
        }
        if u[2] <= 0.0 {
            return None;
        }
        let rounding = 1e-14 * (1.0 + u[2] * (1.0 + u[0].abs() + u[1].abs()));
        if size <= rounding || (size <= 1e-9 && size >= 0.5 * before) {
            return Some(u);
        }
        before = size;
    }
    None
}

/// Follows the solution from the G1 clothoid to the wanted end curvatures.
fn follow(ends: &Ends, from: &Ends, fractions: Fractions, start: Unknowns) -> Option<Unknowns> {
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let (mut t, mut step) = (0.0, 0.5);
    let (mut u, mut before) = (start, None::<(f64, Unknowns)>);
    for _ in 0..60 {
        let next = f64::min(t + step, 1.0);
        let at = Ends {
            phi0: mix(from.phi0, ends.phi0, next),
            phi1: mix(from.phi1, ends.phi1, next),
            kappa0: mix(from.kappa0, ends.kappa0, next),
            kappa1: mix(from.kappa1, ends.kappa1, next),
        };
        // The secant through the last two answers predicts the next.
        let predicted = match before {
            Some((s, v)) => std::array::from_fn(|i| u[i] + (u[i] - v[i]) * ((next - t) / (t - s))),
            None => u,
        };
        match newton(&at, fractions, predicted) {
            Some(found) if (found[2] / u[2]).max(u[2] / found[2]) < 1.7 => {
                before = Some((t, u));
                (t, u) = (next, found);
                if t >= 1.0 {
                    return Some(u);
                }
                step *= 1.6;
            }
            _ => {
                step *= 0.4;
                if step < 1e-3 {
                    return None;
                }
            }
        }
    }
    None
}

/// Variation of curvature `∫ kappa'² ds` times the fifth power of the length: three powers make it free of scale, two more keep
/// wide detours, which vary less, from winning.
fn cost(ends: &Ends, [first, last]: Fractions, [a, b, length]: Unknowns) -> f64 {
    let rate = |d: f64, part: f64| d * d / part;
    (rate(a - ends.kappa0, first) + rate(b - a, 1.0 - first - last) + rate(ends.kappa1 - b, last))
        * length
        * length
        * length
        * length
}

/// The outer fraction on which a jump of curvature turns by about `turn`, and no longer where little turning is asked for.
fn fraction(jump: f64, length: f64, turn: f64) -> f64 {
    (turn / (jump.abs() * length + 1e-300)).clamp(1e-7, (0.2 * turn).min(1.0 / 3.0))
}

/// The one clothoid from which the answer is followed, and the problem that it answers: where the angles are so wide that it runs far away, it is sought for narrower ones.
fn beginning(ends: &Ends) -> Option<(Ends, Segment)> {
    [1.0, 0.9, 0.75, 0.5].into_iter().find_map(|part| {
        let (phi0, phi1) = (ends.phi0 * part, ends.phi1 * part);
        let s = hermite_g1(Point::ORIGIN, phi0, Point::new(1.0, 0.0), phi1)?;
        (s.length < 8.0).then_some((Ends { phi0, phi1, kappa0: s.kappa0, kappa1: s.kappa1 }, s))
    })
}

/// The answer for these fractions, followed from the one clothoid.
fn followed(ends: &Ends, (from, start): (&Ends, &Segment), fractions: Fractions) -> Option<Unknowns> {
    let begin =
        [start.curvature_at(fractions[0] * start.length), start.curvature_at((1.0 - fractions[1]) * start.length)];
    follow(ends, from, fractions, [begin[0], begin[1], start.length])
}

fn best(ends: &Ends) -> Option<(Fractions, Unknowns)> {
    let (from, start) = beginning(ends)?;
    let attempt = |fractions: Fractions, seed: Option<Unknowns>| {
        let u = match seed {
            Some(seed) => newton(ends, fractions, seed)?,
            None => followed(ends, (&from, &start), fractions)?,
        };
        Some((cost(ends, fractions, u), fractions, u))
    };
    let jumps = [ends.kappa0 - from.kappa0, ends.kappa1 - from.kappa1];
    let mut found: Option<(f64, Fractions, Unknowns)> = None;
    for turn in [6.0, 3.0, 1.5, 0.7, 0.3] {
        let fractions = jumps.map(|jump| fraction(jump, start.length, turn));
        if let Some(new) = attempt(fractions, None)
            && found.is_none_or(|old| new.0 < old.0)
        {
            found = Some(new);
        }
    }
    // Rarely needed: ever shorter outer segments, at last of different kinds, approach the G1 problem.
    let short = [0.1, 0.03, 0.01, 1e-3, 1e-4];
    let pairs =
        short.iter().map(|&t| [t, t]).chain(short.iter().flat_map(|&t| [[t, 1.0], [1.0, t], [t, 3.0], [3.0, t]]));
    for turns in pairs {
        if found.is_some() {
            break;
        }
        found = attempt(std::array::from_fn(|i| fraction(jumps[i], start.length, turns[i])), None);
    }
    // Pattern search over the logarithms of the two fractions, each solve warm from the best so far.
    let mut best = found?;
    let mut factor = 1.6;
    for _ in 0..24 {
        let mut improved = false;
        for side in 0..2 {
            for f in [factor, 1.0 / factor] {
                let mut fractions = best.1;
                fractions[side] = (fractions[side] * f).clamp(1e-8, 0.45);
                if let Some(new) = attempt(fractions, Some(best.2))
                    && new.0 < best.0 * (1.0 - 1e-4)
                {
                    best = new;
                    improved = true;
                }
            }
        }
        if !improved {
            factor = 1.0 + 0.5 * (factor - 1.0);
            if factor < 1.05 {
                break;
            }
        }
    }
    Some((best.1, best.2))
}

/// Three clothoid segments from one pose to another, G2 at all four joins and of little variation of curvature.
///
/// Headings are in radians; their differences to the chord are reduced to (−π, π]. The first segment begins with the start
/// pose exactly, each begins where the one before ends, and the last meets the end pose within 1e-12 × length (times
/// 1 + the turning). The curve is a local minimum of `∫ kappa'² ds × length⁵` within its family, found by search.
///
/// `None` where the points coincide, a value is not finite, or no solution was found; the last was not met in ten
/// thousand random cases with end curvatures up to 30 / chord.
#[must_use]
pub fn hermite_g2(start: Pose, end: Pose) -> Option<[Segment; 3]> {
    let (ends, r) = unit(start, end)?;
    let (fractions, unknowns) = best(&ends)?;
    placed(start, end, r, fractions, unknowns)
}

/// As [`hermite_g2`], with the outer segments taking these fractions of the length, without searching for better ones: a tenth of a millisecond's work becomes a few
/// microseconds.
///
/// `None` also where a fraction is not positive, both leave nothing between them, or these fractions admit no curve.
#[must_use]
pub fn hermite_g2_with(start: Pose, end: Pose, fractions: [f64; 2]) -> Option<[Segment; 3]> {
    let [first, last] = fractions;
    if !(first > 0.0 && last > 0.0 && first + last < 1.0) {
        return None;
    }
    let (ends, r) = unit(start, end)?;
    let (from, begin) = beginning(&ends)?;
    let unknowns = followed(&ends, (&from, &begin), fractions)?;
    placed(start, end, r, fractions, unknowns)
}

/// The unit problem of two poses, and their distance.
fn unit(start: Pose, end: Pose) -> Option<(Ends, f64)> {
    let chord = end.point - start.point;
    let r = chord.hypot2().sqrt();
    let values = [r, start.heading, end.heading, start.curvature, end.curvature];
    if !(values.iter().all(|v| v.is_finite()) && r > 0.0) {
        return None;
    }
    let direction = angle_of(chord);
    let ends = Ends {
        phi0: wrap_angle(start.heading - direction),
        phi1: wrap_angle(end.heading - direction),
        kappa0: start.curvature * r,
        kappa1: end.curvature * r,
    };
    Some((ends, r))
}

/// The answer of a unit problem between the poses that it came from.
fn placed(start: Pose, end: Pose, r: f64, [first, last]: Fractions, [a, b, length]: Unknowns) -> Option<[Segment; 3]> {
    let length = length * r;
    let (a, b) = (a / r, b / r);
    let s0 = Segment::clothoid(start.point, start.heading, first * length, start.curvature, a);
    let s1 = Segment::clothoid(s0.end(), s0.end_heading(), (1.0 - first - last) * length, a, b);
    let s2 = Segment::clothoid(s1.end(), s1.end_heading(), last * length, b, end.curvature);
    let segments = [s0, s1, s2];
    segments.iter().all(Segment::is_valid).then_some(segments)
}
