//! One step of the merge: the best change of a chain in the quadratic model of its distances, by a Riccati recursion (after section 3.6
//! of Baran et al. 2010).
//!
//! The state is the pose at which a piece begins, the controls are the piece's own freedoms (length, curvature at the end, and at a
//! weaker join also curvature or heading at its start), and the piece's end is the next state: backward for the feedback law, forward
//! for the new chain, at a cost linear in the number of pieces.
//!
//! A closed chain adds four equations, that the last end is the first start; one whose end is held adds as many, that it is there. They are
//! carried through the recursion with the first state and their multipliers as parameters. A held start is no unknown at all.

use super::chain::{Chain, KAPPA0, KAPPA1, Measured, Piece, PieceNormal, Q, end, end_with_jacobian};
use super::closing::Closure;
use super::controls::{Role, control_bounds, first_bounds, reach, roles};
use crate::linear::{cholesky, solve, solve_lower, solve_upper};
use fairpath_curve::Kind;

/// Numbers in a state.
pub(super) const STATE: usize = 4;
/// State and parameters of a chain whose end is free, and of one that is closed or held there; the latter carries the first state and the
/// multipliers of closure.
pub(crate) const OPEN: usize = STATE;
pub(crate) const CLOSED: usize = STATE + 8;

/// How a heading and a curvature gap compare to one in position, px and px².
const GAP_SCALE: [f64; 4] = [1.0, 1.0, 20.0, 200.0];

/// Weight of the square of an open gap, px.
const GAP_STIFFNESS: f64 = 30.0;

/// The feedback law of one stage.
#[derive(Clone, Copy)]
struct Law<const Z: usize> {
    /// Change of each control, and its response to changes of state and parameters.
    feed: [f64; Q],
    gain: [[f64; Z]; Q],
    /// Slope of the cost by each held control after that, and its response: tells when a held control may be let go.
    slope: [f64; Q],
    slope_gain: [[f64; Z]; Q],
}

/// Which controls of a piece are held at their bounds.
pub(crate) type Held = [bool; Q];

/// Quadratic model `½ zᵀ h z + gᵀ z` of the cost to go.
#[derive(Clone, Copy)]
struct Value<const Z: usize> {
    h: [[f64; Z]; Z],
    g: [f64; Z],
}

/// What is open between piece `k` and the one before, in the parameters that it takes over.
pub(crate) fn gap_before(chain: &Chain, pieces: &[Piece], k: usize) -> [f64; 4] {
    let taken = roles(chain, k);
    let arrived = end(&pieces[k - 1].q);
    std::array::from_fn(|i| if taken[i] == Role::State { arrived[i] - pieces[k].q[i] } else { 0.0 })
}

/// How large a gap is, px: the weighted sum of magnitudes.
pub(super) fn size(gap: [f64; 4]) -> f64 {
    gap.iter().zip(GAP_SCALE).map(|(g, w)| g.abs() * w).sum()
}

/// How fast something falls at most while gaps grow in [`size`], given its slopes by them.
fn steepest(slopes: [f64; 4]) -> f64 {
    slopes.iter().zip(GAP_SCALE).map(|(slope, w)| slope.abs() / w).fold(0.0, f64::max)
}

/// What a backward pass decides.
pub(crate) struct Plan<const Z: usize> {
    laws: Vec<Law<Z>>,
    /// Cost to go from the start of the chain.
    value: Value<Z>,
    aim: Aim,
    /// The largest slope of the cost by a gap, in units of [`GAP_SCALE`].
    pub(crate) pull: f64,
}

/// What a full step decides before it goes along the chain.
#[derive(Clone, Copy)]
struct Aim {
    /// Change of the first state.
    first: [f64; 4],
    /// Multipliers of closure.
    multipliers: [f64; 4],
}

/// One Riccati recursion from the last piece to the first.
pub(crate) fn backward<const Z: usize>(
    chain: &Chain,
    now: &Measured,
    damping: f64,
    closure: &Closure,
    held: &[Held],
) -> Option<Plan<Z>> {
    let n = chain.pieces.len();
    let mut laws = vec![Law { feed: [0.0; Q], gain: [[0.0; Z]; Q], slope: [0.0; Q], slope_gain: [[0.0; Z]; Q] }; n];
    let mut value = Value { h: [[0.0; Z]; Z], g: [0.0; Z] };
    if closure.count > 0 {
        // The Lagrangian of closure: multiplier times (last state − first or held state − turns).
        let gap = closure.gap(&chain.pieces);
        for i in 0..closure.count {
            let l = 8 + i;
            value.h[i][l] = 1.0;
            value.h[l][i] = 1.0;
            value.g[l] = gap[i];
            // A square of the gap is added. It vanishes with the gap and so changes no solution, but without it nothing would
            // resist the controls near the end, and the recursion would be ill-conditioned.
            let w = GAP_STIFFNESS * GAP_SCALE[i] * GAP_SCALE[i];
            value.h[i][i] += w;
            value.g[i] += w * gap[i];
            if closure.is_held() {
                continue;
            }
            value.h[4 + i][l] = -1.0;
            value.h[l][4 + i] = -1.0;
            value.h[4 + i][4 + i] += w;
            value.h[i][4 + i] -= w;
            value.h[4 + i][i] -= w;
            value.g[4 + i] -= w * gap[i];
        }
    }
    let mut pull = 0.0_f64;
    for k in (0..n).rev() {
        let q = &chain.pieces[k].q;
        // Nothing depends on where an open chain ends.
        let (arrived, f) = if k + 1 < n || closure.count > 0 { end_with_jacobian(q) } else { Default::default() };
        if k + 1 < n {
            // The next piece's own start need not be where this one ends, at first.
            let next = &chain.pieces[k + 1];
            let taken = roles(chain, k + 1);
            let mut gap = [0.0; 4];
            for i in 0..4 {
                if taken[i] == Role::State {
                    gap[i] = arrived[i] - next.q[i];
                }
            }
            let shift: [f64; Z] = std::array::from_fn(|i| (0..4).map(|j| value.h[i][j] * gap[j]).sum());
            for i in 0..Z {
                value.g[i] += shift[i];
            }
            let slopes = std::array::from_fn(|i| if taken[i] == Role::State { value.g[i] } else { 0.0 });
            pull = pull.max(steepest(slopes));
        }
        value = Stage::new(&now.normals[k], &f, &value).eliminate(chain, k, damping, &held[k], &value, &mut laws[k])?;
    }
    reduce_to_first(chain, &mut value, damping, closure);
    let aim = best_aim(chain, &value, closure, [0.0; 4])?;
    pull = pull.max(steepest(aim.multipliers));
    Some(Plan { laws, value, aim, pull })
}

/// The quadratic model of a stage: over the piece's own parameters, and how these are coupled with what is carried.
struct Stage<const Z: usize> {
    h: [[f64; Q]; Q],
    g: [f64; Q],
    /// By carried parameter; the first four rows, which stand for the next state, are not used.
    coupling: [[f64; Q]; Z],
}

impl<const Z: usize> Stage<Z> {
    fn new(normal: &PieceNormal, f: &[[f64; Q]; STATE], value: &Value<Z>) -> Self {
        // V F, state rows only.
        let mut coupling = [[0.0; Q]; Z];
        for (i, out) in coupling.iter_mut().enumerate() {
            for (j, v) in out.iter_mut().enumerate() {
                *v = (0..STATE).map(|a| value.h[i][a] * f[a][j]).sum();
            }
        }
        let (mut h, mut g) = ([[0.0; Q]; Q], [0.0; Q]);
        for i in 0..Q {
            for j in 0..=i {
                let v = normal.hessian[i][j] + (0..STATE).map(|a| f[a][i] * coupling[a][j]).sum::<f64>();
                h[i][j] = v;
                h[j][i] = v;
            }
            g[i] = -normal.gradient[i] + (0..STATE).map(|a| f[a][i] * value.g[a]).sum::<f64>();
        }
        Self { h, g, coupling }
    }

    /// Makes both curvatures one.
    fn bend_evenly(&mut self) {
        for i in 0..Q {
            self.h[KAPPA0][i] += self.h[KAPPA1][i];
        }
        for row in self.h.iter_mut().chain(&mut self.coupling) {
            row[KAPPA0] += row[KAPPA1];
        }
        self.g[KAPPA0] += self.g[KAPPA1];
    }

    /// Minimises over the controls within their bounds and gives the cost to go from the stage's state; `after` is that from the
    /// next.
    fn eliminate(
        mut self,
        chain: &Chain,
        k: usize,
        damping: f64,
        held: &Held,
        after: &Value<Z>,
        law: &mut Law<Z>,
    ) -> Option<Value<Z>> {
        let piece = &chain.pieces[k];
        let roles = roles(chain, k);
        if piece.kind == Kind::Arc {
            self.bend_evenly();
        }
        let (h, g) = (&mut self.h, &self.g);
        let mut free = [0; Q];
        let mut count = 0;
        for i in 0..Q {
            if roles[i] == Role::Control && !held[i] {
                // Damping is part of the model, not only of the step: closure then holds in every damped step as well.
                let reach = reach(piece, i);
                h[i][i] += damping / (reach * reach) + FLOOR[i];
                free[count] = i;
                count += 1;
            }
        }
        let free = &free[..count];
        let mut factor = [[0.0; Q]; Q];
        for (a, &i) in free.iter().enumerate() {
            for (b, &j) in free.iter().enumerate().take(a + 1) {
                factor[a][b] = h[i][j];
            }
        }
        if !cholesky(&mut factor, count, 1e-13) {
            return None;
        }
        // Half solved, the slopes by the controls give the cost to go as sums of squares; solved, the feedback.
        let half = |slopes: &dyn Fn(usize) -> f64| {
            let mut b = [0.0; Q];
            for (a, &i) in free.iter().enumerate() {
                b[a] = slopes(i);
            }
            solve_lower(&factor, count, &mut b);
            b
        };
        let dot = |a: &[f64; Q], b: &[f64; Q]| (0..count).map(|i| a[i] * b[i]).sum::<f64>();
        let is_state = |c: usize| c >= STATE || roles[c] == Role::State;
        let own = half(&|i| g[i]);
        let mut by_input = [[0.0; Q]; Z];
        for c in (0..Z).filter(|&c| is_state(c)) {
            if c < STATE {
                self.coupling[c] = h[c];
            }
            by_input[c] = half(&|i| self.coupling[c][i]);
        }
        let mut value = Value { h: [[0.0; Z]; Z], g: [0.0; Z] };
        for c in (0..Z).filter(|&c| is_state(c)) {
            value.g[c] = if c < STATE { g[c] } else { after.g[c] } - dot(&by_input[c], &own);
            for d in (0..=c).filter(|&d| is_state(d)) {
                let direct = if d < STATE { self.coupling[c][d] } else { after.h[c][d] };
                let v = direct - dot(&by_input[c], &by_input[d]);
                value.h[c][d] = v;
                value.h[d][c] = v;
            }
        }
        let respond = |mut b: [f64; Q]| {
            solve_upper(&factor, count, &mut b);
            b
        };
        let feed = respond(own);
        for (a, &i) in free.iter().enumerate() {
            law.feed[i] = -feed[a];
        }
        for c in (0..Z).filter(|&c| is_state(c)) {
            let gain = respond(by_input[c]);
            for (a, &i) in free.iter().enumerate() {
                law.gain[i][c] = -gain[a];
            }
        }
        for i in (0..Q).filter(|&i| roles[i] == Role::Control && held[i]) {
            law.slope[i] = g[i] + free.iter().map(|&j| h[i][j] * law.feed[j]).sum::<f64>();
            for c in (0..Z).filter(|&c| is_state(c)) {
                law.slope_gain[i][c] =
                    self.coupling[c][i] + free.iter().map(|&j| h[i][j] * law.gain[j][c]).sum::<f64>();
            }
        }
        Some(value)
    }
}

/// Energy that letting go of a held control must promise, px³.
const WORTH_LETTING_GO: f64 = 1e-2;

/// Stiffness that every control has by itself, against pieces that no datum holds.
const FLOOR: [f64; Q] = [1e-6, 1e-6, 1e-3, 1e-1, 1e-1, 1e-6];

/// Makes the cost to go one of the first state alone, and of the multipliers.
fn reduce_to_first<const Z: usize>(chain: &Chain, value: &mut Value<Z>, damping: f64, closure: &Closure) {
    if closure.count > 0 {
        // The first state is also what the last must meet.
        for i in 0..4 {
            for c in 0..Z {
                value.h[i][c] += value.h[4 + i][c];
            }
        }
        for i in 0..4 {
            for c in 0..Z {
                value.h[c][i] += value.h[c][4 + i];
            }
            value.g[i] += value.g[4 + i];
        }
    }
    for i in 0..4 {
        let reach = reach(&chain.pieces[0], i);
        value.h[i][i] += damping / (reach * reach) + FLOOR[i];
    }
}

/// The best change of the first state and the multipliers where closure has to make up for `more` than the model knows.
fn best_aim<const Z: usize>(chain: &Chain, value: &Value<Z>, closure: &Closure, more: [f64; 4]) -> Option<Aim> {
    let count = closure.count;
    let roles = roles(chain, 0);
    let mut free: Vec<usize> = (0..4).filter(|&i| roles[i] == Role::State).collect();
    let mut held = [0.0; 4];
    loop {
        let mut factor = [[0.0; 4]; 4];
        for (a, &i) in free.iter().enumerate() {
            for (b, &j) in free.iter().enumerate().take(a + 1) {
                factor[a][b] = value.h[i][j];
            }
        }
        if !cholesky(&mut factor, free.len(), 1e-13) {
            return None;
        }
        let respond = |column: &dyn Fn(usize) -> f64| {
            let mut b = [0.0; 4];
            for (a, &i) in free.iter().enumerate() {
                b[a] = column(i);
            }
            solve(&factor, free.len(), &mut b);
            let mut out = [0.0; 4];
            for (a, &i) in free.iter().enumerate() {
                out[i] = b[a];
            }
            out
        };
        let pull = |i: usize| -value.g[i] - (0..4).map(|j| value.h[i][j] * held[j]).sum::<f64>();
        let still = respond(&pull);
        let mut multipliers = [0.0; 4];
        let mut by_multiplier = [[0.0; 4]; 4];
        if count > 0 {
            for (l, out) in by_multiplier.iter_mut().enumerate().take(count) {
                *out = respond(&|i| -value.h[i][8 + l]);
            }
            // Stationarity in the multipliers, negated to be positive definite.
            let mut a = [[0.0; 4]; 4];
            let mut b = [0.0; 4];
            for l in 0..count {
                for m in 0..count {
                    a[l][m] =
                        -value.h[8 + l][8 + m] - (0..4).map(|i| value.h[8 + l][i] * by_multiplier[m][i]).sum::<f64>();
                }
                a[l][l] *= 1.0 + 1e-12;
                b[l] = value.g[8 + l] + more[l] + (0..4).map(|i| value.h[8 + l][i] * (still[i] + held[i])).sum::<f64>();
            }
            if !cholesky(&mut a, count, 1e-14) {
                return None;
            }
            solve(&a, count, &mut b);
            multipliers = b;
        }
        let mut z = [0.0; 4];
        for i in 0..4 {
            z[i] = held[i] + still[i] + (0..count).map(|l| by_multiplier[l][i] * multipliers[l]).sum::<f64>();
        }
        if z.iter().chain(&multipliers).any(|v| !v.is_finite()) {
            return None;
        }
        // The first curvature must keep its sign.
        let (low, high) = first_bounds(chain);
        let kappa = chain.pieces[0].q[KAPPA0] + z[KAPPA0];
        if free.contains(&KAPPA0) && (kappa < low - 1e-12 || kappa > high + 1e-12) {
            free.retain(|&i| i != KAPPA0);
            held[KAPPA0] = kappa.clamp(low, high) - chain.pieces[0].q[KAPPA0];
            continue;
        }
        return Some(Aim { first: z, multipliers });
    }
}

/// Most corrections of a step.
const CORRECTIONS: usize = 6;

/// A step may leave closure open by this, px; and a correction must bring it down by this factor to be worth another.
const CLOSED_ENOUGH: f64 = 1e-7;
const CONTRACTION: f64 = 0.5;

/// Goes a step of the plan from the pieces `old`; which controls are at their bounds then. A full step closes all gaps; a shorter one leaves
/// its share of them open.
///
/// Where the end goes bends away from where the model sees it: over the length of a chain that is far more than a gap may cost, and would forbid all
/// but small steps (Maratos' effect). So the step is aimed anew by what it missed the end by, with the same laws (a second-order correction:
/// Nocedal and Wright, Numerical Optimization, section 18.3, repeated).
pub(crate) fn take_step<const Z: usize>(
    chain: &mut Chain,
    old: &[Piece],
    plan: &Plan<Z>,
    step: f64,
    held: &[Held],
    closure: &Closure,
) -> Vec<Held> {
    let mut at_bound = forward(chain, old, plan, &plan.aim, step, held);
    if closure.count == 0 {
        return at_bound;
    }
    let wanted = closure.gap(old).map(|gap| (1.0 - step) * gap);
    let missed = |chain: &Chain| -> [f64; 4] {
        let gap = closure.gap(&chain.pieces);
        std::array::from_fn(|i| gap[i] - wanted[i])
    };
    let mut more = [0.0; 4];
    let mut miss = missed(chain);
    for _ in 0..CORRECTIONS {
        if size(miss) < CLOSED_ENOUGH {
            break;
        }
        for i in 0..4 {
            more[i] += miss[i] / step;
        }
        let Some(aim) = best_aim(chain, &plan.value, closure, more) else { break };
        let before = chain.pieces.clone();
        let next = forward(chain, old, plan, &aim, step, held);
        let left = missed(chain);
        if size(left) > CONTRACTION * size(miss) || !size(left).is_finite() {
            chain.pieces = before;
            break;
        }
        (at_bound, miss) = (next, left);
    }
    at_bound
}

/// The chain that a step leads to, aimed so, and which controls it found at their bounds.
fn forward<const Z: usize>(
    chain: &mut Chain,
    old: &[Piece],
    plan: &Plan<Z>,
    Aim { first, multipliers }: &Aim,
    step: f64,
    held: &[Held],
) -> Vec<Held> {
    let laws = &plan.laws;
    let mut at_bound: Vec<Held> = vec![[false; Q]; old.len()];
    let mut state = [0.0; 4];
    for i in 0..4 {
        state[i] = old[0].q[i] + step * first[i];
    }
    if chain.held[0].is_none_or(|pin| pin.count <= KAPPA0) {
        let (low, high) = first_bounds(chain);
        state[KAPPA0] = state[KAPPA0].clamp(low, high);
    }
    for k in 0..old.len() {
        let roles = roles(chain, k);
        let law = &laws[k];
        let mut q = old[k].q;
        let mut input = [0.0; Z];
        for i in 0..4 {
            if roles[i] == Role::State {
                input[i] = state[i] - old[k].q[i];
                q[i] = state[i];
            }
        }
        if Z == CLOSED {
            for i in 0..STATE {
                input[STATE + i] = step * first[i];
                input[2 * STATE + i] = step * multipliers[i];
            }
        }
        for i in 0..Q {
            if roles[i] == Role::Control {
                let change = step * law.feed[i] + (0..Z).map(|c| law.gain[i][c] * input[c]).sum::<f64>();
                let (low, high) = control_bounds(chain, k, i);
                let wanted = old[k].q[i] + change;
                q[i] = wanted.clamp(low, high);
                at_bound[k][i] = if held[k][i] {
                    // Let go where the cost falls towards the inside.
                    let slope = law.slope[i] + (0..Z).map(|c| law.slope_gain[i][c] * input[c]).sum::<f64>();
                    let gain = slope * reach(&old[k], i);
                    (q[i] <= low && gain > -WORTH_LETTING_GO) || (q[i] >= high && gain < WORTH_LETTING_GO)
                } else {
                    wanted < low || wanted > high
                };
            }
        }
        match chain.pieces[k].kind {
            Kind::Line => (q[KAPPA0], q[KAPPA1]) = (0.0, 0.0),
            Kind::Arc => q[KAPPA1] = q[KAPPA0],
            Kind::Clothoid => {
                if roles[KAPPA0] == Role::Fixed {
                    q[KAPPA0] = 0.0;
                }
                if roles[KAPPA1] == Role::Fixed {
                    q[KAPPA1] = 0.0;
                }
            }
        }
        chain.pieces[k].q = q;
        if k + 1 < old.len() {
            state = end(&q);
        }
        if step < 1.0 && k + 1 < old.len() {
            let gap = gap_before(chain, old, k + 1);
            for i in 0..4 {
                state[i] -= (1.0 - step) * gap[i];
            }
        }
    }
    at_bound
}

#[cfg(test)]
mod tests {
    use super::super::chain::Pin;
    use super::*;
    use crate::walk::Datum;
    use fairpath_curve::{Continuity, Vec2};

    /// Five clothoids along a straight line, held at both its ends, which shall follow these data.
    fn straight(data: &[Datum]) -> Chain<'_> {
        let piece = |k: i32| Piece {
            kind: Kind::Clothoid,
            q: [60.0 * f64::from(k), 0.0, 0.0, 0.0, 0.0, 60.0],
            sign: [0, 0],
            longest: 300.0,
        };
        let pin = |x: f64| Some(Pin { pose: [x, 0.0, 0.0, 0.0], count: 4 });
        Chain {
            pieces: (0..5).map(piece).collect(),
            joins: vec![Continuity::G2; 4],
            data,
            corners: Vec::new(),
            closed: false,
            end_factor: 1.0,
            short: None,
            max_curvature: 1.0,
            variation: 0.0,
            pins: [None; 2],
            held: [pin(0.0), pin(300.0)],
        }
    }

    #[test]
    fn a_step_is_aimed_anew_until_its_end_is_where_it_is_held() {
        // A bump, which bends the chain far enough that its end leaves the linear model.
        let bump = |x: f64| Vec2::new(x, 20.0 * (std::f64::consts::PI * x / 300.0).sin().powi(2));
        let datum = |i: i32| Datum { point: bump(3.0 * f64::from(i)), s: 3.0 * f64::from(i), weight: 3.0 };
        let data: Vec<Datum> = (0..=100).map(datum).collect();
        let mut chain = straight(&data);
        let closure = Closure::of(&chain);
        let held = vec![[false; Q]; chain.pieces.len()];
        let now = chain.measure();
        let plan = backward::<CLOSED>(&chain, &now, now.energy, &closure, &held).expect("there is a step");
        for step in [1.0, 0.3] {
            let old = straight(&data).pieces;
            forward(&mut chain, &old, &plan, &plan.aim, step, &held);
            let missed = closure.misfit(&chain.pieces);
            take_step(&mut chain, &old, &plan, step, &held, &closure);
            let left = closure.misfit(&chain.pieces);
            assert!(missed > 1e-3 && left < 1e-6, "step {step}: {missed} px, {left} px when aimed anew");
        }
    }
}
