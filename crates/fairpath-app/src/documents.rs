//! The drawing as a document: opened, saved, imported, exported, kept against crashes.

use crate::app::App;
use crate::files::{FileEvent, Purpose};
use eframe::egui::Context;
use fairpath_fit::Warning;
use fairpath_io::{SplineFormat, WriteOptions, encode_splines};
use fairpath_sketch::{
    Background, Drawing, DrawingError, decode_drawing, encode_drawing, import, is_drawing, splines_of, strokes_of,
};
use std::sync::Arc;

/// A change is kept so long after it was made, seconds of the interface's clock.
const KEEP_AFTER_S: f64 = 5.0;

/// What the application knows of its document.
#[derive(Debug)]
pub(crate) struct Document {
    /// What its file is called.
    pub(crate) name: String,
    /// The version that is kept against crashes, and since when a newer one waits.
    kept: u64,
    waiting: Option<f64>,
}

impl Default for Document {
    fn default() -> Self {
        Self { name: "drawing".into(), kept: 0, waiting: None }
    }
}

impl App {
    /// Does what became of dialogs, and takes files that were dropped on the window.
    pub(crate) fn read_files(&mut self, ctx: &Context) {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        for file in dropped {
            let name = file.path().file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            self.take_dropped(ctx, name, file);
        }
        for event in self.files.events() {
            match event {
                FileEvent::Chosen { purpose, name, bytes } => self.take_file(purpose, &name, &bytes),
                FileEvent::Saved { name } => self.panels.say(format!("Saved {name}.")),
                FileEvent::Failed { text } => self.panels.say(text),
            }
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn take_dropped(&mut self, _ctx: &Context, name: String, file: eframe::egui::DroppedFileHandle) {
        self.files.dropped(match file.bytes() {
            Ok(bytes) => FileEvent::Chosen { purpose: Purpose::Import, name, bytes },
            Err(error) => FileEvent::Failed { text: format!("{name}: cannot be read: {error}") },
        });
    }

    #[cfg(target_arch = "wasm32")]
    fn take_dropped(&mut self, ctx: &Context, name: String, file: eframe::egui::DroppedFileHandle) {
        let (outbox, ctx) = (self.files.outbox(), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            let _ = outbox.send(match file.bytes_async().await {
                Ok(bytes) => FileEvent::Chosen { purpose: Purpose::Import, name, bytes },
                Err(error) => FileEvent::Failed { text: format!("{name}: cannot be read: {error}") },
            });
            ctx.request_repaint();
        });
    }

    /// Takes a file for what it was chosen for. A picture is always traced over.
    pub(crate) fn take_file(&mut self, purpose: Purpose, name: &str, bytes: &[u8]) {
        let taken = match purpose {
            _ if image::guess_format(bytes).is_ok() => self.trace(name, bytes),
            Purpose::Background => Err(format!("{name}: no picture that can be shown; choose a PNG, JPEG or WebP")),
            Purpose::Open if is_drawing(bytes) => decode_drawing(bytes, name).map_err(told).map(|drawing| {
                self.open(drawing, name);
            }),
            Purpose::Open | Purpose::Import => {
                import(bytes, name, self.session.neatening()).map_err(told).map(|(curves, left_out)| {
                    let mut told = format!("{} curves from {name}.", curves.len());
                    if let Some(first) = left_out.first() {
                        told += &format!(" Not all of it: {}", first.text);
                    }
                    self.session.add("Import", curves);
                    self.fit_view();
                    self.panels.say(told);
                })
            }
        };
        if let Err(text) = taken {
            self.panels.say(text);
        }
    }

    /// Goes on with another drawing, which cannot be undone; an empty one is seen with a point of the screen to a unit.
    pub fn open_drawing(&mut self, drawing: Drawing) {
        self.canvas.cancel(&mut self.session);
        self.session.open(drawing);
        self.view.reset();
        self.fit_view();
    }

    fn open(&mut self, drawing: Drawing, name: &str) {
        self.open_drawing(drawing);
        self.document = Document { name: stem(name).into(), ..Document::default() };
    }

    fn trace(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let size = image::ImageReader::new(std::io::Cursor::new(bytes)).with_guessed_format();
        let size = size
            .map_err(|error| error.to_string())
            .and_then(|reader| reader.into_dimensions().map_err(|error| error.to_string()));
        let (width, height) = size.map_err(|error| format!("{name}: cannot be shown: {error}"))?;
        let [min, max] = self.view.seen();
        let room = (max - min) * 0.8;
        let scale = (room.x / f64::from(width)).min(room.y / f64::from(height));
        let half = fairpath_curve::Vec2::new(f64::from(width), f64::from(height)) * (0.5 * scale);
        let at = min.midpoint(max) - half;
        let background = Background { name: name.into(), image: bytes.to_vec(), at, width: 2.0 * half.x, opacity: 0.5 };
        self.session.set_background(Some(Arc::new(background)));
        Ok(())
    }

    /// Saves the drawing where a person chooses.
    pub(crate) fn save(&mut self, ctx: &Context) {
        match encode_drawing(self.session.drawing()) {
            Ok(bytes) => self.files.save(ctx, &format!("{}.json", self.document.name), bytes),
            Err(error) => self.panels.say(error.to_string()),
        }
    }

    /// Exports the curves in a format where a person chooses.
    pub(crate) fn export(&mut self, ctx: &Context, format: SplineFormat) {
        match self.exported(format) {
            Ok((bytes, warnings)) => {
                if let Some(warning) = warnings.first() {
                    self.panels.say(warning.text.clone());
                }
                let name = format!("{}.{}", self.document.name, format.extension());
                self.files.save(ctx, &name, bytes);
            }
            Err(text) => self.panels.say(text),
        }
    }

    /// The selected curves, or if there are none all, in a format.
    pub(crate) fn exported(&self, format: SplineFormat) -> Result<(Vec<u8>, Vec<Warning>), String> {
        let mut file = splines_of(self.session.drawing());
        let selected: Vec<&str> = self
            .session
            .selection()
            .iter()
            .filter_map(|&id| Some(self.session.drawing().curve(id)?.name.as_str()))
            .collect();
        if !selected.is_empty() {
            file.splines.retain(|entry| selected.contains(&entry.name.as_str()));
        }
        let strokes = strokes_of(self.session.drawing());
        let encoded = encode_splines(&file, format, Some(&strokes), &WriteOptions::default());
        encoded.map(|encoded| (encoded.bytes, encoded.warnings)).map_err(|error| error.to_string())
    }

    /// Copies the selected curves, or all, as SVG.
    pub(crate) fn copy_svg(&mut self, ctx: &Context) {
        match self.exported(SplineFormat::Svg) {
            Ok((bytes, _)) => {
                ctx.copy_text(String::from_utf8_lossy(&bytes).into_owned());
                self.panels.say("Copied as SVG.");
            }
            Err(text) => self.panels.say(text),
        }
    }

    /// Begins a new drawing. What was there is still kept by undo.
    pub(crate) fn clear(&mut self) {
        self.session.select_all();
        self.session.delete_selected();
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
            self.store.keep(Box::new(move || encode_drawing(&drawing).map_err(told)));
            self.document.kept = self.session.history().version();
            self.document.waiting = None;
        }
    }
}

fn told(error: DrawingError) -> String {
    error.to_string()
}

/// A file's name without its extension.
fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}
