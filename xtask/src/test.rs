//! The one test command.

use anyhow::{Result, bail};

use crate::process::{cargo, run as run_command};
use crate::steps::{Outcome, Steps};
use crate::{
    evaluate, generate, judge_roads, judge_web, judge_window, judges, layers, process, rectilinear, tools, tree, web,
};

/// Runs everything that can tell whether the project is sound.
pub(crate) fn run() -> Result<()> {
    let mut steps = Steps::default();
    steps.step("toolchain", || tools::components().map(Outcome::Passed));
    steps.step("format", || command(&["fmt", "--all", "--check"], "every file is formatted"));
    steps.step("lints", || {
        command(
            &["clippy", "--quiet", "--workspace", "--all-targets", "--", "--deny", "warnings"],
            "clippy and rustc warn of nothing",
        )
    });
    steps.step("lints of the page", page_lints);
    steps.step("bans in the cores", core_bans);
    steps.step("graphics", || tools::graphics().map(Outcome::Passed));
    steps.step("tests", tests);
    steps.step("documentation", || {
        let mut doc = cargo(&["doc", "--quiet", "--workspace", "--no-deps"]);
        run_command(doc.env("RUSTDOCFLAGS", "--deny warnings"))?;
        Ok(Outcome::Passed("every link leads somewhere".into()))
    });
    steps.step("layers", || layers::run().map(Outcome::Passed));
    steps.step("references", || {
        generate::run(true)?;
        Ok(Outcome::Passed("docs/ says what the program does".into()))
    });
    add_judges(&mut steps);
    evaluate::add_steps(&mut steps, &[]);
    rectilinear::add_step(&mut steps);
    steps.finish()
}

/// The judges alone.
pub(crate) fn judge() -> Result<()> {
    let mut steps = Steps::default();
    add_judges(&mut steps);
    steps.finish()
}

fn add_judges(steps: &mut Steps) {
    steps.step("command line", command_line);
    steps.step("judges' tools", || {
        tools::python().map(|python| Outcome::Passed(format!("{} is ready", python.display())))
    });
    steps.step("judge: kernel", judges::kernel);
    steps.step("judge: DXF", judges::dxf);
    steps.step("judge: SVG", judges::svg);
    steps.step("judge: glTF", judges::gltf);
    steps.step("judge: page", judges::page);
    steps.step("judges of roads", judge_roads::self_test);
    steps.step("judge: roads", judge_roads::examples);
    steps.step("judge: web", || judge_web::step(web::Kind::Quick));
    steps.step("judge: window", judge_window::step);
}

/// The desktop's window alone.
pub(crate) fn judge_window() -> Result<()> {
    let mut steps = Steps::default();
    steps.step("command line", command_line);
    steps.step("judge: window", judge_window::step);
    steps.finish()
}

/// The page of the application alone.
pub(crate) fn judge_web(kind: web::Kind) -> Result<()> {
    let mut steps = Steps::default();
    steps.step("command line", command_line);
    steps.step("judge: web", || judge_web::step(kind));
    steps.finish()
}

fn command_line() -> Result<Outcome> {
    process::build(&["fairpath"])?;
    Ok(Outcome::Passed("the command line is built".into()))
}

fn command(args: &[&str], note: &str) -> Result<Outcome> {
    run_command(&mut cargo(args))?;
    Ok(Outcome::Passed(note.to_owned()))
}

/// The lints of what only the browser's build has.
fn page_lints() -> Result<Outcome> {
    Ok(if web::lint()? {
        Outcome::Passed("clippy and rustc warn of nothing in the browser's build either".into())
    } else {
        Outcome::Skipped("this compiler has no standard library for the browser's machine".into())
    })
}

/// The cores read no clock and no file, start no thread, and take no platform's mathematics.
fn core_bans() -> Result<Outcome> {
    let target = tree::scratch("bans")?;
    let mut clippy = cargo(&["clippy", "--quiet", "--lib"]);
    let cores = ["fairpath-curve", "fairpath-fit", "fairpath-shape", "fairpath-drive"];
    clippy.args(cores.map(|core| format!("--package={core}")));
    // A target folder of its own: cargo does not always notice that another configuration asks other questions.
    clippy.arg("--target-dir").arg(target).args(["--", "--allow", "clippy::all", "--allow", "warnings"]);
    // A hash table may be looked up but not walked: its order differs from run to run.
    for ban in ["clippy::disallowed_methods", "clippy::disallowed_types", "clippy::iter_over_hash_type"] {
        clippy.args(["--deny", ban]);
    }
    run_command(clippy.env("CLIPPY_CONF_DIR", tree::root().join("xtask/judges/core")))?;
    Ok(Outcome::Passed("no clock, file, thread, hash order or platform mathematics in the cores".into()))
}

/// All tests and documentation examples.
fn tests() -> Result<Outcome> {
    let (mut passed, mut ignored) = (0, 0);
    let mut test = cargo(&["test", "--workspace", "--no-fail-fast"]);
    process::watch(&mut test, |line| {
        if let Some(counts) = line.strip_prefix("test result: ") {
            passed += count(counts, "passed");
            ignored += count(counts, "ignored");
        }
    })?;
    if passed == 0 {
        bail!("no test ran");
    }
    Ok(Outcome::Passed(format!("{passed} tests passed, {ignored} ignored")))
}

/// The number before a word, in a line such as `ok. 3 passed; 0 failed; 1 ignored; …`.
fn count(line: &str, word: &str) -> usize {
    let words: Vec<&str> = line.split([' ', ';']).filter(|word| !word.is_empty()).collect();
    words.windows(2).find(|pair| pair[1] == word).and_then(|pair| pair[0].parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn counts_are_read_from_the_harness_line() {
        let line = "ok. 31 passed; 0 failed; 2 ignored; 0 measured; 0 filtered out; finished in 0.01s";
        assert_eq!([count(line, "passed"), count(line, "ignored"), count(line, "rows")], [31, 2, 0]);
    }
}
