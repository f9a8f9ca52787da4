//! The drawing as a document: opened, saved, kept against crashes.

use crate::app::App;
use crate::files::{SavedDocument, Saving};
use eframe::egui::{Context, ViewportCommand};
use fairpath_sketch::{Drawing, decode_drawing, encode_drawing};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A change is kept so long after it was made, seconds of the interface's clock.
const KEEP_AFTER_S: f64 = 5.0;

/// What the application knows of its documents. Undo leads from one that was opened to the one before, so each keeps its file.
#[derive(Debug, Default)]
pub(crate) struct Document {
    files: BTreeMap<u64, DrawingFile>,
    /// What the window was told last.
    title: String,
    /// The version that is kept against crashes, and since when a newer one waits.
    kept: u64,
    waiting: Option<f64>,
}

/// The file of a drawing, or what it would be called.
#[derive(Clone, Debug)]
struct DrawingFile {
    /// Its name without the extension.
    name: String,
    /// Where it lies, once it does; a browser does not tell.
    path: Option<PathBuf>,
    /// The state of the drawing that it holds, a revision of the history.
    saved: u64,
}

impl Default for DrawingFile {
    fn default() -> Self {
        Self { name: "drawing".into(), path: None, saved: 0 }
    }
}

impl App {
    /// What the drawing's file is called, without its extension.
    pub(crate) fn document_name(&self) -> String {
        self.drawing_file().name
    }

    fn drawing_file(&self) -> DrawingFile {
        self.document.files.get(&self.session.drawing().document).cloned().unwrap_or_default()
    }

    /// Takes note that the drawing's own file was written.
    pub(crate) fn note_saved(&mut self, name: &str, saved: SavedDocument) {
        let SavedDocument { document, path, revision } = saved;
        self.document.files.insert(document, DrawingFile { name: stem(name).into(), path, saved: revision });
    }

    /// Begins anew with another drawing, which cannot be undone; an empty one is seen with a point of the screen to a unit.
    pub fn open_drawing(&mut self, drawing: Drawing) {
        self.canvas.cancel(&mut self.session);
        self.session.begin_anew(drawing);
        self.view.reset();
        self.fit_view();
    }

    /// Opens the drawing of a file, from which undo leads back.
    pub(crate) fn open(&mut self, drawing: Drawing, name: &str, path: Option<PathBuf>) {
        self.canvas.cancel(&mut self.session);
        // A crash shall not take what was there; what was opened is in its file until it changes.
        self.keep_now();
        self.session.open(drawing);
        self.view.reset();
        self.fit_view();
        let history = self.session.history();
        let (version, revision) = (history.version(), history.revision());
        self.note_saved(name, SavedDocument { document: self.session.drawing().document, path, revision });
        (self.document.kept, self.document.waiting) = (version, None);
    }

    /// Begins a new drawing, from which undo leads back.
    pub(crate) fn begin_new(&mut self) {
        self.canvas.cancel(&mut self.session);
        self.keep_now();
        self.session.begin_new();
        self.view.reset();
    }

    /// Saves the drawing in its file, or if it has none yet, where a person chooses.
    pub(crate) fn save(&mut self, ctx: &Context) {
        self.save_to(ctx, self.drawing_file().path);
    }

    /// Saves the drawing where a person chooses.
    pub(crate) fn save_as(&mut self, ctx: &Context) {
        self.save_to(ctx, None);
    }

    fn save_to(&mut self, ctx: &Context, path: Option<PathBuf>) {
        let (document, revision) = (self.session.drawing().document, self.session.history().revision());
        match encode_drawing(self.session.drawing()) {
            Ok(bytes) => {
                let saving = Saving::Document(SavedDocument { document, path, revision });
                self.files.save(ctx, &format!("{}.json", self.document_name()), bytes, saving)
            }
            Err(error) => self.panels.say(error.to_string()),
        }
    }

    /// What the window's title is: the drawing's name, with a star while its file does not hold what is shown.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.document.title
    }

    /// Tells the window what it shows.
    pub(crate) fn set_title(&mut self, ctx: &Context) {
        let DrawingFile { name, saved, .. } = self.drawing_file();
        let changed = saved != self.session.history().revision();
        let title = format!("{name}{} – Fairpath", if changed { "*" } else { "" });
        if title != self.document.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.document.title = title;
        }
    }

    /// Keeps the drawing against crashes when it has changed, and takes what an earlier run kept.
    pub(crate) fn keep(&mut self, ctx: &Context) {
        if let Some(bytes) = self.store.kept() {
            match decode_drawing(&bytes, "the drawing that was kept") {
                Ok(drawing) if !drawing.curves().is_empty() => {
                    self.session.restore(drawing);
                    self.document.kept = self.session.history().version();
                    self.fit_view = true;
                    self.panels.hint = false;
                    self.panels.say("Your last drawing is here again; undo leads back to an empty one.");
                }
                Ok(_) => {}
                Err(error) => {
                    // The next change is kept in its place.
                    self.store.set_aside(bytes);
                    self.panels.say(format!("{error}. It is set aside."));
                }
            }
        }
        if let Some(text) = self.store.trouble() {
            self.panels.say(format!("This drawing is not kept against crashes. {text}"));
        }
        if !self.is_to_be_kept() {
            return;
        }
        let now = ctx.input(|i| i.time);
        let left = KEEP_AFTER_S - (now - *self.document.waiting.get_or_insert(now));
        // Encoding takes a moment that a stroke in hand should not feel.
        if left <= 0.0 && self.session.hand().is_none() {
            self.keep_now();
        } else {
            ctx.request_repaint_after_secs(left.max(0.2) as f32);
        }
    }

    fn is_to_be_kept(&self) -> bool {
        self.session.history().version() != self.document.kept && self.session.history().undoable().is_some()
    }

    /// Keeps the drawing against crashes, if it has changed since that was done last.
    pub fn keep_now(&mut self) {
        if self.is_to_be_kept() {
            let drawing = self.session.drawing().clone();
            self.store.keep(Box::new(move || encode_drawing(&drawing).map_err(|error| error.to_string())));
            self.document.kept = self.session.history().version();
            self.document.waiting = None;
        }
    }
}

/// A file's name without its extension.
pub(crate) fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}
