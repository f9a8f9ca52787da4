//! The project's own chores: the one test command, the judges, the benches and the generated references.

mod bench;
mod data;
mod evaluate;
mod fuzz;
mod generate;
mod growth;
mod judge_roads;
mod judge_web;
mod judge_window;
mod judges;
mod layers;
mod limits;
mod pictures;
mod process;
mod rectilinear;
mod session;
mod steps;
mod table;
mod table1;
mod test;
mod tools;
mod tree;
mod web;
mod window;

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand};

/// The project's own chores.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// The one test command: style, lints, tests, documentation, layers and every outside judge.
    Test,
    /// The judges alone: kernel, DXF, SVG, glTF, the page of a comparison, and the application in a browser and in a window.
    Judge,
    /// Fit every file of the shared data folder, judge the results and hold them against the limits.
    Evaluate {
        /// Only files whose names begin so.
        names: Vec<String>,
    },
    /// Time the fitter, stroke by stroke in one thread, with its growth and its peak memory.
    Bench {
        /// Only files whose names begin so.
        names: Vec<String>,
        /// Each stroke's time is the best of so many.
        #[arg(long, default_value_t = 5)]
        repeat: usize,
    },
    /// Time of each method over the number of points.
    Growth {
        /// Each time is the best of so many.
        #[arg(long, default_value_t = 5)]
        repeat: usize,
    },
    /// Take the pictures of pages for the documents anew, by a browser.
    Pictures,
    /// The paper's table 1 for the like strokes of the shared data folder.
    Table1 {
        /// Each stroke's row is the fastest of so many.
        #[arg(long, default_value_t = 5)]
        repeat: usize,
        /// Writes docs/table1.md instead of printing.
        #[arg(long)]
        write: bool,
    },
    /// Run each fuzz target for a while.
    Fuzz {
        /// Seconds for each target.
        #[arg(default_value_t = 60)]
        seconds: u64,
    },
    /// Write the generated references under docs/ anew.
    Generate {
        /// Only say whether they are stale.
        #[arg(long)]
        check: bool,
    },
    /// Check who depends on whom.
    Layers,
    /// Judge files of roads by outside programs: OpenDRIVE (.xodr), LandXML (.xml), GeoJSON (.geojson) and glTF (.glb).
    JudgeRoads {
        /// The files.
        files: Vec<PathBuf>,
        /// First let the judges look at good and at damaged files, to see what their word is worth.
        #[arg(long)]
        self_test: bool,
    },
    /// Drive the application's page in a browser, alone of all judges.
    JudgeWeb {
        /// The page for visitors instead of that for tests, which is sooner built.
        #[arg(long)]
        release: bool,
    },
    /// Drive the application's window on a screen that nobody sees, alone of all judges.
    JudgeWindow,
    /// Draw hundreds of recorded strokes in one session of the window, released, and say how fast it was and how much memory it took.
    Session {
        /// On the screen that you sit at, whose pointer is taken, instead of one that nobody sees, which is drawn by software.
        #[arg(long)]
        on_screen: bool,
        /// How many strokes.
        #[arg(long, default_value_t = 500)]
        strokes: usize,
    },
    /// Build the page that runs the application in a browser, and say how large it is.
    Web {
        /// For tests: soon built, and twice as large.
        #[arg(long)]
        quick: bool,
        /// Then hand it out on this machine.
        #[arg(long)]
        serve: bool,
        /// The port for that.
        #[arg(long, default_value_t = 8080, requires = "serve")]
        port: u16,
        /// Whose compiler to use.
        #[arg(long, value_enum, default_value = "auto")]
        toolchain: web::Toolchain,
    },
    /// Fit one stroke of a file and print this process's peak memory in kB.
    #[command(hide = true)]
    PeakMemory {
        /// The file.
        file: PathBuf,
        /// The stroke's name.
        name: String,
    },
}

impl Chore {
    /// Whether it times fits.
    fn is_timing(&self) -> bool {
        matches!(self, Self::Evaluate { .. } | Self::Bench { .. } | Self::Growth { .. } | Self::Table1 { .. })
    }
}

fn main() -> ExitCode {
    let chore = Cli::parse().chore;
    if cfg!(debug_assertions) && chore.is_timing() {
        return told(released());
    }
    told(done(chore))
}

/// Runs the same chore by a program that is built as the command line is for its users. What these chores time they time in one thread, as they say: a fit would use several.
fn released() -> Result<()> {
    let mut cargo = process::cargo(&["run", "--quiet", "--release", "--package", "xtask", "--"]);
    process::run(cargo.args(std::env::args_os().skip(1)).env("RAYON_NUM_THREADS", "1"))
}

fn done(chore: Chore) -> Result<()> {
    match chore {
        Chore::Test => test::run(),
        Chore::Judge => test::judge(),
        Chore::Evaluate { names } => evaluate::run(&names),
        Chore::Bench { names, repeat } => bench::run(&names, repeat),
        Chore::Growth { repeat } => growth::run(repeat),
        Chore::Pictures => pictures::run(),
        Chore::Table1 { repeat, write } => table1::run(repeat, write),
        Chore::Fuzz { seconds } => fuzz::run(seconds),
        Chore::Generate { check } => generate::run(check),
        Chore::Layers => layers::run().map(|note| println!("{note}")),
        Chore::JudgeRoads { files, self_test } => judge_roads::run(&files, self_test),
        Chore::JudgeWeb { release } => test::judge_web(if release { web::Kind::Release } else { web::Kind::Quick }),
        Chore::JudgeWindow => test::judge_window(),
        Chore::Session { on_screen, strokes } => session::run(on_screen, strokes),
        Chore::Web { quick, serve, port, toolchain } => {
            let kind = if quick { web::Kind::Quick } else { web::Kind::Release };
            web::run(kind, toolchain, serve.then_some(port))
        }
        Chore::PeakMemory { file, name } => bench::peak_memory(&file, &name),
    }
}

fn told(outcome: Result<()>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}
