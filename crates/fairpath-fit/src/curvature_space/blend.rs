//! Knots of curvature rounded off (McCrae and Singh 2008, section 5.2): a profile in, one whose slope changes in many small steps out.
//!
//! Equation 15 as printed, `y − m₁ d (s² + 2s − 1) + m₂ d s²`, does not meet the lines that it is to blend: it begins at `y + m₁ d`. The
//! quadratic that has the value and the slope of both lines at the ends of the window is `y − m₁ d (1 − s)² + m₂ d s²`, since
//! `(1 − s)² = s² − 2s + 1`; the sign of one term was lost.
//!
//! A blend turns the curve by `d² (m₂ − m₁) / 6` more than the corner did. The paper lets that be. For a curve that follows its points it is
//! undone: [`rounded`] moves the knots that are blended so that the curve stays where it was.

use super::compose::{Profile, composed};
use crate::conclude::Parts;
use crate::linear::{cholesky, solve};
use fairpath_curve::{Continuity, Kind, Point, Segment, Vec2};

/// How far on each side of a knot, and in how many pieces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blend {
    /// Half the width of a window, px; where pieces are short, so much of them at most that a part of them remains.
    pub(crate) half_width: f64,
    pub(crate) steps: usize,
}

/// Share of a piece that a window may take.
const SHARE: f64 = 0.45;

/// Half the width of the window between two pieces, px.
fn half_width(blend: Blend, before: f64, after: f64) -> f64 {
    blend.half_width.min(SHARE * before.min(after))
}

/// The profile with its inner knots blended (equation 15 as corrected above).
pub(crate) fn blended(profile: &Profile, blend: Blend) -> Profile {
    Plan::new(profile, false, blend).profile(&profile.kappas)
}

/// A place of a blended profile: its arc length, and how its curvature follows from those of the knots.
struct Node {
    s: f64,
    shares: [(usize, f64); 3],
}

/// Where the places of a blended profile are.
struct Plan {
    nodes: Vec<Node>,
}

impl Plan {
    /// Blends the inner knots; of a ring, whose last knot is its first, that one as well.
    fn new(profile: &Profile, ring: bool, blend: Blend) -> Self {
        let s = &profile.knots;
        let last = s.len() - 1;
        let own = |k: usize| Node { s: s[k], shares: [(k, 1.0), (k, 0.0), (k, 0.0)] };
        let mut nodes = Vec::new();
        if !ring {
            nodes.push(own(0));
        }
        for k in usize::from(!ring)..last + usize::from(ring) {
            // Of a ring, half of the seam's window lies at either end.
            let before = if k > 0 { s[k] - s[k - 1] } else { s[last] - s[last - 1] };
            let after = if k < last { s[k + 1] - s[k] } else { s[1] - s[0] };
            let [previous, next] = [if k > 0 { k - 1 } else { last - 1 }, if k < last { k + 1 } else { 1 }];
            let d = half_width(blend, before, after);
            let half = blend.steps / 2;
            let steps = if k == 0 {
                half..blend.steps + 1
            } else if k == last {
                0..half + 1
            } else {
                0..blend.steps + 1
            };
            for i in steps {
                let u = i as f64 / blend.steps as f64;
                let (fall, rise) = (d * (1.0 - u) * (1.0 - u) / before, d * u * u / after);
                nodes.push(Node { s: s[k] + d * (2.0 * u - 1.0), shares: [(k, 1.0), (previous, fall), (next, rise)] });
            }
        }
        if !ring {
            nodes.push(own(last));
        }
        Self { nodes }
    }

    /// The blended profile for given curvatures at the knots.
    fn profile(&self, kappas: &[f64]) -> Profile {
        let value = |n: &Node| {
            // As differences to the knot, so that an arc stays one to the last bit.
            let (k, _) = n.shares[0];
            n.shares[1..].iter().fold(kappas[k], |sum, &(j, share)| sum + share * (kappas[j] - kappas[k]))
        };
        Profile { knots: self.nodes.iter().map(|n| n.s).collect(), kappas: self.nodes.iter().map(value).collect() }
    }

    /// How the curvature of each place changes with that of the knots: knot and share.
    fn shares(&self, node: usize) -> [(usize, f64); 3] {
        let [(k, _), (a, fall), (b, rise)] = self.nodes[node].shares;
        [(k, 1.0 - fall - rise), (a, fall), (b, rise)]
    }
}

/// A curve that moved further than this by blending is blended over half the width, px.
const MOVED: f64 = 0.2;

/// How often at most.
const NARROWED: usize = 5;

/// The curve with all knots between its corners blended, its ends and corners where they were and the rest within [`MOVED`] of where
/// it was. Joins stay G2: between two pieces the slope of curvature changes by a `steps`th of what it changed by at the knot.
/// Runs between corners that cannot be blended so are left as they are; whether there are any.
///
/// Takes time with the cube of the number of pieces between two corners.
pub(crate) fn rounded((segments, joins, closed): &Parts, blend: Blend) -> (Parts, bool) {
    let ring = *closed && joins.iter().all(|j| *j >= Continuity::G2);
    let mut out: (Vec<Segment>, Vec<Continuity>) = (Vec::new(), Vec::new());
    let mut all = true;
    let mut from = 0;
    for k in 0..segments.len() {
        let ends = k + 1 == segments.len() || joins[k] < Continuity::G2;
        if !ends {
            continue;
        }
        let run = &segments[from..=k];
        // Where the run before ends, to the last bit.
        let start = out.0.last().map_or(run[0].start, Segment::end);
        let rounded = if run.len() > 1 { narrowed(run, start, ring, blend) } else { Some(run.to_vec()) };
        all &= rounded.is_some();
        let run = rounded.unwrap_or_else(|| run.to_vec());
        out.1.extend(std::iter::repeat_n(Continuity::G2, run.len() - 1));
        out.0.extend(run);
        out.1.extend(joins.get(k));
        from = k + 1;
    }
    ((out.0, out.1, *closed), all)
}

fn narrowed(run: &[Segment], start: Point, ring: bool, blend: Blend) -> Option<Vec<Segment>> {
    let mut widths = (0..NARROWED).scan(blend.half_width, |d, _| Some(std::mem::replace(d, 0.5 * *d)));
    widths.find_map(|half_width| Rounding::new(run, start, ring, Blend { half_width, ..blend }).solved())
}

/// Gauss–Newton rounds; the constraints, which need the most, hold to rounding after four or five.
const ROUNDS: usize = 10;

/// What the end of the new curve may be away from that of the old, px and radians.
const CLOSED: f64 = 1e-10;

/// How firmly knots hold their curvature, relative to how firmly the places of the curve do: for knots that no place feels.
const FIRMNESS: f64 = 1e-9;

/// Moving the knots of a blended profile until the curve is where that of the profile was: a least-squares problem for the
/// curvatures at the knots and the first heading, under the constraint that the ends meet.
struct Rounding<'a> {
    run: &'a [Segment],
    start: Point,
    ring: bool,
    plan: Plan,
    /// The unknown that each knot is; none where it is straight. The heading at the start, if it may turn, is the last unknown.
    unknown: Vec<Option<usize>>,
    count: usize,
    kappas: Vec<f64>,
    heading: f64,
}

impl<'a> Rounding<'a> {
    fn new(run: &'a [Segment], start: Point, ring: bool, blend: Blend) -> Self {
        let n = run.len();
        let mut knots = vec![0.0];
        for s in run {
            knots.push(knots[knots.len() - 1] + s.length);
        }
        let mut kappas: Vec<f64> = run.iter().map(|s| s.kappa0).chain([run[n - 1].kappa1]).collect();
        let mut unknown: Vec<Option<usize>> = vec![None; n + 1];
        let mut count = 0;
        for k in 0..=n {
            let [before, after] = [k.checked_sub(1).map(|j| run[j].kind()), run.get(k).map(Segment::kind)];
            unknown[k] = if before == Some(Kind::Line) || after == Some(Kind::Line) {
                None
            } else if before == Some(Kind::Arc) {
                unknown[k - 1]
            } else {
                count += 1;
                Some(count - 1)
            };
        }
        if ring {
            // The seam is one knot. An unknown that is thereby without a knot is held by its firmness alone.
            kappas[n] = kappas[0];
            let (first, last) = (unknown[0], unknown[n]);
            for u in &mut unknown {
                if *u == last || *u == first {
                    *u = first.and(last).and(first);
                }
            }
        } else {
            count += 1;
        }
        let plan = Plan::new(&Profile { knots, kappas: kappas.clone() }, ring, blend);
        Self { run, start, ring, plan, unknown, count, kappas, heading: run[0].heading }
    }

    fn solved(mut self) -> Option<Vec<Segment>> {
        let places = self.places();
        let old = self.run[self.run.len() - 1].end_pose();
        for _ in 0..ROUNDS {
            let segments = composed(&self.plan.profile(&self.kappas), self.start, self.heading);
            if !segments.iter().all(Segment::is_valid) {
                return None;
            }
            let end = segments[segments.len() - 1].end_pose();
            let mut gap = vec![old.point.x - end.point.x, old.point.y - end.point.y];
            if self.ring {
                gap.push(old.heading - end.heading);
            }
            let moved = segments.iter().zip(&places).map(|(s, p)| (s.end() - *p).hypot()).fold(0.0, f64::max);
            if gap.iter().all(|g| g.abs() < CLOSED) && moved < MOVED {
                return Some(segments);
            }
            let by = self.step(&segments, &places, &gap)?;
            for (kappa, unknown) in self.kappas.iter_mut().zip(&self.unknown) {
                *kappa += unknown.map_or(0.0, |u| by[u]);
            }
            if !self.ring {
                self.heading += by[self.count - 1];
            }
        }
        None
    }

    /// Where on the old curve the ends of the new pieces belong.
    fn places(&self) -> Vec<Point> {
        let (mut k, mut begun) = (0, 0.0);
        self.plan.nodes[1..]
            .iter()
            .map(|node| {
                while k + 1 < self.run.len() && begun + self.run[k].length < node.s {
                    begun += self.run[k].length;
                    k += 1;
                }
                self.run[k].point_at((node.s - begun).min(self.run[k].length))
            })
            .collect()
    }

    /// A Gauss–Newton step that closes the gap at the end.
    fn step(&self, segments: &[Segment], places: &[Point], gap: &[f64]) -> Option<Vec<f64>> {
        let n = self.count;
        let mut system = Dense::new(n);
        // A change of an unknown turns what follows about some point: it moves a point p by `shift + turn × p`.
        let mut shift = vec![Vec2::ZERO; n];
        let mut turn = vec![0.0; n];
        if !self.ring {
            turn[n - 1] = 1.0;
            shift[n - 1] = -left_of(self.start.to_vec2());
        }
        for (k, (segment, place)) in segments.iter().zip(places).enumerate() {
            let jacobian = segment.position_jacobian(segment.length);
            let (end, half) = (segment.end(), 0.5 * segment.length);
            for (node, by_kappa) in [(k, jacobian.kappa0), (k + 1, jacobian.kappa1)] {
                for (knot, share) in self.plan.shares(node) {
                    if let Some(u) = self.unknown[knot] {
                        shift[u] += (by_kappa - left_of(end.to_vec2()) * half) * share;
                        turn[u] += half * share;
                    }
                }
            }
            let rows = moves(&shift, &turn, end);
            let off = *place - end;
            system.add(&rows[0], off.x, segment.length);
            system.add(&rows[1], off.y, segment.length);
        }
        let [x, y] = moves(&shift, &turn, segments[segments.len() - 1].end());
        let constraints = [x, y, turn];
        system.step(&constraints[..gap.len()], gap)
    }
}

fn left_of(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// How a point moves with each unknown, in x and in y.
fn moves(shift: &[Vec2], turn: &[f64], point: Point) -> [Vec<f64>; 2] {
    let across = left_of(point.to_vec2());
    let along = |f: fn(Vec2) -> f64| shift.iter().zip(turn).map(|(s, t)| f(*s + across * *t)).collect();
    [along(|v| v.x), along(|v| v.y)]
}

/// Normal equations of any number of unknowns.
struct Dense {
    /// Lower triangle by rows.
    matrix: Vec<Vec<f64>>,
    right: Vec<f64>,
}

impl Dense {
    fn new(n: usize) -> Self {
        Self { matrix: (0..n).map(|i| vec![0.0; i + 1]).collect(), right: vec![0.0; n] }
    }

    fn add(&mut self, row: &[f64], off: f64, weight: f64) {
        for (i, own) in self.matrix.iter_mut().enumerate() {
            let v = weight * row[i];
            if v != 0.0 {
                own.iter_mut().zip(row).for_each(|(h, r)| *h += v * r);
                self.right[i] += v * off;
            }
        }
    }

    /// The step of least squares under the constraints that it moves each of `rows` by its `gap`.
    fn step(mut self, rows: &[Vec<f64>], gap: &[f64]) -> Option<Vec<f64>> {
        let largest = self.matrix.iter().map(|r| r[r.len() - 1]).fold(0.0, f64::max);
        for row in &mut self.matrix {
            let last = row.len() - 1;
            row[last] += FIRMNESS * row[last].max(FIRMNESS * largest);
        }
        self.factor()?;
        let mut step = self.solve(self.right.clone());
        let responses: Vec<Vec<f64>> = rows.iter().map(|r| self.solve(r.clone())).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let m = rows.len();
        let (mut small, mut pull) = ([[0.0; 3]; 3], [0.0; 3]);
        for i in 0..m {
            for j in 0..=i {
                small[i][j] = dot(&rows[i], &responses[j]);
            }
            pull[i] = gap[i] - dot(&rows[i], &step);
        }
        if !cholesky(&mut small, m, 1e-14) {
            return None;
        }
        solve(&small, m, &mut pull);
        for (response, pull) in responses.iter().zip(pull) {
            step.iter_mut().zip(response).for_each(|(s, r)| *s += pull * r);
        }
        step.iter().all(|v| v.is_finite()).then_some(step)
    }

    /// Cholesky's factor in place of the matrix.
    fn factor(&mut self) -> Option<()> {
        for i in 0..self.matrix.len() {
            let (above, below) = self.matrix.split_at_mut(i);
            let row = &mut below[0];
            for j in 0..i {
                let sum: f64 = row[..j].iter().zip(&above[j][..j]).map(|(a, b)| a * b).sum();
                row[j] = (row[j] - sum) / above[j][j];
            }
            let rest = row[i] - row[..i].iter().map(|v| v * v).sum::<f64>();
            if !(rest > 0.0) {
                return None;
            }
            row[i] = rest.sqrt();
        }
        Some(())
    }

    fn solve(&self, mut b: Vec<f64>) -> Vec<f64> {
        let n = b.len();
        for i in 0..n {
            let sum: f64 = self.matrix[i][..i].iter().zip(&b).map(|(a, b)| a * b).sum();
            b[i] = (b[i] - sum) / self.matrix[i][i];
        }
        for i in (0..n).rev() {
            b[i] /= self.matrix[i][i];
            let v = b[i];
            for j in 0..i {
                b[j] -= self.matrix[i][j] * v;
            }
        }
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLEND: Blend = Blend { half_width: 10.0, steps: 8 };

    #[test]
    fn a_blend_meets_both_lines_in_value_and_slope() {
        let profile = Profile { knots: vec![0.0, 50.0, 120.0], kappas: vec![0.01, -0.02, 0.03] };
        let found = blended(&profile, BLEND);
        let line = |s: f64| if s < 50.0 { 0.01 - 0.03 * s / 50.0 } else { -0.02 + 0.05 * (s - 50.0) / 70.0 };
        for (s, kappa) in [(1, 40.0), (9, 60.0)].map(|(i, s)| (found.knots[i], (found.kappas[i], s))) {
            assert!((s - kappa.1).abs() < 1e-12 && (kappa.0 - line(s)).abs() < 1e-15, "{found:?}");
        }
        // Slopes change by an eighth of the corner at a time, at the ends by half of that.
        let slopes: Vec<f64> = (1..found.knots.len())
            .map(|i| (found.kappas[i] - found.kappas[i - 1]) / (found.knots[i] - found.knots[i - 1]))
            .collect();
        let corner = 0.05 / 70.0 + 0.03 / 50.0;
        for pair in slopes.windows(2) {
            assert!((pair[1] - pair[0]).abs() < corner / 8.0 + 1e-12, "{slopes:?}");
        }
        assert!((slopes[0] + 0.03 / 50.0).abs() < 1e-12);
        assert!((slopes[slopes.len() - 1] - 0.05 / 70.0).abs() < 1e-12);
    }

    #[test]
    fn equation_15_as_printed_does_not_meet_the_first_line() {
        let (y, m1, m2, d, s) = (-0.02, -0.0006, 0.0007, 10.0, 0.0);
        let printed: f64 = y - m1 * d * (s * s + 2.0 * s - 1.0) + m2 * d * s * s;
        let line: f64 = y - m1 * d;
        assert!((printed - line).abs() > 0.01);
    }

    #[test]
    fn a_rounded_curve_stays_where_it_was() {
        let line = Segment::line(Point::new(5.0, 5.0), 0.3, 80.0);
        let next = |s: &Segment, kappa1: f64, length: f64| {
            let end = s.end_pose();
            Segment { start: end.point, heading: end.heading, length, kappa0: end.curvature, kappa1 }
        };
        let mut run = vec![line];
        for (kappa, length) in [(0.02, 60.0), (0.02, 50.0), (-0.03, 90.0), (0.0, 40.0)] {
            run.push(next(&run[run.len() - 1], kappa, length));
        }
        let joins = vec![Continuity::G2; 4];
        let ((out, levels, _), all) = rounded(&(run.clone(), joins, false), BLEND);
        assert!(all);
        assert_eq!(levels.len() + 1, out.len());
        assert!((out[0].start - run[0].start).hypot() < 1e-12);
        assert!((out[out.len() - 1].end() - run[4].end()).hypot() < 1e-9);
        assert!(out.iter().any(|s| s.kind() == Kind::Line) && out.iter().any(|s| s.kind() == Kind::Arc));
        for s in &out {
            let near = run.iter().map(|r| r.nearest(s.point_at(0.5 * s.length)).distance).fold(f64::INFINITY, f64::min);
            assert!(near < MOVED, "{near}");
        }
    }
}
