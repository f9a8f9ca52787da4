//! From a file to a document: the commands of a script or of a project, done one after the other.

use super::files::TerrainFolder;
use super::project::{is_project, parse};
use super::script::{DriveScript, ScriptCommand, read_drive_script_from};
use crate::error::{Error, Fault};
use crate::input::{label, open, read_all, text};
use crate::limits::ReadOptions;
use fairpath_drive::{Command, Document, Play};
use fairpath_fit::Warning;
use std::path::{Path, PathBuf};

/// A document from a file.
#[derive(Debug)]
pub struct OpenedDrive {
    /// The document, all commands of the file done.
    pub document: Document,
    /// The folder beside whose files it names its terrain.
    pub folder: PathBuf,
    /// The drives that it asks for; each is possible where it stands in the file.
    pub plays: Vec<Play>,
    /// What the caller should know: about terrains, strokes, heights, and about a project from whose commands something else follows than when it was saved.
    pub warnings: Vec<Warning>,
}

/// The document of a script or a project; files that it names lie beside it. `-` is standard input, beside which is the present folder. `done` is told of each command that was done: its number in
/// the file, from 1, and its word. An import is told of for each of its strokes.
///
/// # Errors
/// When the file cannot be read or breaks the rules of its format, or a command cannot be done, with its number and word.
pub fn open_drive(path: &Path, options: &ReadOptions, done: &mut dyn FnMut(usize, &str)) -> Result<OpenedDrive, Error> {
    let name = label(path);
    let in_file = |fault: Fault| fault.in_file(&name);
    let bytes = read_all(open(path)?, &options.limits).map_err(in_file)?;
    let saved = if is_project(&bytes) { Some(text(&bytes).and_then(parse).map_err(in_file)?) } else { None };
    let script = match &saved {
        Some(saved) => DriveScript { commands: saved.commands.iter().cloned().map(ScriptCommand::Document).collect() },
        None => read_drive_script_from(&bytes[..], &name, options)?,
    };
    let files = TerrainFolder::beside(path);
    let mut opened = OpenedDrive {
        document: Document::new(),
        folder: files.folder().to_path_buf(),
        plays: Vec::new(),
        warnings: Vec::new(),
    };
    for (i, command) in script.commands.into_iter().enumerate() {
        let number = i + 1;
        for command in opened.commands(command, number, &files).map_err(|e| e.in_file(&name))? {
            let word = command.word();
            let outcome = opened.document.run(command, &files).map_err(|e| in_file(fault(number, word, e)))?;
            let told = files.new_warnings().into_iter().chain(outcome.warnings);
            let told = told.map(|w| Warning { text: format!("command {number} ({word}): {}", w.text), ..w });
            opened.warnings.extend(told);
            done(number, word);
        }
    }
    if saved.is_some_and(|saved| !saved.follows_from(&opened.document)) {
        let text = "what follows from its commands is not what was saved with them: a terrain or the program changed";
        opened.warnings.push(Warning { code: "not-as-saved".into(), text: text.into() });
    }
    Ok(opened)
}

fn fault(number: usize, word: &str, problem: impl std::fmt::Display) -> Fault {
    Fault::new(format_args!("command {number} ({word})"), problem)
}

/// Why a command of a script is no command of a document.
enum Trouble {
    /// With the script.
    Own(Fault),
    /// With the file that it imports.
    Other(Error),
}

impl Trouble {
    fn in_file(self, name: &str) -> Error {
        match self {
            Self::Own(fault) => fault.in_file(name),
            Self::Other(error) => error,
        }
    }
}

impl OpenedDrive {
    /// The commands to the document that a command of a script stands for.
    fn commands(
        &mut self,
        command: ScriptCommand,
        number: usize,
        files: &TerrainFolder,
    ) -> Result<Vec<Command>, Trouble> {
        let import = match command {
            ScriptCommand::Document(command) => return Ok(vec![command]),
            ScriptCommand::Import(import) => import,
            ScriptCommand::Play(play) => {
                let results = self.document.results().ok_or("lay the terrain first".to_owned());
                let driven = results.and_then(|r| play.drive(self.document.state(), r).map_err(|e| e.to_string()));
                driven.map_err(|problem| Trouble::Own(fault(number, "play", problem)))?;
                self.plays.push(play);
                return Ok(Vec::new());
            }
        };
        let Some(terrain) = self.document.state().terrain.clone() else {
            return Err(Trouble::Own(fault(number, "import", "lay the terrain first")));
        };
        let imported = import.sketches(files.folder(), &terrain.field, terrain.georeference.as_ref());
        let (sketches, left_out) = imported.map_err(Trouble::Other)?;
        if left_out > 0 {
            let text = format!("command {number} (import): {}: {left_out} lines were left out", import.file);
            self.warnings.push(Warning { code: "lines-left-out".into(), text });
        }
        Ok(sketches)
    }
}
