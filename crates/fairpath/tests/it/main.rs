//! The command line as its users see it: arguments in, files and exit codes out.

mod bad_input;
mod compare;
mod drive;
mod editing;
mod endings;
mod examples;
mod french_curves;
mod inflate;
mod pipes;
mod references;
mod threads;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// What a run left behind.
struct Ran {
    code: Option<i32>,
    out: Vec<u8>,
    err: String,
}

impl Ran {
    fn text(&self) -> &str {
        std::str::from_utf8(&self.out).expect("standard output is UTF-8")
    }

    fn json(&self) -> Value {
        serde_json::from_slice(&self.out).expect("standard output is JSON")
    }

    /// Ends the test unless the run ended so, and never by a panic.
    #[track_caller]
    fn ended(self, code: i32) -> Self {
        assert!(!self.err.contains("panicked"), "{}", self.err);
        assert_eq!(self.code, Some(code), "standard error: {}", self.err);
        self
    }
}

fn command(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fairpath"));
    command.args(args).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs in a folder.
fn run_in(folder: &Path, args: &[&str]) -> Ran {
    let output = command(args).current_dir(folder).output().expect("the program starts");
    Ran { code: output.status.code(), out: output.stdout, err: String::from_utf8_lossy(&output.stderr).into_owned() }
}

/// Runs in the project's root.
fn run(args: &[&str]) -> Ran {
    run_in(&root(), args)
}

/// Runs in the project's root with this on standard input.
fn run_with(input: &[u8], args: &[&str]) -> Ran {
    let mut child = command(args).current_dir(root()).stdin(Stdio::piped()).spawn().expect("the program starts");
    // A program that refuses its arguments does not read: the pipe may be closed already.
    let _ = child.stdin.take().expect("a pipe").write_all(input);
    let output = child.wait_with_output().expect("the program ends");
    Ran { code: output.status.code(), out: output.stdout, err: String::from_utf8_lossy(&output.stderr).into_owned() }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder for the test")
}

fn read_json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).expect("the file exists")).expect("the file is JSON")
}

/// A strokes file with one stroke for each list of points.
fn strokes(lists: &[(&str, &[[f64; 2]])]) -> String {
    let strokes: Vec<Value> =
        lists.iter().map(|(name, points)| serde_json::json!({"name": name, "points": points})).collect();
    serde_json::json!({"format": "fairpath-strokes", "version": 1, "strokes": strokes}).to_string()
}

const BEND: &[[f64; 2]] = &[[0.0, 0.0], [20.0, 2.0], [40.0, 8.0], [60.0, 18.0], [80.0, 32.0], [100.0, 50.0]];
const DOT: &[[f64; 2]] = &[[5.0, 5.0], [5.0, 5.0]];
