//! Drawn paths as splines: a path of lines and Béziers in, lines, arcs and clothoids that follow it out.
//!
//! Lines and circular arcs stay what they are. Any other Bézier is halved until three clothoids with the heading and curvature that it has
//! at both ends of a part keep within the accuracy. Nothing is smoothed, but where a path's direction turns by next to nothing at
//! a node, as happens when coordinates are rounded, both sides get one heading.

use fairpath_curve::trig::{angle_of, wrap_angle};
use fairpath_curve::{Continuity, Point, Pose, Segment, Spline, Vec2, hermite_g2};
use kurbo::{BezPath, CubicBez, ParamCurve, ParamCurveArclen, ParamCurveNearest, PathEl};

/// Turns of a path's direction at a node up to this are no corner, radians: 2 degrees, more than rounding to whole px does to handles of
/// 30 px and less than anybody draws on purpose.
const SMOOTH: f64 = 0.035;

/// Largest difference of heading and relative difference of curvature at which neighbouring arcs are one; circles come as Béziers within
/// 1e-9 of their radius.
const SAME: f64 = 1e-8;

/// A Bézier is halved at most so often.
const MAX_HALVINGS: u32 = 12;

/// Parts of a Bézier at whose ends the distance is measured.
const PROBES: u32 = 12;

/// Most segments of one shape: more is no template.
const MAX_SEGMENTS: usize = 20_000;

/// The spline that follows `path` within `accuracy`, in its unit. It is closed if the path is, or ends exactly where it began.
///
/// Béziers are followed where they can be: a bend tighter than `accuracy` is not resolved.
///
/// # Errors
/// A sentence, when the path has no length, a Bézier cannot be followed (it has a cusp), or too many segments would be needed.
pub(crate) fn follow(path: &BezPath, accuracy: f64) -> Result<Spline, String> {
    if !(accuracy > 0.0 && accuracy.is_finite()) {
        return Err(format!("the accuracy is {accuracy}; expected a small positive number"));
    }
    let (pieces, closed) = pieces(path);
    if pieces.is_empty() {
        return Err("the path has no length; draw a longer one or take it out".into());
    }
    if pieces.len() > MAX_SEGMENTS {
        return Err(format!(
            "it has {} nodes, more than the {MAX_SEGMENTS} of a French curve; simplify it",
            pieces.len()
        ));
    }
    let mut segments = Vec::new();
    for (piece, ends) in pieces.iter().zip(headings(&pieces, closed)) {
        piece.follow(ends, accuracy, &mut segments)?;
        if segments.len() > MAX_SEGMENTS {
            return Err(format!("more than {MAX_SEGMENTS} segments would be needed; simplify it"));
        }
    }
    let segments = merged(segments);
    let joins = joins(&segments, closed);
    Spline::new(segments, joins, closed).map_err(|e| format!("no spline follows it: {e}"))
}

/// A line or a curve of a path that has a length.
enum Piece {
    Line(Point, Point),
    Curve(CubicBez),
}

/// The path's pieces, and whether it is closed.
fn pieces(path: &BezPath) -> (Vec<Piece>, bool) {
    let mut pieces = Vec::new();
    let (mut start, mut at, mut closed) = (Point::ZERO, Point::ZERO, false);
    for el in path.elements() {
        let from = at;
        match *el {
            PathEl::MoveTo(p) => (start, at) = (p, p),
            PathEl::LineTo(p) => {
                at = p;
                pieces.push(Piece::Line(from, p));
            }
            PathEl::QuadTo(c, p) => {
                at = p;
                let (a, b) = (from + (c - from) * (2.0 / 3.0), p + (c - p) * (2.0 / 3.0));
                pieces.push(Piece::Curve(CubicBez::new(from, a, b, p)));
            }
            PathEl::CurveTo(a, b, p) => {
                at = p;
                pieces.push(Piece::Curve(CubicBez::new(from, a, b, p)));
            }
            PathEl::ClosePath => {
                closed = true;
                at = start;
                pieces.push(Piece::Line(from, start));
            }
        }
    }
    pieces.retain(|piece| !matches!(piece, Piece::Line(a, b) if a == b));
    pieces.retain(|piece| !matches!(piece, Piece::Curve(c) if c.p0 == c.p1 && c.p1 == c.p2 && c.p2 == c.p3));
    // What returns to where it began to the last bit was meant to be closed.
    let closed = closed || pieces.len() > 1 && at == start;
    (pieces, closed)
}

/// The headings at both ends of each piece, one on both sides of a node that is no corner.
fn headings(pieces: &[Piece], closed: bool) -> Vec<[f64; 2]> {
    let mut ends: Vec<[f64; 2]> = pieces.iter().map(Piece::headings).collect();
    let count = pieces.len();
    for i in 0..(if closed { count } else { count - 1 }) {
        let next = (i + 1) % count;
        let turn = wrap_angle(ends[next][0] - ends[i][1]);
        if turn.abs() > SMOOTH {
            continue;
        }
        let heading = match (&pieces[i], &pieces[next]) {
            (Piece::Line(..), Piece::Line(..)) => continue,
            (Piece::Line(..), Piece::Curve(_)) => ends[i][1],
            (Piece::Curve(_), Piece::Line(..)) => ends[next][0],
            (Piece::Curve(_), Piece::Curve(_)) => ends[i][1] + 0.5 * turn,
        };
        ends[i][1] = heading;
        ends[next][0] = heading;
    }
    ends
}

impl Piece {
    /// Directions at both ends, radians.
    fn headings(&self) -> [f64; 2] {
        match self {
            Self::Line(a, b) => [angle_of(*b - *a); 2],
            Self::Curve(c) => {
                // A handle of no length leaves the direction to the next.
                let first = [c.p1, c.p2, c.p3].into_iter().find(|p| *p != c.p0).unwrap_or(c.p3);
                let last = [c.p2, c.p1, c.p0].into_iter().find(|p| *p != c.p3).unwrap_or(c.p0);
                [angle_of(first - c.p0), angle_of(c.p3 - last)]
            }
        }
    }

    fn follow(&self, ends: [f64; 2], accuracy: f64, out: &mut Vec<Segment>) -> Result<(), String> {
        match self {
            Self::Line(a, b) => {
                out.push(Segment::line(*a, ends[0], (*b - *a).hypot()));
                Ok(())
            }
            Self::Curve(curve) => match arc(curve, ends) {
                Some(arc) => {
                    out.push(arc);
                    Ok(())
                }
                None => follow_part(curve, ends, accuracy, MAX_HALVINGS, out),
            },
        }
    }
}

/// The arc (or line) through both ends with both headings, if the curve is one.
fn arc(curve: &CubicBez, ends: [f64; 2]) -> Option<Segment> {
    let arc = arc_between(curve.p0, ends[0], curve.p3)?;
    let alike = wrap_angle(arc.end_heading() - ends[1]).abs() < SAME;
    let tolerance = 10.0 * SAME * (curve.p3 - curve.p0).hypot();
    let near = |i: u32| {
        let p = curve.eval(f64::from(i) / f64::from(PROBES));
        arc.nearest(p).distance < tolerance
    };
    (alike && (1..PROBES).all(near)).then_some(arc)
}

/// The arc from a point with that heading to another, unless it turns by nearly a whole turn.
fn arc_between(from: Point, heading: f64, to: Point) -> Option<Segment> {
    let chord = to - from;
    let half = wrap_angle(angle_of(chord) - heading);
    if half.abs() > 3.0 || chord == Vec2::ZERO {
        return None;
    }
    let (sine, _) = fairpath_curve::trig::sin_cos(half);
    // A turn that is rounding only is none.
    if half.abs() < 1e-12 {
        return Some(Segment::line(from, heading, chord.hypot()));
    }
    let kappa = 2.0 * sine / chord.hypot();
    Some(Segment::arc(from, heading, 2.0 * half / kappa, kappa))
}

/// Clothoids along a Bézier, halved where they do not keep to it.
fn follow_part(
    curve: &CubicBez,
    ends: [f64; 2],
    accuracy: f64,
    halvings: u32,
    out: &mut Vec<Segment>,
) -> Result<(), String> {
    let start = Pose { point: curve.p0, heading: ends[0], curvature: curvature_near(curve, 0.0) };
    let end = Pose { point: curve.p3, heading: ends[1], curvature: curvature_near(curve, 1.0) };
    if let Some(segments) = hermite_g2(start, end)
        && keeps_to(&segments, curve, accuracy)
    {
        out.extend(segments);
        return Ok(());
    }
    if halvings == 0 {
        let Point { x, y } = curve.eval(0.5);
        return Err(format!(
            "the curve near ({x:.4}, {y:.4}) cannot be followed within {accuracy}: it has a cusp; make that a corner node"
        ));
    }
    let (a, b) = curve.subdivide();
    let [_, middle] = Piece::Curve(a).headings();
    follow_part(&a, [ends[0], middle], accuracy, halvings - 1, out)?;
    follow_part(&b, [middle, ends[1]], accuracy, halvings - 1, out)
}

/// The curvature of a Bézier at an end, or where that is not finite because a handle has no length, a little further inside.
fn curvature_near(curve: &CubicBez, end: f64) -> f64 {
    let at = |t: f64| {
        let (a, b, c) = (curve.p1 - curve.p0, curve.p2 - curve.p1, curve.p3 - curve.p2);
        let u = 1.0 - t;
        let first = (a * (u * u) + b * (2.0 * u * t) + c * (t * t)) * 3.0;
        let second = ((b - a) * u + (c - b) * t) * 6.0;
        let speed = first.hypot();
        first.cross(second) / (speed * speed * speed)
    };
    let size = curve.control_polygon();
    let inside = [0.0, 0.02, 0.05, 0.1, 0.2].map(|d| if end > 0.5 { 1.0 - d } else { d });
    // More than a few turns within the curve's own length is the sign of such a handle.
    inside.into_iter().map(at).find(|k| (k * size).abs() < 30.0).unwrap_or(0.0)
}

trait ControlPolygon {
    /// Length of the polygon of the control points, not less than the curve's own.
    fn control_polygon(&self) -> f64;
}

impl ControlPolygon for CubicBez {
    fn control_polygon(&self) -> f64 {
        (self.p1 - self.p0).hypot() + (self.p2 - self.p1).hypot() + (self.p3 - self.p2).hypot()
    }
}

/// Whether segments and curve lie within the accuracy of each other, as far as probes tell, and are as long.
fn keeps_to(segments: &[Segment], curve: &CubicBez, accuracy: f64) -> bool {
    let length: f64 = segments.iter().map(|s| s.length).sum();
    if length > 1.1 * curve.arclen(0.1 * accuracy) + accuracy {
        return false;
    }
    let to_segments = |i: u32| {
        let p = curve.eval(f64::from(i) / f64::from(PROBES));
        segments.iter().any(|s| s.nearest(p).distance <= accuracy)
    };
    let limit = accuracy * accuracy;
    let to_curve = |s: &Segment| {
        let probes = [0.25, 0.5, 0.75, 1.0].map(|part| s.point_at(part * s.length));
        probes.iter().all(|p| curve.nearest(*p, 0.1 * accuracy).distance_sq <= limit)
    };
    (1..PROBES).all(to_segments) && segments.iter().all(to_curve)
}

/// Neighbouring arcs of one circle as one, since drawings hold arcs as several Béziers.
fn merged(segments: Vec<Segment>) -> Vec<Segment> {
    let mut out: Vec<Segment> = Vec::with_capacity(segments.len());
    for next in segments {
        let joined = out.last().and_then(|last| one_arc(last, &next));
        match (joined, out.last_mut()) {
            (Some(arc), Some(last)) => *last = arc,
            _ => out.push(next),
        }
    }
    out
}

fn one_arc(a: &Segment, b: &Segment) -> Option<Segment> {
    let arcs = a.kappa0 == a.kappa1 && b.kappa0 == b.kappa1 && a.kappa0 != 0.0;
    let alike =
        (a.kappa0 - b.kappa0).abs() <= SAME * a.kappa0.abs() && wrap_angle(a.end_heading() - b.heading).abs() <= SAME;
    if !arcs || !alike || (a.turning() + b.turning()).abs() > 5.9 {
        return None;
    }
    let whole = arc_between(a.start, a.heading, b.end())?;
    let same = (whole.kappa0 - a.kappa0).abs() <= SAME * a.kappa0.abs()
        && wrap_angle(whole.end_heading() - b.end_heading()).abs() <= SAME;
    same.then_some(whole)
}

/// The continuity that each join holds.
fn joins(segments: &[Segment], closed: bool) -> Vec<Continuity> {
    let count = segments.len();
    let holds = |i: usize, level: Continuity| {
        let (a, b) = (segments[i], segments[(i + 1) % count]);
        if count == 1 {
            Spline::new(vec![a], vec![level], true).is_ok()
        } else {
            Spline::new(vec![a, b], vec![level], false).is_ok()
        }
    };
    (0..(if closed { count } else { count - 1 }))
        .map(|i| [Continuity::G2, Continuity::G1].into_iter().find(|level| holds(i, *level)).unwrap_or(Continuity::G0))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg_geometry::subpaths;
    use fairpath_curve::Kind;
    use proptest::prelude::*;

    fn followed(data: &str) -> Spline {
        follow(&subpaths(data).unwrap()[0], 0.05).unwrap()
    }

    fn kinds(spline: &Spline) -> Vec<Kind> {
        spline.segments().iter().map(Segment::kind).collect()
    }

    #[test]
    fn lines_and_circular_arcs_stay_what_they_are() {
        let slot = followed("M0 0H100A20 20 0 0 1 100 40H0A20 20 0 0 1 0 0Z");
        assert_eq!(kinds(&slot), [Kind::Line, Kind::Arc, Kind::Line, Kind::Arc]);
        assert_eq!(slot.joins(), [Continuity::G1; 4]);
        assert!(slot.is_closed());
        assert!((slot.segments()[1].kappa0 - 0.05).abs() < 1e-9);
        let square = followed("M0 0L50 0L50 50L0 50Z");
        assert_eq!(kinds(&square), [Kind::Line; 4]);
        assert_eq!(square.joins(), [Continuity::G0; 4]);
    }

    #[test]
    fn a_circle_is_closed_and_round() {
        let circle = followed("M50 0A50 50 0 1 1 -50 0A50 50 0 1 1 50 0Z");
        assert!(circle.segments().len() <= 3, "{:?}", circle.segments());
        assert!(circle.joins().iter().all(|join| *join == Continuity::G2));
        assert!((circle.turning() - std::f64::consts::TAU).abs() < 1e-9);
    }

    #[test]
    fn an_ellipse_is_followed_with_smooth_joins() {
        let spline = followed("M100 0A100 40 0 1 1 -100 0A100 40 0 1 1 100 0Z");
        assert!(spline.joins().iter().all(|join| *join >= Continuity::G1));
        for segment in spline.segments() {
            for p in segment.flatten(0.01) {
                let level = (p.x / 100.0).hypot(p.y / 40.0);
                assert!((level - 1.0).abs() * 40.0 < 0.06, "{p:?} is {level}");
            }
        }
    }

    #[test]
    fn rounded_coordinates_make_no_corner_and_corners_stay() {
        let bump = followed("M0 0C30 0 50 20.01 80 20C110 19.98 120 0 150 0L150 40");
        let corners = bump.joins().iter().filter(|join| **join == Continuity::G0).count();
        assert_eq!(corners, 1);
    }

    #[test]
    fn what_has_no_length_is_refused() {
        let mut dot = BezPath::new();
        dot.move_to((1.0, 1.0));
        dot.line_to((1.0, 1.0));
        assert!(follow(&dot, 0.05).unwrap_err().contains("no length"));
        assert!(follow(&dot, 0.0).unwrap_err().contains("accuracy"));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn any_bezier_is_followed_within_the_accuracy_or_refused(
            // A coarse lattice makes handles of no length, cusps and doubled lines likely.
            points in proptest::array::uniform4((-4_i8..5, -4_i8..5))
        ) {
            let [p0, p1, p2, p3] = points.map(|(x, y)| Point::new(20.0 * f64::from(x), 20.0 * f64::from(y)));
            let mut path = BezPath::new();
            path.move_to(p0);
            path.curve_to(p1, p2, p3);
            let curve = CubicBez::new(p0, p1, p2, p3);
            if let Ok(spline) = follow(&path, 0.05) {
                for i in 0..=50 {
                    let p = curve.eval(f64::from(i) / 50.0);
                    prop_assert!(spline.nearest(p).distance < 0.1, "{} at {:?}", spline.nearest(p).distance, p);
                }
                for pose in spline.samples(2.0) {
                    prop_assert!(curve.nearest(pose.point, 1e-6).distance_sq < 0.1 * 0.1);
                }
            }
        }
    }
}
