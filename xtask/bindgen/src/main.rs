//! `fairpath-bindgen IN.wasm FOLDER NAME`: writes NAME.js and NAME_bg.wasm, a module of the browser and what it loads.

use std::env;
use std::path::Path;

use anyhow::{Context, Result, bail};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<()> {
    let args: Vec<String> = env::args().skip(1).collect();
    let [input, folder, name] = args.as_slice() else { bail!("usage: fairpath-bindgen IN.wasm FOLDER NAME") };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(input).out_name(name).typescript(false).web(true)?;
    // Names of functions stay, so that a report of a panic tells where it was.
    bindgen.keep_debug(false).remove_name_section(false);
    bindgen.generate(Path::new(folder)).with_context(|| format!("wasm-bindgen cannot work on {input}"))
}
