//! What a curve is fitted to after it was edited: its stroke, the old curve and the new one come in, a stroke goes out that fits the new one, so that
//! another place on the slider does not undo the edit.

use fairpath_curve::{Point, Spline};
use fairpath_fit::Stroke;

/// Distance of the points that stand for a part without a stroke, px.
const SPACING: f64 = 4.0;

/// A place of one curve this near to the other lies on both, as a share of the curve's length.
const SAME: f64 = 1e-7;

/// The points of `stroke`, which was fitted by `old`, along those parts of `new` that lie on `old`, and along the others the points of `drawn` that
/// are nearest to them, or if there are none, points of `new` itself. Times and pressures belong to a stroke that was drawn at one go and are left
/// out where points are.
///
/// `pixel_size` is the size of a pixel in the unit of the curves.
#[must_use]
pub fn carried(stroke: &Stroke, old: &Spline, new: &Spline, drawn: &[Point], pixel_size: f64) -> Stroke {
    let same = SAME * (old.length() + new.length());
    // The places of `new` in their order, each with whether it lies on `old`.
    let count = (new.length() / (SPACING * pixel_size)).ceil().clamp(1.0, 1e6);
    let step = new.length() / count;
    let places: Vec<(f64, Point, bool)> = (0..=count as usize)
        .map(|i| {
            let s = step * i as f64;
            let point = new.point_at(s);
            (s, point, old.nearest(point).distance <= same)
        })
        .collect();
    let changed = |s: f64| {
        let i = ((s / step) as usize).min(places.len() - 2);
        !(places[i].2 && places[i + 1].2)
    };
    if !places.windows(2).any(|pair| !(pair[0].2 && pair[1].2)) && old.length() <= new.length() + same {
        return stroke.clone();
    }

    let mut points: Vec<(f64, Point)> = Vec::new();
    for &point in &stroke.points {
        let foot = old.nearest(point);
        let on_new = new.nearest(foot.point);
        let s = new.station(on_new.segment, on_new.s);
        if on_new.distance <= same && !changed(s) {
            points.push((s, point));
        }
    }
    let mut replaced: Vec<(f64, Point)> = Vec::new();
    for &point in drawn {
        let foot = new.nearest(point);
        let s = new.station(foot.segment, foot.s);
        if changed(s) {
            replaced.push((s, point));
        }
    }
    if replaced.is_empty() {
        replaced.extend(places.iter().filter(|(s, _, _)| changed(*s)).map(|&(s, point, _)| (s, point)));
    }
    points.append(&mut replaced);
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Stroke::new(stroke.name.clone(), points.into_iter().map(|(_, point)| point).collect())
}
