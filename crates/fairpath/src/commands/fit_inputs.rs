//! The strokes of all inputs as one list, with the options that each is fitted by.

use std::path::PathBuf;

use anyhow::{Result, bail};
use fairpath_fit::Stroke;
use fairpath_io::{ReadOptions, StrokeFile, Unit, read_strokes};

use super::method_options::MethodOptions;
use crate::printer::Printer;

/// Everything that is to be fitted.
pub(crate) struct Inputs {
    /// The strokes of all inputs in their order, with names that differ.
    pub(crate) file: StrokeFile,
    /// For each stroke the size of a pixel, as its file says it.
    pixel_sizes: Vec<f64>,
}

/// A stroke to be fitted.
pub(crate) struct Job<'a> {
    pub(crate) stroke: &'a Stroke,
    pub(crate) options: MethodOptions,
}

impl Inputs {
    /// Reads them all.
    ///
    /// # Errors
    /// When one is unusable, or when they differ in unit or in the direction of y and so make no one file.
    pub(crate) fn read(paths: &[PathBuf], printer: &mut Printer) -> Result<Self> {
        if paths.iter().filter(|path| path.as_os_str() == "-").count() > 1 {
            bail!("standard input (-) can be read only once");
        }
        let mut strokes = Vec::new();
        let mut pixel_sizes = Vec::new();
        let mut first: Option<(String, StrokeFile)> = None;
        for path in paths {
            let mut file = read_strokes(path, &ReadOptions::default())?;
            let name = path.display().to_string();
            for warning in &file.warnings {
                printer.note(&format!("{name}: {}", warning.text));
            }
            if file.strokes.is_empty() {
                bail!("{name}: there is no stroke in it");
            }
            pixel_sizes.extend(std::iter::repeat_n(pixel_size(&file), file.strokes.len()));
            strokes.append(&mut file.strokes);
            match &first {
                None => first = Some((name, file)),
                Some((before, other)) if (other.unit, other.y) != (file.unit, file.y) => bail!(
                    "{name}: its unit is {} with y {}, but {before} has {} with y {}, and one result has one unit: \
                     fit them apart",
                    file.unit,
                    file.y.as_str(),
                    other.unit,
                    other.y.as_str()
                ),
                Some(_) => {}
            }
        }
        let mut file = StrokeFile::new(strokes);
        for warning in &file.warnings {
            printer.note(&warning.text);
        }
        if let Some((_, like)) = first {
            file = StrokeFile { unit: like.unit, y: like.y, dpi: like.dpi, ..file };
        }
        Ok(Self { file, pixel_sizes })
    }

    /// Leaves out all strokes but those of these names, if there are any names.
    ///
    /// # Errors
    /// When there is no stroke of one of the names.
    pub(crate) fn keep_only(&mut self, names: &[String]) -> Result<()> {
        if names.is_empty() {
            return Ok(());
        }
        if let Some(unknown) = names.iter().find(|name| !self.file.strokes.iter().any(|s| s.name == **name)) {
            let known: Vec<&str> = self.file.strokes.iter().take(12).map(|s| s.name.as_str()).collect();
            bail!("--stroke {unknown}: there is no stroke of that name; the first are {}", known.join(", "));
        }
        let kept: Vec<bool> = self.file.strokes.iter().map(|s| names.contains(&s.name)).collect();
        let mut of_stroke = kept.iter();
        self.file.strokes.retain(|_| *of_stroke.next().unwrap_or(&false));
        let mut of_size = kept.iter();
        self.pixel_sizes.retain(|_| *of_size.next().unwrap_or(&false));
        Ok(())
    }

    /// The strokes, each with what `options` says for its pixel size.
    ///
    /// # Errors
    /// As `options`.
    pub(crate) fn jobs(&self, options: impl Fn(Option<f64>) -> Result<MethodOptions>) -> Result<Vec<Job<'_>>> {
        let mut jobs: Vec<Job<'_>> = Vec::with_capacity(self.file.strokes.len());
        let mut known: Option<(f64, MethodOptions)> = None;
        for (stroke, &size) in self.file.strokes.iter().zip(&self.pixel_sizes) {
            // Strokes of one file share their options.
            let options = match &known {
                Some((before, options)) if *before == size => options.clone(),
                _ => options(Some(size))?,
            };
            known = Some((size, options.clone()));
            jobs.push(Job { stroke, options });
        }
        Ok(jobs)
    }
}

/// Size of one pixel of a 100 dpi screen in the file's unit, as its unit says, or where that is px, its dpi.
pub(crate) fn pixel_size(file: &StrokeFile) -> f64 {
    match file.unit {
        Unit::Px => file.dpi.map_or(1.0, |dpi| dpi / 100.0),
        unit => unit.pixel_size(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_a_hundredth_of_an_inch_on_paper_and_screens() {
        let size = |unit, dpi| pixel_size(&StrokeFile { unit, dpi, ..StrokeFile::default() });
        assert_eq!([size(Unit::Px, None), size(Unit::Px, Some(100.0)), size(Unit::Px, Some(200.0))], [1.0, 1.0, 2.0]);
        assert_eq!([size(Unit::Mm, None), size(Unit::In, None), size(Unit::M, None)], [0.254, 0.01, 1.0]);
    }
}
