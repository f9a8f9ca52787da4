//! `fairpath convert`: a spline file in another format.

use anyhow::Result;
use fairpath_io::{ReadOptions, read_splines};

use super::Ending;
use crate::args::ConvertArgs;
use crate::output::{Destination, Ready};
use crate::printer::Printer;
use crate::{interrupt, pictures};

pub(crate) fn run(args: &ConvertArgs, printer: &mut Printer) -> Result<Ending> {
    let to = Destination::new(&args.output, args.format)?;
    interrupt::install();
    let file = read_splines(&args.input, &ReadOptions::default())?;
    let mut ready = Ready::default();
    let (bytes, warnings) = pictures::encode(&file, None, to.format, args.flip_y)?;
    ready.add(&to.path, bytes);
    for warning in warnings {
        printer.note(&format!("{}: {}", to.path.display(), warning.text));
    }
    ready.write()?;
    Ok(Ending::Done)
}
