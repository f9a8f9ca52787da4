//! Stub.
use anyhow::{Result, bail};

use super::Ending;
use crate::args::ConvertArgs;
use crate::printer::Printer;

pub(crate) fn run(_args: &ConvertArgs, _printer: &mut Printer) -> Result<Ending> {
    bail!("not yet")
}
