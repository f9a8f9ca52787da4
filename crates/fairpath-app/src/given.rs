//! Files that are given when the application starts: paths come in, are read and understood before there is a window, and what they hold is in
//! the first picture.

use crate::app::App;
use crate::files::Purpose;
use anyhow::{Context as _, Result, anyhow};
use eframe::egui::{Context, Pos2, Rect, Vec2};
use fairpath_io::{ReadOptions, TemplateOptions, read_edits_from, read_templates_from};
use fairpath_sketch::{Drawing, FileKind, Neatening, decode_drawing, import};
use std::path::{Path, PathBuf};

/// A file that can be shown.
#[derive(Debug)]
pub struct GivenFile {
    name: String,
    bytes: Vec<u8>,
    path: PathBuf,
}

impl GivenFile {
    /// Reads a drawing, strokes, curves, French curves, edits or a picture.
    ///
    /// # Errors
    /// When it cannot be read, or is none of these; the message names the file and says what to do.
    pub fn read(path: &Path) -> Result<Self> {
        let shown = path.display();
        let bytes = std::fs::read(path).with_context(|| {
            format!(
                "{shown}: cannot be read; give a drawing, strokes, curves or a picture that is there and may be read"
            )
        })?;
        let understood = if is_picture(&bytes) {
            let reader = image::ImageReader::new(std::io::Cursor::new(&bytes)).with_guessed_format();
            let size = reader.map_err(|error| anyhow!(error)).and_then(|reader| Ok(reader.into_dimensions()?));
            size.map(drop)
        } else {
            let (name, bytes) = (shown.to_string(), &bytes[..]);
            match FileKind::of(bytes) {
                FileKind::Drawing => decode_drawing(bytes, &name).map(drop).map_err(Into::into),
                FileKind::Templates => {
                    read_templates_from(bytes, &name, &TemplateOptions::default()).map(drop).map_err(Into::into)
                }
                FileKind::Edits => read_edits_from(bytes, &name, &ReadOptions::default()).map(drop).map_err(Into::into),
                FileKind::Curves => {
                    import(bytes, &name, &Drawing::default(), &Neatening::default()).map(drop).map_err(Into::into)
                }
            }
        };
        understood
            .with_context(|| format!("{shown}: cannot be shown; give a drawing, strokes, curves or a picture"))?;
        let name = path.file_name().map_or_else(|| shown.to_string(), |name| name.to_string_lossy().into_owned());
        // Where it lies must hold whatever becomes of the working folder.
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        Ok(Self { name, bytes, path })
    }
}

fn is_picture(bytes: &[u8]) -> bool {
    image::guess_format(bytes).is_ok()
}

impl App {
    /// Shows what was given instead of the drawing that an earlier run kept, to which undo leads back: a first drawing is gone on with, everything else is
    /// added to it. `window` is the size that the window will have, points. Without files nothing changes.
    pub fn open_given(&mut self, ctx: &Context, files: &[GivenFile], window: Vec2) {
        let Some((first, rest)) = files.split_first() else { return };
        // A picture is laid into what is seen.
        self.view.on(Rect::from_min_size(Pos2::ZERO, window));
        self.open_drawing(Drawing::default());
        self.panels.hint = false;
        self.keep(ctx);
        let others = if FileKind::of(&first.bytes) == FileKind::Drawing {
            self.take_file(Purpose::Open, &first.name, &first.bytes, Some(first.path.clone()));
            rest
        } else {
            self.begin_new();
            files
        };
        for file in others {
            self.take_file(Purpose::Import, &file.name, &file.bytes, None);
        }
        self.session.select(None, false);
        self.fit_view = true;
    }
}
