//! Cutting a curve into parts.

use super::{EditError, check_station};
use fairpath_curve::Spline;

/// The parts of a curve between cuts at `stations`, in order: one more than cuts of an open curve, as many as cuts of a closed one, the first of
/// which begins at the first cut. Stations of a closed curve may lie beyond its ends.
///
/// Segments that are not cut keep their bits.
///
/// # Errors
/// When a station is not on the curve, or two cuts leave nothing between them; `stations` that are empty give the curve itself.
pub fn cut(spline: &Spline, stations: &[f64]) -> Result<Vec<Spline>, EditError> {
    let length = spline.length();
    let mut cuts = Vec::with_capacity(stations.len() + 2);
    for &station in stations {
        check_station(spline, station)?;
        cuts.push(if spline.is_closed() { station.rem_euclid(length) } else { station });
    }
    if cuts.is_empty() {
        return Ok(vec![spline.clone()]);
    }
    cuts.sort_by(f64::total_cmp);
    if spline.is_closed() {
        cuts.push(cuts[0] + length);
    } else {
        cuts.insert(0, 0.0);
        cuts.push(length);
    }
    cuts.windows(2)
        .map(|ends| spline.subspline(ends[0], ends[1]).ok_or(EditError::EmptyPart { station: ends[0] }))
        .collect()
}
