//! Three clothoids from one pose to another as a function of both poses: the least that their curvature can vary for given shares of the length comes out,
//! with its first and second derivatives by headings, curvatures and shares.
//!
//! In the frame of the chord, which is the unit, the curve has three more unknowns, the curvatures at the two inner joins and the length. Heading and
//! position at the end are three equations for them, solved by Newton's method. What is left is smooth, and is derived through these equations: the
//! gradient by their multipliers, the second derivatives by those of the Lagrangian along the solutions.

use fairpath_curve::{Pose, Segment, Vec2, moments, moments_to_4, trig};
use std::f64::consts::PI;

/// What may be chosen: heading and curvature at the start, the same at the end, and the logarithms of the lengths of the outer two segments over that of the
/// middle one.
pub(super) const CHOICES: usize = 6;

/// What follows from that: the inner curvatures and the length.
const FOLLOWING: usize = 3;

/// The parameters of the chain: heading and curvature at its start, the curvatures at the ends of its segments, their lengths.
const CHAIN: usize = 8;

/// Three clothoids in the frame of their chord.
#[derive(Clone, Copy, Debug)]
pub(super) struct ThreeClothoids {
    /// Heading and curvature at the start and at the end, and the logarithms of the shares.
    pub(super) choice: [f64; CHOICES],
    /// The inner curvatures and the length.
    following: [f64; FOLLOWING],
    /// The segments' shares of the length.
    shares: [f64; 3],
}

/// The variation of curvature of three clothoids, and how it changes.
pub(super) struct Variation {
    pub(super) gradient: [f64; CHOICES],
    pub(super) hessian: [[f64; CHOICES]; CHOICES],
    /// How what follows moves with what is chosen.
    follows: [[f64; CHOICES]; FOLLOWING],
}

/// Where a chain ends, and how that moves with its parameters.
struct End {
    heading: f64,
    point: Vec2,
    heading_by: [f64; CHAIN],
    point_by: [Vec2; CHAIN],
}

const CURVATURES: usize = 1;
const LENGTHS: usize = 5;

fn shares(choice: &[f64; CHOICES]) -> [f64; 3] {
    let (first, last) = (libm::exp(choice[4]), libm::exp(choice[5]));
    let sum = first + 1.0 + last;
    [first / sum, 1.0 / sum, last / sum]
}

fn left(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

impl ThreeClothoids {
    /// The same from segments, and the angles to be taken from the headings of the poses to get those of the frame.
    pub(super) fn of(segments: &[Segment; 3], from: &Pose, to: &Pose) -> Self {
        let chord = to.point - from.point;
        let r = chord.hypot();
        let length: f64 = segments.iter().map(|s| s.length).sum();
        let heading = trig::wrap_angle(from.heading - trig::angle_of(chord));
        let turning: f64 = segments.iter().map(Segment::turning).sum();
        let share = |i: usize| libm::log(segments[i].length / segments[1].length);
        let choice = [heading, from.curvature * r, heading + turning, to.curvature * r, share(0), share(2)];
        let following = [segments[1].kappa0 * r, segments[1].kappa1 * r, length / r];
        Self { choice, following, shares: shares(&choice) }
    }

    /// As segments between two poses, whose headings and curvatures must be the chosen ones.
    pub(super) fn segments(&self, from: &Pose, to: &Pose) -> [Segment; 3] {
        let r = (to.point - from.point).hypot();
        let [a, b, _] = self.following;
        let lengths = self.lengths().map(|l| l * r);
        let first = Segment::clothoid(from.point, from.heading, lengths[0], from.curvature, a / r);
        let middle = Segment::clothoid(first.end(), first.end_heading(), lengths[1], a / r, b / r);
        let last = Segment::clothoid(middle.end(), middle.end_heading(), lengths[2], b / r, to.curvature);
        [first, middle, last]
    }

    /// The same with other shares of the outer segments, if there is such a curve nearby.
    pub(super) fn shared(&self, [first, last]: [f64; 2]) -> Option<Self> {
        let (old, k) = (self.shares, self.curvatures());
        let at = |share: f64| {
            let knots = [0.0, old[0], old[0] + old[1], 1.0];
            let i = (0..2).find(|&i| share <= knots[i + 1]).unwrap_or(2);
            k[i] + (k[i + 1] - k[i]) * (share - knots[i]) / old[i]
        };
        let mut new = *self;
        new.following = [at(first), at(1.0 - last), self.following[2]];
        let middle = 1.0 - first - last;
        (new.choice[4], new.choice[5]) = (libm::log(first / middle), libm::log(last / middle));
        new.settle().then_some(new)
    }

    fn lengths(&self) -> [f64; 3] {
        self.shares.map(|share| share * self.following[2])
    }

    fn curvatures(&self) -> [f64; 4] {
        [self.choice[1], self.following[0], self.following[1], self.choice[3]]
    }

    /// Curvature's variation `∫ κ'² ds` times the fifth power of the length.
    pub(super) fn variation(&self) -> f64 {
        let (l, k) = (self.lengths(), self.curvatures());
        let sum: f64 = (0..3).map(|i| (k[i + 1] - k[i]) * (k[i + 1] - k[i]) / l[i]).sum();
        let length = self.following[2];
        sum * length * length * length * length * length
    }

    fn end(&self) -> End {
        let (l, k) = (self.lengths(), self.curvatures());
        let mut end =
            End { heading: self.choice[0], point: Vec2::ZERO, heading_by: [0.0; CHAIN], point_by: [Vec2::ZERO; CHAIN] };
        end.heading_by[0] = 1.0;
        for i in 0..3 {
            let bend = k[i + 1] - k[i];
            let [m0, m1, m2] = moments(end.heading, k[i] * l[i], bend * l[i], 1.0);
            let by_heading = left(m0) * l[i];
            for (point, heading) in end.point_by.iter_mut().zip(end.heading_by) {
                *point += by_heading * heading;
            }
            let area = l[i] * l[i];
            end.point_by[CURVATURES + i] += left(m1 - m2 * 0.5) * area;
            end.point_by[CURVATURES + i + 1] += left(m2) * (0.5 * area);
            end.point_by[LENGTHS + i] += m0 + left(m1 * k[i] + m2 * (0.5 * bend)) * l[i];
            end.point += m0 * l[i];
            let mean = 0.5 * (k[i] + k[i + 1]);
            end.heading_by[CURVATURES + i] += 0.5 * l[i];
            end.heading_by[CURVATURES + i + 1] += 0.5 * l[i];
            end.heading_by[LENGTHS + i] += mean;
            end.heading += mean * l[i];
        }
        end
    }

    /// The three equations at the end, by what follows.
    fn by_following(&self, end: &End) -> [[f64; FOLLOWING]; 3] {
        let shares = self.shares;
        let row = |by: &dyn Fn(usize) -> f64| {
            let by_length = (0..3).map(|i| shares[i] * by(LENGTHS + i)).sum();
            [by(CURVATURES + 1), by(CURVATURES + 2), by_length]
        };
        [row(&|y| end.heading_by[y]), row(&|y| end.point_by[y].x), row(&|y| end.point_by[y].y)]
    }

    /// Finds what follows from what is chosen, from a guess; whether it was found.
    fn settle(&mut self) -> bool {
        self.shares = shares(&self.choice);
        for _ in 0..10 {
            let end = self.end();
            let missing = [end.heading - self.choice[2], end.point.x - 1.0, end.point.y];
            let Some(inverse) = inverse(&self.by_following(&end)) else { return false };
            let step = inverse.map(|row| row[0] * missing[0] + row[1] * missing[1] + row[2] * missing[2]);
            let length = self.following[2];
            let size = step[2].abs() + (step[0].abs() + step[1].abs()) * length.abs();
            if !(size <= FARTHEST) {
                return false;
            }
            self.following = std::array::from_fn(|i| self.following[i] - step[i]);
            if !(self.following[2] > 0.0) {
                return false;
            }
            if size <= SMALL {
                return true;
            }
        }
        false
    }

    /// The curve for another choice, from this one's `derivatives`; nothing if there is none nearby, or if it would go round the long way: an arc varies nothing
    /// however large it is, and so nothing else keeps curves from running away on one.
    pub(super) fn moved(&self, derivatives: &Variation, by: [f64; CHOICES]) -> Option<Self> {
        let mut moved = *self;
        for j in 0..CHOICES {
            moved.choice[j] += by[j];
            for i in 0..FOLLOWING {
                moved.following[i] += derivatives.follows[i][j] * by[j];
            }
        }
        if [0, 2].iter().any(|&end| moved.choice[end].abs() > PI) || !moved.settle() {
            return None;
        }
        let [old, new] = [self, &moved].map(|three| three.following[2]);
        (new < MOST_GROWTH * old && old < MOST_GROWTH * new && new <= f64::max(LONGEST, old)).then_some(moved)
    }

    /// The variation's derivatives by what is chosen, what follows following.
    pub(super) fn derivatives(&self) -> Option<Variation> {
        let end = self.end();
        let (shares, length) = (self.shares, self.following[2]);
        // All variables, what is chosen and then what follows, and how the chain's parameters move with them.
        const ALL: usize = CHOICES + FOLLOWING;
        let mut chain_by = [[0.0; ALL]; CHAIN];
        for (y, w) in [(0, 0), (1, 1), (2, 6), (3, 7), (4, 3)] {
            chain_by[y][w] = 1.0;
        }
        for i in 0..3 {
            for (w, j) in [(4, 0), (5, 2)] {
                let own = if i == j { 1.0 } else { 0.0 };
                chain_by[LENGTHS + i][w] = length * shares[i] * (own - shares[j]);
            }
            chain_by[LENGTHS + i][8] = shares[i];
        }
        let (value_by, value_by_2) = self.variation_by();
        let through = |by: &dyn Fn(usize) -> f64| -> [f64; ALL] {
            std::array::from_fn(|w| (0..CHAIN).map(|y| by(y) * chain_by[y][w]).sum())
        };
        let mut equations =
            [through(&|y| end.heading_by[y]), through(&|y| end.point_by[y].x), through(&|y| end.point_by[y].y)];
        equations[0][2] = -1.0;
        let inverse = inverse(&equations.map(|row| [row[6], row[7], row[8]]))?;
        let value = through(&|y| value_by[y]);
        // The multipliers: by how much the variation would change with what the equations leave missing.
        let multiplier: [f64; 3] =
            std::array::from_fn(|i| -(0..3).map(|u| value[CHOICES + u] * inverse[u][i]).sum::<f64>());
        let follows: [[f64; CHOICES]; FOLLOWING] = std::array::from_fn(|u| {
            std::array::from_fn(|w| -(0..3).map(|i| inverse[u][i] * equations[i][w]).sum::<f64>())
        });
        let gradient = std::array::from_fn(|w| value[w] + (0..3).map(|i| multiplier[i] * equations[i][w]).sum::<f64>());
        let mut chain = self.end_by_2(multiplier);
        for y in 0..CHAIN {
            for z in 0..CHAIN {
                chain[y][z] += value_by_2[y][z];
            }
        }
        let mut lagrangian = [[0.0; ALL]; ALL];
        let half: [[f64; ALL]; CHAIN] = std::array::from_fn(|y| through(&|z| chain[y][z]));
        for v in 0..ALL {
            for w in 0..ALL {
                lagrangian[v][w] = (0..CHAIN).map(|y| chain_by[y][v] * half[y][w]).sum();
            }
        }
        // The lengths are no linear functions of length and shares.
        let by_length: [f64; 3] = std::array::from_fn(|i| {
            let y = LENGTHS + i;
            value_by[y]
                + multiplier[0] * end.heading_by[y]
                + multiplier[1] * end.point_by[y].x
                + multiplier[2] * end.point_by[y].y
        });
        let same = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        for i in 0..3 {
            for (v, j) in [(4, 0), (5, 2)] {
                let by_share = shares[i] * (same(i, j) - shares[j]);
                lagrangian[v][8] += by_length[i] * by_share;
                lagrangian[8][v] += by_length[i] * by_share;
                for (w, k) in [(4, 0), (5, 2)] {
                    let twice =
                        (same(i, j) - shares[j]) * (same(i, k) - shares[k]) - shares[j] * (same(j, k) - shares[k]);
                    lagrangian[v][w] += by_length[i] * length * shares[i] * twice;
                }
            }
        }
        let along = |v: usize, w: usize| -> f64 {
            // One column of the Lagrangian's second derivatives along the solutions.
            lagrangian[v][w] + (0..FOLLOWING).map(|u| lagrangian[v][CHOICES + u] * follows[u][w]).sum::<f64>()
        };
        let hessian = std::array::from_fn(|v| {
            std::array::from_fn(|w| {
                along(v, w) + (0..FOLLOWING).map(|u| follows[u][v] * along(CHOICES + u, w)).sum::<f64>()
            })
        });
        Some(Variation { gradient, hessian, follows })
    }

    /// The variation's derivatives by the chain's parameters.
    fn variation_by(&self) -> ([f64; CHAIN], [[f64; CHAIN]; CHAIN]) {
        let (l, k) = (self.lengths(), self.curvatures());
        let length = self.following[2];
        let cube = length * length * length;
        let [fifth, fourth] = [cube * length * length, cube * length];
        let mut by = [0.0; CHAIN];
        let mut by_2 = [[0.0; CHAIN]; CHAIN];
        // First the sum of squared rates alone, then the power of the length.
        let mut sum = 0.0;
        for i in 0..3 {
            let (d, y) = (k[i + 1] - k[i], CURVATURES + i);
            let rate = d / l[i];
            sum += d * rate;
            by[y] -= 2.0 * rate;
            by[y + 1] += 2.0 * rate;
            by[LENGTHS + i] = -rate * rate;
            let second = 2.0 / l[i];
            by_2[y][y] += second;
            by_2[y + 1][y + 1] += second;
            by_2[y][y + 1] -= second;
            by_2[y + 1][y] -= second;
            let mixed = 2.0 * rate / l[i];
            for (z, value) in [(y, mixed), (y + 1, -mixed)] {
                by_2[z][LENGTHS + i] = value;
                by_2[LENGTHS + i][z] = value;
            }
            by_2[LENGTHS + i][LENGTHS + i] = mixed * rate;
        }
        let is_length = |y: usize| if y >= LENGTHS { 1.0 } else { 0.0 };
        for y in 0..CHAIN {
            for z in 0..CHAIN {
                by_2[y][z] = by_2[y][z] * fifth
                    + 5.0 * fourth * (by[y] * is_length(z) + by[z] * is_length(y))
                    + 20.0 * cube * sum * is_length(y) * is_length(z);
            }
        }
        let by = std::array::from_fn(|y| by[y] * fifth + 5.0 * fourth * sum * is_length(y));
        (by, by_2)
    }

    /// Second derivatives of heading and position at the end by the chain's parameters, weighted.
    fn end_by_2(&self, [by_heading, x, y]: [f64; 3]) -> [[f64; CHAIN]; CHAIN] {
        let weight = Vec2::new(x, y);
        let (l, k) = (self.lengths(), self.curvatures());
        let mut by_2 = [[0.0; CHAIN]; CHAIN];
        let mut heading = self.choice[0];
        let mut heading_by = [0.0; CHAIN];
        heading_by[0] = 1.0;
        // What the later segments make of a turn at the end of each.
        let mut turned = [by_heading; 3];
        for i in 0..3 {
            let bend = k[i + 1] - k[i];
            let m = moments_to_4(heading, k[i] * l[i], bend * l[i], 1.0);
            let even = m.map(|m| weight.dot(m));
            let odd = m.map(|m| weight.dot(left(m)));
            turned[..i].iter_mut().for_each(|turned| *turned += l[i] * odd[0]);
            // How the heading at the share t of the segment moves with the heading and curvature at its start, the curvature at its end and its
            // length: polynomials in t.
            let by = [[1.0, 0.0, 0.0], [0.0, l[i], -0.5 * l[i]], [0.0, 0.0, 0.5 * l[i]], [0.0, k[i], 0.5 * bend]];
            let once: [f64; 4] = std::array::from_fn(|a| (0..3).map(|p| by[a][p] * odd[p]).sum());
            let mut own = [[0.0; 4]; 4];
            for a in 0..4 {
                for b in 0..4 {
                    for p in 0..3 {
                        for q in 0..3 {
                            own[a][b] -= l[i] * by[a][p] * by[b][q] * even[p + q];
                        }
                    }
                    let mixed = match (a.min(b), a.max(b)) {
                        (1, 3) => odd[1] - 0.5 * odd[2],
                        (2, 3) => 0.5 * odd[2],
                        _ => 0.0,
                    };
                    own[a][b] += l[i] * mixed;
                    own[a][b] += if a == 3 { once[b] } else { 0.0 } + if b == 3 { once[a] } else { 0.0 };
                }
            }
            let parameters = [CURVATURES + i, CURVATURES + i + 1, LENGTHS + i];
            for v in 0..CHAIN {
                for w in 0..CHAIN {
                    by_2[v][w] += own[0][0] * heading_by[v] * heading_by[w];
                }
                for (a, &w) in parameters.iter().enumerate() {
                    by_2[v][w] += own[0][a + 1] * heading_by[v];
                    by_2[w][v] += own[0][a + 1] * heading_by[v];
                }
            }
            for (a, &v) in parameters.iter().enumerate() {
                for (b, &w) in parameters.iter().enumerate() {
                    by_2[v][w] += own[a + 1][b + 1];
                }
            }
            let mean = 0.5 * (k[i] + k[i + 1]);
            heading_by[CURVATURES + i] += 0.5 * l[i];
            heading_by[CURVATURES + i + 1] += 0.5 * l[i];
            heading_by[LENGTHS + i] += mean;
            heading += mean * l[i];
        }
        for i in 0..3 {
            for y in [CURVATURES + i, CURVATURES + i + 1] {
                by_2[y][LENGTHS + i] += 0.5 * turned[i];
                by_2[LENGTHS + i][y] += 0.5 * turned[i];
            }
        }
        by_2
    }
}

/// The longest curve, in chords, unless it was longer to begin with.
const LONGEST: f64 = 8.0;

/// Lengths that differ by more than this factor belong to different branches.
const MOST_GROWTH: f64 = 2.0;

/// The steps of Newton's method square themselves: after one as small as this, what is left is rounding.
const SMALL: f64 = 1e-8;

/// A step of more than this, in lengths and angles, leads nowhere.
const FARTHEST: f64 = 20.0;

/// The inverse of a 3 × 3 matrix by Cramer's rule.
fn inverse(m: &[[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cross =
        |u: [f64; 3], v: [f64; 3]| [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let columns = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let determinant: f64 = (0..3).map(|i| m[0][i] * columns[0][i]).sum();
    let inverse = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i] / determinant));
    (determinant != 0.0 && determinant.is_finite()).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::{Point, hermite_g2};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]

        #[test]
        fn derivatives_are_those_of_differences(phi in [-2.0..2.0_f64, -2.0..2.0], kappa in [-4.0..4.0_f64, -4.0..4.0]) {
            let pose = |x: f64, i: usize| Pose { point: Point::new(x, 0.0), heading: phi[i], curvature: kappa[i] };
            let (from, to) = (pose(0.0, 0), pose(1.0, 1));
            let segments = hermite_g2(from, to).unwrap();
            let three = ThreeClothoids::of(&segments, &from, &to);
            let own = three.derivatives().unwrap();
            let step = 1e-5;
            for j in 0..CHOICES {
                let at = |h: f64| {
                    let mut by = [0.0; CHOICES];
                    by[j] = h;
                    three.moved(&own, by).unwrap()
                };
                let [ahead, back] = [at(step), at(-step)];
                let slope = (ahead.variation() - back.variation()) / (2.0 * step);
                let scale = own.hessian.iter().flatten().fold(1.0, |a: f64, b| a.max(b.abs()));
                prop_assert!((slope - own.gradient[j]).abs() <= 1e-6 * scale, "{j}: {slope} {}", own.gradient[j]);
                let [ahead, back] = [ahead, back].map(|t| t.derivatives().unwrap().gradient);
                for i in 0..CHOICES {
                    let second = (ahead[i] - back[i]) / (2.0 * step);
                    prop_assert!((second - own.hessian[i][j]).abs() <= 1e-5 * scale, "{i} {j}: {second} {}", own.hessian[i][j]);
                }
            }
        }
    }
}
