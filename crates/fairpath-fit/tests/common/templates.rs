//! French curves made in code.

use fairpath_curve::{Continuity, Point, Segment, Spline};
use fairpath_fit::{FitOptions, Preset, Stroke, Template, TemplateSet, fit};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Segments of given length and curvatures that follow each other, after a turn of the given angle where that is not nought.
pub(crate) fn chain(pieces: &[(f64, f64, f64, f64)]) -> Spline {
    let (mut start, mut heading) = (Point::ORIGIN, 0.0);
    let (mut segments, mut joins) = (Vec::new(), Vec::new());
    for (i, &(turn, length, kappa0, kappa1)) in pieces.iter().enumerate() {
        heading += turn;
        if i > 0 {
            joins.push(if turn == 0.0 { Continuity::G2 } else { Continuity::G0 });
        }
        let segment = Segment { start, heading, length, kappa0, kappa1 };
        (start, heading) = (segment.end(), segment.end_heading());
        segments.push(segment);
    }
    Spline::new(segments, joins, false).unwrap()
}

/// A closed shape of clothoids near the points of a closed curve given by its angle.
pub(crate) fn ring(at: impl Fn(f64) -> (f64, f64)) -> Spline {
    let points = (0..=300).map(|i| f64::from(i) / 300.0 * TAU).map(at).map(|(x, y)| Point::new(x, y)).collect();
    let spline = fit(&Stroke::new("ring", points), &FitOptions::preset(Preset::Accurate)).unwrap().spline;
    assert!(spline.is_closed());
    spline
}

pub(crate) fn set(templates: Vec<(&str, Spline)>) -> TemplateSet {
    let templates = templates.into_iter().map(|(name, spline)| Template::new(name, spline).unwrap()).collect();
    TemplateSet::new("test", templates).unwrap()
}

/// Shapes like those of Burmester: two closed ones and a long sweep.
pub(crate) fn burmester() -> TemplateSet {
    let egg = ring(|t| {
        let r = 1.0 + 0.25 * t.cos();
        (130.0 * r * t.cos(), 80.0 * r * t.sin())
    });
    let comma = ring(|t| {
        let r = 1.0 + 0.45 * t.cos() + 0.15 * (2.0 * t + 0.8).sin();
        (55.0 * r * t.cos(), 45.0 * r * t.sin())
    });
    let sweep = chain(&[(0.0, 400.0, 0.0, 0.004), (0.0, 300.0, 0.004, 0.03), (0.0, 120.0, 0.03, 0.1)]);
    set(vec![("egg", egg), ("comma", comma), ("sweep", sweep)])
}

/// A line and a right angle.
pub(crate) fn rectilinear() -> TemplateSet {
    let angle = chain(&[(0.0, 800.0, 0.0, 0.0), (FRAC_PI_2, 800.0, 0.0, 0.0)]);
    set(vec![("line", chain(&[(0.0, 1500.0, 0.0, 0.0)])), ("angle", angle)])
}

/// A circle.
pub(crate) fn wheel(radius: f64) -> TemplateSet {
    let arc = Segment::arc(Point::ORIGIN, 0.0, TAU * radius, 1.0 / radius);
    set(vec![("wheel", Spline::new(vec![arc], vec![Continuity::G3], true).unwrap())])
}

/// Two waves, each 80 px long.
pub(crate) fn wave() -> TemplateSet {
    let half = |k: f64| [(0.0, 20.0, 0.0, k), (0.0, 20.0, k, 0.0)];
    let waves: Vec<_> = [0.1, -0.1, 0.1, -0.1].into_iter().flat_map(half).collect();
    set(vec![("wave", chain(&waves))])
}
