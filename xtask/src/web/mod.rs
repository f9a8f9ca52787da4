//! The page: the application compiled for the browser, with what it loads. In go the sources, out comes a folder that any server can hand out.

mod bindgen;
mod compile;
mod debian;
mod files;
mod serve;
mod toolchain;

use std::path::PathBuf;

use anyhow::{Result, bail};

use crate::tree;

pub(crate) use compile::lint;
pub(crate) use files::{PROGRAM_FILE, copy};
pub(crate) use serve::Server;
pub(crate) use toolchain::Toolchain;

/// Which page is wanted.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    /// Small, which takes long to build.
    Release,
    /// Soon built and twice as large.
    Quick,
}

impl Kind {
    /// The profile of Cargo.toml that builds it.
    fn profile(self) -> &'static str {
        match self {
            Self::Release => "web",
            Self::Quick => "web-quick",
        }
    }

    /// How many bytes a visitor may have to download at most, gzipped. Hardly optimised, the page for tests is twice as large as the other.
    fn most_gzip_bytes(self) -> u64 {
        match self {
            Self::Release => 6_000_000,
            Self::Quick => 12_000_000,
        }
    }

    /// Where the page comes to lie.
    pub(crate) fn folder(self) -> Result<PathBuf> {
        Ok(tree::target_folder()?.join(self.profile()))
    }
}

/// `cargo xtask web`: builds the page, says how large it is and, if asked, hands it out until interrupted.
pub(crate) fn run(kind: Kind, toolchain: Toolchain, port: Option<u16>) -> Result<()> {
    let page = build(kind, toolchain)?;
    println!("\n{page}");
    if let Some(port) = port {
        let server = Server::start(&page.folder, port)?;
        println!("\nThe page is at {} until you press Ctrl+C.", server.url());
        server.wait();
    }
    Ok(())
}

/// Builds the page from the sources as they are; too large a page is an error.
pub(crate) fn build(kind: Kind, toolchain: Toolchain) -> Result<files::Page> {
    let wasm = compile::wasm(kind.profile(), toolchain)?;
    let folder = kind.folder()?;
    // Made beside its place, so that a build that fails leaves the page of before.
    let fresh = folder.with_extension("new");
    files::empty(&fresh)?;
    bindgen::run(&wasm, &fresh, files::PROGRAM)?;
    files::finish(&fresh)?;
    files::replace(&fresh, &folder)?;
    let page = files::measure(&folder)?;
    let (bytes, most) = (page.gzip_bytes(), kind.most_gzip_bytes());
    if bytes > most {
        bail!("{page}\na visitor downloads {bytes} bytes, gzipped, more than {most}");
    }
    Ok(page)
}
