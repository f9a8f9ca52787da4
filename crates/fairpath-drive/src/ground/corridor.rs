//! Cross-sections of a path on the ground, as far as its slopes reach: a path with its profile and the natural ground come in, cross-sections go out.

use super::soil::Soils;
use crate::network::{Carrier, Path, Structure};
use crate::profile::Profile;
use crate::terrain::Heightfield;
use fairpath_curve::{Point, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the ground beside a path is shaped.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EarthworkOptions {
    /// Level ground on each side before the slope begins, m.
    pub verge_m: f64,
    /// How far the verge lies below the surface, m.
    pub verge_drop_m: f64,
    /// No slope reaches further from the verge than this: a retaining wall stands there, m.
    pub reach_m: f64,
}

impl Default for EarthworkOptions {
    fn default() -> Self {
        Self { verge_m: 1.0, verge_drop_m: 0.1, reach_m: 30.0 }
    }
}

impl EarthworkOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// Names the first that is out of it.
    pub fn validate(&self) -> Result<(), crate::range::OutOfRange> {
        use crate::range::within;
        within("verge_m", self.verge_m, 0.0, 100.0, "0 to 100 m")?;
        within("verge_drop_m", self.verge_drop_m, 0.0, 10.0, "0 to 10 m")?;
        within("reach_m", self.reach_m, 0.0, 500.0, "0 to 500 m")
    }
}

/// One side of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// From the middle to the edge of what is laid, m.
    pub half_width_m: f64,
    /// From the middle to the daylight line, where the slope meets the natural ground, m.
    pub daylight_m: f64,
    /// How far a cut runs for each metre that it rises.
    pub cut_run: f64,
    /// How far a fill runs for each metre that it falls.
    pub fill_run: f64,
    /// Whether a retaining wall ends the slope.
    pub wall: bool,
}

/// A cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossSection {
    /// Arc length from the path's start, m.
    pub station_m: f64,
    /// The middle.
    pub point: Point,
    /// To the left, of length 1.
    pub left: Vec2,
    /// Curvature of the path there, 1/m, left positive.
    pub curvature: f64,
    /// Height of the surface, m.
    pub height_m: f64,
    /// Height of the natural ground below the middle, m.
    pub natural_m: f64,
    /// Whether the path lies on the ground here and shapes it: not on a bridge, in a tunnel, or as a pipe does.
    pub on_ground: bool,
    /// Whether the path lies in a tunnel here: the ground above it is whole.
    pub covered: bool,
    /// Left and right.
    pub sides: [Side; 2],
    /// Area of cut and of fill across, m².
    pub areas_m2: [f64; 2],
}

/// Chords between cross-sections stay this near to the path, m.
const CHORD_M: f64 = 0.05;

/// Cross-sections are no further apart, m.
const FURTHEST_M: f64 = 8.0;

/// Slopes are followed and areas summed in steps of this length, m.
const ACROSS_M: f64 = 0.5;

/// The design of one side: how high the ground may stand and how low, at a distance from the middle; and whether that is still on the bed.
pub(crate) struct Design {
    pub(crate) surface_m: f64,
    pub(crate) bed_m: f64,
    pub(crate) verge_m: f64,
    pub(crate) drop_m: f64,
}

impl Design {
    /// Lowest and highest height of the ground at a distance from the middle.
    #[inline]
    pub(crate) fn bounds(&self, side: &Side, across: f64) -> [f64; 2] {
        let beyond = across - side.half_width_m;
        if beyond <= 0.0 {
            return [self.surface_m - self.bed_m; 2];
        }
        let out = (beyond - self.verge_m).max(0.0);
        let verge = self.surface_m - self.drop_m;
        [verge - out / side.fill_run, verge + out / side.cut_run]
    }
}

/// The cross-sections of a path, ascending; a bridge or a tunnel has them too, without earthwork.
pub(crate) fn cross_sections(
    path: &Path,
    profile: &Profile,
    structures: &[Structure],
    natural: &Heightfield,
    soils: &Soils,
    options: &EarthworkOptions,
) -> Vec<CrossSection> {
    let half = path.section.half_widths_m();
    let design = |surface_m: f64| Design {
        surface_m,
        bed_m: path.section.bed_m,
        verge_m: options.verge_m,
        drop_m: options.verge_drop_m,
    };
    let one = |station_m: f64, carrier: Option<Carrier>| {
        let pose = path.plan.pose_at(station_m);
        let tangent = fairpath_curve::trig::unit(pose.heading);
        let left = Vec2::new(-tangent.y, tangent.x);
        let height_m = profile.at(station_m).height_m;
        let natural_m = natural.height(pose.point);
        let on_ground = carrier.is_none() && path.section.shapes_ground;
        let design = design(height_m);
        let mut areas_m2 = [0.0; 2];
        let sides = [0, 1].map(|i| {
            let out = if i == 0 { left } else { -left };
            let soil = soils.at(pose.point + out * (half[i] + options.verge_m));
            let mut side = Side {
                half_width_m: half[i],
                daylight_m: half[i],
                cut_run: soil.cut_run(),
                fill_run: soil.fill_run(),
                wall: false,
            };
            if on_ground {
                // Towards the centre of a bend, strips to the inside become shorter (Pappus).
                let turn = if i == 0 { pose.curvature } else { -pose.curvature };
                slope(&mut side, &design, options, turn, &mut areas_m2, |across| {
                    natural.height(pose.point + out * across)
                });
            }
            side
        });
        CrossSection {
            station_m,
            point: pose.point,
            left,
            curvature: pose.curvature,
            height_m,
            natural_m,
            on_ground,
            covered: carrier == Some(Carrier::Tunnel),
            sides,
            areas_m2,
        }
    };
    let stations = stations(path, structures);
    stations.into_iter().map(|(station, carrier)| one(station, carrier)).collect()
}

/// Follows one side from the middle until the slope meets the natural ground, adding up areas of cut and fill.
fn slope(
    side: &mut Side,
    design: &Design,
    options: &EarthworkOptions,
    turn: f64,
    areas_m2: &mut [f64; 2],
    natural: impl Fn(f64) -> f64,
) {
    let verge = side.half_width_m + options.verge_m;
    let furthest = verge + options.reach_m;
    let mut add = |across: f64, width: f64, raised: f64| {
        let strip = raised * width * (1.0 - turn * across).max(0.0);
        areas_m2[usize::from(strip > 0.0)] += strip.abs();
    };
    // Bed and verge by Simpson's rule of the midpoints, the slope in steps.
    for (from, to) in [(0.0, side.half_width_m), (side.half_width_m, verge)] {
        let count = ((to - from) / ACROSS_M).ceil().max(1.0) as usize;
        let width = (to - from) / count as f64;
        for i in 0..count {
            let across = from + (i as f64 + 0.5) * width;
            let z = natural(across);
            let [low, high] = design.bounds(side, across);
            add(across, width, z.min(high).max(low) - z);
        }
    }
    let mut across = verge;
    side.daylight_m = verge;
    while across < furthest {
        let middle = across + 0.5 * ACROSS_M;
        let z = natural(middle);
        let [low, high] = design.bounds(side, middle);
        let raised = z.min(high).max(low) - z;
        if raised == 0.0 {
            return;
        }
        add(middle, ACROSS_M, raised);
        across += ACROSS_M;
        side.daylight_m = across;
    }
    side.wall = true;
}

/// Where cross-sections are taken, and what carries the path there, if not the ground. The ends of bridges and tunnels have two, on either side of a hair.
fn stations(path: &Path, structures: &[Structure]) -> Vec<(f64, Option<Carrier>)> {
    let length = path.length_m();
    let mut cuts = vec![0.0, length];
    let mut before = 0.0;
    for segment in path.plan.segments() {
        for s in segment.flatten_at(CHORD_M) {
            cuts.push((before + s).min(length));
        }
        before += segment.length;
    }
    for s in structures {
        cuts.extend([s.from_m.max(0.0), s.to_m.min(length)]);
    }
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| *a - *b < LEAST_M);
    if let Some(last) = cuts.last_mut() {
        *last = length;
    }
    let mut out: Vec<(f64, Option<Carrier>)> = Vec::new();
    let carrier = |from: f64, to: f64| {
        let middle = 0.5 * (from + to);
        structures.iter().find(|s| s.from_m <= middle && middle <= s.to_m).map(|s| s.carrier)
    };
    for pair in cuts.windows(2) {
        let carrier = carrier(pair[0], pair[1]);
        let parts = ((pair[1] - pair[0]) / FURTHEST_M).ceil().max(1.0) as usize;
        if out.last().is_none_or(|(s, c)| *s != pair[0] || *c != carrier) {
            out.push((pair[0], carrier));
        }
        for i in 1..=parts {
            let station = if i == parts { pair[1] } else { pair[0] + (pair[1] - pair[0]) * i as f64 / parts as f64 };
            out.push((station, carrier));
        }
    }
    out
}

/// Cross-sections nearer to each other than this would be one, m.
const LEAST_M: f64 = 1e-3;
