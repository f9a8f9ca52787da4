//! Files by dialog and by dropping them on the window: what a person chose comes in as bytes, what is saved goes out.
//!
//! A dialog is open for as long as a person likes, so each runs beside the interface and is asked after in every frame.

use eframe::egui::Context;
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

    /// As if a file had been chosen: for one that was dropped.
    pub(crate) fn dropped(&self, event: FileEvent) {
        // The other end lives as long as this does.
        let _ = self.outbox.send(event);
    }

    /// Where what happened is to be told.
    pub(crate) fn outbox(&self) -> Sender<FileEvent> {
        self.outbox.clone()
    }

    /// Lets a person choose a file.
    pub(crate) fn choose(&self, ctx: &Context, purpose: Purpose) {
        let (title, filter, extensions): (_, _, &[&str]) = match purpose {
            Purpose::Open => ("Open a drawing", "Drawings", &["json", "svg", "csv", "txt", "inkml", "gpx", "geojson"]),
            Purpose::Import => ("Import strokes or curves", "Strokes and curves", &["json", "svg", "csv", "txt", "inkml", "gpx", "geojson"]),
            Purpose::Background => ("Trace over a picture", "Pictures", &["png", "jpg", "jpeg", "webp"]),
        };
        let dialog = rfd::AsyncFileDialog::new().set_title(title).add_filter(filter, extensions).pick_file();
        let (outbox, ctx) = (self.outbox.clone(), ctx.clone());
        beside(async move {
            if let Some(file) = dialog.await {
                let name = file.file_name();
                let bytes = file.read().await;
                let _ = outbox.send(FileEvent::Chosen { purpose, name, bytes });
                ctx.request_repaint();
            }
        });
    }

    /// Lets a person choose where to write a file.
    pub(crate) fn save(&self, ctx: &Context, name: &str, bytes: Vec<u8>) {
        let dialog = rfd::AsyncFileDialog::new().set_title("Save").set_file_name(name).save_file();
        let (outbox, ctx) = (self.outbox.clone(), ctx.clone());
        beside(async move {
            if let Some(file) = dialog.await {
                let name = file.file_name();
                let event = match write(&file, &bytes).await {
                    Ok(()) => FileEvent::Saved { name },
                    Err(text) => FileEvent::Failed { text },
                };
                let _ = outbox.send(event);
                ctx.request_repaint();
            }
        });
    }
}

/// Writes a file, whole or not at all.
#[cfg(not(target_arch = "wasm32"))]
async fn write(file: &rfd::FileHandle, bytes: &[u8]) -> Result<(), String> {
    fairpath_io::write_whole(file.path(), bytes).map_err(|error| error.to_string())
}

/// In a browser a file that is written is downloaded.
#[cfg(target_arch = "wasm32")]
async fn write(file: &rfd::FileHandle, bytes: &[u8]) -> Result<(), String> {
    file.write(bytes).await.map_err(|error| format!("{}: cannot be saved: {error}", file.file_name()))
}

#[cfg(not(target_arch = "wasm32"))]
fn beside(dialog: impl Future<Output = ()> + Send + 'static) {
    std::thread::spawn(move || pollster::block_on(dialog));
}

#[cfg(target_arch = "wasm32")]
fn beside(dialog: impl Future<Output = ()> + 'static) {
    wasm_bindgen_futures::spawn_local(dialog);
}
