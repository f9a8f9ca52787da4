//! Who does the jobs: a thread on the desktop, a worker of the browser on the page, the caller itself in tests.

use fairpath_sketch::{Answer, Job, Ticket, run};
use std::time::Duration;

/// Someone who does one job at a time, away from the interface.
pub trait Worker {
    /// Begins a job. The worker asks for a new picture when it is done.
    fn submit(&mut self, ticket: Ticket, job: Job);

    /// The answers that came since the last call.
    fn answers(&mut self) -> Vec<(Ticket, Answer)>;

    /// As [`answers`](Self::answers), but if there is none yet, one is waited for that long where that is possible; in a browser it is not.
    fn answers_within(&mut self, _moment: Duration) -> Vec<(Ticket, Answer)> {
        self.answers()
    }
}

/// Does each job at once, where it is given: for tests, which shall not wait for anyone.
#[derive(Debug, Default)]
pub struct InlineWorker {
    answers: Vec<(Ticket, Answer)>,
}

impl Worker for InlineWorker {
    fn submit(&mut self, ticket: Ticket, job: Job) {
        self.answers.push((ticket, run(&job)));
    }

    fn answers(&mut self) -> Vec<(Ticket, Answer)> {
        std::mem::take(&mut self.answers)
    }
}

/// A thread.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) struct ThreadWorker {
    jobs: std::sync::mpsc::Sender<(Ticket, Job)>,
    answers: std::sync::mpsc::Receiver<(Ticket, Answer)>,
}

#[cfg(not(target_arch = "wasm32"))]
impl ThreadWorker {
    /// Starts the thread; it ends with the worker.
    pub(crate) fn start(ctx: eframe::egui::Context) -> std::io::Result<Self> {
        let (jobs, inbox) = std::sync::mpsc::channel::<(Ticket, Job)>();
        let (outbox, answers) = std::sync::mpsc::channel();
        std::thread::Builder::new().name("fitter".into()).spawn(move || {
            for (ticket, job) in inbox {
                if outbox.send((ticket, run(&job))).is_err() {
                    break;
                }
                ctx.request_repaint();
            }
        })?;
        Ok(Self { jobs, answers })
    }
}

#[cfg(not(target_arch = "wasm32"))]
impl Worker for ThreadWorker {
    fn submit(&mut self, ticket: Ticket, job: Job) {
        // The thread lives as long as its inbox does.
        let _ = self.jobs.send((ticket, job));
    }

    fn answers(&mut self) -> Vec<(Ticket, Answer)> {
        self.answers.try_iter().collect()
    }

    fn answers_within(&mut self, moment: Duration) -> Vec<(Ticket, Answer)> {
        self.answers.recv_timeout(moment).into_iter().chain(self.answers.try_iter()).collect()
    }
}
