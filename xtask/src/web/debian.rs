//! Debian's second toolchain, the one its browsers are built with, and a standard library for the browser's machine, built once from
//! its source: for machines whose rustup cannot fetch one.

use std::fs;
#[cfg(unix)]
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::toolchain::{Compiler, TARGET, first_line, usual_linker};
use crate::{process, tools, tree};

const RUSTC: &str = "/usr/bin/rustc";
const CARGO: &str = "/usr/bin/cargo";

/// Where the package rust-web-src puts the source of the standard library.
const SOURCE: &str = "/usr/lib/rustlib/src/rust/library";

/// The packages, each with a file by which one knows that it is installed.
const PACKAGES: [(&str, &str); 3] = [("rustc-web", RUSTC), ("cargo-web", CARGO), ("rust-web-src", SOURCE)];

/// An empty crate: building it builds the standard library that it does not use.
const MANIFEST: &str = "[package]\nname = \"empty\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[profile.release]\npanic = \"abort\"\n\n[workspace]\n";

/// The compiler with its library, both installed or built where they are missing.
pub(super) fn compiler() -> Result<Compiler> {
    for (package, file) in PACKAGES {
        if !Path::new(file).exists() {
            tools::apt(package)?;
        }
        if !Path::new(file).exists() {
            bail!("the package {package} is installed and {file} is missing: reinstall it");
        }
    }
    let library = folder();
    if !is_built()? {
        build(&library)?;
    }
    let flags = format!("--sysroot {}", library.display());
    if library.to_string_lossy().contains(char::is_whitespace) {
        bail!("{} has a blank in its name, which compiler flags cannot have: move the project", library.display());
    }
    let variables = vec![
        ("RUSTC", RUSTC.into()),
        ("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", flags.into()),
        ("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", usual_linker()?.into()),
    ];
    Ok(Compiler { cargo: CARGO.into(), variables, name: format!("{} of Debian", version()?) })
}

/// Whether the library is there, and of the compiler that is there.
pub(super) fn is_built() -> Result<bool> {
    if !Path::new(RUSTC).exists() {
        return Ok(false);
    }
    let made_by = fs::read_to_string(stamp(&folder())).unwrap_or_default();
    Ok(!made_by.is_empty() && made_by == version()?)
}

/// Debian upgrades the package now and then, and a library serves the very compiler only that built it.
fn version() -> Result<String> {
    first_line(Command::new(RUSTC).arg("--version"))
}

fn folder() -> PathBuf {
    tree::cache().join("page/std")
}

fn stamp(library: &Path) -> PathBuf {
    library.join("made-by.txt")
}

/// Builds the library and lays it out as the compiler wants it: beside the packaged one.
fn build(library: &Path) -> Result<()> {
    println!("building the standard library for {TARGET} by {}", version()?);
    if library.exists() {
        fs::remove_dir_all(library).with_context(|| format!("cannot remove the stale {}", library.display()))?;
    }
    let empty = library.join("empty");
    fs::create_dir_all(empty.join("src")).with_context(|| format!("cannot make {}", empty.display()))?;
    fs::write(empty.join("Cargo.toml"), MANIFEST)?;
    fs::write(empty.join("src/lib.rs"), "#![no_std]\n")?;
    let mut cargo = Command::new(CARGO);
    cargo.args(["build", "--quiet", "--release", "-Zbuild-std=std,panic_abort", "--target", TARGET]);
    cargo.current_dir(&empty).env("CARGO_TARGET_DIR", empty.join("target"));
    // Only with this will a stable compiler build its own library.
    cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", RUSTC);
    cargo.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", usual_linker()?);
    process::run(&mut cargo).context("cannot build the standard library")?;
    lay_out(&empty.join("target").join(TARGET).join("release/deps"), library)?;
    fs::remove_dir_all(&empty)?;
    // The stamp is written last, so a broken library is never taken for a good one.
    fs::write(stamp(library), version()?).context("cannot write the stamp of the library")
}

fn lay_out(built: &Path, library: &Path) -> Result<()> {
    let targets = library.join("lib/rustlib");
    let own = targets.join(TARGET).join("lib");
    fs::create_dir_all(&own)?;
    for entry in built.read_dir().with_context(|| format!("nothing was built in {}", built.display()))? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.ends_with(".rlib") && !name.starts_with("libempty-") {
            fs::copy(&path, own.join(name))?;
        }
    }
    // What the packaged compiler finds beside its own library: the source, the machine that it runs on.
    let packaged = Path::new(&first_line(Command::new(RUSTC).args(["--print", "sysroot"]))?).join("lib/rustlib");
    for entry in packaged.read_dir()? {
        let entry = entry?;
        let link = targets.join(entry.file_name());
        if !link.exists() {
            symlink(entry.path(), link)?;
        }
    }
    Ok(())
}

#[cfg(not(unix))]
fn symlink(_: PathBuf, _: PathBuf) -> std::io::Result<()> {
    Err(std::io::Error::new(std::io::ErrorKind::Unsupported, "Debian's toolchain runs on Debian only"))
}
