//! A progress bar for work longer than a second, on standard error, only on a terminal.

use std::io::{IsTerminal, stderr};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

const PATIENCE: Duration = Duration::from_secs(1);

/// Counts finished strokes; shown only once the work has taken a second.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    stop: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    pub(crate) fn start(strokes: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(strokes as u64), ProgressDrawTarget::hidden());
        if !stderr().is_terminal() {
            return Self { bar, stop: None };
        }
        let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} strokes, {elapsed}, {eta} left");
        if let Ok(style) = style {
            bar.set_style(style);
        }
        let (sender, receiver) = channel();
        let shown = bar.clone();
        let waiter = thread::spawn(move || {
            if receiver.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(Duration::from_millis(200));
            }
        });
        Self { bar, stop: Some((sender, waiter)) }
    }

    pub(crate) fn one_done(&self) {
        self.bar.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, waiter)) = self.stop.take() {
            drop(sender);
            let _ = waiter.join();
        }
        self.bar.finish_and_clear();
    }
}
