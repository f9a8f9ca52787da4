//! Files by dialog and by dropping them on the window: what a person chose comes in as bytes, what is saved goes out.
//!
//! A dialog is open for as long as a person likes, so each runs beside the interface and is asked after in every frame.

use eframe::egui::Context;
#[cfg(not(target_arch = "wasm32"))]
use std::future::Future;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};

/// What a file is chosen for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To go on with it instead of the drawing.
    Open,
    /// To be added to the drawing.
    Import,
    /// To be traced over.
    Background,
    /// To be French curves, whatever it holds.
    Templates,
}

/// What a file is written for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Saving {
    /// To hold something of the drawing for another program.
    Copy,
    /// To be the drawing's own file. Nobody is asked where a file lies already.
    Document(SavedDocument),
}

/// A drawing's own file, written or to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SavedDocument {
    /// Which drawing's.
    pub(crate) document: u64,
    /// Where it lies; a browser does not tell.
    pub(crate) path: Option<PathBuf>,
    /// The state that it holds, by the number that the history gives it.
    pub(crate) revision: u64,
}

/// What became of a dialog.
#[derive(Debug)]
pub(crate) enum FileEvent {
    /// A file was chosen and read.
    Chosen { purpose: Purpose, name: String, bytes: Vec<u8>, path: Option<PathBuf> },
    /// A file was written; what is told of it if it is the drawing's own.
    Saved { name: String, document: Option<SavedDocument> },
    /// It could not be.
    Failed { text: String },
}

/// The dialogs that are open.
pub(crate) struct Files {
    events: Receiver<FileEvent>,
    outbox: Sender<FileEvent>,
}

impl Default for Files {
    fn default() -> Self {
        let (outbox, events) = channel();
        Self { events, outbox }
    }
}

impl Files {
    /// What happened since the last call.
    pub(crate) fn events(&self) -> Vec<FileEvent> {
        self.events.try_iter().collect()
    }

    /// As if a file had been chosen: for one that was dropped. A browser reads it beside the interface, through the outbox.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn dropped(&self, event: FileEvent) {
        // The other end lives as long as this does.
        let _ = self.outbox.send(event);
    }

    /// Where what happened is to be told.
    #[cfg(target_arch = "wasm32")]
    pub(crate) fn outbox(&self) -> Sender<FileEvent> {
        self.outbox.clone()
    }

    /// Lets a person choose a file.
    pub(crate) fn choose(&self, ctx: &Context, purpose: Purpose) {
        let curves: &[&str] = &["json", "svg", "csv", "tsv", "txt", "dat", "xy", "inkml", "ink", "gpx", "geojson"];
        let (title, filter, extensions): (_, _, &[&str]) = match purpose {
            Purpose::Open => ("Open a drawing", "Drawings, strokes and curves", curves),
            Purpose::Import => ("Import", "Strokes, curves, French curves and edits", curves),
            Purpose::Background => ("Trace over a picture", "Pictures", &["png", "jpg", "jpeg", "webp"]),
            Purpose::Templates => {
                ("Import French curves", "French curves, curves and drawings", &["json", "svg", "csv"])
            }
        };
        let (outbox, ctx) = (self.outbox.clone(), ctx.clone());
        ask(title, filter, extensions, move |chosen| {
            let _ = outbox.send(match chosen {
                Ok((name, bytes, path)) => FileEvent::Chosen { purpose, name, bytes, path },
                Err(text) => FileEvent::Failed { text },
            });
            ctx.request_repaint();
        });
    }

    /// Writes a file: where it lies already, or else where a person chooses.
    pub(crate) fn save(&self, ctx: &Context, name: &str, bytes: Vec<u8>, saving: Saving) {
        let (outbox, ctx) = (self.outbox.clone(), ctx.clone());
        let document = match saving {
            Saving::Copy => None,
            Saving::Document(document) => Some(document),
        };
        let known = document.as_ref().and_then(|document| document.path.clone());
        write(name, known, bytes, move |written| {
            let _ = outbox.send(match written {
                Ok((name, path)) => {
                    let document = document.map(|document| SavedDocument { path, ..document });
                    FileEvent::Saved { name, document }
                }
                Err(text) => FileEvent::Failed { text },
            });
            ctx.request_repaint();
        });
    }
}

/// A file that was chosen: its name, its bytes, and where it lies, if that is known.
type Chosen = (String, Vec<u8>, Option<PathBuf>);

/// A file that was written: its name, and where it lies, if that is known.
type Written = (String, Option<PathBuf>);

/// Asks for a file and gives its name and its bytes to `then`, or why it cannot be read; nothing if none is chosen.
#[cfg(not(target_arch = "wasm32"))]
fn ask(title: &str, filter: &str, extensions: &[&str], then: impl FnOnce(Result<Chosen, String>) + Send + 'static) {
    let dialog = rfd::AsyncFileDialog::new().set_title(title).add_filter(filter, extensions).pick_file();
    beside(async move {
        if let Some(file) = dialog.await {
            let name = file.file_name();
            // The dialog's own way to read a file takes for granted that it can.
            let read = std::fs::read(file.path()).map_err(|error| format!("{name}: cannot be read: {error}"));
            then(read.map(|bytes| (name, bytes, Some(file.path().to_owned()))));
        }
    });
}

/// A browser shows a title and a filter of its own.
#[cfg(target_arch = "wasm32")]
fn ask(_: &str, _: &str, extensions: &[&str], then: impl FnOnce(Result<Chosen, String>) + 'static) {
    crate::web::open(extensions, move |chosen| then(chosen.map(|(name, bytes)| (name, bytes, None))));
}

/// Writes a file whole or not at all, where it lies already or else where a person chooses, and gives its name and place to `then`, or why it cannot be
/// written; nothing if no place is chosen.
#[cfg(not(target_arch = "wasm32"))]
fn write(
    name: &str,
    known: Option<PathBuf>,
    bytes: Vec<u8>,
    then: impl FnOnce(Result<Written, String>) + Send + 'static,
) {
    let dialog = match known {
        Some(_) => None,
        None => Some(rfd::AsyncFileDialog::new().set_title("Save").set_file_name(name).save_file()),
    };
    beside(async move {
        let chosen = match dialog {
            Some(dialog) => dialog.await.map(|file| file.path().to_owned()),
            None => known,
        };
        if let Some(path) = chosen {
            let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            let written = fairpath_io::write_whole(&path, &bytes).map_err(|error| error.to_string());
            then(written.map(|()| (name, Some(path))));
        }
    });
}

/// In a browser a file that is written is downloaded.
#[cfg(target_arch = "wasm32")]
fn write(name: &str, _known: Option<PathBuf>, bytes: Vec<u8>, then: impl FnOnce(Result<Written, String>) + 'static) {
    then(crate::web::download(name, &bytes).map(|()| (name.to_owned(), None)));
}

#[cfg(not(target_arch = "wasm32"))]
fn beside(dialog: impl Future<Output = ()> + Send + 'static) {
    std::thread::spawn(move || pollster::block_on(dialog));
}
