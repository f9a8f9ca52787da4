//! The command line of Fairpath, as a library so that the references under `docs/` are written from the same code.
//!
//! `args` says what can be typed, `commands` has a module for each verb, `printer` is all that reaches a terminal.

pub mod args;
mod commands;
mod interrupt;
mod output;
mod pictures;
mod printer;
mod progress;
pub mod reference;
mod settings;
pub mod stopwatch;

use std::process::ExitCode;

use clap::Parser;

use crate::args::{Cli, Command};
use crate::commands::{Ending, compare, convert, drive, edit, fit, inflate, oversketch, templates};
use crate::printer::Printer;

/// Parses the arguments, does what they ask and says how it ended: 0 all done, 1 some stroke failed or `--strict`
/// found a tolerance missed, 2 unusable arguments or input.
#[must_use]
pub fn run() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version go to standard output and are no error; a closed pipe there is none either.
            let _ = error.print();
            return if error.use_stderr() { ExitCode::from(2) } else { ExitCode::SUCCESS };
        }
    };
    let mut printer = Printer::new();
    let ending = match &cli.command {
        Command::Fit(args) => fit::run(args, &mut printer),
        Command::Compare(args) => compare::run(args, &mut printer),
        Command::Inflate(args) => inflate::run(args, &mut printer),
        Command::Convert(args) => convert::run(args, &mut printer),
        Command::Templates(args) => templates::run(args, &mut printer),
        Command::Oversketch(args) => oversketch::run(args, &mut printer),
        Command::Edit(args) => edit::run(args, &mut printer),
        Command::Drive(args) => drive::run(args, &mut printer),
    };
    match ending {
        Ok(Ending::Done) => ExitCode::SUCCESS,
        Ok(Ending::SomeFailed) => ExitCode::from(1),
        Err(error) if printer::is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            printer.error(&error);
            ExitCode::from(2)
        }
    }
}

/// The examples of the README are compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
