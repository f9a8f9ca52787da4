//! The application as WebAssembly, and what clippy says of the parts that only a browser sees.

use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use super::toolchain::{TARGET, Toolchain, has_target};
use crate::{process, tree};

/// Compiles the application's library for the browser; the path of the module.
///
/// The build has a target folder of its own, because Debian's compiler and the usual one would drive each other's work out.
pub(super) fn wasm(profile: &str, toolchain: Toolchain) -> Result<PathBuf> {
    let compiler = toolchain.compiler()?;
    println!("compiling the page by {}, profile {profile}", compiler.name);
    let folder = tree::target_folder()?.join("web-build");
    let mut cargo = Command::new(&compiler.cargo);
    // Only here is the library a program of its own; everywhere else it would be linked once more for nobody.
    cargo.args(["rustc", "--package", "fairpath-app", "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--locked", "--target", TARGET, "--profile", profile]);
    cargo.current_dir(tree::root()).arg("--target-dir").arg(&folder);
    // Flags that the user set for other programs know nothing of this machine.
    cargo.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS").envs(compiler.variables);
    process::run(&mut cargo)?;
    Ok(folder.join(TARGET).join(profile).join("fairpath_app.wasm"))
}

/// Lints the application as the browser gets it; false if the usual compiler, whose clippy it is, does not know the browser's machine.
pub(crate) fn lint() -> Result<bool> {
    if !has_target()? {
        return Ok(false);
    }
    let mut clippy =
        process::cargo(&["clippy", "--quiet", "--no-deps", "--package", "fairpath-app", "--lib", "--target", TARGET]);
    clippy.arg("--target-dir").arg(tree::target_folder()?.join("web-build")).args(["--", "--deny", "warnings"]);
    process::run(&mut clippy)?;
    Ok(true)
}
