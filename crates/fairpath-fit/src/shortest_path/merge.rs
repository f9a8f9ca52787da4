//! Fitting all pieces of a chain at once, their joins exact (section 3.6 of Baran et al. 2010).
//!
//! The paper hands this to a general solver. Seen rightly it is an optimal control problem: the state is the pose at which a
//! piece begins, the controls are the piece's own freedoms (length, curvature at the end, and at a weaker join also curvature or
//! heading at its start), and the piece's end is the next state. So each Gauss–Newton step is a Riccati recursion, backward for the
//! feedback law and forward for the new chain, at a cost linear in the number of pieces; and since the forward pass chains the pieces
//! by their own ends, every iterate has exact joins whatever the tolerance of the solver. The first pass starts from pieces that
//! do not meet: the feedback law steers the chain along them.
//!
//! A closed chain adds four equations, that the last end is the first start. They are carried through the recursion with
//! the first state and their multipliers as parameters.

use super::chain::{Chain, HEADING, KAPPA0, KAPPA1, LENGTH, Measured, Piece, Q, end, end_with_jacobian};
use crate::linear::{cholesky, solve};
use fairpath_curve::{Continuity, Kind};
use std::f64::consts::TAU;

/// Parameters carried through a closed chain: the first state and the multipliers of closure.
const EXTRA: usize = 8;
/// State and parameters.
const Z: usize = 4 + EXTRA;
/// Everything that a stage sees.
const M: usize = Q + EXTRA;

/// Shortest length of a piece, px.
const MIN_LENGTH: f64 = 1.0;
/// Largest curvature, radians per px.
pub(crate) const MAX_CURVATURE: f64 = 1.0;

/// How a heading and a curvature gap compare to one in position, px and px².
const GAP_SCALE: [f64; 4] = [1.0, 1.0, 20.0, 200.0];

/// Weight of the square of an open gap, px.
const GAP_STIFFNESS: f64 = 30.0;

/// Gaps that one full step closes anyway, px: while they are smaller they do not hold up the descent.
const SMALL_GAP: f64 = 0.05;

/// Damping to begin with, relative to the energy: for pieces that meet already, and for those that must first be brought together.
const JOINED: f64 = 1e-2;
const APART: f64 = 0.2;

/// By how much, relatively, a step may raise the energy, since closing a small gap may cost a little.
const SLACK: f64 = 1e-4;

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    pub(crate) rounds: usize,
    /// Relative decrease of the energy that is not worth another round.
    pub(crate) tolerance: f64,
}

/// The feedback law of one stage.
#[derive(Clone, Copy)]
struct Law {
    /// Change of each control, and its response to changes of state and parameters.
    feed: [f64; Q],
    gain: [[f64; Z]; Q],
    /// Slope of the cost by each control after that, and its response: tells when a held control may be let go.
    slope: [f64; Q],
    slope_gain: [[f64; Z]; Q],
}

/// Which controls of a piece are held at their bounds.
type Held = [bool; Q];

/// Where each parameter of a piece comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Role {
    State,
    Control,
    /// Zero or equal to another.
    Fixed,
}

/// Quadratic model `½ zᵀ h z + gᵀ z` of the cost to go.
#[derive(Clone, Copy)]
struct Value {
    h: [[f64; Z]; Z],
    g: [f64; Z],
}

/// Fits the chain; nothing if it did not come to a finite end with exact joins.
pub(crate) fn merge(chain: &mut Chain, effort: Effort) -> Option<Measured> {
    unwrap_headings(chain);
    let closure = Closure::of(chain);
    let mut held: Vec<Held> = vec![[false; Q]; chain.pieces.len()];
    let mut now = chain.measure();
    let mut misfit = gaps(chain) + closure.misfit(&chain.pieces);
    // Damping relative to the energy.
    let mut relative = if misfit < SMALL_GAP { JOINED } else { APART };
    let mut replans = 0;
    for _ in 0..effort.rounds {
        let Some(plan) = backward(chain, &now, relative * (now.energy + 1.0), &closure, &held) else {
            relative *= 100.0;
            if relative > 1e9 {
                return None;
            }
            continue;
        };
        // An exact penalty must outweigh what a gap can gain.
        let price = 2.0 * plan.pull;
        let merit = 0.5 * now.energy + price * (misfit - SMALL_GAP).max(0.0);
        let old = chain.pieces.clone();
        let mut step = 1.0;
        let mut gain = None;
        let mut wanted = None;
        for _ in 0..4 {
            let next_held = forward(chain, &old, &plan, step, &held);
            let next = chain.measure();
            let next_misfit = gaps(chain) + closure.misfit(&chain.pieces);
            let next_merit = 0.5 * next.energy + price * (next_misfit - SMALL_GAP).max(0.0);
            if next_merit <= merit * (1.0 + SLACK) {
                gain = Some((merit - next_merit).abs() / (next_merit + 1e-6));
                (now, misfit, held) = (next, next_misfit, next_held);
                break;
            }
            // A full step that ran into bounds is planned anew with those controls held.
            if step == 1.0 && next_held != held && replans < 3 {
                wanted = Some(next_held);
                break;
            }
            step *= 0.3;
        }
        if let Some(next_held) = wanted {
            chain.pieces = old;
            held = next_held;
            replans += 1;
            continue;
        }
        replans = 0;
        let Some(gain) = gain else {
            chain.pieces = old;
            relative = (relative * 100.0).max(1e-3);
            if relative > 1e7 {
                break;
            }
            continue;
        };
        relative = if step == 1.0 { (relative * 0.1).max(1e-9) } else { relative * 3.0 };
        if gain < effort.tolerance && misfit < 1e-3 {
            break;
        }
    }
    if join_exactly(chain, &closure, &mut held)? {
        now = chain.measure();
    }
    now.energy.is_finite().then_some(now)
}

/// Relative damping while only the joins are to be closed: so strong that nothing else moves.
const JOINING: f64 = 1e3;

/// Full steps until all joins hold to rounding; whether any was needed.
fn join_exactly(chain: &mut Chain, closure: &Closure, held: &mut [Held]) -> Option<bool> {
    for round in 0..10 {
        if gaps(chain) == 0.0 && closure.misfit(&chain.pieces) < 1e-10 {
            return Some(round > 0);
        }
        let mut now = chain.measure();
        for normal in &mut now.normals {
            normal.gradient = [0.0; Q];
        }
        let plan = backward(chain, &now, JOINING * (now.energy + 1.0), closure, held)?;
        let old = chain.pieces.clone();
        let next = forward(chain, &old, &plan, 1.0, held);
        // What is held stays held: here only the joins matter.
        for (h, n) in held.iter_mut().zip(next) {
            for (h, n) in h.iter_mut().zip(n) {
                *h |= n;
            }
        }
    }
    (gaps(chain) == 0.0 && closure.misfit(&chain.pieces) < 1e-9).then_some(true)
}

/// What is open at the joins between neighbours: the weighted sum of magnitudes.
fn gaps(chain: &Chain) -> f64 {
    (1..chain.pieces.len())
        .map(|k| gap_before(chain, &chain.pieces, k).iter().zip(GAP_SCALE).map(|(g, w)| g.abs() * w).sum::<f64>())
        .sum()
}

/// What is open between piece `k` and the one before, in the parameters that it takes over.
fn gap_before(chain: &Chain, pieces: &[Piece], k: usize) -> [f64; 4] {
    let taken = roles(chain, k);
    let arrived = end(&pieces[k - 1].q);
    std::array::from_fn(|i| if taken[i] == Role::State { arrived[i] - pieces[k].q[i] } else { 0.0 })
}

/// Makes the headings of pieces that join smoothly run on without jumps of whole turns.
fn unwrap_headings(chain: &mut Chain) {
    for k in 1..chain.pieces.len() {
        let arriving = end(&chain.pieces[k - 1].q)[HEADING];
        let h = &mut chain.pieces[k].q[HEADING];
        *h += TAU * ((arriving - *h) / TAU + 0.5).floor();
    }
}

/// The equations that close a chain.
struct Closure {
    /// How many of x, y, heading and curvature must agree.
    count: usize,
    /// What the last heading exceeds the first by: whole turns.
    turns: f64,
}

impl Closure {
    fn of(chain: &Chain) -> Self {
        if !chain.closed {
            return Self { count: 0, turns: 0.0 };
        }
        let n = chain.pieces.len();
        let straight = chain.pieces[0].kind == Kind::Line || chain.pieces[n - 1].kind == Kind::Line;
        let count = match chain.joins[n - 1] {
            Continuity::G0 => 2,
            Continuity::G1 => 3,
            Continuity::G2 | Continuity::G3 => 4 - usize::from(straight),
        };
        let turned = end(&chain.pieces[n - 1].q)[HEADING] - chain.pieces[0].q[HEADING];
        Self { count, turns: TAU * (turned / TAU + 0.5).floor() }
    }

    fn gap(&self, pieces: &[Piece]) -> [f64; 4] {
        let last = end(&pieces[pieces.len() - 1].q);
        let mut gap = [0.0; 4];
        for i in 0..self.count {
            gap[i] = last[i] - pieces[0].q[i];
        }
        if self.count > HEADING {
            gap[HEADING] -= self.turns;
        }
        gap
    }

    /// Weighted sum of the magnitudes of what is open.
    fn misfit(&self, pieces: &[Piece]) -> f64 {
        if self.count == 0 {
            return 0.0;
        }
        self.gap(pieces).iter().zip(GAP_SCALE).map(|(g, w)| g.abs() * w).sum()
    }
}

/// Where the parameters of piece `k` come from.
fn roles(chain: &Chain, k: usize) -> [Role; Q] {
    let n = chain.pieces.len();
    let piece = &chain.pieces[k];
    let before = if k > 0 { Some(chain.joins[k - 1]) } else { None };
    let after = chain.joins.get(k).copied();
    let line = piece.kind == Kind::Line;
    let mut r = [Role::State; Q];
    if before == Some(Continuity::G0) {
        r[HEADING] = Role::Control;
    }
    let seam_with_line =
        k == 0 && chain.closed && chain.joins[n - 1] >= Continuity::G2 && chain.pieces[n - 1].kind == Kind::Line;
    r[KAPPA0] = if line || seam_with_line {
        Role::Fixed
    } else if before.is_some_and(|j| j < Continuity::G2) {
        Role::Control
    } else {
        Role::State
    };
    let flat_after = after.is_some_and(|j| j >= Continuity::G2) && chain.pieces[(k + 1) % n].kind == Kind::Line;
    r[KAPPA1] = if piece.kind == Kind::Clothoid && !flat_after { Role::Control } else { Role::Fixed };
    r[LENGTH] = Role::Control;
    r
}

/// Least and largest value of a control.
fn bounds(piece: &Piece, after: Option<&Piece>, joined: bool, index: usize) -> (f64, f64) {
    match index {
        LENGTH => (MIN_LENGTH, piece.longest),
        KAPPA0 | KAPPA1 => {
            let mut range = (-MAX_CURVATURE, MAX_CURVATURE);
            let mut keep = |sign: i8| match sign {
                1 => range.0 = 0.0,
                -1 => range.1 = 0.0,
                _ => {}
            };
            if index == KAPPA0 {
                keep(piece.sign[0]);
                if piece.kind == Kind::Arc {
                    keep(piece.sign[1]);
                }
            } else {
                keep(piece.sign[1]);
                if let (true, Some(next)) = (joined, after) {
                    keep(next.sign[0]);
                }
            }
            range
        }
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

fn control_bounds(chain: &Chain, k: usize, index: usize) -> (f64, f64) {
    let n = chain.pieces.len();
    let joined = chain.joins.get(k).is_some_and(|j| *j >= Continuity::G2);
    bounds(&chain.pieces[k], Some(&chain.pieces[(k + 1) % n]), joined, index)
}

/// What a backward pass decides.
struct Plan {
    laws: Vec<Law>,
    /// Change of the first state.
    first: [f64; 4],
    /// Multipliers of closure.
    multipliers: [f64; 4],
    /// The largest slope of the cost by a gap, in units of [`GAP_SCALE`].
    pull: f64,
}

/// One Riccati recursion from the last piece to the first.
fn backward(chain: &Chain, now: &Measured, damping: f64, closure: &Closure, held: &[Held]) -> Option<Plan> {
    let n = chain.pieces.len();
    let extra = if closure.count > 0 { EXTRA } else { 0 };
    let mut laws = vec![Law { feed: [0.0; Q], gain: [[0.0; Z]; Q], slope: [0.0; Q], slope_gain: [[0.0; Z]; Q] }; n];
    let mut value = Value { h: [[0.0; Z]; Z], g: [0.0; Z] };
    if closure.count > 0 {
        // The Lagrangian of closure: multiplier times (last state − first state − turns).
        let gap = closure.gap(&chain.pieces);
        for i in 0..closure.count {
            let l = 8 + i;
            value.h[i][l] = 1.0;
            value.h[l][i] = 1.0;
            value.h[4 + i][l] = -1.0;
            value.h[l][4 + i] = -1.0;
            value.g[l] = gap[i];
            // A square of the gap is added. It vanishes with the gap and so changes no solution, but without it nothing would
            // resist the controls near the end, and the recursion would be ill-conditioned.
            let w = GAP_STIFFNESS * GAP_SCALE[i] * GAP_SCALE[i];
            value.h[i][i] += w;
            value.h[4 + i][4 + i] += w;
            value.h[i][4 + i] -= w;
            value.h[4 + i][i] -= w;
            value.g[i] += w * gap[i];
            value.g[4 + i] -= w * gap[i];
        }
    }
    let mut pull = 0.0_f64;
    for k in (0..n).rev() {
        let q = &chain.pieces[k].q;
        let (arrived, f) = end_with_jacobian(q);
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
            for i in 0..4 + extra {
                value.g[i] += shift[i];
            }
            for i in 0..4 {
                if taken[i] == Role::State {
                    pull = pull.max(value.g[i].abs() / GAP_SCALE[i]);
                }
            }
        }
        let model = stage(&now.normals[k], &f, &value, extra);
        value = eliminate(chain, k, model, damping, extra, &held[k], &mut laws[k])?;
    }
    let (first, multipliers) = first_state(chain, &mut value, damping, closure)?;
    for i in 0..closure.count {
        pull = pull.max(multipliers[i].abs() / GAP_SCALE[i]);
    }
    Some(Plan { laws, first, multipliers, pull })
}

/// The quadratic model of a stage over its parameters and the carried ones.
fn stage(
    normal: &super::chain::PieceNormal,
    f: &[[f64; Q]; 4],
    value: &Value,
    extra: usize,
) -> ([[f64; M]; M], [f64; M]) {
    let mut h = [[0.0; M]; M];
    let mut g = [0.0; M];
    // V F, state rows only.
    let mut vf = [[0.0; Q]; Z];
    for (i, out) in vf.iter_mut().enumerate().take(4 + extra) {
        for (j, v) in out.iter_mut().enumerate() {
            *v = (0..4).map(|a| value.h[i][a] * f[a][j]).sum();
        }
    }
    for i in 0..Q {
        for j in 0..=i {
            let v = normal.hessian[i][j] + (0..4).map(|a| f[a][i] * vf[a][j]).sum::<f64>();
            h[i][j] = v;
            h[j][i] = v;
        }
        g[i] = -normal.gradient[i] + (0..4).map(|a| f[a][i] * value.g[a]).sum::<f64>();
    }
    for i in 0..extra {
        for j in 0..Q {
            h[Q + i][j] = vf[4 + i][j];
            h[j][Q + i] = vf[4 + i][j];
        }
        for j in 0..extra {
            h[Q + i][Q + j] = value.h[4 + i][4 + j];
        }
        g[Q + i] = value.g[4 + i];
    }
    (h, g)
}

/// Minimises a stage over its controls within their bounds and gives the cost to go from its state.
fn eliminate(
    chain: &Chain,
    k: usize,
    (mut h, mut g): ([[f64; M]; M], [f64; M]),
    damping: f64,
    extra: usize,
    held: &Held,
    law: &mut Law,
) -> Option<Value> {
    let m = Q + extra;
    let piece = &chain.pieces[k];
    let roles = roles(chain, k);
    if piece.kind == Kind::Arc {
        // Both curvatures are one.
        for i in 0..m {
            h[KAPPA0][i] += h[KAPPA1][i];
        }
        for i in 0..m {
            h[i][KAPPA0] += h[i][KAPPA1];
        }
        g[KAPPA0] += g[KAPPA1];
    }
    let free: Vec<usize> = (0..Q).filter(|&i| roles[i] == Role::Control && !held[i]).collect();
    // Damping is part of the model, not only of the step: closure then holds in every damped step as well.
    for &i in &free {
        let reach = reach(piece, i);
        h[i][i] += damping / (reach * reach) + FLOOR[i];
    }
    let mut factor = [[0.0; Q]; Q];
    for (a, &i) in free.iter().enumerate() {
        for (b, &j) in free.iter().enumerate().take(a + 1) {
            factor[a][b] = h[i][j];
        }
    }
    if !cholesky(&mut factor, free.len(), 1e-13) {
        return None;
    }
    let mut feed = [0.0; Q];
    let mut b = [0.0; Q];
    for (a, &i) in free.iter().enumerate() {
        b[a] = -g[i];
    }
    solve(&factor, free.len(), &mut b);
    for (a, &i) in free.iter().enumerate() {
        feed[i] = b[a];
    }
    // Response of the free controls to state and parameters.
    let inputs = |c: usize| if c < 4 { c } else { Q + c - 4 };
    let is_state = |c: usize| c >= 4 || roles[c] == Role::State;
    let nz = 4 + extra;
    let mut gain = [[0.0; Z]; Q];
    for c in 0..nz {
        if !is_state(c) {
            continue;
        }
        let mut b = [0.0; Q];
        for (a, &i) in free.iter().enumerate() {
            b[a] = -h[i][inputs(c)];
        }
        solve(&factor, free.len(), &mut b);
        for (a, &i) in free.iter().enumerate() {
            gain[i][c] = b[a];
        }
    }
    let mut value = Value { h: [[0.0; Z]; Z], g: [0.0; Z] };
    // h·feed and h·gain over the controls, used for both the gradient and the Hessian of the cost to go.
    let controls: Vec<usize> = (0..Q).filter(|&i| roles[i] == Role::Control).collect();
    let mut hg = [[0.0; Z]; Q];
    let mut hf = [0.0; Q];
    for &i in &controls {
        hf[i] = g[i] + controls.iter().map(|&j| h[i][j] * feed[j]).sum::<f64>();
        for c in 0..nz {
            let direct = if is_state(c) { h[i][inputs(c)] } else { 0.0 };
            hg[i][c] = direct + controls.iter().map(|&j| h[i][j] * gain[j][c]).sum::<f64>();
        }
    }
    for c in 0..nz {
        if !is_state(c) {
            continue;
        }
        let x = inputs(c);
        value.g[c] = g[x] + controls.iter().map(|&i| h[x][i] * feed[i] + gain[i][c] * hf[i]).sum::<f64>();
        for d in 0..=c {
            if !is_state(d) {
                continue;
            }
            let v =
                h[x][inputs(d)] + controls.iter().map(|&i| h[x][i] * gain[i][d] + gain[i][c] * hg[i][d]).sum::<f64>();
            value.h[c][d] = v;
            value.h[d][c] = v;
        }
    }
    *law = Law { feed, gain, slope: hf, slope_gain: hg };
    Some(value)
}

/// Energy that letting go of a held control must promise, px³.
const WORTH_LETTING_GO: f64 = 1e-2;

/// How far a parameter may change in one round without leaving what its derivatives can foresee.
fn reach(piece: &Piece, index: usize) -> f64 {
    let length = piece.q[LENGTH];
    match index {
        LENGTH => 0.2 * length + 1.0,
        KAPPA0 | KAPPA1 => 0.3 / length + 0.1 * piece.q[index].abs(),
        HEADING => 0.3,
        _ => 3.0,
    }
}

/// Stiffness that every control has by itself, against pieces that no datum holds.
const FLOOR: [f64; Q] = [1e-6, 1e-6, 1e-3, 1e-1, 1e-1, 1e-6];

/// The best change of the first state, and the multipliers.
fn first_state(chain: &Chain, value: &mut Value, damping: f64, closure: &Closure) -> Option<([f64; 4], [f64; 4])> {
    let count = closure.count;
    if count > 0 {
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
                b[l] = value.g[8 + l] + (0..4).map(|i| value.h[8 + l][i] * (still[i] + held[i])).sum::<f64>();
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
        return Some((z, multipliers));
    }
}

fn first_bounds(chain: &Chain) -> (f64, f64) {
    bounds(&chain.pieces[0], None, false, KAPPA0)
}

/// The chain that the plan leads to from the pieces `old`, and which controls it found at their bounds. A full step closes all
/// gaps; a shorter one leaves its share of them open.
fn forward(chain: &mut Chain, old: &[Piece], plan: &Plan, step: f64, held: &[Held]) -> Vec<Held> {
    let Plan { laws, first, multipliers, .. } = plan;
    let mut at_bound: Vec<Held> = vec![[false; Q]; old.len()];
    let mut state = [0.0; 4];
    for i in 0..4 {
        state[i] = old[0].q[i] + step * first[i];
    }
    let (low, high) = first_bounds(chain);
    state[KAPPA0] = state[KAPPA0].clamp(low, high);
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
            input[4 + i] = step * first[i];
            input[8 + i] = step * multipliers[i];
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
        state = end(&q);
        if step < 1.0 && k + 1 < old.len() {
            let gap = gap_before(chain, old, k + 1);
            for i in 0..4 {
                state[i] -= (1.0 - step) * gap[i];
            }
        }
    }
    at_bound
}
