//! A run of named steps: each under its heading and timed, none stopped by another's failure, all counted at the end.

use std::time::Instant;

use anyhow::{Result, bail};

/// How a step ended, when it did not fail.
pub(crate) enum Outcome {
    /// It ran and found nothing wrong; the note says what it saw.
    Passed(String),
    /// It ran and nothing became worse, but the named goals are not reached.
    Short(String),
    /// It did not run, for this reason.
    Skipped(String),
}

enum Verdict {
    Passed,
    Short,
    Failed,
    Skipped,
}

impl Verdict {
    fn word(&self) -> &'static str {
        match self {
            Self::Passed => "ok",
            Self::Short => "SHORT",
            Self::Failed => "FAILED",
            Self::Skipped => "SKIPPED",
        }
    }
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
            Ok(Outcome::Short(goals)) => (Verdict::Short, goals),
            Ok(Outcome::Skipped(reason)) => (Verdict::Skipped, reason),
            Err(error) => (Verdict::Failed, format!("{error:#}")),
        };
        let seconds = begun.elapsed().as_secs_f64();
        println!("---- {} in {seconds:.1} s: {note}", verdict.word());
        self.rows.push(Row { name, verdict, note, seconds });
    }

    /// Prints the summary; an error if a step failed, or if none ran at all.
    pub(crate) fn finish(self) -> Result<()> {
        println!("\n==== Summary");
        for row in &self.rows {
            let note = row.note.lines().next().unwrap_or_default();
            println!("{:>8} {:>7.1} s  {:<34} {note}", row.verdict.word(), row.seconds, row.name);
        }
        let count = |f: fn(&Verdict) -> bool| self.rows.iter().filter(|row| f(&row.verdict)).count();
        let passed = count(|v| matches!(v, Verdict::Passed));
        let short = count(|v| matches!(v, Verdict::Short));
        let failed = count(|v| matches!(v, Verdict::Failed));
        let skipped = count(|v| matches!(v, Verdict::Skipped));
        if skipped > 0 {
            println!("\n{skipped} SKIPPED: this run proves less than it could");
        }
        if short > 0 {
            println!("\n{short} SHORT OF GOAL: no worse than what is held, but not what is wanted");
        }
        println!("\n{passed} passed, {short} short of goal, {failed} failed, in {:.0} s", self.seconds());
        // At the very end, where someone who sees nothing but that finds them.
        for row in self.rows.iter().filter(|row| matches!(row.verdict, Verdict::Failed)) {
            println!("\nFAILED: {}\n{}", row.name, row.note);
        }
        if failed > 0 {
            bail!("{failed} of {} steps failed", self.rows.len());
        }
        if passed + short == 0 {
            bail!("nothing ran");
        }
        Ok(())
    }

    fn seconds(&self) -> f64 {
        self.rows.iter().map(|row| row.seconds).sum()
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
    fn a_step_short_of_its_goal_does_not_fail_the_run() {
        let mut steps = Steps::default();
        steps.step("near", || Ok(Outcome::Short("2, the goal is 1".into())));
        assert!(steps.finish().is_ok());
    }

    #[test]
    fn passed_steps_pass() {
        let mut steps = Steps::default();
        steps.step("good", || Ok(Outcome::Passed("seen".into())));
        steps.step("absent", || Ok(Outcome::Skipped("not here".into())));
        assert!(steps.finish().is_ok());
    }
}
