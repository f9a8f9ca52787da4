//! Running other programs.

use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

use crate::tree;

/// `cargo` in the project's root.
pub(crate) fn cargo(args: &[&str]) -> Command {
    let mut command = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".into()));
    command.args(args).current_dir(tree::root());
    if tree::on_build_server() {
        // Nothing is built there twice.
        command.env("CARGO_INCREMENTAL", "0");
    }
    command
}

/// Builds programs of the project in the profile of this one: the tests' own build, or, for chores that time fits in, the users'.
pub(crate) fn build(programs: &[&str]) -> Result<()> {
    // An example and the whole workspace, so that libraries have the features that the tests gave them, or half of them would be built once more.
    let mut build = cargo(&["build", "--quiet", "--workspace", "--example", "pace"]);
    if cfg!(not(debug_assertions)) {
        build = cargo(&["build", "--quiet", "--release"]);
    }
    for program in programs {
        build.args(["--bin", program]);
    }
    run(&mut build)
}

/// Runs to the end; anything but success is an error.
pub(crate) fn run(command: &mut Command) -> Result<()> {
    let status = command.status().with_context(|| format!("cannot start {}", shown(command)))?;
    if !status.success() {
        bail!("{} ended with {status}", shown(command));
    }
    Ok(())
}

/// What a run left behind.
pub(crate) struct Ran {
    /// Its exit code; none where a signal ended it.
    pub(crate) code: Option<i32>,
    /// Standard output and then standard error.
    pub(crate) text: String,
}

/// Runs quietly, keeping what it says.
pub(crate) fn capture(command: &mut Command) -> Result<Ran> {
    let output = command.stdin(Stdio::null()).output().with_context(|| format!("cannot start {}", shown(command)))?;
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    Ok(Ran { code: output.status.code(), text })
}

/// As [`capture`], but a run that takes longer than `limit` is ended, and that is an error.
pub(crate) fn capture_within(command: &mut Command, limit: Duration) -> Result<Ran> {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().with_context(|| format!("cannot start {}", shown(command)))?;
    let (sender, receiver) = mpsc::channel();
    let pipes: [Option<Box<dyn Read + Send>>; 2] =
        [child.stdout.take().map(|pipe| Box::new(pipe) as _), child.stderr.take().map(|pipe| Box::new(pipe) as _)];
    for mut pipe in pipes.into_iter().flatten() {
        let sender = sender.clone();
        thread::spawn(move || {
            let mut bytes = Vec::new();
            // Both ends of a broken pipe are ours; what was read until then is all there is.
            let _ = pipe.read_to_end(&mut bytes);
            let _ = sender.send(bytes);
        });
    }
    drop(sender);
    let begun = Instant::now();
    let mut text = String::new();
    loop {
        match receiver.recv_timeout(limit.saturating_sub(begun.elapsed())) {
            Ok(bytes) => text.push_str(&String::from_utf8_lossy(&bytes)),
            Err(RecvTimeoutError::Disconnected) => break,
            Err(RecvTimeoutError::Timeout) => {
                child.kill().context("cannot end it")?;
                child.wait().context("cannot wait for its end")?;
                bail!("{} did not end within {} s", shown(command), limit.as_secs());
            }
        }
    }
    let status = child.wait().context("cannot wait for it")?;
    Ok(Ran { code: status.code(), text })
}

/// Runs with each line of standard output shown as it comes, and given to `line`.
pub(crate) fn watch(command: &mut Command, mut line: impl FnMut(&str)) -> Result<()> {
    let mut child =
        command.stdout(Stdio::piped()).spawn().with_context(|| format!("cannot start {}", shown(command)))?;
    let stdout = child.stdout.take().context("no pipe to standard output")?;
    for text in BufReader::new(stdout).lines() {
        let text = text.context("cannot read what it prints")?;
        println!("{text}");
        line(&text);
    }
    let status = child.wait().context("cannot wait for it")?;
    if !status.success() {
        bail!("{} ended with {status}", shown(command));
    }
    Ok(())
}

/// Whether a program answers to `--version`.
pub(crate) fn exists(program: impl AsRef<OsStr>) -> bool {
    Command::new(program)
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|s| s.success())
}

/// The command as one would type it.
pub(crate) fn shown(command: &Command) -> String {
    let mut text = command.get_program().to_string_lossy().into_owned();
    for arg in command.get_args() {
        text.push(' ');
        text.push_str(&arg.to_string_lossy());
    }
    text
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn what_a_run_says_is_kept() {
        let mut command = Command::new("sh");
        let ran =
            capture_within(command.args(["-c", "echo out; echo err >&2; exit 3"]), Duration::from_secs(60)).unwrap();
        assert_eq!(ran.code, Some(3));
        assert!(ran.text.contains("out") && ran.text.contains("err"), "{}", ran.text);
    }

    #[test]
    fn a_run_that_does_not_end_is_ended() {
        let mut command = Command::new("sleep");
        let error = capture_within(command.arg("600"), Duration::from_millis(20)).err().unwrap().to_string();
        assert!(error.contains("did not end within"), "{error}");
    }
}
