//! Cases and our answers, for an independent judge: one JSON object a line, the same ones on every run.
//!
//! `cargo run --release -p fairpath-curve --example kernel_cases | python tools/judge_kernel.py`

use fairpath_curve::{Point, Pose, Segment, Vec2, hermite_g1, hermite_g2};
use std::f64::consts::PI;

/// A linear congruential generator: quality enough to scatter cases.
struct Scatter(u64);

impl Scatter {
    /// A number in [low, high).
    fn number(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A power of ten with an exponent in [low, high), of either sign.
    fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        let value = libm::exp10(self.number(low, high));
        if self.number(0.0, 1.0) < 0.5 { -value } else { value }
    }
}

/// A segment; every kind of degeneracy has its turn.
fn segment(r: &mut Scatter, i: usize, turn: f64) -> Segment {
    let length = libm::exp10(r.number(-6.0, 6.0));
    let wide = r.number(-turn, turn);
    let (a, b) = match i % 8 {
        0 => (wide, r.number(-turn, turn)),
        1 => (r.number(-2.0, 2.0), r.number(-2.0, 2.0)),
        2 => (wide, wide + r.magnitude(-18.0, -6.0)),
        3 => (r.magnitude(-18.0, -3.0), r.magnitude(-18.0, -3.0)),
        4 => (wide, wide),
        5 => (0.0, wide),
        6 => (wide, -wide * (1.0 + r.magnitude(-12.0, -2.0))),
        _ => (0.0, r.magnitude(-18.0, 0.0)),
    };
    let heading = match i % 5 {
        0 => r.number(-PI, PI),
        1 => PI + r.magnitude(-16.0, -6.0),
        2 => -PI + r.magnitude(-16.0, -6.0),
        3 => 0.5 * PI * libm::floor(r.number(-4.0, 5.0)),
        _ => r.number(-30.0, 30.0),
    };
    let start = Point::new(r.number(-1.0, 1.0) * length, r.number(-1.0, 1.0) * length);
    Segment::clothoid(start, heading, length, a / length, b / length)
}

fn fields(s: &Segment) -> String {
    format!("[{:?},{:?},{:?},{:?},{:?},{:?}]", s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1)
}

fn evaluations(r: &mut Scatter) {
    for i in 0..4000 {
        // Both curvatures × length up to 100 keep |turning| within 100 rad.
        let segment = segment(r, i, 100.0);
        let s = if i % 3 == 0 { segment.length } else { r.number(0.0, 1.0) * segment.length };
        let p = segment.point_at(s);
        println!(r#"{{"case":"evaluate","segment":{},"s":{s:?},"x":{:?},"y":{:?}}}"#, fields(&segment), p.x, p.y);
    }
    // Another program, which divides by the sharpness, evaluates this one 20 px off.
    let segment = Segment::clothoid(Point::ORIGIN, 0.0, 600.0, 0.1, 0.1 + 2e-12 * 600.0);
    let p = segment.end();
    println!(r#"{{"case":"evaluate","segment":{},"s":600.0,"x":{:?},"y":{:?}}}"#, fields(&segment), p.x, p.y);
}

fn nearest(r: &mut Scatter) {
    for i in 0..1500 {
        let segment = segment(r, i, if i % 4 == 0 { 60.0 } else { 8.0 });
        let far = if i % 7 == 0 { 10.0 } else { 0.7 };
        let along = segment.point_at(r.number(0.0, 1.0) * segment.length);
        let p = along + Vec2::new(r.number(-far, far), r.number(-far, far)) * segment.length;
        let n = segment.nearest(p);
        println!(
            r#"{{"case":"nearest","segment":{},"point":[{:?},{:?}],"s":{:?},"distance":{:?}}}"#,
            fields(&segment),
            p.x,
            p.y,
            n.s,
            n.distance
        );
    }
}

fn angle(r: &mut Scatter, i: usize) -> f64 {
    match i % 6 {
        0 => r.magnitude(-15.0, -3.0),
        1 => (PI - libm::exp10(r.number(-6.0, -1.0))) * if r.number(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 },
        2 => 0.5 * PI * libm::floor(r.number(-1.0, 2.0)),
        _ => r.number(-PI, PI),
    }
}

fn hermite(r: &mut Scatter) {
    for i in 0..3000 {
        let scale = libm::exp10(r.number(-6.0, 6.0));
        let start = Point::new(r.number(-1.0, 1.0) * scale, r.number(-1.0, 1.0) * scale);
        let direction = r.number(-PI, PI);
        let distance = r.number(0.1, 2.0) * scale;
        let end = start + Vec2::new(libm::cos(direction), libm::sin(direction)) * distance;
        let (phi0, phi1) = (angle(r, i), angle(r, i / 6));
        // Straight back at both ends in opposite senses: no clothoid of bounded length.
        if (phi0 - phi1).abs() > 2.0 * PI - 0.1 {
            continue;
        }
        let (h0, h1) = (direction + phi0, direction + phi1);
        let answer = hermite_g1(start, h0, end, h1).map_or("null".into(), |s| fields(&s));
        println!(
            r#"{{"case":"g1","start":[{:?},{:?},{h0:?}],"end":[{:?},{:?},{h1:?}],"answer":{answer}}}"#,
            start.x, start.y, end.x, end.y
        );
    }
    for i in 0..1500 {
        let bend = if i % 3 == 0 { 15.0 } else { 4.0 };
        let curvature = |r: &mut Scatter| match i % 5 {
            0 => 0.0,
            1 => r.magnitude(-12.0, -2.0),
            _ => r.number(-bend, bend),
        };
        let (phi0, phi1) = (angle(r, i) * 0.95, angle(r, i / 6) * 0.95);
        let pose = |point: Point, heading: f64, curvature: f64| Pose { point, heading, curvature };
        let (k0, k1) = (curvature(r), curvature(r));
        let (a, b) = (pose(Point::ORIGIN, phi0, k0), pose(Point::new(1.0, 0.0), phi1, k1));
        let answer = hermite_g2(a, b)
            .map_or("null".into(), |s| format!("[{}]", s.iter().map(fields).collect::<Vec<_>>().join(",")));
        println!(
            r#"{{"case":"g2","start":[0.0,0.0,{phi0:?},{k0:?}],"end":[1.0,0.0,{phi1:?},{k1:?}],"answer":{answer}}}"#
        );
    }
}

fn main() {
    let mut scatter = Scatter(20_100_405);
    evaluations(&mut scatter);
    nearest(&mut scatter);
    hermite(&mut scatter);
}
