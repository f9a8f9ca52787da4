//! Draws the sets of French curves that come with the library: `cargo run -p fairpath-io --example draw_templates`.
//!
//! Writes `crates/fairpath-io/templates/NAME.json` for each set; a test compares the files with what this program would write.

mod chain;
mod sets;

use fairpath_io::{Error, write_templates};
use std::path::Path;

fn main() -> Result<(), Error> {
    for set in sets::all() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("templates/{}.json", set.name()));
        write_templates(&path, &set)?;
        println!("{}: {} French curves", set.name(), set.templates().len());
    }
    Ok(())
}
