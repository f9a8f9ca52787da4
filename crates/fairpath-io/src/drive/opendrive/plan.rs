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

/// The profile of a road, which begins at station 0.
pub(super) fn write_elevation(xml: &mut Xml, profile: &Profile) {
    xml.open("elevationProfile", &[]);
    for (i, knot) in profile.knots().iter().enumerate().take(profile.knots().len() - 1) {
        let [a, b, c, d] = profile.cubic(i).map(number);
        let s = number(knot.station_m);
        xml.empty("elevation", &[("s", &s), ("a", &a), ("b", &b), ("c", &c), ("d", &d)]);
    }
    xml.close("elevationProfile");
}
