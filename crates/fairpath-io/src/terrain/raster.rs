//! What every format gives: samples in rows from the north or the south, and where they lie. What goes out is a grid in rows from the south, with NaN for
//! what has no height.

use crate::error::Fault;
use crate::limits::Limits;
use fairpath_drive::{MOST_HEIGHT_M, MOST_SAMPLES, Samples, TerrainError};
use fairpath_fit::Warning;
use std::fmt::Display;

/// Steps smaller than this, at a place that could be a longitude and a latitude, are taken for degrees, of which it is a little more than a minute: no terrain has a sample for
/// every two centimetres.
const LIKE_DEGREES: f64 = 0.02;

/// The plane, or the globe, in which a raster's corner and steps are.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Plane {
    /// Metres of nobody knows which projection.
    Local,
    /// Metres of this projection.
    Projected { projection: String, epsg: Option<u32> },
    /// Degrees of longitude and latitude of this geodetic datum.
    Geographic { projection: String },
}

/// Samples on a regular grid.
#[derive(Clone, Debug)]
pub(super) struct Raster {
    /// Columns and rows.
    pub(super) size: [usize; 2],
    /// Row by row from the south, each from the west, m; NaN has no height.
    pub(super) samples: Samples,
    /// Place of the sample furthest to the south-west.
    pub(super) corner: [f64; 2],
    /// From one sample to the next towards east and north, positive.
    pub(super) step: [f64; 2],
    pub(super) plane: Plane,
    /// What the reader had to assume or leave out.
    pub(super) warnings: Vec<Warning>,
}

/// Where the samples of a file lie, as it stores them: in rows, each sample a step from the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stored {
    /// Columns and rows.
    pub(super) size: [usize; 2],
    /// Place of the first sample of the first row.
    pub(super) first: [f64; 2],
    /// From column to column towards east and from row to row towards north; negative where the file goes the other way.
    pub(super) step: [f64; 2],
}

impl Stored {
    /// Samples at a step from each other from the origin, rows from the north: what pictures and bare numbers are.
    pub(super) fn from_north(size: [usize; 2], spacing: f64) -> Self {
        Self { size, first: [0.0, (size[1] as f64 - 1.0) * spacing], step: [spacing, -spacing] }
    }

    /// Where samples in metres of nobody knows which projection lie.
    pub(super) fn without_a_globe() -> Warning {
        let text = "it has no EPSG number that is known: where on the globe the terrain lies is not known, and its places are taken for metres";
        Warning { code: "no-georeference".into(), text: text.into() }
    }

    /// A projection for samples of which nothing says where they lie.
    pub(super) fn without_a_place() -> Warning {
        let text = "it tells a projection, but not where in it its samples lie: where on the globe the terrain lies is not known";
        Warning { code: "no-georeference".into(), text: text.into() }
    }

    /// Refuses places that look like degrees although nothing says so.
    pub(super) fn check_metres(self) -> Result<(), Fault> {
        let like_degrees =
            self.step[0].abs() < LIKE_DEGREES && self.first[0].abs() <= 360.0 && self.first[1].abs() <= 91.0;
        if like_degrees {
            let problem = format!(
                "steps of {:?} look like degrees of longitude and latitude; say so by their EPSG number, which is 4326 for WGS 84",
                self.step[0]
            );
            return Err(Fault::new("the place of the grid", problem));
        }
        Ok(())
    }

    /// The raster of these samples, in rows from the south, each from the west.
    pub(super) fn raster(self, mut samples: Samples, plane: Plane, warnings: Vec<Warning>) -> Result<Raster, Fault> {
        let [columns, rows] = self.size;
        check_count(self.size, samples.len())?;
        let fine = |k: usize| self.first[k].is_finite() && self.step[k].is_finite() && self.step[k] != 0.0;
        if !(fine(0) && fine(1)) {
            let problem = format!(
                "the samples begin at {:?} and lie {:?} apart; expected finite places and steps that are not zero",
                self.first, self.step
            );
            return Err(Fault::new("the place of the grid", problem));
        }
        match &mut samples {
            Samples::F32(samples) => orient(samples, columns, self.step),
            Samples::F64(samples) => orient(samples, columns, self.step),
        }
        let corner = [0, 1].map(|k| self.first[k] + (self.size[k] - 1) as f64 * self.step[k].min(0.0));
        let raster = Raster { size: [columns, rows], samples, corner, step: self.step.map(f64::abs), plane, warnings };
        raster.check_heights()?;
        Ok(raster)
    }
}

/// Turns rows and columns round where they run towards the south or the west.
fn orient<T>(samples: &mut [T], columns: usize, step: [f64; 2]) {
    if step[1] < 0.0 {
        let rows = samples.len() / columns;
        for row in 0..rows / 2 {
            let (low, high) = samples.split_at_mut((rows - 1 - row) * columns);
            low[row * columns..(row + 1) * columns].swap_with_slice(&mut high[..columns]);
        }
    }
    if step[0] < 0.0 {
        samples.chunks_exact_mut(columns).for_each(<[T]>::reverse);
    }
}

impl Raster {
    /// Refuses what is no height, before voids are filled from it.
    fn check_heights(&self) -> Result<(), Fault> {
        let bad = match &self.samples {
            Samples::F32(samples) => samples.iter().position(|h| h.abs() > MOST_HEIGHT_M as f32),
            Samples::F64(samples) => samples.iter().position(|h| h.abs() > MOST_HEIGHT_M),
        };
        let Some(i) = bad else { return Ok(()) };
        let (column, row) = (i % self.size[0], i / self.size[0]);
        let error = TerrainError::Height { column, row, height_m: self.samples.get(i) };
        let problem = format!("{error}; if that stands for no height, give it as the `void_value`");
        Err(Fault::new("the heights", problem))
    }
}

/// Characters of a text from a file, or from a decoder that quotes one, that a message has at most.
const MOST_QUOTED: usize = 200;

/// The beginning of a text that may be as long as a file.
pub(super) fn excerpt(text: impl Display) -> String {
    let text = text.to_string();
    match text.char_indices().nth(MOST_QUOTED) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// An error of the terrain itself, which has no place in the file.
pub(super) fn terrain_fault(error: TerrainError) -> Fault {
    Fault::new("the heights", error)
}

/// Whether a grid of that size is one, and allowed; before memory is taken for it.
pub(super) fn check_size(size: [usize; 2], limits: &Limits) -> Result<usize, Fault> {
    let [columns, rows] = size;
    if columns < 2 || rows < 2 {
        return Err(terrain_fault(TerrainError::TooSmall { columns, rows }));
    }
    let max = limits.max_terrain_samples.min(MOST_SAMPLES as u64);
    match columns.checked_mul(rows) {
        Some(count) if count as u64 <= max => Ok(count),
        _ => {
            let place = format!("a grid of {columns} × {rows}");
            Err(Fault::OverLimit { place, what: "samples", max, limit: "max_terrain_samples" })
        }
    }
}

/// Whether as many samples came as were announced.
pub(super) fn check_count([columns, rows]: [usize; 2], found: usize) -> Result<(), Fault> {
    if columns.checked_mul(rows) == Some(found) && found > 0 {
        return Ok(());
    }
    Err(terrain_fault(TerrainError::Count { columns, rows, found }))
}

/// Says that the heights lie on the steps of eight bits.
pub(super) fn terraces(step_m: f64) -> Warning {
    let text = format!(
        "there are 8 bits for a height: steps of {step_m:.3} m will show as terraces; take a file of 16 bits if there is one"
    );
    Warning { code: "terraces".into(), text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_way_to_store_a_grid_gives_the_same_one() {
        // Columns at 10, 12, 14 and rows at -1, 4; heights are 100 * row + column from the south-west.
        let ways = [
            ([10.0, -1.0], [2.0, 5.0], [0.0, 1.0, 2.0, 100.0, 101.0, 102.0]),
            ([10.0, 4.0], [2.0, -5.0], [100.0, 101.0, 102.0, 0.0, 1.0, 2.0]),
            ([14.0, -1.0], [-2.0, 5.0], [2.0, 1.0, 0.0, 102.0, 101.0, 100.0]),
            ([14.0, 4.0], [-2.0, -5.0], [102.0, 101.0, 100.0, 2.0, 1.0, 0.0]),
        ];
        for (first, step, samples) in ways {
            let stored = Stored { size: [3, 2], first, step };
            let raster = stored.raster(Samples::F64(samples.to_vec()), Plane::Local, Vec::new()).unwrap();
            assert_eq!((raster.corner, raster.step), ([10.0, -1.0], [2.0, 5.0]));
            assert_eq!(raster.samples, Samples::F64(vec![0.0, 1.0, 2.0, 100.0, 101.0, 102.0]));
        }
    }

    #[test]
    fn what_is_no_height_is_named_with_its_place_and_nan_is_a_void() {
        for bad in [f64::INFINITY, -1e5 - 1.0, 3.4e38] {
            let stored = Stored::from_north([3, 2], 1.0);
            let samples = Samples::F64(vec![0.0, f64::NAN, bad, 0.0, 0.0, 0.0]);
            match stored.raster(samples, Plane::Local, Vec::new()) {
                Err(Fault::Malformed { problem, .. }) => assert!(problem.contains("column 2, row 1"), "{problem}"),
                other => panic!("{other:?}"),
            }
        }
    }
}
