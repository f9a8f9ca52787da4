//! Signs as pieces: a post and a plate, with the shapes that drivers know (those of the United States, where the thesis's example stands).

use super::shape::{cuboid, plate};
use super::{Finish, Instances, Part, Placement, Scene, part};
use crate::document::Results;
use crate::furniture::SignKind;
use crate::section::Material;
use fairpath_curve::trig;
use std::collections::BTreeMap;

/// Height of a plate's middle, m.
const MIDDLE_M: f64 = 2.2;

/// Half a plate's height, m.
const HALF_M: f64 = 0.38;

pub(super) fn add(scene: &mut Scene, results: &Results) {
    let mut at: BTreeMap<SignKind, Vec<Placement>> = BTreeMap::new();
    for (path, signs) in results.paths.iter().zip(&results.signs) {
        for sign in signs.iter() {
            let (p, heading_rad) = sign.stands(&path.path);
            let z = path.profile.at(sign.station_m).height_m - 0.1;
            let placement = Placement { position: [p.x, p.y, z], heading_rad, pitch_rad: 0.0, scale: 1.0 };
            at.entry(sign.kind).or_default().push(placement);
        }
    }
    for (kind, at) in at {
        scene.instances.push(Instances { name: name(kind), parts: parts(kind), at });
    }
}

fn name(kind: SignKind) -> String {
    match kind {
        SignKind::Stop => "sign: stop".to_owned(),
        SignKind::StopAhead => "sign: stop ahead".to_owned(),
        SignKind::SharpLeft => "sign: sharp bend to the left".to_owned(),
        SignKind::SharpRight => "sign: sharp bend to the right".to_owned(),
        SignKind::Bump => "sign: bump".to_owned(),
        SignKind::Dip => "sign: dip".to_owned(),
        SignKind::SpeedLimit(kmh) => format!("sign: {kmh} km/h"),
    }
}

/// The pieces of a sign, which those who drive along x see.
fn parts(kind: SignKind) -> Vec<Part> {
    let mut parts = vec![part("post", Finish::Section(Material::Steel), |m| {
        cuboid(m, [0.05, 0.0, -0.5], [0.06, 0.06, MIDDLE_M + 0.5]);
    })];
    let polygon = |sides: usize, turn: f64, radius: f64| -> Vec<[f64; 2]> {
        (0..sides)
            .map(|k| {
                let (sin, cos) = trig::sin_cos(std::f64::consts::TAU * (k as f64 + turn) / sides as f64);
                [radius * cos, MIDDLE_M + radius * sin]
            })
            .collect()
    };
    let mut add = |name: &str, finish: Finish, x: f64, outlines: &[Vec<[f64; 2]>]| {
        parts.push(part(name, finish, |m| outlines.iter().for_each(|o| plate(m, x, o))));
    };
    match kind {
        SignKind::Stop => {
            add("plate", Finish::SignRed, 0.0, &[polygon(8, 0.5, HALF_M)]);
            add("bar", Finish::SignWhite, -0.01, &[bar([-0.24, -0.06], [0.24, 0.06])]);
        }
        SignKind::SpeedLimit(kmh) => {
            add("ring", Finish::SignRed, 0.0, &[polygon(24, 0.0, HALF_M)]);
            add("plate", Finish::SignWhite, -0.01, &[polygon(24, 0.0, 0.8 * HALF_M)]);
            add("number", Finish::SignBlack, -0.02, &number(kmh));
        }
        warning => {
            add("plate", Finish::SignYellow, 0.0, &[polygon(4, 0.0, 1.25 * HALF_M)]);
            add("symbol", Finish::SignBlack, -0.01, &symbol(warning));
        }
    }
    parts
}

/// A rectangle about the plate's middle: to the left and up, m.
fn bar([y0, z0]: [f64; 2], [y1, z1]: [f64; 2]) -> Vec<[f64; 2]> {
    [[y0, z0], [y1, z0], [y1, z1], [y0, z1]].map(|[y, z]| [y, MIDDLE_M + z]).to_vec()
}

/// What a warning shows, of bars and triangles; y runs to the left.
fn symbol(kind: SignKind) -> Vec<Vec<[f64; 2]>> {
    let mirrored = |outlines: Vec<Vec<[f64; 2]>>| -> Vec<Vec<[f64; 2]>> {
        outlines.into_iter().map(|o| o.into_iter().rev().map(|[y, z]| [-y, z]).collect()).collect()
    };
    let tip = |points: [[f64; 2]; 3]| points.map(|[y, z]| [y, MIDDLE_M + z]).to_vec();
    let left = vec![
        bar([-0.15, -0.22], [-0.07, 0.1]),
        bar([-0.07, 0.02], [0.08, 0.1]),
        tip([[0.08, -0.06], [0.24, 0.06], [0.08, 0.18]]),
    ];
    match kind {
        SignKind::SharpLeft => left,
        SignKind::SharpRight => mirrored(left),
        SignKind::Bump => vec![bar([-0.24, -0.1], [0.24, -0.05]), tip([[-0.14, -0.05], [0.14, -0.05], [0.0, 0.1]])],
        SignKind::Dip => vec![
            bar([-0.24, 0.03], [-0.12, 0.08]),
            bar([0.12, 0.03], [0.24, 0.08]),
            tip([[-0.14, 0.08], [0.0, -0.1], [0.14, 0.08]]),
        ],
        // The octagon of what comes.
        _ => {
            let corner = |k: usize| {
                let (sin, cos) = trig::sin_cos(std::f64::consts::TAU * (k as f64 + 0.5) / 8.0);
                [0.16 * cos, MIDDLE_M + 0.16 * sin]
            };
            vec![(0..8).map(corner).collect()]
        }
    }
}

/// The strokes of a digit in a box of one by two, as on a pocket calculator: top, upper right, lower right, bottom, lower left, upper left, middle.
const STROKES: [[bool; 7]; 10] = [
    [true, true, true, true, true, true, false],
    [false, true, true, false, false, false, false],
    [true, true, false, true, true, false, true],
    [true, true, true, true, false, false, true],
    [false, true, true, false, false, true, true],
    [true, false, true, true, false, true, true],
    [true, false, true, true, true, true, true],
    [true, true, true, false, false, false, false],
    [true, true, true, true, true, true, true],
    [true, true, true, true, false, true, true],
];

fn number(value: u16) -> Vec<Vec<[f64; 2]>> {
    let digits: Vec<usize> = value.to_string().bytes().map(|b| usize::from(b - b'0')).collect();
    let (width, height, pen) = (0.13, 0.26, 0.035);
    let pitch = width + 0.05;
    let mut out = Vec::new();
    for (k, &digit) in digits.iter().enumerate() {
        // The first digit is furthest to the left, where y is greatest.
        let left = 0.5 * (digits.len() as f64 * pitch - 0.05) - k as f64 * pitch;
        let right = left - width;
        let (top, middle, low) = (0.5 * height, 0.0, -0.5 * height);
        let strokes = [
            bar([right, top - pen], [left, top]),
            bar([right, middle], [right + pen, top]),
            bar([right, low], [right + pen, middle]),
            bar([right, low], [left, low + pen]),
            bar([left - pen, low], [left, middle]),
            bar([left - pen, middle], [left, top]),
            bar([right, middle - 0.5 * pen], [left, middle + 0.5 * pen]),
        ];
        out.extend(strokes.into_iter().zip(STROKES[digit]).filter(|s| s.1).map(|s| s.0));
    }
    out
}
