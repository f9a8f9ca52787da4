//! Long work in a worker of the browser: jobs go out as text, answers come back. A worker that dies of a job is replaced, and the jobs that
//! waited behind it are given to the next.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::{Rc, Weak};

use eframe::egui;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, MessageEvent, Worker, WorkerOptions, WorkerType};

use super::{said, trouble};

/// Most times of jobs that are remembered.
const MOST_TIMES: usize = 4096;

thread_local! {
    static URL: RefCell<String> = RefCell::default();
    static TIMES_MS: RefCell<Vec<f64>> = RefCell::default();
}

/// Where the worker's script lies.
pub(super) fn set_url(url: String) {
    URL.set(url);
}

/// How long each job took that was answered since [`forget_times`], milliseconds, as the worker itself timed it: from the job's text to
/// the answer's, without the way between page and worker.
pub(super) fn times_ms() -> Vec<f64> {
    TIMES_MS.with_borrow(Vec::clone)
}

/// Begins to time jobs anew.
pub(super) fn forget_times() {
    TIMES_MS.take();
}

fn note_time(ms: f64) {
    TIMES_MS.with_borrow_mut(|times| {
        if times.len() < MOST_TIMES {
            times.push(ms);
        }
    });
}

/// Does one job; the worker's script calls this.
#[must_use]
#[wasm_bindgen]
pub fn run_job(job: &str) -> String {
    trouble::report_panics();
    fairpath_sketch::run_encoded_job(job)
}

/// What becomes of a job: its answer, or of what the worker died.
pub type JobOutcome = Result<String, String>;

/// The page's side of the worker. Jobs are done one at a time in the order in which they were sent.
///
/// Dropping it ends the worker; what was not answered then never is.
#[derive(Clone)]
pub struct JobWorker {
    shared: Rc<Shared>,
}

struct Shared {
    ctx: egui::Context,
    on_answer: Box<dyn Fn(u64, JobOutcome)>,
    /// What was sent and not answered yet; the first one is being done.
    waiting: RefCell<VecDeque<(u64, String)>>,
    worker: RefCell<Option<Line>>,
    /// How many workers were made, so that a late word of an old one is known for such.
    generation: Cell<u32>,
}

/// A worker with those who listen to it.
struct Line {
    worker: Worker,
    _on_message: Closure<dyn FnMut(MessageEvent)>,
    _on_error: Closure<dyn FnMut(ErrorEvent)>,
}

impl Drop for Line {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

/// What the worker says.
enum Word {
    /// The answer to the job with this number, and how long that took, milliseconds.
    Answer(u64, String, f64),
    /// It died of the job that it did, or before it did any.
    Died(String),
}

impl JobWorker {
    /// A worker that begins to load at once, so that it is ready for the first job. `on_answer` is called from the browser's loop, never
    /// while a job is being sent; after it the interface draws a frame.
    #[must_use]
    pub fn new(ctx: &egui::Context, on_answer: impl Fn(u64, JobOutcome) + 'static) -> Self {
        let shared = Rc::new(Shared {
            ctx: ctx.clone(),
            on_answer: Box::new(on_answer),
            waiting: RefCell::default(),
            worker: RefCell::default(),
            generation: Cell::new(0),
        });
        // Where no worker can be had, the first job says so.
        let _ = shared.engage();
        Self { shared }
    }

    /// Sends a job; its outcome comes under the same `id`.
    pub fn send(&self, id: u64, job: String) {
        self.shared.waiting.borrow_mut().push_back((id, job));
        if let Err(reason) = self.shared.hand_over(1) {
            // Told later, since the caller may hold what the outcome is put into.
            let shared = Rc::clone(&self.shared);
            wasm_bindgen_futures::spawn_local(async move { shared.fail_all(&reason) });
        }
    }

    /// Forgets all jobs that were sent, the one that is being done too: their outcomes never come.
    pub fn forget_all(&self) {
        if !self.shared.waiting.take().is_empty() {
            // A worker cannot be interrupted, only ended.
            self.shared.worker.take();
            let _ = self.shared.engage();
        }
    }
}

impl Shared {
    /// Gives the last `count` of the waiting jobs to the worker; all of them if it is a new one.
    fn hand_over(self: &Rc<Self>, count: usize) -> Result<(), String> {
        let fresh = self.engage()?;
        let waiting = self.waiting.borrow();
        let count = if fresh { waiting.len() } else { count };
        for (id, job) in waiting.iter().skip(waiting.len() - count) {
            self.post(&js_sys::Array::of2(&id.to_string().into(), &job.as_str().into()))?;
        }
        Ok(())
    }

    /// Makes sure that there is a worker; true if it is a new one.
    fn engage(self: &Rc<Self>) -> Result<bool, String> {
        if self.worker.borrow().is_some() {
            return Ok(false);
        }
        self.generation.set(self.generation.get() + 1);
        let line = self.connect(self.generation.get()).map_err(|error| said(&error))?;
        *self.worker.borrow_mut() = Some(line);
        // The program as the page compiled it: nothing is loaded twice.
        self.post(&wasm_bindgen::module())?;
        Ok(true)
    }

    fn connect(self: &Rc<Self>, generation: u32) -> Result<Line, JsValue> {
        let options = WorkerOptions::new();
        options.set_type(WorkerType::Module);
        let worker = Worker::new_with_options(&URL.with_borrow(String::clone), &options)?;
        let shared = Rc::downgrade(self);
        let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
            if let Some(word) = word(&event.data()) {
                hear(&shared, generation, word);
            }
        });
        let shared = Rc::downgrade(self);
        let on_error = Closure::<dyn FnMut(ErrorEvent)>::new(move |event: ErrorEvent| {
            event.prevent_default();
            // Browsers say nothing where the script itself cannot be loaded.
            let message = js_sys::Reflect::get(&event, &"message".into()).ok().and_then(|text| text.as_string());
            hear(&shared, generation, Word::Died(message.unwrap_or_else(|| "its script cannot be loaded".into())));
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        Ok(Line { worker, _on_message: on_message, _on_error: on_error })
    }

    fn post(&self, message: &JsValue) -> Result<(), String> {
        match &*self.worker.borrow() {
            Some(line) => line.worker.post_message(message).map_err(|error| said(&error)),
            None => Err("there is no worker".into()),
        }
    }

    fn answered(&self, id: u64, answer: String) {
        self.waiting.borrow_mut().retain(|(waiting, _)| *waiting != id);
        self.tell(id, Ok(answer));
    }

    /// The first of the waiting jobs is taken to be the one that killed it: it was being done.
    fn died(self: &Rc<Self>, reason: &str) {
        self.worker.take();
        let killer = self.waiting.borrow_mut().pop_front();
        if let Some((id, _)) = killer {
            self.tell(id, Err(reason.to_owned()));
        }
        if !self.waiting.borrow().is_empty()
            && let Err(reason) = self.hand_over(0)
        {
            self.fail_all(&reason);
        }
    }

    fn fail_all(&self, reason: &str) {
        for (id, _) in self.waiting.take() {
            self.tell(id, Err(reason.to_owned()));
        }
    }

    fn tell(&self, id: u64, outcome: JobOutcome) {
        (self.on_answer)(id, outcome);
        self.ctx.request_repaint();
    }
}

fn hear(shared: &Weak<Shared>, generation: u32, word: Word) {
    let Some(shared) = shared.upgrade() else { return };
    if shared.generation.get() != generation || shared.worker.borrow().is_none() {
        return;
    }
    match word {
        Word::Answer(id, answer, ms) => {
            note_time(ms);
            shared.answered(id, answer);
        }
        Word::Died(reason) => shared.died(&reason),
    }
}

/// Reads `[id, answer, null, ms]` or `[null, null, reason]`, as the worker's script writes them.
fn word(data: &JsValue) -> Option<Word> {
    let parts: &js_sys::Array = data.dyn_ref()?;
    if let Some(reason) = parts.get(2).as_string() {
        return Some(Word::Died(reason));
    }
    Some(Word::Answer(parts.get(0).as_string()?.parse().ok()?, parts.get(1).as_string()?, parts.get(3).as_f64()?))
}
