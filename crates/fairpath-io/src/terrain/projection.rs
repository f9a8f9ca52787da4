//! Points of a terrain as longitudes and latitudes of WGS 84, and back.

use fairpath_curve::Point;
use fairpath_drive::GeoReference;
use proj4rs::Proj;
use proj4rs::adaptors::transform_xy;
use thiserror::Error;

/// Why a place of a terrain has no place on the globe, or the other way round.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProjectionError {
    /// The projection's text is none that can be computed.
    #[error(
        "the projection {projection:?} cannot be computed: {problem}; expected a PROJ string in metres, such as +proj=utm +zone=31 +datum=WGS84 +units=m"
    )]
    Unknown {
        /// The text.
        projection: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The place lies where the projection has none.
    #[error("the place {place:?} has no counterpart in {projection:?}: {problem}; is it of another terrain?")]
    Beyond {
        /// The text of the projection.
        projection: String,
        /// Metres of the terrain, or longitude and latitude, degrees.
        place: [f64; 2],
        /// What is wrong with it.
        problem: String,
    },
}

/// Takes points of one terrain to the globe and back; made once for many points.
///
/// A point there and back again is the same within a micrometre. That a datum's shift loses the height, and with it millimetres, is made up for: [`point`](Self::point)
/// is the inverse of [`longitude_latitude`](Self::longitude_latitude), which has the point on the datum's own ellipsoid. Datums are shifted by their three or seven
/// parameters, where grids of corrections would tell metres more. Transverse Mercators, UTM among them, are series of the sixth order.
#[derive(Debug)]
pub struct Projector {
    projection: String,
    plane: Proj,
    globe: Proj,
    origin_m: [f64; 2],
}

impl Projector {
    /// The projector of a terrain that lies there.
    ///
    /// # Errors
    /// When the projection cannot be computed or is not in metres, or the origin is not finite.
    pub fn new(reference: &GeoReference) -> Result<Self, ProjectionError> {
        Self::between(&reference.projection, super::hgt::WGS84, reference.origin_m)
    }

    /// From a plane to longitudes and latitudes of that datum instead of WGS 84.
    pub(super) fn between(projection: &str, globe: &str, origin_m: [f64; 2]) -> Result<Self, ProjectionError> {
        let unknown = |problem: String| ProjectionError::Unknown { projection: projection.to_owned(), problem };
        if !origin_m.iter().all(|m| m.is_finite()) {
            return Err(unknown(format!("its origin {origin_m:?} is not finite")));
        }
        let plane = parsed(projection).map_err(unknown)?;
        let globe = parsed(globe).map_err(unknown)?;
        if plane.is_latlong() || plane.is_geocent() || !globe.is_latlong() {
            return Err(unknown("it is no projection to a plane".into()));
        }
        if plane.to_meter() != 1.0 {
            return Err(unknown(format!("its unit is {} m", plane.to_meter())));
        }
        if !(plane.has_inverse() && plane.has_forward()) {
            return Err(unknown("it is known in one direction only".into()));
        }
        Ok(Self { projection: projection.to_owned(), plane, globe, origin_m })
    }

    /// Longitude and latitude of a point of the terrain, degrees.
    ///
    /// # Errors
    /// When the projection has no such place.
    pub fn longitude_latitude(&self, point: Point) -> Result<[f64; 2], ProjectionError> {
        let [east, north] = [self.origin_m[0] + point.x, self.origin_m[1] + point.y];
        let place = [point.x, point.y];
        let (longitude, latitude) = self.finite(transform_xy(&self.plane, &self.globe, east, north), place)?;
        Ok([longitude.to_degrees(), latitude.to_degrees()])
    }

    /// The point of the terrain at a longitude and latitude, degrees.
    ///
    /// # Errors
    /// When the projection has no such place.
    pub fn point(&self, [longitude, latitude]: [f64; 2]) -> Result<Point, ProjectionError> {
        let place = [longitude, latitude];
        let (lambda, phi) = (longitude.to_radians(), latitude.to_radians());
        let there = self.finite(transform_xy(&self.globe, &self.plane, lambda, phi), place)?;
        let back = self.finite(transform_xy(&self.plane, &self.globe, there.0, there.1), place)?;
        let again = self.finite(transform_xy(&self.globe, &self.plane, back.0, back.1), place)?;
        let [east, north] = [2.0 * there.0 - again.0, 2.0 * there.1 - again.1];
        Ok(Point::new(east - self.origin_m[0], north - self.origin_m[1]))
    }

    /// What came out, if it is a place.
    fn finite(
        &self,
        found: Result<(f64, f64), proj4rs::errors::Error>,
        place: [f64; 2],
    ) -> Result<(f64, f64), ProjectionError> {
        let beyond = |problem: String| ProjectionError::Beyond { projection: self.projection.clone(), place, problem };
        match found {
            Ok((x, y)) if x.is_finite() && y.is_finite() => Ok((x, y)),
            Ok(_) => Err(beyond("it is not finite".into())),
            Err(error) => Err(beyond(error.to_string())),
        }
    }
}

/// The projection of a text. The transverse Mercator is computed by its accurate series: the short one is off by millimetres at the edges of a zone. Grids of
/// corrections would have to be read from files, which a text may not bring about.
fn parsed(text: &str) -> Result<Proj, String> {
    if text.split_ascii_whitespace().any(|word| word.starts_with("+nadgrids=") && word != "+nadgrids=@null") {
        return Err("grids of corrections are not read; give +towgs84 instead".into());
    }
    let words = text.split_ascii_whitespace().map(|word| if word == "+proj=tmerc" { "+proj=etmerc" } else { word });
    Proj::from_proj_string(&words.collect::<Vec<_>>().join(" ")).map_err(|error| error.to_string())
}

/// Longitude and latitude, WGS 84, of a point of a terrain, degrees. For many points, keep a [`Projector`].
///
/// # Errors
/// As [`Projector::new`] and [`Projector::longitude_latitude`].
pub fn longitude_latitude(reference: &GeoReference, point: Point) -> Result<[f64; 2], ProjectionError> {
    Projector::new(reference)?.longitude_latitude(point)
}

/// The point of a terrain at a longitude and latitude of WGS 84, degrees. For many points, keep a [`Projector`].
///
/// # Errors
/// As [`Projector::new`] and [`Projector::point`].
pub fn point_at(reference: &GeoReference, place: [f64; 2]) -> Result<Point, ProjectionError> {
    Projector::new(reference)?.point(place)
}
