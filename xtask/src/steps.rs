//! A run of named steps: each under its heading and timed, none stopped by another's failure, all counted at the end.

use std::time::Instant;

use anyhow::{Result, bail};

/// How a step ended, when it did not fail.
pub(crate) enum Outcome {
    /// It ran and found nothing wrong; the note says what it saw.
    Passed(String),
    /// It did not run, for this reason.
    Skipped(String),
}

enum Verdict {
    Passed,
    Failed,
    Skipped,
}

struct Row {
    name: String,
    verdict: Verdict,
    note: String,
    seconds: f64,
}

/// The steps so far.
#[derive(Default)]
pub(crate) struct Steps {
    rows: Vec<Row>,
}

impl Steps {
    /// Runs one step.
    pub(crate) fn step(&mut self, name: impl Into<String>, body: impl FnOnce() -> Result<Outcome>) {
        let name = name.into();
        println!("\n==== {name}");
        let begun = Instant::now();
        let (verdict, note) = match body() {
            Ok(Outcome::Passed(note)) => (Verdict::Passed, note),
            Ok(Outcome::Skipped(reason)) => (Verdict::Skipped, reason),
            Err(error) => (Verdict::Failed, format!("{error:#}")),
        };
        let seconds = begun.elapsed().as_secs_f64();
        let word = match verdict {
            Verdict::Passed => "ok",
            Verdict::Failed => "FAILED",
            Verdict::Skipped => "SKIPPED",
        };
        println!("---- {word} in {seconds:.1} s: {note}");
        self.rows.push(Row { name, verdict, note, seconds });
    }

    /// Prints the summary; an error if a step failed, or if none ran at all.
    pub(crate) fn finish(self) -> Result<()> {
        println!("\n==== Summary");
        for row in &self.rows {
            let word = match row.verdict {
                Verdict::Passed => "ok",
                Verdict::Failed => "FAILED",
                Verdict::Skipped => "SKIPPED",
            };
            let note = row.note.lines().next().unwrap_or_default();
            println!("{word:>8} {:>7.1} s  {:<34} {note}", row.seconds, row.name);
        }
        let count = |f: fn(&Verdict) -> bool| self.rows.iter().filter(|row| f(&row.verdict)).count();
        let passed = count(|v| matches!(v, Verdict::Passed));
        let failed = count(|v| matches!(v, Verdict::Failed));
        let skipped = count(|v| matches!(v, Verdict::Skipped));
        if skipped > 0 {
            println!("\n{skipped} SKIPPED: this run proves less than it could");
        }
        println!("\n{passed} passed, {failed} failed");
        if failed > 0 {
            bail!("{failed} of {} steps failed", self.rows.len());
        }
        if passed == 0 {
            bail!("nothing ran");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_step_fails_the_run_and_does_not_stop_the_next() {
        let mut steps = Steps::default();
        let mut reached = false;
        steps.step("bad", || bail!("no"));
        steps.step("good", || {
            reached = true;
            Ok(Outcome::Passed(String::new()))
        });
        assert!(reached);
        assert!(steps.finish().is_err());
    }

    #[test]
    fn a_run_of_skipped_steps_only_fails() {
        let mut steps = Steps::default();
        steps.step("absent", || Ok(Outcome::Skipped("not here".into())));
        assert!(steps.finish().is_err());
        assert!(Steps::default().finish().is_err());
    }

    #[test]
    fn passed_steps_pass() {
        let mut steps = Steps::default();
        steps.step("good", || Ok(Outcome::Passed("seen".into())));
        steps.step("absent", || Ok(Outcome::Skipped("not here".into())));
        assert!(steps.finish().is_ok());
    }
}
