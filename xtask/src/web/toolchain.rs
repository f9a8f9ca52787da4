//! A compiler that knows the browser's machine, wasm32-unknown-unknown: the usual one if it can be given the target, else Debian's second one.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use clap::ValueEnum;

use super::debian;
use crate::process;

/// The browser's machine, as the compiler calls it.
pub(super) const TARGET: &str = "wasm32-unknown-unknown";

/// How long rustup may take to fetch the target's standard library: 30 MB, or a server that never answers.
const FETCH_LIMIT: Duration = Duration::from_secs(300);

/// Whose compiler is to be used.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(crate) enum Toolchain {
    /// The usual compiler if it has the target or rustup can add it, else Debian's.
    Auto,
    /// The compiler that builds everything else.
    Usual,
    /// The packages rustc-web, cargo-web and rust-web-src of Debian, with a standard library built from their source.
    Debian,
}

/// What differs from an ordinary build.
pub(super) struct Compiler {
    /// Cargo's command.
    pub(super) cargo: OsString,
    /// Variables that it is started with.
    pub(super) variables: Vec<(&'static str, OsString)>,
    /// What it is, for the reader.
    pub(super) name: String,
}

impl Toolchain {
    /// The compiler, installed where it is missing.
    pub(super) fn compiler(self) -> Result<Compiler> {
        match self {
            Self::Debian => debian::compiler(),
            Self::Usual if add_target()? => usual(),
            Self::Usual => bail!("rustup could not add the target: run `rustup target add {TARGET}` and see why"),
            Self::Auto if has_target()? => usual(),
            // Once built it is there at once, and what rustup could not fetch then it would be slow to refuse again.
            Self::Auto if debian::is_built()? => debian::compiler(),
            Self::Auto if add_target()? => usual(),
            Self::Auto => {
                println!("rustup cannot add {TARGET} here: using Debian's second toolchain");
                debian::compiler()
            }
        }
    }
}

fn usual() -> Result<Compiler> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let name = first_line(Command::new(rustc()).arg("--version"))?;
    Ok(Compiler { cargo, variables: Vec::new(), name })
}

/// Whether the usual compiler has a standard library for the target.
pub(super) fn has_target() -> Result<bool> {
    let folder = first_line(Command::new(rustc()).args(["--print", "target-libdir", "--target", TARGET]))?;
    let Ok(entries) = Path::new(&folder).read_dir() else { return Ok(false) };
    Ok(entries.flatten().any(|entry| entry.file_name().to_string_lossy().starts_with("libstd-")))
}

fn add_target() -> Result<bool> {
    if has_target()? {
        return Ok(true);
    }
    if !process::exists("rustup") {
        return Ok(false);
    }
    println!("fetching the standard library for {TARGET}");
    match process::capture_within(Command::new("rustup").args(["target", "add", TARGET]), FETCH_LIMIT) {
        Ok(ran) if ran.code == Some(0) => has_target(),
        Ok(ran) => {
            println!("{}", ran.text.trim_end());
            Ok(false)
        }
        Err(error) => {
            println!("{error:#}");
            Ok(false)
        }
    }
}

fn rustc() -> OsString {
    std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

/// The linker that comes with the usual compiler.
pub(super) fn usual_linker() -> Result<PathBuf> {
    let sysroot = first_line(Command::new(rustc()).args(["--print", "sysroot"]))?;
    let host = first_line(Command::new(rustc()).args(["--print", "host-tuple"]))?;
    let linker = Path::new(&sysroot).join("lib/rustlib").join(host).join("bin/rust-lld");
    if !linker.is_file() {
        bail!(
            "the usual compiler has no linker at {}: install Rust by rustup, whose toolchains have it",
            linker.display()
        );
    }
    Ok(linker)
}

/// The first line that a program prints.
pub(super) fn first_line(command: &mut Command) -> Result<String> {
    let ran = process::capture(command)?;
    if ran.code != Some(0) {
        bail!("{} failed:\n{}", process::shown(command), ran.text);
    }
    ran.text.lines().next().map(str::to_owned).with_context(|| format!("{} printed nothing", process::shown(command)))
}
