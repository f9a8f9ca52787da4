//! Landscapes that nobody surveyed: a kind, a size and a seed come in, heights go out, the same on every platform.

use super::heightfield::{Heightfield, Samples, TerrainError};
use fairpath_curve::{Point, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A kind of landscape. Its water stands at a height of 0 m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Landscape {
    /// Rolling hills, all of them dry.
    #[default]
    Hills,
    /// Islands in a sea.
    Islands,
    /// A valley between mountains with a winding river, which flows from west to east.
    Valley,
}

/// What landscape of what size. The south-western corner is at 0, 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SyntheticTerrain {
    /// What kind.
    pub landscape: Landscape,
    /// Samples each way.
    pub size: usize,
    /// From one to the next, m.
    pub cell_m: f64,
    /// Other seeds give other landscapes of the kind.
    pub seed: u64,
}

impl Default for SyntheticTerrain {
    fn default() -> Self {
        Self { landscape: Landscape::Hills, size: 1024, cell_m: 2.0, seed: 7 }
    }
}

/// The largest hills are about so wide, m.
const HILL_M: f64 = 700.0;

/// Octaves of noise; the last one's waves are then as short as 5 m, and low.
const OCTAVES: u32 = 8;

/// Each octave is so much as high as the one before: less than the half that makes every scale equally rough.
const GAIN: f64 = 0.42;

impl SyntheticTerrain {
    /// Makes the heights.
    ///
    /// # Errors
    /// When there are too few or too many samples, or the cell is not positive and finite.
    pub fn build(&self) -> Result<Heightfield, TerrainError> {
        let size = [self.size; 2];
        super::heightfield::check_frame(size, self.size.saturating_mul(self.size))?;
        let noise = Noise { seed: self.seed };
        let side_m = self.cell_m * (self.size - 1) as f64;
        let place = |i: usize| Point::new((i % self.size) as f64 * self.cell_m, (i / self.size) as f64 * self.cell_m);
        let heights = (0..self.size * self.size).map(|i| self.height(&noise, side_m, place(i)) as f32).collect();
        Heightfield::new(size, Point::ZERO, Vec2::new(self.cell_m, self.cell_m), Samples::F32(heights))
    }

    fn height(&self, noise: &Noise, side_m: f64, p: Point) -> f64 {
        let hills = noise.layered(p, HILL_M);
        match self.landscape {
            Landscape::Hills => 80.0 + 90.0 * hills,
            Landscape::Islands => {
                // Round about the middle there is land, towards the edges sea.
                let from_middle = (p - Point::new(0.5 * side_m, 0.5 * side_m)).hypot() / (0.5 * side_m);
                let shelf = 1.0 - 1.6 * from_middle * from_middle;
                60.0 * shelf.max(-0.6) + 75.0 * hills - 6.0
            }
            Landscape::Valley => {
                let river_y = 0.5 * side_m + 0.16 * side_m * noise.smooth(Point::new(p.x / 900.0, 17.5));
                let aside = (p.y - river_y).abs();
                // A bed, meadows beside it, then slopes that become mountains.
                let bed = 12.0 * smoothstep(18.0, 60.0, aside) - 6.0;
                let meadow = 8.0 * smoothstep(40.0, 260.0, aside);
                let mountain = 0.34 * (aside - 180.0).max(0.0) * (1.0 + 0.5 * hills);
                bed + meadow + mountain + 26.0 * hills * smoothstep(50.0, 400.0, aside)
            }
        }
    }
}

/// From 0 before `low` to 1 after `high`, with level ends.
fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Gradient noise in the plane, with the fade of Perlin, *Improving noise*, 2002, over a hash of our own.
struct Noise {
    seed: u64,
}

/// Eight directions, along the axes and between them.
const GRADIENTS: [[f64; 2]; 8] =
    [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];

impl Noise {
    /// Octaves one over the other, the first with waves of that length; mostly within ±1.
    fn layered(&self, p: Point, wave_m: f64) -> f64 {
        let (mut sum, mut height, mut wave) = (0.0, 1.0, wave_m);
        for octave in 0..OCTAVES {
            // Shifted, or the grids of all octaves would meet at the origin.
            let shift = f64::from(octave) * 13.7;
            sum += height * self.smooth(Point::new(p.x / wave + shift, p.y / wave - shift));
            height *= GAIN;
            wave *= 0.5;
        }
        1.3 * sum
    }

    /// Waves of length 1.
    fn smooth(&self, p: Point) -> f64 {
        let (x, y) = (p.x.floor(), p.y.floor());
        let (u, v) = (p.x - x, p.y - y);
        let slope = |dx: f64, dy: f64| {
            let [gx, gy] = GRADIENTS[(self.hash((x + dx) as i64, (y + dy) as i64) % 8) as usize];
            gx * (u - dx) + gy * (v - dy)
        };
        let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
        let (fu, fv) = (fade(u), fade(v));
        let south = slope(0.0, 0.0) + fu * (slope(1.0, 0.0) - slope(0.0, 0.0));
        let north = slope(0.0, 1.0) + fu * (slope(1.0, 1.0) - slope(0.0, 1.0));
        south + fv * (north - south)
    }

    /// Bits without an order, of a place of the grid (the finaliser of splitmix64).
    fn hash(&self, x: i64, y: i64) -> u64 {
        let mut h =
            self.seed ^ (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (y as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
        h = (h ^ (h >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        h = (h ^ (h >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        h ^ (h >> 31)
    }
}
