//! Road networks as OpenDRIVE.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::python_script;
use super::verdict::{PATIENCE, Verdict};
use crate::process::{self, Ran};
use crate::tools;

/// The plan geometry, walked piece by piece: gaps of more than 1 mm or 1 mrad, along roads and from lane to lane where they are linked.
pub(super) fn plan(file: &Path, _: &Path) -> Result<Verdict> {
    python_script(&tools::python()?, "judge_plan.py", &[file])
}

/// The checker of the format's makers: the schema of the file's version, rules about lanes and junctions, gaps of more than 1 cm.
pub(super) fn asam(file: &Path, scratch: &Path) -> Result<Verdict> {
    python_script(&tools::roads_python()?, "judge_asam.py", &[file, scratch])
}

/// The strictest reader: everything must be continuous to 5 cm and 0.01 rad, in plan and in elevation, and lanes must lead into each other.
pub(super) fn maliput(file: &Path, _: &Path) -> Result<Verdict> {
    python_script(&tools::roads_python_3_10()?, "judge_maliput.py", &[file])
}

/// The reader of the simulator CARLA, which overlooks gaps: a file that it refuses cannot be driven anywhere.
pub(super) fn carla(file: &Path, _: &Path) -> Result<Verdict> {
    python_script(&tools::roads_python_3_10()?, "judge_carla.py", &[file])
}

/// The reader of the traffic simulation SUMO: the network that it makes of the file must have edges.
pub(super) fn sumo(file: &Path, scratch: &Path) -> Result<Verdict> {
    let network = scratch.join("sumo.net.xml");
    if network.exists() {
        fs::remove_file(&network).with_context(|| format!("cannot remove {}", network.display()))?;
    }
    let mut netconvert = Command::new(tools::roads_python()?);
    netconvert.args(["-c", NETCONVERT]).arg("--opendrive-files").arg(file).arg("--output-file").arg(&network);
    let ran = process::capture_within(&mut netconvert, PATIENCE)?;
    let network = fs::read_to_string(&network).unwrap_or_default();
    let text = fs::read_to_string(file).unwrap_or_default();
    verdict_of_sumo(&ran, &network, text.contains("type=\"driving\""))
}

/// Starts netconvert where its package keeps it: the starter beside Python names the place where it was installed, and a cache may be moved.
const NETCONVERT: &str =
    "import os, sys, sumo; os.execv(os.path.join(sumo.SUMO_HOME, 'bin', 'netconvert'), ['netconvert'] + sys.argv[1:])";

/// `is_driven`: whether the file has a lane that cars drive on, without which SUMO may find nothing in it.
fn verdict_of_sumo(ran: &Ran, network: &str, is_driven: bool) -> Result<Verdict> {
    if !matches!(ran.code, Some(0 | 1)) {
        bail!("netconvert ended with {:?}: {}", ran.code, ran.text);
    }
    let lines = |kind: &str| -> Vec<String> {
        ran.text.lines().filter_map(|line| line.strip_prefix(kind)).map(|line| line.trim().to_owned()).collect()
    };
    let (mut faults, warnings) = (lines("Error:"), lines("Warning:"));
    if !is_driven && faults == ["No edges loaded."] {
        return Ok(Verdict { note: "read, with no lane to drive on".into(), warnings, ..Verdict::default() });
    }
    if ran.code == Some(1) && faults.is_empty() {
        faults.push(format!("it failed: {}", ran.text.trim()));
    }
    // Those whose names begin with a colon are SUMO's own, within junctions.
    let edges = network.matches("<edge id=\"").count() - network.matches("<edge id=\":").count();
    if edges == 0 && faults.is_empty() {
        faults.push("no edge came of it".into());
    }
    Ok(Verdict { note: format!("{edges} edges, {} warnings", warnings.len()), faults, warnings })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_network_without_edges_is_a_fault() {
        let ran = |code, text: &str| Ran { code: Some(code), text: text.into() };
        let good = "<net><edge id=\":1_0\"/><edge id=\"1\"/></net>";
        let verdict = verdict_of_sumo(&ran(0, "Warning: steep.\nSuccess.\n"), good, true).unwrap();
        assert_eq!((verdict.faults.len(), verdict.warnings.len()), (0, 1));
        let faults = |code, text: &str, network: &str, is_driven| {
            verdict_of_sumo(&ran(code, text), network, is_driven).unwrap().faults.len()
        };
        assert_eq!(faults(0, "Success.\n", "<net><edge id=\":1_0\"/></net>", true), 1);
        assert_eq!(faults(1, "Error: No nodes loaded.\n", "", false), 1);
        assert_eq!(faults(1, "Quitting.\n", good, true), 1);
        // A file of footpaths has none for SUMO, and is none the worse.
        assert_eq!(faults(1, "Error: No edges loaded.\n", "", true), 1);
        assert_eq!(faults(1, "Error: No edges loaded.\n", "", false), 0);
        assert!(verdict_of_sumo(&Ran { code: None, text: String::new() }, good, true).is_err());
    }
}
