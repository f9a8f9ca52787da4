//! `fairpath edit`: a list of edits made on the curves of a file, all or none.

use anyhow::{Context, Result, bail};
use fairpath_io::{ReadOptions, read_edits, read_splines};
use fairpath_sketch::edited;

use super::Ending;
use crate::args::EditArgs;
use crate::output::{Destination, Ready};
use crate::printer::Printer;
use crate::{interrupt, pictures};

pub(crate) fn run(args: &EditArgs, printer: &mut Printer) -> Result<Ending> {
    let to = Destination::new(&args.output, args.format)?;
    interrupt::install();
    if args.splines.as_os_str() == "-" && args.edits.as_os_str() == "-" {
        bail!("standard input (-) can be read only once");
    }
    let file = read_splines(&args.splines, &ReadOptions::default())?;
    let edits = read_edits(&args.edits, &ReadOptions::default())?;
    let file = edited(&file, &edits).with_context(|| args.edits.display().to_string())?.file;
    let mut ready = Ready::default();
    let (bytes, warnings) = pictures::encode(&file, None, to.format, args.flip_y)?;
    ready.add(&to.path, bytes);
    for warning in warnings {
        printer.note(&format!("{}: {}", to.path.display(), warning.text));
    }
    ready.write()?;
    Ok(Ending::Done)
}
