//! Small shapes that several tests use.

#[path = "chain.rs"]
mod chain;

use chain::chain;
use fairpath_curve::{Continuity, Spline};
use fairpath_io::{SplineEntry, SplineFile};

/// An open spline of line, clothoid, arc, clothoid, clothoid and line, G2 throughout.
pub(crate) fn ribbon(start: (f64, f64)) -> Spline {
    let pieces = [
        (120.0, 0.0, 0.0),
        (90.0, 0.0, 0.02),
        (110.0, 0.02, 0.02),
        (100.0, 0.02, -0.012),
        (150.0, -0.012, -0.012),
        (80.0, -0.012, 0.0),
        (60.0, 0.0, 0.0),
    ];
    Spline::new(chain(start, 0.3, &pieces), vec![Continuity::G2; 6], false).expect("the shape is a spline")
}

/// A closed drop of a line, an arc of three quarters and a line, with one corner.
pub(crate) fn drop_shape() -> Spline {
    let r = 50.0;
    let turn = 1.5 * std::f64::consts::PI;
    let segments = chain((0.0, 0.0), 0.0, &[(r, 0.0, 0.0), (turn * r, 1.0 / r, 1.0 / r), (r, 0.0, 0.0)]);
    Spline::new(segments, vec![Continuity::G1, Continuity::G1, Continuity::G0], true).expect("the shape is a spline")
}

/// An entry without a report.
pub(crate) fn entry(name: &str, spline: Spline) -> SplineEntry {
    SplineEntry {
        name: name.into(),
        method: "by-hand".into(),
        spline,
        report: None,
        templates: None,
        warnings: Vec::new(),
    }
}

/// A file of both shapes.
pub(crate) fn shapes() -> SplineFile {
    SplineFile {
        splines: vec![entry("ribbon", ribbon((-40.0, 30.0))), entry("drop/1", drop_shape())],
        ..SplineFile::default()
    }
}
