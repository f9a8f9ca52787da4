//! The desktop's program while it runs: started on a screen, ended as crashes and as window managers do.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

use super::{Hands, Screen, until};

/// How long a window may take to appear, and to go.
const PATIENCE: Duration = Duration::from_secs(60);

/// The class of the window.
const CLASS: &str = "fairpath";

/// The program with hands on its window. It is ended with its value.
pub(crate) struct Program {
    child: Child,
    pub(crate) hands: Hands,
    /// From the start until there was something in the window, milliseconds.
    pub(crate) ready_ms: f64,
    log: PathBuf,
}

impl Program {
    /// Starts a program with arguments on a screen and waits until its window shows something. What it says goes to `log`.
    pub(crate) fn start(exe: &Path, screen: &Screen, arguments: &[&Path], log: &Path) -> Result<Self> {
        let says = File::create(log).with_context(|| format!("cannot write {}", log.display()))?;
        let mut command = Command::new(exe);
        screen.dress(&mut command);
        command.args(arguments).stdin(Stdio::null()).stdout(says.try_clone()?).stderr(says);
        let begun = Instant::now();
        let mut child = command.spawn().with_context(|| format!("cannot start {}", exe.display()))?;
        let seen = until(PATIENCE, "a window with something in it", || {
            if let Some(ended) = child.try_wait()? {
                bail!("it ended with {ended}");
            }
            let hands = Hands::on(screen, CLASS)?;
            Ok(match hands {
                Some(hands) if !hands.picture()?.is_blank() => Some(hands),
                _ => None,
            })
        });
        match seen {
            Ok(hands) => Ok(Self { child, hands, ready_ms: begun.elapsed().as_secs_f64() * 1e3, log: log.into() }),
            Err(error) => {
                // It may have ended already.
                let _ = child.kill();
                let _ = child.wait();
                Err(error.context(format!("{}; it said: {}", exe.display(), said(log))))
            }
        }
    }

    /// Ends it at once, as a crash does.
    pub(crate) fn crash(&mut self) -> Result<()> {
        self.child.kill().context("cannot end the window's program")?;
        self.child.wait().context("cannot wait for its end")?;
        Ok(())
    }

    /// Has its window closed, and waits until it has ended.
    pub(crate) fn close(mut self) -> Result<ExitStatus> {
        self.hands.ask_to_close()?;
        until(PATIENCE, "the end of the program whose window was closed", || Ok(self.child.try_wait()?))
            .with_context(|| format!("it said: {}", said(&self.log)))
    }

    /// The most memory that it ever had, kB.
    pub(crate) fn peak_kb(&self) -> Result<f64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id()))
            .context("peak memory is read from /proc, as on Linux")?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kb = line.and_then(|rest| rest.split_whitespace().next()).context("/proc has no VmHWM")?;
        kb.parse().context("/proc has a VmHWM that is no number")
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn said(log: &Path) -> String {
    std::fs::read_to_string(log).map_or_else(|_| "nothing".into(), |text| text.trim().to_owned())
}
