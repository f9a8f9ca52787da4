//! Improving a merged chain by local changes whose effect is measured, not estimated.
//!
//! The path is chosen by estimates of what each join costs, two candidates at a time; the merged chain knows better. Here every
//! change that the same costs would welcome (two pieces become one, a clothoid becomes an arc, an arc a line, a piece is split) is tried on
//! the piece and its neighbours, merged anew, and kept if what it really costs is less. Beyond the paper.

use super::candidates::{deviation, mergeable, penalty};
use super::chain::{Chain, KAPPA0, KAPPA1, LENGTH, Measured, Piece, Pin, end};
use super::hold::halves;
use super::merge::{Effort, Verdict, is_hopeful, merge, merge_until};
use super::transition::possible;
use crate::options::FitOptions;
use crate::parallel;
use crate::primitive_fit::{refine as fit_freely, walk_line};
use crate::walk::Primitive;
use fairpath_curve::{Continuity, Kind, Vec2};
use std::ops::Range;

/// Effort of trying one change.
const TRY: Effort = Effort { rounds: 6, tolerance: 1e-2 };

/// Pieces on each side of a change that move with it.
const NEIGHBOURS: usize = 2;

/// What a change must gain, in units of cost: less would be noise.
const WORTHWHILE: f64 = 0.5;

/// What a change must gain if the joins cost nothing before it is tried.
const PROMISING: f64 = 7.0;

/// Pieces that are looked at together: as many as there are often threads.
const AHEAD: usize = 4;

/// Most passes over the chain.
const PASSES: usize = 2;

/// Improves the chain; gives its measurement.
pub(crate) fn refine(chain: &mut Chain, measured: Measured, options: &FitOptions, last: Effort) -> Option<Measured> {
    let mut measured = measured;
    // Pieces whose surroundings have not changed since they were last looked at need no second look.
    let mut fresh = vec![true; chain.pieces.len()];
    for _ in 0..PASSES {
        let before = total(chain, &measured, options);
        let backup = (chain.pieces.clone(), chain.joins.clone());
        if !pass(chain, &mut measured, &mut fresh, options) {
            break;
        }
        match merge(chain, last) {
            Some(m) if total(chain, &m, options) < before => measured = m,
            _ => {
                (chain.pieces, chain.joins) = backup;
                return Some(chain.measure());
            }
        }
    }
    Some(measured)
}

/// The cost of a chain as section 3.4 counts it, on the chain as it is.
pub(crate) fn total(chain: &Chain, measured: &Measured, options: &FitOptions) -> f64 {
    let errors = measured.normals.iter().map(|n| n.deviation(options));
    cost(&chain.pieces, errors, options)
}

fn cost(pieces: &[Piece], errors: impl Iterator<Item = f64>, options: &FitOptions) -> f64 {
    let mut sum = 0.0;
    let mut sign = 0.0;
    for (piece, error) in pieces.iter().zip(errors) {
        let kind = match piece.kind {
            Kind::Line => options.line_cost,
            Kind::Arc => options.arc_cost,
            Kind::Clothoid => options.clothoid_cost,
        };
        let short = (options.short_length - piece.q[LENGTH]).max(0.0);
        sum += kind.unwrap_or(f64::INFINITY) + penalty(error, options) + options.shortness_cost * short * short;
        for kappa in [piece.q[KAPPA0], piece.q[KAPPA1]] {
            if kappa.abs() > 1e-9 {
                if sign * kappa < 0.0 {
                    sum += options.inflection_cost;
                }
                sign = kappa.signum();
            }
        }
    }
    sum
}

/// Tries all changes once along the chain; whether any was made.
fn pass(chain: &mut Chain, measured: &mut Measured, fresh: &mut Vec<bool>, options: &FitOptions) -> bool {
    let mut next = vec![false; fresh.len()];
    let mut changed = false;
    let mut k = 0;
    loop {
        // While nothing is changed it makes no difference in which order pieces are looked at.
        let look = |k: &usize| fresh[*k] || fresh.get(k + 1).is_some_and(|f| *f);
        let ahead: Vec<usize> = (k..chain.pieces.len()).filter(look).take(AHEAD).collect();
        let Some(last) = ahead.last() else { break };
        let improved = parallel::find_map(&ahead, |k| Some((*k, improvement(chain, measured, *k, options)?)));
        let Some((at, trial)) = improved else {
            k = last + 1;
            continue;
        };
        let (window, count) = put_in(chain, measured, trial);
        changed = true;
        fresh.splice(window.clone(), vec![true; count]);
        next.splice(window, vec![true; count]);
        k = at;
    }
    *fresh = next;
    changed
}

/// A change: the pieces in `range` become `with`, joined by `level`.
pub(crate) struct Change {
    pub(crate) range: Range<usize>,
    pub(crate) with: Vec<Piece>,
    pub(crate) level: Continuity,
    /// What it would gain if the joins cost nothing.
    pub(crate) promise: f64,
}

/// What comes of the first change at a piece that gains.
fn improvement(chain: &Chain, measured: &Measured, k: usize, options: &FitOptions) -> Option<Trial> {
    let mut changes = changes(chain, measured, k, options);
    changes.sort_by(|a, b| b.promise.total_cmp(&a.promise));
    changes.iter().find_map(|change| gaining(chain, measured, change, options))
}

/// Makes a change if it gains; the pieces that it replaced with its neighbours, and by how many.
pub(crate) fn made(
    chain: &mut Chain,
    measured: &mut Measured,
    change: &Change,
    options: &FitOptions,
) -> Option<(Range<usize>, usize)> {
    let trial = gaining(chain, measured, change, options)?;
    Some(put_in(chain, measured, trial))
}

/// What comes of a change, if it gains.
fn gaining(chain: &Chain, measured: &Measured, change: &Change, options: &FitOptions) -> Option<Trial> {
    if !fits(chain, change) {
        return None;
    }
    let (gain, trial) = tried(chain, measured, change, options)?;
    (gain > WORTHWHILE).then_some(trial)
}

/// Puts what came of a change into the chain; the pieces that it replaced, and by how many.
fn put_in(chain: &mut Chain, measured: &mut Measured, trial: Trial) -> (Range<usize>, usize) {
    let Trial { window, pieces, joins, normals } = trial;
    let count = pieces.len();
    chain.pieces.splice(window.clone(), pieces);
    chain.joins.splice(window.start..window.end - 1, joins);
    measured.normals.splice(window.clone(), normals);
    (window, count)
}

/// The changes at a piece that might pay, judged by free fits.
fn changes(chain: &Chain, measured: &Measured, k: usize, options: &FitOptions) -> Vec<Change> {
    let mut out = Vec::new();
    let own = piece_cost(chain, measured, k, options);
    let kinds =
        [(Kind::Line, options.line_cost), (Kind::Arc, options.arc_cost), (Kind::Clothoid, options.clothoid_cost)];
    // Two become one.
    if k + 1 < chain.pieces.len() && chain.joins[k] != Continuity::G0 {
        let both = own + piece_cost(chain, measured, k + 1, options);
        let (a, b) = (&chain.pieces[k], &chain.pieces[k + 1]);
        let data = span(measured, k..k + 2);
        for (kind, price) in kinds {
            // A fit is made only where a perfect one would do.
            if let Some(price) = price
                && both - price > PROMISING
                && let Some(piece) = united(chain, (a, b), kind, data.clone(), options)
            {
                let promise = both - price - penalty(piece.1, options);
                if promise > PROMISING {
                    out.push(Change { range: k..k + 2, with: vec![piece.0], level: Continuity::G2, promise });
                }
            }
        }
    }
    // A simpler kind.
    for (kind, price) in kinds {
        let piece = &chain.pieces[k];
        if simplicity(kind) < simplicity(piece.kind)
            && let Some(price) = price
            && own - price > PROMISING
            && let Some(simpler) = united(chain, (piece, piece), kind, span(measured, k..k + 1), options)
        {
            let promise = own - price - penalty(simpler.1, options);
            if promise > PROMISING {
                out.push(Change { range: k..k + 1, with: vec![simpler.0], level: Continuity::G2, promise });
            }
        }
    }
    // One becomes two.
    if let (Some(price), Some(_)) = (options.clothoid_cost, options.g2_cost)
        && own > 2.0 * price + WORTHWHILE
    {
        let piece = &chain.pieces[k];
        if 0.5 * piece.q[LENGTH] > 2.0 {
            let promise = own - 2.0 * price;
            let with = halves(piece).to_vec();
            out.push(Change { range: k..k + 1, with, level: Continuity::G2, promise });
        }
    }
    out
}

fn simplicity(kind: Kind) -> u8 {
    match kind {
        Kind::Line => 0,
        Kind::Arc => 1,
        Kind::Clothoid => 2,
    }
}

fn piece_cost(chain: &Chain, measured: &Measured, k: usize, options: &FitOptions) -> f64 {
    cost(&chain.pieces[k..=k], [measured.normals[k].deviation(options)].into_iter(), options)
}

/// The data that pieces were measured against.
fn span(measured: &Measured, pieces: Range<usize>) -> Range<usize> {
    let (mut from, mut to) = (usize::MAX, 0);
    for n in &measured.normals[pieces] {
        from = from.min(n.span.0);
        to = to.max(n.span.1);
    }
    from..to
}

/// One piece in place of a run from `a` to `b`, freely fitted to the run's data, and its error.
fn united(
    chain: &Chain,
    (a, b): (&Piece, &Piece),
    kind: Kind,
    data: Range<usize>,
    options: &FitOptions,
) -> Option<(Piece, f64)> {
    let data = chain.data.get(data)?;
    if data.len() < 3 {
        return None;
    }
    let far = end(&b.q);
    let distance = Vec2::new(far[0] - a.q[0], far[1] - a.q[1]);
    let length = if a == b { a.q[LENGTH] } else { a.q[LENGTH] + b.q[LENGTH] };
    let (heading, kappa) = match kind {
        Kind::Line => (fairpath_curve::trig::angle_of(distance), 0.0),
        Kind::Arc => (a.q[2], (far[2] - a.q[2]) / length),
        Kind::Clothoid => (a.q[2], a.q[KAPPA0]),
    };
    let sharpness = if kind == Kind::Clothoid { (b.q[KAPPA1] - a.q[KAPPA0]) / length } else { 0.0 };
    let guess = Primitive { start: Vec2::new(a.q[0], a.q[1]), heading, kappa, sharpness };
    let fit = match kind {
        Kind::Line => {
            let first = walk_line(&guess, data, 1.0);
            let step = first.normal.step(2)?;
            walk_line(&first.primitive.moved(&step), data, 1.0)
        }
        Kind::Arc => fit_freely(&guess, data, 3, 3, 1.0),
        Kind::Clothoid => fit_freely(&guess, data, 4, 3, 1.0),
    };
    let p = fit.primitive;
    if !(fit.normal.energy.is_finite() && fit.length > 0.4 * length && mergeable(&p, fit.length, chain.max_curvature)) {
        return None;
    }
    let sign = if kind == Kind::Clothoid && a.sign[0] == b.sign[1] { [a.sign[0], b.sign[1]] } else { [0, 0] };
    let kappa1 = if kind == Kind::Clothoid { p.kappa + p.sharpness * fit.length } else { p.kappa };
    let piece = Piece {
        kind,
        q: [p.start.x, p.start.y, p.heading, p.kappa, kappa1, fit.length],
        sign,
        longest: 3.0 * fit.length + 30.0,
    };
    Some((piece, deviation(fit.normal.energy, fit.normal.weight, fit.normal.max, options)))
}

/// Whether a change leaves a chain whose joins can all hold.
fn fits(chain: &Chain, change: &Change) -> bool {
    let n = chain.pieces.len();
    let at = |i: isize| -> Option<(Kind, Continuity)> {
        // Kind of a neighbour and the level of the join towards the change.
        let (piece, join) = if i < 0 {
            let k = change.range.start as isize + i;
            if k < 0 && !chain.closed {
                return None;
            }
            (k.rem_euclid(n as isize) as usize, k.rem_euclid(n as isize) as usize)
        } else {
            let k = change.range.end as isize + i;
            if k >= n as isize && !chain.closed {
                return None;
            }
            ((k % n as isize) as usize, ((k - 1) % n as isize) as usize)
        };
        Some((chain.pieces[piece].kind, chain.joins[join]))
    };
    if n <= change.range.len() + 1 && chain.closed {
        return false;
    }
    let mut kinds: Vec<(Kind, Continuity)> = Vec::new();
    let before: Vec<_> = [-2, -1].into_iter().map(at).collect();
    kinds.extend(before.iter().flatten());
    for (i, p) in change.with.iter().enumerate() {
        let level = if i + 1 < change.with.len() { change.level } else { at(0).map_or(Continuity::G0, |a| a.1) };
        kinds.push((p.kind, level));
    }
    if let Some((kind, _)) = at(0) {
        kinds.push((kind, at(1).map_or(Continuity::G0, |a| a.1)));
    }
    if let Some((kind, _)) = at(1) {
        kinds.push((kind, Continuity::G0));
    }
    let meets = |side: usize, kind: Kind| chain.held[side].is_none_or(|pin| pin.admits(kind));
    if change.range.start == 0 && !change.with.first().is_some_and(|p| meets(0, p.kind))
        || change.range.end == n && !change.with.last().is_some_and(|p| meets(1, p.kind))
    {
        return false;
    }
    kinds.windows(2).all(|w| possible(w[0].0, w[1].0, w[0].1))
        && kinds.windows(3).all(|w| {
            !(w[0].0 == Kind::Line
                && w[1].0 == Kind::Clothoid
                && w[2].0 == Kind::Line
                && w[0].1 >= Continuity::G2
                && w[1].1 >= Continuity::G2)
        })
}

/// A change with its neighbours after merging them.
struct Trial {
    window: Range<usize>,
    pieces: Vec<Piece>,
    joins: Vec<Continuity>,
    normals: Vec<super::chain::PieceNormal>,
}

/// Merges a change with its neighbours; what it gains, if it can be merged.
fn tried(chain: &Chain, measured: &Measured, change: &Change, options: &FitOptions) -> Option<(f64, Trial)> {
    // Neighbours up to the next corner.
    let mut from = change.range.start;
    while from > 0 && change.range.start - from < NEIGHBOURS && chain.joins[from - 1] != Continuity::G0 {
        from -= 1;
    }
    let mut to = change.range.end;
    while to < chain.pieces.len() && to - change.range.end < NEIGHBOURS && chain.joins[to - 1] != Continuity::G0 {
        to += 1;
    }
    let window = from..to;
    let data = span(measured, window.clone());
    let mut pieces = chain.pieces[from..change.range.start].to_vec();
    pieces.extend_from_slice(&change.with);
    pieces.extend_from_slice(&chain.pieces[change.range.end..to]);
    let mut joins = chain.joins[from..change.range.start].to_vec();
    joins.extend(std::iter::repeat_n(change.level, change.with.len() - 1));
    joins.extend_from_slice(&chain.joins[change.range.end - 1..to - 1]);
    let n = chain.pieces.len();
    // Where the window ends within the chain it must still meet what comes before and after.
    let pin = |join: usize, pose: [f64; 4]| {
        let level = *chain.joins.get(join)?;
        (level != Continuity::G0).then(|| Pin { pose, count: level as usize + 2 })
    };
    let q = chain.pieces[from].q;
    let pins = [pin((from + n - 1) % n, [q[0], q[1], q[2], q[KAPPA0]]), pin(to - 1, end(&chain.pieces[to - 1].q))];
    let mut part = Chain {
        pieces,
        joins,
        data: chain.data.get(data.clone())?,
        corners: Vec::new(),
        closed: false,
        end_factor: chain.end_factor,
        short: chain.short,
        max_curvature: chain.max_curvature,
        variation: 0.0,
        pins,
        held: [chain.held[0].filter(|_| from == 0), chain.held[1].filter(|_| to == n)],
    };
    if part.data.len() < 3 {
        return None;
    }
    let errors = measured.normals[window.clone()].iter().map(|n| n.deviation(options));
    let before = cost(&chain.pieces[window.clone()], errors, options);
    let judge = |part: &Chain, now: &Measured, round: usize| {
        if is_hopeful(total(part, now, options) - before, round) { Verdict::GoOn } else { Verdict::Hopeless }
    };
    let mut result = merge_until(&mut part, TRY, judge)?;
    let gain = before - total(&part, &result, options);
    for normal in &mut result.normals {
        if normal.span.0 < normal.span.1 {
            normal.span = (normal.span.0 + data.start, normal.span.1 + data.start);
        }
    }
    Some((gain, Trial { window, pieces: part.pieces, joins: part.joins, normals: result.normals }))
}
