//! From a stroke as the device gave it to a polyline in pixels: finite, without repeated points, near the origin, and never
//! denser than the fit can use.

use crate::result::FitError;
use fairpath_curve::{Point, Vec2};

/// Points nearer than this to the one before are repetitions, px.
const REPEATED: f64 = 1e-3;

/// Points denser than this are averaged, px: half of the smallest distance of samples, so nothing is lost to the fit.
const DENSEST: f64 = 1.0;

/// A stroke in pixels about a local origin.
#[derive(Clone, Debug)]
pub(crate) struct Cleaned {
    pub(crate) points: Vec<Vec2>,
    /// Where the local origin is in the stroke's frame.
    pub(crate) origin: Point,
    /// Pixels are multiplied by this to give the stroke's unit.
    pub(crate) scale: f64,
}

impl Cleaned {
    /// A position in pixels in the stroke's frame.
    pub(crate) fn restore(&self, p: Vec2) -> Point {
        self.origin + p * self.scale
    }

    /// A position of the stroke's frame in pixels.
    pub(crate) fn localize(&self, p: Point) -> Vec2 {
        (p - self.origin) / self.scale
    }
}

/// The stroke's points in pixels.
///
/// # Errors
/// When a coordinate is not finite, or all points are equal.
pub(crate) fn clean(points: &[Point], pixel_size: f64) -> Result<Cleaned, FitError> {
    if let Some(index) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(FitError::NotFinite { index });
    }
    let (mut low, mut high) =
        (Point::new(f64::INFINITY, f64::INFINITY), Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    for p in points {
        low = Point::new(low.x.min(p.x), low.y.min(p.y));
        high = Point::new(high.x.max(p.x), high.y.max(p.y));
    }
    let size = high - low;
    let extent = size.x.max(size.y);
    // Written so that an overflow of the size to infinity fails too.
    if points.is_empty() || !(extent > REPEATED * pixel_size && extent / pixel_size < LARGEST) {
        return Err(if extent / pixel_size >= LARGEST {
            FitError::TooLarge { extent, largest: LARGEST * pixel_size }
        } else {
            FitError::TooShort { points: points.len(), extent: extent.max(0.0) }
        });
    }
    let origin = low + size * 0.5;
    let local = points.iter().map(|p| (*p - origin) / pixel_size);
    let mut distinct: Vec<Vec2> = Vec::with_capacity(points.len());
    for p in local {
        if distinct.last().is_none_or(|last| (p - *last).hypot2() > REPEATED * REPEATED) {
            distinct.push(p);
        }
    }
    Ok(Cleaned { points: thin(&distinct), origin, scale: pixel_size })
}

/// Drawings larger than this cannot be resolved in double precision at a thousandth of a pixel, px.
const LARGEST: f64 = 1e9;

/// Averages neighbours where the points lie denser than [`DENSEST`]; the ends stay.
fn thin(points: &[Vec2]) -> Vec<Vec2> {
    let n = points.len();
    let spacing: f64 = points.windows(2).map(|p| distance(p[0], p[1])).sum::<f64>() / (n.max(2) - 1) as f64;
    if n < 8 || spacing >= DENSEST {
        return points.to_vec();
    }
    let mut out = vec![points[0]];
    let (mut sum, mut count, mut length) = (Vec2::ZERO, 0.0, 0.0);
    for pair in points.windows(2).take(n - 2) {
        sum += pair[1];
        count += 1.0;
        length += distance(pair[0], pair[1]);
        if length >= DENSEST {
            out.push(sum / count);
            (sum, count, length) = (Vec2::ZERO, 0.0, 0.0);
        }
    }
    out.push(points[n - 1]);
    out
}

#[inline]
pub(crate) fn distance(a: Vec2, b: Vec2) -> f64 {
    (b - a).hypot2().sqrt()
}
