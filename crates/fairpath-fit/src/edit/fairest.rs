//! The fairest curve through poses: poses come in, of some of which heading or curvature may be chosen; three clothoids between each two of them go out, chosen
//! together so that curvature varies least.
//!
//! What is minimised is the sum of the variations of all pieces, over the free headings and curvatures and over the shares that the three clothoids of each piece
//! have of its length. It is smooth, its second derivatives are known ([`ThreeClothoids::derivatives`]), and each piece is about its own two poses only, so that
//! a step of Newton's method is one banded system. There are several minima. Those far apart differ in the poses: the search begins from three guesses of
//! these and goes on from the best end. Those close together, some per cent apart, differ in the shares: at the end of a search each piece tries others.

use super::banded::{BAND, Row, solve_banded};
use super::guesses::{circles, quintic};
use super::three_clothoids::{CHOICES, ThreeClothoids, Variation};
use fairpath_curve::{Pose, Segment, hermite_g2};

/// A pose that the curve passes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passed {
    pub(super) pose: Pose,
    /// Whether its heading and its curvature may be chosen.
    pub(super) free: [bool; 2],
}

/// The segments of the curve, three from each pose to the next; nothing if no clothoids were found.
///
/// The result depends on the poses alone. It is a local minimum within a relative 1e-9 or so, not always the lowest.
pub(super) fn fairest(passed: &[Passed]) -> Option<Vec<Segment>> {
    let guesses = [Some(passed.to_vec()), quintic(passed), Some(circles(passed))];
    let ends = guesses.into_iter().flatten().filter_map(|guess| {
        let mut course = Course::new(guess)?;
        course.descend(FINE, MOST_STEPS);
        Some(course)
    });
    let mut best = ends.min_by(|a, b| a.variation().total_cmp(&b.variation()))?;
    for _ in 0..MOST_ROUNDS {
        if !best.reshare() {
            break;
        }
        best.descend(FINE, MOST_STEPS);
    }
    Some(best.segments())
}

/// A search ends when a step promises to gain no more than this share of the variation; one that only compares shares ends sooner.
const FINE: f64 = 1e-10;
const COARSE: f64 = 1e-4;

/// What counts as a variation of zero, for chords of length one: nothing of it is seen.
const NOTHING: f64 = 1e-12;

/// Most steps of a search, most of one that compares shares, and most rounds of these. The first is hardly ever needed.
const MOST_STEPS: usize = 60;
const FEW_STEPS: usize = 12;
const MOST_ROUNDS: usize = 4;

/// The longest step: radians of heading, curvature times the shorter chord, logarithms of shares.
const LONGEST: f64 = 0.5;

/// Shares of the two outer clothoids that every piece tries: even, long at one end, long at both, and short with the middle long.
const SHARES: [[f64; 2]; 6] = [[0.2, 0.2], [0.15, 0.65], [0.65, 0.15], [0.42, 0.42], [0.06, 0.3], [0.3, 0.06]];

/// Other shares are taken for a gain of at least this share of the piece's variation.
const WORTHWHILE: f64 = 1e-6;

/// Unknowns of a pose and of a piece.
const OF_POSE: usize = 2;
const OF_BOTH: usize = 4;

/// A curve through all poses.
#[derive(Clone)]
struct Course {
    passed: Vec<Passed>,
    pieces: Vec<ThreeClothoids>,
    /// Lengths of the chords, in which the pieces measure.
    chords: Vec<f64>,
    /// The unit of each pose's curvature: one over the shorter chord.
    bends: Vec<f64>,
}

/// A step's equations: second and first derivatives of the variation by all unknowns, which are those of the first pose, the first piece, the second pose and
/// so on.
struct Equations {
    matrix: Vec<Row>,
    slope: Vec<f64>,
}

impl Course {
    /// The curve through poses as they are.
    fn new(passed: Vec<Passed>) -> Option<Self> {
        let pairs = || passed.windows(2).map(|pair| (&pair[0].pose, &pair[1].pose));
        let pieces: Option<_> = pairs().map(|(a, b)| Some(ThreeClothoids::of(&hermite_g2(*a, *b)?, a, b))).collect();
        let chords: Vec<f64> = pairs().map(|(a, b)| (b.point - a.point).hypot()).collect();
        let chord = |i: Option<usize>| i.and_then(|i| chords.get(i)).copied().unwrap_or(f64::INFINITY);
        let bends = (0..passed.len()).map(|i| 1.0 / chord(i.checked_sub(1)).min(chord(Some(i)))).collect();
        Some(Self { pieces: pieces?, bends, chords, passed })
    }

    fn variation(&self) -> f64 {
        self.pieces.iter().zip(&self.chords).map(|(piece, r)| piece.variation() * r * r).sum()
    }

    /// Which unknown each choice of a piece is, and how far the choice moves with it.
    fn unknowns(&self, piece: usize) -> [(usize, f64); CHOICES] {
        let at = OF_BOTH * piece;
        let [before, after] = [piece, piece + 1].map(|pose| self.bends[pose] * self.chords[piece]);
        [(at, 1.0), (at + 1, before), (at + 4, 1.0), (at + 5, after), (at + 2, 1.0), (at + 3, 1.0)]
    }

    fn equations(&self, derivatives: &[Variation]) -> Equations {
        let n = OF_BOTH * self.pieces.len() + OF_POSE;
        let mut matrix: Vec<Row> = vec![[0.0; BAND + 1]; n];
        let mut slope = vec![0.0; n];
        for (i, derivatives) in derivatives.iter().enumerate() {
            let unknowns = self.unknowns(i);
            let area = self.chords[i] * self.chords[i];
            for (a, &(row, scale)) in unknowns.iter().enumerate() {
                slope[row] += derivatives.gradient[a] * scale * area;
                for (b, &(column, other)) in unknowns.iter().enumerate().filter(|(_, (column, _))| *column <= row) {
                    matrix[row][BAND + column - row] += derivatives.hessian[a][b] * scale * other * area;
                }
            }
        }
        let mut equations = Equations { matrix, slope };
        for (i, passed) in self.passed.iter().enumerate() {
            for k in (0..OF_POSE).filter(|&k| !passed.free[k]) {
                equations.hold(OF_BOTH * i + k);
            }
        }
        equations
    }

    /// Goes down by Newton's method, damped as Levenberg and Marquardt do, until a step promises to gain no more than `fine` of the variation.
    fn descend(&mut self, fine: f64, most_steps: usize) {
        let nothing = NOTHING * self.chords.iter().map(|r| r * r).sum::<f64>();
        let mut damping = 1e-3;
        for _ in 0..most_steps {
            let before = self.variation();
            let derivatives: Option<Vec<_>> = self.pieces.iter().map(ThreeClothoids::derivatives).collect();
            let Some(derivatives) = derivatives else { return };
            let equations = self.equations(&derivatives);
            loop {
                if let Some((by, gain)) = equations.step(damping) {
                    if !(gain > fine * (before + nothing)) {
                        return;
                    }
                    if let Some(moved) = self.moved(&derivatives, &by)
                        && moved.variation() < before
                    {
                        *self = moved;
                        damping = f64::max(0.1 * damping, 1e-9);
                        break;
                    }
                }
                damping = f64::max(6.0 * damping, 1e-6);
                if damping > 1e8 {
                    return;
                }
            }
        }
    }

    /// The curve a step further; nothing if a piece does not follow.
    fn moved(&self, derivatives: &[Variation], by: &[f64]) -> Option<Self> {
        let follow = |(i, piece): (usize, &ThreeClothoids)| {
            piece.moved(&derivatives[i], self.unknowns(i).map(|(unknown, scale)| by[unknown] * scale))
        };
        let pieces = self.pieces.iter().enumerate().map(follow).collect::<Option<_>>()?;
        let mut moved = Self { pieces, ..self.clone() };
        for (i, Passed { pose, .. }) in moved.passed.iter_mut().enumerate() {
            pose.heading += by[OF_BOTH * i];
            pose.curvature += by[OF_BOTH * i + 1] * self.bends[i];
        }
        Some(moved)
    }

    /// Gives pieces other shares that are better between the same poses; whether there were any.
    fn reshare(&mut self) -> bool {
        let mut improved = false;
        for i in 0..self.pieces.len() {
            let held = [i, i + 1].map(|i| Passed { free: [false; 2], ..self.passed[i] }).to_vec();
            let (chords, bends) = (vec![self.chords[i]], self.bends[i..=i + 1].to_vec());
            let mut alone = Self { passed: held, pieces: Vec::new(), chords, bends };
            for shares in SHARES {
                let Some(other) = self.pieces[i].shared(shares) else { continue };
                alone.pieces = vec![other];
                alone.descend(COARSE, FEW_STEPS);
                if alone.pieces[0].variation() < self.pieces[i].variation() * (1.0 - WORTHWHILE) {
                    self.pieces[i] = alone.pieces[0];
                    improved = true;
                }
            }
        }
        improved
    }

    fn segments(&self) -> Vec<Segment> {
        let pairs = self.passed.windows(2);
        self.pieces.iter().zip(pairs).flat_map(|(piece, pair)| piece.segments(&pair[0].pose, &pair[1].pose)).collect()
    }
}

impl Equations {
    /// Keeps one unknown as it is.
    fn hold(&mut self, k: usize) {
        self.slope[k] = 0.0;
        self.matrix[k] = [0.0; BAND + 1];
        self.matrix[k][BAND] = 1.0;
        for i in k + 1..self.matrix.len().min(k + BAND + 1) {
            self.matrix[i][BAND + k - i] = 0.0;
        }
    }

    /// The step of all unknowns and what it would gain along the slope; nothing if it would not go down.
    fn step(&self, damping: f64) -> Option<(Vec<f64>, f64)> {
        let largest = self.matrix.iter().map(|row| row[BAND].abs()).fold(0.0, f64::max);
        let mut damped = self.matrix.clone();
        for row in &mut damped {
            // Unknowns on which hardly anything depends, such as the shares of what is one clothoid, stay where they are.
            row[BAND] += damping * (row[BAND].abs() + 1e-3 * largest);
        }
        let mut by = solve_banded(damped, self.slope.clone())?;
        let farthest = by.iter().fold(0.0, |far: f64, x| far.max(x.abs()));
        let part = if farthest > LONGEST { LONGEST / farthest } else { 1.0 };
        by.iter_mut().for_each(|x| *x *= -part);
        let gain = -by.iter().zip(&self.slope).map(|(x, slope)| x * slope).sum::<f64>();
        Some((by, gain))
    }
}

#[cfg(test)]
mod tests {
    use super::super::coordinate_search::{coordinate_search, variation};
    use super::*;
    use fairpath_curve::{Point, Vec2};

    /// Numbers that look random, from −1 to 1, the same on every run.
    struct Scatter(u64);

    impl Scatter {
        fn number(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    /// A curve of some bends, one to three of whose places are moved by up to `far` to each side: its pieces are from 6 to 125 px long.
    fn pulled(r: &mut Scatter, far: f64) -> Vec<Passed> {
        let n = 1 + (1.5 * (1.0 + r.number())) as usize;
        let mut pose = Pose { point: Point::ORIGIN, heading: 3.0 * r.number(), curvature: 0.02 * r.number() };
        let held = |pose| Passed { pose, free: [false; 2] };
        let mut passed = vec![held(pose)];
        for i in 0..=n {
            let length = 80.0 * libm::exp(1.5 * (r.number() - 0.7));
            let next = (0.025 * r.number() + 0.3 * pose.curvature).clamp(-2.0 / length, 2.0 / length);
            pose = Segment::clothoid(pose.point, pose.heading, length, pose.curvature, next).end_pose();
            let by = Vec2::new(r.number(), r.number()) * far;
            let knot = Pose { point: pose.point + by, ..pose };
            passed.push(if i < n { Passed { pose: knot, free: [true; 2] } } else { held(pose) });
        }
        passed
    }

    fn of(segments: &[Segment]) -> f64 {
        segments.chunks(3).map(variation).sum()
    }

    #[test]
    fn curvature_varies_no_more_than_a_search_along_coordinates_finds() {
        let mut r = Scatter(7);
        let mut fairer = 0;
        for case in 0..16 {
            let passed = pulled(&mut r, if case % 2 == 0 { 3.0 } else { 10.0 });
            let old = of(&coordinate_search(&passed).expect("it finds a curve"));
            let new = of(&fairest(&passed).expect("there is a curve"));
            assert!(new <= old * (1.0 + 1e-6), "{case}: {new} instead of {old}");
            fairer += usize::from(new < 0.99 * old);
        }
        // That search stops at steps of 4e-3 and leaves something to gain, or this test would compare nothing.
        assert!(fairer > 4, "{fairer}");
    }

    #[test]
    fn nothing_that_is_near_varies_less() {
        let mut r = Scatter(11);
        for _ in 0..40 {
            let mut course = Course::new(pulled(&mut r, 8.0)).expect("there is a curve");
            course.descend(FINE, MOST_STEPS);
            let derivatives: Vec<_> = course.pieces.iter().map(|p| p.derivatives().expect("it is regular")).collect();
            let (least, mut tried) = (course.variation(), 0);
            for _ in 0..20 {
                let by: Vec<f64> = (0..OF_BOTH * course.pieces.len() + OF_POSE)
                    .map(|k| {
                        let is_free = k % OF_BOTH >= OF_POSE || course.passed[k / OF_BOTH].free[k % OF_BOTH];
                        if is_free { 0.01 * r.number() } else { 0.0 }
                    })
                    .collect();
                if let Some(moved) = course.moved(&derivatives, &by) {
                    assert!(moved.variation() >= least * (1.0 - 1e-8), "{} {least}", moved.variation());
                    tried += 1;
                }
            }
            assert!(tried > 10);
        }
    }

    #[test]
    fn poses_are_met_and_what_is_held_keeps_its_bits() {
        let mut r = Scatter(3);
        for case in 0..60 {
            let mut passed = pulled(&mut r, 20.0);
            passed[1].free = [case % 3 == 0, case % 3 == 1];
            let segments = fairest(&passed).expect("there is a curve");
            assert_eq!(segments.len(), 3 * (passed.len() - 1));
            for (three, pair) in segments.chunks(3).zip(passed.windows(2)) {
                let (start, end) = (three[0].start_pose(), three[2].end_pose());
                assert_eq!(start.point, pair[0].pose.point);
                assert!(
                    (end.point - pair[1].pose.point).hypot() < 1e-9,
                    "{}",
                    (end.point - pair[1].pose.point).hypot()
                );
                if !pair[0].free[0] {
                    assert_eq!(start.heading, pair[0].pose.heading);
                }
                if !pair[0].free[1] {
                    assert_eq!(start.curvature, pair[0].pose.curvature);
                }
            }
            for (i, pair) in segments.windows(2).enumerate() {
                let (end, start) = (pair[0].end_pose(), pair[1].start_pose());
                let turn = fairpath_curve::trig::wrap_angle(end.heading - start.heading).abs();
                let (bend, scale) = ((end.curvature - start.curvature).abs(), end.curvature.abs() + 1e-3);
                assert!(turn < 1e-9 && bend < 1e-9 * scale, "{case} {i}: {turn:e} {bend:e}");
            }
        }
    }
}
