//! How long the teeth of curvature combs are: what suits a drawing, and the handle of a comb, the tip of its longest tooth, which is dragged to make all
//! teeth longer or shorter.

use crate::app::Shown;
use crate::view::View;
use eframe::egui::{Pos2, Vec2};
use fairpath_curve::Spline;
use fairpath_sketch::Session;

/// The comb's scale, in points of the screen squared as the drawing is seen, is kept within these.
const SCALES: std::ops::RangeInclusive<f64> = 1.0..=1e8;

/// The scale where nothing is curved, points squared.
const USUAL: f64 = 1500.0;

/// Along this share of all curves teeth shall be no longer than `TALL`, and nowhere longer than `TALLEST`, points.
const SHARE: f64 = 0.9;
const TALL: f64 = 36.0;
const TALLEST: f64 = 100.0;

/// The scale that suits curves as they are seen, in the drawing's unit squared.
pub(crate) fn suitable<'a>(curves: impl Iterator<Item = &'a Spline>, view: &View) -> f64 {
    let parts = 4;
    let mut bends: Vec<(f64, f64)> = curves
        .flat_map(Spline::segments)
        .flat_map(|segment| {
            let at = |i: usize| segment.curvature_at(segment.length * (i as f64 + 0.5) / parts as f64);
            (0..parts).map(move |i| (at(i).abs(), segment.length / parts as f64))
        })
        .collect();
    bends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let length: f64 = bends.iter().map(|(_, length)| length).sum();
    let mut passed = 0.0;
    let bent = bends.iter().find(|(_, part)| {
        passed += part;
        passed >= SHARE * length
    });
    let pixel = view.pixel_size();
    let scales = [(bent, TALL), (bends.last(), TALLEST)].map(|(bend, tooth)| {
        let curvature = bend.map_or(0.0, |(curvature, _)| *curvature);
        if curvature > 0.0 { tooth * pixel / curvature } else { f64::INFINITY }
    });
    let scale = scales[0].min(scales[1]);
    if scale.is_finite() && length > 0.0 { scale } else { USUAL * pixel * pixel }
}

/// The longest tooth of a comb on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Handle {
    /// The tooth's foot.
    foot: Pos2,
    /// The unit vector along it.
    along: Vec2,
    /// Its length in points for a scale of one, in the drawing's unit squared.
    length_per_scale: f64,
    /// Scales that it may be given.
    scales: [f64; 2],
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
        let length_per_scale = sharpest.curvature.abs() * view.zoom();
        let scales = [SCALES.start(), SCALES.end()].map(|scale| scale * view.pixel_size() * view.pixel_size());
        // Teeth stand on the side away from the centre of curvature.
        let left = Vec2::angled((sharpest.heading + std::f64::consts::FRAC_PI_2) as f32);
        let along = if sharpest.curvature > 0.0 { -left } else { left };
        let foot = view.screen_of(sharpest.point);
        (length_per_scale > 0.0).then_some(Self { foot, along, length_per_scale, scales })
    }

    /// Where it is.
    pub(crate) fn place(&self, scale: f64) -> Pos2 {
        self.foot + self.along * (scale * self.length_per_scale) as f32
    }

    /// The scale for which it would be nearest to a place.
    pub(crate) fn scale_at(&self, pos: Pos2) -> f64 {
        let length = f64::from((pos - self.foot).dot(self.along));
        (length / self.length_per_scale).clamp(self.scales[0], self.scales[1])
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
        let comb = spline.comb(5.0, scale);
        let tip = view.screen_of(comb.last().unwrap().tip);
        assert!(handle.place(scale).distance(tip) < 1e-2, "{:?} {tip:?}", handle.place(scale));
        assert!((handle.scale_at(handle.place(700.0)) - 700.0).abs() < 0.1);
    }

    #[test]
    fn teeth_are_as_long_as_suits_most_of_a_drawing_however_near_it_is_seen() {
        let arc = |radius: f64, length: f64| {
            let arc = Segment::arc(Point::ORIGIN, 0.0, length, 1.0 / radius);
            Spline::new(vec![arc], vec![], false).unwrap()
        };
        let view = View::default();
        let [wide, tight] = [arc(200.0, 400.0), arc(150.0, 10.0)];
        let tooth = |scale: f64, radius: f64, view: &View| scale / radius * view.zoom();
        let scale = suitable([&wide, &tight].into_iter(), &view);
        assert!((tooth(scale, 200.0, &view) - TALL).abs() < 1e-9, "the tight bend is rare");
        let sharp = arc(2.0, 10.0);
        let scale = suitable([&wide, &sharp].into_iter(), &view);
        assert!((tooth(scale, 2.0, &view) - TALLEST).abs() < 1e-9, "a sharp bend is not off the screen");
        let mut near = view;
        near.zoom_at(Pos2::ZERO, 10.0);
        let scale = suitable([&wide, &tight].into_iter(), &near);
        assert!((tooth(scale, 200.0, &near) - TALL).abs() < 1e-9);
        let line = Spline::new(vec![Segment::line(Point::ORIGIN, 0.0, 10.0)], vec![], false).unwrap();
        assert_eq!(suitable([&line].into_iter(), &view), USUAL);
        assert_eq!(suitable(std::iter::empty(), &view), USUAL);
    }

    #[test]
    fn a_straight_line_has_no_handle() {
        let line = Segment::line(Point::ORIGIN, 0.0, 10.0);
        assert_eq!(Handle::of(&Spline::new(vec![line], vec![], false).unwrap(), &View::default()), None);
    }
}
