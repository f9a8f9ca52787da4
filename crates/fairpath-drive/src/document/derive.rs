//! What follows from a state: crossings, heights, structures and the shaped ground. Only what a change touches is worked out anew; the rest is shared with what followed from the
//! state before, so that the result is the same as if all were new.

use super::state::{FoliageRegion, LaidTerrain, State};
use crate::furniture::{DRY_M, Sign, Tree, signs, standing, stopping_arms, tiles_of, wild_trees_on};
use crate::ground::{
    Asked, Corridor, CorridorSite, CrossSection, Ground, Hit, Hits, TILE, TileIndex, corridor, cross_sections,
};
use crate::groups::Groups;
use crate::network::{
    Arm, Crossing, HeightMode, Junction, Path, PathId, PathPlace, Site, Structure, Surveyed, Unordered, alone,
    crossings_between, crossings_within, decide, engineered, junctions, profile_with, reach, structures,
    wanted_heights,
};
use crate::profile::Profile;
use crate::survey::Survey;
use fairpath_curve::Rect;
use fairpath_fit::parallel;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// What follows for one path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathResult {
    /// The path.
    pub path: Arc<Path>,
    /// Its elevation.
    pub profile: Arc<Profile>,
    /// Its bridges and tunnels, in order.
    pub structures: Vec<Structure>,
    /// Its cross-sections, in order.
    pub sections: Arc<Vec<CrossSection>>,
    /// The natural terrain along it.
    survey: Arc<Survey>,
    /// The elevation that it would have alone.
    alone: Arc<Profile>,
    /// Stations of its crossings and the heights there, m.
    wanted: Vec<[f64; 2]>,
    /// Why it is not engineered although it is to be.
    infeasible: Option<Arc<str>>,
    /// Its crossings, for which it has bridges.
    crossings: Vec<Crossing>,
    /// What it asks of the ground.
    corridor: Arc<Corridor>,
}

/// The trees on each tile of the fine grid that has any.
type Wood = BTreeMap<TileIndex, Arc<Vec<Tree>>>;

/// Crossings of each pair of paths that has any.
type Pairs = BTreeMap<[PathId; 2], Arc<Vec<Crossing>>>;

/// What follows from a state with a terrain.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// For each path of the state, in its order.
    pub paths: Vec<Arc<PathResult>>,
    /// All crossings, by the ids of their paths.
    pub crossings: Vec<Crossing>,
    /// All intersections of roads.
    pub junctions: Vec<Arc<Junction>>,
    /// The signs of each path, in the paths' order.
    pub signs: Vec<Arc<Vec<Sign>>>,
    /// The trees, by tiles of the fine grid.
    pub trees: Wood,
    /// The shaped ground.
    pub ground: Ground,
    /// Crossings that ask for a ring, where there are such; the heights of their paths know nothing of crossings.
    pub unordered: Option<Unordered>,
    /// Crossings by pairs, as if nothing had been said about them.
    pairs: Pairs,
    /// The trees that there would be without paths and water.
    wild: Arc<Wood>,
}

impl Results {
    /// Paths that are to be engineered and are not, with the reason.
    pub fn infeasible(&self) -> impl Iterator<Item = (&Path, &str)> {
        self.paths.iter().filter_map(|p| Some((p.path.as_ref(), p.infeasible.as_deref()?)))
    }

    /// What follows for a path.
    #[must_use]
    pub fn path(&self, id: PathId) -> Option<&Arc<PathResult>> {
        self.paths.binary_search_by_key(&id, |p| p.path.id).ok().map(|i| &self.paths[i])
    }
}

/// What follows from `state`, whose terrain is `terrain`; `before` is a state with what follows from it.
pub(super) fn derive(before: Option<(&State, &Results)>, state: &State, terrain: &LaidTerrain) -> Results {
    parallel::within(|| derived(before, state, terrain))
}

fn derived(before: Option<(&State, &Results)>, state: &State, terrain: &LaidTerrain) -> Results {
    let before = before.filter(|(old, _)| old.terrain.as_ref().is_some_and(|t| is_same_terrain(t, terrain)));
    let old_path = |id: PathId| before.and_then(|(_, results)| results.path(id));
    let is_old = |path: &Arc<Path>| old_path(path.id).is_some_and(|old| Arc::ptr_eq(&old.path, path));
    // A path that merely got another speed, say, crosses others where it did.
    let same_course = |path: &Arc<Path>| {
        old_path(path.id)
            .is_some_and(|old| Arc::ptr_eq(&old.path.plan, &path.plan) && Arc::ptr_eq(&old.path.section, &path.section))
    };
    // Settings reach every path; a region of soil reaches those that lie on it, and telling which would cost more than it saves.
    let same_ground =
        before.is_some_and(|(old, _)| old.settings == state.settings && Arc::ptr_eq(&old.soils, &state.soils));
    let (field, waters) = (&terrain.field, &terrain.waters);
    let survey_of = |path: &Arc<Path>| match old_path(path.id) {
        Some(old) if Arc::ptr_eq(&old.path.plan, &path.plan) => old.survey.clone(),
        old => Arc::new(Survey::of(&path.plan, field, waters, old.map(|old| old.survey.as_ref()))),
    };
    let surveys: Vec<Arc<Survey>> = state.paths.iter().map(survey_of).collect();
    let alone_of = |(path, survey): (&Arc<Path>, &Arc<Survey>)| match old_path(path.id) {
        Some(old) if same_course(path) && old.path.heights == path.heights && old.path.drawn == path.drawn => {
            old.alone.clone()
        }
        _ => Arc::new(alone(path, survey, field, waters)),
    };
    let (pairs, alone_of) = parallel::join(
        || pairs(before.map(|(_, r)| &r.pairs), state, &surveys, same_course),
        || state.paths.iter().zip(&surveys).map(alone_of).collect::<Vec<Arc<Profile>>>(),
    );
    let crossings = decided(&pairs, state);
    let mut crossings_of: Vec<Vec<Crossing>> = vec![Vec::new(); state.paths.len()];
    let index = |id: PathId| state.paths.binary_search_by_key(&id, |p| p.id).ok();
    for crossing in &crossings {
        let [a, b] = crossing.places().map(|p| index(p.path));
        let own = [a, if a == b { None } else { b }];
        own.into_iter().flatten().for_each(|i| crossings_of[i].push(*crossing));
    }
    let old = before.map(|(_, r)| r);
    let same_rules = before.is_some_and(|(old, _)| Arc::ptr_eq(&old.rules, &state.rules));
    let known = Known { surveys: &surveys, alone: &alone_of, crossings: &crossings, crossings_of: &crossings_of };
    let (elevations, unordered) =
        heights(old, state, terrain, known, &|path| is_old(path) && same_ground && same_rules);
    let mut paths = Vec::with_capacity(state.paths.len());
    let mut dirty = Dirty::default();
    let empty = Ground::new(terrain.field.clone());
    let old_ground = before.map_or(&empty, |(_, results)| &results.ground);
    for (i, path) in state.paths.iter().enumerate() {
        let old = old_path(path.id);
        let elevation = &elevations[i];
        let same_heights = old.is_some_and(|old| same_course(path) && is_same(&old.profile, &elevation.profile));
        // Whether there is a bridge, and how long it is, depends on the path below it.
        let same_others = || {
            let places = crossings_of[i].iter().flat_map(Crossing::places);
            places.into_iter().all(|place| {
                let before = old_path(place.path).map(|old| &old.profile);
                let now = index(place.path).map(|j| &elevations[j].profile);
                let same_heights = before.zip(now).is_some_and(|(before, now)| is_same(before, now));
                state.path_of(place.path).is_some_and(same_course) && same_heights
            })
        };
        let as_before = |old: &&Arc<PathResult>| {
            old.crossings == crossings_of[i]
                && old.wanted == elevation.wanted
                && old.infeasible == elevation.infeasible
                && same_others()
        };
        if let Some(old) = old.filter(|old| is_old(path) && same_heights && same_ground && as_before(old)) {
            paths.push(old.clone());
            continue;
        }
        let profile = match old {
            Some(old) if same_heights => old.profile.clone(),
            _ => elevation.profile.clone(),
        };
        let other = |place: PathPlace| {
            let j = index(place.path)?;
            Some((state.paths[j].as_ref(), elevations[j].profile.as_ref()))
        };
        let limits = &state.settings.structures;
        let structures = structures(path, &surveys[i], &profile, &crossings_of[i], other, field, limits);
        let result = match old {
            Some(old) if same_heights && same_ground && old.structures == structures => PathResult {
                path: path.clone(),
                survey: surveys[i].clone(),
                alone: alone_of[i].clone(),
                crossings: crossings_of[i].clone(),
                wanted: elevation.wanted.clone(),
                infeasible: elevation.infeasible.clone(),
                ..old.as_ref().clone()
            },
            _ => {
                let options = &state.settings.earthwork;
                let site = CorridorSite { natural: field, soils: &state.soils, options };
                // Where the path runs as it did, so does its corridor.
                let kept = old.filter(|old| same_ground && Arc::ptr_eq(&old.path.section, &path.section));
                let kept = kept.map(|old| (old.sections.as_slice(), old.corridor.as_ref()));
                let before = kept.map_or(&[][..], |(sections, _)| sections);
                let sections = cross_sections(path, &surveys[i], &profile, &structures, &site, before);
                let corridor = corridor(&sections, kept, &path.section, options, old_ground);
                let (sections, corridor) = (Arc::new(sections.all), Arc::new(corridor));
                // Where it asks what it asked before, the ground stays.
                dirty.compare(old.map(|old| old.corridor.as_ref()), Some(&corridor));
                PathResult {
                    path: path.clone(),
                    profile,
                    structures,
                    sections,
                    survey: surveys[i].clone(),
                    alone: alone_of[i].clone(),
                    wanted: elevation.wanted.clone(),
                    infeasible: elevation.infeasible.clone(),
                    crossings: crossings_of[i].clone(),
                    corridor,
                }
            }
        };
        paths.push(Arc::new(result));
    }
    let gone = before.into_iter().flat_map(|(_, r)| &r.paths).filter(|old| index(old.path.id).is_none());
    gone.for_each(|old| dirty.compare(Some(&old.corridor), None));
    let shaped = || {
        let ground = if dirty.shaped.is_empty() {
            old_ground.clone()
        } else {
            let corridors: Vec<&Hits> = paths.iter().map(|p| &p.corridor.hits).collect();
            old_ground.reshaped(&dirty.shaped, &corridors)
        };
        let (wild, trees) = planted(before, state, terrain, &paths, &ground, &dirty);
        (ground, wild, trees)
    };
    let met = || {
        let junctions = intersections(before.map(|(_, r)| r), state, &paths, &crossings);
        let before = before.filter(|(old, _)| Arc::ptr_eq(&old.rules, &state.rules)).map(|(_, r)| r);
        let signs = posted(before, state, &paths, &junctions);
        (junctions, signs)
    };
    let ((ground, wild, trees), (junctions, signs)) = parallel::join(shaped, met);
    Results { paths, crossings, junctions, signs, trees, ground, unordered, pairs, wild }
}

/// Tiles of which a path asks something else than before.
#[derive(Default)]
struct Dirty {
    /// Where the ground is shaped anew.
    shaped: BTreeSet<TileIndex>,
    /// Where trees have other places to stand.
    cleared: BTreeSet<TileIndex>,
}

impl Dirty {
    /// Adds the tiles of which a path asks something else than before.
    fn compare(&mut self, old: Option<&Corridor>, new: Option<&Corridor>) {
        let [mut before, mut now] =
            [old, new].map(|corridor| corridor.into_iter().flat_map(|c| c.hits.iter()).peekable());
        while let Some(tile) = before.peek().into_iter().chain(now.peek()).map(|(tile, _)| **tile).min() {
            let [a, b] = [&mut before, &mut now].map(|hits| Some(hits.next_if(|(at, _)| **at == tile)?.1));
            if a.zip(b).is_some_and(|(a, b)| Arc::ptr_eq(a, b) || a == b) {
                continue;
            }
            self.shaped.insert(tile);
            if !old.zip(new).is_some_and(|(old, new)| new.clears_as(old, tile)) {
                self.clear(tile, a, b);
            }
        }
    }

    /// Adds the tiles where trees have other places to stand, since a path keeps other samples of a tile clear.
    fn clear(&mut self, tile: TileIndex, old: Option<&Arc<Vec<Hit>>>, new: Option<&Arc<Vec<Hit>>>) {
        fn cleared(hits: Option<&Arc<Vec<Hit>>>) -> impl Iterator<Item = u16> {
            hits.into_iter().flat_map(|hits| hits.iter()).filter(|h| h.keeps_clear()).map(|h| h.sample)
        }
        if cleared(old).eq(cleared(new)) {
            return;
        }
        // A tree beside a sample at the rim of a tile may stand on the next one.
        let [mut columns, mut rows] = tile.map(|i| [i, i]);
        for sample in cleared(old).chain(cleared(new)) {
            let at = [sample % TILE as u16, sample / TILE as u16];
            for (range, (at, i)) in [&mut columns, &mut rows].into_iter().zip(at.into_iter().zip(tile)) {
                let last = usize::from(at) == TILE - 1;
                *range = [if at == 0 { i.saturating_sub(1) } else { range[0] }, if last { i + 1 } else { range[1] }];
            }
        }
        let [columns, rows] = [columns, rows].map(|[from, to]| from..=to);
        self.cleared.extend(rows.flat_map(|row| columns.clone().map(move |column| [column, row])));
    }
}

/// The signs of all paths; those of a path that is as it was, with its intersections, are kept.
fn posted(
    before: Option<&Results>,
    state: &State,
    paths: &[Arc<PathResult>],
    junctions: &[Arc<Junction>],
) -> Vec<Arc<Vec<Sign>>> {
    let rules = &state.rules;
    let mut by_path: BTreeMap<PathId, Vec<&Arc<Junction>>> = BTreeMap::new();
    for junction in junctions {
        let ids: BTreeSet<PathId> = junction.spans.iter().map(|s| s.0).collect();
        ids.into_iter().for_each(|id| by_path.entry(id).or_default().push(junction));
    }
    let mut old: BTreeMap<PathId, Vec<&Arc<Junction>>> = BTreeMap::new();
    for junction in before.into_iter().flat_map(|b| &b.junctions) {
        let ids: BTreeSet<PathId> = junction.spans.iter().map(|s| s.0).collect();
        ids.into_iter().for_each(|id| old.entry(id).or_default().push(junction));
    }
    let none = Vec::new();
    let path_of = |id: PathId| state.path_of(id).map(Arc::as_ref);
    let one = |result: &Arc<PathResult>| {
        let id = result.path.id;
        let (own, former) = (by_path.get(&id).unwrap_or(&none), old.get(&id).unwrap_or(&none));
        let index = before.and_then(|b| b.paths.binary_search_by_key(&id, |p| p.path.id).ok());
        let same_junctions = own.len() == former.len() && own.iter().zip(former).all(|(a, b)| Arc::ptr_eq(a, b));
        if let (Some(i), Some(b), true) = (index, before, same_junctions)
            && Arc::ptr_eq(&b.paths[i], result)
        {
            return b.signs[i].clone();
        }
        let stops: Vec<Arm> = own.iter().flat_map(|j| stopping_arms(j, path_of)).collect();
        let own: Vec<&Junction> = own.iter().map(|j| j.as_ref()).collect();
        Arc::new(signs(&result.path, &result.profile, &own, &stops, rules))
    };
    paths.iter().map(one).collect()
}

/// The trees that there would be without paths and water, and those that there are. The former are planted anew where regions of trees came or went, the latter are
/// also looked at anew in and beside tiles where something else changed that they depend on.
fn planted(
    before: Option<(&State, &Results)>,
    state: &State,
    terrain: &LaidTerrain,
    paths: &[Arc<PathResult>],
    ground: &Ground,
    dirty: &Dirty,
) -> (Arc<Wood>, Wood) {
    let grid = ground.grid();
    let before = before.filter(|(old, _)| old.settings.seed == state.settings.seed);
    let (mut wild, mut trees) = before.map(|(_, r)| (r.wild.clone(), r.trees.clone())).unwrap_or_default();
    let old_regions = before.map_or(&[][..], |(old, _)| &old.foliage);
    let is_in = |regions: &[Arc<FoliageRegion>], r: &Arc<FoliageRegion>| regions.iter().any(|o| Arc::ptr_eq(o, r));
    let came = state.foliage.iter().filter(|r| !is_in(old_regions, r));
    let went = old_regions.iter().filter(|r| !is_in(&state.foliage, r));
    let mut which: BTreeSet<TileIndex> = came.chain(went).flat_map(|r| tiles_of(grid, r)).collect();
    if !which.is_empty() {
        let wild_on = |tile| Arc::new(wild_trees_on(tile, ground, &state.foliage, state.settings.seed));
        plant(Arc::make_mut(&mut wild), &which, wild_on);
    }
    if !state.foliage.is_empty() {
        which.extend(&dirty.cleared);
        // Heights tell where there is water, and nothing else.
        if let Some(level) = terrain.waters.highest_m() {
            let is_dry = |ground: &Ground, tile| ground.lowest_m(tile) > level + DRY_M;
            let old = before.map(|(_, r)| &r.ground);
            let may_be_wet = |tile: &TileIndex| !(is_dry(ground, *tile) && old.is_some_and(|old| is_dry(old, *tile)));
            which.extend(around(&dirty.shaped).into_iter().filter(may_be_wet));
        }
    }
    // Beside a tile, too, something may be in the way of its trees.
    let corridors: Vec<&Hits> = paths.iter().map(|p| &p.corridor.hits).collect();
    let asked = Asked::of(&around(&which), &corridors);
    let none = Arc::default();
    plant(&mut trees, &which, |tile| standing(tile, wild.get(&tile).unwrap_or(&none), ground, &asked, &terrain.waters));
    (wild, trees)
}

/// Puts other trees on tiles.
fn plant(wood: &mut Wood, which: &BTreeSet<TileIndex>, trees_on: impl Fn(TileIndex) -> Arc<Vec<Tree>> + Sync) {
    let which: Vec<TileIndex> = which.iter().copied().collect();
    let planted = parallel::map(&which, |tile| trees_on(*tile));
    for (tile, trees) in which.into_iter().zip(planted) {
        if trees.is_empty() {
            wood.remove(&tile);
        } else {
            wood.insert(tile, trees);
        }
    }
}

/// Tiles and those beside them.
fn around(tiles: &BTreeSet<TileIndex>) -> BTreeSet<TileIndex> {
    let beside = |i: u32| i.saturating_sub(1)..=i + 1;
    tiles.iter().flat_map(|&[column, row]| beside(column).flat_map(move |c| beside(row).map(move |r| [c, r]))).collect()
}

/// All intersections; those whose roads are as they were are kept.
fn intersections(
    before: Option<&Results>,
    state: &State,
    paths: &[Arc<PathResult>],
    crossings: &[Crossing],
) -> Vec<Arc<Junction>> {
    let result = |id: PathId| paths.binary_search_by_key(&id, |p| p.path.id).ok().map(|i| &paths[i]);
    let unchanged = |id: PathId| match (before.and_then(|b| b.path(id)), result(id)) {
        (Some(old), Some(new)) => Arc::ptr_eq(&old.path, &new.path) && Arc::ptr_eq(&old.profile, &new.profile),
        _ => false,
    };
    let old: BTreeMap<PathId, Vec<&Arc<Junction>>> =
        before.into_iter().flat_map(|b| &b.junctions).fold(BTreeMap::new(), |mut by_path, junction| {
            let first = junction.spans.first().map(|s| s.0);
            by_path.entry(first.unwrap_or(PathId(0))).or_default().push(junction);
            by_path
        });
    let known = |spans: &[(PathId, [f64; 2])]| {
        let same = |j: &&&Arc<Junction>| j.spans == spans && spans.iter().all(|(id, _)| unchanged(*id));
        old.get(&spans.first()?.0)?.iter().find(same).map(|j| Arc::clone(j))
    };
    let path_of = |id: PathId| state.path_of(id).map(Arc::as_ref);
    let profile_of = |id: PathId| result(id).map(|r| r.profile.as_ref());
    junctions(crossings, &path_of, &profile_of, &known)
}

/// Whether two are equal; of what was kept it is soon told.
fn is_same<T: PartialEq>(a: &Arc<T>, b: &Arc<T>) -> bool {
    Arc::ptr_eq(a, b) || a == b
}

fn is_same_terrain(a: &LaidTerrain, b: &LaidTerrain) -> bool {
    Arc::ptr_eq(&a.field, &b.field) && Arc::ptr_eq(&a.waters, &b.waters)
}

/// Crossings of all pairs; those of two paths that run as they did are kept.
fn pairs(
    before: Option<&Pairs>,
    state: &State,
    surveys: &[Arc<Survey>],
    same_course: impl Fn(&Arc<Path>) -> bool,
) -> Pairs {
    let fresh: Vec<bool> = state.paths.iter().map(|p| !same_course(p)).collect();
    let index = |id: PathId| state.paths.binary_search_by_key(&id, |p| p.id).ok();
    let mut pairs = Pairs::new();
    for (ids, crossings) in before.into_iter().flatten() {
        if ids.iter().all(|id| index(*id).is_some_and(|i| !fresh[i])) {
            pairs.insert(*ids, crossings.clone());
        }
    }
    let surveyed = |i: usize| -> Surveyed<'_> { (&state.paths[i], &surveys[i]) };
    let count = state.paths.len();
    let boxes: Vec<Rect> = (0..count).map(|i| reach(surveyed(i))).collect();
    for i in (0..count).filter(|&i| fresh[i]) {
        // Two fresh ones are looked at once.
        for j in (0..count).filter(|&j| j >= i || !fresh[j]) {
            if boxes[i].intersect(boxes[j]).is_zero_area() {
                continue;
            }
            let [a, b] = [surveyed(i.min(j)), surveyed(i.max(j))];
            let found = if i == j { crossings_within(a) } else { crossings_between(a, b) };
            if !found.is_empty() {
                pairs.insert([a.0.id, b.0.id], Arc::new(found));
            }
        }
    }
    pairs
}

/// All crossings, with what was said about them.
fn decided(pairs: &Pairs, state: &State) -> Vec<Crossing> {
    let mut all = Vec::new();
    for ([first, second], crossings) in pairs {
        let (Some(a), Some(b)) = (state.path_of(*first), state.path_of(*second)) else { continue };
        let mut crossings = crossings.as_ref().clone();
        decide(a, b, &mut crossings, &state.choices);
        all.extend(crossings);
    }
    all
}

/// The elevation of one path among those that it hangs together with.
struct PathElevation {
    profile: Arc<Profile>,
    wanted: Vec<[f64; 2]>,
    infeasible: Option<Arc<str>>,
}

/// What is known of all paths before their elevations are.
struct Known<'a> {
    surveys: &'a [Arc<Survey>],
    /// The elevation that each would have alone.
    alone: &'a [Arc<Profile>],
    crossings: &'a [Crossing],
    crossings_of: &'a [Vec<Crossing>],
}

/// The elevations of all paths. Paths that hang together through crossings are solved together; where neither they nor what they depend on changed, elevations are those of before.
fn heights(
    before: Option<&Results>,
    state: &State,
    terrain: &LaidTerrain,
    Known { surveys, alone, crossings, crossings_of }: Known<'_>,
    is_old: &dyn Fn(&Arc<Path>) -> bool,
) -> (Vec<PathElevation>, Option<Unordered>) {
    let mut found: Vec<Option<PathElevation>> = state.paths.iter().map(|_| None).collect();
    let mut unordered = None;
    for members in hanging_together(state, crossings) {
        let old = |i: usize| before.and_then(|r| r.path(state.paths[i].id));
        let kept = |&i: &usize| old(i).filter(|old| is_old(&state.paths[i]) && old.crossings == crossings_of[i]);
        if members.iter().all(|i| kept(i).is_some()) {
            for (&i, old) in members.iter().zip(members.iter().filter_map(kept)) {
                found[i] = Some(PathElevation {
                    profile: old.profile.clone(),
                    wanted: old.wanted.clone(),
                    infeasible: old.infeasible.clone(),
                });
            }
            continue;
        }
        let paths: Vec<&Path> = members.iter().map(|&i| state.paths[i].as_ref()).collect();
        let surveyed: Vec<Surveyed<'_>> =
            members.iter().map(|&i| -> Surveyed<'_> { (&state.paths[i], &surveys[i]) }).collect();
        let profiles: Vec<&Profile> = members.iter().map(|&i| alone[i].as_ref()).collect();
        let ids: BTreeSet<PathId> = paths.iter().map(|p| p.id).collect();
        let own: Vec<usize> = (0..crossings.len()).filter(|&c| ids.contains(&crossings[c].first.path)).collect();
        let of_group: Vec<Crossing> = own.iter().map(|&c| crossings[c]).collect();
        let wanted = wanted_heights(&paths, &profiles, &of_group).unwrap_or_else(|ring| {
            unordered = Some(Unordered { crossings: ring.crossings.iter().map(|&c| own[c]).collect() });
            vec![Vec::new(); paths.len()]
        });
        let fair: Vec<Profile> = (0..paths.len()).map(|k| profile_with(paths[k], profiles[k], &wanted[k])).collect();
        let site = Site {
            waters: &terrain.waters,
            soils: &state.soils,
            rules: &state.rules,
            earthwork: &state.settings.earthwork,
        };
        let any = paths.iter().any(|p| p.heights == HeightMode::Engineered);
        let (exact, trouble) = match if any { engineered(&surveyed, &fair, &of_group, &site) } else { Ok(Vec::new()) } {
            Ok(exact) => (exact, None),
            Err(error) => (Vec::new(), Some(Arc::from(error.to_string()))),
        };
        let mut exact = exact.into_iter();
        for ((&i, wanted), fair) in members.iter().zip(wanted).zip(fair) {
            let profile = Arc::new(exact.next().flatten().unwrap_or(fair));
            let infeasible = trouble.clone().filter(|_| state.paths[i].heights == HeightMode::Engineered);
            found[i] = Some(PathElevation { profile, wanted, infeasible });
        }
    }
    let elevations = found.into_iter().zip(alone).map(|(elevation, alone)| {
        elevation.unwrap_or_else(|| PathElevation { profile: alone.clone(), wanted: Vec::new(), infeasible: None })
    });
    (elevations.collect(), unordered)
}

/// Paths in groups that hang together through crossings.
fn hanging_together(state: &State, crossings: &[Crossing]) -> Vec<Vec<usize>> {
    let index = |id: PathId| state.paths.binary_search_by_key(&id, |p| p.id).ok();
    let mut groups = Groups::new(state.paths.len());
    for crossing in crossings {
        if let [Some(a), Some(b)] = crossing.places().map(|p| index(p.path)) {
            groups.unite(a, b);
        }
    }
    groups.all()
}
