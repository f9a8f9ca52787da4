//! The closed curve as the mesher wants it: a spline comes in, a simple outline in a frame of size one goes out, its inside on the left.

use crate::error::InflateError;
use fairpath_curve::{Continuity, Point, Pose, Spline, trig};

/// Size below which a curve is lost in the rounding of its coordinates, as a part of the largest of them.
const SMALLEST: f64 = 1e-9;
/// Largest coordinate: beyond it, squares and their products overflow.
const LARGEST: f64 = 1e60;
/// Least size: beneath it, squares and their products vanish.
const LEAST: f64 = 1e-60;
/// Most turning of a curve, radians. A circle turns by 6, a scribble that fills a page by some hundreds.
const MOST_TURNING: f64 = 1e4;
/// An area below this part of the squared size is none.
const NO_AREA: f64 = 1e-9;
/// Joins that turn by more than this are corners, which triangles must keep, radians.
const CORNER: f64 = 1e-3;

/// A closed curve without crossings, whose inside lies to the left. Lengths and stations are those of a frame in which the larger side
/// of the bounding box is one and its centre the origin.
pub(crate) struct Outline {
    spline: Spline,
    centre: Point,
    /// Units of the spline's frame per unit here.
    pub(crate) scale: f64,
    /// Area inside.
    pub(crate) area: f64,
    /// Stations of the corners, increasing.
    pub(crate) corners: Vec<f64>,
    /// Station at which each segment begins, and the length of all.
    pub(crate) knots: Vec<f64>,
}

impl Outline {
    /// The outline of a spline that does not cross itself.
    ///
    /// # Errors
    /// When the spline is open, encloses nothing or is beyond all measure.
    pub(crate) fn new(spline: &Spline) -> Result<Self, InflateError> {
        let (centre, size, reach) = measured(spline)?;
        let area = signed_area(spline, centre);
        if !(area.abs() > NO_AREA * size * size) {
            return Err(InflateError::TooSmall { size, reach });
        }
        let spline = if area < 0.0 { spline.reversed() } else { spline.clone() };
        let mut knots = vec![0.0];
        for segment in spline.segments() {
            knots.push(knots[knots.len() - 1] + segment.length / size);
        }
        let mut outline =
            Self { spline, centre, scale: size, area: area.abs() / (size * size), corners: Vec::new(), knots };
        outline.corners = outline.find_corners();
        Ok(outline)
    }

    /// Length all around.
    pub(crate) fn length(&self) -> f64 {
        self.knots[self.knots.len() - 1]
    }

    fn find_corners(&self) -> Vec<f64> {
        let segments = self.spline.segments();
        let mut corners: Vec<f64> = (0..segments.len())
            .filter(|&i| {
                let before = (i + segments.len() - 1) % segments.len();
                let turn = trig::wrap_angle(segments[i].heading - segments[before].end_heading());
                self.spline.joins()[before] == Continuity::G0 && turn.abs() > CORNER
            })
            .map(|i| self.knots[i])
            .collect();
        corners.sort_by(f64::total_cmp);
        corners
    }

    /// Pose at a station, which may run over the whole length. At a corner it is that of the segment that begins there.
    pub(crate) fn pose(&self, station: f64) -> Pose {
        let station = if station >= self.length() { station - self.length() } else { station };
        let count = self.spline.segments().len();
        let i = self.knots.partition_point(|&knot| knot <= station).clamp(1, count) - 1;
        let segment = &self.spline.segments()[i];
        let pose = segment.pose_at(((station - self.knots[i]) * self.scale).clamp(0.0, segment.length));
        Pose { point: self.inward(pose.point), heading: pose.heading, curvature: pose.curvature * self.scale }
    }

    /// Heading with which the curve arrives at a corner.
    pub(crate) fn arriving(&self, corner: f64) -> f64 {
        let segments = self.spline.segments();
        let begins = self.knots.iter().position(|&knot| knot == corner).unwrap_or(0);
        segments[(begins + segments.len() - 1) % segments.len()].end_heading()
    }

    /// Largest curvature of each segment and how far it turns.
    pub(crate) fn bends(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let of = |s: &fairpath_curve::Segment| (s.kappa0.abs().max(s.kappa1.abs()) * self.scale, s.absolute_turning());
        self.spline.segments().iter().map(of)
    }

    fn inward(&self, p: Point) -> Point {
        Point::new((p.x - self.centre.x) / self.scale, (p.y - self.centre.y) / self.scale)
    }

    /// A point of this frame in the spline's own.
    pub(crate) fn outward(&self, p: Point) -> Point {
        Point::new(self.centre.x + p.x * self.scale, self.centre.y + p.y * self.scale)
    }
}

/// Area to the left of the curve, by a polygon along it: only its sign and rough size matter.
fn signed_area(spline: &Spline, centre: Point) -> f64 {
    let size = spline.length();
    let points = spline.flatten(1e-5 * size);
    0.5 * points.windows(2).map(|w| (w[0] - centre).cross(w[1] - centre)).sum::<f64>()
}

/// The middle of a curve's bounding box, its larger side, and the largest coordinate.
///
/// # Errors
/// When the curve is open or beyond all measure.
pub(crate) fn measured(spline: &Spline) -> Result<(Point, f64, f64), InflateError> {
    if !spline.is_closed() {
        return Err(InflateError::Open);
    }
    let turning: f64 = spline.segments().iter().map(|s| s.absolute_turning()).sum();
    if !(turning <= MOST_TURNING) {
        return Err(InflateError::TooWinding { turning, limit: MOST_TURNING });
    }
    let bounds = spline.bounding_box();
    let reach = [bounds.x0, bounds.y0, bounds.x1, bounds.y1].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if !(reach <= LARGEST) {
        return Err(InflateError::TooLarge { limit: LARGEST });
    }
    let size = bounds.width().max(bounds.height());
    if !(size >= LEAST && size > SMALLEST * reach) {
        return Err(InflateError::TooSmall { size, reach });
    }
    Ok((bounds.center(), size, reach))
}
