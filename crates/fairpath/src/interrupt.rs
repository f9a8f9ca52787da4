//! Ctrl-C ends the program at once, but never in the middle of writing a file.

use std::sync::{Mutex, MutexGuard, PoisonError};

static WRITING: Mutex<()> = Mutex::new(());

/// The exit code of a program that was interrupted, by the shells' convention.
const INTERRUPTED: i32 = 130;

/// Holds interruption off for as long as it lives.
pub(crate) fn hold_off() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From here on an interruption waits for the file that is being written.
pub(crate) fn install() {
    // Without a handler the program just ends where it stands, which is the system's default and no reason to give up.
    let _ = ctrlc::set_handler(|| {
        let _whole = hold_off();
        end();
    });
}

#[expect(clippy::disallowed_methods, reason = "an interrupted program ends here; no file is half-written, by the lock")]
fn end() {
    std::process::exit(INTERRUPTED);
}
