//! Where things are.

use std::env;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// The project's root.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies in the root")
}

/// The shared data folder: a sibling of the project with recorded strokes and the evaluator; not everyone has it.
pub(crate) fn shared() -> PathBuf {
    root().join("../shared")
}

/// The evaluator, which nobody here may change.
pub(crate) fn evaluator() -> PathBuf {
    shared().join("check/evaluate.py")
}

/// The recorded strokes.
pub(crate) fn strokes() -> PathBuf {
    shared().join("data/strokes")
}

/// Where the chores keep what they install.
pub(crate) fn cache() -> PathBuf {
    root().join("cache")
}

/// A folder for what the chores write, inside cargo's own target folder.
pub(crate) fn scratch(name: &str) -> Result<PathBuf> {
    let folder = target_folder()?.join("xtask").join(name);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    folder.canonicalize().with_context(|| format!("cannot find {}", folder.display()))
}

/// The command line of the same profile as this program, by which it lies; it must have been built before.
pub(crate) fn fairpath() -> Result<PathBuf> {
    let exe = env::current_exe().context("cannot tell where this program is")?;
    Ok(exe.with_file_name(format!("fairpath{}", env::consts::EXE_SUFFIX)))
}

/// The folder of all builds, wherever cargo was told to put it: this program lies in the folder of its profile.
pub(crate) fn target_folder() -> Result<PathBuf> {
    let exe = env::current_exe().context("cannot tell where this program is")?;
    Ok(exe.ancestors().nth(2).context("this program lies in no folder of a profile")?.to_path_buf())
}

/// Whether this is the build server, where nothing may be skipped.
pub(crate) fn on_build_server() -> bool {
    env::var("CI").is_ok_and(|value| value == "true" || value == "1")
}
