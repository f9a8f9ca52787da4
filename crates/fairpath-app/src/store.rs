//! What survives a crash: the drawing is kept every few seconds while it changes, and offered when the application starts again.

#[cfg(not(target_arch = "wasm32"))]
use std::sync::mpsc::{Receiver, Sender, channel};

/// A place that keeps one text, which may take a while: nothing here waits for it.
pub trait Store {
    /// Keeps a text instead of the one before, whole or not at all. Failures come by [`trouble`](Self::trouble).
    fn keep(&mut self, text: Box<dyn FnOnce() -> Result<Vec<u8>, String> + Send>);

    /// Asks for what was kept by an earlier run; it comes by [`kept`](Self::kept).
    fn ask(&mut self);

    /// What an earlier run kept, once it has come.
    fn kept(&mut self) -> Option<Vec<u8>>;

    /// Keeps what an earlier run kept and nobody can read beside what is kept from now on, for whoever can mend it.
    fn set_aside(&mut self, damaged: Vec<u8>);

    /// What went wrong since the last call.
    fn trouble(&mut self) -> Option<String>;
}

/// Keeps nothing: for tests and where there is no place.
#[derive(Debug, Default)]
pub struct NoStore;

impl Store for NoStore {
    fn keep(&mut self, _text: Box<dyn FnOnce() -> Result<Vec<u8>, String> + Send>) {}

    fn ask(&mut self) {}

    fn kept(&mut self) -> Option<Vec<u8>> {
        None
    }

    fn set_aside(&mut self, _damaged: Vec<u8>) {}

    fn trouble(&mut self) -> Option<String> {
        None
    }
}

/// Keeps a file in the folder that the system has for such things.
#[cfg(not(target_arch = "wasm32"))]
#[derive(Debug)]
pub struct FileStore {
    path: std::path::PathBuf,
    kept: Option<Vec<u8>>,
    troubles: Receiver<String>,
    outbox: Sender<String>,
    /// The last save, which the next one waits for.
    saving: Option<std::thread::JoinHandle<()>>,
}

#[cfg(not(target_arch = "wasm32"))]
impl FileStore {
    /// The store in the user's own folder; `None` where the system has none.
    #[must_use]
    pub fn of_user() -> Option<Self> {
        let folder = directories::ProjectDirs::from("org", "Fairpath", "fairpath")?;
        Some(Self::at(folder.data_local_dir().join("kept.json")))
    }

    /// The store in that file.
    #[must_use]
    pub fn at(path: std::path::PathBuf) -> Self {
        let (outbox, troubles) = channel();
        Self { path, kept: None, troubles, outbox, saving: None }
    }
}

#[cfg(not(target_arch = "wasm32"))]
impl Store for FileStore {
    fn keep(&mut self, text: Box<dyn FnOnce() -> Result<Vec<u8>, String> + Send>) {
        let (path, outbox, before) = (self.path.clone(), self.outbox.clone(), self.saving.take());
        self.saving = Some(std::thread::spawn(move || {
            // One after the other, or an old state could overtake a new one.
            if let Some(before) = before {
                let _ = before.join();
            }
            let write = |bytes: Vec<u8>| {
                let folder = path.parent().unwrap_or(&path);
                std::fs::create_dir_all(folder)
                    .map_err(|error| format!("{}: cannot be made: {error}", folder.display()))?;
                fairpath_io::write_whole(&path, &bytes).map_err(|error| error.to_string())
            };
            if let Err(text) = text().and_then(write) {
                let _ = outbox.send(text);
            }
        }));
    }

    fn ask(&mut self) {
        match std::fs::read(&self.path) {
            Ok(bytes) => self.kept = Some(bytes),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => {
                let _ = self.outbox.send(format!("{}: cannot be read: {error}", self.path.display()));
            }
        }
    }

    fn kept(&mut self) -> Option<Vec<u8>> {
        self.kept.take()
    }

    fn set_aside(&mut self, damaged: Vec<u8>) {
        if let Err(error) = fairpath_io::write_whole(&self.path.with_extension("damaged.json"), &damaged) {
            // The other end lives as long as this does.
            let _ = self.outbox.send(error.to_string());
        }
    }

    fn trouble(&mut self) -> Option<String> {
        self.troubles.try_recv().ok()
    }
}

#[cfg(not(target_arch = "wasm32"))]
impl Drop for FileStore {
    fn drop(&mut self) {
        // What is being kept is kept before the window is gone.
        if let Some(saving) = self.saving.take() {
            let _ = saving.join();
        }
    }
}
