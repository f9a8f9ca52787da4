//! What can be drawn: writers that approximate refuse curves whose approximation would have no end.

use crate::error::Error;
use crate::spline_file::SplineFile;
use fairpath_curve::{Point, Spline};
use fairpath_fit::Stroke;

/// Most turning of one spline that is drawn, radians: some 16,000 full turns.
const MAX_TURNING: f64 = 1e5;
/// Most turning of all splines of a file together, radians: a few million Béziers.
const MAX_TURNING_OF_ALL: f64 = 1e7;
/// Largest coordinate that is drawn: beyond it, squares overflow.
const MAX_COORDINATE: f64 = 1e60;

/// Says which splines of a file can be drawn, one after the other.
#[derive(Default)]
pub(crate) struct Drawable {
    /// Turning of all that were admitted, radians.
    turning: f64,
}

impl Drawable {
    /// Why the spline cannot be drawn, if so.
    fn obstacle(&mut self, spline: &Spline) -> Option<String> {
        let segments = spline.segments();
        let turning: f64 = segments.iter().map(|s| s.absolute_turning()).sum();
        if turning.is_nan() || turning > MAX_TURNING {
            return Some(format!("it turns by {turning:e} rad, more than the {MAX_TURNING:e} rad that can be drawn"));
        }
        if self.turning + turning > MAX_TURNING_OF_ALL {
            return Some(format!(
                "with it, the file turns by more than the {MAX_TURNING_OF_ALL:e} rad that can be drawn"
            ));
        }
        let near = |v: f64| v.abs() < MAX_COORDINATE;
        if !segments.iter().all(|s| near(s.start.x) && near(s.start.y) && near(s.length)) {
            return Some(format!("it reaches beyond ±{MAX_COORDINATE:e}"));
        }
        self.turning += turning;
        None
    }

    /// Whether the spline can be approximated by finitely many Béziers or arcs.
    pub(crate) fn admits(&mut self, spline: &Spline) -> bool {
        self.obstacle(spline).is_none()
    }
}

/// The points of a stroke that a page can show.
pub(crate) fn drawable_points(stroke: &Stroke) -> impl Iterator<Item = Point> + '_ {
    stroke.points.iter().copied().filter(|p| p.x.abs() < MAX_COORDINATE && p.y.abs() < MAX_COORDINATE)
}

/// Every spline of the file can be drawn.
pub(crate) fn check_drawable(file: &SplineFile, format: &'static str) -> Result<(), Error> {
    let mut drawable = Drawable::default();
    for entry in &file.splines {
        if let Some(obstacle) = drawable.obstacle(&entry.spline) {
            let problem = format!("{obstacle}; write JSON or CSV");
            return Err(Error::Unwritable { format, place: format!("spline {:?}", entry.name), problem });
        }
    }
    Ok(())
}

/// A tolerance is positive and finite.
pub(crate) fn check_tolerance(tolerance: f64, format: &'static str) -> Result<(), Error> {
    if tolerance > 0.0 && tolerance.is_finite() {
        return Ok(());
    }
    let problem = format!("the tolerance is {tolerance}; give a positive number of the file's units, such as 0.01");
    Err(Error::Unwritable { format, place: "the options".into(), problem })
}
