//! Strokes, and hands that draw them.

use fairpath_curve::{Point, Spline, Vec2};
use fairpath_fit::Stroke;
use fairpath_io::{ReadOptions, StrokeFormat, read_strokes_from};
use fairpath_sketch::{CurveId, Session, run};
use std::f64::consts::TAU;
use std::path::Path;

/// Points of a curve by its equation, with the tremor of a hand: the same on every run.
pub(crate) fn points(count: usize, place: impl Fn(f64) -> (f64, f64)) -> Vec<Point> {
    let tremor = |i: usize, k: f64| 0.4 * (k * i as f64).sin();
    let point = |i: usize| {
        let (x, y) = place(i as f64 / (count - 1) as f64);
        Point::new(x + tremor(i, 1.7), y + tremor(i, 2.3))
    };
    (0..count).map(point).collect()
}

/// Two bends.
pub(crate) fn wave() -> Vec<Point> {
    points(90, |u| (40.0 + 320.0 * u, 120.0 + 50.0 * (6.5 * u).sin()))
}

/// Most of a circle, open.
pub(crate) fn arch() -> Vec<Point> {
    points(70, |u| (500.0 + 80.0 * (0.4 + 5.0 * u).cos(), 150.0 + 80.0 * (0.4 + 5.0 * u).sin()))
}

/// A closed ellipse.
pub(crate) fn ring() -> Vec<Point> {
    points(100, |u| (240.0 + 110.0 * (TAU * u).cos(), 320.0 + 60.0 * (TAU * u).sin()))
}

/// Two straight legs.
pub(crate) fn corner() -> Vec<Point> {
    points(61, |u| if u < 0.5 { (60.0 + 240.0 * u, 420.0) } else { (180.0, 420.0 + 220.0 * (u - 0.5)) })
}

/// An eight, which crosses itself.
pub(crate) fn eight() -> Vec<Point> {
    points(140, |u| (520.0 + 120.0 * (6.1 * u).sin(), 380.0 + 60.0 * (12.2 * u).sin()))
}

pub(crate) fn shapes() -> [Vec<Point>; 5] {
    [wave(), arch(), ring(), corner(), eight()]
}

/// Draws a stroke.
pub(crate) fn draw(session: &mut Session, points: &[Point]) {
    session.begin_stroke(1.0, false);
    for (i, &point) in points.iter().enumerate() {
        session.extend_stroke(point, Some(0.01 * i as f64), None);
    }
    session.finish_stroke(false);
}

/// Does the next job, if there is one.
pub(crate) fn work_once(session: &mut Session) -> bool {
    let Some((ticket, job)) = session.next_job() else { return false };
    session.take_answer(ticket, run(&job));
    true
}

/// Does all jobs.
pub(crate) fn settle(session: &mut Session) {
    let mut done = 0;
    while work_once(session) {
        done += 1;
        assert!(done < 1000, "the session never settles");
    }
    assert!(session.is_settled());
}

/// A session with these strokes, all of them fitted.
pub(crate) fn session_of(strokes: &[Vec<Point>]) -> (Session, Vec<CurveId>) {
    let mut session = Session::default();
    for points in strokes {
        session.begin_stroke(1.0, false);
        points.iter().for_each(|&point| session.extend_stroke(point, None, None));
        session.finish_stroke(true);
        settle(&mut session);
    }
    assert_eq!(session.drawing().curves().len(), strokes.len());
    let ids = session.drawing().curves().iter().map(|curve| curve.id).collect();
    (session, ids)
}

/// The curve of an identity.
pub(crate) fn spline(session: &Session, id: CurveId) -> &Spline {
    &session.drawing().curve(id).expect("it is in the drawing").spline
}

/// Points beside a part of a curve: they leave it, are `away` from it in the middle, and come back.
pub(crate) fn beside(curve: &Spline, from: f64, to: f64, away: f64) -> Vec<Point> {
    let count = ((to - from) / 3.0).ceil().max(8.0) as usize;
    (0..=count)
        .map(|i| {
            let u = i as f64 / count as f64;
            let pose = curve.pose_at(from + (to - from) * u);
            let normal = Vec2::new(-pose.heading.sin(), pose.heading.cos());
            pose.point + normal * (away * (std::f64::consts::PI * u).sin().powi(2))
        })
        .collect()
}

/// How far the curves are apart at most: each sampled against the other.
pub(crate) fn apart(a: &Spline, b: &Spline) -> f64 {
    let one_way = |from: &Spline, to: &Spline| {
        from.samples(1.0).into_iter().map(|pose| to.nearest(pose.point).distance).fold(0.0, f64::max)
    };
    one_way(a, b).max(one_way(b, a))
}

/// All that a curve is made of, bit by bit.
pub(crate) fn bits(spline: &Spline) -> Vec<[u64; 6]> {
    let of =
        |s: &fairpath_curve::Segment| [s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1].map(f64::to_bits);
    spline.segments().iter().map(of).collect()
}

/// The strokes of a file of the corpus, where that is; where tests must run whole, it has to be.
pub(crate) fn corpus(name: &str) -> Option<Vec<Stroke>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/strokes").join(name);
    if !file.is_file() {
        assert!(std::env::var_os("CI").is_none(), "the strokes are not at {}", file.display());
        eprintln!("skipped: the strokes are not at {}", file.display());
        return None;
    }
    let bytes = std::fs::read(&file).expect("the file can be read");
    let read = read_strokes_from(&bytes[..], name, Some(StrokeFormat::Json), &ReadOptions::default());
    Some(read.expect("the corpus is sound").strokes)
}
