//! `fairpath-project 1`: a document as its commands, and what followed from them, so that opening can tell whether the same follows again.

use crate::error::{Error, Fault};
use crate::strokes_json::{check_format, check_version, json_fault};
use fairpath_drive::{Command, Document, Results, TerrainSource};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::{Component, Path, PathBuf};

/// The word in the file's `format`.
const FORMAT: &str = "fairpath-project";

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    format: String,
    version: u64,
    /// What was done, in order.
    commands: Vec<Command>,
    /// What followed.
    results: Value,
}

/// The file of a document: the same bytes for the same document. Files of terrains, which lie beside a script in the folder `from`, are named so that they are found from the folder `to`, in
/// which the project will lie.
///
/// # Errors
/// Never for documents that commands led to; a number that is not finite would be refused.
pub fn encode_project(document: &Document, from: &Path, to: &Path) -> Result<Vec<u8>, Error> {
    let mut commands = document.commands().to_vec();
    for command in &mut commands {
        if let Command::Terrain(TerrainSource { file: Some(file), .. }) = command {
            *file = seen_from(&from.join(&*file), to, file);
        }
    }
    let record = Record { format: FORMAT.to_owned(), version: 1, commands, results: what_followed(document) };
    let unwritable = |e: serde_json::Error| Error::Unwritable {
        format: "fairpath-project",
        place: "the document".to_owned(),
        problem: e.to_string(),
    };
    let mut bytes = serde_json::to_vec_pretty(&record).map_err(unwritable)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// A file's path as it is from another folder; as it was if one of them is not there.
fn seen_from(file: &Path, folder: &Path, as_it_was: &str) -> String {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (Ok(file), Ok(folder)) = (file.canonicalize(), folder.canonicalize()) else { return as_it_was.to_owned() };
    let common = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    let path: PathBuf = up.chain(file.components().skip(common)).collect();
    // With slashes, so that the project can be taken to another system.
    let parts: Vec<String> = path.components().map(|c| c.as_os_str().to_string_lossy().into_owned()).collect();
    parts.join("/")
}

/// What followed from a document's commands.
fn what_followed(document: &Document) -> Value {
    document.results().map_or(Value::Null, |r| results(r))
}

/// The commands of a project, and what followed from them when it was saved.
pub(super) struct Saved {
    pub(super) commands: Vec<Command>,
    results: Value,
}

impl Saved {
    /// Whether the same follows again, to the bit.
    pub(super) fn follows_from(&self, document: &Document) -> bool {
        self.results == what_followed(document)
    }
}

/// What followed, in so far as other programs may want it, and sums of the rest.
fn results(results: &Results) -> Value {
    let path = |p: &fairpath_drive::PathResult| {
        let segment =
            |s: &fairpath_curve::Segment| json!([s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1]);
        let knot = |k: &fairpath_drive::Knot| json!([k.station_m, k.height_m, k.grade]);
        json!({
            "name": p.path.name,
            "plan": p.path.plan.segments().iter().map(segment).collect::<Vec<_>>(),
            "closed": p.path.plan.is_closed(),
            "profile": p.profile.knots().iter().map(knot).collect::<Vec<_>>(),
            "structures": p.structures.iter()
                .map(|s| json!({"carrier": s.carrier, "from_m": s.from_m, "to_m": s.to_m})).collect::<Vec<_>>(),
        })
    };
    let mut ground = Fnv::default();
    for at in results.ground.shaped_samples() {
        ground.add(at[0] as u64);
        ground.add(at[1] as u64);
        ground.add(results.ground.sample(at).to_bits());
    }
    let mut trees = Fnv::default();
    for tree in results.trees.values().flat_map(|t| t.iter()) {
        trees.add(tree.place.x.to_bits());
        trees.add(tree.place.y.to_bits());
    }
    json!({
        "paths": results.paths.iter().map(|p| path(p)).collect::<Vec<_>>(),
        "ground": format!("{:016x}", ground.0),
        "trees": format!("{:016x}", trees.0),
    })
}

/// Fowler, Noll and Vo's hash (FNV-1a) of numbers: tells files apart that rounding made differ, not those that somebody forged.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn add(&mut self, number: u64) {
        for byte in number.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// Whether a file that begins like this is a project.
pub(super) fn is_project(head: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&head[..head.len().min(200)]);
    head.contains("\"fairpath-project\"")
}

/// A project from its text.
pub(super) fn parse(text: &str) -> Result<Saved, Fault> {
    let Record { format, version, commands, results } = serde_json::from_str(text).map_err(|e| json_fault(&e))?;
    let told = |e: serde_json::Error| Fault::new("the head of the file", e);
    check_format(&format, FORMAT).map_err(told)?;
    check_version(version).map_err(told)?;
    Ok(Saved { commands, results })
}
