//! What goes out of a drawing: a kind of file comes in, its bytes go out, by dialog or to the clipboard.

use crate::app::App;
use crate::files::Saving;
use eframe::egui::Context;
use fairpath_fit::Warning;
use fairpath_io::{
    SplineFile, SplineFormat, StrokeFile, StrokeFormat, SurfaceEntry, SurfaceFile, SurfaceFormat, WriteOptions,
    encode_splines, encode_strokes, encode_surfaces, encode_templates,
};
use fairpath_sketch::{CurveId, splines_of, strokes_of};

/// A kind of file that a drawing can be exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Export {
    /// The selected curves, or all.
    Curves(SplineFormat),
    /// The strokes that they come from.
    Strokes(StrokeFormat),
    /// The surface that is shown.
    Surface(SurfaceFormat),
    /// The set of French curves that is chosen.
    Templates,
}

/// Everything that can be exported, by what it is of, with what a person calls it.
pub(crate) const EXPORTS: [(&str, &[(Export, &str)]); 4] = [
    (
        "Curves",
        &[
            (Export::Curves(SplineFormat::Svg), "SVG, for drawing programs"),
            (Export::Curves(SplineFormat::Dxf), "DXF, for CAD"),
            (Export::Curves(SplineFormat::Json), "JSON, exact curves"),
            (Export::Curves(SplineFormat::Csv), "CSV, a row for each segment"),
            (Export::Curves(SplineFormat::Png), "PNG, a picture"),
        ],
    ),
    (
        "Strokes as drawn",
        &[
            (Export::Strokes(StrokeFormat::Json), "Strokes, JSON with times and pressures"),
            (Export::Strokes(StrokeFormat::Svg), "Strokes, SVG polylines"),
            (Export::Strokes(StrokeFormat::Text), "Strokes, CSV"),
        ],
    ),
    (
        "Surface",
        &[
            (Export::Surface(SurfaceFormat::Glb), "glTF, for 3-D programs"),
            (Export::Surface(SurfaceFormat::Obj), "OBJ, a mesh"),
            (Export::Surface(SurfaceFormat::Png), "PNG, a shaded picture"),
        ],
    ),
    ("French curves", &[(Export::Templates, "The chosen set, JSON")]),
];

impl App {
    /// Whether there is anything of that kind, or else what to do for it.
    pub(crate) fn exportable(&self, export: Export) -> Result<(), &'static str> {
        let drawing = self.session.drawing();
        match export {
            Export::Curves(_) | Export::Strokes(_) if drawing.curves().is_empty() => Err("Draw something first"),
            Export::Surface(_) if self.session.surface().is_none() => Err("Inflate a closed curve first (I)"),
            Export::Templates if drawing.template_set(&self.session.neatening().templates).is_none() => {
                Err("Choose a set of French curves first")
            }
            _ => Ok(()),
        }
    }

    /// Exports to a place that a person chooses.
    pub(crate) fn export(&mut self, ctx: &Context, export: Export) {
        match self.exported(export) {
            Ok((name, bytes, warnings)) => {
                if let Some(warning) = warnings.first() {
                    self.panels.say(warning.text.clone());
                }
                self.files.save(ctx, &name, bytes, Saving::Copy);
            }
            Err(text) => self.panels.say(text),
        }
    }

    /// The file: a name, its bytes, and what could not be kept of the drawing.
    ///
    /// # Errors
    /// What to do first, or why it cannot be written.
    pub(crate) fn exported(&self, export: Export) -> Result<(String, Vec<u8>, Vec<Warning>), String> {
        self.exportable(export)?;
        let drawing = self.session.drawing();
        let stem = &self.document_name();
        let (stem, extension, encoded) = match export {
            Export::Curves(format) => {
                let encoded = encode_splines(
                    &self.chosen_splines(),
                    format,
                    Some(&strokes_of(drawing)),
                    &WriteOptions::default(),
                );
                (stem.clone(), format.extension(), encoded.map(|encoded| (encoded.bytes, encoded.warnings)))
            }
            Export::Strokes(format) => {
                let extension = match format {
                    StrokeFormat::Svg => "svg",
                    StrokeFormat::Text => "csv",
                    _ => "json",
                };
                (format!("{stem}-strokes"), extension, alone(encode_strokes(&self.chosen_strokes(), format)))
            }
            Export::Surface(format) => {
                let (id, mesh) = self.session.surface().ok_or("there is no surface")?;
                let name = drawing.curve(id).map_or_else(String::new, |curve| curve.name.clone());
                let surfaces = vec![SurfaceEntry { name, mesh: (**mesh).clone() }];
                let file = SurfaceFile { unit: drawing.unit, y: drawing.y, surfaces };
                (format!("{stem}-surface"), format.extension(), alone(encode_surfaces(&file, format)))
            }
            Export::Templates => {
                let set = drawing.template_set(&self.session.neatening().templates).ok_or("there is no such set")?;
                (format!("{}-templates", set.name()), "json", alone(encode_templates(&set)))
            }
        };
        let (bytes, warnings) = encoded.map_err(|error| error.to_string())?;
        Ok((format!("{stem}.{extension}"), bytes, warnings))
    }

    /// Copies the selected curves, or all, as SVG.
    pub(crate) fn copy_svg(&mut self, ctx: &Context) {
        match self.exported(Export::Curves(SplineFormat::Svg)) {
            Ok((_, bytes, _)) => {
                ctx.copy_text(String::from_utf8_lossy(&bytes).into_owned());
                self.panels.say("Copied as SVG.");
            }
            Err(text) => self.panels.say(text),
        }
    }

    fn chosen_splines(&self) -> SplineFile {
        let mut file = splines_of(self.session.drawing());
        let mut chosen = self.chosen();
        file.splines.retain(|_| chosen.next().unwrap_or(true));
        file
    }

    fn chosen_strokes(&self) -> StrokeFile {
        let mut file = strokes_of(self.session.drawing());
        let mut chosen = self.chosen();
        file.strokes.retain(|_| chosen.next().unwrap_or(true));
        file
    }

    /// For each curve whether it is chosen: selected, or nothing is.
    fn chosen(&self) -> impl Iterator<Item = bool> {
        let selection = self.session.selection();
        let is_chosen = |id: CurveId| selection.is_empty() || selection.contains(&id);
        self.session.drawing().curves().iter().map(move |curve| is_chosen(curve.id))
    }
}

/// A file about which there is nothing to say.
fn alone<E>(bytes: Result<Vec<u8>, E>) -> Result<(Vec<u8>, Vec<Warning>), E> {
    bytes.map(|bytes| (bytes, Vec::new()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::NoStore;
    use crate::worker::InlineWorker;
    use fairpath_io::{ReadOptions, TemplateOptions, read_splines_from, read_strokes_from, read_templates_from};

    /// The application with its first drawing, fitted.
    fn app() -> App {
        let ctx = Context::default();
        let mut app = App::new(&ctx, Box::<InlineWorker>::default(), Box::new(NoStore));
        for _ in 0..3 {
            app.frame_without_window(&ctx, eframe::egui::RawInput::default());
        }
        assert!(app.is_settled());
        app
    }

    fn all() -> impl Iterator<Item = Export> {
        EXPORTS.into_iter().flat_map(|(_, exports)| exports).map(|(export, _)| *export)
    }

    #[test]
    fn everything_that_the_library_writes_can_be_exported() {
        for format in SplineFormat::ALL {
            assert!(all().any(|export| export == Export::Curves(format)), "{format:?}");
        }
        for format in SurfaceFormat::ALL {
            assert!(all().any(|export| export == Export::Surface(format)), "{format:?}");
        }
        let points = vec![fairpath_curve::Point::ORIGIN, fairpath_curve::Point::new(9.0, 3.0)];
        let strokes = StrokeFile { strokes: vec![fairpath_fit::Stroke::new("a", points)], ..StrokeFile::default() };
        for format in StrokeFormat::ALL {
            let is_written = encode_strokes(&strokes, format).is_ok();
            assert_eq!(all().any(|export| export == Export::Strokes(format)), is_written, "{format:?}");
        }
    }

    #[test]
    fn each_export_is_a_file_that_its_reader_takes() {
        let mut app = app();
        let closed = app.session.drawing().curves().iter().find(|curve| curve.spline.is_closed()).map(|curve| curve.id);
        app.session.select(closed, false);
        app.inflate_selected();
        while let Some((ticket, job)) = app.session.next_job() {
            app.session.take_answer(ticket, fairpath_sketch::run(&job));
        }
        for export in all() {
            let (name, bytes, _) = app.exported(export).unwrap_or_else(|text| panic!("{export:?}: {text}"));
            let read = ReadOptions::default();
            let begins = |magic: &[u8]| bytes.starts_with(magic);
            let is_sound = match export {
                Export::Curves(SplineFormat::Json | SplineFormat::Svg | SplineFormat::Csv) => {
                    read_splines_from(&bytes[..], &name, None, &read).is_ok_and(|file| file.splines.len() == 1)
                }
                Export::Curves(SplineFormat::Dxf) => begins(b"  0\n") || begins(b"0\n") || begins(b"999"),
                Export::Curves(_) | Export::Surface(SurfaceFormat::Png) => begins(b"\x89PNG"),
                Export::Strokes(_) => {
                    read_strokes_from(&bytes[..], &name, None, &read).is_ok_and(|file| file.strokes.len() == 1)
                }
                Export::Surface(SurfaceFormat::Glb) => begins(b"glTF"),
                Export::Surface(_) => String::from_utf8_lossy(&bytes).contains("\nf "),
                Export::Templates => read_templates_from(&bytes[..], &name, &TemplateOptions::default()).is_ok(),
            };
            assert!(is_sound, "{export:?} as {name}");
        }
    }

    #[test]
    fn what_is_not_there_is_not_exported_and_what_to_do_is_told() {
        let mut app = app();
        let told = app.exported(Export::Surface(SurfaceFormat::Glb)).unwrap_err();
        assert!(told.contains("Inflate"), "{told}");
        app.session.select_all();
        app.session.delete_selected();
        let told = app.exported(Export::Curves(SplineFormat::Svg)).unwrap_err();
        assert!(told.contains("Draw"), "{told}");
    }

    #[test]
    fn selected_curves_alone_are_exported() {
        let mut app = app();
        let ids: Vec<_> = app.session.drawing().curves().iter().map(|curve| curve.id).collect();
        assert_eq!(app.chosen_splines().splines.len(), ids.len());
        app.session.select(Some(ids[1]), false);
        app.session.select(Some(ids[2]), true);
        let names: Vec<String> = app.chosen_splines().splines.into_iter().map(|entry| entry.name).collect();
        let strokes: Vec<String> = app.chosen_strokes().strokes.into_iter().map(|stroke| stroke.name).collect();
        let expected: Vec<String> =
            ids[1..3].iter().map(|&id| app.session.drawing().curve(id).unwrap().name.clone()).collect();
        assert_eq!((&names, &strokes), (&expected, &expected));
    }
}
