//! How long each terrain of a folder takes to be read, and what it is.
//!
//! cargo run --release --package fairpath-io --example terrain_time -- ../shared/data/terrain

use fairpath_io::{TerrainOptions, read_terrain};
use std::path::PathBuf;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args_os().nth(1).ok_or("give the folder of the terrains")?;
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)?.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let mut options = TerrainOptions::default();
    for path in paths {
        // Pictures say neither.
        let is_picture = path.extension().is_some_and(|extension| extension == "png");
        options.spacing_m = is_picture.then_some(80.0);
        options.height_range_m = is_picture.then_some([-100.0, 3200.0]);
        let start = Instant::now();
        let file = read_terrain(&path, &options)?;
        let seconds = start.elapsed().as_secs_f64();
        let [columns, rows] = file.field.size();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        println!("{name:28} {seconds:6.3} s {columns:5} × {rows:5} every {:.2} m", file.field.spacing_m().x);
        for warning in &file.warnings {
            println!("    {}: {}", warning.code, warning.text);
        }
    }
    Ok(())
}
