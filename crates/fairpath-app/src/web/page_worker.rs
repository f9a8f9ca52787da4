//! The application's worker, as the browser has it: jobs and answers as JSON between the page and a worker of its own.

use std::cell::RefCell;
use std::mem;
use std::rc::Rc;

use eframe::egui;
use fairpath_sketch::{Answer, Job, Ticket, Trouble};

use super::{JobOutcome, JobWorker};
use crate::worker::Worker;

/// Answers that the application has not yet taken.
type Answers = Rc<RefCell<Vec<(Ticket, Answer)>>>;

/// A worker of the browser.
pub struct PageWorker {
    jobs: JobWorker,
    answers: Answers,
}

impl PageWorker {
    /// Begins to load the worker; each answer asks `ctx` for a new picture.
    #[must_use]
    pub fn new(ctx: &egui::Context) -> Self {
        let answers = Answers::default();
        let jobs = JobWorker::new(ctx, {
            let answers = Rc::clone(&answers);
            move |id, outcome| answers.borrow_mut().push((Ticket(id), read(outcome)))
        });
        Self { jobs, answers }
    }
}

impl Worker for PageWorker {
    fn submit(&mut self, ticket: Ticket, job: Job) {
        match serde_json::to_string(&job) {
            Ok(job) => self.jobs.send(ticket.0, job),
            Err(error) => {
                let text = format!("the job cannot be written: {error}");
                self.answers.borrow_mut().push((ticket, failed("bad-job", text)));
            }
        }
    }

    fn answers(&mut self) -> Vec<(Ticket, Answer)> {
        mem::take(&mut self.answers.borrow_mut())
    }
}

fn read(outcome: JobOutcome) -> Answer {
    match outcome {
        Ok(answer) => serde_json::from_str(&answer)
            .unwrap_or_else(|error| failed("bad-answer", format!("the worker's answer is none: {error}"))),
        Err(reason) => failed(
            "worker-died",
            format!("This curve could not be computed ({reason}). Undo it or draw it again; everything else goes on."),
        ),
    }
}

fn failed(code: &str, text: String) -> Answer {
    Answer::Failed(Trouble { code: code.into(), text })
}
