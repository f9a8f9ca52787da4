//! All that reaches a terminal: results on standard output, everything else on standard error.

use std::io::{self, Write};

use anyhow::{Error, Result};

/// Writes text for people.
#[derive(Debug, Default)]
pub(crate) struct Printer {}

impl Printer {
    pub(crate) fn new() -> Self {
        Self {}
    }

    /// A result, to standard output.
    ///
    /// # Errors
    /// When standard output is closed or full; see [`is_closed_pipe`].
    pub(crate) fn result(&mut self, text: &str) -> Result<()> {
        let mut out = io::stdout().lock();
        out.write_all(text.as_bytes())?;
        out.flush()?;
        Ok(())
    }

    /// Something the user should know.
    pub(crate) fn note(&mut self, text: &str) {
        // A closed standard error leaves nobody to tell.
        let _ = writeln!(io::stderr(), "{text}");
    }

    /// Why nothing came of it.
    pub(crate) fn error(&mut self, error: &Error) {
        self.note(&format!("error: {}", chain(error)));
    }
}

/// An error and its causes, less those that it has told already.
fn chain(error: &Error) -> String {
    let mut text = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !text.contains(&cause) {
            text.push_str(": ");
            text.push_str(&cause);
        }
    }
    text
}

/// Whether the reader of standard output has gone, as `head` does: no error of ours.
pub(crate) fn is_closed_pipe(error: &Error) -> bool {
    let closed = |cause: &(dyn std::error::Error + 'static)| {
        cause.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe)
    };
    error.chain().any(closed)
}

/// Text in columns: the first to the left, the others to the right.
pub(crate) fn columns(rows: &[Vec<String>]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |i: usize| rows.iter().filter_map(|row| row.get(i)).map(|cell| cell.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (i, cell) in row.iter().enumerate() {
            let width = widths[i];
            if i == 0 {
                line.push_str(&format!("{cell:<width$}"));
            } else {
                line.push_str(&format!("  {cell:>width$}"));
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_is_told_once() {
        let error = anyhow::anyhow!("inner").context("outer: inner; do this").context("outermost");
        assert_eq!(chain(&error), "outermost: outer: inner; do this");
    }

    #[test]
    fn columns_line_up() {
        let rows = [vec!["name".into(), "px".into()], vec!["a".into(), "10.5".into()], vec!["é, long".into()]];
        assert_eq!(columns(&rows), "name       px\na        10.5\né, long\n");
    }
}
