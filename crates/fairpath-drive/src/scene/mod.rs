//! A scene: what a document looks like, as triangles and pieces that stand at many places. A state with what follows from it comes in.

mod bridges;
mod ground_mesh;
mod intersections;
mod roads;
mod shape;
mod signs;
mod trees;
mod tunnels;

use crate::document::{Results, State};
use crate::section::Material;
use fairpath_shape::Mesh;

/// What a surface of a scene looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Finish {
    /// What paths are made of.
    Section(Material),
    /// The natural ground.
    Ground,
    /// Ground that was cut or filled.
    Earthwork,
    /// Water.
    Water,
    /// Leaves of broad trees.
    Leaves,
    /// Needles.
    Needles,
    /// Trunks.
    Bark,
    /// A sign's red.
    SignRed,
    /// A sign's yellow.
    SignYellow,
    /// A sign's white.
    SignWhite,
    /// A sign's black.
    SignBlack,
    /// A lamp's light.
    Light,
}

/// A surface of one finish.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// What it looks like.
    pub finish: Finish,
    /// Its triangles, in metres, z up.
    pub mesh: Mesh,
}

/// Where a piece stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Its origin, m.
    pub position: [f64; 3],
    /// By how much it is turned about the upright, against the clock, radians: then its x axis points there.
    pub heading_rad: f64,
    /// By how much its x axis rises, radians.
    pub pitch_rad: f64,
    /// By how much it is larger than it is.
    pub scale: f64,
}

/// A piece and all places at which it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Instances {
    /// Its name.
    pub name: String,
    /// Its surfaces.
    pub parts: Vec<Part>,
    /// Where it stands.
    pub at: Vec<Placement>,
}

/// What a document looks like.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Surfaces that are there once.
    pub parts: Vec<Part>,
    /// Pieces that stand at many places.
    pub instances: Vec<Instances>,
}

/// How much of a scene is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneOptions {
    /// The natural ground far from all paths may be off by this share of the distance.
    pub coarseness: f64,
    /// Beyond this distance from all paths there is no ground, m; infinite for all of it.
    pub margin_m: f64,
    /// Whether there is natural ground at all, beside the cells of the terrain in which it was shaped.
    pub natural: bool,
}

impl Default for SceneOptions {
    fn default() -> Self {
        Self { coarseness: 0.005, margin_m: f64::INFINITY, natural: true }
    }
}

impl Scene {
    /// The scene of a state. Takes time in proportion to what there is.
    #[must_use]
    pub fn of(state: &State, results: &Results, options: &SceneOptions) -> Self {
        let mut scene = Self::default();
        let mouths = tunnels::mouths(results);
        ground_mesh::add(&mut scene, state, results, options, &mouths);
        for path in &results.paths {
            roads::add(&mut scene, path, &results.junctions);
            bridges::add(&mut scene, path, results);
            tunnels::add(&mut scene, path, results);
        }
        intersections::add(&mut scene, state, results);
        signs::add(&mut scene, results);
        trees::add(&mut scene, results);
        scene.parts.retain(|p| !p.mesh.triangles.is_empty());
        scene.instances.retain(|i| !i.at.is_empty());
        scene
    }

    /// The ground alone, without the mouths of tunnels.
    #[must_use]
    pub fn ground(state: &State, results: &Results, options: &SceneOptions) -> Self {
        let mut scene = Self::default();
        ground_mesh::add(&mut scene, state, results, options, &[]);
        scene.parts.retain(|p| !p.mesh.triangles.is_empty());
        scene
    }

    fn part(&mut self, name: impl Into<String>, finish: Finish, mesh: Mesh) {
        self.parts.push(Part { name: name.into(), finish, mesh });
    }
}

fn part(name: &str, finish: Finish, build: impl FnOnce(&mut Mesh)) -> Part {
    let mut mesh = Mesh::default();
    build(&mut mesh);
    Part { name: name.to_owned(), finish, mesh }
}
