//! Draws the strokes of a file: `cargo run -p fairpath-io --example stroke_pictures -- IN OUT.png|.svg [sheet] [comb] [stages]`.
//! With `stages`, the pictures of figure 4 of the first stroke go beside OUT.
//!
//! Any other extension that splines have (json, csv, dxf) is written as such.
//!
//! Fits each stroke with the default options, so it shows whatever the fitter does.

use fairpath_fit::{FitOptions, Stages, fit, fit_observed};
use fairpath_io::picture::{Comb, Layout, PictureOptions, draw_splines, draw_stages};
use fairpath_io::{
    Error, Failure, ReadOptions, SplineEntry, SplineFile, WriteOptions, read_strokes, write_splines, write_whole,
};
use std::path::Path;
use std::process::ExitCode;

fn main() -> Result<ExitCode, Error> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [input, output, words @ ..] = args.as_slice() else {
        eprintln!("usage: pictures IN OUT.png|.svg [sheet] [comb] [stages]");
        return Ok(ExitCode::from(2));
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
    if let (true, Some(stroke)) = (words.iter().any(|w| w == "stages"), strokes.strokes.first()) {
        let mut stages = Stages::default();
        if let Ok(fit) = fit_observed(stroke, &FitOptions::default(), &mut (), Some(&mut stages)) {
            for stage in draw_stages(stroke, &stages, &fit.spline, strokes.y, &options) {
                let path = Path::new(output).with_extension(format!("{}-{}.png", stage.letter, stage.name));
                write_whole(&path, &stage.picture.to_png()?)?;
            }
        }
    }
    if !output.ends_with(".svg") && !output.ends_with(".png") {
        for warning in write_splines(Path::new(output), &splines, Some(&strokes), &WriteOptions::default())? {
            eprintln!("{}: {}", warning.code, warning.text);
        }
        return Ok(ExitCode::SUCCESS);
    }
    let picture = draw_splines(&splines, Some(&strokes), &options);
    let bytes = if output.ends_with(".svg") { picture.to_svg().as_bytes().to_vec() } else { picture.to_png()? };
    write_whole(Path::new(output), &bytes)?;
    Ok(ExitCode::SUCCESS)
}
