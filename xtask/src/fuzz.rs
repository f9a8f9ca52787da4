//! Each fuzz target for a while.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::{process, tree};

/// Runs every target under `fuzz/fuzz_targets`; a crash ends it with the input that caused it.
pub(crate) fn run(seconds: u64) -> Result<()> {
    let folder = tree::root().join("fuzz/fuzz_targets");
    let entries = fs::read_dir(&folder).with_context(|| format!("no fuzz targets in {}", folder.display()))?;
    let mut targets: Vec<String> = entries
        .flatten()
        .filter_map(|entry| entry.file_name().to_string_lossy().strip_suffix(".rs").map(str::to_owned))
        .collect();
    targets.sort();
    if targets.is_empty() {
        bail!("{} holds no targets", folder.display());
    }
    let cargo_fuzz = cargo_fuzz()?;
    for target in &targets {
        println!("\n==== fuzz {target}, {seconds} s");
        // What is found goes into the first folder, which git ignores; the seeds are checked in.
        let corpus = tree::scratch("fuzz")?.join(target);
        fs::create_dir_all(&corpus).with_context(|| format!("cannot make {}", corpus.display()))?;
        let mut command = Command::new(&cargo_fuzz);
        command.args(["fuzz", "run", target]).arg(corpus);
        let seeds = tree::root().join("fuzz/seeds").join(target);
        if seeds.is_dir() {
            command.arg(seeds);
        }
        command.args(["--", &format!("-max_total_time={seconds}")]);
        // The sanitizers are still behind nightly's gate; this opens it on the toolchain in use.
        process::run(command.current_dir(tree::root()).env("RUSTC_BOOTSTRAP", "1"))?;
    }
    println!("\n{} passed, 0 failed", targets.len());
    Ok(())
}

/// The cargo-fuzz that is here, or one installed into `cache/`.
fn cargo_fuzz() -> Result<PathBuf> {
    if process::exists("cargo-fuzz") {
        return Ok("cargo-fuzz".into());
    }
    let tools = tree::cache().join("tools");
    let installed = tools.join("bin/cargo-fuzz");
    if !installed.exists() {
        process::run(process::cargo(&["install", "--quiet", "--locked", "cargo-fuzz", "--root"]).arg(&tools))?;
    }
    Ok(installed)
}
