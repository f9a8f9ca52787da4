//! Who may depend on whom, checked from `cargo metadata`.

use std::collections::BTreeMap;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::process;

/// What one crate of the workspace may depend on.
struct Layer {
    name: &'static str,
    /// Crates of the workspace, each of a row above.
    workspace: &'static [&'static str],
    /// Crates from outside, in builds; `None` where any will do.
    outside: Option<&'static [&'static str]>,
}

/// The rows of ARCHITECTURE.md, from the bottom of the house up.
const LAYERS: &[Layer] = &[
    Layer {
        name: "fairpath-curve",
        workspace: &[],
        outside: Some(&["kurbo", "libm", "schemars", "serde", "thiserror"]),
    },
    Layer {
        name: "fairpath-fit",
        workspace: &["fairpath-curve"],
        outside: Some(&["flo_curves", "kurbo", "libm", "rayon", "schemars", "serde", "thiserror"]),
    },
    Layer {
        name: "fairpath-shape",
        // The fitter makes the splines of its tests.
        workspace: &["fairpath-curve", "fairpath-fit"],
        outside: Some(&["libm", "schemars", "serde", "spade", "thiserror"]),
    },
    Layer {
        name: "fairpath-drive",
        workspace: &["fairpath-curve", "fairpath-fit", "fairpath-shape"],
        outside: Some(&["clarabel", "libm", "schemars", "serde", "thiserror"]),
    },
    Layer {
        name: "fairpath-io",
        workspace: &["fairpath-curve", "fairpath-fit", "fairpath-shape", "fairpath-drive"],
        outside: None,
    },
    Layer {
        name: "fairpath-render",
        // Files and the fitter are for the pictures of its examples.
        workspace: &["fairpath-curve", "fairpath-shape", "fairpath-fit", "fairpath-io"],
        outside: Some(&["bytemuck", "glam", "pollster", "thiserror", "wgpu"]),
    },
    Layer {
        name: "fairpath-sketch",
        workspace: &["fairpath-curve", "fairpath-fit", "fairpath-shape", "fairpath-io"],
        outside: Some(&["data-encoding", "libm", "schemars", "serde", "serde_json", "thiserror"]),
    },
    Layer {
        name: "fairpath",
        workspace: &[
            "fairpath-curve",
            "fairpath-fit",
            "fairpath-shape",
            "fairpath-drive",
            "fairpath-io",
            "fairpath-sketch",
        ],
        outside: None,
    },
    Layer {
        name: "fairpath-app",
        workspace: &[
            "fairpath-curve",
            "fairpath-fit",
            "fairpath-shape",
            "fairpath-io",
            "fairpath-render",
            "fairpath-sketch",
        ],
        outside: None,
    },
    Layer {
        name: "xtask",
        workspace: &["fairpath-curve", "fairpath-fit", "fairpath-shape", "fairpath-io", "fairpath-sketch", "fairpath"],
        outside: None,
    },
];

/// One dependency as a manifest declares it.
#[derive(Clone, Debug, PartialEq)]
struct Edge {
    from: String,
    to: String,
    /// Needed by tests, examples and benches only.
    dev: bool,
}

/// Checks the workspace; the note says what was seen.
pub(crate) fn run() -> Result<String> {
    let mut command = process::cargo(&["metadata", "--format-version", "1", "--no-deps", "--quiet"]);
    let output = command.output().context("cannot start cargo metadata")?;
    if !output.status.success() {
        bail!("cargo metadata failed: {}", String::from_utf8_lossy(&output.stderr));
    }
    let metadata: Value = serde_json::from_slice(&output.stdout).context("cargo metadata gave no JSON")?;
    let (members, edges) = read(&metadata)?;
    let breaches = check(LAYERS, &members, &edges);
    if !breaches.is_empty() {
        bail!("the layers are broken:\n  {}", breaches.join("\n  "));
    }
    Ok(format!("{} crates, {} dependencies, each where it may be", members.len(), edges.len()))
}

fn read(metadata: &Value) -> Result<(Vec<String>, Vec<Edge>)> {
    let text = |value: &Value| value.as_str().map(str::to_owned).context("a name is missing from cargo metadata");
    let mut members = Vec::new();
    let mut edges = Vec::new();
    for package in metadata["packages"].as_array().context("cargo metadata lists no packages")? {
        let from = text(&package["name"])?;
        for dependency in package["dependencies"].as_array().context("a package without a list of dependencies")? {
            edges.push(Edge { from: from.clone(), to: text(&dependency["name"])?, dev: dependency["kind"] == "dev" });
        }
        members.push(from);
    }
    Ok((members, edges))
}

/// Every breach of the rules, in words.
fn check(layers: &[Layer], members: &[String], edges: &[Edge]) -> Vec<String> {
    let table: BTreeMap<&str, &Layer> = layers.iter().map(|layer| (layer.name, layer)).collect();
    let mut breaches = Vec::new();
    for member in members {
        if !table.contains_key(member.as_str()) {
            breaches.push(format!("{member} is in no row: give it one in xtask/src/layers.rs and ARCHITECTURE.md"));
        }
    }
    for layer in layers {
        if !members.iter().any(|member| member == layer.name) {
            breaches.push(format!("{} has a row and does not exist", layer.name));
        }
    }
    for edge in edges {
        let Some(layer) = table.get(edge.from.as_str()) else { continue };
        let inside = members.contains(&edge.to);
        if inside && edge.from != edge.to && !layer.workspace.contains(&edge.to.as_str()) {
            breaches.push(format!("{} may not depend on {}, which is not below it", edge.from, edge.to));
        }
        // Oracles and generators of tests do not ship, so dev-dependencies from outside are free.
        if !inside && !edge.dev && layer.outside.is_some_and(|list| !list.contains(&edge.to.as_str())) {
            breaches.push(format!("{} may not depend on {} from outside: it is not on its list", edge.from, edge.to));
        }
    }
    breaches
}

#[cfg(test)]
mod tests {
    use super::*;

    fn members() -> Vec<String> {
        LAYERS.iter().map(|layer| layer.name.to_owned()).collect()
    }

    fn edge(from: &str, to: &str, dev: bool) -> Edge {
        Edge { from: from.into(), to: to.into(), dev }
    }

    #[test]
    fn this_workspace_keeps_its_layers() {
        run().unwrap();
    }

    #[test]
    fn every_row_depends_on_rows_above_it_only() {
        for (i, layer) in LAYERS.iter().enumerate() {
            for name in layer.workspace {
                assert!(LAYERS[..i].iter().any(|above| above.name == *name), "{} on {name}", layer.name);
            }
        }
    }

    #[test]
    fn what_is_allowed_passes() {
        let edges = [
            edge("fairpath-fit", "fairpath-curve", false),
            edge("fairpath-curve", "kurbo", false),
            edge("fairpath-curve", "num-dual", true),
            edge("fairpath-io", "usvg", false),
        ];
        assert_eq!(check(LAYERS, &members(), &edges), Vec::<String>::new());
    }

    #[test]
    fn a_dependency_upwards_is_a_breach_even_in_tests() {
        for dev in [false, true] {
            let breaches = check(LAYERS, &members(), &[edge("fairpath-curve", "fairpath-fit", dev)]);
            assert_eq!(breaches, ["fairpath-curve may not depend on fairpath-fit, which is not below it"]);
        }
    }

    #[test]
    fn an_unlisted_crate_from_outside_is_a_breach_in_the_cores() {
        let breaches = check(LAYERS, &members(), &[edge("fairpath-fit", "tokio", false)]);
        assert_eq!(breaches, ["fairpath-fit may not depend on tokio from outside: it is not on its list"]);
    }

    #[test]
    fn a_crate_without_a_row_and_a_row_without_a_crate_are_breaches() {
        let mut names = members();
        names.retain(|name| name != "xtask");
        names.push("fairpath-new".into());
        let breaches = check(LAYERS, &names, &[]);
        assert_eq!(breaches.len(), 2, "{breaches:?}");
        assert!(breaches[0].starts_with("fairpath-new is in no row"));
        assert!(breaches[1].starts_with("xtask has a row"));
    }
}
