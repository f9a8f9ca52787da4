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

    /// The strokes, each with what `options` says for its pixel size.
    ///
    /// # Errors
    /// As `options`.
    pub(crate) fn jobs(&self, options: impl Fn(Option<f64>) -> Result<MethodOptions>) -> Result<Vec<Job<'_>>> {
        let mut jobs: Vec<Job<'_>> = Vec::with_capacity(self.file.strokes.len());
        let mut known: Option<(f64, MethodOptions)> = None;
        for (stroke, &size) in self.file.strokes.iter().zip(&self.pixel_sizes) {
            // Strokes of one file share their options; making them means a trial fit.
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

/// Size of one pixel of a 100 dpi screen in the file's unit.
///
/// On paper that is a hundredth of an inch. Strokes in metres, kilometres and feet are maps, where it would be absurd: there one
/// pixel is a metre, unless `--pixel-size` says better.
pub(crate) fn pixel_size(file: &StrokeFile) -> f64 {
    let inch = match file.unit {
        Unit::Px => return file.dpi.map_or(1.0, |dpi| dpi / 100.0),
        Unit::Pt => 72.0,
        Unit::Mm => 25.4,
        Unit::Cm => 2.54,
        Unit::In => 1.0,
        Unit::M => return 1.0,
        Unit::Km => return 0.001,
        Unit::Ft => return 1.0 / 0.3048,
    };
    inch / 100.0
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
