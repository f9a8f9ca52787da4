//! Draws the strokes of a file: `cargo run -p fairpath-io --example pictures -- IN OUT.png|.svg [sheet] [comb]`.
//!
//! Fits each stroke with the default options, so it shows whatever the fitter does.

use fairpath_fit::{FitOptions, fit};
use fairpath_io::picture::{Comb, Layout, PictureOptions, draw_splines};
use fairpath_io::{Error, Failure, ReadOptions, SplineEntry, SplineFile, read_strokes, write_whole};
use std::path::Path;

fn main() -> Result<(), Error> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [input, output, words @ ..] = args.as_slice() else {
        eprintln!("usage: pictures IN OUT.png|.svg [sheet] [comb]");
        std::process::exit(2);
    };
    let strokes = read_strokes(Path::new(input), &ReadOptions::default())?;
    let mut splines = SplineFile { unit: strokes.unit, y: strokes.y, ..SplineFile::default() };
    for stroke in &strokes.strokes {
        match fit(stroke, &FitOptions::default()) {
            Ok(fit) => splines.splines.push(SplineEntry::from_fit(&stroke.name, "shortest-path", fit, None)),
            Err(error) => splines.failures.push(Failure::from_error(&stroke.name, &error)),
        }
    }
    let mut options = PictureOptions::default();
    if words.iter().any(|w| w == "sheet") {
        options.layout = Layout::Sheet { columns: None };
    }
    if words.iter().any(|w| w == "comb") {
        options.comb = Comb::Auto;
    }
    let picture = draw_splines(&splines, Some(&strokes), &options);
    let bytes = if output.ends_with(".svg") { picture.to_svg().as_bytes().to_vec() } else { picture.to_png()? };
    write_whole(Path::new(output), &bytes)
}
