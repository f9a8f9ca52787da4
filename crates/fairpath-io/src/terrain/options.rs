//! What the caller says about a terrain that its file does not.

use crate::error::Fault;
use crate::limits::Limits;
use fairpath_drive::RawLayout;

/// How to read a terrain. Without any of these every file is read that says what it is.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct TerrainOptions {
    /// Bounds on the input.
    pub limits: Limits,
    /// Heights that the lowest and the highest whole number of a sample stand for, m: black and white of a PNG, which must have it; 0 and 65,535 of raw u16;
    /// whole numbers of a TIFF likewise. Where they stand for metres, or samples are not whole numbers, it has no place.
    pub height_range_m: Option<[f64; 2]>,
    /// From one sample to the next, m. PNG, raw numbers and a TIFF that does not say where it lies must have it; what is in longitude and latitude is resampled
    /// with it. Other files have their own.
    pub spacing_m: Option<f64>,
    /// The EPSG number of the file's coordinates, where the file has none: an ASCII grid, a TIFF without a projection.
    pub epsg: Option<u32>,
    /// The number that stands for no height, as the file has it; beside the one that the file tells.
    pub void_value: Option<f64>,
    /// Length of the unit of height, m, instead of the one that the file tells (else 1): 0.3048 for feet, 1200/3937 for feet of surveys of the United States.
    pub height_unit_m: Option<f64>,
    /// What raw numbers are; they must have it.
    pub raw: Option<RawLayout>,
}

impl TerrainOptions {
    /// Refuses numbers that nothing could be made of.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let positive = |x: Option<f64>| x.is_none_or(|x| x > 0.0 && x.is_finite());
        let refused = |name: &str, expected: &str| Err(Fault::new("the options", format_args!("`{name}` {expected}")));
        if !positive(self.spacing_m) {
            return refused("spacing_m", "must be a positive number of metres");
        }
        if !positive(self.height_unit_m) {
            return refused("height_unit_m", "must be a positive number of metres");
        }
        if self.height_range_m.is_some_and(|range| !range.iter().all(|h| h.is_finite()) || range[0] == range[1]) {
            return refused("height_range_m", "must be two heights that differ, m");
        }
        Ok(())
    }

    /// The spacing, which this file does not tell.
    pub(super) fn spacing(&self, place: &str) -> Result<f64, Fault> {
        let missing = || Fault::new(place, "it does not say how far apart its samples lie; give `spacing_m`");
        self.spacing_m.ok_or_else(missing)
    }

    /// Whether a number stands for none by what the caller says; `is_single` tells that it had no more digits than single precision has.
    pub(super) fn is_void(&self, value: f64, is_single: bool) -> bool {
        self.void_value.is_some_and(|void| value == void || (is_single && value == f64::from(void as f32)))
    }

    /// The height that a number in a file stands for, m; `whole` are the lowest and highest that whole numbers of its kind can be.
    pub(super) fn height(&self, value: f64, whole: Option<[f64; 2]>) -> f64 {
        match (self.height_range_m, whole) {
            (Some([low, high]), Some([least, most])) => low + (value - least) / (most - least) * (high - low),
            _ => value * self.height_unit_m.unwrap_or(1.0),
        }
    }
}
