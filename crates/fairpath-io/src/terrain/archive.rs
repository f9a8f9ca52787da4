//! Terrains in ZIP archives, as the sheets of SRTM are handed out: the one terrain in it, and its name.

use super::TerrainFormat;
use super::raster::excerpt;
use crate::error::Fault;
use crate::limits::Limits;
use std::io::{Cursor, Read};
use std::path::Path;
use zip::ZipArchive;
use zip::result::ZipError;

/// How an archive begins, empty ones included.
const MAGICS: [&[u8]; 2] = [b"PK\x03\x04", b"PK\x05\x06"];

/// Whether a file that begins like this is an archive.
pub(super) fn begins(head: &[u8]) -> bool {
    MAGICS.iter().any(|magic| head.starts_with(magic))
}

/// Name and bytes of the one terrain in an archive: the file with the extension of a terrain, or the only file.
pub(super) fn unpacked(bytes: &[u8], limits: &Limits) -> Result<(String, Vec<u8>), Fault> {
    let fault = |error: ZipError| Fault::new("the archive", format_args!("{}; is the file cut off?", excerpt(error)));
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(fault)?;
    let mut files = Vec::new();
    for i in 0..archive.len() {
        let entry = archive.by_index_raw(i).map_err(fault)?;
        if !entry.is_dir() {
            files.push((i, entry.name().map_err(fault)?.into_owned()));
        }
    }
    let terrains: Vec<_> =
        files.iter().filter(|(_, name)| TerrainFormat::from_path(Path::new(name)).is_some()).collect();
    let (i, name) = match (terrains[..].first(), &files[..]) {
        (Some(&found), _) if terrains.len() == 1 => found.clone(),
        (None, [only]) => only.clone(),
        _ => {
            let problem = format!(
                "there are {} terrains among its {} files; unpack it and choose one",
                terrains.len(),
                files.len()
            );
            return Err(Fault::new("the archive", problem));
        }
    };
    let entry = archive.by_index(i).map_err(fault)?;
    // What it says of its size is not believed.
    let mut content = Vec::new();
    let read = entry.take(limits.max_bytes.saturating_add(1)).read_to_end(&mut content);
    read.map_err(|error| Fault::new(format_args!("{} in the archive", excerpt(&name)), error))?;
    if content.len() as u64 > limits.max_bytes {
        let place = format!("{} in the archive", excerpt(&name));
        return Err(Fault::OverLimit { place, what: "bytes", max: limits.max_bytes, limit: "max_bytes" });
    }
    Ok((name, content))
}
