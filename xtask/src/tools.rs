//! What the judges need, installed where it is missing: packages of Python and Node into `cache/`, system packages if we may.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::{process, tree};

/// Fails with a remedy where a part of the toolchain is missing.
pub(crate) fn components() -> Result<String> {
    for (component, probe) in [("rustfmt", "fmt"), ("clippy", "clippy")] {
        let ran = process::capture(&mut process::cargo(&[probe, "--version"]))?;
        if ran.code != Some(0) {
            bail!("the toolchain lacks {component}: run `rustup component add {component}`");
        }
        print!("{}", ran.text);
    }
    Ok("rustfmt and clippy are here".into())
}

/// The Python that runs the judges, in a virtual environment of its own with pinned packages.
pub(crate) fn python() -> Result<PathBuf> {
    environment("judges", "requirements.txt", Path::new("python3"))
}

/// The Python of those judges of roads that run in any, with SUMO's programs beside it.
pub(crate) fn roads_python() -> Result<PathBuf> {
    environment("judges-roads", "roads/requirements.txt", Path::new("python3"))
}

/// The Python of those judges of roads that are built for 3.10.
pub(crate) fn roads_python_3_10() -> Result<PathBuf> {
    let requirements = "roads/requirements-3.10.txt";
    // Known without a search once it is there.
    match installed("judges-roads-3.10", requirements)? {
        Some(python) => Ok(python),
        None => environment("judges-roads-3.10", requirements, &python_3_10()?),
    }
}

/// A virtual environment in `cache/` with the packages that a file of `xtask/judges/` asks for: its Python.
fn environment(name: &str, requirements: &str, base: &Path) -> Result<PathBuf> {
    if let Some(python) = installed(name, requirements)? {
        return Ok(python);
    }
    fs::create_dir_all(tree::cache()).context("cannot make cache/")?;
    let folder = tree::cache().join(name);
    make_venv(&folder, base)?;
    let wanted = tree::root().join("xtask/judges").join(requirements);
    let python = python_in(&folder);
    process::run(Command::new(&python).args(["-m", "pip", "install", "--quiet", "--requirement"]).arg(&wanted))
        .with_context(|| format!("cannot install the Python packages of {}", wanted.display()))?;
    // The stamp is written last, so a broken installation is never taken for a good one.
    let stamp = folder.join("requirements.txt");
    fs::copy(&wanted, &stamp).with_context(|| format!("cannot write {}", stamp.display()))?;
    Ok(python)
}

/// The Python of an environment that has just what a file asks for.
fn installed(name: &str, requirements: &str) -> Result<Option<PathBuf>> {
    let folder = tree::cache().join(name);
    let wanted = tree::root().join("xtask/judges").join(requirements);
    let wanted = fs::read_to_string(&wanted).with_context(|| format!("cannot read {}", wanted.display()))?;
    let is_there = fs::read_to_string(folder.join("requirements.txt")).is_ok_and(|text| text == wanted);
    let python = python_in(&folder);
    Ok((is_there && python.exists()).then_some(python))
}

fn python_in(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}

fn make_venv(folder: &Path, base: &Path) -> Result<()> {
    let make = || process::run(Command::new(base).args(["-m", "venv", "--clear"]).arg(folder));
    if process::exists(base) && make().is_ok() {
        return Ok(());
    }
    apt("python3-venv").with_context(|| format!("`{} -m venv` does not work here", base.display()))?;
    make()
}

/// A Python 3.10: one that is here, be it among those of pyenv, or else one that uv fetches into `cache/`.
fn python_3_10() -> Result<PathBuf> {
    let is_it = |python: &Path| {
        let ran = process::capture(Command::new(python).args(["-c", "import sys; print(sys.version_info[:2])"]));
        ran.is_ok_and(|ran| ran.code == Some(0) && ran.text.trim() == "(3, 10)")
    };
    let pyenv = std::env::var_os("PYENV_ROOT").map(PathBuf::from);
    let pyenv = pyenv.or_else(|| std::env::home_dir().map(|home| home.join(".pyenv")));
    let mut candidates = vec![PathBuf::from("python3.10")];
    // In the order of their names, so that the same one is taken every time.
    let versions = pyenv.and_then(|root| fs::read_dir(root.join("versions")).ok());
    let mut versions: Vec<PathBuf> = versions.into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    versions.sort();
    candidates.extend(versions.into_iter().map(|version| version.join("bin/python3.10")));
    if let Some(python) = candidates.into_iter().find(|python| is_it(python)) {
        return Ok(python);
    }
    let uv = environment("uv", "roads/requirements-uv.txt", Path::new("python3"))?.with_file_name("uv");
    let run_uv = |args: &[&str]| {
        let mut command = Command::new(&uv);
        command.args(["python", args[0], "--managed-python"]).args(&args[1..]).arg("3.10");
        process::capture(command.env("UV_PYTHON_INSTALL_DIR", tree::cache().join("python")))
    };
    let (install, find) = (run_uv(&["install", "--no-bin"])?, run_uv(&["find"])?);
    let python = PathBuf::from(find.text.trim());
    if !is_it(&python) {
        bail!("no Python 3.10 is here, and uv could not fetch one; install it and run this again:\n{}", install.text);
    }
    Ok(python)
}

/// Makes sure that `xmllint` is here, if it can be had.
pub(crate) fn xmllint() -> Result<()> {
    if process::exists("xmllint") { Ok(()) } else { apt("libxml2-utils") }
}

/// Makes sure that `ogrinfo` is here, if it can be had.
pub(crate) fn ogrinfo() -> Result<()> {
    if process::exists("ogrinfo") { Ok(()) } else { apt("gdal-bin") }
}

/// Makes sure that `rsvg-convert` is here, if it can be had.
pub(crate) fn rsvg_convert() -> Result<()> {
    if process::exists("rsvg-convert") { Ok(()) } else { apt("librsvg2-bin") }
}

/// Makes sure that there is a driver to draw with, Mesa's in software where there is no graphics card.
pub(crate) fn graphics() -> Result<String> {
    /// Where each driver for Vulkan has a file that tells of it.
    const FOLDERS: [&str; 3] = ["/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"];
    let known =
        || FOLDERS.iter().filter_map(|folder| fs::read_dir(folder).ok()).any(|mut files| files.next().is_some());
    // Elsewhere the system brings its own.
    if cfg!(target_os = "linux") && !known() {
        apt("mesa-vulkan-drivers")?;
    }
    Ok("there is a driver to draw with".into())
}

/// The browser, if it can be had.
pub(crate) fn chromium() -> Result<&'static str> {
    const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
    if let Some(name) = NAMES.into_iter().find(|name| process::exists(name)) {
        return Ok(name);
    }
    apt("chromium")?;
    Ok(NAMES[0])
}

/// Where a program lies that is found by its name.
pub(crate) fn path_of(program: &str) -> Result<PathBuf> {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&folders).map(|folder| folder.join(program)).find(|path| path.is_file());
    found.with_context(|| format!("{program} is in no folder of PATH"))
}

/// The folder of the glTF validator.
pub(crate) fn gltf_validator() -> Result<PathBuf> {
    node_packages("gltf")
}

/// The folder where a judge of `xtask/judges/` finds its packages, installed with Node's package manager in the versions that its lock
/// file pins.
pub(crate) fn node_packages(judge: &str) -> Result<PathBuf> {
    for (program, package) in [("node", "nodejs"), ("npm", "npm")] {
        if !process::exists(program) {
            apt(package)?;
        }
    }
    let from = tree::root().join("xtask/judges").join(judge);
    let folder = tree::cache().join(judge);
    let lock = fs::read_to_string(from.join("package-lock.json"))
        .with_context(|| format!("the lock file of the judge {judge} is missing"))?;
    let stamp = folder.join("installed-lock.json");
    // The stamp is written last, so a broken installation is never taken for a good one.
    if fs::read_to_string(&stamp).is_ok_and(|text| text == lock) {
        return Ok(folder);
    }
    fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for name in ["package.json", "package-lock.json"] {
        fs::copy(from.join(name), folder.join(name))
            .with_context(|| format!("cannot copy {name} to {}", folder.display()))?;
    }
    let mut install = Command::new("npm");
    install.args(["ci", "--no-audit", "--no-fund", "--ignore-scripts", "--loglevel", "error"]).current_dir(&folder);
    process::run(&mut install).with_context(|| format!("cannot install the packages of the judge {judge}"))?;
    fs::write(&stamp, lock).with_context(|| format!("cannot write {}", stamp.display()))?;
    Ok(folder)
}

/// Installs a system package, which only the superuser of a Debian system may.
pub(crate) fn apt(package: &str) -> Result<()> {
    let user = process::capture(Command::new("id").arg("-u")).map(|ran| ran.text).unwrap_or_default();
    if user.trim() != "0" || !process::exists("apt-get") {
        bail!("install the system package {package} (Debian's name) and run this again");
    }
    let install = || {
        let mut command = Command::new("apt-get");
        command.args(["install", "--yes", "--quiet", "--no-install-recommends", package]);
        command.env("DEBIAN_FRONTEND", "noninteractive");
        process::capture(&mut command)
    };
    if install()?.code == Some(0) {
        return Ok(());
    }
    // The list of packages may be missing or old.
    process::capture(Command::new("apt-get").args(["update", "--quiet"]))?;
    let ran = install()?;
    if ran.code != Some(0) {
        bail!("apt-get could not install {package}:\n{}", ran.text);
    }
    Ok(())
}
