//! `fairpath-project 1`: a document as its commands, and what followed from them, so that opening can tell whether the same follows again.

use super::files::TerrainFolder;
use crate::error::{Error, Fault};
use crate::input::{label, open, read_all, text};
use crate::limits::ReadOptions;
use crate::strokes_json::{check_format, check_version, json_fault};
use fairpath_drive::{Command, Document, Results};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::Path;

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

/// A document from a file.
#[derive(Clone, Debug)]
pub struct DriveProject {
    /// The document, its commands done again.
    pub document: Document,
    /// Whether the same followed from them as when the file was saved, to the bit.
    pub same: bool,
}

/// The file of a document: the same bytes for the same document.
///
/// # Errors
/// Never for documents that commands led to; a number that is not finite would be refused.
pub fn encode_project(document: &Document) -> Result<Vec<u8>, Error> {
    let record = Record {
        format: FORMAT.to_owned(),
        version: 1,
        commands: document.commands().to_vec(),
        results: document.results().map_or(Value::Null, |r| results(r)),
    };
    let unwritable = |e: serde_json::Error| Error::Unwritable {
        format: "fairpath-project",
        place: "the document".to_owned(),
        problem: e.to_string(),
    };
    let mut bytes = serde_json::to_vec_pretty(&record).map_err(unwritable)?;
    bytes.push(b'\n');
    Ok(bytes)
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
        trees.add(tree.foot_m.to_bits());
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
#[must_use]
pub fn is_project(head: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&head[..head.len().min(200)]);
    head.contains("\"fairpath-project\"")
}

/// The document in a file, its commands done again; terrains are looked for beside it. `-` is standard input.
///
/// # Errors
/// When the file cannot be read or breaks the format's rules, or one of its commands cannot be done.
pub fn read_project(path: &Path, options: &ReadOptions) -> Result<DriveProject, Error> {
    let name = label(path);
    let in_file = |fault: Fault| fault.in_file(&name);
    let bytes = read_all(open(path)?, &options.limits).map_err(in_file)?;
    let record: Record =
        text(&bytes).and_then(|t| serde_json::from_str(t).map_err(|e| json_fault(&e))).map_err(in_file)?;
    let checked =
        check_format::<serde_json::Error>(&record.format, FORMAT).and_then(|()| check_version(record.version));
    checked.map_err(|e| in_file(json_fault(&e)))?;
    let files = TerrainFolder::beside(path);
    let mut document = Document::new();
    for (i, command) in record.commands.into_iter().enumerate() {
        document
            .run(command, &files)
            .map_err(|e| in_file(Fault::new(format_args!("command {}", i + 1), e.to_string())))?;
    }
    let same = encode_project(&document)? == bytes;
    Ok(DriveProject { document, same })
}
