//! Recorded strokes as a mouse can draw them: moved and scaled into a part of a window, on whole pixels.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use fairpath_curve::Point;
use fairpath_fit::Stroke;

use super::Area;
use crate::tree;

/// A place in a window, pixels from its upper left corner.
pub(crate) type Place = [i32; 2];

/// A stroke that never is further than this from its start is no stroke, pixels.
const TAP: f64 = 4.0;

/// The strokes of a file, each moved into an area and made smaller if it is larger, without those that are taps then.
pub(crate) fn laid_out(file: &Path, area: Area) -> Result<Vec<Vec<Place>>> {
    let strokes = fairpath_io::read_strokes(file, &fairpath_io::ReadOptions::default())?.strokes;
    let laid: Vec<_> = strokes.iter().map(|stroke| laid(stroke, area)).filter(|places| !is_tap(places)).collect();
    if laid.is_empty() {
        bail!("{} has no strokes that can be drawn", file.display());
    }
    Ok(laid)
}

/// Where the strokes of a tablet are, if they are here; on the build server they must be.
pub(crate) fn wacom() -> Option<PathBuf> {
    let file = tree::strokes().join("wacom.json");
    if file.is_file() || tree::on_build_server() {
        return Some(file);
    }
    println!("skipped: the strokes of a tablet are not at {}", file.display());
    None
}

/// A stroke moved into an area, and made smaller if it is larger.
pub(crate) fn laid(stroke: &Stroke, area: Area) -> Vec<Place> {
    let least = |of: fn(&Point) -> f64| stroke.points.iter().map(of).fold(f64::INFINITY, f64::min);
    let most = |of: fn(&Point) -> f64| stroke.points.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let (x, y) = (least(|p| p.x), least(|p| p.y));
    let room = |area: i32, extent: f64| f64::from(area - 1) / extent.max(1.0);
    let scale = room(area.width, most(|p| p.x) - x).min(room(area.height, most(|p| p.y) - y)).min(1.0);
    let place =
        |p: &Point| [area.left + (scale * (p.x - x)).round() as i32, area.top + (scale * (p.y - y)).round() as i32];
    let mut places: Vec<Place> = stroke.points.iter().map(place).collect();
    // A mouse reports a place only where it differs from the one before.
    places.dedup();
    places
}

/// Whether the application takes it for a tap.
pub(crate) fn is_tap(places: &[Place]) -> bool {
    let far = |[x, y]: &Place| f64::from(x - places[0][0]).hypot(f64::from(y - places[0][1]));
    places.iter().map(far).fold(0.0, f64::max) <= TAP
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_are_laid_into_their_area_on_pixels_that_differ() {
        let area = Area { left: 100, top: 50, width: 30, height: 20 };
        let strokes = laid_out(&tree::root().join("examples/hello.json"), area).unwrap();
        assert!(strokes.len() > 2);
        for stroke in &strokes {
            assert!(stroke.iter().all(|[x, y]| (100..130).contains(x) && (50..70).contains(y)), "{stroke:?}");
            assert!(stroke.windows(2).all(|pair| pair[0] != pair[1]));
        }
    }

    #[test]
    fn dots_are_taps() {
        assert!(is_tap(&[[5, 5], [6, 7], [5, 5]]));
        assert!(!is_tap(&[[5, 5], [60, 7], [5, 5]]));
    }
}
