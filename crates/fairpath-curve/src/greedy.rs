//! Cutting an interval into the fewest pieces that an approximation can represent.

/// How the error of an approximation grows with the piece, and when it is small enough.
pub(crate) struct Tolerance {
    /// Greatest error allowed.
    pub(crate) accuracy: f64,
    /// Power of the piece's length with which the error grows, a guess that only costs time.
    pub(crate) order: f64,
    /// Pieces are never made shorter than this: there rounding rules.
    pub(crate) shortest: f64,
}

/// Cuts [0, length] into pieces, each as long as the tolerance allows, and returns what `approximate` made of each.
///
/// `approximate(from, to)` returns its error and its result. Where the error grows with the piece, taking the
/// longest piece each time gives the fewest; the search for it stops within 1 %. `longest(from)` is an upper
/// limit for a piece's length.
pub(crate) fn longest_pieces<T>(
    length: f64,
    tolerance: &Tolerance,
    longest: impl Fn(f64) -> f64,
    mut approximate: impl FnMut(f64, f64) -> (f64, T),
) -> Vec<T> {
    /// A bound on the work and the memory.
    const MAX_PIECES: usize = 100_000;
    let mut pieces = Vec::new();
    let mut from = 0.0;
    let mut guess = length;
    while from < length && pieces.len() < MAX_PIECES {
        let rest = length - from;
        let limit = rest.min(longest(from).max(tolerance.shortest));
        let mut step = guess.min(limit);
        // Lengths known to be good and to be bad.
        let (mut good, mut bad) = ((0.0, None), f64::INFINITY);
        for _ in 0..40 {
            let to = if step >= rest { length } else { from + step };
            let (error, made) = approximate(from, to);
            if error <= tolerance.accuracy || step <= tolerance.shortest || to <= from {
                good = (step, Some(made));
                if step >= limit || bad <= 1.01 * step {
                    break;
                }
            } else {
                bad = step;
                if good.1.is_some() && bad <= 1.01 * good.0 {
                    break;
                }
            }
            let factor = libm::pow(tolerance.accuracy / error, 1.0 / tolerance.order);
            let factor = if factor.is_finite() { factor.clamp(0.1, 4.0) } else { 0.5 };
            let wanted = step * factor * 0.995;
            step = if good.1.is_some() && bad.is_finite() {
                // Between the two, but not so near to either that nothing is learnt.
                wanted.clamp(0.9 * good.0 + 0.1 * bad, 0.1 * good.0 + 0.9 * bad)
            } else if good.1.is_some() {
                wanted.max(1.005 * step)
            } else {
                wanted.min(0.95 * step)
            }
            .clamp(tolerance.shortest.min(limit), limit);
        }
        let (step, made) = match good {
            (step, Some(made)) => (step, made),
            // Nothing was good enough: the shortest piece tried stands.
            (_, None) => (step, approximate(from, if step >= rest { length } else { from + step }).1),
        };
        pieces.push(made);
        guess = step;
        from = if step >= rest { length } else { from + step };
    }
    pieces
}
