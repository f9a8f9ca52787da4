//! An orbit camera: what is looked at, from how far and from where comes in; the matrices that draw it so go out.
//!
//! Three frames, all right-handed. The *world* has x to the right, y up and z out of the drawing, towards who looks at it from the front.
//! The *view* has its origin in the eye, x to the right and y up on the picture and z backwards, away from what is seen. *Clip* is that of WebGPU, with the
//! depth reversed: 1 at the nearest plane, towards 0 at infinity, which spreads the digits of f32 evenly over the distances.

use crate::bounds::Bounds;
use fairpath_curve::trig;
use glam::{DMat4, DVec3, DVec4};
use std::f64::consts::FRAC_PI_6;

/// Room around a surface that has been fitted into the picture, as a factor of its distance.
const AIR: f64 = 1.02;
/// Where new cameras stand: a little to the left (30 degrees) and above (24 degrees), as in the pictures of `fairpath inflate`.
const FIRST_AZIMUTH_RAD: f64 = -FRAC_PI_6;
const FIRST_ELEVATION_RAD: f64 = 0.418_879_020_478_639_1;
/// Steepest look from above or below, radians (89 degrees): straight down, there would be no telling where up is.
const STEEPEST_RAD: f64 = 1.553_343_034_274_953_3;
/// Least and greatest distance of the eye from its target, in radii of the subject.
const NEAREST: f64 = 0.2;
const FARTHEST: f64 = 40.0;
/// Least distance of the nearest plane from the eye, in radii of the subject. What is nearer is cut off.
const LEAST_NEAR: f64 = 0.01;
/// Least and greatest ratio of a picture's sides that is taken at its word.
const ASPECTS: [f64; 2] = [1e-3, 1e3];

/// A camera that looks at a target from a point on a sphere about it, with y up.
///
/// A plain value: each movement gives a new camera. Movements by numbers that are not finite are no movements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// What the camera was last fitted to; distances are limited in terms of it, and the target stays in it.
    subject: Bounds,
    target: DVec3,
    distance: f64,
    azimuth_rad: f64,
    elevation_rad: f64,
}

impl Default for Camera {
    /// Looks at the unit ball, from a little to the left and above.
    fn default() -> Self {
        let start = Self {
            subject: Bounds::UNIT,
            target: DVec3::ZERO,
            distance: 1.0,
            azimuth_rad: FIRST_AZIMUTH_RAD,
            elevation_rad: FIRST_ELEVATION_RAD,
        };
        start.fitted_to(&Bounds::UNIT, 1.0)
    }
}

impl Camera {
    /// Angle from the lower to the upper edge of the picture, radians (30 degrees): that of a long lens, which distorts little.
    pub const FIELD_OF_VIEW_RAD: f64 = FRAC_PI_6;

    /// The camera in the same direction from its target, but with `bounds` in the middle and whole in the picture, however it is turned afterwards.
    ///
    /// `aspect` is the picture's width over its height.
    #[must_use]
    pub fn fitted_to(self, bounds: &Bounds, aspect: f64) -> Self {
        if !(bounds.centre.is_finite() && bounds.radius.is_finite() && bounds.radius > 0.0) {
            return self;
        }
        // A ball appears within a cone whose half angle has the sine radius over distance.
        let upright = half_tangent();
        let least = upright.min(upright * sensible(aspect));
        let sine = least / (1.0 + least * least).sqrt();
        let distance = (AIR * bounds.radius / sine).min(FARTHEST * bounds.radius);
        Self { subject: *bounds, target: bounds.centre, distance, ..self }
    }

    /// The camera with the same target and distance in another direction.
    ///
    /// `azimuth_rad` turns to the right about the upright axis, `elevation_rad` goes up; with both 0 the drawing is seen straight from the front.
    /// Elevations end at ±89 degrees.
    #[must_use]
    pub fn seen_from(self, azimuth_rad: f64, elevation_rad: f64) -> Self {
        if !(azimuth_rad.is_finite() && elevation_rad.is_finite()) {
            return self;
        }
        let elevation_rad = elevation_rad.clamp(-STEEPEST_RAD, STEEPEST_RAD);
        Self { azimuth_rad: trig::wrap_angle(azimuth_rad), elevation_rad, ..self }
    }

    /// The camera after the surface was turned by hand: its front by `right_rad` to the right and by `down_rad` downwards.
    #[must_use]
    pub fn orbited(self, right_rad: f64, down_rad: f64) -> Self {
        self.seen_from(self.azimuth_rad - right_rad, self.elevation_rad + down_rad)
    }

    /// The camera nearer to its target: everything there appears `factor` times as large. From 1/5 of the subject's radius to 40 times that.
    #[must_use]
    pub fn zoomed(self, factor: f64) -> Self {
        if !(factor.is_finite() && factor > 0.0) {
            return self;
        }
        let [nearest, farthest] = [NEAREST, FARTHEST].map(|radii| radii * self.subject.radius);
        Self { distance: (self.distance / factor).clamp(nearest, farthest), ..self }
    }

    /// The camera moved sideways, so that what is at the target appears further `right` and `down`, in heights of the picture.
    /// The target stays within the subject's ball.
    #[must_use]
    pub fn panned(self, right: f64, down: f64) -> Self {
        if !(right.is_finite() && down.is_finite()) {
            return self;
        }
        let height = 2.0 * half_tangent() * self.distance;
        let [x, y, _] = self.axes();
        let away = self.target + (down * y - right * x) * height - self.subject.centre;
        if !away.is_finite() {
            return self;
        }
        Self { target: self.subject.centre + away.clamp_length_max(self.subject.radius), ..self }
    }

    /// The point of the world in the middle of the picture.
    #[must_use]
    pub fn target(&self) -> DVec3 {
        self.target
    }

    /// From the target to the eye, in the unit of the drawing.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Direction of the eye from the target about the upright axis, from −π to π: 0 in front, positive to the right.
    #[must_use]
    pub fn azimuth_rad(&self) -> f64 {
        self.azimuth_rad
    }

    /// Direction of the eye from the target over the horizon, within ±89 degrees.
    #[must_use]
    pub fn elevation_rad(&self) -> f64 {
        self.elevation_rad
    }

    /// Where the camera stands in the world.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.target + self.distance * self.axes()[2]
    }

    /// The eye seen from the middle of a ball, in its radii. No digits are lost to the place of the ball.
    fn local_eye(&self, bounds: &Bounds) -> DVec3 {
        ((self.target - bounds.centre) + self.distance * self.axes()[2]) / bounds.radius
    }

    /// The axes of the view in the world: right, up and backwards.
    #[must_use]
    pub fn axes(&self) -> [DVec3; 3] {
        let (sin_a, cos_a) = trig::sin_cos(self.azimuth_rad);
        let (sin_e, cos_e) = trig::sin_cos(self.elevation_rad);
        let right = DVec3::new(cos_a, 0.0, -sin_a);
        let back = DVec3::new(sin_a * cos_e, sin_e, cos_a * cos_e);
        [right, back.cross(right), back]
    }

    /// From points about the centre of `bounds`, in units of its radius, to the view in that unit.
    ///
    /// So f32 has all its digits for the surface itself, wherever it lies.
    #[must_use]
    pub fn view_from_local(&self, bounds: &Bounds) -> DMat4 {
        let eye = self.local_eye(bounds);
        let [x, y, z] = self.axes();
        let row = |axis: DVec3| axis.extend(-axis.dot(eye));
        DMat4::from_cols(row(x), row(y), row(z), DVec4::W).transpose()
    }

    /// From the view, in radii of `bounds`, to clip, for a picture `aspect` times as wide as high. All of the ball is in front of the nearest plane, if the
    /// eye is outside.
    #[must_use]
    pub fn clip_from_view(&self, bounds: &Bounds, aspect: f64) -> DMat4 {
        let near = (self.local_eye(bounds).length() - 1.0).max(LEAST_NEAR);
        let scale = 1.0 / half_tangent();
        DMat4::from_cols(
            DVec4::X * (scale / sensible(aspect)),
            DVec4::Y * scale,
            // Depth is near / distance, and the fourth coordinate is the distance, −z.
            DVec4::new(0.0, 0.0, 0.0, -1.0),
            DVec4::new(0.0, 0.0, near, 0.0),
        )
    }
}

/// Half of the picture's height at distance 1.
fn half_tangent() -> f64 {
    let (sin, cos) = trig::sin_cos(0.5 * Camera::FIELD_OF_VIEW_RAD);
    sin / cos
}

fn sensible(aspect: f64) -> f64 {
    if aspect.is_finite() { aspect.clamp(ASPECTS[0], ASPECTS[1]) } else { 1.0 }
}
