//! Sets of French curves by name or from files.

use std::path::Path;

use anyhow::{Result, bail};
use fairpath_fit::TemplateSet;
use fairpath_io::{SHIPPED_TEMPLATES, TemplateOptions, read_templates, shipped_templates};

use crate::printer::Printer;

/// The set that is used where none is asked for.
pub(crate) const USUAL: &str = "burmester";

/// A set that comes along, by its name, or that of a file.
///
/// # Errors
/// When it is no such name and no file, or the file cannot be used.
pub(crate) fn load(source: &Path, pixel_size: Option<f64>, printer: &mut Printer) -> Result<TemplateSet> {
    if let Some(set) = source.to_str().and_then(shipped_templates) {
        return Ok(set);
    }
    // What looks like a name was meant as one.
    if source.extension().is_none() && source.as_os_str() != "-" && !source.exists() {
        let shipped = SHIPPED_TEMPLATES.join(", ");
        bail!("{}: there is no such set and no such file; the sets that come along are {shipped}", source.display());
    }
    let mut options = TemplateOptions::default();
    options.pixel_size = pixel_size;
    let file = read_templates(source, &options)?;
    for warning in &file.warnings {
        printer.note(&format!("{}: {}", source.display(), warning.text));
    }
    Ok(file.set)
}
