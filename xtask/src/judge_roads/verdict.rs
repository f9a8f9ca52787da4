//! What a judge says of one file, read from what its program printed.

use std::time::Duration;

use anyhow::{Context, Result, bail};

use crate::process::Ran;

/// After so long a judge is given up.
pub(super) const PATIENCE: Duration = Duration::from_secs(900);

/// What a judge says of one file; it passes what it finds no fault with.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Verdict {
    pub(super) faults: Vec<String>,
    pub(super) warnings: Vec<String>,
    /// What it saw, in one line.
    pub(super) note: String,
}

impl Verdict {
    /// Reads what a script of `xtask/judges/roads/` printed: lines of `fault:` and `warning:`, and one of `note:`, which a script that broke
    /// does not come to. An error unless the exit code agrees, since then there is no verdict.
    pub(super) fn of_script(ran: &Ran) -> Result<Self> {
        let lines = |kind: &str| -> Vec<String> {
            ran.text.lines().filter_map(|line| line.strip_prefix(kind)).map(str::to_owned).collect()
        };
        let (faults, warnings) = (lines("fault: "), lines("warning: "));
        let note = lines("note: ").pop().with_context(|| format!("the judge broke: {}", tail(&ran.text)))?;
        let agrees = ran.code == Some(i32::from(!faults.is_empty()));
        if !agrees {
            bail!("the judge ended with {:?} and told {} faults: {}", ran.code, faults.len(), tail(&ran.text));
        }
        Ok(Self { faults, warnings, note })
    }
}

/// The last of what was printed, where what broke a program is told.
fn tail(text: &str) -> String {
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    lines[lines.len().saturating_sub(4)..].join(" | ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ran(code: Option<i32>, text: &str) -> Ran {
        Ran { code, text: text.into() }
    }

    #[test]
    fn faults_and_warnings_are_told_apart() {
        let text = "chatter\nfault: a gap\nwarning: a bend\nnote: 2 roads\n";
        let verdict = Verdict::of_script(&ran(Some(1), text)).unwrap();
        assert_eq!(verdict.faults, ["a gap"]);
        assert_eq!(verdict.warnings, ["a bend"]);
        assert_eq!(verdict.note, "2 roads");
    }

    #[test]
    fn a_script_that_broke_gives_no_verdict() {
        // Killed, ended before its note, and at odds with itself.
        assert!(Verdict::of_script(&ran(None, "note: 2 roads\n")).is_err());
        assert!(Verdict::of_script(&ran(Some(1), "Traceback\nKeyError: 'x'\n")).is_err());
        assert!(Verdict::of_script(&ran(Some(0), "fault: a gap\nnote: 2 roads\n")).is_err());
        assert!(Verdict::of_script(&ran(Some(1), "note: 2 roads\n")).is_err());
        assert!(Verdict::of_script(&ran(Some(0), "")).is_err());
    }
}
