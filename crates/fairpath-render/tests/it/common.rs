//! A device, balls, and where rays of light say that they appear: worked out in f64 from the meaning of a camera's angles alone.

use fairpath_curve::{Continuity, Point, Segment, Spline};
use fairpath_render::{Adapter, Camera, DVec3, Offscreen, Picture};
use fairpath_shape::{InflateOptions, Mesh, inflate};
use std::f64::consts::{PI, TAU};

/// A device in software, whose pictures are the same on every machine, or else any.
pub(crate) fn offscreen() -> Offscreen {
    let offscreen = Offscreen::new(Adapter::Software).or_else(|_| Offscreen::new(Adapter::Best));
    let offscreen = offscreen.unwrap_or_else(|error| panic!("{error}"));
    println!("drawn by {}", offscreen.adapter());
    offscreen
}

/// A ball in the coordinates of a drawing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub(crate) centre: [f64; 3],
    pub(crate) radius: f64,
}

impl Ball {
    pub(crate) const fn new(x: f64, y: f64, z: f64, radius: f64) -> Self {
        Self { centre: [x, y, z], radius }
    }

    /// The ball as an inflated circle.
    pub(crate) fn mesh(&self) -> Mesh {
        let [x, y, z] = self.centre;
        let arc = Segment::arc(Point::new(x + self.radius, y), PI / 2.0, self.radius * TAU, 1.0 / self.radius);
        let circle = Spline::new(vec![arc], vec![Continuity::G1], true).expect("it is a circle");
        let mut mesh = inflate(&circle, &InflateOptions::default()).expect("circles can be inflated").mesh;
        mesh.vertices.iter_mut().for_each(|v| v[2] += z);
        mesh
    }

    /// Distance along the ray to where it enters the ball.
    pub(crate) fn entered(&self, eye: DVec3, ray: DVec3) -> Option<f64> {
        let away = eye - DVec3::from(self.centre);
        let (b, c) = (away.dot(ray), away.length_squared() - self.radius * self.radius);
        let discriminant = b * b - c;
        (discriminant >= 0.0).then(|| -b - discriminant.sqrt())
    }
}

/// Where the camera stands, and the direction in which it sees a place of the picture, px from the upper left corner.
pub(crate) fn ray(camera: &Camera, size_px: [u32; 2], x: f64, y: f64) -> (DVec3, DVec3) {
    let (a, e) = (camera.azimuth_rad(), camera.elevation_rad());
    let back = DVec3::new(a.sin() * e.cos(), e.sin(), a.cos() * e.cos());
    let right = DVec3::new(a.cos(), 0.0, -a.sin());
    let up = DVec3::new(-a.sin() * e.sin(), e.cos(), -a.cos() * e.sin());
    let [width, height] = size_px.map(f64::from);
    let unit = 2.0 * (0.5 * Camera::FIELD_OF_VIEW_RAD).tan() / height;
    let direction = right * ((x - 0.5 * width) * unit) - up * ((y - 0.5 * height) * unit) - back;
    (camera.target() + camera.distance() * back, direction.normalize())
}

/// Colour of a pixel.
pub(crate) fn pixel(picture: &Picture, x: u32, y: u32) -> [u8; 3] {
    let at = 4 * (y as usize * picture.size_px[0] as usize + x as usize);
    [picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]]
}
