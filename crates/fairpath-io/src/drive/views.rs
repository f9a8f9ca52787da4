//! From where a network is seen: what there is of it comes in, a camera goes out.

use super::export::DriveExport;
use fairpath_curve::Point;
use fairpath_drive::{Camera, CameraTrack, PathResult, drive};

/// From where a picture of a network is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DriveView {
    /// All of it, from high above.
    Birdseye,
    /// The middle of it, from half as far and lower.
    Midway,
    /// What there is to see first: a bridge, a tunnel or an intersection, from near by.
    Closeup,
    /// From the driver's seat, in the middle of the first path.
    Driver,
}

/// From how far a sphere is seen whole, in its radii.
const WHOLE: f64 = 2.1;

/// Distance of a close view, m.
const CLOSE_M: f64 = 90.0;

/// No eye is lower over the ground, m.
const LEAST_HEIGHT_M: f64 = 3.0;

impl DriveView {
    /// The camera; of a network without paths the terrain is seen.
    pub(super) fn camera(self, export: &DriveExport<'_>) -> Camera {
        let (centre, radius) = extent(export);
        match self {
            Self::Birdseye => from(export, centre, WHOLE * radius, 50.0),
            Self::Midway => from(export, centre, 0.5 * WHOLE * radius, 30.0),
            Self::Closeup => from(export, sight(export).unwrap_or(centre), CLOSE_M.min(WHOLE * radius), 22.0),
            Self::Driver => driver(export).unwrap_or_else(|| from(export, centre, WHOLE * radius, 50.0)),
        }
    }
}

/// A camera to the south-west of a target, at this distance and this many degrees above it.
fn from(export: &DriveExport<'_>, target: [f64; 3], distance: f64, degrees: f64) -> Camera {
    let (sin, cos) = fairpath_curve::trig::sin_cos(degrees.to_radians());
    let aside = distance * cos * std::f64::consts::FRAC_1_SQRT_2;
    let eye = Point::new(target[0] - 0.8 * aside, target[1] - 1.2 * aside);
    let least = export.results.ground.height(eye) + LEAST_HEIGHT_M;
    Camera { eye: [eye.x, eye.y, (target[2] + distance * sin).max(least)], target, up: [0.0, 0.0, 1.0] }
}

/// The middle of all paths, or of the terrain, and the radius of a sphere around them, m.
fn extent(export: &DriveExport<'_>) -> ([f64; 3], f64) {
    let paths = &export.results.paths;
    let plans = paths.iter().map(|p| p.path.plan.bounding_box());
    let field = export.results.ground.natural();
    let whole = fairpath_curve::Rect::from_points(field.corner(), field.far_corner());
    let around = plans.reduce(|a, b| a.union(b)).unwrap_or(whole);
    let heights = paths.iter().flat_map(|p| p.profile.knots()).map(|knot| knot.height_m);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), z| (a.min(z), b.max(z)));
    let middle = if low <= high { 0.5 * (low + high) } else { export.results.ground.height(around.center()) };
    let radius = 0.5 * around.width().hypot(around.height()).hypot((high - low).max(0.0));
    ([around.center().x, around.center().y, middle], radius.max(20.0))
}

/// The first bridge or tunnel's mouth, or the first intersection.
fn sight(export: &DriveExport<'_>) -> Option<[f64; 3]> {
    let at = |path: &PathResult, station: f64| {
        let place = path.path.plan.point_at(station);
        [place.x, place.y, path.profile.at(station).height_m]
    };
    let structure = export.results.paths.iter().find_map(|p| Some(at(p, p.structures.first()?.from_m)));
    let crossing = || {
        let place = export.results.crossings.first()?.first;
        Some(at(export.results.path(place.path)?, place.station_m))
    };
    let middle = || export.results.paths.first().map(|p| at(p, 0.5 * p.path.length_m()));
    structure.or_else(crossing).or_else(middle)
}

/// Through the eyes of whoever drives in the middle of the first path.
fn driver(export: &DriveExport<'_>) -> Option<Camera> {
    let path = export.results.paths.first()?;
    let length = path.path.length_m();
    let driven = drive(export.results, path.path.id, [0.0, length], false, 1.0).ok()?;
    let moment = driven.moments.iter().find(|m| m.driven_m >= 0.5 * length).or(driven.moments.last())?;
    Some(CameraTrack::Driver.at(moment))
}
