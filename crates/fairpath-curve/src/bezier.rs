//! Conversion to cubic Béziers: a segment or spline and a tolerance come in, the fewest cubics within it go out.
//!
//! kurbo's own fitter takes sines from the platform and so differs in its last bits between systems; this
//! construction does not. A cubic keeps both end points and end headings of its piece of curve, and its two handle lengths are
//! chosen so that it meets the curve again in two inner points. Six conditions make the error fall with the sixth power of
//! the piece's length, and the two inner points are those which level the three bulges of the error between them.
//! [`crate::FitSource`] offers the same curves to kurbo's fitter.

use crate::greedy::{Tolerance, longest_pieces};
use crate::moments::displacement;
use crate::segment::Segment;
use crate::spline::Spline;
use crate::trig::unit;
use kurbo::{BezPath, CubicBez, ParamCurve, Point, Vec2};

/// Where the cubic meets the curve, as a fraction of arc length from either end: `u (1 − u) = 0.2229` levels the bulges of
/// `u² (1 − u)² (u − a)(u − 1 + a)`.
const MEETING: f64 = 0.3354;

/// Turning allowed to one cubic, radians.
const MAX_TURN: f64 = 2.4;

/// Samples of a cubic at which its distance from the curve is measured.
const SAMPLES: usize = 20;

/// What a parabola through three samples may miss of a bulge's height.
const SAMPLING_MARGIN: f64 = 1.02;

/// The power of a piece's length with which its error grows.
const ORDER: f64 = 6.0;

/// Accuracies below this, relative to the length of the segment, are taken as this.
const FINEST: f64 = 1e-12;

/// A piece of segment that begins at the origin with heading 0.
struct LocalPiece {
    length: f64,
    kappa: f64,
    sharpness: f64,
}

impl LocalPiece {
    fn heading(&self, s: f64) -> f64 {
        s * (self.kappa + 0.5 * self.sharpness * s)
    }

    fn point(&self, s: f64) -> Vec2 {
        displacement(0.0, self.kappa, self.sharpness, s)
    }

    /// Signed distance of `q` from the curve near arc length `s`, positive to its left.
    fn offset(&self, q: Vec2, mut s: f64) -> f64 {
        let mut e = q - self.point(s);
        // Two steps bring the foot within the square of an already small error.
        for _ in 0..2 {
            let t = unit(self.heading(s));
            let across = t.cross(e);
            let curvature = self.kappa + self.sharpness * s;
            let step = e.dot(t) / (1.0 - curvature * across).max(0.1);
            s = (s + step).clamp(0.0, self.length);
            e = q - self.point(s);
            // The offset is stationary at the foot: an error of the foot enters it by its square.
            if step.abs() < 1e-3 * self.length {
                break;
            }
        }
        unit(self.heading(s)).cross(e)
    }
}

fn cubic(a: f64, b: f64, t1: Vec2, end: Vec2) -> CubicBez {
    let (p1, p2) = (Vec2::new(a, 0.0), end - t1 * b);
    CubicBez::new(Point::ORIGIN, p1.to_point(), p2.to_point(), end.to_point())
}

/// The cubic for a piece in its own frame, and its greatest distance from it.
fn fit(piece: &LocalPiece) -> (f64, CubicBez) {
    let length = piece.length;
    let end = piece.point(length);
    let t1 = unit(piece.heading(length));
    let meetings = [MEETING, 1.0 - MEETING].map(|u| {
        let s = u * length;
        (piece.point(s), unit(piece.heading(s)))
    });
    // Handle lengths in units of the piece's length; a circle asks for (4/3) tan(turn/4) / turn.
    let turn = 0.5 * (piece.kappa.abs() + (piece.kappa + piece.sharpness * length).abs()) * length;
    let third = (1.0 + turn * turn / 48.0) / 3.0;
    let (mut a, mut b) = (third, third);
    let mut times = [MEETING, 1.0 - MEETING];
    for _ in 0..5 {
        let curve = cubic(a * length, b * length, t1, end);
        let (mut jtj, mut jtr) = ([0.0; 3], [0.0; 2]);
        for (time, (p, t)) in times.iter_mut().zip(&meetings) {
            let mut e = curve.eval(*time).to_vec2() - *p;
            for _ in 0..2 {
                let d = derivative(&curve, *time);
                let slope = d.dot(*t);
                if slope > 0.1 * length {
                    *time = (*time - e.dot(*t) / slope).clamp(0.1, 0.9);
                }
                e = curve.eval(*time).to_vec2() - *p;
            }
            let (u, v) = (*time, 1.0 - *time);
            let residual = t.cross(e) / length;
            let by_a = 3.0 * v * v * u * t.cross(Vec2::new(1.0, 0.0));
            let by_b = -3.0 * v * u * u * t.cross(t1);
            jtj = [jtj[0] + by_a * by_a, jtj[1] + by_a * by_b, jtj[2] + by_b * by_b];
            jtr = [jtr[0] + by_a * residual, jtr[1] + by_b * residual];
        }
        // A straight piece leaves the handles undetermined; the damping then keeps them as they are.
        let damping = 1e-10 * (jtj[0] + jtj[2]) + 1e-30;
        let (d0, d1) = (jtj[0] + damping, jtj[2] + damping);
        let det = d0 * d1 - jtj[1] * jtj[1];
        let (da, db) = ((jtr[0] * d1 - jtr[1] * jtj[1]) / det, (jtr[1] * d0 - jtr[0] * jtj[1]) / det);
        a = (a - da).clamp(0.1, 1.0);
        b = (b - db).clamp(0.1, 1.0);
        if da.abs() + db.abs() < 1e-7 {
            break;
        }
    }
    let curve = cubic(a * length, b * length, t1, end);
    let mut s = 0.0;
    let mut before = Point::ORIGIN;
    let mut offsets = [0.0; SAMPLES + 1];
    for (i, offset) in offsets.iter_mut().enumerate().take(SAMPLES).skip(1) {
        let q = curve.eval(i as f64 / SAMPLES as f64);
        s += (q - before).hypot2().sqrt();
        before = q;
        *offset = piece.offset(q.to_vec2(), s.min(length));
    }
    let worst = offsets.windows(3).map(bulge).fold(0.0, f64::max);
    (if worst.is_finite() { worst * SAMPLING_MARGIN } else { 0.0 }, curve)
}

/// The height of the bulge that three neighbouring samples belong to: the apex of the parabola through them, or the largest.
fn bulge(w: &[f64]) -> f64 {
    let (slope, bend) = (w[2] - w[0], w[0] - 2.0 * w[1] + w[2]);
    // The apex lies between the outer samples where |slope| < 2 |bend|.
    let apex = if slope.abs() < 2.0 * bend.abs() { w[1] - slope * slope / (8.0 * bend) } else { w[1] };
    apex.abs().max(w[1].abs())
}

fn derivative(c: &CubicBez, t: f64) -> Vec2 {
    let u = 1.0 - t;
    ((c.p1 - c.p0) * (u * u) + (c.p2 - c.p1) * (2.0 * u * t) + (c.p3 - c.p2) * (t * t)) * 3.0
}

impl Segment {
    /// Cubic Béziers along the segment that stay within `accuracy` of it and it of them.
    ///
    /// Ends and end headings of every cubic are those of the segment, so joins stay G1. The distance is measured at
    /// 19 points of every cubic, with parabolas between them. Accuracies below 1e-12 × length are taken as that. The cubics are
    /// the fewest of their kind within 1 %, of about equal error, and none turns by more than 2.4 rad. A line gives one
    /// cubic; an invalid segment gives none.
    #[must_use]
    pub fn to_beziers(&self, accuracy: f64) -> Vec<CubicBez> {
        if !self.is_valid() {
            return Vec::new();
        }
        let finest = FINEST * self.length;
        let sharpness = self.sharpness();
        let longest = |from: f64| turn_limit(self.curvature_at(from), sharpness, MAX_TURN);
        let end = self.end();
        let within = |accuracy: f64| {
            let tolerance = Tolerance { accuracy, order: ORDER, shortest: 1e-6 * self.length };
            longest_pieces(self.length, &tolerance, longest, |from, to| {
                let piece = LocalPiece { length: to - from, kappa: self.curvature_at(from), sharpness };
                let (error, local) = fit(&piece);
                (error, (error, self.placed(&local, from, to)))
            })
        };
        let accuracy = accuracy.max(finest);
        let mut cubics = within(accuracy);
        // The last piece is what the others left over. As many pieces of about equal error are better.
        let mean = cubics.iter().map(|c| libm::pow(c.0, 1.0 / ORDER)).sum::<f64>() / cubics.len() as f64;
        let mut level = 1.1 * libm::pow(mean, ORDER);
        for _ in 0..3 {
            if cubics.len() == 1 || level > 0.9 * accuracy {
                break;
            }
            let levelled = within(level.max(finest));
            if levelled.len() <= cubics.len() {
                cubics = levelled;
                break;
            }
            level = (level * accuracy).sqrt();
        }
        let mut cubics: Vec<CubicBez> = cubics.into_iter().map(|c| c.1).collect();
        if let Some(last) = cubics.last_mut() {
            last.p3 = end;
        }
        cubics
    }

    /// A cubic in the frame of the segment at `from`, brought to its place.
    fn placed(&self, local: &CubicBez, from: f64, to: f64) -> CubicBez {
        let (start, t) = (self.point_at(from), self.tangent_at(from));
        let place = |v: Point| start + Vec2::new(t.x * v.x - t.y * v.y, t.y * v.x + t.x * v.y);
        // Neighbours share the same bits where they meet.
        CubicBez::new(start, place(local.p1), place(local.p2), self.point_at(to))
    }
}

/// The arc length over which a curvature that begins with `kappa` and changes at `rate` turns by `turn`, both senses
/// counted.
pub(crate) fn turn_limit(kappa: f64, rate: f64, turn: f64) -> f64 {
    let (k, r) = (kappa.abs(), rate.abs());
    if kappa * rate >= 0.0 {
        return 2.0 * turn / (k + (k * k + 2.0 * r * turn).sqrt());
    }
    let to_inflection = 0.5 * k * k / r;
    if to_inflection >= turn {
        2.0 * turn / (k + (k * k - 2.0 * r * turn).max(0.0).sqrt())
    } else {
        k / r + (2.0 * (turn - to_inflection) / r).sqrt()
    }
}

impl Spline {
    /// The spline as a path of cubic Béziers (lines stay lines) within `accuracy`; see [`Segment::to_beziers`].
    ///
    /// A closed spline gives a closed path. Knots are taken from the segments that begin there, so a
    /// join's rounding gap disappears.
    #[must_use]
    pub fn to_bez_path(&self, accuracy: f64) -> BezPath {
        let mut path = BezPath::new();
        let segments = self.segments();
        path.move_to(segments[0].start);
        for (i, segment) in segments.iter().enumerate() {
            let knot = match segments.get(i + 1) {
                Some(next) => next.start,
                None if self.is_closed() => segments[0].start,
                None => segment.end(),
            };
            if segment.kappa0 == 0.0 && segment.kappa1 == 0.0 {
                path.line_to(knot);
                continue;
            }
            let cubics = segment.to_beziers(accuracy);
            let last = cubics.len().saturating_sub(1);
            for (j, c) in cubics.iter().enumerate() {
                path.curve_to(c.p1, c.p2, if j == last { knot } else { c.p3 });
            }
        }
        if self.is_closed() {
            path.close_path();
        }
        path
    }
}
