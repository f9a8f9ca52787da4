//! Pieces turned and shifted until they are near their points and meet their neighbours: beyond McCrae and Singh (2011), who lay each by
//! itself and leave the rest to the blend.
//!
//! Gauss–Newton steps on the distances of all points, and on what is missing where pieces meet: the gap across them and the angle between them.
//! Along the templates they may slide. The matrix couples neighbours only, so that a step takes time linear in the number of pieces.

use super::guide::Guide;
use super::joints::{goes_straight_on, only_whole_lines};
use super::laid::{Laid, SLIDE};
use crate::linear::{cholesky, solve};
use fairpath_curve::{Pose, Vec2, trig};

/// How a piece meets the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Joint {
    /// They are blended there.
    Smooth,
    /// Both are straight and continue each other.
    Straight,
    /// The stroke has a corner.
    Corner,
}

/// What a piece that is laid by itself has to meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbours {
    /// The piece before it, which stays where it is.
    pub(crate) before: Option<Laid>,
}

impl Neighbours {
    pub(crate) const NONE: Self = Self { before: None };
}

/// Length of stroke whose points together count as much as a gap between two pieces, px, and lever at which an angle between them counts as a gap, px.
const GAP_WEIGHT: f64 = 60.0;
const LEVER: f64 = 20.0;

/// Where straight pieces continue each other, they count so many times as much: as good as always.
const STRAIGHT_FACTOR: f64 = 1e6;

/// Steps for one piece, and for all together.
const ROUNDS: usize = 3;
const ROUNDS_TOGETHER: usize = 8;

/// Normal equations of one piece in shift and turn about a centre.
#[derive(Clone, Copy)]
struct Normal {
    a: [[f64; 3]; 3],
    b: [f64; 3],
    centre: Vec2,
}

type Row = [f64; 3];
type Block = [[f64; 3]; 3];

impl Normal {
    /// How far the points are across the piece.
    fn of(laid: &Laid, points: &[Vec2], guides: &[Guide]) -> Self {
        let path = &guides[laid.guide].path;
        let centre = points.iter().fold(Vec2::ZERO, |c, p| c + *p) / points.len() as f64;
        let mut normal = Self { a: [[0.0; 3]; 3], b: [0.0; 3], centre };
        let weight = (laid.to - laid.from) / (points.len() - 1) as f64;
        for (at, &point) in laid.places(points.len()).zip(points) {
            let foot = laid.foot(path, at, [laid.from, laid.to], point);
            normal.add(across(foot.pose, centre), foot.across, weight);
        }
        // At the ends the piece also stays put along itself, or a line would be free to slide.
        for (at, point) in [(laid.from, points[0]), (laid.to, points[points.len() - 1])] {
            let pose = laid.pose(path, at);
            let along = Pose { heading: pose.heading - std::f64::consts::FRAC_PI_2, ..pose };
            let off = trig::unit(pose.heading).dot(point - pose.point.to_vec2());
            normal.add(across(along, centre), off, ALONG * weight);
        }
        normal
    }

    fn add(&mut self, row: Row, residual: f64, weight: f64) {
        for i in 0..3 {
            for j in 0..3 {
                self.a[i][j] += weight * row[i] * row[j];
            }
            self.b[i] += weight * row[i] * residual;
        }
    }

    /// Keeps what nothing determines where it is.
    fn damped(mut self, lever: f64) -> Self {
        let size = DAMPING * (self.a[0][0] + self.a[1][1]);
        self.a[0][0] += size;
        self.a[1][1] += size;
        self.a[2][2] += size * lever * lever;
        self
    }
}

/// Weight with which an end stays where it is along the piece, as a multiple of a point's.
const ALONG: f64 = 0.25;

/// Share of the diagonal that is added to it.
const DAMPING: f64 = 1e-9;

/// How a pose moves across itself with shift and turn.
fn across(pose: Pose, centre: Vec2) -> Row {
    let t = trig::unit(pose.heading);
    let (n, arm) = (Vec2::new(-t.y, t.x), pose.point.to_vec2() - centre);
    [n.x, n.y, n.dot(Vec2::new(-arm.y, arm.x))]
}

/// A piece after a step.
fn moved(laid: &Laid, step: [f64; 3], centre: Vec2) -> Laid {
    let c = trig::unit(step[2]);
    let arm = laid.shift - centre;
    let shift = centre + Vec2::new(c.x * arm.x - c.y * arm.y, c.y * arm.x + c.x * arm.y) + Vec2::new(step[0], step[1]);
    Laid { turn: laid.turn + step[2], shift, ..*laid }
}

/// One piece laid over its points as near as possible, and meeting what it has to meet.
pub(crate) fn settled(laid: &Laid, points: &[Vec2], guides: &[Guide], neighbours: &Neighbours) -> Laid {
    let path = &guides[laid.guide].path;
    let mut laid = *laid;
    for _ in 0..ROUNDS {
        let mut normal = Normal::of(&laid, points, guides);
        if let Some(before) = neighbours.before {
            let joint = if goes_straight_on(&before, &laid, guides) { Joint::Straight } else { Joint::Smooth };
            let end = before.pose(&guides[before.guide].path, before.to);
            let foot = laid.foot(path, laid.from, [laid.from, laid.to], end.point.to_vec2());
            let turn = trig::wrap_angle(end.heading - foot.pose.heading);
            let [gap_weight, turn_weight] = weights(joint);
            normal.add(across(foot.pose, normal.centre), foot.across, gap_weight * robust(foot.across, FAR_GAP));
            normal.add([0.0, 0.0, 1.0], turn, turn_weight * robust(turn, FAR_TURN));
        }
        let mut normal = normal.damped(laid.to - laid.from);
        if !cholesky(&mut normal.a, 3, 0.0) {
            break;
        }
        solve(&normal.a, 3, &mut normal.b);
        laid = moved(&laid, normal.b, normal.centre);
    }
    laid
}

/// Weights of gap and angle.
fn weights(joint: Joint) -> [f64; 2] {
    let gap = match joint {
        Joint::Smooth => GAP_WEIGHT,
        Joint::Straight => STRAIGHT_FACTOR * GAP_WEIGHT,
        Joint::Corner => 0.0,
    };
    [gap, gap * LEVER * LEVER]
}

/// All pieces settled together: `points` has those of each piece, and `joints` how each meets the next, the last the first if there are as many.
///
/// No piece is drawn further from its points than `limit`, or than it was: what meets such a piece is relaxed, and all is begun anew. A long line
/// may be drawn a little bowed; where it is bowed too much, it becomes several that are blended.
pub(crate) fn settle_together(
    pieces: &mut [Laid],
    points: &[&[Vec2]],
    joints: &mut [Joint],
    guides: &[Guide],
    limit: f64,
) {
    let n = pieces.len();
    if n < 2 {
        return;
    }
    let alone: Vec<f64> =
        pieces.iter().zip(points).map(|(l, p)| limit.max(WORSE * l.distance(guides, p).largest)).collect();
    let mut pulls = vec![1.0; joints.len()];
    let mut round = 0;
    loop {
        let lines = line_lengths(pieces, joints);
        let bowed = |i: usize| (BOW * lines[i]).min(MOST_BOWED * limit);
        let allowed: Vec<f64> = (0..n).map(|i| alone[i].max(bowed(i))).collect();
        let mut moved = pieces.to_vec();
        pull(&mut moved, points, joints, &pulls, guides);
        trim_ends(&mut moved, points, joints, guides);
        let bad: Vec<usize> =
            (0..n).filter(|&i| !(moved[i].distance(guides, points[i]).largest <= allowed[i])).collect();
        if bad.is_empty() || round == RELAXATIONS {
            for (i, new) in moved.into_iter().enumerate() {
                if !bad.contains(&i) {
                    pieces[i] = new;
                }
            }
            return;
        }
        let beside = |i: &usize| [if *i > 0 { i - 1 } else { n - 1 }, *i];
        let around: Vec<usize> = bad.iter().flat_map(beside).filter(|j| *j < joints.len()).collect();
        let straight: Vec<usize> = around.iter().copied().filter(|&j| joints[j] == Joint::Straight).collect();
        if straight.is_empty() {
            around.into_iter().for_each(|j| pulls[j] *= RELAXED);
            round += 1;
        } else {
            straight.into_iter().for_each(|j| joints[j] = Joint::Smooth);
            only_whole_lines(joints, pieces, guides);
        }
    }
}

/// For each piece the length of all that are one line with it, px; nothing for those that are blended on both sides.
fn line_lengths(pieces: &[Laid], joints: &[Joint]) -> Vec<f64> {
    let n = pieces.len();
    let mut out = vec![0.0; n];
    let mut first = 0;
    while first < n {
        let mut last = first;
        while last + 1 < n && joints[last] == Joint::Straight {
            last += 1;
        }
        if last > first {
            out[first..=last].fill(pieces[first..=last].iter().map(|l| l.to - l.from).sum());
        }
        first = last + 1;
    }
    out
}

/// By how much of its length a line may be drawn bowed, and at most by how many times what a piece may be off.
const BOW: f64 = 0.04;
const MOST_BOWED: f64 = 2.5;

/// Lets the curve end beside the ends of the stroke and of its parts.
fn trim_ends(pieces: &mut [Laid], points: &[&[Vec2]], joints: &[Joint], guides: &[Guide]) {
    let n = pieces.len();
    let free = |i: usize| joints.get(i).is_none_or(|j| *j == Joint::Corner);
    for i in 0..n {
        let before = if i > 0 { i - 1 } else { n - 1 };
        let trimmed = pieces[i].trimmed(guides, points[i]);
        let from = if free(before) { trimmed.from } else { pieces[i].from };
        let to = if free(i) { trimmed.to } else { pieces[i].to };
        if to > from {
            (pieces[i].from, pieces[i].to) = (from, to);
        }
    }
}

/// How often what meets badly is relaxed, and by how much.
const RELAXATIONS: usize = 4;
const RELAXED: f64 = 0.1;

/// By how much a piece may become worse.
const WORSE: f64 = 1.1;

/// Gauss–Newton steps; a joint counts as its entry in `pulls` tells.
fn pull(pieces: &mut [Laid], points: &[&[Vec2]], joints: &[Joint], pulls: &[f64], guides: &[Guide]) {
    let n = pieces.len();
    let alone = pieces.to_vec();
    let smooth = |i: &usize| joints[*i] != Joint::Corner;
    for _ in 0..ROUNDS_TOGETHER {
        let mut normals: Vec<Normal> =
            pieces.iter().zip(points).map(|(l, p)| Normal::of(l, p, guides).damped(l.to - l.from)).collect();
        // Coupling of each piece with the next, and of the last with the first.
        let mut couplings = vec![[[0.0; 3]; 3]; n];
        for i in (0..joints.len()).filter(smooth) {
            let next = (i + 1) % n;
            slide(pieces, &alone, i, next, guides);
            let (a, b) = (pieces[i], pieces[next]);
            let (pa, pb) = (a.pose(&guides[a.guide].path, a.to), b.pose(&guides[b.guide].path, b.from));
            // The gap is measured across the direction between both.
            let turn = trig::wrap_angle(pb.heading - pa.heading);
            let middle = pa.heading + 0.5 * turn;
            let (ra, rb) = (
                across(Pose { heading: middle, ..pa }, normals[i].centre),
                across(Pose { heading: middle, ..pb }, normals[next].centre),
            );
            let gap = trig::unit(middle).cross(pb.point - pa.point);
            let [gap_weight, turn_weight] = weights(joints[i]).map(|w| w * pulls[i]);
            let both = [0.0, 0.0, 1.0];
            for (ra, rb, residual, weight) in [
                (ra, rb, gap, gap_weight * robust(gap, FAR_GAP)),
                (both, both, turn, turn_weight * robust(turn, FAR_TURN)),
            ] {
                normals[i].add(ra, residual, weight);
                normals[next].add(rb, -residual, weight);
                for r in 0..3 {
                    for c in 0..3 {
                        couplings[i][r][c] -= weight * ra[r] * rb[c];
                    }
                }
            }
        }
        let Some(steps) = solved(&normals, &couplings) else { return };
        for ((laid, step), normal) in pieces.iter_mut().zip(steps).zip(&normals) {
            *laid = moved(laid, step, normal.centre);
        }
    }
    for i in (0..joints.len()).filter(smooth) {
        slide(pieces, &alone, i, (i + 1) % n, guides);
    }
}

/// What is far from meeting does not come together by force.
fn robust(residual: f64, far: f64) -> f64 {
    1.0 / (1.0 + (residual / far) * (residual / far))
}

/// A gap and an angle that are too large to be closed, px and radians.
const FAR_GAP: f64 = 5.0;
const FAR_TURN: f64 = 0.5;

/// Moves the end of a piece and the beginning of the next along their templates to where the two are side by side, not far from where they were
/// while they lay `alone`.
fn slide(pieces: &mut [Laid], alone: &[Laid], i: usize, next: usize, guides: &[Guide]) {
    let (a, b) = (pieces[i], pieces[next]);
    let (pa, pb) = (&guides[a.guide].path, &guides[b.guide].path);
    let middle = a.pose(pa, a.to).point.midpoint(b.pose(pb, b.from).point).to_vec2();
    // Neither passes a corner of its template, an end of it, or the middle of the piece.
    let (was_a, was_b) = (alone[i], alone[next]);
    let [_, high] = pa.smooth_stretch(was_a.to - SAME);
    let [low, _] = pb.smooth_stretch(was_b.from);
    let shortened = |l: Laid| (KEPT * (l.to - l.from)).min(SLIDE);
    let ends = [was_a.to - shortened(was_a), high.min(was_a.to + SLIDE).max(was_a.to)];
    let begins = [low.max(was_b.from - SLIDE).min(was_b.from), was_b.from + shortened(was_b)];
    pieces[i].to = a.foot(pa, a.to, [a.from, high], middle).at.clamp(ends[0], ends[1]);
    pieces[next].from = b.foot(pb, b.from, [low, b.to], middle).at.clamp(begins[0], begins[1]);
}

/// Most of a piece by which it is shortened at an end.
const KEPT: f64 = 0.3;
const SAME: f64 = 1e-9;

/// Solves the equations of a ring of pieces by elimination; an open chain is one whose last coupling is zero.
fn solved(normals: &[Normal], couplings: &[Block]) -> Option<Vec<Row>> {
    let n = normals.len();
    let last = n - 1;
    let mut a: Vec<Block> = normals.iter().map(|n| n.a).collect();
    let mut b: Vec<Row> = normals.iter().map(|n| n.b).collect();
    // Coupling of each piece with the last one, which elimination fills in.
    let mut far = vec![[[0.0; 3]; 3]; last];
    far[0] = transposed(&couplings[last]);
    far[last - 1] = plus(&far[last - 1], &couplings[last - 1]);
    let mut inverses = Vec::with_capacity(last);
    for p in 0..last {
        let inverse = inverse(&a[p])?;
        if p + 1 < last {
            let k = times(&transposed(&couplings[p]), &inverse);
            a[p + 1] = minus(&a[p + 1], &times(&k, &couplings[p]));
            b[p + 1] = less(&b[p + 1], &applied(&k, &b[p]));
            far[p + 1] = minus(&far[p + 1], &times(&k, &far[p]));
        }
        let k = times(&transposed(&far[p]), &inverse);
        a[last] = minus(&a[last], &times(&k, &far[p]));
        b[last] = less(&b[last], &applied(&k, &b[p]));
        inverses.push(inverse);
    }
    let mut x = vec![[0.0; 3]; n];
    x[last] = applied(&inverse(&a[last])?, &b[last]);
    for p in (0..last).rev() {
        let mut right = less(&b[p], &applied(&far[p], &x[last]));
        if p + 1 < last {
            right = less(&right, &applied(&couplings[p], &x[p + 1]));
        }
        x[p] = applied(&inverses[p], &right);
    }
    x.iter().flatten().all(|v| v.is_finite()).then_some(x)
}

/// The inverse of a symmetric positive definite block.
fn inverse(a: &Block) -> Option<Block> {
    let mut factor = *a;
    if !cholesky(&mut factor, 3, 0.0) {
        return None;
    }
    let mut out = [[0.0; 3]; 3];
    for (i, row) in out.iter_mut().enumerate() {
        row[i] = 1.0;
        solve(&factor, 3, row);
    }
    Some(out)
}

fn times(a: &Block, b: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn applied(a: &Block, x: &Row) -> Row {
    std::array::from_fn(|i| (0..3).map(|k| a[i][k] * x[k]).sum())
}

fn transposed(a: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

fn plus(a: &Block, b: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}

fn minus(a: &Block, b: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] - b[i][j]))
}

fn less(a: &Row, b: &Row) -> Row {
    std::array::from_fn(|i| a[i] - b[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn elimination_solves_the_whole_ring(
            n in 2..7_usize, closed in any::<bool>(), entries in prop::collection::vec(-1.0..1.0_f64, 7 * 21),
        ) {
            // Rows that concern a piece and the next make a matrix like that of pieces.
            let mut normals = vec![Normal { a: [[0.0; 3]; 3], b: [0.0; 3], centre: Vec2::ZERO }; n];
            let mut couplings = vec![[[0.0; 3]; 3]; n];
            for i in 0..n {
                let e = &entries[21 * i..];
                normals[i].b = [e[0], e[1], e[2]];
                for k in 0..3 {
                    normals[i].a[k][k] += 0.1;
                    if i + 1 == n && !closed {
                        continue;
                    }
                    let next = (i + 1) % n;
                    let row = |j: usize| [e[3 + 6 * k + j], e[4 + 6 * k + j], e[5 + 6 * k + j]];
                    let (ra, rb) = (row(0), row(3));
                    normals[i].add(ra, 0.0, 1.0);
                    normals[next].add(rb, 0.0, 1.0);
                    for r in 0..3 {
                        for c in 0..3 {
                            couplings[i][r][c] += ra[r] * rb[c];
                        }
                    }
                }
            }
            let x = solved(&normals, &couplings).unwrap();
            for i in 0..n {
                let (before, next) = ((i + n - 1) % n, (i + 1) % n);
                let mut left = applied(&normals[i].a, &x[i]);
                left = less(&left, &applied(&couplings[i], &x[next]).map(|v| -v));
                left = less(&left, &applied(&transposed(&couplings[before]), &x[before]).map(|v| -v));
                for k in 0..3 {
                    prop_assert!((left[k] - normals[i].b[k]).abs() < 1e-6, "{:?} {:?}", left, normals[i].b);
                }
            }
        }
    }
}
