//! Samples without a height: they come in marked as NaN, and go out with heights that bridge them smoothly from their rims, and counted.

use super::heightfield::{Samples, TerrainError, check_frame};

/// What was filled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VoidReport {
    /// How many samples had no height.
    pub filled: usize,
    /// How many there are in all.
    pub samples: usize,
}

impl VoidReport {
    /// The share of samples that had no height.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.filled as f64 / self.samples.max(1) as f64
    }
}

/// Rounds of relaxation on each level. Each halves what is left of the error's short waves; the long ones were right on the coarser level.
const ROUNDS: usize = 8;

/// Fills the samples that are NaN, in a grid of that size, with a membrane from rim to rim: each tends to the mean of its neighbours. Samples with a height keep it.
///
/// The mean of those known goes up a pyramid of ever coarser levels; then, from the coarsest down, what is still unknown takes what the coarser level has there
/// and is relaxed. Time is proportional to the number of samples, whatever the size of the voids.
///
/// # Errors
/// When the counts do not agree, or no sample has a height.
pub fn fill_voids(size: [usize; 2], samples: &mut Samples) -> Result<VoidReport, TerrainError> {
    check_frame(size, samples.len())?;
    let known: Vec<bool> = (0..samples.len()).map(|i| !samples.get(i).is_nan()).collect();
    let filled = known.iter().filter(|known| !**known).count();
    let report = VoidReport { filled, samples: known.len() };
    if filled == 0 {
        return Ok(report);
    }
    if filled == known.len() {
        return Err(TerrainError::AllVoid);
    }
    let heights = (0..samples.len()).map(|i| samples.get(i)).collect();
    let full = bridged(Level { size, heights, known });
    for (i, &known) in full.known.iter().enumerate() {
        if !known {
            samples.set(i, full.heights[i]);
        }
    }
    Ok(report)
}

/// A grid in which some heights are known; the others mean nothing until they are bridged.
struct Level {
    size: [usize; 2],
    heights: Vec<f64>,
    known: Vec<bool>,
}

/// The level with all its heights; `known` stays as it was.
fn bridged(mut level: Level) -> Level {
    if level.known.iter().all(|known| *known) {
        return level;
    }
    let coarse = bridged(coarser(&level));
    let [columns, rows] = level.size;
    for row in 0..rows {
        for column in 0..columns {
            let i = row * columns + column;
            if !level.known[i] {
                level.heights[i] = coarse.heights[(row / 2) * coarse.size[0] + column / 2];
            }
        }
    }
    for _ in 0..ROUNDS {
        relax(&mut level);
    }
    level
}

/// Half as many samples each way: each the mean of those known among its four.
fn coarser(level: &Level) -> Level {
    let [columns, rows] = level.size;
    let size = [columns.div_ceil(2), rows.div_ceil(2)];
    let mut heights = Vec::with_capacity(size[0] * size[1]);
    let mut known = Vec::with_capacity(size[0] * size[1]);
    for row in 0..size[1] {
        for column in 0..size[0] {
            let (mut sum, mut count) = (0.0, 0);
            for r in 2 * row..(2 * row + 2).min(rows) {
                for c in 2 * column..(2 * column + 2).min(columns) {
                    let i = r * columns + c;
                    if level.known[i] {
                        sum += level.heights[i];
                        count += 1;
                    }
                }
            }
            known.push(count > 0);
            heights.push(if count > 0 { sum / f64::from(count) } else { 0.0 });
        }
    }
    Level { size, heights, known }
}

/// Lets each unknown height be the mean of its neighbours, one after the other.
fn relax(level: &mut Level) {
    let [columns, rows] = level.size;
    for row in 0..rows {
        if row == 0 || row + 1 == rows || columns < 2 {
            (0..columns).for_each(|column| relax_one(level, [column, row]));
            continue;
        }
        relax_one(level, [0, row]);
        // Most are here, and all their four neighbours are there: half the time of asking each.
        let at = row * columns;
        let known = &level.known[at..at + columns];
        let (above, rest) = level.heights.split_at_mut(at);
        let (line, below) = rest.split_at_mut(columns);
        let (above, below) = (&above[at - columns..][..columns], &below[..columns]);
        let mut left = line[0];
        for column in 1..columns - 1 {
            if !known[column] {
                // In the order of `relax_one`, so that it is the same to the bit.
                line[column] = (left + line[column + 1] + above[column] + below[column]) * 0.25;
            }
            left = line[column];
        }
        relax_one(level, [columns - 1, row]);
    }
}

/// Lets one height, if it is unknown, be the mean of its neighbours, of which there may be fewer than four.
fn relax_one(level: &mut Level, [column, row]: [usize; 2]) {
    let [columns, rows] = level.size;
    let i = row * columns + column;
    if level.known[i] {
        return;
    }
    let (mut sum, mut count) = (0.0, 0.0);
    let mut add = |there: bool, i: usize| {
        if there {
            sum += level.heights[i];
            count += 1.0;
        }
    };
    add(column > 0, i.wrapping_sub(1));
    add(column + 1 < columns, i + 1);
    add(row > 0, i.wrapping_sub(columns));
    add(row + 1 < rows, i + columns);
    if count > 0.0 {
        level.heights[i] = sum / count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(size: [usize; 2]) -> Vec<f64> {
        (0..size[0] * size[1]).map(|i| 3.0 * (i % size[0]) as f64 - 2.0 * (i / size[0]) as f64).collect()
    }

    #[test]
    fn a_hole_in_a_plane_is_bridged_nearly_flat_and_the_rest_stays() {
        let size = [61, 47];
        let whole = plane(size);
        let mut holed = whole.clone();
        let is_void = |i: usize| (20..32).contains(&(i % size[0])) && (10..25).contains(&(i / size[0]));
        for (i, height) in holed.iter_mut().enumerate() {
            if is_void(i) {
                *height = f64::NAN;
            }
        }
        let mut samples = Samples::F64(holed);
        let report = fill_voids(size, &mut samples).unwrap();
        assert_eq!(report, VoidReport { filled: 12 * 15, samples: 61 * 47 });
        for (i, &height) in whole.iter().enumerate() {
            let allowed = if is_void(i) { 3.0 } else { 0.0 };
            assert!((samples.get(i) - height).abs() <= allowed, "{i}: {} for {height}", samples.get(i));
        }
    }

    #[test]
    fn whole_lines_are_relaxed_as_one_after_the_other_would_be() {
        for size in [[1, 7], [2, 5], [3, 3], [17, 1], [23, 19]] {
            let heights: Vec<f64> = (0..size[0] * size[1]).map(|i| ((i * i * 37) % 101) as f64 / 7.0).collect();
            let known = (0..heights.len()).map(|i| i % 5 == 2).collect();
            let mut quick = Level { size, heights, known };
            let mut slow = Level { size, heights: quick.heights.clone(), known: quick.known.clone() };
            for _ in 0..3 {
                relax(&mut quick);
                (0..slow.heights.len()).for_each(|i| relax_one(&mut slow, [i % size[0], i / size[0]]));
            }
            assert_eq!(quick.heights, slow.heights, "{size:?}");
        }
    }

    #[test]
    fn a_single_height_fills_everything_and_none_at_all_is_refused() {
        let mut heights = vec![f32::NAN; 35];
        assert_eq!(fill_voids([7, 5], &mut Samples::F32(heights.clone())), Err(TerrainError::AllVoid));
        heights[33] = 12.5;
        let mut samples = Samples::F32(heights);
        assert_eq!(fill_voids([7, 5], &mut samples).unwrap().filled, 34);
        assert_eq!(samples, Samples::F32(vec![12.5; 35]));
        assert!(matches!(fill_voids([7, 6], &mut samples), Err(TerrainError::Count { found: 35, .. })));
    }
}
