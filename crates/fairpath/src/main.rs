//! The command line; all of it is in the library beside, where the project's chores can reach it.

use std::process::ExitCode;

fn main() -> ExitCode {
    fairpath::run()
}
