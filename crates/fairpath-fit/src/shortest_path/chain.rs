//! A chain of primitives as the merge sees it, and its distance to the data (section 3.6 of Baran et al. 2010).

use super::candidates::deviation;
use crate::options::FitOptions;
use crate::walk::{Datum, Primitive, Walker};
use fairpath_curve::{Continuity, Kind, Point, Segment, Vec2, trig};
use std::ops::Range;

/// Number of parameters of a piece: x, y, heading, curvature at start and end, length.
pub(crate) const Q: usize = 6;
pub(crate) const HEADING: usize = 2;
pub(crate) const KAPPA0: usize = 3;
pub(crate) const KAPPA1: usize = 4;
pub(crate) const LENGTH: usize = 5;

/// Weight of a corner relative to that of an end.
const CORNER_FACTOR: f64 = 2.0;

/// A foot this far before the start of a piece is not on the curve, px; nearer ones may be, on the piece before.
const BACK: f64 = 2.0;

/// A primitive in a chain, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    pub(crate) kind: Kind,
    pub(crate) q: [f64; Q],
    /// Sign that the curvature must keep at start and end, or 0 where it is free (section 3.8).
    pub(crate) sign: [i8; 2],
    /// Length that it may not exceed: a diverging step must not wind it up.
    pub(crate) longest: f64,
}

impl Piece {
    pub(crate) fn segment(&self) -> Segment {
        let [x, y, heading, kappa0, kappa1, length] = self.q;
        Segment { start: Point::new(x, y), heading, length, kappa0, kappa1 }
    }
}

/// Pieces with their joins and the data that they shall follow.
#[derive(Clone, Debug)]
pub(crate) struct Chain<'a> {
    pub(crate) pieces: Vec<Piece>,
    /// Between neighbours; one more for a closed chain.
    pub(crate) joins: Vec<Continuity>,
    pub(crate) data: &'a [Datum],
    /// For every G0 join between neighbours, in order: which datum is the corner.
    pub(crate) corners: Vec<usize>,
    pub(crate) closed: bool,
    /// Weight of the ends and corners relative to the other data.
    pub(crate) end_factor: f64,
    pub(crate) short: Option<Shortness>,
    /// No piece may bend more, radians per px.
    pub(crate) max_curvature: f64,
    /// Energy for the square of how fast curvature changes, summed along the chain, px⁶; zero where fairness comes from having few pieces.
    pub(crate) variation: f64,
    /// Where the ends of a part of a longer chain must stay to meet the rest, nearly: the rest can still give way.
    pub(crate) pins: [Option<Pin>; 2],
    /// Where the ends of an open chain must be exactly, because what they meet stays as it is (section 3.7).
    pub(crate) held: [Option<Pin>; 2],
}

/// The pose at which a part of a chain meets the rest: x, y, heading, curvature, of which the first `count` must agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pin {
    pub(crate) pose: [f64; 4],
    pub(crate) count: usize,
}

impl Pin {
    /// Whether a kind of piece can meet it: a line has no curvature, and an arc must not be one.
    pub(crate) fn admits(&self, kind: Kind) -> bool {
        let bend = self.pose[KAPPA0];
        self.count <= KAPPA0
            || match kind {
                Kind::Line => bend == 0.0,
                Kind::Arc => bend.abs() > STRAIGHT,
                Kind::Clothoid => true,
            }
    }

    /// Adds what a pose, with its derivatives by the parameters of its piece, is away from this one.
    fn hold(&self, piece: usize, pose: [f64; 4], rows: [[f64; Q]; 4], out: &mut Measured) {
        for i in 0..self.count {
            out.resist(piece, &rows[i], self.pose[i] - pose[i], PIN_STIFFNESS[i]);
        }
    }
}

/// What resists pieces that become short: a merge that knows only distances would let them vanish (section 3.4 prices them, section 3.6 is
/// silent).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shortness {
    /// Pieces shorter than this are short, px.
    pub(crate) length: f64,
    /// Energy for the square of what is missing, px.
    pub(crate) stiffness: f64,
}

/// No piece is short that has this share of what falls to each between two corners.
const FAIR_SHARE: f64 = 0.6;

/// Curvature below which an arc would be a line, radians per px.
const STRAIGHT: f64 = 1e-7;

/// Stiffness of a pin in position, heading and curvature.
const PIN_STIFFNESS: [f64; 4] = [30.0, 30.0, 12e3, 12e5];

/// Normal equations of one piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceNormal {
    /// Lower triangle.
    pub(crate) hessian: [[f64; Q]; Q],
    /// Descent direction `Jᵀ W d`.
    pub(crate) gradient: [f64; Q],
    /// `max |d|`.
    pub(crate) error: f64,
    /// `Σ w d²` and `Σ w`.
    pub(crate) energy: f64,
    pub(crate) weight: f64,
    /// First datum that it was measured against, and one past the last; empty where no datum reached it.
    pub(crate) span: (usize, usize),
}

/// The distances of all data to a chain.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    pub(crate) normals: Vec<PieceNormal>,
    /// `Σ w d²`.
    pub(crate) energy: f64,
    /// Where the foot of each datum is: arc length from the start of its stretch, pieces laid end to end.
    feet: Vec<f64>,
}

impl Measured {
    /// Adds to the energy what a piece lacks in something other than distance to data.
    fn resist(&mut self, piece: usize, row: &[f64; Q], lacks: f64, stiffness: f64) {
        self.normals[piece].add(row, lacks, stiffness);
        self.energy += stiffness * lacks * lacks;
    }
}

impl PieceNormal {
    const ZERO: Self = Self {
        hessian: [[0.0; Q]; Q],
        gradient: [0.0; Q],
        error: 0.0,
        energy: 0.0,
        weight: 0.0,
        span: (usize::MAX, 0),
    };

    /// The deviation that costs are counted from.
    pub(crate) fn deviation(&self, options: &FitOptions) -> f64 {
        deviation(self.energy, self.weight, self.error, options)
    }

    /// Adds normal equations by the natural parameters of a piece.
    fn take(&mut self, natural: &mut Natural, q: &[f64; Q]) {
        let Natural { hessian: h, gradient: g } = std::mem::replace(natural, Natural::ZERO);
        // Sharpness is (κ₁ − κ₀) / length.
        let per_length = 1.0 / q[LENGTH];
        let by_sharpness = [-per_length, per_length, -(q[KAPPA1] - q[KAPPA0]) * per_length * per_length];
        let lower = |i: usize, j: usize| h[i.max(j)][i.min(j)];
        for i in 0..Q {
            // A parameter is a natural one, if it is one at all, and a share of sharpness.
            let share = if i < KAPPA0 { 0.0 } else { by_sharpness[i - KAPPA0] };
            let row: [f64; Natural::COUNT] = std::array::from_fn(|j| {
                let own = if i <= KAPPA0 { lower(i, j) } else { 0.0 };
                own + share * lower(Natural::SHARPNESS, j)
            });
            for j in 0..=i {
                let own = if j <= KAPPA0 { row[j] } else { 0.0 };
                let share = if j < KAPPA0 { 0.0 } else { by_sharpness[j - KAPPA0] };
                self.hessian[i][j] += own + share * row[Natural::SHARPNESS];
            }
            self.gradient[i] += if i <= KAPPA0 { g[i] } else { 0.0 } + share * g[Natural::SHARPNESS];
        }
    }

    #[inline]
    fn reached(&mut self, datum: usize, d: f64, w: f64) {
        self.error = self.error.max(d);
        self.energy += w * d * d;
        self.weight += w;
        self.span = (self.span.0.min(datum), self.span.1.max(datum + 1));
    }

    #[inline]
    fn add(&mut self, row: &[f64; Q], d: f64, w: f64) {
        for i in 0..Q {
            let v = w * row[i];
            for j in 0..=i {
                self.hessian[i][j] += v * row[j];
            }
            self.gradient[i] += v * d;
        }
    }
}

/// Normal equations of one piece by x, y, heading, curvature at the start and sharpness, with which derivatives are simplest.
struct Natural {
    /// Lower triangle.
    hessian: [[f64; Self::COUNT]; Self::COUNT],
    gradient: [f64; Self::COUNT],
}

impl Natural {
    const COUNT: usize = 5;
    const SHARPNESS: usize = 4;
    const ZERO: Self = Self { hessian: [[0.0; Self::COUNT]; Self::COUNT], gradient: [0.0; Self::COUNT] };

    #[inline]
    fn add(&mut self, row: &[f64; Self::COUNT], d: f64, w: f64) {
        for i in 0..Self::COUNT {
            let v = w * row[i];
            for j in 0..=i {
                self.hessian[i][j] += v * row[j];
            }
            self.gradient[i] += v * d;
        }
    }
}

impl Chain<'_> {
    /// Runs of pieces between G0 joins, with the data that belong to each, corners to both sides.
    fn stretches(&self) -> Vec<(Range<usize>, Range<usize>)> {
        let mut out = Vec::new();
        let (mut piece, mut datum) = (0, 0);
        let mut corners = self.corners.iter();
        for k in 0..self.pieces.len() - 1 {
            if self.joins[k] == Continuity::G0 {
                let corner = *corners.next().expect("every G0 join has its datum");
                out.push((piece..k + 1, datum..corner + 1));
                (piece, datum) = (k + 1, corner);
            }
        }
        out.push((piece..self.pieces.len(), datum..self.data.len()));
        out
    }

    /// Walks along all data.
    pub(crate) fn measure(&self) -> Measured {
        self.measured(&[])
    }

    /// As [`Chain::measure`], given the measurement of a chain that differs little.
    pub(crate) fn measure_near(&self, near: &Measured) -> Measured {
        self.measured(&near.feet)
    }

    fn measured(&self, near: &[f64]) -> Measured {
        let mut out = Measured {
            normals: vec![PieceNormal::ZERO; self.pieces.len()],
            energy: 0.0,
            feet: vec![0.0; self.data.len()],
        };
        for (pieces, data) in self.stretches() {
            self.measure_stretch(pieces, data, near, &mut out);
        }
        self.add_shortness(&mut out);
        self.add_pins(&mut out);
        self.add_variation(&mut out);
        out
    }

    fn add_shortness(&self, out: &mut Measured) {
        let Some(Shortness { length, stiffness }) = self.short else { return };
        for (pieces, _) in self.stretches() {
            let all: f64 = self.pieces[pieces.clone()].iter().map(|p| p.q[LENGTH]).sum();
            let wanted = length.min(FAIR_SHARE * all / pieces.len() as f64);
            for k in pieces {
                let missing = wanted - self.pieces[k].q[LENGTH];
                if missing > 0.0 {
                    out.resist(k, &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0], missing, stiffness);
                }
            }
        }
    }

    /// Moreton's functional: each piece adds `(κ₁ − κ₀)² / length`.
    fn add_variation(&self, out: &mut Measured) {
        if self.variation == 0.0 {
            return;
        }
        for (k, piece) in self.pieces.iter().enumerate() {
            let root = 1.0 / piece.q[LENGTH].sqrt();
            let change = (piece.q[KAPPA1] - piece.q[KAPPA0]) * root;
            let mut row = [0.0; Q];
            (row[KAPPA0], row[KAPPA1], row[LENGTH]) = (-root, root, -0.5 * change / piece.q[LENGTH]);
            out.resist(k, &row, -change, self.variation);
        }
    }

    fn add_pins(&self, out: &mut Measured) {
        let last = self.pieces.len() - 1;
        if let Some(pin) = &self.pins[0] {
            let q = &self.pieces[0].q;
            let still = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
            pin.hold(0, [q[0], q[1], q[2], q[3]], still, out);
        }
        if let Some(pin) = &self.pins[1] {
            let (arrived, rows) = end_with_jacobian(&self.pieces[last].q);
            pin.hold(last, arrived, rows, out);
        }
    }

    fn measure_stretch(&self, pieces: Range<usize>, data: Range<usize>, near: &[f64], out: &mut Measured) {
        let Measured { normals, energy, feet } = out;
        let mut k = pieces.start;
        // Length of the pieces before this one.
        let mut before = 0.0;
        let (first, last) = (data.start, data.end - 1);
        // The seam of a smoothly closed chain is no end, nor is a pin: their data are ordinary.
        let ring = self.closed && self.joins[self.pieces.len() - 1] != Continuity::G0;
        let goes_on = [0, 1].map(|i| ring || self.pins[i].is_some() || self.held[i].is_some());
        let (open_start, open_end) = (!(goes_on[0] && first == 0), !(goes_on[1] && last + 1 == self.data.len()));
        let mut walker = Walker::new(&primitive(&self.pieces[k]));
        let mut natural = Natural::ZERO;
        for i in data {
            let datum = self.data[i];
            if i == first && open_start {
                let (v, w) = (datum.point - walker.position, self.weight_of_end(i) * datum.weight);
                normals[k].add(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], v.x, w);
                normals[k].add(&[0.0, 1.0, 0.0, 0.0, 0.0, 0.0], v.y, w);
                normals[k].reached(i, self.end_error(v, walker.tangent, i), datum.weight);
                *energy += w * v.hypot2();
                continue;
            }
            if i == last && open_end {
                // Pieces that no datum reached still lie between here and the end.
                if k + 1 < pieces.end {
                    normals[k].take(&mut natural, &self.pieces[k].q);
                    k = pieces.end - 1;
                    walker = Walker::new(&primitive(&self.pieces[k]));
                }
                walker.go_to(self.pieces[k].q[LENGTH]);
                let (v, w) = (datum.point - walker.position, self.weight_of_end(i) * datum.weight);
                for (n, d) in [(Vec2::new(1.0, 0.0), v.x), (Vec2::new(0.0, 1.0), v.y)] {
                    let mut row = row(&walker, n, &self.pieces[k].q);
                    row[LENGTH] += n.dot(walker.tangent);
                    normals[k].add(&row, d, w);
                }
                normals[k].reached(i, self.end_error(v, walker.tangent, i), datum.weight);
                *energy += w * v.hypot2();
                continue;
            }
            // Where the foot was before saves the search for it from the foot of the last datum.
            let guess = near.get(i).and_then(|near| walker.foot_near(near - before, datum.point));
            let mut foot = guess.unwrap_or_else(|| walker.project(datum.point));
            while k + 1 < pieces.end && foot.s > self.pieces[k].q[LENGTH] {
                let beyond = foot.s - self.pieces[k].q[LENGTH];
                before += self.pieces[k].q[LENGTH];
                normals[k].take(&mut natural, &self.pieces[k].q);
                k += 1;
                walker = Walker::new(&primitive(&self.pieces[k]));
                foot = walker.project_from(beyond, datum.point);
            }
            feet[i] = before + foot.s;
            let q = &self.pieces[k].q;
            let slack = if k > pieces.start { BACK } else { 0.0 };
            let beyond = (foot.s < -slack && (k > pieces.start || open_start))
                || (foot.s > q[LENGTH] && k + 1 == pieces.end && open_end);
            let d = if beyond {
                // Beyond the end the nearest point is the end itself.
                let at_end = foot.s > 0.0;
                walker.go_to(if at_end { q[LENGTH] } else { 0.0 });
                let v = datum.point - walker.position;
                let d = v.hypot2().sqrt();
                let n = if d > 0.0 { v / d } else { Vec2::ZERO };
                let mut row = row(&walker, n, q);
                if at_end {
                    row[LENGTH] += n.dot(walker.tangent);
                }
                normals[k].add(&row, d, datum.weight);
                d
            } else {
                natural.add(&walker.natural_row(), foot.distance, datum.weight);
                foot.distance
            };
            normals[k].reached(i, d.abs(), datum.weight);
            *energy += datum.weight * d * d;
        }
        normals[k].take(&mut natural, &self.pieces[k].q);
    }
}

impl Chain<'_> {
    /// Weight of an end's datum. Arms that meet at an acute corner would run on to where they cross; the drawn tip holds them.
    fn weight_of_end(&self, datum: usize) -> f64 {
        let is_end = (datum == 0 || datum + 1 == self.data.len()) && !self.closed;
        if is_end { self.end_factor } else { CORNER_FACTOR * self.end_factor }
    }

    /// The distance of an end's datum: at a corner, where the curves meet a little off the drawn tip, only what lies across.
    fn end_error(&self, v: Vec2, tangent: Vec2, datum: usize) -> f64 {
        let is_end = datum == 0 || datum + 1 == self.data.len();
        if is_end && !self.closed { v.hypot2().sqrt() } else { tangent.cross(v).abs() }
    }
}

fn primitive(piece: &Piece) -> Primitive {
    let [x, y, heading, kappa0, kappa1, length] = piece.q;
    Primitive { start: Vec2::new(x, y), heading, kappa: kappa0, sharpness: (kappa1 - kappa0) / length }
}

/// Derivatives of the position's component along `n` by the piece's parameters, arc length held.
#[inline]
fn row(walker: &Walker, n: Vec2, q: &[f64; Q]) -> [f64; Q] {
    let [by_heading, by_kappa, by_sharpness] = walker.jacobian().map(|v| n.dot(v));
    let per_length = by_sharpness / q[LENGTH];
    let sharpness = (q[KAPPA1] - q[KAPPA0]) / q[LENGTH];
    [n.x, n.y, by_heading, by_kappa - per_length, per_length, -sharpness * per_length]
}

/// The pose at the end of a piece: x, y, heading, curvature; and its derivatives by the piece's parameters.
pub(crate) fn end_with_jacobian(q: &[f64; Q]) -> ([f64; 4], [[f64; Q]; 4]) {
    let [x, y, heading, kappa0, kappa1, length] = *q;
    let s = Segment { start: Point::new(x, y), heading, length, kappa0, kappa1 };
    let j = s.position_jacobian(length);
    let end = s.end_pose();
    let along = j.length + trig::unit(end.heading);
    let half = 0.5 * length;
    (
        [end.point.x, end.point.y, end.heading, kappa1],
        [
            [1.0, 0.0, j.heading.x, j.kappa0.x, j.kappa1.x, along.x],
            [0.0, 1.0, j.heading.y, j.kappa0.y, j.kappa1.y, along.y],
            [0.0, 0.0, 1.0, half, half, 0.5 * (kappa0 + kappa1)],
            [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        ],
    )
}

/// The pose at the end of a piece: x, y, heading, curvature.
pub(crate) fn end(q: &[f64; Q]) -> [f64; 4] {
    let [x, y, heading, kappa0, kappa1, length] = *q;
    let p = Segment { start: Point::new(x, y), heading, length, kappa0, kappa1 }.end_pose();
    [p.point.x, p.point.y, p.heading, p.curvature]
}
