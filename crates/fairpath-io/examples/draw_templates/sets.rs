//! The sets of French curves that come with the library, as they are noted down.
//!
//! Curvatures are in radians per px and lengths in px of 100 to the inch. The shapes are drawn for a page whose y points up and mirrored for
//! the screen's frame, where it points down.

use crate::chain::{Knot, open, ring};
use fairpath_curve::{Continuity, Point, Segment, Spline};
use fairpath_fit::{Template, TemplateSet};
use std::f64::consts::{FRAC_PI_2, TAU};

/// All sets.
pub(crate) fn all() -> Vec<TemplateSet> {
    vec![burmester(), rectilinear(), automotive()]
}

fn template(name: &str, spline: Spline) -> Template {
    Template::new(name, spline).expect("the shape is a French curve")
}

fn set(name: &str, templates: Vec<Template>) -> TemplateSet {
    TemplateSet::new(name, templates).expect("the names differ")
}

fn mirrored(knots: &[Knot]) -> Vec<Knot> {
    knots.iter().map(|&(length, kappa)| (length, -kappa)).collect()
}

/// Four curves in the manner of Burmester's: sweeps of ever increasing bend that end in tight tips, long ones and short ones, the hollow
/// beside the round. Between them every radius from 9 px to straight occurs, at several rates of change.
fn burmester() -> TemplateSet {
    let closed = |name, heading: f64, knots: &[Knot]| template(name, ring(-heading, &mirrored(knots)));
    set(
        "burmester",
        vec![
            closed(
                "sickle",
                -0.50,
                &[
                    (860.0, 0.0005),
                    (228.0, 0.0018),
                    (160.0, 0.011),
                    (42.0, 0.017),
                    (247.0, -0.0058),
                    (495.0, -0.0022),
                    (118.0, -0.0008),
                    (46.0, 0.004),
                    (30.0, 0.074),
                ],
            ),
            closed(
                "horn",
                -0.27,
                &[
                    (368.0, -0.0005),
                    (192.0, 0.0018),
                    (84.0, 0.005),
                    (54.0, 0.013),
                    (36.0, 0.036),
                    (104.0, 0.008),
                    (99.0, -0.012),
                    (99.0, -0.007),
                    (36.0, -0.0014),
                    (24.0, 0.0),
                    (24.0, 0.098),
                    (107.0, 0.0),
                    (128.0, -0.0053),
                    (90.0, -0.0038),
                    (24.0, 0.0),
                    (26.0, 0.11),
                ],
            ),
            closed(
                "scroll",
                -0.27,
                &[
                    (120.0, 0.0045),
                    (112.0, 0.0062),
                    (104.0, 0.0075),
                    (98.0, 0.0085),
                    (79.0, 0.01),
                    (47.0, 0.015),
                    (25.0, 0.0235),
                    (22.0, 0.067),
                    (35.0, 0.0),
                    (56.0, -0.028),
                    (60.0, -0.022),
                    (72.0, -0.015),
                    (112.0, -0.0054),
                    (76.0, -0.001),
                    (24.0, 0.0),
                    (26.0, 0.11),
                    (120.0, 0.0),
                    (114.0, 0.002),
                ],
            ),
            closed(
                "pear",
                -1.54,
                &[
                    (95.0, 0.019),
                    (125.0, 0.008),
                    (150.0, 0.0005),
                    (50.0, 0.0002),
                    (24.0, 0.002),
                    (24.0, 0.115),
                    (70.0, 0.0),
                    (150.0, -0.0022),
                    (130.0, -0.0005),
                    (100.0, 0.0095),
                ],
            ),
        ],
    )
}

/// Straight lines and right angles only. A right angle to the other side is the same run through backward.
fn rectilinear() -> TemplateSet {
    set(
        "rectilinear",
        vec![
            template("line", angular(&[3000.0], &[])),
            template("right angle", angular(&[1500.0, 1500.0], &[1])),
            template("U", angular(&[1000.0, 200.0, 1000.0], &[1, 1])),
            template("step", angular(&[1000.0, 100.0, 1000.0], &[1, -1])),
        ],
    )
}

/// Lines of these lengths, each a quarter turn further than the one before, to the side that `turns` says.
fn angular(lengths: &[f64], turns: &[i32]) -> Spline {
    // Whole quarters and whole px, so that not even rounding bends them.
    const STEPS: [(f64, f64); 4] = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
    let mut quarter: i32 = 0;
    let mut at = Point::ORIGIN;
    let mut segments = Vec::new();
    for (i, &length) in lengths.iter().enumerate() {
        quarter += if i > 0 { turns[i - 1] } else { 0 };
        segments.push(Segment::line(at, f64::from(quarter) * FRAC_PI_2, length));
        let (x, y) = STEPS[quarter.rem_euclid(4) as usize];
        at += (x * length, y * length);
    }
    let joins = vec![Continuity::G0; turns.len()];
    Spline::new(segments, joins, false).expect("lines end where the next begin")
}

/// Nothing straight: wheels, arches over them, panels with crowned sides, and long sweeps.
fn automotive() -> TemplateSet {
    let mut templates: Vec<Template> = RADII.iter().map(|&radius| circle(radius)).collect();
    let chain = |name, heading: f64, knots: &[Knot]| template(name, open(-heading, &mirrored(knots)));
    // A sweep is bent most in its middle and ever less towards its ends; its crown is up.
    let sweep = |name, half: f64, end: f64, middle: f64| {
        let turn = half * (end + middle) * 0.5;
        chain(name, turn, &[(half, -end), (half, -middle), (0.0, -end)])
    };
    templates.extend([
        sweep("roof", 900.0, 1.0 / 4000.0, 1.0 / 600.0),
        sweep("bonnet", 400.0, 1.0 / 2500.0, 1.0 / 250.0),
        sweep("wing", 160.0, 1.0 / 1200.0, 1.0 / 90.0),
        chain("waistline", 0.3, &[(700.0, -1.0 / 600.0), (700.0, 1.0 / 5000.0), (0.0, 1.0 / 900.0)]),
        chain(
            "tail",
            0.15,
            &[
                (400.0, -1.0 / 1500.0),
                (90.0, -1.0 / 500.0),
                (60.0, -1.0 / 35.0),
                (140.0, 1.0 / 220.0),
                (0.0, 1.0 / 900.0),
            ],
        ),
        chain("wheel arch", 90.0 * CROWN, &arch()),
        fillet("small fillet", 20.0),
        fillet("fillet", 50.0),
        fillet("large fillet", 125.0),
        template("panel", ring(-180.0 * CROWN, &panel())),
    ]);
    set("automotive", templates)
}

/// Radii of the circles, px: preferred numbers, each about 1.6 times the one before.
const RADII: [f64; 8] = [12.5, 20.0, 31.5, 50.0, 80.0, 125.0, 200.0, 315.0];

fn circle(radius: f64) -> Template {
    let round = Segment::arc(Point::ORIGIN, 0.0, TAU * radius, 1.0 / radius);
    let spline = Spline::new(vec![round], vec![Continuity::G2], true).expect("a whole turn closes");
    template(&format!("circle {radius}"), spline)
}

/// Crown of what would be straight elsewhere, radians per px.
const CROWN: f64 = 1.0 / 3000.0;

/// Sill, hollow, the arch over the wheel, and the same back.
fn arch() -> Vec<Knot> {
    let (hollow, round) = (1.0 / 22.0, -1.0 / 95.0);
    let into_hollow = 30.0;
    let along_hollow = 8.0;
    let out_of_hollow = 14.0;
    // The arch undoes what both hollows turn.
    let turn = 0.5 * into_hollow * (hollow - CROWN) + along_hollow * hollow + 0.5 * out_of_hollow * (hollow + round);
    vec![
        (180.0, -CROWN),
        (into_hollow, -CROWN),
        (along_hollow, hollow),
        (out_of_hollow, hollow),
        (-2.0 * turn / round, round),
        (out_of_hollow, round),
        (along_hollow, hollow),
        (into_hollow, hollow),
        (180.0, -CROWN),
        (0.0, -CROWN),
    ]
}

/// A quarter turn between crowned sides, with transitions as long as the arc between them.
fn fillet(name: &str, radius: f64) -> Template {
    let side = 4.0 * radius + 100.0;
    let turn = FRAC_PI_2 - 2.0 * side * CROWN;
    // The transitions turn by half of what an arc of their length does, and by half the crown beside.
    let part = turn / (2.0 / radius + CROWN);
    let kappa = 1.0 / radius;
    let knots = [(side, CROWN), (part, CROWN), (part, kappa), (part, kappa), (side, CROWN), (0.0, CROWN)];
    template(name, open(0.0, &mirrored(&knots)))
}

/// A rounded rectangle with crowned sides, clockwise on the screen.
fn panel() -> Vec<Knot> {
    let corner = 1.0 / 45.0;
    let side = |length: f64| [(length, CROWN), (40.0, CROWN), (30.0, corner), (40.0, corner)];
    [side(360.0), side(180.0), side(360.0), side(180.0)].concat()
}
