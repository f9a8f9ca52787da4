//! Stub.
use anyhow::{Result, bail};

use super::Ending;
use crate::args::FitArgs;
use crate::printer::Printer;

pub(crate) fn run(_args: &FitArgs, _printer: &mut Printer) -> Result<Ending> {
    bail!("not yet")
}
