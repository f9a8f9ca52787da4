//! Surfaces as a shaded picture: seen from above and aside, in parallel projection, with smooth shading.
//!
//! A depth buffer with several samples to a pixel. No light is traced: a key light from the upper left, a fill light from the right, a sky.
//! Colours are worked out as squares, near enough to what screens do.

use super::raster::{covered, dot, normalised, to_png, turn};
use crate::error::Error;
use crate::surfaces::{SurfaceFile, upright};

/// Longest side of the picture, px.
const SIZE: usize = 960;
/// Samples to a pixel along each side.
const SAMPLES: usize = 3;
/// White around the surfaces, px.
const MARGIN: f64 = 40.0;
/// Sines and cosines of the turn about the upright axis (30 degrees) and of the look from above (24 degrees).
const TURN: [f64; 2] = [0.5, 0.866_025_403_784_438_6];
const ABOVE: [f64; 2] = [0.406_736_643_075_8, 0.913_545_457_642_6];
/// Colour of the surfaces, of the sky, of the ground and of the paper, in light, not in screen values.
const CLAY: [f64; 3] = [0.72, 0.26, 0.13];
const SKY: [f64; 3] = [0.42, 0.46, 0.52];
const GROUND: [f64; 3] = [0.20, 0.15, 0.13];
const PAPER: [f64; 3] = [1.0, 1.0, 1.0];
/// Directions to the lights and their strengths.
const KEY: ([f64; 3], f64) = ([-0.48, 0.62, 0.62], 0.86);
const FILL: ([f64; 3], f64) = ([0.85, 0.10, 0.52], 0.16);
/// Strength of the gloss.
const GLOSS: f64 = 0.22;

/// The picture as a PNG file.
pub(crate) fn draw(file: &SurfaceFile) -> Result<Vec<u8>, Error> {
    let seen: Vec<Vec<[f64; 3]>> = file
        .surfaces
        .iter()
        .map(|entry| entry.mesh.vertices.iter().map(|&v| view(upright(v, file.y))).collect())
        .collect();
    let frame = Frame::around(seen.iter().flatten());
    let mut canvas = Canvas::new(&frame);
    for (entry, vertices) in file.surfaces.iter().zip(&seen) {
        let placed: Vec<[f64; 3]> = vertices.iter().map(|&v| frame.place(v)).collect();
        let normals: Vec<[f64; 3]> = entry.mesh.normals.iter().map(|&n| view(upright(n, file.y))).collect();
        for triangle in &entry.mesh.triangles {
            canvas.fill(triangle.map(|i| placed[i as usize]), triangle.map(|i| normals[i as usize]));
        }
    }
    to_png(&canvas.light, canvas.width, SAMPLES)
}

/// A vector in the viewer's frame: x to the right, y up, z towards the viewer.
fn view([x, y, z]: [f64; 3]) -> [f64; 3] {
    let (x, z) = (TURN[1] * x + TURN[0] * z, -TURN[0] * x + TURN[1] * z);
    [x, ABOVE[1] * y - ABOVE[0] * z, ABOVE[0] * y + ABOVE[1] * z]
}

/// Where the surfaces come to lie on the picture.
struct Frame {
    low: [f64; 3],
    /// Samples per unit.
    scale: f64,
    width: usize,
    height: usize,
}

impl Frame {
    fn around<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points {
            for k in 0..3 {
                low[k] = low[k].min(point[k]);
                high[k] = high[k].max(point[k]);
            }
        }
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        let scale = (SIZE as f64 - 2.0 * MARGIN) / width.max(height);
        let scale = if scale.is_finite() && scale > 0.0 { scale } else { 1.0 };
        let pixels = |length: f64| ((length * scale + 2.0 * MARGIN).round() as usize).clamp(1, SIZE);
        Self { low: [low[0], high[1], low[2]], scale, width: pixels(width), height: pixels(height) }
    }

    /// A point in samples from the upper left, with its depth towards the viewer.
    fn place(&self, p: [f64; 3]) -> [f64; 3] {
        let samples = SAMPLES as f64;
        [
            ((p[0] - self.low[0]) * self.scale + MARGIN) * samples,
            ((self.low[1] - p[1]) * self.scale + MARGIN) * samples,
            (p[2] - self.low[2]) * self.scale,
        ]
    }
}

/// Samples with their depths and light.
struct Canvas {
    width: usize,
    height: usize,
    depth: Vec<f64>,
    light: Vec<[f32; 3]>,
}

impl Canvas {
    fn new(frame: &Frame) -> Self {
        let (width, height) = (frame.width * SAMPLES, frame.height * SAMPLES);
        let paper = PAPER.map(|x| x as f32);
        Self { width, height, depth: vec![f64::NEG_INFINITY; width * height], light: vec![paper; width * height] }
    }

    fn fill(&mut self, p: [[f64; 3]; 3], normals: [[f64; 3]; 3]) {
        // The picture's y points down, so triangles that face the viewer run clockwise in it.
        let turn = turn(p);
        if !(turn < 0.0) {
            return;
        }
        let (depths, light) = (&mut self.depth, &mut self.light);
        covered(p, turn, [self.width, self.height], |place, weights| {
            let depth = weights[0] * p[0][2] + weights[1] * p[1][2] + weights[2] * p[2][2];
            if depth > depths[place] {
                depths[place] = depth;
                let normal = [0, 1, 2].map(|k| (0..3).map(|corner| weights[corner] * normals[corner][k]).sum::<f64>());
                light[place] = shade(normalised(normal)).map(|x| x as f32);
            }
        });
    }
}

/// Light that comes from a place with this normal.
fn shade(normal: [f64; 3]) -> [f64; 3] {
    let towards = |light: [f64; 3]| dot(normal, normalised(light)).max(0.0);
    let direct = KEY.1 * towards(KEY.0) + FILL.1 * towards(FILL.0);
    let up = 0.5 + 0.5 * normal[1];
    let half = normalised([KEY.0[0], KEY.0[1], KEY.0[2] + 1.0]);
    let glint = dot(normal, half).max(0.0);
    // The 32nd power by squaring.
    let glint = (0..5).fold(glint, |x, _| x * x) * GLOSS;
    // Places that are seen at a glance catch more of the sky.
    let glance = 1.0 - normal[2].clamp(0.0, 1.0);
    let glance = 0.10 * glance * glance * glance;
    [0, 1, 2].map(|k| {
        let around = GROUND[k] + (SKY[k] - GROUND[k]) * up;
        CLAY[k] * (direct + around) + glint + glance * SKY[k]
    })
}
