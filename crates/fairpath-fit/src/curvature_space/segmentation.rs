//! Which stretches of curvature space are linear (McCrae and Singh 2008, section 4.2): places in, breaks out.
//!
//! The paper fills a matrix of all pairs of points by equation 7, in cubic time. What its recursion minimises is a sum over the pieces between
//! successive breaks, so that the best way to each place from any place before it finds the same minimum.

use super::estimate::Place;

/// Indices of the places at which the linear pieces begin and end, the first and the last included, such that the errors of the pieces
/// (equation 8) and `piece_cost` for each have the least sum, which is given as well, radians.
///
/// One place alone is its own begin and end.
pub(crate) fn breaks(places: &[Place], piece_cost: f64) -> (Vec<usize>, f64) {
    let n = places.len();
    let sums = Sums::new(places);
    let mut best = vec![f64::INFINITY; n];
    let mut before = vec![0; n];
    best[0] = 0.0;
    for b in 1..n {
        for a in (0..b).rev() {
            let room = best[b] - best[a] - piece_cost;
            if room <= 0.0 {
                continue;
            }
            let error = error_below(places, &sums, a, b, room);
            if error < room {
                best[b] = best[a] + piece_cost + error;
                before[b] = a;
            }
        }
    }
    let mut out = vec![n - 1];
    let mut at = n - 1;
    while at > 0 {
        at = before[at];
        out.push(at);
    }
    out.reverse();
    (out, best[n - 1])
}

/// Running sums of the places, about the first so that rounding stays small.
struct Sums {
    /// `Σ w`, `Σ w s`, `Σ w s²`, `Σ w κ`, `Σ w s κ` of all places before.
    before: Vec<[f64; 5]>,
    origin: f64,
}

impl Sums {
    fn new(places: &[Place]) -> Self {
        let origin = places.first().map_or(0.0, |p| p.s);
        let mut sum = [0.0; 5];
        let mut before = vec![sum];
        for p in places {
            let (s, w) = (p.s - origin, p.weight);
            for (sum, v) in sum.iter_mut().zip([1.0, s, s * s, p.kappa, s * p.kappa]) {
                *sum += w * v;
            }
            before.push(sum);
        }
        Self { before, origin }
    }

    /// The line of least squares through the places `a..=b`: its value at the origin and its slope.
    fn line(&self, a: usize, b: usize) -> (f64, f64) {
        let [w, s, ss, k, sk] = std::array::from_fn(|i| self.before[b + 1][i] - self.before[a][i]);
        let spread = ss - s * s / w;
        let slope = if spread > 0.0 { (sk - s * k / w) / spread } else { 0.0 };
        ((k - slope * s) / w, slope)
    }
}

/// Equation 8, each place counted by the length that it stands for; `limit` or more where that is reached before the end.
fn error_below(places: &[Place], sums: &Sums, a: usize, b: usize, limit: f64) -> f64 {
    // A line passes through two places.
    if b == a + 1 {
        return 0.0;
    }
    let (value, slope) = sums.line(a, b);
    let mut sum = 0.0;
    for p in &places[a..=b] {
        sum += p.weight * (value + slope * (p.s - sums.origin) - p.kappa).abs();
        if sum >= limit {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cost_of(places: &[Place], breaks: &[usize], piece_cost: f64) -> f64 {
        let sums = Sums::new(places);
        breaks.windows(2).map(|b| piece_cost + error_below(places, &sums, b[0], b[1], f64::INFINITY)).sum()
    }

    /// Equation 7 as it stands, with lines fitted anew for each pair.
    fn literal(places: &[Place], piece_cost: f64) -> f64 {
        let n = places.len();
        let mut m = vec![vec![0.0_f64; n]; n];
        for span in 1..n {
            for a in 0..n - span {
                let b = a + span;
                let run = &places[a..=b];
                let w: f64 = run.iter().map(|p| p.weight).sum();
                let mean = |f: &dyn Fn(&Place) -> f64| run.iter().map(|p| p.weight * f(p)).sum::<f64>() / w;
                let (s, k) = (mean(&|p| p.s), mean(&|p| p.kappa));
                let slope = mean(&|p| (p.s - s) * (p.kappa - k)) / mean(&|p| (p.s - s) * (p.s - s));
                let error: f64 = run.iter().map(|p| p.weight * (k + slope * (p.s - s) - p.kappa).abs()).sum();
                m[a][b] = (a + 1..b).map(|k| m[a][k] + m[k][b]).fold(error + piece_cost, f64::min);
            }
        }
        m[0][n - 1]
    }

    fn places() -> impl Strategy<Value = Vec<Place>> {
        // Straight runs and repeated values are where ties and cancellation lie.
        let kappa = prop_oneof![Just(0.0), Just(0.01), -0.1..0.1_f64, -1e-9..1e-9_f64];
        prop::collection::vec((0.1..8.0_f64, kappa), 2..=60).prop_map(|steps| {
            let mut s = 1000.0;
            steps
                .into_iter()
                .map(|(step, kappa)| {
                    s += step;
                    Place { s, kappa, weight: step }
                })
                .collect()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn the_breaks_cost_what_the_literal_recursion_finds(places in places(), piece_cost in 1e-3..1.0_f64) {
            let (breaks, cost) = breaks(&places, piece_cost);
            prop_assert_eq!((breaks[0], breaks[breaks.len() - 1]), (0, places.len() - 1));
            let (ours, theirs) = (cost_of(&places, &breaks, piece_cost), literal(&places, piece_cost));
            prop_assert!((ours - cost).abs() < 1e-9 * (1.0 + cost));
            prop_assert!((ours - theirs).abs() < 1e-9 * (1.0 + theirs), "{} {}", ours, theirs);
        }
    }

    #[test]
    fn a_bent_profile_breaks_at_its_bends() {
        let profile = |s: f64| if s < 100.0 { 0.0 } else { (0.001 * (s - 100.0)).min(0.048) };
        let places: Vec<Place> =
            (0..60).map(|i| 4.0 * f64::from(i)).map(|s| Place { s, kappa: profile(s), weight: 4.0 }).collect();
        let found: Vec<f64> = breaks(&places, 0.1).0.into_iter().map(|i| places[i].s).collect();
        assert_eq!(found, [0.0, 100.0, 148.0, 236.0]);
    }
}
