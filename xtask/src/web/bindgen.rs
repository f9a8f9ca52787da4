//! wasm-bindgen, which writes the JavaScript between the browser and the module: its own library as a small command, built once.

use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::{process, tree};

/// Writes `NAME.js` and `NAME_bg.wasm` into `folder`.
pub(super) fn run(wasm: &Path, folder: &Path, name: &str) -> Result<()> {
    process::run(Command::new(tool()?).arg(wasm).arg(folder).arg(name))
}

/// The command, built where it is missing or stale.
fn tool() -> Result<PathBuf> {
    let source = tree::root().join("xtask/bindgen");
    let read = |path: PathBuf| fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()));
    let lock = read(source.join("Cargo.lock"))?;
    check_versions(&read(tree::root().join("Cargo.lock"))?, &lock)?;
    let sources = format!("{lock}{}{}", read(source.join("Cargo.toml"))?, read(source.join("src/main.rs"))?);

    let folder = tree::cache().join("page/bindgen");
    let tool = folder.join(format!("fairpath-bindgen{EXE_SUFFIX}"));
    let stamp = folder.join("sources.txt");
    // The stamp is written last, so a broken build is never taken for a good one.
    if tool.is_file() && fs::read_to_string(&stamp).is_ok_and(|text| text == sources) {
        return Ok(tool);
    }
    println!("building wasm-bindgen's command, once");
    let target = folder.join("target");
    let mut cargo = process::cargo(&["build", "--quiet", "--release", "--locked"]);
    process::run(cargo.current_dir(&source).arg("--target-dir").arg(&target)).context("cannot build wasm-bindgen")?;
    fs::copy(target.join("release").join(format!("fairpath-bindgen{EXE_SUFFIX}")), &tool)?;
    fs::remove_dir_all(&target).context("cannot remove what the build left")?;
    fs::write(&stamp, sources).with_context(|| format!("cannot write {}", stamp.display()))?;
    Ok(tool)
}

/// The command and the library in the page must be of one version, since they speak a private language.
fn check_versions(project: &str, command: &str) -> Result<()> {
    let of_library = locked(project, "wasm-bindgen").context("Cargo.lock has no wasm-bindgen")?;
    let of_command = locked(command, "wasm-bindgen-cli-support")
        .context("xtask/bindgen/Cargo.lock has no wasm-bindgen-cli-support")?;
    if of_library != of_command {
        bail!(
            "Cargo.lock has wasm-bindgen {of_library} and xtask/bindgen has {of_command}: write \
             `wasm-bindgen-cli-support = \"={of_library}\"` into xtask/bindgen/Cargo.toml and run `cargo update` there"
        );
    }
    Ok(())
}

/// The version of a package in the text of a Cargo.lock.
fn locked<'a>(lock: &'a str, package: &str) -> Option<&'a str> {
    let entry =
        lock.split("[[package]]").find(|entry| entry.lines().any(|line| line == format!("name = \"{package}\"")))?;
    entry.lines().find_map(|line| line.strip_prefix("version = \"")?.strip_suffix('"'))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOCK: &str = "version = 4\n\n[[package]]\nname = \"wasm-bindgen\"\nversion = \"0.2.130\"\n\n[[package]]\nname = \"web-sys\"\nversion = \"0.3.107\"\n";

    #[test]
    fn the_version_is_that_of_the_package_asked_for() {
        assert_eq!(locked(LOCK, "wasm-bindgen"), Some("0.2.130"));
        assert_eq!(locked(LOCK, "web-sys"), Some("0.3.107"));
        assert_eq!(locked(LOCK, "wasm"), None);
    }

    #[test]
    fn versions_that_differ_are_refused_with_the_remedy() {
        let command = |version| format!("[[package]]\nname = \"wasm-bindgen-cli-support\"\nversion = \"{version}\"\n");
        check_versions(LOCK, &command("0.2.130")).unwrap();
        let refused = check_versions(LOCK, &command("0.2.131")).unwrap_err().to_string();
        assert!(refused.contains("wasm-bindgen-cli-support = \"=0.2.130\""), "{refused}");
    }

    #[test]
    fn the_locks_of_this_project_agree() {
        let read = |path: &str| fs::read_to_string(tree::root().join(path)).unwrap();
        check_versions(&read("Cargo.lock"), &read("xtask/bindgen/Cargo.lock")).unwrap();
    }
}
