//! What goes to other programs than simulators: alignments as LandXML, lines as GeoJSON, surfaces as glTF.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::python_script;
use super::verdict::{PATIENCE, Verdict};
use crate::process::{self, Ran};
use crate::{tools, tree};

/// The namespace of the Finnish profile of LandXML 1.2, whose files differ from the rest by it alone as far as alignments go.
const INFRAMODEL: &str = "xmlns=\"http://www.inframodel.fi/inframodel\"";

/// The namespace of LandXML itself.
const LANDXML: &str = "xmlns=\"http://www.landxml.org/schema/LandXML-1.2\"";

/// Every line, curve and spiral of an alignment, walked from its start: it must reach its end within 1 mm.
pub(super) fn alignments(file: &Path, _: &Path) -> Result<Verdict> {
    python_script(&tools::python()?, "judge_landxml.py", &[file])
}

/// The structure of a LandXML file, by the part of its schema that alignments need.
pub(super) fn xmllint(file: &Path, scratch: &Path) -> Result<Verdict> {
    // Other encodings than UTF-8 are in use, and the namespace is plain text in all of them.
    let bytes = fs::read(file).with_context(|| format!("cannot read {}", file.display()))?;
    let general = scratch.join("general.xml");
    fs::write(&general, replaced(&bytes, INFRAMODEL.as_bytes(), LANDXML.as_bytes()))
        .with_context(|| format!("cannot write {}", general.display()))?;
    let schema = tree::root().join("xtask/judges/roads/landxml-1.2-alignments.xsd");
    let mut command = Command::new("xmllint");
    command.args(["--nonet", "--noout", "--schema"]).arg(schema).arg(&general);
    let ran = process::capture_within(&mut command, PATIENCE)?;
    match ran.code {
        Some(0) => Ok(Verdict { note: "it is as the schema of alignments wants it".into(), ..Verdict::default() }),
        // Not well-formed, and not valid.
        Some(1 | 3) => {
            let mut faults: Vec<String> =
                ran.text.lines().filter(|line| line.contains("error")).map(str::to_owned).collect();
            // Whatever it says, it did not say that the file is valid.
            if faults.is_empty() {
                faults.push(ran.text);
            }
            Ok(Verdict { faults, note: "not as the schema wants it".into(), ..Verdict::default() })
        }
        code => bail!("xmllint ended with {code:?}: {}", ran.text),
    }
}

/// The first occurrence of some bytes, exchanged.
fn replaced(bytes: &[u8], old: &[u8], new: &[u8]) -> Vec<u8> {
    match bytes.windows(old.len()).position(|window| window == old) {
        Some(at) => [&bytes[..at], new, &bytes[at + old.len()..]].concat(),
        None => bytes.to_vec(),
    }
}

/// The rules of RFC 7946.
pub(super) fn check_geojson(file: &Path, _: &Path) -> Result<Verdict> {
    let script = tree::root().join("xtask/judges/roads/geojson/judge.mjs");
    let mut command = Command::new("node");
    command.arg(script).arg(file).current_dir(tools::node_packages("roads/geojson")?);
    Verdict::of_script(&process::capture_within(&mut command, PATIENCE)?)
}

/// GDAL's reader: there must be features, in longitudes and latitudes that exist.
pub(super) fn ogrinfo(file: &Path, _: &Path) -> Result<Verdict> {
    let mut command = Command::new("ogrinfo");
    command.args(["-ro", "-al", "-so"]).arg(file);
    verdict_of_ogrinfo(&process::capture_within(&mut command, PATIENCE)?)
}

fn verdict_of_ogrinfo(ran: &Ran) -> Result<Verdict> {
    if !matches!(ran.code, Some(0 | 1)) {
        bail!("ogrinfo ended with {:?}: {}", ran.code, ran.text);
    }
    let lines = |kind: &str| -> Vec<String> {
        ran.text.lines().filter(|line| line.starts_with(kind)).map(str::to_owned).collect()
    };
    let (mut faults, warnings) = (lines("ERROR"), lines("Warning"));
    let value = |key: &str| ran.text.lines().find_map(|line| line.strip_prefix(key));
    let count: usize = value("Feature Count: ").and_then(|text| text.parse().ok()).unwrap_or(0);
    // (west, south) - (east, north)
    let extent = value("Extent: ").unwrap_or_default();
    let numbers: Vec<f64> = extent.split(['(', ')', ',', ' ']).filter_map(|word| word.parse().ok()).collect();
    if count == 0 {
        faults.push("no feature in it".into());
    } else if let [west, south, east, north] = numbers[..] {
        if west < -180.0 || east > 180.0 || south < -90.0 || north > 90.0 {
            faults.push(format!("beyond all longitudes and latitudes: {extent}"));
        }
    } else {
        faults.push(format!("it covers nothing: {extent:?}"));
    }
    Ok(Verdict { note: format!("{count} features within {extent}"), faults, warnings })
}

/// The validator of the glTF specification's authors.
pub(super) fn gltf(file: &Path, _: &Path) -> Result<Verdict> {
    let script = tree::root().join("xtask/judges/gltf/judge.mjs");
    let mut command = Command::new("node");
    command.arg(script).arg(file).current_dir(tools::gltf_validator()?);
    verdict_of_validator(&process::capture_within(&mut command, PATIENCE)?)
}

fn verdict_of_validator(ran: &Ran) -> Result<Verdict> {
    let mut lines = ran.text.lines();
    // Its first line counts, the others say what was found.
    let note = lines.next().unwrap_or_default().to_owned();
    let told: Vec<String> = lines.map(|line| line.trim().to_owned()).collect();
    match ran.code {
        Some(0) => Ok(Verdict { note, warnings: told, faults: Vec::new() }),
        Some(1) if note.contains(": ") => {
            let faults = if told.is_empty() { vec![note.clone()] } else { told };
            Ok(Verdict { note, faults, warnings: Vec::new() })
        }
        code => bail!("the validator ended with {code:?}: {}", ran.text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ran(code: Option<i32>, text: &str) -> Ran {
        Ran { code, text: text.into() }
    }

    #[test]
    fn an_extent_may_lie_west_and_south() {
        let told = |extent: &str| format!("Layer name: x\nFeature Count: 2\nExtent: {extent}\n");
        let faults = |text: String| verdict_of_ogrinfo(&ran(Some(0), &text)).unwrap().faults.len();
        assert_eq!(faults(told("(-122.5, -37.0) - (-122.4, -36.0)")), 0);
        assert_eq!(faults(told("(-37.0, -122.5) - (-36.0, -122.4)")), 1);
        assert_eq!(faults(told("")), 1);
        assert_eq!(faults("Feature Count: 0\nExtent: (1, 2) - (3, 4)\n".into()), 1);
        assert_eq!(faults("ERROR 4: Failed to read GeoJSON data\n".into()), 2);
    }

    #[test]
    fn a_validator_that_broke_gives_no_verdict() {
        let counted = "x.glb: 1 errors, 0 warnings, 0 hints; 1 meshes, 2 triangles\n  ACCESSOR /a wrong\n";
        assert_eq!(verdict_of_validator(&ran(Some(1), counted)).unwrap().faults, ["ACCESSOR /a wrong"]);
        assert!(verdict_of_validator(&ran(Some(1), "")).is_err());
        assert!(verdict_of_validator(&ran(None, counted)).is_err());
    }

    #[test]
    fn only_the_first_namespace_is_exchanged() {
        assert_eq!(replaced(b"a b a", b"a", b"xy"), b"xy b a");
        assert_eq!(replaced(b"a b a", b"q", b"xy"), b"a b a");
    }
}
