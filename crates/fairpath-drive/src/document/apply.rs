//! A command done to a state: the state before and the command come in, the state after goes out, with what else there is to say.

use super::command::{Command, CrossingSet, SketchAs, TerrainSource};
use super::error::CommandError;
use super::lasso::stretches_within;
use super::state::{FoliageRegion, LaidTerrain, State};
use super::strokes::{Meant, meant, redrawn};
use crate::ground::SoilRegion;
use crate::network::{Choice, Crossing, DrawnHeights, HeightMode, Path, PathId, SketchScale, SpeedZone};
use crate::range::within;
use crate::section::Section;
use crate::terrain::{SyntheticTerrain, WaterBody, Waters};
use fairpath_curve::{Continuity, Point, Segment, Spline};
use fairpath_fit::{CurveEnd, EditError, Warning, join};
use std::sync::Arc;

/// Where terrains that lie in files come from: the core reads none.
pub trait Terrains {
    /// The terrain of a command that names a file.
    ///
    /// # Errors
    /// What is wrong with the file, in words for people that name it.
    fn terrain(&self, source: &TerrainSource) -> Result<LaidTerrain, String>;
}

/// No files at all.
pub struct NoFiles;

impl Terrains for NoFiles {
    fn terrain(&self, source: &TerrainSource) -> Result<LaidTerrain, String> {
        Err(format!("{}: there are no files here", source.file.as_deref().unwrap_or("terrain")))
    }
}

/// What a command did, beside the state that came of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// The paths that are new or changed, those among them of which a part was taken away.
    pub paths: Vec<PathId>,
    /// What the caller should know.
    pub warnings: Vec<Warning>,
}

/// A crossing is looked for no further than this from where it is said to be, m.
const CROSSING_REACH_M: f64 = 60.0;

/// The crossings of a state, for those commands that are about them.
pub(super) type Crossings<'a> = &'a [Crossing];

/// Does a command.
pub(super) fn apply(
    state: &State,
    crossings: Crossings,
    command: &Command,
    files: &dyn Terrains,
) -> Result<(State, Outcome), CommandError> {
    let mut next = state.clone();
    let mut outcome = Outcome::default();
    if !matches!(command, Command::Terrain(_) | Command::DefineSection { .. } | Command::Settings { .. })
        && state.terrain.is_none()
    {
        return Err(CommandError::NoTerrain);
    }
    match command {
        Command::Terrain(source) => next.terrain = Some(laid(state, source, files)?),
        Command::Sketch { points_m, layer, name, section, sketch_as, closed, pixel_m, min_radius_m } => {
            named_layer(layer)?;
            let given = name.as_deref().map(|name| free_name(state, name)).transpose()?;
            let points = stroke(points_m)?;
            let section = section_named(state, section.as_deref().unwrap_or("two-lane"))?;
            let scale = scale(*pixel_m, min_radius_m.unwrap_or(section.min_radius_m))?;
            let meant = match sketch_as {
                SketchAs::Auto if !closed && given.is_none() => meant(&state.paths, layer, &points, &scale),
                _ => Meant::New,
            };
            match meant {
                Meant::New => {
                    let fit = scale.plan(&points, *closed)?;
                    outcome.warnings = fit.warnings;
                    let name = given.unwrap_or_else(|| counted_name(state, layer));
                    outcome.paths.push(added(&mut next, name, layer, section, fit.plan));
                }
                Meant::Changed { path, result, warnings } => {
                    outcome = Outcome { paths: vec![result.id], warnings };
                    next.paths[path] = Arc::new(result);
                }
                Meant::Joined { first, second, result, second_is_earlier, warnings } => {
                    outcome = Outcome { paths: vec![result.id], warnings };
                    renamed_choices(&mut next, state.paths[second].id, result.id, second_is_earlier);
                    next.paths[first] = Arc::new(result);
                    next.paths.remove(second);
                }
            }
        }
        Command::Oversketch { points_m, path, pixel_m } => {
            let points = stroke(points_m)?;
            let i = match path {
                Some(name) => index(state, name)?,
                None => nearest_path(state, points[0]).ok_or_else(|| state.no_path("(under the stroke)"))?,
            };
            let scale = scale(*pixel_m, state.paths[i].section.min_radius_m)?;
            let (result, warnings) = redrawn(&state.paths[i], &points, &scale)?;
            outcome = Outcome { paths: vec![result.id], warnings };
            next.paths[i] = Arc::new(result);
        }
        Command::Crossing { near_m, set, path, other } => {
            let choice = choice(state, crossings, *near_m, *set, path.as_deref(), other.as_deref())?;
            outcome.paths = vec![choice.first, choice.second];
            let mut choices = state.choices.as_ref().clone();
            choices.push(choice);
            next.choices = Arc::new(choices);
        }
        Command::Delete { lasso_m, path } => {
            deleted(state, &mut next, lasso_m.as_deref(), path.as_deref(), &mut outcome)?;
        }
        Command::Split { path, at_m } => {
            let i = index(state, path)?;
            outcome.paths = in_parts(&mut next, i, &halves(&state.paths[i], *at_m)?);
        }
        Command::Join { path, with } => {
            let (first, second) = (index(state, path)?, index(state, with)?);
            let (result, second_is_earlier) = joined(&state.paths[first], &state.paths[second])?;
            outcome.paths.push(result.id);
            renamed_choices(&mut next, state.paths[second].id, result.id, second_is_earlier);
            next.paths[first] = Arc::new(result);
            next.paths.remove(second);
        }
        Command::Roundabout { at_m, radius_m, name, section } => {
            let centre = places("at_m", std::slice::from_ref(at_m), 1)?[0];
            let section = section_named(state, section.as_deref().unwrap_or("two-lane"))?;
            within("radius_m", *radius_m, 3.0, 1e4, "3 to 10000 m")?;
            let name = match name {
                Some(name) => free_name(state, name)?,
                None => counted_name(state, "roundabout"),
            };
            outcome.paths.push(added(&mut next, name, "road", section, ring(centre, *radius_m)?));
        }
        Command::Elevation { path, points_m } => {
            let i = index(state, path)?;
            let drawn = drawn(&state.paths[i], points_m)?;
            next.paths[i] = changed(&state.paths[i], |path| path.drawn.push(drawn));
            outcome.paths.push(next.paths[i].id);
        }
        Command::Heights { path, mode } => {
            each(state, &mut next, path.as_deref(), &mut outcome, |path| path.heights = *mode)?;
        }
        Command::Speed { lasso_m, path, kmh } => {
            within("kmh", *kmh, 1.0, 500.0, "1 to 500 km/h")?;
            sped(state, &mut next, lasso_m.as_deref(), path.as_deref(), *kmh, &mut outcome)?;
        }
        Command::Foliage { lasso_m, density } => {
            within("density", *density, 0.0, 1.0, "0 to 1")?;
            let outline = places("lasso_m", lasso_m, 3)?;
            let mut regions = state.foliage.as_ref().clone();
            regions.push(Arc::new(FoliageRegion { outline, density: *density }));
            next.foliage = Arc::new(regions);
        }
        Command::Water { lasso_m, level_m } => {
            within("level_m", *level_m, -1e5, 1e5, "-100000 to 100000 m")?;
            let outline = places("lasso_m", lasso_m, 3)?;
            if let Some(terrain) = &mut next.terrain {
                let mut waters = terrain.waters.as_ref().clone();
                waters.bodies.push(WaterBody { outline, level_m: *level_m });
                terrain.waters = Arc::new(waters);
            }
        }
        Command::Soil { lasso_m, class } => {
            let mut soils = state.soils.as_ref().clone();
            match lasso_m {
                Some(lasso) => soils.regions.push(SoilRegion { outline: places("lasso_m", lasso, 3)?, soil: *class }),
                None => soils.elsewhere = *class,
            }
            next.soils = Arc::new(soils);
        }
        Command::Section { path, template } => {
            let section = section_named(state, template)?;
            each(state, &mut next, Some(path), &mut outcome, |path| path.section = section.clone())?;
        }
        Command::DefineSection { section } => {
            section.validate()?;
            let mut sections = state.sections.as_ref().clone();
            sections.insert(section.name.clone(), Arc::new(section.clone()));
            next.sections = Arc::new(sections);
        }
        Command::Layer { path, layer } => {
            named_layer(layer)?;
            each(state, &mut next, Some(path), &mut outcome, |path| path.layer.clone_from(layer))?;
        }
        Command::Settings { structures, earthwork, rules, seed } => {
            let mut settings = state.settings;
            if let Some(limits) = structures {
                limits.validate()?;
                settings.structures = *limits;
            }
            if let Some(options) = earthwork {
                options.validate()?;
                settings.earthwork = *options;
            }
            if let Some(rules) = rules {
                rules.validate()?;
                next.rules = Arc::new(rules.clone());
            }
            settings.seed = seed.unwrap_or(settings.seed);
            next.settings = settings;
        }
    }
    Ok((next, outcome))
}

/// Coordinates as places.
fn places(field: &'static str, points: &[[f64; 2]], least: usize) -> Result<Vec<Point>, CommandError> {
    if points.len() < least {
        let problem = format!("there are {}, and at least {least} are needed", points.len());
        return Err(CommandError::Points { field, problem });
    }
    if let Some(i) = points.iter().position(|p| !p.iter().all(|x| x.abs() <= 1e9)) {
        let problem = format!("point {} is {:?}; coordinates must be within ±1e9 m", i + 1, points[i]);
        return Err(CommandError::Points { field, problem });
    }
    Ok(points.iter().map(|&[x, y]| Point::new(x, y)).collect())
}

/// No stroke is longer, m: what follows from a path takes memory in proportion to its length.
const LONGEST_STROKE_M: f64 = 1e6;

/// The points of a stroke.
fn stroke(points_m: &[[f64; 2]]) -> Result<Vec<Point>, CommandError> {
    let points = places("points_m", points_m, 2)?;
    let length: f64 = points.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
    if length > LONGEST_STROKE_M {
        let problem = format!("the stroke is {length:.0} m long; no path may be longer than 1000 km");
        return Err(CommandError::Points { field: "points_m", problem });
    }
    Ok(points)
}

fn laid(state: &State, source: &TerrainSource, files: &dyn Terrains) -> Result<LaidTerrain, CommandError> {
    if state.terrain.is_some() {
        return Err(CommandError::SecondTerrain);
    }
    if let Some(level) = source.water_level_m {
        within("water_level_m", level, -1e5, 1e5, "-100000 to 100000 m")?;
    }
    let waters = Arc::new(Waters { level_m: source.water_level_m, bodies: Vec::new() });
    match (&source.file, source.synthetic) {
        (Some(_), None) => {
            let laid = files.terrain(source).map_err(CommandError::TerrainFile)?;
            Ok(LaidTerrain { waters, ..laid })
        }
        (None, Some(landscape)) => {
            let default = SyntheticTerrain::default();
            let made = SyntheticTerrain {
                landscape,
                size: source.size.unwrap_or(default.size),
                cell_m: source.cell_m.unwrap_or(default.cell_m),
                seed: source.seed.unwrap_or(default.seed),
            };
            Ok(LaidTerrain { field: Arc::new(made.build()?), georeference: None, waters })
        }
        _ => Err(CommandError::TerrainSource),
    }
}

fn scale(pixel_m: f64, min_radius_m: f64) -> Result<SketchScale, CommandError> {
    within("pixel_m", pixel_m, 1e-3, 1e4, "0.001 to 10000 m")?;
    within("min_radius_m", min_radius_m, 0.1, 1e4, "0.1 to 10000 m")?;
    Ok(SketchScale { pixel_m, min_radius_m })
}

fn index(state: &State, name: &str) -> Result<usize, CommandError> {
    state.paths.iter().position(|p| p.name == name).ok_or_else(|| state.no_path(name))
}

fn section_named(state: &State, name: &str) -> Result<Arc<Section>, CommandError> {
    state.section(name).ok_or_else(|| {
        let defined = state.sections.keys().map(String::as_str);
        let known: Vec<&str> = Section::SHIPPED.into_iter().chain(defined).collect();
        CommandError::NoSection { name: name.to_owned(), known: known.join(", ") }
    })
}

fn free_name(state: &State, name: &str) -> Result<String, CommandError> {
    if name.trim().is_empty() {
        return Err(CommandError::NoName);
    }
    if state.path(name).is_some() { Err(CommandError::NameTaken(name.to_owned())) } else { Ok(name.to_owned()) }
}

fn named_layer(layer: &str) -> Result<(), CommandError> {
    if layer.trim().is_empty() { Err(CommandError::NoName) } else { Ok(()) }
}

/// The layer's name with the next number that no path has.
fn counted_name(state: &State, layer: &str) -> String {
    let mut number = state.paths_so_far + 1;
    loop {
        let name = format!("{layer} {number}");
        if state.path(&name).is_none() {
            return name;
        }
        number += 1;
    }
}

fn next_id(next: &mut State) -> PathId {
    next.paths_so_far += 1;
    PathId(next.paths_so_far)
}

fn added(next: &mut State, name: String, layer: &str, section: Arc<Section>, plan: Spline) -> PathId {
    let id = next_id(next);
    next.paths.push(Arc::new(Path {
        id,
        name,
        layer: layer.to_owned(),
        section,
        plan: Arc::new(plan),
        heights: HeightMode::default(),
        drawn: Vec::new(),
        breaks: Vec::new(),
        speeds: Vec::new(),
    }));
    id
}

fn changed(path: &Arc<Path>, change: impl FnOnce(&mut Path)) -> Arc<Path> {
    let mut path = path.as_ref().clone();
    change(&mut path);
    Arc::new(path)
}

/// Changes one path, or all.
fn each(
    state: &State,
    next: &mut State,
    name: Option<&str>,
    outcome: &mut Outcome,
    mut change: impl FnMut(&mut Path),
) -> Result<(), CommandError> {
    let which = match name {
        Some(name) => vec![index(state, name)?],
        None => (0..state.paths.len()).collect(),
    };
    for i in which {
        next.paths[i] = changed(&state.paths[i], &mut change);
        outcome.paths.push(next.paths[i].id);
    }
    Ok(())
}

fn nearest_path(state: &State, place: Point) -> Option<usize> {
    let distance = |i: &usize| state.paths[*i].plan.nearest(place).distance;
    (0..state.paths.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// What was said about crossings of a path holds for the one that it became a part of. About a crossing of both it is said of the one with the earlier place, which on a path that crosses itself comes
/// first.
fn renamed_choices(next: &mut State, old: PathId, new: PathId, old_is_earlier: bool) {
    if !next.choices.iter().any(|c| c.first == old || c.second == old) {
        return;
    }
    let id = |id: PathId| if id == old { new } else { id };
    let renamed = |c: &Choice| {
        let later_first = if old_is_earlier { (new, old) } else { (old, new) };
        let meeting = if (c.first, c.second) == later_first { c.meeting.turned() } else { c.meeting };
        Choice { first: id(c.first), second: id(c.second), meeting, ..*c }
    };
    next.choices = Arc::new(next.choices.iter().map(renamed).collect());
}

/// The crossing that is meant, and what is said about it.
fn choice(
    state: &State,
    crossings: Crossings,
    near_m: [f64; 2],
    set: CrossingSet,
    path: Option<&str>,
    other: Option<&str>,
) -> Result<Choice, CommandError> {
    let near = places("near_m", &[near_m], 1)?[0];
    let id = |name: Option<&str>| name.map(|n| index(state, n).map(|i| state.paths[i].id)).transpose();
    let (path_id, other_id) = (id(path)?, id(other)?);
    let has = |c: &Crossing, id: Option<PathId>| id.is_none_or(|id| c.first.path == id || c.second.path == id);
    let both = |c: &&Crossing| match (path_id, other_id) {
        (Some(a), Some(b)) if a == b => c.first.path == a && c.second.path == a,
        _ => has(c, path_id) && has(c, other_id),
    };
    let distance = |c: &Crossing| (c.point - near).hypot2().sqrt();
    let found = crossings.iter().filter(both).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let found = found.filter(|c| distance(c) <= CROSSING_REACH_M).ok_or_else(|| {
        let named = [path, other].into_iter().flatten().map(|n| format!("of {n:?} ")).collect();
        CommandError::NoCrossing { of: named, reach_m: CROSSING_REACH_M, x: near.x, y: near.y }
    })?;
    let name = |id: PathId| state.path_of(id).map_or_else(String::new, |p| p.name.clone());
    let first = match (path_id, set) {
        (Some(id), _) => id,
        (None, CrossingSet::Intersect) => found.first.path,
        (None, _) => {
            return Err(CommandError::WhichPath { first: name(found.first.path), second: name(found.second.path) });
        }
    };
    let second = if found.first.path == first { found.second.path } else { found.first.path };
    Ok(Choice { first, second, near: found.point, meeting: set.into() })
}

/// Paths without what lies within a lasso.
fn deleted(
    state: &State,
    next: &mut State,
    lasso: Option<&[[f64; 2]]>,
    name: Option<&str>,
    outcome: &mut Outcome,
) -> Result<(), CommandError> {
    let only = name.map(|name| index(state, name)).transpose()?;
    let Some(lasso) = lasso else {
        let i = only.ok_or(CommandError::Nothing)?;
        next.paths.remove(i);
        return Ok(());
    };
    let outline = places("lasso_m", lasso, 3)?;
    let mut any = false;
    for path in state.paths.iter().enumerate().filter(|(i, _)| only.is_none_or(|o| o == *i)).map(|(_, p)| p) {
        let gone = stretches_within(&path.plan, &outline);
        if gone.is_empty() {
            continue;
        }
        any = true;
        let ranges = left_over(&path.plan, &gone);
        let Some(at) = next.paths.iter().position(|p| p.id == path.id) else { continue };
        outcome.paths.extend(in_parts(next, at, &ranges));
    }
    if any { Ok(()) } else { Err(CommandError::EmptyLasso) }
}

/// No part of a path is shorter, m: what would be left of it is nothing to drive on.
const LEAST_PART_M: f64 = 1.0;

/// The stretches on both sides of a cut; all of a closed path, begun there.
fn halves(path: &Path, at_m: f64) -> Result<Vec<[f64; 2]>, CommandError> {
    let length = path.length_m();
    if path.plan.is_closed() {
        within("at_m", at_m, 0.0, length, "a station of the path")?;
        return Ok(vec![[at_m, at_m + length]]);
    }
    within("at_m", at_m, LEAST_PART_M, length - LEAST_PART_M, "a station a metre or more from both ends of the path")?;
    Ok(vec![[0.0, at_m], [at_m, length]])
}

/// What is left of a plan without some stretches: stations, on a closed plan perhaps beyond its end.
fn left_over(plan: &Spline, gone: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let length = plan.length();
    let mut kept: Vec<[f64; 2]> = Vec::new();
    let mut from = 0.0;
    for &[a, b] in gone {
        kept.push([from, a]);
        from = b;
    }
    kept.push([from, length]);
    // A closed plan goes on over its start.
    if plan.is_closed() && kept.len() > 1 && kept[0][1] > 0.0 && kept[kept.len() - 1][0] < length {
        let first = kept.remove(0);
        if let Some(last) = kept.last_mut() {
            last[1] = length + first[1];
        }
    }
    kept.retain(|[a, b]| b - a >= LEAST_PART_M);
    kept
}

/// Puts parts of a path in its place: the first keeps its name and id. Gives the ids of all.
fn in_parts(next: &mut State, at: usize, ranges: &[[f64; 2]]) -> Vec<PathId> {
    let whole = next.paths.remove(at);
    let mut parts: Vec<Arc<Path>> = Vec::new();
    for &range in ranges {
        let (id, name) = if parts.is_empty() {
            (whole.id, whole.name.clone())
        } else {
            let free = |n: &String| next.path(n).is_none() && parts.iter().all(|p| p.name != *n);
            let name = (2..).map(|n| format!("{} ({n})", whole.name)).find(free).unwrap_or_default();
            (next_id(next), name)
        };
        parts.extend(whole.part(range, id, name).map(Arc::new));
    }
    if parts.len() > 1 && next.choices.iter().any(|c| c.first == whole.id || c.second == whole.id) {
        next.choices = Arc::new(next.choices.iter().map(|c| said_of_parts(c, &whole, &parts)).collect());
    }
    let ids = parts.iter().map(|p| p.id).collect();
    let mut parts = parts.into_iter();
    next.paths.splice(at..at, parts.next());
    next.paths.extend(parts);
    ids
}

/// What was said about a crossing of a path, as said about the part on which it lies now.
fn said_of_parts(choice: &Choice, whole: &Path, parts: &[Arc<Path>]) -> Choice {
    let off = |part: &Arc<Path>| part.plan.nearest(choice.near).distance;
    let mut near: Vec<(f64, usize)> = parts.iter().map(off).zip(0..).collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let id = |i: usize| parts[i].id;
    match (choice.first == whole.id, choice.second == whole.id) {
        // With itself: the earlier place lies on the earlier part. Where a second part is as near, the other place is on that.
        (true, true) => {
            let other = near.get(1).filter(|n| n.0 <= near[0].0 + SAME_PLACE_M).map_or(near[0].1, |n| n.1);
            let (i, j) = (near[0].1.min(other), near[0].1.max(other));
            Choice { first: id(i), second: id(j), ..*choice }
        }
        (true, false) => Choice { first: id(near[0].1), ..*choice },
        (false, true) => Choice { second: id(near[0].1), ..*choice },
        (false, false) => *choice,
    }
}

/// Two parts that come this near to a crossing both lead over it, m.
const SAME_PLACE_M: f64 = 1.0;

/// Two paths as one, over the two ends that are nearest to each other, in the direction of the first; and whether the second comes before it.
fn joined(first: &Path, second: &Path) -> Result<(Path, bool), EditError> {
    let pose = |path: &Path, end| if end == CurveEnd::Start { path.plan.start_pose() } else { path.plan.end_pose() };
    let ends = [CurveEnd::Start, CurveEnd::End];
    let pairs = ends.into_iter().flat_map(|a| ends.into_iter().map(move |b| (a, b)));
    let distance = |(a, b): (CurveEnd, CurveEnd)| (pose(first, a).point - pose(second, b).point).hypot2().sqrt();
    let (a, b) = pairs.min_by(|p, q| distance(*p).total_cmp(&distance(*q))).unwrap_or((CurveEnd::End, CurveEnd::Start));
    let shorter = first.length_m().min(second.length_m());
    let reach = (0.5 * distance((a, b)) + 2.0 * first.section.min_radius_m).min(0.3 * shorter);
    let bridge = |continuity| join(&first.plan, a, &second.plan, b, continuity, reach);
    let whole = bridge(Continuity::G2).or_else(|_| bridge(Continuity::G1))?;
    let whole = Arc::new(if a == CurveEnd::Start { whole.reversed() } else { whole });
    let keep = 2.0 * reach + 1.0;
    let mut result = first.on(whole.clone(), keep);
    let other = second.on(whole, keep);
    result.drawn.extend(other.drawn);
    result.breaks.extend(other.breaks);
    result.speeds.extend(other.speeds);
    Ok((result, a == CurveEnd::Start))
}

/// A circle that is gone round against the clock, as traffic on the right does.
fn ring(centre: Point, radius: f64) -> Result<Spline, CommandError> {
    let start = Point::new(centre.x + radius, centre.y);
    let quarter = std::f64::consts::FRAC_PI_2;
    let arc = |k: usize| {
        let (sin, cos) = fairpath_curve::trig::sin_cos(quarter * k as f64);
        let from = if k == 0 { start } else { Point::new(centre.x + radius * cos, centre.y + radius * sin) };
        Segment::arc(from, quarter * (k as f64 + 1.0), quarter * radius, 1.0 / radius)
    };
    let joins = vec![Continuity::G2; 4];
    Spline::new((0..4).map(arc).collect(), joins, true).map_err(|e| CommandError::Edit(EditError::from(e)))
}

/// Heights along a path, in the order of stations.
fn drawn(path: &Path, points: &[[f64; 2]]) -> Result<DrawnHeights, CommandError> {
    places("points_m", points, 2)?;
    let mut points_m = points.to_vec();
    points_m.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points_m.dedup_by(|a, b| a[0] - b[0] < 1e-6);
    let length = path.length_m();
    let beyond = points_m.iter().find(|p| !(-1e-6..=length + 1e-6).contains(&p[0]));
    if let Some([station, _]) = beyond {
        let problem = format!("station {station} m lies beside path {:?}, which is {length:.3} m long", path.name);
        return Err(CommandError::Points { field: "points_m", problem });
    }
    if points_m.len() < 2 {
        let problem = "all of them are at one station".to_owned();
        return Err(CommandError::Points { field: "points_m", problem });
    }
    Ok(DrawnHeights { points_m })
}

fn sped(
    state: &State,
    next: &mut State,
    lasso: Option<&[[f64; 2]]>,
    name: Option<&str>,
    kmh: f64,
    outcome: &mut Outcome,
) -> Result<(), CommandError> {
    let only = name.map(|name| index(state, name)).transpose()?;
    let outline = lasso.map(|lasso| places("lasso_m", lasso, 3)).transpose()?;
    if only.is_none() && outline.is_none() {
        return Err(CommandError::Nothing);
    }
    for i in 0..state.paths.len() {
        if only.is_some_and(|o| o != i) {
            continue;
        }
        let path = &state.paths[i];
        let stretches = match &outline {
            Some(outline) => stretches_within(&path.plan, outline),
            None => vec![[0.0, path.length_m()]],
        };
        if stretches.is_empty() {
            continue;
        }
        let zones = stretches.into_iter().map(|[from_m, to_m]| SpeedZone { from_m, to_m, kmh });
        next.paths[i] = changed(path, |path| path.speeds.extend(zones));
        outcome.paths.push(path.id);
    }
    if outcome.paths.is_empty() { Err(CommandError::EmptyLasso) } else { Ok(()) }
}
