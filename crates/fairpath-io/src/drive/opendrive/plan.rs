//! Plan view and elevation of a road.

use crate::drive::xml::{Xml, number};
use fairpath_curve::{Segment, Spline};
use fairpath_drive::Profile;

/// Curvatures that differ by less are equal, 1/m: readers take a spiral or an arc of less for broken.
const SAME_CURVATURE: f64 = 1e-11;

/// Segments that are shorter are left out: the next one begins where they do to within this, m.
const SHORTEST_M: f64 = 1e-6;

/// Lines whose headings differ by less are one, radians.
const SAME_HEADING: f64 = 1e-12;

/// What a plan is as geometries: no empty ones, no two lines after each other.
pub(super) fn geometries(plan: &Spline) -> Vec<Segment> {
    let mut kept: Vec<Segment> = Vec::new();
    for segment in plan.segments().iter().filter(|s| s.length > SHORTEST_M) {
        let straight = |s: &Segment| s.kappa0.abs() < SAME_CURVATURE && s.kappa1.abs() < SAME_CURVATURE;
        match kept.last_mut() {
            Some(last) if straight(last) && straight(segment) && same_heading(last, segment) => {
                last.length += segment.length;
            }
            _ => kept.push(*segment),
        }
    }
    kept
}

fn same_heading(a: &Segment, b: &Segment) -> bool {
    fairpath_curve::trig::wrap_angle(a.heading - b.heading).abs() < SAME_HEADING
}

/// The length of a road with these geometries, m.
pub(super) fn length(geometries: &[Segment]) -> f64 {
    geometries.iter().map(|g| g.length).sum()
}

pub(super) fn write_plan(xml: &mut Xml, geometries: &[Segment]) {
    xml.open("planView", &[]);
    let mut s = 0.0;
    for g in geometries {
        let numbers = [s, g.start.x, g.start.y, g.heading, g.length].map(number);
        let [at, x, y, hdg, length] = &numbers;
        xml.open("geometry", &[("s", at), ("x", x), ("y", y), ("hdg", hdg), ("length", length)]);
        if g.kappa0.abs() < SAME_CURVATURE && g.kappa1.abs() < SAME_CURVATURE {
            xml.empty("line", &[]);
        } else if (g.kappa1 - g.kappa0).abs() < SAME_CURVATURE {
            xml.empty("arc", &[("curvature", &number(g.kappa0))]);
        } else {
            xml.empty("spiral", &[("curvStart", &number(g.kappa0)), ("curvEnd", &number(g.kappa1))]);
        }
        xml.close("geometry");
        s += g.length;
    }
    xml.close("planView");
}

/// A cubic that another one goes on for may be off by this in height, m, and grade.
const SAME_HEIGHT_M: f64 = 1e-6;
const SAME_GRADE: f64 = 1e-7;

/// The profile of a road, which begins at station 0. A piece that merely goes on as the one before has no record of its own.
pub(super) fn write_elevation(xml: &mut Xml, profile: &Profile) {
    xml.open("elevationProfile", &[]);
    let mut written: Option<(f64, [f64; 4])> = None;
    for (i, knot) in profile.knots().iter().enumerate().take(profile.knots().len() - 1) {
        let cubic = profile.cubic(i);
        let ends = [knot.station_m, profile.knots()[i + 1].station_m];
        let goes_on = written.is_some_and(|(from, before)| {
            ends.iter().all(|&station| {
                let ([z, grade], [w, slope]) = (value(before, station - from), value(cubic, station - knot.station_m));
                (z - w).abs() <= SAME_HEIGHT_M && (grade - slope).abs() <= SAME_GRADE
            })
        });
        if goes_on {
            continue;
        }
        written = Some((knot.station_m, cubic));
        let ([a, b, c, d], s) = (cubic.map(number), number(knot.station_m));
        xml.empty("elevation", &[("s", &s), ("a", &a), ("b", &b), ("c", &c), ("d", &d)]);
    }
    xml.close("elevationProfile");
}

/// Height and grade of a cubic.
fn value([a, b, c, d]: [f64; 4], s: f64) -> [f64; 2] {
    [a + s * (b + s * (c + s * d)), b + s * (2.0 * c + 3.0 * d * s)]
}
