//! Output files appear whole or not at all.

use crate::error::Error;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes `bytes` to `path`: either the whole content is there afterwards, or what was there before.
///
/// The content goes into a temporary file beside it, which is synced and renamed over `path`. A symbolic link is followed, an
/// existing file keeps its permissions, a new one gets the user's usual ones; what is no regular file (a pipe, `/dev/stdout`) is
/// written directly, and `-` is standard output.
///
/// # Errors
/// [`Error::Write`] when the folder does not exist or may not be written, or the disk is full.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let result = if path.as_os_str() == "-" { write_to_stdout(bytes) } else { replace(path, bytes) };
    result.map_err(|source| Error::Write { file: path.display().to_string(), source })
}

fn write_to_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let existing = fs::metadata(&target).ok();
    if let Some(meta) = &existing
        && !meta.is_file()
    {
        if meta.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder; give the name of a file"));
        }
        return fs::OpenOptions::new().write(true).open(&target)?.write_all(bytes);
    }
    let folder = match target.parent() {
        Some(p) if !p.as_os_str().is_empty() => p.to_path_buf(),
        _ => PathBuf::from("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".fairpath-");
    #[cfg(unix)]
    let ordinary = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(ordinary);
    let mut temporary = builder.tempfile_in(folder)?;
    temporary.write_all(bytes)?;
    if let Some(meta) = existing {
        if meta.permissions().readonly() {
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
        }
        temporary.as_file().set_permissions(meta.permissions())?;
    }
    temporary.as_file().sync_all()?;
    temporary.persist(&target).map_err(|e| e.error)?;
    Ok(())
}
