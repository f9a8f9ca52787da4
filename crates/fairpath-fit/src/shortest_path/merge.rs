//! Fitting all pieces of a chain at once, their joins exact (section 3.6 of Baran et al. 2010).
//!
//! The paper hands this to a general solver. Seen rightly it is an optimal control problem, so that each Gauss–Newton step is a
//! recursion along the chain; and since its forward pass chains the pieces by their own ends, every iterate has exact joins
//! whatever the tolerance of the solver. The first pass starts from pieces that do not meet: the feedback law steers the chain along
//! them.

use super::chain::{Chain, HEADING, KAPPA0, KAPPA1, Measured, Q, end};
use super::closing::Closure;
use super::recursion::{CLOSED, Held, OPEN, backward, gap_before, size, take_step};
use fairpath_curve::Kind;
use std::f64::consts::TAU;

/// Gaps that one full step closes anyway, px: while they are smaller they do not hold up the descent.
const SMALL_GAP: f64 = 0.05;

/// Damping to begin with, relative to the energy: for pieces that meet already, and for those that must first be brought together.
const JOINED: f64 = 1e-2;
const APART: f64 = 2.0;

/// How often a full step that runs into bounds is planned anew before it is taken as the bounds cut it.
const REPLANS: usize = 3;

/// By how much, relatively, a step may raise the energy, since closing a small gap may cost a little.
const SLACK: f64 = 1e-4;

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    pub(crate) rounds: usize,
    /// Relative decrease of the energy that is not worth another round.
    pub(crate) tolerance: f64,
}

/// What to do after a round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    GoOn,
    /// The chain is good enough.
    Enough,
    /// It will not become good enough.
    Hopeless,
}

/// Fits the chain; nothing if it did not come to a finite end with exact joins.
pub(crate) fn merge(chain: &mut Chain, effort: Effort) -> Option<Measured> {
    merge_until(chain, effort, |_, _, _| Verdict::GoOn)
}

/// As [`merge`], with a `judge` of the chain and its measurement after each round, who may end it: early, or with nothing.
pub(crate) fn merge_until(
    chain: &mut Chain,
    effort: Effort,
    judge: impl Fn(&Chain, &Measured, usize) -> Verdict,
) -> Option<Measured> {
    let bound = chain.closed || chain.held[1].is_some();
    let descend = if bound { descend::<CLOSED, _> } else { descend::<OPEN, _> };
    let measured = descend(chain, effort, &judge)?;
    // Every step ends within bounds; but where none helps, the chain is still as it was guessed.
    if bend_within_bounds(chain) { descend(chain, effort, &judge) } else { Some(measured) }
}

/// Makes no piece bend more than it may; whether one did.
fn bend_within_bounds(chain: &mut Chain) -> bool {
    let most = chain.max_curvature;
    let mut bent = false;
    for (k, piece) in chain.pieces.iter_mut().enumerate() {
        let is_held = k == 0 && chain.held[0].is_some_and(|pin| pin.count > KAPPA0);
        for kappa in &mut piece.q[KAPPA0 + usize::from(is_held)..=KAPPA1] {
            if kappa.abs() > (1.0 + 1e-9) * most {
                *kappa = kappa.clamp(-most, most);
                bent = true;
            }
        }
    }
    bent
}

/// Gauss–Newton rounds with a damping that follows their success.
fn descend<const Z: usize, J: Fn(&Chain, &Measured, usize) -> Verdict>(
    chain: &mut Chain,
    effort: Effort,
    judge: &J,
) -> Option<Measured> {
    begin_where_held(chain);
    unwrap_headings(chain);
    let closure = Closure::of(chain);
    let mut held: Vec<Held> = vec![[false; Q]; chain.pieces.len()];
    let mut now = chain.measure();
    let mut open = gaps(chain);
    let mut misfit = open + closure.misfit(&chain.pieces);
    // Damping relative to the energy.
    let mut relative = if misfit < SMALL_GAP { JOINED } else { APART };
    let mut replans = 0;
    for round in 0..effort.rounds {
        let Some(plan) = backward::<Z>(chain, &now, relative * (now.energy + 1.0), &closure, &held) else {
            // With too many controls held there is no way to the end: all are let go, and the bounds cut the next step.
            if closure.count > 0 && held.iter().flatten().any(|h| *h) {
                held.fill([false; Q]);
                replans = REPLANS;
                continue;
            }
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
            let next_held = take_step(chain, &old, &plan, step, &held, &closure);
            let next = chain.measure_near(&now);
            // A full step leaves no gap, and no step opens one.
            let next_open = if step == 1.0 || open == 0.0 { 0.0 } else { gaps(chain) };
            let next_misfit = next_open + closure.misfit(&chain.pieces);
            let next_merit = 0.5 * next.energy + price * (next_misfit - SMALL_GAP).max(0.0);
            if next_merit <= merit * (1.0 + SLACK) {
                gain = Some((merit - next_merit).abs() / (next_merit + 1e-6));
                (now, open, misfit, held) = (next, next_open, next_misfit, next_held);
                break;
            }
            // A full step that ran into bounds is planned anew with those controls held.
            if step == 1.0 && next_held != held && replans < REPLANS {
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
        let verdict = judge(chain, &now, round);
        if verdict == Verdict::Hopeless {
            return None;
        }
        let Some(gain) = gain else {
            chain.pieces = old;
            relative = (relative * 100.0).max(1e-3);
            if relative > 1e7 {
                break;
            }
            continue;
        };
        relative = if step == 1.0 { (relative * 0.1).max(1e-9) } else { relative * 3.0 };
        if (gain < effort.tolerance || verdict == Verdict::Enough) && misfit < 1e-3 {
            break;
        }
    }
    if join_exactly::<Z>(chain, &closure, &mut held)? {
        now = chain.measure();
    }
    now.energy.is_finite().then_some(now)
}

/// Whether a trial that after some round costs more than it may by `excess` could still come down to it. Most that cannot show it soon.
pub(crate) fn is_hopeful(excess: f64, round: usize) -> bool {
    excess < (0..round).fold(DOUBTFUL, |limit, _| limit * FADING)
}

/// Excess at which a trial is given up after its first round, in units of cost, and the share of it after each further one: at
/// these one in twenty of those that would come down is lost.
const DOUBTFUL: f64 = 2000.0;
const FADING: f64 = 0.15;

/// Relative damping while only the joins are to be closed: so strong that nothing else moves.
const JOINING: f64 = 1e3;

/// Full steps until all joins hold to rounding; whether any was needed.
fn join_exactly<const Z: usize>(chain: &mut Chain, closure: &Closure, held: &mut [Held]) -> Option<bool> {
    for round in 0..10 {
        if gaps(chain) == 0.0 && closure.misfit(&chain.pieces) < 1e-10 {
            return Some(round > 0);
        }
        let mut now = chain.measure();
        for normal in &mut now.normals {
            normal.gradient = [0.0; Q];
        }
        let plan = backward::<Z>(chain, &now, JOINING * (now.energy + 1.0), closure, held)?;
        let old = chain.pieces.clone();
        let next = take_step(chain, &old, &plan, 1.0, held, closure);
        // What is held stays held: here only the joins matter.
        for (h, n) in held.iter_mut().zip(next) {
            for (h, n) in h.iter_mut().zip(n) {
                *h |= n;
            }
        }
    }
    (gaps(chain) == 0.0 && closure.misfit(&chain.pieces) < 1e-9).then_some(true)
}

/// What is open at the joins between neighbours, in sum.
fn gaps(chain: &Chain) -> f64 {
    (1..chain.pieces.len()).map(|k| size(gap_before(chain, &chain.pieces, k))).sum()
}

/// Puts the start of a held chain where it is held; the recursion leaves it there.
fn begin_where_held(chain: &mut Chain) {
    let (Some(pin), piece) = (chain.held[0], &mut chain.pieces[0]) else { return };
    piece.q[..pin.count].copy_from_slice(&pin.pose[..pin.count]);
    match piece.kind {
        Kind::Line => piece.q[KAPPA0] = 0.0,
        Kind::Arc => piece.q[KAPPA1] = piece.q[KAPPA0],
        Kind::Clothoid => {}
    }
}

/// Makes the headings of pieces that join smoothly run on without jumps of whole turns.
fn unwrap_headings(chain: &mut Chain) {
    for k in 1..chain.pieces.len() {
        let arriving = end(&chain.pieces[k - 1].q)[HEADING];
        let h = &mut chain.pieces[k].q[HEADING];
        *h += TAU * ((arriving - *h) / TAU + 0.5).floor();
    }
}
