//! A closed curve that crosses itself as the simple curves around what it encloses: a spline comes in, splines that do not cross come out.
//!
//! At a crossing one can stay on the curve or change to the other passage. Who always changes, in the direction of travel, walks round simple
//! curves that only touch each other (Seifert's circles of knot theory). Those that lie inside others are left out: what remains are the outlines
//! of all that the curve winds around.

use crate::error::InflateError;
use fairpath_curve::{Contact, Continuity, Place, Point, Spline, SplineIntersection};

/// Most crossings: a scribble with more is no outline of anything.
const MOST_CROSSINGS: usize = 500;

/// Loops shorter than this part of the whole are what rounding and trembling leave at a crossing.
const SHORTEST: f64 = 1e-3;

/// The outlines of a closed spline, the spline itself if it does not cross itself. At a crossing an outline has a corner.
///
/// # Errors
/// When it touches or retraces itself, or crosses itself more often than [`MOST_CROSSINGS`].
pub(crate) fn outlines(spline: &Spline) -> Result<Vec<Spline>, InflateError> {
    let found = spline.self_intersections();
    let Some(first) = found.first() else { return Ok(vec![spline.clone()]) };
    let refused = |at: &SplineIntersection| InflateError::MeetsItself {
        x: at.point.x,
        y: at.point.y,
        first: spline.station(at.first.segment, at.first.s),
        second: spline.station(at.second.segment, at.second.s),
        count: found.len(),
    };
    if let Some(touch) = found.iter().find(|f| f.contact != Contact::Crossing) {
        return Err(refused(touch));
    }
    if found.len() > MOST_CROSSINGS {
        return Err(refused(first));
    }
    let loops = simple_loops(spline, &found).ok_or_else(|| refused(first))?;
    Ok(outermost(loops, SHORTEST * spline.length()))
}

/// All loops of those who change passages at each crossing; nothing if they cannot be told apart.
fn simple_loops(spline: &Spline, crossings: &[SplineIntersection]) -> Option<Vec<Spline>> {
    let station = |place: Place| spline.station(place.segment, place.s);
    // Where the curve is cut: a station, and which crossing it belongs to.
    let mut cuts: Vec<(f64, usize)> =
        crossings.iter().enumerate().flat_map(|(i, c)| [(station(c.first), i), (station(c.second), i)]).collect();
    cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = cuts.len();
    let other = |k: usize| (0..count).find(|&j| j != k && cuts[j].1 == cuts[k].1);
    // The part that begins at cut `k`, to the next one.
    let part = |k: usize| {
        let to = if k + 1 < count { cuts[k + 1].0 } else { cuts[0].0 + spline.length() };
        spline.subspline(cuts[k].0, to)
    };
    let mut walked = vec![false; count];
    let mut loops = Vec::new();
    for begin in 0..count {
        let (mut segments, mut joins) = (Vec::new(), Vec::new());
        let mut k = begin;
        while !walked[k] {
            walked[k] = true;
            let part = part(k)?;
            segments.extend_from_slice(part.segments());
            joins.extend_from_slice(part.joins());
            joins.push(Continuity::G0);
            k = other((k + 1) % count)?;
        }
        if !segments.is_empty() {
            loops.push(Spline::new(segments, joins, true).ok()?);
        }
    }
    Some(loops)
}

/// The loops that lie in no other, the longest first.
fn outermost(mut loops: Vec<Spline>, shortest: f64) -> Vec<Spline> {
    loops.retain(|l| l.length() > shortest);
    loops.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let polygons: Vec<Vec<Point>> = loops.iter().map(|l| l.flatten(1e-4 * l.length())).collect();
    // Loops touch where they have corners: the middle of a segment lies clearly on one side of all others.
    let within = |i: usize, j: usize| {
        let longest = loops[i].segments().iter().max_by(|a, b| a.length.total_cmp(&b.length));
        longest.is_some_and(|s| winds_around(&polygons[j], s.point_at(0.5 * s.length)))
    };
    let keep: Vec<bool> = (0..loops.len()).map(|i| !(0..loops.len()).any(|j| j != i && within(i, j))).collect();
    let mut keep = keep.into_iter();
    loops.retain(|_| keep.next().unwrap_or(true));
    loops
}

/// Whether a point is inside a closed polygon whose last point is its first, by the crossings of a ray from it.
fn winds_around(polygon: &[Point], p: Point) -> bool {
    let mut inside = false;
    for e in polygon.windows(2) {
        if (e[0].y > p.y) != (e[1].y > p.y) {
            let x = e[0].x + (p.y - e[0].y) / (e[1].y - e[0].y) * (e[1].x - e[0].x);
            inside ^= x > p.x;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::Segment;

    fn polygon(points: &[(f64, f64)]) -> Spline {
        let count = points.len();
        let edge = |i: usize| {
            let (a, b) = (Point::from(points[i]), Point::from(points[(i + 1) % count]));
            Segment::line(a, fairpath_curve::trig::angle_of(b - a), (b - a).hypot())
        };
        Spline::new((0..count).map(edge).collect(), vec![Continuity::G0; count], true).unwrap()
    }

    #[test]
    fn a_bow_tie_has_two_halves() {
        let tie = polygon(&[(0.0, 0.0), (4.0, 2.0), (4.0, 0.0), (0.0, 2.0)]);
        let halves = outlines(&tie).unwrap();
        assert_eq!(halves.len(), 2);
        for half in &halves {
            assert!(half.self_intersections().is_empty());
            assert_eq!(half.segments().len(), 3);
            let middle = Point::new(2.0, 1.0);
            assert!(half.segments().iter().any(|s| (s.start - middle).hypot() < 1e-9));
        }
    }

    #[test]
    fn a_pentagram_is_a_star_without_its_pentagon() {
        let tip = |i: i32| {
            let v = fairpath_curve::trig::unit(f64::from(i) * 0.8 * std::f64::consts::PI) * 10.0;
            (v.x, v.y)
        };
        let star = outlines(&polygon(&[tip(0), tip(1), tip(2), tip(3), tip(4)])).unwrap();
        assert_eq!(star.len(), 1);
        assert_eq!(star[0].segments().len(), 10);
        assert!(star[0].self_intersections().is_empty());
    }

    #[test]
    fn what_does_not_cross_stays_as_it_is() {
        let square = polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        assert_eq!(outlines(&square).unwrap(), [square]);
    }

    #[test]
    fn a_circle_that_is_traced_twice_is_refused() {
        let twice = Segment::arc(Point::ORIGIN, 0.0, 2.0 * std::f64::consts::TAU * 5.0, 0.2);
        let twice = Spline::new(vec![twice], vec![Continuity::G1], true).unwrap();
        assert!(matches!(outlines(&twice), Err(InflateError::MeetsItself { .. })));
    }
}
