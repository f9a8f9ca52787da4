//! The elevation of a path over its arc length in plan: a chain of cubics with a continuous grade.

use std::fmt;
use thiserror::Error;

/// A place of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Arc length in plan from the path's start, m.
    pub station_m: f64,
    /// Height above the origin of heights, m.
    pub height_m: f64,
    /// Rise for a metre of arc length in plan.
    pub grade: f64,
}

impl Knot {
    /// Whether the piece from here to the next knot is anywhere steeper than this, whichever way.
    pub(crate) fn is_steeper(&self, next: &Self, grade: f64) -> bool {
        let h = next.station_m - self.station_m;
        // The grade is a parabola, within what it has at both ends and this (its Bézier points).
        let middle = 3.0 * (next.height_m - self.height_m) / h - self.grade - next.grade;
        let ends = self.grade.abs().max(next.grade.abs());
        if ends > grade || middle.abs() <= grade {
            return ends > grade;
        }
        let [by, bend] = [middle - self.grade, self.grade - 2.0 * middle + next.grade];
        let turns = -by / bend;
        turns > 0.0 && turns < 1.0 && (self.grade + by * turns).abs() > grade
    }
}

/// Why knots are no profile.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// There are fewer than two.
    #[error("a profile needs at least two knots, and there are {0}")]
    TooFew(usize),
    /// A number is not finite, or a station is not beyond the one before.
    #[error("knot {knot} of the profile is at station {station_m} m; stations must ascend, and all numbers be finite")]
    Knot {
        /// Which one.
        knot: usize,
        /// Its station, m.
        station_m: f64,
    },
    /// Two profiles that are to be added lie apart.
    #[error("the profiles have no stations in common: one ends at {end_m} m, and the other begins at {begin_m} m")]
    Apart {
        /// The first end, m.
        end_m: f64,
        /// The last beginning, m.
        begin_m: f64,
    },
    /// A height cannot be followed with a weight that is not positive and finite, or there are more or fewer weights than heights.
    #[error("{points} heights come with {weights} weights; each height needs one that is positive and finite")]
    Weights {
        /// How many heights there are.
        points: usize,
        /// How many weights.
        weights: usize,
    },
    /// A stiffness is not positive and finite, or there are more or fewer of them than intervals between heights.
    #[error("{intervals} intervals come with {given} stiffnesses; each needs one that is positive and finite")]
    Stiffness {
        /// How many intervals there are.
        intervals: usize,
        /// How many stiffnesses.
        given: usize,
    },
}

/// The elevation of a path over its arc length in plan.
///
/// Between two knots it is the cubic that has their heights and grades (Hermite), so that the grade is continuous everywhere.
#[derive(Clone, PartialEq)]
pub struct Profile {
    knots: Vec<Knot>,
}

impl fmt::Debug for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.knots.iter().map(|k| (k.station_m, k.height_m, k.grade))).finish()
    }
}

/// No piece that comes of others is shorter, m: what rounding makes of equal stations would have any bend.
const LEAST_PIECE_M: f64 = 1e-6;

/// What a profile is at a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elevation {
    /// Height, m.
    pub height_m: f64,
    /// Rise for a metre of arc length in plan.
    pub grade: f64,
    /// Change of grade for a metre, 1/m: positive in a sag, negative over a crest.
    pub bend_per_m: f64,
}

impl Profile {
    /// A profile through these knots.
    ///
    /// # Errors
    /// When there are fewer than two, stations do not ascend, or a number is not finite.
    pub fn new(knots: Vec<Knot>) -> Result<Self, ProfileError> {
        if knots.len() < 2 {
            return Err(ProfileError::TooFew(knots.len()));
        }
        for (i, knot) in knots.iter().enumerate() {
            let finite = [knot.station_m, knot.height_m, knot.grade].iter().all(|x| x.is_finite());
            if !finite || (i > 0 && !(knot.station_m > knots[i - 1].station_m)) {
                return Err(ProfileError::Knot { knot: i, station_m: knot.station_m });
            }
        }
        Ok(Self { knots })
    }

    /// Through points by Catmull-Rom's rule, as section 3.4.4 of the thesis has it: the grade at a point is that of the line between its neighbours. It may rise
    /// above the highest point and fall below the lowest.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn catmull_rom(points: &[[f64; 2]]) -> Result<Self, ProfileError> {
        let grade = |i: usize| {
            let (a, b) = (points[i.saturating_sub(1)], points[(i + 1).min(points.len() - 1)]);
            (b[1] - a[1]) / (b[0] - a[0])
        };
        Self::with_grades(points, grade)
    }

    /// Through points without rising above or falling below neighbouring ones: level at the highest and the lowest, and between them a grade of one sign
    /// (Steffen, *A simple method for monotonic interpolation in one dimension*, 1990). At both ends it is level.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn monotone(points: &[[f64; 2]]) -> Result<Self, ProfileError> {
        let slope = |i: usize| (points[i + 1][1] - points[i][1]) / (points[i + 1][0] - points[i][0]);
        let grade = |i: usize| {
            if i == 0 || i + 1 == points.len() {
                return 0.0;
            }
            let (before, after) = (slope(i - 1), slope(i));
            if !(before * after > 0.0) {
                return 0.0;
            }
            let (h0, h1) = (points[i][0] - points[i - 1][0], points[i + 1][0] - points[i][0]);
            let parabola = (before * h1 + after * h0) / (h0 + h1);
            let most = 2.0 * before.abs().min(after.abs());
            parabola.abs().min(most).copysign(before)
        };
        Self::with_grades(points, grade)
    }

    fn with_grades(points: &[[f64; 2]], grade: impl Fn(usize) -> f64) -> Result<Self, ProfileError> {
        if points.len() < 2 {
            return Err(ProfileError::TooFew(points.len()));
        }
        let knot = |i: usize| Knot { station_m: points[i][0], height_m: points[i][1], grade: grade(i) };
        Self::new((0..points.len()).map(knot).collect())
    }

    /// Its knots.
    #[must_use]
    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// From the first station to the last, m.
    #[must_use]
    pub fn range_m(&self) -> [f64; 2] {
        [self.knots[0].station_m, self.knots[self.knots.len() - 1].station_m]
    }

    /// Height, grade and bend at a station; before the first and beyond the last it goes on straight.
    #[must_use]
    pub fn at(&self, station_m: f64) -> Elevation {
        let [first, last] = self.range_m();
        if station_m < first || station_m > last {
            let knot = if station_m < first { self.knots[0] } else { self.knots[self.knots.len() - 1] };
            let height_m = knot.height_m + knot.grade * (station_m - knot.station_m);
            return Elevation { height_m, grade: knot.grade, bend_per_m: 0.0 };
        }
        self.on_piece(self.piece(station_m), station_m)
    }

    /// The same for stations that mostly ascend: each looks for its piece from that of the one before.
    pub(crate) fn along(&self) -> impl FnMut(f64) -> Elevation + '_ {
        let [first, last] = self.range_m();
        let mut piece = 0;
        move |station_m| {
            if !(first..=last).contains(&station_m) || station_m < self.knots[piece].station_m {
                piece = 0;
                return self.at(station_m);
            }
            while piece + 2 < self.knots.len() && self.knots[piece + 1].station_m <= station_m {
                piece += 1;
            }
            self.on_piece(piece, station_m)
        }
    }

    fn on_piece(&self, piece: usize, station_m: f64) -> Elevation {
        let t = station_m - self.knots[piece].station_m;
        let [a, b, c, d] = self.cubic(piece);
        Elevation {
            height_m: a + t * (b + t * (c + t * d)),
            grade: b + t * (2.0 * c + t * 3.0 * d),
            bend_per_m: 2.0 * c + t * 6.0 * d,
        }
    }

    /// The piece in which a station lies; the last one for whatever is beyond all.
    fn piece(&self, station_m: f64) -> usize {
        let after = self.knots.partition_point(|knot| knot.station_m <= station_m);
        after.saturating_sub(1).min(self.knots.len() - 2)
    }

    /// The cubic between a knot and the next: height is a + b t + c t² + d t³ at t metres beyond the knot, as OpenDRIVE writes elevation.
    ///
    /// # Panics
    /// When there is no such piece.
    #[must_use]
    pub fn cubic(&self, piece: usize) -> [f64; 4] {
        let (p, q) = (self.knots[piece], self.knots[piece + 1]);
        let h = q.station_m - p.station_m;
        let slope = (q.height_m - p.height_m) / h;
        let c = (3.0 * slope - 2.0 * p.grade - q.grade) / h;
        let d = (p.grade + q.grade - 2.0 * slope) / (h * h);
        [p.height_m, p.grade, c, d]
    }

    /// Where it is steepest within a range, and the grade there.
    #[must_use]
    pub fn steepest(&self, [from_m, to_m]: [f64; 2]) -> (f64, f64) {
        let mut found = (from_m, self.at(from_m).grade);
        let mut consider = |station: f64| {
            let grade = self.at(station).grade;
            if grade.abs() > found.1.abs() {
                found = (station, grade);
            }
        };
        consider(to_m);
        for piece in self.piece(from_m)..=self.piece(to_m) {
            let begin = self.knots[piece].station_m;
            let [_, _, c, d] = self.cubic(piece);
            // The grade is a parabola: it is steepest at its ends or where its own slope is nothing.
            for station in [begin, begin - c / (3.0 * d)] {
                if (from_m.max(begin)..=to_m.min(self.knots[piece + 1].station_m)).contains(&station) {
                    consider(station);
                }
            }
        }
        found
    }

    /// The sum with another profile, at the stations that both have.
    ///
    /// # Errors
    /// When they have no range in common, or a sum is not finite.
    pub fn plus(&self, other: &Self) -> Result<Self, ProfileError> {
        let ([a0, a1], [b0, b1]) = (self.range_m(), other.range_m());
        let (first, last) = (a0.max(b0), a1.min(b1));
        if !(first < last) {
            return Err(ProfileError::Apart { end_m: last, begin_m: first });
        }
        let within = |knot: &&Knot| knot.station_m > first && knot.station_m < last;
        let mut stations: Vec<f64> =
            self.knots.iter().chain(&other.knots).filter(within).map(|knot| knot.station_m).collect();
        stations.retain(|s| s - first > LEAST_PIECE_M && last - s > LEAST_PIECE_M);
        stations.extend([first, last]);
        stations.sort_by(f64::total_cmp);
        stations.dedup_by(|later, earlier| *later - *earlier <= LEAST_PIECE_M);
        let knot = |station_m: f64| {
            let (a, b) = (self.at(station_m), other.at(station_m));
            Knot { station_m, height_m: a.height_m + b.height_m, grade: a.grade + b.grade }
        };
        Self::new(stations.into_iter().map(knot).collect())
    }

    /// The part between two stations, which become 0 and the difference.
    ///
    /// # Errors
    /// When the range is empty.
    pub fn part(&self, [from_m, to_m]: [f64; 2]) -> Result<Self, ProfileError> {
        let end = |station: f64| {
            let at = self.at(station);
            Knot { station_m: station - from_m, height_m: at.height_m, grade: at.grade }
        };
        let within = |knot: &&Knot| knot.station_m - from_m > LEAST_PIECE_M && to_m - knot.station_m > LEAST_PIECE_M;
        let between = self.knots.iter().filter(within);
        let moved = between.map(|knot| Knot { station_m: knot.station_m - from_m, ..*knot });
        Self::new(std::iter::once(end(from_m)).chain(moved).chain([end(to_m)]).collect())
    }

    /// The same run through from its end, from station 0.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let [_, last] = self.range_m();
        let turned =
            |knot: &Knot| Knot { station_m: last - knot.station_m, height_m: knot.height_m, grade: -knot.grade };
        Self { knots: self.knots.iter().rev().map(turned).collect() }
    }

    /// Another profile in the place of a part of this one: what lies within `transition_m` beside it makes way for a cubic that leads over with a continuous
    /// grade; the rest stays as it is.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_part(&self, part: &Self, transition_m: f64) -> Result<Self, ProfileError> {
        let [first, last] = self.range_m();
        let [from, to] = part.range_m();
        let (from, to) = (from.max(first), to.min(last));
        // Near an end there is less room for it.
        let (before, after) = ((from - transition_m.max(0.0)).max(first), (to + transition_m.max(0.0)).min(last));
        let knot = |profile: &Self, station_m: f64| {
            let at = profile.at(station_m);
            Knot { station_m, height_m: at.height_m, grade: at.grade }
        };
        let mut knots: Vec<Knot> =
            self.knots.iter().copied().filter(|k| before - k.station_m > LEAST_PIECE_M).collect();
        if from - before > LEAST_PIECE_M {
            knots.push(knot(self, before));
        }
        knots.push(knot(part, from));
        knots.extend(part.knots.iter().copied().filter(|k| k.station_m > from && k.station_m < to));
        knots.push(knot(part, to));
        if after - to > LEAST_PIECE_M {
            knots.push(knot(self, after));
        }
        knots.extend(self.knots.iter().copied().filter(|k| k.station_m - after > LEAST_PIECE_M));
        Self::new(knots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn along_a_profile_all_is_as_it_is_at_each_station(
            heights in prop::collection::vec((0.1..9.0_f64, -5.0..5.0_f64, -0.5..0.5_f64), 2..9),
            stations in prop::collection::vec((-9.0..60.0_f64, any::<bool>()), 1..30),
        ) {
            let mut station_m = 0.0;
            let knots = heights.iter().map(|&(step, height_m, grade)| {
                station_m += step;
                Knot { station_m, height_m, grade }
            });
            let profile = Profile::new(knots.collect()).unwrap();
            let mut stations: Vec<f64> = stations.into_iter().map(|(s, is_knot)| {
                let nearest = |a: &&Knot, b: &&Knot| (a.station_m - s).abs().total_cmp(&(b.station_m - s).abs());
                if is_knot { profile.knots().iter().min_by(nearest).unwrap().station_m } else { s }
            }).collect();
            // In any order, then as they ascend.
            let mut along = profile.along();
            prop_assert!(stations.iter().all(|s| along(*s) == profile.at(*s)));
            stations.sort_by(f64::total_cmp);
            let mut along = profile.along();
            prop_assert!(stations.iter().all(|s| along(*s) == profile.at(*s)));
        }

        #[test]
        fn a_piece_is_steeper_where_its_samples_are(
            length in 0.1..50.0_f64, rise in -5.0..5.0_f64, grades in [-0.5..0.5_f64, -0.5..0.5_f64], limit in 0.01..1.0_f64,
        ) {
            let from = Knot { station_m: 100.0, height_m: 7.0, grade: grades[0] };
            let to = Knot { station_m: 100.0 + length, height_m: 7.0 + rise, grade: grades[1] };
            let profile = Profile::new(vec![from, to]).unwrap();
            let steepest = (0..=1000)
                .map(|i| profile.at(100.0 + length * f64::from(i) / 1000.0).grade.abs())
                .fold(0.0, f64::max);
            // Between two samples it may be a little steeper.
            let slack = 1e-4 * (1.0 + rise.abs() / length);
            if steepest > limit + 1e-9 {
                prop_assert!(from.is_steeper(&to, limit), "{steepest} of {limit}");
            }
            if steepest < limit - slack {
                prop_assert!(!from.is_steeper(&to, limit), "{steepest} of {limit}");
            }
        }
    }
}
