//! Files by dialog and by dropping them on the window: what a person chose comes in as bytes, what is saved goes out.
//!
//! A dialog is open for as long as a person likes, so each runs beside the interface and is asked after in every frame.

use eframe::egui::Context;
#[cfg(not(target_arch = "wasm32"))]
use std::future::Future;
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
}

/// What became of a dialog.
#[derive(Debug)]
pub(crate) enum FileEvent {
    /// A file was chosen and read.
    Chosen { purpose: Purpose, name: String, bytes: Vec<u8> },
    /// A file was written.
    Saved { name: String },
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
        let (title, filter, extensions): (_, _, &[&str]) = match purpose {
            Purpose::Open => ("Open a drawing", "Drawings", &["json", "svg", "csv", "txt", "inkml", "gpx", "geojson"]),
            Purpose::Import => (
                "Import strokes or curves",
                "Strokes and curves",
                &["json", "svg", "csv", "txt", "inkml", "gpx", "geojson"],
            ),
            Purpose::Background => ("Trace over a picture", "Pictures", &["png", "jpg", "jpeg", "webp"]),
        };
        let (outbox, ctx) = (self.outbox.clone(), ctx.clone());
        ask(title, filter, extensions, move |chosen| {
            let _ = outbox.send(match chosen {
                Ok((name, bytes)) => FileEvent::Chosen { purpose, name, bytes },
                Err(text) => FileEvent::Failed { text },
            });
            ctx.request_repaint();
        });
    }

    /// Lets a person choose where to write a file.
    pub(crate) fn save(&self, ctx: &Context, name: &str, bytes: Vec<u8>) {
        let (outbox, ctx) = (self.outbox.clone(), ctx.clone());
        write(name, bytes, move |written| {
            let _ = outbox.send(match written {
                Ok(name) => FileEvent::Saved { name },
                Err(text) => FileEvent::Failed { text },
            });
            ctx.request_repaint();
        });
    }
}

/// Asks for a file and gives its name and its bytes to `then`, or why it cannot be read; nothing if none is chosen.
#[cfg(not(target_arch = "wasm32"))]
fn ask(
    title: &str,
    filter: &str,
    extensions: &[&str],
    then: impl FnOnce(Result<(String, Vec<u8>), String>) + Send + 'static,
) {
    let dialog = rfd::AsyncFileDialog::new().set_title(title).add_filter(filter, extensions).pick_file();
    beside(async move {
        if let Some(file) = dialog.await {
            then(Ok((file.file_name(), file.read().await)));
        }
    });
}

/// A browser shows a title and a filter of its own.
#[cfg(target_arch = "wasm32")]
fn ask(_: &str, _: &str, extensions: &[&str], then: impl FnOnce(Result<(String, Vec<u8>), String>) + 'static) {
    crate::web::open(extensions, then);
}

/// Asks where to write a file, writes it whole or not at all, and gives its name to `then`, or why it cannot be written; nothing if no place
/// is chosen.
#[cfg(not(target_arch = "wasm32"))]
fn write(name: &str, bytes: Vec<u8>, then: impl FnOnce(Result<String, String>) + Send + 'static) {
    let dialog = rfd::AsyncFileDialog::new().set_title("Save").set_file_name(name).save_file();
    beside(async move {
        if let Some(file) = dialog.await {
            let written = fairpath_io::write_whole(file.path(), &bytes).map_err(|error| error.to_string());
            then(written.map(|()| file.file_name()));
        }
    });
}

/// In a browser a file that is written is downloaded.
#[cfg(target_arch = "wasm32")]
fn write(name: &str, bytes: Vec<u8>, then: impl FnOnce(Result<String, String>) + 'static) {
    then(crate::web::download(name, &bytes).map(|()| name.to_owned()));
}

#[cfg(not(target_arch = "wasm32"))]
fn beside(dialog: impl Future<Output = ()> + Send + 'static) {
    std::thread::spawn(move || pollster::block_on(dialog));
}
