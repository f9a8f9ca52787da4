//! Guesses of how the fairest curve through points passes them: poses come in, of some of which heading or curvature may be chosen; the same poses with a choice
//! go out.

use super::banded::{BAND, Row, solve_banded};
use super::fairest::Passed;
use fairpath_curve::{Point, Vec2, trig};

/// The integral's weights for the differences of position, velocity and acceleration to those of a parabola from the start, over the unit interval.
const WEIGHTS: [[f64; 3]; 3] = [[720.0, -360.0, 60.0], [-360.0, 192.0, -36.0], [60.0, -36.0, 9.0]];

/// As the quintic spline of least `∫ |p'''|² dt` passes them, with chords for times: one system of linear equations. Nothing if these have no solution.
pub(super) fn quintic(passed: &[Passed]) -> Option<Vec<Passed>> {
    let n = passed.len();
    let is_free = |i: usize| passed[i].free.iter().any(|free| *free);
    // Velocity and acceleration of what is held.
    let held = |i: usize| {
        let pose = passed[i].pose;
        let tangent = trig::unit(pose.heading);
        [tangent, Vec2::new(-tangent.y, tangent.x) * pose.curvature]
    };
    let mut matrix: Vec<Row> = vec![[0.0; BAND + 1]; 2 * n];
    let mut right = [vec![0.0; 2 * n], vec![0.0; 2 * n]];
    for i in 0..n - 1 {
        let chord = passed[i + 1].pose.point - passed[i].pose.point;
        let h = chord.hypot();
        // Differences over powers of the time, so that the weights stay those of the unit interval.
        let by = [[-1.0 / h, -0.5, 0.0, 0.0], [-1.0 / h, -1.0, 1.0 / h, 0.0], [0.0, -1.0, 0.0, 1.0]];
        let mut rest = [chord / (h * h), Vec2::ZERO, Vec2::ZERO];
        for (k, end) in [i, i + 1].into_iter().enumerate().filter(|(_, end)| !is_free(*end)) {
            for (u, value) in held(end).into_iter().enumerate() {
                for (rest, by) in rest.iter_mut().zip(by) {
                    *rest += value * by[2 * k + u];
                }
            }
        }
        let free = |u: usize| is_free(i + u / 2);
        for u in (0..4).filter(|u| free(*u)) {
            let row: [f64; 3] = std::array::from_fn(|d| (0..3).map(|c| WEIGHTS[c][d] * by[c][u]).sum::<f64>() / h);
            for v in (0..=u).filter(|v| free(*v)) {
                matrix[2 * i + u][BAND + v - u] += (0..3).map(|d| row[d] * by[d][v]).sum::<f64>();
            }
            let slope = (0..3).fold(Vec2::ZERO, |sum, d| sum + rest[d] * row[d]);
            right[0][2 * i + u] -= slope.x;
            right[1][2 * i + u] -= slope.y;
        }
    }
    for i in (0..n).filter(|i| !is_free(*i)) {
        matrix[2 * i][BAND] = 1.0;
        matrix[2 * i + 1][BAND] = 1.0;
    }
    let [x, y] = right.map(|right| solve_banded(matrix.clone(), right));
    let (x, y) = (x?, y?);
    let pose = |(i, passed): (usize, &Passed)| {
        let [velocity, acceleration] = [0, 1].map(|u| Vec2::new(x[2 * i + u], y[2 * i + u]));
        let speed = velocity.hypot();
        let mut new = *passed;
        if passed.free[0] && speed > 0.0 {
            new.pose.heading += trig::wrap_angle(trig::angle_of(velocity) - passed.pose.heading);
        }
        if passed.free[1] && speed > 0.0 {
            new.pose.curvature = velocity.cross(acceleration) / (speed * speed * speed);
        }
        new
    };
    Some(passed.iter().enumerate().map(pose).collect())
}

/// As the circle through each and its two neighbours passes it. What has one neighbour stays as it is.
pub(super) fn circles(passed: &[Passed]) -> Vec<Passed> {
    let points: Vec<Point> = passed.iter().map(|p| p.pose.point).collect();
    let mut new = passed.to_vec();
    for (three, Passed { pose, free }) in points.windows(3).zip(new.iter_mut().skip(1)) {
        let (before, after) = (three[1] - three[0], three[2] - three[1]);
        let lengths = [before.hypot(), after.hypot()];
        let tangent = before * (lengths[1] / lengths[0]) + after * (lengths[0] / lengths[1]);
        let curvature = 2.0 * before.cross(after) / (lengths[0] * lengths[1] * (three[2] - three[0]).hypot());
        if free[0] && tangent.is_finite() {
            pose.heading += trig::wrap_angle(trig::angle_of(tangent) - pose.heading);
        }
        if free[1] && curvature.is_finite() {
            pose.curvature = curvature;
        }
    }
    new
}
