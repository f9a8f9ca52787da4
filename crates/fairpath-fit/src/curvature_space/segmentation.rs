//! Which stretches of curvature space are linear (McCrae and Singh 2008, section 4.2): places in, breaks out.
//!
//! The paper fills a matrix of all pairs of points by equation 7, in cubic time. What its recursion minimises is a sum over the pieces between
//! successive breaks, so that the best way to each place from any place before it finds the same minimum.
//!
//! Most pairs are never looked at. The error of a line of least squares, when its residuals have signs, also tells how large the sum of
//! magnitudes must be for *any* line ([`Error::least`]); that bound holds for every longer piece as well, and bounds of pieces side by side add
//! up. So the search for the best last piece ends where no longer one can be better: after about the length of two pieces, and the time
//! grows with the number of places. Where all of a stroke is one line it grows with its square.

use super::estimate::Place;

/// Indices of the places at which the linear pieces begin and end, the first and the last included, such that the errors of the pieces
/// (equation 8) and `piece_cost` for each have the least sum, which is given as well, radians.
///
/// One place alone is its own begin and end.
pub(crate) fn breaks(places: &[Place], piece_cost: f64) -> (Vec<usize>, f64) {
    let n = places.len();
    let sums = Sums::new(places);
    // The least cost of pieces up to each place, and where the last of them begins.
    let mut best = vec![f64::INFINITY; n];
    let mut before = vec![0; n];
    // A bound from below for the cost up to any place before, and of a piece that runs from there to each place or beyond it, as far as
    // that and without its price.
    let mut under_way = vec![0.0; n];
    best[0] = 0.0;
    for b in 1..n {
        let mut least = 0.0_f64;
        let mut looked_at = 1;
        under_way[b] = f64::INFINITY;
        for a in (0..b).rev() {
            if under_way[a] + least + piece_cost >= best[b] {
                under_way[b] = under_way[b].min(under_way[a] + least);
                break;
            }
            let room = best[b] - best[a] - piece_cost;
            if room > least || (b - a) as f64 > LOOK_AGAIN * looked_at as f64 {
                let error = Error::of(places, &sums, a, b);
                least = least.max(error.least);
                looked_at = b - a;
                if error.sum < room {
                    best[b] = best[a] + piece_cost + error.sum;
                    before[b] = a;
                }
            }
            under_way[b] = under_way[b].min(best[a] + least);
        }
        under_way[b] = under_way[b].min(best[b]);
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

/// A piece that is longer by this factor than the last that was looked at is looked at for the sake of its bound.
const LOOK_AGAIN: f64 = 1.2;

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
        self.through(a, b, self.before[b + 1][3] - self.before[a][3], self.before[b + 1][4] - self.before[a][4])
    }

    /// As [`Sums::line`], of other values whose sum and first moment are given.
    fn through(&self, a: usize, b: usize, k: f64, sk: f64) -> (f64, f64) {
        let [w, s, ss] = std::array::from_fn(|i| self.before[b + 1][i] - self.before[a][i]);
        let spread = ss - s * s / w;
        let slope = if spread > 0.0 { (sk - s * k / w) / spread } else { 0.0 };
        ((k - slope * s) / w, slope)
    }
}

/// Sums side by side.
const LANES: usize = 4;

/// What the places of a piece are away from lines.
struct Error {
    /// Equation 8, each place counted by the length that it stands for: the sum of magnitudes from the line of least squares.
    sum: f64,
    /// A bound from below of that sum for any line through these places, or through more.
    least: f64,
}

impl Error {
    /// By duality: weights between −w and w for the places, which give nothing for any line, give for the places no more than the least sum
    /// of magnitudes. The signs of the residuals, less their own line of least squares and scaled down, are such weights, and what they give
    /// is the sum over the scale.
    fn of(places: &[Place], sums: &Sums, a: usize, b: usize) -> Self {
        // A line passes through two places.
        if b == a + 1 {
            return Self { sum: 0.0, least: 0.0 };
        }
        let (value, slope) = sums.line(a, b);
        // Several sums side by side, which the processor need not wait for in turn.
        let mut lanes = [[0.0; 3]; LANES];
        let mut add = |lane: usize, p: &Place| {
            let s = p.s - sums.origin;
            let residual = value + slope * s - p.kappa;
            let sign = p.weight.copysign(residual);
            let [sum, signs, moments] = &mut lanes[lane];
            *sum += p.weight * residual.abs();
            *signs += sign;
            *moments += sign * s;
        };
        let mut chunks = places[a..=b].chunks_exact(LANES);
        for chunk in &mut chunks {
            for (lane, p) in chunk.iter().enumerate() {
                add(lane, p);
            }
        }
        for p in chunks.remainder() {
            add(0, p);
        }
        let [sum, signs, moments] = std::array::from_fn(|i| lanes.iter().map(|l| l[i]).sum::<f64>());
        let (offset, tilt) = sums.through(a, b, signs, moments);
        let at = |p: &Place| (offset + tilt * (p.s - sums.origin)).abs();
        let scale = 1.0 + at(&places[a]).max(at(&places[b]));
        // A little less for rounding.
        Self { sum, least: sum * (1.0 - 1e-9) / scale - 1e-12 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cost_of(places: &[Place], breaks: &[usize], piece_cost: f64) -> f64 {
        let sums = Sums::new(places);
        breaks.windows(2).map(|b| piece_cost + Error::of(places, &sums, b[0], b[1]).sum).sum()
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
