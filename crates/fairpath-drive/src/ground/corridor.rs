//! Cross-sections of a path on the ground, as far as its slopes reach: a path with its profile and the natural ground come in, cross-sections go out.

use super::soil::Soils;
use crate::course::Course;
use crate::network::{Carrier, Path, Structure};
use crate::profile::Profile;
use crate::survey::{Line, Survey};
use crate::terrain::Heightfield;
use fairpath_curve::{Point, Vec2};
use fairpath_fit::parallel;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;

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

impl Side {
    /// How much a fill falls and a cut rises for each metre that it runs.
    pub(crate) fn slopes(&self) -> [f64; 2] {
        [1.0 / self.fill_run, 1.0 / self.cut_run]
    }
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
    /// Height of the surface, m, to the nearest 1/1024.
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

/// Slopes are followed and areas summed in steps of this length, m.
const ACROSS_M: f64 = 1.0;

/// The design of one side: how high the ground may stand and how low, at a distance from the middle; and whether that is still on the bed.
pub(crate) struct Design {
    pub(crate) surface_m: f64,
    pub(crate) bed_m: f64,
    pub(crate) verge_m: f64,
    pub(crate) drop_m: f64,
}

impl Design {
    /// Lowest and highest height of the ground at a distance beyond the edge of what is laid, where fills and cuts have these slopes.
    #[inline]
    pub(crate) fn bounds(&self, beyond: f64, [fill, cut]: [f64; 2]) -> [f64; 2] {
        if beyond <= 0.0 {
            return [self.surface_m - self.bed_m; 2];
        }
        let out = (beyond - self.verge_m).max(0.0);
        let verge = self.surface_m - self.drop_m;
        [verge - out * fill, verge + out * cut]
    }
}

/// The cross-sections of a path, ascending; a bridge or a tunnel has them too, without earthwork.
pub(crate) struct Sections {
    pub(crate) all: Vec<CrossSection>,
    /// Those of them that were made anew.
    pub(crate) new: Range<usize>,
    /// Those of before in the place of which they are.
    pub(crate) old: Range<usize>,
}

/// What cross-sections are made from beside the path.
pub(crate) struct Site<'a> {
    pub(crate) natural: &'a Heightfield,
    pub(crate) soils: &'a Soils,
    pub(crate) options: &'a EarthworkOptions,
}

/// The cross-sections of a path. Those of `before`, which have the same site and the same section of the path, stay as far as from both ends the path runs as it did.
pub(crate) fn cross_sections(
    path: &Path,
    survey: &Survey,
    profile: &Profile,
    structures: &[Structure],
    site: &Site,
    before: &[CrossSection],
) -> Sections {
    let bare = bare_sections(path, survey, profile, structures, site.natural);
    let is_same = |old: &CrossSection, new: &CrossSection| {
        // The station tells only where it is counted from.
        old.point == new.point
            && old.left == new.left
            && old.curvature == new.curvature
            && old.height_m == new.height_m
            && old.on_ground == new.on_ground
            && old.covered == new.covered
    };
    let front = before.iter().zip(&bare).take_while(|(old, new)| is_same(old, new)).count();
    let rest = (before.len() - front).min(bare.len() - front);
    let pairs = before.iter().rev().zip(bare.iter().rev()).take(rest);
    let back = pairs.take_while(|(old, new)| is_same(old, new)).count();
    let (old, new) = (front..before.len() - back, front..bare.len() - back);
    let fresh = parallel::map(&bare[new.clone()], |bare| shaped(*bare, path, site));
    let kept = |old: &CrossSection, bare: &CrossSection| CrossSection { station_m: bare.station_m, ..*old };
    let ahead = before.iter().zip(&bare[..front]).map(|(old, bare)| kept(old, bare));
    let behind = before[old.end..].iter().zip(&bare[new.end..]).map(|(old, bare)| kept(old, bare));
    let all = ahead.chain(fresh).chain(behind).collect();
    Sections { all, new, old }
}

/// Cross-sections that know nothing of the ground beside the path.
fn bare_sections(
    path: &Path,
    survey: &Survey,
    profile: &Profile,
    structures: &[Structure],
    natural: &Heightfield,
) -> Vec<CrossSection> {
    let half = path.section.half_widths_m();
    let mut elevation = profile.along();
    let bare = |Place { station_m, line, carrier }: Place| {
        let side =
            |i: usize| Side { half_width_m: half[i], daylight_m: half[i], cut_run: 1.0, fill_run: 1.0, wall: false };
        CrossSection {
            station_m,
            point: line.point,
            left: line.left,
            curvature: line.curvature,
            height_m: (elevation(station_m).height_m / HEIGHT_STEP_M).round() * HEIGHT_STEP_M + 0.0,
            natural_m: line.natural_m,
            on_ground: carrier.is_none() && path.section.shapes_ground,
            covered: carrier == Some(Carrier::Tunnel),
            sides: [side(0), side(1)],
            areas_m2: [0.0; 2],
        }
    };
    places(path, survey, structures, natural).into_iter().map(bare).collect()
}

/// A cross-section on the ground.
fn shaped(bare: CrossSection, path: &Path, site: &Site) -> CrossSection {
    let Site { natural, soils, options } = site;
    let design = Design {
        surface_m: bare.height_m,
        bed_m: path.section.bed_m,
        verge_m: options.verge_m,
        drop_m: options.verge_drop_m,
    };
    let mut section = bare;
    for i in 0..2 {
        let out = if i == 0 { bare.left } else { -bare.left };
        let side = &mut section.sides[i];
        let soil = soils.at(bare.point + out * (side.half_width_m + options.verge_m));
        (side.cut_run, side.fill_run) = (soil.cut_run(), soil.fill_run());
        if bare.on_ground {
            // Towards the centre of a bend, strips to the inside become shorter (Pappus).
            let turn = if i == 0 { bare.curvature } else { -bare.curvature };
            slope(side, &design, options, turn, &mut section.areas_m2, |across| {
                natural.height(bare.point + out * across)
            });
        }
    }
    section
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
    let (verge, slopes) = (side.half_width_m + options.verge_m, side.slopes());
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
            let [low, high] = design.bounds(across - side.half_width_m, slopes);
            add(across, width, z.min(high).max(low) - z);
        }
    }
    // Beyond the verge the ground is too high for the slope, or too low, until it meets it.
    let misses = |across: f64| {
        let z = natural(across);
        let [low, high] = design.bounds(across - side.half_width_m, slopes);
        [high - z, low - z]
    };
    let [high, low] = misses(verge);
    let which = if high < 0.0 { 0 } else { 1 };
    let mut raised = [high.min(0.0), low.max(0.0)][which];
    let mut across = verge;
    let mut ends = raised == 0.0;
    while !ends && across < furthest {
        let width = ACROSS_M.min(furthest - across);
        let next = misses(across + width)[which];
        ends = next * raised <= 0.0;
        let width = if ends { width * raised / (raised - next) } else { width };
        let mean = if ends { 0.5 * raised } else { 0.5 * (raised + next) };
        add(across + 0.5 * width, width, mean);
        across += width;
        raised = next;
    }
    side.daylight_m = across;
    side.wall = !ends;
}

/// Where a cross-section is taken, and what carries the path there, if not the ground.
struct Place {
    station_m: f64,
    line: Line,
    carrier: Option<Carrier>,
}

/// Where cross-sections are taken. Where what carries the path changes there are two at one place. The lines across it were surveyed segment by segment, so that where the plan is as it
/// was, they are; the ends of bridges and tunnels come in between and move none of them.
fn places(path: &Path, survey: &Survey, structures: &[Structure], natural: &Heightfield) -> Vec<Place> {
    let course = Course::new(&path.plan);
    let ends = structures.iter().flat_map(|s| [s.from_m, s.to_m]);
    let mut ends: Vec<(usize, f64)> = ends.map(|station| course.locate(station)).collect();
    ends.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut ends = ends.into_iter().peekable();
    let mut out: Vec<Place> = Vec::new();
    let mut carrier = None;
    let last = path.plan.segments().len() - 1;
    for (i, (start, segment)) in survey.segments().enumerate() {
        let length = segment.length_m();
        let mut lines = segment.lines.clone();
        while let Some((_, s)) = ends.next_if(|end| end.0 == i) {
            // Stations have other last digits where the path became longer before them.
            let line = segment.line_near(s, LEAST_M, natural);
            lines.insert(lines.partition_point(|other| other.s_m <= line.s_m), line);
        }
        // The end is the start of the next one.
        lines.retain(|line| line.s_m < length - LEAST_M);
        lines.dedup_by(|a, b| a.s_m - b.s_m < LEAST_M);
        for (k, &line) in lines.iter().enumerate() {
            let to = lines.get(k + 1).map_or(length, |next| next.s_m);
            let middle = start + 0.5 * (line.s_m + to);
            let own = structures.iter().find(|s| s.from_m <= middle && middle <= s.to_m).map(|s| s.carrier);
            let station_m = start + line.s_m;
            if own != carrier && !out.is_empty() {
                out.push(Place { station_m, line, carrier });
            }
            carrier = own;
            out.push(Place { station_m, line, carrier });
        }
        if i == last {
            out.push(Place { station_m: start + length, line: segment.last_line(natural), carrier });
        }
    }
    out
}

/// Cross-sections nearer to each other than this would be one, m.
const LEAST_M: f64 = 1.0 / 1024.0;

/// Heights of cross-sections are told in steps of this, m: no ground is shaped to a millimetre, and what hardly changed far from where a path was drawn over is then the same.
const HEIGHT_STEP_M: f64 = 1.0 / 1024.0;
