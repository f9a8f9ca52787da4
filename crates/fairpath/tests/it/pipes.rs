//! Readers that hang up, and users who press Ctrl-C.

use std::process::Stdio;

use super::{command, folder, root};

#[test]
fn a_reader_that_hangs_up_is_no_error() {
    for args in [
        &["fit", "examples/hello.json"][..],
        &["fit", "examples/hello.json", "-o", "-", "--format", "json"],
        &["fit", "examples/hello.json", "--stats", "json"],
        &["fit", "--list-parameters"],
        &["fit", "--help"],
    ] {
        let mut child = command(args).current_dir(root()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr);
        assert!(!err.contains("panicked"), "{args:?}: {err}");
        assert_eq!(output.status.code(), Some(0), "{args:?}: {err}");
    }
}

#[test]
fn a_closed_standard_error_is_no_error() {
    let mut child = command(&["fit", "missing.json"]).current_dir(root()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(2));
}

#[cfg(unix)]
#[test]
fn an_interruption_leaves_no_file() {
    use std::io::Write;
    let folder = folder();
    let mut child =
        command(&["fit", "-", "-o", "out.json"]).current_dir(folder.path()).stdin(Stdio::piped()).spawn().unwrap();
    // It waits for more input than this, and so can be met at a known place.
    let mut input = child.stdin.take().unwrap();
    input.write_all(br#"{"format":"fairpath-strokes","#).unwrap();
    let pid = child.id().to_string();
    // More than once: where this test itself runs in the background, the first may come before the program listens, and is then lost.
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        assert!(std::process::Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    };
    drop(input);
    assert!(!status.success());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
