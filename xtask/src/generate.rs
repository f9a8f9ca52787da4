//! The references under docs/ that are written by the program that they describe.

use std::fs;

use anyhow::{Context, Result, bail};

use crate::tree;

/// Writes them, or only says whether they are stale.
pub(crate) fn run(check: bool) -> Result<()> {
    let mut stale = Vec::new();
    for (name, text) in fairpath::reference::all() {
        let path = tree::root().join("docs").join(&name);
        if fs::read_to_string(&path).is_ok_and(|old| old == text) {
            continue;
        }
        if check {
            stale.push(name);
        } else {
            fs::create_dir_all(tree::root().join("docs")).context("cannot make docs/")?;
            fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
            println!("wrote docs/{name}");
        }
    }
    if !stale.is_empty() {
        bail!("stale under docs/: {}; run `cargo xtask generate`", stale.join(", "));
    }
    Ok(())
}
