//! The lowest and the highest height of ever larger blocks of cells: what rays skip, and how rough a chunk is. A change touches only the blocks over it.

use super::heightfield::Heightfield;

/// Side of the smallest block, cells. All blocks together, of two f64 each, take 8 % of the memory of samples in single precision; with blocks of single cells they would take five times as much as these.
const BLOCK: usize = 8;

/// Lowest and highest, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Range {
    const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    fn with(self, height: f64) -> Self {
        Self { low: self.low.min(height), high: self.high.max(height) }
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

/// Cells from the first to before the last, in columns and rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cells {
    /// Columns, from the west.
    pub columns: [usize; 2],
    /// Rows, from the south.
    pub rows: [usize; 2],
}

/// Blocks of one size.
#[derive(Clone, Debug, PartialEq)]
struct Level {
    size: [usize; 2],
    ranges: Vec<Range>,
}

/// All sizes of blocks, each with a side of twice the one before, up to one block over everything.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pyramid {
    levels: Vec<Level>,
}

impl Pyramid {
    pub(super) fn new(field: &Heightfield) -> Self {
        let [columns, rows] = field.size();
        let mut size = [(columns - 1).div_ceil(BLOCK), (rows - 1).div_ceil(BLOCK)];
        let mut levels = vec![Level { size, ranges: vec![Range::NONE; size[0] * size[1]] }];
        while size != [1, 1] {
            size = size.map(|side| side.div_ceil(2));
            levels.push(Level { size, ranges: vec![Range::NONE; size[0] * size[1]] });
        }
        let mut pyramid = Self { levels };
        pyramid.update(field, Cells { columns: [0, columns - 1], rows: [0, rows - 1] });
        pyramid
    }

    /// Takes note that heights at the corners of these cells have changed.
    pub(super) fn update(&mut self, field: &Heightfield, cells: Cells) {
        let [columns, rows] = field.size();
        let blocks =
            |range: [usize; 2], side: usize, count: usize| [range[0] / side, range[1].div_ceil(side).min(count)];
        let first = &mut self.levels[0];
        let [x, y] = [blocks(cells.columns, BLOCK, first.size[0]), blocks(cells.rows, BLOCK, first.size[1])];
        for by in y[0]..y[1] {
            for bx in x[0]..x[1] {
                let mut range = Range::NONE;
                // Corners of cells: one more than cells each way.
                for row in by * BLOCK..=((by + 1) * BLOCK).min(rows - 1) {
                    for column in bx * BLOCK..=((bx + 1) * BLOCK).min(columns - 1) {
                        range = range.with(field.sample([column, row]));
                    }
                }
                first.ranges[by * first.size[0] + bx] = range;
            }
        }
        let mut side = BLOCK;
        for level in 1..self.levels.len() {
            side *= 2;
            let (below, here) = self.levels.split_at_mut(level);
            let (below, here) = (&below[level - 1], &mut here[0]);
            let [x, y] = [blocks(cells.columns, side, here.size[0]), blocks(cells.rows, side, here.size[1])];
            for by in y[0]..y[1] {
                for bx in x[0]..x[1] {
                    let mut range = Range::NONE;
                    for cy in 2 * by..(2 * by + 2).min(below.size[1]) {
                        for cx in 2 * bx..(2 * bx + 2).min(below.size[0]) {
                            range = range.union(below.ranges[cy * below.size[0] + cx]);
                        }
                    }
                    here.ranges[by * here.size[0] + bx] = range;
                }
            }
        }
    }

    /// The level of the one block over everything.
    pub(super) fn top(&self) -> usize {
        self.levels.len() - 1
    }

    /// The range of a block.
    pub(super) fn range(&self, level: usize, [bx, by]: [usize; 2]) -> Range {
        let level = &self.levels[level];
        level.ranges[by * level.size[0] + bx]
    }

    /// The blocks of the level below that a block is made of.
    pub(super) fn children(&self, level: usize, [bx, by]: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
        let [columns, rows] = self.levels[level - 1].size;
        (2 * by..(2 * by + 2).min(rows)).flat_map(move |y| (2 * bx..(2 * bx + 2).min(columns)).map(move |x| [x, y]))
    }

    /// The cells of a block, in a field of that many samples.
    pub(super) fn cells(level: usize, [bx, by]: [usize; 2], [columns, rows]: [usize; 2]) -> Cells {
        let side = BLOCK << level;
        let range = |block: usize, count: usize| [block * side, ((block + 1) * side).min(count - 1)];
        Cells { columns: range(bx, columns), rows: range(by, rows) }
    }
}
