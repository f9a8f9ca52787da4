//! Numbers that a point of a program has, and what is done with many of them.

/// A number for each unknown, each equation, each row, and each side of a row.
#[derive(Clone, Debug)]
pub(super) struct Of {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) w: Vec<f64>,
    pub(super) s: Vec<f64>,
}

impl Of {
    /// Adds as much of another one.
    pub(super) fn add(&mut self, factor: f64, other: &Self) {
        let Self { x, y, w, s } = self;
        for (own, other) in [(x, &other.x), (y, &other.y), (w, &other.w), (s, &other.s)] {
            add(factor, other, own);
        }
    }
}

/// Adds as much of some numbers to others.
pub(super) fn add(factor: f64, by: &[f64], numbers: &mut [f64]) {
    numbers.iter_mut().zip(by).for_each(|(number, by)| *number += factor * by);
}

/// Puts numbers in place of others.
pub(super) fn set(numbers: &mut Vec<f64>, by: impl Iterator<Item = f64>) {
    numbers.clear();
    numbers.extend(by);
}

/// So many numbers at a time are taken together, that the processor need not wait for one after the other.
const LANES: usize = 8;

/// What comes of pairs, lane by lane and then of all lanes.
fn reduced(
    a: &[f64],
    b: &[f64],
    first: f64,
    with: impl Fn(f64, f64, f64) -> f64,
    of_lanes: impl Fn(f64, f64) -> f64,
) -> f64 {
    let mut lanes = [first; LANES];
    let (of_a, of_b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let (rest_a, rest_b) = (of_a.remainder(), of_b.remainder());
    for (a, b) in of_a.zip(of_b) {
        for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b) {
            *lane = with(*lane, *a, *b);
        }
    }
    for ((lane, a), b) in lanes.iter_mut().zip(rest_a).zip(rest_b) {
        *lane = with(*lane, *a, *b);
    }
    lanes.into_iter().fold(first, of_lanes)
}

/// The greater one, or NaN if one is.
fn greater(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

pub(super) fn size(numbers: &[f64]) -> f64 {
    reduced(numbers, numbers, 0.0, |most, number, _| greater(most, number.abs()), greater)
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    reduced(a, b, 0.0, |sum, a, b| sum + a * b, |sum, lane| sum + lane)
}

/// One over how often numbers can go their ways before one of them is nothing.
pub(super) fn haste(numbers: &[f64], ways: &[f64]) -> f64 {
    let greater = |most: f64, haste: f64| if haste > most { haste } else { most };
    reduced(numbers, ways, 0.0, |most, number, way| greater(most, -way / number), greater)
}
