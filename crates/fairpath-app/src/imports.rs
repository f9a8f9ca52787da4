//! What comes into a drawing: files that were chosen or dropped on the window come in by their bytes, and what they hold becomes part of the work.

use crate::app::App;
use crate::documents::stem;
use crate::files::{FileEvent, Purpose};
use eframe::egui::{Context, DroppedFileHandle};
use fairpath_curve::Vec2;
use fairpath_fit::TemplateSet;
use fairpath_io::{ReadOptions, TemplateOptions, read_edits_from, read_templates_from};
use fairpath_sketch::{Background, DrawingError, FileKind, decode_drawing, import};
use std::path::PathBuf;
use std::sync::Arc;

/// The share of what is seen that a picture to trace over takes up.
const PICTURE_SHARE: f64 = 0.8;

/// So many of the things that are to be said of a file fit on the screen.
const MOST_TOLD: usize = 3;

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
                FileEvent::Chosen { purpose, name, bytes, path } => self.take_file(purpose, &name, &bytes, path),
                FileEvent::Saved { name, document } => {
                    self.panels.say(format!("Saved {name}."));
                    if let Some(saved) = document {
                        self.note_saved(&name, saved);
                    }
                }
                FileEvent::Failed { text } => self.panels.say(text),
            }
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn take_dropped(&mut self, _ctx: &Context, name: String, file: DroppedFileHandle) {
        self.files.dropped(match file.bytes() {
            Ok(bytes) => FileEvent::Chosen { purpose: Purpose::Import, name, bytes, path: None },
            Err(error) => FileEvent::Failed { text: format!("{name}: cannot be read: {error}") },
        });
    }

    #[cfg(target_arch = "wasm32")]
    fn take_dropped(&mut self, ctx: &Context, name: String, file: DroppedFileHandle) {
        let (outbox, ctx) = (self.files.outbox(), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            let _ = outbox.send(match file.bytes_async().await {
                Ok(bytes) => FileEvent::Chosen { purpose: Purpose::Import, name, bytes, path: None },
                Err(error) => FileEvent::Failed { text: format!("{name}: cannot be read: {error}") },
            });
            ctx.request_repaint();
        });
    }

    /// Takes a file for what it was chosen for, `path` being where it lies, if that is known. A picture is always traced over, and what a file of ours says
    /// it is, it is.
    pub(crate) fn take_file(&mut self, purpose: Purpose, name: &str, bytes: &[u8], path: Option<PathBuf>) {
        let kind = FileKind::of(bytes);
        let taken = match purpose {
            _ if image::guess_format(bytes).is_ok() => self.trace(name, bytes),
            Purpose::Background => Err(format!("{name}: no picture that can be shown; choose a PNG, JPEG or WebP")),
            Purpose::Open if kind == FileKind::Drawing => decode_drawing(bytes, name).map_err(told).map(|drawing| {
                self.open(drawing, name, path);
            }),
            Purpose::Templates => self.take_templates(name, bytes),
            Purpose::Open | Purpose::Import => match kind {
                FileKind::Templates => self.take_templates(name, bytes),
                FileKind::Edits => self.take_edits(name, bytes),
                FileKind::Drawing | FileKind::Curves => self.take_curves(name, bytes),
            },
        };
        if let Err(text) = taken {
            self.panels.say(text);
        }
    }

    /// Strokes or curves, to be added to the drawing.
    fn take_curves(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let imported = import(bytes, name, self.session.drawing(), self.session.neatening()).map_err(told)?;
        let count = imported.curves.len();
        let mut told = format!("{count} {} from {name}.", if count == 1 { "curve" } else { "curves" });
        for warning in imported.told.iter().take(MOST_TOLD) {
            told += &format!(" Note: {}.", warning.text.trim_end_matches('.'));
        }
        self.session.import(imported);
        self.fit_view();
        self.panels.say(told);
        Ok(())
    }

    /// A set of French curves, which is chosen at once.
    fn take_templates(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let file = read_templates_from(bytes, name, &TemplateOptions::default()).map_err(|error| error.to_string())?;
        let count = file.set.templates().len();
        let set = match file.set {
            // A set that tells no name has that of its file.
            set if set.name() == name => TemplateSet::new(stem(name), set.templates().to_vec()),
            set => Ok(set),
        };
        let set = self.session.add_templates(set.map_err(|error| error.to_string())?);
        let mut told = format!("{count} French curves in {set:?}.");
        if let Some(first) = file.warnings.first() {
            told += &format!(" Not all of it: {}", first.text);
        }
        self.choose_templates(set);
        self.panels.say(told);
        Ok(())
    }

    /// Edits, made on the curves that are there.
    fn take_edits(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let edits = read_edits_from(bytes, name, &ReadOptions::default()).map_err(|error| error.to_string())?;
        if self.session.make_edits(&edits) {
            self.panels.say(format!("{} edits from {name}.", edits.len()));
            return Ok(());
        }
        let why = self.session.take_trouble().map_or_else(String::new, |trouble| trouble.text);
        Err(format!("{name}: {why}"))
    }

    fn trace(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let size = image::ImageReader::new(std::io::Cursor::new(bytes)).with_guessed_format();
        let size = size
            .map_err(|error| error.to_string())
            .and_then(|reader| reader.into_dimensions().map_err(|error| error.to_string()));
        let (width, height) = size.map_err(|error| format!("{name}: cannot be shown: {error}"))?;
        let [min, max] = self.view.seen();
        let room = (max - min) * PICTURE_SHARE;
        let scale = (room.x / f64::from(width)).min(room.y / f64::from(height));
        let half = Vec2::new(f64::from(width), f64::from(height)) * (0.5 * scale);
        let at = min.midpoint(max) - half;
        let background = Background { name: name.into(), image: bytes.to_vec(), at, width: 2.0 * half.x, opacity: 0.5 };
        self.session.set_background(Some(Arc::new(background)));
        Ok(())
    }
}

fn told(error: DrawingError) -> String {
    error.to_string()
}
