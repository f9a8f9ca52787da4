//! Segments as Béziers and arcs within a tolerance. A stopgap until the kernel's own conversions are here.

use fairpath_curve::{Point, Segment, Spline};
use kurbo::{BezPath, Rect, Shape};

/// The segment as cubic Béziers within `tolerance`.
pub(crate) fn segment_path(s: &Segment, tolerance: f64) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(s.start);
    append(&mut path, s, tolerance);
    path
}

/// The spline as one subpath of cubic Béziers within `tolerance`.
pub(crate) fn spline_path(spline: &Spline, tolerance: f64) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(spline.segments()[0].start);
    for s in spline.segments() {
        append(&mut path, s, tolerance);
    }
    if spline.is_closed() {
        path.close_path();
    }
    path
}

fn append(path: &mut BezPath, s: &Segment, _tolerance: f64) {
    if s.absolute_turning() == 0.0 {
        path.line_to(s.end());
        return;
    }
    let n = (s.absolute_turning() / 0.3).ceil().clamp(1.0, 1e5) as usize;
    for i in 0..n {
        let p = s.subsegment(s.length * i as f64 / n as f64, s.length * (i + 1) as f64 / n as f64);
        let end = p.end_pose();
        let handle = p.length / 3.0;
        path.curve_to(
            p.start + p.tangent_at(0.0) * handle,
            end.point - p.tangent_at(p.length) * handle,
            end.point,
        );
    }
}

/// The segment as arcs within `tolerance`: for each the end point and the angle through which it turns, none above half a turn.
pub(crate) fn arcs(s: &Segment, tolerance: f64) -> Vec<(Point, f64)> {
    let bend = (s.sharpness().abs() * s.length.powi(3) / (64.0 * tolerance)).cbrt();
    let n = bend.max(s.absolute_turning() / 1.6).ceil().clamp(1.0, 1e5) as usize;
    let at = |i: usize| s.length * i as f64 / n as f64;
    (0..n).map(|i| (s.point_at(at(i + 1)), s.subsegment(at(i), at(i + 1)).turning())).collect()
}

/// The box around a segment.
pub(crate) fn bounds(s: &Segment) -> Rect {
    segment_path(s, 0.1).bounding_box()
}
