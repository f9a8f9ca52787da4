//! Closed splines that tests, benches and examples share.

use fairpath_curve::{Continuity, Point, Segment, Spline, hermite_g1};
use std::f64::consts::{PI, TAU};

/// A circle as one arc.
pub(crate) fn circle(centre: (f64, f64), radius: f64) -> Spline {
    let start = Point::new(centre.0 + radius, centre.1);
    let arc = Segment::arc(start, PI / 2.0, radius * TAU, 1.0 / radius);
    Spline::new(vec![arc], vec![Continuity::G1], true).expect("it is a circle")
}

/// A closed curve through points with these headings, counterclockwise, of one clothoid from each to the next.
pub(crate) fn through(poses: &[(Point, f64)]) -> Spline {
    let segments: Vec<Segment> = (0..poses.len())
        .map(|i| {
            let ((p, a), (q, b)) = (poses[i], poses[(i + 1) % poses.len()]);
            hermite_g1(p, a, q, b).expect("the points are apart")
        })
        .collect();
    let joins = vec![Continuity::G1; segments.len()];
    Spline::new(segments, joins, true).expect("it closes")
}

/// An ellipse about the origin with these half axes, turned by `angle`; 96 clothoids are within 1e-7 of it.
pub(crate) fn ellipse(a: f64, b: f64, angle: f64) -> Spline {
    let poses: Vec<(Point, f64)> = (0..96)
        .map(|i| {
            let t = TAU * f64::from(i) / 96.0;
            let (x, y) = (a * t.cos(), b * t.sin());
            let heading = (b * t.cos()).atan2(-a * t.sin()) + angle;
            (Point::new(x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()), heading)
        })
        .collect();
    through(&poses)
}

/// A polygon, with a corner at each point.
pub(crate) fn polygon(points: &[(f64, f64)]) -> Spline {
    let segments: Vec<Segment> = (0..points.len())
        .map(|i| {
            let (p, q) = (Point::from(points[i]), Point::from(points[(i + 1) % points.len()]));
            let edge = q - p;
            Segment::line(p, edge.y.atan2(edge.x), edge.hypot())
        })
        .collect();
    let joins = vec![Continuity::G0; segments.len()];
    Spline::new(segments, joins, true).expect("it closes")
}

/// A ring of bumps: radius 1 ± `depth`, `lobes` of them.
pub(crate) fn flower(lobes: u32, depth: f64) -> Spline {
    let poses: Vec<(Point, f64)> = (0..32 * lobes)
        .map(|i| {
            let t = TAU * f64::from(i) / f64::from(32 * lobes);
            let n = f64::from(lobes);
            let (r, dr) = (1.0 + depth * (n * t).cos(), -depth * n * (n * t).sin());
            let (x, y) = (r * t.cos(), r * t.sin());
            let (dx, dy) = (dr * t.cos() - y, dr * t.sin() + x);
            (Point::new(x, y), dy.atan2(dx))
        })
        .collect();
    through(&poses)
}
