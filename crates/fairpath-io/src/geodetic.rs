//! Longitudes and latitudes of WGS 84 as metres in a plane about the middle of the drawing, x to the east and y to the north.
//!
//! Transverse Mercator about the middle longitude, unscaled, by Krüger's series (Karney 2011, "Transverse Mercator with an accuracy of
//! a few nanometers", to the fourth order): angles are true everywhere, lengths on the middle meridian. At a distance d east or west of
//! it lengths are too long by the share d²/2R², R = 6378 km: 3e-5 at 50 km.

use crate::error::Fault;
use crate::stroke_file::StrokeFile;
use crate::unit::{Unit, YAxis};
use fairpath_curve::Point;
use fairpath_fit::Warning;

/// Longitude and latitude, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) longitude: f64,
    pub(crate) latitude: f64,
}

impl Place {
    /// A place on the globe, or what is wrong with it.
    pub(crate) fn new(longitude: f64, latitude: f64, at: impl Fn() -> String) -> Result<Self, Fault> {
        if !(-90.0..=90.0).contains(&latitude) {
            let problem = format!(
                "latitude {latitude} is not within -90 and 90 degrees; are latitude and longitude swapped, or in metres?"
            );
            return Err(Fault::new(at(), problem));
        }
        if !(-360.0..=360.0).contains(&longitude) {
            let problem = format!("longitude {longitude} is not within -360 and 360 degrees; give degrees of WGS 84");
            return Err(Fault::new(at(), problem));
        }
        Ok(Self { longitude, latitude })
    }
}

/// Semi-major axis of WGS 84, metres, and its third flattening.
const EQUATOR_M: f64 = 6_378_137.0;
const THIRD_FLATTENING: f64 = 0.001_679_220_386_383_705;

/// Further than this from the middle meridian lengths are off by more than three in a thousand, metres.
const FAR_M: f64 = 500_000.0;

/// At 90 degrees from the middle meridian the projection has a pole.
const WIDEST_DEGREES: f64 = 60.0;

/// Puts the places of each stroke, in the strokes' order, into the file as points.
///
/// # Errors
/// When they reach further round the globe than a plane can show.
pub(crate) fn project(file: &mut StrokeFile, places: &[Vec<Place>]) -> Result<(), Fault> {
    (file.unit, file.y) = (Unit::M, YAxis::Up);
    let Some(&first) = places.iter().flatten().next() else { return Ok(()) };
    // East of the first place, so that a track may cross the 180th meridian.
    let east = |p: &Place| wrapped(p.longitude - first.longitude);
    let middle = |value: &dyn Fn(&Place) -> f64| {
        let values = || places.iter().flatten().map(value);
        0.5 * (values().fold(f64::INFINITY, f64::min) + values().fold(f64::NEG_INFINITY, f64::max))
    };
    // Rounded, so that the text below says exactly what was done.
    let rounded = |degrees: f64| (1e6 * degrees).round() / 1e6;
    let longitude0 = rounded(wrapped(first.longitude + middle(&east)));
    let latitude0 = rounded(middle(&|p| p.latitude));
    let east = |p: &Place| wrapped(p.longitude - longitude0);
    let north0 = transverse_mercator(0.0, latitude0).y;
    let mut farthest = 0.0_f64;
    for (stroke, places) in file.strokes.iter_mut().zip(places) {
        for place in places {
            if east(place).abs() > WIDEST_DEGREES {
                let problem = "the lines reach further round the globe than one plane can show; split the file";
                return Err(Fault::new(format_args!("stroke {:?}", stroke.name), problem));
            }
            let p = transverse_mercator(east(place), place.latitude);
            farthest = farthest.max(p.x.abs());
            stroke.points.push(Point::new(p.x, p.y - north0));
        }
    }
    let mut text =
        format!("projected to metres about longitude {longitude0}, latitude {latitude0} (transverse Mercator, WGS 84)");
    if farthest > FAR_M {
        let share = 50.0 * (farthest / EQUATOR_M).powi(2);
        text.push_str(&format!(
            "; it reaches {:.0} km to the side, where lengths are {share:.1} % too long: split it",
            farthest / 1e3
        ));
    }
    file.warnings.push(Warning { code: "projected".into(), text });
    Ok(())
}

/// Degrees within -180 and 180.
pub(crate) fn wrapped(degrees: f64) -> f64 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}

/// Metres east of a meridian and north of the equator.
fn transverse_mercator(east_degrees: f64, latitude_degrees: f64) -> Point {
    let n = THIRD_FLATTENING;
    let (n2, n3, n4) = (n * n, n * n * n, n * n * n * n);
    let radius = EQUATOR_M / (1.0 + n) * (1.0 + n2 / 4.0 + n4 / 64.0);
    let alpha = [
        n / 2.0 - 2.0 * n2 / 3.0 + 5.0 * n3 / 16.0 + 41.0 * n4 / 180.0,
        13.0 * n2 / 48.0 - 3.0 * n3 / 5.0 + 557.0 * n4 / 1440.0,
        61.0 * n3 / 240.0 - 103.0 * n4 / 140.0,
        49_561.0 * n4 / 161_280.0,
    ];
    let (phi, lambda) = (latitude_degrees.to_radians(), east_degrees.to_radians());
    let e = 2.0 * n.sqrt() / (1.0 + n);
    // Conformal latitude, by its tangent; a pole's is finite in double precision.
    let tau = phi.tan();
    let sigma = (e * (e * tau / tau.hypot(1.0)).atanh()).sinh();
    let conformal = tau * sigma.hypot(1.0) - sigma * tau.hypot(1.0);
    let xi = conformal.atan2(lambda.cos());
    let eta = (lambda.sin() / conformal.hypot(lambda.cos())).asinh();
    let (mut x, mut y) = (eta, xi);
    for (k, a) in alpha.iter().enumerate() {
        let m = 2.0 * (k + 1) as f64;
        y += a * (m * xi).sin() * (m * eta).cosh();
        x += a * (m * xi).cos() * (m * eta).sinh();
    }
    Point::new(radius * x, radius * y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metres_agree_with_published_utm_coordinates() {
        // UTM is the same projection scaled by 0.9996 about 500 km. The CN Tower, zone 17 (central meridian 81° W).
        let p = transverse_mercator(-79.387_139 + 81.0, 43.642_567);
        assert!((0.9996 * p.x + 500_000.0 - 630_084.0).abs() < 1.0, "{p:?}");
        assert!((0.9996 * p.y - 4_833_438.0).abs() < 1.0, "{p:?}");
    }

    #[test]
    fn a_quarter_meridian_is_10_001_965_729_m_in_mm() {
        assert!((transverse_mercator(0.0, 90.0).y - 10_001_965.729).abs() < 1e-3);
    }

    #[test]
    fn a_second_of_longitude_is_as_long_as_the_parallel_says() {
        for latitude in [0.0, 30.0, -60.0, 89.0_f64] {
            let (sin, cos) = latitude.to_radians().sin_cos();
            let e2 = 4.0 * THIRD_FLATTENING / (1.0 + THIRD_FLATTENING).powi(2);
            let parallel = EQUATOR_M * cos / (1.0 - e2 * sin * sin).sqrt() * (1.0_f64 / 3600.0).to_radians();
            let metres = transverse_mercator(1.0 / 3600.0, latitude).x;
            assert!((metres - parallel).abs() < 1e-8 * parallel, "{latitude}: {metres} but {parallel}");
        }
    }
}
