//! The handle of a curvature comb: the tip of its longest tooth, which is dragged to make all teeth longer or shorter.

use crate::app::Shown;
use crate::view::View;
use eframe::egui::{Pos2, Vec2};
use fairpath_curve::Spline;
use fairpath_sketch::Session;

/// The comb's scale, points squared, is kept within these.
const SCALES: std::ops::RangeInclusive<f64> = 1.0..=1e8;

/// The longest tooth of a comb on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Handle {
    /// The tooth's foot.
    foot: Pos2,
    /// The unit vector along it.
    along: Vec2,
    /// Its length in points for a scale of one point squared.
    length_per_scale: f64,
}

impl Handle {
    /// The handle of the selected curve's comb, if one is shown.
    pub(crate) fn of_selected(session: &Session, view: &View, shown: &Shown) -> Option<Self> {
        let curve = session.selected().filter(|_| shown.comb)?;
        Self::of(&curve.spline, view)
    }

    fn of(spline: &Spline, view: &View) -> Option<Self> {
        // Curvature is linear along a segment, so that it is largest at an end of one.
        let ends = spline.segments().iter().flat_map(|segment| [segment.start_pose(), segment.end_pose()]);
        let sharpest = ends.max_by(|a, b| a.curvature.abs().total_cmp(&b.curvature.abs()))?;
        let length_per_scale = sharpest.curvature.abs() * view.pixel_size();
        // Teeth stand on the side away from the centre of curvature.
        let left = Vec2::angled((sharpest.heading + std::f64::consts::FRAC_PI_2) as f32);
        let along = if sharpest.curvature > 0.0 { -left } else { left };
        (length_per_scale > 0.0).then(|| Self { foot: view.screen_of(sharpest.point), along, length_per_scale })
    }

    /// Where it is.
    pub(crate) fn place(&self, scale: f64) -> Pos2 {
        self.foot + self.along * (scale * self.length_per_scale) as f32
    }

    /// The scale for which it would be nearest to a place.
    pub(crate) fn scale_at(&self, pos: Pos2) -> f64 {
        let length = f64::from((pos - self.foot).dot(self.along));
        (length / self.length_per_scale).clamp(*SCALES.start(), *SCALES.end())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::{Point, Segment};

    #[test]
    fn the_handle_is_the_tip_of_the_longest_tooth_and_follows_the_hand() {
        let bend = Segment::clothoid(Point::new(10.0, 20.0), 0.4, 80.0, 0.002, 0.02);
        let spline = Spline::new(vec![bend], vec![], false).unwrap();
        let view = View::default();
        let handle = Handle::of(&spline, &view).unwrap();
        let scale = 1500.0;
        let comb = spline.comb(5.0, scale * view.pixel_size() * view.pixel_size());
        let tip = view.screen_of(comb.last().unwrap().tip);
        assert!(handle.place(scale).distance(tip) < 1e-2, "{:?} {tip:?}", handle.place(scale));
        assert!((handle.scale_at(handle.place(700.0)) - 700.0).abs() < 0.1);
    }

    #[test]
    fn a_straight_line_has_no_handle() {
        let line = Segment::line(Point::ORIGIN, 0.0, 10.0);
        assert_eq!(Handle::of(&Spline::new(vec![line], vec![], false).unwrap(), &View::default()), None);
    }
}
