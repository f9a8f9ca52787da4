//! What can be drawn: writers that approximate refuse curves whose approximation would have no end.

use crate::error::Error;
use crate::spline_file::SplineFile;

/// Most turning of one spline that is drawn, radians: some 16,000 full turns.
const MAX_TURNING: f64 = 1e5;
/// Largest coordinate that is drawn: beyond it, squares overflow.
const MAX_COORDINATE: f64 = 1e60;

/// Every spline of the file can be approximated by finitely many Béziers or arcs.
pub(crate) fn check_drawable(file: &SplineFile, format: &'static str) -> Result<(), Error> {
    for entry in &file.splines {
        let segments = entry.spline.segments();
        let turning: f64 = segments.iter().map(|s| s.absolute_turning()).sum();
        let far = segments.iter().any(|s| s.start.x.abs().max(s.start.y.abs()).max(s.length) > MAX_COORDINATE);
        let problem = if !(turning <= MAX_TURNING) {
            format!(
                "it turns by {turning:e} rad, more than the {MAX_TURNING:e} rad that can be drawn; write JSON or CSV"
            )
        } else if far {
            format!("it reaches beyond ±{MAX_COORDINATE:e}; write JSON or CSV")
        } else {
            continue;
        };
        return Err(Error::Unwritable { format, place: format!("spline {:?}", entry.name), problem });
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
