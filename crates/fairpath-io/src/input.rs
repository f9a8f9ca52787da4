//! Opens files and standard input, tells formats apart, and reads no more than the limits allow.

use crate::error::{Error, Fault};
use crate::limits::Limits;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::path::Path;

/// Bytes looked at to tell a format by its content.
const PEEK: usize = 64 << 10;

/// The name that messages give a path; `-` is standard input.
pub(crate) fn label(path: &Path) -> String {
    if path.as_os_str() == "-" { "standard input".into() } else { path.display().to_string() }
}

/// Opens a file, or standard input for `-`.
pub(crate) fn open(path: &Path) -> Result<Box<dyn Read>, Error> {
    if path.as_os_str() == "-" {
        return Ok(Box::new(io::stdin().lock()));
    }
    let fail = |source| Error::Read { file: label(path), source };
    let file = File::open(path).map_err(fail)?;
    if file.metadata().map_err(fail)?.is_dir() {
        return Err(fail(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder; give the name of a file")));
    }
    Ok(Box::new(file))
}

/// The extension of a path in lower case, or nothing.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

/// Reads the beginning and gives it back with the whole still to be read.
pub(crate) fn peek(mut reader: impl Read) -> io::Result<(Vec<u8>, impl Read)> {
    let mut head = Vec::new();
    reader.by_ref().take(PEEK as u64).read_to_end(&mut head)?;
    Ok((head.clone(), Cursor::new(head).chain(reader)))
}

/// The first byte that is neither blank nor part of a byte order mark.
pub(crate) fn first_byte(head: &[u8]) -> Option<u8> {
    strip_bom(head).iter().copied().find(|b| !b.is_ascii_whitespace())
}

pub(crate) fn strip_bom(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// Everything up to the limit.
pub(crate) fn read_all(reader: impl Read, limits: &Limits) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    reader.take(limits.max_bytes.saturating_add(1)).read_to_end(&mut bytes).map_err(Fault::Io)?;
    check_size(&bytes, limits)?;
    Ok(bytes)
}

/// The size limit for bytes that are in memory already.
pub(crate) fn check_size(bytes: &[u8], limits: &Limits) -> Result<(), Fault> {
    if bytes.len() as u64 > limits.max_bytes {
        let (what, max, limit) = ("bytes", limits.max_bytes, "max_bytes");
        return Err(Fault::OverLimit { place: "the file as a whole".into(), what, max, limit });
    }
    Ok(())
}

/// The text of a file without its byte order mark; UTF-16 is recognised and named.
pub(crate) fn text(bytes: &[u8]) -> Result<&str, Fault> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(Fault::new("byte 0", "the text is UTF-16; save it as UTF-8"));
    }
    let bytes = strip_bom(bytes);
    let text = std::str::from_utf8(bytes).map_err(|e| {
        let at = e.valid_up_to();
        let line = 1 + bytes[..at].iter().filter(|&&b| b == b'\n').count();
        Fault::new(format_args!("line {line}, byte {at}"), "the text is not UTF-8; save it as UTF-8")
    })?;
    if text.bytes().all(|b| b.is_ascii_whitespace()) {
        return Err(Fault::new("line 1", "the file is empty"));
    }
    Ok(text)
}

/// Lines of a text as a stream, none longer than the limit.
pub(crate) struct Lines<R> {
    reader: BufReader<R>,
    buffer: Vec<u8>,
    number: u64,
    max: u64,
}

impl<R: Read> Lines<R> {
    pub(crate) fn new(reader: R, limits: &Limits) -> Self {
        Self { reader: BufReader::new(reader), buffer: Vec::new(), number: 0, max: limits.max_line_bytes }
    }

    /// The next line with its number from 1, without its end; nothing after the last.
    pub(crate) fn next_line(&mut self) -> Result<Option<(u64, &str)>, Fault> {
        self.buffer.clear();
        self.number += 1;
        let place = format!("line {}", self.number);
        let mut limited = self.reader.by_ref().take(self.max.saturating_add(2));
        if limited.read_until(b'\n', &mut self.buffer).map_err(Fault::Io)? == 0 {
            return Ok(None);
        }
        let mut line = self.buffer.as_slice();
        line = line.strip_suffix(b"\n").unwrap_or(line);
        line = line.strip_suffix(b"\r").unwrap_or(line);
        if line.len() as u64 > self.max {
            return Err(Fault::OverLimit { place, what: "bytes in one line", max: self.max, limit: "max_line_bytes" });
        }
        if self.number == 1 {
            if line.starts_with(b"\xff\xfe") || line.starts_with(b"\xfe\xff") {
                return Err(Fault::new(place, "the text is UTF-16; save it as UTF-8"));
            }
            line = strip_bom(line);
        }
        let Ok(line) = std::str::from_utf8(line) else {
            return Err(Fault::new(place, "the text is not UTF-8; expected numbers `x y [t [pressure]]`"));
        };
        if line.contains('\0') {
            return Err(Fault::new(place, "there is a zero byte; expected text with numbers `x y [t [pressure]]`"));
        }
        Ok(Some((self.number, line)))
    }
}

/// Counts what the limits bound.
#[derive(Debug)]
pub(crate) struct Budget {
    left: u64,
    max: u64,
    what: &'static str,
    limit: &'static str,
}

impl Budget {
    pub(crate) fn points(limits: &Limits) -> Self {
        Self { left: limits.max_points, max: limits.max_points, what: "points", limit: "max_points" }
    }

    pub(crate) fn items(limits: &Limits) -> Self {
        Self { left: limits.max_items, max: limits.max_items, what: "strokes or splines", limit: "max_items" }
    }

    pub(crate) fn templates(limits: &Limits) -> Self {
        let max = limits.max_templates;
        Self { left: max, max, what: "French curves", limit: "max_templates" }
    }

    pub(crate) fn nodes(limits: &Limits) -> Self {
        Self { left: limits.max_nodes, max: limits.max_nodes, what: "elements", limit: "max_nodes" }
    }

    /// Bytes that are parsed, again and again where an element is used more than once.
    pub(crate) fn work(limits: &Limits) -> Self {
        Self {
            left: limits.max_bytes,
            max: limits.max_bytes,
            what: "bytes of attributes, counting every use",
            limit: "max_bytes",
        }
    }

    /// Spends one.
    pub(crate) fn spend(&mut self, place: impl Fn() -> String) -> Result<(), Fault> {
        self.spend_many(1, place)
    }

    /// Spends as many.
    pub(crate) fn spend_many(&mut self, count: usize, place: impl Fn() -> String) -> Result<(), Fault> {
        match self.left.checked_sub(count as u64) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(Fault::OverLimit { place: place(), what: self.what, max: self.max, limit: self.limit }),
        }
    }

    pub(crate) fn left(&self) -> u64 {
        self.left
    }
}
