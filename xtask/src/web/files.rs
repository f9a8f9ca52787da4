//! The files of the page: what is written by hand put beside what was compiled, each with its compressed forms, and how large it all is.

use std::fmt;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;

use crate::tree;

/// Name of the compiled module and of the script that loads it.
pub(super) const PROGRAM: &str = "fairpath";

/// The compiled module's file.
pub(crate) const PROGRAM_FILE: &str = "fairpath_bg.wasm";

/// Endings of the compressed forms, and what a browser that takes them says.
pub(super) const ENCODINGS: [(&str, &str); 2] = [("br", "br"), ("gz", "gzip")];

/// Brotli's effort, of 11: one step more takes three times as long for 1 %, which nobody waits for who is testing.
const BROTLI_QUALITY: i32 = 9;

/// Brotli's window, 2^22 bytes, the largest that every browser takes.
const BROTLI_WINDOW_LOG2: i32 = 22;

/// The marks in index.html for what only the build knows.
const MARKS: [&str; 2] = ["{{program-bytes}}", "{{version}}"];

/// A page that is ready to be handed out.
pub(crate) struct Page {
    /// Where it lies.
    pub(crate) folder: PathBuf,
    sizes: Vec<Size>,
}

/// How many bytes one file has, as it is and compressed.
struct Size {
    name: String,
    plain: u64,
    gzip: u64,
    brotli: u64,
}

impl Page {
    /// Bytes that a browser which takes gzip only must download.
    pub(super) fn gzip_bytes(&self) -> u64 {
        self.sizes.iter().map(|size| size.gzip).sum()
    }
}

impl fmt::Display for Page {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:>11} {:>11} {:>11}  bytes of {}", "plain", "gzip", "brotli", self.folder.display())?;
        for Size { name, plain, gzip, brotli } in &self.sizes {
            writeln!(f, "{plain:>11} {gzip:>11} {brotli:>11}  {name}")?;
        }
        let sum = |of: fn(&Size) -> u64| self.sizes.iter().map(of).sum::<u64>();
        write!(f, "{:>11} {:>11} {:>11}  all", sum(|s| s.plain), sum(|s| s.gzip), sum(|s| s.brotli))
    }
}

/// Puts the files written by hand beside the compiled ones in `folder`, and every file's compressed forms beside it.
pub(super) fn finish(folder: &Path) -> Result<()> {
    let by_hand = tree::root().join("crates/fairpath-app/web");
    for path in plain_files(&by_hand)? {
        fs::copy(&path, folder.join(name_of(&path)))?;
    }
    fill_in(folder)?;
    for path in plain_files(folder)? {
        compress(&path).with_context(|| format!("cannot compress {}", path.display()))?;
    }
    Ok(())
}

/// Tells the page how large the program is, which the browser does not when it comes compressed, and gives everything that it loads a
/// version, so that no browser mixes an old file with a new one.
fn fill_in(folder: &Path) -> Result<()> {
    let program = folder.join(PROGRAM_FILE);
    let bytes = fs::metadata(&program).with_context(|| format!("{} is missing", program.display()))?.len();
    let mut sum = flate2::Crc::new();
    for path in plain_files(folder)? {
        sum.update(&fs::read(path)?);
    }
    let index = folder.join("index.html");
    let mut text = fs::read_to_string(&index).context("the page has no index.html")?;
    for (mark, value) in MARKS.into_iter().zip([bytes.to_string(), format!("{:08x}", sum.sum())]) {
        if !text.contains(mark) {
            bail!("index.html has no {mark}");
        }
        text = text.replace(mark, &value);
    }
    fs::write(&index, text)?;
    Ok(())
}

fn compress(path: &Path) -> Result<()> {
    let bytes = fs::read(path)?;
    let create = |ending: &str| File::create(with_ending(path, ending)).map(BufWriter::new);
    let mut gzip = GzEncoder::new(create("gz")?, Compression::best());
    gzip.write_all(&bytes)?;
    gzip.finish()?.flush()?;
    let options = brotli::enc::BrotliEncoderParams {
        quality: BROTLI_QUALITY,
        lgwin: BROTLI_WINDOW_LOG2,
        ..brotli::enc::BrotliEncoderParams::default()
    };
    let mut out = create("br")?;
    brotli::BrotliCompress(&mut &bytes[..], &mut out, &options)?;
    out.flush()?;
    Ok(())
}

/// The sizes of a finished page, the largest file first.
pub(super) fn measure(folder: &Path) -> Result<Page> {
    let mut sizes = Vec::new();
    for path in plain_files(folder)? {
        let bytes =
            |path: PathBuf| fs::metadata(&path).map(|data| data.len()).with_context(|| format!("{path:?} is missing"));
        sizes.push(Size {
            name: name_of(&path),
            plain: bytes(path.clone())?,
            gzip: bytes(with_ending(&path, "gz"))?,
            brotli: bytes(with_ending(&path, "br"))?,
        });
    }
    sizes.sort_by_key(|size| std::cmp::Reverse(size.plain));
    Ok(Page { folder: folder.to_owned(), sizes })
}

/// Copies a page with all that belongs to it.
pub(crate) fn copy(page: &Path, folder: &Path) -> Result<()> {
    empty(folder)?;
    for entry in page.read_dir().with_context(|| format!("cannot look into {}", page.display()))? {
        let entry = entry?;
        fs::copy(entry.path(), folder.join(entry.file_name()))?;
    }
    Ok(())
}

/// An empty folder, whatever was there before.
pub(super) fn empty(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("cannot remove {}", folder.display()))?;
    }
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))
}

/// Puts a fresh folder in the place of an old one.
pub(super) fn replace(fresh: &Path, folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("cannot remove the old {}", folder.display()))?;
    }
    fs::rename(fresh, folder).with_context(|| format!("cannot put the page at {}", folder.display()))
}

/// The path with one more ending.
pub(super) fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

/// The files of a folder that are not the compressed form of another, by name.
fn plain_files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in folder.read_dir().with_context(|| format!("cannot look into {}", folder.display()))? {
        let path = entry?.path();
        let compressed = ENCODINGS.iter().any(|(ending, _)| path.extension().is_some_and(|own| own == *ending));
        if path.is_file() && !compressed {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    fn page(index: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("fairpath-page-{}-{}", std::process::id(), index.len()));
        empty(&folder).unwrap();
        fs::write(folder.join("fairpath_bg.wasm"), vec![7; 4321]).unwrap();
        fs::write(folder.join("index.html"), index).unwrap();
        folder
    }

    #[test]
    fn the_page_is_told_how_large_the_program_is() {
        let folder = page("<i>{{program-bytes}}</i>{{version}}{{version}}");
        fill_in(&folder).unwrap();
        let text = fs::read_to_string(folder.join("index.html")).unwrap();
        assert!(text.starts_with("<i>4321</i>") && !text.contains("{{"), "{text}");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_page_without_its_marks_is_refused() {
        let folder = page("<i>{{version}}</i>");
        assert!(fill_in(&folder).unwrap_err().to_string().contains("{{program-bytes}}"));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn compressed_files_hold_the_plain_ones_bytes_and_are_counted_beside_them() {
        let folder = page("<p>a page of which nothing is special, a page of which nothing is special</p>");
        for path in plain_files(&folder).unwrap() {
            compress(&path).unwrap();
        }
        let index = folder.join("index.html");
        let plain = fs::read(&index).unwrap();
        let (mut gzip, mut brotli) = (Vec::new(), Vec::new());
        flate2::read::GzDecoder::new(File::open(with_ending(&index, "gz")).unwrap()).read_to_end(&mut gzip).unwrap();
        brotli::Decompressor::new(File::open(with_ending(&index, "br")).unwrap(), 4096)
            .read_to_end(&mut brotli)
            .unwrap();
        assert!(gzip == plain && brotli == plain);
        let measured = measure(&folder).unwrap();
        let names: Vec<&str> = measured.sizes.iter().map(|size| size.name.as_str()).collect();
        assert_eq!(names, ["fairpath_bg.wasm", "index.html"]);
        assert_eq!(measured.sizes[1].plain, plain.len() as u64);
        assert_eq!(measured.gzip_bytes(), measured.sizes.iter().map(|size| size.gzip).sum::<u64>());
        fs::remove_dir_all(folder).unwrap();
    }
}
