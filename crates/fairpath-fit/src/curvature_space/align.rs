//! The turn and shift that lay points of one curve over those of another (McCrae and Singh 2008, section 4.4).

use fairpath_curve::{Vec2, trig};

/// A point of the curve as it was composed, the point of the stroke that it corresponds to, and how much the two count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) composed: Vec2,
    pub(crate) drawn: Vec2,
    pub(crate) weight: f64,
}

/// A turn about the origin followed by a shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    /// Radians, to the left.
    pub(crate) turn: f64,
    pub(crate) shift: Vec2,
}

/// The placement with the least weighted sum of squared distances (equations 12 to 14); if a `joint` is given, among those that move the
/// origin there (section 5.1).
///
/// The paper takes the rotational part of A_pq by polar decomposition, which fails where A_pq is singular, as for every straight stroke, and may
/// be a reflection. In the plane the best turn is known in closed form and needs neither; only where no turn is better than another, the
/// direction from the first to the last point decides, as the paper proposes.
pub(crate) fn align(pairs: &[Pair], joint: Option<Vec2>) -> Placement {
    let weight: f64 = pairs.iter().map(|p| p.weight).sum();
    let mean = |f: fn(&Pair) -> Vec2| pairs.iter().fold(Vec2::ZERO, |sum, p| sum + f(p) * (p.weight / weight));
    let (from, to) = match joint {
        Some(joint) => (Vec2::ZERO, joint),
        None => (mean(|p| p.composed), mean(|p| p.drawn)),
    };
    // The sums of dot and cross products are trace and skew part of A_pq.
    let (mut turned, mut size) = (Vec2::ZERO, 0.0);
    for pair in pairs {
        let (q, p) = (pair.composed - from, pair.drawn - to);
        turned += Vec2::new(q.dot(p), q.cross(p)) * pair.weight;
        size += pair.weight * (q.hypot2() * p.hypot2()).sqrt();
    }
    let turn = if turned.hypot2().sqrt() > SINGULAR * size {
        trig::angle_of(turned)
    } else {
        let (first, last) = (pairs[0], pairs[pairs.len() - 1]);
        trig::angle_of(last.drawn - first.drawn) - trig::angle_of(last.composed - first.composed)
    };
    Placement { turn, shift: to - rotated(from, turn) }
}

/// Below this share of what points that agree would give, the turn is rounding.
const SINGULAR: f64 = 1e-9;

fn rotated(v: Vec2, turn: f64) -> Vec2 {
    let t = trig::unit(turn);
    Vec2::new(t.x * v.x - t.y * v.y, t.y * v.x + t.x * v.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn pairs(composed: &[Vec2], turn: f64, shift: Vec2) -> Vec<Pair> {
        (1..)
            .zip(composed)
            .map(|(w, &q)| Pair { composed: q, drawn: rotated(q, turn) + shift, weight: f64::from(w) })
            .collect()
    }

    proptest! {
        #[test]
        fn a_rigid_motion_is_found_again(
            turn in -3.1..3.1_f64, x in -1e3..1e3_f64, y in -1e3..1e3_f64, bend in prop_oneof![Just(0.0), -1.0..1.0_f64],
        ) {
            // A straight row of points makes the paper's matrix singular.
            let row: Vec<Vec2> = (0..9).map(f64::from).map(|u| Vec2::new(10.0 * u, bend * u * u)).collect();
            for joint in [None, Some(Vec2::new(x, y))] {
                let found = align(&pairs(&row, turn, Vec2::new(x, y)), joint);
                prop_assert!(trig::wrap_angle(found.turn - turn).abs() < 1e-9);
                prop_assert!((found.shift - Vec2::new(x, y)).hypot() < 1e-8);
            }
        }
    }

    #[test]
    fn where_no_turn_is_best_the_ends_decide() {
        let at =
            |x: f64, y: f64, p: f64, q: f64| Pair { composed: Vec2::new(x, y), drawn: Vec2::new(p, q), weight: 1.0 };
        // Mirrored pairs: whatever one gains by a turn, another loses.
        let mirrored =
            [at(1.0, 0.0, 0.0, 1.0), at(0.0, 1.0, 1.0, 0.0), at(0.0, -1.0, -1.0, 0.0), at(-1.0, 0.0, 0.0, -1.0)];
        let found = align(&mirrored, None);
        assert!(trig::wrap_angle(found.turn - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
}
