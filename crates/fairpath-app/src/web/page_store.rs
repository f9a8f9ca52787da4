//! What survives a crash of the page, or its being closed: the drawing, in the browser's database.

use std::cell::RefCell;
use std::mem;
use std::rc::Rc;

use eframe::egui;
use wasm_bindgen_futures::spawn_local;

use super::storage::{self, StorageError};
use crate::store::Store;

/// The key of the drawing.
const DRAWING: &str = "drawing";

/// The key of a drawing that could not be read.
const DAMAGED: &str = "drawing-damaged";

/// The browser's database as the application's store.
pub struct PageStore {
    ctx: egui::Context,
    heard: Rc<RefCell<Heard>>,
}

/// What came back and nobody has asked for yet.
#[derive(Default)]
struct Heard {
    kept: Option<Vec<u8>>,
    troubles: Vec<String>,
}

impl PageStore {
    /// What comes back asks `ctx` for a new picture.
    #[must_use]
    pub fn new(ctx: &egui::Context) -> Self {
        Self { ctx: ctx.clone(), heard: Rc::default() }
    }

    /// Does something with the database and hears what became of it.
    fn then(&self, deed: impl Future<Output = Result<Option<String>, StorageError>> + 'static) {
        let (heard, ctx) = (Rc::clone(&self.heard), self.ctx.clone());
        spawn_local(async move {
            match deed.await {
                Ok(None) => return,
                Ok(Some(text)) => heard.borrow_mut().kept = Some(text.into_bytes()),
                Err(error) => heard.borrow_mut().troubles.push(error.to_string()),
            }
            ctx.request_repaint();
        });
    }
}

impl Store for PageStore {
    fn keep(&mut self, text: Box<dyn FnOnce() -> Result<Vec<u8>, String> + Send>) {
        match text().and_then(|bytes| String::from_utf8(bytes).map_err(|error| error.to_string())) {
            Ok(text) => self.then(async move { storage::save(DRAWING, &text).await.map(|()| None) }),
            Err(text) => self.heard.borrow_mut().troubles.push(text),
        }
    }

    fn ask(&mut self) {
        self.then(storage::load(DRAWING));
    }

    fn kept(&mut self) -> Option<Vec<u8>> {
        mem::take(&mut self.heard.borrow_mut().kept)
    }

    fn set_aside(&mut self, damaged: Vec<u8>) {
        let text = String::from_utf8_lossy(&damaged).into_owned();
        self.then(async move { storage::save(DAMAGED, &text).await.map(|()| None) });
    }

    fn trouble(&mut self) -> Option<String> {
        self.heard.borrow_mut().troubles.pop()
    }
}
