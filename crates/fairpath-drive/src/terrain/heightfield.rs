//! Heights on a regular grid in plan: samples come in, heights and slopes anywhere between them go out.

use fairpath_curve::{Point, Vec2};
use thiserror::Error;

/// Most samples of a heightfield: 2²⁸, twenty times the 3601² of a sheet of SRTM at 1″, and a GiB in single precision.
pub const MOST_SAMPLES: usize = 1 << 28;

/// The heights themselves, row by row from the south, each from the west, m.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Single precision: a quarter of a millimetre at 4,000 m.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
}

impl Samples {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::F32(samples) => samples.len(),
            Self::F64(samples) => samples.len(),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of them, m.
    ///
    /// # Panics
    /// When there is none of that number.
    #[must_use]
    pub fn get(&self, i: usize) -> f64 {
        match self {
            Self::F32(samples) => f64::from(samples[i]),
            Self::F64(samples) => samples[i],
        }
    }

    /// One of them and the next, m.
    #[inline]
    fn pair(&self, i: usize) -> [f64; 2] {
        match self {
            Self::F32(samples) => [f64::from(samples[i]), f64::from(samples[i + 1])],
            Self::F64(samples) => [samples[i], samples[i + 1]],
        }
    }

    /// Puts another height there, rounded to the precision of the samples.
    ///
    /// # Panics
    /// When there is none of that number.
    pub fn set(&mut self, i: usize, height_m: f64) {
        match self {
            Self::F32(samples) => samples[i] = height_m as f32,
            Self::F64(samples) => samples[i] = height_m,
        }
    }
}

/// Why samples are no heightfield.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TerrainError {
    /// There is nothing between fewer.
    #[error("the terrain has {columns} × {rows} samples; there must be at least 2 × 2")]
    TooSmall {
        /// Samples from west to east.
        columns: usize,
        /// Samples from south to north.
        rows: usize,
    },
    /// It would not fit into memory.
    #[error(
        "the terrain has {columns} × {rows} samples, more than {MOST_SAMPLES}; cut a part out or take a coarser one"
    )]
    TooLarge {
        /// Samples from west to east.
        columns: usize,
        /// Samples from south to north.
        rows: usize,
    },
    /// Columns times rows is another number.
    #[error(
        "{columns} × {rows} samples were announced, and there are {found}; the file is cut off or its size is told wrongly"
    )]
    Count {
        /// Samples from west to east.
        columns: usize,
        /// Samples from south to north.
        rows: usize,
        /// How many came.
        found: usize,
    },
    /// The spacing or the corner is not a finite place, or the spacing is not positive.
    #[error(
        "the samples lie {x} m by {y} m apart from a corner at {corner:?}; spacing must be positive, and all of it finite"
    )]
    Frame {
        /// From west to east, m.
        x: f64,
        /// From south to north, m.
        y: f64,
        /// The corner.
        corner: Point,
    },
    /// A height is infinite, or so high that nothing on this planet is.
    #[error(
        "the height in column {column}, row {row} from the south-west is {height_m} m; heights are expected within ±{MOST_HEIGHT_M} m"
    )]
    Height {
        /// From the west.
        column: usize,
        /// From the south.
        row: usize,
        /// What stands there.
        height_m: f64,
    },
    /// Every sample is a void.
    #[error("the terrain has no height at all: every sample is a void")]
    AllVoid,
}

/// Heights beyond this are taken for rubbish, m: other planets' mountains and trenches lie within it too.
pub const MOST_HEIGHT_M: f64 = 1e5;

/// Heights on a regular grid in plan. x is east, y north, z up, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Heightfield {
    columns: usize,
    rows: usize,
    /// The sample furthest to the south-west.
    corner: Point,
    spacing_m: Vec2,
    samples: Samples,
}

impl Heightfield {
    /// Heights without voids.
    ///
    /// `samples` go row by row from the south, each from the west; `corner` is the place of the first one, `spacing_m` the distance from one to the next
    /// towards east and north.
    ///
    /// # Errors
    /// When counts do not agree, there are fewer than 2 × 2 or more than [`MOST_SAMPLES`], spacing is not positive, or a height is not finite or beyond
    /// [`MOST_HEIGHT_M`]; a NaN too, which other makers of terrains use for a void: [`fill_voids`](super::fill_voids) first.
    pub fn new(
        [columns, rows]: [usize; 2],
        corner: Point,
        spacing_m: Vec2,
        samples: Samples,
    ) -> Result<Self, TerrainError> {
        check_frame([columns, rows], samples.len())?;
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !(positive(spacing_m.x) && positive(spacing_m.y) && corner.is_finite()) {
            return Err(TerrainError::Frame { x: spacing_m.x, y: spacing_m.y, corner });
        }
        let found = (0..samples.len()).find(|&i| !(samples.get(i).abs() <= MOST_HEIGHT_M));
        if let Some(i) = found {
            return Err(TerrainError::Height { column: i % columns, row: i / columns, height_m: samples.get(i) });
        }
        Ok(Self { columns, rows, corner, spacing_m, samples })
    }

    /// Samples from west to east and from south to north.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// The place of the sample furthest to the south-west.
    #[must_use]
    pub fn corner(&self) -> Point {
        self.corner
    }

    /// The place of the sample furthest to the north-east.
    #[must_use]
    pub fn far_corner(&self) -> Point {
        self.place([self.columns - 1, self.rows - 1])
    }

    /// From one sample to the next, m.
    #[must_use]
    pub fn spacing_m(&self) -> Vec2 {
        self.spacing_m
    }

    /// The samples.
    #[must_use]
    pub fn samples(&self) -> &Samples {
        &self.samples
    }

    /// Where a sample lies.
    #[must_use]
    pub fn place(&self, [column, row]: [usize; 2]) -> Point {
        self.corner + Vec2::new(column as f64 * self.spacing_m.x, row as f64 * self.spacing_m.y)
    }

    /// The height of a sample, m.
    ///
    /// # Panics
    /// When there is none in that column and row.
    #[must_use]
    pub fn sample(&self, [column, row]: [usize; 2]) -> f64 {
        assert!(column < self.columns, "column {column} of {}", self.columns);
        self.samples.get(row * self.columns + column)
    }

    /// Puts another height there, rounded to the precision of the samples.
    pub(super) fn set(&mut self, [column, row]: [usize; 2], height_m: f64) {
        self.samples.set(row * self.columns + column, height_m);
    }

    /// Whether a place lies among the samples.
    #[must_use]
    pub fn contains(&self, place: Point) -> bool {
        let (low, high) = (self.corner, self.far_corner());
        (low.x..=high.x).contains(&place.x) && (low.y..=high.y).contains(&place.y)
    }

    /// The nearest place among the samples.
    #[must_use]
    pub fn clamped(&self, place: Point) -> Point {
        let (low, high) = (self.corner, self.far_corner());
        // Not `clamp`, which gives NaN back.
        Point::new(place.x.min(high.x).max(low.x), place.y.min(high.y).max(low.y))
    }

    /// No height between two corners of an upright rectangle, the south-western first, is lower, m: what lies beside the terrain is as high as its rim.
    pub(crate) fn lowest_m(&self, corners: [Point; 2]) -> f64 {
        let [low, high] = corners.map(|place| self.clamped(place) - self.corner);
        let [columns, rows] = [
            [low.x / self.spacing_m.x, high.x / self.spacing_m.x],
            [low.y / self.spacing_m.y, high.y / self.spacing_m.y],
        ];
        let range = |[from, to]: [f64; 2], count: usize| from.floor() as usize..=(to.ceil() as usize).min(count - 1);
        let [columns, rows] = [range(columns, self.columns), range(rows, self.rows)];
        let samples = rows.flat_map(|row| columns.clone().map(move |column| self.sample([column, row])));
        samples.fold(f64::INFINITY, f64::min)
    }

    /// The height at a place, m, from the four samples around it by bilinear interpolation: continuous, and what a ray meets. Beyond the edge it is that of
    /// the nearest place on it.
    #[must_use]
    pub fn height(&self, place: Point) -> f64 {
        let (cell, within) = self.cell(place);
        self.height_within(cell, within)
    }

    /// The height in a cell, m, at shares of its sides from its south-western sample.
    #[inline]
    fn height_within(&self, cell: [usize; 2], [u, v]: [f64; 2]) -> f64 {
        let [sw, se, nw, ne] = self.corners(cell);
        (sw * (1.0 - u) + se * u) * (1.0 - v) + (nw * (1.0 - u) + ne * u) * v
    }

    /// The [`height`](Self::height), m, of a sample of the grid that has `parts` samples, a power of two, for each one of this.
    #[inline]
    pub(crate) fn height_between(&self, [column, row]: [usize; 2], parts: usize) -> f64 {
        let share = 1.0 / parts as f64;
        let at = |sample: usize, count: usize| {
            // As of a place: the last sample belongs to the cell before it.
            let cell = (sample >> parts.trailing_zeros()).min(count - 2);
            (cell, (sample - cell * parts) as f64 * share)
        };
        let ((column, u), (row, v)) = (at(column, self.columns), at(row, self.rows));
        self.height_within([column, row], [u, v])
    }

    /// The slope of [`height`](Self::height) at a place: how much it rises for a metre towards east and north.
    #[must_use]
    pub fn slope(&self, place: Point) -> Vec2 {
        let ([column, row], [u, v]) = self.cell(place);
        let [sw, se, nw, ne] = self.corners([column, row]);
        Vec2::new(
            ((se - sw) * (1.0 - v) + (ne - nw) * v) / self.spacing_m.x,
            ((nw - sw) * (1.0 - u) + (ne - se) * u) / self.spacing_m.y,
        )
    }

    /// The height at a place, m, from the sixteen samples around it by cubics through them (Catmull-Rom, in both directions): with a continuous slope, for
    /// what is laid on the terrain and would show each crease of the grid. Through the samples it is their height; it may overshoot between them.
    #[must_use]
    pub fn smooth_height(&self, place: Point) -> f64 {
        let ([column, row], [u, v]) = self.cell(place);
        let weights = [catmull_rom(u), catmull_rom(v)];
        let mut sum = 0.0;
        for (j, wv) in weights[1].iter().enumerate() {
            let line: f64 = (0..4).map(|i| weights[0][i] * self.sample_near([column, row], [i, j])).sum();
            sum += wv * line;
        }
        sum
    }

    /// A sample of the 4 × 4 around a cell; beyond the edge it goes on straight.
    fn sample_near(&self, [column, row]: [usize; 2], [i, j]: [usize; 2]) -> f64 {
        let along = |at: usize, step: usize, count: usize| -> ([usize; 2], f64) {
            // The samples between which a line goes on, and how far beyond the first one.
            match (at + step).checked_sub(1) {
                None => ([0, 1], -1.0),
                Some(k) if k < count => ([k, k], 0.0),
                Some(_) => ([count - 1, count - 2], -1.0),
            }
        };
        let (c, beyond_x) = along(column, i, self.columns);
        let (r, beyond_y) = along(row, j, self.rows);
        let line = |r: usize| {
            let first = self.sample([c[0], r]);
            first + beyond_x * (self.sample([c[1], r]) - first)
        };
        let first = line(r[0]);
        first + beyond_y * (line(r[1]) - first)
    }

    /// The cell in which a place lies, by its south-western sample, and where in it, from 0 to 1.
    #[inline]
    pub(super) fn cell(&self, place: Point) -> ([usize; 2], [f64; 2]) {
        let at = |x: f64, low: f64, spacing: f64, count: usize| {
            let t = ((x - low) / spacing).min((count - 1) as f64).max(0.0);
            // The last sample belongs to the cell before it.
            let cell = (t as usize).min(count - 2);
            (cell, t - cell as f64)
        };
        let (column, u) = at(place.x, self.corner.x, self.spacing_m.x, self.columns);
        let (row, v) = at(place.y, self.corner.y, self.spacing_m.y, self.rows);
        ([column, row], [u, v])
    }

    /// Heights at the corners of a cell: south-west, south-east, north-west, north-east.
    #[inline]
    pub(super) fn corners(&self, [column, row]: [usize; 2]) -> [f64; 4] {
        let (south, north) = (row * self.columns + column, (row + 1) * self.columns + column);
        let [[sw, se], [nw, ne]] = [self.samples.pair(south), self.samples.pair(north)];
        [sw, se, nw, ne]
    }
}

/// Whether so many samples are a grid of that size.
pub(super) fn check_frame([columns, rows]: [usize; 2], found: usize) -> Result<(), TerrainError> {
    if columns < 2 || rows < 2 {
        return Err(TerrainError::TooSmall { columns, rows });
    }
    match columns.checked_mul(rows) {
        Some(count) if count <= MOST_SAMPLES => {
            if count == found {
                Ok(())
            } else {
                Err(TerrainError::Count { columns, rows, found })
            }
        }
        _ => Err(TerrainError::TooLarge { columns, rows }),
    }
}

/// Weights of four samples for a place between the second and the third.
fn catmull_rom(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [0.5 * (2.0 * t2 - t - t3), 0.5 * (2.0 - 5.0 * t2 + 3.0 * t3), 0.5 * (t + 4.0 * t2 - 3.0 * t3), 0.5 * (t3 - t2)]
}
