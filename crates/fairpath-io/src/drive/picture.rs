//! A network as a picture: its scene from a camera, in perspective, with sun, sky and haze.
//!
//! A depth buffer with several samples to a pixel, light worked out at vertices, no shadows. For what a network looks like at a glance; who wants more opens the glTF.

use super::export::DriveExport;
use super::finishes::look;
use super::views::DriveView;
use crate::error::Error;
use crate::picture::{covered, dot, normalised, to_png, turn};
use fairpath_curve::trig;
use fairpath_drive::{Camera, Part, Placement, Scene, SceneOptions};

/// Samples to a pixel along each side.
const SAMPLES: usize = 2;

/// Most pixels of a side.
pub const MOST_PIXELS: usize = 8192;

/// Half the angle of view across the shorter side, as its tangent: 50 degrees in all.
const HALF_VIEW: f64 = 0.466_307_658_155;

/// What is nearer to the eye is not drawn, m.
const NEAR_M: f64 = 0.3;

/// Light of the sun and where it comes from, of the sky above and of the ground below.
const SUN: ([f64; 3], [f64; 3]) = ([-0.45, -0.55, 0.70], [1.35, 1.28, 1.15]);
const ABOVE: [f64; 3] = [0.55, 0.65, 0.80];
const BELOW: [f64; 3] = [0.22, 0.20, 0.17];

/// The sky at the horizon, into which everything fades, and overhead.
const HORIZON: [f64; 3] = [0.70, 0.78, 0.86];
const ZENITH: [f64; 3] = [0.20, 0.38, 0.68];

/// Half of the light is the sky's at so many distances of what is looked at, and no nearer than so many metres.
const HAZE: f64 = 8.0;
const HAZE_M: f64 = 6000.0;

/// The picture of a network as a PNG file of this width and height, px.
///
/// # Errors
/// When a side has no pixels or more than [`MOST_PIXELS`], or the picture cannot be packed.
pub fn encode_drive_picture(export: &DriveExport<'_>, view: DriveView, size: [usize; 2]) -> Result<Vec<u8>, Error> {
    if !size.iter().all(|side| (1..=MOST_PIXELS).contains(side)) {
        let problem = format!("its size is {} × {} px; each side has 1 to {MOST_PIXELS}", size[0], size[1]);
        return Err(Error::Unwritable { format: "PNG", place: "the picture".into(), problem });
    }
    let scene = Scene::of(export.state, export.results, &SceneOptions::default());
    let mut canvas = Canvas::new(Lens::new(&view.camera(export), size), size);
    for part in &scene.parts {
        canvas.draw(part, &|v| v, &|n| n);
    }
    for piece in &scene.instances {
        for placement in &piece.at {
            let turn = turned(placement);
            let [x, y, z] = placement.position;
            let placed = |v: [f64; 3]| {
                let [a, b, c] = turn(v).map(|t| t * placement.scale);
                [x + a, y + b, z + c]
            };
            piece.parts.iter().for_each(|part| canvas.draw(part, &placed, &turn));
        }
    }
    to_png(&canvas.light, canvas.width, SAMPLES)
}

/// Turns a vector of a piece as its placement says: nose up first, then about the upright.
fn turned(placement: &Placement) -> impl Fn([f64; 3]) -> [f64; 3] {
    let ((sh, ch), (sp, cp)) = (trig::sin_cos(placement.heading_rad), trig::sin_cos(placement.pitch_rad));
    move |[x, y, z]| {
        let (x, z) = (cp * x - sp * z, sp * x + cp * z);
        [ch * x - sh * y, sh * x + ch * y, z]
    }
}

/// A camera on a picture.
struct Lens {
    eye: [f64; 3],
    /// To the right, up and forward, each of length 1.
    axes: [[f64; 3]; 3],
    /// Samples for a tangent of 1.
    scale: f64,
    middle: [f64; 2],
    /// Distance of what is looked at, m.
    distance: f64,
}

impl Lens {
    fn new(camera: &Camera, size: [usize; 2]) -> Self {
        let towards = minus(camera.target, camera.eye);
        let forward = normalised(towards);
        let right = normalised(cross(forward, camera.up));
        let samples = size.map(|side| (side * SAMPLES) as f64);
        Self {
            eye: camera.eye,
            axes: [right, cross(right, forward), forward],
            scale: 0.5 * samples[0].min(samples[1]) / HALF_VIEW,
            middle: samples.map(|side| 0.5 * side),
            distance: dot(towards, towards).sqrt(),
        }
    }

    /// A place as seen from the eye: to the right, up, and away, m.
    fn seen(&self, place: [f64; 3]) -> [f64; 3] {
        let from_eye = minus(place, self.eye);
        self.axes.map(|axis| dot(axis, from_eye))
    }

    /// A seen place in samples from the upper left, and how near it is, 1/m.
    fn placed(&self, [right, up, away]: [f64; 3]) -> [f64; 3] {
        let k = self.scale / away;
        [self.middle[0] + k * right, self.middle[1] - k * up, 1.0 / away]
    }

    /// The sky behind a row of samples.
    fn sky(&self, row: usize) -> [f32; 3] {
        let up = (self.middle[1] - (row as f64 + 0.5)) / self.scale;
        let [_, above, forward] = self.axes;
        let rise = normalised([0, 1, 2].map(|k| forward[k] + up * above[k]))[2].clamp(0.0, 1.0).sqrt();
        [0, 1, 2].map(|k| (HORIZON[k] + (ZENITH[k] - HORIZON[k]) * rise) as f32)
    }
}

/// A corner of a triangle: where it is seen, and its light.
#[derive(Clone, Copy)]
struct Corner {
    seen: [f64; 3],
    light: [f64; 3],
}

/// Samples with their depths and light.
struct Canvas {
    lens: Lens,
    width: usize,
    height: usize,
    near: Vec<f32>,
    light: Vec<[f32; 3]>,
}

impl Canvas {
    fn new(lens: Lens, size: [usize; 2]) -> Self {
        let [width, height] = size.map(|side| side * SAMPLES);
        let light = (0..height).flat_map(|row| std::iter::repeat_n(lens.sky(row), width)).collect();
        Self { lens, width, height, near: vec![0.0; width * height], light }
    }

    fn draw(&mut self, part: &Part, placed: &dyn Fn([f64; 3]) -> [f64; 3], turned: &dyn Fn([f64; 3]) -> [f64; 3]) {
        let colour = look(part.finish).colour;
        let vertices = part.mesh.vertices.iter().zip(&part.mesh.normals);
        let corners: Vec<Corner> = vertices
            .map(|(v, n)| {
                let place = placed(*v);
                Corner { seen: self.lens.seen(place), light: self.lit(colour, place, turned(*n)) }
            })
            .collect();
        for triangle in &part.mesh.triangles {
            self.clipped(triangle.map(|i| corners[i as usize]));
        }
    }

    /// Light from a place.
    fn lit(&self, colour: [f64; 3], place: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
        let to_eye = minus(self.lens.eye, place);
        // Thin things have one side only, and are seen from both.
        let normal = if dot(normal, to_eye) < 0.0 { normal.map(|x| -x) } else { normal };
        let sun = dot(normal, normalised(SUN.0)).max(0.0);
        let up = 0.5 + 0.5 * normal[2];
        let share = 1.0 / (1.0 + (HAZE * self.lens.distance).max(HAZE_M) / dot(to_eye, to_eye).sqrt().max(1e-9));
        [0, 1, 2].map(|k| {
            let own = colour[k] * (SUN.1[k] * sun + BELOW[k] + (ABOVE[k] - BELOW[k]) * up);
            own + (HORIZON[k] - own) * share
        })
    }

    /// What of a triangle lies before the eye.
    fn clipped(&mut self, corners: [Corner; 3]) {
        let mut inside: Vec<Corner> = Vec::with_capacity(4);
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            if a.seen[2] >= NEAR_M {
                inside.push(a);
            }
            if (a.seen[2] >= NEAR_M) != (b.seen[2] >= NEAR_M) {
                let t = (NEAR_M - a.seen[2]) / (b.seen[2] - a.seen[2]);
                let mix = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k]));
                inside.push(Corner { seen: mix(a.seen, b.seen), light: mix(a.light, b.light) });
            }
        }
        for i in 2..inside.len() {
            self.fill([inside[0], inside[i - 1], inside[i]]);
        }
    }

    fn fill(&mut self, corners: [Corner; 3]) {
        let p = corners.map(|c| self.lens.placed(c.seen));
        let turn = turn(p);
        if turn == 0.0 || !turn.is_finite() {
            return;
        }
        let (nearest, light) = (&mut self.near, &mut self.light);
        covered(p, turn, [self.width, self.height], |sample, weights| {
            // On the picture 1/distance is linear, and light times it.
            let near = (0..3).map(|i| weights[i] * p[i][2]).sum::<f64>();
            if near as f32 > nearest[sample] {
                nearest[sample] = near as f32;
                light[sample] = [0, 1, 2]
                    .map(|k| ((0..3).map(|i| weights[i] * p[i][2] * corners[i].light[k]).sum::<f64>() / near) as f32);
            }
        });
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
